"""A path in time of all joints, and its ranges over intervals.

Between two knots the joint values lie within `slack` of the straight line from knot to knot: 0 for
trajectories, which are linear there; for samples of a curve the bound of its sagitta. A position on
the path is a real number u: knot floor(u), and the fraction of the segment after it.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rapidgen.collision.shapes import Array, Indices

_SAGITTA_FACTOR = 2.0
"""The bound of the sagitta, over that of the largest second difference of three segments."""


@dataclass(frozen=True, eq=False)
class Path:
    """Knots: `times` (n,) s, `values` (n, columns) rad or m, `slack` (n - 1, columns)."""

    times: Array
    values: Array
    slack: Array

    @classmethod
    def linear(cls, times: Array, values: Array) -> "Path":
        """Return a path that is linear in the joints between its knots; n is at least 1."""
        if len(times) == 1:
            times, values = np.repeat(times, 2), np.repeat(values, 2, axis=0)
        return cls(times, values, np.zeros((len(times) - 1, values.shape[1])))

    @classmethod
    def cornered(cls, times: Array, values: Array, shares: Array) -> "Path":
        """Return a path whose points (n, columns) are corners.

        `shares` (n - 1,) is the part of each segment that a corner may take at each of its ends, 0
        to 0.5. A curve from A to B inside the triangle with the corner P is at most |A + B - 2 P| /
        2 away from the legs, in each joint; and at most |A - P| away from the leg to B, which is
        less where the leg to A is short.
        """
        if len(times) < 3:
            return cls.linear(times, values)
        step = np.diff(values, axis=0)
        share = np.clip(shares, 1e-6, 0.5)[:, None]
        bend = np.zeros_like(values)
        to_b, from_a = step[1:] * share[1:], step[:-1] * share[:-1]
        bounds = np.abs(np.stack([(to_b - from_a) / 2, from_a, to_b]))
        least = bounds.sum(axis=2).argmin(axis=0)
        bend[1:-1] = bounds[least, np.arange(len(least))]
        # Three segments for each leg: corner, straight, corner.
        knots = [values[:-1], values[:-1] + share * step, values[1:] - share * step]
        places = np.stack(knots, axis=1).reshape(-1, values.shape[1])
        span = np.diff(times)
        moments = [times[:-1], times[:-1] + share[:, 0] * span, times[1:] - share[:, 0] * span]
        slack = np.stack([bend[:-1], np.zeros_like(step), bend[1:]], axis=1)
        return cls(
            np.append(np.stack(moments, axis=1).ravel(), times[-1]),
            np.concatenate([places, values[-1:]]),
            slack.reshape(-1, values.shape[1]),
        )

    @classmethod
    def sampled(cls, times: Array, values: Array) -> "Path":
        """Return a path through samples of a curve, taken densely.

        A curve deviates from its chord by at most a h^2 / 8. The second difference of samples is
        a h^2 for evenly spaced ones; neighbours and a factor of 2 cover jumps of the acceleration.
        """
        path = cls.linear(times, values)
        if len(path.times) < 3:
            return path
        h = np.diff(path.times)
        rates = np.diff(path.values, axis=0) / np.maximum(h, 1e-9)[:, None]
        bend = np.abs(np.diff(rates, axis=0))
        padded = np.concatenate([bend[:1], bend, bend[-1:]])
        around = np.maximum(padded[:-1], padded[1:])
        slack = _SAGITTA_FACTOR * around * h[:, None] / 8
        return cls(path.times, path.values, slack)

    @cached_property
    def finest(self) -> float:
        """Return the length of intervals that are not worth halving: their slack dominates."""
        return 1 / 16 if self.slack.any() else 0.0

    @property
    def last(self) -> int:
        """Return the number of the last knot."""
        return len(self.times) - 1

    def at(self, u: Array) -> Array:
        """Return the joint values (m, columns) at positions (m,)."""
        index = np.clip(u.astype(np.intp), 0, self.last - 1)
        share = (u - index)[:, None]
        result: Array = (1 - share) * self.values[index] + share * self.values[index + 1]
        return result

    def time(self, u: float) -> float:
        """Return the time at a position."""
        return float(np.interp(u, np.arange(self.last + 1), self.times))

    def position(self, time: float) -> float:
        """Return the position at a time."""
        return float(np.interp(time, self.times, np.arange(self.last + 1)))

    def pieces(self, spread: float) -> Array:
        """Return positions from the first to the last knot, whole numbers.

        Between two of them the joints move by about `spread` rad or m in all, or by one segment.
        """
        way = np.concatenate([[0.0], np.abs(np.diff(self.values, axis=0)).sum(axis=1).cumsum()])
        step = np.floor(way / spread)
        inner = np.flatnonzero(np.diff(step) > 0) + 1
        return np.unique(np.concatenate([[0.0], inner, [float(self.last)]]))

    def ranges(self, ua: Array, ub: Array, um: Array) -> tuple[Array, Array, Array, Array]:
        """Return values at `um`, and how far the path goes from there between `ua` and `ub`.

        Four arrays (m, columns): q, delta, line, rest. Every value of an interval is within delta
        of q, and is q + s line + r with s from -1 to 1 and |r| <= rest.
        """
        q = self.at(um)
        first = np.floor(ua).astype(np.intp) + 1
        stop = np.ceil(ub).astype(np.intp)
        inner = np.maximum(stop - first, 0)
        sizes = inner + 2
        starts = np.concatenate([[0], np.cumsum(sizes)[:-1]])
        owner = np.repeat(np.arange(len(ua)), sizes)
        place = np.arange(int(sizes.sum())) - starts[owner]
        u = first[owner] + place - 1.0
        u[starts] = ua
        u[starts + sizes - 1] = ub
        away = self.at(u) - q[owner]
        slack = self._slack(np.floor(ua).astype(np.intp), np.maximum(stop, 1))
        delta = np.maximum.reduceat(np.abs(away), starts) + slack
        chord = away[starts + sizes - 1] - away[starts]
        length = np.linalg.norm(chord, axis=1)[:, None]
        way = chord / np.where(length > 0, length, 1.0)
        along = np.einsum("ni,ni->n", away, way[owner])
        reach = np.maximum.reduceat(np.abs(along), starts)
        aside = np.abs(away - along[:, None] * way[owner])
        rest = np.maximum.reduceat(aside, starts) + slack
        return q, delta, reach[:, None] * way, rest

    def _slack(self, first: Indices, stop: Indices) -> Array:
        """Return the largest slack of the segments from `first` to before `stop`."""
        if not self.slack.any():
            return np.zeros((len(first), self.values.shape[1]))
        padded = np.concatenate([self.slack, np.zeros_like(self.slack[:1])])
        bounds = np.stack([first, np.maximum(stop, first + 1)], axis=1).ravel()
        result: Array = np.maximum.reduceat(padded, bounds)[::2]
        return result
