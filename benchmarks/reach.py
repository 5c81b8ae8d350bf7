"""Inverse kinematics of the shipped models: poses missed, and CPU time from afar and from near.

    python benchmarks/reach.py [--poses N] [MODEL ...]

Each pose is that of a random posture within the ranges; from afar the search begins in the middle
of the ranges and has to find a posture within them, from near 0.02 rad beside the posture. Limits:
no pose missed; without a closed form 3 ms from afar (median), 20 ms (99 of 100), 0.3 ms from near.
"""

import argparse
import random
import time

from rapidgen.axes.kinematics import Kinematics
from rapidgen.config import load_config, shipped_names

AFAR, AFAR_99, NEAR = 3e-3, 20e-3, 0.3e-3


def measure(own: Kinematics, poses: int) -> tuple[int, list[float], list[float]]:
    """Poses missed, and the times from afar and from near, sorted."""
    draw = random.Random(5)
    joints = own.group.joints
    missed, afar, near, moves = 0, [], [], []
    for _ in range(poses):
        posture = tuple(draw.uniform(j.lower, j.upper) for j in joints)
        pose = own.forward(posture)
        middle = tuple(
            (j.lower + j.upper) / 2 if j.axis.startswith("rax") else v
            for j, v in zip(joints, posture, strict=True)
        )
        start = time.thread_time()
        missed += next(own.found(pose, middle), None) is None
        afar.append(time.thread_time() - start)
        beside = tuple(
            v + draw.uniform(-0.02, 0.02) * j.axis.startswith("rax")
            for j, v in zip(joints, posture, strict=True)
        )
        moves.append((pose, beside))
    # Each once, and nothing between two of them: as along a way.
    for pose, beside in moves:
        start = time.thread_time()
        own.follow(pose, beside)
        near.append(time.thread_time() - start)
    return missed, sorted(afar), sorted(near)


def main() -> int:
    """The table; 1 when a limit is not kept."""
    parser = argparse.ArgumentParser()
    parser.add_argument("models", nargs="*", default=shipped_names())
    parser.add_argument("--poses", type=int, default=10_000)
    given = parser.parse_args()
    bad = 0
    for name in given.models:
        for group in load_config(name).groups:
            own = Kinematics.of(group)
            missed, afar, near = measure(own, given.poses)
            middle, most = given.poses // 2, int(given.poses * 0.99)
            slow = not own.is_closed_form and (
                afar[middle] > AFAR or afar[most] > AFAR_99 or near[middle] > NEAR
            )
            bad += bool(missed or slow)
            print(
                f"{name:<13}{group.name:<7}{'formula' if own.is_closed_form else 'search':<9}"
                f"missed {missed:<5} afar {afar[middle] * 1e3:6.2f} ms, "
                f"99 % {afar[most] * 1e3:6.2f}; near {near[middle] * 1e6:5.0f} us"
            )
    return int(bool(bad))


if __name__ == "__main__":
    raise SystemExit(main())
