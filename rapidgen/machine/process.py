"""Processes: greenlets that share the CPU of a scheduler and are charged for what they do."""

from collections.abc import Callable
from types import FrameType

import greenlet

from rapidgen.machine.scheduler import Scheduler


class Process:
    """A greenlet that is charged for what it does. RAPID tasks are processes.

    What it is launched with runs in the greenlet `body`; `process_pending()` is called at every
    poll and after every wait and is where a task serves traps and stops.
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
        """Start a function in a fresh greenlet at the next turn."""
        self.body = greenlet.greenlet(function)
        self._blocked = False
        self.scheduler.ready.append(self)

    def abandon(self) -> None:
        """End the greenlet where it is; nothing wakes it any more. It can be launched again."""
        self._blocked = False
        self.body = None

    @property
    def alive(self) -> bool:
        """Whether it has been launched and has not returned."""
        return self.body is not None and not self.body.dead

    @property
    def frame(self) -> FrameType | None:
        """Innermost Python frame of a suspended process, for call stacks."""
        result: FrameType | None = self.body.gr_frame if self.body is not None else None
        return result

    def wake(self) -> None:
        """Make a blocked process ready; it looks at the reason itself."""
        if self._blocked:
            self._blocked = False
            self.scheduler.ready.append(self)

    def process_pending(self) -> None:
        """Hook: called in the process after every poll and every wait."""

    # -- inside the process ----------------------------------------------------------------------

    def block(self) -> None:
        """Give the CPU away until somebody calls `wake()`; then `process_pending()`."""
        self._blocked = True
        self.scheduler.suspend(self)
        self.process_pending()

    def poll(self, b: int) -> int:
        """Account for a spent budget, let the world go on, return the next budget."""
        self.b = b
        scheduler = self.scheduler
        if scheduler.catch_up(self):
            scheduler.suspend(self)
        else:
            scheduler.grant(self)
        self.process_pending()
        return self.b

    def yield_cpu(self) -> None:
        """Go to the end of the queue when others are ready; then `process_pending()`."""
        self.switch()
        self.process_pending()

    def switch(self) -> None:
        """Go to the end of the queue when others are ready, in the middle of a statement."""
        scheduler = self.scheduler
        self._kicked = False
        if scheduler.catch_up(self):
            scheduler.suspend(self)
        elif scheduler.ready:
            scheduler.ready.append(self)
            scheduler.suspend(self)
        else:
            scheduler.grant(self)
        if self._kicked:  # nothing has attended to what came meanwhile
            self.wake_at_next_statement()

    def charge(self, cost: int) -> None:
        """Spend `cost` nanoseconds of CPU."""
        self.b -= cost
        if self.b < 0:
            self.poll(self.b)

    def wake_at_next_statement(self) -> None:
        """Let `process_pending()` be called before the next statement, or in the wait."""
        scheduler = self.scheduler
        self._kicked = True
        if scheduler.running is self:
            scheduler.deadline -= self.b + 1
            self.b = -1
        else:
            self.wake()

    def process_pending_if_woken(self) -> None:
        """Before a wait that begins in the middle of a statement: nobody would kick again."""
        if self.b < 0:
            self.poll(self.b)
