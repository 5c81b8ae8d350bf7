"""Stopping, starting and changing the path.

Sources: 3HAC050917 for arguments and IsStopMoveAct's two kinds, S4 datasys 2-StopMove and
2-StartMove for behaviour, abb_driver [code] for StopMove, ClearPath, StartMove in sequence.
"""

from collections.abc import Callable, Iterable

from rapidgen.motion.group import MotionGroup
from rapidgen.runtime.builtins.motion.task_group import group_of
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.motion_faults import NOT_ALLOWED, planned
from rapidgen.runtime.registry import builtin, builtins
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Value

MOVE_TASK = "move task"
OTHER_TASK = "other task"


def reason_of(task: Task) -> str:
    """Under which name a task stops and starts a robot."""
    motion = task.controller.motion
    if motion.is_motion_task(task.name):
        return MOVE_TASK
    return OTHER_TASK if motion.settings.stop_owner == "kind" else f"{OTHER_TASK} {task.name}"


def _groups(task: Task, all_tasks: bool | None) -> Iterable[MotionGroup]:
    if not all_tasks:
        return (group_of(task),)
    if task.controller.motion.is_motion_task(task.name):
        raise FatalError(NOT_ALLOWED, "Not allowed", "\\AllMotionTasks is for non-motion tasks")
    return task.controller.motion.groups.values()


@builtin("StopMove", cost="call")
def stop_move(task: Task, quick: bool | None, all_tasks: bool | None) -> None:
    """Brakes on the path and stays; the program goes on (S4 datasys 2-StopMove-1)."""
    groups = tuple(_groups(task, all_tasks))
    for group in groups:
        group.stop(reason_of(task), quick=bool(quick))
    if task.controller.motion.settings.stop_waits:
        for group in groups:
            group.wait_standing(task)


@builtin("StartMove", cost="call")
def start_move(task: Task, all_tasks: bool | None) -> None:
    """Takes back the stop of this kind of task; moves when no other holds.

    ERR_PATHDIST: more than 10 mm or 20 degrees off the path (S4 datasys 2-StartMove-1).
    """
    groups = tuple(_groups(task, all_tasks))
    for group in groups:
        path, turn = group.off_path
        if path > group.settings.path_distance or turn > group.settings.path_angle:
            raise RapidError("ERR_PATHDIST", f"{group.name}: {path * 1000:.1f} mm off the path")
    for group in groups:
        group.start(reason_of(task))


@builtin("StartMoveRetry", cost="call")
def start_move_retry(task: Task) -> None:
    """StartMove and RETRY in one, in an ERROR handler only [manual 3HAC050917]."""
    start_move(task, None)
    task.errors.retry_here()


@builtin("StopMoveReset", cost="call")
def stop_move_reset(task: Task, all_tasks: bool | None) -> None:
    """Takes back the stop without moving: what is left of the path is gone (`stop_move_reset`)."""
    for group in _groups(task, all_tasks):
        if group.settings.stop_move_reset == "releases":
            group.release(reason_of(task))


@builtin("IsStopMoveAct")
def is_stop_move_act(task: Task, from_move: bool | None, from_other: bool | None) -> bool:
    """Whether a StopMove of a motion task, or of another task, holds the robot."""
    reasons = group_of(task).stop_reasons
    other = any(reason.startswith(OTHER_TASK) for reason in reasons)
    if from_move:
        return MOVE_TASK in reasons
    if from_other:
        return other
    return MOVE_TASK in reasons or other


@builtin("RestoPath")
@planned
def resto_path(task: Task) -> None:
    """Brings the stored path back; StartMove sets the robot going on it."""
    group_of(task).restore_path(reason_of(task))


_PLAIN: dict[str, Callable[..., Value]] = {
    # What is left of the path goes; the robot ends where its stop ends.
    "ClearPath": lambda task: group_of(task).clear_path(),
    "WaitRob": lambda task, _in_pos, _zero_speed: group_of(task).wait_standing(task),
    "StorePath": lambda task, _keep_sync: group_of(task).store_path(task, reason_of(task)),
    "PathLevel": lambda task: group_of(task).path_level,
}
builtins(_PLAIN)
