"""Convex parts that cover a mesh: at most a given number, without an underestimate.

A part is a set of triangles, and its shape is their convex hull. A cut by a plane clips the
triangles, so that both halves still contain every point of the surface; the union of the hulls
therefore covers the whole surface.

The search uses the cells of a grid that are outside of the mesh and inside of its hull, each with
its distance from the mesh. The cost of a part is the sum of a high power of the distances of the
cells in its hull, which is near the largest distance and yet smooth. The mesh is cut into more
parts than wanted, always where a cut saves most; then the two parts whose common hull costs least
are joined, until the number is right. At the end, a part is cut and two others are joined as long
as that saves anything.

Cuts are compared with supports in fixed directions instead of hulls, which are slow: a cell is in a
hull if it is below the support in all of them. Only the best cuts get hulls.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from rapidgen.collision.fit_grid import Grid, grid_of
from rapidgen.collision.fit_measures import is_below, overestimate, underestimate
from rapidgen.collision.hulls import hull_planes, hull_triangles
from rapidgen.collision.shapes import Array, Indices

PARTS = 8
_OFFSETS = np.linspace(0.05, 0.95, 13)
"""Places of cuts, as shares of a part's extent."""
_FACES = 4
"""Directions of large faces of a part that cuts have, and faces of each that they go along."""
_PARALLEL = 0.999
"""Cosine of directions that count as one."""
_TRIED = 6
"""Cuts of which hulls are made."""
_SURPLUS = 2.5
"""Parts that a mesh is cut into, over those wanted."""
_ROUNDS = 12
"""Most attempts to cut a part and join others."""
_LEAST = 0.05
"""Least share of the cost that an attempt saves."""
_SAVED = 1e-6
"""Least saved share of the whole hull's cost for a further cut."""
_SLACK = 0.7
"""Cells by which hulls are enlarged in the search."""
_EVENNESS, _STEPWISE = 0.01, 0.5
"""Weights of the larger half's cost in the choice of a cut, usually and if several are needed."""
_POWER = 8
_GOOD = 0.25**_POWER
"""Cost of a cell, over the largest one of the hull, that is not worth an attempt."""
_RELEVANT = 0.15
"""Cells that are nearer to the mesh than this share of the largest distance do not count."""
_MOST_CELLS = 15_000


def _directions() -> Array:
    """Return the axes and diagonals of a cube, and evenly spread directions: (62, 3)."""
    cube = np.array(
        [
            [x, y, z]
            for x in (-1, 0, 1)
            for y in (-1, 0, 1)
            for z in (-1, 0, 1)
            if (x, y, z) != (0, 0, 0)
        ],
        dtype=np.float64,
    )
    z = np.linspace(-0.97, 0.97, 36)
    turn = np.arange(36) * np.pi * (3 - np.sqrt(5))
    spread = np.stack([np.sqrt(1 - z**2) * np.cos(turn), np.sqrt(1 - z**2) * np.sin(turn), z], 1)
    return np.concatenate([cube / np.linalg.norm(cube, axis=1)[:, None], spread])


_WAYS = _directions()


@dataclass(frozen=True, slots=True, eq=False)
class Fit:
    """Convex parts of a mesh, as vertices (n, 3), and how well they fit.

    `over` is the largest distance of a part's surface, outside of the mesh, from the mesh; `hull`
    is that of a single hull. `under` is the largest distance of the mesh from the union of the
    parts, in the mesh's unit.
    """

    parts: tuple[Array, ...]
    over: float
    hull: float
    under: float


@dataclass(frozen=True, slots=True, eq=False)
class _Part:
    """Triangles of a part, and points (n, 3) of their surface for the search.

    `corners` are those of the hull of the points, `cells` the indices of the cells in it, and
    `cost` is their cost.
    """

    triangles: Array
    points: Array
    corners: Array
    cells: Indices
    cost: float


@dataclass(frozen=True, slots=True, eq=False)
class _Cut:
    """A plane that cuts a part, and the estimated saving."""

    normal: Array
    offset: float
    saved: float


