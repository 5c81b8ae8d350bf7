"""Accelerations of axes, fitted to logs of single-axis moves.

A move of one axis from standstill to standstill is a trapezoid of the speed, smoothed over the
ramp time of the motion model (`smoothing.py`). Three figures describe it: when it begins, its speed
and its acceleration. They are fitted to all samples of the move, so a log of ten samples a second
is enough, and what is fitted is what the virtual controller then plans with.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import exp, inf, isfinite, log, sqrt

import numpy as np
import numpy.typing as npt

from rapidgen.config.model import Joint
from rapidgen.motion.settings import MotionSettings

Array = npt.NDArray[np.float64]

RAMP = MotionSettings().ramp_time
_STILL = 2e-5
"""rad or m between two samples below which an axis counts as standing."""
_SHORTEST = 0.01
"""rad or m of a move that is fitted."""
_FEWEST = 4
"""Samples of a move that is fitted, at least, while the axis moves."""
TOO_FEW = "fewer than 4 samples while it moves: move further, or record more often (`state.rate`)"
_LARGEST_MISS = 0.02
"""Part of a move's length that its samples may be off the fitted move (RMS)."""
_UNCERTAIN = 0.1
"""Relative standard deviation of an acceleration above which the move says nothing of it."""
_REST = 0.15
"""s of standstill on both sides of a move that belong to its samples."""
_SHORT_RAMP, _LONG_RAMP = 0.01, 2.0
"""s from standstill to full speed between which the fit begins."""
_STARTS, _DESCENTS, _ROUNDS = 9, 5, 40
_EXACT = 1e-5
"""Part of a move's length: no other start of the fit is tried below this RMS."""
_RESOLUTION = 1e-5
"""rad or m by which samples are off at least."""
_SURE = 0.005
"""Relative deviation below which moves count alike."""


@dataclass(frozen=True, slots=True)
class MoveFit:
    """One move of one axis; rad or m, s."""

    axis: int
    start: float
    length: float
    speed: float
    acceleration: float
    deviation: float
    """Relative standard deviation of the acceleration."""
    miss: float
    """RMS of the samples' distance from the fitted move, rad or m."""
    posture: tuple[float, ...]
    """Axis values at the beginning."""
    doubt: str = ""
    """Why the acceleration is not used; empty if it is."""


@dataclass(frozen=True, slots=True)
class AxisFit:
    """The acceleration of one axis: the median of its moves, weighted by their certainty."""

    axis: int
    acceleration: float
    lowest: float
    highest: float
    miss: float
    """RMS over all its moves, rad or m."""
    moves: int


def identification_moves(
    start: Sequence[float], amplitudes: Sequence[float], axes: Sequence[str]
) -> list[tuple[float, ...]]:
    """Return targets, one after another from `start`, that move single axes in three postures.

    Axes 2 and 3 are folded and stretched by their amplitudes between the postures. No axis is ever
    further from its start than its amplitude. Axes with the amplitude 0 do not move.
    """
    folds = [axes.index(name) for name in ("rax_2", "rax_3") if name in axes]
    folds = [axis for axis in folds if amplitudes[axis] > 0.0]
    postures = [tuple(start)]
    for sign in (1.0, -1.0) if len(folds) == 2 else ():
        values = list(start)
        for axis, side in zip(folds, (sign, -sign), strict=True):
            values[axis] += side * amplitudes[axis]
        postures.append(tuple(values))
    targets: list[tuple[float, ...]] = []
    for posture in postures:
        targets.append(posture)
        for axis, amplitude in enumerate(amplitudes):
            if amplitude <= 0.0:
                continue
            for side in (1.0, -1.0):
                values = list(posture)
                values[axis] = start[axis] + side * amplitude
                targets.append(tuple(values))
            targets.append(posture)
    targets.append(tuple(start))
    return [b for a, b in zip([tuple(start), *targets], targets, strict=False) if a != b]


def fit_moves(times: Array, positions: Array, joints: Sequence[Joint]) -> list[MoveFit]:
    """Fit all moves of a single axis in samples (n,), (n, axes) of the controller's axes."""
    result = []
    for axis, first, last in _single_moves(times, positions):
        posture = tuple(positions[first].tolist())
        length = float(abs(positions[last, axis] - positions[first, axis]))
        if last - first - 1 < _FEWEST:
            unknown = (axis, float(times[first]), length, 0.0, 0.0, inf, inf, posture)
            result.append(MoveFit(*unknown, doubt=TOO_FEW))
            continue
        low = int(np.searchsorted(times, times[first] - _REST))
        high = int(np.searchsorted(times, times[last] + _REST, side="right"))
        values = positions[low:high, axis]
        # Neighbouring moves of other axes may lie within the rest.
        fit = _fit(times[low:high], np.abs(values - positions[first, axis]), joints[axis])
        begin, speed, acceleration, deviation, miss = fit
        doubt = ""
        if miss > _LARGEST_MISS * length:
            doubt = f"it is no trapezoid of the speed: {miss / length:.1%} of its length off"
        elif deviation > _UNCERTAIN:
            doubt = "too few samples while the speed changes: move faster, or further"
        result.append(
            MoveFit(axis, begin, length, speed, acceleration, deviation, miss, posture, doubt)
        )
    return result


