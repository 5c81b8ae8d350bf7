"""Synchronised movement: moves of several robots with one \\ID begin and end together.

Between SyncMoveOn and SyncMoveOff a move waits until every task of the list has come to the one
of its \\ID; all then take the time of the longest [mem: MultiMove is in no public source].
"""

from dataclasses import replace

from rapidgen.machine.sync_points import SyncMoveGroup
from rapidgen.motion.group import MotionGroup
from rapidgen.motion.moves import Move
from rapidgen.runtime.builtins.motion.task_group import data_of
from rapidgen.runtime.errors import FatalError
from rapidgen.runtime.motion_faults import NOT_ALLOWED
from rapidgen.runtime.task.task import Task


def together(task: Task, group: MotionGroup, move: Move, identity: float | None) -> Move:
    """The move with the time that it takes in synchronised movement; else as it is.

    FatalError: \\ID is missing in synchronised movement.
    """
    data = data_of(task, group)
    if not data.partners or data.suspended:
        return move
    if identity is None:
        raise FatalError(NOT_ALLOWED, "\\ID is missing", "between SyncMoveOn and SyncMoveOff")
    gatherings = task.controller.meetings.moves
    point, own = (data.partners, identity), task.name.lower()
    gathering = gatherings.setdefault(point, SyncMoveGroup())
    gathering.times[own] = group.whole_time(move)
    if gathering.times.keys() == data.partners:
        gathering.longest = max(gathering.times.values())
        del gatherings[point]
        gathering.changed.notify()
    else:
        try:
            task.wait_for(
                lambda: gathering.longest is not None,
                on=(gathering.changed,),
                why=lambda: (
                    f"waits for a move \\ID:={identity} of "
                    f"{', '.join(sorted(data.partners - gathering.times.keys()))}"
                ),
            )
        finally:
            if gathering.longest is None:
                del gathering.times[own]
    return replace(move, time=gathering.longest) if gathering.longest else move
