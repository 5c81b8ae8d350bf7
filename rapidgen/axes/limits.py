"""Controller axis limits, unconverted (rad, m)."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from rapidgen.config.model import Joint

ROUNDING = 1e-6
"""Tolerance (rad, m) for float32 and the conversion to degrees at the end of a range."""


@dataclass(frozen=True, slots=True)
class LimitFault:
    """One value outside its range; `point` counts from 0.

    NaN and infinity are outside.
    """

    point: int
    joint: Joint
    value: float

    def __str__(self) -> str:
        unit, factor = ("deg", 180 / math.pi) if self.joint.kind == "revolute" else ("mm", 1000.0)
        low, high = self.joint.lower * factor, self.joint.upper * factor
        return (
            f"{self.joint.axis} ({self.joint.name}) = {self.value * factor:.3f} {unit}, "
            f"range {low:g} to {high:g} {unit}"
        )


def outside(joints: Sequence[Joint], values: Sequence[float]) -> list[LimitFault]:
    """Return the faults of one posture in controller values, in joint order."""
    return [
        LimitFault(0, joint, value)
        for joint, value in zip(joints, values, strict=True)
        if not joint.lower - ROUNDING <= value <= joint.upper + ROUNDING
    ]


def check_limits(joints: Sequence[Joint], points: Iterable[Sequence[float]]) -> list[LimitFault]:
    """Return the faults of all points (controller values), in order."""
    return [
        LimitFault(i, fault.joint, fault.value)
        for i, values in enumerate(points)
        for fault in outside(joints, values)
    ]
