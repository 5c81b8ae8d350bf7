"""Workers of a Dask scheduler on any number of machines.

Needs the extra `rapidgen[cluster]`. Each worker must have the same build: it reports its build at
first contact and gets the context then. If a worker is lost, another worker gets its items.
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
from rapidgen.verification.result_file import identity
from rapidgen.verification.worker_pool import Call, WorkersLost, reraise
from rapidgen.verification.worker_process import WorkerProcess, WorkerProcessLost

CONNECTS = 10
"""s within which the scheduler must answer."""
EVERY = 1.0
"""s between two checks of the list of workers."""
WORKER_TIMEOUT = 60.0
"""s without a worker after which the campaign stops."""
AHEAD = 1
"""Items queued at a worker besides those in progress."""


@dataclass(frozen=True, slots=True)
class _Given:
    piece: Call
    worker: str
    future: "Future[tuple[bool, object]]"


class Cluster:
    """The workers of a scheduler that have this build."""

    def __init__(self, address: str, context: object, tell: Callable[[str], None]) -> None:
        """Connect; report workers that join, leave or are rejected to `tell`.

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

    def has_capacity(self) -> bool:
        """True if a worker could start another item soon."""
        slots = sum(threads + AHEAD for threads in self._workers.values())
        return len(self._given) + len(self._waiting) < slots

    def give(self, piece: Call) -> None:
        """Submit an item to the worker with the least work."""
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
        """Return finished results; resubmit the items of lost workers."""
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
        """Cancel the submitted items and disconnect; the workers stay."""
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
        """Return the result of an item.

        Raises WorkerProcessLost, KilledWorker, FutureCancelledError.

        If a worker is lost between its answer and this call, Dask waits until it returns.
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
        self._tell(f"worker {given.worker} was lost: its items are done again")
        self.give(given.piece.again())

    def _look(self) -> None:
        """Update the list of workers.

        New workers are asked for their build and get the context.
        """
        target = self._client.nthreads()
        self._looked = time.monotonic()
        new = [worker for worker in target if worker not in {*self._workers, *self._refused}]
        answers = self._client.run(
            rejection_reason, identity(), self._key, self._context, workers=new, on_error="return"
        )
        for worker in new:
            answer = answers.get(worker)
            if answer is None or isinstance(answer, OSError):
                continue  # the worker has left, or answers next time
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
        elif self._looked - self._seen > WORKER_TIMEOUT:
            raise WorkersLost(
                f"the scheduler at {self._address} has had no worker for {WORKER_TIMEOUT:g} s"
            )


def _none(address: str, what: str, help: str) -> DiagnosticError:
    return refusal("RG808", None, f"{address}: {what}", help)


# -- in the process of a Dask worker ------------------------------------------------------------

_contexts: dict[str, bytes] = {}
_idle: dict[str, list[WorkerProcess]] = {}
_lock = threading.Lock()


def rejection_reason(build: str, key: str, context: bytes) -> str:
    """Return why this worker cannot be used, or an empty string.

    If it can, it has the context afterwards.
    """
    if identity() != build:
        return f"its rapidgen is {identity()}, not {build}"
    with _lock:
        _contexts[key] = context
    return ""


def perform(key: str, function: Callable[..., object], item: object) -> tuple[bool, object]:
    """Do a work item in an idle worker process.

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
    """End the worker processes of a finished campaign."""
    with _lock:
        _contexts.pop(key, None)
        engines = _idle.pop(key, [])
    for engine in engines:
        engine.close()
