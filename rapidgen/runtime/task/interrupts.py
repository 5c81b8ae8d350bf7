"""Interrupts, event routines and process errors of a task."""

import sys
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from types import CodeType, FrameType
from typing import Literal, TypeAlias

from rapidgen.machine.event_log import Event
from rapidgen.runtime.compiler.symbols import Routine
from rapidgen.runtime.errors import EventStopped, FatalError, RapidError
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.registry import bound
from rapidgen.runtime.task.calls import outwards
from rapidgen.runtime.task.errors import Errors

# -- Process errors --------------------------------------------------------------------------------
#
# Errors that a trap raises in the routine that moves the robot: ProcerrRecovery [K §7.4].
#
# The error waits for the end of the trap. `\SyncLastMoveInst`: the current move instruction raises
# it, or else the next one. `\SyncOrgMoveInst`: the routine whose move made the current path raises
# it at once. Routines called from there are left, so that a RETRY calls them again (a controller
# continues inside them).


@dataclass(frozen=True, slots=True)
class ProcessError:
    """A pending error of ProcerrRecovery.

    `owner`: module and routine of the path's move, or "" for the last move instruction.
    """

    number: int
    owner: tuple[str, str] | None = None

    def due(self, task: RapidTask, outside: Sequence[CodeType]) -> RapidError | None:
        """Return the error if it is due, None otherwise.

        Between two statements, in functions that compiled code calls outside of them (`outside`),
        no handler would receive the error: it waits for the next statement.
        """
        frames, between = _frames(task, outside)
        error = RapidError(self.number)
        if self.owner is None:
            return error if not between and _at_move(task, frames) else None
        error.target = _frame_of(task, frames, self.owner)
        return None if between and error.target in (None, frames[0]) else error


def _frames(task: RapidTask, outside: Sequence[CodeType]) -> tuple[list[FrameType], bool]:
    """Return frames of RAPID routines, and True between statements.

    The innermost frame comes first; the flag concerns this frame.
    """
    result: list[FrameType] = []
    between = False
    called: CodeType | None = None
    for frame in outwards(sys._getframe(1)):
        if frame.f_code.co_filename in task.program.codes:
            between = between or (not result and any(called is code for code in outside))
            result.append(frame)
        called = frame.f_code
    return result, between


def _at_move(task: RapidTask, frames: list[FrameType]) -> bool:
    """Return True if the current statement is a move instruction."""
    for frame in frames[:1]:
        compiled = task.program.codes[frame.f_code.co_filename]
        if 0 <= frame.f_lineno < len(compiled.tokens):
            token = compiled.tokens[frame.f_lineno]
            builtin = bound(compiled.module.tree.source.tokens[token])
            return builtin is not None and builtin.cost == "move"
    return False


def _frame_of(task: RapidTask, frames: list[FrameType], owner: tuple[str, str]) -> FrameType | None:
    """Return the innermost frame with a handler outside the owner.

    The search starts at the owner's frame. None: the owner has ended.
    """
    inside = False
    for frame in frames:
        compiled = task.program.codes[frame.f_code.co_filename]
        inside = inside or (compiled.module.name, compiled.routine.name) == owner
        if inside and compiled.handled and not compiled.role(frame.f_code).is_handler:
            return frame
    return None


# -- Event routines --------------------------------------------------------------------------------
#
# Event routines and service routines: started by a start, a stop or a reset.
#
# They run at user level: interrupts wait, and only their own handlers receive errors.


EventName: TypeAlias = Literal["POWER_ON", "START", "STOP", "QSTOP", "RESTART", "RESET", "STEP"]
StopEvent: TypeAlias = Literal["STOP", "QSTOP", ""]
"""Which routines a stop brings."""
WHILE_STOPPED: frozenset[EventName] = frozenset({"STOP", "QSTOP", "POWER_ON"})
"""Events whose routines run at once in a stopped task."""
AT_RESTART: frozenset[EventName] = frozenset({"RESTART", "STEP"})


