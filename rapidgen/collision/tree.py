"""Moving frames of one or more robots in one world, for many postures at once.

A tree has a node for each moving joint, in an order in which parents come first. Values are joint
values in the sense of the URDF, one column for each joint of all robots: rad and m.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rapidgen.axes import frames
from rapidgen.collision.shapes import Array
from rapidgen.config.vectors import Vector

WORLD = -1
"""Index of the parent of nodes and bodies that stand in the world."""


@dataclass(frozen=True, slots=True)
class Node:
    """A moving joint.

    `fixed` is the pose of its frame, at value 0, in the frame of its parent node. Its value is the
    sum of factor * column.
    """

    name: str
    parent: int
    fixed: frames.Pose
    axis: Vector
    slides: bool
    columns: tuple[tuple[int, float], ...]


class Tree:
    """Nodes as arrays."""

    def __init__(self, nodes: Sequence[Node], columns: int) -> None:
        self.nodes = tuple(nodes)
        self.columns = columns
        count = len(self.nodes)
        self.mix = np.zeros((count, columns))
        """Value of each node for the columns."""
        self.slides = np.array([node.slides for node in nodes], dtype=np.bool_)
        self.ancestors = np.zeros((count + 1, count), dtype=np.bool_)
        """Nodes that move each node, itself included; the last row is the world's."""
        self._fixed: list[tuple[Array, Array]] = []
        self._axis: list[Array] = []
        for i, node in enumerate(self.nodes):
            for column, factor in node.columns:
                self.mix[i, column] += factor
            self.ancestors[i] = self.ancestors[node.parent]
            self.ancestors[i, i] = True
            rotation = np.array(frames.to_matrix(node.fixed[1]))
            self._fixed.append((rotation, np.array(node.fixed[0])))
            self._axis.append(np.array(node.axis))

    def poses(self, values: Array) -> tuple[Array, Array, Array]:
        """Return rotations (m, k + 1, 3, 3), positions (m, k + 1, 3) and axes (m, k, 3).

        `values` is (m, columns). The last pose is the world's, so that index -1 selects it.
        """
        many, count = len(values), len(self.nodes)
        amounts = values @ self.mix.T
        rotations = np.empty((many, count + 1, 3, 3))
        positions = np.empty((many, count + 1, 3))
        axes = np.empty((many, count, 3))
        rotations[:, count] = np.eye(3)
        positions[:, count] = 0.0
        for i, node in enumerate(self.nodes):
            rotation, position = self._fixed[i]
            above = rotations[:, node.parent]
            turned = above @ rotation
            axis = self._axis[i]
            axes[:, i] = turned @ axis
            positions[:, i] = positions[:, node.parent] + above @ position
            if self.slides[i]:
                positions[:, i] += axes[:, i] * amounts[:, i, None]
                rotations[:, i] = turned
            else:
                rotations[:, i] = turned @ _turns(axis, amounts[:, i])
        return rotations, positions, axes


def _turns(axis: Array, angles: Array) -> Array:
    """Return rotation matrices (m, 3, 3) about a unit axis [Rodrigues]."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    sine = np.sin(angles)[:, None, None]
    versine = (1 - np.cos(angles))[:, None, None]
    result: Array = np.eye(3) + sine * cross + versine * (cross @ cross)
    return result
