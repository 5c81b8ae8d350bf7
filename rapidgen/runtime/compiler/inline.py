"""Built-ins that are so small, or know so much of the compiler, that they become code."""

from collections.abc import Callable
from typing import TypeAlias

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.calls import call, pass_argument
from rapidgen.runtime.compiler.context import CannotCompile, E, RoutineScope, calling, failing
from rapidgen.runtime.compiler.references import place_of
from rapidgen.runtime.compiler.symbols import Routine
from rapidgen.runtime.values import BOOL, NUM, STRING, Type

Inline: TypeAlias = Callable[[RoutineScope, n.FunctionCall], E | None]


def _only_argument(scope: RoutineScope, node: n.FunctionCall) -> n.Expression:
    if len(node.arguments) != 1 or node.arguments[0].value is None:
        raise CannotCompile(f"{node.name} takes one argument", node)
    return node.arguments[0].value


def _present(scope: RoutineScope, node: n.FunctionCall) -> E:
    """Present: of a parameter; TRUE for anything that is always there [K §11]."""
    argument = _only_argument(scope, node)
    data = scope.locals.get(argument.name.lower()) if isinstance(argument, n.Name) else None
    if data is None or not data.optional:
        return E("True", BOOL, cost=scope.options.call)
    return E(f"({data.code} is not None)", BOOL, cost=scope.options.call)


def _dim(scope: RoutineScope, node: n.FunctionCall) -> E | None:
    """Dim: a constant when the sizes are known."""
    if len(node.arguments) != 2:
        return None
    array, number = (a.value for a in node.arguments)
    if array is None or number is None:
        return None
    e = scope.expression(array)
    which = scope.value_of(number, NUM, (), "DimNo")
    if which.range is not None and which.range[0] == which.range[1]:
        index = which.range[0]
        if 1 <= index <= len(e.dims) and e.dims[index - 1]:
            size = e.dims[index - 1]
            return E(
                repr(size), NUM, cost=scope.options.call, whole=True, exact=True, range=(size, size)
            )
    code = f"DIM({e.code}, {which.code})"
    result = E(code, NUM, cost=scope.options.call, whole=True, exact=True, range=(1, 1 << 20))
    result.take(e, which).fails = True
    return result


def _abs(scope: RoutineScope, node: n.FunctionCall) -> E:
    """Abs."""
    e = scope.value_of(_only_argument(scope, node), NUM, (), "argument")
    limits = None
    if e.range is not None:
        limits = (0, max(abs(e.range[0]), abs(e.range[1])))
    result = E(
        f"abs({e.code})",
        NUM,
        cost=scope.options.call,
        whole=e.whole,
        exact=e.exact,
        risky=e.risky,
        range=limits,
    )
    return result.take(e)


def _str_len(scope: RoutineScope, node: n.FunctionCall) -> E:
    """StrLen."""
    e = scope.value_of(_only_argument(scope, node), STRING, (), "argument")
    cost = int(50_000 * scope.options.builtin_scale)
    result = E(f"len({e.code})", NUM, cost=cost, whole=True, exact=True, range=(0, 80))
    return result.take(e)


def _string_function(
    scope: RoutineScope, node: n.FunctionCall, code: str, kinds: tuple[Type, ...]
) -> E | None:
    """A string function of runtime.py with required arguments only; else the built-in."""
    if len(node.arguments) != len(kinds) or any(a.kind != "required" for a in node.arguments):
        return None
    parts = [
        scope.value_of(a.value, kind, (), "argument")
        for a, kind in zip(node.arguments, kinds, strict=True)
        if a.value is not None
    ]
    cost = int(50_000 * scope.options.builtin_scale)
    inside = ", ".join(p.code for p in parts)
    return E(f"{code}({inside})", STRING, cost=cost, fails=True, exact=True).take(*parts)


def _str_part(scope: RoutineScope, node: n.FunctionCall) -> E | None:
    """StrPart."""
    return _string_function(scope, node, "PARTOF", (STRING, NUM, NUM))


def _position(scope: RoutineScope, node: n.FunctionCall, code: str) -> E | None:
    if scope.options.dialect.find_behind == "error":
        return None
    e = _string_function(scope, node, code, (STRING, NUM, STRING))
    if e is not None:
        e.type, e.whole, e.range = NUM, True, (1, 81)
    return e


def _str_find(scope: RoutineScope, node: n.FunctionCall) -> E | None:
    """StrFind without the switch; one character needs no set."""
    last = node.arguments[-1].value if node.arguments else None
    single = isinstance(last, n.StringLiteral) and len(last.value) == 1
    e = _position(scope, node, "FIND1" if single else "FINDSET")
    if e is None:  # with \NotInSet the built-in gives an int, too
        e = call(scope, _builtin(scope, node), node)
        e.whole, e.range, e.exact = True, (1, 81), True
    return e


def _str_match(scope: RoutineScope, node: n.FunctionCall) -> E | None:
    """StrMatch."""
    return _position(scope, node, "FIND1")


def _is_pers(scope: RoutineScope, node: n.FunctionCall) -> E:
    """IsPers: of an INOUT parameter only run time knows [K §11]."""
    place = place_of(scope, _only_argument(scope, node))
    if place is None:
        return E("False", BOOL, cost=scope.options.call)
    if place.data.storage == "ref" and place.data.mode == "INOUT":
        return E(f"({place.data.code}.cell is not None)", BOOL, cost=scope.options.call)
    persistent = place.data.kind == "PERS" or place.data.mode == "PERS"
    return E(repr(persistent), BOOL, cost=scope.options.call)


def _is_var(scope: RoutineScope, node: n.FunctionCall) -> E:
    """IsVar."""
    place = place_of(scope, _only_argument(scope, node))
    if place is None or place.data.kind == "CONST":
        return E("False", BOOL, cost=scope.options.call)
    pers = _is_pers(scope, node)
    return E(f"(not {pers.code})", BOOL, cost=scope.options.call)


def _arg_name(scope: RoutineScope, node: n.FunctionCall) -> E:
    """ArgName: of a parameter; its name is all that is passed on."""
    first = node.arguments[0].value if node.arguments else None
    if not isinstance(first, n.Name):
        raise CannotCompile("ArgName takes a parameter", node)
    codes, parts = [repr(first.name)], []
    for given in node.arguments[1:]:
        number = pass_argument(scope, _builtin(scope, node).parameters[1], given, builtin=True)
        codes.append(number.code)
        parts.append(number)
    cost = int(50_000 * scope.options.builtin_scale)
    return calling(f"ARGNAME(R, {', '.join(codes)})", STRING, *parts, cost=cost)


def _builtin(scope: RoutineScope, node: n.FunctionCall) -> Routine:
    routine = scope.known_routine(node.name)
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

NEVER_BOXES = frozenset({*_INLINE.keys() - {"argname"}, "incr", "decr", "add", "clear"})
"""Built-ins with reference parameters that need no box for a local variable."""


def function_call(scope: RoutineScope, node: n.FunctionCall, want: Type | None) -> E:
    """Compile the call of a function; one that does not exist fails when it is reached."""
    routine = scope.known_routine(node.name)
    if routine is None or routine.kind != "FUNC":
        return failing("ERR_REFUNKFUN", node.name, want or NUM)
    inline = _INLINE.get(routine.name.lower()) if routine.node is None else None
    done = inline(scope, node) if inline is not None else None
    return call(scope, routine, node) if done is None else done
