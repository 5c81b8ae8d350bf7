"""Targets and frames in the scene, and the TCP dragged by the mouse."""

import numpy as np
import pytest

from rapidgen.axes.kinematics import Kinematics
from rapidgen.config import load_config
from tests.viewer.bench import STATE, picture_for_docs, simulator, until

pytestmark = pytest.mark.browser
PROGRAM = """MODULE p
  PERS tooldata grip := [TRUE, [[0,0,120],[1,0,0,0]], [1,[0,0,60],[1,0,0,0],0,0,0]];
  PERS wobjdata table := [FALSE, TRUE, "", [[300,0,100],[1,0,0,0]], [[0,0,0],[1,0,0,0]]];
  CONST robtarget pick := [[10,20,50],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget home := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveAbsJ home, v1000, fine, grip;
    MoveJ Offs(pick,0,0,80), v500, fine, grip \\WObj:=table;
    MoveL pick, v500, fine, grip \\WObj:=table;
    WaitTime 1000;
  ENDPROC
ENDMODULE
"""


@pytest.fixture(scope="module")
def ready(tmp_path_factory):
    module = tmp_path_factory.mktemp("stage") / "p.mod"
    module.write_text(PROGRAM)
    with simulator(str(module)) as (ready, _):
        yield ready


def test_targets_of_the_program_and_the_frames_of_its_moves_are_drawn(ready, open_page):
    page = open_page(ready["view"])
    until(page, STATE)
    names = "[...document.querySelectorAll('.labels span')].map(label => label.textContent)"
    assert until(page, names, len) == ["home", "pick", "grip", "table"]
    aims = page.evaluate("rapidgen.stage.aimed()")
    np.testing.assert_allclose(aims[1]["pose"]["position"], [0.31, 0.02, 0.23], atol=1e-9)
    np.testing.assert_allclose(aims[2]["pose"]["position"], [0.31, 0.02, 0.15], atol=1e-9)
    group = load_config("irb120").groups[0]
    place, _ = Kinematics.of(group).forward((0, 0, 0, 0, np.radians(30), 0))
    assert np.linalg.norm(np.array(aims[0]["pose"]["position"]) - place) == pytest.approx(0.12)
    # The work object's frame is where the move has it.
    until(page, f"{STATE}.groups[0].work_object.position", lambda at: at[0] == pytest.approx(0.3))
    page.get_by_role("button", name="Close hint").click()
    page.get_by_role("tab", name="Program").click()
    page.locator(".cm-at-program").wait_for()
    picture_for_docs(page, "view")
    displayed = "rapidgen.stage.robots.get('rob1').object.visible"
    until(page, displayed)
    page.get_by_text("Layers").click()
    page.get_by_label("Frames").uncheck()
    until(page, displayed, lambda visible: not visible)
    page.get_by_label("Targets").uncheck()
    assert page.locator(".labels span").count() == 0


# What is dragged is carried out only when the test lets it be.
SLOW = """() => {
  const carried = rapidgen.stage.onwanted;
  window.asked = [];
  rapidgen.stage.onwanted = (robot, ...place) => new Promise((answered) => {
    asked.push({ to: place[0], carry: () => carried(robot, ...place).then(answered) });
  });
}"""


def drag(page):
    """Drag the handle of the TCP along its x arrow, by a tenth of its length four times."""
    # The mouse finds what has been drawn.
    held = page.get_by_role("button", name="Drag TCP")
    drawn = held.evaluate("button => { button.click(); return rapidgen.stage.drawn.pictures; }")
    until(page, "rapidgen.stage.drawn.pictures", lambda pictures: pictures > drawn)
    x, y, reach = page.evaluate("rapidgen.stage.handle()")
    box = page.locator("main canvas").bounding_box()
    page.mouse.move(box["x"] + reach[0], box["y"] + reach[1])
    page.mouse.down()
    for share in (0.1, 0.2, 0.3, 0.4):
        at = (reach[0] + share * (reach[0] - x), reach[1] + share * (reach[1] - y))
        page.mouse.move(box["x"] + at[0], box["y"] + at[1])
    page.mouse.up()


