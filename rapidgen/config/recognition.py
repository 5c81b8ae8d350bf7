"""Recognise the variant of a chain of joints.

Zero posture, senses and names do not matter. Distance and angle between neighbouring axes do not
depend on the joint positions. If they are a variant's, the joints are turned one after the other
until each axis is where the variant has it; that gives signs and zeros. Axes 1 and 6 have no zero
in this: the file's is kept.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise, product

from rapidgen.config.geometry import ArmAxes, Line, apply, distance, in_axis_frame, turn
from rapidgen.config.variant_library import (
    SAME_PLACE,
    SAME_TURN,
    Variant,
    closeness,
    family,
    variants,
)
from rapidgen.config.vectors import Vector, add, cross, dot, norm, scale, subtract, unit

_ROUGH = 0.01
"""m by which axes of an imprecise export may be off, if its name gives the type."""
_EXACT = math.radians(0.06)
"""A zero this close to a multiple of 15 degrees is that multiple."""
_STEP = math.radians(15)
_SCARA = [False, False, True, False]
_WITHOUT_LAST = 3
"""Axes of a SCARA whose export omits axis 4, which turns about the quill without visible effect."""


@dataclass(frozen=True, slots=True)
class Alignment:
    """Mapping of joints to axes: controller = sign * joint + offset (rad)."""

    variant: Variant
    others: tuple[str, ...]
    """Variants of the same geometry."""
    axes: tuple[str, ...]
    signs: tuple[int, ...]
    offsets: tuple[float, ...]
    certain: bool
    """True if no other senses fit as well."""
    rough: bool
    """True if some axis is farther off than sources differ: only the file's name tells."""


def align(lines: Sequence[Line], *names: str) -> Alignment | None:
    """Return the variant with these axes in chain order, or None."""
    return _aligned(lines, names, SAME_PLACE) or (
        _aligned(lines, names, _ROUGH) if family(*names) else None
    )


def _aligned(lines: Sequence[Line], names: tuple[str, ...], within: float) -> Alignment | None:
    expected = [_of_size(v.skeleton, len(lines)) for v in variants()]
    if len(lines) == _WITHOUT_LAST and [line.slides for line in lines] == [False, False, True]:
        # The quill turns where it slides: if axis 4 is omitted, that gives the forearm.
        lines = [replace(line, slides=False) for line in lines]
    known = {
        v.name: skeleton
        for v, skeleton in zip(variants(), expected, strict=True)
        if skeleton and _is_like(lines, skeleton.lines, within)
    }
    hits = [v for v in variants() if v.name in known]
    if within > SAME_PLACE:
        hits = [v for v in hits if v.family == family(*names)]
    message = family(*names)
    hits.sort(key=lambda v: (v.family == message, closeness(v, *names)), reverse=True)
    for variant in hits:
        result = sorted(
            _postures(lines, known[variant.name], within),
            key=lambda f: _plainness(f, lines[0].direction),
        )
        if not result:
            continue
        signs, values = result[0]
        up = lines[0].direction[2] * signs[0] > 0
        rivals = [
            other
            for other, v in result[1:]
            if other != signs
            and _effort(v) < _effort(values) + 0.02
            and (lines[0].direction[2] * other[0] > 0) == up
        ]
        offsets = tuple(-s * v for s, v in zip(signs, values, strict=True))
        same = [v.name for v in hits if v is not variant and _is_same(v, variant)]
        axes = tuple(line.axis for line in known[variant.name].lines)
        return Alignment(
            variant, tuple(same), axes, signs, offsets, not rivals, within > SAME_PLACE
        )
    return None


def _of_size(known: ArmAxes, size: int) -> ArmAxes | None:
    """Return a variant's axes if the number of axes fits.

    A SCARA may lack its last one.
    """
    if len(known.lines) == size:
        return known
    if size != _WITHOUT_LAST or [line.slides for line in known.lines] != _SCARA:
        return None
    lines = (*known.lines[:2], replace(known.lines[3], axis="rax_3"))
    return ArmAxes(lines, known.end)


def _is_same(a: Variant, b: Variant) -> bool:
    return [line.axis for line in a.skeleton.lines] == [
        line.axis for line in b.skeleton.lines
    ] and all(
        distance(x, y) <= SAME_PLACE
        for x, y in zip(
            in_axis_frame(a.skeleton).lines, in_axis_frame(b.skeleton).lines, strict=True
        )
    )


def _effort(values: Sequence[float]) -> float:
    return sum(abs(value) for value in values)


