"""The page in a real browser: the robot of a simulator moves there, by state and by pixels, and its
driver is read together with the templates that made it."""

import io

import numpy as np
import pytest
from PIL import Image

from rapidgen._data import data_folder
from rapidgen.axes.kinematics import Kinematics
from rapidgen.client import Robot, Timeouts, Trajectory
from rapidgen.config import load_config
from tests.viewer.bench import STATE, until

pytestmark = pytest.mark.browser
SEEN = "rapidgen.panels.program.seen"
# A page that hears nothing until `hears()`.
KEPT = """
let kept = [];
window.hears = () => { const now = kept; kept = null; now.forEach((take) => take()); };
const Real = WebSocket;
window.WebSocket = class extends Real {
  set onmessage(take) {
    super.onmessage = (event) => { if (kept) kept.push(() => take(event)); else take(event); };
  }
};
"""
GOAL = (0.6, 0.3, -0.4, 0.5, 0.7, -1.0)


def picture(page):
    """The space with the robots as pixels."""
    shot = page.locator("main canvas").screenshot()
    return np.asarray(Image.open(io.BytesIO(shot)).convert("RGB")).astype(int)


def move(ready, goal=GOAL, time=1.0):
    ports = ready["ports"]["rob1"]
    address = "127.0.0.1:{motion},{state},{control}".format(**ports)
    with Robot("irb120", address=address, timeouts=Timeouts(silence=20)) as robot:
        start = robot.state.joints
        robot.execute(Trajectory([0.0, time], [start, goal])).result()


def test_the_robot_moves(irb120, open_page):
    page = open_page(irb120["view"])
    until(page, STATE)
    before = picture(page)
    move(irb120)
    target = f"{STATE}.groups[0].joints"
    values = until(page, target, lambda joints: np.allclose(joints, GOAL, atol=1e-6))
    until(page, "rapidgen.stage.drawn.time === rapidgen.state().time")
    moved = np.abs(picture(page) - before).max(axis=2) > 24
    assert moved.sum() > 2000
    group = load_config("irb120").groups[0]
    place, _ = Kinematics.of(group).forward(tuple(values))
    poses = page.evaluate("rapidgen.stage.robots.get('rob1').poses()")
    assert np.allclose(poses["link_7"][12:15], place, atol=1e-6)
    assert page.evaluate("location.hash") == ""


def test_no_tab_moves_away_under_the_mouse(irb120, open_page):
    """Which are there is known with the scene; a click before it went to the next one."""
    page = open_page(irb120["view"], before=KEPT)
    tabs = page.get_by_role("tab")
    page.get_by_role("tablist", include_hidden=True).wait_for(state="attached")
    assert tabs.count() == 0
    page.evaluate("hears()")
    page.get_by_role("tab", name="Program").click()
    named = ["Pendant", "Program", "Axes", "Signals", "Log", "Path", "Network"]
    assert tabs.all_inner_texts() == named
    assert page.get_by_role("tab", selected=True).inner_text() == "Program"


def test_from_a_line_to_its_template_and_back(irb120, open_page):
    page = open_page(irb120["view"])
    page.get_by_role("tab", name="Program").click()
    # It is shown where the program is, which is far down.
    page.locator(".cm-at-program").wait_for()
    assert until(page, f"{SEEN}.program") > 50
    modules = page.get_by_label("Module", exact=True)
    modules.select_option("ROS_motion")
    text = until(page, f"{SEEN}.text", lambda text: text and "MODULE ROS_motion\n" in text)
    line = text.splitlines().index("    PROC main()") + 1
    source = page.locator(".source")
    source.locator(".cm-line").filter(has_text="MODULE ROS_motion").first.click()
    page.keyboard.press("Control+Home")
    for _ in range(line - 1):
        page.keyboard.press("ArrowDown")
    origin = page.locator(".origin")
    origin.get_by_text(f"Line {line} is made by").wait_for()
    template = (data_folder("templates") / "ROS_motion.mod.j2").read_text()
    number = template.splitlines().index("    PROC main()") + 1
    assert number != line
    origin.get_by_role("button", name=f"ROS_motion.mod.j2, line {number}", exact=True).click()
    until(page, f"{SEEN}.text", lambda text: text == template)
    assert modules.input_value() == "ROS_motion.mod.j2"
    page.locator(".cm-lineNumbers .cm-gutterElement", has_text=str(number)).first.click()
    page.get_by_text("not in templates").wait_for()
    assert page.evaluate(f"{SEEN}.breakpoints") == []
    back = origin.get_by_role("button", name=f"ROS_motion, line {line}", exact=True)
    back.click()
    until(page, f"{SEEN}.text", lambda now: now == text)
    origin.get_by_text(f"Line {line} is made by").wait_for()
    # What several modules have in common names all of them.
    modules.select_option("_head.j2")
    origin.get_by_role("button", name="ROS_motion, line 2", exact=True).wait_for()
    assert origin.get_by_role("button").count() > 1
    page.get_by_label("Follow").check()
    page.locator(".cm-at-program").wait_for()
    page.close()
