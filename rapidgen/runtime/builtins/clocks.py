"""Stop watches, date and time, and what the controller tells about itself.

Sources: S4 reference, pages clock, ClkStart to ClkRead, CDate, CTime, GetTime [manual]; the form
of GetSysInfo's texts is remembered only [mem].
"""

from collections.abc import Callable

from rapidgen.machine.calendar import date_time
from rapidgen.rapid.numbers import single
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.registry import builtin, builtins
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Value, register_type

_MS = 1_000_000
_US = 1_000
_S = 1_000_000_000
_LONGEST = 4_294_967
"""Seconds that a clock can hold, about 49 days."""


class StopWatch:
    """A `clock`: what it has measured, and since when it runs (ns), if it does."""

    __slots__ = ("measured", "started")

    def __init__(self) -> None:
        self.measured = 0
        self.started: int | None = None

    def read(self, now: int) -> int:
        """Nanoseconds; ERR_OVERFLOW beyond 49 days."""
        total = self.measured + (0 if self.started is None else now - self.started)
        if total > _LONGEST * _S:
            raise RapidError("ERR_OVERFLOW", "a clock holds 49 days")
        return total


register_type("clock", StopWatch)


@builtin("ClkReset")
def clk_reset(_task: Task, clock: StopWatch) -> None:
    """Stop and set to 0."""
    clock.measured = 0
    clock.started = None


@builtin("ClkStart")
def clk_start(task: Task, clock: StopWatch) -> None:
    """Run on from where it stands."""
    clock.read(task.scheduler.now)
    if clock.started is None:
        clock.started = task.scheduler.now


@builtin("ClkStop")
def clk_stop(task: Task, clock: StopWatch) -> None:
    """Stop; the value stays."""
    clock.measured = clock.read(task.scheduler.now)
    clock.started = None


@builtin("ClkRead")
def clk_read(task: Task, clock: StopWatch, high_resolution: bool | None) -> float:
    """Seconds, in steps of 1 ms (1 µs with \\HighRes)."""
    step = _US if high_resolution else _MS
    return single(clock.read(task.scheduler.now) // step * step / _S)


@builtin("GetTime")
def get_time(
    task: Task, weekday: bool | None, hour: bool | None, minute: bool | None, second: bool | None
) -> int:
    """One part of date and time; Monday is 1."""
    now = date_time(task.scheduler)
    if weekday:
        return now.isoweekday()
    if hour:
        return now.hour
    if minute:
        return now.minute
    if second:
        return now.second
    raise FatalError(40_661, "GetTime needs a part", "one of \\WDay, \\Hour, \\Min and \\Sec")


_SHOWN: dict[str, Callable[..., Value]] = {
    "CDate": lambda task: f"{date_time(task.scheduler):%Y-%m-%d}",
    "CTime": lambda task: f"{date_time(task.scheduler):%H:%M:%S}",
}
builtins(_SHOWN, cost="string")