def accelerations(moves: Sequence[MoveFit]) -> list[AxisFit]:
    """Return the accelerations of all axes that have a usable move."""
    result = []
    for axis in sorted({move.axis for move in moves}):
        own = [move for move in moves if move.axis == axis and not move.doubt]
        if own:
            own.sort(key=lambda move: move.acceleration)
            miss = sqrt(sum(move.miss**2 for move in own) / len(own))
            weights = np.cumsum([1 / (move.deviation**2 + _SURE**2) for move in own])
            middle = int(np.searchsorted(weights, weights[-1] / 2))
            values = [move.acceleration for move in own]
            result.append(AxisFit(axis, values[middle], values[0], values[-1], miss, len(own)))
    return result


def _single_moves(times: Array, positions: Array) -> list[tuple[int, int, int]]:
    """Return (axis, sample before, sample after) of moves that only one axis makes."""
    moves = []
    moving = np.abs(np.diff(positions, axis=0)) > _STILL
    busy = moving.any(axis=1)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], busy, [False]]).astype(int)))
    for first, last in edges.reshape(-1, 2).tolist():
        axes = np.flatnonzero(moving[first:last].any(axis=0))
        whole = first > 0 and last < len(times) - 1
        if len(axes) != 1 or not whole:
            continue
        axis = int(axes[0])
        steps = np.diff(positions[first : last + 1, axis])
        one_way = bool((steps >= 0).all() or (steps <= 0).all())
        if one_way and abs(positions[last, axis] - positions[first, axis]) >= _SHORTEST:
            moves.append((axis, first, last))
    return moves


# -- one move ---------------------------------------------------------------------------------


def _way(times: Array, length: float, values: Array) -> Array:
    """Return the way at times of a smoothed trapezoid: begin, log speed, log acceleration."""
    acceleration = exp(values[2])
    speed = min(exp(values[1]), sqrt(acceleration * length))
    rise, whole = speed / acceleration, length / speed + speed / acceleration
    after = times[:, None] - values[0] - np.array([0.0, rise, whole - rise, whole])
    signs = np.array([1.0, -1.0, -1.0, 1.0])

    def integral(t: Array) -> Array:
        positive = np.maximum(t, 0.0)
        cubes: Array = (acceleration / 6) * ((positive * positive * positive) @ signs)
        return cubes

    way: Array = (integral(after) - integral(after - RAMP)) / RAMP
    return way


def _fit(times: Array, way: Array, joint: Joint) -> tuple[float, float, float, float, float]:
    """Return begin, speed, acceleration, its relative deviation and the RMS of the residuals."""
    length = float(way[-1])
    moving = np.flatnonzero(way > length * 1e-3)
    first = float(times[max(0, moving[0] - 1)])
    fastest = float(np.max(np.diff(way) / np.diff(times)))
    spread = log(_LONG_RAMP / _SHORT_RAMP) / (_STARTS - 1)
    starts = [
        np.array([first, log(1.05 * fastest), log(joint.speed / _SHORT_RAMP) - k * spread])
        for k in range(_STARTS)
    ]
    starts.sort(key=lambda at: float(np.sum((way - _way(times, length, at)) ** 2)))
    miss, values = inf, starts[0]
    for start in starts[:_DESCENTS]:  # with few samples there are several minima
        reached = _descend(times, way, length, start)
        if reached[0] < miss:
            miss, values = reached
        if miss < _EXACT * length:
            break
    speed, acceleration = exp(values[1]), exp(values[2])
    slopes = _slopes(times, length, values)
    noise = max(_RESOLUTION, miss * sqrt(len(times) / max(1, len(times) - 3)))
    covariance = np.linalg.pinv(slopes.T @ slopes) * noise * noise
    deviation = sqrt(float(covariance[2, 2]))
    if float(np.abs(slopes[:, 2]).max()) * 0.5 < 1e-4 * length:
        deviation = inf
    return float(values[0]), min(speed, sqrt(acceleration * length)), acceleration, deviation, miss


def _descend(times: Array, way: Array, length: float, values: Array) -> tuple[float, Array]:
    """Fit by Levenberg and Marquardt from one start; return the RMS and the values."""

    damping, residual = 1e-3, way - _way(times, length, values)
    miss = float(residual @ residual)
    for _ in range(_ROUNDS):
        slopes = _slopes(times, length, values)
        normal, gradient = slopes.T @ slopes, slopes.T @ residual
        scale = np.diag(np.maximum(np.diag(normal), 1e-12))
        step = np.linalg.solve(normal + damping * scale, gradient)
        tried = values + np.clip(step, -1.0, 1.0)
        fresh = way - _way(times, length, tried)
        now = float(fresh @ fresh)
        if isfinite(now) and now < miss:
            done = miss - now < 1e-9 * miss
            values, residual, miss, damping = tried, fresh, now, max(damping / 4, 1e-9)
            if done:
                break
        else:
            damping *= 5
            if damping > 1e9:
                break
    return sqrt(miss / len(times)), values


def _slopes(times: Array, length: float, values: Array) -> Array:
    """Return derivatives of the shape by begin, log speed and log acceleration."""
    columns = []
    for k in range(3):
        step = np.zeros(3)
        step[k] = 1e-5
        above, below = (_way(times, length, at) for at in (values + step, values - step))
        columns.append((above - below) / 2e-5)
    return np.stack(columns, axis=1)
