"""Positions, loads and maximum speeds."""

from collections.abc import Callable
from typing import Final

from rapidgen.config.plausibility import arm_of, mass_doubts
from rapidgen.motion.events import overload
from rapidgen.motion.fault_reasons import FaultReason, MotionFault
from rapidgen.motion.group import MotionGroup
from rapidgen.motion.moves import MoveFrames
from rapidgen.rapid.builtins.signatures import constant
from rapidgen.rapid.numbers import single
from rapidgen.runtime.builtins.motion.targets import (
    NoConfiguration,
    carrier_of,
    configuration_of,
    data_of,
    external_values,
    frame,
    geometry_of,
    group_of,
    here,
    joint_target,
    joints_for,
    named_group,
    rob_target,
    target_of,
)
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.registry import Arguments, builtin, builtins
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import LoadData, Orient, Pos, Pose, Ref, ToolData, Value, WobjData

# -- Positions -------------------------------------------------------------------------------------
#
# Reading and computing positions.
#
# Sources: S4 datasys 3-CJointT, 3-CRobT, 3-CTool; 3HAC050917 for CalcJointT and CalcRobT.


_NEXT_TO_NOTHING = single(0.001)
_UNREACHABLE = {
    FaultReason.NO_POSTURE: "ERR_OUTSIDE_REACH",
    FaultReason.NO_POSTURE_IN_RANGE: "ERR_ROBLIMIT",
}
_CONFIGURATION_ERRORS = {"limit": "ERR_ROBLIMIT", "reach": "ERR_OUTSIDE_REACH", "stop": ""}


def tool0() -> Value:
    """Return tooldata of the flange."""
    return ToolData(True, _identity(), load0())


def load0() -> Value:
    """Return loaddata of a minimal load."""
    return LoadData(_NEXT_TO_NOTHING, Pos(0, 0, _NEXT_TO_NOTHING), Orient(1, 0, 0, 0))


def wobj0() -> Value:
    """Return wobjdata of the world."""
    return WobjData(False, True, "", _identity(), _identity())


def _identity() -> Value:
    return Pose(Pos(0, 0, 0), Orient(1, 0, 0, 0))


def carrier_for(
    task: Task, group: MotionGroup, tool: Ref | None, work_object: Ref | None
) -> MoveFrames:
    """Return the frames of a tool and a work object.

    A missing argument means the active one, also the work object if the tool is given (S4 datasys
    3-CRobT-1).
    """
    data = data_of(task, group)
    return carrier_of(
        group,
        tool.get() if tool is not None else data.tool or tool0(),
        work_object.get() if work_object is not None else data.work_object,
    )


def here_of(task: Task, group: MotionGroup, tool: Ref | None, work_object: Ref | None) -> Value:
    """Return the current TCP as a robtarget in a displaced object frame."""
    carrier = carrier_for(task, group, tool, work_object)
    return rob_target(group, group.positions(), carrier, data_of(task, group).external_offset)


@builtin("CJointT")
def c_joint_t(task: Task, reference: Value, name: str | None) -> Value:
    """Return current arm-side angles and external axes.

    External axes include their offsets.
    """
    group = named_group(task, reference, name)
    return joint_target(group.map, group.positions(), data_of(task, group).external_offset)


@builtin("CRobT")
def c_rob_t(
    task: Task, reference: Value, name: str | None, tool: Ref | None, work_object: Ref | None
) -> Value:
    """Return the current TCP in the displaced object frame."""
    group = named_group(task, reference, name)
    return here_of(task, group, tool, work_object)


@builtin("CPos")
def c_pos(task: Task, tool: Ref | None, work_object: Ref | None) -> Value:
    """Return the position of `CRobT`."""
    return here_of(task, group_of(task), tool, work_object).trans


def _computed(task: Task) -> MotionGroup:
    """Return the group for a computation.

    ERR_NOT_MOVETASK: the switch `calc_in_background` forbids it.
    """
    moves = task.controller.motion.is_motion_task(task.name)
    if not moves and not task.controller.dialect.calc_in_background:
        raise RapidError("ERR_NOT_MOVETASK")
    return group_of(task)


@builtin("CalcRobT")
def calc_rob_t(task: Task, joints: Value, tool: Ref, work_object: Ref | None) -> Value:
    """Return the robtarget of a jointtarget."""
    group = _computed(task)
    offsets = data_of(task, group).external_offset
    posture = target_of(joints, group.map, group.positions(), offsets)
    return rob_target(group, posture, _carrier(group, tool, work_object), offsets)


