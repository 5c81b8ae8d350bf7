"""What a task may ask about itself, the others and the controller; meeting other tasks."""

from dataclasses import dataclass, field
from typing import Any

from rapidgen.virtual.builtins.control import wait_standing
from rapidgen.virtual.errors import RapidError
from rapidgen.virtual.kernel import WaitSet
from rapidgen.virtual.registry import builtin
from rapidgen.virtual.running import RapidTask
from rapidgen.virtual.values import Ref

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
def get_mec_unit_name(task: RapidTask, unit: Any) -> str:  # noqa: ANN401 - an opaque mecunit
    """GetMecUnitName: name of a mechanical unit."""
    return str(unit.value or "")


def _task(task: RapidTask, reference: Any, name: str | None) -> RapidTask:  # noqa: ANN401
    wanted = name if name is not None else str(reference.value or "")
    for other in task.controller.rapid_tasks.values():
        if other.name.lower() == wanted.lower():
            found: RapidTask = other
            return found
    raise RapidError("ERR_TASKNAME", wanted)


@builtin("TaskIsActive")
def task_is_active(task: RapidTask, reference: Any, name: str | None) -> bool:  # noqa: ANN401
    """TaskIsActive: no task is switched off here."""
    return _task(task, reference, name).state != "empty"


@builtin("TaskIsExecuting")
def task_is_executing(task: RapidTask, reference: Any, name: str | None) -> bool:  # noqa: ANN401
    """TaskIsExecuting: whether its program runs."""
    return _task(task, reference, name).state == "running"


# -- meeting -----------------------------------------------------------------------------------


@dataclass
class Meeting:
    """Tasks that have come to one synchronisation point."""

    members: frozenset[str]
    arrived: set[str] = field(default_factory=set)
    changed: WaitSet = field(default_factory=WaitSet)
    complete: bool = False


@builtin("WaitSyncTask")
def wait_sync_task(
    task: RapidTask, in_pos: bool | None, identity: Ref, tasks: Ref, time_out: float | None
) -> None:
    """WaitSyncTask: until every task of the list waits at the point of that name.

    \\TimeOut: ERR_WAITSYNCTASK. A task that is not in its own list is an error.
    """
    if in_pos:
        wait_standing(task)
    members = frozenset(entry.taskname.lower() for entry in tasks.get().values())
    own = task.name.lower()
    known = {t.name.lower() for t in task.controller.rapid_tasks.values()}
    if own not in members or not members <= known:
        raise RapidError("ERR_TASKNAME", ", ".join(sorted(members - known)) or task.name)
    key = _sync_name(task, identity)
    meetings: dict[tuple[str, frozenset[str]], Meeting] = task.controller.meetings
    meeting = meetings.setdefault((key, members), Meeting(members))
    meeting.arrived.add(own)
    if meeting.arrived == meeting.members:
        meeting.complete = True
        del meetings[key, members]
        meeting.changed.notify()
        return
    try:
        met = task.wait_for(lambda: meeting.complete, on=(meeting.changed,), timeout=time_out)
    finally:
        if not meeting.complete:
            meeting.arrived.discard(own)
    if not met:
        raise RapidError("ERR_WAITSYNCTASK")


def _sync_name(task: RapidTask, identity: Any) -> str:  # noqa: ANN401 - an opaque syncident
    """A syncident is known by the name of its variable, the same in each task."""
    program = task.program
    for module in program.modules.values():
        for key in module.declarations:
            if program.value(module, key) is identity:
                return key
    return ""


@builtin("TasksInSync")
def tasks_in_sync(task: RapidTask, tasks: Ref) -> bool:
    """TasksInSync: whether the listed tasks move synchronously; they never do here."""
    return False


@builtin("IsSyncMoveOn")
def is_sync_move_on(task: RapidTask) -> bool:
    """IsSyncMoveOn: synchronised movements are not available."""
    return False
