"""Data that a program looks at again and again, and that nothing in it makes what it looks for: a
panel, a client of web services or a task in no file would. In a guessed cell each is set in turn,
and together what has to hold together.

`WaitUntil bStart;` and `WHILE TRUE DO IF nOrder = 3 ...` wait for such data. While a task is at
such a place, or in the loop around it, one of them becomes what is looked for, for a second where
the program never writes it, and for good where it does: then it takes it back by itself. Of what is
only copied from another datum, that one is set.
"""

import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final, Protocol

from rapidgen.controller.inference.name_usage import passed, scoped
from rapidgen.controller.inference.wait_conditions import (
    NEGATED,
    RELATIONS,
    SWAPPED,
    Term,
    WaitCondition,
)
from rapidgen.machine.scheduler import S, Scheduler
from rapidgen.rapid.binding import DataSymbol, ModuleScope, RoutineSymbol, Scope, constant
from rapidgen.rapid.binding.names import called
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.task.calls import stack_at
from rapidgen.runtime.task.task import Task

if TYPE_CHECKING:
    from rapidgen.controller.inference.dialog_answers import Said
    from rapidgen.controller.views import TaskView

_HELD: Final = 0.5
"""Seconds between two data that are set."""
_TURNS: Final = 2
"""Of them, for which a datum keeps what it was set to."""
_MOST: Final = 200
"""Times that data are set."""
GUESSED_DATA: Final = "cell_data"
"""The module that guessed data are in."""
_KINDS: Final[Mapping[type, tuple[str, ...]]] = {bool: ("bool",), str: ("string",)}
_ANY: Final = (False, 0.0, "")
_WATCHING: Final = frozenset(("ipers",))
"""What takes a persistent and leaves it as it is."""
Plain = bool | float | str


@dataclass(frozen=True, slots=True)
class Adjusted:
    """What a datum becomes, and whether the program writes it otherwise."""

    owner: str
    """Module that declares it."""
    name: str
    value: Plain
    written: bool = False


@dataclass(frozen=True, slots=True)
class PolledData:
    """Data that are looked at together in lines of a module, and what for."""

    task: str
    module: str
    first: int
    last: int
    sets: tuple[Adjusted, ...]


def flags(
    task: str,
    scopes: Iterable[ModuleScope],
    looks: Iterable[WaitCondition],
    made: Mapping[str, str],
) -> Iterator[PolledData]:
    """All that the modules of a task look at. `made` are the types of data that are guessed, by
    lower-case name."""
    written: dict[str, set[object]] = {}
    for scope in scopes:
        for name, value in _written(scope, made):
            written.setdefault(name, set()).add(value)
    for look in looks:
        expected = [one for term in look.terms for one in _wanted(term, made)]
        known = {one.name.casefold(): one for one in (_given(s, written) for s in expected) if one}
        if known:
            yield PolledData(task, look.module, look.first, look.last, tuple(known.values()))


def _given(one: Adjusted, written: Mapping[str, set[object]]) -> Adjusted | None:
    """What nothing in the program gives; of what only copies another datum, that one."""
    values = written.get(one.name.casefold(), set())
    copied = [value for value in values if isinstance(value, Adjusted)]
    if len(copied) == 1:
        source = copied[0].name.casefold()
        values = values - {copied[0]} | written.get(source, set())
        one = replace(copied[0], value=one.value)
        values = {None if isinstance(value, Adjusted) else value for value in values}
    if None in values or one.value in values:
        return None
    return replace(one, written=bool(written.get(one.name.casefold())))


def _wanted(term: Term, made: Mapping[str, str]) -> Iterator[Adjusted]:
    """A plain datum in a comparison, and what makes it hold or not."""
    node, holds, scope = term
    if isinstance(node, n.Name):
        yield from _set(node, scope, holds, made)
    elif isinstance(node, n.Binary) and node.operator in RELATIONS:
        for one, other, relation in (
            (node.left, node.right, node.operator),
            (node.right, node.left, SWAPPED.get(node.operator, node.operator)),
        ):
            value = constant(other, scope)
            if isinstance(one, n.Name) and isinstance(value, bool | int | float | str):
                expected = _making(relation if holds else NEGATED[relation], value)
                if expected is not None:
                    yield from _set(one, scope, expected, made)


