"""Where a stopped program stands when nothing of it is being executed any more.

After an error without a handler the program pointer is at the faulty statement, which Start tries
again [S4 overview 3-23]. The frames are gone then: what they held is kept, and the rest of each
routine is compiled anew (compiler/resume.py). Routines that the error left are not aborted: their
UNDO handlers run when the program pointer is moved.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from types import FrameType, TracebackType
from typing import Any

from rapidgen.runtime.compiler.compiled import Role
from rapidgen.runtime.compiler.program import Program
from rapidgen.runtime.compiler.resume import Standing, find
from rapidgen.runtime.compiler.symbols import Routine
from rapidgen.runtime.errors import RECOVERABLE, FatalError
from rapidgen.runtime.task.task import Task

LARGEST_STACK = 100
"""Routines inside each other that are kept."""
_OTHER_LEVELS = frozenset({"_serve_traps", "_run_event"})


def frames_of(traceback: TracebackType | None) -> Iterator[tuple[FrameType, int]]:
    """Frames and lines of a traceback, outermost first."""
    while traceback is not None:
        yield traceback.tb_frame, traceback.tb_lineno
        traceback = traceback.tb_next


def standing(program: Program, frames: Iterable[tuple[FrameType, int]]) -> list[Standing] | None:
    """Where the routines of frames are, outermost first.

    None when the program cannot go on there: in a handler, a trap or an event routine, or too
    deep inside.
    """
    found: dict[int, Standing] = {}
    for frame, line in frames:
        compiled = program.codes.get(frame.f_code.co_filename)
        name = frame.f_code.co_name
        if name in _OTHER_LEVELS:
            return None
        if compiled is None or not 0 <= line < len(compiled.tokens):
            continue
        role = compiled.role(frame.f_code)
        if role.is_handler:
            return None
        assert compiled.routine.node is not None
        path = find(compiled.routine.node.body, compiled.tokens[line])
        if path is None:
            return None
        key, values = id(frame), dict(frame.f_locals)
        if role is Role.PART:
            key = list(found)[-1]
            values = {**found[key].values, **values}
        found[key] = Standing(compiled.routine, path, values)
    return list(found.values()) if 0 < len(found) <= LARGEST_STACK else None


class Pointer(Task):
    """The part of a task that keeps its place."""

    def __init__(self, *arguments: Any) -> None:  # noqa: ANN401 - those of Task
        super().__init__(*arguments)
        self.place: list[Standing] | None = None
        """Where an error stopped the program; None: it starts from main only."""
        self._below: list[tuple[Standing, Callable[[dict[str, Any]], Any]]] = []
        self._intercepted: tuple[str, Any] | None = None
        self._kept_undo: list[Callable[[], int]] = []

    @property
    def keeps_place(self) -> bool:
        """Whether a start after an error tries the faulty statement again."""
        raise NotImplementedError

    def keep_undo(self, handler: Callable[[], int]) -> bool:
        """Leave an UNDO handler for later: the error that leaves its routine stops the program."""
        if not self.keeps_place:
            return False
        self._kept_undo.append(handler)
        return True

    def keep_place(self, fatal: FatalError, raised: BaseException) -> None:
        """Remember where an error stopped the program, or leave all its routines for good."""
        self.not_below()
        self._below = []
        self.place = None
        if self.keeps_place and fatal.restartable:
            self.place = standing(self.program, frames_of(raised.__traceback__))
        if self.place is None:
            self.leave_place()

    def leave_place(self) -> None:
        """The program pointer is moved: UNDO handlers of the routines, the innermost first."""
        self.place = None
        handlers, self._kept_undo = self._kept_undo, []
        for handler in handlers:
            self.undo_level += 1
            try:
                handler()
            except FatalError as error:
                self.undo_ended(error)
                break
            except RECOVERABLE as error:
                self.undo_ended(self.unhandled(error))
                if self.controller.dialect.undo_error == "stop":
                    break
            finally:
                self.undo_level -= 1
        self._kept_undo = []

    def go_on(self, places: Sequence[Standing]) -> None:
        """Try the statement again where the program stands. CannotCompile: not from there."""
        self._kept_undo = []
        last = len(places) - 1
        rests = [(p, self.program.rest(p, calls=i < last)) for i, p in enumerate(places)]
        self._below = rests[1:]
        rests[0][1](places[0].values)

    def go_on_below(self) -> None:
        """The next call of the routine below goes on with it instead."""
        place, rest = self._below.pop(0)
        self.intercept(place.routine, lambda *_, **__: rest(place.values))

    def intercept(self, routine: Routine, instead: Callable[..., Any]) -> None:
        """Let the next call of a routine do something else."""
        space, code = self.program.space, routine.code
        self._intercepted = (code, space[code])

        def once(*arguments: Any, **named: Any) -> Any:  # noqa: ANN401
            self.not_below()
            return instead(*arguments, **named)

        space[code] = once

    def not_below(self) -> None:
        """Calls are ordinary again."""
        if self._intercepted is not None:
            code, function = self._intercepted
            self._intercepted = None
            self.program.space[code] = function
