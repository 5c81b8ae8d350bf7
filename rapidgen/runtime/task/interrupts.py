"""Interrupts of one task: numbers, orders, the queue, and when a trap runs [K §8].

An event is noticed at once and its trap starts a while later, at the next statement or inside
a wait. While a trap runs, or between IDisable and IEnable, events queue, first in first out.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field

from rapidgen.machine.event_log import Event
from rapidgen.runtime.compiler.symbols import Routine
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.task.errors import Errors
from rapidgen.runtime.task.process_errors import ProcessError

LARGEST_QUEUE = 30
"""Queued interrupts of a task; one more stops it [S4 datasys 1-intnum-2]."""
LARGEST_NUMBER = 100
"""Connected interrupts of a task, then ERR_INOMAX (switch `interrupts_limited`)."""


@dataclass(slots=True, eq=False)
class Interrupt:
    """One connected intnum."""

    number: int
    trap: Routine
    cancel: list[Callable[[], None]] = field(default_factory=list)
    """Takes back what was ordered."""
    ordered: bool = False
    asleep: bool = False
    single: bool = False
    safe: bool = False


class Interrupts:
    """Numbers, orders and queue of one task."""

    def __init__(self, task: RapidTask, errors: Errors) -> None:
        self._task = task
        self._errors = errors
        self.connected: dict[int, Interrupt] = {}
        self.queue: deque[tuple[Interrupt, Event | None]] = deque()
        """Events whose delay has passed."""
        self.disabled = False
        self.process_error: ProcessError | None = None
        """What ProcerrRecovery ordered, until it is raised."""
        self.trap_data: Event | None = None
        """What the trap that is being executed is about (GetTrapData)."""
        self._underway = 0
        self._next = 1
        self._last_due = 0

    # -- connecting and ordering -----------------------------------------------------------------

    def connect(self, current: float, trap: Routine) -> int:
        """CONNECT: a fresh number; ERR_ALRDYCNT while `current` is connected [K §4.12]."""
        if current in self.connected:
            raise RapidError("ERR_ALRDYCNT")
        limited = self._task.controller.dialect.interrupts_limited
        if limited and len(self.connected) >= LARGEST_NUMBER:
            raise RapidError("ERR_INOMAX")
        number = self._next
        self._next += 1
        self.connected[number] = Interrupt(number, trap)
        return number

    def find(self, number: float) -> Interrupt:
        """A connected interrupt; ERR_UNKINO."""
        match = self.connected.get(int(number))
        if match is None:
            raise RapidError("ERR_UNKINO")
        return match

    def order(self, number: float, *, single: bool, safe: bool) -> Interrupt:
        """Begin an order. A second one without IDelete is not allowed [S4 datasys 2-ISignalDI]."""
        interrupt = self.connected.get(int(number))
        if interrupt is None:
            raise RapidError("ERR_UNKINO")
        if interrupt.ordered:
            raise FatalError(
                40214, "Interrupt is already ordered", "delete it before it is ordered again"
            )
        interrupt.ordered = True
        interrupt.asleep = False
        interrupt.single = single or safe
        interrupt.safe = safe
        return interrupt

    def delete(self, number: float) -> None:
        """IDelete: orders, queued events and the connection go."""
        interrupt = self.connected.pop(int(number), None)
        if interrupt is None:
            return
        for cancel in interrupt.cancel:
            cancel()
        interrupt.cancel.clear()
        interrupt.ordered = False
        self.queue = deque(e for e in self.queue if e[0] is not interrupt)

    def clear(self) -> None:
        """Delete everything: PP to main, new program [K §8.2]."""
        for number in list(self.connected):
            self.delete(number)
        self.queue.clear()
        self.disabled = False
        self.process_error = None

    # -- events ----------------------------------------------------------------------------------

    def happen(self, interrupt: Interrupt, data: Event | None = None) -> None:
        """The event of an interrupt has come."""
        task = self._task
        if interrupt.asleep or self.connected.get(interrupt.number) is not interrupt:
            return
        if task.is_stopped and not interrupt.safe:
            return  # lost while the program is stopped [S4 overview 4-39]
        if interrupt.single:
            for cancel in interrupt.cancel:
                cancel()
            interrupt.cancel.clear()
            interrupt.ordered = False
        scheduler = task.scheduler
        low, high = task.controller.costs.interrupt_delay
        now = scheduler.now
        due = max(now + scheduler.rng.randint(low, high), self._last_due)
        self._last_due = due
        self._underway += 1

        def arrive() -> None:
            self._underway -= 1
            if self.connected.get(interrupt.number) is interrupt:
                self.queue.append((interrupt, data))
                task.wake_at_next_statement()

        if due <= now:
            arrive()
        else:
            scheduler.at(due, arrive)
        if len(self.queue) + self._underway > LARGEST_QUEUE:
            task.order(FatalError(40223, "Too many interrupts wait", f"{LARGEST_QUEUE} are queued"))

    def serve(self) -> None:
        """Execute the traps of what has come."""
        task = self._task
        while self.queue and not self.disabled:
            interrupt, self.trap_data = self.queue.popleft()
            task.in_trap = True
            task.intno = interrupt.number
            try:
                self._errors.at_level(task.program.function(interrupt.trap))
            finally:
                task.in_trap = False
                self.trap_data = None
