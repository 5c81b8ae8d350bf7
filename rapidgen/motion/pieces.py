"""Pieces of path: where the axes are at each place of the nominal time, and the limits there."""

from collections.abc import Callable, Sequence
from copy import copy
from itertools import pairwise
from math import inf, sqrt

from rapidgen.axes import frames
from rapidgen.axes.frames import Vector
from rapidgen.axes.kinematics import Posture

_SAMPLES = 8
"""Parts of a piece over which the TCP's curve is measured."""


class Piece:
    """A stretch of path from `start` to `end` (nominal s) with constant limits.

    `speed` and `acceleration` are ceilings of the path's own speed (1 = as programmed).
    """

    __slots__ = ("acceleration", "at", "end", "speed", "start", "stop", "tcp")

    def __init__(
        self,
        start: float,
        end: float,
        at: Callable[[float], Posture],
        limits: tuple[float, float],
        tcp: float,
    ) -> None:
        self.start = start
        self.end = end
        self.at = at
        """Axis values at a place."""
        self.speed, self.acceleration = limits
        self.tcp = tcp
        """m that the TCP goes in a nominal s."""
        self.stop = False
        """Whether the robot stands at the end."""

    def until(self, end: float, *, stop: bool = False) -> "Piece":
        """The part of this piece before `end`."""
        part = copy(self)
        part.end = end
        part.stop = stop
        return part

    def since(self, start: float) -> "Piece":
        """The part of this piece behind `start`."""
        part = copy(self)
        part.start = start
        return part


class AxisLimits:
    """Speeds and accelerations of the axes (rad, m), turned into limits along a path."""

    __slots__ = ("accelerations", "ramp", "share", "speeds", "tcp_acceleration", "world")

    def __init__(
        self,
        speeds: Sequence[float],
        accelerations: Sequence[float],
        fraction: float,
        tcp_acceleration: float = inf,
        ramp: float = 0.0,
        world: tuple[Callable[[Posture], Vector], float] | None = None,
    ) -> None:
        self.speeds = tuple(speeds)
        self.accelerations = tuple(accelerations)
        self.share = fraction
        self.tcp_acceleration = tcp_acceleration
        """m/s^2 of the TCP along the path (PathAccLim)."""
        self.ramp = ramp
        """s in which acceleration builds up; a standstill begins and ends half of it later."""
        self.world = world
        """Where the TCP of a posture is, and its largest acceleration, m/s^2 (WorldAccLim)."""

    def slow(self, pieces: Sequence[Piece]) -> Sequence[Piece]:
        """Fresh pieces with the limits of the TCP's acceleration, along its path and in all."""
        for piece in pieces:
            if piece.tcp * piece.acceleration > self.tcp_acceleration:
                piece.acceleration = self.tcp_acceleration / piece.tcp
            if self.world is not None:
                self._slow_in_world(piece, *self.world)
        return pieces

    def _slow_in_world(self, piece: Piece, tcp: Callable[[Posture], Vector], limit: float) -> None:
        """Turning takes its part of the limit first, as it does of the axes'."""
        step = (piece.end - piece.start) / _SAMPLES
        row = [tcp(piece.at(piece.start + k * step)) for k in range(_SAMPLES + 1)]
        rate = max(frames.distance(a, b) for a, b in pairwise(row)) / step
        chords = [frames.subtract(b, a) for a, b in pairwise(row)]
        bend = max(frames.distance(a, b) for a, b in pairwise(chords)) / (step * step)
        if bend * piece.speed * piece.speed > limit * self.share:
            piece.speed = sqrt(limit * self.share / bend)
        left = limit - bend * piece.speed * piece.speed
        if rate * piece.acceleration > left:
            piece.acceleration = left / rate

    def of_line(self, rates: Posture) -> tuple[float, float]:
        """Path speed (at most 1) and acceleration on a straight joint line."""
        speed, acceleration = 1.0, inf
        for rate, v, a in zip(rates, self.speeds, self.accelerations, strict=True):
            size = abs(rate)
            if size * speed > v:
                speed = v / size
            if size * acceleration > a:
                acceleration = a / size
        return speed, acceleration

    def of_curve(self, rates: Posture, curvings: Posture) -> tuple[float, float]:
        """The same where the path bends: turning takes its part of the acceleration first."""
        speed = 1.0
        for rate, curving, v, a in zip(
            rates, curvings, self.speeds, self.accelerations, strict=True
        ):
            if rate * speed > v:
                speed = v / rate
            if curving * speed * speed > a * self.share:
                speed = sqrt(a * self.share / curving)
        acceleration = inf
        for rate, curving, a in zip(rates, curvings, self.accelerations, strict=True):
            left = a - curving * speed * speed
            if rate * acceleration > left:
                acceleration = left / rate
        return speed, acceleration


