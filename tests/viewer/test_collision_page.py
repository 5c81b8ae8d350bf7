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


def test_nearest_pair_has_its_distance_after_a_jog(ready, open_page):
    page = open_page(ready["view"])
    until(page, STATE)
    page.get_by_role("tab", name="Pendant").click()
    page.get_by_role("button", name="Stop", exact=True).click()
    page.get_by_role("tab", name="Jog", exact=True).click()
    figure = page.get_by_label("joint_1 in °")
    for angle, bodies in (("0", {}), ("-60", {})):
        figure.fill(angle)
        figure.press("Enter")
        until(page, BODIES, lambda now, bodies=bodies: now == bodies)
    page.get_by_role("tab", name="Collisions").click()
    until(page, PANEL, lambda text: "nearer than 100 mm" in text)


def test_objects_zones_and_tools_are_drawn(ready, open_page):
    page = open_page(ready["view"])
    until(page, STATE)
    around = page.evaluate("rapidgen.stage.around()")
    assert set(around) == {"post", "floor"}
    low, high = around["post"]
    assert low == pytest.approx([0.31, 0.21, 0.0], abs=1e-6)
    assert high == pytest.approx([0.39, 0.29, 0.9], abs=1e-6)
    assert page.evaluate("rapidgen.stage.furnished()") == {"zones": ["area"], "tools": ["grip"]}
