"""Values of expressions known before execution [K §3.1, 3.2, 3.11].

Numbers are those of RAPID: a literal in a place of type num and the value of a num constant are
rounded to single precision; operators in between are not. A literal combined with a dnum is a dnum.
Records and arrays are tuples.
"""

import operator
from collections.abc import Callable
from math import isfinite
from typing import Final

from rapidgen.rapid.binding.names import DataSymbol, Scope, array, degree, element
from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.builtins.signatures import Value
from rapidgen.rapid.numbers import single
from rapidgen.rapid.syntax.nodes import (
    Aggregate,
    Binary,
    BoolLiteral,
    Expression,
    Index,
    Member,
    Name,
    NumberLiteral,
    Parenthesis,
    StringLiteral,
    Unary,
)

_MAX_DEPTH: Final = 200
"""Maximum depth of an expression, the parser's own limit."""
_COMPARE: Final[dict[str, Callable[[Value, Value], bool]]] = {
    "=": operator.eq,
    "<>": operator.ne,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}
_Typed = tuple[Value, str | None]
"""A value and its type; None for a literal number, which takes the type of its place."""


class NotConstant(Exception):
    """An expression without a value before execution; `node` is its place."""

    def __init__(self, message: str, node: Expression) -> None:
        super().__init__(message)
        self.node = node


def constant(node: Expression, scope: Scope, want: str | None = "num") -> Value | None:
    """Return the value of an expression, None if unknown.

    `want` is the type of its place.
    """
    if isinstance(node, NumberLiteral):
        return node.value if isfinite(node.value) else None
    if isinstance(node, Name):
        symbol = scope.find(node.name)
        return value_of(symbol, scope) if isinstance(symbol, DataSymbol) else None
    try:
        return _value(node, want, scope, 0)[0]
    except NotConstant:
        return None


def evaluate(node: Expression, scope: Scope, want: str) -> Value:
    """Return the value of an expression of type `want`.

    See `names` for types as texts. NotConstant: it has no value.
    """
    value, result = _value(node, want, scope, 0)
    if result is not None and result != want:
        raise NotConstant(f"the value is {result}, not {want}", node)
    return _rounded(value, node) if want == "num" else value


def value_of(symbol: DataSymbol, scope: Scope) -> Value | None:
    """Return the value of a constant, None for other data or if unknown.

    `scope` is the scope that contains its name: a routine's constant is evaluated there.
    """
    if symbol.kind != "CONST":
        return None
    if symbol.module is None:
        predefined = signatures.constant(symbol.name)
        return predefined.value if predefined is not None else None
    values = scope.module.task.values
    if symbol in values:
        return values[symbol]
    values[symbol] = None  # Constants that refer to each other end the recursion here.
    if symbol.initial is not None:
        inside: Scope = symbol.module if symbol.routine is None else scope
        expected = inside.module.type_of(symbol)
        try:
            if expected is not None:
                values[symbol] = evaluate(symbol.initial, inside, expected)
        except NotConstant:
            pass
    return values[symbol]


def sizes_of(symbol: DataSymbol, scope: Scope) -> list[Value | None]:
    """Return the declared sizes of an array, None for unknown ones.

    See `value_of` for `scope`.
    """
    away = symbol.routine is None and symbol.module is not None
    inside = symbol.module if away and symbol.module else scope
    return [constant(size, inside) for size in symbol.dimensions]


def _value(node: Expression, want: str | None, scope: Scope, depth: int) -> _Typed:
    if depth > _MAX_DEPTH:
        raise NotConstant("this is nested too deeply", node)
    match node:
        case NumberLiteral():
            return (node.value if want == "dnum" else _rounded(node.value, node)), None
        case StringLiteral():
            return node.value, "string"
        case BoolLiteral():
            return node.value, "bool"
        case Parenthesis():
            return _value(node.inner, want, scope, depth + 1)
        case Name():
            return _named(node, scope)
        case Unary():
            return _unary(node, want, scope, depth)
        case Binary():
            return _binary(node, want, scope, depth)
        case Aggregate():
            return _aggregate(node, want, scope, depth)
        case Member():
            value, complete = _value(node.base, None, scope, depth + 1)
            components = list((scope.module.components(complete or "") or {}).items())
            for (name, kind), part in zip(components, _members(value), strict=False):
                if name == node.component.lower():
                    return part, kind
            raise NotConstant(f"there is no component {node.component}", node)
        case Index():
            value, complete = _value(node.base, None, scope, depth + 1)
            for index in node.indices:
                at = evaluate(index, scope, "num")
                parts = _members(value)
                if not isinstance(at, int) or not 1 <= at <= len(parts):
                    raise NotConstant("the index is outside the array", index)
                value = parts[at - 1]
            return value, element(complete) if complete else None
    raise NotConstant("this is no constant expression", node)


def _members(value: Value) -> tuple[Value, ...]:
    return value if isinstance(value, tuple) else ()


