"""Calls: matching arguments to parameters, and passing them by value or by reference [K §5.1]."""

from collections.abc import Iterator, Sequence

from rapidgen.machine.io import Relation
from rapidgen.rapid.binding.arguments import ArgumentFault, match
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk
from rapidgen.runtime.compiler.context import CALLS, CompiledExpression, Unit, calling, same_type
from rapidgen.runtime.compiler.references import place_of, reference
from rapidgen.runtime.compiler.symbols import CannotCompile, FormalParameter, Routine
from rapidgen.runtime.compiler.value_copies import by_value
from rapidgen.runtime.registry import COSTS
from rapidgen.runtime.values import BOOL, NUM, STRING

_FAULTS = {
    ArgumentFault.SURPLUS: "too many arguments for {0}",
    ArgumentFault.UNKNOWN: "{0} has no parameter {1}",
    ArgumentFault.TWICE: "{1} is given twice",
}


def _matched(
    unit: Unit, routine: Routine, arguments: list[n.Argument], node: n.Node
) -> list[n.Argument | None]:
    """Arguments in the order of the parameters; None where a parameter gets none.

    An order that only the checker minds is taken; of alternatives run time finds two.
    """
    parameters = routine.parameters
    result = match(parameters, arguments, lambda a, among: _meant(unit, parameters, a, among))
    for pair in result.pairs:
        argument = pair.argument
        for misfit in pair.misfits:
            # Of two conditional arguments for one parameter one may be absent: run time tells.
            if misfit not in _FAULTS or (
                misfit is ArgumentFault.TWICE and argument.kind == "conditional"
            ):
                continue
            name = argument.name if pair.parameter < 0 else parameters[pair.parameter].name
            raise CannotCompile(_FAULTS[misfit].format(routine.name, name), node)
    if result.missing:
        raise CannotCompile(f"{routine.name} needs {parameters[result.missing[0]].name}", node)
    return result.in_order(len(parameters))


def _meant(
    unit: Unit, parameters: Sequence[FormalParameter], argument: n.Argument, among: Sequence[int]
) -> int:
    """Which of several required alternatives a positional argument means: by its type."""
    if argument.value is None:
        return among[0]
    place = place_of(unit, argument.value)
    kind = place.e.type if place else unit.expression(argument.value).type
    types = [parameters[i].type for i in among]
    return next(
        (i for i, t in zip(among, types, strict=True) if t is None or same_type(kind, t)), among[0]
    )


def pass_argument(
    unit: Unit, parameter: FormalParameter, argument: n.Argument, *, builtin: bool
) -> CompiledExpression:
    """Compile one argument."""
    if argument.kind == "conditional":
        return _conditional(unit, parameter, argument, builtin=builtin)
    if parameter.switch:
        return CompiledExpression("True", NUM)
    node = argument.value
    if node is None:
        raise CannotCompile(f"{parameter.name} needs a value", argument)
    if parameter.mode or parameter.type is None:
        return reference(unit, node, parameter, builtin=builtin)
    e = unit.value_of(node, parameter.type, (0,) * parameter.dims, parameter.name)
    code = e.code if builtin and not e.type.is_value else by_value(e, parameter.type)
    if builtin and (e.dims or e.type.kind == "record"):
        code = e.code
    return CompiledExpression(code, e.type, e.dims).take(e)


def _conditional(
    unit: Unit, parameter: FormalParameter, argument: n.Argument, *, builtin: bool
) -> CompiledExpression:
    """`\\Opt?par`: passes the caller's optional parameter on, or its absence."""
    node = argument.value
    data = unit.data(node.name) if isinstance(node, n.Name) else None
    if data is None or not data.optional:
        raise CannotCompile("a conditional argument names an optional parameter", argument)
    if parameter.switch or data.storage == "ref" or parameter.mode:
        if builtin and parameter.mode and data.storage not in ("ref", "box"):
            t = unit.linker.keep(data.type)
            code = f"(None if {data.code} is None else BOX({data.code}, {t}, {data.dims!r}))"
            return CompiledExpression(code, data.type, data.dims)
        if data.storage == "ref" and not parameter.mode:
            return CompiledExpression(
                f"(None if {data.code} is None else {data.code}.v)", data.type
            )
        return CompiledExpression(data.code, data.type, data.dims)
    if data.storage == "box":
        return CompiledExpression(f"{data.code}.v", data.type, data.dims)
    copied = bool(data.dims) or data.type.kind == "record"
    return CompiledExpression(f"COPY({data.code})" if copied else data.code, data.type, data.dims)


