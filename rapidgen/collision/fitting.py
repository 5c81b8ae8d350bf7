"""Convex parts that cover a mesh: at most a given number, without an underestimate.

A part is a set of triangles, and its shape is their convex hull. A cut by a plane clips the
triangles, so that both halves still contain every point of the surface; the union of the hulls
therefore covers the whole surface.

The search for cuts uses the cells of a grid that are outside of the mesh and inside of its hull,
each with its distance from the mesh. The cost of a part is the sum of the fourth powers of the
distances of the cells in its hull, which is near the largest distance and yet smooth. The part
whose best cut saves most is cut next.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rapidgen.collision.hulls import hull_triangles, hull_volume
from rapidgen.collision.shapes import Array

PARTS = 8
_OFFSETS = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9)
"""Places of cuts, as shares of a part's extent."""
_SAVED = 1e-3
"""Least saved share of the whole hull's cost for a further cut."""
_CELLS = 48
"""Cells along the longest side of a mesh."""
_POWER = 4
_SAMPLES = 4000
"""Points on the surface of a mesh, and of its parts."""
_CHUNK = 400


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


def fit_parts(triangles: Array, most: int = PARTS) -> Fit:
    """Return at most `most` convex parts that cover triangles (n, 3, 3).

    Raises ModuleNotFoundError without coal, ValueError for a mesh in one plane.
    """
    if _volume(_thinned(triangles.reshape(-1, 3))) <= 0:
        raise ValueError("all points lie in one plane")
    whole = hull_triangles(triangles.reshape(-1, 3))[0]
    grid = _grid_of(triangles)
    outside = grid.outside
    total = _cost(whole, outside)[0]
    parts = [triangles]
    cuts = [_best_cut(triangles, outside)]
    while len(parts) < most:
        best = max(range(len(parts)), key=lambda i: cuts[i].saved)
        if cuts[best].saved < _SAVED * total or total <= 0:
            break
        halves = _clip(parts[best], cuts[best].normal, cuts[best].offset)
        parts[best : best + 1] = halves
        cells = cuts[best].cells
        cuts[best : best + 1] = [_best_cut(half, cells) for half in halves]
    hulls = tuple(_solid(part) for part in parts)
    return Fit(
        hulls,
        overestimate(triangles, hulls, grid),
        overestimate(triangles, (whole,), grid),
        underestimate(triangles, hulls),
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Cut:
    """The best cut of a part: saved cost, plane, and the cells (n, 4) in the part's hull."""

    saved: float
    normal: Array
    offset: float
    cells: Array


@dataclass(frozen=True, slots=True, eq=False)
class _Grid:
    """Cells of a mesh: those of its `surface` and those outside, `free`.

    `outside` (n, 4) are free cells off the surface: x, y, z and the distance from the mesh.
    """

    low: Array
    size: float
    surface: NDArray[np.bool_]
    free: NDArray[np.bool_]
    outside: Array

    def at(self, points: Array) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Return which points (n, 3) are in surface cells, and which in free ones."""
        index = np.floor((points - self.low) / self.size).astype(np.intp) + 1
        index = np.clip(index, 0, np.array(self.free.shape) - 1)
        return self.surface[tuple(index.T)], self.free[tuple(index.T)]


def _grid_of(triangles: Array) -> _Grid:
    """Return the cells of a mesh.

    The outside is flooded from the border of the grid; distances are counted in layers of cells.
    """
    points = np.concatenate([_samples(triangles, 50 * _SAMPLES), triangles.reshape(-1, 3)])
    low, high = points.min(axis=0), points.max(axis=0)
    size = float((high - low).max()) / _CELLS
    shape = np.floor((high - low) / size).astype(np.intp) + 3
    surface = np.zeros(shape, dtype=np.bool_)
    surface[tuple((np.floor((points - low) / size).astype(np.intp) + 1).T)] = True
    free = np.zeros_like(surface)
    free[0], free[-1] = True, True
    free[:, 0] = free[:, -1] = free[:, :, 0] = free[:, :, -1] = True
    count = 0
    while int(free.sum()) != count:
        count = int(free.sum())
        free = _grown(free, corners=False) & ~surface
    layers = np.zeros(shape)
    reached = surface
    while not (reached | ~free).all():
        grown = _grown(reached, corners=True)
        layers += free & ~reached
        reached = grown
    index = np.argwhere(free & (layers > 1))
    places = low + (index - 0.5) * size
    outside = np.column_stack([places, (layers[tuple(index.T)] - 0.5) * size])
    return _Grid(low, size, surface, free, outside)


def _grown(cells: NDArray[np.bool_], *, corners: bool) -> NDArray[np.bool_]:
    """Return cells and their neighbours, across faces or across corners too."""
    result: NDArray[np.bool_] = cells.copy()
    for axis in range(3):
        base = result.copy() if corners else cells
        for low, high in ((slice(1, None), slice(None, -1)), (slice(None, -1), slice(1, None))):
            to, source = [slice(None)] * 3, [slice(None)] * 3
            to[axis], source[axis] = low, high
            result[tuple(to)] |= base[tuple(source)]
    return result


def _cost(points: Array, cells: Array) -> tuple[float, Array]:
    """Return the cost of the hull of points, and the cells in it."""
    if not len(cells) or _volume(points) <= 0:
        return 0.0, cells[:0]
    corners, index = hull_triangles(points)
    a, b, c = np.moveaxis(corners[index], 1, 0)
    normal = np.cross(b - a, c - a)
    offset = np.einsum("ni,ni->n", normal, a)
    inside = (cells[:, :3] @ normal.T <= offset).all(axis=1)
    own = cells[inside]
    return float((own[:, 3] ** _POWER).sum()), own


def _solid(triangles: Array) -> Array:
    """Return the hull's vertices; a flat part gets a thickness of a thousandth of its size."""
    points = triangles.reshape(-1, 3)
    if _volume(points) > 0:
        return hull_triangles(points)[0]
    middle = points.mean(axis=0)
    _, spread, axes = np.linalg.svd(points - middle, full_matrices=False)
    thick = max(float(spread[0]) / np.sqrt(len(points)) * 1e-3, 1e-6)
    ways = axes[spread < spread[0] * 1e-6] if len(spread) == 3 else axes[2:]
    for way in ways:
        points = np.concatenate([points + thick * way, points - thick * way])
    return hull_triangles(points)[0]


def _volume(points: Array) -> float:
    """Return the volume of the hull of points; 0 if they lie in one plane."""
    centred = points - points.mean(axis=0)
    spread = np.linalg.svd(centred, compute_uv=False) if len(points) > 3 else np.zeros(3)
    if len(spread) < 3 or spread[2] <= 1e-6 * spread[0]:
        return 0.0
    return hull_volume(points)


def _thinned(points: Array) -> Array:
    """Return one point for each cell of a grid, for the search for cuts."""
    low = points.min(axis=0)
    size = float((points.max(axis=0) - low).max()) / (2 * _CELLS)
    if size <= 0:
        return points[:1]
    cells = np.floor((points - low) / size).astype(np.int64)
    _, index = np.unique(cells, axis=0, return_index=True)
    return points[index]


def _best_cut(triangles: Array, cells: Array) -> _Cut:
    """Return the best cut of a part among some; `cells` are those of its parent."""
    points = _thinned(triangles.reshape(-1, 3))
    whole, own = _cost(points, cells)
    best = _Cut(0.0, np.array([1.0, 0.0, 0.0]), 0.0, own)
    if whole <= 0:
        return best
    principal = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)[2]
    for normal in (*np.eye(3), *principal):
        along = triangles @ normal
        low, high = float(along.min()), float(along.max())
        for share in _OFFSETS:
            offset = low + share * (high - low)
            first, second = _clip(triangles, normal, offset, along)
            if not len(first) or not len(second):
                continue
            halves = sum(_cost(_thinned(h.reshape(-1, 3)), own)[0] for h in (first, second))
            if whole - halves > best.saved:
                best = _Cut(whole - halves, normal, offset, own)
    return best


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


