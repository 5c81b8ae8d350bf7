"""Times for waypoints, required speeds, resampling (numpy).

A trajectory is executed as `MoveAbsJ ... \\T` with zones: constant axis speeds between two points
and a change of speed around each point. The speed of segment k is its distance over its time, and
the acceleration at a point is the change of speed over the mean of the two times; at the first and
last point speed rises from and falls to zero within the segment.
"""

from dataclasses import dataclass
from math import floor

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class LimitUsage:
    """Required speeds and accelerations, as shares of their limits.

    `speed[k]` belongs to the segment from point k to k + 1, `acceleration[k]` to point k.
    """

    speed: Array
    acceleration: Array

    @property
    def worst(self) -> float:
        """Return the largest share of all."""
        return float(max(self.speed.max(initial=0.0), self.acceleration.max(initial=0.0)))


def limit_usage(times: Array, positions: Array, speed: Array, acceleration: Array) -> LimitUsage:
    """Return the shares of the limits that a trajectory needs.

    `times` (N,) s ascending, `positions` (N, n), `speed` and `acceleration` (n,). ValueError: fewer
    than two points or times that do not increase.
    """
    periods, deltas = _segments(times, positions)
    return _demand(periods, deltas, np.asarray(speed), np.asarray(acceleration))


def parametrise(positions: Array, speed: Array, acceleration: Array) -> Array:
    """Return short times (N,) from 0 for the points within the limits.

    Points that repeat their predecessor get a segment of zero length and a time that is 1 ms later.
    ValueError: fewer than two points, or a limit that is not positive.
    """
    points = np.asarray(positions, dtype=np.float64)
    limits = np.asarray(speed, dtype=np.float64), np.asarray(acceleration, dtype=np.float64)
    if len(points) < 2:
        raise ValueError("a trajectory needs at least two points")
    if min(limits[0].min(), limits[1].min()) <= 0:
        raise ValueError("speed and acceleration limits must be positive")
    deltas = np.diff(points, axis=0)
    # Shares: s = 1 on a segment means that one axis moves at its largest speed.
    shortest = np.maximum(np.max(np.abs(deltas) / limits[0], axis=1), 1e-3)
    rates = deltas / shortest[:, None]
    ramps = 4 if len(deltas) == 1 else 2
    fraction = np.ones(len(deltas))
    for end in (0, -1):
        ramp = np.sqrt(ramps * np.max(np.abs(deltas[end]) / limits[1]))
        fraction[end] = min(1.0, shortest[end] / ramp) if ramp > 0 else 1.0
    with np.errstate(divide="ignore"):
        turn = np.max(np.abs(np.diff(rates, axis=0)) / limits[1], axis=1)
        corner = np.sqrt((shortest[1:] + shortest[:-1]) / 2 / turn)
    fraction[1:] = np.minimum(fraction[1:], corner)
    fraction[:-1] = np.minimum(fraction[:-1], corner)
    for k in range(1, len(fraction)):
        reach = _next_share(
            rates[k - 1], rates[k], shortest[k - 1], shortest[k], fraction[k - 1], limits[1]
        )
        fraction[k] = min(fraction[k], reach)
    for k in range(len(fraction) - 2, -1, -1):
        reach = _next_share(
            rates[k + 1], rates[k], shortest[k + 1], shortest[k], fraction[k + 1], limits[1]
        )
        fraction[k] = min(fraction[k], reach)
    periods = shortest / fraction
    periods = periods * max(1.0, float(np.sqrt(_demand(periods, deltas, *limits).worst)))
    result: Array = np.concatenate(([0.0], np.cumsum(periods)))
    return result


def _next_share(
    before: Array, rate: Array, period_before: float, period: float, fraction: float, limit: Array
) -> float:
    """Return the largest share of a segment with a neighbour at `fraction`.

    It is bounded by the acceleration between them.

    |rate s' - before s| <= limit (period_before / s + period / s') / 2 is, for each axis in
    the direction in which it speeds up, a quadratic inequality in s'.
    """
    sign = np.where(rate < 0, -1.0, 1.0)
    square = np.maximum(np.abs(rate), 1e-12)
    linear = sign * before * fraction + limit * period_before / (2 * fraction)
    roots = (linear + np.sqrt(linear**2 + 2 * square * limit * period)) / (2 * square)
    return float(roots.min())


