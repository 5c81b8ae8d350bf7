"""A thread in which a controller runs by itself, on the real clock."""

import threading
from collections.abc import Callable
from typing import TypeVar

from rapidgen.machine.scheduler import Scheduler

_T = TypeVar("_T")
_LOOK = 0.1
"""s between two looks whether the thread is still there to answer."""


class ControllerThread:
    """Lets a scheduler advance, and carries out what other threads ask."""

    def __init__(self, scheduler: Scheduler, name: str) -> None:
        self._scheduler = scheduler
        self._name = name
        self._thread: threading.Thread | None = None
        self._stopping = False

    def start(self) -> None:
        """Run from now on. ValueError: the clock is not the real one."""
        if self._scheduler.clock != "real":
            raise ValueError('only clock="real" runs by itself; else use run_for and run_until')
        if self._thread is not None:
            return
        self._stopping = False
        self._scheduler.rebase()
        self._thread = threading.Thread(
            target=lambda: self._scheduler.advance(stop=lambda: self._stopping),
            name=self._name,
            daemon=True,
        )
        self._thread.start()

    def stop(self, last: Callable[[], None] | None = None) -> None:
        """End the thread, which can be started again; `last` is what it does as its last."""

        def end() -> None:
            self._stopping = True
            if last is not None:
                last()

        self.call(end)
        if self._thread is not None:
            self._thread.join()
            self._thread = None

    def call(self, function: Callable[[], _T]) -> _T:
        """Run `function` on the thread, or here where there is none, and return its result."""
        thread = self._thread
        if thread is None or thread is threading.current_thread() or not thread.is_alive():
            return function()
        done = threading.Event()
        result: list[_T] = []

        def run() -> None:
            try:
                result.append(function())
            finally:
                done.set()

        self._scheduler.post(run)
        while not done.wait(_LOOK):
            if not thread.is_alive() and not done.is_set():
                # A fault has ended the thread: nobody else runs anything any more.
                return function()
        if not result:
            raise RuntimeError("the controller's thread could not carry out the request")
        return result[0]