class EventRoutines:
    """Pending event routines of one task, and their execution."""

    def __init__(self, task: RapidTask, errors: Errors) -> None:
        self._task = task
        self._errors = errors
        self.due: list[EventName] = []
        """Events whose routines are pending, in order."""
        self.service: list[Routine] = []
        """Pending service routines, which run while the program is stopped."""
        self.running: EventName | Literal["SERVICE", ""] = ""
        """Event whose routine runs."""
        self.while_stopped = False
        """True while a routine of a stop or power-up runs in a stopped program."""

    def names(self, event: EventName) -> Iterator[str]:
        """Iterate over routine names of an event by -SeqNo (CAB_EXEC_HOOKS)."""
        task = self._task
        for entry in sorted(task.controller.system.events, key=lambda entry: entry.order):
            mine = (
                entry.all_tasks
                or entry.task.lower() == task.name.lower()
                or (entry.all_motion_tasks and task.spec.motion)
            )
            if mine and entry.event.upper().replace("_", "") == event.replace("_", ""):
                yield entry.routine

    def run(self, which: frozenset[EventName] | None = None) -> None:
        """Run pending routines, only of events in `which`."""
        program = self._task.program
        while due := [e for e in self.due if which is None or e in which]:
            self.due.remove(due[0])
            for name in self.names(due[0]):
                result = program.find_routine(None, name.lower())
                if result is not None and result.node is not None:
                    self.execute(due[0], program.function(result))

    def execute(self, event: EventName | Literal["SERVICE"], routine: Callable[[], object]) -> None:
        """Execute a routine at user level."""
        outer, self.running = self.running, event
        try:
            self._errors.at_level(routine)
        except EventStopped:
            pass
        finally:
            self.running = outer
        if not outer:
            self._task.process_pending()

    @property
    def due_while_stopped(self) -> bool:
        """True if a routine is pending while the program is stopped."""
        due = bool(self.service) or any(e in WHILE_STOPPED for e in self.due)
        return due and not self.while_stopped

    def run_while_stopped(self) -> None:
        """Execute routines of a stop, and service routines."""
        task = self._task
        self.while_stopped = True
        task.held = False
        try:
            self.run(WHILE_STOPPED)
            while self.service:
                self.execute("SERVICE", task.program.function(self.service.pop(0)))
        finally:
            self.while_stopped = False
            task.held = task.state == "stopped" and not task.leaving


# -- Interrupts ------------------------------------------------------------------------------------
#
# Interrupts of one task: numbers, orders, the queue, and when a trap runs [K §8].
#
# An event is noticed at once and its trap starts a while later, at the next statement or inside
# a wait. While a trap runs, or between IDisable and IEnable, events queue, first in first out.


LARGEST_QUEUE = 30
"""Queued interrupts of a task; one more stops it [S4 datasys 1-intnum-2]."""
LARGEST_NUMBER = 100
"""Connected interrupts of a task, then ERR_INOMAX (switch `interrupts_limited`)."""


@dataclass(slots=True, eq=False)
class Interrupt:
    """A connected intnum."""

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
        """Events after their delay."""
        self.disabled = False
        self.process_error: ProcessError | None = None
        """Pending error of ProcerrRecovery."""
        self.trap_data: Event | None = None
        """Event of the current trap (GetTrapData)."""
        self._underway = 0
        self._next = 1
        self._last_due = 0

    # -- connecting and ordering -----------------------------------------------------------------

    def connect(self, current: float, trap: Routine) -> int:
        """CONNECT: return a new number.

        ERR_ALRDYCNT: `current` is connected [K §4.12].
        """
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
        """Return a connected interrupt, or raise ERR_UNKINO."""
        match = self.connected.get(int(number))
        if match is None:
            raise RapidError("ERR_UNKINO")
        return match

    def order(self, number: float, *, single: bool, safe: bool) -> Interrupt:
        """Begin an order.

        A second one requires IDelete before [S4 datasys 2-ISignalDI].
        """
        interrupt = self.connected.get(int(number))
        if interrupt is None:
            raise RapidError("ERR_UNKINO")
        if interrupt.ordered:
            raise FatalError(
                194214, "Interrupt is already ordered", "delete it before it is ordered again"
            )
        interrupt.ordered = True
        interrupt.asleep = False
        interrupt.single = single or safe
        interrupt.safe = safe
        return interrupt

    def delete(self, number: float) -> None:
        """IDelete: remove orders, queued events and the connection."""
        interrupt = self.connected.pop(int(number), None)
        if interrupt is None:
            return
        for cancel in interrupt.cancel:
            cancel()
        interrupt.cancel.clear()
        interrupt.ordered = False
        self.queue = deque(e for e in self.queue if e[0] is not interrupt)

    def clear(self) -> None:
        """Delete all interrupts: PP to main, new program [K §8.2]."""
        for number in list(self.connected):
            self.delete(number)
        self.queue.clear()
        self.disabled = False
        self.process_error = None

    # -- events ----------------------------------------------------------------------------------

    def happen(self, interrupt: Interrupt, data: Event | None = None) -> None:
        """Record the event of an interrupt."""
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
            task.order(
                FatalError(194224, "Too many interrupts wait", f"{LARGEST_QUEUE} are queued")
            )

    def serve(self) -> None:
        """Execute the traps of queued events."""
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
