"""How a task runs its program: start, cycles, stop, PP to main, event routines, faults."""

import sys
from collections.abc import Callable
from typing import Any, Literal

from rapidgen.machine.scheduler import Scheduler
from rapidgen.runtime.compiler.context import CannotCompile
from rapidgen.runtime.compiler.linking import Shared
from rapidgen.runtime.compiler.program import Program
from rapidgen.runtime.compiler.resume import Standing
from rapidgen.runtime.compiler.symbols import Routine
from rapidgen.runtime.errors import (
    RECOVERABLE,
    EndOfRun,
    EventStopped,
    ExitCycle,
    FatalError,
    PointerMoved,
)
from rapidgen.runtime.task.driving_back import StepHistory
from rapidgen.runtime.task.recovery import DEEPEST
from rapidgen.runtime.task.stepping import CannotStep, Step, Stepping
from rapidgen.system.model import TaskSpec

State = Literal["ready", "running", "stopped", "finished", "error", "empty"]
Event = Literal["POWER_ON", "START", "STOP", "QSTOP", "RESTART", "RESET", "STEP"]
_WHILE_STOPPED: frozenset[Event] = frozenset({"STOP", "QSTOP", "POWER_ON"})
"""Their routines run at once, in a task that stands."""
_AT_RESTART: frozenset[Event] = frozenset({"RESTART", "STEP"})


