"""Initial values of declarations: constant expressions as RAPID values [K §3.1-3.2].

They are not compiled: backups hold a hundred thousand numbers. Aggregates and literals are made
here directly, whatever else is worked out by rapid/binding.
"""

from rapidgen.rapid.binding import constants
from rapidgen.rapid.binding.names import Scope
from rapidgen.rapid.binding.types import array
from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.numbers import single
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.symbols import CannotCompile
from rapidgen.runtime.values import Type, Value


def evaluate(node: n.Expression, kind: Type, dims: tuple[int, ...], scope: Scope) -> Value:
    """The value of a constant expression of a known type. CannotCompile: it has none."""
    if not dims and kind.kind == "num":
        if isinstance(node, n.NumberLiteral):
            return single(node.value)
        if isinstance(node, n.Unary) and isinstance(node.operand, n.NumberLiteral):
            value = single(node.operand.value)
            return -value if node.operator == "-" else value
    elif isinstance(node, n.Aggregate):
        return _aggregate(node, kind, dims, scope)
    try:
        result = constants.evaluate(node, scope, array(kind.name, len(dims)))
    except constants.NotConstant as error:
        raise CannotCompile(str(error), error.node) from error
    return build(kind, result, len(dims))


def _aggregate(node: n.Aggregate, kind: Type, dims: tuple[int, ...], scope: Scope) -> Value:
    members = node.members
    if dims:
        if len(members) != dims[0]:
            raise CannotCompile(f"{len(members)} members for {dims[0]} elements", node)
        inner = dims[1:]
        return {i: evaluate(m, kind, inner, scope) for i, m in enumerate(members, start=1)}
    if kind.kind != "record" or kind.make is None:
        raise CannotCompile(f"an aggregate is no {kind.name}", node)
    components = kind.components
    if len(members) != len(components) and not scope.module.takes(kind.name, len(members)):
        raise CannotCompile(f"{kind.name} has {len(components)} components", node)
    return kind.make(
        *[evaluate(m, inner, (), scope) for m, (_, inner) in zip(members, components, strict=False)]
    )


def build(kind: Type, value: signatures.Value | None, degree: int = 0) -> Value:
    """A value of rapid/binding or the signature data (nested tuples) as a RAPID value."""
    if value is None:
        return kind.default()
    if isinstance(value, tuple):
        if degree:
            return {i: build(kind, v, degree - 1) for i, v in enumerate(value, start=1)}
        assert kind.make is not None
        return kind.make(*[build(t, v) for (_, t), v in zip(kind.components, value, strict=False)])
    if kind.kind == "num" and isinstance(value, int | float):
        return single(value)
    return value