def _making(operator: str, value: Plain) -> Plain | None:
    """What a datum becomes so that its comparison with a value holds."""
    if operator in ("=", ">=", "<="):
        return value
    if isinstance(value, bool):
        return not value if operator == "<>" else None
    if isinstance(value, str):
        return "x" if operator == "<>" else None
    return value - 1 if operator == "<" else value + 1


def _set(name: n.Name, scope: Scope, value: Plain, made: Mapping[str, str]) -> Iterator[Adjusted]:
    """Nothing where the name is no variable or persistent of a plain type."""
    symbol = scope.find(name.name)
    if symbol is None:
        owner, kind = GUESSED_DATA, made.get(name.name.casefold(), "")
    elif isinstance(symbol, DataSymbol) and symbol.kind in ("VAR", "PERS") and symbol.module:
        if symbol.routine is not None:
            return
        owner, kind = symbol.module.tree.name.lower(), symbol.module.base(symbol.type) or ""
    else:
        return
    if kind in (_KINDS.get(type(value)) or ("num", "dnum")):
        yield Adjusted(owner, name.name, value)


def _written(module: ModuleScope, made: Mapping[str, str]) -> Iterator[tuple[str, object]]:
    """Names that a module writes, and what: a constant, a copied datum (Adjusted), or something
    else (None)."""
    for node, scope in scoped(module):
        match node:
            case n.Assignment() if isinstance(node.target, n.Name):
                value: object = constant(node.value, scope)
                if value is None and isinstance(node.value, n.Name):
                    value = next((s for v in _ANY for s in _set(node.value, scope, v, made)), None)
                yield node.target.name.casefold(), value
            case n.ProcedureCall() | n.FunctionCall() if node.name.lower() not in _WATCHING:
                routine = called(scope.find(node.name))
                if isinstance(routine, RoutineSymbol):
                    for one, _, mode in passed(node.arguments, routine, scope):
                        if mode and isinstance(one, n.Name):
                            yield one.name.casefold(), None


class HasPolledData(Protocol):
    """A controller whose tasks look at data."""

    scheduler: Scheduler
    rapid_tasks: dict[str, Task]

    def task(self, name: str) -> "TaskView":
        """One task."""


class DataSetter:
    """Sets the data that tasks look for, one after the other."""

    def __init__(
        self, controller: HasPolledData, rows: tuple[PolledData, ...], message: "list[Said]"
    ) -> None:
        self._controller = controller
        self._rows = rows
        self._said = message
        self._looks = 0
        self._turn = 0
        self._held: dict[tuple[str, str], tuple[Plain, int]] = {}
        self._next()

    def _next(self) -> None:
        if self._looks < _MOST:
            self._looks += 1
            self._controller.scheduler.after(round(_HELD * S), self._look)

    def _look(self) -> None:
        for (task_name, name), (before, look) in list(self._held.items()):
            if self._looks - look >= _TURNS:
                self._controller.task(task_name)[name] = before
                del self._held[task_name, name]
        tasks = [t for t in self._controller.rapid_tasks.values() if t.state == "running"]
        rows = [row for task in tasks for row in self._around(task)]
        for _ in rows:
            row = rows[self._turn % len(rows)]
            self._turn += 1
            if self._set(row):
                break
        if tasks:
            self._next()

    def _set(self, row: PolledData) -> bool:
        """Whether anything was not so yet."""
        changed, task = False, self._controller.task(row.task)
        for one in row.sets:
            name = f"{one.owner}:{one.name}"
            before = task[name]
            if before != one.value:
                changed = True
                if not one.written:
                    first = self._held.get((row.task, name), (before, 0))[0]
                    self._held[row.task, name] = first, self._looks
                task[name] = one.value
                value = str(one.value).upper() if isinstance(one.value, bool) else f"{one.value}"
                self._said.append((one.name, value))
        return changed

    def _around(self, task: Task) -> list[PolledData]:
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
