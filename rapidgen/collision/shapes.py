"""Convex shapes in the frame of their body: m.

Every shape is the Minkowski sum of a core and a ball: a sphere is a point and a ball, a capsule a
segment and a ball, all others are cores alone. Bounds of motion therefore need only the core, since
a ball that turns is the same ball.

Canonical frames: box, cylinder, capsule and sphere have their centre at the origin, the axis of a
cylinder and a capsule is z, and a half-space is solid for z <= 0. A hull has its own vertices.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from rapidgen.axes import frames

Array: TypeAlias = NDArray[np.float64]
Indices: TypeAlias = NDArray[np.intp]
Kind: TypeAlias = Literal["sphere", "capsule", "box", "cylinder", "hull", "half_space"]
KINDS: tuple[Kind, ...] = ("sphere", "capsule", "box", "cylinder", "hull", "half_space")
CORNERS = 8
"""Points of a core that bound its levers."""
_SIGNS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=np.float64)


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """A convex shape with its place in a body.

    `size`: radius of a sphere; radius and length between the centres of a capsule; half x, y, z of
    a box; radius and length of a cylinder; empty for a hull, whose `vertices` (n, 3) are in the
    shape's frame, and for a half-space.
    """

    kind: Kind
    size: tuple[float, ...] = ()
    pose: frames.Pose = frames.IDENTITY
    vertices: Array = field(default_factory=lambda: np.zeros((0, 3)))
    source: str = ""
    """Origin, such as a mesh file."""

    def placed(self, outer: frames.Pose) -> "Shape":
        """Return the shape in a frame in which its present one is `outer`."""
        return replace(self, pose=frames.compose(outer, self.pose))

    @property
    def radius(self) -> float:
        """Return the radius of the ball: 0 for shapes without."""
        return self.size[0] if self.kind in ("sphere", "capsule") else 0.0

    def corners(self) -> tuple[Array, float]:
        """Return points (8, 3) in the shape's frame, and a distance around them.

        The core lies within this distance of the points' hull. A half-space has no such points.
        """
        if self.kind == "box":
            return _SIGNS * np.array(self.size), 0.0
        if self.kind in ("capsule", "cylinder"):
            ends = np.array([[0, 0, -self.size[1] / 2], [0, 0, self.size[1] / 2]])
            return np.repeat(ends, 4, axis=0), 0.0 if self.kind == "capsule" else self.size[0]
        if self.kind == "hull":
            low, high = self.vertices.min(axis=0), self.vertices.max(axis=0)
            return (low + high) / 2 + _SIGNS * (high - low) / 2, 0.0
        return np.zeros((CORNERS, 3)), 0.0

    def bounding_sphere(self) -> tuple[Array, float]:
        """Return centre (3,) in the shape's frame and radius, the ball included."""
        if self.kind == "hull":
            centre = (self.vertices.min(axis=0) + self.vertices.max(axis=0)) / 2
            return centre, float(np.linalg.norm(self.vertices - centre, axis=1).max())
        points, around = self.corners()
        if self.kind == "cylinder":
            return np.zeros(3), float(np.hypot(self.size[0], self.size[1] / 2))
        return np.zeros(3), float(np.linalg.norm(points, axis=1).max()) + around + self.radius


def sphere(radius: float, pose: frames.Pose = frames.IDENTITY) -> Shape:
    """Return a sphere about the origin of `pose`."""
    return Shape("sphere", (radius,), pose)


def capsule(radius: float, length: float, pose: frames.Pose = frames.IDENTITY) -> Shape:
    """Return a capsule; `length` is that between the centres of its ends."""
    return Shape("capsule", (radius, length), pose)


def box(x: float, y: float, z: float, pose: frames.Pose = frames.IDENTITY) -> Shape:
    """Return a box of whole lengths x, y, z."""
    return Shape("box", (x / 2, y / 2, z / 2), pose)


def cylinder(radius: float, length: float, pose: frames.Pose = frames.IDENTITY) -> Shape:
    """Return a cylinder about z."""
    return Shape("cylinder", (radius, length), pose)


def half_space(normal: Sequence[float], point: frames.Vector = frames.ORIGIN) -> Shape:
    """Return everything behind the plane through `point`; `normal` points out of it."""
    size = float(np.linalg.norm(normal))
    z = np.array(normal, dtype=np.float64) / size
    helper = np.eye(3)[int(np.argmin(np.abs(z)))]
    x = np.cross(helper, z) / np.linalg.norm(np.cross(helper, z))
    columns = np.stack([x, np.cross(z, x), z], axis=1).tolist()
    rows = tuple((row[0], row[1], row[2]) for row in columns)
    q = frames.from_matrix((rows[0], rows[1], rows[2]))
    return Shape("half_space", (), (point, q))


