"""What a move instruction asks for, in SI units: the seam between built-ins and planning."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum

Posture = tuple[float, ...]
"""Controller axis values in wire order, rad and m."""


@dataclass(frozen=True, slots=True)
class Speed:
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


class Kind(Enum):
    """Interpolation."""

    JOINT = "joint"
    LINEAR = "linear"
    CIRCULAR = "circular"


@dataclass(frozen=True, slots=True)
class Measure:
    """How far a move goes: TCP m, turn rad, external axes m and rad (the longest of each)."""

    tcp: float = 0.0
    angle: float = 0.0
    linear: float = 0.0
    rotary: float = 0.0


@dataclass(frozen=True, slots=True)
class JointMove:
    """To a posture with all axes together (MoveAbsJ, MoveJ, MoveExtJ)."""

    target: Posture
    speed: Speed
    zone: Zone
    time: float | None = None
    """\\T, s"""
    concurrent: bool = False
    dwell: float = 0.0
    """s that the program waits after a stop point (\\Inpos with a stop time)."""
    tool: object = None
    """Kinematic tool of the move, for corners and TCP speed."""
    place: Callable[[], object] | None = None
    """Tells where in the program it stands, for messages and the motion pointer."""


def nominal_time(measure: Measure, speed: Speed) -> float:
    """s that the slowest part needs at programmed speed; 0 when nothing moves.

    All parts end together: the slowest one limits the move (S4 datasys 1-speeddata-1).
    ValueError: something has to move at speed 0.
    """
    needs = (
        (measure.tcp, speed.tcp),
        (measure.angle, speed.orientation),
        (measure.linear, speed.linear),
        (measure.rotary, speed.rotary),
    )
    times = [0.0]
    for way, rate in needs:
        if way > 1e-12:
            if rate <= 0.0:
                raise ValueError("speed is zero")
            times.append(way / rate)
    return max(times)


def corner_shares(zone: Zone, before: Measure, after: Measure) -> tuple[float, float] | None:
    """Parts of the two moves (0 to 1/2) that the corner between them takes; None: a stop.

    The TCP zone has one radius on both sides, at most half of the shorter move, and shrinks
    with an extended zone that is smaller in proportion (S4 datasys 1-zonedata). Where the TCP
    does not move, the zone's angle, or its external parts, count instead.
    """
    if zone.fine:
        return None
    if before.tcp > 1e-7 and after.tcp > 1e-7:
        radius = min(zone.tcp, before.tcp / 2, after.tcp / 2)
        for measure in (before, after):
            radius = min(radius, extended_share(zone, measure) * measure.tcp)
        return radius / before.tcp, radius / after.tcp
    shares = [extended_share(zone, measure) for measure in (before, after)]
    return min(shares[0], 0.5), min(shares[1], 0.5)


def extended_share(zone: Zone, measure: Measure) -> float:
    """Part of a move that the zone of orientation and external axes covers, at most 1/2."""
    shares = [0.5]
    moves = measure.tcp > 1e-7
    if moves:
        shares.append(max(zone.orientation, zone.external, zone.tcp) / measure.tcp)
    if measure.angle > 1e-9:
        shares.append(zone.angle / measure.angle)
    if measure.linear > 1e-9:
        shares.append(zone.linear / measure.linear)
    if measure.rotary > 1e-9:
        shares.append(zone.rotary / measure.rotary)
    return min(shares)


def largest(values: Sequence[float]) -> float:
    """The largest magnitude; 0 of nothing."""
    return max(map(abs, values), default=0.0)
