"""Proof that two robots keep their clearance if one is early or late.

Robots that do not share a clock follow their paths with a time shift: one is at time t of its path
while the other is at t + s. A pair of their bodies is proved for all times and all shifts up to a
tolerance, on rectangles of times (t, u) with the bounds of `bounds`: the joints of each robot move
within its own side. A rectangle that is not proved is cut across its longer motion. The
rectangles with the least shift come first, so that a violation has nearly the least shift at which
there is one.

Synchronised movement (SyncMoveOn to SyncMoveOff) shares one clock: nothing to prove, and no robot
is before it while another is after it. The intervals between are proved each on its own.
"""

import heapq
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import TypeAlias

import numpy as np

from rapidgen.collision.bounds import Bounds, Motion
from rapidgen.collision.path import Path
from rapidgen.collision.proof import TOLERANCE, Verdict
from rapidgen.collision.scene import Pair, Scene
from rapidgen.collision.shapes import Array, Indices

LEAST_TOLERANCE, SHARE = 1.0, 0.1
"""s, and share of an interval without a common clock: the larger one is the default tolerance."""
Together: TypeAlias = tuple[float, float, frozenset[str]]
"""Start and end, s, of an interval in which robots share a clock, and their names."""
_BATCH = 256
_MOST = 200_000
"""Rectangles for the tolerance; what is left then is not proved."""
_MOST_FOR_ANY = 20_000
"""Rectangles for the proof of any timing, which is only tried."""
_SHORTEST = 1e-4
"""s: shorter sides are not cut."""
_FINE_SHIFT = 0.02
"""s: precision of the least shift of a violation."""


@dataclass(frozen=True, slots=True)
class ShiftViolation:
    """A pair of bodies of two robots that does not keep its clearance at two different times.

    `times` are those of the first and the second body on their paths, s. `distance` and `point` are
    as in `Violation`.
    """

    pair: int
    verdict: Verdict
    times: tuple[float, float]
    distance: float
    point: tuple[float, float, float]

    @property
    def shift(self) -> float:
        """Return the time between both, s."""
        return abs(self.times[0] - self.times[1])


@dataclass(frozen=True, slots=True)
class Timing:
    """Result for two robots, by the names of their groups.

    `proved` is the shift in s up to which all clearances are proved, infinite for any timing;
    `tolerance` the one that was asked for.
    """

    robots: tuple[str, str]
    proved: float
    tolerance: float
    violations: tuple[ShiftViolation, ...] = ()
    rectangles: int = 0


def prove_timing(
    path: Path,
    scene: Scene,
    columns: Mapping[str, slice],
    tolerance: float | None = None,
    common: Sequence[Together] = (),
    known: frozenset[int] = frozenset(),
) -> tuple[Timing, ...]:
    """Check all pairs of bodies of two robots for shifts of time.

    `columns` are those of each robot's joints. `tolerance` in s; None: 1 s, or 10 % of an interval
    without a common clock. `common` are intervals with one. `known` are pairs of bodies that
    touch or come too near without a shift: they are left out, since the proof on one clock reports
    them. Robots that stand still, or share no pair of bodies, have no result.
    """
    movers = _movers(scene, columns)
    moving = np.ptp(path.values, axis=0) > 0
    result = []
    for one, other in combinations(columns, 2):
        if not (moving[columns[one]].any() and moving[columns[other]].any()):
            continue
        bodies = [
            {movers[pair.first], movers[pair.second]} == {one, other} and number not in known
            for number, pair in enumerate(scene.pairs)
        ]
        pairs = np.flatnonzero(np.array(bodies, dtype=np.bool_)[scene.pair_of])
        if len(pairs):
            of_first = frozenset(i for i, mover in enumerate(movers) if mover == one)
            search = _Search(path, scene, (columns[one], columns[other]), pairs, of_first)
            shared = [(start, end) for start, end, names in common if {one, other} <= names]
            result.append(_timing(search, (one, other), tolerance, shared))
    return tuple(result)


def _movers(scene: Scene, columns: Mapping[str, slice]) -> list[str]:
    """Return the robot that moves each body; empty if there is none, or more than one."""
    result = []
    for body in scene.bodies:
        own = np.abs(scene.tree.mix[scene.tree.ancestors[body.node]]).sum(axis=0) > 0
        names = [name for name, part in columns.items() if own[part].any()]
        result.append(names[0] if len(names) == 1 else "")
    return result


