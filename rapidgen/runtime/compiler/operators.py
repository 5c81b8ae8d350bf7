"""Operators: what they take, what they cost, how large their results may be [K §3.11]."""

from rapidgen.rapid.numbers import EXACT
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.context import UNBOUNDED, CompiledExpression, Unit, same_type
from rapidgen.runtime.compiler.symbols import CannotCompile
from rapidgen.runtime.values import BOOL, DNUM, STRING, TYPES, Type

_COMPARE = {"=": "==", "<>": "!=", "<": "<", "<=": "<=", ">": ">", ">=": ">="}
_COUNTED = 1 << 52
"""A dnum counts whole numbers so far, whatever is assumed."""
POS, ORIENT = TYPES["pos"], TYPES["orient"]


def unary(unit: Unit, node: n.Unary, expected: Type | None) -> CompiledExpression:
    """NOT, + and -."""
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
    """Compile an operator between two operands; `want` types literals."""
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
    """Both operands; a literal takes the type of the other one."""
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
    """DIV or MOD; a whole left and a positive literal right side need no call."""
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
    """Whether a dnum holds the result whatever it is."""
    return e.range is not None and e.range[0] >= -_COUNTED and e.range[1] <= _COUNTED


def _is_exact(e: CompiledExpression) -> bool:
    """Whether no single would have to be rounded."""
    return e.whole and e.range is not None and e.range[0] >= -EXACT and e.range[1] <= EXACT


def _grows(
    operator: str, left: CompiledExpression, right: CompiledExpression, e: CompiledExpression
) -> bool:
    """Whether a whole result may leave the range of a single: not by adding something small."""
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
