"""Guessed inputs that a program looks at again and again: each becomes what it looks for, in turn.

`WHILE TRUE DO IF diStart = 1 ...` waits, though no instruction says so. While a task is inside such
a loop, one of the inputs in the loop's conditions is pressed like a button for half a second, then
the next one; inputs that have to hold together are pressed together. So are outputs that programs
only read: the system or another task sets them. What an interrupt waits for is looked for wherever
the task is.
"""

import sys
from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol, cast

from rapidgen.controller.inference.name_usage import scoped
from rapidgen.controller.inference.wait_conditions import (
    NEGATED,
    RELATIONS,
    SWAPPED,
    Term,
    WaitCondition,
)
from rapidgen.machine.io import IOSystem, Relation, SignalCondition
from rapidgen.machine.scheduler import S, Scheduler
from rapidgen.rapid.binding import ModuleScope, constant
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.task.calls import stack_at
from rapidgen.runtime.task.task import Task

if TYPE_CHECKING:
    from rapidgen.controller.inference.dialog_answers import Said

_HELD = 0.5
"""Seconds that an input is pressed."""
_READING = frozenset(("dinput", "ginput", "ainput", "testdi", "doutput", "goutput", "aoutput"))
Wanted = tuple[str, Relation, float]
"""Lower-case name of a signal, relation and value."""


@dataclass(frozen=True, slots=True)
class PolledSignals:
    """Comparisons of signals in a loop (lines of its module) that hold together."""

    module: str
    first: int
    last: int
    wanted: tuple[Wanted, ...]


def polled(looks: Iterable[WaitCondition], given: Collection[str]) -> Iterator[PolledSignals]:
    """All that are of `given` signals, by lower-case name."""
    for look in looks:
        result = (one for term in look.terms for one in _compared(term))
        expected = tuple(dict.fromkeys(one for one in result if one[0] in given))
        if expected:
            yield PolledSignals(look.module, look.first, look.last, expected)


def _compared(term: Term) -> Iterator[Wanted]:
    node, holds, scope = term
    if isinstance(node, n.FunctionCall) and node.name.lower() == "testdi":
        yield _signal(node), "=", float(holds)
    elif isinstance(node, n.Binary) and node.operator in RELATIONS:
        for one, other, relation in (
            (node.left, node.right, node.operator),
            (node.right, node.left, SWAPPED.get(node.operator, node.operator)),
        ):
            name, value = _signal(one), constant(other, scope)
            if name and isinstance(value, int | float):
                yield name, cast(Relation, relation if holds else NEGATED[relation]), value


def _signal(node: n.Node) -> str:
    if isinstance(node, n.FunctionCall) and node.name.lower() in _READING and node.arguments:
        node = node.arguments[0].value or node
    return node.name.casefold() if isinstance(node, n.Name) else ""


def passed_arguments(module: ModuleScope) -> Iterator[str]:
    """Lower-case names that a module gives to instructions: of outputs, those that it sets."""
    for node, _ in scoped(module):
        if isinstance(node, n.LateCall) or (
            isinstance(node, n.ProcedureCall | n.FunctionCall)
            and node.name.lower() not in _READING
            and not node.name.lower().startswith(("wait", "isignal"))
        ):
            yield from (_signal(a.value) for a in node.arguments if isinstance(a.value, n.Name))


class Polling(Protocol):
    """A controller whose tasks poll."""

    io: IOSystem
    scheduler: Scheduler
    rapid_tasks: dict[str, Task]


class InputSetter:
    """Presses the inputs that tasks look for, one after the other."""

    def __init__(
        self, controller: Polling, rows: tuple[PolledSignals, ...], message: "list[Said]"
    ) -> None:
        self._controller = controller
        self._rows = rows
        self._said = message
        self._turn = 0
        self._pressed: list[tuple[str, float]] = []
        self._next()

    def _next(self) -> None:
        self._controller.scheduler.after(round(_HELD * S), self._press)

    def _press(self) -> None:
        io, scheduler = self._controller.io, self._controller.scheduler
        for pressed, before in self._pressed:
            io.set(io[pressed], before)
        self._pressed = []
        rows = [row for task in self._running() for row in self._of(task)]
        for _ in rows:
            row = rows[self._turn % len(rows)]
            self._turn += 1
            for name, relation, expected in row.wanted:
                awaited = SignalCondition(io[name], relation, expected)
                value = awaited.fulfilling()
                if value is not None and not awaited.holds():
                    self._pressed.append((awaited.signal.name, awaited.signal.value))
                    self._said.append((awaited.signal.name, value))
                    io.set(awaited.signal, value)
            if self._pressed:
                break
        # Where every task waits and nothing is ahead, the program waits for ever.
        waits = all(task.waits_for is not None for task in self._running())
        if not waits or scheduler.next_event() is not None:
            self._next()

    def _running(self) -> Iterator[Task]:
        return (t for t in self._controller.rapid_tasks.values() if t.state == "running")

    def _of(self, task: Task) -> list[PolledSignals]:
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
