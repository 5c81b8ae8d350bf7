"""Work on several processes of this machine, and a function in a copy of this one.

A piece of work is a module's function of a context, which every worker has from the start, and of
an item. Its result depends on nothing else, so it does not matter who does it, nor how often: a
piece whose worker was lost is given to another one. `cluster.py` has workers of other machines.

A booted controller is copied by a fork in a few milliseconds; whatever is done to the copy ends
with it.
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
"""Workers that may be lost with a piece before it is taken for what ends them."""
LOOK = 0.5
"""s between two looks at the clock while results are awaited."""


class ForkFailed(Exception):
    """The copy ended without a result: killed, or by a fault of the interpreter."""


class RaisedElsewhere(Exception):
    """Why another process raised something: its text is the traceback from there."""

    def __str__(self) -> str:
        return f"\n{self.args[0]}"


class WorkersLost(Exception):
    """A piece ended every worker that it was given to, or there is none left."""


@dataclass(frozen=True, slots=True)
class Call:
    """A call of a module's function; `number` is its place in the work."""

    number: int
    function: Callable[..., object]
    item: object
    lost: int = 0
    """Workers that ended with it."""

    def again(self) -> "Call":
        """The same for another worker.

        Raises WorkersLost when it has ended too many.
        """
        if self.lost + 1 == TRIES:
            raise WorkersLost(f"{TRIES} workers ended with {self.item}")
        return replace(self, lost=self.lost + 1)


@dataclass(frozen=True, slots=True)
class CachedResult:
    """A result that is there already."""

    result: object


class WorkerPool(Protocol):
    """Who does pieces of work; on this machine or on others."""

    def room(self) -> bool:
        """Whether a further piece would be begun now, or soon."""

    def give(self, piece: Call) -> None:
        """Have a piece done."""

    def come(self, seconds: float) -> list[tuple[int, object]]:
        """Results that have come, by number; waits for one, but not longer than that.

        Raises what a piece has raised, and WorkersLost.
        """

    def __enter__(self) -> Self:
        """They are there."""

    def __exit__(self, *_: object) -> None:
        """They end what they are at, and go."""


def in_order(
    workers: WorkerPool,
    total: int,
    make: Callable[[int], "Call | CachedResult"],
    needs: Callable[[int], int] = lambda number: 0,
    over: Callable[[], bool] = lambda: False,
) -> Iterator[object]:
    """Results of `total` pieces, in their order.

    A piece is made once the results of the first `needs(number)` ones have been taken, so it may
    depend on them. Once `over()` none is begun any more; those under way still come.
    """
    given = accepted = 0
    results: dict[int, object] = {}
    while accepted < total:
        if accepted in results:
            yield results.pop(accepted)
            accepted += 1
        elif given < total and needs(given) <= accepted and workers.room() and not over():
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
    """Results of a function for each piece of work, in order."""
    for result in in_order(workers, len(work), lambda n: Call(n, function, work[n])):
        yield cast(R, result)


class LocalPool:
    """Processes of this machine, copies of this one: they have the context by that."""

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
        """Process ids of the workers."""
        return [process.pid for process in self._processes.values() if process.pid is not None]

    def room(self) -> bool:
        """Whether a worker has nothing to do."""
        return None in self._pieces.values()

    def give(self, piece: Call) -> None:
        """Have a piece done by a worker that has nothing to do."""
        idle = next(one for one, busy in self._pieces.items() if busy is None)
        self._pieces[idle] = piece
        # Of a worker that is gone `come` hears, too.
        with suppress(BrokenPipeError, ConnectionResetError):
            idle.send((piece.function, piece.item))

    def come(self, seconds: float) -> list[tuple[int, object]]:
        """Results that have come; a worker that was lost is replaced."""
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
        """Let the workers end what they are at, and go."""
        for connection in list(self._processes):
            self._dismiss(connection)

    def _hire(self) -> None:
        ours, theirs = get_context("fork").Pipe()
        # Whoever holds another worker's end keeps that one from seeing that this process is gone.
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
    """What a worker does: calls that come are done, until nobody is there any more."""
    # An interruption is for whoever gives the work.
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
    """The result of `function`, or what it raised.

    Raises ForkFailed when there is neither.
    """
    reading, writing = os.pipe()
    with _no_matter_of_threads():
        child = os.fork()
    if child == 0:
        os.close(reading)
        # What is there stays there: nobody looks whether it is garbage.
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
    """Threads of a test runner do not matter: the copy uses none of their locks."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        yield


def _outcome(function: Callable[[], object]) -> tuple[bool, object]:
    """Whether a call returned, and what it returned or raised."""
    try:
        return True, function()
    except Exception as error:  # noqa: BLE001 - handed to whoever asked, who raises it
        return False, (error, traceback.format_exc())


def reraise(outcome: object) -> NoReturn:
    """Raise what another process has raised, with where that was."""
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
