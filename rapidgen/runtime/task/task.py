"""One RAPID task: the process that runs its program.

The controller and users start, stop and step it. Compiled code and built-ins call its methods to
wait, to charge time and to reach the controller. The task owns its parts: errors, interrupts, the
program pointer, the stepper, event routines, and the run, which is its greenlet's body.

Rules of scheduling:

1. Exactly one greenlet executes at a time. A task gives up control only in `poll` (budget spent),
   in a wait, or at a stop; the code between two polls is atomic for other tasks.
2. Compiled code counts its budget in a local and calls `poll` only when it is negative. To make the
   task attend to a stop, a trap or an order, `wake_at_next_statement` sets the budget so that the
   next payment polls.
3. `process_pending` handles what is due in a fixed order: orders (EXIT, PP to main), stops, then
   traps. A stop before a trap matters: interrupts are lost or wait while the program is stopped [S4
   overview 4-39].
4. `_BETWEEN` and `_BEFORE` list the functions that compiled code calls outside of statements. A
   stack look-up treats a task inside them as between two statements.
"""

import sys
from collections.abc import Callable, Iterable, Iterator
from types import FrameType

from rapidgen.diagnostics import Span
from rapidgen.machine.process import Process
from rapidgen.machine.scheduler import Scheduler, Timer, WaitSet
from rapidgen.motion.fault_reasons import MotionFault
from rapidgen.runtime import unsupported
from rapidgen.runtime.compiler.link import Shared
from rapidgen.runtime.compiler.program import Program
from rapidgen.runtime.compiler.support import LateArgument
from rapidgen.runtime.compiler.symbols import CannotCompile, Data, LoadedModule, Routine
from rapidgen.runtime.errors import EndOfRun, EventStopped, FatalError, Location, PointerMoved
from rapidgen.runtime.host import Host, TaskState
from rapidgen.runtime.motion_interface import in_rapid
from rapidgen.runtime.registry import COSTS
from rapidgen.runtime.signals import CyclicBools
from rapidgen.runtime.task.calls import (
    between,
    late_arguments,
    late_routine,
    location,
    outwards,
    stack_at,
)
from rapidgen.runtime.task.errors import Errors
from rapidgen.runtime.task.interrupts import (
    AT_RESTART,
    EventRoutines,
    Interrupts,
    ProcessError,
    StopEvent,
)
from rapidgen.runtime.task.pointer import CannotStep, Pointer, standing
from rapidgen.runtime.task.run import Run
from rapidgen.runtime.task.stepping import Stepper
from rapidgen.runtime.values import Value
from rapidgen.system.model import TaskSpec

DEEPEST = 5_000
"""Python frames of a task; a deeper one is RAPID's stack overflow."""
_NS = 1_000_000_000


