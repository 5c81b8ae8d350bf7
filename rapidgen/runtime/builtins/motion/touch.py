"""ContactL, lead-through, GetJointData.

Sources: 3HAC050917 for ContactL and GetJointData, programs for their arguments [code yumipy]; that
SetLeadThrough \\On orders StopMove, \\Off ClearPath and StartMove [manual, in public notes].
There are no dynamics: torques are 0, and a robot touches something when a test says so
(`controller.motion.group(name).touch()`).
"""

from rapidgen.machine.scheduler import MS, S
from rapidgen.motion.group import MotionGroup
from rapidgen.runtime.builtins.motion.cartesian_request import cartesian_move
from rapidgen.runtime.builtins.motion.path import reason_of
from rapidgen.runtime.builtins.motion.synchronised_moves import together
from rapidgen.runtime.builtins.motion.task_group import data_of, group_of
from rapidgen.runtime.builtins.motion.units import unit_axis, unit_group
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.motion_faults import planned
from rapidgen.runtime.registry import Arguments, builtin, by_name
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value

_LED = "LeadThrough"
_CONTACT = "contact"


@by_name("ContactL", cost="move")
@planned
def contact_l(task: Task, _name: str, arguments: Arguments) -> None:
    """On a line until the robot touches something; what is left of the line goes.

    ERR_CONTACTL: it has come to the end without, and \\DesiredTorque is given [mem].
    """
    group, move = cartesian_move(task, _without_zone(arguments))
    touched: list[bool] = []

    def touch() -> None:
        touched.append(True)
        group.stop(_CONTACT, quick=True)

    leg = group.enqueue(together(task, group, move, arguments["ID"]))
    group.contacts.add(touch)
    try:
        if leg is not None:
            group.wait(task, leg, lambda: (leg.finished or bool(touched)) and group.is_settled)
    finally:
        group.contacts.remove(touch)
        if touched:
            group.clear_path()
            group.start(_CONTACT)
    if not touched and arguments["DesiredTorque"] is not None:
        raise RapidError("ERR_CONTACTL", "nothing was touched on the way")


def _without_zone(arguments: Arguments) -> dict[str, Value]:
    """It ends in a stop point: the program has to know whether there was contact."""
    return {name: value for name, value in arguments.items() if name != "Zone"}


@builtin("SetLeadThrough")
def set_lead_through(
    task: Task,
    on: bool | None,
    off: bool | None,
    no_stop: bool | None,
    no_start: bool | None,
    no_clear: bool | None,
) -> None:
    """The robot yields to hands, or holds its place again."""
    group = group_of(task)
    data_of(task, group).extra[_LED] = not off
    if off:
        if not no_clear:
            group.clear_path()
        if not no_start:
            group.start(reason_of(task))
    elif not no_stop:
        group.stop(reason_of(task))


@builtin("IsLeadThrough")
def is_lead_through(task: Task, unit: Value, active: bool | None, _set: bool | None) -> bool:
    """Whether lead-through is set; \\Active: and the robot stands, so that it yields."""
    group = group_of(task) if unit is None else unit_group(task, unit)
    led = bool(data_of(task, group).extra.get(_LED))
    return led and (group.is_standing or not active)


@builtin("GetJointData")
def get_joint_data(
    task: Task,
    unit: Value,
    axis: float,
    position: Ref | None,
    speed: Ref | None,
    torque: Ref | None,
    outer_torque: Ref | None,
) -> None:
    """Place and speed of an axis now, deg or mm and per s; its torques, 0 Nm. ERR_AXIS_PAR."""
    group, joint = unit_axis(task, unit, axis)
    now = task.scheduler.now
    current, before = (_axis(group, joint.axis, time) for time in (now, now - MS))
    for where, value in (
        (position, current),
        (speed, (current - before) * S / MS if now < group.motion.end else 0.0),
        (torque, 0.0),
        (outer_torque, 0.0),
    ):
        if where is not None:
            where.set(value)


def _axis(group: MotionGroup, axis: str, time: int) -> float:
    robot, external = group.map.to_rapid(group.motion.posture(max(time, group.motion.since)))
    kind, _, number = axis.partition("_")
    return robot[int(number) - 1] if kind == "rax" else external["abcdef".index(number)]
