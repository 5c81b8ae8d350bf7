"""RaiseToUser: errors of NOSTEPIN routines that the user's routine deals with [K §7.3]."""

import sys
from types import FrameType

from rapidgen.runtime.compiler.compiled import Role
from rapidgen.runtime.errors import RapidError, ResumeInside
from rapidgen.runtime.task.recovery import RETRIES, RETRY, TRYNEXT, Recovery, lists


def give_to_user(task: Recovery, error: RapidError, *, resume: bool) -> None:
    """Give an error to the handler of the nearest caller outside NOSTEPIN modules.

    `resume` (\\Continue): the handler runs while the routines between are still there, and its
    RETRY and TRYNEXT are for what failed inside. Without it they are dropped. Returns when
    RaiseToUser stood in no handler and TRYNEXT passes over it.
    """
    user, inside_handler = _user(task, error.number)
    if user is None:
        raise task.unhandled(error)
    error.target = user
    if not resume:
        raise error
    handler = task.program.codes[user.f_code.co_filename].handler(user)
    assert handler is not None
    for retries in range(RETRIES + 1):
        error.way = task.run_handler(handler, error, retries, user)
        if error.way not in (RETRY, TRYNEXT):
            raise error
        if inside_handler:
            raise ResumeInside(error.way)
        if error.way == TRYNEXT:
            return
    raise task.unhandled(RapidError("ERR_EXCRTYMAX"))


def _user(task: Recovery, number: int) -> tuple[FrameType | None, bool]:
    """The frame whose handler gets the error, and whether a handler of NOSTEPIN raised it."""
    codes = task.program.codes
    at: FrameType | None = sys._getframe(2)
    first = True
    inside = False
    while at is not None:
        compiled = codes.get(at.f_code.co_filename)
        if compiled is not None:
            hidden = "NOSTEPIN" in compiled.module.tree.attributes
            role = compiled.role(at.f_code)
            if role.is_handler:
                if not (hidden or first):
                    break  # errors inside a handler go to the system error handler [K §7.1]
                inside = True
            elif not (first or hidden) and compiled.handler(at) is not None:
                listed = compiled.listed(at)
                if listed is None or lists(listed, number):
                    return at, inside
            elif role is Role.ROUTINE:
                first = False
        at = at.f_back
    return None, inside
