"""Stops by the brakes: every axis comes to rest by itself, so the robot leaves its path.

S4 overview 5-23: a quick stop by the brakes deviates most; at the next start the robot first
returns to the point of the path where it should have stopped.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil
from typing import TypeAlias

from rapidgen.axes.kinematics import Posture
from rapidgen.config.model import Joint
from rapidgen.machine.scheduler import S

_STEP = 1e-6
"""s over which the axes' speeds are measured."""


@dataclass(frozen=True, slots=True)
class BrakingMotion:
    """Axes that slow down each at its own rate. Times are scheduler ns."""

    since: int
    origin: Posture
    rates: Posture
    """rad/s and m/s"""
    slowing: Posture
    """Decelerations, positive."""

    @property
    def end(self) -> int:
        """When the last axis stands."""
        longest = max(abs(v) / a for v, a in zip(self.rates, self.slowing, strict=True))
        return self.since + ceil(longest * S)

    def posture(self, now: int) -> Posture:
        """Axis values at a time."""
        time = (now - self.since) / S
        result = []
        for q, v, a in zip(self.origin, self.rates, self.slowing, strict=True):
            t = min(time, abs(v) / a)
            result.append(q + v * t - (a if v > 0 else -a) * t * t / 2)
        return tuple(result)


@dataclass(frozen=True, slots=True)
class GuidedStep:
    """A cycle of externally guided motion at constant axis speeds. Times are scheduler ns.

    It lasts half a cycle longer than its way, so that the robot does not count as standing between
    two cycles.
    """

    since: int
    origin: Posture
    target: Posture
    length: int
    reference: Posture | None = None
    """Where the guiding partner wants the robot to be; None: unknown."""

    @property
    def end(self) -> int:
        """When the robot stands if no further step follows."""
        return self.since + self.length + (0 if self.origin == self.target else self.length // 2)

    def posture(self, now: int) -> Posture:
        """Axis values at a time."""
        part = min(1.0, (now - self.since) / self.length)
        ways = zip(self.origin, self.target, strict=True)
        return tuple(q + (end - q) * part for q, end in ways)


AxisMotion: TypeAlias = BrakingMotion | GuidedStep
"""A motion of axes that follows no path."""


def path_factor(joints: Sequence[Joint], factor: float) -> float:
    """Return the deceleration of a quick stop on the path, in units of the axes' acceleration.

    The axis with the least of it decides. `factor` is that of axes without data.
    """
    return min(
        joint.stop_deceleration / joint.acceleration if joint.stop_deceleration else factor
        for joint in joints
    )


def coast(
    now: int, current: Posture, before: Posture, joints: Sequence[Joint], factor: float
) -> BrakingMotion:
    """From a posture, and the one a moment earlier; each axis by its brake.

    Without data of an axis, its brake has `factor` times its acceleration.

    An axis that would leave its range stops harder, at the end of it; one that is there stays.
    """
    rates, slowing = [], []
    for q, p, joint in zip(current, before, joints, strict=True):
        rate = (q - p) / _STEP
        room = (joint.upper - q) if rate > 0 else (q - joint.lower)
        if room <= 0:
            rate, room = 0.0, 1.0
        rates.append(rate)
        brake = joint.brake_deceleration or joint.acceleration * factor
        slowing.append(max(brake, rate * rate / (2 * room)))
    return BrakingMotion(now, current, tuple(rates), tuple(slowing))


def moment_before(now: int) -> int:
    """The time, scheduler ns, at which `coast` wants the earlier posture."""
    return now - round(_STEP * S)
