"""Workers of a Dask scheduler, on any number of machines (extra `rapidgen[cluster]`).

Each has to be of the same build: it says so when it is seen first, and gets the context then. A
worker that is gone takes nothing along: what it was at is given to another one.
"""

import hashlib
import pickle
import queue
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass

from distributed import Client, Future
from distributed.client import FutureCancelledError
from distributed.scheduler import KilledWorker

from rapidgen._compat import Self
from rapidgen.diagnostics import DiagnosticError, refusal
from rapidgen.verification.build_identity import identity
from rapidgen.verification.worker_pool import Call, WorkersLost, reraise
from rapidgen.verification.worker_process import WorkerProcess, WorkerProcessLost

CONNECTS = 10
"""s in which the scheduler answers."""
EVERY = 1.0
"""s between two looks at who is there."""
NOBODY = 60.0
"""s without a worker after which there will be none."""
AHEAD = 1
"""Pieces that a worker has besides those that it is at."""


@dataclass(frozen=True, slots=True)
class _Given:
    piece: Call
    worker: str
    future: "Future[tuple[bool, object]]"


class Cluster:
    """The workers of a scheduler that are of this build."""

    def __init__(self, address: str, context: object, tell: Callable[[str], None]) -> None:
        """Connect; `tell` hears of workers that come, go and are refused.

        DiagnosticError RG808.
        """
        self._address = address
        self._tell = tell
        self._context = pickle.dumps(context)
        self._key = hashlib.sha256(self._context).hexdigest()
        self._workers: dict[str, int] = {}
        self._refused: dict[str, str] = {}
        self._given: dict[int, _Given] = {}
        self._waiting: list[Call] = []
        self._come: queue.SimpleQueue[Future[tuple[bool, object]]] = queue.SimpleQueue()
        try:
            self._client = Client(address, timeout=CONNECTS, set_as_default=False)
        except (OSError, ValueError) as fault:
            help = "start it: dask scheduler; or `make cluster` on one machine"
            raise _none(address, "no Dask scheduler answers", help) from fault
        self._looked = self._seen = time.monotonic()
        with suppress(TimeoutError):
            self._client.wait_for_workers(1, timeout=CONNECTS)
        self._look()
        if not self._workers:
            reply = "; ".join(sorted(set(self._refused.values()))) or "it has none"
            self._client.close()
            help = "start some with this rapidgen: dask worker ADDRESS --nthreads 1"
            raise _none(address, f"no worker can be used: {reply}", help)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def room(self) -> bool:
        """Whether a worker would begin a further piece soon."""
        slots = sum(threads + AHEAD for threads in self._workers.values())
        return len(self._given) + len(self._waiting) < slots

    def give(self, piece: Call) -> None:
        """Have a piece done by the worker that has the least to do."""
        if not self._workers:
            self._waiting.append(piece)
            return
        busy = [given.worker for given in self._given.values()]
        worker = min(self._workers, key=lambda w: (busy.count(w) / self._workers[w], w))
        future = self._client.submit(
            perform,
            self._key,
            piece.function,
            piece.item,
            workers=[worker],
            allow_other_workers=False,
            pure=False,
        )
        self._given[piece.number] = _Given(piece, worker, future)
        future.add_done_callback(self._come.put)

    def come(self, seconds: float) -> list[tuple[int, object]]:
        """Results that have come; what a lost worker was at is given to another one."""
        result: list[tuple[int, object]] = []
        with suppress(queue.Empty):
            done = [self._come.get(timeout=min(seconds, EVERY))]
            while not self._come.empty():
                done.append(self._come.get())
            by_key = {given.future.key: given for given in self._given.values()}
            for future in done:
                given = by_key.get(future.key)
                if given is not None and given.future is future:
                    result += self._result(given)
        if time.monotonic() - self._looked > EVERY:
            self._look()
        return result

    def close(self) -> None:
        """Take back what was given, and leave the scheduler; its workers stay."""
        self._client.cancel([given.future for given in self._given.values()])
        with suppress(OSError):
            self._client.run(dismiss, self._key, workers=list(self._workers))
        self._client.close()

    def _result(self, given: _Given) -> list[tuple[int, object]]:
        del self._given[given.piece.number]
        try:
            good, result = self._fetched(given)
        except (WorkerProcessLost, KilledWorker, FutureCancelledError):
            self._again(given)
            return []
        if not good:
            reraise(result)
        return [(given.piece.number, result)]

    def _fetched(self, given: _Given) -> tuple[bool, object]:
        """What a worker has made of a piece.

        Raises WorkerProcessLost, KilledWorker, FutureCancelledError.

        A worker may be lost between its answer and this: Dask then waits for it to come back.
        """
        while True:
            try:
                outcome: tuple[bool, object] = given.future.result(timeout=EVERY)
            except TimeoutError:
                if given.worker not in self._client.nthreads():
                    self._client.cancel([given.future])
                    raise WorkerProcessLost(
                        f"worker {given.worker} took its result along"
                    ) from None
            else:
                return outcome

    def _again(self, given: _Given) -> None:
        self._tell(f"worker {given.worker} was lost: what it was at is done again")
        self.give(given.piece.again())

    def _look(self) -> None:
        """Who is there; new ones are asked for their build, and given the context."""
        target = self._client.nthreads()
        self._looked = time.monotonic()
        new = [worker for worker in target if worker not in {*self._workers, *self._refused}]
        answers = self._client.run(
            rejection_reason, identity(), self._key, self._context, workers=new, on_error="return"
        )
        for worker in new:
            answer = answers.get(worker)
            if answer is None or isinstance(answer, OSError):
                continue  # it is gone, or will answer next time
            if answer == "":
                self._workers[worker] = target[worker]
                continue
            reason = answer if isinstance(answer, str) else f"it has another rapidgen ({answer})"
            self._refused[worker] = reason
            self._tell(f"worker {worker} is refused: {reason}")
        gone = [worker for worker in self._workers if worker not in target]
        for worker in gone:
            del self._workers[worker]
        for given in [given for given in self._given.values() if given.worker in gone]:
            del self._given[given.piece.number]
            self._client.cancel([given.future])
            self._again(given)
        if self._workers:
            self._seen = self._looked
            waiting, self._waiting = self._waiting, []
            for piece in waiting:
                self.give(piece)
        elif self._looked - self._seen > NOBODY:
            raise WorkersLost(
                f"the scheduler at {self._address} has had no worker for {NOBODY:g} s"
            )


def _none(address: str, what: str, help: str) -> DiagnosticError:
    return refusal("RG808", None, f"{address}: {what}", help)


# -- in the process of a Dask worker --------------------------------------------------------------

_contexts: dict[str, bytes] = {}
_idle: dict[str, list[WorkerProcess]] = {}
_lock = threading.Lock()


def rejection_reason(build: str, key: str, context: bytes) -> str:
    """Why this worker cannot be used; empty: it can, and has the context now."""
    if identity() != build:
        return f"its rapidgen is {identity()}, not {build}"
    with _lock:
        _contexts[key] = context
    return ""


def perform(key: str, function: Callable[..., object], item: object) -> tuple[bool, object]:
    """A piece of work, by an engine that has nothing to do.

    Raises WorkerProcessLost.
    """
    with _lock:
        idle = _idle.setdefault(key, [])
        engine = idle.pop() if idle else None
    engine = engine or WorkerProcess(_contexts[key])
    outcome = engine.work(function, item)
    with _lock:
        _idle.setdefault(key, []).append(engine)
    return outcome


def dismiss(key: str) -> None:
    """The campaign is over."""
    with _lock:
        _contexts.pop(key, None)
        engines = _idle.pop(key, [])
    for engine in engines:
        engine.close()
