"""Statement steps, forward and backward."""

import sys
from collections.abc import Callable
from dataclasses import dataclass, replace

from rapidgen.axes.kinematics import Posture
from rapidgen.motion.group import MotionGroup, MotionWaiter
from rapidgen.motion.moves import FINE, CartesianMove, JointMove, Move
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.resume import StoppedFrame
from rapidgen.runtime.compiler.symbols import CannotCompile, LoadedModule
from rapidgen.runtime.errors import Location
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.motion_interface import planned
from rapidgen.runtime.task.calls import outwards
from rapidgen.runtime.task.errors import Errors
from rapidgen.runtime.task.interrupts import EventRoutines
from rapidgen.runtime.task.pointer import CannotStep, Pointer

# -- Moves of steps --------------------------------------------------------------------------------
#
# Moves of a program that is stepped: a step backward over one takes the robot to where it began.
#
# Source: S4 datasys 2-SearchL-6 and 2-TriggL: backward, a move instruction just carries out the
# movement, without supervision and without events. Where a move began is known of those that were
# stepped forward; what was executed otherwise in between makes all of them unknown.


MOST = 1000
"""Moves that are remembered."""
_AT = 1e-5
"""Maximum distance (rad or m) of the robot from the end of a move."""


@dataclass(frozen=True, slots=True)
class _Driven:
    move: Move
    origin: Posture
    end: Posture


class StepHistory:
    """The moves of the steps of one task, the latest last."""

    def __init__(self, group: MotionGroup) -> None:
        self._group = group
        self._driven: list[_Driven] = []
        self._current: list[tuple[Move, Posture]] = []
        self._listens = False

    def begin(self) -> None:
        """Begin a step forward."""
        self._current.clear()
        if not self._listens:
            self._group.listeners.append(self._note)
            self._listens = True

    def end(self) -> None:
        """Record the end of a step at standstill."""
        if self._listens:
            self._group.listeners.remove(self._note)
            self._listens = False
        if len(self._current) == 1:
            ((move, origin),) = self._current
            self._driven.append(_Driven(move, origin, self._group.positions()))
            del self._driven[:-MOST]

    def forget(self) -> None:
        """Clear the history: other execution, or a moved program pointer."""
        self._current.clear()
        self.end()
        self._driven.clear()

    def _note(self, move: Move) -> None:
        self._current.append((move, self._group.path_target))

    @planned
    def drive(self, task: MotionWaiter, statement: Location, start: Callable[[], None]) -> bool:
        """Drive back over the move of a statement; False if unknown.

        The robot follows the path of the move at its speed to a stop point. `start` enables motion.
        """
        current = self._group.positions()
        for k in range(len(self._driven) - 1, -1, -1):
            one = self._driven[k]
            if _same(_place(one.move), statement) and _near(one.end, current):
                break
        else:
            return False
        del self._driven[k:]
        start()
        self._group.move(task, self._reversed(one))
        self._group.wait_standing(task)
        if not _near(self._group.positions(), one.origin):
            self._driven.clear()
        return True

    def _reversed(self, one: _Driven) -> Move:
        move = replace(one.move, zone=FINE, events=(), concurrent=False, dwell=0.0)
        if isinstance(move, JointMove):
            return replace(move, target=one.origin)
        assert isinstance(move, CartesianMove)
        carrier = move.carrier.at(one.origin)
        pose = carrier.pose(self._group.geometry().forward(one.origin))
        return replace(move, target=pose, external=one.origin, wanted=None)


def _place(move: Move) -> Location | None:
    result = move.place() if move.place is not None else None
    return result if isinstance(result, Location) else None


def _same(one: Location | None, other: Location) -> bool:
    return one is not None and (one.module, one.routine, one.span.line, one.span.column) == (
        other.module,
        other.routine,
        other.span.line,
        other.span.column,
    )


def _near(one: Posture, other: Posture) -> bool:
    return all(abs(a - b) <= _AT for a, b in zip(one, other, strict=True))


# -- Steps -----------------------------------------------------------------------------------------
#
# Statement steps, forward and backward [K §6, S4 overview 4-39 to 4-42].
#
# A stopped program is converted to code that reports every statement (pointer.py) and stops before
# the next one. Backward, only simple statements are possible. Assignments and CONNECT have no
# effect; a call of a procedure of the program executes its BACKWARD handler; a stepped move drives
# the robot back; other statements raise CannotStep. Interrupts are off meanwhile.


@dataclass(slots=True)
class ForwardStep:
    """A step forward in progress."""

    over: bool
    """Calls are executed as a whole."""
    depth: int = -1
    """Routines inside each other where the step began; not known before the first statement."""
    depth_now: int = -1
    """The same where it has come to."""


@dataclass(slots=True, eq=False)
class Stepper:
    """Executes the steps of one task."""

    task: RapidTask
    errors: Errors
    pointer: Pointer
    events: EventRoutines
    forward: ForwardStep | None = None
    """Step in progress."""
    back_asked: bool = False
    """The step that begins goes back."""
    going_back: bool = False
    at_point: int = -1
    """Depth of the statement before which a step has ended; -1 elsewhere."""
    history: StepHistory | None = None
    """Of a motion task: the moves of its steps."""

    @property
    def active(self) -> bool:
        """True during a step: interrupts are off [S4 overview 4-39]."""
        return self.forward is not None or self.going_back

    def forget(self) -> None:
        """Forget the moves of earlier steps."""
        if self.history is not None:
            self.history.forget()

    # -- forward ---------------------------------------------------------------------------------

    def begin(self, over: bool, depth: int = -1) -> None:
        """Begin a step, at a depth if known."""
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
        """Return True if the step ends before the next statement.

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
        """Stop the program before the reached statement, and the robot."""
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
        """Execute the previous statement backward; return the new place.

        CannotStep: there is none, or it has no backward behaviour. The arguments of a call are
        evaluated nevertheless [K §6].
        """
        last = places[-1]
        body, i = last.path[-1]
        if i == 0:
            raise CannotStep("the program is at the top of a statement list")
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
        """Drive a stepped move back (switch `moves_back`)."""
        task = self.task
        module = before.routine.module
        assert module is not None
        if self.history is None or not task.controller.dialect.moves_back:
            raise CannotStep(f"{call.name} is not executed backward")
        place = Location(module.name, before.routine.name, module.span(call))
        if not self.history.drive(task, place, task.controller.operation.step_moves):
            raise CannotStep(f"{call.name}: its start is unknown, or the robot is not at its end")


def _nothing(*_arguments: object, **_named: object) -> None:
    """Do nothing, as a procedure without BACKWARD."""
