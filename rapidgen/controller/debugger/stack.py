"""Call stacks and pointers of tasks."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from types import FrameType
from typing import Literal, TypeAlias

from rapidgen.controller.controller import VirtualController
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.resume import find
from rapidgen.runtime.compiler.symbols import CodeRole, LoadedModule, Routine
from rapidgen.runtime.errors import Location
from rapidgen.runtime.task.calls import location, outwards
from rapidgen.runtime.task.interrupts import EventRoutines, Interrupts
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Value

# -- Stacks ----------------------------------------------------------------------------------------
#
# Call stacks of tasks with what their routines hold.


Level: TypeAlias = Literal["program", "trap", "event"]
"""Cause of a routine's execution: program, interrupt, or an event such as START."""
_LEVELS: dict[object, Level] = {
    Interrupts.serve.__code__: "trap",
    EventRoutines.execute.__code__: "event",
}


@dataclass(frozen=True, slots=True, eq=False)
class StackFrame:
    """A routine of a call stack."""

    place: Location
    level: Level
    handler: str
    """`ERROR` or `UNDO` when that handler of the routine is being executed."""
    routine: Routine
    module: LoadedModule
    values: dict[str, Value]
    """Python locals, by what compiled code calls them."""
    python: FrameType | None
    """None: of a program that an error stopped, only the values are left."""
    loops: tuple[n.For, ...] = ()
    """FOR loops around the place, outermost first."""


def frames_of(task: Task) -> tuple[StackFrame, ...]:
    """Return the routines of a task, outermost first."""
    if not task.pointer.in_statement and task.pointer.place is not None:
        return tuple(_kept(task))
    return tuple(reversed(list(_live(task, task.frame))))


def where_it_looks(task: Task) -> StackFrame | None:
    """Return the innermost routine for display.

    For a task without frames it is the entry, without values.
    """
    frames = frames_of(task)
    if frames:
        return frames[-1]
    routine = task.program.find_routine(None, task.spec.entry.lower())
    if routine is None or routine.node is None or routine.module is None:
        return None
    place = Location(routine.module.name, routine.name, routine.module.span(routine.node))
    return StackFrame(place, "program", "", routine, routine.module, {}, None)


def innermost(task: Task, frame: FrameType | None) -> StackFrame:
    """Return the current routine of a running task.

    `frame` is a Python frame above it.
    """
    return next(iter(_live(task, frame)))


def depth_here(task: Task, frame: FrameType | None) -> int:
    """Return the number of nested routines above a Python frame.

    A handler counts as its routine.
    """
    codes = task.program.codes
    result = 0
    for at in outwards(frame):
        compiled = codes.get(at.f_code.co_filename)
        if compiled is not None and compiled.role(at.f_code) is CodeRole.ROUTINE:
            result += 1
    return result


def _live(task: Task, frame: FrameType | None) -> Iterable[StackFrame]:
    codes = task.program.codes
    inner: list[FrameType] = []
    """Handlers and parts of the routine whose frame comes next."""
    waiting: list[StackFrame] = []
    for at in outwards(frame):
        level = _LEVELS.get(at.f_code)
        if level is not None:
            # All frames inside this call belong to it.
            yield from (replace(known, level=level) for known in waiting)
            waiting.clear()
            continue
        compiled = codes.get(at.f_code.co_filename)
        if compiled is None:
            continue
        inner.append(at)
        if compiled.role(at.f_code) is not CodeRole.ROUTINE:
            continue
        first = inner[0]
        place = location(codes, first.f_code.co_filename, first.f_lineno)
        assert place is not None
        handler = next((r for f in inner if (r := compiled.role(f.f_code)).is_handler), None)
        values: dict[str, Value] = {}
        for part in reversed(inner):
            values.update(part.f_locals)
        token = compiled.tokens[first.f_lineno]
        loops = loops_around(compiled.routine, token)
        waiting.append(
            StackFrame(
                place,
                "program",
                handler.value if handler is not None else "",
                compiled.routine,
                compiled.module,
                values,
                at,
                loops,
            )
        )
        inner = []
    yield from waiting


def _kept(task: Task) -> Iterable[StackFrame]:
    for standing in task.pointer.place or ():
        module = standing.routine.module
        assert module is not None
        body, i = standing.path[-1]
        place = Location(module.name, standing.routine.name, module.span(body[i]))
        loops = tuple(s for b, k in standing.path if isinstance(s := b[k], n.For))
        yield StackFrame(
            place, "program", "", standing.routine, module, standing.values, None, loops
        )


def loops_around(routine: Routine, token: int) -> tuple[n.For, ...]:
    """Return the FOR loops around the statement at a token."""
    node = routine.node
    assert node is not None
    for part in (node, node.error, node.undo, node.backward):
        path = find(part.body, token) if part is not None else None
        if path is not None:
            return tuple(s for body, i in path[:-1] if isinstance(s := body[i], n.For))
    return ()


# -- Pointers --------------------------------------------------------------------------------------
#
# Program pointer and motion pointer: what a task is about to execute, and what its robot does.


def program_pointer(task: Task) -> Location | None:
    """Return a task's place in its program, None without one.

    Traps and event routines do not count.
    """
    frames = [frame for frame in frames_of(task) if frame.level == "program"]
    return frames[-1].place if frames else None


def motion_pointer(controller: VirtualController, task: str) -> Location | None:
    """Return the move instruction that a task's robot executes, or None."""
    group = controller.motion.moved_by(task)
    move = None if group is None else group.motion.move(controller.scheduler.now)
    where = None if move is None or move.place is None else move.place()
    return where if isinstance(where, Location) else None
