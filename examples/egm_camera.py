"""Corrections from a simulated camera: the TCP stays above a part on a belt.

The camera takes 30 pictures a second and needs 60 ms for each. It sees where the part is relative
to the TCP, with noise. A filter (alpha, beta) estimates position and speed of the part; the target
is where the part is now, and moves on with the part's speed until the next picture.
"""

import math
import random
from collections import deque

from guiding import session_of
from rapidgen.client import Pose

PERIOD, LATENCY, NOISE = 1 / 30, 0.060, 0.0002  # s, s, m
BELT = (0.0, 0.03, 0.0)  # m/s
ALPHA, BETA = 0.4, 0.08
SECONDS = 4.0


def add(place: tuple[float, ...], speed: tuple[float, ...], time: float) -> tuple[float, ...]:
    return tuple(p + v * time for p, v in zip(place, speed, strict=True))


noise = random.Random(1)
with session_of("guided_tcp.mod") as session:
    begin = state = session.state
    start, orientation = begin.pose
    part = add(start, (1.0, 0.0, 0.0), 0.02)  # 20 mm beside the TCP
    pictures: deque[tuple[float, tuple[float, ...]]] = deque()
    place, speed, seen, taken = start, (0.0, 0.0, 0.0), None, -1.0
    errors = []
    while (time := state.controller_time - begin.controller_time) < SECONDS:
        real = add(part, BELT, time)
        if time - taken >= PERIOD:
            # A picture shows the part relative to the camera on the flange.
            taken = time
            offset = [
                r - p + noise.gauss(0.0, NOISE) for r, p in zip(real, state.pose[0], strict=True)
            ]
            pictures.append((time, add(state.pose[0], tuple(offset), 1.0)))
        if pictures and time - pictures[0][0] >= LATENCY:
            at, measured = pictures.popleft()
            if seen is None:
                place = measured
            else:
                step = at - seen
                predicted = add(place, speed, step)
                wrong = tuple(m - p for m, p in zip(measured, predicted, strict=True))
                place, speed = add(predicted, wrong, ALPHA), add(speed, wrong, BETA / step)
            seen = at
        if seen is not None:
            # The picture is old: the part has moved on since then.
            session.send(
                pose=Pose(add(place, speed, time - seen), orientation), speeds=[*speed, 0, 0, 0]
            )
        state = session.next_state()
        errors.append(math.dist(state.pose[0], real))
    session.stop()
    print(f"above the part within {max(errors[-250:]) * 1000:.1f} mm")
