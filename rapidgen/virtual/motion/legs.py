"""Legs: one move instruction each, placed on the path, and the corners between them."""

from dataclasses import dataclass, field
from math import inf, sqrt
from typing import Protocol

from rapidgen.config.model import MotionGroup
from rapidgen.virtual.motion.moves import (
    JointMove,
    Measure,
    Posture,
    corner_shares,
    largest,
    nominal_time,
)
from rapidgen.virtual.motion.pieces import AxisLimits, JointLine, Piece, joint_corner


class Geometry(Protocol):
    """The way of one move in its own nominal time, 0 to `duration`."""

    duration: float
    measure: Measure
    limits: AxisLimits

    @property
    def target(self) -> Posture:
        """Where it ends."""

    @property
    def tcp(self) -> float:
        """m that the TCP goes in a nominal s."""

    def pieces(self, begin: float, start: float, end: float) -> list[Piece]:
        """The path pieces from `start` to `end` of a leg that begins at `begin`."""


@dataclass(slots=True, eq=False)
class Leg:
    """One move on the path. Places are nominal s along the whole path."""

    move: JointMove
    way: Geometry
    begin: float
    end: float
    left: float = field(default=0.0)
    """Place at which the robot has left this leg: behind the corner at its end."""
    released: bool = False
    """The program may go on."""
    committed: bool = False
    """No successor came in time: the point is a stop."""
    finished: bool = False
    """Reached (a stop point) or passed."""
    cleared: bool = False
    """Taken off the path before it was finished."""
    began: float | None = None
    """Kernel time (s) of its beginning, when that was from a standstill."""
    passed_at: float | None = None
    """Kernel time (s) at which its end was passed."""

    @property
    def stops(self) -> bool:
        """Whether the robot stands at the end."""
        return self.move.zone.fine or self.committed


class JointWay:
    """All axes together on a straight line in joint space."""

    __slots__ = ("duration", "limits", "measure", "origin", "rates", "target")

    def __init__(
        self,
        origin: Posture,
        target: Posture,
        duration: float,
        measure: Measure,
        limits: AxisLimits,
    ) -> None:
        self.origin = origin
        self.target = target
        self.duration = duration
        self.measure = measure
        self.limits = limits
        self.rates = tuple([(b - a) / duration for a, b in zip(origin, target, strict=True)])

    @property
    def tcp(self) -> float:
        """m that the TCP goes in a nominal s."""
        return self.measure.tcp / self.duration

    def pieces(self, begin: float, start: float, end: float) -> list[Piece]:
        """One straight piece."""
        return [JointLine(start, end, begin, self.origin, self.rates, self.limits, self.tcp)]


def joint_way(
    origin: Posture,
    move: JointMove,
    measure: Measure,
    limits: AxisLimits,
    *,
    from_rest: bool,
) -> JointWay:
    """The way of a joint move. `\\T` includes the ramps at ends where the robot stands."""
    deltas = [b - a for a, b in zip(origin, move.target, strict=True)]
    fastest = max(abs(d) / v for d, v in zip(deltas, limits.speeds, strict=True))
    if move.time is None:
        duration = max(fastest, nominal_time(measure, move.speed))
    else:
        ramp = min(
            (a / abs(d) for d, a in zip(deltas, limits.accelerations, strict=True) if d),
            default=inf,
        )
        duration = timed(move.time, fastest, ramp, (from_rest + move.zone.fine) / 2)
    return JointWay(origin, move.target, duration, measure, limits)


def timed(total: float, fastest: float, acceleration: float, ramps: float) -> float:
    """Nominal time of a way whose whole time is to be `total` s.

    `fastest` is the nominal time at the axes' full speed, `acceleration` the way's share per
    s^2, `ramps` half the number of ends at rest: total = 1/c + ramps c / acceleration for a
    speed of c ways per s. Where no speed does it, the best that the limits allow.
    """
    if ramps == 0.0:
        return max(total, fastest, 1e-4)
    square = total * total - 4 * ramps / acceleration
    if square <= 0.0:
        return max(fastest, sqrt(ramps / acceleration))
    speed = acceleration * (total - sqrt(square)) / (2 * ramps)
    return max(fastest, 1 / speed)


def corner(
    before: Leg, after: Geometry, size: float, limits: AxisLimits
) -> tuple[float, float, list[Piece]] | None:
    """Start, end and pieces of the corner between a leg and its successor; None: a stop.

    `size` (0 to 1) shrinks the zone where the path cannot be met otherwise.
    """
    shares = corner_shares(before.move.zone, before.way.measure, after.measure)
    if shares is None:
        return None
    inside, outside = (shares[0] * size * before.way.duration, shares[1] * size * after.duration)
    if min(inside, outside) < 1e-7:
        return None
    start, end = before.end - inside, before.end + outside
    if isinstance(before.way, JointWay) and isinstance(after, JointWay):
        pieces = joint_corner(
            start,
            before.way.target,
            (before.way.rates, inside),
            (after.rates, outside),
            limits,
            max(before.way.tcp, after.tcp),
        )
        return start, end, pieces
    return None


def zone_entry(leg: Leg) -> float:
    """Where the largest corner that its end may get would begin."""
    shares = corner_shares(leg.move.zone, leg.way.measure, leg.way.measure)
    return leg.end - (shares[0] * leg.way.duration if shares else 0.0)


def lever_measure(group: MotionGroup, origin: Posture, target: Posture, lever: float) -> Measure:
    """How far a joint move goes when the robot has no geometry.

    Each robot axis swings the TCP on an arm of `lever` m; the largest swing counts.
    """
    robot, turns, linear, rotary = [0.0], [0.0], [0.0], [0.0]
    for joint, a, b in zip(group.joints, origin, target, strict=True):
        if joint.axis.startswith("rax"):
            robot.append((b - a) * lever if joint.kind == "revolute" else b - a)
            if joint.kind == "revolute":
                turns.append(b - a)
        elif joint.kind == "revolute":
            rotary.append(b - a)
        else:
            linear.append(b - a)
    return Measure(largest(robot), largest(turns), largest(linear), largest(rotary))
