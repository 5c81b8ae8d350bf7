"""`%name% arguments;` [K §4.5]: what is called is known when it is; arguments are thunks."""

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.context import CompiledExpression, Unit, calling
from rapidgen.runtime.compiler.emitter import Emitter
from rapidgen.runtime.compiler.references import DataReference, place_of
from rapidgen.runtime.compiler.symbols import CannotCompile
from rapidgen.runtime.compiler.value_copies import by_value
from rapidgen.runtime.values import NUM, STRING


def late_call(emitter: Emitter, node: n.LateCall) -> None:
    """`%name% arguments;` [K §4.5]: arguments are thunks, by value and by reference."""
    unit = emitter.unit
    name = unit.value_of(node.procedure, STRING)
    parts, codes = [name], []
    for argument in node.arguments:
        code, part = _argument(unit, argument)
        codes.append(code)
        parts += part
    module = unit.linker.keep(unit.module)
    inside = "".join(c + ", " for c in codes)
    code = f"R.late({name.code}, {module}, ({inside}))"
    emitter.simple(calling(code, NUM, *parts, cost=emitter.options.call))


def _argument(unit: Unit, argument: n.Argument) -> tuple[str, list[CompiledExpression]]:
    name = repr(argument.name.lower() if argument.name else None)
    if argument.kind == "switch":
        return f"LATE({name}, None, None)", []
    node = argument.value
    assert node is not None
    if argument.kind == "conditional" and isinstance(node, n.Name):
        data = unit.data(node.name)
        if data is None or not data.optional:
            raise CannotCompile("a conditional argument names an optional parameter", argument)
        value = f"{data.code}.v" if data.storage in ("box", "ref") else data.code
        code = f"LATE({name}, lambda: {value}, lambda: {data.code})"
        return f"(None if {data.code} is None else {code})", []
    last = ", required=True" if argument.name and argument.kind == "required" else ""
    place = place_of(unit, node)
    if place is None:
        e = unit.expression(node)
        t = unit.linker.keep(e.type)
        return f"LATE({name}, lambda: {by_value(e, e.type)}, None, {t}{last})", [e]
    t = unit.linker.keep(place.e.type)
    read = by_value(place.e, place.e.type)
    ref = _reference(unit, place)
    return f"LATE({name}, lambda: {read}, {ref}, {t}, lambda: {place.e.code}{last})", [place.e]


def _reference(unit: Unit, place: DataReference) -> str:
    """A lambda that makes a Ref to a place, or None for what cannot be one."""
    data, e = place.data, place.e
    if data.readonly or e.type.kind in ("nonvalue", "semivalue"):
        return "None"
    if not place.holder and data.storage in ("box", "cell", "ref"):
        return f"lambda: {data.code}"
    if not place.holder and data.storage == "global":
        return f"lambda: {unit.linker.global_ref(data)}"
    t, cell = unit.linker.keep(e.type), place.cell or "None"
    if place.holder and place.atomic:
        maker = "MEMBER" if place.member else "ITEM"
        key = repr(place.key) if place.member else place.key
        return f"lambda: {maker}({place.holder}, {key}, {t}, {data.name!r}, {cell})"
    return f"lambda: PART({e.code}, {t}, {data.name!r}, {cell}, {e.dims!r})"
