"""Expressions, operators and calls as Python source.

The compiler tracks the range of whole numbers through operators. A result inside +-2^24 is an exact
single, so that its store needs no rounding; this is the largest single gain in speed. A function of
the program runs through the same call path as a procedure, built-ins get all parameters by
position.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import TypeAlias

from rapidgen.machine.io import Relation
from rapidgen.rapid.binding.arguments import ArgumentFault, match
from rapidgen.rapid.numbers import EXACT, dnum, single
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk
from rapidgen.runtime import unsupported
from rapidgen.runtime.compiler.emit.access import (
    CALLS,
    UNBOUNDED,
    CompiledExpression,
    Unit,
    by_value,
    calling,
    failing,
    place_of,
    read,
    reference,
    same_type,
)
from rapidgen.runtime.compiler.symbols import CannotCompile, FormalParameter, Routine
from rapidgen.runtime.registry import COSTS
from rapidgen.runtime.values import BOOL, DNUM, NUM, STRING, TYPES, Type, attribute

# -- Operators -------------------------------------------------------------------------------------
#
# Operators: what they take, what they cost, how large their results may be [K §3.11].


_COMPARE = {"=": "==", "<>": "!=", "<": "<", "<=": "<=", ">": ">", ">=": ">="}
_COUNTED = 1 << 52
"""A dnum counts whole numbers so far, whatever is assumed."""
POS, ORIENT = TYPES["pos"], TYPES["orient"]


def unary(unit: Unit, node: n.Unary, expected: Type | None) -> CompiledExpression:
    """Compile NOT, + and -."""
    if node.operator == "NOT":
        inner = unit.value_of(node.operand, BOOL, (), "operand of NOT")
        return CompiledExpression(f"(not {inner.code})", BOOL, ops=1).take(inner)
    inner = unit.expression(node.operand, expected)
    if inner.type.kind in ("num", "dnum"):
        if node.operator == "+":
            return inner
        limits = inner.range and (-inner.range[1], -inner.range[0])
        e = CompiledExpression(
            f"(-{inner.code})",
            inner.type,
            ops=0 if inner.literal else 1,
            whole=inner.whole,
            exact=inner.exact,
            range=limits,
            literal=inner.literal,
            risky=inner.risky,
        )
        return e.take(inner)
    if same_type(inner.type, POS) and not inner.dims:
        if node.operator == "+":
            return inner
        return CompiledExpression(f"PNEG({inner.code})", POS, ops=1, fresh=True).take(inner)
    raise CannotCompile(f"{node.operator} takes num, dnum or pos, not {inner.type.name}", node)


def binary(unit: Unit, node: n.Binary, expected: Type | None) -> CompiledExpression:
    """Compile an operator with two operands; `expected` types literals."""
    operator = node.operator
    if operator in ("AND", "OR", "XOR"):
        left = unit.value_of(node.left, BOOL, (), f"left operand of {operator}")
        right = unit.value_of(node.right, BOOL, (), f"right operand of {operator}")
        word = {"AND": "and", "OR": "or", "XOR": "is not"}[operator]
        return CompiledExpression(f"({left.code} {word} {right.code})", BOOL, ops=1).take(
            left, right
        )
    if operator in _COMPARE:
        return _comparison(unit, node)
    left, right = _operands(unit, node, expected)
    a, b = left.type, right.type
    if left.dims or right.dims:
        raise CannotCompile(f"{operator} does not take arrays", node)
    if a.kind == b.kind and a.kind in ("num", "dnum"):
        return _arithmetic(unit, node, left, right)
    if a.kind == b.kind == "string" and operator == "+":
        return CompiledExpression(
            f"CAT({left.code}, {right.code})", STRING, ops=1, fails=True
        ).take(left, right)
    function = {
        ("+", "pos", "pos"): "PADD",
        ("-", "pos", "pos"): "PSUB",
        ("*", "pos", "pos"): "PCROSS",
        ("*", "pos", "num"): "PMUL",
        ("*", "num", "pos"): "PMUL",
        ("/", "pos", "num"): "PDIV",
        ("*", "orient", "orient"): "QMUL",
    }.get((operator, a.name, b.name))
    if function is None:
        raise CannotCompile(f"{operator} does not take {a.name} and {b.name}", node)
    kind = ORIENT if function == "QMUL" else POS
    first, second = (right, left) if (a.kind, b.name) == ("num", "pos") else (left, right)
    code = f"{function}({first.code}, {second.code})"
    return CompiledExpression(code, kind, ops=1, fails=True, fresh=True).take(left, right)


def _operands(
    unit: Unit, node: n.Binary, want: Type | None
) -> tuple[CompiledExpression, CompiledExpression]:
    """Compile both operands; a literal takes the type of the other one."""
    expected = want if want is not None and want.kind in ("num", "dnum") else None
    if want is not None and want.name == "pos" and node.has_type_of_place:
        return unit.expression(node.left, want), unit.expression(node.right, want)
    if isinstance(node.left, n.Aggregate):
        right = unit.expression(node.right, expected)
        return unit.expression(node.left, right.type), right
    if isinstance(node.right, n.Aggregate):
        left = unit.expression(node.left, expected)
        return left, unit.expression(node.right, left.type)
    left = unit.expression(node.left, expected)
    right = unit.expression(node.right, expected)
    if left.type.kind != right.type.kind and {left.type.kind, right.type.kind} == {"num", "dnum"}:
        # A literal, or an operator on literals, adapts to its partner.
        left = unit.expression(node.left, right.type if right.type.kind == "dnum" else DNUM)
        right = unit.expression(node.right, left.type if left.type.kind == "dnum" else DNUM)
        if left.type.kind != right.type.kind:
            raise CannotCompile("num and dnum do not mix: use NumToDnum or DnumToNum", node)
    return left, right


def _comparison(unit: Unit, node: n.Binary) -> CompiledExpression:
    word = _COMPARE[node.operator]
    if isinstance(node.left, n.Aggregate):
        right = unit.expression(node.right)
        left = unit.expression(node.left, right.type, right.dims)
    else:
        left = unit.expression(node.left)
        right = unit.expression(node.right, left.type, left.dims)
        if left.type.kind == "num" and right.type.kind == "dnum":
            left = unit.expression(node.left, DNUM)
    if not same_type(left.type, right.type) or len(left.dims) != len(right.dims):
        raise CannotCompile(
            f"{node.operator} compares {left.type.name} with {right.type.name}", node
        )
    if not left.type.is_value:
        raise CannotCompile(f"{left.type.name} cannot be compared", node)
    if node.operator not in ("=", "<>") and left.type.kind not in ("num", "dnum"):
        raise CannotCompile(f"{node.operator} takes num or dnum, not {left.type.name}", node)
    return CompiledExpression(f"({left.code} {word} {right.code})", BOOL, ops=1).take(left, right)


def _arithmetic(
    unit: Unit, node: n.Binary, left: CompiledExpression, right: CompiledExpression
) -> CompiledExpression:
    operator, kind = node.operator, left.type
    dialect = unit.options.dialect
    if operator in ("DIV", "MOD"):
        e = CompiledExpression(
            _integer(unit, operator, left, right), kind, ops=1, fails=True, whole=True
        )
        if operator == "MOD" and right.range is not None:
            e.range = (-right.range[1], right.range[1])
        elif left.range is not None:
            limit = max(abs(left.range[0]), abs(left.range[1]))
            e.range = (-limit, limit)
        return e.take(left, right)
    e = CompiledExpression(f"({left.code} {operator} {right.code})", kind, ops=1)
    if operator == "/":
        e.fails = e.risky = True
    else:
        e.whole = left.whole and right.whole
        e.range = _range(operator, left.range, right.range) if e.whole else None
        e.risky = e.whole and _grows(operator, left, right, e)
        if operator == "*" and not e.whole:
            e.fails = e.risky = True
        elif not e.whole:
            e.risky = left.risky or right.risky or not (left.literal or right.literal)
            e.fails = e.risky
    e.take(left, right)
    if kind.kind == "dnum" and operator != "/" and not _is_counted(e):
        e.code, e.fails = f"WHOLE({e.code})", True
    if dialect.num_rounding == "operation" and kind.kind == "num" and not _is_exact(e):
        e.code, e.exact, e.risky, e.fails = f"RND({e.code})", True, False, True
    return e


def _integer(unit: Unit, operator: str, left: CompiledExpression, right: CompiledExpression) -> str:
    """Compile DIV or MOD.

    A whole left operand and a positive literal on the right need no call.
    """
    dialect = unit.options.dialect
    plain = dialect.integer_division == "truncate" and dialect.negative_mod == "allow"
    if plain and left.whole and right.range is not None and right.range[0] > 0 and right.whole:
        python = "//" if operator == "DIV" else "%"
        a, b = left.code, right.code
        if left.range is not None and left.range[0] >= 0:
            return f"({a} {python} {b})"
        return f"(_y {python} {b} if (_y := {a}) >= 0 else -(-_y {python} {b}))"
    return f"{operator}({left.code}, {right.code})"


def _is_counted(e: CompiledExpression) -> bool:
    """Return True if a dnum represents every possible result."""
    return e.range is not None and e.range[0] >= -_COUNTED and e.range[1] <= _COUNTED


def _is_exact(e: CompiledExpression) -> bool:
    """Return True if no single needs rounding."""
    return e.whole and e.range is not None and e.range[0] >= -EXACT and e.range[1] <= EXACT


def _grows(
    operator: str, left: CompiledExpression, right: CompiledExpression, e: CompiledExpression
) -> bool:
    """Return True if a whole result may leave the range of a single.

    Sums with small operands do not count.
    """
    if e.range is not None and max(abs(e.range[0]), abs(e.range[1])) < UNBOUNDED:
        return False
    return operator == "*" or not (_is_exact(left) or _is_exact(right))


def _range(
    operator: str, a: tuple[int, int] | None, b: tuple[int, int] | None
) -> tuple[int, int] | None:
    if a is None or b is None:
        return None
    if operator == "+":
        return a[0] + b[0], a[1] + b[1]
    if operator == "-":
        return a[0] - b[1], a[1] - b[0]
    ends = [x * y for x in a for y in b]
    return min(ends), max(ends)


# -- Calls -----------------------------------------------------------------------------------------
#
# Calls: matching arguments to parameters, and passing them by value or by reference [K §5.1].


_FAULTS = {
    ArgumentFault.SURPLUS: "too many arguments for {0}",
    ArgumentFault.UNKNOWN: "{0} has no parameter {1}",
    ArgumentFault.TWICE: "{1} is given twice",
}


def _matched(
    unit: Unit, routine: Routine, arguments: list[n.Argument], node: n.Node
) -> list[n.Argument | None]:
    """Return arguments in the order of the parameters.

    None marks a parameter without an argument. The compiler accepts an order that only the checker
    reports. Of alternatives, run time finds duplicates.
    """
    parameters = routine.parameters
    result = match(parameters, arguments, lambda a, among: _meant(unit, parameters, a, among))
    for pair in result.pairs:
        argument = pair.argument
        for misfit in pair.misfits:
            # One of two conditional arguments for a parameter may be absent: a check at run time
            # decides.
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
    """Return the alternative of a positional argument by its type."""
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
    """Compile `\\Opt?par`: pass an optional parameter, or its absence."""
    node = argument.value
    data = unit.data(node.name) if isinstance(node, n.Name) else None
    if data is None or not data.optional:
        raise CannotCompile("a conditional argument names an optional parameter", argument)
    if parameter.switch or data.storage == "ref" or parameter.mode:
        if builtin and parameter.mode and data.storage not in ("ref", "box"):
            t = unit.keep(data.type)
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
    """Compile the condition of WaitUntil as a function.

    WaitUntil evaluates it repeatedly and needs the data that it reads.
    """
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
    """Iterate over comparisons of signals in an expected condition."""
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
    """Return the signal that an expression reads, "" without one."""
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


# -- Inlined built-ins -----------------------------------------------------------------------------
#
# Built-ins that are so small, or know so much of the compiler, that they become code.


Inline: TypeAlias = Callable[[Unit, n.FunctionCall], CompiledExpression | None]


def _only_argument(unit: Unit, node: n.FunctionCall) -> n.Expression:
    if len(node.arguments) != 1 or node.arguments[0].value is None:
        raise CannotCompile(f"{node.name} takes one argument", node)
    return node.arguments[0].value


def _present(unit: Unit, node: n.FunctionCall) -> CompiledExpression:
    """Compile Present: TRUE for data that always exist [K §11]."""
    argument = _only_argument(unit, node)
    data = unit.data(argument.name) if isinstance(argument, n.Name) else None
    if data is None or not data.optional:
        return CompiledExpression("True", BOOL, cost=unit.options.call)
    return CompiledExpression(f"({data.code} is not None)", BOOL, cost=unit.options.call)


def _dim(unit: Unit, node: n.FunctionCall) -> CompiledExpression | None:
    """Compile Dim: a constant if the sizes are known."""
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
    """Compile Abs."""
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
    """Compile StrLen."""
    e = unit.value_of(_only_argument(unit, node), STRING, (), "argument")
    cost = int(50_000 * unit.options.builtin_scale)
    result = CompiledExpression(
        f"len({e.code})", NUM, cost=cost, whole=True, exact=True, range=(0, 80)
    )
    return result.take(e)


def _string_function(
    unit: Unit, node: n.FunctionCall, code: str, kinds: tuple[Type, ...]
) -> CompiledExpression | None:
    """Compile a string function of support.py.

    Only required arguments are possible; other calls use the built-in.
    """
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
    """Compile StrPart."""
    return _string_function(unit, node, "PARTOF", (STRING, NUM, NUM))


def _position(unit: Unit, node: n.FunctionCall, code: str) -> CompiledExpression | None:
    if unit.options.dialect.find_past_end == "error":
        return None
    e = _string_function(unit, node, code, (STRING, NUM, STRING))
    if e is not None:
        e.type, e.whole, e.range = NUM, True, (1, 81)
    return e


def _str_find(unit: Unit, node: n.FunctionCall) -> CompiledExpression | None:
    """Compile StrFind without the switch.

    One character needs no set.
    """
    last = node.arguments[-1].value if node.arguments else None
    single = isinstance(last, n.StringLiteral) and len(last.value) == 1
    e = _position(unit, node, "FIND1" if single else "FINDSET")
    if e is None:  # With \NotInSet the built-in also returns an int.
        e = call(unit, _builtin(unit, node), node)
        e.whole, e.range, e.exact = True, (1, 81), True
    return e


def _str_match(unit: Unit, node: n.FunctionCall) -> CompiledExpression | None:
    """Compile StrMatch."""
    return _position(unit, node, "FIND1")


def _is_pers(unit: Unit, node: n.FunctionCall) -> CompiledExpression:
    """Compile IsPers: run time decides for an INOUT parameter [K §11]."""
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
    """Compile IsVar."""
    place = place_of(unit, _only_argument(unit, node))
    if place is None or place.data.kind == "CONST":
        return CompiledExpression("False", BOOL, cost=unit.options.call)
    pers = _is_pers(unit, node)
    return CompiledExpression(f"(not {pers.code})", BOOL, cost=unit.options.call)


def _arg_name(unit: Unit, node: n.FunctionCall) -> CompiledExpression:
    """Compile ArgName, which receives only the name of a parameter."""
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
    """Compile a function call; an unknown function fails when executed."""
    routine = unit.routine_named(node.name)
    if routine is None or routine.kind != "FUNC":
        if node.name.lower() in unsupported.option_routines():
            return calling(f"R.missing({node.name!r})", expected or NUM)
        return failing("ERR_REFUNKFUN", node.name, expected or NUM)
    inline = _INLINE.get(routine.name.lower()) if routine.node is None else None
    done = inline(unit, node) if inline is not None else None
    return call(unit, routine, node) if done is None else done


# -- Expressions -----------------------------------------------------------------------------------
#
# Expressions: typed Python source, with what it costs and touches.


def compile_expression(
    unit: Unit, node: n.Expression, expected: Type | None, dims: tuple[int, ...]
) -> CompiledExpression:
    """Compile any expression; a signal yields the signal itself."""
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
    raise CannotCompile("an inlined position is permitted only as a target", node)


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
    """Return a part of undeclared data, of the type of its place."""
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
    cls = unit.keep(expected.make)
    return CompiledExpression(f"{cls}({inside})", expected, fresh=True).take(*parts)
