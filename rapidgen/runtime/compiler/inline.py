"""Built-ins that are so small, or know so much of the compiler, that they become code."""

from collections.abc import Callable
from typing import TypeAlias

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime import unsupported
from rapidgen.runtime.compiler.calls import call, pass_argument
from rapidgen.runtime.compiler.context import CompiledExpression, Unit, calling, failing
from rapidgen.runtime.compiler.references import place_of
from rapidgen.runtime.compiler.symbols import CannotCompile, Routine
from rapidgen.runtime.values import BOOL, NUM, STRING, Type

Inline: TypeAlias = Callable[[Unit, n.FunctionCall], CompiledExpression | None]


def _only_argument(unit: Unit, node: n.FunctionCall) -> n.Expression:
    if len(node.arguments) != 1 or node.arguments[0].value is None:
        raise CannotCompile(f"{node.name} takes one argument", node)
    return node.arguments[0].value


def _present(unit: Unit, node: n.FunctionCall) -> CompiledExpression:
    """Present: of a parameter; TRUE for anything that is always there [K §11]."""
    argument = _only_argument(unit, node)
    data = unit.data(argument.name) if isinstance(argument, n.Name) else None
    if data is None or not data.optional:
        return CompiledExpression("True", BOOL, cost=unit.options.call)
    return CompiledExpression(f"({data.code} is not None)", BOOL, cost=unit.options.call)


def _dim(unit: Unit, node: n.FunctionCall) -> CompiledExpression | None:
    """Dim: a constant when the sizes are known."""
    if len(node.arguments) != 2:
        return None
    array, number = (a.value for a in node.arguments)
    if array is None or number is None:
        return None
    e = unit.expression(array)
    which = unit.value_of(number, NUM, (), "DimNo")
    if which.range is not None and which.range[0] == which.range[1]:
        index = which.range[0]
        if 1 <= index <= len(e.dims) and e.dims[index - 1]:
            size = e.dims[index - 1]
            return CompiledExpression(
                repr(size), NUM, cost=unit.options.call, whole=True, exact=True, range=(size, size)
            )
    code = f"DIM({e.code}, {which.code})"
    result = CompiledExpression(
        code, NUM, cost=unit.options.call, whole=True, exact=True, range=(1, 1 << 20)
    )
    result.take(e, which).fails = True
    return result


def _abs(unit: Unit, node: n.FunctionCall) -> CompiledExpression:
    """Abs."""
    e = unit.value_of(_only_argument(unit, node), NUM, (), "argument")
    limits = None
    if e.range is not None:
        limits = (0, max(abs(e.range[0]), abs(e.range[1])))
    result = CompiledExpression(
        f"abs({e.code})",
        NUM,
        cost=unit.options.call,
        whole=e.whole,
        exact=e.exact,
        risky=e.risky,
        range=limits,
    )
    return result.take(e)


def _str_len(unit: Unit, node: n.FunctionCall) -> CompiledExpression:
    """StrLen."""
    e = unit.value_of(_only_argument(unit, node), STRING, (), "argument")
    cost = int(50_000 * unit.options.builtin_scale)
    result = CompiledExpression(
        f"len({e.code})", NUM, cost=cost, whole=True, exact=True, range=(0, 80)
    )
    return result.take(e)


def _string_function(
    unit: Unit, node: n.FunctionCall, code: str, kinds: tuple[Type, ...]
) -> CompiledExpression | None:
    """A string function of runtime.py with required arguments only; else the built-in."""
    if len(node.arguments) != len(kinds) or any(a.kind != "required" for a in node.arguments):
        return None
    parts = [
        unit.value_of(a.value, kind, (), "argument")
        for a, kind in zip(node.arguments, kinds, strict=True)
        if a.value is not None
    ]
    cost = int(50_000 * unit.options.builtin_scale)
    inside = ", ".join(p.code for p in parts)
    return CompiledExpression(f"{code}({inside})", STRING, cost=cost, fails=True, exact=True).take(
        *parts
    )


