"""Programs on a robot whose geometry is not quite the configuration's, as a calibrated one's."""

import json
from contextlib import contextmanager
from dataclasses import replace

import numpy as np
import pytest
from both_clients import Simulated
from driven import BENT, robot_of, system_of

from rapidgen.client import Program, TrajectoryRefused
from rapidgen.controller.controller import VirtualController
from rapidgen.testing.asyncio_clock import VirtualLoop
from rapidgen.wire.simple_message.spec import Reason


@contextmanager
def calibrated(tolerance, away=0.004):
    """A robot whose own geometry is some mm away from the configuration's."""
    config, system = system_of("irb120", json.dumps({"trajectory.pose_tolerance": tolerance}))
    (group,) = config.groups
    link = group.chain[2]
    x, y, z = link.xyz
    chain = (*group.chain[:2], replace(link, xyz=(x, y, z + away)), *group.chain[3:])
    controller = VirtualController(system, [replace(group, chain=chain)])
    controller.run_for(2.0)
    target = robot_of(config)
    with controller, Simulated(target, VirtualLoop(controller)) as robot:
        yield robot, controller.motion.group(config.groups[0].name)


def test_a_calibrated_robot_goes_to_the_pose_by_its_own_geometry():
    with calibrated(5) as (robot, group):
        robot.move_to(BENT, speed=1.0)
        wanted = robot.pose_of(BENT).moved(y=0.03)
        robot.run(Program(speed=0.2).move_linear(wanted)).result()
        place, turn = group.kinematics.forward(group.positions())
        assert np.allclose(place, wanted[0], atol=1e-5)
        assert abs(np.dot(turn, wanted[1])) == pytest.approx(1, abs=1e-9)
        assert np.linalg.norm(np.subtract(robot.pose[0], wanted[0])) > 1e-3


def test_a_robot_with_another_geometry_is_refused():
    for tolerance in (1, 3):
        with calibrated(tolerance) as (robot, _):
            robot.move_to(BENT, speed=1.0)
            with pytest.raises(TrajectoryRefused) as refused:
                robot.run(Program(speed=0.2).move_linear(robot.pose.moved(y=0.03)))
            assert refused.value.reason is Reason.POSE_MISMATCH


def test_a_circle_begins_at_the_pose_before_it():
    """237 degrees; from where the robot's geometry has the joints, mm away, more than 240."""
    for away in (-0.004, 0.004):
        with calibrated(5, away) as (robot, group):
            robot.move_to(BENT, speed=1.0)
            start = robot.pose_of(BENT)
            via, end = start.moved(y=0.01, z=0.02), start.moved(y=0.0205, z=0.005)
            program = Program(speed=0.2).move_linear(start, zone="fine")
            robot.run(program.move_circular(via, end, zone="fine")).result()
            assert np.allclose(group.kinematics.forward(group.positions())[0], end[0], atol=1e-5)
