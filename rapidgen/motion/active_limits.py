"""The limit that is active at a place of the planned motion.

Phases of a speed profile keep one limit each. A phase at constant speed is at the programmed
speed, at the override or at a ceiling of its piece of path; in any other phase the axis that needs
the largest part of its acceleration decides. Speeds and accelerations of the axes are differences
of the path itself, so they do not depend on how the planner found its ceilings.
"""

from dataclasses import dataclass
from math import inf

from rapidgen.axes import frames
from rapidgen.axes.kinematics import Posture
from rapidgen.config.model import Joint
from rapidgen.motion.legs import Leg
from rapidgen.motion.moves import Measure, MoveSpeed
from rapidgen.motion.pieces import Piece

CORNER = "corner"
FINE_POINT = "fine point"
LATE = "late program pointer (50024)"
NO_CORNER = "no corner possible (50024)"
OVERRIDE = "speed override"
TCP_LIMIT = "limit of the TCP speed"
STOP = "stop"
RETURN = "return to the path"
GUIDED = "externally guided motion"
PROGRAMMED = "programmed speed"
ORIENTATION = "orientation speed"
EXTERNAL = "speed of external axes"
TIME = "programmed time"
PATH_ACCELERATION = "PathAccLim"
WORLD_ACCELERATION = "WorldAccLim"
_SAME = 1e-6
"""Relative difference of speeds that count as the same."""
_FULL = 0.995
"""Part of an axis speed that counts as all of it."""


@dataclass(frozen=True, slots=True)
class Ceilings:
    """What holds for all moves of a motion: share of the programmed speed, m/s of the TCP."""

    cap: float
    tcp: float = inf


def axis_name(joint: Joint) -> str:
    """Return the name of a controller axis for a report: `axis 1`, `external axis a`."""
    kind, _, number = joint.axis.partition("_")
    return f"{'external ' if kind == 'eax' else ''}axis {number}"


def stop_cause(leg: Leg) -> str:
    """Return why the robot stands at the end of a leg; empty if it does not."""
    if leg.move.zone.fine:
        return FINE_POINT
    if leg.late:
        return LATE
    return NO_CORNER if leg.committed else ""


def active_limit(
    piece: Piece,
    leg: Leg,
    state: tuple[float, float, float],
    joints: tuple[Joint, ...],
    ceilings: Ceilings,
) -> str:
    """Return the limit of a phase that has a place, speed and acceleration in its middle."""
    place, speed, acceleration = state
    if speed <= 0.0 and acceleration == 0.0:
        return stop_cause(leg) or FINE_POINT
    rates, curvatures = _derivatives(piece, place)
    limits = leg.way.limits
    fastest = max(range(len(joints)), key=lambda j: rates[j] / limits.speeds[j])
    at_full = rates[fastest] * speed >= _FULL * limits.speeds[fastest]
    if acceleration == 0.0:
        programmed = piece.programmed * ceilings.cap
        if piece.tcp * speed >= ceilings.tcp * (1 - _SAME):
            return TCP_LIMIT
        if speed >= programmed * (1 - _SAME):
            if ceilings.cap < 1.0:
                return OVERRIDE
            if at_full:
                return f"speed of {axis_name(joints[fastest])}"
            return _programmed(leg)
        if at_full:
            return f"speed of {axis_name(joints[fastest])}"
        if piece.corner:
            return CORNER
    bending = [c * speed * speed for c in curvatures]
    along = [r * abs(acceleration) for r in rates]
    available = limits.accelerations(piece.at(place))
    shares = [(b + a) / most for b, a, most in zip(bending, along, available, strict=True)]
    axis = max(range(len(joints)), key=shares.__getitem__)
    largest, name = shares[axis], f"acceleration of {axis_name(joints[axis])}"
    if piece.corner and bending[axis] > along[axis]:
        name = CORNER
    if piece.tcp * abs(acceleration) > largest * limits.tcp_acceleration:
        largest = piece.tcp * abs(acceleration) / limits.tcp_acceleration
        name = PATH_ACCELERATION
    if limits.world is not None:
        tcp, most = limits.world
        rate, bend = _of_points([tcp(piece.at(p)) for p in _around(piece, place)], _step(piece))
        if rate * abs(acceleration) + bend * speed * speed > largest * most:
            name = WORLD_ACCELERATION
    return name


def _programmed(leg: Leg) -> str:
    """Return the part of the speeddata that decides, or \\T."""
    if leg.move.time is not None:
        return TIME
    measure, speed = leg.way.measure, leg.move.speed
    return max(_parts(measure, speed))[1]


def _parts(measure: Measure, speed: MoveSpeed) -> list[tuple[float, str]]:
    pairs = (
        (measure.tcp, speed.tcp, PROGRAMMED),
        (measure.angle, speed.orientation, ORIENTATION),
        (measure.linear, speed.linear, EXTERNAL),
        (measure.rotary, speed.rotary, EXTERNAL),
    )
    # A speed of 0 is allowed where nothing moves.
    return [(way / rate if rate > 0.0 else 0.0, name) for way, rate, name in pairs]


def _step(piece: Piece) -> float:
    return (piece.end - piece.start) / 4


def _around(piece: Piece, place: float) -> tuple[float, float, float]:
    step = _step(piece)
    return place - step, place, place + step


def _derivatives(piece: Piece, place: float) -> tuple[Posture, Posture]:
    """Return magnitudes of the axes' first and second derivatives by the place."""
    step = _step(piece)
    before, here, after = (piece.at(p) for p in _around(piece, place))
    rates = [abs(c - a) / (2 * step) for a, c in zip(before, after, strict=True)]
    if piece.straight:
        return tuple(rates), (0.0,) * len(rates)
    rows = zip(before, here, after, strict=True)
    return tuple(rates), tuple([abs(a - 2 * b + c) / (step * step) for a, b, c in rows])


def _of_points(points: list[frames.Vector], step: float) -> tuple[float, float]:
    a, b, c = points
    bend = frames.subtract(frames.subtract(c, b), frames.subtract(b, a))
    return frames.distance(a, c) / (2 * step), frames.norm(bend) / (step * step)
