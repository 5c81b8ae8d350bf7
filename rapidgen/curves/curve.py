"""A dense curve of a tool: its points, its tool axis, and both at any arc length.

A file has one point a line: `x y z nx ny nz` (position and normal) or `x y z q1 q2 q3 q4` (pose, w
first), separated by commas, semicolons or blanks. A first line of names is skipped and must name
the columns in this order. Positions are in the unit that the caller gives, m inside.

Between the points the position is a cubic spline by arc length, and the tool axis turns at constant
rate (slerp), so a curve with points 20 mm apart is as smooth as one with points 0.5 mm apart. Both
are kept on a grid of equal steps. Beyond its ends a curve goes on straight with a constant
orientation, for the ways in which the robot gets up to speed and back to rest.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Final, TypeAlias

import numpy as np
import numpy.typing as npt

from rapidgen._reading import read_foreign
from rapidgen.axes import frames
from rapidgen.axes.frames import Pose
from rapidgen.diagnostics import Span, refusal

Array: TypeAlias = npt.NDArray[np.float64]

UNITS: Final = {"mm": 0.001, "m": 1.0, "in": 0.0254}
"""m per unit of positions."""
LARGEST: Final = 64 * 1024 * 1024
"""Bytes of a file."""
MOST: Final = 500_000
"""Points of a file."""
_LONGEST: Final = 6.0
"""m of extent above which a unit is wrong: no arm of ABB reaches across more than 6.3 m."""
_SHORTEST: Final = 0.001
_STEP: Final = 0.0005
_FEWEST, _MOST_STEPS = 400, 8000
_SAME: Final = 1e-7
"""m: points closer to each other are one."""
_COLUMNS: Final = {
    6: ("x", "y", "z", "nx", "ny", "nz"),
    7: ("x", "y", "z", "q1", "q2", "q3", "q4"),
}


@dataclass(frozen=True)
class Curve:
    """A curve on a grid of equal steps of arc length; lengths in m, axes of length 1."""

    step: float
    positions: Array
    """(n, 3), m."""
    axes: Array
    """(n, 3): z of the tool."""
    sideways: Array
    """(n, 3): x of the tool, with the rotation about the axis still free or already that of the
    poses."""
    is_pose: bool
    """True if the file gives the rotation about the tool axis."""
    points: int
    """Points of the file."""

    @property
    def length(self) -> float:
        """Return the arc length, m."""
        return self.step * (len(self.positions) - 1)

    @cached_property
    def tangents(self) -> Array:
        """Return unit tangents (n, 3)."""
        return _unit(np.gradient(self.positions, axis=0))

    def at(self, s: Array) -> tuple[Array, Array, Array]:
        """Return positions, z and x of the tool at arc lengths; straight beyond the ends."""
        inside = np.clip(s, 0.0, self.length) / self.step
        low = np.minimum(inside.astype(int), len(self.positions) - 2)
        part = (inside - low)[:, None]
        position, axis, side = (
            of[low] * (1 - part) + of[low + 1] * part
            for of in (self.positions, self.axes, self.sideways)
        )
        beyond = (s - np.clip(s, 0.0, self.length))[:, None]
        tangent = np.where(beyond > 0, self.tangents[-1], self.tangents[0])
        axis = _unit(axis)
        side = side - axis * np.sum(side * axis, axis=1, keepdims=True)
        return position + beyond * tangent, axis, _unit(side)

    def poses(self, s: Array, rotation: Array) -> list[Pose]:
        """Return tool poses at arc lengths, turned by `rotation` (rad) about the tool axis."""
        position, axis, side = self.at(s)
        other = np.cross(axis, side)
        c, d = np.cos(rotation)[:, None], np.sin(rotation)[:, None]
        x, y = c * side + d * other, c * other - d * side
        return [
            (tuple(p), _turn_of(a, b, z))
            for p, a, b, z in zip(
                position.tolist(), x.tolist(), y.tolist(), axis.tolist(), strict=True
            )
        ]

    def placed(self, pose: Pose) -> "Curve":
        """Return the curve moved by a pose."""
        turn = np.array(frames.to_matrix(pose[1]))
        return Curve(
            self.step,
            self.positions @ turn.T + np.array(pose[0]),
            self.axes @ turn.T,
            self.sideways @ turn.T,
            self.is_pose,
            self.points,
        )


def read_curve(path: Path, unit: str = "mm", *, inward: bool = False) -> Curve:
    """Read a curve.

    `inward`: the tool's z axis points against the normals, as for normals of a surface.
    Raises DiagnosticError: RG780 (not readable), RG781 (a value), RG782 (not a curve), RG783
    (unit).
    """
    try:
        text = read_foreign(path, LARGEST).decode("utf-8")
    except OSError as problem:
        raise refusal("RG780", _at(path), f"cannot read the curve: {problem.strerror}") from None
    except UnicodeDecodeError:
        raise refusal("RG780", _at(path), "the curve is not a text file", "give a CSV") from None
    rows, lines = _rows(text, path)
    values = np.array(rows)
    values[:, :3] *= UNITS[unit]
    _check_size(values, path, unit)
    return _resampled(values, lines, path, inward=inward)


def _at(path: Path, line: int = 1) -> Span:
    return Span(str(path), line, 1)


def _rows(text: str, path: Path) -> tuple[list[list[float]], list[int]]:
    """Return the numbers of all lines, and their line numbers."""
    rows: list[list[float]] = []
    lines: list[int] = []
    width = 0
    for number, line in enumerate(text.splitlines(), 1):
        cells = line.replace(",", " ").replace(";", " ").split()
        if not cells or cells[0].startswith("#"):
            continue
        try:
            row = [float(cell) for cell in cells]
        except ValueError:
            if not rows and not width:
                _check_names(cells, path, number)
                width = len(cells)
                continue
            raise refusal(
                "RG781", _at(path, number), f"not a number: {line.strip()[:40]!r}", _FORM
            ) from None
        width = width or len(row)
        if len(row) != width or width not in _COLUMNS:
            raise refusal(
                "RG781", _at(path, number), f"{len(row)} values, not {width or '6 or 7'}", _FORM
            )
        if not all(map(math.isfinite, row)):
            raise refusal(
                "RG781", _at(path, number), "a value is not finite", "remove or correct the line"
            )
        rows.append(row)
        lines.append(number)
        if len(rows) > MOST:
            raise refusal("RG782", _at(path, number), f"more than {MOST:,} points", _SPLIT)
    if not rows:
        raise refusal("RG782", _at(path), "the curve has no points", _FORM)
    return rows, lines


_FORM: Final = "one point a line: `x,y,z,nx,ny,nz` or `x,y,z,q1,q2,q3,q4`"
_SPLIT: Final = "split the curve, or leave out points"


def _check_names(cells: list[str], path: Path, line: int) -> None:
    names = tuple(cell.strip("\"'").casefold() for cell in cells)
    if names not in _COLUMNS.values():
        raise refusal("RG781", _at(path, line), f"unknown columns: {' '.join(cells)[:60]}", _FORM)


def _check_size(values: Array, path: Path, unit: str) -> None:
    extent = float(np.max(np.ptp(values[:, :3], axis=0)))
    if extent > _LONGEST or extent < _SHORTEST:
        others = [other for other in UNITS if other != unit]
        fitting = [
            other
            for other in others
            if _SHORTEST <= extent / UNITS[unit] * UNITS[other] <= _LONGEST
        ]
        size = f"{extent:.3g} m" if extent >= _SHORTEST else f"{extent * 1000:.3g} mm"
        help = f"use `--unit {fitting[0]}`" if fitting else "check the unit of the positions"
        raise refusal("RG783", _at(path), f"the curve extends over {size} in {unit}", help)


def _resampled(values: Array, lines: list[int], path: Path, *, inward: bool) -> Curve:
    """Return the curve of equal steps through the points."""
    count = len(values)
    distances = np.linalg.norm(np.diff(values[:, :3], axis=0), axis=1)
    kept = np.concatenate([[True], distances > _SAME])
    values = values[kept]
    if len(values) < 2:
        raise refusal("RG782", _at(path), "the curve has fewer than two different points", _FORM)
    is_pose = values.shape[1] == 7
    sizes = np.linalg.norm(values[:, 3:], axis=1)
    for row, size in enumerate(sizes):
        if not 0.9 <= size <= 1.1:
            line = np.array(lines)[kept][row]
            what = "quaternion" if is_pose else "normal"
            raise refusal(
                "RG781", _at(path, int(line)), f"a {what} of length {size:.3g}", "its length is 1"
            )
    places = values[:, :3]
    chords = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(places, axis=0), axis=1))])
    spline = _Spline(chords, places)
    # Arc length differs from the sum of chords: measured on the spline, four times as fine.
    fine = np.linspace(0.0, chords[-1], 4 * _steps(chords[-1]) + 1)
    along = spline.at(fine)
    arc = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(along, axis=0), axis=1))])
    steps = _steps(arc[-1])
    parameters = np.interp(np.linspace(0.0, arc[-1], steps + 1), arc, fine)
    positions = spline.at(parameters)
    if is_pose:
        axes, sideways = _turned(chords, values[:, 3:], parameters)
    else:
        axes = _slerped(chords, values[:, 3:] * (-1.0 if inward else 1.0), parameters)
        sideways = _transported(axes, _unit(np.gradient(positions, axis=0)), path)
    return Curve(float(arc[-1]) / steps, positions, axes, sideways, is_pose, count)


def _steps(length: float) -> int:
    return int(min(max(length / _STEP, _FEWEST), _MOST_STEPS))


def _slerped(chords: Array, normals: Array, parameters: Array) -> Array:
    """Return unit vectors between normals, turning at constant rate."""
    normals = _unit(normals)
    low = np.clip(np.searchsorted(chords, parameters, side="right") - 1, 0, len(chords) - 2)
    part = (parameters - chords[low]) / (chords[low + 1] - chords[low])
    one, other = normals[low], normals[low + 1]
    angle = np.arccos(np.clip(np.sum(one * other, axis=1), -1.0, 1.0))
    sine = np.sin(angle)
    flat = sine < 1e-9
    safe = np.where(flat, 1.0, sine)
    first = np.where(flat, 1 - part, np.sin((1 - part) * angle) / safe)
    second = np.where(flat, part, np.sin(part * angle) / safe)
    return _unit(first[:, None] * one + second[:, None] * other)


def _turned(chords: Array, turns: Array, parameters: Array) -> tuple[Array, Array]:
    """Return z and x of the tool between quaternions."""
    own = [frames.normalise((w, x, y, z)) for w, x, y, z in turns.tolist()]
    low = np.clip(np.searchsorted(chords, parameters, side="right") - 1, 0, len(chords) - 2)
    part = (parameters - chords[low]) / (chords[low + 1] - chords[low])
    result = np.array(
        [
            frames.to_matrix(frames.slerp(own[i], own[i + 1], f))
            for i, f in zip(low.tolist(), part.tolist(), strict=True)
        ]
    )
    return result[:, :, 2], result[:, :, 0]


def _transported(axes: Array, tangents: Array, path: Path) -> Array:
    """Return x of the tool: the first tangent, then turned no more than the axis turns."""
    first = tangents[0] - axes[0] * float(tangents[0] @ axes[0])
    if float(np.linalg.norm(first)) < 0.05:
        raise refusal(
            "RG782",
            _at(path),
            "the tool axis lies along the curve",
            "check the normals, or give poses",
        )
    result = np.empty_like(axes)
    side = first / np.linalg.norm(first)
    for row, axis in enumerate(axes):
        side = side - axis * float(side @ axis)
        side /= np.linalg.norm(side)
        result[row] = side
    return result


def _unit(vectors: Array) -> Array:
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    return vectors / np.where(lengths > 0, lengths, 1.0)


def _turn_of(x: Sequence[float], y: Sequence[float], z: Sequence[float]) -> frames.Quaternion:
    """Return the orientation with these axes."""
    return frames.from_matrix(((x[0], y[0], z[0]), (x[1], y[1], z[1]), (x[2], y[2], z[2])))


class _Spline:
    """A natural cubic spline through points; with two of them a line."""

    def __init__(self, knots: Array, values: Array) -> None:
        self.knots, self.values = knots, values
        n = len(knots)
        h = np.diff(knots)
        self.second = np.zeros_like(values)
        if n < 3:
            return
        slopes = np.diff(values, axis=0) / h[:, None]
        right = 6 * np.diff(slopes, axis=0)
        diagonal = 2 * (h[:-1] + h[1:])
        # Thomas algorithm: the matrix has three diagonals, and files have up to 500,000 points.
        for i in range(1, n - 2):
            factor = h[i] / diagonal[i - 1]
            diagonal[i] -= factor * h[i]
            right[i] -= factor * right[i - 1]
        for i in range(n - 3, -1, -1):
            following = h[i + 1] * self.second[i + 2] if i < n - 3 else 0.0
            self.second[i + 1] = (right[i] - following) / diagonal[i]

    def at(self, parameters: Array) -> Array:
        """Return values (n, 3) at parameters within the knots."""
        low = np.clip(
            np.searchsorted(self.knots, parameters, side="right") - 1, 0, len(self.knots) - 2
        )
        h = (self.knots[low + 1] - self.knots[low])[:, None]
        b = (parameters - self.knots[low])[:, None] / h
        a = 1 - b
        cubic = ((a**3 - a) * self.second[low] + (b**3 - b) * self.second[low + 1]) * h**2 / 6
        return a * self.values[low] + b * self.values[low + 1] + cubic
