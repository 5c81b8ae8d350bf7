"""Debugger of one controller: it pauses time, tasks and robots.

A pause is not a state of the controller. No task stops, no event routine runs, no socket closes,
and a robot stands still in the middle of its move, because time does not pass. Programs without a
traced statement are compiled as without a debugger.
"""

import sys
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, TypeAlias

from rapidgen.controller.controller import VirtualController
from rapidgen.controller.debugger import breakpoints as places
from rapidgen.controller.debugger import values
from rapidgen.controller.debugger.breakpoints import Breakpoint, PlacedBreakpoint
from rapidgen.controller.debugger.stack import (
    Level,
    StackFrame,
    depth_here,
    frames_of,
    innermost,
    motion_pointer,
    program_pointer,
)
from rapidgen.controller.debugger.values import DisplayedValue, NotPaused
from rapidgen.machine.scheduler import S, Timer, WaitSet
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.resume import WatchedExpression
from rapidgen.runtime.compiler.symbols import LoadedModule, Routine
from rapidgen.runtime.errors import FatalError, Location, PointerMoved, RapidError
from rapidgen.runtime.task.pointer import CannotStep
from rapidgen.runtime.task.task import Task

Reason: TypeAlias = Literal["breakpoint", "step", "cursor", "error", "pause", "time"]
StepKind: TypeAlias = Literal["in", "over", "out"]
ErrorStop: TypeAlias = Literal["never", "unhandled", "all"]
"""Errors that pause: those that stop a task, or all before their handler."""
LARGEST_OUTPUT = 1000
"""Maximum number of stored log point lines."""


@dataclass(frozen=True, slots=True)
class PauseReason:
    """Reason of a pause."""

    reason: Reason
    task: str = ""
    """Empty: paused by a user."""
    place: Location | None = None
    text: str = ""
    breakpoint: int = 0
    code: str = ""
    """Of an error: its name, such as ERR_DIVZERO, or the event number that stops the task."""
    stack: tuple[Location, ...] = ()
    """Of an error that stops the task: the call stack, outermost first."""


@dataclass(frozen=True, slots=True)
class LogPointOutput:
    """A line of a log point; `time` is the controller's, s."""

    time: float
    task: str
    place: Location
    text: str


@dataclass(frozen=True, slots=True)
class _Step:
    task: str
    kind: StepKind
    depth: int
    level: Level
    hidden: bool
    """It began in a module that is executed as a whole."""
    reason: Reason = "step"


