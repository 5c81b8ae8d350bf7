"""Inverse kinematics of the shipped models: missed poses, CPU time.

    python benchmarks/reach.py [--poses N] [MODEL ...]

Each pose is that of a random posture within the ranges; from afar the search begins in the middle
of the ranges and must find a posture within them, from near 0.02 rad next to the posture. A tenth
as many searches use the posture's configuration (and arm angle) from any other posture. Limits:
none missed; without a closed form 3 ms from afar (median), 20 ms (99 of 100), 0.3 ms from near.
"""

import argparse
import random
import time

from rapidgen.axes.kinematics import Kinematics
from rapidgen.config import load_config, shipped_names

AFAR, AFAR_99, NEAR = 3e-3, 20e-3, 0.3e-3


def measure(own: Kinematics, poses: int) -> tuple[int, list[float], list[float]]:
    """Return missed poses, and sorted times from afar and from near."""
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
        adjacent = tuple(
            v + draw.uniform(-0.02, 0.02) * j.axis.startswith("rax")
            for j, v in zip(joints, posture, strict=True)
        )
        moves.append((pose, adjacent))
    # Each once, and no other search between them: as along a path.
    for pose, adjacent in moves:
        start = time.thread_time()
        own.follow(pose, adjacent)
        near.append(time.thread_time() - start)
    return missed, sorted(afar), sorted(near)


def configured(own: Kinematics, poses: int) -> tuple[int, float]:
    """Return poses whose configuration is not found, and the median time.

    From any other posture.
    """
    draw = random.Random(6)
    missed, times = 0, []
    for _ in range(poses):
        posture, current = (
            tuple(draw.uniform(j.lower, j.upper) for j in own.group.joints) for _ in range(2)
        )
        pose, expected = own.forward(posture), own.configuration(posture)
        if own.seventh < 0:
            rax = [j.axis.startswith("rax") for j in own.group.joints]
            current = tuple(h if r else p for h, p, r in zip(current, posture, rax, strict=True))
        angle = own.arm.arm_angle(posture) if own.seventh >= 0 else 0.0
        start = time.thread_time()
        result = (
            iter(own.solutions(pose, current, expected))
            if own.seventh < 0
            else own.at_arm_angle(pose, angle, current)
        )
        missed += next((p for p in result if own.misfit(p, expected) == 0.0), None) is None
        times.append(time.thread_time() - start)
    return missed, sorted(times)[poses // 2]


def main() -> int:
    """Print the table; return 1 when a limit is exceeded."""
    parser = argparse.ArgumentParser()
    parser.add_argument("models", nargs="*", default=shipped_names())
    parser.add_argument("--poses", type=int, default=10_000)
    arguments = parser.parse_args()
    bad = 0
    for name in arguments.models:
        for group in load_config(name).groups:
            own = Kinematics.of(group)
            missed, afar, near = measure(own, arguments.poses)
            middle, most = arguments.poses // 2, int(arguments.poses * 0.99)
            slow = not own.is_closed_form and (
                afar[middle] > AFAR or afar[most] > AFAR_99 or near[middle] > NEAR
            )
            unlike, took = configured(own, arguments.poses // 10)
            bad += bool(missed or slow or unlike)
            print(
                f"{name:<13}{group.name:<7}{'formula' if own.is_closed_form else 'search':<9}"
                f"missed {missed:<5} afar {afar[middle] * 1e3:6.2f} ms, "
                f"99 % {afar[most] * 1e3:6.2f}; near {near[middle] * 1e6:5.0f} us; "
                f"with configuration missed {unlike:<4} {took * 1e3:6.2f} ms"
            )
    return int(bool(bad))


if __name__ == "__main__":
    raise SystemExit(main())
