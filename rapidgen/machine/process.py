"""Processes: greenlets that share the CPU of a scheduler."""

import sys
from collections.abc import Callable
from types import FrameType

import greenlet

from rapidgen.machine.scheduler import Scheduler


class Process:
    """A greenlet that pays for its CPU time, such as a RAPID task.

    The launched function runs in the greenlet `body`. `process_pending()` is called at every poll
    and after every wait; there a task handles traps and stops.
    """

    __slots__ = ("_blocked", "_kicked", "b", "body", "name", "scheduler", "slice_end")

    def __init__(self, scheduler: Scheduler, name: str) -> None:
        self.scheduler = scheduler
        self.name = name
        self.b = 0
        self.slice_end = 0
        self._blocked = False
        self._kicked = False
        self.body: greenlet.greenlet | None = None

    # -- for the scheduler and its owner -----------------------------------------------------------

    def launch(self, function: Callable[[], None]) -> None:
        """Start a function in a new greenlet at the next turn."""
        self.body = greenlet.greenlet(function)
        self._blocked = False
        self.scheduler.ready.append(self)

    def abandon(self) -> None:
        """End the greenlet at its current place; it can be launched again."""
        self._blocked = False
        self.body = None

    @property
    def alive(self) -> bool:
        """True between launch and return."""
        return self.body is not None and not self.body.dead

    @property
    def frame(self) -> FrameType | None:
        """Innermost Python frame of a suspended process, or the caller's if it runs."""
        if self.body is greenlet.getcurrent():
            return sys._getframe(1)
        result: FrameType | None = self.body.gr_frame if self.body is not None else None
        return result

    def wake(self) -> None:
        """Make a blocked process ready; it evaluates the reason itself."""
        if self._blocked:
            self._blocked = False
            self.scheduler.ready.append(self)

    def process_pending(self) -> None:
        """Hook: called in the process after every poll and every wait."""

    # -- inside the process ----------------------------------------------------------------------

    def block(self) -> None:
        """Release the CPU until `wake()`, then call `process_pending()`."""
        self._blocked = True
        self.scheduler.suspend(self)
        self.process_pending()

    def poll(self, b: int) -> int:
        """Account for a spent budget, let time pass, return the next budget."""
        self.b = b
        scheduler = self.scheduler
        if scheduler.catch_up(self):
            scheduler.suspend(self)
        else:
            scheduler.grant(self)
        self.process_pending()
        return self.b

    def yield_cpu(self) -> None:
        """Let other ready processes run, then call `process_pending()`."""
        self.switch()
        self.process_pending()

    def switch(self) -> None:
        """Let other ready processes run, in the middle of a statement."""
        scheduler = self.scheduler
        self._kicked = False
        if scheduler.catch_up(self):
            scheduler.suspend(self)
        elif scheduler.ready:
            scheduler.ready.append(self)
            scheduler.suspend(self)
        else:
            scheduler.grant(self)
        if self._kicked:  # Events that arrived meanwhile have not been handled.
            self.wake_at_next_statement()

    def charge(self, cost: int) -> None:
        """Spend `cost` nanoseconds of CPU."""
        self.b -= cost
        if self.b < 0:
            self.poll(self.b)

    def wake_at_next_statement(self) -> None:
        """Call `process_pending()` before the next statement or in the wait."""
        scheduler = self.scheduler
        self._kicked = True
        if scheduler.running is self:
            scheduler.deadline -= self.b + 1
            self.b = -1
        else:
            self.wake()

    def process_pending_if_woken(self) -> None:
        """Handle pending events before a wait inside a statement.

        After the wait begins, no further wake-up would follow.
        """
        if self.b < 0:
            self.poll(self.b)
