"""How far a robot was from the way through other places, looked at for all places together.

The TCP is found along the URDF's chain, not by the formulas with which the controller moves.
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
"""A row for each place: its TCP (m), or its axes where the robot's geometry is not known."""
_AT_ONCE = 16
"""Places that are compared together."""
_BACK, _AHEAD, _FASTER = 3, 40, 4
"""The way is followed from piece to piece, not left out: so many further at most, and from place to
place so many more."""


def movement(track: Track) -> tuple[float, list[Position]]:
    """s from the first movement to the last, and where the robot was meanwhile."""
    moving = [later for earlier, later in pairwise(track) if earlier[1] != later[1]]
    return (moving[-1][0] - moving[0][0], [place for _, place in moving]) if moving else (0.0, [])


def points(bench: Bench, places: Sequence[Position]) -> Points:
    """What is compared of some places."""
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
    """The largest distance of a point from the way through others, in their order."""
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
