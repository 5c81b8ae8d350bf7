"""A thread that runs a controller on the real clock."""

import atexit
import threading
from collections.abc import Callable
from queue import SimpleQueue
from typing import TypeVar

from rapidgen.machine.scheduler import CLOSED, Scheduler

_T = TypeVar("_T")
_LOOK = 0.1
"""s between two looks whether the thread is still there to answer."""
_LEAVING = 2.0
"""s that a thread has to end with the program: a callback may hold it for ever."""


class ControllerThread:
    """A thread that advances a scheduler and runs functions of others.

    It is one thread until `close`: greenlets of RAPID tasks cannot move to another one. While it is
    stopped, a calling thread runs its function itself.
    """

    def __init__(self, scheduler: Scheduler, name: str, last: Callable[[], None]) -> None:
        """`last` is the last function of the thread."""
        self._scheduler = scheduler
        self._name = name
        self._last = last
        self._thread: threading.Thread | None = None
        self._stopping = False
        self._stopped = threading.Event()
        self._going_on: SimpleQueue[bool] = SimpleQueue()
        """True to continue, False to end."""

    @property
    def owns_tasks(self) -> bool:
        """True if the controller's tasks run in this thread, even if stopped."""
        return self._thread is not None

    def start(self) -> None:
        """Run from now on.

        ValueError: the clock is not the real one. RuntimeError: closed.
        """
        if self._scheduler.clock != "real":
            raise ValueError('only clock="real" runs by itself; else use run_for and run_until')
        if self._scheduler.is_closed:
            raise RuntimeError(CLOSED)
        if self._thread is not None and not self._stopped.is_set():
            return
        self._stopping = False
        self._scheduler.rebase()
        if self._thread is not None:
            self._stopped.clear()
            self._going_on.put(True)
            return
        self._thread = threading.Thread(target=self._run, name=self._name, daemon=True)
        self._thread.start()
        # The interpreter ends with a crash where greenlets of another thread still run.
        atexit.register(self._leave)

    def _run(self) -> None:
        goes_on = True
        while goes_on:
            self._scheduler.advance(stop=lambda: self._stopping)
            self._stopped.set()
            goes_on = self._going_on.get()
        self._last()

    def _leave(self) -> None:
        """End with the program, without a regular close."""
        thread = self._thread
        if thread is not None and thread.is_alive():
            self._scheduler.post(self._stand)
            if self._stopped.wait(_LEAVING):
                self._going_on.put(False)
                thread.join(_LEAVING)

    def stop(self) -> None:
        """Stop the thread; `start` continues."""
        thread = self._thread
        if thread is None or self._stopped.is_set():
            return

        self.call(self._stand)
        while not self._rests(thread):
            self._stopped.wait(_LOOK)

    def _stand(self) -> None:
        self._stopping = True

    def close(self) -> None:
        """End the thread, or run its last function here."""
        self.stop()
        atexit.unregister(self._leave)
        thread = self._thread
        if thread is None or not thread.is_alive():
            self._last()
            return
        self._going_on.put(False)
        thread.join()
        self._thread = None

    def call(self, function: Callable[[], _T]) -> _T:
        """Run `function` on the thread and return its result.

        Without a running thread it runs here. Exceptions are raised here; the controller continues.
        """
        thread = self._thread
        if thread is None or thread is threading.current_thread() or self._rests(thread):
            return function()
        done = threading.Event()
        in_use = threading.Lock()
        result: list[_T] = []
        raised: list[BaseException] = []

        def run() -> None:
            if not in_use.acquire(blocking=False):
                return
            try:
                result.append(function())
            except BaseException as fault:  # noqa: BLE001 - passed to the caller
                raised.append(fault)
            finally:
                done.set()

        self._scheduler.post(run)
        while not done.wait(_LOOK):
            # The thread stopped or ended by a fault before this function: run it here.
            if self._rests(thread) and in_use.acquire(blocking=False):
                return function()
        if raised:
            raise raised[0]
        return result[0]

    def _rests(self, thread: threading.Thread) -> bool:
        return self._stopped.is_set() or not thread.is_alive()
