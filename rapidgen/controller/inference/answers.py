"""Answers to a foreign program: dialogs, polled signals and data."""

import sys
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import product
from typing import TYPE_CHECKING, Final, Protocol, cast, get_args

from rapidgen.controller.inference.names import passed, scoped, stub_datum
from rapidgen.machine.io import IOSystem, Relation, SignalCondition
from rapidgen.machine.operator import Operator, Question
from rapidgen.machine.scheduler import S, Scheduler
from rapidgen.rapid.binding import (
    DataSymbol,
    ModuleScope,
    RoutineScope,
    RoutineSymbol,
    Scope,
    constant,
)
from rapidgen.rapid.binding.names import called
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import children, walk
from rapidgen.runtime.task.calls import stack_at
from rapidgen.runtime.task.task import Task

if TYPE_CHECKING:
    from rapidgen.controller.views import TaskView


# -- Conditions of waits ---------------------------------------------------------------------------
#
# Conditions that a program looks at again and again, each as what has to hold together.
#
# `IF diDoor = 1 AND bAuto THEN IF nOrder = 3 ...` inside a loop needs three things at once. What is
# looked at in the routines that a loop calls is looked at by the loop.


Term = tuple[n.Expression, bool, RoutineScope]
"""A comparison or name, its expected truth, and its scope."""
Terms = tuple[Term, ...]


@dataclass(frozen=True, slots=True)
class WaitCondition:
    """A condition that a loop needs as a whole, by the lines of its module."""

    module: str
    first: int
    last: int
    terms: Terms


RELATIONS = frozenset(get_args(Relation))
NEGATED: Mapping[str, str] = {"=": "<>", "<>": "=", "<": ">=", ">=": "<", ">": "<=", "<=": ">"}
SWAPPED: Mapping[str, str] = {"<": ">", ">": "<", "<=": ">=", ">=": "<="}
_ORDERING = frozenset(
    ("isignaldi", "isignaldo", "isignalgi", "isignalgo", "isignalai", "isignalao", "ipers")
)
"""Instructions that order interrupts for a signal or a persistent."""
_WAYS = 8
"""Of one condition."""


def wait_conditions(task: Sequence[ModuleScope], entry: str) -> Iterator[WaitCondition]:
    """Iterate over the conditions of each loop in a task's modules.

    Conditions of loop exits come last. The entry routine counts as a loop: it is executed in
    cycles, and interrupts wait in it. WaitUntil also counts.
    """
    for module in task:
        for first, last, terms in _loops(module, entry, task):
            yield WaitCondition(module.tree.name.lower(), first, last, terms)


def _loops(
    module: ModuleScope, entry: str, task: Sequence[ModuleScope]
) -> Iterator[tuple[int, int, Terms]]:
    source = module.tree.source
    for routine in module.tree.routines:
        scope = module.routine(routine)
        for loop in walk(routine):
            cycle = loop is routine and routine.name.lower() == entry.lower()
            if cycle or _is_wait(loop) or isinstance(loop, n.While):
                lines = source.line(loop.first), source.line(loop.last)
                for terms in _inside(loop, scope, (), {routine.name.lower()}):
                    yield *lines, terms
                if cycle:
                    for terms in (one for other in task for one in _interrupts(other)):
                        yield *lines, terms
                if isinstance(loop, n.While):
                    for terms in _ways(loop.condition, scope, holds=False):
                        yield *lines, terms


def _interrupts(module: ModuleScope) -> Iterator[Terms]:
    """Iterate over conditions of interrupts, and of their traps."""
    traps: dict[str, str] = {}
    for node, scope in scoped(module):
        if isinstance(node, n.Connect) and isinstance(node.target, n.Name):
            traps[node.target.name.casefold()] = node.trap
        if not isinstance(node, n.ProcedureCall) or node.name.lower() not in _ORDERING:
            continue
        given = [a.value for a in node.arguments if a.kind == "required" and a.value]
        if given and isinstance(given[-1], n.Name) and isinstance(scope, RoutineScope):
            term: n.Expression = given[0]
            if node.name.lower() != "ipers":
                one = n.NumberLiteral(node.first, node.last, 1, "1")
                term = n.Binary(node.first, node.last, "=", term, one)
            first = ((term, True, scope),)
            yield first
            trap = called(scope.find(traps.get(given[-1].name.casefold(), "")))
            if isinstance(trap, RoutineSymbol) and trap.node is not None and trap.module:
                yield from _inside(trap.node, trap.module.routine(trap.node), first, set())


def _is_wait(node: n.Node) -> bool:
    return isinstance(node, n.ProcedureCall) and node.name.lower() == "waituntil"


