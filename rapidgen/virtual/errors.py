"""Errors and other ways out of RAPID code.

`RapidError` is what an ERROR handler can handle: it has a number (ERRNO). `FatalError` stops
the task. Numbers of the ERR_ constants are in no public source; they are opaque and distinct.
"""

from collections.abc import Iterable

from rapidgen.virtual.errnames import ERROR_NAMES

FIRST_SYSTEM_ERROR = 1001
LARGEST_USER_ERROR = 90
"""RAISE takes 1 to 90 [K §4.8]."""

_NUMBERS = {name: FIRST_SYSTEM_ERROR + i for i, name in enumerate(ERROR_NAMES)}
_NAMES = {number: name for name, number in _NUMBERS.items()}
LONG_JMP_ALL_ERR = _NUMBERS["LONG_JMP_ALL_ERR"]


def errnum(name: str) -> int:
    """Number of an ERR_ constant (any case). KeyError: there is no such constant."""
    return _NUMBERS[name.upper()]


def error_name(number: float) -> str:
    """`ERR_DIVZERO` for its number; the number as text when it is a user's own."""
    return _NAMES.get(int(number), f"error {number:g}")


class RapidError(Exception):
    """A recoverable error of execution. `text` says more for the event log."""

    __slots__ = ("jumping", "number", "text")

    def __init__(self, name: str | int, text: str = "") -> None:
        super().__init__(name)
        self.number: int = errnum(name) if isinstance(name, str) else name
        self.text = text
        self.jumping = False
        """Whether it is on its way to a long-jump handler [K §7.2]."""

    @property
    def name(self) -> str:
        """The constant's name."""
        return error_name(self.number)


class FatalError(Exception):
    """An error without a number: the event is logged and the task stops."""

    __slots__ = ("arguments", "event", "title")

    def __init__(self, event: int, title: str, *arguments: str) -> None:
        super().__init__(title)
        self.event = event
        self.title = title
        self.arguments = arguments


class Unwind(BaseException):
    """Leaves every routine of the task and runs their UNDO handlers."""


class ExitCycle(Unwind):
    """Back to the first statement of the entry routine; data are kept."""


class EndOfRun(Unwind):
    """EXIT, PP moved, or the controller is closed: the run is over."""

    def __init__(self, *, restart: bool = False) -> None:
        super().__init__()
        self.restart = restart


# Python's own exceptions in compiled code, and what RAPID calls them.
PYTHON_ERRORS: dict[type[Exception], str] = {
    ZeroDivisionError: "ERR_DIVZERO",
    KeyError: "ERR_OUTOFBND",
    OverflowError: "ERR_NUM_LIMIT",
}
RECOVERABLE: tuple[type[Exception], ...] = (RapidError, *PYTHON_ERRORS)


def as_rapid_error(error: BaseException) -> RapidError:
    """The RAPID error that one of `RECOVERABLE` stands for."""
    if isinstance(error, RapidError):
        return error
    for kind, name in PYTHON_ERRORS.items():
        if isinstance(error, kind):
            return RapidError(name)
    raise TypeError(f"{type(error).__name__} is no RAPID error") from error


def known_names() -> Iterable[str]:
    """Every ERR_ constant."""
    return ERROR_NAMES