def joint_line(
    start: float,
    end: float,
    line: tuple[float, Posture, Posture],
    limits: AxisLimits,
    tcp: float,
) -> Piece:
    """All axes linear in nominal time: a line is the place where it begins, where the axes are
    there, and their rates per s."""
    zero, origin, rates = line

    def at(place: float) -> Posture:
        t = place - zero
        return tuple([q + r * t for q, r in zip(origin, rates, strict=True)])

    return Piece(start, end, at, limits.of_line(rates), tcp)


def joint_corner(
    start: float,
    point: Posture,
    incoming: tuple[Posture, float],
    outgoing: tuple[Posture, float],
    limits: AxisLimits,
    tcp: float,
) -> list[Piece]:
    """The two halves of a corner at `point` that begins at `start` on the path.

    `incoming` and `outgoing` are the rates of the two lines and the nominal s that the corner
    takes of each; `tcp` the larger TCP speed of the two.
    """
    (rates_in, before), (rates_out, after) = incoming, outgoing
    origin = tuple([p - r * before for p, r in zip(point, rates_in, strict=True)])
    tangent = tuple([2 * r * before for r in rates_in])
    bend = tuple([o * after - i * before for i, o in zip(rates_in, rates_out, strict=True)])
    curve = origin, tangent, bend
    middle = 1 / (before + after)
    first, last = 1 / (2 * before), 1 / (2 * after)
    half = 0.25 + before * middle / 2
    centre = start + before
    return [
        _half(start, centre, curve, (first, middle), 0.0, limits, tcp),
        _half(centre, centre + after, curve, (middle, last), half, limits, tcp),
    ]


def _half(
    start: float,
    end: float,
    curve: tuple[Posture, Posture, Posture],
    slopes: tuple[float, float],
    first: float,
    limits: AxisLimits,
    tcp: float,
) -> Piece:
    """Half of a joint corner: the parabola over entry, programmed point and exit.

    Its parameter w runs from 0 to 1 over both halves with a slope that changes linearly within
    each half, from the speed of the incoming move to that of the outgoing one, and passes both
    halves in the time that the two programmed speeds need for them. So the place of the corner
    is that of the zone, while \\T stays exact.
    """
    origin, tangent, bend = curve
    slope = slopes[0]
    turn = (slopes[1] - slopes[0]) / (end - start)
    last = first + (slopes[0] + slopes[1]) / 2 * (end - start)

    def at(place: float) -> Posture:
        t = place - start
        w = first + (slope + turn * t / 2) * t
        return tuple([o + (d + b * w) * w for o, d, b in zip(origin, tangent, bend, strict=True)])

    extremes = _extremes(tangent, bend, (slope, turn), (first, last))
    return Piece(start, end, at, limits.of_curve(*extremes), tcp)


def _extremes(
    tangents: Posture, bends: Posture, slopes: tuple[float, float], ends: tuple[float, float]
) -> tuple[Posture, Posture]:
    """Largest first and second derivatives by nominal time, per axis.

    With slope(w)^2 = s + 2 turn (w - first): rate = (d + 2 b w) slope, whose square is a
    cubic in w; curving = 2 b slope^2 + (d + 2 b w) turn, which is linear in w.
    """
    (slope, turn), (first, last) = slopes, ends
    square = slope * slope
    rates, curvings = [], []
    for d, b in zip(tangents, bends, strict=True):
        places = [first, last]
        if b and turn:
            # d/dw of the squared rate is zero here
            w = -(4 * b * (square - 2 * turn * first) + 2 * turn * d) / (12 * b * turn)
            if first < w < last:
                places.append(w)
        rate = curving = 0.0
        for w in places:
            own = max(0.0, square + 2 * turn * (w - first))
            tangent = d + 2 * b * w
            rate = max(rate, abs(tangent) * sqrt(own))
            curving = max(curving, abs(2 * b * own + tangent * turn))
        rates.append(rate)
        curvings.append(curving)
    return tuple(rates), tuple(curvings)
