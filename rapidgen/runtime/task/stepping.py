"""Statement by statement, forward and backward [K §6, S4 overview 4-39 to 4-42].

A stopped program is taken down and goes on in code that reports every statement
(pointer.py); it stops again before the next one. Backward, only simple statements are executed:
assignments and CONNECT do nothing, a call of the program's own procedure executes its BACKWARD
handler, a move that was stepped takes the robot back, everything else refuses. There are no
interrupts meanwhile.
"""

import sys
from dataclasses import dataclass, replace
from types import FrameType
from typing import Any

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.analysis import walk
from rapidgen.runtime.compiler.context import CannotCompile
from rapidgen.runtime.compiler.linking import LoadedModule
from rapidgen.runtime.compiler.resume import Standing, find
from rapidgen.runtime.task.driving_back import StepHistory
from rapidgen.runtime.task.pointer import Pointer, standing
from rapidgen.runtime.task.recovery import Place


class CannotStep(Exception):
    """A step is not possible from where the program stands; the text says why."""


@dataclass(slots=True)
class Step:
    """What is under way."""

    over: bool
    """Calls are executed as a whole."""
    depth: int = -1
    """Routines inside each other where the step began; not known before the first statement."""
    depth_now: int = -1
    """The same where it has come to."""


class Stepping(Pointer):
    """The part of a task that steps."""

    def __init__(self, *arguments: Any) -> None:  # noqa: ANN401 - those of Task
        super().__init__(*arguments)
        self.step_under_way: Step | None = None
        self.stepping_back = False
        self.history: StepHistory | None = None
        """Of a motion task: the moves of its steps."""

    @property
    def stepping(self) -> bool:
        """Whether a step is being executed: there are no interrupts [S4 overview 4-39]."""
        return self.step_under_way is not None or self.stepping_back

    def where_it_stands(self) -> list[Standing]:
        """Every routine of a stopped program. CannotStep: inside what cannot be left."""
        if self.place is not None:
            return self.place
        frames: list[tuple[FrameType, int]] = []
        frame: Any = self.frame
        while frame is not None:
            frames.append((frame, frame.f_lineno))
            frame = frame.f_back
        found = standing(self.program, reversed(frames))
        if found is None:
            raise CannotStep("it stands in a handler, a trap or an event routine")
        return found

    def stands_before(self) -> Place | None:
        """The statement that a start would execute next."""
        if self.place is None and self.frame is None:
            return None
        try:
            last = self.where_it_stands()[-1]
        except CannotStep:
            return None
        body, i = last.path[-1]
        module = last.routine.module
        assert module is not None
        return Place(module.name, last.routine.name, module.span(body[i]), None)

    def standing_at(self, line: int) -> list[Standing]:
        """The same stack with the innermost routine at another statement. CannotStep."""
        places = self.where_it_stands()
        last = places[-1]
        module, node = last.routine.module, last.routine.node
        assert module is not None
        assert node is not None
        source = module.tree.source
        tokens = sorted(at.first for at in walk(node) if source.line(at.first) == line)
        paths = (find(node.body, token) for token in tokens)
        path = next((p for p in paths if p is not None), None)
        if path is None:
            raise CannotStep(f"no statement of {last.routine.name} begins in line {line}")
        there = replace(last, path=path)
        try:
            self.program.rest(there)
        except CannotCompile as error:
            raise CannotStep(str(error)) from error
        return [*places[:-1], there]

    def reached(self, module: LoadedModule | None) -> bool:
        """A statement is about to be executed: whether the step ends before it.

        Statements of NOSTEPIN modules are executed as a whole [S4 overview 4-8].
        """
        step = self.step_under_way
        if step is None or self.event or self.in_trap:
            return False
        if module is not None and (module.installed or "NOSTEPIN" in module.tree.attributes):
            return False
        depth = step.depth_now = self._depth()
        if step.depth < 0:
            step.depth = depth
            return False
        return not step.over or depth <= step.depth

    def _depth(self) -> int:
        codes = self.program.codes
        depth = 0
        frame: FrameType | None = sys._getframe(2)
        while frame is not None:
            depth += frame.f_code.co_filename in codes
            frame = frame.f_back
        return depth

    # -- backward --------------------------------------------------------------------------------

    def step_back(self, places: list[Standing]) -> list[Standing]:
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

    def _call_back(self, call: n.ProcedureCall, before: Standing) -> None:
        routine = self.program.find_routine(before.routine.module, call.name.lower())
        if routine is None or routine.node is None:
            if routine is None or routine.builtin is None or routine.builtin.cost != "move":
                raise CannotStep(f"{call.name} is not executed backward")
            self._drive_back(call, before)
            return
        handler = routine.node.backward
        try:
            once = self.program.rest(before, alone=True)
            function = self.program.backward(routine) if handler is not None else _nothing
        except CannotCompile as error:
            raise CannotStep(str(error)) from error
        if handler is not None:
            self.controller.step_moves()
        self.intercept(routine, lambda *a, **k: self.at_level(lambda: function(*a, **k)))
        try:
            once(before.values)
        finally:
            self.not_below()
        if handler is None:
            raise CannotStep(f"{call.name} has no BACKWARD handler")

    def _drive_back(self, call: n.ProcedureCall, before: Standing) -> None:
        """A move that was stepped is driven back (switch `moves_back`)."""
        module = before.routine.module
        assert module is not None
        if self.history is None or not self.controller.dialect.moves_back:
            raise CannotStep(f"{call.name} is not executed backward")
        place = Place(module.name, before.routine.name, module.span(call), None)
        if not self.history.drive(self, place, self.controller.step_moves):
            raise CannotStep(
                f"{call.name}: where it began is not known, or the robot does not stand at its end"
            )


def _nothing(*_arguments: Any, **_named: Any) -> None:  # noqa: ANN401
    """What a procedure without BACKWARD does."""
