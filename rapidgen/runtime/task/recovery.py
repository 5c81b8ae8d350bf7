"""Errors of a task: handlers, RETRY, long jumps, UNDO, and who is where [K §7]."""

import sys
from collections.abc import Callable
from dataclasses import dataclass
from types import FrameType, TracebackType
from typing import TYPE_CHECKING, Any, NoReturn

from greenlet import GreenletExit

from rapidgen.diagnostics import Span
from rapidgen.machine.process import Process
from rapidgen.machine.scheduler import Scheduler
from rapidgen.runtime.errors import (
    LARGEST_USER_ERROR,
    RECOVERABLE,
    FatalError,
    PointerMoved,
    RapidError,
    ResumeInside,
    as_rapid_error,
    errnum,
    error_name,
    python_error,
)

if TYPE_CHECKING:
    from rapidgen.runtime.compiler.program import Program

RETRY, TRYNEXT, RETURN, RAISE = 0, 1, 2, 3
RETRIES = 4
"""Recoveries of one statement by RETRY: system parameter No Of Retry [K §7.5]."""
DEEPEST = 5_000
"""Python frames of a task; a deeper one is RAPID's stack overflow."""

Listed = Callable[[], tuple[float, ...]]


@dataclass(frozen=True, slots=True)
class Place:
    """Where a routine of the call stack is."""

    module: str
    routine: str
    span: Span
    origin: tuple[str, int] | None
    """Template and line of a generated module."""

    def __str__(self) -> str:
        made = f" (from {self.origin[0]}:{self.origin[1]})" if self.origin else ""
        return f"{self.module}/{self.routine}/{self.span.line}{made}"


