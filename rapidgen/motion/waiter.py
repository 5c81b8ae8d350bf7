"""Whoever waits for a robot."""

from collections.abc import Callable, Iterable
from typing import Protocol

from rapidgen.machine.scheduler import WaitSet


class Waiter(Protocol):
    """What a group needs of a program: RAPID tasks do it, and Python functions in tests."""

    def wait_for(
        self,
        predicate: Callable[[], bool],
        *,
        on: Iterable[WaitSet] = (),
        timeout: float | None = None,
    ) -> bool:
        """Wait until the predicate holds."""
