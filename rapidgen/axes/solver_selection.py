"""Select the formulas of an arm from its axes at zero.

Names and signs do not matter.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import atan2, hypot

from rapidgen.axes import frames
from rapidgen.axes.chain import Step
from rapidgen.axes.four_axes import FourAxes, palletiser, scara
from rapidgen.axes.frames import IDENTITY, Pose, Vector
from rapidgen.axes.spherical_wrist import WristArm

_NEAR = 1e-6
_SIX = ("rax_1", "rax_2", "rax_3", "rax_4", "rax_5", "rax_6")
_SCARA = ("rax_1", "rax_2", "rax_3", "rax_4")
_PALLETISER = ("rax_1", "rax_2", "rax_3", "rax_6")


@dataclass(frozen=True)
class SixAxes:
    """An arm with six axes: its formulas, and their use of the joints."""

    arm: WristArm
    offset: tuple[float, float]
    """y, z of axis 6 at zero from where axes 4 and 5 meet."""
    first: int
    """Number of steps of the chain before axis 1."""
    signs: tuple[int, ...]
    places: tuple[int, ...]


@dataclass(frozen=True)
class Four:
    """An arm with four axes."""

    arm: FourAxes
    first: int
    """Number of steps of the chain before axis 1."""
    places: tuple[int, ...]


def six_axes(
    steps: tuple[Step, ...], axes: Mapping[str, int], linear: Sequence[bool]
) -> SixAxes | None:
    """Return the six-axis arm of a chain, or None.

    `axes` gives the indices of controller axes among the joints.
    """
    places = tuple(axes.get(axis, -1) for axis in _SIX)
    if -1 in places or any(linear[i] for i in places) or any(step.follows for step in steps):
        return None
    first = _first(steps, places)
    return None if first is None else _of_wrist(*_at_zero(steps[first:]), first, places)


def four_axes(
    steps: tuple[Step, ...], axes: Mapping[str, int], linear: Sequence[bool]
) -> Four | None:
    """Return the palletiser or SCARA of a chain, or None."""
    names = tuple(sorted(axis for axis in axes if axis.startswith("rax")))
    if names not in (_PALLETISER, _SCARA):
        return None
    places = tuple(axes[axis] for axis in names)
    first = _first(steps, places)
    if first is None:
        return None
    slides = [linear[i] for i in places]
    passive = [i for i, s in enumerate(steps) if s.follows]
    points, directions, flange = _at_zero(steps[first:])
    if slides == [False, False, True, False] and not passive:
        made: FourAxes | None = scara(points, directions, flange)
    elif not any(slides) and len(passive) == 1:
        step = steps[passive[0]]
        signs = {places[1]: directions[1][1], places[2]: directions[2][1]}
        wrist = IDENTITY
        for before in steps[first : passive[0] + 1]:
            wrist = frames.compose(wrist, before.fixed)
        across = frames.rotate(wrist[1], step.axis)[1]
        # The rods compensate the rotation of axes 2 and 3.
        if {i: k * across for i, k in step.follows} != {i: -v for i, v in signs.items()}:
            return None
        made = palletiser(points, directions, wrist[0], flange)
    else:
        return None
    return None if made is None else Four(made, first, places)


def _first(steps: tuple[Step, ...], places: tuple[int, ...]) -> int | None:
    """Return the step of axis 1, if all axes follow in order.

    Nothing else may move after it.
    """
    if tuple(s.joint for s in steps if s.joint in places) != places:
        return None
    first = next(i for i, s in enumerate(steps) if s.joint == places[0])
    return None if any(s.joint >= 0 and s.joint not in places for s in steps[first:]) else first


def _at_zero(steps: tuple[Step, ...]) -> tuple[list[Vector], list[Vector], Pose]:
    """Return points and directions of axes at zero, and the flange."""
    pose, points, axes = IDENTITY, [], []
    for step in steps:
        pose = frames.compose(pose, step.fixed)
        if step.joint >= 0:
            points.append(pose[0])
            axes.append(frames.rotate(pose[1], step.axis))
    return points, axes, pose


def _of_wrist(
    points: list[Vector], axes: list[Vector], flange: Pose, first: int, places: tuple[int, ...]
) -> SixAxes | None:
    signs = []
    for axis, n in zip(axes, (2, 1, 1, 0, 1, 0), strict=True):
        if abs(abs(axis[n]) - 1.0) > _NEAR:
            return None
        signs.append(1 if axis[n] > 0 else -1)
    if abs(points[0][0]) > _NEAR or abs(points[0][1]) > _NEAR:
        return None
    # Axis 4, and usually axis 6 (both along x), meet axis 5 in the wrist centre.
    x5, z5 = points[4][0], points[4][2]
    y4, z4 = points[3][1], points[3][2]
    y6, z6 = points[5][1], points[5][2]
    if abs(z4 - z5) > _NEAR:
        return None
    offset = (y6 - y4, z6 - z5)
    if max(map(abs, offset)) < _NEAR:
        offset = (0.0, 0.0)
    (x2, _, z2), (x3, _, z3) = points[1], points[2]
    back = frames.conjugate(flange[1])
    arm = WristArm(
        shoulder=(x2, z2),
        upper=(hypot(x3 - x2, z3 - z2), atan2(z3 - z2, x3 - x2)),
        fore=(hypot(x5 - x3, z5 - z3), atan2(z5 - z3, x5 - x3)),
        lateral=y4,
        flange=frames.rotate(back, frames.subtract(flange[0], (x5, y6, z6))),
        turn=flange[1],
    )
    if min(arm.upper[0], arm.fore[0]) < _NEAR:
        return None
    return SixAxes(arm, offset, first, tuple(signs), places)
