"""Expressions: typed Python source, with what it costs and touches."""

from rapidgen.rapid.numbers import dnum, single
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.context import CompiledExpression, Unit, failing
from rapidgen.runtime.compiler.inline import function_call
from rapidgen.runtime.compiler.operators import binary, unary
from rapidgen.runtime.compiler.references import read
from rapidgen.runtime.compiler.symbols import CannotCompile
from rapidgen.runtime.compiler.value_copies import by_value
from rapidgen.runtime.values import BOOL, DNUM, NUM, STRING, Type, attribute


def compile_expression(
    unit: Unit, node: n.Expression, expected: Type | None, dims: tuple[int, ...]
) -> CompiledExpression:
    """Compile any expression; a signal comes as the signal itself."""
    match node:
        case n.NumberLiteral():
            return _number(unit, node, expected)
        case n.StringLiteral():
            return CompiledExpression(repr(node.value), STRING, literal=True)
        case n.BoolLiteral():
            return CompiledExpression(repr(node.value), BOOL, literal=True)
        case n.Name():
            return _name(unit, node, expected)
        case n.Index():
            return _index(unit, node, expected)
        case n.Member():
            return _member(unit, node, expected)
        case n.FunctionCall():
            return function_call(unit, node, expected)
        case n.Aggregate():
            return _aggregate(unit, node, expected, dims)
        case n.Unary():
            return unary(unit, node, expected)
        case n.Binary():
            return binary(unit, node, expected)
        case n.Parenthesis():
            return compile_expression(unit, node.inner, expected, dims)
        case n.Placeholder():
            return failing("ERR_EXECPHR", kind=expected or NUM, dims=dims)
    raise CannotCompile("an inlined position stands only for a target", node)


def _number(unit: Unit, node: n.NumberLiteral, expected: Type | None) -> CompiledExpression:
    value = node.value
    if expected is not None and expected.kind == "dnum":
        return _double(unit, value)
    try:
        value = single(value)
    except OverflowError:
        return _double(unit, node.value)
    if isinstance(value, int):
        return CompiledExpression(
            repr(value), NUM, literal=True, whole=True, exact=True, range=(value, value)
        )
    return CompiledExpression(repr(value), NUM, literal=True, exact=True)


def _double(unit: Unit, value: float) -> CompiledExpression:
    held = dnum(value, int(unit.options.dialect.dnum_whole))
    return CompiledExpression(repr(held), DNUM, literal=True, whole=isinstance(held, int))


def _name(unit: Unit, node: n.Name, expected: Type | None) -> CompiledExpression:
    data = unit.data(node.name)
    if data is None:
        return failing("ERR_REFUNKDAT", node.name, expected or NUM)
    return read(unit, data)


def _is_undeclared(base: CompiledExpression) -> bool:
    return base.code.startswith("FAIL('ERR_REFUNKDAT'")


def _undeclared(base: CompiledExpression, expected: Type | None) -> CompiledExpression:
    """A part of what nothing declares: of the type that its place wants."""
    return CompiledExpression(
        base.code, expected or NUM, fails=True, effect=base.effect, exact=True
    )


def _index(unit: Unit, node: n.Index, expected: Type | None) -> CompiledExpression:
    base = compile_expression(unit, node.base, None, ())
    if _is_undeclared(base):
        return _undeclared(base, expected)
    if len(base.dims) != len(node.indices):
        raise CannotCompile("the number of indices is not the number of dimensions", node)
    indices = [unit.value_of(i, NUM, (), "index") for i in node.indices]
    code = base.code + "".join(f"[{i.code}]" for i in indices)
    e = CompiledExpression(code, base.type, ops=len(indices), fails=True, exact=True)
    return e.take(base, *indices)


def _member(unit: Unit, node: n.Member, expected: Type | None) -> CompiledExpression:
    base = compile_expression(unit, node.base, None, ())
    if _is_undeclared(base):
        return _undeclared(base, expected)
    kind = base.type.component(node.component.lower())
    if kind is None or base.dims:
        raise CannotCompile(f"{base.type.name} has no component {node.component}", node)
    return CompiledExpression(
        f"{base.code}.{attribute(node.component)}", kind, ops=1, exact=True
    ).take(base)


def _aggregate(
    unit: Unit, node: n.Aggregate, expected: Type | None, dims: tuple[int, ...]
) -> CompiledExpression:
    if expected is None:
        raise CannotCompile("an aggregate has no type here", node)
    if dims:
        if dims[0] not in (0, len(node.members)):
            raise CannotCompile(f"{len(node.members)} members for {dims[0]} elements", node)
        parts = [unit.value_of(m, expected, dims[1:], "member") for m in node.members]
        inside = ", ".join(f"{i}: {by_value(p, expected)}" for i, p in enumerate(parts, start=1))
        return CompiledExpression(
            f"{{{inside}}}", expected, (len(parts), *dims[1:]), fresh=True
        ).take(*parts)
    if expected.kind != "record" or expected.make is None:
        raise CannotCompile(f"an aggregate is no {expected.name}", node)
    if not unit.module.scope.takes(expected.name, len(node.members)):
        raise CannotCompile(f"{expected.name} has {len(expected.components)} components", node)
    kinds = [kind for _, kind in expected.components]
    members = list(zip(node.members, kinds, strict=False))
    parts = [unit.value_of(m, kind, (), "component") for m, kind in members]
    inside = ", ".join(by_value(p, kind) for p, kind in zip(parts, kinds, strict=False))
    cls = unit.linker.keep(expected.make)
    return CompiledExpression(f"{cls}({inside})", expected, fresh=True).take(*parts)