def _inside(node: n.Node, scope: RoutineScope, around: Terms, known: set[str]) -> Iterator[Terms]:
    """Iterate over conditions in a node; `around` are those it is in."""
    condition, guarded = _condition(node)
    if condition is not None:
        ways = _ways(condition, scope, holds=True)
        yield from (around + way for way in ways)
        inside = around + (ways[0] if ways else ())
        yield from _called(condition, scope, around, known)
        for statement in guarded:
            yield from _inside(statement, scope, inside, known)
        return
    if isinstance(node, n.Binary) and node.operator in RELATIONS:
        yield (*around, (node, True, scope))
    elif isinstance(node, n.Test):
        for case in node.cases:
            one = [n.Binary(v.first, v.last, "=", node.subject, v) for v in case.values]
            yield from ((*around, (term, True, scope)) for term in one)
            inside = (*around, (one[0], True, scope)) if one else around
            for child in case.body:
                yield from _inside(child, scope, inside, known)
        for child in node.default or ():
            yield from _inside(child, scope, around, known)
        return
    yield from _called(node, scope, around, known)
    inner = scope.loop(node) if isinstance(node, n.For) else scope
    for part in children(node):
        yield from _inside(part, inner, around, known)


def _condition(node: n.Node) -> tuple[n.Expression | None, list[n.Statement]]:
    """Return the condition of a node, and the statements it guards."""
    match node:
        case n.Branch() | n.While():
            return node.condition, node.body
        case n.CompactIf():
            return node.condition, [node.statement]
        case n.Return() if node.value is not None:
            return node.value, []
        case n.ProcedureCall() if _is_wait(node):
            given = (a.value for a in node.arguments if a.kind == "required")
            return next(given, None), []
    return None, []


def _called(node: n.Node, scope: RoutineScope, around: Terms, known: set[str]) -> Iterator[Terms]:
    """Iterate over conditions in routines that a node calls.

    It covers calls of the node itself, and of expressions completely.
    """
    for one in walk(node) if isinstance(node, n.Expression) else (node,):
        if isinstance(one, n.ProcedureCall | n.FunctionCall) and one.name.lower() not in known:
            routine = called(scope.find(one.name))
            if isinstance(routine, RoutineSymbol) and routine.node is not None and routine.module:
                known.add(one.name.lower())
                inside = routine.module.routine(routine.node)
                yield from _inside(routine.node, inside, around, known)


def _ways(node: n.Expression, scope: RoutineScope, *, holds: bool) -> list[Terms]:
    """Return alternatives of terms that make a condition true or false."""
    match node:
        case n.Parenthesis():
            return _ways(node.inner, scope, holds=holds)
        case n.Unary() if node.operator == "NOT":
            return _ways(node.operand, scope, holds=not holds)
        case n.Binary() if node.operator in ("AND", "OR", "XOR"):
            left, right = (_ways(e, scope, holds=holds) for e in (node.left, node.right))
            if (node.operator == "AND") is holds and node.operator != "XOR":
                return [a + b for a, b in product(left, right)][:_WAYS]
            return (left + right)[:_WAYS]
    return [((node, holds, scope),)]


# -- Dialogs ---------------------------------------------------------------------------------------
#
# Dialogs in an inferred cell, without an operator. Each answer is one of the possible choices in
# turn.
#
# The first answer to a question is its default, or the first choice. Each further question of the
# same task with the same text receives the next choice, so that a program passes through all items
# of a menu. Without a default and choices the answers are small numbers.


Answer = tuple[str, float | str]
"""An inferred input or a dialog with its text, and the value it received."""
_THOUGHT: Final = 0.5
"""Seconds that a question stays on the screen."""
_NUMBERS: Final = (*(str(n) for n in range(1, 11)), "0", "100")


class DialogResponder:
    """Answers the dialogs of one controller.

    `message` receives (dialog and text, answer).
    """

    def __init__(self, operator: Operator, scheduler: Scheduler, message: list[Answer]) -> None:
        self._operator = operator
        self._scheduler = scheduler
        self._answers = message
        self._seen: set[int] = set()
        self._turns: Counter[tuple[object, ...]] = Counter()
        operator.attach()
        operator.asked.add(self._look)

    def _look(self) -> None:
        for question in self._operator.questions:
            if question.number not in self._seen:
                self._seen.add(question.number)
                self._scheduler.after(round(_THOUGHT * S), partial(self._give, question))

    def _give(self, question: Question) -> None:
        if question not in self._operator.questions:
            return
        key = (question.task, question.dialog, question.text, question.choices)
        answers = _answers(question)
        for _ in answers:
            answer = answers[self._turns[key] % len(answers)]
            self._turns[key] += 1
            try:
                self._operator.answer(question.number, answer)
            except ValueError:
                continue
            requested = question.text.replace("\n", " ").strip()
            self._answers.append((f"{question.dialog} '{requested}'", answer))
            return


