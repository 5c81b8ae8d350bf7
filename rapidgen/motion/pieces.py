"""Pieces of path: where the axes are at each place of the nominal time, and the limits there."""

from collections.abc import Callable, Sequence
from itertools import pairwise
from math import ceil, inf, sqrt

from rapidgen.axes import frames
from rapidgen.axes.frames import Vector
from rapidgen.axes.kinematics import Posture
from rapidgen.motion.speed_profile import Shares

Limits = tuple[float, Shares]
"""Path speed, and what the axes need of their accelerations."""
_PART, _MOST_PARTS = 0.01, 6
"""s at the programmed speed, and number, of the parts of half a joint corner."""
_SAMPLES = 8
"""Parts of a piece over which the TCP's curve is measured."""


class Piece:
    """A stretch of path from `start` to `end` (nominal s) with constant limits.

    `speed` is a ceiling of the path's own speed (1 = as programmed), `shares` are what the axes
    need of their accelerations (`speed_profile.py`).
    """

    __slots__ = (
        "at",
        "corner",
        "end",
        "programmed",
        "shares",
        "speed",
        "start",
        "stop",
        "straight",
        "tcp",
    )

    def __init__(
        self,
        start: float,
        end: float,
        at: Callable[[float], Posture],
        limits: Limits,
        tcp: float,
        *,
        straight: bool = False,
        programmed: float = 1.0,
    ) -> None:
        self.start = start
        self.end = end
        self.at = at
        """Axis values at a place."""
        self.speed, self.shares = limits
        self.tcp = tcp
        """m that the TCP goes in a nominal s."""
        self.straight = straight
        """Whether all axes are linear in the place."""
        self.programmed = programmed
        """Path speed that is as programmed."""
        self.stop = False
        """Whether the robot stands at the end."""
        self.corner = False
        """True for a part of the corner at a fly-by point."""

    def until(self, end: float, *, stop: bool = False) -> "Piece":
        """The part of this piece before `end`."""
        part = self._copied()
        part.end = end
        part.stop = stop
        return part

    def since(self, start: float) -> "Piece":
        """The part of this piece behind `start`."""
        part = self._copied()
        part.start = start
        return part

    def _copied(self) -> "Piece":
        limits = self.speed, self.shares
        part = Piece(
            self.start,
            self.end,
            self.at,
            limits,
            self.tcp,
            straight=self.straight,
            programmed=self.programmed,
        )
        part.stop, part.corner = self.stop, self.corner
        return part


