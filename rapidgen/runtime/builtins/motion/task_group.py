"""How a built-in finds the motion group of its task."""

import sys
from collections.abc import Callable
from functools import partial
from types import FrameType

from rapidgen.axes.kinematics import Kinematics
from rapidgen.motion.group import MotionGroup
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.motion_faults import NO_MOTION_TASK, NO_UNIT, planned
from rapidgen.runtime.robot_data import RobotData
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Value


def here(task: Task) -> Callable[[], object] | None:
    """Where the task is, to be looked up only when somebody asks."""
    codes = task.program.codes
    frame: FrameType | None = sys._getframe(1)
    while frame is not None:
        file = frame.f_code.co_filename
        if file in codes:
            return partial(task.place_of, file, frame.f_lineno)
        frame = frame.f_back
    return None


def group_of(task: RapidTask) -> MotionGroup:
    """The group that the task moves or is connected to. FatalError: there is none."""
    group = task.controller.motion.of_task(task.name)
    if group is None:
        raise FatalError(NO_UNIT, "No mechanical unit", f"{task.name} is connected to no robot")
    return group


def data_of(task: RapidTask, group: MotionGroup) -> RobotData:
    """What programs have set for a robot."""
    return task.controller.robot_data[group.name]


@planned
def geometry_of(group: MotionGroup) -> Kinematics:
    """The kinematics of a robot. FatalError: its model has none."""
    return group.geometry()


def moving_group(task: Task) -> MotionGroup:
    """The same for move instructions, which only a motion task may execute."""
    if not task.controller.motion.is_motion_task(task.name):
        raise FatalError(NO_MOTION_TASK, "Not a motion task", f"{task.name} cannot execute moves")
    if task.interrupts.process_error is not None:
        task.raise_process_error(task.interrupts.process_error)
    return group_of(task)


def named_group(task: Task, reference: Value, name: str | None) -> MotionGroup:
    """The group of \\TaskRef or \\TaskName, else the task's own.

    ERR_TASKNAME: no such task, which in a guessed cell is the own one; ERR_NOT_MOVETASK: it moves
    nothing.
    """
    expected = name if reference is None else reference.value
    if expected is None:
        return group_of(task)
    if expected.lower() not in (known.lower() for known in task.controller.tasks):
        if task.controller.meetings.any_task:
            return group_of(task)
        raise RapidError("ERR_TASKNAME", expected)
    motion = task.controller.motion
    group = motion.of_task(expected)
    if group is None or not motion.is_motion_task(expected):
        raise RapidError("ERR_NOT_MOVETASK", expected)
    return group
