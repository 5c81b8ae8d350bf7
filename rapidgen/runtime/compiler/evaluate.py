"""Values of declarations: constant and literal expressions, worked out on the tree [K §3.1-3.2].

Initial values are evaluated here and not compiled: backups hold a hundred thousand numbers.
"""

from collections.abc import Callable

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler import runtime
from rapidgen.runtime.compiler.context import CannotCompile
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.values import NUM, Type, Value, attribute, copy_value, single

Lookup = Callable[[n.Name], tuple[Type, tuple[int, ...], Value]]
"""Type, sizes and value of a constant; raises CannotCompile for anything else."""


def evaluate(node: n.Expression, kind: Type | None, dims: tuple[int, ...], lookup: Lookup) -> Value:
    """The value of a constant expression of a known type."""
    if node.__class__ is n.NumberLiteral:
        value = node.value
        return value if kind is not None and kind.kind == "dnum" else single(value)
    if node.__class__ is n.Aggregate:
        return _aggregate(node, kind, dims, lookup)
    value, found = _value(node, kind, lookup)
    if kind is not None and found is not None and found.name != kind.name:
        raise CannotCompile(f"the value is {found.name}, not {kind.name}", node)
    if kind is not None and kind.kind == "num" and not dims:
        return single(value)
    return value


def _aggregate(
    node: n.Aggregate, kind: Type | None, dims: tuple[int, ...], lookup: Lookup
) -> Value:
    members = node.members
    if kind is None:
        raise CannotCompile("an aggregate has no type here", node)
    if dims:
        if len(members) != dims[0]:
            raise CannotCompile(f"{len(members)} members for {dims[0]} elements", node)
        inner = dims[1:]
        return {i: evaluate(m, kind, inner, lookup) for i, m in enumerate(members, start=1)}
    if kind.kind != "record" or kind.make is None:
        raise CannotCompile(f"an aggregate is no {kind.name}", node)
    components = kind.components
    if len(members) != len(components):
        raise CannotCompile(f"{kind.name} has {len(components)} components", node)
    return kind.make(
        *[
            evaluate(m, inner_kind, (), lookup)
            for m, (_, inner_kind) in zip(members, components, strict=True)
        ]
    )


def _value(node: n.Expression, kind: Type | None, lookup: Lookup) -> tuple[Value, Type | None]:
    """A value and its type, where it is known (a literal number has none of its own)."""
    match node:
        case n.NumberLiteral():
            return node.value if kind is not None and kind.kind == "dnum" else single(
                node.value
            ), None
        case n.StringLiteral() | n.BoolLiteral():
            return node.value, None
        case n.Parenthesis():
            return _value(node.inner, kind, lookup)
        case n.Name():
            whole, dims, value = lookup(node)
            return copy_value(value), whole if not dims else None
        case n.Member():
            base, outer = _value(node.base, None, lookup)
            inner = outer.component(node.component.lower()) if outer is not None else None
            if inner is None:
                raise CannotCompile(f"there is no component {node.component}", node)
            return getattr(base, attribute(node.component)), inner
        case n.Index(base=n.Name() as name):
            element, _, value = lookup(name)
            for index in node.indices:
                at = evaluate(index, NUM, (), lookup)
                if at not in value:
                    raise CannotCompile("the index lies outside the array", index)
                value = value[at]
            return value, element
        case n.Unary():
            value, operand = _value(node.operand, kind, lookup)
            if node.operator == "NOT":
                return not value, operand
            return (-value if node.operator == "-" else value), operand
        case n.Binary():
            return _binary(node, kind, lookup)
    raise CannotCompile("this is no constant expression", node)


def _binary(node: n.Binary, kind: Type | None, lookup: Lookup) -> tuple[Value, Type | None]:
    left, left_type = _value(node.left, kind, lookup)
    right, right_type = _value(node.right, kind, lookup)
    found = left_type or right_type
    try:
        match node.operator:
            case "+":
                if isinstance(left, str):
                    return runtime.concat(left, right), found
                if hasattr(left, "x"):
                    return runtime.pos_add(left, right), found
                return left + right, found
            case "-":
                return left - right, found
            case "*":
                return left * right, found
            case "/":
                return left / right, found
            case "DIV":
                return runtime.div(left, right), found
            case "MOD":
                return runtime.mod(left, right), found
            case "AND":
                return left and right, None
            case "OR":
                return left or right, None
            case "XOR":
                return left is not right, None
            case "=":
                return left == right, None
            case "<>":
                return left != right, None
            case "<":
                return left < right, None
            case "<=":
                return left <= right, None
            case ">":
                return left > right, None
            case _:
                return left >= right, None
    except (ZeroDivisionError, RapidError, TypeError) as error:
        raise CannotCompile(f"this cannot be evaluated ({error})", node) from error
