"""Errors of a task: handlers, RETRY, long jumps, UNDO [K §7].

Errors are Python exceptions in compiled code. Rules:

1. A routine with ERROR guards its statements. The guard calls `handle` with the exception; the
   result says how the routine continues.
2. An error in a handler leaves the routine. A handler never handles its own errors.
3. RETRY is limited (`Errors.RETRIES`); afterwards the handler receives ERR_EXCRTYMAX once, and a
   further RETRY stops the task.
4. A long jump (ERROR with a list of numbers) searches the callers for the nearest list with the
   number. `RapidError.target` names that frame, and the handlers in between pass the error on.
5. UNDO runs when a routine is aborted, not when an error passes to its caller. If the error stops
   the program and a start may continue there, UNDO waits until the program pointer moves.
6. An error keeps the budget right: a statement that fails refunds the costs of the statements after
   it in its block.
"""

import sys
from collections.abc import Callable
from types import FrameType, TracebackType
from typing import NoReturn

from greenlet import GreenletExit

from rapidgen.machine.event_table import ERROR_CODES, KINDS, OUT_OF_REACH, RAPID_ERROR
from rapidgen.runtime.compiler.symbols import CodeRole
from rapidgen.runtime.errors import (
    LARGEST_USER_ERROR,
    RECOVERABLE,
    FatalError,
    MotionError,
    PointerMoved,
    RapidError,
    ResumeInside,
    as_rapid_error,
    errnum,
    error_name,
    python_error,
)
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.task.calls import outwards, place_in_rapid, stack_of_error

RETRY, TRYNEXT, RETURN, RAISE = 0, 1, 2, 3
RETRIES = 4
"""Recoveries of one statement by RETRY: system parameter No Of Retry [K §7.5]."""

Handler = Callable[[], int]
Listed = Callable[[], tuple[float, ...]]


