"""External axes and base frames of a backup's robots, as its cfg describes them.

A robot model knows its own six axes. The cfg says where the robot stands, which unit moves it, and
which units hold work objects.

- A SINGLE moves along x (track) or turns about z of its base frame. The base frame of a robot that
  it moves is given in the world, for position 0 of the unit (EBRUUN: robots and tracks have the
  same positions).
- A ROBOT without a TCP (a gantry) has its geometry in ROBOT_TYPE and ARM_TYPE. The base frame of a
  robot that it moves is given in the frame of its last axis (targets of createchaos and gkr_timber
  have the quadrants of axis 1 that follow).
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import isclose

from rapidgen.axes import frames
from rapidgen.axes.frames import IDENTITY, Pose
from rapidgen.config.model import ChainLink, ExternalUnit, GroupConfig, Joint, Placement, Positioner
from rapidgen.diagnostics import Diagnostic, Severity, error
from rapidgen.system.controller_cfg import ControllerCfg
from rapidgen.system.mechanical_units import MechanicalUnit, RobotMount, UnitAxis, mount_of

LINEAR_SPEED, ANGULAR_SPEED = 1.0, 1.5708
"""m/s and rad/s of an axis whose speed no file gives: a usual track, a usual positioner."""
SPEED_TIME = 0.5
"""s from standstill to full speed of such an axis."""
_ROUNDED = 2e-5
_AXES = tuple(f"rax_{n}" for n in range(1, 7))


def with_cfg(
    group: GroupConfig, cfg: ControllerCfg | None
) -> tuple[GroupConfig, tuple[Diagnostic, ...]]:
    """Return a robot as the cfg of its controller describes it, and what cannot be simulated."""
    mount = mount_of(cfg, group.mechanical_unit) if cfg is not None else None
    if mount is None:
        return group, ()
    group = replace(group, joints=tuple(_limited(joint, mount) for joint in group.joints))
    # The seventh axis of a YuMi is a unit of its own in the cfg, and part of the arm here.
    own = {joint.axis for joint in group.joints}
    units = [u for u in mount.units if not own.intersection(axis.external for axis in u.axes)]
    group, report = _with_units(group, units, mount)
    return group, (*report, *(_missing(name) for name in mount.unknown))


def with_limits(group: GroupConfig, cfg: ControllerCfg | None) -> GroupConfig:
    """Return a robot with the axis limits of the cfg of its controller."""
    mount = mount_of(cfg, group.mechanical_unit) if cfg is not None else None
    if mount is None:
        return group
    return replace(group, joints=tuple(_limited(joint, mount) for joint in group.joints))


def _limited(joint: Joint, mount: RobotMount) -> Joint:
    """Return a joint with the limits of the cfg."""
    external = {a.external: (a.lower, a.upper) for u in mount.units for a in u.axes}
    limits = dict(zip(_AXES, mount.limits, strict=True)).get(joint.axis) or external.get(joint.axis)
    if limits is None:
        return joint
    # A value that differs in the rounding of the file only is the model's own.
    lower, upper = (
        own if isclose(own, limit, rel_tol=_ROUNDED) else limit
        for own, limit in zip((joint.lower, joint.upper), limits, strict=True)
    )
    return replace(joint, lower=lower, upper=upper)


def _with_units(
    group: GroupConfig, units: Sequence[MechanicalUnit], mount: RobotMount
) -> tuple[GroupConfig, list[Diagnostic]]:
    moved_by = next((u for u in units if u.name.casefold() == mount.moved_by.casefold()), None)
    chain: tuple[ChainLink, ...] = ()
    if moved_by is not None:
        chain = tuple(_chain(moved_by))
        base = _pose(mount.base)
        if moved_by.kind == "single":
            base = frames.compose(frames.invert(_pose(moved_by.base)), base)
        chain += tuple(_fixed(base))
    else:
        chain = tuple(_fixed(_pose(mount.base)))
    positioners = [Positioner(u.name, tuple(_chain(u))) for u in units if u is not moved_by]
    moving = [(unit, axis) for unit in units for axis in unit.axes if not axis.locked]
    external = tuple(
        ExternalUnit(
            unit.name,
            tuple(axis.external for axis in unit.axes if not axis.locked),
            unit.active,
            unit.may_deactivate,
        )
        for unit in units
    )
    result = replace(
        group,
        joints=(*group.joints, *(_joint(axis) for _, axis in moving)),
        chain=(*chain, *group.chain) if group.chain else (),
        external_units=(*group.external_units, *(unit.name for unit in units)),
        units=external,
        positioners=(*group.positioners, *positioners),
    )
    if mount.moved_by and moved_by is None and mount.moved_by in mount.unknown:
        result = replace(result, chain=group.chain)
    return result, [note for unit in units for note in _notes(unit)]


def _joint(axis: UnitAxis) -> Joint:
    usual = LINEAR_SPEED if axis.linear else ANGULAR_SPEED
    speed = axis.speed or usual
    return Joint(
        axis.joint,
        axis.external,
        "prismatic" if axis.linear else "revolute",
        axis.lower,
        axis.upper,
        speed,
        axis.acceleration or speed / SPEED_TIME,
        source="MOC.cfg",
    )


def _chain(unit: MechanicalUnit) -> Iterator[ChainLink]:
    """Yield the steps from the world to the frame that a unit moves."""
    before = frames.compose(_pose(unit.base), _pose(unit.pose))
    for axis in unit.axes:
        place: Pose = ((axis.length, 0.0, 0.0), frames.about((1.0, 0.0, 0.0), axis.attitude))
        turned: Pose = (axis.offset, frames.about((0.0, 0.0, 1.0), axis.turn))
        before = frames.compose(before, frames.compose(place, turned))
        if axis.locked:
            continue
        along = (1.0, 0.0, 0.0) if axis.linear and unit.kind == "single" else (0.0, 0.0, 1.0)
        yield ChainLink(axis.joint, before[0], _rpy(before), along)
        before = IDENTITY
    yield from _fixed(before)


def _fixed(pose: Pose) -> Iterator[ChainLink]:
    if any(abs(v) > 1e-12 for v in pose[0]) or frames.angle_between(pose[1], frames.UNIT) > 1e-9:
        yield ChainLink("", pose[0], _rpy(pose))


def _rpy(pose: Pose) -> tuple[float, float, float]:
    z, y, x = frames.to_zyx(pose[1])
    return x, y, z


def _pose(placement: Placement) -> Pose:
    return placement.position, placement.orientation


def _notes(unit: MechanicalUnit) -> Iterator[Diagnostic]:
    assumed = dict.fromkeys(text for axis in unit.axes if not axis.locked for text in axis.assumed)
    if assumed:
        yield _note(
            f"mechanical unit {unit.name} ({unit.type}): {', '.join(assumed)} are not in MOC.cfg",
            f"{LINEAR_SPEED:g} m/s or {ANGULAR_SPEED:.4g} rad/s are used",
        )
    for axis in unit.axes:
        if axis.follows:
            yield _note(
                f"mechanical unit {unit.name}: {axis.joint} follows {axis.follows} when they are "
                "linked, which is not simulated",
                "check motions with linked axes on the controller",
            )


def _missing(name: str) -> Diagnostic:
    return _note(
        f"mechanical unit {name} is not simulated: MOC.cfg has no joint or limits of it",
        "describe the robot with its units in a configuration, and select it with `--robot`",
    )


def _note(message: str, help: str) -> Diagnostic:
    return error("RG436", None, message, help, severity=Severity.WARNING)
