"""Proof that boxes of joint values keep their clearances: every posture in them, in any order.

A box is the set of postures in which each joint is within its own range. It bounds what is not
known in advance, such as the way on which brakes bring the axes to rest, or where a guided robot
is between its position and its target. Boxes that the bounds do not prove are cut across the joint
with the largest range, with the pairs that are open in them.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rapidgen.collision.bounds import Bounds
from rapidgen.collision.proof import Verdict
from rapidgen.collision.scene import Scene
from rapidgen.collision.shapes import Array, Indices

TOLERANCE = 1e-3
"""m: boxes in which no pair loses more than this are not cut."""
_BATCH = 256
MOST = 5_000
"""Boxes of a proof; what is left then is not proved."""


@dataclass(frozen=True, slots=True)
class BoxViolation:
    """A pair of bodies that does not keep its clearance in a box: m.

    `box` is the number of the box, `values` (columns,) the posture at which `distance` holds.
    """

    pair: int
    verdict: Verdict
    box: int
    distance: float
    point: tuple[float, float, float]
    values: tuple[float, ...]


@dataclass(slots=True, eq=False)
class _Part:
    """A part of a box, with the pairs of shapes that are open in it."""

    box: int
    middle: Array
    half: Array
    pairs: Indices


def prove_boxes(low: Array, high: Array, scene: Scene, most: int = MOST) -> list[BoxViolation]:
    """Check all pairs of a scene in boxes from `low` to `high` (n, columns).

    Returns the first violation of each pair, by the number of its box; none means that all are
    proved. Raises ModuleNotFoundError for hulls without coal.
    """
    everything = np.arange(len(scene.first))
    middle, half = (low + high) / 2, np.abs(high - low) / 2
    waiting = [
        _Part(number, middle[number], half[number], everything) for number in range(len(low))
    ]
    waiting.reverse()
    found: dict[int, BoxViolation] = {}
    spent = 0
    while waiting:
        taken = [waiting.pop() for _ in range(min(_BATCH, len(waiting)))]
        spent += len(taken)
        rest = _step(scene, taken, found, is_over=spent > most)
        # The earliest boxes first.
        waiting += reversed(rest)
    return sorted(found.values(), key=lambda violation: violation.box)


def _step(
    scene: Scene, taken: Sequence[_Part], found: dict[int, BoxViolation], *, is_over: bool
) -> list[_Part]:
    """Prove parts and record violations; return the halves of what is open."""
    q = np.array([part.middle for part in taken])
    delta = np.array([part.half for part in taken])
    rows = np.repeat(np.arange(len(taken)), [len(part.pairs) for part in taken])
    pairs = np.concatenate([part.pairs for part in taken])
    open_pairs = np.array([n not in found for n in range(len(scene.pairs))], dtype=np.bool_)
    keep = open_pairs[scene.pair_of[pairs]]
    motion = (q, delta, np.zeros_like(delta), delta)
    bounds = Bounds(scene, motion, rows[keep], pairs[keep])
    is_last = (bounds.loss < TOLERANCE) | is_over
    ends = bounds.is_open & (bounds.is_near | is_last)
    for row in np.flatnonzero(ends).tolist():
        number = int(scene.pair_of[bounds.pairs[row]])
        part = taken[bounds.rows[row]]
        if number in found and found[number].box <= part.box:
            continue
        distance = float(bounds.far[row])
        verdict: Verdict = "contact" if distance <= 0 else "too near"
        if not bounds.is_near[row]:
            verdict = "not proved"
        x, y, z = ((bounds.on_first[row] + bounds.on_second[row]) / 2).tolist()
        values = tuple(part.middle.tolist())
        found[number] = BoxViolation(number, verdict, part.box, distance, (x, y, z), values)
    halves = []
    cut = np.flatnonzero(bounds.is_open & ~ends)
    for index in np.unique(bounds.rows[cut]).tolist():
        halves += _halves(taken[index], bounds.pairs[cut[bounds.rows[cut] == index]])
    return halves


def _halves(part: _Part, pairs: Indices) -> list[_Part]:
    axis = int(part.half.argmax())
    half, middle = part.half.copy(), part.middle.copy()
    half[axis] /= 2
    other = middle.copy()
    middle[axis] -= half[axis]
    other[axis] += half[axis]
    return [_Part(part.box, middle, half, pairs), _Part(part.box, other, half, pairs)]
