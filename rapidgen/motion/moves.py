"""Data of a move instruction in SI units: the interface of built-ins and planning."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from enum import Enum
from math import inf, sqrt
from typing import Protocol

from rapidgen.axes.frames import IDENTITY, Pose, compose, invert
from rapidgen.axes.kinematics import AxisConfiguration, MovingFrame, Posture
from rapidgen.axes.path_shapes import CircleMode
from rapidgen.diagnostics import Span
from rapidgen.motion.fault_reasons import FaultReason, MotionFault


class Place(Protocol):
    """The location of a move in the program."""

    @property
    def reference(self) -> str:
        """The location as the event log of a controller names it."""

    @property
    def span(self) -> Span:
        """The location in the source."""


NO_WAY = 1e-7
"""m of TCP way that count as none."""
NO_TURN = 1e-9
"""rad, or m of an external axis, that count as none."""
SHORTEST = 1e-4
"""s of nominal time that the shortest way takes."""


@dataclass(frozen=True, slots=True)
class MoveSpeed:
    """speeddata: TCP m/s, reorientation rad/s, external axes m/s and rad/s."""

    tcp: float
    orientation: float = 500.0 * 0.017453292519943295
    linear: float = 5.0
    rotary: float = 1000.0 * 0.017453292519943295


@dataclass(frozen=True, slots=True)
class Zone:
    """zonedata: m and rad. A fine point ignores the rest."""

    fine: bool = False
    tcp: float = 0.0
    orientation: float = 0.0
    external: float = 0.0
    angle: float = 0.0
    linear: float = 0.0
    rotary: float = 0.0


FINE = Zone(fine=True)


@dataclass(frozen=True, slots=True)
class Measure:
    """How far a move goes: TCP m, turn rad, external axes m and rad (the longest of each)."""

    tcp: float = 0.0
    angle: float = 0.0
    linear: float = 0.0
    rotary: float = 0.0


@dataclass(frozen=True, slots=True)
class MoveFrames:
    """Tool and work object of a move: the holder of each, and their frames.

    A pose of the move is that of the TCP in the object (the displaced object frame). With a
    stationary tool the robot carries the object and `tool` is a frame of the world.
    """

    tool: Pose = IDENTITY
    object: Pose = IDENTITY
    """user * object * displacement: in the world, when held in the flange, on a unit in that."""
    stationary: bool = False
    unit: MovingFrame | None = None
    """The mechanical unit that carries the object; poses need `at` a posture then."""

    def at(self, posture: Posture) -> "MoveFrames":
        """The same where the external axes are those of a posture: nothing carries it."""
        if self.unit is None:
            return self
        placed = compose(self.unit.pose(posture), self.object)
        return MoveFrames(self.tool, placed, self.stationary)

    def flange(self, pose: Pose) -> Pose:
        """Where the flange is when the TCP has a pose in the object."""
        placed = pose if self.object == IDENTITY else compose(self.object, pose)
        if self.stationary:
            return compose(self.tool, invert(placed))
        return placed if self.tool == IDENTITY else compose(placed, invert(self.tool))

    def pose(self, flange: Pose) -> Pose:
        """The pose of the TCP in the object for a flange."""
        if self.stationary:
            return compose(invert(compose(flange, self.object)), self.tool)
        tool = flange if self.tool == IDENTITY else compose(flange, self.tool)
        return tool if self.object == IDENTITY else compose(invert(self.object), tool)


@dataclass(frozen=True, slots=True, kw_only=True)
class Move:
    """What every move instruction has."""

    speed: MoveSpeed
    zone: Zone
    time: float | None = None
    """\\T, s"""
    concurrent: bool = False
    dwell: float = 0.0
    """s that the program waits after a stop point (\\Inpos with a stop time)."""
    carrier: MoveFrames = field(default_factory=MoveFrames)
    place: Callable[[], Place | None] | None = None
    """Returns its location in the program, for messages and the motion pointer."""
    events: tuple["PathEvent", ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class JointMove(Move):
    """To a posture with all axes together (MoveAbsJ, MoveJ, MoveExtJ)."""

    target: Posture


class Singularities(Enum):
    """SingArea: what linear and circular moves do about them."""

    OFF = "nothing"
    WRIST = "wrist axes go straight in joint space, the TCP stays on the way"
    LOCK_AXIS_4 = "the same, with axis 4 at a multiple of 180 degrees"


@dataclass(frozen=True, slots=True, kw_only=True)
class CartesianMove(Move):
    """The TCP on a line, or on the circle through `via` (MoveL, MoveC).

    `external` holds all axis values in wire order; those of the robot are not used.
    """

    target: Pose
    external: Posture
    via: Pose | None = None
    wanted: AxisConfiguration | None = None
    """confdata that is checked at the end (ConfL \\On)."""
    circle: CircleMode = CircleMode.PATH
    singularities: Singularities = Singularities.OFF


class MeasuredFrom(Enum):
    """Where the distance of an event counts from."""

    END = "end"
    START = "start"
    BEFORE_END = "time"
    MIDDLE = "middle"


@dataclass(frozen=True, slots=True)
class PathEvent:
    """Something that happens at a place of a move, or some time before its end.

    `amount` is m (END, START) or s (BEFORE_END); MIDDLE is the middle of the corner, and
    arrival at a stop point. `lag` s earlier is what equipment needs; negative is later.
    """

    where: MeasuredFrom
    amount: float
    act: Callable[[], None]
    lag: float = 0.0


def nominal_time(measure: Measure, speed: MoveSpeed) -> float:
    """s that the slowest part needs at programmed speed; 0 when nothing moves.

    All parts end together: the slowest one limits the move (S4 datasys 1-speeddata-1).
    MotionFault NO_SPEED: something has to move at speed 0.
    """
    needs = (
        (measure.tcp, speed.tcp),
        (measure.angle, speed.orientation),
        (measure.linear, speed.linear),
        (measure.rotary, speed.rotary),
    )
    times = [0.0]
    for path, rate in needs:
        if path > 1e-12:
            if rate <= 0.0:
                raise MotionFault(FaultReason.NO_SPEED)
            times.append(path / rate)
    return max(times)


def timed(total: float, fastest: float, acceleration: float, ramps: float) -> float:
    """Nominal time of a way whose whole time, ramps at rest included, is to be `total` s (\\T).

    `fastest` is the nominal time at the axes' full speed, `acceleration` the way's share per
    s^2, `ramps` half the number of ends at rest: total = 1/c + ramps c / acceleration for a
    speed of c ways per s. Where no speed does it, the best that the limits allow.
    """
    if ramps == 0.0 or acceleration == inf:
        return max(total, fastest, SHORTEST)
    square = total * total - 4 * ramps / acceleration
    if total <= 0.0 or square <= 0.0:
        return max(fastest, sqrt(ramps / acceleration), SHORTEST)
    speed = acceleration * (total - sqrt(square)) / (2 * ramps)
    return max(fastest, 1 / speed)


def corner_shares(zone: Zone, before: Measure, after: Measure) -> tuple[float, float] | None:
    """Parts of the two moves (0 to 1/2) that the corner between them takes; None: a stop.

    The TCP zone has one radius on both sides, at most half of the shorter move, and shrinks
    with an extended zone that is smaller in proportion (S4 datasys 1-zonedata). Where the TCP
    does not move, the zone's angle, or its external parts, count instead.
    """
    if zone.fine:
        return None
    if before.tcp > NO_WAY and after.tcp > NO_WAY:
        reach = min(extended_share(zone, m) * m.tcp for m in (before, after))
        radius = min(zone.tcp, reach)
        return radius / before.tcp, radius / after.tcp
    shares = [extended_share(zone, measure) for measure in (before, after)]
    return min(shares[0], 0.5), min(shares[1], 0.5)


def extended_share(zone: Zone, measure: Measure) -> float:
    """Part of a move that the zone of orientation and external axes covers, at most 1/2.

    The smallest of pzone_ori / length and zone_ori / turn, and likewise for external axes;
    pzone_ori and pzone_eax below pzone_tcp are raised to it.
    """
    shares = [0.5]
    moves = measure.tcp > NO_WAY
    if measure.angle > NO_TURN:
        shares.append(zone.angle / measure.angle)
        if moves:
            shares.append(max(zone.orientation, zone.tcp) / measure.tcp)
    if measure.linear > NO_TURN or measure.rotary > NO_TURN:
        if moves:
            shares.append(max(zone.external, zone.tcp) / measure.tcp)
        if measure.linear > NO_TURN:
            shares.append(zone.linear / measure.linear)
        if measure.rotary > NO_TURN:
            shares.append(zone.rotary / measure.rotary)
    return min(shares)


def largest(values: Sequence[float]) -> float:
    """The largest magnitude; 0 of nothing."""
    return max(map(abs, values), default=0.0)
