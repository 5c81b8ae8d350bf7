"""References that are sent: they follow targets, and never leave the limits of an envelope.

A reference moves in cycles. In each it approaches a target, takes over given speeds, or brakes; the
change of its speed in a cycle is limited by the acceleration. An axis is never faster than it can
still stop before its range ends. Units are rad and m.
"""

from dataclasses import dataclass
from math import copysign, inf, sqrt
from typing import Protocol, TypeAlias

from rapidgen.axes import frames
from rapidgen.axes.frames import Pose, Quaternion, Vector
from rapidgen.client.egm.envelope import Joints, TcpLimits

Twist: TypeAlias = tuple[float, ...]
"""(6,): m/s along and rad/s about x, y and z."""
_ENOUGH = 1e-12
_SMALLEST = 1e-9
"""rad or m that count as none."""
_STOPPED: Vector = (0.0, 0.0, 0.0)


class AxisLimits(Protocol):
    """Limits of each axis."""

    @property
    def lower(self) -> Joints:
        """Return the lowest positions."""

    @property
    def upper(self) -> Joints:
        """Return the highest positions."""

    @property
    def speed(self) -> Joints:
        """Return the highest speeds."""

    @property
    def acceleration(self) -> Joints:
        """Return the highest accelerations."""


class Reference:
    """Positions and speeds of axes."""

    def __init__(self, envelope: AxisLimits, start: Joints) -> None:
        self.envelope = envelope
        self.positions = start
        self.speeds: Joints = (0.0,) * len(start)

    @property
    def is_standing(self) -> bool:
        """True at speed zero."""
        return not any(self.speeds)

    def follow(self, target: Joints, time: float, rates: Joints | None = None) -> None:
        """Advance by a time in s towards a target, which moves with `rates`."""
        speeds = []
        for i, (t, q) in enumerate(zip(target, self.positions, strict=True)):
            rate = 0.0 if rates is None else rates[i]
            acceleration = self.envelope.acceleration[i]
            wanted = _towards(t - q, self.speeds[i], rate, acceleration, time)
            speeds.append(self._limited(i, wanted, time))
        self._advance(time, speeds)

        # Rounding must not keep it from its target.
        pairs = zip(self.positions, target, strict=True)
        self.positions = tuple(t if abs(t - q) < _SMALLEST else q for q, t in pairs)

    def drive(self, rates: Joints, time: float) -> None:
        """Advance by a time in s and take over speeds."""
        self._advance(time, [self._limited(i, rate, time) for i, rate in enumerate(rates)])

    def brake(self, time: float) -> None:
        """Advance by a time in s and slow down."""
        pairs = zip(self.speeds, self.envelope.acceleration, strict=True)
        self._advance(time, [copysign(max(0.0, abs(v) - a * time), v) for v, a in pairs])

    def _limited(self, axis: int, wanted: float, time: float) -> float:
        """Return the speed of the next cycle that is closest to a wanted one."""
        envelope, q = self.envelope, self.positions[axis]
        acceleration, top = envelope.acceleration[axis], envelope.speed[axis]
        up = min(top, _limit_at_end(envelope.upper[axis] - q, acceleration, time))
        down = min(top, _limit_at_end(q - envelope.lower[axis], acceleration, time))
        change, speed = acceleration * time, self.speeds[axis]
        return max(speed - change, min(speed + change, max(-down, min(up, wanted))))

    def _advance(self, time: float, speeds: list[float]) -> None:
        envelope, positions = self.envelope, []
        for i, (q, v) in enumerate(zip(self.positions, speeds, strict=True)):
            # A robot may begin outside of its range; it does not go further.
            low, high = min(envelope.lower[i], q), max(envelope.upper[i], q)
            position = min(high, max(low, q + v * time))
            positions.append(position)
            # An axis that brakes into its bound may pass it by a rounding error.
            if abs(position - (q + v * time)) > _ENOUGH:
                speeds[i] = 0.0
        self.positions = tuple(positions)
        self.speeds = tuple(0.0 if abs(v) < _ENOUGH else v for v in speeds)


