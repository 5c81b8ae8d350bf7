"""The page in a real browser: the robot of a simulator moves there, by state and by pixels."""

import io

import numpy as np
import pytest
from PIL import Image

from rapidgen.axes.kinematics import Kinematics
from rapidgen.client import Robot, Trajectory
from rapidgen.config import load_config
from tests.view.bench import STATE, until

pytestmark = pytest.mark.browser
GOAL = (0.6, 0.3, -0.4, 0.5, 0.7, -1.0)


def picture(page):
    """The space with the robots as pixels."""
    shot = page.locator("main canvas").screenshot()
    return np.asarray(Image.open(io.BytesIO(shot)).convert("RGB")).astype(int)


def move(ready, goal=GOAL, time=1.0):
    ports = ready["ports"]["rob1"]
    address = "127.0.0.1:{motion},{state},{control}".format(**ports)
    with Robot("irb120", address=address) as robot:
        start = robot.state.joints
        robot.execute(Trajectory([0.0, time], [start, goal])).result()


def test_the_robot_moves(irb120, open_page):
    page = open_page(irb120["view"])
    until(page, STATE)
    before = picture(page)
    move(irb120)
    there = f"{STATE}.groups[0].joints"
    values = until(page, there, lambda joints: np.allclose(joints, GOAL, atol=1e-6))
    until(page, "rapidgen.stage.drawn.time === rapidgen.state().time")
    moved = np.abs(picture(page) - before).max(axis=2) > 24
    assert moved.sum() > 2000
    group = load_config("irb120").groups[0]
    place, _ = Kinematics.of(group).forward(tuple(values))
    poses = page.evaluate("rapidgen.stage.robots.get('rob1').poses()")
    assert np.allclose(poses["link_7"][12:15], place, atol=1e-6)
    assert page.evaluate("location.hash") == ""