class Recovery(Process):
    """The part of a task that deals with errors."""

    __slots__ = ("__dict__",)

    program: "Program"

    def __init__(self, scheduler: Scheduler, name: str, controller: Any) -> None:  # noqa: ANN401
        super().__init__(scheduler, name)
        self.controller = controller
        self.errno = 0
        self.ret: Any = None
        """Value of RETURN in a handler."""
        self.retry_number = 0
        self.retry_base = 0
        self.skip_warning = False
        self.handler_level = 0
        self._stops = controller.dialect.unhandled_error == "stop"
        fatal = controller.dialect.argument_error == "fatal"
        self._fatal_number = errnum("ERR_ARGVALERR") if fatal else None
        self._instead: RapidError | None = None
        self.undo_level = 0
        self.undo_failed = False
        """An error in an UNDO handler stops the task (switch `undo_error`)."""

    # -- handlers --------------------------------------------------------------------------------

    def handle(
        self,
        handler: Callable[[], int],
        error: Exception,
        budget: int | None,
        retries: int,
        listed: Listed | None,
    ) -> int:
        """An error reached a statement of a routine with ERROR: 0 RETRY, 1 TRYNEXT, 2 RETURN.

        `budget` is what the task has left when the statement itself failed; None when calls
        wrote it back. Raises the error again when this handler is not for it.
        """
        traceback = error.__traceback__
        frame = sys._getframe(1)
        known = self._settled(error, traceback, frame, budget)
        number = known.number
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
        self, handler: Callable[[], int], error: RapidError, retries: int, frame: FrameType
    ) -> int:
        """Execute a handler; how it ended."""
        self.errno = error.number
        self.retry_number = retries
        self.skip_warning = False
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
            self.controller.log.handled(self.name, error.number, error.text)
        return way

    def _retry(
        self, handler: Callable[[], int], error: RapidError, retries: int, frame: FrameType
    ) -> int:
        """RETRY, as often as it is allowed [K §7.5].

        After that the handler sees ERR_EXCRTYMAX once [S4 datasys 2-IODisable-2]; when it asks
        for RETRY again the task stops.
        """
        if error.raised and not self.controller.dialect.retry_raised:
            raise FatalError(40199, "RETRY is not allowed for an error made by RAISE")
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
        """What RAISE in the handler of an error gives the caller: the same one, or its own."""
        other, self._instead = self._instead, None
        if other is None:
            return error
        other.settled = True
        other.__traceback__ = error.__traceback__
        return other

    def _stop_at_bare_callee(self, error: RapidError, traceback: TracebackType | None) -> None:
        """Dialect: an error that came out of a routine without ERROR is nobody's."""
        at = traceback.tb_next if traceback is not None else None
        while at is not None:
            compiled = self.program.codes.get(at.tb_frame.f_code.co_filename)
            if compiled is not None:
                if not compiled.handled:
                    raise self.unhandled(error) from None
                return
            at = at.tb_next

    def _settled(
        self,
        error: Exception,
        traceback: TracebackType | None,
        frame: FrameType,
        budget: int | None,
    ) -> RapidError:
        """The RAPID error, with the task's budget put right for where it was raised."""
        if isinstance(error, RapidError):
            known = error
            if known.settled:
                return known
        else:
            known = RapidError(python_error(error.__class__))
            known.__traceback__ = traceback
            if traceback is not None and traceback.tb_next is None and budget is not None:
                self.b = budget
                known.settled = True
                return known
        known.settled = True
        at = traceback
        inner = None
        codes = self.program.codes
        while at is not None:
            if at.tb_frame.f_code.co_filename in codes:
                inner = at
            at = at.tb_next
        if inner is None:
            return known
        if inner.tb_frame is frame:
            if budget is not None:
                self.b = budget
            return known
        compiled = codes[inner.tb_frame.f_code.co_filename]
        if inner.tb_lineno not in compiled.synced:
            left = inner.tb_frame.f_locals.get("b")
            if left is not None:
                self.b = left + compiled.refunds.get(inner.tb_lineno, 0)
        return known

    def throw(self, number: float) -> NoReturn:
        """RAISE n."""
        raise self._own_error(number)

    def instead(self, number: float) -> None:
        """RAISE n in an ERROR handler: the caller gets this error [code]; K §4.8 forbids it."""
        if self.controller.dialect.raise_in_handler == "error":
            raise FatalError(40001, "RAISE with a number may not stand in a handler", "[K §4.8]")
        self._instead = self._own_error(number)

    def _own_error(self, number: float) -> RapidError:
        """1 to 90, a booked number or an ERR_ constant; else ERR_ILLRAISE [K §4.8]."""
        whole = int(number) if number == number and abs(number) < 1e9 else 0
        allowed = whole == number and (
            1 <= whole <= LARGEST_USER_ERROR
            or whole in self.controller.booked
            or error_name(whole).startswith("ERR_")
        )
        error = RapidError(whole) if allowed else RapidError("ERR_ILLRAISE")
        error.raised = True
        return error

    def _recovery_point(self, frame: FrameType, number: int) -> FrameType | None:
        """The nearest caller whose ERROR (list) has the number [K §7.2]."""
        codes = self.program.codes
        at = frame.f_back
        in_handler = False
        while at is not None:
            compiled = codes.get(at.f_code.co_filename)
            if compiled is not None:
                if at.f_code.co_name in ("_h", "_u"):
                    in_handler = True
                else:
                    own = at.f_locals.get("_l")
                    if not in_handler and own is not None and lists(own(), number):
                        return at
                    in_handler = in_handler and is_part(at)
            at = at.f_back
        return None

    def _has_handler_above(self, frame: FrameType) -> bool:
        codes = self.program.codes
        at = frame.f_back
        while at is not None:
            compiled = codes.get(at.f_code.co_filename)
            if compiled is not None:
                if at.f_code.co_name in ("_h", "_u"):
                    return False
                if compiled.handled:
                    return True
            at = at.f_back
        return False

    def undo(self, handler: Callable[[], int], leaving: BaseException) -> None:
        """Run UNDO when the routine is aborted, not when an error only passes to its caller."""
        if isinstance(leaving, GreenletExit | PointerMoved) or self.undo_failed:
            return
        if isinstance(leaving, RECOVERABLE):
            known = as_rapid_error(leaving)
            frame = sys._getframe(1)
            if known.target is None and self._has_handler_above(frame):
                return
            if known.target is None and self.keep_undo(handler):
                return
        elif isinstance(leaving, FatalError) and self.keep_undo(handler):
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
            if self.controller.dialect.undo_error == "ignore":
                self.undo_ended(fatal)
                return
            self.undo_failed = True
            raise fatal from None
        finally:
            self.undo_level -= 1

    def undo_ended(self, error: FatalError) -> None:
        """Tell of an error in an UNDO handler that stops nothing."""
        place = str(error.stack[-1]) if error.stack else ""
        texts = [text for text in error.arguments if text]
        self.controller.log.error(error.event, error.title, place, *texts, task=self.name)

    def keep_undo(self, handler: Callable[[], int]) -> bool:
        """Whether an UNDO handler is left for later: the program may go on where it was."""
        return False

    # -- reports ---------------------------------------------------------------------------------

    def unhandled(self, raised: Exception, *, restartable: bool = True) -> FatalError:
        """What the system error handler makes of an error."""
        error = as_rapid_error(raised)
        name = error_name(error.number)
        title = f"Unhandled error {name}"
        fatal = FatalError(40199, title, name, error.text, cause=error, restartable=restartable)
        fatal.stack = self.stack_of(raised.__traceback__)
        return fatal

    def place_of(self, file: str, line: int) -> Place | None:
        """RAPID place of a Python line."""
        compiled = self.program.codes.get(file)
        if compiled is None or not 0 <= line < len(compiled.tokens):
            return None
        module = compiled.module
        token = compiled.tokens[line]
        source = module.tree.source
        span = source.span(token, token)
        origin = None
        for rapid_line, template, template_line in module.file.origin:
            if rapid_line > span.line:
                break
            origin = (template, template_line + span.line - rapid_line)
        return Place(module.name, compiled.routine.name, span, origin)

    def stack_of(self, traceback: TracebackType | None) -> tuple[Place, ...]:
        """Call stack of an error, outermost first."""
        found: list[Place] = []
        while traceback is not None:
            frame = traceback.tb_frame
            place = self.place_of(frame.f_code.co_filename, traceback.tb_lineno)
            if place is not None:
                if is_part(frame):
                    found.pop()
                found.append(place)
            traceback = traceback.tb_next
        return tuple(found)

    def stack(self) -> tuple[Place, ...]:
        """Call stack of a suspended or running task, outermost first."""
        frame: Any = self.frame if self.scheduler.running is not self else sys._getframe(1)
        found: list[Place] = []
        inside = False
        while frame is not None:
            place = self.place_of(frame.f_code.co_filename, frame.f_lineno)
            if place is not None:
                if not inside:
                    found.append(place)
                inside = is_part(frame)
            frame = frame.f_back
        return tuple(reversed(found))

    def poll(self, b: int) -> int:
        """See Process.poll; also looks at the depth of the call stack."""
        try:
            sys._getframe(DEEPEST)
        except ValueError:
            return super().poll(b)
        self.b = b
        raise FatalError(40027, "Stack overflow", "routines call each other too deeply")


def is_part(frame: FrameType) -> bool:
    """Whether it is a deeply nested part of a routine or handler, whose frame is the next."""
    return frame.f_code.co_name.startswith("_a")


def lists(numbers: tuple[float, ...], number: int) -> bool:
    """Whether ERROR (numbers) is for an error."""
    return number in numbers or errnum("LONG_JMP_ALL_ERR") in numbers
