"""Errors and other exits of RAPID code.

An ERROR handler can handle a `RapidError`, which has a number (ERRNO). A `FatalError` stops the
task. No public source has the numbers of the ERR_ constants; they are opaque and distinct.
"""

from dataclasses import dataclass
from functools import cache
from types import FrameType

from rapidgen.diagnostics import Span
from rapidgen.rapid.builtins import signatures

LARGEST_USER_ERROR = 90
"""RAISE takes 1 to 90 [K §4.8]."""
FIRST_BOOKED_ERROR = 2001
"""First number of BookErrNo, above every ERR_ constant."""


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
    """Return the number of an ERR_ constant (any case), or raise KeyError."""
    return _numbers()[name.upper()]


def error_name(number: float) -> str:
    """Return `ERR_DIVZERO` for its number, a user's number as text."""
    return _names().get(int(number), f"error {number:g}")


@dataclass(frozen=True, slots=True)
class Location:
    """A place of a routine in the call stack."""

    module: str
    routine: str
    span: Span
    origin: tuple[str, int] | None = None
    """Template and line of a generated module."""
    instruction: str = ""
    """Instruction of the statement, or the function that it calls first."""

    @property
    def reference(self) -> str:
        """The place as a controller's event log names it: `/Module/routine/MoveL/12`."""
        return f"/{self.module}/{self.routine}/{self.instruction}/{self.span.line}"

    def __str__(self) -> str:
        made = f" (from {self.origin[0]}:{self.origin[1]})" if self.origin else ""
        return f"{self.module}/{self.routine}/{self.span.line}{made}"


class RapidError(Exception):
    """A recoverable error of execution; `text` adds details for the log."""

    __slots__ = ("number", "raised", "settled", "target", "text", "way")

    def __init__(self, name: str | int, text: str = "") -> None:
        super().__init__(name)
        self.number: int = errnum(name) if isinstance(name, str) else name
        self.text = text
        self.settled = False
        """True after the correction of the task's budget."""
        self.raised = False
        """True if RAISE with a number raised it."""
        self.target: FrameType | None = None
        """Python frame of the routine whose handler receives the error [K §7.2, 7.3]."""
        self.way: int | None = None
        """How that handler has ended, when it has run already."""

    @property
    def name(self) -> str:
        """Name of the constant."""
        return error_name(self.number)


class MotionError(RapidError):
    """A target that the robot cannot reach: an error of the motion system, not of the statement.

    The switch `unreachable_target` decides if an ERROR handler receives it.
    """

    __slots__ = ()


class FatalError(Exception):
    """An error without a number: it is logged and stops the task."""

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
        """The unhandled error."""
        self.restartable = restartable
        """True if a start may execute the statement again."""
        self.stack: tuple[Location, ...] = ()
        """Call stack at the error, outermost first."""


class Unwind(BaseException):
    """Leaves every routine of the task and runs the UNDO handlers."""


class ExitCycle(Unwind):
    """Returns to the first statement of the entry routine; data stay."""


class EndOfRun(Unwind):
    """Ends the run: EXIT, or a moved program pointer."""


class ResumeInside(Unwind):
    """RaiseToUser \\Continue: RETRY or TRYNEXT for the inner statement."""

    def __init__(self, way: int) -> None:
        super().__init__(way)
        self.way = way


class PointerMoved(Unwind):
    """Leaves everything without UNDO, for the program pointer."""


class EventStopped(Unwind):
    """Stop in an event routine: leaves it and stops the program."""


# Python exceptions in compiled code and their RAPID errors.
PYTHON_ERRORS: dict[type[Exception], str] = {
    ZeroDivisionError: "ERR_DIVZERO",
    KeyError: "ERR_OUTOFBND",
    OverflowError: "ERR_NUM_LIMIT",
    # NaN where a whole number is needed: raw bytes of a socket can contain one.
    ValueError: "ERR_ARGVALERR",
}
RECOVERABLE: tuple[type[Exception], ...] = (RapidError, *PYTHON_ERRORS)


def python_error(kind: type[BaseException]) -> int:
    """Return the RAPID error number of a Python exception."""
    for known, name in PYTHON_ERRORS.items():
        if issubclass(kind, known):
            return errnum(name)
    raise TypeError(f"{kind.__name__} is no RAPID error")


def as_rapid_error(error: BaseException) -> RapidError:
    """Return one of `RECOVERABLE` as a RAPID error."""
    return error if isinstance(error, RapidError) else RapidError(python_error(type(error)))