def fit_parts(triangles: Array, most: int = PARTS) -> Fit:
    """Return at most `most` convex parts that cover triangles (n, 3, 3).

    Raises ModuleNotFoundError without coal, ValueError for a mesh in one plane.
    """
    corners = triangles.reshape(-1, 3)
    if _is_flat(corners):
        raise ValueError("all points lie in one plane")
    grid = grid_of(triangles)
    whole = hull_triangles(corners)[0]
    parts = [triangles]
    if most > 1:
        search = _Search(grid, whole)
        parts = [part.triangles for part in search.parts(triangles, grid.points, most)]
    hulls = tuple(_solid(part) for part in parts)
    return Fit(
        hulls,
        overestimate(triangles, hulls, grid),
        overestimate(triangles, (whole,), grid),
        underestimate(triangles, hulls),
    )


class _Search:
    """Search for parts with the cells that matter: in the hull, and not near the mesh."""

    def __init__(self, grid: Grid, whole: Array) -> None:
        _, normal, offset = hull_planes(whole)
        # The points that stand for the surface are up to a cell inside of its hull.
        self._slack = _SLACK * grid.size
        cells = grid.outside[is_below(grid.outside[:, :3], normal, offset + self._slack)]
        top = float(cells[:, 3].max(initial=0.0))
        cells = cells[cells[:, 3] > _RELEVANT * top]
        if len(cells) > _MOST_CELLS:
            cells = np.random.default_rng(1).choice(cells, _MOST_CELLS, replace=False)
        self._places = cells[:, :3]
        self._costs = (cells[:, 3] / max(top, 1e-12)) ** _POWER
        self._heights = self._places @ _WAYS.T

    def parts(self, triangles: Array, points: Array, most: int) -> list[_Part]:
        """Return at most `most` parts of a mesh."""
        whole = self._part(triangles, points, points, np.arange(len(self._places)))
        parts = self._joined(self._cut_up(whole, round(_SURPLUS * most)), most)
        for _ in range(_ROUNDS):
            if max(float(self._costs[part.cells].max(initial=0.0)) for part in parts) < _GOOD:
                break
            tried = self._improved(parts, most)
            if tried is None:
                break
            parts = tried
        return parts

    def _improved(self, parts: list[_Part], most: int) -> list[_Part] | None:
        """Cut the worst part and join others; None if that saves nothing."""
        worst = max(parts, key=lambda part: part.cost)
        others = [part for part in parts if part is not worst]
        limit = _total(parts) * (1 - _LEAST)

        def joined(made: list[_Part]) -> list[_Part]:
            return self._joined([*others, *made], most)

        result = joined(self._cut_up(worst, 2))
        if _total(result) > limit:
            made = [*self._sectors(worst), self._cut_up(worst, most, is_stepwise=True)]
            result = min(map(joined, made), key=_total)
        return result if _total(result) <= limit else None

    def _part(self, triangles: Array, points: Array, outer: Array, among: Indices) -> _Part:
        """Return a part; `outer` are points with its hull, `among` cells that may be in it."""
        support = (outer @ _WAYS.T).max(axis=0) + self._slack
        heights = self._heights if len(among) == len(self._places) else self._heights[among]
        near = among[(heights <= support).all(axis=1)]
        if _is_flat(outer):
            # The hull of a flat ring covers its hole, too.
            outer = _thickened(outer, self._slack)
        corners, normal, offset = hull_planes(outer)
        if len(near):
            near = near[is_below(self._places[near], normal, offset + self._slack)]
        return _Part(triangles, points, corners, near, float(self._costs[near].sum()))

    def _cut_up(self, whole: _Part, count: int, *, is_stepwise: bool = False) -> list[_Part]:
        """Return at most `count` parts, cut where it saves most.

        `is_stepwise`: cuts that save nothing are made, too.
        """
        evenness = _STEPWISE if is_stepwise else _EVENNESS
        parts = [whole]
        halves = [self._halves(whole, evenness)]
        while len(parts) < count:
            saved = [
                _score((part,), evenness) - _score(cut, evenness) if cut is not None else -np.inf
                for part, cut in zip(parts, halves, strict=True)
            ]
            best = int(np.argmax(saved))
            chosen = halves[best]
            if chosen is None or (
                parts[best].cost - _total(chosen) <= _SAVED * whole.cost and not is_stepwise
            ):
                break
            parts[best : best + 1] = chosen
            halves[best : best + 1] = [self._halves(part, evenness) for part in chosen]
        return parts

    def _sectors(self, part: _Part) -> Iterator[list[_Part]]:
        """Yield four sectors of a part about axes through what it covers.

        A bore through a part needs all four cuts before they save anything.
        """
        middle = np.average(self._places[part.cells], axis=0, weights=self._costs[part.cells])
        principal = np.linalg.svd(part.points - part.points.mean(axis=0), full_matrices=False)[2]
        for axes in (np.eye(3), principal):
            for first, second in combinations(axes, 2):
                made = [part]
                for normal in (first, second):
                    cut = _Cut(normal, float(normal @ middle), 0.0)
                    made = [half for one in made for half in self._divided(one, cut) or (one,)]
                yield made

    def _joined(self, parts: Sequence[_Part], most: int) -> list[_Part]:
        """Return at most `most` parts: those whose common hull costs least are joined."""
        left, number = dict(enumerate(parts)), len(parts)
        known: dict[tuple[int, int], _Part] = {}
        everything = np.arange(len(self._places))
        limit = _SAVED * _total(parts)
        while len(left) > 1:
            for one, other in combinations(left, 2):
                if (one, other) not in known:
                    both = left[one], left[other]
                    known[one, other] = self._part(
                        np.concatenate([part.triangles for part in both]),
                        np.concatenate([part.points for part in both]),
                        np.concatenate([part.corners for part in both]),
                        everything,
                    )
            dearer, one, other = min(
                (known[pair].cost - left[pair[0]].cost - left[pair[1]].cost, *pair)
                for pair in combinations(left, 2)
            )
            if len(left) <= most and dearer > limit:
                break
            made = known[one, other]
            del left[one], left[other]
            left[number] = made
            number += 1
        return list(left.values())

    def _halves(self, part: _Part, evenness: float) -> tuple[_Part, _Part] | None:
        """Return the two parts of the best cut; None if there is no cut."""
        best: tuple[_Part, _Part] | None = None
        for cut in sorted(self._cuts(part, evenness), key=lambda cut: -cut.saved)[:_TRIED]:
            made = self._divided(part, cut)
            if made is None:
                continue
            low, high = made
            if best is None or _score((low, high), evenness) < _score(best, evenness):
                best = low, high
        return best

    def _divided(self, part: _Part, cut: _Cut) -> tuple[_Part, _Part] | None:
        """Return both sides of a cut; None if one is empty."""
        sides = _clip(part.triangles, cut.normal, cut.offset)
        along = part.points @ cut.normal
        points = part.points[along <= cut.offset], part.points[along >= cut.offset]
        if min(map(len, (*sides, *points))) == 0:
            return None
        low, high = (
            self._part(side, own, np.concatenate([own, _extremes(side)]), part.cells)
            for side, own in zip(sides, points, strict=True)
        )
        return low, high

    def _cuts(self, part: _Part, evenness: float) -> Iterator[_Cut]:
        """Yield cuts with their savings as supports tell them."""
        if part.cost <= 0 or len(part.points) < 8:
            return
        reach = part.points @ _WAYS.T + self._slack
        heights, costs = self._heights[part.cells], self._costs[part.cells]
        for normal, offsets in _planes(part):
            along = part.points @ normal
            order = np.argsort(along)
            counts = np.searchsorted(along[order], offsets)
            usable = (counts > 0) & (counts < len(along))
            up = np.maximum.accumulate(reach[order], axis=0)
            down = np.maximum.accumulate(reach[order][::-1], axis=0)[::-1]
            for offset, count in zip(
                offsets[usable].tolist(), counts[usable].tolist(), strict=True
            ):
                sides = [
                    float(costs[(heights <= support).all(axis=1)].sum())
                    for support in (up[count - 1], down[count])
                ]
                yield _Cut(normal, offset, part.cost - sum(sides) - evenness * max(sides))