def _answers(question: Question) -> Sequence[str]:
    """Return the possible answers of a question, in turn."""
    given = question.choices or _NUMBERS
    first = (question.proposed,) if question.proposed else ()
    return (*first, *(choice for choice in given if choice != question.proposed))


# -- Polled signals --------------------------------------------------------------------------------
#
# Inferred inputs that a program polls. Each receives the expected value in turn.
#
# `WHILE TRUE DO IF diStart = 1 ...` waits without a wait instruction. While a task is inside such a
# loop, one of the inputs in the loop's conditions is pressed like a button for half a second, then
# the next one. Inputs of one condition are pressed together. The same applies to outputs that
# programs only read: the system or another task sets them. Inputs of interrupts are pressed
# regardless of the task's place.


_HELD = 0.5
"""Seconds that an input is pressed."""
_READING = frozenset(("dinput", "ginput", "ainput", "testdi", "doutput", "goutput", "aoutput"))
Wanted = tuple[str, Relation, float]
"""Lower-case name of a signal, relation and value."""


@dataclass(frozen=True, slots=True)
class PolledSignals:
    """Comparisons of signals in a loop that are true together.

    Lines are those of its module.
    """

    module: str
    first: int
    last: int
    wanted: tuple[Wanted, ...]


def polled(looks: Iterable[WaitCondition], given: Collection[str]) -> Iterator[PolledSignals]:
    """Return all conditions on `given` signals, by lower-case name."""
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
    """Iterate over names that a module passes to instructions.

    For outputs these are the signals that it sets. Names are lower case.
    """
    for node, _ in scoped(module):
        if isinstance(node, n.LateCall) or (
            isinstance(node, n.ProcedureCall | n.FunctionCall)
            and node.name.lower() not in _READING
            and not node.name.lower().startswith(("wait", "isignal"))
        ):
            yield from (_signal(a.value) for a in node.arguments if isinstance(a.value, n.Name))


class Polling(Protocol):
    """A controller whose tasks poll signals."""

    io: IOSystem
    scheduler: Scheduler
    rapid_tasks: dict[str, Task]


class InputSetter:
    """Presses the inputs that tasks poll, one after the other."""

    def __init__(
        self, controller: Polling, rows: tuple[PolledSignals, ...], message: list[Answer]
    ) -> None:
        self._controller = controller
        self._rows = rows
        self._answers = message
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
                    self._answers.append((awaited.signal.name, value))
                    io.set(awaited.signal, value)
            if self._pressed:
                break
        # If every task waits and no event follows, the program waits for ever.
        waits = all(task.waits_for is not None for task in self._running())
        if not waits or scheduler.next_event() is not None:
            self._next()

    def _running(self) -> Iterator[Task]:
        return (t for t in self._controller.rapid_tasks.values() if t.state == "running")

    def _of(self, task: Task) -> list[PolledSignals]:
        """Return the conditions of a task's loops, the innermost first."""
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


# -- Polled data -----------------------------------------------------------------------------------
#
# Data that a program polls and never sets to the expected value. On a real controller a panel, a
# client of web services or a task outside the files sets them. In an inferred cell each is set in
# turn, data of one condition together.
#
# `WaitUntil bStart;` and `WHILE TRUE DO IF nOrder = 3 ...` wait for such data. While a task is at
# such a place, or in the loop around it, one of them receives the expected value: for a second if
# the program never writes it, permanently if it does, because the program then resets it itself.
# For a copy of another datum, the original is set.


_HELD_DATA: Final = 0.5
"""Seconds between two data that are set."""
_TURNS: Final = 2
"""Turns for which a datum keeps its set value."""
_MOST: Final = 200
"""Times that data are set."""
GUESSED_DATA: Final = "cell_data"
"""The module that contains inferred data."""
_KINDS: Final[Mapping[type, tuple[str, ...]]] = {bool: ("bool",), str: ("string",)}
_ANY: Final = (False, 0.0, "")
_WATCHING: Final = frozenset(("ipers",))
"""Instructions that read a persistent without changing it."""
Plain = bool | float | str


@dataclass(frozen=True, slots=True)
class Adjusted:
    """The value of a datum, and True if the program also writes it."""

    owner: str
    """Module that declares it."""
    name: str
    value: Plain
    written: bool = False
    function: str = ""
    """Of a stub that returns the datum."""

    @property
    def shown(self) -> str:
        """Display name."""
        return f"{self.function}()" if self.function else self.name


