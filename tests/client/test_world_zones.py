"""The generated World Zones stop the robot on a virtual controller.

WZLimSup stops robot and program on the path before the zone [manual 3HAC050917]. The controller
computes the crossing itself: these tests need no check of the client.
"""

import numpy as np
import pytest
from driven import driven

from rapidgen.client import MotionFailed, Trajectory

ZONES = """
zones:
  post: {keep: out, cylinder: {base: [300, 300, 0], radius: 60, height: 900}, of: [tcp]}
  area: {keep: inside, box: {low: [-500, -700, 100], high: [700, 700, 1100]}, of: [tcp]}
"""
START = np.array([0.0, 0.2, 0.1, 0.0, 0.6, 0.0])


@pytest.fixture
def config(tmp_path):
    (tmp_path / "zones.yaml").write_text("robots: {T_ROB1: {model: irb120}}\n" + ZONES)
    path = tmp_path / "robot.yaml"
    path.write_text("model: irb120\ncontroller: {robotware: 6.15}\nworld_zones: zones.yaml\n")
    return str(path)


def turn(angle):
    return Trajectory.from_points([START, [angle, *START[1:]]], seconds=4)


@pytest.mark.parametrize(
    ("points", "border"),
    [
        # The TCP is 0.42 m from the axis of joint 1, as is the axis of the post.
        (turn(1.4), lambda tcp: np.hypot(tcp[0] - 0.3, tcp[1] - 0.3) - 0.06),
        (
            Trajectory.from_points([START, [0.0, 1.2, 0.5, 0.0, 0.6, 0.0]], seconds=4),
            lambda tcp: tcp[2] - 0.1,
        ),
    ],
)
def test_robot_stops_before_a_generated_zone(config, points, border):
    with driven(config) as (robot, controller):
        robot.execute(Trajectory.from_points([[0.0] * 6, START], seconds=2)).result()
        with pytest.raises(MotionFailed, match="program was stopped"):
            robot.execute(points).result()
        group = controller.motion.groups["rob1"]
        tcp = group.geometry().forward(group.positions())[0]
        assert 0 < border(tcp) < 0.01
        assert any("World zone" in event.title for event in controller.log)


def test_robot_moves_beside_a_generated_zone(config):
    with driven(config) as (robot, controller):
        robot.execute(Trajectory.from_points([[0.0] * 6, START], seconds=2)).result()
        assert robot.execute(turn(-1.4)).result().deviation < 1e-3
        assert len(controller.motion.zones) == 2
