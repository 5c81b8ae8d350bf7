"""Grid around a mesh: its surface, what is outside, and how far that is from the mesh.

The fitting of convex parts searches with it. The surface is sampled so densely that a flood from
the border of the grid does not leak through it.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rapidgen.collision.shapes import Array

CELLS = 96
"""Cells along the longest side of a mesh."""
_DENSITY = 0.6
"""Distance of samples on the surface over the size of a cell."""
_MOST_SAMPLES = 4_000_000


@dataclass(frozen=True, slots=True, eq=False)
class Grid:
    """Cells of a mesh: those of its `surface` and those outside, `free`.

    `outside` (n, 4) are free cells off the surface: x, y, z and the distance from the mesh.
    `points` (k, 3) are points of the surface, about one for each of its cells.
    """

    low: Array
    size: float
    surface: NDArray[np.bool_]
    free: NDArray[np.bool_]
    outside: Array
    points: Array

    def at(self, points: Array) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Return which points (n, 3) are in surface cells, and which in free ones."""
        index = np.floor((points - self.low) / self.size).astype(np.intp) + 1
        index = np.clip(index, 0, np.array(self.free.shape) - 1)
        return self.surface[tuple(index.T)], self.free[tuple(index.T)]


def grid_of(triangles: Array) -> Grid:
    """Return the cells of a mesh (n, 3, 3)."""
    corners = triangles.reshape(-1, 3)
    low, high = corners.min(axis=0), corners.max(axis=0)
    size = float((high - low).max()) / CELLS
    points = surface_samples(triangles, _DENSITY * size)
    shape = np.floor((high - low) / size).astype(np.intp) + 3
    index = np.floor((points - low) / size).astype(np.intp) + 1
    flat, first = np.unique(np.ravel_multi_index(tuple(index.T), tuple(shape)), return_index=True)
    surface = np.zeros(shape, dtype=np.bool_)
    surface.ravel()[flat] = True
    free = _flooded(surface)
    square = _squared_distances(surface)
    cells = np.argwhere(free & (square > 1.5**2))
    # Half a cell less: the surface is somewhere in its cell.
    far = (np.sqrt(square[tuple(cells.T)]) - 0.5) * size
    outside = np.column_stack([low + (cells - 0.5) * size, far])
    return Grid(low, size, surface, free, outside, points[first])


def surface_samples(triangles: Array, spacing: float) -> Array:
    """Return points on triangles (n, 3, 3), at most `spacing` apart, corners and edges included."""
    edges = np.stack([triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]], axis=1)
    third = edges[:, 1] - edges[:, 0]
    longest = np.linalg.norm(np.concatenate([edges, third[:, None]], axis=1), axis=2).max(axis=1)
    count = np.maximum(np.ceil(longest / spacing), 1).astype(np.intp)
    while (count * (count + 3) / 2 + 1).sum() > _MOST_SAMPLES:
        count = np.maximum(count // 2, 1)
    parts = []
    for n in np.unique(count).tolist():
        i, j = (axis.ravel() for axis in np.meshgrid(np.arange(n + 1), np.arange(n + 1)))
        keep = i + j <= n
        share = np.stack([i[keep], j[keep]], axis=1) / n
        rows = count == n
        points = triangles[rows, :1] + np.einsum("pk,tki->tpi", share, edges[rows])
        parts.append(points.reshape(-1, 3))
    return np.concatenate(parts)


def _flooded(surface: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return the cells that are connected to the border of the grid across faces."""
    free = np.zeros_like(surface)
    free[0], free[-1] = True, True
    free[:, 0] = free[:, -1] = free[:, :, 0] = free[:, :, -1] = True
    count = 0
    while int(free.sum()) != count:
        count = int(free.sum())
        for axis in range(3):
            for order in (1, -1):
                # A sweep along an axis carries a flood to the next cell of the surface.
                sides = np.moveaxis(free, axis, 0)[::order]
                blocked = np.moveaxis(surface, axis, 0)[::order]
                for k in range(1, len(sides)):
                    sides[k] |= sides[k - 1] & ~blocked[k]
    return free


def _squared_distances(surface: NDArray[np.bool_]) -> Array:
    """Return squared distances of all cells from the nearest cell of the surface, in cells.

    Each axis takes the minimum over all shifts [Felzenszwalb & Huttenlocher 2012].
    """
    result = np.where(surface, 0.0, np.inf)
    for axis in range(3):
        before = np.moveaxis(result, axis, 0)
        after = before.copy()
        for shift in range(1, len(before)):
            np.minimum(after[shift:], before[:-shift] + shift**2, out=after[shift:])
            np.minimum(after[:-shift], before[shift:] + shift**2, out=after[:-shift])
        result = np.moveaxis(after, 0, axis)
    return result