def _score(parts: Sequence[_Part], evenness: float) -> float:
    """Return the total cost, and a share of the largest one: even cuts come before others."""
    return _total(parts) + evenness * max(part.cost for part in parts)


def _extremes(triangles: Array) -> Array:
    """Return the farthest corner of triangles in each direction.

    A thin slice of a mesh has few points of the grid, or none at its ends.
    """
    corners = triangles.reshape(-1, 3)
    result: Array = corners[(corners @ _WAYS.T).argmax(axis=0)]
    return result


def _total(parts: Sequence[_Part]) -> float:
    return sum(part.cost for part in parts)


def _planes(part: _Part) -> Iterator[tuple[Array, Array]]:
    """Yield normals and offsets of cuts: along axes, principal axes and large faces."""
    principal = np.linalg.svd(part.points - part.points.mean(axis=0), full_matrices=False)[2]
    edges = part.triangles[:, 1:] - part.triangles[:, :1]
    across = np.cross(edges[:, 0], edges[:, 1])
    area = np.linalg.norm(across, axis=1)
    faces = across[area > 0] / area[area > 0, None]
    area, places = area[area > 0], part.triangles[area > 0, 0]
    # Opposite faces have one direction.
    faces *= np.where(faces[:, [2]] + 1e-3 * faces[:, [1]] + 1e-6 * faces[:, [0]] < 0, -1.0, 1.0)
    kinds, which = np.unique(np.round(faces, 2), axis=0, return_inverse=True)
    sizes = np.bincount(which.ravel(), area, len(kinds))
    large = [kinds[i] / np.linalg.norm(kinds[i]) for i in np.argsort(-sizes)[:_FACES]]
    normals: list[Array] = []
    for normal in (*np.eye(3), *principal, *large):
        if any(abs(float(normal @ other)) > _PARALLEL for other in normals):
            continue
        normals.append(normal)
        along = part.points @ normal
        low, high = float(along.min()), float(along.max())
        parallel = np.abs(faces @ normal) > _PARALLEL
        levels, index = np.unique(
            np.round((places[parallel] @ normal - low) / max(high - low, 1e-12), 2),
            return_inverse=True,
        )
        own = np.bincount(index.ravel(), area[parallel], len(levels))
        shares = levels[np.argsort(-own)[:_FACES]]
        shares = np.concatenate([_OFFSETS, shares[(shares > 0.01) & (shares < 0.99)]])
        yield normal, low + shares * (high - low)


