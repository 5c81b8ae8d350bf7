"""Data that a program looks at again and again, and that nothing in it makes what it looks for: a
panel, a client of web services or a task in no file would. In a guessed cell each is set in turn.

`WaitUntil bStart;` and `WHILE TRUE DO IF nOrder = 3 ...` wait for such data. While a task is at
such a place, or in the loop around it, one of them becomes what is looked for, for half a second
where the program never writes it, and for good where it does: then it takes it back by itself.
"""

import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final, Protocol

from rapidgen.controller.uses import passed, scoped
from rapidgen.machine.scheduler import S, Scheduler
from rapidgen.rapid.binding import DataSymbol, ModuleScope, RoutineSymbol, Scope, constant
from rapidgen.rapid.binding.names import called
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk
from rapidgen.runtime.task.call_stack import stack_at
from rapidgen.runtime.task.task import Task
from rapidgen.system.model import TaskSpec

if TYPE_CHECKING:
    from rapidgen.controller.answering import Said
    from rapidgen.controller.views import TaskView

_HELD: Final = 0.5
"""Seconds that a datum keeps what it was set to, and between two of them."""
_MOST: Final = 200
"""Times that data are set."""
GUESSED_DATA: Final = "cell_data"
"""The module that guessed data are in."""
_TYPES: Final = frozenset(("bool", "num", "dnum", "string"))
_LOGICAL: Final = frozenset(("AND", "OR", "XOR"))
Plain = bool | float | str


@dataclass(frozen=True, slots=True)
class Flag:
    """A datum that is looked at in lines of a module, what for, and whether the program writes it
    otherwise."""

    task: str
    module: str
    first: int
    last: int
    owner: str
    """Module that declares it."""
    name: str
    value: Plain
    written: bool = False


def flags(task: TaskSpec, scopes: Sequence[ModuleScope], made: Mapping[str, str]) -> Iterator[Flag]:
    """All of the modules of a task; the routine that it starts in is a loop. `made` are the types
    of data that are guessed, by lower-case name."""
    found = dict.fromkeys(flag for scope in scopes for flag in _looked_at(scope, task, made))
    written: dict[str, set[object]] = {}
    for scope in scopes:
        for name, value in _written(scope):
            written.setdefault(name, set()).add(value)
    for flag in found:
        values = written.get(flag.name.casefold(), set())
        if None not in values and flag.value not in values:
            yield replace(flag, written=bool(values))


def _looked_at(module: ModuleScope, task: TaskSpec, made: Mapping[str, str]) -> Iterator[Flag]:
    source = module.tree.source
    for routine in module.tree.routines:
        scope = module.routine(routine)
        for loop in walk(routine):
            cycle = loop is routine and routine.name.lower() == task.entry.lower()
            waits = isinstance(loop, n.ProcedureCall) and loop.name.lower() == "waituntil"
            if not (cycle or waits or isinstance(loop, n.While)):
                continue
            lines = source.line(loop.first), source.line(loop.last)
            for node in walk(loop):
                for condition in _conditions(node):
                    for name, value in _wanted(condition, scope, True):
                        owner = _owner(name, scope, made)
                        if owner:
                            here = task.name, module.tree.name.lower(), *lines
                            yield Flag(*here, owner, name.name, value)


def _conditions(node: n.Node) -> Iterator[n.Expression]:
    match node:
        case n.Branch() | n.CompactIf() | n.While():
            yield node.condition
        case n.ProcedureCall() if node.name.lower() == "waituntil":
            yield from (a.value for a in node.arguments if a.kind == "required" and a.value)
        case n.Test():
            for case in node.cases:
                for value in case.values:
                    yield n.Binary(node.first, node.last, "=", node.subject, value)