@dataclass(frozen=True, slots=True)
class PolledData:
    """Data that lines of a module poll together, with expected values."""

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
    exchanged: Collection[str] = (),
) -> Iterator[PolledData]:
    """Return all data polled in the modules of a task.

    `made` are the types of inferred data, by lower-case name. `exchanged` are persistents that
    the tasks set for each other: their values are never inferred.
    """
    written: dict[str, set[object]] = {}
    for scope in scopes:
        for name, value in _written(scope, made):
            written.setdefault(name, set()).add(value)
    for look in looks:
        expected = [one for term in look.terms for one in _wanted(term, made)]
        given = (_given(one, written) for one in expected)
        free = [one for one in given if one and one.name.casefold() not in exchanged]
        known = {one.name.casefold(): one for one in free}
        if known:
            yield PolledData(task, look.module, look.first, look.last, tuple(known.values()))


def exchanged_persistents(
    tasks: Iterable[Sequence[ModuleScope]], made: Mapping[str, str]
) -> frozenset[str]:
    """Return the persistents of several tasks of which one sets them, by lower-case name.

    Undeclared data count: the inferred ones may be persistents.
    """
    known: Counter[str] = Counter()
    written: set[str] = set()
    for scopes in tasks:
        own = {
            one.name.casefold()
            for scope in scopes
            for one in scope.tree.data
            if one.kind == "PERS" and not one.scope
        }
        for scope in scopes:
            for name, _ in _written(scope, made):
                if name in own or scope.find(name) is None:
                    own.add(name)
                    written.add(name)
        known.update(own)
    return frozenset(name for name in written if known[name] > 1)


def _given(one: Adjusted, written: Mapping[str, set[object]]) -> Adjusted | None:
    """Return a value that no part of the program writes.

    For a copy of another datum, it is a value of the original.
    """
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
    """Iterate over plain data in a comparison, with deciding values."""
    node, holds, scope = term
    if isinstance(node, n.Name | n.FunctionCall):
        yield from _set(node, scope, holds, made)
    elif isinstance(node, n.Binary) and node.operator in RELATIONS:
        for one, other, relation in (
            (node.left, node.right, node.operator),
            (node.right, node.left, SWAPPED.get(node.operator, node.operator)),
        ):
            value = constant(other, scope)
            if isinstance(one, n.Name | n.FunctionCall) and isinstance(
                value, bool | int | float | str
            ):
                expected = _making(relation if holds else NEGATED[relation], value)
                if expected is not None:
                    yield from _set(one, scope, expected, made)


def _making(operator: str, value: Plain) -> Plain | None:
    """Return a value that makes a comparison with `value` true."""
    if operator in ("=", ">=", "<="):
        return value
    if isinstance(value, bool):
        return not value if operator == "<>" else None
    if isinstance(value, str):
        return "x" if operator == "<>" else None
    return value - 1 if operator == "<" else value + 1


def _set(
    name: n.Name | n.FunctionCall, scope: Scope, value: Plain, made: Mapping[str, str]
) -> Iterator[Adjusted]:
    """Iterate over a value for a name of a plain variable or persistent, or for a stub's result."""
    symbol = scope.find(name.name)
    if isinstance(name, n.FunctionCall):
        if symbol is None:
            datum = stub_datum(name.name)
            kind = made.get(datum.casefold(), "")
            if kind in (_KINDS.get(type(value)) or ("num", "dnum")):
                yield Adjusted(GUESSED_DATA, datum, value, function=name.name)
        return
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
    """Iterate over names that a module writes, and the values.

    A value is a constant, a copied datum (Adjusted), or None for others.
    """
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
    """A controller whose tasks poll data."""

    scheduler: Scheduler
    rapid_tasks: dict[str, Task]

    def task(self, name: str) -> "TaskView":
        """Return a task."""


class DataSetter:
    """Sets the data that tasks poll, one after the other."""

    def __init__(
        self, controller: HasPolledData, rows: tuple[PolledData, ...], message: list[Answer]
    ) -> None:
        self._controller = controller
        self._rows = rows
        self._answers = message
        self._looks = 0
        self._turn = 0
        self._held: dict[tuple[str, str], tuple[Plain, int]] = {}
        self._next()

    def _next(self) -> None:
        if self._looks < _MOST:
            self._looks += 1
            self._controller.scheduler.after(round(_HELD_DATA * S), self._look)

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
        """Set the data of a condition; return False if all were set already."""
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
                self._answers.append((one.shown, value))
        return changed

    def _around(self, task: Task) -> list[PolledData]:
        """Return the conditions at a task's place, the innermost first."""
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
