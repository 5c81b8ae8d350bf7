"""Distances of convex hulls and cylinders with coal [coal 3: distance, GJK and EPA].

`distances` is the interface; only this module imports coal, on first use.
"""

from functools import cache
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np

from rapidgen._extras import named
from rapidgen.collision.plain import Distances
from rapidgen.collision.shapes import Array, Indices, Shape, ShapeTable

if TYPE_CHECKING:
    from coal import CollisionGeometry, ConvexBase


@cache
def _coal() -> ModuleType:
    """Import coal. Raises ModuleNotFoundError with the extra's name."""
    with named():
        return import_module("coal")


class HullDistances:
    """Distances of the shapes of a table; coal's objects are made once."""

    def __init__(self, table: ShapeTable) -> None:
        self._table = table
        self._made: dict[int, CollisionGeometry] = {}

    def share(self, other: "HullDistances") -> None:
        """Use the objects of a table with the same shapes at other places."""
        self._made = other._made

    def distances(
        self, a: Indices, b: Indices, pose_a: tuple[Array, Array], pose_b: tuple[Array, Array]
    ) -> Distances:
        """Return signed distances (n,) and nearest points (n, 3).

        `a` and `b` (n,) are rows of the table, the poses rotations (n, 3, 3) and positions (n, 3).
        """
        coal = _coal()
        request, result = coal.DistanceRequest(), coal.DistanceResult()
        request.gjk_max_iterations = 1000
        request.gjk_tolerance = 1e-9
        far = np.empty(len(a))
        points = np.empty((2, len(a), 3))
        place_a, place_b = coal.Transform3s(), coal.Transform3s()
        for i, (one, other) in enumerate(zip(a.tolist(), b.tolist(), strict=True)):
            place_a.setRotation(pose_a[0][i])
            place_a.setTranslation(pose_a[1][i])
            place_b.setRotation(pose_b[0][i])
            place_b.setTranslation(pose_b[1][i])
            result.clear()
            far[i] = coal.distance(
                self._geometry(one), place_a, self._geometry(other), place_b, request, result
            )
            points[0, i] = result.getNearestPoint1()
            points[1, i] = result.getNearestPoint2()
        return far, points[0], points[1]

    def _geometry(self, index: int) -> "CollisionGeometry":
        if index not in self._made:
            self._made[index] = _geometry(self._table.shapes[index])
        return self._made[index]


def _geometry(shape: Shape) -> "CollisionGeometry":
    coal = _coal()
    match shape.kind, shape.size:
        case "sphere", (radius,):
            return coal.Sphere(radius)
        case "capsule", (radius, length):
            return coal.Capsule(radius, length)
        case "cylinder", (radius, length):
            return coal.Cylinder(radius, length)
        case "box", (x, y, z):
            return coal.Box(2 * x, 2 * y, 2 * z)
        case "half_space", _:
            return coal.Halfspace(np.array([0.0, 0.0, 1.0]), 0.0)
        case _:
            return _hull(shape.vertices)


def _hull(vertices: Array) -> "ConvexBase":
    coal = _coal()
    points = coal.StdVec_Vec3s()
    points.extend(list(vertices))
    return coal.ConvexBase.convexHull(points, True, "Qt")


def hull_vertices(points: Array) -> Array:
    """Return the vertices (n, 3) of the convex hull of points.

    Raises ModuleNotFoundError without coal; ValueError for points that lie in one plane.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    size = float(np.linalg.norm(high - low))
    centred = points - (low + high) / 2
    if (
        len(points) < 4
        or np.linalg.matrix_rank(centred, tol=1e-9 * max(size, 1e-9) * len(points) ** 0.5) < 3
    ):
        raise ValueError("all points lie in one plane")
    made = _hull(points)
    return np.array([made.point(i) for i in range(made.num_points)])


def hull_triangles(points: Array) -> tuple[Array, Indices]:
    """Return vertices (n, 3) and outward triangles (m, 3) of the convex hull of points."""
    made = _hull(points)
    vertices = np.array([made.point(i) for i in range(made.num_points)])
    triangles = np.array(
        [[made.polygons(i)[k] for k in range(3)] for i in range(made.num_polygons)], dtype=np.intp
    )
    middle = vertices.mean(axis=0)
    corners = vertices[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    turned = np.einsum("ni,ni->n", normals, corners[:, 0] - middle) < 0
    triangles[turned] = triangles[turned][:, ::-1]
    return vertices, triangles


def hull_planes(points: Array) -> tuple[Array, Array, Array]:
    """Return vertices (n, 3), unit normals (m, 3) and offsets (m,) of the convex hull of points.

    n . x <= offset is true for all points.
    """
    vertices, triangles = hull_triangles(points)
    a, b, c = np.moveaxis(vertices[triangles], 1, 0)
    normal = np.cross(b - a, c - a)
    size = np.linalg.norm(normal, axis=1)
    normal = normal[size > 0] / size[size > 0, None]
    return vertices, normal, np.einsum("ni,ni->n", normal, a[size > 0])
