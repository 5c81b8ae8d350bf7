"""Conditions that a program looks at again and again, each as what has to hold together.

`IF diDoor = 1 AND bAuto THEN IF nOrder = 3 ...` inside a loop needs three things at once. What is
looked at in the routines that a loop calls is looked at by the loop.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import get_args

from rapidgen.controller.inference.name_usage import scoped
from rapidgen.machine.io import Relation
from rapidgen.rapid.binding import ModuleScope, RoutineScope, RoutineSymbol
from rapidgen.rapid.binding.names import called
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import children, walk

Term = tuple[n.Expression, bool, RoutineScope]
"""A comparison or a name, whether it has to hold, and where it stands."""
Terms = tuple[Term, ...]


@dataclass(frozen=True, slots=True)
class WaitCondition:
    """What has to hold together in a loop, by the lines of its module."""

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
"""What orders interrupts at a signal or a persistent."""
_WAYS = 8
"""Of one condition."""


def wait_conditions(task: Sequence[ModuleScope], entry: str) -> Iterator[WaitCondition]:
    """What each loop in the modules of a task looks at; what leaves it comes last. The routine that
    a task starts in is a loop: it is executed in cycles, and interrupts wait in it. So is a
    WaitUntil."""
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
    """What the interrupts of a module wait for, and what their traps look at then."""
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
    """What a node looks at; `around` are the conditions that it stands in."""
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
    """The condition of a node, and what is executed where it holds."""
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
    """What the routines look at that a node calls itself, or an expression with all in it."""
    for one in walk(node) if isinstance(node, n.Expression) else (node,):
        if isinstance(one, n.ProcedureCall | n.FunctionCall) and one.name.lower() not in known:
            routine = called(scope.find(one.name))
            if isinstance(routine, RoutineSymbol) and routine.node is not None and routine.module:
                known.add(one.name.lower())
                inside = routine.module.routine(routine.node)
                yield from _inside(routine.node, inside, around, known)


def _ways(node: n.Expression, scope: RoutineScope, *, holds: bool) -> list[Terms]:
    """In which ways a condition holds, or does not: what has to hold together."""
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
