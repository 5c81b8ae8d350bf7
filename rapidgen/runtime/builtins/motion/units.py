"""Mechanical units: which there are, and which of their axes move.

Sources: S4 datasys 2-ActUnit, 2-DeactUnit; 3HAC050917 for IsMechUnitActive and GetNextMechUnit.
"""

from rapidgen.config.model import Joint
from rapidgen.motion.group import MotionGroup
from rapidgen.runtime.builtins.motion.task_group import group_of
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.motion_faults import NOT_ALLOWED
from rapidgen.runtime.registry import builtin
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value


def _axes_of(group: MotionGroup, unit: str) -> tuple[str, ...] | None:
    """External axes of a mechanical unit; None: it is none of this group's external ones.

    The configuration names units and axes in order: with one axis for each they belong
    together, otherwise the last unit has all that are left.
    """
    names = [name.lower() for name in group.config.external_units]
    if unit.lower() not in names:
        return None
    axes = [j.axis for j in group.config.joints if j.axis.startswith("eax")]
    place = names.index(unit.lower())
    return tuple(axes[place:] if place == len(names) - 1 else axes[place : place + 1])


def _external(task: Task, unit: Value) -> tuple[MotionGroup, tuple[str, ...]]:
    """Group and axes of an external unit. FatalError: the robot itself stays active."""
    for group in task.controller.motion.groups.values():
        axes = _axes_of(group, unit.value)
        if axes is not None:
            return group, axes
    raise FatalError(NOT_ALLOWED, "Not a unit that can be switched", unit.value)


def unit_group(task: Task, unit: Value) -> MotionGroup:
    """The group that a mechanical unit belongs to. ERR_AXIS_PAR: there is none."""
    for group in task.controller.motion.groups.values():
        own = unit.value.lower() == group.config.mechanical_unit.lower()
        if own or _axes_of(group, unit.value) is not None:
            return group
    raise RapidError("ERR_AXIS_PAR", unit.value)


def unit_axis(task: Task, unit: Value, number: float) -> tuple[MotionGroup, Joint]:
    """The axis of a mechanical unit (None: the task's own robot) by its number from 1.

    ERR_AXIS_PAR: the unit has no such axis.
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
    """Waits for standstill, then the unit's axes move with the others."""
    group, axes = _external(task, unit)
    group.wait_standing(task)
    group.inactive.difference_update(axes)


@builtin("DeactUnit")
def deact_unit(task: Task, unit: Value) -> None:
    """Waits for standstill, then the unit's axes stay. ERR_AXIS_ACT on a stored path."""
    group, axes = _external(task, unit)
    if group.path_level > 1:
        raise RapidError("ERR_AXIS_ACT", "between StorePath and RestoPath")
    group.wait_standing(task)
    group.inactive.update(axes)


@builtin("IsMechUnitActive")
def is_mech_unit_active(task: Task, unit: Value) -> bool:
    """Whether a unit is active; a robot always is."""
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
    """The next unit of the list: 0 begins it. FALSE behind the last one."""
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
        (may_deactivate, own is not None),
    ):
        if where is not None:
            where.set(value)
    return True
