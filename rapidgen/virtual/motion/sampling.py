"""Limits along ways that only inverse kinematics knows: sampled at nodes, kept per interval."""

from collections.abc import Callable, Sequence
from itertools import pairwise

from rapidgen.virtual.motion.moves import Posture
from rapidgen.virtual.motion.pieces import AxisLimits


def interval_limits(
    nodes: Sequence[Posture], spacing: float, limits: AxisLimits
) -> list[tuple[float, float]]:
    """Path speed and acceleration for each interval between equally spaced nodes.

    First and second derivatives come from differences; each interval takes the larger value
    of its two ends, so a bend between nodes is seen from both sides.
    """
    count = len(nodes) - 1
    axes = range(len(nodes[0]))
    chords = [[(b[j] - a[j]) / spacing for j in axes] for a, b in pairwise(nodes)]
    bends = [
        [abs(after[j] - before[j]) / spacing for j in axes] for before, after in pairwise(chords)
    ]
    if not bends:
        bends = [[0.0 for _ in axes]]
    # The ends are extrapolated from their inner neighbours.
    ahead, behind = (bends[1], bends[-2]) if len(bends) > 1 else (bends[0], bends[0])
    first = [max(b, 2 * b - n) for b, n in zip(bends[0], ahead, strict=True)]
    last = [max(b, 2 * b - n) for b, n in zip(bends[-1], behind, strict=True)]
    at_nodes = [first, *bends, last]
    found = []
    for k in range(count):
        left, right = at_nodes[k], at_nodes[k + 1]
        curvings = tuple([max(left[j], right[j]) for j in axes])
        rates = tuple([abs(chords[k][j]) + curvings[j] * spacing / 2 for j in axes])
        found.append(limits.of_curve(rates, curvings))
    return found


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
