"""Mechanical units and synchronised tasks."""

from collections.abc import Iterable

from rapidgen.config.model import Joint
from rapidgen.machine.scheduler import SyncPoint
from rapidgen.motion.group import MotionGroup
from rapidgen.runtime.builtins.control import wait_standing
from rapidgen.runtime.builtins.motion.targets import data_of, group_of, moving_group
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.motion_interface import NOT_ALLOWED
from rapidgen.runtime.registry import builtin
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value

# -- Mechanical units ------------------------------------------------------------------------------
#
# Mechanical units: which there are, and which of their axes move.
#
# Sources: S4 datasys 2-ActUnit, 2-DeactUnit; 3HAC050917 for IsMechUnitActive and GetNextMechUnit.


def _axes_of(group: MotionGroup, unit: str) -> tuple[str, ...] | None:
    """Return external axes of a mechanical unit, None if unknown.

    Without a cfg, the configuration lists units and axes in order. If each unit has one axis, they
    correspond; otherwise the last unit has all remaining axes.
    """
    known = next((u for u in group.config.units if u.name.lower() == unit.lower()), None)
    if known is not None:
        return known.axes
    names = [name.lower() for name in group.config.external_units]
    if unit.lower() not in names:
        return None
    axes = [j.axis for j in group.config.joints if j.axis.startswith("eax")]
    place = names.index(unit.lower())
    return tuple(axes[place:] if place == len(names) - 1 else axes[place : place + 1])


def _external(task: Task, unit: Value) -> tuple[MotionGroup, tuple[str, ...]]:
    """Return group and axes of an external unit.

    FatalError: the robot itself cannot be deactivated.
    """
    for group in task.controller.motion.groups.values():
        axes = _axes_of(group, unit.value)
        if axes is not None:
            return group, axes
    raise FatalError(NOT_ALLOWED, "Not a unit that can be switched", unit.value)


def _may_deactivate(group: MotionGroup, unit: str) -> bool:
    """Return False if the cfg of a unit forbids it (deactivation_forbidden)."""
    known = (u.may_deactivate for u in group.config.units if u.name.lower() == unit.lower())
    return next(known, True)


def unit_group(task: Task, unit: Value) -> MotionGroup:
    """Return the group of a mechanical unit, or raise ERR_AXIS_PAR."""
    for group in task.controller.motion.groups.values():
        own = unit.value.lower() == group.config.mechanical_unit.lower()
        if own or _axes_of(group, unit.value) is not None:
            return group
    raise RapidError("ERR_AXIS_PAR", unit.value)


def unit_axis(task: Task, unit: Value, number: float) -> tuple[MotionGroup, Joint]:
    """Return the axis of a mechanical unit by its number from 1.

    None means the task's robot. ERR_AXIS_PAR: the unit has no such axis.
    """
    group = group_of(task) if unit is None else unit_group(task, unit)
    axes = None if unit is None else _axes_of(group, unit.value)
    if axes is None:
        axes = tuple(f"rax_{k}" for k in range(1, 7))
    joints = {joint.axis: joint for joint in group.config.joints}
    if not 1 <= number <= len(axes) or axes[int(number) - 1] not in joints:
        raise RapidError("ERR_AXIS_PAR", f"axis {number:g}")
    return group, joints[axes[int(number) - 1]]


@builtin("ActUnit")
def act_unit(task: Task, unit: Value) -> None:
    """Wait for standstill, then activate the axes of a unit."""
    group, axes = _external(task, unit)
    group.wait_standing(task)
    group.inactive.difference_update(axes)


@builtin("DeactUnit")
def deact_unit(task: Task, unit: Value) -> None:
    """Wait for standstill, then deactivate the axes of a unit.

    ERR_AXIS_ACT: the path is a stored one.
    """
    group, axes = _external(task, unit)
    if not _may_deactivate(group, unit.value):
        raise FatalError(
            NOT_ALLOWED, "Not a unit that can be deactivated", f"{unit.value}: MECHANICAL_UNIT"
        )
    if group.path_level > 1:
        raise RapidError("ERR_AXIS_ACT", "between StorePath and RestoPath")
    group.wait_standing(task)
    group.inactive.update(axes)