class Errors:
    """Error handling of one task.

    Compiled code calls `handle`, `undo` and the methods of RAISE.
    """

    def __init__(self, task: RapidTask) -> None:
        self._task = task
        self._switches = task.controller.dialect
        self.retry_number = 0
        self.retry_base = 0
        self.skip_warning = False
        self.handler_level = 0
        self.undo_level = 0
        self.undo_failed = False
        """An error in an UNDO handler stops the task (switch `undo_error`)."""
        self._stops = self._switches.unhandled_error == "stop"
        fatal = self._switches.argument_error == "fatal"
        self._fatal_number = errnum("ERR_ARGVALERR") if fatal else None
        self._reach_stops = self._switches.unreachable_target == "stop"
        self._instead: RapidError | None = None
        self.kept_undo: list[Handler] = []
        """Of routines that an error left while the program can go on there."""

    # -- handlers --------------------------------------------------------------------------------

    def handle(
        self,
        handler: Handler,
        error: Exception,
        budget: int | None,
        retries: int,
        listed: Listed | None,
    ) -> int:
        """Handle an error at a statement of a routine with ERROR.

        Returns 0 RETRY, 1 TRYNEXT, 2 RETURN. `budget` is the task's remaining budget if the
        statement itself failed, None if calls wrote it back. Raises the error again if this handler
        is not for it.
        """
        traceback = error.__traceback__
        frame = sys._getframe(1)
        known = self._settled(error, traceback, frame, budget)
        number = known.number
        if self._reach_stops and isinstance(known, MotionError):
            raise self.unhandled(known) from None
        if number == self._fatal_number and not known.raised:
            raise self.unhandled(known) from None
        way = None
        if known.target is not None:
            if known.target is not frame:
                raise known
            known.target = None
            way, known.way = known.way, None
        elif listed is not None and not lists(listed(), number):
            raise known
        elif self._stops:
            self._stop_at_bare_callee(known, traceback)
        elif listed is None and self._came_out_of_bare(traceback):
            # A recovery point further out comes before a plain handler nearer by [K §7.2].
            known.target = self._recovery_point(frame, number)
            if known.target is not None:
                raise known
        if way is None:
            if not retries:
                self.retry_base = 0
            way = self.run_handler(handler, known, retries, frame)
        if way in (TRYNEXT, RETURN):
            return way
        if way == RAISE:
            known = self._handed_on(known)
            known.target = self._recovery_point(frame, known.number)
            raise known
        if way == RETRY:
            return self._retry(handler, known, retries, frame)
        raise self.unhandled(known) from None

    def run_handler(
        self, handler: Handler, error: RapidError, retries: int, frame: FrameType
    ) -> int:
        """Execute a handler and return its result."""
        task = self._task
        place = place_in_rapid(task.program.codes, error.__traceback__)
        task.errno = error.number
        self.retry_number = retries
        self.skip_warning = False
        for tell in task.controller.statements.errors:
            tell(task.name, error)
        self.handler_level += 1
        try:
            way = handler()
        except RECOVERABLE as second:
            if isinstance(second, RapidError) and second.target is not None:
                raise  # RaiseToUser
            # Errors inside a handler go straight to the system error handler [K §7.1].
            known = self._settled(second, second.__traceback__, frame, None)
            raise self.unhandled(known, restartable=False) from None
        except ResumeInside as order:
            way = order.way
        finally:
            self.handler_level -= 1
        if not self.skip_warning:
            task.controller.recovered(task, error, place)
        return way

    def _retry(self, handler: Handler, error: RapidError, retries: int, frame: FrameType) -> int:
        """Count a RETRY and stop after the limit [K §7.5].

        After the limit the handler receives ERR_EXCRTYMAX once [S4 datasys 2-IODisable-2]. A
        further RETRY stops the task.
        """
        if error.raised and not self._switches.retry_raised:
            raise FatalError(194199, "RETRY is not allowed for an error made by RAISE")
        if retries - self.retry_base < RETRIES:
            return RETRY
        last = RapidError("ERR_EXCRTYMAX")
        last.settled = True
        last.__traceback__ = error.__traceback__
        way = self.run_handler(handler, last, retries, frame)
        if way in (TRYNEXT, RETURN):
            return way
        if way == RAISE:
            raise self._handed_on(last)
        raise self.unhandled(last) from None

    def _handed_on(self, error: RapidError) -> RapidError:
        """Return the error that RAISE in a handler passes to the caller."""
        other, self._instead = self._instead, None
        if other is None:
            return error
        other.settled = True
        other.__traceback__ = error.__traceback__
        return other

    def _stop_at_bare_callee(self, error: RapidError, traceback: TracebackType | None) -> None:
        """Make an error of a routine without ERROR fatal (switch)."""
        if self._came_out_of_bare(traceback):
            raise self.unhandled(error) from None

    def _came_out_of_bare(self, traceback: TracebackType | None) -> bool:
        """Return True if a called routine without ERROR raised the error."""
        at = traceback.tb_next if traceback is not None else None
        while at is not None:
            compiled = self._task.program.codes.get(at.tb_frame.f_code.co_filename)
            if compiled is not None:
                return not compiled.handled
            at = at.tb_next
        return False

    def _settled(
        self,
        error: Exception,
        traceback: TracebackType | None,
        frame: FrameType,
        budget: int | None,
    ) -> RapidError:
        """Return the RAPID error, and correct the task's budget for it."""
        task = self._task
        if isinstance(error, RapidError):
            known = error
            if known.settled:
                return known
        else:
            known = RapidError(python_error(error.__class__))
            known.__traceback__ = traceback
            if traceback is not None and traceback.tb_next is None and budget is not None:
                task.b = budget
                known.settled = True
                return known
        known.settled = True
        at = traceback
        inner = None
        codes = task.program.codes
        while at is not None:
            if at.tb_frame.f_code.co_filename in codes:
                inner = at
            at = at.tb_next
        if inner is None:
            return known
        if inner.tb_frame is frame:
            left = budget
        else:
            compiled = codes[inner.tb_frame.f_code.co_filename]
            left = compiled.budget(inner.tb_frame, inner.tb_lineno)
        if left is not None:
            task.b = left
        return known

    def throw(self, number: float) -> NoReturn:
        """Raise the error of RAISE n."""
        raise self._own_error(number)

    def instead(self, number: float) -> None:
        """Set the error of RAISE n in an ERROR handler, for the caller.

        Source: [code]; K §4.8 forbids it.
        """
        if self._switches.raise_in_handler == "error":
            raise FatalError(
                194001, "RAISE with a number is not permitted in a handler", "[K §4.8]"
            )
        self._instead = self._own_error(number)

    def retry_here(self) -> NoReturn:
        """Execute RETRY for an instruction.

        FatalError: outside an ERROR handler.
        """
        if not self.handler_level:
            raise FatalError(194001, "RETRY is permitted only in an error handler", "[K §4.10]")
        raise ResumeInside(RETRY)

    def _own_error(self, number: float) -> RapidError:
        """Return the error of a RAISE number, else ERR_ILLRAISE [K §4.8].

        Permitted numbers are 1 to 90, booked numbers and ERR_ constants.
        """
        complete = int(number) if number == number and abs(number) < 1e9 else 0
        allowed = complete == number and (
            1 <= complete <= LARGEST_USER_ERROR
            or complete in self._task.controller.booked
            or error_name(complete).startswith("ERR_")
        )
        error = RapidError(complete) if allowed else RapidError("ERR_ILLRAISE")
        error.raised = True
        return error

    def _recovery_point(self, frame: FrameType, number: int) -> FrameType | None:
        """Return the nearest caller with the number in its list [K §7.2]."""
        codes = self._task.program.codes
        in_handler = False
        for at in outwards(frame.f_back):
            compiled = codes.get(at.f_code.co_filename)
            if compiled is None:
                continue
            role = compiled.role(at.f_code)
            if role.is_handler:
                in_handler = True
                continue
            own = None if in_handler else compiled.listed(at)
            if own is not None and lists(own, number):
                return at
            in_handler = in_handler and role is CodeRole.PART
        return None

    def _has_handler_above(self, frame: FrameType) -> bool:
        codes = self._task.program.codes
        for at in outwards(frame.f_back):
            compiled = codes.get(at.f_code.co_filename)
            if compiled is not None:
                if compiled.role(at.f_code).is_handler:
                    return False
                if compiled.handled:
                    return True
        return False

    # -- RaiseToUser -----------------------------------------------------------------------------

    def raise_in_user_code(self, error: RapidError, *, resume: bool) -> None:
        """Raise an error in the nearest caller outside NOSTEPIN [K §7.3].

        `resume` (\\Continue): the handler runs while the routines in between still exist; its RETRY
        and TRYNEXT apply to the inner statement. Otherwise these routines are left. Returns if
        RaiseToUser is in no handler and TRYNEXT skips it.
        """
        user, handler, inside_handler = self._user(error.number)
        if user is None or handler is None:
            raise self.unhandled(error)
        error.target = user
        if not resume:
            raise error
        for retries in range(RETRIES + 1):
            error.way = self.run_handler(handler, error, retries, user)
            if error.way not in (RETRY, TRYNEXT):
                raise error
            if inside_handler:
                raise ResumeInside(error.way)
            if error.way == TRYNEXT:
                return
        raise self.unhandled(RapidError("ERR_EXCRTYMAX"))

    def _user(self, number: int) -> tuple[FrameType | None, Handler | None, bool]:
        """Return frame and handler for the error, and its origin.

        The last value is True if a handler of NOSTEPIN raised the error.
        """
        codes = self._task.program.codes
        first = True
        inside = False
        for at in outwards(sys._getframe(2)):
            compiled = codes.get(at.f_code.co_filename)
            if compiled is None:
                continue
            hidden = "NOSTEPIN" in compiled.module.tree.attributes
            role = compiled.role(at.f_code)
            if role.is_handler:
                if not (hidden or first):
                    break  # errors inside a handler go to the system error handler [K §7.1]
                inside = True
            elif not (first or hidden) and (handler := compiled.handler(at)) is not None:
                listed = compiled.listed(at)
                if listed is None or lists(listed, number):
                    return at, handler, inside
            elif role is CodeRole.ROUTINE:
                first = False
        return None, None, inside

    # -- UNDO ------------------------------------------------------------------------------------

    def undo(self, handler: Handler, leaving: BaseException) -> None:
        """Run UNDO if the routine is aborted.

        An error that only passes to the caller does not abort it.
        """
        if isinstance(leaving, GreenletExit | PointerMoved) or self.undo_failed:
            return
        if isinstance(leaving, RECOVERABLE):
            known = as_rapid_error(leaving)
            frame = sys._getframe(1)
            if known.target is None and not self._stops:
                known.target = self._recovery_point(frame, known.number)
            if known.target is None and self._has_handler_above(frame):
                return
            if known.target is None and self._keep_undo(handler):
                return
        elif isinstance(leaving, FatalError) and self._keep_undo(handler):
            return
        self.undo_level += 1
        try:
            handler()
        except FatalError:
            # The others are not executed: each might fail, too, and call what failed again.
            self.undo_failed = True
            raise
        except RECOVERABLE as error:
            fatal = self.unhandled(error)
            if self._switches.undo_error == "ignore":
                self.undo_ended(fatal)
                return
            self.undo_failed = True
            raise fatal from None
        finally:
            self.undo_level -= 1

    @property
    def tried_again(self) -> bool:
        """True if a start executes the failed statement again."""
        return self._switches.after_error == "statement" and self._task.spec.type == "NORMAL"

    def _keep_undo(self, handler: Handler) -> bool:
        """Postpone UNDO if the error stops the program at this routine."""
        if self.tried_again:
            self.kept_undo.append(handler)
        return self.tried_again

    def undo_late(self) -> None:
        """Run postponed UNDO handlers."""
        handlers, self.kept_undo = self.kept_undo, []
        for handler in handlers:
            self.undo_level += 1
            try:
                handler()
            except FatalError as error:
                self.undo_ended(error)
                break
            except RECOVERABLE as error:
                self.undo_ended(self.unhandled(error))
                if self._switches.undo_error == "stop":
                    break
            finally:
                self.undo_level -= 1
        self.kept_undo = []

    def undo_ended(self, error: FatalError) -> None:
        """Log an error in an UNDO handler; it stops nothing."""
        place = str(error.stack[-1]) if error.stack else ""
        texts = [text for text in error.arguments if text]
        task = self._task
        task.controller.log.error(error.event, error.title, place, *texts, task=task.name)

    # -- unhandled --------------------------------------------------------------------------------

    def at_level(self, routine: Callable[[], object]) -> None:
        """Execute a routine at trap or user level.

        Only a long jump leaves it [K §7.2].
        """
        try:
            routine()
        except RECOVERABLE as error:
            if isinstance(error, RapidError) and error.target is not None:
                raise
            raise self.unhandled(error) from error

    def unhandled(self, raised: Exception, *, restartable: bool = True) -> FatalError:
        """Return the fatal error of an unhandled error."""
        error = as_rapid_error(raised)
        if isinstance(error, MotionError):
            # A start from such a place was refused with 10097 (saved event logs).
            title = KINDS[OUT_OF_REACH].title
            fatal = FatalError(OUT_OF_REACH, title, error.text, cause=error, restartable=False)
        else:
            name = error_name(error.number)
            title = f"Unhandled error {name}"
            code = ERROR_CODES.get(name, RAPID_ERROR)
            fatal = FatalError(code, title, name, error.text, cause=error, restartable=restartable)
        fatal.stack = stack_of_error(self._task.program.codes, raised)
        return fatal


def lists(numbers: tuple[float, ...], number: int) -> bool:
    """Return True if ERROR (numbers) applies to an error."""
    return number in numbers or errnum("LONG_JMP_ALL_ERR") in numbers
