"""Where the robot was, and what is judged by that alone.

A position is that of the controller's axes, rad and m, in wire order; a track holds when (simulated
s) each was first seen. These are the oracles of motion: tests/verification/test_oracles.py holds
them.
"""

import math
from collections.abc import Sequence
from typing import TypeAlias

from rapidgen.config.model import Joint
from rapidgen.verification.model import CheckFailed

Position: TypeAlias = tuple[float, ...]
Point: TypeAlias = tuple[Position, float]
"""Joints and the seconds from the point before."""
Track: TypeAlias = Sequence[tuple[float, Position]]

SETTLED = 1e-4
"""rad or m: as far as a standing robot may be from a point that it has reached."""


def distance(one: Position, other: Position) -> float:
    """Largest difference of an axis."""
    return max(abs(a - b) for a, b in zip(one, other, strict=True))


def off(seen: Position, start: Position, end: Position) -> float:
    """Distance of a position from the straight way between two (largest axis)."""
    along = [e - s for s, e in zip(start, end, strict=True)]
    length = sum(a * a for a in along)
    share = 0.0
    if length:
        share = sum((p - s) * a for p, s, a in zip(seen, start, along, strict=True)) / length
        share = min(1.0, max(0.0, share))
    return distance(seen, tuple(s + share * a for s, a in zip(start, along, strict=True)))


def changed(position: Position, axis: int, value: float) -> Position:
    """The position with another value for one axis."""
    return (*position[:axis], value, *position[axis + 1 :])


def inward(joint: Joint, current: float, step: float) -> float:
    """`step` from where a joint stands, to the side where there is more room."""
    return current + step if joint.upper - current >= current - joint.lower else current - step


def small_unit(joint: Joint) -> float:
    """One degree or one millimetre."""
    return 1e-3 if joint.kind == "prismatic" else math.radians(1)


def still(track: Track, place: Position, why: str) -> None:
    """Broken where the robot was anywhere but at `place`."""
    for when, seen in track:
        if distance(seen, place) > SETTLED:
            raise CheckFailed(f"the robot moved at {when:.3f} s: {why}")


def on_path(track: Track, path: Sequence[Position], corner: float = 0.05) -> None:
    """Broken unless every sample lies on a prefix of `path`, in order.

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
