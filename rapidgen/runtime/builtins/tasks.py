"""What a task may ask about itself, the others and the controller."""

from collections.abc import Callable

from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.registry import builtin, builtins
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value

OP_MAN_TEST = 3
OP_MODES = {"auto": 1, "manual_reduced": 2}
RUN_CONT_CYCLE = 1


@builtin("GetTaskName")
def get_task_name(task: Task, number: Ref | None, mechanical: Ref | None) -> str:
    """GetTaskName: the own name; \\TaskNo and \\MecTaskNo count from 1."""
    tasks = list(task.controller.rapid_tasks.values())
    if number is not None:
        number.set(tasks.index(task) + 1)
    if mechanical is not None:
        moving = [t for t in tasks if task.controller.motion.is_motion_task(t.name)]
        mechanical.set(moving.index(task) + 1 if task in moving else 0)
    return task.name


@builtin("RobName")
def rob_name(task: Task) -> str:
    """RobName: the task's robot, or an empty string."""
    group = task.controller.motion.moved_by(task.name)
    return "" if group is None else group.config.mechanical_unit


@builtin("MotionPlannerNo")
def motion_planner_no(task: Task) -> int:
    """MotionPlannerNo: number of the task's group from 1; 0 without one."""
    motion = task.controller.motion
    group = motion.moved_by(task.name)
    return 0 if group is None else list(motion.groups.values()).index(group) + 1


def _task(task: Task, reference: Value, name: str | None) -> RapidTask:
    expected = name if name is not None else str(reference.value or "")
    for other in task.controller.rapid_tasks.values():
        if other.name.lower() == expected.lower():
            return other
    raise RapidError("ERR_TASKNAME", expected)


def _moves(task: Task) -> bool:
    return task.controller.motion.is_motion_task(task.name)


_CHECKED = {"NORMAL": 14, "STATIC": 15, "SEMISTATIC": 16}
"""TSP_NORMAL_CHECKED, TSP_STATIC_CHECKED, TSP_SEMISTATIC_CHECKED [mem]."""


# Programs run continuously here, and no task is switched off; \\Main changes neither.
_TOLD: dict[str, Callable[..., Value]] = {
    "OpMode": lambda task: OP_MODES.get(task.controller.mode, OP_MAN_TEST),
    "RunMode": lambda _task, _main: RUN_CONT_CYCLE,
    "NonMotionMode": lambda _task, _main: 0,
    "TaskRunRob": _moves,
    "TaskRunMec": _moves,
    "GetMecUnitName": lambda _task, unit: str(unit.value or ""),
    "GetTSPStatus": lambda task, *which: _CHECKED[_task(task, *which).spec.type],
    "TaskIsActive": lambda task, *which: _task(task, *which).state != "empty",
    "TaskIsExecuting": lambda task, *which: _task(task, *which).state == "running",
}
builtins(_TOLD)