def _is_flat(points: Array) -> bool:
    """True if points lie in one plane."""
    if len(points) < 4:
        return True
    centred = points - points.mean(axis=0)
    spread = np.linalg.eigvalsh(centred.T @ centred)
    return bool(spread[0] <= 1e-12 * spread[2])


def _solid(triangles: Array) -> Array:
    """Return the hull's vertices; a flat part gets a thickness of a thousandth of its size."""
    points = triangles.reshape(-1, 3)
    if _is_flat(points):
        points = _thickened(points, max(1e-3 * float(np.ptp(points, axis=0).max()), 1e-6))
    return hull_triangles(points)[0]


def _thickened(points: Array, thick: float) -> Array:
    """Return points of one plane or line, moved to both sides of it."""
    centred = points - points.mean(axis=0)
    spread, axes = np.linalg.eigh(centred.T @ centred)
    for way in axes.T[spread <= 1e-12 * max(spread[2], 1e-30)]:
        points = np.concatenate([points + thick * way, points - thick * way])
    return points


def _clip(
    triangles: Array, normal: Array, offset: float, along: Array | None = None
) -> tuple[Array, Array]:
    """Return the triangles below and above a plane; those that cross it are cut."""
    height = (triangles @ normal if along is None else along) - offset
    below, above = (height <= 0).all(axis=1), (height >= 0).all(axis=1)
    crossing = ~(below | above)
    sides = [triangles[below & ~above], triangles[above]]
    cut, h = triangles[crossing], height[crossing]
    if len(cut):
        # Turn each triangle so that its lone corner comes first.
        negative = h < 0
        lone_is_negative = negative.sum(axis=1) == 1
        lone = np.where(lone_is_negative, negative.argmax(axis=1), (~negative).argmax(axis=1))
        order = (lone[:, None] + np.arange(3)) % 3
        a, b, c = np.moveaxis(np.take_along_axis(cut, order[..., None], axis=1), 1, 0)
        ha, hb, hc = np.take_along_axis(h, order, axis=1).T
        ab = a + (ha / (ha - hb))[:, None] * (b - a)
        ac = a + (ha / (ha - hc))[:, None] * (c - a)
        tips = np.stack([a, ab, ac], axis=1)
        rests = np.concatenate([np.stack([ab, b, c], axis=1), np.stack([ab, c, ac], axis=1)])
        twice = np.concatenate([lone_is_negative, lone_is_negative])
        sides[0] = np.concatenate([sides[0], tips[lone_is_negative], rests[~twice]])
        sides[1] = np.concatenate([sides[1], tips[~lone_is_negative], rests[twice]])
    return sides[0], sides[1]
