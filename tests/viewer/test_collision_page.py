"""Collision checks on the page: bodies, distances, the first contact, objects and zones."""

import pytest

from tests.viewer.bench import STATE, simulator, until

pytestmark = pytest.mark.browser
CELL = """robots:
  T_ROB1: {model: irb120}
tools:
  grip:
    frame: {position: [0, 0, 120]}
    load: {mass: 0.5}
    shapes: [{capsule: {radius: 30, length: 100}, frame: {position: [0, 0, 60]}}]
things:
  post: {box: [80, 80, 900], frame: {position: [350, 250, 450]}}
  floor: {half_space: [0, 0, 1], frame: {position: [0, 0, -5]}}
zones:
  area: {keep: inside, box: {low: [-900, -900, 0], high: [900, 900, 1200]}, of: [tcp]}
collision: {clearance: 10}
"""
PROGRAM = """MODULE turn
  CONST jointtarget a := [[0,10,5,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget b := [[70,10,5,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveAbsJ a, v500, fine, grip;
    MoveAbsJ b, v200, fine, grip;
  ENDPROC
ENDMODULE
"""
BODIES = "rapidgen.stage.collisions.seen"
PANEL = "document.querySelector('#panel-collisions').innerText"


@pytest.fixture(scope="module")
def ready(tmp_path_factory):
    folder = tmp_path_factory.mktemp("collisions")
    (folder / "cell.yaml").write_text(CELL)
    (folder / "turn.mod").write_text(PROGRAM)
    arguments = (str(folder / "turn.mod"), "--cell", str(folder / "cell.yaml"))
    with simulator(*arguments) as (ready, _):
        yield ready


def test_contact_is_shown_in_red_with_points_and_ghost(ready, open_page):
    page = open_page(ready["view"])
    until(page, STATE)
    page.get_by_role("tab", name="Collisions").click()
    text = until(page, PANEL, lambda text: "grip touches post" in text)
    assert "MoveAbsJ" in text
    # Links of shipped models have no shapes, and this is said.
    assert "links of rob1: no shapes" in text
    until(page, BODIES, lambda bodies: bodies == {"grip": "contact", "post": "contact"})
    until(page, "document.body.dataset.state", lambda now: now == "collision")
    label = "[...document.querySelectorAll('.labels span')].map(label => label.textContent)"
    assert any("mm deep" in text for text in page.evaluate(label))
    robot = "rapidgen.stage.robots.get('rob1')"
    assert not page.evaluate(f"{robot}.isMet")
    page.get_by_role("button", name="Show robots at the first contact").click()
    assert page.evaluate(f"{robot}.isMet")
    page.get_by_text("Layers").click()
    page.get_by_label("Collision shapes").check()
    shown = {"grip": "contact", "post": "contact", "floor": "free"}
    assert page.evaluate(BODIES) == shown
    page.get_by_label("Collision shapes").uncheck()
    assert page.evaluate(f"Object.keys({BODIES}).length") == 2


def jogged_away(page):
    """Stop the program and turn the robot away from the post."""
    until(page, STATE)
    page.get_by_role("tab", name="Pendant").click()
    page.get_by_role("button", name="Stop", exact=True).click()
    page.get_by_role("tab", name="Jog", exact=True).click()
    figure = page.get_by_label("joint_1 in °")
    figure.fill("-60")
    figure.press("Enter")
    until(page, f"{STATE}.groups[0].axes[0]", lambda angle: abs(angle + 1.0471976) < 1e-6)


@pytest.mark.long
def test_bodies_are_free_after_a_jog(ready, open_page):
    page = open_page(ready["view"])
    jogged_away(page)
    until(page, BODIES, lambda now: now == {})
    page.get_by_role("tab", name="Collisions").click()
    until(page, PANEL, lambda text: "nearer than 100 mm" in text)


@pytest.mark.long
def test_dropped_path_into_an_object_is_rejected(ready, open_page, tmp_path):
    page = open_page(ready["view"])
    jogged_away(page)
    start = page.evaluate(STATE)["groups"][0]["joints"][:6]
    for name, angle in (("into.csv", 1.2), ("away.csv", -1.2)):
        rows = ["time," + ",".join(f"joint_{i}" for i in range(1, 7))]
        rows += [",".join(map(str, (t, a, *start[1:]))) for t, a in ((0, start[0]), (4, angle))]
        (tmp_path / name).write_text("\n".join(rows))
    page.get_by_role("tab", name="Path").click()
    shown = "document.querySelector('#panel-trajectory').innerText"
    page.get_by_label("Trajectory file").set_input_files(tmp_path / "into.csv")
    text = until(page, shown, lambda text: "Rejected." in text)
    assert "RG820" in text
    assert "grip touches post" in text
    assert "in contact" in text
    page.get_by_label("Trajectory file").set_input_files(tmp_path / "away.csv")
    text = until(page, shown, lambda text: "Ready to execute." in text)
    assert "clearance above 100 mm" in text
    page.get_by_role("button", name="Remove").click()


def test_objects_zones_and_tools_are_drawn(ready, open_page):
    page = open_page(ready["view"])
    until(page, STATE)
    around = page.evaluate("rapidgen.stage.around()")
    assert set(around) == {"post", "floor"}
    low, high = around["post"]
    assert low == pytest.approx([0.31, 0.21, 0.0], abs=1e-6)
    assert high == pytest.approx([0.39, 0.29, 0.9], abs=1e-6)
    assert page.evaluate("rapidgen.stage.furnished()") == {"zones": ["area"], "tools": ["grip"]}
