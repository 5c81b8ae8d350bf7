"""Axes of an arm as lines in space, and comparison of two arms.

Lines are those at the controller's zero. Points are m in the root of the chain, directions unit
vectors in the controller's sense. Arms are aligned by their axes 1 and 2, so that the position of a
base does not matter.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import TypeAlias

from rapidgen.config.draft import GroupDraft
from rapidgen.config.model import ChainLink
from rapidgen.config.vectors import Vector, add, cross, dot, norm, scale, subtract, unit

Matrix: TypeAlias = tuple[Vector, Vector, Vector]
_PARALLEL = 1e-3
IDENTITY: Matrix = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True, slots=True)
class Line:
    """One axis: a point on it, its direction and its name."""

    axis: str
    point: Vector
    direction: Vector
    slides: bool = False


@dataclass(frozen=True, slots=True)
class ArmAxes:
    """The axes of an arm along the chain, and the end of the chain."""

    lines: tuple[Line, ...]
    end: Vector
    facing: Matrix | None = None


@dataclass(frozen=True, slots=True)
class Difference:
    """Difference of two arms: `axis` with `distance` (m) or `angle` (rad).

    `turned` are the axes that turn the other way, `end` is the distance of the two flanges and
    `facing` the angle (rad) between them, 0 if one is not known.
    """

    axis: str
    distance: float
    angle: float
    turned: tuple[str, ...]
    end: float
    facing: float


def apply(m: Matrix, v: Vector) -> Vector:
    """Return matrix times vector."""
    return (dot(m[0], v), dot(m[1], v), dot(m[2], v))


def times(a: Matrix, b: Matrix) -> Matrix:
    """Return the matrix product."""
    x, y, z = (apply(a, (b[0][i], b[1][i], b[2][i])) for i in range(3))
    return ((x[0], y[0], z[0]), (x[1], y[1], z[1]), (x[2], y[2], z[2]))


def turn(axis: Vector, angle: float) -> Matrix:
    """Return the rotation about a unit vector."""
    c, s = math.cos(angle), math.sin(angle)
    x, y, z = axis
    k = 1 - c
    return (
        (c + x * x * k, x * y * k - z * s, x * z * k + y * s),
        (y * x * k + z * s, c + y * y * k, y * z * k - x * s),
        (z * x * k - y * s, z * y * k + x * s, c + z * z * k),
    )


def from_rpy(rpy: Vector) -> Matrix:
    """Return the rotation for fixed axes x, y, z, as in a URDF."""
    roll, pitch, yaw = rpy
    return times(
        turn((0.0, 0.0, 1.0), yaw),
        times(turn((0.0, 1.0, 0.0), pitch), turn((1.0, 0.0, 0.0), roll)),
    )


def skeleton(draft: GroupDraft, chain: Sequence[ChainLink] = ()) -> ArmAxes:
    """Return the axes of a group's arm with all controller axes at 0.

    `chain` replaces the group's own chain.
    """
    joints = {joint.name: joint for joint in draft.joints}
    at = {
        name: -joint.sign * joint.offset * (0.001 if joint.unit == "mm" else math.pi / 180)
        for name, joint in joints.items()
    }
    lines, end, facing = _along(chain or draft.chain, at)
    arm = [i for i, (step, _, _) in enumerate(lines) if joints[step.joint].axis.startswith("rax")]
    return ArmAxes(
        tuple(
            Line(
                joints[step.joint].axis,
                point,
                scale(direction, joints[step.joint].sign),
                joints[step.joint].unit == "mm",
            )
            for step, point, direction in lines[arm[0] : arm[-1] + 1]
        )
        if arm
        else (),
        end,
        facing,
    )


def _along(
    chain: Sequence[ChainLink], at: dict[str, float]
) -> tuple[list[tuple[ChainLink, Vector, Vector]], Vector, Matrix]:
    """Return each joint's place and direction, and the chain's end pose."""
    place: Vector = (0.0, 0.0, 0.0)
    turned = IDENTITY
    result = []
    for step in chain:
        place = add(place, apply(turned, step.xyz))
        turned = times(turned, from_rpy(step.rpy))
        if step.joint:
            result.append((step, place, apply(turned, step.axis)))
        amount = at[step.joint] if step.joint else sum(at[n] * k for n, k in step.follows)
        if amount:
            turned = times(turned, turn(step.axis, amount))
    return result, place, turned


def distance(a: Line, b: Line) -> float:
    """Return the distance of an axis from the other one's point."""
    way = subtract(a.point, b.point)
    return norm(subtract(way, scale(b.direction, dot(way, b.direction))))