class AxisLimits:
    """Speeds and accelerations of the axes (rad, m), turned into limits along a path."""

    __slots__ = (
        "_at",
        "_typical",
        "corner",
        "ramp",
        "share",
        "shortest",
        "speeds",
        "tcp_acceleration",
        "world",
    )

    def __init__(
        self,
        speeds: Sequence[float],
        accelerations: Sequence[float],
        fraction: float,
        tcp_acceleration: float = inf,
        ramp: float = 0.0,
        world: tuple[Callable[[Posture], Vector], float] | None = None,
        at: Callable[[Posture], Sequence[float]] | None = None,
        corner: float = 1.0,
        shortest: float = 0.0,
    ) -> None:
        self.speeds = tuple(speeds)
        self._typical = tuple(accelerations)
        self._at = at
        self.share = fraction
        """What the curvature of the path may take of an acceleration; the rest is for braking."""
        self.corner = corner
        """Part of a zone that the parabola of its corner takes."""
        self.shortest = shortest
        """s that the way through a zone takes at least."""
        self.tcp_acceleration = tcp_acceleration
        """m/s^2 of the TCP along the path (PathAccLim)."""
        self.ramp = ramp
        """s over which the robot follows the mean of what is planned."""
        self.world = world
        """Where the TCP of a posture is, and its largest acceleration, m/s^2 (WorldAccLim)."""

    @property
    def vary(self) -> bool:
        """Whether the accelerations depend on the posture."""
        return self._at is not None

    def accelerations(self, posture: Posture) -> Sequence[float]:
        """Accelerations of the axes in a posture."""
        return self._typical if self._at is None else self._at(posture)

    def slow(self, pieces: Sequence[Piece]) -> Sequence[Piece]:
        """Fresh pieces with the limits of the TCP's acceleration, along its path and in all."""
        for piece in pieces:
            if piece.tcp and self.tcp_acceleration < inf:
                piece.shares = (*piece.shares, (piece.tcp / self.tcp_acceleration, 0.0))
            if self.world is not None:
                self._slow_in_world(piece, *self.world)
        return pieces

    def _slow_in_world(self, piece: Piece, tcp: Callable[[Posture], Vector], limit: float) -> None:
        step = (piece.end - piece.start) / _SAMPLES
        row = [tcp(piece.at(piece.start + k * step)) for k in range(_SAMPLES + 1)]
        rate = max(frames.distance(a, b) for a, b in pairwise(row)) / step
        chords = [frames.subtract(b, a) for a, b in pairwise(row)]
        bend = max(frames.distance(a, b) for a, b in pairwise(chords)) / (step * step)
        if bend * piece.speed * piece.speed > limit * self.share:
            piece.speed = sqrt(limit * self.share / bend)
        if rate > 0.0 or bend > 0.0:
            piece.shares = (*piece.shares, (rate / limit, bend / limit))

    def of_line(
        self, rates: Posture, accelerations: Sequence[float], programmed: float = 1.0
    ) -> Limits:
        """Path speed (at most 1) and shares on a straight joint line."""
        speed, most = programmed, 0.0
        for rate, v, a in zip(rates, self.speeds, accelerations, strict=True):
            size = abs(rate)
            if size * speed > v:
                speed = v / size
            if size > most * a:
                most = size / a
        return speed, ((most, 0.0),) if most else ()

    def of_curve(
        self, rates: Posture, curvatures: Posture, posture: Posture, programmed: float = 1.0
    ) -> Limits:
        """The same where the path bends."""
        speed, pairs = programmed, []
        for rate, curvature, v, a in zip(
            rates, curvatures, self.speeds, self.accelerations(posture), strict=True
        ):
            if rate * speed > v:
                speed = v / rate
            if curvature * speed * speed > a * self.share:
                speed = sqrt(a * self.share / curvature)
            pairs.append((rate / a, curvature / a))
        pairs.sort(reverse=True)
        shares, most = [], -1.0
        for pair in pairs:
            if pair[1] > most and pair != (0.0, 0.0):
                shares.append(pair)
                most = pair[1]
        return speed, tuple(shares)


def joint_line(
    start: float,
    end: float,
    line: tuple[float, Posture, Posture],
    limits: AxisLimits,
    tcp: float,
    accelerations: Sequence[float] | None = None,
    programmed: float = 1.0,
) -> Piece:
    """Return a piece on which all axes are linear in nominal time.

    A line is its place, the axes there, and their rates per s. `accelerations` are those of the
    axes in its middle.
    """
    zero, origin, rates = line

    def at(place: float) -> Posture:
        t = place - zero
        return tuple([q + r * t for q, r in zip(origin, rates, strict=True)])

    if accelerations is None:
        accelerations = limits.accelerations(at((start + end) / 2))
    own = limits.of_line(rates, accelerations, programmed)
    return Piece(start, end, at, own, tcp, straight=True, programmed=programmed)