class Task(Process):
    """A task of a controller.

    `state`: `ready` PP is at main · `running` · `stopped` a start continues · `finished` main
    returned, EXIT, or the cycle ended · `error` a fault stopped it; a start executes the failed
    statement again if the pointer has a place · `empty` there is no entry routine.
    """

    __slots__ = ("__dict__",)

    def __init__(
        self, scheduler: Scheduler, spec: TaskSpec, controller: Host, shared: Shared
    ) -> None:
        super().__init__(scheduler, spec.name)
        # Polls detect RAPID's stack overflow (DEEPEST). Python's own limit could strike anywhere,
        # even inside the scheduler.
        sys.setrecursionlimit(max(sys.getrecursionlimit(), 4 * DEEPEST))
        self.spec = spec
        self.controller = controller
        self.state: TaskState = "empty"
        self.no_start = ""
        """Why the task has no program that could be started."""
        self.fault: FatalError | None = None
        self.cycles = 0
        """How often the program came to the end of its entry routine."""
        self.held = False
        """True after Stop, an emergency stop or the operator's stop, until the release."""
        self.in_trap = False
        self.errno = 0
        self.intno = 0
        self.ret: Value = None
        """Value of RETURN in a handler."""
        self.waits_for: Callable[[], str] | None = None
        """Text of the awaited condition; None without one, or for time only."""
        self.found: Iterator[tuple[LoadedModule | None, Data]] = iter(())
        """Results of SetDataSearch that GetNextSym has not returned yet."""
        self.searched_module = False
        """It began in a module, not above all of them."""
        self.cyclic = CyclicBools()
        self._order: BaseException | None = None
        self._holds = 0
        self._renews = False
        """True if the current routines are to continue in reporting code."""

        self.errors = errors = Errors(self)
        self.interrupts = Interrupts(self, errors)
        self.pointer = Pointer(self, errors)
        self.events = EventRoutines(self, errors)
        self.stepper = Stepper(self, errors, self.pointer, self.events)
        self.run = Run(self, errors, self.interrupts, self.pointer, self.stepper, self.events)
        # What compiled code calls: bound once, and without a frame of the task in between.
        self.handle = self.errors.handle
        self.undo = self.errors.undo
        self.throw = self.errors.throw
        self.instead = self.errors.instead
        self.connect = self.interrupts.connect
        self.go_on_below = self.pointer.go_on_below
        self.not_below = self.pointer.not_below
        self.program = Program(self, shared, controller.options)

    # -- from outside ----------------------------------------------------------------------------

    def power_up(self) -> None:
        """Run the POWER_ON routines, regardless of a later start."""
        self.events.due.insert(0, "POWER_ON")
        if self.state == "stopped":
            self.wake()
        elif self.state in ("ready", "finished") and any(self.events.names("POWER_ON")):
            self.launch(self.run.body)

    def start(self) -> None:
        """Start from the place of the stop, or from main."""
        self.stepper.forget()
        if self.leaving:
            self.run.start_asked = self._asked_to_start
        elif self.state == "stopped":
            self.events.due.append("RESTART")
            self.enter("running")
            if self.pointer.place is not None:
                # A program whose routines are still being left continues by itself.
                self._run()
            elif not self.events.due_while_stopped:
                self.release()
        elif self.state in ("ready", "finished"):
            self.fault = None
            self.events.due.append("START" if self.run.routine is None else "RESTART")
            self.enter("running")
            self._run()
        elif self.state == "error" and self.pointer.place is not None:
            self.fault = None
            self.events.due.append("RESTART")
            self.enter("running")
            self._run()

    def _asked_to_start(self) -> None:
        self.events.due.append("START")
        self.enter("running")

    def stop(self, event: StopEvent = "STOP") -> None:
        """Stop before the next statement or in the wait.

        `start()` continues there. The routines of `event` run at standstill.
        """
        self.run.start_asked = None
        if self.state == "running":
            self.enter("stopped")
            if event:
                self.events.due.append(event)
            self.hold()

    def step(self, *, back: bool = False, over: bool = False) -> None:
        """Execute one statement.

        CannotStep: not possible; the state is unchanged.
        """
        stepper = self.stepper
        if self.state in ("ready", "finished") and not back:
            stepper.begin(over)
            self._run()
            return
        if self.state == "running":
            raise CannotStep("the program runs: stop it first")
        if self.leaving and not back:
            self.run.start_asked = lambda: stepper.begin(over)
            return
        if self.state not in ("stopped", "error") or self.leaving:
            raise CannotStep(f"the task is {'at main' if self.leaving else self.state}")
        if self.events.while_stopped:
            raise CannotStep("the routines of STOP still run: let time pass")
        if self.state == "error" and self.pointer.place is None:
            raise CannotStep("the program pointer is lost: PP to main first")
        if stepper.at_point >= 0 and not back:
            stepper.begin(over, stepper.at_point)
            self.release()
            return
        if self.alive and self.pointer.place is None and not self.pointer.in_statement and not back:
            # Stopped before its first statement.
            stepper.begin(over)
            self.release()
            return
        self.pointer.place = self.pointer.stack()
        stepper.back_asked = back
        stepper.begin(over)
        if self.alive:
            self._leave_frames(PointerMoved())
        else:
            self.launch(self.run.body)

    def pp_to_main(self) -> None:
        """Leave all routines (UNDO handlers run) and set PP to main."""
        self._set_pointer(None)

    def pp_to_routine(self, name: str) -> None:
        """Set PP to a procedure without parameters.

        The effect is that of PP to main, without RESET routines.
        """
        self._set_pointer(self._procedure(name))

    def pp_to_statement(self, line: int) -> None:
        """Set PP to a statement of the current routine (PP to cursor).

        CannotStep: no such statement, or the program cannot continue there.
        """
        if self.state not in ("stopped", "error"):
            raise CannotStep(f"the task is {self.state}")
        self.pointer.move_to(line)
        self.stepper.forget()
        if self.alive:
            self._leave_frames(PointerMoved())
        self.enter("stopped")

    def call_service(self, name: str) -> None:
        """Execute a procedure without parameters in a stopped program.

        It runs at user level.
        """
        if self.state == "running" or self.leaving:
            raise CannotStep(f"the task is {self.state}")
        self.events.service.append(self._procedure(name))
        if not self.alive:
            self.launch(self.run.body)
        else:
            self.wake()

    def _run(self) -> None:
        if not self.alive:
            self.launch(self.run.body)

    def _procedure(self, name: str) -> Routine:
        result = self.program.find_routine(None, name.lower())
        if result is None or result.node is None or result.kind != "PROC" or result.parameters:
            raise CannotStep(f"{self.name} has no procedure {name} without parameters")
        return result

    def _set_pointer(self, routine: Routine | None) -> None:
        self.stepper.forget()
        run, events = self.run, self.events
        run.routine = routine
        run.fresh = True
        run.start_asked = None
        events.due = [e for e in events.due if e == "POWER_ON"]
        if routine is None:
            events.due.append("RESET")
        if self.state in ("running", "stopped") and self.alive:
            self._leave_frames(EndOfRun())
        elif self.state != "empty":
            saved = self.pointer.place is not None
            self.pointer.place = None
            self.enter("ready")
            if saved:
                self._run()

    def _leave_frames(self, order: BaseException) -> None:
        self.order(order)
        self.held = False

    def enter(self, state: TaskState) -> None:
        """Change the state and report it to the controller."""
        self.state = state
        if state != "running":
            self.stepper.forward = None
        self.controller.operation.task_changed()

    @property
    def is_stopped(self) -> bool:
        """True if the program is stopped, even while event routines run."""
        return self.held or self.events.while_stopped or self.state == "error" or self.stepping

    @property
    def stepping(self) -> bool:
        """True during a step."""
        return self.stepper.active

    @property
    def leaving(self) -> bool:
        """True while routines are left after PP to main."""
        return self.run.fresh and self.state in ("running", "stopped")

    def stack(self) -> tuple[Location, ...]:
        """Return the call stack, outermost routine first."""
        suspended = self.scheduler.running is not self
        return stack_at(self.program.codes, self.frame if suspended else sys._getframe(1))

    def place_of(self, file: str, line: int) -> Location | None:
        """Return the RAPID location of a Python line."""
        return location(self.program.codes, file, line)

    # -- waiting ---------------------------------------------------------------------------------

    def sleep(self, seconds: float) -> None:
        """Let virtual time pass; traps run meanwhile."""
        self.wait_for(_never, timeout=seconds)

    def wait_for(
        self,
        predicate: Callable[[], bool],
        *,
        on: Iterable[WaitSet] = (),
        timeout: float | None = None,
        why: Callable[[], str] | None = None,
    ) -> bool:
        """Wait until `predicate()` is true.

        It is evaluated now and after each change of a member of `on`. Returns False after `timeout`
        seconds. Traps run meanwhile. After a program stop the timeout starts again [S4 overview
        5-23]. `why` describes the condition on demand.
        """
        scheduler = self.scheduler
        changed = expired = False

        def notice() -> None:
            # The evaluation itself may give control to a task that changes the value just read.
            nonlocal changed
            changed = True
            self.wake()

        def expire() -> None:
            nonlocal expired
            expired = True
            self.wake()

        timer: Timer | None = None
        watched = tuple(on)
        for wait_set in watched:
            wait_set.add(notice)
        before = self.waits_for
        try:
            if predicate():
                return True
            self.process_pending_if_woken()
            delay = None if timeout is None else round(timeout * _NS)
            timer = None if delay is None else scheduler.after(delay, expire)
            holds = self._holds
            if why is not None:
                self.waits_for = why
            while True:
                self.process_pending_if_woken()
                if not changed:
                    self.block()
                changed = False
                if holds != self._holds:
                    holds, expired = self._holds, False
                    if timer is not None and delay is not None:
                        timer.cancel()
                        timer = scheduler.after(delay, expire)
                if predicate():
                    return True
                if expired:
                    return False
        finally:
            self.waits_for = before
            if timer is not None:
                timer.cancel()
            for wait_set in watched:
                wait_set.remove(notice)

    # -- attention: stops, orders, traps ---------------------------------------------------------

    def process_pending(self) -> None:
        """Handle pending events between two statements or inside a wait."""
        if self._order is not None:
            self.obey()
        while self.held:
            self._park()
        if self.events.due and not (self.events.running or self.events.while_stopped):
            # A stop without routines that ended before the task stopped.
            self.events.run(AT_RESTART)
        if self._renews:
            self._renew()
        interrupts = self.interrupts
        if interrupts.queue and not self.in_trap and not self.events.running:
            interrupts.serve()
        if interrupts.process_error is not None:
            self.raise_process_error(interrupts.process_error)

    def raise_process_error(self, error: ProcessError) -> None:
        """Raise a ProcerrRecovery error, or retry at the next statement."""
        if self.in_trap or self.events.running:
            return
        due = error.due(self, _BETWEEN)
        if due is None:
            self.wake_at_next_statement()
            return
        self.interrupts.process_error = None
        raise due

    def order(self, order: BaseException) -> None:
        """Raise `order` in the current code."""
        self._order = order
        self.wake_at_next_statement()

    def obey(self) -> None:
        """Raise a pending order."""
        order, self._order = self._order, None
        if order is not None:
            raise order

    def hold(self) -> None:
        """Stop before the next statement or in the wait.

        Routines that run because of a stop continue.
        """
        self.held = not self.events.while_stopped
        self._holds += 1
        self.wake_at_next_statement()

    def report_statements(self) -> str:
        """Report every statement from now on, also of current routines.

        The routines continue in other code between two statements, which costs the time of one
        statement. Returns why the innermost one cannot continue until it is called again, ""
        otherwise.
        """
        program = self.program
        program.trace_from_now()
        if self.pointer.place is not None or not self.pointer.in_statement:
            return ""
        if all(program.codes[f.f_code.co_filename].traced for f in self._frames()):
            return ""
        try:
            for i, place in enumerate(reversed(self.pointer.stack())):
                program.rest(place, calls=i > 0)
        except (CannotStep, CannotCompile) as reason:
            return str(reason)
        self._renews = True
        self.wake_at_next_statement()
        return ""

    def _frames(self) -> Iterator[FrameType]:
        codes = self.program.codes
        yield from (f for f in outwards(self.frame) if f.f_code.co_filename in codes)

    def _renew(self) -> None:
        """Leave the current code between two statements, for reporting code."""
        codes, current = self.program.codes, sys._getframe(1)
        if self.in_trap or self.events.running or not between(codes, current, _BEFORE):
            self.wake_at_next_statement()
            return
        self._renews = False
        frames = [(frame, frame.f_lineno) for frame in outwards(current)]
        self.pointer.place = standing(self.program, reversed(frames))
        if self.pointer.place is not None:
            raise PointerMoved

    def release(self) -> None:
        """Continue."""
        self.held = False
        self.wake()

    def _park(self) -> None:
        if self.events.due_while_stopped:
            self.events.run_while_stopped()
        else:
            self._blocked = True
            self.scheduler.suspend(self)
            if self._order is not None:
                self.obey()
        if not self.held:
            self.events.run(AT_RESTART)

    def stand(self) -> None:
        """Wait until the program is started again."""
        self.held = True
        self._holds += 1
        self.process_pending()

    def stop_here(self) -> None:
        """Stop, Break: stop the program; a start continues after it.

        In an event routine it ends the routine, which starts anew at the next event [S4 2-Stop-1].
        A switch decides whether the STOP routines run then.
        """
        self.enter("stopped")
        self.controller.operation.program_stopped(self)
        event, due = self.events.running, self.events.due
        if event:
            if self.controller.dialect.event_stops and event != "STOP":
                due.append("STOP")
            self.hold()
            raise EventStopped
        due.append("STOP")
        self.stand()

    # -- called by compiled code -----------------------------------------------------------------

    def poll(self, b: int) -> int:
        """Check the call depth and poll, see Process.poll.

        Events run here: a fault of the planner in one becomes an error of this program.
        """
        try:
            sys._getframe(DEEPEST)
        except ValueError:
            try:
                return super().poll(b)
            except MotionFault as fault:
                raise in_rapid(fault) from fault
        self.b = b
        raise FatalError(194027, "Stack overflow", "routines call each other too deeply")

    def polls(self, b: int, costs: tuple[int, ...]) -> int:
        """Pay a block statement by statement if the budget is too small."""
        return self.charge_again(b + sum(costs), costs)

    def charge_again(self, b: int, costs: tuple[int, ...]) -> int:
        """Pay again the refunded costs after a failed statement."""
        for cost in costs:
            b -= cost
            if b < 0:
                b = self.poll(b)
        return b

    def touch(self, value: Value) -> Value:
        """Record access to a PERS: other tasks may run (schedule `pers`)."""
        if self.scheduler.switches_here():
            self.switch()
        return value

    def trace(self, point: int) -> None:
        """Report the next statement."""
        if self._renews:
            # Otherwise the other code would report this statement once more.
            self._renew()
        routine, node = self.program.trace_points[point]
        module, statements = routine.module, self.controller.statements
        report = self.stepper.forward is not None
        for tracer in statements.tracers:
            if not tracer(self.name, routine, node):
                report = True
        if self.stepper.forward is not None and self.stepper.reached(module):
            self.stepper.end()
        if statements.waiting and module is not None:
            actions = statements.due(self.name, module, node)
            if actions is not None:
                report = True
                for action in actions:
                    action()
                    self.process_pending()
        if not report:
            self.program.traced_points[point] = False

    def exit(self) -> None:
        """Execute EXIT [K §4.9]."""
        raise EndOfRun

    def missing(self, name: str) -> None:
        """Stop at a routine that exists on controllers only."""
        raise FatalError(
            194001, f"{name} is not available on the virtual controller", unsupported.reason(name)
        )

    def refuse(self, reason: str, span: Span) -> None:
        """Stop at a statement that violates the language."""
        raise FatalError(194001, "Statement cannot be executed", reason, span=span)

    def late(
        self, name: str, module: LoadedModule | None, arguments: tuple[LateArgument | None, ...]
    ) -> None:
        """Execute `%name% arguments;` [K §4.5]."""
        routine = late_routine(self.program, name, module)
        binding = routine.builtin
        if routine.node is None and binding is None:
            self.missing(routine.name)
            return
        positional, named = late_arguments(routine, [a for a in arguments if a is not None])
        if binding is None:
            self.program.function(routine)(*positional, **named)
            return
        values = [*positional]
        for parameter in routine.parameters[len(positional) :]:
            values.append(named.get(f"v_{parameter.name.lower()}"))
        self.charge(COSTS[binding.cost])
        binding.function(self, *values)

    def call(self, name: str, *arguments: Value) -> Value:
        """Call a routine of the program from the task's greenlet.

        Raises KeyError for an unknown routine.
        """
        routine = self.program.find_routine(None, name.lower())
        if routine is None or routine.node is None:
            raise KeyError(name)
        return self.program.function(routine)(*arguments)


def _never() -> bool:
    return False


_BETWEEN = (Task.poll.__code__, Task.polls.__code__, Task.charge_again.__code__)
"""Functions that compiled code calls outside its statements."""
_BEFORE = (*_BETWEEN[:2], Task.trace.__code__)
"""Functions that it calls before a statement."""
