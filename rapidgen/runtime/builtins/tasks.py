"""What a task may ask about itself, the others and the controller."""

from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.registry import builtin
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value

OP_AUTO, OP_MAN_PROG, OP_MAN_TEST = 1, 2, 3
RUN_CONT_CYCLE = 1


@builtin("OpMode")
def op_mode(task: Task) -> int:
    """OpMode: OP_AUTO, OP_MAN_PROG or OP_MAN_TEST."""
    mode = task.controller.mode
    return {"auto": OP_AUTO, "manual_reduced": OP_MAN_PROG}.get(mode, OP_MAN_TEST)


@builtin("RunMode")
def run_mode(task: Task, main: bool | None) -> int:
    """RunMode: programs run continuously here; they are not stepped."""
    return RUN_CONT_CYCLE


@builtin("NonMotionMode")
def non_motion_mode(task: Task, main: bool | None) -> int:
    """NonMotionMode: off."""
    return 0


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


@builtin("TaskRunRob")
def task_run_rob(task: Task) -> bool:
    """TaskRunRob: whether the task moves a robot."""
    return task.controller.motion.is_motion_task(task.name)


@builtin("TaskRunMec")
def task_run_mec(task: Task) -> bool:
    """TaskRunMec: whether the task moves any mechanical unit."""
    return task_run_rob(task)


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


@builtin("GetMecUnitName")
def get_mec_unit_name(task: Task, unit: Value) -> str:
    """GetMecUnitName: name of a mechanical unit."""
    return str(unit.value or "")


def _task(task: Task, reference: Value, name: str | None) -> RapidTask:
    wanted = name if name is not None else str(reference.value or "")
    for other in task.controller.rapid_tasks.values():
        if other.name.lower() == wanted.lower():
            return other
    raise RapidError("ERR_TASKNAME", wanted)


@builtin("TaskIsActive")
def task_is_active(task: Task, reference: Value, name: str | None) -> bool:
    """TaskIsActive: no task is switched off here."""
    return _task(task, reference, name).state != "empty"


@builtin("TaskIsExecuting")
def task_is_executing(task: Task, reference: Value, name: str | None) -> bool:
    """TaskIsExecuting: whether its program runs."""
    return _task(task, reference, name).state == "running"