def joint_corner(
    start: float,
    point: Posture,
    incoming: tuple[Posture, float, float],
    outgoing: tuple[Posture, float, float],
    limits: AxisLimits,
    tcp: float,
) -> list[Piece]:
    """Return the pieces of a corner at `point` that begins at `start` on the path.

    `incoming` and `outgoing` are the rates of the two lines, the nominal s that the corner takes
    of each, and the path speed that is as programmed; `tcp` is the larger TCP speed of the two.

    The corner is the parabola over entry, programmed point and exit. Its parameter w runs from 0
    to 1 over both halves with a slope that changes linearly within each half, from the speed of
    the incoming move to that of the outgoing one, and passes both halves in the time that the two
    programmed speeds need for them. So the place of the corner is that of the zone, while \\T stays
    exact.
    """
    (rates_in, before, speed_in), (rates_out, after, speed_out) = incoming, outgoing
    origin = tuple([p - r * before for p, r in zip(point, rates_in, strict=True)])
    tangent = tuple([2 * r * before for r in rates_in])
    bend = tuple([o * after - i * before for i, o in zip(rates_in, rates_out, strict=True)])
    curve = origin, tangent, bend
    middle = 1 / (before + after)
    first, last = 1 / (2 * before), 1 / (2 * after)
    half = 0.25 + before * middle / 2
    centre = start + before
    return [
        *_half((start, centre), curve, (first, middle), 0.0, limits, tcp, speed_in),
        *_half((centre, centre + after), curve, (middle, last), half, limits, tcp, speed_out),
    ]


def _half(
    ends: tuple[float, float],
    curve: tuple[Posture, Posture, Posture],
    slopes: tuple[float, float],
    first: float,
    limits: AxisLimits,
    tcp: float,
    programmed: float,
) -> list[Piece]:
    """Return half of a joint corner, in parts with limits of their own."""
    origin, tangent, bend = curve
    start, end = ends
    slope = slopes[0]
    turn = (slopes[1] - slopes[0]) / (end - start)

    def w_at(t: float) -> float:
        return first + (slope + turn * t / 2) * t

    def at(place: float) -> Posture:
        w = w_at(place - start)
        return tuple([o + (d + b * w) * w for o, d, b in zip(origin, tangent, bend, strict=True)])

    parts = min(_MOST_PARTS, ceil((end - start) / programmed / _PART))
    step = (end - start) / parts
    pieces = []
    for k in range(parts):
        low, high = k * step, (k + 1) * step
        extremes = _extremes(tangent, bend, (slope + turn * low, turn), (w_at(low), w_at(high)))
        own = limits.of_curve(*extremes, at(start + (low + high) / 2), programmed)
        right = end if k == parts - 1 else start + high
        pieces.append(Piece(start + low, right, at, own, tcp, programmed=programmed))
    return pieces


def _extremes(
    tangents: Posture, bends: Posture, slopes: tuple[float, float], ends: tuple[float, float]
) -> tuple[Posture, Posture]:
    """Largest first and second derivatives by nominal time, per axis.

    With slope(w)^2 = s + 2 turn (w - first): rate = (d + 2 b w) slope, whose square is a
    cubic in w; curving = 2 b slope^2 + (d + 2 b w) turn, which is linear in w.
    """
    (slope, turn), (first, last) = slopes, ends
    square = slope * slope
    least, most = square, max(0.0, square + 2 * turn * (last - first))
    root_least, root_most = slope, sqrt(most)
    rates, curvings = [], []
    for d, b in zip(tangents, bends, strict=True):
        twice = 2 * b
        at_first, at_last = d + twice * first, d + twice * last
        rate = max(abs(at_first) * root_least, abs(at_last) * root_most)
        curving = max(abs(twice * least + at_first * turn), abs(twice * most + at_last * turn))
        if b and turn:
            # d/dw of the squared rate is zero here; the curving is largest at an end.
            w = -(4 * b * (square - 2 * turn * first) + 2 * turn * d) / (12 * b * turn)
            if first < w < last:
                own = max(0.0, square + 2 * turn * (w - first))
                rate = max(rate, abs(d + twice * w) * sqrt(own))
        rates.append(rate)
        curvings.append(curving)
    return tuple(rates), tuple(curvings)