def _timing(
    search: "_Search",
    robots: tuple[str, str],
    tolerance: float | None,
    common: Sequence[tuple[float, float]],
) -> Timing:
    gaps = list(_gaps(search.path, common))
    wanted = [
        max(LEAST_TOLERANCE, SHARE * (end - start)) if tolerance is None else tolerance
        for start, end in gaps
    ]
    proved = np.inf
    for (start, end), limit in zip(gaps, wanted, strict=True):
        proved = min(proved, search.run(start, end, limit, _MOST))
    found = {**search.doubts, **search.hits}
    near = [number for number, hit in found.items() if hit.distance > 0]
    if near:
        later = search.touching(near)
        for (start, end), limit in zip(gaps, wanted, strict=True):
            later.run(start, end, limit, _MOST)
        found.update(later.hits)
    asked = max(wanted, default=0.0)
    if found:
        ordered = tuple(sorted(found.values(), key=lambda hit: hit.shift))
        return Timing(robots, proved, asked, ordered, search.count)
    trial = search.fresh()
    if all(np.isinf(trial.run(start, end, np.inf, _MOST_FOR_ANY)) for start, end in gaps):
        return Timing(robots, np.inf, asked, (), search.count + trial.count)
    return Timing(robots, min(wanted, default=np.inf), asked, (), search.count + trial.count)


def _gaps(path: Path, common: Sequence[tuple[float, float]]) -> Iterator[tuple[float, float]]:
    """Yield the intervals without a common clock."""
    since, last = float(path.times[0]), float(path.times[-1])
    for start, end in sorted(common):
        if start > since:
            yield since, start
        since = max(since, end)
    if last > since:
        yield since, last


@dataclass(frozen=True, slots=True, eq=False)
class _Rectangle:
    """Times t of the first robot and u of the second, s, with the pairs (n,) to prove in it."""

    t: tuple[float, float]
    u: tuple[float, float]
    pairs: Indices

    @property
    def least(self) -> float:
        """Return the least shift in it."""
        return max(0.0, self.t[0] - self.u[1], self.u[0] - self.t[1])