class Debugger:
    """Breakpoints, steps, stacks and values of one controller.

    All methods run on the thread that lets the controller's time pass. On the virtual clock,
    `run_for` and similar methods return at once while it is paused.
    """

    def __init__(
        self, controller: VirtualController, breakpoints: Iterable[Breakpoint] = ()
    ) -> None:
        self._controller = controller
        self._scheduler = controller.scheduler
        self._tasks = controller.rapid_tasks
        self._numbers = 0
        self.placed: dict[int, PlacedBreakpoint] = {}
        """Breakpoints by number."""
        self.errors: ErrorStop = "never"
        self.only_errors: frozenset[str] = frozenset()
        """Errors that pause before a handler, by upper-case name or by number; empty: all."""
        self.only_failures: frozenset[str] = frozenset()
        """Errors that pause when they stop a task, also by event number; empty: all."""
        self.halt: PauseReason | None = None
        """Why it is paused; None: it is not."""
        self.output: list[LogPointOutput] = []
        """Output of log points, the latest last."""
        self.changed = WaitSet()
        """Changes of pause, output or breakpoints."""
        self._armed: dict[tuple[int, int], list[PlacedBreakpoint]] = {}
        self._trees: dict[int, n.Module] = {}
        self._watched: dict[tuple[str, Routine, str], WatchedExpression] = {}
        self._step: _Step | None = None
        self._cursor: PlacedBreakpoint | None = None
        self._timer: Timer | None = None
        controller.statements.errors.append(self._error)
        controller.statements.failures.append(self._failure)
        for task in self._tasks.values():
            task.program.changed.add(self._modules_changed)
        for expression in breakpoints:
            self.add(expression)

    def successor(self, controller: VirtualController) -> "Debugger":
        """Return a debugger of a restarted controller with the same breakpoints and errors."""
        result = Debugger(controller, [placed.asked for placed in self.placed.values()])
        result.errors = self.errors
        result.only_errors, result.only_failures = self.only_errors, self.only_failures
        return result

    # -- breakpoints -----------------------------------------------------------------------------

    def add(self, expression: Breakpoint) -> PlacedBreakpoint:
        """Set a breakpoint and return its place and doubts.

        ValueError: invalid `hits`.
        """
        places.due(expression.hits, 0)
        self._numbers += 1
        placed = self.placed[self._numbers] = PlacedBreakpoint(self._numbers, expression)
        self._place()
        self._listen()
        self.changed.notify()
        return placed

    def change(self, number: int, expression: Breakpoint) -> PlacedBreakpoint:
        """Change a breakpoint and reset its count.

        KeyError: unknown number. ValueError: invalid `hits`; the breakpoint is unchanged.
        """
        places.due(expression.hits, 0)
        placed = self.placed[number]
        placed.asked, placed.count = expression, 0
        self._place()
        self.changed.notify()
        return placed

    def remove(self, number: int) -> None:
        """Remove a breakpoint, if it exists."""
        self.placed.pop(number, None)
        self._place()
        self._listen()
        self.changed.notify()

    def _place(self) -> None:
        """Find the statements of all breakpoints in the loaded modules."""
        modules = [m for task in self._tasks.values() for m in task.program.modules.values()]
        self._trees = {id(module.tree): module.tree for module in modules}
        self._watched.clear()
        self._armed = {}
        every = [*self.placed.values(), *([self._cursor] if self._cursor else ())]
        for placed in every:
            places.place(placed, modules)
            for point in placed.points:
                self._armed.setdefault(point, []).append(placed)

    def _modules_changed(self) -> None:
        """Find the statements again after a module was loaded or unloaded."""
        if self.placed:
            self._place()
            self._listen()
        self.changed.notify()

    def _listen(self) -> None:
        """Enable or disable statement reports, as needed."""
        tracers = self._controller.statements.tracers
        needed = bool(self._armed) or self._step is not None
        if not needed:
            if self._statement in tracers:
                tracers.remove(self._statement)
            return
        if self._statement not in tracers:
            self._controller.statements.listen(self._statement)
        for name, task in self._tasks.items():
            doubt = task.report_statements()
            for placed in self.placed.values():
                if doubt and placed.line and self._is_in(name, placed):
                    placed.doubt = f"{name} notices it when its routines are called again: {doubt}"

    def _is_in(self, task: str, placed: PlacedBreakpoint) -> bool:
        modules = {id(module.tree) for module in self._tasks[task].program.modules.values()}
        return any(tree in modules for tree, _ in placed.points)

    # -- pausing and going on --------------------------------------------------------------------

    def pause(self) -> None:
        """Pause at the current place, even inside a statement."""
        self._pause("pause")

    def run_for(self, seconds: float) -> None:
        """Continue, and pause after an amount of controller time.

        Another reason may pause earlier. NotPaused: it is not paused.
        """
        self._go_on(None)
        self._timer = self._scheduler.after(round(seconds * S), lambda: self._pause("time"))

    def _pause(self, reason: Reason) -> None:
        self._end_timer()
        if self.halt is None:
            self.halt = PauseReason(reason)
            self._scheduler.pause()
            self.changed.notify()

    def _end_timer(self) -> None:
        timer, self._timer = self._timer, None
        if timer is not None:
            timer.cancel()

    def resume(self) -> None:
        """Continue to the next breakpoint."""
        self._go_on(None)

    def step(self, task: str, kind: StepKind = "over") -> None:
        """Continue to the next statement of a task.

        `in` enters calls, `over` does not, `out` ends after the routine's call. Traps, event
        routines and NOSTEPIN modules run as a whole, unless they contain a breakpoint. All other
        tasks run meanwhile. NotPaused: it is not paused.
        """
        frames = self._frames(task)
        if not frames:
            raise NotPaused(f"{task} is not executing anything")
        depth = depth_here(self._tasks[task], self._tasks[task].frame)
        if kind == "out" and len(frames) < 2:
            raise NotPaused("this is the outermost routine")
        self._go_on(_Step(task, kind, depth, frames[-1].level, _hidden(frames[-1].module)))

    def run_to(self, task: str, module: str, line: int) -> None:
        """Continue to a line, as with a temporary breakpoint.

        NotPaused: the line has no statement.
        """
        cursor = PlacedBreakpoint(0, Breakpoint(module, line, task))
        places.place(cursor, self._tasks[task].program.modules.values())
        if not cursor.line:
            raise NotPaused(f"no statement begins in line {line} of {module}")
        self._require_halt()
        self._cursor = cursor
        self._go_on(None)

    def move_to(self, task: str, line: int) -> None:
        """Move the program pointer to a line of the innermost routine, and pause before it.

        Data and interrupts stay; the robot's path is discarded, as by PP to cursor. The other tasks
        run for a moment. NotPaused: the program cannot continue there.
        """
        self._require_halt()
        frame = self.frame(task)
        owner = self._tasks[task]
        try:
            owner.pointer.move_to(line)
        except CannotStep as error:
            raise NotPaused(str(error)) from error
        if owner.state == "running":
            # The task leaves its routines when time passes again.
            owner.order(PointerMoved())
        else:
            owner.enter("stopped")
            if not self._controller.start_program():
                raise NotPaused("the controller rejects a start: the event log contains the reason")
        group = self._controller.motion.moved_by(task)
        if group is not None:
            group.clear_path()
        self._go_on(_Step(task, "in", 0, frame.level, _hidden(frame.module), "cursor"))

    def _go_on(self, step: _Step | None) -> None:
        self._require_halt()
        self._end_timer()
        self._step = step
        self._place()
        self._listen()
        self.halt = None
        self.changed.notify()
        self._scheduler.resume()

    def _require_halt(self) -> None:
        if self.halt is None:
            raise NotPaused("nothing is paused")

    def close(self) -> None:
        """Remove all hooks and let the controller continue."""
        statements = self._controller.statements
        statements.errors.remove(self._error)
        statements.failures.remove(self._failure)
        for task in self._tasks.values():
            task.program.changed.remove(self._modules_changed)
        self.placed.clear()
        self._cursor = self._step = None
        self._end_timer()
        self._place()
        self._listen()
        self.halt = None
        self._scheduler.resume()

    # -- reports of tasks ------------------------------------------------------------------------

    def _statement(self, name: str, routine: Routine, node: n.Statement) -> None:
        module = routine.module
        assert module is not None
        if id(module.tree) not in self._trees:
            self._place()
        for placed in self._armed.get((id(module.tree), node.first), ()):
            expression = placed.asked
            if expression.task and expression.task.lower() != name.lower():
                continue
            halt = self._reached(name, placed, innermost(self._tasks[name], sys._getframe(1)))
            if halt is not None:
                self._hold(halt)
                return
        step = self._step
        if step is not None and step.task == name and self._ends(step, module):
            frame = innermost(self._tasks[name], sys._getframe(1))
            self._hold(PauseReason(step.reason, name, frame.place))

    def _reached(
        self, name: str, placed: PlacedBreakpoint, frame: StackFrame
    ) -> PauseReason | None:
        """Handle the breakpoints of the next statement."""
        expression, task = placed.asked, self._tasks[name]
        try:
            if expression.condition and self._value(task, frame, expression.condition) is not True:
                return None
            placed.count += 1
            if not places.due(expression.hits, placed.count):
                return None
            if expression.log:
                self._tell(task, frame, expression.log)
                return None
        except NotPaused as reason:
            return PauseReason("breakpoint", name, frame.place, str(reason), placed.number)
        if placed is self._cursor:
            return PauseReason("cursor", name, frame.place)
        return PauseReason("breakpoint", name, frame.place, "", placed.number)

    def _value(self, task: Task, frame: StackFrame, text: str) -> object:
        return values.read(self._compiled(task, frame, text), frame)

    def _compiled(self, task: Task, frame: StackFrame, text: str) -> WatchedExpression:
        key = (task.name, frame.routine, text)
        match = self._watched.get(key)
        if match is None:
            match = self._watched[key] = values.compiled(task.program, frame, text)
        return match

    def _tell(self, task: Task, frame: StackFrame, log: str) -> None:
        texts, expressions = places.pieces(log)
        line = texts[0]
        for expression, text in zip(expressions, texts[1:], strict=True):
            watched = self._compiled(task, frame, expression)
            value = values.read(watched, frame)
            line += values.shown("", watched.type, watched.dims, value).text + text
        self.output.append(LogPointOutput(self._controller.now, task.name, frame.place, line))
        del self.output[:-LARGEST_OUTPUT]
        self.changed.notify()

    def _ends(self, step: _Step, module: LoadedModule) -> bool:
        task = self._tasks[step.task]
        outside = step.level == "program" and (task.in_trap or bool(task.events.running))
        if outside or (_hidden(module) and not step.hidden):
            return False
        depth = depth_here(task, sys._getframe(1))
        return step.kind == "in" or depth < step.depth + (step.kind == "over")

    def _error(self, name: str, error: RapidError) -> None:
        if self.errors == "all" and _selected(self.only_errors, error.name, str(error.number)):
            frame = innermost(self._tasks[name], sys._getframe(1))
            text = f"{error.name} {error.text}".strip()
            self._hold(PauseReason("error", name, frame.place, text, code=error.name))

    def _failure(self, name: str, fatal: FatalError) -> None:
        cause = (fatal.cause.name, str(fatal.cause.number)) if fatal.cause is not None else ()
        if self.errors != "never" and _selected(self.only_failures, str(fatal.event), *cause):
            stack = fatal.stack
            place = stack[-1] if stack else None
            text = ": ".join([f"{fatal.event} {fatal.title}", *(a for a in fatal.arguments if a)])
            code = cause[0] if cause else str(fatal.event)
            self._hold(PauseReason("error", name, place, text, code=code, stack=stack))

    def _hold(self, halt: PauseReason) -> None:
        """Pause in the reporting task, which continues here."""
        self._end_timer()
        self._step = self._cursor = None
        self.halt = halt
        self.changed.notify()
        task = self._tasks[halt.task]
        self._scheduler.pause(task)
        task.process_pending()

    # -- stacks and values -----------------------------------------------------------------------

    def frames(self, task: str) -> tuple[StackFrame, ...]:
        """Return the call stack of a task, outermost first, or raise KeyError."""
        return frames_of(self._tasks[task])

    def _frames(self, task: str) -> tuple[StackFrame, ...]:
        self._require_halt()
        return self.frames(task)

    def frame(self, task: str, level: int = -1) -> StackFrame:
        """Return one routine of a call stack, by default the innermost.

        NotPaused: there is none.
        """
        frames = self.frames(task)
        try:
            return frames[level]
        except IndexError:
            raise NotPaused(f"{task} is not executing anything there") from None

    def evaluate(self, task: str, text: str, level: int = -1) -> DisplayedValue:
        """Evaluate an expression in a routine. NotPaused explains a fault."""
        return values.evaluate(self._tasks[task].program, self.frame(task, level), text)

    def assign(self, task: str, target: str, value: str, level: int = -1) -> DisplayedValue:
        """Set a datum, an element or a component; return its new value.

        NotPaused explains a fault.
        """
        done = values.assign(self._tasks[task].program, self.frame(task, level), target, value)
        self.changed.notify()
        return done

    def variables(self, task: str, level: int = -1) -> tuple[DisplayedValue, ...]:
        """Return parameters, data and loop variables of a routine."""
        return values.variables(self._tasks[task].program, self.frame(task, level))

    def parts(
        self, task: str, text: str, level: int = -1, start: int = 0, count: int = 0
    ) -> tuple[DisplayedValue, ...]:
        """Return components or elements of a value from index `start` on, 0 for the first.

        `count` 0: all. NotPaused explains a fault.
        """
        frame = self.frame(task, level)
        return values.parts(self._tasks[task].program, frame, text, start, count)

    def module_data(self, task: str, level: int = -1) -> tuple[DisplayedValue, ...]:
        """Return data of the module of a routine."""
        return values.module_data(self._tasks[task].program, self.frame(task, level))

    def program_pointer(self, task: str) -> Location | None:
        """Return a task's place in its program, None without one.

        Traps and event routines do not count.
        """
        return program_pointer(self._tasks[task])

    def motion_pointer(self, task: str) -> Location | None:
        """Return the move instruction that a task's robot executes, or None."""
        return motion_pointer(self._controller, task)


def _selected(only: frozenset[str], *keys: str) -> bool:
    return not only or any(key.upper() in only for key in keys)


def _hidden(module: LoadedModule) -> bool:
    """Return True if its routines run as a whole [S4 overview 4-8]."""
    return module.installed or "NOSTEPIN" in module.tree.attributes
