"""A path as an array: points from numpy, times from the axes' own limits."""

import numpy as np

from rapidgen.client import Trajectory
from trying import robot_of

with robot_of("irb120") as robot:
    here = np.array(robot.state.joints)
    share = np.linspace(0, 1, 11)
    around = 0.2 * np.sin(np.pi * share)[:, None] * np.array([1, 0.5, -0.5, 0, 0.5, 1])
    rough = Trajectory(3 * share, here + around, robot.group.names)

    path = rough.timed(robot.group, speed=0.5)  # half of what the axes can do
    print(f"{path} instead of {rough.duration:.1f} s")
    fastest = np.abs(np.diff(path["joint_1"]) / np.diff(path.times)).max()
    print(f"joint_1 at most {np.degrees(fastest):.0f} degrees/s")

    execution = robot.execute(path)
    print(execution)
    print(f"{execution.result().seconds:.2f} s")