@builtin("IsMechUnitActive")
def is_mech_unit_active(task: Task, unit: Value) -> bool:
    """Return True if a unit is active; a robot always is."""
    for group in task.controller.motion.groups.values():
        axes = _axes_of(group, unit.value)
        if axes is not None:
            return not group.inactive.intersection(axes)
    return True


@builtin("GetNextMechUnit")
def get_next_mech_unit(
    task: Task,
    number: Ref,
    name: Ref,
    reference: Value,
    is_robot: Ref | None,
    axes: Ref | None,
    task_number: Ref | None,
    planner: Ref | None,
    active: Ref | None,
    drive: Ref | None,
    may_deactivate: Ref | None,
) -> bool:
    """Return the next unit of the list, which starts at 0.

    Returns FALSE after the last one.
    """
    motion = task.controller.motion
    units = [
        (group, unit, place)
        for place, group in enumerate(motion.groups.values(), 1)
        for unit in (group.config.mechanical_unit, *group.config.external_units)
    ]
    index = int(number.get())
    if not 0 <= index < len(units):
        return False
    group, unit, place = units[index]
    own = _axes_of(group, unit)
    count = len(own) if own is not None else sum(j.axis[0] == "r" for j in group.config.joints)
    number.set(index + 1)
    name.set(unit)
    if reference is not None:
        reference.value = unit
    names = [task_name.lower() for task_name in task.controller.tasks]
    for where, value in (
        (is_robot, own is None),
        (axes, count),
        (task_number, names.index(group.config.task.lower()) + 1),
        (planner, place),
        (active, own is None or not group.inactive.intersection(own)),
        (drive, place),
        (may_deactivate, own is not None and _may_deactivate(group, unit)),
    ):
        if where is not None:
            where.set(value)
    return True


# -- Synchronised tasks ----------------------------------------------------------------------------
#
# Tasks that wait for each other: WaitSyncTask, and SyncMoveOn to SyncMoveUndo.
#
# Sources: 3HAC050917 for arguments; ETH's and Gramazio Kohler's cells [code] for lists with empty
# names; the rest of MultiMove [mem]. Between SyncMoveOn and SyncMoveOff moves of one \ID begin and
# end together (`together.py`).


_REFUSED = 194_910
"""Event of ours: ABB's numbers are not public."""


def _members(task: Task, tasks: Ref) -> frozenset[str]:
    """Return lower-case names of a task list without empty rows [code].

    ERR_TASKNAME: an unknown task, or a list without the calling task. An inferred cell ignores
    unknown tasks.
    """
    members = frozenset(entry.taskname.lower() for entry in tasks.get().values()) - {""}
    known = {t.name.lower() for t in task.controller.rapid_tasks.values()}
    if task.controller.meetings.any_task:
        return members & known | {task.name.lower()}
    if task.name.lower() not in members or not members <= known:
        raise RapidError("ERR_TASKNAME", ", ".join(sorted(members - known)) or task.name)
    return members


def _missing(absent: frozenset[str]) -> str:
    tasks = ", ".join(sorted(absent))
    return f"waits for {tasks}" if tasks else "all tasks have arrived"


def _meet(
    task: Task, point: object, members: frozenset[str], time_out: float | None, error: str
) -> None:
    """Wait for all members at a point; raise `error` after `time_out` s."""
    meetings = task.controller.meetings.points
    meeting = meetings.setdefault((point, members), SyncPoint(members))
    own = task.name.lower()
    meeting.arrived.add(own)
    if meeting.arrived == meeting.members:
        meeting.complete = True
        del meetings[point, members]
        meeting.changed.notify()
        return
    try:
        met = task.wait_for(
            lambda: meeting.complete,
            on=(meeting.changed,),
            timeout=time_out,
            why=lambda: _missing(members - meeting.arrived),
        )
    finally:
        if not meeting.complete:
            meeting.arrived.discard(own)
    if not met:
        raise RapidError(error)


def _point(task: Task, identity: Value) -> str:
    """Return the name of a syncident variable, which identifies it."""
    program = task.program
    for module in program.modules.values():
        for key in module.declarations:
            if program.value(module, key) is identity:
                return key
    return ""


