"""Symbols at a place of a text, and all uses of a symbol.

`BoundModule(scope).at(line, column)` is the symbol named there. It also covers parameters named by
an argument and procedures named by a literal in a late call.
"""

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass, field

from rapidgen.diagnostics import Span
from rapidgen.rapid.binding.constants import constant
from rapidgen.rapid.binding.names import ModuleScope, RoutineSymbol, Scope, Symbol
from rapidgen.rapid.syntax.nodes import (
    AliasDeclaration,
    Argument,
    Connect,
    DataDeclaration,
    For,
    FunctionCall,
    Goto,
    LateCall,
    Name,
    Node,
    Parameter,
    ProcedureCall,
    RecordDeclaration,
    RoutineDeclaration,
)
from rapidgen.rapid.syntax.walk import children

_Mention = tuple[int, Symbol]
"""Token of a name, and its symbol."""


@dataclass(slots=True, eq=False)
class BoundModule:
    """A module with its names looked up on first use."""

    scope: ModuleScope
    _named: dict[int, Symbol] = field(default_factory=dict)

    @property
    def names(self) -> dict[int, Symbol]:
        """Every token that names a known symbol, including declarations."""
        if not self._named:
            self._named.update(_mentions(self.scope))
        return self._named

    def at(self, line: int, column: int) -> Symbol | None:
        """Return the symbol at a line and column (from 1, code points).

        The position after the last letter belongs to the name.
        """
        source = self.scope.tree.source
        offset = source.offset(line, column)
        for at in (offset, offset - 1):
            token = bisect_right(source.starts, at) - 1
            if token >= 0 and at < source.starts[token] + len(source.tokens[token]):
                symbol = self.names.get(token)
                if symbol is not None:
                    return symbol
        return None

    def uses(self, symbol: Symbol) -> list[Span]:
        """Return places that name a symbol, in order.

        The declaration is not included.
        """
        own = symbol.token if symbol.module is self.scope else -1
        span = self.scope.tree.source.span
        tokens = sorted(t for t, s in self.names.items() if s is symbol and t != own)
        return [span(token, token) for token in tokens]


def _mentions(module: ModuleScope) -> Iterator[_Mention]:
    for symbol in module.task.find(module.tree.name.lower()), *module.own.values():
        if symbol is not None and symbol.module is module:
            yield symbol.token, symbol
    for declaration in module.tree.declarations:
        yield from _below(declaration, module)


def _below(start: Node, outer: ModuleScope) -> Iterator[_Mention]:
    """Iterate over names in a declaration of a module.

    The scope changes with routines and loops.
    """
    stack: list[tuple[Node, Scope]] = [(start, outer)]
    while stack:
        node, scope = stack.pop()
        yield from _named(node, scope)
        match node:
            case RoutineDeclaration():
                inside = outer.routine(node)
                for symbol in (*inside.names.values(), *inside.labels.values()):
                    yield symbol.token, symbol
                stack += [(child, inside) for child in children(node)]
            case For():
                heads = (node.start, node.end, node.step)
                stack += [(head, scope) for head in heads if head is not None]
                assert not isinstance(scope, ModuleScope)
                inside = scope.loop(node)
                variable = inside.names[node.variable.lower()]
                yield variable.token, variable
                stack += [(child, inside) for child in node.body]
            case _:
                stack += [(child, scope) for child in children(node)]


def _named(node: Node, scope: Scope) -> Iterator[_Mention]:
    """Iterate over the names of a node itself, not of its children."""
    match node:
        case Name(name=name):
            yield from _found(node.first, scope.find(name))
        case FunctionCall(name=name) | ProcedureCall(name=name):
            symbol = scope.find(name)
            yield from _found(node.first, symbol)
            yield from _arguments(node.arguments, symbol, scope)
        case LateCall():
            named = constant(node.procedure, scope, "string")
            symbol = scope.find(named) if isinstance(named, str) else None
            yield from _found(node.procedure.first, symbol)
            yield from _arguments(node.arguments, symbol, scope)
        case DataDeclaration(type=name) | Parameter(type=name):
            yield from _found(node.name_token - 1, scope.find(name))
        case RoutineDeclaration(type=str(name)):
            yield from _found(node.name_token - 1, scope.find(name))
        case AliasDeclaration(type=name):
            yield from _found(node.last - 2, scope.find(name))
        case RecordDeclaration():
            for component in node.components:
                yield from _found(component.first, scope.find(component.type))
        case Connect(trap=name):
            yield from _found(node.last - 1, scope.find(name))
        case Goto(name=name) if not isinstance(scope, ModuleScope):
            yield from _found(node.last - 1, scope.labels.get(name.lower()))


def _arguments(
    arguments: list[Argument], routine: Symbol | None, scope: Scope
) -> Iterator[_Mention]:
    """Iterate over parameters named by arguments."""
    if not isinstance(routine, RoutineSymbol):
        return
    known = {p.name.lower(): p for p in scope.module.task.parameters(routine)}
    for argument in arguments:
        if argument.name is not None:
            token = argument.first + (argument.kind != "required")
            yield from _found(token, known.get(argument.name.lower()))


def _found(token: int, symbol: Symbol | None) -> Iterator[_Mention]:
    if symbol is not None:
        yield token, symbol
