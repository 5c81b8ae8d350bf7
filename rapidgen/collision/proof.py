"""Proof that a path keeps its clearances between samples, too.

For an interval of the path with a posture q in it, joint k moves by at most delta_k. Moving joints
from the last to the first, each one turns the body about its axis at q: a point at the distance r_k
from that axis, already displaced by D, moves by at most delta_k (r_k + D). The sum of these over
the joints that move only one body of a pair bounds the loss of distance. A pair is proved for the
interval if its distance at q exceeds the bound and the clearance.

This bound is wasteful where a body glides along another. There a plane with the contact's normal n
separates both: to first order a point v moves along n by s L(v), with the same s from -1 to 1 for
all joints of a straight segment and L linear in v. The least gap over s is at s = -1 or 1, and is a
support function of the shapes. Terms of second order, and the deviation of the joints from a
straight line, are added as lengths.

Intervals that are not proved are halved, the earliest first, and only with the pairs that need it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

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
        queries += len(step.kept)
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


class _Step:
    """Distances and bounds of one batch.

    `kept` are the rows of the batch that bounding spheres do not prove.
    """

    def __init__(self, path: Path, scene: Scene, batch: _Batch) -> None:
        self._path, self._scene = path, scene
        self._batch = batch
        self._middle = _middles(batch)
        q, delta, line, rest = path.ranges(batch.start, batch.end, self._middle)
        mix = scene.tree.mix
        self._delta, self._line = delta @ np.abs(mix).T, line @ mix.T
        self._rest = rest @ np.abs(mix).T
        rotations, positions, self._axes = scene.tree.poses(q)
        self._origins = positions
        self._rotation, self._position = scene.places(rotations, positions)
        self._levers = self._lengths()
        rows, pairs = batch.interval, batch.pair
        loss, second, aside = self._losses(rows, pairs)
        gap = scene.sphere_gaps(pairs, rows, self._rotation, self._position)
        kept = np.flatnonzero(gap <= loss + scene.clearance[pairs])
        self.kept = kept
        rows, pairs = rows[kept], pairs[kept]
        self._rows, self._pairs = rows, pairs
        self._loss = loss[kept]
        self._far, self._on_first, self._on_second = scene.distances(
            pairs, rows, self._rotation, self._position
        )
        clearance = scene.clearance[pairs]
        self._open = self._far <= self._loss + clearance
        self.is_near = self._far <= clearance
        gliding = np.flatnonzero(self._open & ~self.is_near & (self._far > 1e-9))
        if len(gliding):
            least = self._gaps(gliding) - second[kept][gliding] - aside[kept][gliding]
            self._open[gliding] = least <= clearance[gliding]

    def _lengths(self) -> Array:
        """Return the levers (m, s, k): distance of each core from each axis."""
        table, count = self._scene.table, len(self._scene.tree.nodes)
        moving = np.flatnonzero(self._scene.node_of >= 0)
        levers = np.zeros((len(self._middle), len(table.shapes), count))
        corners = self._position[:, moving, None, :] + np.einsum(
            "msij,scj->msci", self._rotation[:, moving], table.corners[moving]
        )
        for k in np.flatnonzero(~self._scene.tree.slides).tolist():
            away = corners - self._origins[:, None, None, k, :]
            along = np.einsum("msci,mi->msc", away, self._axes[:, k])
            square = np.einsum("msci,msci->msc", away, away) - along * along
            far = np.sqrt(np.maximum(square.max(axis=2), 0.0))
            levers[:, moving, k] = far + table.around[moving]
        return levers

    def _losses(self, rows: Indices, pairs: Indices) -> tuple[Array, Array, Array]:
        """Return bounds (n,): of the whole motion, of its second order, off the straight line."""
        total = np.zeros(len(rows))
        second, aside = np.zeros(len(rows)), np.zeros(len(rows))
        scene = self._scene
        for shapes, relation in zip((scene.first, scene.second), scene.relations, strict=True):
            index = shapes[pairs]
            moved = np.zeros(len(rows))
            for k in range(len(scene.tree.nodes) - 1, -1, -1):
                weight = relation[pairs, k]
                if not weight.any():
                    continue
                turn = self._delta[rows, k] * weight
                off = self._rest[rows, k] * weight
                if scene.tree.slides[k]:
                    moved += turn
                    aside += off
                    continue
                lever = self._levers[rows, index, k]
                aside += off * lever
                second += turn * moved + turn * turn / 2 * (lever + moved)
                moved += turn * (lever + moved)
            total += moved
        return total, second, aside

    def _gaps(self, chosen: Indices) -> Array:
        """Return the least first-order gap (n,) along the normals of nearest points."""
        scene, rows, pairs = self._scene, self._rows[chosen], self._pairs[chosen]
        n = (self._on_first[chosen] - self._on_second[chosen]) / self._far[chosen, None]
        sides = []
        for shapes, relation in zip((scene.first, scene.second), scene.relations, strict=True):
            ways, shift = np.zeros((len(rows), 3)), np.zeros(len(rows))
            for k in range(len(scene.tree.nodes)):
                turn = self._line[rows, k] * relation[pairs, k]
                axis = self._axes[rows, k]
                if scene.tree.slides[k]:
                    shift += turn * np.einsum("ni,ni->n", n, axis)
                    continue
                across = turn[:, None] * np.cross(n, axis)
                ways += across
                shift -= np.einsum("ni,ni->n", across, self._origins[rows, k])
            sides.append((shapes[pairs], ways, shift))
        result = np.full(len(rows), np.inf)
        for sign in (1.0, -1.0):
            low, high = (
                scene.table.lowest(
                    index,
                    self._rotation[rows, index],
                    self._position[rows, index],
                    turn * (n + sign * ways),
                )
                + turn * sign * shift
                for turn, (index, ways, shift) in zip((1.0, -1.0), sides, strict=True)
            )
            result = np.minimum(result, low + high)
        index_a, index_b = sides[0][0], sides[1][0]
        balls: Array = scene.table.radius[index_a] + scene.table.radius[index_b]
        return result - balls

    def is_last(self, tolerance: float) -> NDArray[np.bool_]:
        """Return True (n,) for intervals that are not halved."""
        width = (self._batch.end - self._batch.start)[self._rows]
        result: NDArray[np.bool_] = (self._loss < tolerance) | (width <= self._path.finest)
        return result

    def record(
        self, hits: dict[int, _Hit], first: Array, ends: NDArray[np.bool_], tolerance: float
    ) -> None:
        """Keep the earliest violation of each pair of bodies, of the open rows in `ends`."""
        scene, batch = self._scene, self._batch
        for row in np.flatnonzero(ends & self._open).tolist():
            number = int(scene.pair_of[self._pairs[row]])
            interval = self._rows[row]
            # A short interval is within the tolerance of its middle as a whole.
            place = batch.start if self._loss[row] < tolerance else self._middle
            position = float(place[interval])
            known = hits.get(number)
            far = float(self._far[row])
            if known is not None and (known.position, known.distance) <= (position, far):
                continue
            first[number] = min(first[number], position)
            way = self._on_first[row] - self._on_second[row]
            size = float(np.linalg.norm(way))
            normal = way / size * np.sign(far or 1.0) if size > 0 else np.zeros(3)
            pair = int(self._pairs[row])
            a, b = int(scene.first[pair]), int(scene.second[pair])
            if scene.body_of[a] != scene.pairs[number].first:
                a, b, normal = b, a, -normal
            hits[number] = _Hit(
                position,
                far,
                (self._on_first[row] + self._on_second[row]) / 2,
                normal,
                (a, b),
                bool(self.is_near[row]),
                float(batch.end[interval] - batch.start[interval]),
            )

    def children(self, halved: NDArray[np.bool_], first: Array) -> _Batch:
        """Return the halves of intervals with the pairs that are still open in them."""
        open_rows = np.flatnonzero(self._open & halved)
        interval, pair = self._rows[open_rows], self._pairs[open_rows]
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