def stopped(page):
    """Stop the program; the TCP where the robot then stands."""
    until(page, STATE)
    page.get_by_role("button", name="Stop", exact=True).click()
    until(page, f"{STATE}.groups[0].standing")
    until(page, "document.querySelector('header').textContent", lambda text: "Stopped" in text)
    return page.evaluate(f"{STATE}.groups[0].tcp")


def test_what_is_dragged_while_another_place_is_on_its_way_is_not_lost(ready, open_page):
    """The handle went back to the robot as it was let go, and the robot was sent back there."""
    page = open_page(ready["view"])
    before = stopped(page)["position"]
    page.evaluate(SLOW)
    drag(page)
    first = until(page, "asked", len)[0]["to"]
    page.evaluate("asked[0].carry()")
    until(page, f"{STATE}.groups[0].tcp.position", lambda at: np.allclose(at, first, atol=1e-6))
    last = until(page, "asked", lambda requested: len(requested) == 2)[1]["to"]
    page.evaluate("asked[1].carry()")
    until(page, f"{STATE}.groups[0].tcp.position", lambda at: np.allclose(at, last, atol=1e-6))
    ways = [np.linalg.norm(np.subtract(at, before)) for at in (first, last)]
    assert ways[0] > 0.001
    assert ways[1] == pytest.approx(4 * ways[0], rel=0.2)


def test_the_tcp_is_dragged_by_the_mouse_and_typed(ready, open_page):
    page = open_page(ready["view"])
    before = stopped(page)
    drag(page)

    def moved(tcp):
        return np.linalg.norm(np.subtract(tcp["position"], before["position"])) > 0.005

    now = until(page, f"{STATE}.groups[0].tcp", moved)
    # By the handle's x alone: the tool keeps its orientation.
    assert now["position"][1:] == pytest.approx(before["position"][1:], abs=1e-6)
    np.testing.assert_allclose(now["orientation"], before["orientation"], atol=1e-6)
    page.get_by_role("tab", name="Jog").click()
    page.get_by_label("TCP z of rob1 in mm").fill("200")
    page.get_by_label("TCP z of rob1 in mm").press("Enter")
    until(page, f"{STATE}.groups[0].tcp.position[2]", lambda z: z == pytest.approx(0.2, abs=1e-6))
    page.get_by_label("TCP x of rob1 in mm").fill("5000")
    page.get_by_label("TCP x of rob1 in mm").press("Enter")
    page.get_by_text("does not reach").wait_for()


# Without letting the page hear anything between them.
AT_ONCE = """([names, values, event]) => names.forEach((name, i) => {
  const input = document.querySelector(`input[aria-label="${name}"]`);
  input.value = values[i];
  input.dispatchEvent(new Event(event));
})"""


def test_what_is_asked_for_first_stays_when_the_next_one_comes_at_once(ready, open_page):
    """Each order had values of all axes, so it reverted the one before."""
    page = open_page(ready["view"])
    stopped(page)
    page.get_by_role("tab", name="Jog").click()
    displayed = page.locator(".axes input[type=range]").evaluate_all(
        "all => all.map(own => own.ariaLabel)"
    )
    names = [displayed[0], displayed[3]]
    page.evaluate(AT_ONCE, [names, [0.2, 0.1], "input"])
    axes = until(page, f"{STATE}.groups[0].axes", lambda axes: axes[3] == pytest.approx(0.1))
    assert axes[0] == pytest.approx(0.2)
    x, y, _ = page.evaluate(f"{STATE}.groups[0].tcp.position")
    names = [f"TCP {axis} of rob1 in mm" for axis in "xy"]
    page.evaluate(AT_ONCE, [names, [1000 * x - 10, 1000 * y + 20], "change"])
    until(page, f"{STATE}.groups[0].tcp.position[1]", lambda at: at == pytest.approx(y + 0.02))
    assert page.evaluate(f"{STATE}.groups[0].tcp.position[0]") == pytest.approx(x - 0.01)
