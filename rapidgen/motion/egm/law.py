"""The law by which guided axes follow their references, in cycles.

In each cycle (manual 3HAC073318, 2.3 and 2.5):

1. The ordered speed is gain * (reference - position) + speed reference, where the position is the
   one that was ordered, not the measured one.
2. A low pass of first order smooths the speed. Its solution over a cycle is exact, so results do
   not depend on the length of the cycle while the reference stands.
3. If an axis exceeds the speed limit, all axes are slowed down by one ratio.
4. The robot follows after a dead time (`docs/rapid/options.md` names reports of 10 to 80 ms).

At the start the order grows from zero over the ramp-in time. A stop reduces the speed linearly over
the ramp-out time, or returns to the start. How fast a controller does so is not published.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, cosh, exp, pi, sin, sinh, sqrt
from typing import Final, TypeAlias

from rapidgen.axes.kinematics import Posture

CYCLE: Final = 0.004
"""s; a real controller has 4.032 ms."""
_NOTHING: Final = 1e-12


@dataclass(frozen=True, slots=True)
class Profile:
    """An instance of EXT_MOTION_DATA; the defaults are those of the manual (chapter 4)."""

    level: int = 1
    stands_after_motors_off: bool = False
    """do_not_restart_after_motors_off"""
    ramp_time: float = 0.5
    """s, for stops that no RAPID instruction causes."""
    gain: float = 5.0
    """1/s"""
    bandwidth: float = 20.0
    """Hz of the low pass; 0: none."""


Transition: TypeAlias = tuple[float, float, float, float]
"""Rows of a 2 x 2 matrix."""


def transition(gain: float, bandwidth: float, cycle: float) -> Transition:
    """Return how the deviation x and the speed v of an axis go through a cycle.

    x' = v and v' = bandwidth * (-gain * x - v), with a bandwidth in 1/s, for a reference that
    stands. The two rates of the solution are real, equal or complex.
    """
    half, product = bandwidth / 2, bandwidth * gain
    decay, square = exp(-half * cycle), half * half - product
    if abs(square) < _NOTHING:
        even, odd = 1.0, cycle
    elif square > 0:
        root = sqrt(square)
        even, odd = cosh(root * cycle), sinh(root * cycle) / root
    else:
        root = sqrt(-square)
        even, odd = cos(root * cycle), sin(root * cycle) / root
    return (
        decay * (even + half * odd),
        decay * odd,
        -decay * product * odd,
        decay * (even - half * odd),
    )


class Law:
    """Coordinates that follow their references, cycle by cycle.

    Args:
        start: Where it begins; any units, all the same over the life of a law.
        gain: 1/s.
        bandwidth: Hz of the low pass; 0: none.
        ramp_in: s.
    """

    def __init__(self, start: Posture, gain: float, bandwidth: float, ramp_in: float = 0.0) -> None:
        self.positions = start
        self.speeds: Posture = (0.0,) * len(start)
        self._gain, self._bandwidth, self._ramp_in = gain, 2 * pi * bandwidth, ramp_in
        self._age = 0.0

    def propose(
        self, reference: Posture, speeds: Posture, cycle: float = CYCLE
    ) -> tuple[Posture, Posture]:
        """Return positions and speeds at the end of the next cycle, which `accept` executes."""
        part = 1.0 if self._ramp_in <= 0 else min(1.0, (self._age + cycle) / self._ramp_in)
        gain, bandwidth = self._gain * part, self._bandwidth
        matrix = transition(gain, bandwidth, cycle) if bandwidth > 0 else None
        positions, results = [], []
        for wanted, rate, q, v in zip(reference, speeds, self.positions, self.speeds, strict=True):
            if matrix is None:
                moved, v = _without_filter(gain, wanted - q, rate * part, cycle)
            else:
                moved, v = _with_filter(matrix, gain, bandwidth, q - wanted, rate * part, v, cycle)
            positions.append(q + moved)
            results.append(v)
        return tuple(positions), tuple(results)

    def accept(self, positions: Posture, speeds: Posture, cycle: float = CYCLE) -> None:
        """Execute a cycle, as proposed or slowed down."""
        self.positions, self.speeds = positions, speeds
        self._age += cycle


def slowed(
    before: Posture, positions: Posture, speeds: Posture, ratio: float
) -> tuple[Posture, Posture]:
    """Return a proposal of which only a ratio is executed.

    The speed becomes that of the executed step, so that the low pass does not keep one that was
    never reached.
    """
    steps = tuple(q + (n - q) * ratio for q, n in zip(before, positions, strict=True))
    pairs = zip(speeds, steps, before, strict=True)
    return steps, tuple(_smaller(v * ratio, (n - q) / CYCLE) for v, n, q in pairs)


def _smaller(a: float, b: float) -> float:
    return a if abs(a) < abs(b) else b


def braking_time(speeds: Posture, room: Sequence[tuple[float, float]], time: float) -> float:
    """Return the time, at most `time`, in which no axis leaves its room (down, up)."""
    for v, (down, up) in zip(speeds, room, strict=True):
        if abs(v) > _NOTHING:
            time = min(time, 2 * max(0.0, up if v > 0 else down) / abs(v))
    return max(time, CYCLE)


class Brake:
    """Speeds that decrease linearly to zero within a time in s."""

    def __init__(self, origin: Posture, speeds: Posture, time: float) -> None:
        self._origin, self._first, self._time = origin, speeds, time
        self._age = 0.0

    @property
    def done(self) -> bool:
        """True at the end."""
        return self._age >= self._time

    @property
    def left(self) -> float:
        """Return the time in s until it stands."""
        return self._time - self._age

    def advance(self, cycle: float) -> Posture:
        """Return the position after a further cycle."""
        self._age = min(self._age + cycle, self._time)
        return self._at(self._age)

    def end(self) -> Posture:
        """Return where it stands at the end."""
        return self._at(self._time)

    def _at(self, t: float) -> Posture:
        moved = t - t * t / (2 * self._time)
        return tuple(q + v * moved for q, v in zip(self._origin, self._first, strict=True))


class Line:
    """A joint line from rest to rest."""

    def __init__(self, origin: Posture, target: Posture, time: float) -> None:
        self._origin, self._target, self._time = origin, target, time
        self._age = 0.0

    @property
    def done(self) -> bool:
        """True at the end."""
        return self._age >= self._time

    @property
    def left(self) -> float:
        """Return the time in s until it stands."""
        return self._time - self._age

    def advance(self, cycle: float) -> Posture:
        """Return the position after a further cycle."""
        self._age = min(self._age + cycle, self._time)
        if self.done:
            return self._target
        u = self._age / self._time
        part = u * u * (3 - 2 * u)
        pairs = zip(self._origin, self._target, strict=True)
        return tuple(q + (end - q) * part for q, end in pairs)


class Return:
    """A brake, then a line."""

    def __init__(self, brake: Brake, line: Line) -> None:
        self._parts: tuple[Brake | Line, ...] = (brake, line)

    @property
    def _current(self) -> "Brake | Line":
        return self._parts[0] if not self._parts[0].done else self._parts[1]

    @property
    def done(self) -> bool:
        """True at the end."""
        return self._parts[1].done

    @property
    def left(self) -> float:
        """Return the time in s until it stands."""
        return sum(part.left for part in self._parts)

    def advance(self, cycle: float) -> Posture:
        """Return the position after a further cycle."""
        return self._current.advance(cycle)


def _without_filter(
    gain: float, deviation: float, rate: float, cycle: float
) -> tuple[float, float]:
    """Return the distance and the speed at the end: x' = gain * (deviation - x) + rate."""
    if gain * cycle < _NOTHING:
        return rate * cycle, rate
    end = deviation + rate / gain
    left = exp(-gain * cycle)
    return end * (1 - left), end * gain * left


def _with_filter(
    matrix: Transition,
    gain: float,
    bandwidth: float,
    deviation: float,
    rate: float,
    speed: float,
    cycle: float,
) -> tuple[float, float]:
    """Return the distance and the speed at the end.

    With a speed reference the deviation tends to rate / gain; without a gain the speed tends to
    the reference and the distance is its integral.
    """
    if gain < _NOTHING:
        left = exp(-bandwidth * cycle)
        return (
            rate * cycle + (speed - rate) * (1 - left) / bandwidth,
            rate + (speed - rate) * left,
        )
    a, b, c, d = matrix
    x = deviation - rate / gain
    return a * x + b * speed - x, c * x + d * speed
