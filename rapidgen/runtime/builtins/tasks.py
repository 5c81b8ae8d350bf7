"""What a task may ask about itself, the others and the controller."""

from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.registry import builtin
from rapidgen.runtime.task.running import RapidTask
from rapidgen.runtime.values import Ref, Value

OP_AUTO, OP_MAN_PROG, OP_MAN_TEST = 1, 2, 3
RUN_CONT_CYCLE = 1


@builtin("OpMode")
def op_mode(task: RapidTask) -> int:
    """OpMode: OP_AUTO, OP_MAN_PROG or OP_MAN_TEST."""
    mode = task.controller.mode
    return {"auto": OP_AUTO, "manual_reduced": OP_MAN_PROG}.get(mode, OP_MAN_TEST)


@builtin("RunMode")
def run_mode(task: RapidTask, main: bool | None) -> int:
    """RunMode: programs run continuously here; they are not stepped."""
    return RUN_CONT_CYCLE


@builtin("NonMotionMode")
def non_motion_mode(task: RapidTask, main: bool | None) -> int:
    """NonMotionMode: off."""
    return 0


@builtin("GetTaskName")
def get_task_name(task: RapidTask, number: Ref | None, mechanical: Ref | None) -> str:
    """GetTaskName: the own name; \\TaskNo and \\MecTaskNo count from 1."""
    tasks = list(task.controller.rapid_tasks.values())
    if number is not None:
        number.set(tasks.index(task) + 1)
    if mechanical is not None:
        moving = [t for t in tasks if task.controller.motion.is_motion_task(t.name)]
        mechanical.set(moving.index(task) + 1 if task in moving else 0)
    return task.name


@builtin("TaskRunRob")
def task_run_rob(task: RapidTask) -> bool:
    """TaskRunRob: whether the task moves a robot."""
    found: bool = task.controller.motion.is_motion_task(task.name)
    return found


@builtin("TaskRunMec")
def task_run_mec(task: RapidTask) -> bool:
    """TaskRunMec: whether the task moves any mechanical unit."""
    return task_run_rob(task)


@builtin("RobName")
def rob_name(task: RapidTask) -> str:
    """RobName: the task's robot, or an empty string."""
    motion = task.controller.motion
    if not motion.is_motion_task(task.name):
        return ""
    name: str = motion.of_task(task.name).config.mechanical_unit
    return name


@builtin("MotionPlannerNo")
def motion_planner_no(task: RapidTask) -> int:
    """MotionPlannerNo: number of the task's group from 1; 0 without one."""
    motion = task.controller.motion
    if not motion.is_motion_task(task.name):
        return 0
    return list(motion.groups.values()).index(motion.of_task(task.name)) + 1


@builtin("GetMecUnitName")
def get_mec_unit_name(task: RapidTask, unit: Value) -> str:
    """GetMecUnitName: name of a mechanical unit."""
    return str(unit.value or "")


def _task(task: RapidTask, reference: Value, name: str | None) -> RapidTask:
    wanted = name if name is not None else str(reference.value or "")
    for other in task.controller.rapid_tasks.values():
        if other.name.lower() == wanted.lower():
            found: RapidTask = other
            return found
    raise RapidError("ERR_TASKNAME", wanted)


@builtin("TaskIsActive")
def task_is_active(task: RapidTask, reference: Value, name: str | None) -> bool:
    """TaskIsActive: no task is switched off here."""
    return _task(task, reference, name).state != "empty"


@builtin("TaskIsExecuting")
def task_is_executing(task: RapidTask, reference: Value, name: str | None) -> bool:
    """TaskIsExecuting: whether its program runs."""
    return _task(task, reference, name).state == "running"
