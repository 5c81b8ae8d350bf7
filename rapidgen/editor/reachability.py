"""Reachability of a target by the robot of its program, for descriptions.

The robot is that of a generated folder, of a backup's MOC.cfg (exact type only) or of the project
file. With several robots, an unknown type, an arm whose inverse is an iteration, or a base that an
external unit moves, nothing is said. Limits and base frame are those of the controller's cfg.

Values of tools and work objects are initial ones: a program may change them.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from math import degrees, hypot, isfinite, prod, tau
from pathlib import Path

from rapidgen.axes import frames
from rapidgen.axes.default_postures import usual_start
from rapidgen.axes.frames import IDENTITY, Pose
from rapidgen.axes.kinematics import Kinematics, Posture
from rapidgen.axes.limits import outside
from rapidgen.config import from_manifest, load_config, shipped_names
from rapidgen.config.model import GroupConfig, Placement
from rapidgen.config.model_cache import shipped_groups
from rapidgen.diagnostics import DiagnosticError
from rapidgen.editor.project import Program
from rapidgen.rapid.builtins.signatures import Value
from rapidgen.system.folder import read_manifest
from rapidgen.system.mechanical_units import mount_of

_MOST_TURNS = 2000.0
"""Combinations of full turns within the ranges of all axes."""
_UNIT_ERROR = 0.1
"""Allowed error of the sum of squares of an orientation (S4 datasys 1-orient-1)."""


@dataclass(frozen=True, slots=True)
class Robot:
    """The only robot of a program."""

    kinematics: Kinematics
    base: Pose | None
    """Base frame in the world, m; None: an external unit moves the robot."""


@dataclass(frozen=True, slots=True)
class Frames:
    """Tool and work object of a move: names, and values as RAPID has them."""

    tool: str = "tool0"
    work_object: str = "wobj0"
    tool_value: Value | None = None
    """None: tool0."""
    work_object_value: Value | None = None
    """None: wobj0."""


@lru_cache(maxsize=4)
def robot_of(program: Program) -> Robot | None:
    """Return the robot of a program; None if there are several, or it is unknown."""
    try:
        groups = _groups(program)
    except (DiagnosticError, OSError):
        return None
    if len(groups) != 1:
        return None
    group, base = groups[0], IDENTITY
    system = program.system
    name = system.robot_types[0][0] if system and system.robot_types else group.mechanical_unit
    mount = mount_of(system.cfg, name) if system is not None and system.cfg is not None else None
    if mount is not None:
        limits = {f"rax_{n}": limit for n, limit in enumerate(mount.limits, 1)}
        joints = []
        for joint in group.joints:
            limit = limits.get(joint.axis)
            lower, upper = limit if limit is not None else (joint.lower, joint.upper)
            joints.append(replace(joint, lower=lower, upper=upper))
        group = replace(group, joints=tuple(joints))
        base = _pose(mount.base)
    # The solver lists every turn of every axis: a cfg with huge ranges would stop the server.
    turns = prod(max(1.0, (joint.upper - joint.lower) / tau) for joint in group.joints)
    if not turns < _MOST_TURNS:
        return None
    kinematics = Kinematics.of(group)
    if kinematics is None or not kinematics.is_closed_form:
        return None
    return Robot(kinematics, None if mount is not None and mount.moved_by else base)


def _groups(program: Program) -> Sequence[GroupConfig]:
    """Return the robots of a program. Raises DiagnosticError or OSError for unusable files."""
    if program.kind == "generated":
        return from_manifest(read_manifest(Path(program.root))["configuration"]).groups
    if program.kind == "project" and program.robot:
        return _named(program.robot)
    if program.system is None or len(program.system.robot_types) != 1:
        return ()
    from rapidgen.config.variant_group import group_of, variants_of

    variant, _ = variants_of(program.system.robot_types[0][1])
    if variant is None:
        return ()
    if variant.model:
        return shipped_groups(variant.model)
    group = group_of(variant)
    return (group,) if group is not None else ()


def _named(name: str) -> Sequence[GroupConfig]:
    """Return the robots of a shipped model, a variant or a configuration."""
    if name in shipped_names():
        return shipped_groups(name)
    from rapidgen.config.variant_group import group_of, variant_named

    variant = variant_named(name)
    if variant is None:
        return load_config(name).groups
    group = group_of(variant)
    return (group,) if group is not None else ()


def reachability(robot: Robot, of: str, value: Value, moved: Frames) -> str:
    """Return a line about a robtarget or jointtarget (deg, mm); empty if nothing is known."""
    match of, value:
        case "jointtarget", (axes, external):
            return _joint_target(robot, _numbers(axes, 6), _numbers(external, 6))
        case "robtarget", (trans, rot, conf, external):
            target = _frame((trans, rot))
            cf, extax = _numbers(conf, 4), _numbers(external, 6)
            flange = _flange(robot, target, moved) if target is not None else None
            if flange is None or cf is None or extax is None:
                return ""
            return _robot_target(robot, flange, cf, extax, moved)
    return ""


def _joint_target(
    robot: Robot, axes: tuple[float, ...] | None, external: tuple[float, ...] | None
) -> str:
    if axes is None or external is None:
        return ""
    kinematics = robot.kinematics
    start = usual_start(kinematics.group)
    faults = outside(kinematics.group.joints, kinematics.map.from_rapid(axes, external, start))
    if faults:
        return f"out of reach: {', '.join(map(str, faults))}"
    return "reachable: all axes are within their ranges"


def _robot_target(
    robot: Robot,
    flange: Pose,
    conf: tuple[float, ...],
    external: tuple[float, ...],
    moved: Frames,
) -> str:
    kinematics = robot.kinematics
    usual = usual_start(kinematics.group)
    placed = kinematics.map.from_rapid((0.0,) * 6, external, usual)
    # External axes are those of the target; the robot's axes begin at their usual start.
    start = tuple(
        new if joint.axis.startswith("eax") else old
        for joint, new, old in zip(kinematics.group.joints, placed, usual, strict=True)
    )
    expected = (int(conf[0]), int(conf[1]), int(conf[2]), int(conf[3]))
    postures = kinematics.solutions(flange, start, expected)
    how = f"with {moved.tool} and {moved.work_object}"
    if not postures:
        return f"out of reach {how}"
    posture = kinematics.fitting(postures, expected, "turn")
    if posture is not None:
        return f"reachable {how}: joints {_degrees(kinematics, posture)}"
    other = ",".join(map(str, kinematics.configuration(postures[0])))
    return (
        f"out of reach {how} in its configuration; "
        f"with [{other}]: joints {_degrees(kinematics, postures[0])}"
    )


def _degrees(kinematics: Kinematics, posture: Posture) -> str:
    parts = []
    for joint, value in zip(kinematics.group.joints, posture, strict=True):
        is_linear = joint.kind == "prismatic"
        text = f"{value * 1000 if is_linear else degrees(value):.2f}"
        parts.append(("0.00" if text == "-0.00" else text) + (" mm" if is_linear else "°"))
    return ", ".join(parts)


def _flange(robot: Robot, target: Pose, moved: Frames) -> Pose | None:
    """Return the flange in the robot's base frame; None if a frame is unknown."""
    if robot.base is None:
        return None
    tool, is_tool_held = IDENTITY, True
    if moved.tool_value is not None:
        match moved.tool_value:
            case (bool() as is_tool_held, frame, _) if (found := _frame(frame)) is not None:
                tool = found
            case _:
                return None
    object_, is_object_held = IDENTITY, False
    if moved.work_object_value is not None:
        match moved.work_object_value:
            # A user frame that a mechanical unit moves (ufprog FALSE) is not known.
            case (bool() as is_object_held, True, _, user, own):
                outer, inner = _frame(user), _frame(own)
                if outer is None or inner is None:
                    return None
                object_ = frames.compose(outer, inner)
            case _:
                return None
    point = frames.compose(object_, target)
    if is_tool_held == is_object_held:
        return None
    if is_tool_held:
        return frames.within(robot.base, frames.compose(point, frames.invert(tool)))
    # The robot holds the object, the tool is fixed in the world (S4 datasys 1-tooldata).
    return frames.within(robot.base, frames.compose(tool, frames.invert(point)))


def _pose(placement: Placement) -> Pose:
    return placement.position, placement.orientation


def _frame(value: Value) -> Pose | None:
    """Return a pose of RAPID (mm) in m; None if its orientation is invalid."""
    if not isinstance(value, tuple) or len(value) != 2:
        return None
    trans, rot = _numbers(value[0], 3), _numbers(value[1], 4)
    if trans is None or rot is None or abs(sum(q * q for q in rot) - 1.0) > _UNIT_ERROR:
        return None
    length = hypot(*rot)
    x, y, z = (v / 1000 for v in trans)
    a, b, c, d = (q / length for q in rot)
    return (x, y, z), (a, b, c, d)


def _numbers(value: Value, count: int) -> tuple[float, ...] | None:
    if not isinstance(value, tuple) or len(value) != count:
        return None
    numbers = tuple(float(v) for v in value if isinstance(v, int | float))
    return numbers if len(numbers) == count and all(map(isfinite, numbers)) else None
