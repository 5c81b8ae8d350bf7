"""A move is made, joined with those of other robots, and put on the path.

A guessed robot does not come everywhere. With robot, tool and table made up, a place out of reach
or in another configuration says more of the guess than of the program: the move then goes to the
same place with all axes together, in the nearest configuration, and where no posture reaches it the
robot stays, and what the move does on its way is done there. Each is told
(`MotionSystem.on_missed`). A robot that somebody chose stops the program, as controllers do.
"""

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

from rapidgen.motion.fault_reasons import MotionFault
from rapidgen.motion.group import MotionGroup
from rapidgen.motion.moves import JointMove, Move, PathEvent
from rapidgen.runtime.builtins.motion.cartesian_request import common, joint_move
from rapidgen.runtime.builtins.motion.synchronised_moves import together
from rapidgen.runtime.builtins.motion.task_group import here, moving_group
from rapidgen.runtime.errors import FatalError, Location, RapidError, errnum
from rapidgen.runtime.motion_faults import (
    CIRCLE_UNCERTAIN,
    NOT_COMPATIBLE,
    OUT_OF_RANGE,
    SINGULARITY,
    in_rapid,
)
from rapidgen.runtime.registry import Arguments, by_name
from rapidgen.runtime.task.task import Task

Maker: TypeAlias = Callable[[Task, Arguments, tuple[PathEvent, ...]], tuple[MotionGroup, Move]]
"""joint_move or cartesian_move."""
_PLACES = frozenset(map(errnum, ("ERR_OUTSIDE_REACH", "ERR_ROBLIMIT")))
_STOPS = frozenset((NOT_COMPATIBLE, OUT_OF_RANGE, SINGULARITY, CIRCLE_UNCERTAIN))


def order(
    task: Task, arguments: Arguments, make: Maker, events: tuple[PathEvent, ...] = ()
) -> MotionGroup:
    """Execute a move instruction; the group that moves. Raises what the planner refuses."""
    try:
        return _put(task, arguments, *make(task, arguments, events))
    except (MotionFault, RapidError, FatalError) as raised:
        fault = in_rapid(raised) if isinstance(raised, MotionFault) else raised
        if task.controller.motion.on_missed is None or not _is_of_place(fault):
            raise fault from raised
    group, how = moving_group(task), "by its axes, in the nearest configuration"
    if not _goes_by_its_axes(task, arguments, events):
        how = "not at all"
        stay = JointMove(target=group.path_target, events=events, **common(task, group, arguments))
        _put(task, arguments, group, stay)
    place = here(task)
    at = place() if place is not None else None
    file = f"{Path(at.span.path).name}:{at.span.line}" if isinstance(at, Location) else task.name
    task.controller.motion.on_missed(file, how)
    return group


def _put(task: Task, arguments: Arguments, group: MotionGroup, move: Move) -> MotionGroup:
    group.move(task, together(task, group, move, arguments.get("ID")))
    return group


def _goes_by_its_axes(task: Task, arguments: Arguments, events: tuple[PathEvent, ...]) -> bool:
    """Whether a target is reached that way; one of axes is not."""
    if "ToPoint" not in arguments:
        return False
    try:
        _put(task, arguments, *joint_move(task, arguments, events, checked=False))
    except (MotionFault, RapidError, FatalError):
        return False
    return True


def _is_of_place(fault: RapidError | FatalError) -> bool:
    """Whether it is about where the robot can come, and not about the way of asking."""
    if isinstance(fault, RapidError):
        return fault.number in _PLACES
    return fault.event in _STOPS


def bind(
    name: str,
    make: Maker,
    events_of: Callable[[Task, Arguments], tuple[PathEvent, ...]] = lambda _task, _given: (),
) -> None:
    """Bind a move instruction to what makes its move and its events on the path."""

    @by_name(name, cost="move")
    def execute(task: Task, _name: str, arguments: Arguments) -> None:
        order(task, arguments, make, events_of(task, arguments))