def _samples(triangles: Array, count: int) -> Array:
    """Return points on a surface, evenly by area, and all its corners up to `count`."""
    rng = np.random.default_rng(1)
    edges = triangles[:, 1:] - triangles[:, :1]
    area = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
    if not area.sum():
        return triangles[:, 0]
    chosen = rng.choice(len(triangles), count, p=area / area.sum())
    u, v = rng.random((2, count))
    flip = u + v > 1
    u, v = np.where(flip, 1 - u, u), np.where(flip, 1 - v, v)
    result: Array = (
        triangles[chosen, 0] + u[:, None] * edges[chosen, 0] + v[:, None] * edges[chosen, 1]
    )
    return result


def overestimate(triangles: Array, hulls: tuple[Array, ...], grid: _Grid) -> float:
    """Return the largest distance of the hulls' surface from the mesh, outside of the mesh."""
    faces = []
    for vertices in hulls:
        points, index = hull_triangles(vertices)
        faces.append(points[index])
    points = np.concatenate([np.concatenate(hulls), _samples(np.concatenate(faces), _SAMPLES // 2)])
    surface = np.concatenate(
        [
            _samples(triangles, 4 * _SAMPLES),
            triangles.reshape(-1, 3)[:: max(1, len(triangles) // _SAMPLES)],
        ]
    )
    far = np.concatenate(
        [_nearest(points[i : i + _CHUNK], surface) for i in range(0, len(points), _CHUNK)]
    )
    # Only points outside count. The winding number is costly, so that only points in cells of the
    # surface need it.
    on_surface, free = grid.at(points)
    for index in np.argsort(-far):
        if on_surface[index]:
            if abs(_winding(points[index], triangles)) < 0.5:
                return float(far[index])
        elif free[index]:
            return float(far[index])
    return 0.0


def _nearest(points: Array, surface: Array) -> Array:
    square = (points**2).sum(axis=1)[:, None] + (surface**2).sum(axis=1) - 2 * points @ surface.T
    result: Array = np.sqrt(np.maximum(square.min(axis=1), 0.0))
    return result


def _winding(point: Array, triangles: Array) -> float:
    """Return the winding number of a mesh about a point [van Oosterom & Strackee 1983]."""
    a, b, c = np.moveaxis(triangles - point, 1, 0)
    la, lb, lc = (np.linalg.norm(v, axis=1) for v in (a, b, c))
    volume = np.einsum("ni,ni->n", a, np.cross(b, c))
    dots = (
        la * lb * lc
        + np.einsum("ni,ni->n", a, b) * lc
        + np.einsum("ni,ni->n", b, c) * la
        + np.einsum("ni,ni->n", c, a) * lb
    )
    return float(np.arctan2(volume, dots).sum() / (2 * np.pi))


def underestimate(triangles: Array, hulls: tuple[Array, ...]) -> float:
    """Return the largest distance of points of the mesh from the union of convex hulls."""
    points = np.concatenate([_samples(triangles, _SAMPLES), triangles.reshape(-1, 3)])
    worst = np.full(len(points), np.inf)
    for vertices in hulls:
        corners, index = hull_triangles(vertices)
        a, b, c = np.moveaxis(corners[index], 1, 0)
        normal = np.cross(b - a, c - a)
        size = np.linalg.norm(normal, axis=1)
        keep = size > 0
        normal = normal[keep] / size[keep, None]
        offset = np.einsum("ni,ni->n", normal, a[keep])
        for low in range(0, len(points), 5000):
            rows = slice(low, low + 5000)
            out = (points[rows] @ normal.T - offset).max(axis=1)
            worst[rows] = np.minimum(worst[rows], out)
    scale = float(np.ptp(triangles.reshape(-1, 3), axis=0).max())
    deepest = float(worst.max())
    # Rounding of the hulls' planes.
    return deepest if deepest > 1e-6 * scale else 0.0
