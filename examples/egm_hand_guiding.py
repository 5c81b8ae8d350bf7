"""Hand guiding of a simulated mass: the TCP moves as a body that a hand pushes.

The body has a mass and is damped. Its force comes from a simulated hand, which pulls it towards a
point as a spring does; a real one comes from a force sensor.
"""

import math

from guiding import session_of
from rapidgen.client import Pose

MASS, DAMPING = 4.0, 30.0  # kg, N s/m
STIFFNESS, STRONGEST = 60.0, 8.0  # N/m and N of the hand
WAY = (0.06, 0.04, -0.05)  # m that the hand pulls
SECONDS = 6.0


def hand(place: tuple[float, ...], goal: tuple[float, ...]) -> list[float]:
    """The force in N with which the hand pulls a body from a place to its goal."""
    pull = [STIFFNESS * (g - p) for p, g in zip(place, goal, strict=True)]
    size = math.hypot(*pull)
    return [value * min(1.0, STRONGEST / size) if size else 0.0 for value in pull]


with session_of("guided_tcp.mod") as session:
    begin = state = session.state
    place, orientation = begin.pose
    goal = tuple(p + w for p, w in zip(place, WAY, strict=True))
    speed = [0.0, 0.0, 0.0]
    while state.controller_time - begin.controller_time < SECONDS:
        before = state.controller_time
        session.send(pose=Pose(place, orientation), speeds=[*speed, 0.0, 0.0, 0.0])
        state = session.next_state()
        step = state.controller_time - before
        # The hand feels the robot where it is, not where it was sent.
        force = hand(state.pose[0], goal)
        speed = [v + (f - DAMPING * v) / MASS * step for v, f in zip(speed, force, strict=True)]
        place = tuple(p + v * step for p, v in zip(place, speed, strict=True))
    session.stop()
    error = math.dist(state.pose[0], goal) * 1000
    print(f"{error:.1f} mm from where the hand pulls")