def _plainness(
    result: tuple[tuple[int, ...], tuple[float, ...]], first: Vector
) -> tuple[float, bool, int]:
    """Return a sort key: zeros of the file, upright arm, senses."""
    signs, values = result
    upright = first[2] * signs[0] > -1e-6
    return round(_effort(values), 2), not upright, sum(sign < 0 for sign in signs)


def _is_like(lines: Sequence[Line], known: Sequence[Line], within: float) -> bool:
    """True if neighbouring axes have the distances and angles of a variant."""
    if [line.slides for line in lines] != [line.slides for line in known] or len(lines) < 3:
        return False
    return all(
        abs(a[0] - b[0]) <= within and abs(a[1] - b[1]) <= SAME_TURN
        for a, b in zip(_neighbours(lines), _neighbours(known), strict=True)
    )


def _neighbours(lines: Sequence[Line]) -> Iterator[tuple[float, float]]:
    for a, b in pairwise(lines):
        angle = math.acos(min(1.0, abs(dot(a.direction, b.direction))))
        if a.slides or b.slides:
            yield 0.0, angle
            continue
        normal = cross(a.direction, b.direction)
        way = subtract(b.point, a.point)
        if norm(normal) < SAME_TURN:
            yield distance(a, b), angle
        else:
            yield abs(dot(way, unit(normal))), angle


def _postures(
    lines: Sequence[Line], known: ArmAxes, within: float
) -> Iterator[tuple[tuple[int, ...], tuple[float, ...]]]:
    """Yield signs and joint values that align the axes with the variant's."""
    there = in_axis_frame(known).lines
    for flips in product((1, -1), (1, -1)):
        current = in_axis_frame(ArmAxes(tuple(lines), (0.0, 0.0, 0.0)), flips).lines
        if not _lies_on(current[1], there[1], within):
            continue
        for values, posed in _turned(current, there, 1, within):
            signs = tuple(
                1 if dot(a.direction, b.direction) > 0 else -1
                for a, b in zip(posed, there, strict=True)
            )
            yield signs, (0.0, *values, 0.0)


def _turned(
    current: Sequence[Line], there: Sequence[Line], place: int, within: float
) -> Iterator[tuple[tuple[float, ...], Sequence[Line]]]:
    """Yield values of the joints from `place` on, and the turned axes.

    The last joint is left out.
    """
    if place == len(current) - 1:
        yield (), current
        return
    for value in _values(current[place], current[place + 1], there[place + 1]):
        posed = [
            *current[: place + 1],
            *(_moved(current[place], line, value) for line in current[place + 1 :]),
        ]
        if _lies_on(posed[place + 1], there[place + 1], within):
            for remaining, complete in _turned(posed, there, place + 1, within):
                yield (value, *remaining), complete


def _values(about: Line, line: Line, expected: Line) -> Iterator[float]:
    """Yield joint values that may bring the next axis to its place."""
    yield 0.0
    if about.slides:
        return
    result = []
    if abs(dot(line.direction, about.direction)) < 1 - 1e-5:
        for flip in (1, -1):
            result.append(_angle(about, line.direction, scale(expected.direction, flip)))
    else:
        foot, goal = (
            subtract(
                end.point,
                scale(about.direction, dot(subtract(end.point, about.point), about.direction)),
            )
            for end in (line, expected)
        )
        result.append(_angle(about, subtract(foot, about.point), subtract(goal, about.point)))
    for angle in result:
        if angle is not None and abs(angle) > _EXACT / 4:
            near = _STEP * round(angle / _STEP)
            yield near if abs(angle - near) < _EXACT else angle


def _angle(about: Line, first: Vector, second: Vector) -> float | None:
    """Return the angle between two directions about an axis."""
    axis = about.direction
    a = subtract(first, scale(axis, dot(first, axis)))
    b = subtract(second, scale(axis, dot(second, axis)))
    if norm(a) < 1e-6 or norm(b) < 1e-6:
        return None
    return math.atan2(dot(cross(a, b), axis), dot(a, b))


def _moved(about: Line, line: Line, value: float) -> Line:
    if not value:
        return line
    rotation = turn(about.direction, value)
    point = add(about.point, apply(rotation, subtract(line.point, about.point)))
    return Line(line.axis, point, apply(rotation, line.direction), line.slides)


def _lies_on(line: Line, expected: Line, within: float) -> bool:
    angle = math.acos(min(1.0, abs(dot(line.direction, expected.direction))))
    return angle <= 2 * SAME_TURN and (
        line.slides or expected.slides or distance(expected, line) <= 2 * within
    )
