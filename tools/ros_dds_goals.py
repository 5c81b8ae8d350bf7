"""Send random goals to the ROS 2 node over DDS, with a real rclpy; check their ends.

`build/ros/bin/python tools/ros_dds_goals.py [--goals N] [--seed N]`, after `.ci/ros`. The simulator
is ten times as fast as real time. A goal is good, outside the limits, too fast, late, with a wrong
joint name, or cancelled while the robot moves; the place where the robot stands is compared, too.
"""

import argparse
import os
import random
import sys
import time
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "ros"))

import real
from builtin_interfaces.msg import Duration, Time
from control_msgs.action import FollowJointTrajectory
from trajectory_msgs.msg import JointTrajectoryPoint

from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.generate import build, make_system

NAMES = [f"joint_{number}" for number in range(1, 7)]
EXPECTED = {
    "good": ("succeeded", 0),
    "limits": ("aborted", -1),
    "names": ("aborted", -2),
    "fast": ("aborted", -1),
    "late": ("aborted", -3),
    "cancel": ("canceled", 0),
}
"""State and error_code by kind."""
KINDS = ("good", "good", "good", "limits", "names", "fast", "late", "cancel")
TIMEOUT = 60.0
"""s that anything may take."""


def goal_of(kind: str, rows: list[list[float]]) -> FollowJointTrajectory.Goal:
    """Return a goal of a kind, whose first point is where the robot stands."""
    goal = FollowJointTrajectory.Goal()
    goal.trajectory.joint_names = ["elbow", *NAMES[1:]] if kind == "names" else NAMES
    period = {"cancel": 100.0, "fast": 0.11}.get(kind, 1.0)
    if kind == "limits":
        rows = [*rows, [9.0] * 6]
    if kind == "fast":
        rows = [rows[0], [value + 1.5 for value in rows[0]]]
    if kind == "late":
        goal.trajectory.header.stamp = Time(sec=1)
    for number, row in enumerate(rows):
        seconds, part = divmod(number * period, 1.0)
        at = Duration(sec=int(seconds), nanosec=int(part * 1e9))
        point = JointTrajectoryPoint(positions=row, time_from_start=at)
        goal.trajectory.points.append(point)
    return goal


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--goals", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    requested = parser.parse_args()
    chance, ends, wrong = random.Random(requested.seed), Counter(), []
    config = load_config("irb120")
    system = make_system(config, build(config))
    real.start()
    began = time.monotonic()
    with VirtualController(
        system, config.groups, clock="real", speed=10.0, ports="auto"
    ) as simulator:
        simulator.start()
        address = str(simulator.address("rob1", timeout=TIMEOUT))
        node = real.Driver(parameter_overrides={"config": "irb120", "address": address})
        node.topics["robot_status"].wait(lambda status: status.motion_possible.val == 1)
        action = node.actions["rob1_controller/follow_joint_trajectory"]

        def joints() -> list[float]:
            return list(simulator.call(simulator.motion.groups["rob1"].positions)[:6])

        for number in range(requested.goals):
            kind, before = chance.choice(KINDS), joints()
            rows = [before]
            for _ in range(chance.randint(1, 4)):
                rows.append([chance.uniform(-0.4, 0.4) for _ in NAMES])
            handle = action.send(goal_of(kind, rows))
            if kind == "cancel":
                assert handle.fed.wait(TIMEOUT)
                action.cancel(handle)
            assert handle.over.wait(TIMEOUT)
            end = handle.status, handle.result.error_code
            stands = joints()
            expected = {"good": rows[-1], "cancel": stands}.get(kind, before)
            far = max(abs(a - b) for a, b in zip(stands, expected, strict=True))
            ends[kind] += 1
            if end != EXPECTED[kind] or far > 1e-3:
                wrong.append((number, kind, end, far, handle.result.error_string))
        node.destroy_node()
    middleware = os.environ.get("RMW_IMPLEMENTATION", "rmw_fastrtps_cpp")
    print(
        f"{middleware}: {sum(ends.values())} goals in {time.monotonic() - began:.0f} s", dict(ends)
    )
    for one in wrong:
        print("wrong:", *one)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
