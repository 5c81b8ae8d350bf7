"""Corners: what replaces a fly-by point between two legs.

Two joint legs get a parabola in joint space. Two Cartesian legs of one tool and one object get
a parabola of the TCP inside the TCP zone, and of orientation and external axes inside the
extended zone. Anything else is joined in joint space along the tangents of both ways.
"""

from collections.abc import Callable
from itertools import pairwise

from rapidgen.axes import frames
from rapidgen.axes.frames import Pose, Quaternion, Vector
from rapidgen.axes.kinematics import Kinematics, Posture
from rapidgen.motion.cartesian import CartesianPath, external_places, with_external
from rapidgen.motion.fault_reasons import FaultReason, MotionFault
from rapidgen.motion.legs import Geometry, JointPath, Leg
from rapidgen.motion.moves import (
    NO_TURN,
    NO_WAY,
    MoveFrames,
    Zone,
    corner_shares,
    extended_share,
)
from rapidgen.motion.pieces import AxisLimits, Limits, Piece, joint_corner
from rapidgen.motion.sampling import cubics, interval_limits, largest_step, sample, spaced

Bend = tuple[float, float, list[Piece]]
"""Start and end on the path, and the pieces between."""
Ceilings = list[Limits]
"""Limits of each of some equal intervals."""
_SMALLEST = 1e-7
_FURTHEST = 1e4
"""Largest ratio of the programmed speeds of two moves that a way is stretched by."""
_FEWEST, _MOST = 5, 80
"""Intervals of one section of a corner."""
_STEP = 0.05
"""rad or m of one axis that an interval should not exceed."""


def corner(
    before: Leg, after: Geometry, size: float, limits: AxisLimits, kinematics: Kinematics | None
) -> Bend | None:
    """The corner between a leg and the way of its successor; None: a stop.

    `size` (0 to 1) shrinks the zone where the path cannot be met otherwise.
    """
    path, zone = before.way, before.move.zone
    shares = corner_shares(zone, path.measure, after.measure)
    if shares is None:
        return None
    inside, outside = shares[0] * size * path.duration, shares[1] * size * after.duration
    if min(inside, outside) < _SMALLEST:
        return None
    if isinstance(path, JointPath) and isinstance(after, JointPath):
        return _straight(before, after, path.rates, after.rates, (inside, outside), limits)
    if isinstance(path, CartesianPath) and isinstance(after, CartesianPath):
        if (path.measure.tcp > NO_WAY) != (after.measure.tcp > NO_WAY):
            return None  # TCP motion next to pure reorientation (S4 overview p.5-17)
        poses = path.joins_poses and after.joins_poses and path.carrier == after.carrier
        if poses and kinematics is not None:
            near = inside, outside
            wide = _extended(zone, path, after, size, near)
            bend: Bend | None
            if path.rates is not None and after.rates is not None and _same(wide, near):
                bend = _straight(before, after, path.rates, after.rates, near, limits)
            else:
                bend = _cartesian(before, path, after, near, wide, limits, kinematics)
            if bend is not None and limits.shortest > 0.0:
                _limit_speed(bend[2], before.end, near, limits)
            return bend
    return _mixed(before, path, after, (inside, outside), limits)


def _straight(
    before: Leg,
    after: Geometry,
    rates_in: Posture,
    rates_out: Posture,
    near: tuple[float, float],
    limits: AxisLimits,
) -> Bend:
    """A parabola in joint space between two ways on which all axes go straight."""
    path, (inside, outside) = before.way, near
    start, end = before.end - inside, before.end + outside
    rates = (rates_in, inside, path.programmed), (rates_out, outside, after.programmed)
    tcp = max(path.tcp, after.tcp)
    return start, end, joint_corner(start, path.target, *rates, limits, tcp)


def _same(one: tuple[float, float], other: tuple[float, float]) -> bool:
    """True if a corner begins and ends at the same times for position and orientation."""
    return all(a - b <= _SMALLEST for a, b in zip(one, other, strict=True))


def _limit_speed(
    pieces: list[Piece], point: float, near: tuple[float, float], limits: AxisLimits
) -> None:
    """Let the way through the TCP's zone take `limits.shortest` at least."""
    fastest = sum(near) / limits.corner / limits.shortest
    for piece in pieces:
        if point - near[0] <= (piece.start + piece.end) / 2 <= point + near[1]:
            piece.speed = min(piece.speed, fastest)


def stretch(before: Leg, after: Geometry) -> None:
    """Give the way behind a leg the nominal time with which both halves of the corner are equal.

    Then the speed along the corner is even, and a change of the programmed speed is one of the
    path speed, for which the axes have room. A move with \\T keeps its nominal time: the corner
    has to pass from one speed to the other exactly in its middle.
    """
    shares = corner_shares(before.move.zone, before.way.measure, after.measure)
    if shares is not None and min(shares) > 0.0:
        factor = before.way.duration * shares[0] / (after.duration * shares[1])
        if 1 / _FURTHEST < factor < _FURTHEST:
            after.stretch(factor)