class _Search:
    """Search for violations of pairs of shapes of two robots; `hits` are by pair of bodies."""

    def __init__(
        self,
        path: Path,
        scene: Scene,
        columns: tuple[slice, slice],
        pairs: Indices,
        of_first: frozenset[int],
    ) -> None:
        """`of_first` are the bodies of the first robot."""
        self.path, self._scene = path, scene
        self._columns, self._pairs, self._of_first = columns, pairs, of_first
        self.hits: dict[int, ShiftViolation] = {}
        self.doubts: dict[int, ShiftViolation] = {}
        """Violations that are not proved."""
        self.count = 0

    def fresh(self) -> "_Search":
        """Return a search for the same pairs without results."""
        return _Search(self.path, self._scene, self._columns, self._pairs, self._of_first)

    def touching(self, numbers: Sequence[int]) -> "_Search":
        """Return a search for contacts of pairs of bodies."""
        chosen = set(numbers)
        pairs = self._pairs[[int(p) in chosen for p in self._scene.pair_of[self._pairs]]]
        scene = self._scene.with_pairs(
            [Pair(pair.first, pair.second, 0.0) for pair in self._scene.pairs]
        )
        return _Search(self.path, scene, self._columns, pairs, self._of_first)

    def run(self, start: float, end: float, limit: float, most: int) -> float:
        """Search an interval of time for shifts up to `limit`.

        Returns the shift up to which all pairs are proved: infinite if there is no violation.
        """
        least: dict[int, float] = {}
        proved = np.inf
        waiting: list[tuple[float, int, _Rectangle]] = []
        number = 0

        def add(rectangle: _Rectangle) -> None:
            nonlocal number
            made = _within(rectangle, limit)
            if made is not None:
                number += 1
                heapq.heappush(waiting, (made.least, number, made))

        add(_Rectangle((start, end), (start, end), self._pairs))
        spent = 0
        while waiting:
            taken: list[_Rectangle] = []
            while waiting and len(taken) < _BATCH:
                shift, _, rectangle = heapq.heappop(waiting)
                own = self._scene.pair_of[rectangle.pairs]
                keep = np.array([least.get(int(p), np.inf) > shift for p in own], dtype=np.bool_)
                if keep.any():
                    taken.append(_Rectangle(rectangle.t, rectangle.u, rectangle.pairs[keep]))
            if not taken:
                break
            spent += len(taken)
            halves, refuted = self._step(taken, least, is_over=spent > most)
            proved = min(proved, refuted)
            for rectangle in halves:
                add(rectangle)
        self.count += spent
        return min(proved, *least.values(), np.inf)

    def _step(
        self, taken: Sequence[_Rectangle], least: dict[int, float], *, is_over: bool
    ) -> tuple[list[_Rectangle], float]:
        """Prove rectangles; record violations.

        Returns the halves of what is open, and the least shift in rectangles that are not cut
        again.
        """
        t = np.array([rectangle.t for rectangle in taken])
        u = np.array([rectangle.u for rectangle in taken])
        motion, reach = self._motion(t, u)
        rows = np.repeat(np.arange(len(taken)), [len(r.pairs) for r in taken])
        pairs = np.concatenate([r.pairs for r in taken])
        bounds = Bounds(self._scene, motion, rows, pairs, independent=True)
        rows = bounds.rows
        is_short = np.maximum(np.ptp(t, axis=1), np.ptp(u, axis=1)) < _SHORTEST
        is_last = (bounds.loss < TOLERANCE) | (is_short | self._is_fine(t, u))[rows] | is_over
        cut = bounds.is_open & ~is_last
        refuted = np.inf
        for row in np.flatnonzero(bounds.is_open & (is_last | bounds.is_near)).tolist():
            rectangle = taken[rows[row]]
            number = int(self._scene.pair_of[bounds.pairs[row]])
            hit = self._hit(number, bounds, row, rectangle, reach[:, rows[row]])
            if bounds.is_near[row]:
                if hit.shift < least.get(number, np.inf):
                    least[number] = hit.shift
                    self.hits[number] = hit
            elif number not in self.doubts or hit.shift < self.doubts[number].shift:
                self.doubts[number] = hit
            if is_last[row] or hit.shift - rectangle.least < _FINE_SHIFT:
                refuted = min(refuted, rectangle.least)
                cut[row] = False
        left = np.flatnonzero(cut)
        halves: list[_Rectangle] = []
        for index in np.unique(rows[left]).tolist():
            own = bounds.pairs[left[rows[left] == index]]
            is_first = bool(reach[0, index] >= reach[1, index])
            halves += _halves(taken[index], own, first=is_first)
        return halves, refuted

    def _positions(self, times: Array) -> Array:
        path = self.path
        result: Array = np.interp(times, path.times, np.arange(path.last + 1.0))
        return result

    def _motion(self, t: Array, u: Array) -> tuple[Motion, Array]:
        """Return the motion in rectangles, and how far (2, m) each robot moves in them."""
        first, second = (
            self.path.ranges(*(self._positions(row) for row in (*side.T, side.mean(axis=1))))
            for side in (t, u)
        )
        own, others = self._columns
        for values, other in zip(first, second, strict=True):
            values[:, others] = other[:, others]
        delta = first[1]
        return first, np.stack([delta[:, own].sum(axis=1), delta[:, others].sum(axis=1)])

    def _is_fine(self, t: Array, u: Array) -> Array:
        """Return True (m,) where the slack of the path dominates both sides."""
        widths = [np.ptp(self._positions(side), axis=1) for side in (t, u)]
        result: Array = np.maximum(*widths) <= self.path.finest
        return result

    def _hit(
        self, number: int, bounds: Bounds, row: int, rectangle: _Rectangle, reach: Array
    ) -> ShiftViolation:
        far = float(bounds.far[row])
        verdict: Verdict = "contact" if far <= 0 else "too near"
        if not bounds.is_near[row]:
            verdict = "not proved"
        (t0, t1), (u0, u1) = rectangle.t, rectangle.u
        t, u = (t0 + t1) / 2, (u0 + u1) / 2
        # A robot that stands still is there at the other's time, too.
        if reach[0] == 0:
            t = min(max(u, t0), t1)
        elif reach[1] == 0:
            u = min(max(t, u0), u1)
        times = (t, u) if self._scene.pairs[number].first in self._of_first else (u, t)
        x, y, z = ((bounds.on_first[row] + bounds.on_second[row]) / 2).tolist()
        return ShiftViolation(number, verdict, times, far, (x, y, z))


def _within(rectangle: _Rectangle, limit: float) -> _Rectangle | None:
    """Return the box around the part of a rectangle with shifts up to a limit.

    The middle of this box has such a shift, too.
    """
    (t0, t1), (u0, u1) = rectangle.t, rectangle.u
    t0, t1 = max(t0, u0 - limit), min(t1, u1 + limit)
    u0, u1 = max(u0, t0 - limit), min(u1, t1 + limit)
    if t0 > t1 or u0 > u1:
        return None
    return _Rectangle((t0, t1), (u0, u1), rectangle.pairs)


def _halves(rectangle: _Rectangle, pairs: Indices, *, first: bool) -> Iterator[_Rectangle]:
    """Yield the halves of a rectangle, cut across the first or the second side."""
    t, u = rectangle.t, rectangle.u
    if first:
        middle = (t[0] + t[1]) / 2
        yield _Rectangle((t[0], middle), u, pairs)
        yield _Rectangle((middle, t[1]), u, pairs)
    else:
        middle = (u[0] + u[1]) / 2
        yield _Rectangle(t, (u[0], middle), pairs)
        yield _Rectangle(t, (middle, u[1]), pairs)
