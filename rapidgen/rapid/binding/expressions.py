"""Static types of expressions, without error reports [K §2.17, 3].

An expression that violates a rule has the type None, like one with an unknown part.
"""

from typing import Final

from rapidgen.rapid.binding.names import (
    AGGREGATE,
    EQUALITY,
    LOGICAL,
    NUMBER,
    RELATIONS,
    DataSymbol,
    RoutineSymbol,
    Scope,
    Symbol,
    arithmetic,
    array,
    called,
    degree,
    element,
)
from rapidgen.rapid.syntax.nodes import (
    Aggregate,
    Binary,
    BoolLiteral,
    Expression,
    FunctionCall,
    Index,
    Member,
    Name,
    NumberLiteral,
    Parenthesis,
    StringLiteral,
    Unary,
)

_TRUTH: Final = LOGICAL | EQUALITY | RELATIONS


def root(node: Expression, scope: Scope) -> Symbol | None:
    """Return the first symbol of a data reference.

    None for other expressions and unknown names.
    """
    while isinstance(node, Index | Member):
        node = node.base
    return scope.find(node.name) if isinstance(node, Name) else None


def declared_type(node: Expression, scope: Scope) -> str | None:
    """Return the declared type of a data reference.

    Includes signals and non-value types.
    """
    if isinstance(node, Name):
        symbol = scope.find(node.name)
        return scope.module.type_of(symbol) if isinstance(symbol, DataSymbol) else None
    if isinstance(node, Index):
        complete = declared_type(node.base, scope)
        fits = complete is not None and degree(complete) == len(node.indices)
        return element(complete) if complete and fits else None
    if isinstance(node, Member):
        complete = declared_type(node.base, scope)
        components = scope.module.components(complete) if complete else None
        return components.get(node.component.lower()) if components else None
    return None


def type_of(node: Expression, scope: Scope) -> str | None:
    """Return the type of a read expression; a signal reads as num."""
    match node:
        case NumberLiteral():
            return NUMBER
        case StringLiteral():
            return "string"
        case BoolLiteral():
            return "bool"
        case Name() | Index() | Member():
            result = declared_type(node, scope)
            kind = scope.module.type_class(result) if result else None
            if kind == "nonvalue":
                return None
            return array("num", degree(result)) if result and kind == "semivalue" else result
        case FunctionCall():
            symbol = called(scope.find(node.name))
            if isinstance(symbol, RoutineSymbol) and symbol.kind == "FUNC":
                return scope.module.type_of(symbol)
            return None
        case Aggregate():
            return AGGREGATE
        case Parenthesis():
            return type_of(node.inner, scope)
        case Unary():
            return "bool" if node.operator == "NOT" else type_of(node.operand, scope)
        case Binary():
            if node.operator in _TRUTH:
                return "bool"
            left, right = type_of(node.left, scope), type_of(node.right, scope)
            if left == AGGREGATE or right == AGGREGATE:
                left = right = right if left == AGGREGATE else left
            if left and right:
                return arithmetic(node.operator, left, right)
            known = left or right
            return known if known in ("string", "dnum") else None
    return None
