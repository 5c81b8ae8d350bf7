"""One RAPID task: the process that runs its routines, and what built-ins may ask of it."""

from collections.abc import Callable, Iterable
from typing import Any

from rapidgen.virtual.kernel import Kernel, Process, WaitSet

_NS = 1_000_000_000


class Task(Process):
    """A task while it runs. `controller` is the whole virtual controller."""

    __slots__ = ("__dict__",)

    def __init__(self, kernel: Kernel, name: str, controller: Any) -> None:  # noqa: ANN401
        super().__init__(kernel, name)
        self.controller = controller

    def sleep(self, seconds: float) -> None:
        """Let simulated time pass; traps are served meanwhile."""
        self.wait_for(_never, timeout=seconds)

    def wait_for(
        self,
        predicate: Callable[[], bool],
        *,
        on: Iterable[WaitSet] = (),
        timeout: float | None = None,
    ) -> bool:
        """Wait until `predicate()`, looked at now and whenever a member of `on` changes.

        False when `timeout` seconds passed first. Traps are served meanwhile.
        """
        if predicate():
            return True
        kernel = self.kernel
        expired = False

        def expire() -> None:
            nonlocal expired
            expired = True
            self.wake()

        timer = None if timeout is None else kernel.after(round(timeout * _NS), expire)
        watched = tuple(on)
        for wait_set in watched:
            wait_set.add(self.wake)
        try:
            while True:
                self.block()
                if predicate():
                    return True
                if expired:
                    return False
        finally:
            if timer is not None:
                timer.cancel()
            for wait_set in watched:
                wait_set.remove(self.wake)


def _never() -> bool:
    return False
