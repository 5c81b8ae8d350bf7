"""Limits along ways that only inverse kinematics knows: sampled at nodes, kept per interval.

Second derivatives are differences of nodes, each a mean around its node; between two nodes the
derivative may be larger than at both. The change of the differences from node to node shows how
much: for a derivative that is a parabola over three intervals, 1/8 of that change between the
nodes, and 1/12 of it at them.
"""

from collections.abc import Callable, Sequence
from itertools import pairwise

from rapidgen.axes.kinematics import Posture
from rapidgen.motion.pieces import AxisLimits, Limits

_MARGIN = 1 / 3
"""Part of the change of differences that is added: 1/8 + 1/12 for a parabola, and some more."""
_CLOSE = 0.9
"""What the margin has to leave of path speed and acceleration; else nodes are too far apart."""


def interval_limits(
    nodes: Sequence[Posture], spacing: float, limits: AxisLimits, programmed: float = 1.0
) -> tuple[list[Limits], bool]:
    """Path speed and shares for each interval between equally spaced nodes, 6 or more.

    Also whether the nodes are close enough to show what is between them.
    """
    axes = [_curvings(nodes, j, spacing) for j in range(len(nodes[0]))]
    seen = zip(*[curvings for curvings, _ in axes], strict=True)
    beyond = zip(*[margins for _, margins in axes], strict=True)
    result, close = [], True
    for (a, b), curving, margin in zip(pairwise(nodes), seen, beyond, strict=True):
        least = [
            abs(y - x) / spacing + c * spacing / 2 for x, y, c in zip(a, b, curving, strict=True)
        ]
        most = tuple([rate + m * spacing / 2 for rate, m in zip(least, margin, strict=True)])
        curved = tuple([c + m for c, m in zip(curving, margin, strict=True)])
        own = limits.of_curve(most, curved, a, programmed)
        result.append(own)
        if close:
            close = _close(own, limits.of_curve(tuple(least), curving, a, programmed))
    return result, close


def _close(own: Limits, without: Limits) -> bool:
    """Whether limits with the margin are about those without it."""
    speed, shares = own
    other_speed, other_shares = without
    if speed < _CLOSE * other_speed:
        return False
    if not other_shares:
        return not shares
    return shares[0][0] * _CLOSE <= other_shares[0][0]


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


def cubics(
    nodes: Sequence[Posture], spacing: float, first: float
) -> list[Callable[[float], Posture]]:
    """Axis values at a place, for each interval between equally spaced nodes from `first` on.

    Cubics through the nodes with the slopes of quartics over five of them: with the steps that
    ways are sampled with, they are off the nodes' curve by a few 1e-7 rad at most.
    """
    axes = [_cubic([node[j] for node in nodes]) for j in range(len(nodes[0]))]
    return [
        _polynomial(first + k * spacing, 1 / spacing, [axis[k] for axis in axes])
        for k in range(len(nodes) - 1)
    ]


_Cubic = tuple[float, float, float, float]


def _cubic(q: Sequence[float]) -> list[_Cubic]:
    """Coefficients of one axis for each interval, by the share of the interval."""
    slopes = [_first(*q[:5]), _second(*q[:5])]
    slopes += [
        (a - e + 8 * (d - b)) / 12 for a, b, d, e in zip(q, q[1:], q[3:], q[4:], strict=False)
    ]
    slopes += [-_second(*q[:-6:-1]), -_first(*q[:-6:-1])]
    return [
        (a, m, 3 * (b - a) - 2 * m - n, 2 * (a - b) + m + n)
        for (a, b), (m, n) in zip(pairwise(q), pairwise(slopes), strict=True)
    ]


def _first(a: float, b: float, c: float, d: float, e: float) -> float:
    """Slope of a quartic at the first of five nodes."""
    return (-25 * a + 48 * b - 36 * c + 16 * d - 3 * e) / 12


def _second(a: float, b: float, c: float, d: float, e: float) -> float:
    """Slope of a quartic at the second of five nodes."""
    return (-3 * a - 10 * b + 18 * c - 6 * d + e) / 12


def _polynomial(start: float, factor: float, axes: Sequence[_Cubic]) -> Callable[[float], Posture]:
    def at(place: float) -> Posture:
        u = (place - start) * factor
        return tuple([a + (b + (c + d * u) * u) * u for a, b, c, d in axes])

    return at
