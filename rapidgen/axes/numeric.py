"""Inverse kinematics by iteration, for arms without a closed form (numpy)."""

from collections.abc import Callable, Sequence
from math import sqrt

import numpy as np

from rapidgen.axes.frames import Pose, conjugate, multiply, subtract

Values = tuple[float, ...]
_ROUNDS = 60
_POSITION, _ANGLE = 1e-9, 1e-9
_STEP = 1e-6
_LARGEST = 0.4
"""rad (or m) that one round may move a joint."""


def iterate(
    forward: Callable[[Values], Pose], pose: Pose, start: Values, moving: Sequence[int]
) -> Values | None:
    """Values that reach a pose, from a start, changing only the joints in `moving`.

    Damped least squares; None when it does not get there (out of reach, or a bad start).
    """
    values = list(start)
    error = _error(forward(tuple(values)), pose)
    damping = 1e-4
    for _ in range(_ROUNDS):
        size = _size(error)
        if size < _POSITION:
            return tuple(values)
        columns = []
        for index in moving:
            shifted = values.copy()
            shifted[index] += _STEP
            there = _error(forward(tuple(shifted)), pose)
            columns.append([(a - b) / _STEP for a, b in zip(error, there, strict=True)])
        jacobian = np.array(columns).T
        normal = jacobian.T @ jacobian
        gradient = jacobian.T @ np.array(error)
        for _ in range(8):
            step = np.linalg.solve(normal + damping * np.eye(len(moving)), gradient)
            longest = float(np.max(np.abs(step)))
            if longest > _LARGEST:
                step *= _LARGEST / longest
            trial = values.copy()
            for index, change in zip(moving, step, strict=True):
                trial[index] += float(change)
            found = _error(forward(tuple(trial)), pose)
            if _size(found) < size:
                values, error = trial, found
                damping = max(damping / 10, 1e-12)
                break
            damping *= 10
        else:
            return None
    return tuple(values) if _size(error) < 100 * _POSITION else None


def _error(have: Pose, want: Pose) -> Values:
    """Position (m) and rotation vector (rad) from one pose to the other."""
    w, x, y, z = multiply(want[1], conjugate(have[1]))
    if w < 0:
        w, x, y, z = -w, -x, -y, -z
    size = sqrt(x * x + y * y + z * z)
    factor = 2.0 if size < 1e-12 else 2 * float(np.arctan2(size, w)) / size
    return (*subtract(want[0], have[0]), factor * x, factor * y, factor * z)


def _size(error: Values) -> float:
    return max(map(abs, error))
