"""Limits that a client keeps on its own, and the reference that keeps them.

They are apart from the limits that the controller enforces (`\\MaxPosDeviation` and
`\\MaxSpeedDeviation`), and hold for whatever a program sends. All values are rad and m, rad/s and
m/s, rad/s^2 and m/s^2, in the order of the robot's joints.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import copysign, inf, isfinite, sqrt
from typing import TypeAlias

from rapidgen.client.errors import TargetRejected
from rapidgen.config.model import GroupConfig

Joints: TypeAlias = tuple[float, ...]
_ENOUGH = 1e-12
_SMALLEST = 1e-9
"""rad or m that count as none."""


@dataclass(frozen=True, slots=True)
class Envelope:
    """Limits of one robot.

    Attributes:
        names: Joints.
        lower, upper: Positions.
        speed: Highest speeds.
        acceleration: Highest accelerations, also of a stop.
        step: Largest difference between a target and the one before, or the robot's position.
    """

    names: tuple[str, ...]
    lower: Joints
    upper: Joints
    speed: Joints
    acceleration: Joints
    step: float = inf

    @classmethod
    def of(cls, group: GroupConfig, fraction: float = 0.25, step: float = 0.1) -> "Envelope":
        """Return the limits of a configuration, speeds and accelerations times a fraction.

        ValueError: the fraction is not in (0, 1], or the step is not positive.
        """
        if not 0 < fraction <= 1:
            raise ValueError(f"fraction={fraction!r} is not above 0 and at most 1")
        if not step > 0:
            raise ValueError(f"step={step!r} is not positive")
        joints = group.joints
        low_high = [
            _urdf_range(joint.lower, joint.upper, joint.sign, joint.offset) for joint in joints
        ]
        return cls(
            tuple(joint.name for joint in joints),
            tuple(low for low, _ in low_high),
            tuple(high for _, high in low_high),
            tuple(joint.speed * fraction for joint in joints),
            tuple(joint.acceleration * fraction for joint in joints),
            step,
        )

    def check(self, target: Sequence[float], before: Joints) -> Joints:
        """Return a target as a tuple. Raises TargetRejected."""
        values = tuple(map(float, target))
        if len(values) != len(self.names):
            raise _rejected(f"{len(values)} values for {len(self.names)} joints")
        for i, (value, last) in enumerate(zip(values, before, strict=True)):
            name = self.names[i]
            if not isfinite(value):
                raise _rejected(f"{name} = {value}")
            if not self.lower[i] <= value <= self.upper[i]:
                low, high = self.lower[i], self.upper[i]
                raise _rejected(f"{name} = {value:.4f}, allowed are {low:.4f} to {high:.4f}")
            if abs(value - last) > self.step:
                raise _rejected(
                    f"{name} would step by {value - last:.4f}, allowed is {self.step:g}"
                )
        return values


def _urdf_range(lower: float, upper: float, sign: int, offset: float) -> tuple[float, float]:
    """Return a range of controller values as values of the URDF joint."""
    low, high = sorted((sign * (lower - offset), sign * (upper - offset)))
    return low, high


def _rejected(text: str) -> TargetRejected:
    return TargetRejected.because(
        "RG680", f"target not sent: {text}", "send targets close to the position of the robot"
    )


class Reference:
    """What is sent: it follows targets, and never faster than the envelope allows."""

    def __init__(self, envelope: Envelope, start: Joints) -> None:
        self.envelope = envelope
        self.positions = start
        self.speeds: Joints = (0.0,) * len(start)

    @property
    def is_standing(self) -> bool:
        """True at speed zero."""
        return not any(self.speeds)

    def follow(self, target: Joints, time: float) -> None:
        """Advance by a time in s towards a target."""
        self._advance(
            time,
            [
                _towards(t - q, v, top, a, time)
                for t, q, v, top, a in zip(
                    target,
                    self.positions,
                    self.speeds,
                    self.envelope.speed,
                    self.envelope.acceleration,
                    strict=True,
                )
            ],
        )

        # Rounding must not keep it from its target.
        pairs = zip(self.positions, target, strict=True)
        self.positions = tuple(t if abs(t - q) < _SMALLEST else q for q, t in pairs)

    def brake(self, time: float) -> None:
        """Advance by a time in s and slow down."""
        pairs = zip(self.speeds, self.envelope.acceleration, strict=True)
        self._advance(time, [copysign(max(0.0, abs(v) - a * time), v) for v, a in pairs])

    def _advance(self, time: float, speeds: list[float]) -> None:
        envelope, positions = self.envelope, []
        for i, (q, v) in enumerate(zip(self.positions, speeds, strict=True)):
            # A robot may begin outside of its range; it does not go further.
            low, high = min(envelope.lower[i], q), max(envelope.upper[i], q)
            position = min(high, max(low, q + v * time))
            positions.append(position)
            if position != q + v * time:
                speeds[i] = 0.0
        self.positions = tuple(positions)
        self.speeds = tuple(0.0 if abs(v) < _ENOUGH else v for v in speeds)


def _towards(distance: float, speed: float, top: float, acceleration: float, time: float) -> float:
    """Return the speed of the next cycle: straight to the target if that keeps the limits.

    Otherwise the axis moves so that it can still stop at the target.
    """
    change = acceleration * time
    direct = distance / time
    if abs(direct) <= top and abs(direct - speed) <= change:
        return direct
    # From v the axis stops within v^2 / 2a + v * time / 2.
    stoppable = -change / 2 + sqrt(change * change / 4 + 2 * acceleration * abs(distance))
    wanted = copysign(min(top, max(0.0, stoppable)), distance)
    return max(speed - change, min(speed + change, wanted))
