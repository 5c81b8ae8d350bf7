"""Event routines and service routines: what a task executes because of a start, a stop, a reset.

They run at user level: interrupts wait, and errors are nobody's but their own.
"""

from collections.abc import Callable, Iterator
from typing import Literal, TypeAlias

from rapidgen.runtime.compiler.symbols import Routine
from rapidgen.runtime.errors import EventStopped
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.task.errors import Errors

EventName: TypeAlias = Literal["POWER_ON", "START", "STOP", "QSTOP", "RESTART", "RESET", "STEP"]
StopEvent: TypeAlias = Literal["STOP", "QSTOP", ""]
"""Which routines a stop brings."""
WHILE_STOPPED: frozenset[EventName] = frozenset({"STOP", "QSTOP", "POWER_ON"})
"""Their routines run at once, in a task that stands."""
AT_RESTART: frozenset[EventName] = frozenset({"RESTART", "STEP"})


class EventRoutines:
    """Which routines of one task are due, and their execution."""

    def __init__(self, task: RapidTask, errors: Errors) -> None:
        self._task = task
        self._errors = errors
        self.due: list[EventName] = []
        """Events whose routines are to be executed, in order."""
        self.service: list[Routine] = []
        """Service routines that are to be executed while the program stands."""
        self.running: EventName | Literal["SERVICE", ""] = ""
        """Event whose routine is being executed."""
        self.while_stopped = False
        """Executing what a stop or the power-up brought, while the program stands."""

    def names(self, event: EventName) -> Iterator[str]:
        """Names of the routines of an event (CAB_EXEC_HOOKS), lower -SeqNo first."""
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
        """Run the routines of the events that are due, of `which` only."""
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
        """Whether something is to be executed now, although the program stands."""
        due = bool(self.service) or any(e in WHILE_STOPPED for e in self.due)
        return due and not self.while_stopped

    def run_while_stopped(self) -> None:
        """Execute what a stop brought, and service routines."""
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
