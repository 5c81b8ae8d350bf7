"""Errors that a trap raises in the routine that moves the robot: ProcerrRecovery [K §7.4].

The error waits until the trap is over. `\\SyncLastMoveInst`: it is raised at the move instruction
that is being executed, or else at the next one. `\\SyncOrgMoveInst`: it is raised at once, in the
routine whose move made the path that the robot is on; routines that this one has called are left,
so that a RETRY calls them again (a controller goes on inside them).
"""

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from types import CodeType, FrameType

from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.registry import bound
from rapidgen.runtime.task.call_stack import outwards


@dataclass(frozen=True, slots=True)
class ProcessError:
    """An error that waits. `owner`: module and routine of the path's move, or "" for the last."""

    number: int
    owner: tuple[str, str] | None = None

    def due(self, task: RapidTask, outside: Sequence[CodeType]) -> RapidError | None:
        """The error where it is to be raised now; None: not yet.

        Between two statements, in functions that compiled code calls `outside` of any, nobody
        would handle it: it waits for the inside of one.
        """
        frames, between = _frames(task, outside)
        error = RapidError(self.number)
        if self.owner is None:
            return error if not between and _at_move(task, frames) else None
        error.target = _frame_of(task, frames, self.owner)
        return None if between and error.target in (None, frames[0]) else error


def _frames(task: RapidTask, outside: Sequence[CodeType]) -> tuple[list[FrameType], bool]:
    """Frames of RAPID routines, innermost first; whether the innermost is between statements."""
    result: list[FrameType] = []
    between = False
    called: CodeType | None = None
    for frame in outwards(sys._getframe(1)):
        if frame.f_code.co_filename in task.program.codes:
            between = between or (not result and any(called is code for code in outside))
            result.append(frame)
        called = frame.f_code
    return result, between


def _at_move(task: RapidTask, frames: list[FrameType]) -> bool:
    """Whether the statement that is being executed is a move instruction."""
    for frame in frames[:1]:
        compiled = task.program.codes[frame.f_code.co_filename]
        if 0 <= frame.f_lineno < len(compiled.tokens):
            token = compiled.tokens[frame.f_lineno]
            builtin = bound(compiled.module.tree.source.tokens[token])
            return builtin is not None and builtin.cost == "move"
    return False


def _frame_of(task: RapidTask, frames: list[FrameType], owner: tuple[str, str]) -> FrameType | None:
    """The innermost frame with a handler, from the owner's one on; None: the owner is gone."""
    inside = False
    for frame in frames:
        compiled = task.program.codes[frame.f_code.co_filename]
        inside = inside or (compiled.module.name, compiled.routine.name) == owner
        if inside and compiled.handled and not compiled.role(frame.f_code).is_handler:
            return frame
    return None
