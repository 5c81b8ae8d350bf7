"""Bounds on the distance of bodies over intervals of a path, from one posture of each interval.

For an interval with a posture q in it, joint k moves by at most delta_k. Moving joints
from the last to the first, each one turns the body about its axis at q: a point at the distance r_k
from that axis, already displaced by D, moves by at most delta_k (r_k + D). The sum of these over
the joints that move only one body of a pair bounds the loss of distance. A pair is proved for the
interval if its distance at q exceeds the bound and the clearance.

This bound is wasteful where a body glides along another. There a plane with the contact's normal n
separates both: to first order a point v moves along n by s L(v), with the same s from -1 to 1 for
all joints of a straight segment and L linear in v. The least gap over s is at s = -1 or 1, and is a
support function of the shapes. Terms of second order, and the deviation of the joints from a
straight line, are added as lengths.
"""

from typing import TypeAlias

import numpy as np

from rapidgen.collision.scene import Scene
from rapidgen.collision.shapes import Array, Indices

Motion: TypeAlias = tuple[Array, Array, Array, Array]
"""Values, and how far the path goes from there, of intervals: see `Path.ranges`."""


class Bounds:
    """Distances and bounds of pairs in intervals.

    `rows` (n,) are intervals and `pairs` (n,) pairs of shapes that bounding spheres do not prove;
    `is_open` is true for pairs that are not proved, `is_near` for those below the clearance at the
    interval's posture; `loss` is how much of the distance `far` the interval may lose, m.
    """

    def __init__(
        self,
        scene: Scene,
        motion: Motion,
        rows: Indices,
        pairs: Indices,
        *,
        independent: bool = False,
    ) -> None:
        """`independent`: both bodies of a pair are at any s of their own in their straight lines.

        That is the case for two robots that do not share a clock.
        """
        q, delta, line, rest = motion
        self._scene, self._independent = scene, independent
        mix = scene.tree.mix
        self._delta, self._line = delta @ np.abs(mix).T, line @ mix.T
        self._rest = rest @ np.abs(mix).T
        rotations, positions, self._axes = scene.tree.poses(q)
        self._origins = positions
        self._rotation, self._position = scene.places(rotations, positions)
        self._levers = self._lengths()
        loss, second, aside = self._losses(rows, pairs)
        gap = scene.sphere_gaps(pairs, rows, self._rotation, self._position)
        kept = np.flatnonzero(gap <= loss + scene.clearance[pairs])
        rows, pairs = rows[kept], pairs[kept]
        self.rows, self.pairs = rows, pairs
        self.loss = loss[kept]
        self.far, self.on_first, self.on_second = scene.distances(
            pairs, rows, self._rotation, self._position
        )
        clearance = scene.clearance[pairs]
        self.is_open = self.far <= self.loss + clearance
        self.is_near = self.far <= clearance
        gliding = np.flatnonzero(self.is_open & ~self.is_near & (self.far > 1e-9))
        if len(gliding):
            least = self._gaps(gliding) - second[kept][gliding] - aside[kept][gliding]
            self.is_open[gliding] = least <= clearance[gliding]

    def _lengths(self) -> Array:
        """Return the levers (m, s, k): distance of each core from each axis."""
        table, count = self._scene.table, len(self._scene.tree.nodes)
        moving = np.flatnonzero(self._scene.node_of >= 0)
        levers = np.zeros((len(self._origins), len(table.shapes), count))
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
        scene, rows, pairs = self._scene, self.rows[chosen], self.pairs[chosen]
        n = (self.on_first[chosen] - self.on_second[chosen]) / self.far[chosen, None]
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
        ends = [
            [
                scene.table.lowest(
                    index,
                    self._rotation[rows, index],
                    self._position[rows, index],
                    turn * (n + sign * ways),
                )
                + turn * sign * shift
                for turn, (index, ways, shift) in zip((1.0, -1.0), sides, strict=True)
            ]
            for sign in (1.0, -1.0)
        ]
        (low, high), (other_low, other_high) = ends
        if self._independent:
            result = np.minimum(low, other_low) + np.minimum(high, other_high)
        else:
            result = np.minimum(low + high, other_low + other_high)
        index_a, index_b = sides[0][0], sides[1][0]
        balls: Array = scene.table.radius[index_a] + scene.table.radius[index_b]
        return result - balls
