"""Points that are made while the robot moves: 50 a second, as a controller of your own would."""

import math

from rapidgen.config import load_config
from trying import robot_of

# 0.1 s is the shortest segment that any controller follows; a driver is built with another one.
config = load_config("irb120", overrides=["trajectory.min_segment=0.02"])

with robot_of(config) as robot:
    here = robot.state.joints
    with robot.stream() as stream:  # the end of the block waits for the robot
        for n in range(76):
            time = n * 0.02
            swing = 0.05 * math.sin(math.tau * time / 1.5) ** 2
            stream.append(time, [value + swing for value in here])
    print(f"{stream.total} points by {stream.mode}, {stream.starved} times without one")