def call(
    unit: Unit, routine: Routine, node: n.FunctionCall | n.ProcedureCall
) -> CompiledExpression:
    """Compile a call as a Python call."""
    if routine.missing:
        return calling(f"R.missing({routine.name!r})", routine.type or NUM)
    found = _matched(unit, routine, node.arguments, node)
    if routine.builtin is not None:
        return _builtin_call(unit, routine, found)
    codes, parts = [], []
    absent = False
    groups: dict[int, list[str]] = {}
    for parameter, argument in zip(routine.parameters, found, strict=True):
        if argument is None:
            absent = True
            continue
        e = pass_argument(unit, parameter, argument, builtin=False)
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
    result = calling(code, routine.type or NUM, *parts, cost=unit.options.call)
    result.fresh = True
    return result


def _condition_code(unit: Unit, node: n.Expression | None, e: CompiledExpression) -> str:
    """WaitUntil looks at its condition again: it gets a function, and what it reads."""
    watched, reads = [], []
    for part in walk(node) if node is not None else ():
        if not isinstance(part, n.Name):
            continue
        data = unit.data(part.name)
        if data is None:
            continue
        if data.storage == "cell":
            watched.append(data.code)
        elif data.type.kind == "semivalue":
            watched.append(f"{data.code}.signal.changed")
        if data.kind != "CONST" and not data.dims and data.type in (NUM, BOOL, STRING):
            reads.append(f"({data.name!r}, {unit.expression(part).code})")
        elif data.type.kind == "semivalue":
            reads.append(f"({data.name!r}, {data.code}.signal.value)")
    sets = "".join(f"{code}, " for code in dict.fromkeys(watched))
    cost = e.ops * unit.options.operator + e.cost
    values = "".join(f"{code}, " for code in dict.fromkeys(reads))
    signals = "".join(f"{code}, " for code in _awaited(unit, node, holds=True))
    own = any(
        isinstance(part, n.FunctionCall)
        and (routine := unit.routine_named(part.name)) is not None
        and routine.node is not None
        for part in (walk(node) if node is not None else ())
    )
    report = f"lambda: ({values}), lambda: ({signals})"
    return f"CONDITION(lambda: {e.code}, ({sets}), {cost}, {report}, {own})"


_INVERSE: dict[str, Relation] = {"=": "<>", "<>": "=", "<": ">=", ">=": "<", ">": "<=", "<=": ">"}
_READING = frozenset(("dinput", "doutput", "ginput", "goutput", "ainput", "aoutput", "testdi"))


def _awaited(unit: Unit, node: n.Expression | None, *, holds: bool) -> Iterator[str]:
    """Comparisons of signals in a condition that is to hold, or not to."""
    match node:
        case n.Parenthesis():
            yield from _awaited(unit, node.inner, holds=holds)
        case n.Unary(operator="NOT"):
            yield from _awaited(unit, node.operand, holds=not holds)
        case n.Binary(operator="AND" | "OR" | "XOR"):
            yield from _awaited(unit, node.left, holds=holds)
            yield from _awaited(unit, node.right, holds=holds)
        case n.Binary() if node.operator in _INVERSE:
            signal = _signal(unit, node.left)
            if signal:
                relation = node.operator if holds else _INVERSE[node.operator]
                value = unit.expression(node.right).code
                yield f"AWAITED({signal}, {relation!r}, {value})"
        case n.FunctionCall() if node.name.lower() == "testdi":
            yield f"AWAITED({_signal(unit, node)}, '=', {int(holds)})"


def _signal(unit: Unit, node: n.Expression) -> str:
    """The signal that an expression reads; empty: none."""
    if isinstance(node, n.FunctionCall) and node.name.lower() in _READING and node.arguments:
        node = node.arguments[0].value or node
    data = unit.data(node.name) if isinstance(node, n.Name) else None
    return f"{data.code}.signal" if data is not None and data.type.kind == "semivalue" else ""


def _builtin_call(
    unit: Unit, routine: Routine, found: list[n.Argument | None]
) -> CompiledExpression:
    binding = routine.builtin
    assert binding is not None
    codes, parts = ["R"], []
    for parameter, argument in zip(routine.parameters, found, strict=True):
        if argument is None:
            codes.append("None")
            continue
        e = pass_argument(unit, parameter, argument, builtin=True)
        parts.append(e)
        if parameter.name.lower() in routine.lazy:
            codes.append(_condition_code(unit, argument.value, e))
        else:
            codes.append(e.code)
    cost = COSTS[binding.cost]
    if binding.cost != "call":
        cost = int(cost * unit.options.builtin_scale)
    kind = routine.type or NUM
    code = f"{routine.code}({', '.join(codes)})"
    result = CompiledExpression(
        f"WHOLE({code})" if kind.kind == "dnum" else code,
        kind,
        cost=cost if binding.cost != "call" else unit.options.call,
        fresh=True,
        fails=True,
    ).take(*parts)
    result.fails = True
    if not binding.pure:
        result.effect = CALLS
    return result