def _wanted(node: n.Expression, scope: Scope, holds: bool) -> Iterator[tuple[n.Name, Plain]]:
    """Names in a condition, and what makes it hold."""
    match node:
        case n.Name():
            yield node, holds
        case n.Unary() if node.operator == "NOT":
            yield from _wanted(node.operand, scope, not holds)
        case n.Binary() if node.operator in _LOGICAL:
            yield from _wanted(node.left, scope, holds)
            yield from _wanted(node.right, scope, holds)
        case n.Binary() if node.operator in ("=", "<>", ">", "<", ">=", "<="):
            value = constant(node.right, scope)
            if isinstance(node.left, n.Name) and isinstance(value, bool | int | float | str):
                made = _making(node.operator, value)
                if made is not None:
                    yield node.left, made


def _making(operator: str, value: Plain) -> Plain | None:
    """What a datum becomes so that its comparison with a value holds."""
    if operator in ("=", ">=", "<="):
        return value
    if isinstance(value, bool):
        return not value if operator == "<>" else None
    if isinstance(value, str):
        return "x" if operator == "<>" else None
    return value - 1 if operator == "<" else value + 1


def _owner(name: n.Name, scope: Scope, made: Mapping[str, str]) -> str:
    """The module that declares a variable or persistent of a plain type; empty: it is no such."""
    symbol = scope.find(name.name)
    if symbol is None:
        return GUESSED_DATA if made.get(name.name.casefold()) in _TYPES else ""
    if not isinstance(symbol, DataSymbol) or symbol.routine is not None or symbol.module is None:
        return ""
    kind = symbol.module.base(symbol.type or "") or ""
    plain = symbol.kind in ("VAR", "PERS") and kind in _TYPES
    return symbol.module.tree.name.lower() if plain else ""


def _written(module: ModuleScope) -> Iterator[tuple[str, object]]:
    """Names that a module writes, and the constants that it writes (None: something else)."""
    for node, scope in scoped(module):
        match node:
            case n.Assignment() if isinstance(node.target, n.Name):
                yield node.target.name.casefold(), constant(node.value, scope)
            case n.ProcedureCall() | n.FunctionCall():
                routine = called(scope.find(node.name))
                if isinstance(routine, RoutineSymbol):
                    for one, _, mode in passed(node.arguments, routine, scope):
                        if mode and isinstance(one, n.Name):
                            yield one.name.casefold(), None


class Looking(Protocol):
    """A controller whose tasks look at data."""

    scheduler: Scheduler
    rapid_tasks: dict[str, Task]

    def task(self, name: str) -> "TaskView":
        """One task."""


class Flags:
    """Sets the data that tasks look for, one after the other."""

    def __init__(self, controller: Looking, rows: tuple[Flag, ...], said: "list[Said]") -> None:
        self._controller = controller
        self._rows = rows
        self._said = said
        self._looks = 0
        self._turn = 0
        self._held: tuple[Flag, Plain] | None = None
        self._next()

    def _next(self) -> None:
        if self._looks < _MOST:
            self._looks += 1
            self._controller.scheduler.after(round(_HELD * S), self._look)

    def _look(self) -> None:
        if self._held is not None:
            self._put(*self._held)
            self._held = None
        tasks = [t for t in self._controller.rapid_tasks.values() if t.state == "running"]
        rows = [row for task in tasks for row in self._around(task)]
        for _ in rows:
            row = rows[self._turn % len(rows)]
            self._turn += 1
            before = self._controller.task(row.task)[f"{row.owner}:{row.name}"]
            if before != row.value:
                if not row.written:
                    self._held = row, before
                self._put(row, row.value)
                shown = str(row.value).upper() if isinstance(row.value, bool) else f"{row.value}"
                self._said.append((row.name, shown))
                break
        if tasks:
            self._next()

    def _put(self, row: Flag, value: Plain) -> None:
        self._controller.task(row.task)[f"{row.owner}:{row.name}"] = value

    def _around(self, task: Task) -> list[Flag]:
        """What a task looks for where it is, the innermost first."""
        waits = task.waits_for is not None
        stack = (
            task.stack() if waits else stack_at(task.program.codes, task.frame or sys._getframe())
        )
        places = [(at.module.lower(), at.span.line) for at in reversed(stack)]
        return [
            row
            for module, line in places[: 1 if waits else len(places)]
            for row in self._rows
            if row.task == task.name and row.module == module and row.first <= line <= row.last
        ]