@builtin("WaitSyncTask")
def wait_sync_task(
    task: Task, in_pos: bool | None, identity: Ref, tasks: Ref, time_out: float | None
) -> None:
    """Wait until all tasks of the list reach the point of that name.

    ERR_WAITSYNCTASK: after \\TimeOut.
    """
    if in_pos:
        wait_standing(task)
    members = _members(task, tasks)
    _meet(task, _point(task, identity), members, time_out, "ERR_WAITSYNCTASK")


# -- synchronised movement -----------------------------------------------------------------------


def _partners(task: Task) -> frozenset[str]:
    return data_of(task, group_of(task)).partners


def _synchronised(task: RapidTask) -> bool:
    motion = task.controller.motion
    if not motion.is_motion_task(task.name):
        return False
    data = data_of(task, group_of(task))
    return bool(data.partners) and not data.suspended


def _forget(task: Task, names: Iterable[str]) -> None:
    motion = task.controller.motion
    task.controller.meetings.end_together(_partners(task), task.scheduler.now)
    for other in task.controller.rapid_tasks.values():
        group = motion.moved_by(other.name) if other.name.lower() in names else None
        if group is not None:
            data = data_of(task, group)
            data.partners, data.suspended = frozenset(), False


@builtin("SyncMoveOn")
def sync_move_on(task: Task, identity: Ref, tasks: Ref, time_out: float | None) -> None:
    """Wait for all tasks of the list at standstill, then synchronise.

    ERR_SYNCMOVEON: after \\TimeOut.
    """
    group = moving_group(task)
    if _partners(task):
        raise FatalError(_REFUSED, "SyncMoveOn", "synchronised movement is on already")
    members = _members(task, tasks)
    wait_standing(task)
    _meet(task, ("on", _point(task, identity)), members, time_out, "ERR_SYNCMOVEON")
    data_of(task, group).partners = members
    task.controller.meetings.begin_together(members, task.scheduler.now)


@builtin("SyncMoveOff")
def sync_move_off(task: Task, identity: Ref, time_out: float | None) -> None:
    """Wait for all tasks, then end synchronisation.

    ERR_SYNCMOVEOFF: after \\TimeOut.
    """
    moving_group(task)
    members = _partners(task)
    if not members:
        raise FatalError(_REFUSED, "SyncMoveOff", "no synchronised movement is on")
    wait_standing(task)
    _meet(task, ("off", _point(task, identity)), members, time_out, "ERR_SYNCMOVEOFF")
    _forget(task, {task.name.lower()})


@builtin("SyncMoveUndo")
def sync_move_undo(task: Task) -> None:
    """End synchronised movement of all its tasks, if active."""
    moving_group(task)
    _forget(task, _partners(task))


@builtin("SyncMoveSuspend")
def sync_move_suspend(task: Task) -> None:
    """Make moves independent until SyncMoveResume.

    The instruction is permitted on the path level after StorePath.
    """
    _pause(task, suspended=True)


@builtin("SyncMoveResume")
def sync_move_resume(task: Task) -> None:
    """Synchronise moves again."""
    _pause(task, suspended=False)


def _pause(task: Task, *, suspended: bool) -> None:
    group = moving_group(task)
    data = data_of(task, group)
    members = data.partners
    name = "SyncMoveSuspend" if suspended else "SyncMoveResume"
    if not members or group.path_level == 1 or data.suspended == suspended:
        raise FatalError(
            _REFUSED, name, "it is permitted in synchronised movement after StorePath only"
        )
    _meet(task, name, members, None, "ERR_SYNCMOVEON")
    data.suspended = suspended
    meetings, now = task.controller.meetings, task.scheduler.now
    (meetings.end_together if suspended else meetings.begin_together)(members, now)


@builtin("TasksInSync")
def tasks_in_sync(task: Task, tasks: Ref) -> bool:
    """Return True if all tasks of the list move synchronously."""
    names = {entry.taskname.lower() for entry in tasks.get().values()} - {""}
    named = [t for t in task.controller.rapid_tasks.values() if t.name.lower() in names]
    return bool(named) and all(_synchronised(t) for t in named)


@builtin("IsSyncMoveOn")
def is_sync_move_on(task: Task) -> bool:
    """Return True if the task's robot moves synchronously."""
    return _synchronised(task)
