"""Process pool of this machine, and a function call in a fork.

A work item is a module's function of a context, which every worker has from the start, and of an
argument. Its result depends on nothing else, so any worker may do it, more than once: the item of a
lost worker is given to another one. `cluster.py` has workers of other machines.

A fork copies a booted controller in a few milliseconds; changes to the copy end with it.
"""

import gc
import os
import pickle
import signal
import traceback
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import NoReturn, Protocol, TypeVar, cast

from rapidgen._compat import Self
from rapidgen.machine.files import remove_scratch_folders

R = TypeVar("R")

TRIES = 3
"""Workers that an item may end before it counts as the cause."""
LOOK = 0.5
"""s between two looks at the clock while waiting for results."""


class ForkFailed(Exception):
    """The fork ended without a result: killed, or an interpreter fault."""


class RaisedElsewhere(Exception):
    """Reason of an exception in another process: its traceback as text."""

    def __str__(self) -> str:
        return f"\n{self.args[0]}"


class WorkersLost(Exception):
    """An item ended every worker that it was given to, or none is left."""


@dataclass(frozen=True, slots=True)
class Call:
    """A call of a module's function; `number` is its place in the work."""

    number: int
    function: Callable[..., object]
    item: object
    lost: int = 0
    """Workers that ended with it."""

    def again(self) -> "Call":
        """Return the same call for another worker.

        Raises WorkersLost when it has ended too many.
        """
        if self.lost + 1 == TRIES:
            raise WorkersLost(f"{TRIES} workers ended with {self.item}")
        return replace(self, lost=self.lost + 1)


@dataclass(frozen=True, slots=True)
class CachedResult:
    """A known result."""

    result: object


class WorkerPool(Protocol):
    """Workers on this machine or on others."""

    def has_capacity(self) -> bool:
        """True if the pool could start another item now, or soon."""

    def give(self, piece: Call) -> None:
        """Submit an item."""

    def come(self, seconds: float) -> list[tuple[int, object]]:
        """Return finished results by number; wait at most `seconds` for one.

        Raises the exception of an item, and WorkersLost.
        """

    def __enter__(self) -> Self:
        """Start the workers."""

    def __exit__(self, *_: object) -> None:
        """Finish current items and stop the workers."""


def in_order(
    workers: WorkerPool,
    total: int,
    make: Callable[[int], "Call | CachedResult"],
    needs: Callable[[int], int] = lambda number: 0,
    over: Callable[[], bool] = lambda: False,
) -> Iterator[object]:
    """Yield results of `total` items in order.

    An item is created once the first `needs(number)` results are available, so it may depend on
    them. After `over()` is true no new item starts; those in progress still finish.
    """
    given = accepted = 0
    results: dict[int, object] = {}
    while accepted < total:
        if accepted in results:
            yield results.pop(accepted)
            accepted += 1
        elif given < total and needs(given) <= accepted and workers.has_capacity() and not over():
            made = make(given)
            if isinstance(made, CachedResult):
                results[given] = made.result
            else:
                workers.give(made)
            given += 1
        elif given == accepted and over():
            return
        else:
            results.update(workers.come(LOOK))


def each(workers: WorkerPool, work: Sequence[object], function: Callable[..., R]) -> Iterator[R]:
    """Yield results of a function for each item, in order."""
    for result in in_order(workers, len(work), lambda n: Call(n, function, work[n])):
        yield cast(R, result)


