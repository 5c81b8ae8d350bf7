"""How a task runs its program: start, cycles, stop, PP to main, event routines, faults."""

import sys
from collections.abc import Callable
from typing import Any, Literal

from rapidgen.system.model import TaskSpec
from rapidgen.virtual.compiler.program import Program, Shared
from rapidgen.virtual.errors import (
    RECOVERABLE,
    EndOfRun,
    ExitCycle,
    FatalError,
)
from rapidgen.virtual.kernel import Kernel
from rapidgen.virtual.recovery import DEEPEST
from rapidgen.virtual.task import Task

State = Literal["ready", "running", "stopped", "finished", "error", "empty"]


class RapidTask(Task):
    """A task of the controller.

    `state`: `ready` PP stands at main · `running` · `stopped` goes on when it is started ·
    `finished` main returned, EXIT, or the cycle ended · `error` a fault stopped it; it starts
    again from main only · `empty` there is no entry routine.
    """

    def __init__(
        self,
        kernel: Kernel,
        spec: TaskSpec,
        controller: Any,  # noqa: ANN401 - VirtualController; importing it would be a cycle
        shared: Shared,
    ) -> None:
        super().__init__(kernel, spec.name, controller)
        # Polls find RAPID's stack overflow (DEEPEST); Python's own limit would strike anywhere,
        # also in the middle of the kernel's work.
        sys.setrecursionlimit(max(sys.getrecursionlimit(), 4 * DEEPEST))
        self.spec = spec
        self.program = Program(self, shared, controller.options)
        self.state: State = "empty"
        self.cycles = 0
        self.fault: FatalError | None = None
        self._fresh = True
        """PP was set to main: variables are to be initialised."""
        self._events: list[str] = []

    # -- from outside ----------------------------------------------------------------------------

    def start(self) -> None:
        """Start from where the task stopped, or from main."""
        if self.state == "stopped":
            self._events.append("RESTART")
            self._set("running")
            self.release()
        elif self.state in ("ready", "finished"):
            self._events.append("START")
            self._set("running")
            self.launch(self._body)

    def stop(self) -> None:
        """Stop before the next statement or in the wait; `start()` goes on there."""
        if self.state == "running":
            self._set("stopped")
            self.hold()

    def pp_to_main(self) -> None:
        """Leave everything (UNDO handlers run) and set PP to main."""
        self._fresh = True
        self._events.append("RESET")
        if self.state in ("running", "stopped") and self.alive:
            self.order(EndOfRun())
            self.held = False
        elif self.state != "empty":
            self._set("ready")

    def due(self, event: str) -> None:
        """An event routine is to run before the program goes on."""
        self._events.append(event)

    @property
    def leaving(self) -> bool:
        """Whether PP was set to main and the routines are still being left."""
        return self._fresh and self.state in ("running", "stopped")

    # -- the run ---------------------------------------------------------------------------------

    def _set(self, state: State) -> None:
        self.state = state
        self.controller.task_changed(self)

    def _body(self) -> None:
        """The greenlet of one run."""
        again = True
        while again:
            if self._fresh:
                self._fresh = False
                self._initialise()
            again = self._cycle()

    def _initialise(self) -> None:
        """PP to main: variables, interrupts, ERRNO, sockets and files [S4 overview 4-24]."""
        self.program.reset_variables()
        self.interrupts.clear()
        self.errno = self.intno = 0
        self.controller.reset_task(self)

    def _cycle(self) -> bool:
        """One pass of the entry routine; whether another one follows at once."""
        try:
            self.charge(self.controller.costs.statement)
            self._run_events()
            entry = self.program.globals.get(self.spec.entry.lower())
            self.program.function(entry)()  # type: ignore[arg-type]
        except ExitCycle:
            pass
        except EndOfRun:
            self._set("ready" if self._fresh else "finished")
            return False
        except FatalError as fatal:
            self._fail(fatal, fatal)
            return False
        except RECOVERABLE as error:
            self._fail(self.unhandled(error), error)
            return False
        except RecursionError as error:
            self._fail(FatalError(40027, "Stack overflow"), error)
            return False
        self.cycles += 1
        if self.controller.dialect.cycle_resets_interrupts:
            self.interrupts.clear()
        if self.controller.cycle == "forever":
            return True
        self._set("finished")
        return False

    def _fail(self, fatal: FatalError, raised: BaseException) -> None:
        if not fatal.stack:
            fatal.stack = self.stack_of(raised.__traceback__)
        self.fault = fatal
        self.interrupts.clear()
        self.controller.task_failed(self, fatal)
        self._set("error")

    def _run_events(self) -> None:
        while self._events:
            event = self._events.pop(0)
            for routine in self.controller.event_routines(self, event):
                found = self.program.find_routine(None, routine.lower())
                if found is not None and found.node is not None:
                    self.controller.event_under_way[self.name] = event
                    try:
                        self.program.function(found)()
                    finally:
                        self.controller.event_under_way.pop(self.name, None)

    def _park(self) -> None:
        super()._park()
        if not self.held and "RESTART" in self._events:
            self._run_events()

    def stop_here(self) -> None:
        """Stop, Break: the program stops; a start goes on behind the instruction."""
        self._set("stopped")
        self.controller.program_stopped(self)
        super().stop_here()

    def call(self, name: str, *arguments: Any) -> Any:  # noqa: ANN401
        """Call a routine of the task's program, from the task's own greenlet."""
        routine = self.program.find_routine(None, name.lower())
        if routine is None or routine.node is None:
            raise KeyError(name)
        function: Callable[..., Any] = self.program.function(routine)
        return function(*arguments)
