"""Parameters and data of a routine: how each is kept, and the Python that makes it."""

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.analysis import Facts, Whole
from rapidgen.runtime.compiler.context import UNBOUNDED, RoutineScope
from rapidgen.runtime.compiler.symbols import Data, Parameter, Storage
from rapidgen.runtime.compiler.writer import Writer
from rapidgen.runtime.values import ATOMIC, Type, Value


def header(scope: RoutineScope) -> str:
    """Parameters of the Python function."""
    absent = False
    names = []
    for parameter in scope.routine.parameters:
        absent = absent or parameter.optional
        names.append(f"v_{parameter.name.lower()}" + ("=None" if absent else ""))
    return ", ".join(names)


def declare(scope: RoutineScope, w: Writer, facts: Facts) -> None:
    """Enter parameters and data into the scope, and write what makes them."""
    for parameter in scope.routine.parameters:
        _parameter(scope, w, parameter)
    candidates: dict[str, int] = {}
    values: list[tuple[n.DataDeclaration, Data, Value]] = []
    for d in scope.node.data:
        w.token = d.first
        kind, dims, value = scope.program.evaluate_local(scope.module, scope.locals, d)
        key = d.name.lower()
        if d.kind == "CONST" and not dims and kind.kind in ATOMIC:
            scope.locals[key] = Data(
                d.name, "CONST", kind, (), "inline", "", value=value, readonly=True
            )
            continue
        data = scope.locals[key] = Data(d.name, "VAR", kind, dims, "local", f"v_{key}")
        values.append((d, data, value))
        if kind.kind == "num" and not dims and isinstance(value, int):
            candidates[key] = value
    whole = Whole(candidates, facts, lambda name: _constant(scope, name))
    for d, data, value in values:
        w.token = d.first
        _variable(scope, w, d, data, value, whole)


def _parameter(scope: RoutineScope, w: Writer, parameter: Parameter) -> None:
    key = parameter.name.lower()
    code = f"v_{key}"
    kind = parameter.type or scope.program.switch_type
    dims = (0,) * parameter.dims
    atomic = kind.kind in ATOMIC and not dims
    storage: Storage = "local"
    if parameter.mode in ("PERS", "INOUT") or (parameter.mode == "VAR" and atomic):
        storage = "ref"
    elif parameter.mode == "VAR":
        storage = "object"
    elif key in scope.boxed and atomic and not parameter.switch:
        storage = "box"
        t = scope.program.type_code(kind)
        box = f"{code} = BOX({code}, {t}, (), {parameter.name!r})"
        w.emit(f"if {code} is not None: {box}" if parameter.optional else box)
    scope.locals[key] = Data(
        parameter.name,
        "PARAMETER",
        kind,
        dims,
        storage,
        code,
        mode=parameter.mode,
        optional=parameter.optional,
    )


def _constant(scope: RoutineScope, name: str) -> Value:
    data = scope.data(name)
    return data.value if data is not None and data.storage == "inline" else None


def _variable(
    scope: RoutineScope,
    w: Writer,
    d: n.DataDeclaration,
    data: Data,
    value: Value,
    whole: Whole,
) -> None:
    key, kind, dims, program = d.name.lower(), data.type, data.dims, scope.program
    if d.kind == "CONST":
        data.kind, data.readonly, data.storage = "CONST", True, "global"
        data.code = program.keep(value)
    elif dims or kind.kind not in ATOMIC:
        w.emit(f"{data.code} = {_fresh(scope, d, kind, dims, value)}")
    elif key in scope.boxed:
        data.storage = "box"
        w.emit(f"{data.code} = BOX({value!r}, {program.type_code(kind)}, (), {d.name!r})")
    else:
        data.whole = key in whole.whole and kind.kind == "num"
        if data.whole and key in whole.natural:
            data.range = (0, UNBOUNDED)
        w.emit(f"{data.code} = {value!r}")


def _fresh(
    scope: RoutineScope, d: n.DataDeclaration, kind: Type, dims: tuple[int, ...], value: Value
) -> str:
    """What makes a record, an array or an object for each call."""
    program = scope.program
    if d.initial is None and not dims and kind.make is not None:
        return f"{program.record_code(kind)}()"
    if d.initial is None and len(dims) == 1 and kind.kind in ATOMIC:
        return f"dict.fromkeys(range(1, {dims[0] + 1}), {kind.default()!r})"
    if kind.is_value:
        return f"COPY({program.keep(value)})"
    return f"ARRAY({dims!r}, {program.record_code(kind)})"