class LocalPool:
    """Processes of this machine; forks of this one inherit the context."""

    def __init__(self, context: object, jobs: int | None = None) -> None:
        self._context = context
        self._processes: dict[Connection, BaseProcess] = {}
        self._pieces: dict[Connection, Call | None] = {}
        for _ in range(jobs or os.cpu_count() or 1):
            self._hire()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def processes(self) -> list[int]:
        """Return process ids of the workers."""
        return [process.pid for process in self._processes.values() if process.pid is not None]

    def has_capacity(self) -> bool:
        """True if a worker is idle."""
        return None in self._pieces.values()

    def give(self, piece: Call) -> None:
        """Submit an item to an idle worker."""
        idle = next(one for one, busy in self._pieces.items() if busy is None)
        self._pieces[idle] = piece
        # `come` also handles a worker that has ended.
        with suppress(BrokenPipeError, ConnectionResetError):
            idle.send((piece.function, piece.item))

    def come(self, seconds: float) -> list[tuple[int, object]]:
        """Return finished results; replace a lost worker."""
        failures: list[tuple[int, object]] = []
        for connection in wait([one for one, busy in self._pieces.items() if busy], seconds):
            assert isinstance(connection, Connection)
            piece = self._pieces[connection]
            assert piece is not None
            try:
                good, result = connection.recv()
            except (EOFError, ConnectionResetError):
                self._dismiss(connection)
                self._hire()
                self.give(piece.again())
                continue
            self._pieces[connection] = None
            if not good:
                reraise(result)
            failures.append((piece.number, result))
        return failures

    def close(self) -> None:
        """Let the workers finish their items, and stop them."""
        for connection in list(self._processes):
            self._dismiss(connection)

    def _hire(self) -> None:
        ours, theirs = get_context("fork").Pipe()
        # A copy of another worker's connection end would hide the end of this process.
        others = (*self._processes, ours)
        process = get_context("fork").Process(
            target=_work, args=(theirs, others, self._context), daemon=True
        )
        with _no_matter_of_threads():
            process.start()
        theirs.close()
        self._processes[ours], self._pieces[ours] = process, None

    def _dismiss(self, connection: Connection) -> None:
        process = self._processes.pop(connection)
        del self._pieces[connection]
        connection.close()
        process.join()


def _work(connection: Connection, others: Sequence[Connection], context: object) -> None:
    for other in others:
        other.close()
    serve(connection, context)


def serve(connection: Connection, context: object) -> None:
    """Do calls of a connection until it closes."""
    # The parent process handles interruptions.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)
    try:
        while True:
            function, item = connection.recv()
            connection.send(_outcome(lambda: function(context, item)))  # noqa: B023
    except (EOFError, BrokenPipeError, ConnectionResetError):
        return
    finally:
        remove_scratch_folders()


def run_in_fork(function: Callable[[], R]) -> R:
    """Return the result of `function` in a fork, or raise its exception.

    Raises ForkFailed when there is neither.
    """
    reading, writing = os.pipe()
    with _no_matter_of_threads():
        child = os.fork()
    if child == 0:
        os.close(reading)
        # Objects of the parent stay: the collector does not examine them.
        gc.freeze()
        _answer(function, writing)
    os.close(writing)
    with os.fdopen(reading, "rb") as stream:
        data = stream.read()
    _, status = os.waitpid(child, 0)
    if not data:
        raise ForkFailed(f"status {status}")
    good, result = pickle.loads(data)
    if not good:
        reraise(result)
    answer: R = result
    return answer


@contextmanager
def _no_matter_of_threads() -> Iterator[None]:
    """Ignore warnings about threads: the fork uses none of their locks."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        yield


def _outcome(function: Callable[[], object]) -> tuple[bool, object]:
    """Return success, and the result or exception of a call."""
    try:
        return True, function()
    except Exception as error:  # noqa: BLE001 - returned to the caller, which raises it
        return False, (error, traceback.format_exc())


def reraise(outcome: object) -> NoReturn:
    """Raise an exception of another process, with its traceback."""
    error, where = cast(tuple[Exception, str], outcome)
    raise error from RaisedElsewhere(where)


def _answer(function: Callable[[], object], writing: int) -> None:
    try:
        outcome = _outcome(function)
        with os.fdopen(writing, "wb") as stream:
            pickle.dump(outcome, stream)
    finally:
        remove_scratch_folders()
        os._exit(0)
