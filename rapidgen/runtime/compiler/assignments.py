"""Stores: assignment, Incr and its kin, CONNECT; waking who watches a persistent."""

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.context import (
    CALLS,
    SHARED,
    SILENT,
    CompiledExpression,
    Unit,
    calling,
    failing,
)
from rapidgen.runtime.compiler.emitter import Emitter
from rapidgen.runtime.compiler.references import DataReference, place_of
from rapidgen.runtime.compiler.symbols import CannotCompile, Data
from rapidgen.runtime.compiler.value_copies import by_value, store_lines
from rapidgen.runtime.values import NUM, Type


def _target(unit: Unit, node: n.Expression) -> DataReference:
    """A datum that may be assigned."""
    if isinstance(node, n.Placeholder):
        raise CannotCompile("a placeholder is no datum", node)
    place = place_of(unit, node)
    if place is None:
        raise CannotCompile("only variables, persistents and parameters can be assigned", node)
    if place.data.readonly:
        raise CannotCompile(f"{place.data.name} cannot be changed", node)
    return place


def assignment(emitter: Emitter, node: n.Assignment) -> None:
    """`:=`, by value."""
    if isinstance(node.target, n.Placeholder):
        emitter.simple(failing("ERR_EXECPHR"))
        return
    place = _target(emitter.unit, node.target)
    if not place.e.type.is_value:
        raise CannotCompile(f"{place.e.type.name} cannot be assigned", node)
    value = emitter.unit.value_of(node.value, place.e.type, place.e.dims)
    _store(emitter, place, value)


def _store(emitter: Emitter, place: DataReference, value: CompiledExpression) -> None:
    """Assign a compiled value to a place and wake who watches it."""
    kind, data = place.e.type, place.data
    total = CompiledExpression("", kind).take(place.e, value)
    if place.holder or data.storage not in ("local", "global"):
        total.effect = max(total.effect, SHARED if data.storage != "box" else SILENT)
    if not place.holder and not place.e.dims and not place.cell:
        # Writing is no access in the cost model; reading the target was not either.
        total.fails = value.fails or place.data.optional
    total.fails = total.fails or value.risky or bool(place.e.dims)
    lines = _store_lines(emitter, place, value)
    if place.cell and emitter.options.switching:
        total.effect = CALLS
        lines.append(f"R.touch({place.cell})")
    emitter.pay(total)
    emitter.guard(total, lines)
    _wake(emitter, place)
    if total.effect != SILENT:
        emitter.w.close()


def _wake(emitter: Emitter, place: DataReference) -> None:
    if not place.cell:
        return
    w = emitter.w
    if place.data.storage == "cell":
        w.emit(f"if {place.cell}.w:")
    else:
        w.emit(f"_c = {place.cell}")
        w.emit("if _c is not None and _c.w:")
    cell = place.cell if place.data.storage == "cell" else "_c"
    w.depth += 1
    w.emit("R.b = b")
    w.emit(f"{cell}.notify()")
    w.emit("b = R.b")
    w.depth -= 1


def _store_lines(emitter: Emitter, place: DataReference, value: CompiledExpression) -> list[str]:
    data, kind = place.data, place.e.type
    if data.storage == "global":
        emitter.unit.globals_written.add(data.code)
    if place.e.dims:
        return _array_lines(emitter, place, value)
    if kind.kind == "record":
        if data.storage == "local" and not place.holder:
            emitter.function.stored.add(data.code)
            return [f"{data.code} = {by_value(value, kind)}"]
        return [f"{place.e.code}.assign({value.code})"]
    if not place.holder:
        if data.storage in ("local", "global"):
            emitter.function.stored.add(data.code)
            return store_lines(data.code, value, kind, keep=True)
        return _through("_x", f"{_kept(data)}.v", value, kind)
    if place.member:
        return _through("_x", f"{place.holder}.{place.key}", value, kind)
    lines = []
    key = place.key
    if not (key.isidentifier() or key.isdigit()):
        lines.append(f"_i = {key}")
        key = "_i"
    if not _inside(place):
        lines.append(f"{place.holder}[{key}]")  # outside: KeyError
    return lines + _through("_x", f"{place.holder}[{key}]", value, kind)


def _kept(data: Data) -> str:
    return f"PRESENT({data.code})" if data.optional else data.code


def _through(temporary: str, target: str, value: CompiledExpression, kind: Type) -> list[str]:
    """Store by way of a temporary when the value has to be tested."""
    lines = store_lines(temporary, value, kind)
    if len(lines) == 1:
        return [target + lines[0].removeprefix(temporary)]
    return [*lines, f"{target} = {temporary}"]


def _inside(place: DataReference) -> bool:
    """Whether the last index is known to lie in the array."""
    limits = place.index_range
    dims = place.data.dims
    return limits is not None and bool(dims) and limits[0] >= 1 and limits[1] <= dims[-1]


def _array_lines(emitter: Emitter, place: DataReference, value: CompiledExpression) -> list[str]:
    data = place.data
    known = 0 not in place.e.dims and place.e.dims == value.dims
    if data.storage == "local" and known:
        emitter.function.stored.add(data.code)
        return [f"{data.code} = {by_value(value, place.e.type)}"]
    return [f"ASSIGN({place.e.code}, {value.code})"]


def step(emitter: Emitter, key: str, node: n.ProcedureCall) -> None:
    """Incr, Decr, Add and Clear are assignments."""
    arguments = [a.value for a in node.arguments if a.value is not None]
    if not arguments:
        raise CannotCompile(f"{node.name} takes an argument", node)
    place = _target(emitter.unit, arguments[0])
    kind = place.e.type
    if kind.kind not in ("num", "dnum") or place.e.dims:
        raise CannotCompile(f"{node.name} takes num or dnum, not {kind.name}", node)
    if key == "clear":
        value = CompiledExpression("0", kind, whole=True, exact=True, range=(0, 0))
    else:
        by = (
            emitter.unit.value_of(arguments[1], kind)
            if key == "add" and len(arguments) > 1
            else CompiledExpression("1", kind, whole=True, exact=True, range=(1, 1), literal=True)
        )
        sign = "-" if key == "decr" else "+"
        current = place.e
        value = CompiledExpression(
            f"({current.code} {sign} {by.code})",
            kind,
            whole=current.whole and by.whole,
            risky=not (by.literal or (current.whole and by.whole)),
        ).take(current, by)
    if kind.kind == "dnum" and key != "clear":
        value.code, value.fails = f"WHOLE{value.code}", True
    value.cost += emitter.options.call
    _store(emitter, place, value)


def connect(emitter: Emitter, node: n.Connect) -> None:
    """CONNECT: the interrupt's number is stored in its variable."""
    place = _target(emitter.unit, node.target)
    trap = emitter.unit.routine_named(node.trap)
    if trap is None or trap.kind != "TRAP":
        emitter.simple(failing("ERR_REFUNKTRP", node.trap))
        return
    if place.e.type.kind != "num" or place.e.dims:
        raise CannotCompile("CONNECT takes an intnum", node)
    code = f"R.connect({place.e.code}, {emitter.unit.linker.keep(trap)})"
    e = calling(code, NUM, place.e)
    lines = _through("_x", place.e.code, e, NUM)
    if place.data.storage == "global":
        emitter.unit.globals_written.add(place.data.code)
    if place.data.storage == "local" and not place.holder:
        emitter.function.stored.add(place.data.code)
    emitter.simple(e, *lines)