def slow_down(times: Array, positions: Array, speed: Array, acceleration: Array) -> Array:
    """Return the times, scaled until the limits hold.

    They are unchanged if the limits hold already.
    """
    worst = limit_usage(times, positions, speed, acceleration)
    factor = max(1.0, float(worst.speed.max()), float(np.sqrt(worst.acceleration.max())))
    stretched: Array = times[0] + (np.asarray(times) - times[0]) * factor
    return stretched


def resample(times: Array, positions: Array, period: float) -> tuple[Array, Array]:
    """Return points at an equal spacing close to `period` s.

    The spacing is not below `period` unless the whole is; first and last point are kept exactly.
    Between points axes move linearly, so ranges and speeds stay within those of the input.
    """
    stamps = np.asarray(times, dtype=np.float64)
    points = np.asarray(positions, dtype=np.float64)
    _segments(stamps, points)
    if not period > 0:
        raise ValueError("the period must be positive")
    # A spacing equal to a period up to rounding counts as one.
    count = max(1, floor((stamps[-1] - stamps[0]) / period * (1 + 1e-9)))
    fresh = np.linspace(stamps[0], stamps[-1], count + 1)
    columns = [np.interp(fresh, stamps, points[:, j]) for j in range(points.shape[1])]
    return fresh, np.stack(columns, axis=1)


def decimate(times: Array, positions: Array, shortest: float, tolerance: float) -> Array:
    """Return the indices of points to keep.

    No segment is below `shortest` s if possible, and no dropped point is further than `tolerance`
    (rad, m) from the path between its kept neighbours.
    """
    stamps = np.asarray(times, dtype=np.float64)
    points = np.asarray(positions, dtype=np.float64)
    _segments(stamps, points)
    chosen = [0]
    last = len(stamps) - 1
    while chosen[-1] < last:
        start = chosen[-1]
        end = start + 1
        while end < last and stamps[end] - stamps[start] < shortest - 1e-9:
            if not _is_straight(stamps, points, start, end + 1, tolerance):
                break
            end += 1
        chosen.append(end)
    return np.array(chosen)


def _is_straight(stamps: Array, points: Array, start: int, end: int, tolerance: float) -> bool:
    inner = slice(start + 1, end)
    fraction = (stamps[inner] - stamps[start]) / (stamps[end] - stamps[start])
    line = points[start] + fraction[:, None] * (points[end] - points[start])
    return bool(np.abs(points[inner] - line).max() <= tolerance)


def _segments(times: Array, positions: Array) -> tuple[Array, Array]:
    stamps = np.asarray(times, dtype=np.float64)
    points = np.asarray(positions, dtype=np.float64)
    if len(stamps) < 2 or len(stamps) != len(points):
        raise ValueError("a trajectory needs at least two points, each with its time")
    periods = np.diff(stamps)
    if not (periods > 0).all():
        raise ValueError("times must increase")
    return periods, np.diff(points, axis=0)


def _demand(periods: Array, deltas: Array, speed: Array, acceleration: Array) -> LimitUsage:
    rates = deltas / periods[:, None]
    shares = np.max(np.abs(rates) / speed, axis=1)
    mean = (periods[1:] + periods[:-1]) / 2
    inner = np.abs(np.diff(rates, axis=0)) / mean[:, None]
    # From rest within a segment of time T over a distance D: T = D/v + v/(2a), so that a >= 2 D /
    # T^2 is the minimum; with both ends at rest, 4 D / T^2.
    ramps = 4 if len(deltas) == 1 else 2
    first = ramps * np.abs(deltas[0]) / periods[0] ** 2
    final = ramps * np.abs(deltas[-1]) / periods[-1] ** 2
    accelerations = np.concatenate((first[None], inner, final[None]))
    return LimitUsage(shares, np.max(accelerations / acceleration, axis=1))
