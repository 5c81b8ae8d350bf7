"""Calls: matching arguments to parameters, and passing them by value or by reference [K §5.1]."""

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.analysis import walk
from rapidgen.runtime.compiler.context import (
    CALLS,
    CannotCompile,
    E,
    RoutineScope,
    calling,
    same_type,
)
from rapidgen.runtime.compiler.references import place_of, reference
from rapidgen.runtime.compiler.storing import by_value
from rapidgen.runtime.compiler.symbols import Parameter, Routine
from rapidgen.runtime.registry import COSTS
from rapidgen.runtime.values import NUM


def match(
    scope: RoutineScope, routine: Routine, arguments: list[n.Argument], node: n.Node
) -> list[n.Argument | None]:
    """Arguments in the order of the parameters; None where a parameter gets none."""
    parameters = routine.parameters
    found: list[n.Argument | None] = [None] * len(parameters)
    required = [i for i, p in enumerate(parameters) if not p.optional]
    at = 0
    for argument in arguments:
        if argument.name is not None:
            index = routine.by_name.get(argument.name.lower())
            if index is None:
                raise CannotCompile(f"{routine.name} has no parameter {argument.name}", node)
            if not parameters[index].optional and index in required:
                at = required.index(index) + 1
        else:
            if at >= len(required):
                raise CannotCompile(f"too many arguments for {routine.name}", node)
            index = _alternative(scope, routine, required, at, argument)
            group = parameters[index].group
            at += 1
            while group >= 0 and at < len(required) and parameters[required[at]].group == group:
                at += 1
        if found[index] is not None and argument.kind != "conditional":
            raise CannotCompile(f"{parameters[index].name} is given twice", node)
        found[index] = argument
    for i in required:
        group = parameters[i].group
        given = found[i] is not None or (
            group >= 0
            and any(
                f is not None and p.group == group for f, p in zip(found, parameters, strict=True)
            )
        )
        if not given:
            raise CannotCompile(f"{routine.name} needs {parameters[i].name}", node)
    return found


def _alternative(
    scope: RoutineScope, routine: Routine, required: list[int], at: int, argument: n.Argument
) -> int:
    """Which of several required alternatives a positional argument means: by its type."""
    first = required[at]
    group = routine.parameters[first].group
    if group < 0 or argument.value is None:
        return first
    for index in required[at:]:
        parameter = routine.parameters[index]
        if parameter.group != group:
            break
        place = place_of(scope, argument.value)
        kind = place.e.type if place else scope.expression(argument.value).type
        if parameter.type is None or same_type(kind, parameter.type):
            return index
    return first


def pass_argument(
    scope: RoutineScope, parameter: Parameter, argument: n.Argument, *, builtin: bool
) -> E:
    """Compile one argument."""
    if argument.kind == "conditional":
        return _conditional(scope, parameter, argument, builtin=builtin)
    if parameter.switch:
        return E("True", NUM)
    node = argument.value
    if node is None:
        raise CannotCompile(f"{parameter.name} needs a value", argument)
    if parameter.mode or parameter.type is None:
        return reference(scope, node, parameter, builtin=builtin)
    e = scope.value_of(node, parameter.type, (0,) * parameter.dims, parameter.name)
    code = e.code if builtin and not e.type.is_value else by_value(e, parameter.type)
    if builtin and (e.dims or e.type.kind == "record"):
        code = e.code
    return E(code, e.type, e.dims).take(e)


def _conditional(
    scope: RoutineScope, parameter: Parameter, argument: n.Argument, *, builtin: bool
) -> E:
    """`\\Opt?par`: passes the caller's optional parameter on, or its absence."""
    node = argument.value
    data = scope.locals.get(node.name.lower()) if isinstance(node, n.Name) else None
    if data is None or not data.optional:
        raise CannotCompile("a conditional argument names an optional parameter", argument)
    if parameter.switch or data.storage == "ref" or parameter.mode:
        if builtin and parameter.mode and data.storage not in ("ref", "box"):
            t = scope.program.type_code(data.type)
            code = f"(None if {data.code} is None else BOX({data.code}, {t}, {data.dims!r}))"
            return E(code, data.type, data.dims)
        if data.storage == "ref" and not parameter.mode:
            return E(f"(None if {data.code} is None else {data.code}.v)", data.type)
        return E(data.code, data.type, data.dims)
    if data.storage == "box":
        return E(f"{data.code}.v", data.type, data.dims)
    copied = bool(data.dims) or data.type.kind == "record"
    return E(f"COPY({data.code})" if copied else data.code, data.type, data.dims)


def call(scope: RoutineScope, routine: Routine, node: n.FunctionCall | n.ProcedureCall) -> E:
    """Compile a call as a Python call."""
    if routine.missing:
        scope.program.said_missing(routine.name)
        return calling(f"R.missing({routine.name!r})", routine.type or NUM)
    found = match(scope, routine, node.arguments, node)
    if routine.builtin is not None:
        return _builtin_call(scope, routine, found)
    codes, parts = [], []
    absent = False
    groups: dict[int, list[str]] = {}
    for parameter, argument in zip(routine.parameters, found, strict=True):
        if argument is None:
            absent = True
            continue
        e = pass_argument(scope, parameter, argument, builtin=False)
        parts.append(e)
        code = e.code
        if parameter.group >= 0:
            others = groups.setdefault(parameter.group, [])
            if others:  # conditional arguments, of which one may be present [K §3.10]
                code = f"ONLY_ONE({code}, {', '.join(others)})"
            others.append(e.code)
        prefix = f"v_{parameter.name.lower()}=" if parameter.optional or absent else ""
        codes.append(f"{prefix}{code}")
    code = f"{routine.code}({', '.join(codes)})"
    result = calling(code, routine.type or NUM, *parts, cost=scope.options.call)
    result.fresh = True
    return result


def _condition_code(scope: RoutineScope, node: n.Expression | None, e: E) -> str:
    """WaitUntil looks at its condition again: it gets a function, and what it reads."""
    watched = []
    for part in walk(node) if node is not None else ():
        data = scope.data(part.name) if isinstance(part, n.Name) else None
        if data is None:
            continue
        if data.storage == "cell":
            watched.append(data.code)
        elif data.type.kind == "semivalue":
            watched.append(f"{data.code}.signal.changed")
    sets = "".join(f"{code}, " for code in dict.fromkeys(watched))
    cost = e.ops * scope.options.operator + e.cost
    return f"CONDITION(lambda: {e.code}, ({sets}), {cost})"


def _builtin_call(scope: RoutineScope, routine: Routine, found: list[n.Argument | None]) -> E:
    binding = routine.builtin
    assert binding is not None
    codes, parts = ["R"], []
    for parameter, argument in zip(routine.parameters, found, strict=True):
        if argument is None:
            codes.append("None")
            continue
        e = pass_argument(scope, parameter, argument, builtin=True)
        parts.append(e)
        if routine.name == "WaitUntil" and parameter.name == "Cond":
            codes.append(_condition_code(scope, argument.value, e))
        else:
            codes.append(e.code)
    cost = COSTS[binding.cost]
    if binding.cost != "call":
        cost = int(cost * scope.options.builtin_scale)
    kind = routine.type or NUM
    result = E(
        f"{routine.code}({', '.join(codes)})",
        kind,
        cost=cost if binding.cost != "call" else scope.options.call,
        fresh=True,
        fails=True,
    ).take(*parts)
    result.fails = True
    if not binding.pure:
        result.effect = CALLS
    return result
