"""What the greenlet of a task executes: cycles of the program, event routines, ways out."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from rapidgen.runtime.compiler.resume import Standing
from rapidgen.runtime.compiler.symbols import CannotCompile, Routine
from rapidgen.runtime.errors import RECOVERABLE, EndOfRun, ExitCycle, FatalError, PointerMoved
from rapidgen.runtime.task.call_stack import stack_of_error
from rapidgen.runtime.task.event_routines import WHILE_STOPPED
from rapidgen.runtime.task.pointer import CannotStep

if TYPE_CHECKING:
    from rapidgen.runtime.task.task import Task


class Run:
    """Runs one task from a launch until nothing of it is to be executed any more."""

    def __init__(self, task: "Task") -> None:
        self._task = task
        self.fresh = True
        """PP was set to main: variables are to be initialised."""
        self.routine: Routine | None = None
        """Where PP was set instead of main."""
        self.start_asked = False
        """A start came while routines were still being left for PP to main."""

    def body(self) -> None:
        """The greenlet of one run."""
        task = self._task
        step = self._begin if task.pointer.place is None else self._again
        if task.events.service and task.state != "running":
            step = self._serve
        # Whoever hears of a state may start the task again at once.
        while self._guarded(step) or task.state == "running":
            step = self._cycle if task.pointer.place is None else self._again

    def _serve(self) -> bool:
        """What is due in a program that stands, and of which nothing is being executed."""
        self._task.events.run_while_stopped()
        return False

    def _begin(self) -> bool:
        """What is due without a start: UNDO after PP to main, routines of POWER_ON."""
        task = self._task
        # PP to main may have come before the first statement.
        task.obey()
        task.pointer.leave()
        self._prepare()
        task.events.run(WHILE_STOPPED)
        return task.state in ("running", "stopped")

    def _prepare(self) -> None:
        """After PP to main: variables, interrupts, ERRNO, sockets and files [S4 overview 4-24].

        Modules that the program loaded as dynamic go; after PP to a routine settings of motion
        stay.
        """
        if not self.fresh:
            return
        self.fresh = False
        task = self._task
        task.program.reset_variables()
        task.interrupts.clear()
        task.errno = task.intno = 0
        controller = task.controller
        controller.modules.drop_dynamic(task)
        controller.sockets.close_task(task.name)
        controller.files.close_task(task.name)
        group = controller.motion.moved_by(task.name)
        if self.routine is None and group is not None:
            group.reset()

    def _cycle(self) -> bool:
        """One pass of the entry routine; whether another one follows at once."""
        task = self._task
        task.errors.undo_failed = False
        self._prepare()
        task.attend()
        task.charge(task.controller.costs.statement)
        task.events.run()
        entry = self.routine or task.program.find_routine(None, task.spec.entry.lower())
        assert isinstance(entry, Routine)
        task.program.function(entry)()
        return self._next_cycle()

    def _again(self) -> bool:
        """Go on where an error stopped the program."""
        task = self._task
        task.errors.undo_failed = False
        task.attend()
        places, task.pointer.place = task.pointer.place, None
        assert places is not None
        task.charge(task.controller.costs.statement)
        task.events.run()
        if task.stepper.back_asked:
            return self._back(places)
        try:
            task.pointer.go_on(places)
        except CannotCompile as error:
            raise FatalError(
                40_001, "Program pointer is lost", f"{error}: PP to main", restartable=False
            ) from error
        return self._next_cycle()

    def _back(self, places: list[Standing]) -> bool:
        """Execute the statement before backward; the program then stands before it."""
        task, stepper = self._task, self._task.stepper
        stepper.back_asked = False
        stepper.forward = None
        stepper.going_back = True
        try:
            task.pointer.place = stepper.step_back(places)
        except CannotStep as reason:
            task.pointer.place = places
            task.controller.log.warning(
                40_700, "Backward step is not possible", str(reason), task=task.name
            )
        except FatalError as fatal:
            self._fail(fatal, fatal)
            task.pointer.place = places
            return False
        finally:
            stepper.going_back = False
        task.enter("stopped")
        task.controller.operation.step_ended()
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
            return self._task.state == "running"
        except FatalError as fatal:
            self._fail(fatal, fatal)
        except RECOVERABLE as error:
            self._fail(self._task.errors.unhandled(error), error)
        except RecursionError as error:
            self._fail(FatalError(40027, "Stack overflow"), error)
        return False

    def _next_cycle(self) -> bool:
        task = self._task
        task.cycles += 1
        if task.controller.dialect.cycle_resets_interrupts:
            task.interrupts.clear()
        if task.controller.cycle == "forever" and self.routine is None:
            return True
        self.routine = None
        task.enter("finished")
        return False

    def _over(self) -> bool:
        """EXIT, or everything was left for PP to main: then a start may have come meanwhile."""
        task = self._task
        if not self.fresh:
            task.enter("finished")
        elif self.start_asked:
            self.start_asked = False
            task.events.due.append("START")
            task.enter("running")
            return True
        else:
            task.enter("ready")
        return False

    def _fail(self, fatal: FatalError, raised: BaseException) -> None:
        task = self._task
        if not fatal.stack:
            fatal.stack = stack_of_error(task.program.codes, raised)
        task.fault = fatal
        task.pointer.keep(fatal, raised)
        if task.pointer.place is None:
            task.interrupts.clear()
        task.controller.operation.task_failed(task, fatal)
        task.enter("error")
        if task.controller.dialect.fault_routines and not task.events.while_stopped:
            task.events.due.append("STOP")
            self._guarded(self._serve)
