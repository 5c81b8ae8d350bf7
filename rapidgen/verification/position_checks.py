"""Checks on recorded positions of the robot.

A position holds the controller's axes, rad and m, in wire order. A track maps each position to the
simulated time (s) of its first sample. These functions are the test oracles of motion;
tests/verification/test_oracles.py tests them.
"""

import math
from collections.abc import Sequence
from typing import TypeAlias

from rapidgen.config.model import Joint
from rapidgen.verification.model import CheckFailed

Position: TypeAlias = tuple[float, ...]
Point: TypeAlias = tuple[Position, float]
"""Joints and the seconds from the previous point."""
Track: TypeAlias = Sequence[tuple[float, Position]]

SETTLED = 1e-4
"""rad or m: tolerance of a robot at rest at a reached point."""


def distance(one: Position, other: Position) -> float:
    """Largest difference of an axis."""
    return max(abs(a - b) for a, b in zip(one, other, strict=True))


def off(seen: Position, start: Position, end: Position) -> float:
    """Return the distance of a position from a straight path (largest axis)."""
    along = [e - s for s, e in zip(start, end, strict=True)]
    length = sum(a * a for a in along)
    share = 0.0
    if length:
        share = sum((p - s) * a for p, s, a in zip(seen, start, along, strict=True)) / length
        share = min(1.0, max(0.0, share))
    return distance(seen, tuple(s + share * a for s, a in zip(start, along, strict=True)))


def changed(position: Position, axis: int, value: float) -> Position:
    """Return the position with another value for one axis."""
    return (*position[:axis], value, *position[axis + 1 :])


def inward(joint: Joint, current: float, step: float) -> float:
    """Return `step` with the sign of the larger distance to a limit."""
    return current + step if joint.upper - current >= current - joint.lower else current - step


def small_unit(joint: Joint) -> float:
    """Return one degree or one millimetre."""
    return 1e-3 if joint.kind == "prismatic" else math.radians(1)


def still(track: Track, place: Position, why: str) -> None:
    """Check that the robot was never anywhere but at `place`."""
    for when, seen in track:
        if distance(seen, place) > SETTLED:
            raise CheckFailed(f"the robot moved at {when:.3f} s: {why}")


def on_path(track: Track, path: Sequence[Position], corner: float = 0.05) -> None:
    """Check that every sample lies on a prefix of `path`, in order.

    `corner` (rad, m) is how far a zone may cut a corner.
    """
    at = 0
    for when, seen in track:
        near = off(seen, path[at], path[at + 1])
        while near > SETTLED and at < len(path) - 2:
            ahead = off(seen, path[at + 1], path[at + 2])
            if ahead > near:
                break
            at, near = at + 1, ahead
        if near > corner:
            raise CheckFailed(
                f"at {when:.3f} s the robot was {near:.4f} rad off what was asked "
                f"(near point {at + 1})"
            )