def _stoppable(distance: float, acceleration: float, time: float) -> float:
    """Return the speed from which an axis stops within a distance: v^2 / 2a + v * time / 2."""
    if distance <= 0:
        return 0.0
    change = acceleration * time
    return -change / 2 + sqrt(change * change / 4 + 2 * acceleration * distance)


def _limit_at_end(room: float, acceleration: float, time: float) -> float:
    """Return the highest speed with which an axis stops in its room, braking in whole cycles."""
    if 0 < room <= acceleration * time * time:
        return room / time
    # In cycles it needs up to a * time^2 / 8 more than continuously.
    return _stoppable(room - acceleration * time * time / 8, acceleration, time)


def _towards(distance: float, speed: float, rate: float, acceleration: float, time: float) -> float:
    """Return the speed with which an axis approaches a target that moves at a rate.

    Straight to it if the acceleration permits that; otherwise so that the axis can still reach the
    target's speed there.
    """
    direct = distance / time
    if abs(direct - speed) <= acceleration * time:
        return direct
    return rate + copysign(_stoppable(abs(distance), acceleration, time), distance)


@dataclass(frozen=True, slots=True)
class _CartesianLimits:
    """Limits along and about x, y and z."""

    lower: Joints
    upper: Joints
    speed: Joints
    acceleration: Joints


def _by_axis(limits: TcpLimits) -> _CartesianLimits:
    """Return limits of each coordinate so that the length of a vector keeps the limit."""
    unit = 1 / sqrt(3)

    def both(linear: float, angular: float) -> Joints:
        return (linear * unit,) * 3 + (angular * unit,) * 3

    return _CartesianLimits(
        lower=(*limits.lower, -inf, -inf, -inf),
        upper=(*limits.upper, inf, inf, inf),
        speed=both(limits.speed, limits.rotation),
        acceleration=both(limits.acceleration, limits.rotation_acceleration),
    )


class PoseReference:
    """Pose and speeds of a TCP.

    A cycle works on the position and on the rotation vector from the present orientation, so angles
    are exact for whatever orientation is reached.
    """

    def __init__(self, limits: TcpLimits, start: Pose) -> None:
        self.pose = start
        self._axes = Reference(_by_axis(limits), (*start[0], *_STOPPED))

    @property
    def speeds(self) -> Twist:
        """Return the speeds."""
        return self._axes.speeds

    @property
    def is_standing(self) -> bool:
        """True at speed zero."""
        return self._axes.is_standing

    def follow(self, target: Pose, time: float, rates: Twist | None = None) -> None:
        """Advance by a time in s towards a pose, which moves with `rates`."""
        turned = frames.multiply(target[1], frames.conjugate(self.pose[1]))
        axis, angle = frames.to_axis(turned)
        self._axes.follow((*target[0], *frames.scale(axis, angle)), time, rates)
        self._turn()

    def drive(self, rates: Twist, time: float) -> None:
        """Advance by a time in s and take over speeds."""
        self._axes.drive(rates, time)
        self._turn()

    def brake(self, time: float) -> None:
        """Advance by a time in s and slow down."""
        self._axes.brake(time)
        self._turn()

    def _turn(self) -> None:
        x, y, z, *vector = self._axes.positions
        self.pose = ((x, y, z), rotated(self.pose[1], (vector[0], vector[1], vector[2])))
        self._axes.positions = (x, y, z, *_STOPPED)


def rotated(orientation: Quaternion, vector: Vector) -> Quaternion:
    """Return an orientation that is turned by a rotation vector, rad."""
    angle = frames.norm(vector)
    if angle < _ENOUGH:
        return orientation
    turn = frames.about(frames.scale(vector, 1 / angle), angle)
    return frames.normalise(frames.multiply(turn, orientation))
