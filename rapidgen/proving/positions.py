"""Positions of the axes (rad, m): how far apart, how far off a way, and changed in one axis."""

import math

from rapidgen.config.model import Joint
from rapidgen.proving.link import Position


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


def small_unit(joint: Joint) -> float:
    """One degree or one millimetre."""
    return 1e-3 if joint.kind == "prismatic" else math.radians(1)
