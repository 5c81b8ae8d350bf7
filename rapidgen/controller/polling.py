"""Guessed inputs that a program looks at again and again: each becomes what it looks for, in turn.

`WHILE TRUE DO IF diStart = 1 ...` waits, though no instruction says so. While a task is inside such
a loop, one of the inputs in the loop's conditions is pressed like a button for half a second, then
the next one.
"""

import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol, cast, get_args

from rapidgen.machine.io import Awaited, IOSystem, Relation
from rapidgen.machine.scheduler import S, Scheduler
from rapidgen.rapid.binding import ModuleScope, RoutineScope, constant
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk
from rapidgen.runtime.task.call_stack import stack_at
from rapidgen.runtime.task.task import Task

if TYPE_CHECKING:
    from rapidgen.controller.answering import Said

_HELD = 0.5
"""Seconds that an input is pressed."""
_READING = frozenset(("dinput", "ginput", "ainput", "testdi"))
_SWAPPED: Mapping[str, str] = {"<": ">", ">": "<", "<=": ">=", ">=": "<="}


@dataclass(frozen=True, slots=True)
class Polled:
    """A comparison of a signal in a condition inside a loop (lines of its module)."""

    module: str
    first: int
    last: int
    signal: str
    relation: Relation
    value: float


def polled(scope: ModuleScope, entry: str) -> Iterator[Polled]:
    """All of a module. The routine that a task starts in is a loop: it is executed in cycles."""
    source = scope.tree.source
    for routine in scope.tree.routines:
        inside = scope.routine(routine)
        for loop in walk(routine):
            cycle = loop is routine and routine.name.lower() == entry.lower()
            if not cycle and not isinstance(loop, n.While):
                continue
            lines = source.line(loop.first), source.line(loop.last)
            for node in walk(loop):
                for signal, relation, value in _compared(node, inside):
                    yield Polled(scope.tree.name.lower(), *lines, signal, relation, value)


def _compared(node: n.Node, scope: RoutineScope) -> Iterator[tuple[str, Relation, float]]:
    match node:
        case n.Binary() if node.operator in get_args(Relation):
            for one, other, relation in (
                (node.left, node.right, node.operator),
                (node.right, node.left, _SWAPPED.get(node.operator, node.operator)),
            ):
                name, value = _signal(one), constant(other, scope)
                if name and isinstance(value, int | float):
                    yield name, cast(Relation, relation), value
        case n.Test():
            for case in node.cases:
                for value in (constant(v, scope) for v in case.values):
                    if _signal(node.subject) and isinstance(value, int | float):
                        yield _signal(node.subject), "=", value
        case n.FunctionCall() if node.name.lower() == "testdi":
            yield _signal(node), "=", 1


def _signal(node: n.Node) -> str:
    if isinstance(node, n.FunctionCall) and node.name.lower() in _READING and node.arguments:
        node = node.arguments[0].value or node
    return node.name.casefold() if isinstance(node, n.Name) else ""


class Polling(Protocol):
    """A controller whose tasks poll."""

    io: IOSystem
    scheduler: Scheduler
    rapid_tasks: dict[str, Task]


class Buttons:
    """Presses the inputs that tasks look for, one after the other."""

    def __init__(self, controller: Polling, rows: tuple[Polled, ...], said: "list[Said]") -> None:
        self._controller = controller
        self._rows = rows
        self._said = said
        self._turn = 0
        self._pressed: tuple[str, float] | None = None
        self._next()

    def _next(self) -> None:
        self._controller.scheduler.after(round(_HELD * S), self._press)

    def _press(self) -> None:
        io, scheduler = self._controller.io, self._controller.scheduler
        if self._pressed is not None:
            name, before = self._pressed
            io.set(io[name], before)
            self._pressed = None
        rows = [row for task in self._running() for row in self._of(task)]
        for _ in rows:
            row = rows[self._turn % len(rows)]
            self._turn += 1
            awaited = Awaited(io[row.signal], row.relation, row.value)
            value = awaited.fulfilling()
            if value is not None and not awaited.holds():
                self._pressed = (row.signal, awaited.signal.value)
                self._said.append((awaited.signal.name, value))
                io.set(awaited.signal, value)
                break
        # Where every task waits and nothing is ahead, the program waits for ever.
        waits = all(task.waits_for is not None for task in self._running())
        if not waits or scheduler.next_event() is not None:
            self._next()

    def _running(self) -> Iterator[Task]:
        return (t for t in self._controller.rapid_tasks.values() if t.state == "running")

    def _of(self, task: Task) -> list[Polled]:
        """What a task looks for in the loop that it is in, the innermost first."""
        if task.waits_for is not None:
            return []
        # Time passes in the middle of its statements: then this is called by the task itself.
        stack = stack_at(task.program.codes, task.frame or sys._getframe())
        places = [(at.module.lower(), at.span.line) for at in reversed(stack)]
        return [
            row
            for module, line in places
            for row in self._rows
            if row.module == module and row.first <= line <= row.last
        ]
