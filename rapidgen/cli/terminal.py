"""Colour, verbosity, progress bars and signals of the terminal."""

import logging
import os
import signal
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, TextIO

if TYPE_CHECKING:
    from rich.progress import TaskID


def letters(text: str) -> str:
    """Decode a RAPID string for display: its bytes are UTF-8 if the file is."""
    try:
        return text.encode("latin-1").decode("utf-8")
    except UnicodeError:
        return text


def is_terminal() -> bool:
    """True if the user can be asked: stdin and stderr are a terminal."""
    return sys.stdin.isatty() and sys.stderr.isatty()


def use_colour(stream: object = None) -> bool:
    """True if a stream (default: stderr) is a terminal and NO_COLOR is not set."""
    isatty = getattr(stream or sys.stderr, "isatty", lambda: False)
    return bool(isatty()) and not os.environ.get("NO_COLOR")


_LEVELS = {
    "-v": logging.INFO,
    "--verbose": logging.INFO,
    "-vv": logging.DEBUG,
    "-q": logging.ERROR,
    "--quiet": logging.ERROR,
}
_LOG = logging.getLogger("rapidgen")
"""Parent of the loggers of all packages."""


def set_up(text: Sequence[str]) -> list[str]:
    """Set the log level from -v, -vv and -q; return the other words.

    The log goes to stderr. These options may stand anywhere on the command line.
    """
    options = [word for word in text if word in _LEVELS]
    repeated = options.count("-v") + options.count("--verbose") > 1
    _LOG.setLevel(
        logging.DEBUG
        if repeated
        else min(map(_LEVELS.__getitem__, options), default=logging.WARNING)
    )
    if not any(isinstance(handler, _ToStderr) for handler in _LOG.handlers):
        handler = _ToStderr()
        handler.setFormatter(
            logging.Formatter("%(asctime)s.%(msecs)03d %(name)s: %(message)s", "%H:%M:%S")
        )
        _LOG.addHandler(handler)
    return [word for word in text if word not in options]


def is_quiet() -> bool:
    """True if only errors are to be shown."""
    return _LOG.getEffectiveLevel() >= logging.ERROR


class _ToStderr(logging.Handler):
    """Write records to the stream that is `sys.stderr` at the time."""

    def emit(self, record: logging.LogRecord) -> None:
        """Write one line."""
        sys.stderr.write(self.format(record) + "\n")


LINE_PERIOD = 10.0
"""Seconds between two lines of progress where stderr is no terminal."""


class Bars:
    """Progress of long work: bars on a terminal, lines elsewhere.

    Entering it returns a function that takes the name of the work, the number of finished steps
    and their total.
    """

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
        self._started: dict[str, tuple[float, int]] = {}
        self._last_line = clock()

    def __enter__(self) -> Callable[[str, int, int], None]:
        self._bars.start()
        return self._step

    def __exit__(self, *_: object) -> None:
        self._bars.stop()

    def _step(self, name: str, done: int, total: int) -> None:
        now = self._clock()
        started, before = self._started.setdefault(name, (now, done))
        rate = (done - before) / (now - started) if now > started else 0.0
        if self._terminal:
            self._show(name, done, total, rate)
        elif now - self._last_line >= LINE_PERIOD and not is_quiet():
            self._last_line = now
            left = f", {_time((total - done) / rate)} left" if rate else ""
            self._stream.write(f"{name}: {done} of {total}, {rate:.3g} per second{left}\n")
            self._stream.flush()

    def _show(self, name: str, done: int, total: int, rate: float) -> None:
        if name not in self._tasks:
            self._tasks[name] = self._bars.add_task(name, total=total, rate="")
        text = f"{rate:.3g}/s" if rate else ""
        self._bars.update(self._tasks[name], completed=done, rate=text)


def _time(seconds: float) -> str:
    minutes, remaining = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min {remaining} s"


@contextmanager
def on_signal(end: Callable[[], None]) -> Iterator[None]:
    """Call `end()` in a separate thread at Ctrl-C, SIGTERM or SIGHUP.

    A signal handler would not do: the code that it interrupts may hold any lock. It also runs in
    the main thread, which continues to wait if another thread received the signal. Python writes
    to the wakeup descriptor in both cases (documentation of signal.set_wakeup_fd).
    """
    import socket
    import threading

    from rapidgen._interruption import heeded_signals

    numbers = heeded_signals()
    receiver, sender = socket.socketpair()
    sender.setblocking(False)

    def watch() -> None:
        while number := receiver.recv(1):
            if number[0] in numbers:
                end()

    watcher = threading.Thread(target=watch, name="signals", daemon=True)
    previous_fd = signal.set_wakeup_fd(sender.fileno(), warn_on_full_buffer=False)
    before = {number: signal.signal(number, lambda *_: None) for number in numbers}
    watcher.start()
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        signal.set_wakeup_fd(previous_fd)
        sender.close()
        watcher.join()
        receiver.close()
