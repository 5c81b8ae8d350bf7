"""Statement by statement, forward and backward [K §6, S4 overview 4-39 to 4-42].

A stopped program is taken down and goes on in code that reports every statement
(pointer.py); it stops again before the next one. Backward, only simple statements are executed:
assignments and CONNECT do nothing, a call of the program's own procedure executes its BACKWARD
handler, a move that was stepped takes the robot back, everything else refuses. There are no
interrupts meanwhile.
"""

import sys
from dataclasses import dataclass, replace

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.resume import StoppedFrame
from rapidgen.runtime.compiler.symbols import CannotCompile, LoadedModule
from rapidgen.runtime.errors import Location
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.task.backward_motion import StepHistory
from rapidgen.runtime.task.call_stack import outwards
from rapidgen.runtime.task.errors import Errors
from rapidgen.runtime.task.event_routines import EventRoutines
from rapidgen.runtime.task.pointer import CannotStep, Pointer


@dataclass(slots=True)
class ForwardStep:
    """A step that is under way."""

    over: bool
    """Calls are executed as a whole."""
    depth: int = -1
    """Routines inside each other where the step began; not known before the first statement."""
    depth_now: int = -1
    """The same where it has come to."""


@dataclass(slots=True, eq=False)
class Stepper:
    """Steps one task."""

    task: RapidTask
    errors: Errors
    pointer: Pointer
    events: EventRoutines
    forward: ForwardStep | None = None
    """What is under way."""
    back_asked: bool = False
    """The step that begins goes back."""
    going_back: bool = False
    at_point: int = -1
    """Depth of the statement before which a step has ended; -1 elsewhere."""
    history: StepHistory | None = None
    """Of a motion task: the moves of its steps."""

    @property
    def active(self) -> bool:
        """Whether a step is being executed: there are no interrupts [S4 overview 4-39]."""
        return self.forward is not None or self.going_back

    def forget(self) -> None:
        """Moves that were stepped are not driven back any more."""
        if self.history is not None:
            self.history.forget()

    # -- forward ---------------------------------------------------------------------------------

    def begin(self, over: bool, depth: int = -1) -> None:
        """A step begins, at a depth where that is known."""
        task = self.task
        group = task.controller.motion.moved_by(task.name)
        if self.history is None and group is not None:
            self.history = StepHistory(group)
        if self.history is not None and not self.back_asked:
            self.history.begin()
        task.program.trace_from_now()
        task.fault = None
        self.events.due.append("STEP")
        task.enter("running")
        self.forward = ForwardStep(over, depth)

    def reached(self, module: LoadedModule | None) -> bool:
        """A statement is about to be executed: whether the step ends before it.

        Statements of NOSTEPIN modules are executed as a whole [S4 overview 4-8].
        """
        step, task = self.forward, self.task
        if step is None or self.events.running or task.in_trap:
            return False
        if module is not None and (module.installed or "NOSTEPIN" in module.tree.attributes):
            return False
        depth = step.depth_now = self._depth()
        if step.depth < 0:
            step.depth = depth
            return False
        return not step.over or depth <= step.depth

    def _depth(self) -> int:
        codes = self.task.program.codes
        return sum(frame.f_code.co_filename in codes for frame in outwards(sys._getframe(2)))

    def end(self) -> None:
        """Stand before the statement that was reached; the robot stands, too."""
        task = self.task
        assert self.forward is not None
        group = task.controller.motion.moved_by(task.name)
        if group is not None:
            group.wait_standing(task)
        if self.history is not None:
            self.history.end()
        self.at_point = self.forward.depth_now
        task.enter("stopped")
        task.controller.operation.step_ended()
        try:
            task.stand()
        finally:
            self.at_point = -1

    # -- backward --------------------------------------------------------------------------------

    def step_back(self, places: list[StoppedFrame]) -> list[StoppedFrame]:
        """Execute the statement before the place backward; where the program stands then.

        CannotStep: there is none, or it has no backward behaviour. Arguments of a call are
        evaluated even so [K §6].
        """
        last = places[-1]
        body, i = last.path[-1]
        if i == 0:
            raise CannotStep("it stands at the top of a statement list")
        statement = body[i - 1]
        before = replace(last, path=[*last.path[:-1], (body, i - 1)])
        if isinstance(statement, n.ProcedureCall):
            self._call_back(statement, before)
        elif not isinstance(statement, n.Assignment | n.Connect | n.Label):
            raise CannotStep("the statement before cannot be executed backward")
        return [*places[:-1], before]

    def _call_back(self, call: n.ProcedureCall, before: StoppedFrame) -> None:
        task = self.task
        program = task.program
        routine = program.find_routine(before.routine.module, call.name.lower())
        if routine is None or routine.node is None:
            if routine is None or routine.builtin is None or routine.builtin.cost != "move":
                raise CannotStep(f"{call.name} is not executed backward")
            self._drive_back(call, before)
            return
        handler = routine.node.backward
        try:
            once = program.rest(before, alone=True)
            function = program.backward(routine) if handler is not None else _nothing
        except CannotCompile as error:
            raise CannotStep(str(error)) from error
        if handler is not None:
            task.controller.operation.step_moves()
        level = self.errors.at_level
        self.pointer.intercept(routine, lambda *a, **k: level(lambda: function(*a, **k)))
        try:
            once(before.values)
        finally:
            self.pointer.not_below()
        if handler is None:
            raise CannotStep(f"{call.name} has no BACKWARD handler")

    def _drive_back(self, call: n.ProcedureCall, before: StoppedFrame) -> None:
        """A move that was stepped is driven back (switch `moves_back`)."""
        task = self.task
        module = before.routine.module
        assert module is not None
        if self.history is None or not task.controller.dialect.moves_back:
            raise CannotStep(f"{call.name} is not executed backward")
        place = Location(module.name, before.routine.name, module.span(call))
        if not self.history.drive(task, place, task.controller.operation.step_moves):
            raise CannotStep(
                f"{call.name}: where it began is not known, or the robot does not stand at its end"
            )


def _nothing(*_arguments: object, **_named: object) -> None:
    """What a procedure without BACKWARD does."""