class RapidTask(Stepping):
    """A task of the controller.

    `state`: `ready` PP stands at main · `running` · `stopped` goes on when it is started ·
    `finished` main returned, EXIT, or the cycle ended · `error` a fault stopped it; a start tries
    the faulty statement again, where `place` is known · `empty` there is no entry routine.
    """

    def __init__(
        self,
        scheduler: Scheduler,
        spec: TaskSpec,
        controller: Any,  # noqa: ANN401 - VirtualController; importing it would be a cycle
        shared: Shared,
    ) -> None:
        super().__init__(scheduler, spec.name, controller)
        # Polls find RAPID's stack overflow (DEEPEST); Python's own limit would strike anywhere,
        # also in the middle of the scheduler's work.
        sys.setrecursionlimit(max(sys.getrecursionlimit(), 4 * DEEPEST))
        self.spec = spec
        self.program = Program(self, shared, controller.options)
        self.state: State = "empty"
        self.cycles = 0
        self.fault: FatalError | None = None
        self._fresh = True
        """PP was set to main: variables are to be initialised."""
        self._routine: Routine | None = None
        """Where PP was set instead of main."""
        self._service: list[Routine] = []
        """Service routines that are to be executed while the program stands."""
        self._backward = False
        """The step under way goes back."""
        self._at_point = -1
        """Depth of the statement before which a step has ended; -1 elsewhere."""
        self._start_asked = False
        """A start came while routines were still being left for PP to main."""
        self._events: list[Event] = []
        """Whose routines are due, in order."""

    # -- from outside ----------------------------------------------------------------------------

    def power_up(self) -> None:
        """The routines of POWER_ON run, whether or not the program is started afterwards."""
        self._events.insert(0, "POWER_ON")
        if self.state == "stopped":
            self.wake()
        elif self.state in ("ready", "finished") and self._has_routines("POWER_ON"):
            self.launch(self._body)

    def start(self) -> None:
        """Start from where the task stopped, or from main."""
        self._forget_steps()
        if self.leaving:
            self._start_asked = True
        elif self.state == "stopped":
            self._events.append("RESTART")
            self._set("running")
            if self.place is not None:
                # A program that is still being left goes on by itself.
                if not self.alive:
                    self.launch(self._body)
            elif not self._stop_routines_due:
                self.release()
        elif self.state in ("ready", "finished"):
            self.fault = None
            self._events.append("START" if self._routine is None else "RESTART")
            self._set("running")
            if not self.alive:
                self.launch(self._body)
        elif self.state == "error" and self.place is not None:
            self.fault = None
            self._events.append("RESTART")
            self._set("running")
            if not self.alive:
                self.launch(self._body)

    def stop(self, event: Literal["STOP", "QSTOP", ""] = "STOP") -> None:
        """Stop before the next statement or in the wait; `start()` goes on there.

        The routines of `event` run when the task stands.
        """
        self._start_asked = False
        if self.state == "running":
            self._set("stopped")
            if event:
                self._events.append(event)
            self.hold()

    def step(self, *, back: bool = False, over: bool = False) -> None:
        """Execute one statement. CannotStep: not from here; nothing has changed then."""
        if self.state in ("ready", "finished") and not back:
            self._begin_step(over)
            if not self.alive:
                self.launch(self._body)
            return
        if self.state not in ("stopped", "error") or self.leaving or self.while_stopped:
            raise CannotStep(f"the task is {self.state}")
        if self.state == "error" and self.place is None:
            raise CannotStep("the program pointer is lost: PP to main first")
        if self._at_point >= 0 and not back:
            self._begin_step(over, self._at_point)
            self.release()
            return
        self.place = self.where_it_stands()
        self._backward = back
        self._begin_step(over)
        if self.alive:
            self.order(PointerMoved())
            self.held = False
        else:
            self.launch(self._body)

    def _begin_step(self, over: bool, depth: int = -1) -> None:
        motion = self.controller.motion
        if self.history is None and motion.is_motion_task(self.name):
            self.history = StepHistory(motion.of_task(self.name))
        if self.history is not None and not self._backward:
            self.history.begin()
        self.program.trace_from_now()
        self.fault = None
        self._events.append("STEP")
        self._set("running")
        self.step_under_way = Step(over, depth)

    def step_ends(self) -> None:
        """Stand before the statement that was reached; the robot stands, too."""
        assert self.step_under_way is not None
        motion = self.controller.motion
        if motion.is_motion_task(self.name):
            motion.of_task(self.name).wait_standing(self)
        if self.history is not None:
            self.history.end()
        self._at_point = self.step_under_way.depth_now
        self._set("stopped")
        self.controller.step_ended(self)
        try:
            super().stop_here()
        finally:
            self._at_point = -1

    def hold(self) -> None:
        """Stop before the next statement, or in the wait; not in what runs because of a stop."""
        super().hold()
        if self.while_stopped:
            self.held = False

    def pp_to_main(self) -> None:
        """Leave everything (UNDO handlers run) and set PP to main."""
        self._leave(None)

    def pp_to_routine(self, name: str) -> None:
        """Set PP to a procedure without parameters: as main, but RESET routines do not run."""
        self._leave(self._procedure(name))

    def pp_to_statement(self, line: int) -> None:
        """Set PP to a statement of the routine in which the program stands (PP to cursor).

        CannotStep: there is none, or the program cannot go on there.
        """
        if self.state not in ("stopped", "error"):
            raise CannotStep(f"the task is {self.state}")
        self.place = self.standing_at(line)
        self._forget_steps()
        if self.alive:
            self.order(PointerMoved())
            self.held = False
        self._set("stopped")

    def call_service(self, name: str) -> None:
        """Execute a procedure without parameters at user level, while the program stands."""
        if self.state == "running" or self.leaving:
            raise CannotStep(f"the task is {self.state}")
        self._service.append(self._procedure(name))
        if not self.alive:
            self.launch(self._body)
        else:
            self.wake()

    def _procedure(self, name: str) -> Routine:
        found = self.program.find_routine(None, name.lower())
        if found is None or found.node is None or found.kind != "PROC" or found.parameters:
            raise CannotStep(f"{self.name} has no procedure {name} without parameters")
        return found

    def _forget_steps(self) -> None:
        """Moves that were stepped are not driven back any more."""
        if self.history is not None:
            self.history.forget()

    def _leave(self, routine: Routine | None) -> None:
        self._forget_steps()
        self._routine = routine
        self._fresh = True
        self._start_asked = False
        self._events = [e for e in self._events if e == "POWER_ON"]
        if routine is None:
            self._events.append("RESET")
        if self.state in ("running", "stopped") and self.alive:
            self.order(EndOfRun())
            self.held = False
        elif self.state != "empty":
            kept = self.place is not None
            self.place = None
            self._set("ready")
            if kept and not self.alive:
                self.launch(self._body)

    @property
    def keeps_place(self) -> bool:
        """Whether a start after an error tries the faulty statement again."""
        return self.controller.dialect.after_error == "statement" and self.spec.type == "NORMAL"

    @property
    def stands(self) -> bool:
        """Whether the program is stopped, even if something runs because of that."""
        return super().stands or self.state == "error" or self.stepping

    @property
    def leaving(self) -> bool:
        """Whether PP was set to main and the routines are still being left."""
        return self._fresh and self.state in ("running", "stopped")

    # -- the run ---------------------------------------------------------------------------------

    def _set(self, state: State) -> None:
        self.state = state
        if state != "running":
            self.step_under_way = None
        self.controller.task_changed(self)

    def _body(self) -> None:
        """The greenlet of one run."""
        step = self._begin if self.place is None else self._again
        if self._service and self.state != "running":
            step = self._serve
        # Whoever hears of a state may start the task again at once.
        while self._guarded(step) or self.state == "running":
            step = self._cycle if self.place is None else self._again

    def _serve(self) -> bool:
        """Service routines of a program of which nothing is being executed."""
        self._stop_routines()
        return False

    def _begin(self) -> bool:
        """What is due without a start: UNDO after PP to main, routines of POWER_ON."""
        # PP to main may have come before the first statement.
        self._obey()
        self.leave_place()
        self._prepare()
        self._run_events(_WHILE_STOPPED)
        return self.state in ("running", "stopped")

    def _prepare(self) -> None:
        """After PP to main: variables, interrupts, ERRNO, sockets and files [S4 overview 4-24]."""
        if not self._fresh:
            return
        self._fresh = False
        self.program.reset_variables()
        self.interrupts.clear()
        self.errno = self.intno = 0
        self.controller.reset_task(self, settings=self._routine is None)

    def _cycle(self) -> bool:
        """One pass of the entry routine; whether another one follows at once."""
        self.undo_failed = False
        self._prepare()
        self.attend()
        self.charge(self.controller.costs.statement)
        self._run_events()
        entry = self._routine or self.program.find_routine(None, self.spec.entry.lower())
        self.program.function(entry)()  # type: ignore[arg-type]
        return self._next_cycle()

    def _again(self) -> bool:
        """Go on where an error stopped the program."""
        self.undo_failed = False
        self.attend()
        places, self.place = self.place, None
        assert places is not None
        self.charge(self.controller.costs.statement)
        self._run_events()
        if self._backward:
            return self._back(places)
        try:
            self.go_on(places)
        except CannotCompile as error:
            raise FatalError(
                40_001, "Program pointer is lost", f"{error}: PP to main", restartable=False
            ) from error
        return self._next_cycle()

    def _back(self, places: list[Standing]) -> bool:
        """Execute the statement before backward; the program then stands before it."""
        self._backward = False
        self.step_under_way = None
        self.stepping_back = True
        try:
            self.place = self.step_back(places)
        except CannotStep as reason:
            self.place = places
            self.controller.log.warning(
                40_700, "Backward step is not possible", str(reason), task=self.name
            )
        except FatalError as fatal:
            self._fail(fatal, fatal)
            self.place = places
            return False
        finally:
            self.stepping_back = False
        self._set("stopped")
        self.controller.step_ended(self)
        return False

    def _guarded(self, step: Callable[[], bool]) -> bool:
        """Do a step of the run and deal with every way out of it; whether the run goes on."""
        try:
            return step()
        except ExitCycle:
            return self._next_cycle()
        except EndOfRun:
            return self._over()
        except PointerMoved:
            return self.state == "running"
        except FatalError as fatal:
            self._fail(fatal, fatal)
        except RECOVERABLE as error:
            self._fail(self.unhandled(error), error)
        except RecursionError as error:
            self._fail(FatalError(40027, "Stack overflow"), error)
        return False

    def _next_cycle(self) -> bool:
        self.cycles += 1
        if self.controller.dialect.cycle_resets_interrupts:
            self.interrupts.clear()
        if self.controller.cycle == "forever" and self._routine is None:
            return True
        self._routine = None
        self._set("finished")
        return False

    def _over(self) -> bool:
        """EXIT, or everything was left for PP to main: then a start may have come meanwhile."""
        if not self._fresh:
            self._set("finished")
        elif self._start_asked:
            self._start_asked = False
            self._events.append("START")
            self._set("running")
            return True
        else:
            self._set("ready")
        return False

    def _fail(self, fatal: FatalError, raised: BaseException) -> None:
        if not fatal.stack:
            fatal.stack = self.stack_of(raised.__traceback__)
        self.fault = fatal
        self.keep_place(fatal, raised)
        if self.place is None:
            self.interrupts.clear()
        self.controller.task_failed(self, fatal)
        self._set("error")
        if self.controller.dialect.fault_routines and not self.while_stopped:
            self._events.append("STOP")
            self._guarded(self._after_fault)

    def _after_fault(self) -> bool:
        """STOP routines of a task that an error stopped (dialect)."""
        self._stop_routines()
        return False

    # -- event routines --------------------------------------------------------------------------

    def _has_routines(self, event: Event) -> bool:
        return any(self.controller.event_routines(self, event))

    def _run_events(self, which: frozenset[Event] | None = None) -> None:
        """Run the routines of the events that are due, of `which` only."""
        while due := [e for e in self._events if which is None or e in which]:
            self._events.remove(due[0])
            for routine in self.controller.event_routines(self, due[0]):
                found = self.program.find_routine(None, routine.lower())
                if found is not None and found.node is not None:
                    self._run_event(due[0], self.program.function(found))

    def _run_event(self, event: Event | Literal["SERVICE"], routine: Callable[..., Any]) -> None:
        """Execute a routine at user level: interrupts wait, errors are nobody's but its own."""
        outer, self.event = self.event, event
        try:
            self.at_level(routine)
        except EventStopped:
            pass
        finally:
            self.event = outer
        if not outer:
            self.attend()

    def _park(self) -> None:
        if self._stop_routines_due:
            self._stop_routines()
        else:
            super()._park()
        if not self.held:
            self._run_events(_AT_RESTART)

    @property
    def _stop_routines_due(self) -> bool:
        due = bool(self._service) or any(e in _WHILE_STOPPED for e in self._events)
        return due and not self.while_stopped

    def _stop_routines(self) -> None:
        self.while_stopped = True
        self.held = False
        try:
            self._run_events(_WHILE_STOPPED)
            while self._service:
                self._run_event("SERVICE", self.program.function(self._service.pop(0)))
        finally:
            self.while_stopped = False
            self.held = self.state == "stopped" and not self.leaving

    def stop_here(self) -> None:
        """Stop, Break: the program stops; a start goes on behind the instruction.

        In an event routine it ends the routine, which runs from its beginning at the next event
        [S4 2-Stop-1]. Whether the STOP routines run then is a switch.
        """
        self._set("stopped")
        self.controller.program_stopped(self)
        if self.event:
            if self.controller.dialect.event_stops and self.event != "STOP":
                self._events.append("STOP")
            self.hold()
            raise EventStopped
        self._events.append("STOP")
        super().stop_here()

    def call(self, name: str, *arguments: Any) -> Any:  # noqa: ANN401
        """Call a routine of the task's program, from the task's own greenlet."""
        routine = self.program.find_routine(None, name.lower())
        if routine is None or routine.node is None:
            raise KeyError(name)
        function: Callable[..., Any] = self.program.function(routine)
        return function(*arguments)
