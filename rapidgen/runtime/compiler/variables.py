"""Parameters and data of a routine: how each is kept, and the Python that makes it."""

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.analysis import IntegerLocals, RoutineFacts
from rapidgen.runtime.compiler.context import UNBOUNDED, Unit
from rapidgen.runtime.compiler.symbols import Data, FormalParameter, Storage
from rapidgen.runtime.compiler.writer import Writer
from rapidgen.runtime.values import ATOMIC, Type, Value

SWITCH = Type("switch", "bool")


def header(unit: Unit) -> str:
    """Parameters of the Python function."""
    absent = False
    names = []
    for parameter in unit.routine.parameters:
        absent = absent or parameter.optional
        names.append(f"v_{parameter.name.lower()}" + ("=None" if absent else ""))
    return ", ".join(names)


def declare(unit: Unit, w: Writer, facts: RoutineFacts) -> None:
    """Enter parameters and data into the unit, and write what makes them."""
    for parameter in unit.routine.parameters:
        _parameter(unit, w, parameter)
    candidates: dict[str, int] = {}
    values: list[tuple[n.DataDeclaration, Data, Value]] = []
    for d in unit.node.data:
        w.token = d.first
        kind, dims, value = unit.linker.evaluate(unit.module, unit.names, d)
        key = d.name.lower()
        symbol = unit.names.names[key]
        if d.kind == "CONST" and not dims and kind.kind in ATOMIC:
            unit.locals[symbol] = Data(
                d.name, "CONST", kind, (), "inline", "", value=value, readonly=True
            )
            continue
        data = unit.locals[symbol] = Data(d.name, "VAR", kind, dims, "local", f"v_{key}")
        values.append((d, data, value))
        if kind.kind == "num" and not dims and isinstance(value, int):
            candidates[key] = value
    complete = IntegerLocals(candidates, facts, lambda name: _constant(unit, name))
    for d, data, value in values:
        w.token = d.first
        _variable(unit, w, d, data, value, complete)


def _parameter(unit: Unit, w: Writer, parameter: FormalParameter) -> None:
    key = parameter.name.lower()
    code = f"v_{key}"
    kind = parameter.type or SWITCH
    dims = (0,) * parameter.dims
    atomic = kind.kind in ATOMIC and not dims
    storage: Storage = "local"
    if parameter.mode in ("PERS", "INOUT") or (parameter.mode == "VAR" and atomic):
        storage = "ref"
    elif parameter.mode == "VAR":
        storage = "object"
    elif key in unit.boxed and atomic and not parameter.switch:
        storage = "box"
        t = unit.linker.keep(kind)
        box = f"{code} = BOX({code}, {t}, (), {parameter.name!r})"
        w.emit(f"if {code} is not None: {box}" if parameter.optional else box)
    unit.locals[unit.names.names[key]] = Data(
        parameter.name,
        "PARAMETER",
        kind,
        dims,
        storage,
        code,
        mode=parameter.mode,
        optional=parameter.optional,
    )


def _constant(unit: Unit, name: str) -> Value:
    data = unit.data(name)
    return data.value if data is not None and data.storage == "inline" else None


def _variable(
    unit: Unit, w: Writer, d: n.DataDeclaration, data: Data, value: Value, complete: IntegerLocals
) -> None:
    key, kind, dims, linker = d.name.lower(), data.type, data.dims, unit.linker
    if d.kind == "CONST":
        data.kind, data.readonly, data.storage = "CONST", True, "global"
        data.code = linker.keep(value)
    elif dims or kind.kind not in ATOMIC:
        w.emit(f"{data.code} = {_fresh(unit, d, kind, dims, value)}")
    elif key in unit.boxed:
        data.storage = "box"
        w.emit(f"{data.code} = BOX({value!r}, {linker.keep(kind)}, (), {d.name!r})")
    else:
        # Where statements are reported, somebody may set it to anything.
        data.whole = key in complete.whole and kind.kind == "num" and not unit.options.tracing
        if data.whole and key in complete.natural:
            data.range = (0, UNBOUNDED)
        w.emit(f"{data.code} = {value!r}")


def _fresh(
    unit: Unit, d: n.DataDeclaration, kind: Type, dims: tuple[int, ...], value: Value
) -> str:
    """What makes a record, an array or an object for each call."""
    linker = unit.linker
    if d.initial is None and not dims and kind.make is not None:
        return f"{linker.keep(kind.make)}()"
    if d.initial is None and len(dims) == 1 and kind.kind in ATOMIC:
        return f"dict.fromkeys(range(1, {dims[0] + 1}), {kind.default()!r})"
    if kind.is_value:
        return f"COPY({linker.keep(value)})"
    return f"ARRAY({dims!r}, {linker.keep(kind.make)})"
