"""Built-ins that are so small, or know so much of the compiler, that they become code."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.base import CALLS, E
from rapidgen.runtime.values import BOOL, NUM, STRING, Type

if TYPE_CHECKING:
    from rapidgen.runtime.compiler.calls import Calls

Inline = Callable[["Calls", n.FunctionCall | n.ProcedureCall], E | None]


def _only_argument(c: "Calls", node: n.FunctionCall | n.ProcedureCall) -> n.Expression:
    if len(node.arguments) != 1 or node.arguments[0].value is None:
        c.fault(f"{node.name} takes one argument", node)
    return node.arguments[0].value


def _present(c: "Calls", node: n.FunctionCall | n.ProcedureCall) -> E:
    """Present: of a parameter; TRUE for anything that is always there [K §11]."""
    argument = _only_argument(c, node)
    data = c.locals.get(argument.name.lower()) if isinstance(argument, n.Name) else None
    if data is None or not data.optional:
        return E("True", BOOL, cost=c.options.call)
    return E(f"({data.code} is not None)", BOOL, cost=c.options.call)


def _dim(c: "Calls", node: n.FunctionCall | n.ProcedureCall) -> E | None:
    """Dim: a constant when the sizes are known."""
    if len(node.arguments) != 2:
        return None
    array, number = (a.value for a in node.arguments)
    if array is None or number is None:
        return None
    e = c.expression(array)
    which = c.value_of(number, NUM, (), "DimNo")
    if which.range is not None and which.range[0] == which.range[1]:
        index = which.range[0]
        if 1 <= index <= len(e.dims) and e.dims[index - 1]:
            size = e.dims[index - 1]
            return E(
                repr(size), NUM, cost=c.options.call, whole=True, exact=True, range=(size, size)
            )
    code = f"DIM({e.code}, {which.code})"
    result = E(code, NUM, cost=c.options.call, whole=True, exact=True, range=(1, 1 << 20))
    result.take(e, which).fails = True
    return result


def _abs(c: "Calls", node: n.FunctionCall | n.ProcedureCall) -> E:
    """Abs."""
    e = c.value_of(_only_argument(c, node), NUM, (), "argument")
    limits = None
    if e.range is not None:
        limits = (0, max(abs(e.range[0]), abs(e.range[1])))
    result = E(
        f"abs({e.code})",
        NUM,
        cost=c.options.call,
        whole=e.whole,
        exact=e.exact,
        risky=e.risky,
        range=limits,
    )
    return result.take(e)


def _str_len(c: "Calls", node: n.FunctionCall | n.ProcedureCall) -> E:
    """StrLen."""
    e = c.value_of(_only_argument(c, node), STRING, (), "argument")
    cost = int(50_000 * c.options.builtin_scale)
    result = E(f"len({e.code})", NUM, cost=cost, whole=True, exact=True, range=(0, 80))
    return result.take(e)


def _string_function(
    c: "Calls", node: n.FunctionCall | n.ProcedureCall, code: str, kinds: tuple[Type, ...]
) -> E | None:
    """A string function of runtime.py with required arguments only; else the built-in."""
    if len(node.arguments) != len(kinds) or any(a.kind != "required" for a in node.arguments):
        return None
    parts = [
        c.value_of(a.value, kind, (), "argument")
        for a, kind in zip(node.arguments, kinds, strict=True)
        if a.value is not None
    ]
    cost = int(50_000 * c.options.builtin_scale)
    inside = ", ".join(p.code for p in parts)
    return E(f"{code}({inside})", STRING, cost=cost, fails=True, exact=True).take(*parts)


def _str_part(c: "Calls", node: n.FunctionCall | n.ProcedureCall) -> E | None:
    """StrPart."""
    return _string_function(c, node, "PARTOF", (STRING, NUM, NUM))


def _position(c: "Calls", node: n.FunctionCall | n.ProcedureCall, code: str) -> E | None:
    if c.options.dialect.find_behind == "error":
        return None
    e = _string_function(c, node, code, (STRING, NUM, STRING))
    if e is not None:
        e.type, e.whole, e.range = NUM, True, (1, 81)
    return e


def _str_find(c: "Calls", node: n.FunctionCall | n.ProcedureCall) -> E | None:
    """StrFind without the switch; one character needs no set."""
    last = node.arguments[-1].value if node.arguments else None
    single = isinstance(last, n.StringLiteral) and len(last.value) == 1
    e = _position(c, node, "FIND1" if single else "FINDSET")
    if e is None:  # with \NotInSet the built-in gives an int, too
        e = c.plain_call(node)
        e.whole, e.range, e.exact = True, (1, 81), True
    return e


def _str_match(c: "Calls", node: n.FunctionCall | n.ProcedureCall) -> E | None:
    """StrMatch."""
    return _position(c, node, "FIND1")


def _is_pers(c: "Calls", node: n.FunctionCall | n.ProcedureCall) -> E:
    """IsPers: of an INOUT parameter only run time knows [K §11]."""
    place = c.place(_only_argument(c, node))
    if place is None:
        return E("False", BOOL, cost=c.options.call)
    if place.data.storage == "ref" and place.data.mode == "INOUT":
        return E(f"({place.data.code}.cell is not None)", BOOL, cost=c.options.call)
    persistent = place.data.kind == "PERS" or place.data.mode == "PERS"
    return E(repr(persistent), BOOL, cost=c.options.call)


def _is_var(c: "Calls", node: n.FunctionCall | n.ProcedureCall) -> E:
    """IsVar."""
    place = c.place(_only_argument(c, node))
    if place is None or place.data.kind == "CONST":
        return E("False", BOOL, cost=c.options.call)
    pers = _is_pers(c, node)
    return E(f"(not {pers.code})", BOOL, cost=c.options.call)


def _arg_name(c: "Calls", node: n.FunctionCall | n.ProcedureCall) -> E:
    """ArgName: of a parameter; its name is all that is passed on."""
    first = node.arguments[0].value if node.arguments else None
    if not isinstance(first, n.Name):
        c.fault("ArgName takes a parameter", node)
    codes, parts = [repr(first.name)], []
    for argument in node.arguments[1:]:
        parameter = c.known_routine("ArgName").parameters[1]  # type: ignore[union-attr]
        number = c.argument(parameter, argument, builtin=True)
        codes.append(number.code)
        parts.append(number)
    cost = int(50_000 * c.options.builtin_scale)
    e = E(f"ARGNAME(R, {', '.join(codes)})", STRING, cost=cost, exact=True).take(*parts)
    e.effect, e.fails = CALLS, True
    return e


INLINE: dict[str, Inline] = {
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

NEVER_BOXES = frozenset({*INLINE.keys() - {"argname"}, "incr", "decr", "add", "clear"})
"""Built-ins with reference parameters that need no box for a local variable."""