def hull(vertices: Array, pose: frames.Pose = frames.IDENTITY, source: str = "") -> Shape:
    """Return the convex hull of vertices (n, 3); inner points are allowed."""
    return Shape("hull", (), pose, np.ascontiguousarray(vertices, dtype=np.float64), source)


class ShapeTable:
    """The figures of many shapes as arrays, one row for each shape."""

    def __init__(self, shapes: Sequence[Shape]) -> None:
        self.shapes = tuple(shapes)
        count = len(self.shapes)
        self.kind = np.array([KINDS.index(shape.kind) for shape in shapes], dtype=np.intp)
        self.rotation = np.empty((count, 3, 3))
        self.position = np.empty((count, 3))
        self.half = np.zeros((count, 3))
        """Half lengths of a box; radius, radius and half length of a cylinder or capsule."""
        self.radius = np.array([shape.radius for shape in shapes], dtype=np.float64)
        self.corners = np.empty((count, CORNERS, 3))
        self.around = np.empty(count)
        self.centre = np.empty((count, 3))
        self.reach = np.empty(count)
        for i, shape in enumerate(self.shapes):
            self.position[i] = shape.pose[0]
            self.rotation[i] = frames.to_matrix(shape.pose[1])
            if shape.kind == "box":
                self.half[i] = shape.size
            elif shape.kind in ("capsule", "cylinder"):
                self.half[i] = (shape.size[0], shape.size[0], shape.size[1] / 2)
            self.corners[i], self.around[i] = shape.corners()
            self.centre[i], self.reach[i] = shape.bounding_sphere()

    def lowest(self, index: Indices, rotation: Array, position: Array, way: Array) -> Array:
        """Return the minimum of way . v over the core of each shape.

        `index` (n,) selects shapes, `rotation` (n, 3, 3) and `position` (n, 3) are their frames in
        the world, `way` (n, 3). Half-spaces: only along their normal, opposite to `way`.
        """
        local = np.einsum("nij,ni->nj", rotation, way)
        base = np.einsum("ni,ni->n", position, way)
        kind, half = self.kind[index], self.half[index]
        deep = np.zeros(len(index))
        is_box = kind == KINDS.index("box")
        deep[is_box] = (np.abs(local[is_box]) * half[is_box]).sum(axis=1)
        is_long = (kind == KINDS.index("capsule")) | (kind == KINDS.index("cylinder"))
        deep[is_long] = np.abs(local[is_long, 2]) * half[is_long, 2]
        is_round = kind == KINDS.index("cylinder")
        deep[is_round] += np.hypot(local[is_round, 0], local[is_round, 1]) * half[is_round, 0]
        result: Array = base - deep
        for one in np.unique(index[kind == KINDS.index("hull")]):
            rows = index == one
            result[rows] += (local[rows] @ self.shapes[one].vertices.T).min(axis=1)
        return result

    def lowest_point(self, index: Indices, rotation: Array, position: Array, way: Array) -> Array:
        """Return the point (n, 3) of each shape, ball included, with the least way . v."""
        local = np.einsum("nij,ni->nj", rotation, way)
        kind, half = self.kind[index], self.half[index]
        point = np.zeros((len(index), 3))
        is_box = kind == KINDS.index("box")
        point[is_box] = -np.sign(local[is_box]) * half[is_box]
        is_long = (kind == KINDS.index("capsule")) | (kind == KINDS.index("cylinder"))
        point[is_long, 2] = -np.sign(local[is_long, 2]) * half[is_long, 2]
        is_round = kind == KINDS.index("cylinder")
        flat = np.hypot(local[is_round, 0], local[is_round, 1])[:, None]
        point[is_round, :2] = (
            -local[is_round, :2] / np.where(flat > 0, flat, 1.0) * half[is_round, :1]
        )
        for one in np.unique(index[kind == KINDS.index("hull")]):
            rows = index == one
            vertices = self.shapes[one].vertices
            point[rows] = vertices[(local[rows] @ vertices.T).argmin(axis=1)]
        size = np.linalg.norm(way, axis=1)[:, None]
        ball = self.radius[index][:, None] * way / np.where(size > 0, size, 1.0)
        result: Array = position + np.einsum("nij,nj->ni", rotation, point) - ball
        return result