def _str_part(unit: Unit, node: n.FunctionCall) -> CompiledExpression | None:
    """StrPart."""
    return _string_function(unit, node, "PARTOF", (STRING, NUM, NUM))


def _position(unit: Unit, node: n.FunctionCall, code: str) -> CompiledExpression | None:
    if unit.options.dialect.find_behind == "error":
        return None
    e = _string_function(unit, node, code, (STRING, NUM, STRING))
    if e is not None:
        e.type, e.whole, e.range = NUM, True, (1, 81)
    return e


def _str_find(unit: Unit, node: n.FunctionCall) -> CompiledExpression | None:
    """StrFind without the switch; one character needs no set."""
    last = node.arguments[-1].value if node.arguments else None
    single = isinstance(last, n.StringLiteral) and len(last.value) == 1
    e = _position(unit, node, "FIND1" if single else "FINDSET")
    if e is None:  # with \NotInSet the built-in gives an int, too
        e = call(unit, _builtin(unit, node), node)
        e.whole, e.range, e.exact = True, (1, 81), True
    return e


def _str_match(unit: Unit, node: n.FunctionCall) -> CompiledExpression | None:
    """StrMatch."""
    return _position(unit, node, "FIND1")


def _is_pers(unit: Unit, node: n.FunctionCall) -> CompiledExpression:
    """IsPers: of an INOUT parameter only run time knows [K §11]."""
    place = place_of(unit, _only_argument(unit, node))
    if place is None:
        return CompiledExpression("False", BOOL, cost=unit.options.call)
    if place.data.storage == "ref" and place.data.mode == "INOUT":
        return CompiledExpression(
            f"({place.data.code}.cell is not None)", BOOL, cost=unit.options.call
        )
    persistent = place.data.kind == "PERS" or place.data.mode == "PERS"
    return CompiledExpression(repr(persistent), BOOL, cost=unit.options.call)


def _is_var(unit: Unit, node: n.FunctionCall) -> CompiledExpression:
    """IsVar."""
    place = place_of(unit, _only_argument(unit, node))
    if place is None or place.data.kind == "CONST":
        return CompiledExpression("False", BOOL, cost=unit.options.call)
    pers = _is_pers(unit, node)
    return CompiledExpression(f"(not {pers.code})", BOOL, cost=unit.options.call)


def _arg_name(unit: Unit, node: n.FunctionCall) -> CompiledExpression:
    """ArgName: of a parameter; its name is all that is passed on."""
    first = node.arguments[0].value if node.arguments else None
    if not isinstance(first, n.Name):
        raise CannotCompile("ArgName takes a parameter", node)
    codes, parts = [repr(first.name)], []
    for given in node.arguments[1:]:
        number = pass_argument(unit, _builtin(unit, node).parameters[1], given, builtin=True)
        codes.append(number.code)
        parts.append(number)
    cost = int(50_000 * unit.options.builtin_scale)
    return calling(f"ARGNAME({', '.join(codes)})", STRING, *parts, cost=cost)


def _builtin(unit: Unit, node: n.FunctionCall) -> Routine:
    routine = unit.routine_named(node.name)
    assert routine is not None
    return routine


_INLINE: dict[str, Inline] = {
    "argname": _arg_name,
    "present": _present,
    "dim": _dim,
    "abs": _abs,
    "strlen": _str_len,
    "strpart": _str_part,
    "strfind": _str_find,
    "strmatch": _str_match,
    "ispers": _is_pers,
    "isvar": _is_var,
}


def function_call(unit: Unit, node: n.FunctionCall, expected: Type | None) -> CompiledExpression:
    """Compile the call of a function; one that does not exist fails when it is reached."""
    routine = unit.routine_named(node.name)
    if routine is None or routine.kind != "FUNC":
        if node.name.lower() in unsupported.option_routines():
            return calling(f"R.missing({node.name!r})", expected or NUM)
        return failing("ERR_REFUNKFUN", node.name, expected or NUM)
    inline = _INLINE.get(routine.name.lower()) if routine.node is None else None
    done = inline(unit, node) if inline is not None else None
    return call(unit, routine, node) if done is None else done
