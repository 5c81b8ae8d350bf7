"""Fit frames, displacements, spheres and tool points to measured points.

Lengths are mm, as measured. Only a best fit imports numpy. Sources: S4 datasys 3-DefFrame for
points that are too close; the built-ins FitSphere and similar ones.
"""

from collections.abc import Sequence
from typing import NamedTuple

from rapidgen.axes import frames
from rapidgen.axes.frames import Pose, Vector

_CLOSEST = 0.1
"""mm between the points of a frame (S4 datasys 3-DefFrame)."""
_STRAIGHT = 1e-4
_FLAT = 1e-9
"""Spread of points across a line or a plane, relative to their spread along it."""


class NoFit(Exception):
    """The points do not determine the figure."""


class Sphere(NamedTuple):
    """A sphere, and the deviations of the points from it."""

    centre: Vector
    radius: float
    rms: float
    largest: float
    worst: int
    """Index of the point with the largest deviation."""


def frame_through(first: Vector, second: Vector, third: Vector) -> Pose:
    """Return the frame at the first point.

    The second point is on its x axis and the third on the y side.

    NoFit: one is too close to the first, or all are on one line.
    """
    along, side = frames.subtract(second, first), frames.subtract(third, first)
    if min(frames.norm(along), frames.norm(side)) < _CLOSEST:
        raise NoFit("points closer than 0.1 mm")
    x, towards = frames.unit(along), frames.unit(side)
    if abs(frames.dot(x, towards)) > 1 - _STRAIGHT:
        raise NoFit("the points lie on one line")
    z = frames.unit(frames.cross(x, towards))
    y = frames.cross(z, x)
    return first, frames.from_matrix(((x[0], y[0], z[0]), (x[1], y[1], z[1]), (x[2], y[2], z[2])))


def displacement(old: Sequence[Vector], new: Sequence[Vector]) -> tuple[Pose, float, float]:
    """Return the best displacement of old points to new ones.

    Also the largest and the mean remaining distance.

    NoFit: all are on one line.
    """
    import numpy as np

    a, b = np.array(old), np.array(new)
    middle_a, middle_b = a.mean(axis=0), b.mean(axis=0)
    u, size, vt = np.linalg.svd((a - middle_a).T @ (b - middle_b))
    if size[1] < _CLOSEST**2:
        raise NoFit("the points lie on one line")
    sign = np.sign(np.linalg.det(vt.T @ u.T))
    rotation = vt.T @ np.diag([1.0, 1.0, sign]) @ u.T
    shift = middle_b - rotation @ middle_a
    errors = np.linalg.norm(a @ rotation.T + shift - b, axis=1)
    rows = [_vector(row) for row in rotation]
    turned = frames.from_matrix((rows[0], rows[1], rows[2]))
    return (_vector(shift), turned), float(errors.max()), float(errors.mean())


def sphere(points: Sequence[Vector]) -> Sphere:
    """Return the sphere through four or more points, by least squares.

    NoFit: they are in a plane.
    """
    import numpy as np

    at = np.array(points)
    middle = at.mean(axis=0)
    start = at - middle
    spread = np.linalg.svd(start, compute_uv=False)
    if spread[2] <= _FLAT * spread[0]:
        raise NoFit("the points lie in a plane")
    # |p - c|^2 = r^2 is linear in c and r^2 - |c|^2.
    matrix = np.column_stack([2 * start, np.ones(len(start))])
    solved = np.linalg.lstsq(matrix, (start**2).sum(axis=1), rcond=None)[0]
    result = float(np.sqrt(solved[3] + solved[:3] @ solved[:3]))
    errors = np.abs(np.linalg.norm(start - solved[:3], axis=1) - result)
    rms = float(np.sqrt((errors**2).mean()))
    centre = _vector(solved[:3] + middle)
    return Sphere(centre, result, rms, float(errors.max()), int(errors.argmax()))


class Circle(NamedTuple):
    """A circle in space, and the deviations of the points from it."""

    centre: Vector
    radius: float
    normal: Vector
    rms: float
    largest: float
    worst: int
    """Index of the point with the largest deviation."""


def circle(points: Sequence[Vector]) -> Circle:
    """Return the circle through three or more points, by least squares.

    It is in the plane that fits best.

    NoFit: they are on one line.
    """
    import numpy as np

    at = np.array(points)
    middle = at.mean(axis=0)
    start = at - middle
    _, spread, axes = np.linalg.svd(start)
    if spread[1] <= _FLAT * spread[0]:
        raise NoFit("the points lie on one line")
    flat = start @ axes[:2].T
    matrix = np.column_stack([2 * flat, np.ones(len(flat))])
    solved = np.linalg.lstsq(matrix, (flat**2).sum(axis=1), rcond=None)[0]
    radius = float(np.sqrt(solved[2] + solved[:2] @ solved[:2]))
    centre = solved[:2] @ axes[:2]
    # Deviation from the circle: across its plane, and along it.
    along = np.linalg.norm(flat - solved[:2], axis=1) - radius
    errors = np.hypot(along, start @ axes[2])
    rms = float(np.sqrt((errors**2).mean()))
    normal = axes[2] if axes[2][int(np.abs(axes[2]).argmax())] > 0 else -axes[2]
    worst = int(errors.argmax())
    return Circle(
        _vector(centre + middle), radius, _vector(normal), rms, float(errors[worst]), worst
    )


def held_point(flanges: Sequence[Pose]) -> tuple[Vector, list[float]]:
    """Return the tool point that all flanges share, and the deviations.

    NoFit: the flanges do not turn the tool.
    """
    import numpy as np

    rows, ends = [], []
    for place, turn in flanges:
        # turn * tcp + place = world, for the unknown tcp and world
        rows.append(np.hstack([np.array(frames.to_matrix(turn)), -np.eye(3)]))
        ends.append(-np.array(place))
    solved, _, rank, _ = np.linalg.lstsq(np.vstack(rows), np.concatenate(ends), rcond=1e-9)
    if rank < 6:
        raise NoFit("the postures do not turn the tool about two axes")
    off = [float(np.linalg.norm(row @ solved - end)) for row, end in zip(rows, ends, strict=True)]
    return _vector(solved[:3]), off


def _vector(values: Sequence[float]) -> Vector:
    x, y, z = values
    return float(x), float(y), float(z)
