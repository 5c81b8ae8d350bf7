"""The page draws links and TCP where `axes` computes them.

Links of every shipped model, and the TCP's pixel.
"""

import io
import random

import numpy as np
import pytest
from PIL import Image

from rapidgen.axes import frames
from rapidgen.axes.chain import along, steps_of
from rapidgen.axes.kinematics import Kinematics
from rapidgen.axes.mapping import JointMap
from rapidgen.config import load_config, shipped_names
from rapidgen.viewer.messages import Pose, Positions, RobotPlace, Scene
from rapidgen.viewer.primitive_urdf import described
from rapidgen.viewer.robots import group_of
from tests.viewer.bench import STATE, until

pytestmark = pytest.mark.browser
POSTURES = 20
HERE = Pose(position=(0, 0, 0), orientation=(1, 0, 0, 0))


def scene_of(groups):
    return Scene(
        title="robots",
        kind="simulation",
        may_command=True,
        groups=tuple(group_of(group, described(group)) for group in groups),
    )


def place_of(group, posture):
    urdf = described(group).values(JointMap.of(group).to_urdf(posture))
    return RobotPlace(
        joints=urdf,
        commanded=urdf,
        axes=posture,
        tcp=None,
        tool=HERE,
        tool_held=True,
        work_object=HERE,
        standing=True,
    )


@pytest.fixture(scope="module")
def stage(browser, irb120):
    """A page whose space shows what a test gives it."""
    context = browser.new_context(viewport={"width": 1280, "height": 720})
    page = context.new_page()
    page.goto(irb120["view"])
    until(page, STATE)
    yield page
    context.close()


@pytest.mark.parametrize("name", shipped_names())
def test_links_are_where_axes_says(stage, name):
    groups = load_config(name).groups
    stage.evaluate("scene => rapidgen.stage.build(scene)", scene_of(groups).model_dump(mode="json"))
    chance = random.Random(name)
    tried = [
        [tuple(chance.uniform(j.lower, j.upper) for j in group.joints) for group in groups]
        for _ in range(POSTURES)
    ]
    states = [
        Positions(time=0.0, groups=tuple(map(place_of, groups, postures))).model_dump(mode="json")
        for postures in tried
    ]
    # All at once: each that is asked for alone would be drawn, too.
    displayed = stage.evaluate(
        "states => states.map(state => (rapidgen.stage.show(state),"
        " [...rapidgen.stage.robots.values()].map(robot => robot.poses())))",
        states,
    )
    for postures, drawn in zip(tried, displayed, strict=True):
        for group, posture, poses in zip(groups, postures, drawn, strict=True):
            steps = steps_of(group, group.chain)
            urdf = JointMap.of(group).to_urdf(posture)
            for i in range(1, len(steps) + 1):
                assert_same(poses[f"link_{i}"], along(steps[:i], urdf))
            assert_same(poses[f"link_{len(steps)}"], Kinematics.of(group).forward(posture))


def assert_same(matrix, pose):
    matrix = np.reshape(matrix, (4, 4)).T
    np.testing.assert_allclose(matrix[:3, 3], pose[0], atol=1e-6)
    np.testing.assert_allclose(matrix[:3, :3], frames.to_matrix(pose[1]), atol=1e-6)


def test_the_tcp_is_drawn_where_a_camera_sees_it(stage):
    """The marker's pixels, by taking it away; the camera is computed here once more."""
    group = load_config("irb120").groups[0]
    posture = (0.3, 0.2, -0.1, 0.4, 0.5, 0.0)
    scene = scene_of([group]).model_dump(mode="json")
    state = Positions(time=0.0, groups=(place_of(group, posture),)).model_dump(mode="json")
    stage.evaluate(
        "([scene, state]) => { rapidgen.stage.build(scene); rapidgen.stage.show(state);"
        " rapidgen.stage.look('fit'); rapidgen.stage.bare(true) }",
        [scene, state],
    )
    displayed = picture(stage)
    stage.evaluate(
        "() => { rapidgen.stage.robots.get('rob1').tcp.visible = false; rapidgen.stage.draw() }"
    )
    changed = np.argwhere(np.abs(picture(stage) - displayed).max(axis=2) > 12)[:, ::-1]
    place, _ = Kinematics.of(group).forward(posture)
    eye = stage.evaluate("rapidgen.stage.eye()")
    height, width = displayed.shape[:2]
    expected = seen(np.array(place), eye, width, height)
    ends = np.linalg.norm(changed - expected, axis=1)
    assert ends.min() < 2
    assert ends.max() < 120
    own = stage.evaluate("point => rapidgen.stage.pixel(point)", list(place))
    np.testing.assert_allclose(own, expected, atol=0.5)


def picture(page):
    drawn = page.evaluate("rapidgen.stage.drawn.pictures")
    page.evaluate("rapidgen.stage.draw()")
    until(page, "rapidgen.stage.drawn.pictures", lambda now: now > drawn)
    shot = page.locator("main canvas").screenshot()
    return np.asarray(Image.open(io.BytesIO(shot)).convert("RGB")).astype(int)


def seen(point, eye, width, height):
    """Where a pinhole camera that stands upright sees a point, in pixels."""
    forward = np.array(eye["target"]) - eye["position"]
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, [0, 0, 1])
    right /= np.linalg.norm(right)
    away = point - eye["position"]
    scale = height / 2 / np.tan(np.radians(eye["angle"]) / 2) / (away @ forward)
    return np.array(
        [width / 2 + away @ right * scale, height / 2 - away @ np.cross(right, forward) * scale]
    )
