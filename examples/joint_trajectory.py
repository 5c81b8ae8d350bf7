"""A joint trajectory: where the robot stands, to a bent posture, and back."""

import math

from rapidgen.client import Trajectory
from trying import robot_of

with robot_of("irb120") as robot:
    here = robot.state.joints
    bent = [value + math.radians(angle) for value, angle in zip(here, (5, 4, -3, 0, 6, 10))]
    path = Trajectory.from_points([here, bent, here], seconds=0.5, names=robot.group.names)

    for note in robot.check(path):  # faults would be raised here, before a byte is sent
        print(note.message)

    result = robot.execute(path).result()
    print(f"{result.points} points in {result.seconds:.2f} s")
    print("stands", math.degrees(result.deviation), "degrees from the last point")
