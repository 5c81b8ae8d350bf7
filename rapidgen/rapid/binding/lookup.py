"""Symbols at a place of a text, and all uses of a symbol.

`BoundModule(scope).at(line, column)` is the symbol named there. It also covers components of
records, parameters named by an argument and procedures named by a literal in a late call.

A statement with a syntax error is not in the tree. Its names are looked up by their tokens, so that
an editor has an answer while the statement is written (`scope_at`, `type_before`).
"""

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from rapidgen.diagnostics import Span
from rapidgen.rapid.binding.constants import constant
from rapidgen.rapid.binding.expressions import declared_type
from rapidgen.rapid.binding.names import (
    DataSymbol,
    ModuleScope,
    RoutineScope,
    RoutineSymbol,
    Scope,
    Symbol,
    TypeSymbol,
    called,
    element,
)
from rapidgen.rapid.syntax.damage import damage_of
from rapidgen.rapid.syntax.lexer import NAME, Kinds
from rapidgen.rapid.syntax.nodes import (
    AliasDeclaration,
    Argument,
    Connect,
    DataDeclaration,
    For,
    FunctionCall,
    Goto,
    LateCall,
    Member,
    Name,
    Node,
    NumberLiteral,
    Parameter,
    ProcedureCall,
    RecordDeclaration,
    RoutineDeclaration,
    StringLiteral,
)
from rapidgen.rapid.syntax.walk import children

_Mention = tuple[int, Symbol]
"""Token of a name, and its symbol."""


@dataclass(slots=True, eq=False)
class BoundModule:
    """A module with its names looked up on first use.

    One place needs the names of its declaration only (`near`): the other 2,000 lines of a module
    cost 25 ms.
    """

    scope: ModuleScope
    _named: dict[int, Symbol] = field(default_factory=dict)
    _near: dict[int, dict[int, Symbol]] = field(default_factory=dict)
    """Names of single declarations, by their first tokens."""

    @property
    def names(self) -> dict[int, Symbol]:
        """Every token that names a known symbol, including declarations."""
        if not self._named:
            self._named.update(_in_damage(self.scope))
            self._named.update(_mentions(self.scope))
        return self._named

    def near(self, token: int) -> dict[int, Symbol]:
        """Return the names in the declaration that has a token."""
        if self._named:
            return self._named
        declarations = self.scope.tree.declarations
        at = bisect_right(declarations, token, key=_first) - 1
        declaration = declarations[at] if at >= 0 else None
        if declaration is None or token > declaration.last:
            return self.names
        result = self._near.get(declaration.first)
        if result is None:
            if declaration in damage_of(self.scope.tree).routines:
                return self.names
            own = self.scope.own.get(getattr(declaration, "name", "").lower())
            result = {} if own is None else {own.token: own}
            result.update(_below(declaration, self.scope))
            self._near[declaration.first] = result
        return result

    def at(self, line: int, column: int) -> Symbol | None:
        """Return the symbol at a line and column (from 1, code points).

        The position after the last letter belongs to the name.
        """
        token = self.token_at(line, column)
        return None if token is None else self.near(token)[token]

    def token_at(self, line: int, column: int) -> int | None:
        """Return the token at a place that names a known symbol."""
        source = self.scope.tree.source
        offset = source.offset(line, column)
        for at in (offset, offset - 1):
            token = bisect_right(source.starts, at) - 1
            inside = token >= 0 and at < source.starts[token] + len(source.tokens[token])
            if inside and token in self.near(token):
                return token
        return None

    def uses(self, symbol: Symbol) -> list[Span]:
        """Return places that name a symbol, in order.

        The declaration is not included.
        """
        own = symbol.token if symbol.module is self.scope else -1
        span = self.scope.tree.source.span
        tokens = sorted(t for t, s in self.names.items() if s is symbol and t != own)
        return [span(token, token) for token in tokens]


def _first(node: Node) -> int:
    return node.first