def _named(node: Name, scope: Scope) -> _Typed:
    symbol = scope.find(node.name)
    if not isinstance(symbol, DataSymbol):
        raise NotConstant(f"{node.name} is not known", node)
    if symbol.kind != "CONST":
        raise NotConstant(f"{node.name} is no constant", node)
    value = value_of(symbol, scope)
    if value is None:
        raise NotConstant(f"{node.name} has no value that is known", node)
    return value, scope.module.type_of(symbol)


def _aggregate(node: Aggregate, want: str | None, scope: Scope, depth: int) -> _Typed:
    """Return members of an array or record of the type of its place."""
    if want is None:
        raise NotConstant("an aggregate has no type here", node)
    members = node.members
    if degree(want):
        inner = array(element(want), degree(want) - 1)
        return tuple(_member(m, inner, scope, depth) for m in members), want
    components = scope.module.components(want)
    if components is None:
        raise NotConstant(f"an aggregate is no {want}", node)
    if not scope.module.takes(want, len(members)):
        raise NotConstant(f"{want} has {len(components)} components", node)
    kinds = components.values()
    return tuple(_member(m, k, scope, depth) for m, k in zip(members, kinds, strict=False)), want


def _member(node: Expression, want: str | None, scope: Scope, depth: int) -> Value:
    value, result = _value(node, want, scope, depth + 1)
    if want is not None and result is not None and result != want:
        raise NotConstant(f"the value is {result}, not {want}", node)
    return _rounded(value, node) if want == "num" else value


def _rounded(value: Value, node: Expression) -> Value:
    if isinstance(value, bool) or not isinstance(value, int | float):
        return value
    try:
        return single(value)
    except OverflowError as error:
        raise NotConstant("num cannot hold this", node) from error


def _unary(node: Unary, want: str | None, scope: Scope, depth: int) -> _Typed:
    value, result = _value(node.operand, want, scope, depth + 1)
    if node.operator == "NOT":
        if not isinstance(value, bool):
            raise NotConstant("NOT takes bool", node)
        return not value, "bool"
    if isinstance(value, bool | str):
        raise NotConstant(f"{node.operator} takes num, dnum or pos", node)
    if node.operator == "+":
        return value, result
    if isinstance(value, tuple):
        return tuple(-part for part in _position(value, node)), result
    return -value, result


def _binary(node: Binary, want: str | None, scope: Scope, depth: int) -> _Typed:
    numeric = want if want in ("num", "dnum") else None
    if isinstance(node.left, Aggregate):
        right, second = _value(node.right, numeric, scope, depth + 1)
        left, first = _value(node.left, second, scope, depth + 1)
    else:
        left, first = _value(node.left, numeric, scope, depth + 1)
        expected = first if isinstance(node.right, Aggregate) else numeric
        right, second = _value(node.right, expected, scope, depth + 1)
    if "dnum" in (first, second) and numeric != "dnum":  # a literal is what its partner is
        left, first = _value(node.left, "dnum", scope, depth + 1)
        right, second = _value(node.right, "dnum", scope, depth + 1)
    try:
        return _combined(node, left, right, first or second)
    except (ArithmeticError, TypeError, ValueError) as error:
        raise NotConstant(f"this cannot be evaluated ({error})", node) from error


def _combined(node: Binary, left: Value, right: Value, kind: str | None) -> _Typed:
    keyword = node.operator
    if keyword in _COMPARE:
        return _COMPARE[keyword](left, right), "bool"
    if isinstance(left, bool) and isinstance(right, bool):
        if keyword in ("AND", "OR", "XOR"):
            both = left and right if keyword == "AND" else left or right
            return (left is not right if keyword == "XOR" else both), "bool"
    elif isinstance(left, str) and isinstance(right, str) and keyword == "+":
        return left + right, kind
    elif isinstance(left, tuple) and isinstance(right, tuple) and keyword in ("+", "-"):
        sign = 1 if keyword == "+" else -1
        pairs = zip(_position(left, node), _position(right, node), strict=True)
        return tuple(single(a + sign * b) for a, b in pairs), kind
    elif not isinstance(left, bool | str | tuple) and not isinstance(right, bool | str | tuple):
        value = _number(keyword, left, right)
        if isfinite(value):
            return value, kind
    raise NotConstant(f"{keyword} does not take these", node)


def _number(keyword: str, left: float, right: float) -> float:
    match keyword:
        case "+":
            return left + right
        case "-":
            return left - right
        case "*":
            return left * right
        case "/":
            return left / right
        case "DIV":
            quotient = abs(_whole(left)) // abs(_whole(right))
            return quotient if (left < 0) == (right < 0) else -quotient
        case "MOD":
            if right < 0:
                raise ValueError("ERR_NEGARG")
            remainder = abs(_whole(left)) % _whole(right)
            return remainder if left >= 0 else -remainder
    raise TypeError(f"{keyword} does not take numbers")


def _whole(value: float) -> int:
    if value != int(value):
        raise ValueError("ERR_NOTINTVAL")
    return int(value)


def _position(value: tuple[Value, ...], node: Expression) -> tuple[float, ...]:
    """Return the coordinates of a pos, the only record with operators."""
    numbers = tuple(part for part in value if isinstance(part, int | float))
    if len(numbers) != 3 or len(value) != 3:
        raise NotConstant("of records only pos has operators", node)
    return numbers
