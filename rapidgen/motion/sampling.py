"""Limits along ways that only inverse kinematics knows: sampled at nodes, kept per interval.

Second derivatives are differences of nodes, each a mean around its node; between two nodes the
derivative may be larger than at both. How much is told by how the differences change from node to
node: for a derivative that is a parabola over three intervals, 1/8 of that change between the
nodes, and 1/12 of it at them.
"""

from collections.abc import Callable, Sequence
from itertools import pairwise

from rapidgen.axes.kinematics import Posture
from rapidgen.motion.pieces import AxisLimits

_MARGIN = 1 / 3
"""Part of the change of differences that is added: 1/8 + 1/12 for a parabola, and some more."""
_CLOSE = 0.9
"""What the margin has to leave of path speed and acceleration; else nodes are too far apart."""


def interval_limits(
    nodes: Sequence[Posture], spacing: float, limits: AxisLimits
) -> tuple[list[tuple[float, float]], bool]:
    """Path speed and acceleration for each interval between equally spaced nodes, 6 or more.

    Also whether the nodes are close enough to tell what is between them.
    """
    axes = [_curvings(nodes, j, spacing) for j in range(len(nodes[0]))]
    seen = zip(*[curvings for curvings, _ in axes], strict=True)
    feared = zip(*[margins for _, margins in axes], strict=True)
    result, close = [], True
    for (a, b), curving, margin in zip(pairwise(nodes), seen, feared, strict=True):
        least = [
            abs(y - x) / spacing + c * spacing / 2 for x, y, c in zip(a, b, curving, strict=True)
        ]
        most = tuple([rate + m * spacing / 2 for rate, m in zip(least, margin, strict=True)])
        speed, acceleration = limits.of_curve(
            most, tuple([c + m for c, m in zip(curving, margin, strict=True)])
        )
        result.append((speed, acceleration))
        if close:
            bold_speed, bold_acceleration = limits.of_curve(tuple(least), curving)
            close = speed >= _CLOSE * bold_speed and acceleration >= _CLOSE * bold_acceleration
    return result, close


def _curvings(
    nodes: Sequence[Posture], axis: int, spacing: float
) -> tuple[list[float], list[float]]:
    """Largest second derivative of an axis in each interval as the nodes show it, and a margin."""
    bends = _bends(nodes, axis, spacing)
    changes = [abs(a - 2 * b + c) for a, b, c in zip(bends, bends[1:], bends[2:], strict=False)]
    changes = [changes[0], *changes, changes[-1]]
    sizes = [abs(bend) for bend in bends]
    return (
        [a if a > b else b for a, b in pairwise(sizes)],
        [_MARGIN * (a if a > b else b) for a, b in pairwise(changes)],
    )


def _bends(nodes: Sequence[Posture], axis: int, spacing: float) -> list[float]:
    """Second derivative of one axis at the nodes."""
    square = spacing * spacing
    inner = [
        (a[axis] - 2 * b[axis] + c[axis]) / square
        for a, b, c in zip(nodes, nodes[1:], nodes[2:], strict=False)
    ]
    return [_beyond(*inner[:4]), *inner, _beyond(*inner[:-5:-1])]


def _beyond(a: float, b: float, c: float, d: float) -> float:
    """What comes before four values that lie on a cubic."""
    return 4 * (a + c) - 6 * b - d


def largest_step(nodes: Sequence[Posture]) -> float:
    """The largest change of one axis between two nodes."""
    largest = 0.0
    for a, b in pairwise(nodes):
        for x, y in zip(a, b, strict=True):
            step = y - x if y > x else x - y
            if step > largest:
                largest = step
    return largest


def spaced(start: float, end: float, count: int) -> list[float]:
    """`count` + 1 places from start to end."""
    return [start + (end - start) * k / count for k in range(count + 1)]


def sample(at: Callable[[float], Posture], start: float, end: float, count: int) -> list[Posture]:
    """Postures at equally spaced places."""
    return [at(place) for place in spaced(start, end, count)]