@builtin("CalcJointT")
def calc_joint_t(
    task: Task,
    current: bool | None,
    target: Value,
    tool: Ref,
    work_object: Ref | None,
    number: Ref | None,
) -> Value:
    """Return the jointtarget of a robtarget in its configuration.

    Raises ERR_ROBLIMIT or ERR_OUTSIDE_REACH; with \\ErrorNumber it returns the number instead (0:
    reachable). A switch decides which of them an impossible configuration raises.
    """
    group = _computed(task)
    here = group.positions()
    offsets = data_of(task, group).external_offset
    external = external_values(target.extax, offsets)
    requested = group.map.from_rapid((0.0,) * 6, external, here)
    near = tuple(
        new if joint.axis.startswith("eax") else old
        for joint, new, old in zip(group.config.joints, requested, here, strict=True)
    )
    expected = configuration_of(target.robconf) if group.modal.check_joint else None
    # \UseCurWObjPos uses the present position of the object's unit, not that of the target.
    placed = _carrier(group, tool, work_object).at(here if current else near)
    flange = placed.flange(frame(target))
    try:
        check = group.settings.configuration_check
        try:
            posture = joints_for(geometry_of(group), flange, near, expected, check, here)
        except NoConfiguration as fault:
            name = _CONFIGURATION_ERRORS[task.controller.dialect.no_configuration]
            if not name:
                raise
            raise RapidError(name, " ".join(fault.arguments)) from fault
        except MotionFault as fault:
            # An error of the function, not of the motion system: a handler receives it.
            raise RapidError(_UNREACHABLE[fault.refusal], *map(str, fault.facts)) from fault
    except RapidError as error:
        if number is None:
            raise
        number.set(error.number)
        return joint_target(group.map, here, offsets)
    if number is not None:
        number.set(0)
    return joint_target(group.map, posture, offsets)


def _carrier(group: MotionGroup, tool: Ref, work_object: Ref | None) -> MoveFrames:
    return carrier_of(group, tool.get(), work_object.get() if work_object is not None else None)


@builtin("CTool")
def c_tool(task: Task, reference: Value, name: str | None) -> Value:
    """Return the tool of the last move."""
    tool: Value = data_of(task, named_group(task, reference, name)).tool or tool0()
    return tool.copy()


@builtin("CWObj")
def c_wobj(task: Task, reference: Value, name: str | None) -> Value:
    """Return the work object of the last move."""
    data = data_of(task, named_group(task, reference, name))
    work_object: Value = data.work_object or wobj0()
    return work_object.copy()


# -- Loads -----------------------------------------------------------------------------------------
#
# An undefined load stops the program; a load that is too heavy is reported.
#
# Loads do not change motion here, but motion and collision detection of a controller depend on
# them. Event 41438 was observed at EGMActJoint with a load of 0 kg (ros-industrial/abb_libegm,
# issue 73). Remembered only [mem]: a negative mass raises it at every move and in GripLoad
# (`undefined_load`). A move accepts a mass of 0, because no source says that a controller rejects
# it.


_UNDEFINED: Final = 41_438
_GRIPPED: Final = "GripLoad"


def payload_of(task: RapidTask, group: MotionGroup) -> Value:
    """Return the active payload.

    GripLoad or SetSysData set it; None: not set since PP to main.
    """
    return data_of(task, group).extra.get(_GRIPPED)


def carry(task: RapidTask, group: MotionGroup, load: Value, what: str) -> None:
    """Activate a payload. FatalError: it is undefined."""
    require_defined(task, group, load, what)
    data_of(task, group).extra[_GRIPPED] = load.copy()


def require_defined(
    task: RapidTask, group: MotionGroup, load: Value, what: str, *, zero: bool = True
) -> None:
    """Raise FatalError if a mass is negative or not a number.

    Without `zero` a mass of 0 is an error as well.
    """
    if load.mass >= 0 if zero else load.mass > 0:
        return
    title, text = "Undefined load", f"{what} has a mass of {load.mass:g} kg"
    if group.settings.undefined_load == "stop":
        raise FatalError(_UNDEFINED, title, text)
    task.controller.log.warning(_UNDEFINED, title, text, task=task.name)


def check_loads(task: Task, group: MotionGroup, arguments: Arguments) -> None:
    """Check the loads of a move.

    A load above the robot's payload is reported once per change. FatalError: a load is undefined.
    \\TLoad is the total load unless it is load0 (3HAC050917, MoveL).
    """
    total = arguments["TLoad"].get() if arguments.get("TLoad") is not None else None
    if total is not None and total != load0():
        loads = [("\\TLoad", total)]
    else:
        loads = [("the load of the tool", arguments["Tool"].get().tload)]
        payload = payload_of(task, group)
        loads += [("the payload", payload)] if payload is not None else []
    for what, load in loads:
        require_defined(task, group, load, what)
    mass = sum(load.mass for _, load in loads)
    data = data_of(task, group)
    if mass == data.carried:
        return
    data.carried = mass
    # The payload of an inferred robot is an assumption.
    if task.controller.motion.is_any_robot:
        return
    for doubt in mass_doubts(mass, arm_of(group.config)):
        place = here(task)
        overload(task.controller.log, group.name, doubt.message, place() if place else None)


# -- Maximum speeds --------------------------------------------------------------------------------
#
# MaxRobReorientSpeed and its relatives, CornerPathWarning.
#
# Sources: 3HAC050917 for the names; the speeds are those of the predefined vmax [mem].


def _part_of_vmax(place: int) -> Callable[[Task], Value]:
    vmax = constant("vmax")
    assert vmax is not None
    assert isinstance(vmax.value, tuple)
    speed = vmax.value[place]
    return lambda _task: speed


def _corner_path_warning(task: Task, warning: bool) -> None:
    """Enable the report of corners that become stop points (50024).

    The setting applies until PP to main.
    """
    group_of(task).modal.corner_warning = warning


_PLAIN: dict[str, Callable[..., Value]] = {
    "MaxRobReorientSpeed": _part_of_vmax(1),
    "MaxExtLinearSpeed": _part_of_vmax(2),
    "MaxExtReorientSpeed": _part_of_vmax(3),
    "CornerPathWarning": _corner_path_warning,
}
builtins(_PLAIN)