def _mentions(module: ModuleScope) -> Iterator[_Mention]:
    for symbol in module.symbol, *module.own.values():
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
            # A name that is put together of parts has no token of its own.
            if isinstance(node.procedure, StringLiteral):
                yield from _found(node.procedure.first, symbol)
            yield from _arguments(node.arguments, symbol, scope)
        case DataDeclaration(type=name) | Parameter(type=name):
            yield from _found(node.name_token - 1, scope.find(name))
        case RoutineDeclaration(type=str(name)):
            yield from _found(node.name_token - 1, scope.find(name))
        case AliasDeclaration(type=name):
            yield from _found(node.last - 2, scope.find(name))
        case RecordDeclaration():
            symbol = scope.module.own.get(node.name.lower())
            for component in node.components:
                yield from _found(component.first, scope.find(component.type))
                if isinstance(symbol, TypeSymbol) and symbol.node is node:
                    member = scope.module.task.members(symbol).get(component.name.lower())
                    yield from _found(component.first + 1, member)
        case Member():
            complete = declared_type(node.base, scope)
            if complete is not None:
                yield from _found(node.last, scope.module.member(complete, node.component))
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


# -- unfinished text ---------------------------------------------------------------------------


def scope_at(module: ModuleScope, token: int) -> Scope:
    """Return the scope of a token: its routine with the loops around it, else the module.

    Loops are read from the tokens, because a loop without its end is not in the tree.
    """
    for routine in module.tree.routines:
        if routine.first <= token <= routine.last:
            break
    else:
        return module
    result: RoutineScope = module.routine(routine)
    tokens = module.tree.source.tokens
    opened: list[int] = []
    for at in range(routine.first, min(token, len(tokens))):
        word = tokens[at].upper()
        if word == "FOR":
            opened.append(at)
        elif word == "ENDFOR" and opened:
            opened.pop()
    for at in opened:
        if at + 1 < token and tokens[at + 1].isidentifier():
            zero = NumberLiteral(at, at, 0, "0")
            result = result.loop(For(at, at, tokens[at + 1], zero, zero, None, []))
    return result


def type_before(tokens: Sequence[str], at: int, scope: Scope) -> str | None:
    """Return the type of the data reference or call that ends with token `at`."""
    path: list[str] = []
    is_call = is_element = False
    while at >= 0:
        is_element = False
        if tokens[at] in ("}", ")"):
            is_call, is_element = tokens[at] == ")", tokens[at] == "}"
            at = _opening(tokens, at) - 1
        if at < 0 or not tokens[at][0].isalpha():
            return None
        path.append(tokens[at])
        if is_call or at == 0 or tokens[at - 1] != ".":
            break
        at -= 2
    if not path:
        return None
    symbol = called(scope.find(path.pop())) if is_call else scope.find(path.pop())
    if not isinstance(symbol, DataSymbol | RoutineSymbol):
        return None
    result = scope.module.type_of(symbol)
    if result is not None and (is_element or path):
        result = element(result)
    for name in reversed(path):
        components = scope.module.components(result) if result else None
        result = components.get(name.lower()) if components else None
    return result


def _opening(tokens: Sequence[str], at: int) -> int:
    """Return the index of the bracket that the one at `at` closes, or -1."""
    opener = {"}": "{", ")": "("}[tokens[at]]
    depth = 0
    for i in range(at, -1, -1):
        depth += (tokens[i] == tokens[at]) - (tokens[i] == opener)
        if depth == 0:
            return i
        if tokens[i] == ";":
            break
    return -1


def _in_damage(module: ModuleScope) -> Iterator[_Mention]:
    """Iterate over the names in parts with a syntax error, by their tokens alone."""
    tokens, kinds = module.tree.source.tokens, Kinds()
    for first, last in damage_of(module.tree).ranges:
        scope = scope_at(module, first)
        for at in range(first, min(last + 1, len(tokens))):
            if kinds[tokens[at]] is not NAME:
                continue
            before = tokens[at - 1] if at else ""
            if before == ".":
                record = type_before(tokens, at - 2, scope)
                if record is not None:
                    yield from _found(at, scope.module.member(record, tokens[at]))
            elif before != "\\":
                yield from _found(at, scope.find(tokens[at]))