def _extended(
    zone: Zone, path: Geometry, after: Geometry, size: float, least: tuple[float, float]
) -> tuple[float, float]:
    """Nominal times of the extended zone on both sides, not below those of the TCP zone."""
    measures = path.measure, after.measure
    if all(m.angle + m.linear + m.rotary < NO_TURN for m in measures):
        return least  # nothing but the TCP moves
    first, second = extended_share(zone, path.measure), extended_share(zone, after.measure)
    if path.measure.tcp > NO_WAY:
        radius = min(first * path.measure.tcp, second * after.measure.tcp)
        first, second = radius / path.measure.tcp, radius / after.measure.tcp
    return (
        max(least[0], first * size * path.duration),
        max(least[1], second * size * after.duration),
    )


# -- the corner's own parameter -------------------------------------------------------------------


def _parameter(before: float, after: float) -> Callable[[float], float]:
    """w from 0 to 1 over nominal times -before to after: see `pieces.joint_corner`."""
    middle = 1 / (before + after)
    first, last = 1 / (2 * before), 1 / (2 * after)
    half = 0.25 + before * middle / 2

    def w(time: float) -> float:
        if time < 0.0:
            t = time + before
            return (first + (middle - first) / before * t / 2) * t
        return half + (middle + (last - middle) / after * time / 2) * time

    return w


def _curve(points: tuple[Posture, ...], w: float) -> Posture:
    """Cubic over four control points."""
    v = 1 - w
    a, b, c, d = v * v * v, 3 * v * v * w, 3 * v * w * w, w * w * w
    p, q, r, s = points
    return tuple([a * i + b * j + c * k + d * m for i, j, k, m in zip(p, q, r, s, strict=True)])


def _turn(points: tuple[Quaternion, ...], w: float) -> Quaternion:
    """The same for orientations: repeated even turns."""
    row = list(points)
    while len(row) > 1:
        row = [frames.slerp(a, b, w) for a, b in pairwise(row)]
    return row[0]


# -- Cartesian ------------------------------------------------------------------------------


def _cartesian(
    before: Leg,
    path: CartesianPath,
    after: CartesianPath,
    near: tuple[float, float],
    wide: tuple[float, float],
    limits: AxisLimits,
    kinematics: Kinematics,
) -> Bend | None:
    point = before.end
    position = _position(path, after, near)
    orientation = _orientation(path, after, wide)
    external = _external(path, after, wide) if external_places(kinematics) else None

    def pose(time: float) -> Pose:
        return position(time), orientation(time)

    # The second derivatives jump where a zone begins and at the point: no interval lies across.
    ends = sorted({-wide[0], -near[0], 0.0, near[1], wide[1]})
    sections = [(point + a, point + b) for a, b in pairwise(ends) if b - a > _SMALLEST]
    origin = path.posture(path.duration - wide[0])
    solve = _Tracker(kinematics, path.carrier, pose, external)
    speeds = path.programmed, after.programmed
    return _sampled(solve, point, sections, origin, limits, max(path.tcp, after.tcp), speeds)


def _position(
    path: CartesianPath, after: CartesianPath, zone: tuple[float, float]
) -> Callable[[float], Vector]:
    inside, outside = zone
    w = _parameter(inside, outside)
    first, last = path.pose(path.duration - inside)[0], after.pose(outside)[0]
    points = (
        first,
        frames.add(first, frames.scale(path.velocity(path.duration - inside), inside * 2 / 3)),
        frames.add(last, frames.scale(after.velocity(outside), -outside * 2 / 3)),
        last,
    )

    def at(time: float) -> Vector:
        if time <= -inside:
            return path.pose(path.duration + time)[0]
        if time >= outside:
            return after.pose(time)[0]
        x, y, z = _curve(points, w(time))
        return x, y, z

    return at


def _orientation(
    path: CartesianPath, after: CartesianPath, zone: tuple[float, float]
) -> Callable[[float], Quaternion]:
    constant = path.orientation
    if constant is not None and after.orientation is not None:
        return lambda _time: constant
    inside, outside = zone
    w = _parameter(inside, outside)
    first, last = path.pose(path.duration - inside)[1], after.pose(outside)[1]
    points = (
        first,
        frames.multiply(_spun(path, path.duration - inside, inside * 2 / 3), first),
        frames.multiply(_spun(after, outside, -outside * 2 / 3), last),
        last,
    )

    def at(time: float) -> Quaternion:
        return _turn(points, min(1.0, max(0.0, w(time))))

    return at


def _spun(path: CartesianPath, time: float, span: float) -> Quaternion:
    """How far the tool would turn in `span` at the rate that it has at `time`."""
    step = 1e-4 * path.duration
    ahead, after = path.pose(time + step)[1], path.pose(time - step)[1]
    axis, angle = frames.to_axis(frames.multiply(ahead, frames.conjugate(after)))
    return frames.about(axis, angle * span / (2 * step))


def _external(
    path: CartesianPath, after: CartesianPath, zone: tuple[float, float]
) -> Callable[[float], Posture]:
    inside, outside = zone
    w = _parameter(inside, outside)
    points = (
        path.external(path.duration - inside),
        path.external(path.duration - inside / 3),
        after.external(outside / 3),
        after.external(outside),
    )
    return lambda time: _curve(points, min(1.0, max(0.0, w(time))))


