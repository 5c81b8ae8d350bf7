"""Whoever waits for a robot: what a group needs of a task."""

from collections.abc import Callable, Iterable
from typing import Protocol

from rapidgen.machine.scheduler import WaitSet


class Waiter(Protocol):
    """What a task can do for a move."""

    def wait_for(
        self,
        predicate: Callable[[], bool],
        *,
        on: Iterable[WaitSet] = (),
        timeout: float | None = None,
    ) -> bool:
        """Wait until the predicate holds."""
