"""Program pointer of a stopped program without frames.

After an unhandled error the program pointer is at the failed statement, which Start executes again
[S4 overview 3-23]. The frames no longer exist: the task keeps their variables, and compiles the
rest of each routine (compiler/resume.py). The error does not abort these routines: their UNDO
handlers run when the program pointer moves.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from types import FrameType
from typing import ParamSpec, TypeVar

from rapidgen.rapid.syntax.walk import walk
from rapidgen.runtime.compiler.program import Program
from rapidgen.runtime.compiler.resume import StoppedFrame, find
from rapidgen.runtime.compiler.symbols import CannotCompile, CodeRole, Routine
from rapidgen.runtime.errors import FatalError, Location
from rapidgen.runtime.host import RapidTask
from rapidgen.runtime.task.calls import frames_of, outwards
from rapidgen.runtime.task.errors import Errors
from rapidgen.runtime.task.interrupts import EventRoutines, Interrupts

LARGEST_STACK = 100
"""Maximum number of nested routines that are kept."""
_OTHER_LEVELS = (Interrupts.serve.__code__, EventRoutines.execute.__code__)
"""Below these, a trap or an event routine is being executed."""
_P = ParamSpec("_P")
_T = TypeVar("_T")


class CannotStep(Exception):
    """A step is not possible at this place; the text explains why."""


def standing(
    program: Program, frames: Iterable[tuple[FrameType, int]]
) -> list[StoppedFrame] | None:
    """Return the places of the routines of frames, outermost first.

    None: the program cannot continue there, that is in a handler, a trap or an event routine, or
    too deep.
    """
    result: dict[int, StoppedFrame] = {}
    for frame, line in frames:
        code = frame.f_code
        if any(code is other for other in _OTHER_LEVELS):
            return None
        compiled = program.codes.get(code.co_filename)
        if compiled is None or not 0 <= line < len(compiled.tokens):
            continue
        role = compiled.role(code)
        if role.is_handler:
            return None
        assert compiled.routine.node is not None
        path = find(compiled.routine.node.body, compiled.tokens[line])
        if path is None:
            return None
        key, values = id(frame), dict(frame.f_locals)
        if role is CodeRole.PART:
            key = list(result)[-1]
            values = {**result[key].values, **values}
        result[key] = StoppedFrame(compiled.routine, path, values)
    return list(result.values()) if 0 < len(result) <= LARGEST_STACK else None


class Pointer:
    """The program pointer of one task."""

    def __init__(self, task: RapidTask, errors: Errors) -> None:
        self._task = task
        self._errors = errors
        self.place: list[StoppedFrame] | None = None
        """Where an error stopped the program; None: it starts from main only."""
        self._below: list[tuple[StoppedFrame, Callable[[dict[str, object]], object]]] = []
        self._intercepted: tuple[str, object] | None = None

    # -- keeping the place -----------------------------------------------------------------------

    def keep(self, fatal: FatalError, raised: BaseException) -> None:
        """Keep the place of an error, or leave all its routines."""
        self.not_below()
        self._below = []
        self.place = None
        if self._errors.tried_again and fatal.restartable:
            self.place = standing(self._task.program, frames_of(raised.__traceback__))
        if self.place is None:
            self.leave()

    def leave(self) -> None:
        """Run UNDO handlers of kept routines, the innermost first.

        The program pointer moves away.
        """
        self.place = None
        self._errors.undo_late()

    # -- place ------------------------------------------------------------------------------------

    @property
    def in_statement(self) -> bool:
        """True if a statement is in execution, or was when stopped."""
        codes = self._task.program.codes
        return any(f.f_code.co_filename in codes for f in outwards(self._task.frame))

    def stack(self) -> list[StoppedFrame]:
        """Return every routine of a stopped program.

        CannotStep: inside a construct that cannot be left.
        """
        if self.place is not None:
            return self.place
        frames = [(frame, frame.f_lineno) for frame in outwards(self._task.frame)]
        result = standing(self._task.program, reversed(frames))
        if result is None:
            raise CannotStep("the program is in a handler, a trap or an event routine")
        return result

    def next_statement(self) -> Location | None:
        """Return the statement that a start would execute next."""
        if self.place is None and self._task.frame is None:
            return None
        try:
            last = self.stack()[-1]
        except CannotStep:
            return None
        body, i = last.path[-1]
        module = last.routine.module
        assert module is not None
        return Location(module.name, last.routine.name, module.span(body[i]))

    def move_to(self, line: int) -> None:
        """Move to a statement of the innermost routine (PP to cursor).

        Raises CannotStep.
        """
        places = self.stack()
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
            self._task.program.rest(there)
        except CannotCompile as error:
            raise CannotStep(str(error)) from error
        self.place = [*places[:-1], there]

    # -- going on --------------------------------------------------------------------------------

    def go_on(self, places: Sequence[StoppedFrame]) -> None:
        """Execute the failed statement again. CannotCompile: not possible."""
        self._errors.kept_undo = []
        last = len(places) - 1
        remaining = self._task.program.rest
        rests = [(p, remaining(p, calls=i < last)) for i, p in enumerate(places)]
        self._below = rests[1:]
        rests[0][1](places[0].values)

    def go_on_below(self) -> None:
        """Continue the routine below at its next call."""
        place, remaining = self._below.pop(0)
        self.intercept(place.routine, lambda *_, **__: remaining(place.values))

    def intercept(self, routine: Routine, instead: Callable[_P, _T]) -> None:
        """Replace the next call of a routine by another function."""
        space, code = self._task.program.space, routine.code
        self._intercepted = (code, space[code])

        def once(*arguments: _P.args, **named: _P.kwargs) -> _T:
            self.not_below()
            return instead(*arguments, **named)

        space[code] = once

    def not_below(self) -> None:
        """Remove the replacements."""
        if self._intercepted is not None:
            code, function = self._intercepted
            self._intercepted = None
            self._task.program.space[code] = function