def frame(first: Line, second: Line) -> tuple[Matrix, Vector]:
    """Return the frame of an arm: origin on axis 1, z along it, y along axis 2.

    If both are parallel, x points from the first to the second.
    """
    z = first.direction
    way = subtract(second.point, first.point)
    across = subtract(second.direction, scale(z, dot(second.direction, z)))
    if norm(across) > _PARALLEL:
        y = unit(across)
        x = cross(y, z)
        # the foot of the common normal
        normal = cross(z, second.direction)
        along = dot(cross(way, second.direction), normal) / dot(normal, normal)
        origin = add(first.point, scale(z, along))
    else:
        away = subtract(way, scale(z, dot(way, z)))
        x = unit(away) if norm(away) > 1e-6 else (1.0, 0.0, 0.0)
        y = cross(z, x)
        origin = first.point
    return (x, y, z), origin


def in_axis_frame(arm: ArmAxes, flips: tuple[int, int] = (1, 1)) -> ArmAxes:
    """Return the arm in the frame of its first two axes.

    `flips` reverses either of them.
    """
    first, second = (
        Line(line.axis, line.point, scale(line.direction, flip), line.slides)
        for line, flip in zip(arm.lines, flips, strict=False)
    )
    axes, origin = frame(first, second)
    return ArmAxes(
        tuple(
            Line(
                line.axis,
                apply(axes, subtract(line.point, origin)),
                apply(axes, line.direction),
                line.slides,
            )
            for line in arm.lines
        ),
        apply(axes, subtract(arm.end, origin)),
        None if arm.facing is None else times(axes, arm.facing),
    )


def compare(arm: ArmAxes, known: ArmAxes) -> Difference | None:
    """Return the difference of two arms; None for other axes."""
    if [line.axis for line in arm.lines] != [line.axis for line in known.lines]:
        return None
    if len(arm.lines) < 2:
        return None
    there = in_axis_frame(known)
    best: tuple[float, Difference] | None = None
    for flips in product((1, -1), (1, -1)):
        current = in_axis_frame(arm, flips)
        result = _difference(current, there)
        badness = result.distance + result.angle
        if best is None or badness < best[0] - 1e-9:
            best = badness, result
    assert best is not None
    return best[1]


def _difference(current: ArmAxes, there: ArmAxes) -> Difference:
    worst, axis, far, wide = -1.0, "", 0.0, 0.0
    turned = []
    for a, b in zip(current.lines, there.lines, strict=True):
        cosine = dot(a.direction, b.direction)
        if cosine < 0:
            turned.append(a.axis)
        angle = math.acos(min(1.0, abs(cosine)))
        apart = 0.0 if a.slides or b.slides else distance(b, a)
        far, wide = max(far, apart), max(wide, angle)
        if apart + angle > worst:
            worst, axis = apart + angle, a.axis
    end = norm(subtract(current.end, there.end))
    return Difference(axis, far, wide, tuple(turned), end, _apart(current.facing, there.facing))


def _apart(a: Matrix | None, b: Matrix | None) -> float:
    """Return the angle between two orientations."""
    if a is None or b is None:
        return 0.0
    trace = sum(dot(row, other) for row, other in zip(a, b, strict=True))
    return math.acos(max(-1.0, min(1.0, (trace - 1) / 2)))
