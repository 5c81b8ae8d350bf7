"""The run of a task's greenlet: cycles, event routines, exits.

A run begins with a launch and ends when no statement is left to execute. Order within a run:
pending UNDO handlers, event routines, then the statement where an error stopped the program or a
new cycle. Every exit (error, Stop, EXIT, PP to main) passes `_guarded`, which decides on the state
and on the next step of the run.
"""

from collections.abc import Callable
from dataclasses import dataclass

from rapidgen.machine.event_log import EventType
from rapidgen.machine.event_table import KINDS
from rapidgen.runtime.compiler.resume import StoppedFrame
from rapidgen.runtime.compiler.symbols import CannotCompile, Routine
from rapidgen.runtime.errors import RECOVERABLE, EndOfRun, ExitCycle, FatalError, PointerMoved
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.loading import drop_dynamic
from rapidgen.runtime.task.calls import stack_of_error
from rapidgen.runtime.task.errors import Errors
from rapidgen.runtime.task.interrupts import WHILE_STOPPED, EventRoutines, Interrupts
from rapidgen.runtime.task.pointer import CannotStep, Pointer
from rapidgen.runtime.task.stepping import Stepper


@dataclass(slots=True, eq=False)
class Run:
    """One run of a task, from a launch to its end."""

    task: RapidTask
    errors: Errors
    interrupts: Interrupts
    pointer: Pointer
    stepper: Stepper
    events: EventRoutines
    fresh: bool = True
    """PP was set to main: variables are to be initialised."""
    routine: Routine | None = None
    """Where PP was set instead of main."""
    start_asked: Callable[[], None] | None = None
    """A start or step that arrived while routines were left for PP to main."""

    def body(self) -> None:
        """Execute the run, as the greenlet's body."""
        task = self.task
        step = self._begin if self.pointer.place is None else self._again
        if self.events.service and task.state != "running":
            step = self._serve
        # An observer of the state may start the task again at once.
        while self._guarded(step) or task.state == "running":
            step = self._cycle if self.pointer.place is None else self._again

    def _serve(self) -> bool:
        """Execute pending routines of a stopped program without frames."""
        self.events.run_while_stopped()
        return False

    def _begin(self) -> bool:
        """Execute what needs no start: UNDO after PP to main, POWER_ON."""
        task = self.task
        # PP to main may have come before the first statement.
        task.obey()
        self.pointer.leave()
        self._prepare()
        self.events.run(WHILE_STOPPED)
        return task.state in ("running", "stopped")

    def _prepare(self) -> None:
        """Prepare a program after PP to main [S4 overview 4-24].

        Variables, interrupts, ERRNO, sockets and files are reset, and dynamically loaded modules
        are removed. After PP to a routine the motion settings stay.
        """
        if not self.fresh:
            return
        self.fresh = False
        task = self.task
        task.program.reset_variables()
        self.interrupts.clear()
        task.errno = task.intno = 0
        controller = task.controller
        drop_dynamic(task)
        task.cyclic.clear()
        controller.sockets.close_task(task.name)
        controller.files.close_task(task.name)
        controller.egm.close_task(task.name)
        group = controller.motion.moved_by(task.name)
        if self.routine is None and group is not None:
            group.reset()

    def _cycle(self) -> bool:
        """Execute the entry routine once; return True for another cycle."""
        task = self.task
        self.errors.undo_failed = False
        self._prepare()
        task.process_pending()
        task.charge(task.controller.costs.statement)
        self.events.run()
        entry = self.routine or task.program.find_routine(None, task.spec.entry.lower())
        assert isinstance(entry, Routine)
        task.program.function(entry)()
        return self._next_cycle()

    def _again(self) -> bool:
        """Continue where an error stopped the program."""
        task = self.task
        self.errors.undo_failed = False
        task.process_pending()
        places, self.pointer.place = self.pointer.place, None
        assert places is not None
        task.charge(task.controller.costs.statement)
        self.events.run()
        if self.stepper.back_asked:
            return self._back(places)
        try:
            self.pointer.go_on(places)
        except CannotCompile as error:
            raise FatalError(
                194_001, "Program pointer is lost", f"{error}: PP to main", restartable=False
            ) from error
        return self._next_cycle()

    def _back(self, places: list[StoppedFrame]) -> bool:
        """Execute the previous statement backward.

        The program pointer is then before it.
        """
        task, stepper = self.task, self.stepper
        stepper.back_asked = False
        stepper.forward = None
        stepper.going_back = True
        try:
            self.pointer.place = stepper.step_back(places)
        except CannotStep as reason:
            self.pointer.place = places
            number = str(1 + list(task.controller.rapid_tasks).index(task.name))
            task.controller.log.add(
                EventType.WARNING,
                10_128,
                KINDS[10_128].title,
                (str(reason),),
                task.name,
                (number, task.name),
            )
        except FatalError as fatal:
            self._fail(fatal, fatal)
            self.pointer.place = places
            return False
        finally:
            stepper.going_back = False
        task.enter("stopped")
        task.controller.operation.step_ended()
        return False

    def _guarded(self, step: Callable[[], bool]) -> bool:
        """Execute a step of the run and handle every exit from it.

        Returns True if the run continues.
        """
        try:
            return step()
        except ExitCycle:
            return self._next_cycle()
        except EndOfRun:
            return self._over()
        except PointerMoved:
            return self.task.state == "running"
        except FatalError as fatal:
            self._fail(fatal, fatal)
        except RECOVERABLE as error:
            self._fail(self.errors.unhandled(error), error)
        except RecursionError as error:
            self._fail(FatalError(194027, "Stack overflow"), error)
        return False

    def _next_cycle(self) -> bool:
        task = self.task
        task.cycles += 1
        if task.controller.dialect.cycle_resets_interrupts:
            self.interrupts.clear()
        if task.controller.cycle == "forever" and self.routine is None:
            return True
        self.routine = None
        task.enter("finished")
        return False

    def _over(self) -> bool:
        """Handle EXIT and PP to main; a start may have arrived meanwhile."""
        task = self.task
        if not self.fresh:
            task.enter("finished")
        elif self.start_asked is not None:
            begin, self.start_asked = self.start_asked, None
            begin()
            return True
        else:
            task.enter("ready")
        return False

    def _fail(self, fatal: FatalError, raised: BaseException) -> None:
        task = self.task
        if not fatal.stack:
            fatal.stack = stack_of_error(task.program.codes, raised)
        task.fault = fatal
        self.pointer.keep(fatal, raised)
        if self.pointer.place is None:
            self.interrupts.clear()
        task.controller.operation.task_failed(task, fatal)
        task.enter("error")
        for tell in task.controller.statements.failures:
            tell(task.name, fatal)
        if task.controller.dialect.fault_routines and not self.events.while_stopped:
            self.events.due.append("STOP")
            self._guarded(self._serve)
