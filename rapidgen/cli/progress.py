"""How far long work is, how fast it goes, what is left: bars on a terminal, lines in a pipe."""

import sys
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, TextIO

from rapidgen.cli.verbosity import is_quiet

if TYPE_CHECKING:
    from rich.progress import TaskID

EVERY = 10.0
"""s between two lines."""


class Bars:
    """Called with what is done, how many of it are, and of how many."""

    def __init__(
        self, stream: TextIO | None = None, clock: Callable[[], float] = time.monotonic
    ) -> None:
        from rich.console import Console
        from rich.progress import (
            BarColumn,
            MofNCompleteColumn,
            Progress,
            TaskProgressColumn,
            TextColumn,
            TimeRemainingColumn,
        )

        self._stream = stream or sys.stderr
        self._clock = clock
        self._terminal = self._stream.isatty()
        self._bars = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            TaskProgressColumn(),
            MofNCompleteColumn(),
            TextColumn("{task.fields[rate]}"),
            TimeRemainingColumn(),
            console=Console(file=self._stream),
            disable=not self._terminal or is_quiet(),
        )
        self._tasks: dict[str, TaskID] = {}
        self._begun: dict[str, tuple[float, int]] = {}
        self._told = clock()

    def __enter__(self) -> Callable[[str, int, int], None]:
        self._bars.start()
        return self._step

    def __exit__(self, *_: object) -> None:
        self._bars.stop()

    def _step(self, what: str, done: int, total: int) -> None:
        now = self._clock()
        started, before = self._begun.setdefault(what, (now, done))
        rate = (done - before) / (now - started) if now > started else 0.0
        if self._terminal:
            self._show(what, done, total, rate)
        elif now - self._told >= EVERY and not is_quiet():
            self._told = now
            left = f", {_time((total - done) / rate)} left" if rate else ""
            self._stream.write(f"{what}: {done} of {total}, {rate:.3g} in a second{left}\n")
            self._stream.flush()

    def _show(self, what: str, done: int, total: int, rate: float) -> None:
        if what not in self._tasks:
            self._tasks[what] = self._bars.add_task(what, total=total, rate="")
        text = f"{rate:.3g}/s" if rate else ""
        self._bars.update(self._tasks[what], completed=done, rate=text)


def _time(seconds: float) -> str:
    minutes, remaining = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min {remaining} s"
