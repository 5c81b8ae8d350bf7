"""The robot that a program without a controller seems to be written for: that which reaches its
targets, in the configurations that they name and with the tools and work objects that it declares.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

from rapidgen.axes import frames
from rapidgen.axes.default_postures import usual_start
from rapidgen.axes.frames import Pose
from rapidgen.axes.kinematics import AxisConfiguration, Kinematics
from rapidgen.axes.mapping import ABSENT, JointMap
from rapidgen.config import shipped_names
from rapidgen.config.model import GroupConfig
from rapidgen.config.model_cache import shipped_groups
from rapidgen.config.variant_group import group_of
from rapidgen.config.variant_library import variants
from rapidgen.controller.inference.move_targets import MoveTarget, move_targets
from rapidgen.rapid import Dialect, parse
from rapidgen.rapid.binding import TaskScope
from rapidgen.system.model import System

_MOST: Final = 24
"""Targets that are tried."""
_UNUSED: Final = 8e9
_ARM: Final = 0.9
"""m that an arm of seven axes reaches; a value of eax_a farther out is of an external axis."""
_SEVEN_AXES: Final = "irb14000"
_ORIGIN: Final = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class FlangeTarget:
    """Where a program wants the flange (m), in what configuration; or its axes, as RAPID's
    robax (deg, mm)."""

    flange: Pose | None
    configuration: AxisConfiguration = (0, 0, 0, 0)
    arm_angle: float | None = None
    """What eax_a may be of an arm with seven axes; None: it is not."""
    axes: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class RobotCandidate:
    """A model, and how many of the targets it reaches."""

    model: str
    reached: int
    targets: int


def infer_robot_model(system: System, default: str) -> RobotCandidate | None:
    """The first model that reaches most of what the programs of `system` aim at: `default`, the
    shipped ones, known variants. None: they aim at nothing that can be told."""
    result = list(dict.fromkeys(aims(system)))
    tried = result[:: 1 + len(result) // _MOST]
    if not tried:
        return None
    # Programs written by other tools give 0 to axes that a robot does not have.
    if all(aim.arm_angle is not None for aim in tried) and any(aim.arm_angle for aim in tried):
        return RobotCandidate(_SEVEN_AXES, len(tried), len(tried))
    best: RobotCandidate | None = None
    for name, group in _candidates(default):
        reached = _reached(group, tried)
        if best is None or reached > best.reached:
            best = RobotCandidate(name, reached, len(tried))
        if reached == len(tried):
            break
    return best


def _candidates(default: str) -> Iterator[tuple[str, GroupConfig]]:
    for name in dict.fromkeys((default, *shipped_names())):
        if name != _SEVEN_AXES:
            yield name, shipped_groups(name)[0]
    for variant in variants():
        group = None if variant.model else group_of(variant)
        if group is not None:
            yield variant.name, group


def _reached(group: GroupConfig, tried: Sequence[FlangeTarget]) -> int:
    kinematics = Kinematics.of(group)
    if kinematics is None or not kinematics.is_closed_form:
        return 0
    near = usual_start(group)
    return sum(1 for aim in tried if _reaches(group, kinematics, aim, near))


def _reaches(
    group: GroupConfig, kinematics: Kinematics, aim: FlangeTarget, near: tuple[float, ...]
) -> bool:
    if aim.flange is not None:
        result = kinematics.solutions(aim.flange, near, aim.configuration)
        return kinematics.fitting(result, aim.configuration, "turn") is not None
    # Of the axes beside the arm nothing is asked: they stay.
    expected = JointMap.of(group).from_rapid(aim.axes, (ABSENT,) * 6, near)
    return all(
        joint.lower - 1e-6 <= value <= joint.upper + 1e-6
        for joint, value in zip(group.joints, expected, strict=True)
        if joint.axis.startswith("rax")
    )


def aims(system: System) -> Iterator[FlangeTarget]:
    """What the moves of all tasks aim at, where that can be told without running them."""
    for spec in system.tasks:
        task = TaskScope()
        dialect = Dialect(system.robotware, some=not system.robotware_told)
        scopes = [task.add(parse(f.data, path=f.path, dialect=dialect)) for f in spec.modules]
        for scope in scopes:
            yield from map(_aim, move_targets(scope, roughly=True))


def _aim(result: MoveTarget) -> FlangeTarget:
    if result.place is None:
        return FlangeTarget(None, axes=result.axes)
    flange = frames.compose(result.place, frames.invert(result.tool))
    eax_a = result.external[0]
    near = abs(eax_a) < _UNUSED and frames.distance(result.place[0], _ORIGIN) < _ARM
    return FlangeTarget(flange, result.configuration, eax_a if near else None)