class _Tracker:
    """Postures along poses, on one branch."""

    def __init__(
        self,
        kinematics: Kinematics,
        carrier: MoveFrames,
        pose: Callable[[float], Pose],
        external: Callable[[float], Posture] | None,
    ) -> None:
        self._kinematics = kinematics
        self._carrier = carrier
        self._pose = pose
        self._external = external
        self._places = external_places(kinematics)

    def __call__(self, time: float, near: Posture) -> Posture:
        if self._external is not None:
            near = with_external(near, self._external(time), self._places)
        result = self._kinematics.follow(self._carrier.at(near).flange(self._pose(time)), near)
        if result is None:
            raise MotionFault(FaultReason.OUT_OF_REACH_IN_CORNER)
        return result


def _sampled(
    solve: _Tracker,
    point: float,
    sections: list[tuple[float, float]],
    origin: Posture,
    limits: AxisLimits,
    tcp: float,
    speeds: tuple[float, float],
) -> Bend | None:
    pieces: list[Piece] = []
    try:
        for low, high in sections:
            programmed = speeds[low >= point]
            result = _section(solve, point, (low, high), origin, limits, tcp, programmed)
            if result is None:
                return None
            origin, own = result
            pieces += own
    except MotionFault:
        return None  # the corner cannot be reached: the point itself can
    return sections[0][0], sections[-1][1], pieces


def _section(
    solve: _Tracker,
    point: float,
    bounds: tuple[float, float],
    origin: Posture,
    limits: AxisLimits,
    tcp: float,
    programmed: float,
) -> tuple[Posture, list[Piece]] | None:
    """The last posture, and a piece for each interval; None: a jump."""
    (low, high), count = bounds, _FEWEST
    while True:
        places = spaced(low, high, count)
        spacing = (high - low) / count
        nodes = [origin]
        for place in places[1:]:
            nodes.append(solve(place - point, nodes[-1]))
        if largest_step(nodes) <= _STEP:
            ceilings, close = interval_limits(nodes, spacing, limits, programmed)
            if close or count >= _MOST:
                break
        elif count >= _MOST:
            return None
        count *= 2
    return nodes[-1], _pieces(nodes, bounds, ceilings, tcp, programmed)


def _pieces(
    nodes: list[Posture],
    bounds: tuple[float, float],
    ceilings: Ceilings,
    tcp: float,
    programmed: float,
) -> list[Piece]:
    """A piece for each interval between nodes."""
    low, high = bounds
    curves = cubics(nodes, (high - low) / len(ceilings), low)
    places = pairwise(spaced(low, high, len(ceilings)))
    return [
        Piece(*ends, at, own, tcp, programmed=programmed)
        for ends, at, own in zip(places, curves, ceilings, strict=True)
    ]


# -- joint space along both tangents ------------------------------------------------------------


def _mixed(
    before: Leg,
    path: Geometry,
    after: Geometry,
    zone: tuple[float, float],
    limits: AxisLimits,
) -> Bend:
    inside, outside = zone
    point = before.end
    first, last = path.posture(path.duration - inside), after.posture(outside)
    rate_in, rate_out = _rate(path, path.duration - inside), _rate(after, outside)
    points = (
        first,
        tuple([q + r * inside * 2 / 3 for q, r in zip(first, rate_in, strict=True)]),
        tuple([q - r * outside * 2 / 3 for q, r in zip(last, rate_out, strict=True)]),
        last,
    )
    w = _parameter(inside, outside)

    def at(place: float) -> Posture:
        return _curve(points, min(1.0, max(0.0, w(place - point))))

    start, end = point - inside, point + outside
    # The two halves have different slopes: sampled apart, so that no node lies across.
    pieces: list[Piece] = []
    for low, high, programmed in (
        (start, point, path.programmed),
        (point, end, after.programmed),
    ):
        count = _FEWEST
        while True:
            nodes, spacing = sample(at, low, high, count), (high - low) / count
            ceilings, close = interval_limits(nodes, spacing, limits, programmed)
            if close or count >= _MOST:
                break
            count *= 2
        tcp = max(path.tcp, after.tcp)
        pieces += _pieces(nodes, (low, high), ceilings, tcp, programmed)
    return start, end, pieces


def _rate(path: Geometry, time: float) -> Posture:
    step = min(1e-4 * path.duration, time, path.duration - time)
    ahead, after = path.posture(time + step), path.posture(time - step)
    return tuple([(a - b) / (2 * step) for a, b in zip(ahead, after, strict=True)])


def zone_entry(leg: Leg) -> float:
    """Where the largest corner that its end may get would begin."""
    shares = corner_shares(leg.move.zone, leg.way.measure, leg.way.measure)
    if shares is None:
        return leg.end
    fraction = max(shares[0], min(0.5, extended_share(leg.move.zone, leg.way.measure)))
    return leg.end - fraction * leg.way.duration
