"""A scene: bodies with shapes, their moving frames, and the pairs to check.

A body moves with a node of the tree. Pairs of bodies have a clearance; `Scene` expands them to
pairs of shapes, as arrays, and computes distances of many pairs in many postures at once.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from rapidgen.collision import plain
from rapidgen.collision.hulls import HullDistances
from rapidgen.collision.plain import Distances
from rapidgen.collision.shapes import KINDS, Array, Indices, Shape, ShapeTable
from rapidgen.collision.tree import Tree

_SPHERE, _CAPSULE, _BOX, _CYLINDER, _HULL, _HALF_SPACE = range(len(KINDS))


@dataclass(frozen=True, slots=True, eq=False)
class Body:
    """A link, a tool, an object: shapes in the frame of a node.

    `owner` is the robot of a link, its tool or what it holds; empty for objects.
    """

    name: str
    node: int
    shapes: tuple[Shape, ...]
    owner: str = ""
    role: Literal["link", "tool", "object", "part", "zone"] = "object"


@dataclass(frozen=True, slots=True)
class Pair:
    """Two bodies by index, and the distance in m that they keep."""

    first: int
    second: int
    clearance: float


class Scene:
    """Bodies and pairs. Frozen after its creation."""

    def __init__(self, tree: Tree, bodies: Sequence[Body], pairs: Sequence[Pair]) -> None:
        self.tree = tree
        self.bodies = tuple(bodies)
        shapes: list[Shape] = []
        self.shapes_of: list[range] = []
        owners: list[int] = []
        for i, body in enumerate(self.bodies):
            self.shapes_of.append(range(len(shapes), len(shapes) + len(body.shapes)))
            shapes += body.shapes
            owners += [i] * len(body.shapes)
        self.table = ShapeTable(shapes)
        self.body_of = np.array(owners, dtype=np.intp)
        self.node_of = np.array([self.bodies[i].node for i in owners], dtype=np.intp)
        self._hulls = HullDistances(self.table)
        self._set_pairs(pairs)

    def _set_pairs(self, pairs: Sequence[Pair]) -> None:
        self.pairs = tuple(pairs)
        rows = [
            (a, b, number)
            for number, pair in enumerate(self.pairs)
            for a in self.shapes_of[pair.first]
            for b in self.shapes_of[pair.second]
        ]
        table = np.array(rows, dtype=np.intp).reshape(-1, 3)
        first, second = table[:, 0], table[:, 1]
        kind = self.table.kind
        # Kernels take the kinds in this order; half-spaces are always second.
        swap = kind[first] > kind[second]
        self.first = np.where(swap, second, first)
        self.second = np.where(swap, first, second)
        self.pair_of = table[:, 2]
        self.clearance = np.array([self.pairs[i].clearance for i in self.pair_of], dtype=np.float64)

    def with_pairs(self, pairs: Sequence[Pair]) -> "Scene":
        """Return the same bodies with other pairs; geometry is shared."""
        other = Scene.__new__(Scene)
        other.__dict__.update(
            {name: value for name, value in self.__dict__.items() if name != "relations"}
        )
        other._set_pairs(pairs)
        return other

    def with_body(self, index: int, body: Body, pairs: Sequence[Pair]) -> "Scene":
        """Return a scene in which a body has the same shapes at other places, and other pairs."""
        bodies = (*self.bodies[:index], body, *self.bodies[index + 1 :])
        other = Scene(self.tree, bodies, pairs)
        # The shapes have kept their numbers and sizes.
        other._hulls.share(self._hulls)
        return other

    @cached_property
    def relations(self) -> tuple[Array, Array]:
        """Return the nodes that move the first and the second shape of each pair alone.

        Shapes (p, k) of 0 and 1. Nodes that move both do not change their distance.
        """
        ancestors = self.tree.ancestors
        a, b = ancestors[self.node_of[self.first]], ancestors[self.node_of[self.second]]
        return (a & ~b).astype(np.float64), (b & ~a).astype(np.float64)

    def places(self, rotations: Array, positions: Array) -> tuple[Array, Array]:
        """Return rotations (m, s, 3, 3) and positions (m, s, 3) of all shapes.

        The arguments are results of `Tree.poses`.
        """
        outer, origin = rotations[:, self.node_of], positions[:, self.node_of]
        turned = outer @ self.table.rotation
        moved = origin + np.einsum("msij,sj->msi", outer, self.table.position)
        return turned, moved

    def distances(
        self, pairs: Indices, postures: Indices, rotation: Array, position: Array
    ) -> Distances:
        """Return signed distances and nearest points of pairs of shapes in postures.

        `pairs` and `postures` are (n,); `rotation` and `position` come from `places`.
        Raises ModuleNotFoundError for a hull or a cylinder without coal.
        """
        count = len(pairs)
        far, on_first, on_second = np.empty(count), np.empty((count, 3)), np.empty((count, 3))
        a, b = self.first[pairs], self.second[pairs]
        kinds = self.table.kind[a] * len(KINDS) + self.table.kind[b]
        for kind in np.unique(kinds).tolist():
            rows = np.flatnonzero(kinds == kind)
            i, j, m = a[rows], b[rows], postures[rows]
            first, second = (rotation[m, i], position[m, i]), (rotation[m, j], position[m, j])
            kind_a, kind_b = divmod(kind, len(KINDS))
            result = self._of_kinds(kind_a, kind_b, i, j, first, second)
            far[rows], on_first[rows], on_second[rows] = result
        return far, on_first, on_second

    def _of_kinds(
        self,
        kind_a: int,
        kind_b: int,
        i: Indices,
        j: Indices,
        first: tuple[Array, Array],
        second: tuple[Array, Array],
    ) -> Distances:
        table = self.table
        if kind_b == _HALF_SPACE:
            normal = second[0][:, :, 2]
            lowest = table.lowest_point(i, *first, normal)
            depth = np.einsum("ni,ni->n", lowest - second[1], normal)
            return depth, lowest, lowest - depth[:, None] * normal
        if kind_b <= _CAPSULE:
            a, u = self._segment(i, first)
            b, v = self._segment(j, second)
            return plain.segment_segment(a, u, table.radius[i], b, v, table.radius[j])
        if kind_b == _BOX and kind_a <= _CAPSULE:
            a, u = self._segment(i, first)
            return plain.segment_box(a, u, table.radius[i], *second, table.half[j])
        if kind_a == kind_b == _BOX:
            return plain.box_box(*first, table.half[i], *second, table.half[j])
        return self._hulls.distances(i, j, first, second)

    def _segment(self, index: Indices, place: tuple[Array, Array]) -> tuple[Array, Array]:
        """Return starts and ways of the cores of spheres and capsules."""
        half = place[0][:, :, 2] * self.table.half[index, 2:]
        return place[1] - half, 2 * half

    def sphere_gaps(
        self, pairs: Indices, postures: Indices, rotation: Array, position: Array
    ) -> Array:
        """Return lower bounds (n,) of distances, from bounding spheres."""
        a, b = self.first[pairs], self.second[pairs]
        table = self.table
        centre = position + np.einsum("msij,sj->msi", rotation, table.centre)
        way = centre[postures, a] - centre[postures, b]
        gap = np.linalg.norm(way, axis=1) - table.reach[a] - table.reach[b]
        flat = np.flatnonzero(table.kind[b] == _HALF_SPACE)
        if len(flat):
            normal = rotation[postures[flat], b[flat]][:, :, 2]
            out = centre[postures[flat], a[flat]] - position[postures[flat], b[flat]]
            gap[flat] = np.einsum("ni,ni->n", out, normal) - table.reach[a[flat]]
        result: Array = gap
        return result

    def body_distances(self, values: Array, pairs: Sequence[int] | None = None) -> Array:
        """Return distances (m, p) of pairs of bodies in postures (m, columns), exactly.

        `pairs` selects some by number. Costly for many postures: proofs need less.
        """
        chosen = range(len(self.pairs)) if pairs is None else pairs
        places = self.places(*self.tree.poses(values)[:2])
        result = np.full((len(values), len(chosen)), np.inf)
        for column, number in enumerate(chosen):
            own = np.flatnonzero(self.pair_of == number)
            for one in own.tolist():
                rows = np.arange(len(values))
                far = self.distances(np.full(len(values), one), rows, *places)[0]
                result[:, column] = np.minimum(result[:, column], far)
        return result

    def names(self, pair: int) -> tuple[str, str]:
        """Return the names of the bodies of a pair."""
        one = self.pairs[pair]
        return self.bodies[one.first].name, self.bodies[one.second].name
