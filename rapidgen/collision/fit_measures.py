"""How far convex parts are outside of a mesh, and the mesh outside of the parts."""

import numpy as np
from numpy.typing import NDArray

from rapidgen.collision.fit_grid import Grid
from rapidgen.collision.hulls import hull_planes, hull_triangles
from rapidgen.collision.shapes import Array

_SAMPLES = 4000
"""Points on the surface of a mesh, and of its parts."""
_CHUNK = 400
_PLANES = 64


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


def overestimate(triangles: Array, hulls: tuple[Array, ...], grid: Grid) -> float:
    """Return the largest distance of a point of the hulls from the mesh, outside of the mesh.

    Points are those of the hulls' surfaces, and the cells of the grid in the hulls: the middle of a
    cavity is farther from the mesh than its mouth.
    """
    faces = []
    covered = np.zeros(len(grid.outside), dtype=np.bool_)
    for vertices in hulls:
        points, index = hull_triangles(vertices)
        faces.append(points[index])
        _, normal, offset = hull_planes(vertices)
        covered |= is_below(grid.outside[:, :3], normal, offset)
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
    cells = grid.outside[covered]
    points = np.concatenate([points, cells[:, :3]])
    # From the middle of a cell to that of another one, and from there to the surface.
    far = np.concatenate([far, cells[:, 3] + 1.4 * grid.size])
    # Distances from samples of the surface are too large, and the winding number is costly: both
    # are corrected from the largest one down. Only points outside count, and only points in cells
    # of the surface need the winding number to tell.
    on_surface, free = grid.at(points)
    worst = 0.0
    for index in np.argsort(-far):
        if far[index] <= worst:
            break
        if on_surface[index]:
            is_out = abs(_winding(points[index], triangles)) < 0.5
        else:
            is_out = bool(free[index])
        if is_out:
            worst = max(worst, _distance(points[index], triangles))
    return worst


def _distance(point: Array, triangles: Array) -> float:
    """Return the distance of a point from triangles."""
    a, b, c = np.moveaxis(triangles - point, 1, 0)
    square = np.inf
    for start, end in ((a, b), (b, c), (c, a)):
        way = end - start
        length = np.einsum("ni,ni->n", way, way)
        share = -np.einsum("ni,ni->n", start, way) / np.where(length > 0, length, 1.0)
        at = start + np.clip(share, 0.0, 1.0)[:, None] * way
        square = min(square, float(np.einsum("ni,ni->n", at, at).min()))
    normal = np.cross(b - a, c - a)
    size = np.einsum("ni,ni->n", normal, normal)
    # The foot on the plane is in the triangle if it is on the inner side of all edges.
    inner = size > 0
    for start, end in ((a, b), (b, c), (c, a)):
        inner &= np.einsum("ni,ni->n", np.cross(start, end), normal) >= 0
    if inner.any():
        height = np.einsum("ni,ni->n", a[inner], normal[inner]) ** 2 / size[inner]
        square = min(square, float(height.min()))
    return float(np.sqrt(square))


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


def is_below(places: Array, normal: Array, offset: Array) -> NDArray[np.bool_]:
    """Return which places (m, 3) are below all planes."""
    result = np.ones(len(places), dtype=np.bool_)
    for low in range(0, len(normal), _PLANES):
        left = np.flatnonzero(result)
        rows = slice(low, low + _PLANES)
        result[left] = (places[left] @ normal[rows].T <= offset[rows]).all(axis=1)
    return result


def underestimate(triangles: Array, hulls: tuple[Array, ...]) -> float:
    """Return the largest distance of points of the mesh from the union of convex hulls."""
    points = np.concatenate([_samples(triangles, _SAMPLES), triangles.reshape(-1, 3)])
    worst = np.full(len(points), np.inf)
    for vertices in hulls:
        _, normal, offset = hull_planes(vertices)
        for low in range(0, len(points), 5000):
            rows = slice(low, low + 5000)
            out = (points[rows] @ normal.T - offset).max(axis=1)
            worst[rows] = np.minimum(worst[rows], out)
    scale = float(np.ptp(triangles.reshape(-1, 3), axis=0).max())
    deepest = float(worst.max())
    # Rounding of the hulls' planes.
    return deepest if deepest > 1e-6 * scale else 0.0
