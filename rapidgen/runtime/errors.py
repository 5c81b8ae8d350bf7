"""Errors and other ways out of RAPID code.

`RapidError` is what an ERROR handler can handle: it has a number (ERRNO). `FatalError` stops
the task. Numbers of the ERR_ constants are in no public source; they are opaque and distinct.
"""

from dataclasses import dataclass
from functools import cache
from types import FrameType

from rapidgen.diagnostics import Span
from rapidgen.rapid.builtins import signatures

LARGEST_USER_ERROR = 90
"""RAISE takes 1 to 90 [K §4.8]."""
FIRST_BOOKED_ERROR = 2001
"""BookErrNo hands out numbers from here: above every ERR_ constant."""


@cache
def _numbers() -> dict[str, int]:
    return {
        name.upper(): int(datum.value)
        for name, datum in signatures.predefined().items()
        if datum.type == "errnum" and isinstance(datum.value, int)
    }


@cache
def _names() -> dict[int, str]:
    return {number: name for name, number in _numbers().items()}


def errnum(name: str) -> int:
    """Number of an ERR_ constant (any case). KeyError: there is no such constant."""
    return _numbers()[name.upper()]


def error_name(number: float) -> str:
    """`ERR_DIVZERO` for its number; the number as text when it is a user's own."""
    return _names().get(int(number), f"error {number:g}")


@dataclass(frozen=True, slots=True)
class Location:
    """Where a routine of the call stack is."""

    module: str
    routine: str
    span: Span
    origin: tuple[str, int] | None = None
    """Template and line of a generated module."""

    def __str__(self) -> str:
        made = f" (from {self.origin[0]}:{self.origin[1]})" if self.origin else ""
        return f"{self.module}/{self.routine}/{self.span.line}{made}"


class RapidError(Exception):
    """A recoverable error of execution. `text` says more for the event log."""

    __slots__ = ("number", "raised", "settled", "target", "text", "way")

    def __init__(self, name: str | int, text: str = "") -> None:
        super().__init__(name)
        self.number: int = errnum(name) if isinstance(name, str) else name
        self.text = text
        self.settled = False
        """Whether the task's budget was put right for it."""
        self.raised = False
        """Whether RAISE with a number made it."""
        self.target: FrameType | None = None
        """Python frame of the routine whose handler it jumps to [K §7.2, 7.3]."""
        self.way: int | None = None
        """How that handler has ended, when it has run already."""

    @property
    def name(self) -> str:
        """The constant's name."""
        return error_name(self.number)


class FatalError(Exception):
    """An error without a number: the event is logged and the task stops."""

    __slots__ = ("arguments", "cause", "event", "restartable", "span", "stack", "title")

    def __init__(
        self,
        event: int,
        title: str,
        *arguments: str,
        span: Span | None = None,
        cause: "RapidError | None" = None,
        restartable: bool = True,
    ) -> None:
        super().__init__(title)
        self.event = event
        self.title = title
        self.arguments = arguments
        self.span = span
        """Where it is, when that is not where it was raised."""
        self.cause = cause
        """The error that nobody handled."""
        self.restartable = restartable
        """Whether a start may try the statement again."""
        self.stack: tuple[Location, ...] = ()
        """Call stack at the error, outermost first."""


class Unwind(BaseException):
    """Leaves every routine of the task and runs their UNDO handlers."""


class ExitCycle(Unwind):
    """Back to the first statement of the entry routine; data are kept."""


class EndOfRun(Unwind):
    """EXIT, or PP was moved: the run is over."""


class ResumeInside(Unwind):
    """RaiseToUser \\Continue: the user's handler said RETRY or TRYNEXT to what failed here."""

    def __init__(self, way: int) -> None:
        super().__init__(way)
        self.way = way


class PointerMoved(Unwind):
    """Everything is left and goes on where the program pointer is: no UNDO."""


class EventStopped(Unwind):
    """Stop in an event routine: the routine is left, and the program stands."""


# Python's own exceptions in compiled code, and what RAPID calls them.
PYTHON_ERRORS: dict[type[Exception], str] = {
    ZeroDivisionError: "ERR_DIVZERO",
    KeyError: "ERR_OUTOFBND",
    OverflowError: "ERR_NUM_LIMIT",
}
RECOVERABLE: tuple[type[Exception], ...] = (RapidError, *PYTHON_ERRORS)


def python_error(kind: type[BaseException]) -> int:
    """Number of the RAPID error that a Python exception in compiled code stands for."""
    for known, name in PYTHON_ERRORS.items():
        if issubclass(kind, known):
            return errnum(name)
    raise TypeError(f"{kind.__name__} is no RAPID error")


def as_rapid_error(error: BaseException) -> RapidError:
    """The RAPID error that one of `RECOVERABLE` stands for."""
    return error if isinstance(error, RapidError) else RapidError(python_error(type(error)))
