"""Deviation of a robot's track from a path, computed for all samples.

The TCP comes from the URDF's kinematic chain, not from the formulas of the controller.
"""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from rapidgen.axes import frames
from rapidgen.axes.kinematics import Kinematics
from rapidgen.verification.position_checks import Position, Track
from rapidgen.verification.testbench import Bench

Points: TypeAlias = NDArray[np.float64]
"""A row for each sample: its TCP (m), or its axes if the geometry is unknown."""
_AT_ONCE = 16
"""Samples compared in one step."""
_BACK, _AHEAD, _FASTER = 3, 40, 4
"""Search window along the path: pieces back, pieces ahead, and growth of the window per sample."""


def movement(track: Track) -> tuple[float, list[Position]]:
    """Return s from first to last movement, and the positions between."""
    moving = [later for earlier, later in pairwise(track) if earlier[1] != later[1]]
    return (moving[-1][0] - moving[0][0], [place for _, place in moving]) if moving else (0.0, [])


def points(bench: Bench, places: Sequence[Position]) -> Points:
    """Return the compared coordinates of some positions."""
    geometry = bench.motion_group.kinematics
    if geometry is None or not places:
        return np.array(places, float)
    return _tcp(geometry, bench.group.tool.frame.position, np.array(places))


def _tcp(geometry: Kinematics, tool: Sequence[float], places: Points) -> Points:
    joints = geometry.map.to_urdf(places.T)
    result = np.tile(np.array(tool, float), (len(places), 1))
    for step in reversed(geometry.steps):
        axis = np.array(step.axis)
        amount = joints[step.joint] if step.joint >= 0 else 0.0
        for joint, share in step.follows:
            amount = amount + joints[joint] * share
        turn = np.broadcast_to(amount, len(places))[:, None]
        if step.prismatic:
            result = result + turn * axis
        else:
            along = (result @ axis)[:, None] * axis
            result = along + np.cos(turn) * (result - along) + np.sin(turn) * np.cross(axis, result)
        origin, turned = step.fixed
        result = result @ [frames.rotate(turned, row) for row in _UNITS] + origin
    return result


_UNITS = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def farthest(seen: Points, path: Points) -> float:
    """Return the largest distance of a point from the path, in order."""
    if not len(seen) or len(path) < 2:
        return math.inf if len(seen) else 0.0
    start, along = path[:-1], np.diff(path, axis=0)
    length = np.maximum((along * along).sum(axis=1), np.finfo(float).tiny)
    at, worst = 0, 0.0
    for first in range(0, len(seen), _AT_ONCE):
        some = seen[first : first + _AT_ONCE, None]
        near = slice(max(0, at - _BACK), at + _AHEAD + _FASTER * len(some))
        away = some - start[near]
        share = np.clip(np.einsum("ijk,jk->ij", away, along[near]) / length[near], 0.0, 1.0)
        away -= share[..., None] * along[near]
        apart = np.sqrt(np.einsum("ijk,ijk->ij", away, away))
        piece, number = np.arange(apart.shape[1]), np.arange(len(some))[:, None]
        apart[piece + near.start >= at + _AHEAD + _FASTER * number] = np.inf
        worst = max(worst, float(apart.min(axis=1).max()))
        at = near.start + int(apart[-1].argmin())
    return worst
