"""Alignment of a configuration's chain with a description.

A configuration may take its chain from a known model and its appearance from a description whose
root is another one: of a YuMi, for example, whose arms share one body. Both move alike, so for
postures q with `D(q)` the description's last link and `K(q)` the chain's end there are a root X and
a flange F with D(q) F = X K(q). Two postures give A X = X B, which is solved as in hand-eye
calibration [Park & Martin 1994].
"""

import random
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from rapidgen.axes import frames
from rapidgen.axes.frames import Pose
from rapidgen.axes.kinematics import Posture

_POSTURES = 12
_TURN = 0.4
"""rad or m: movement of the joints for the measurement."""
_SAME = 1e-3
"""m and rad: tolerance of the alignment."""
_NEAR = 1e-6
"""m and rad: tolerance of equal roots."""
Matrix = NDArray[np.float64]


def aligned(
    description: Callable[[Posture], Pose], chain: Callable[[Posture], Pose], count: int
) -> tuple[Pose, Pose] | None:
    """Return X and F for `count` joints; None if the motions differ."""
    chance = random.Random(1)
    postures = [(0.0,) * count] + [
        tuple(chance.uniform(-_TURN, _TURN) for _ in range(count)) for _ in range(_POSTURES)
    ]
    seen = [description(q) for q in postures]
    meant = [chain(q) for q in postures]
    root = frames.IDENTITY
    flange = frames.within(seen[0], meant[0])
    if not _holds(seen, meant, root, flange, _NEAR):
        root = _root(seen, meant)
        flange = frames.within(seen[0], frames.compose(root, meant[0]))
    return (root, flange) if _holds(seen, meant, root, flange, _SAME) else None


def _holds(seen: list[Pose], meant: list[Pose], root: Pose, flange: Pose, within: float) -> bool:
    return all(
        max(map(abs, frames.error(frames.compose(d, flange), frames.compose(root, k)))) < within
        for d, k in zip(seen, meant, strict=True)
    )


def _root(seen: list[Pose], meant: list[Pose]) -> Pose:
    """Return X of A X = X B: rotation from the turns' axes, then position."""
    moved = [
        (frames.compose(d, frames.invert(seen[0])), frames.compose(k, frames.invert(meant[0])))
        for d, k in zip(seen[1:], meant[1:], strict=True)
    ]
    there, current = (np.array([_turn(pair[i]) for pair in moved]) for i in (0, 1))
    left, _, right = np.linalg.svd(there.T @ current)
    mirror = np.diag([1.0, 1.0, float(np.sign(np.linalg.det(left @ right)))])
    rotation: Matrix = left @ mirror @ right
    # (R_A - 1) x = R_X t_B - t_A
    rows = np.concatenate([np.array(frames.to_matrix(a[1])) - np.eye(3) for a, _ in moved])
    values = np.concatenate([rotation @ b[0] - a[0] for a, b in moved])
    x, y, z = np.linalg.lstsq(rows, values, rcond=1e-9)[0].tolist()
    r = rotation.tolist()
    matrix = tuple((row[0], row[1], row[2]) for row in r)
    return (x, y, z), frames.from_matrix((matrix[0], matrix[1], matrix[2]))


def _turn(pose: Pose) -> list[float]:
    axis, angle = frames.to_axis(pose[1])
    return [value * angle for value in axis]
