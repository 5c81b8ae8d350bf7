"""Proof that a path keeps its clearances between samples, too.

`bounds` has the method. Intervals that are not proved are halved, the earliest first, and only with
the pairs that need it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from rapidgen.collision.bounds import Bounds
from rapidgen.collision.path import Path
from rapidgen.collision.scene import Pair, Scene
from rapidgen.collision.shapes import Array, Indices

TOLERANCE = 2e-4
"""m: bounds of motion below this are not halved again; the result is "not proved"."""
_PIECE = 0.6
"""rad or m, summed over the joints: length of the first intervals."""
_AHEAD = 64
"""Postures after one that is not proved, in which the pair may become too near."""
_BATCH = 256
"""Intervals of one step, the earliest first."""
MOST_POSTURES = 400_000
"""Postures of a proof; what is left then is not proved."""
Verdict: TypeAlias = Literal["contact", "too near", "not proved"]


@dataclass(frozen=True, slots=True)
class Violation:
    """The first place where a pair of bodies does not keep its clearance.

    `position` is that of the path (see `Path`), `distance` in m at that posture, negative inside;
    `point` is between the nearest points, `normal` points from the second body to the first.
    """

    pair: int
    verdict: Verdict
    time: float
    position: float
    distance: float
    point: tuple[float, float, float]
    normal: tuple[float, float, float]
    shapes: tuple[int, int]


@dataclass(frozen=True, slots=True)
class Proof:
    """Result of `prove`: violations by time; none means that all clearances are proved."""

    violations: tuple[Violation, ...]
    postures: int
    queries: int
    """Distances computed."""

    @property
    def is_free(self) -> bool:
        """True if every pair keeps its clearance."""
        return not self.violations


@dataclass(slots=True, eq=False)
class _Hit:
    position: float
    distance: float
    point: Array
    normal: Array
    shapes: tuple[int, int]
    is_proved: bool
    width: float
    """Length of its interval."""


@dataclass(frozen=True, slots=True, eq=False)
class _Batch:
    """Intervals (m,) with the pairs (n,) to prove in them."""

    start: Array
    end: Array
    interval: Indices
    pair: Indices


def prove(path: Path, scene: Scene, tolerance: float = TOLERANCE) -> Proof:
    """Check all pairs of a scene along a path.

    Returns the first violation of each pair of bodies: a contact if it touches anywhere, else the
    first place that is too near or not proved. Raises ModuleNotFoundError for hulls without coal.
    """
    hits, postures, queries = _search(path, scene, tolerance, touching=False)
    for pair, hit in hits.items():
        if not hit.is_proved:
            _look_ahead(path, scene, pair, hit)
    near = [pair for pair, hit in hits.items() if hit.distance > 0]
    if near:
        # Such a pair may touch later.
        chosen = [Pair(p.first, p.second, 0.0) for p in (scene.pairs[i] for i in near)]
        later, more, asked = _search(path, scene.with_pairs(chosen), tolerance, touching=True)
        hits.update({near[i]: hit for i, hit in later.items()})
        postures, queries = postures + more, queries + asked
    violations = [_violation(path, pair, hit) for pair, hit in hits.items()]
    return Proof(tuple(sorted(violations, key=lambda v: v.time)), postures, queries)


def _look_ahead(path: Path, scene: Scene, pair: int, hit: "_Hit") -> None:
    """Mark a hit as too near if the pair is so within the next postures.

    A body that approaches is not proved in the interval before it is too near.
    """
    u = np.minimum(hit.position + hit.width * np.arange(_AHEAD), path.last)
    far = scene.body_distances(path.at(u), [pair])[:, 0]
    near = np.flatnonzero(far <= scene.pairs[pair].clearance)
    if len(near):
        hit.position, hit.distance = float(u[near[0]]), float(far[near[0]])
        hit.is_proved = True


def _violation(path: Path, pair: int, hit: _Hit) -> Violation:
    verdict: Verdict = "contact" if hit.distance <= 0 else "too near"
    if hit.distance > 0 and not hit.is_proved:
        verdict = "not proved"
    x, y, z = hit.point.tolist()
    u, v, w = hit.normal.tolist()
    return Violation(
        pair,
        verdict,
        path.time(hit.position),
        hit.position,
        float(hit.distance),
        (x, y, z),
        (u, v, w),
        hit.shapes,
    )


def _search(
    path: Path, scene: Scene, tolerance: float, *, touching: bool
) -> tuple[dict[int, _Hit], int, int]:
    """Return the first hit of each pair, and the numbers of postures and queries.

    `touching`: only pairs below their clearance are hits, and intervals that are not proved end no
    search.
    """
    hits: dict[int, _Hit] = {}
    first = np.full(len(scene.pairs), np.inf)
    edges = path.pieces(_PIECE)
    count, all_pairs = len(edges) - 1, len(scene.first)
    everything = _Batch(
        edges[:-1],
        edges[1:],
        np.repeat(np.arange(count), all_pairs),
        np.tile(np.arange(all_pairs), count),
    )
    waiting = list(reversed(_split(everything)))
    postures = queries = 0
    while waiting:
        batch = _before(waiting.pop(), first[scene.pair_of])
        if not len(batch.interval):
            continue
        postures += len(batch.start)
        step = _Step(path, scene, batch)
        queries += len(step.rows)
        is_last = step.is_last(tolerance) | (postures > MOST_POSTURES)
        ends = step.is_near if touching else step.is_near | is_last
        step.record(hits, first, ends, tolerance)
        children = step.children(~is_last, first)
        if len(children.interval):
            waiting += reversed(_split(children))
    return hits, postures, queries


def _split(batch: _Batch) -> list[_Batch]:
    """Return batches of at most _BATCH intervals, in the order of time."""
    count = len(batch.start)
    if count <= _BATCH:
        return [batch]
    result = []
    order = np.argsort(batch.interval, kind="stable")
    interval, pair = batch.interval[order], batch.pair[order]
    for low in range(0, count, _BATCH):
        high = min(low + _BATCH, count)
        rows = slice(*np.searchsorted(interval, [low, high]).tolist())
        result.append(
            _Batch(batch.start[low:high], batch.end[low:high], interval[rows] - low, pair[rows])
        )
    return result


def _before(batch: _Batch, first: Array) -> _Batch:
    """Drop pairs in intervals after their first violation, and intervals without pairs."""
    keep = batch.start[batch.interval] < first[batch.pair]
    interval, pair = batch.interval[keep], batch.pair[keep]
    used, renumbered = np.unique(interval, return_inverse=True)
    return _Batch(batch.start[used], batch.end[used], renumbered.astype(np.intp), pair)


class _Step(Bounds):
    """Bounds of one batch."""

    def __init__(self, path: Path, scene: Scene, batch: _Batch) -> None:
        self._finest, self._batch, self._middle = path.finest, batch, _middles(batch)
        motion = path.ranges(batch.start, batch.end, self._middle)
        super().__init__(scene, motion, batch.interval, batch.pair)

    def is_last(self, tolerance: float) -> NDArray[np.bool_]:
        """Return True (n,) for intervals that are not halved."""
        width = (self._batch.end - self._batch.start)[self.rows]
        result: NDArray[np.bool_] = (self.loss < tolerance) | (width <= self._finest)
        return result

    def record(
        self, hits: dict[int, _Hit], first: Array, ends: NDArray[np.bool_], tolerance: float
    ) -> None:
        """Keep the earliest violation of each pair of bodies, of the open rows in `ends`."""
        scene, batch = self._scene, self._batch
        for row in np.flatnonzero(ends & self.is_open).tolist():
            number = int(scene.pair_of[self.pairs[row]])
            interval = self.rows[row]
            # A short interval is within the tolerance of its middle as a whole.
            place = batch.start if self.loss[row] < tolerance else self._middle
            position = float(place[interval])
            known = hits.get(number)
            far = float(self.far[row])
            if known is not None and (known.position, known.distance) <= (position, far):
                continue
            first[number] = min(first[number], position)
            way = self.on_first[row] - self.on_second[row]
            size = float(np.linalg.norm(way))
            normal = way / size * np.sign(far or 1.0) if size > 0 else np.zeros(3)
            pair = int(self.pairs[row])
            a, b = int(scene.first[pair]), int(scene.second[pair])
            if scene.body_of[a] != scene.pairs[number].first:
                a, b, normal = b, a, -normal
            hits[number] = _Hit(
                position,
                far,
                (self.on_first[row] + self.on_second[row]) / 2,
                normal,
                (a, b),
                bool(self.is_near[row]),
                float(batch.end[interval] - batch.start[interval]),
            )

    def children(self, halved: NDArray[np.bool_], first: Array) -> _Batch:
        """Return the halves of intervals with the pairs that are still open in them."""
        open_rows = np.flatnonzero(self.is_open & halved)
        interval, pair = self.rows[open_rows], self.pairs[open_rows]
        used, renumbered = np.unique(interval, return_inverse=True)
        start, middle, end = (
            values[used] for values in (self._batch.start, self._middle, self._batch.end)
        )
        starts = np.stack([start, middle], axis=1).ravel()
        ends = np.stack([middle, end], axis=1).ravel()
        both = np.concatenate([renumbered * 2, renumbered * 2 + 1]).astype(np.intp)
        return _before(
            _Batch(starts, ends, both, np.concatenate([pair, pair])),
            first[self._scene.pair_of],
        )


def _middles(batch: _Batch) -> Array:
    """Return positions inside the intervals: a knot as long as there is one."""
    middle = (batch.start + batch.end) / 2
    knot = np.rint(middle)
    inside = (knot > batch.start) & (knot < batch.end)
    result: Array = np.where(inside, knot, middle)
    return result


def first_of(proofs: Sequence[Proof]) -> Violation | None:
    """Return the earliest violation of some proofs; a contact before others at one time."""
    found = [v for proof in proofs for v in proof.violations]
    return min(found, key=lambda v: (v.time, v.distance), default=None)
