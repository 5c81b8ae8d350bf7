"""Expressions: typed Python source, with what it costs and touches."""

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.base import CALLS, EXACT, SHARED, UNBOUNDED, CompilerBase, E
from rapidgen.runtime.compiler.symbols import Data, Routine
from rapidgen.runtime.values import BOOL, DNUM, NUM, STRING, TYPES, Type, attribute, single

_COMPARE = {"=": "==", "<>": "!=", "<": "<", "<=": "<=", ">": ">", ">=": ">="}
_LARGEST = "3.4028234663852886e+38"
_SMALLEST = "1.1754943508222875e-38"
"""Below it a single has fewer digits."""
POS, ORIENT = TYPES["pos"], TYPES["orient"]


def same_type(a: Type, b: Type) -> bool:
    """Type equality after aliases [K §2.17]."""
    return a is b or a.name == b.name


class Expressions(CompilerBase):
    """Compiles expressions."""

    # -- storing ---------------------------------------------------------------------------------

    def rounded(self, e: E, kind: Type) -> str:
        """Code of `e` as a num that is stored, passed or returned: rounded where it has to be."""
        if kind.kind != "num" or e.exact:
            return e.code
        if e.whole and e.range is not None and e.range[0] >= -EXACT and e.range[1] <= EXACT:
            return e.code
        if e.whole:
            return f"(_x if -{EXACT} <= (_x := {e.code}) <= {EXACT} else RND(_x))"
        if e.risky:
            split = f"(_t := (_y := {e.code}) * 536870913.0) - (_t - _y)"
            return f"(_x if {_normal(f'(_x := {split})')} else RND(_y))"
        return f"((_t := (_y := {e.code}) * 536870913.0) - (_t - _y))"

    def store_lines(self, target: str, e: E, kind: Type, *, keep: bool = False) -> list[str]:
        """Statements that store `e` in a simple Python target, rounded.

        Rounding splits at 24 bits (Veltkamp), which is exact inside the normal range; what may
        leave it is tested, and NaN takes the slow way, too.
        """
        if kind.kind != "num" or e.exact:
            return [f"{target} = {e.code}"]
        if e.whole:
            low, high = e.range if e.range is not None else (-EXACT - 1, EXACT + 1)
            if low >= -EXACT and high <= EXACT:
                return [f"{target} = {e.code}"]
            held = "_x" if keep and e.risky else target
            inside = f"{held} <= {EXACT}" if low >= -EXACT else f"-{EXACT} <= {held} <= {EXACT}"
            lines = [f"{held} = {e.code}", f"if not {inside}: {held} = RND({held})"]
            return lines if held == target else [*lines, f"{target} = {held}"]
        if not e.risky:
            return [f"{target} = (_t := (_y := {e.code}) * 536870913.0) - (_t - _y)"]
        # A failing store leaves the target as it was; without ERROR nobody sees a local again.
        held = "_x" if keep else target
        lines = [
            f"{held} = (_t := (_y := {e.code}) * 536870913.0) - (_t - _y)",
            f"if not ({_normal(held)}): {held} = RND(_y)",
        ]
        if keep:
            lines.append(f"{target} = {held}")
        return lines

    def by_value(self, e: E, kind: Type) -> str:
        """Code of a value that the receiver may keep: rounded, or copied."""
        if e.dims or kind.kind == "record":
            if e.fresh:
                return e.code
            return f"COPY({e.code})" if e.dims else f"{e.code}.copy()"
        return self.rounded(e, kind)

    # -- expressions -----------------------------------------------------------------------------

    def expression(
        self, node: n.Expression, want: Type | None = None, dims: tuple[int, ...] | None = None
    ) -> E:
        """Compile an expression to a value (signals are read)."""
        e = self._any(node, want, dims or ())
        if e.type.kind == "semivalue":
            value = E(f"{e.code}.value", NUM, exact=True, effect=SHARED, fails=e.fails)
            return value.take(e)
        return e

    def value_of(
        self, node: n.Expression, kind: Type, dims: tuple[int, ...] = (), what: str = "value"
    ) -> E:
        """Compile an expression that has to have a given type."""
        e = self.expression(node, kind, dims)
        if not same_type(e.type, kind):
            self.fault(f"the {what} is {e.type.name}, not {kind.name}", node)
        if len(e.dims) != len(dims):
            self.fault(f"the {what} has {len(e.dims)} dimensions, not {len(dims)}", node)
        return e

    def condition(self, node: n.Expression) -> E:
        """Compile a bool."""
        return self.value_of(node, BOOL, (), "condition")

    def _any(self, node: n.Expression, want: Type | None, dims: tuple[int, ...]) -> E:
        match node:
            case n.NumberLiteral():
                return self._number(node, want)
            case n.StringLiteral():
                return E(repr(node.value), STRING, literal=True)
            case n.BoolLiteral():
                return E(repr(node.value), BOOL, literal=True)
            case n.Name():
                return self._name(node, want)
            case n.Index():
                return self._index(node)
            case n.Member():
                return self._member(node)
            case n.FunctionCall():
                return self._function_call(node, want)
            case n.Aggregate():
                return self._aggregate(node, want, dims)
            case n.Unary():
                return self._unary(node, want)
            case n.Binary():
                return self._binary(node, want)
            case n.Parenthesis():
                return self._any(node.inner, want, dims)
            case n.Placeholder():
                return E(
                    "FAIL('ERR_EXECPHR')", want or NUM, dims, fails=True, effect=SHARED, exact=True
                )
        self.fault("an inlined position stands only for a target", node)

    def _number(self, node: n.NumberLiteral, want: Type | None) -> E:
        value = node.value
        if want is not None and want.kind == "dnum":
            code = repr(value)
            return E(code, DNUM, literal=True, whole=isinstance(value, int))
        try:
            value = single(value)
        except OverflowError:
            return E(repr(node.value), DNUM, literal=True)
        if isinstance(value, int):
            return E(repr(value), NUM, literal=True, whole=True, exact=True, range=(value, value))
        return E(repr(value), NUM, literal=True, exact=True)

    def data(self, name: str) -> Data | None:
        """What a name stands for when it is a datum."""
        key = name.lower()
        return self.locals.get(key) or self.program.find_data(self.module, key)

    def _name(self, node: n.Name, want: Type | None) -> E:
        data = self.data(node.name)
        if data is None:
            unknown = f"FAIL('ERR_REFUNKDAT', {node.name!r})"
            return E(unknown, want or NUM, fails=True, effect=SHARED, exact=True)
        return self.read(data)

    def read(self, data: Data) -> E:
        """Read a whole datum."""
        code, effect, fails = self.holder(data)
        kind, dims = data.type, data.dims
        if data.storage == "inline":
            value = data.value
            whole = isinstance(value, int) and not isinstance(value, bool)
            return E(
                repr(value),
                kind,
                whole=whole,
                exact=True,
                range=(value, value) if whole else None,
            )
        if data.storage in ("box", "ref", "cell"):
            code = f"{code}.v"
        if data.storage == "cell" and self.options.switching:
            code = f"R.touch({data.code}.v)"
            effect = CALLS
        return E(
            code,
            kind,
            dims,
            effect=effect,
            fails=fails,
            exact=True,
            whole=data.whole,
            range=data.range,
        )

    def holder(self, data: Data) -> tuple[str, int, bool]:
        """Code of what keeps a datum, its effect, and whether reaching it may fail."""
        effect = SHARED if data.storage in ("global", "cell") and data.kind != "CONST" else 0
        if data.storage in ("ref", "object"):
            effect = SHARED
        if data.optional:
            return f"PRESENT({data.code})", effect, True
        return data.code, effect, False

    def index_code(self, node: n.Expression) -> E:
        """Compile an index; a whole float finds the same element as an int."""
        return self.value_of(node, NUM, (), "index")

    def _index(self, node: n.Index) -> E:
        base = self._any(node.base, None, ())
        if len(base.dims) != len(node.indices):
            self.fault("the number of indices is not the number of dimensions", node)
        indices = [self.index_code(i) for i in node.indices]
        code = base.code + "".join(f"[{i.code}]" for i in indices)
        e = E(code, base.type, ops=len(indices), fails=True, exact=True)
        return e.take(base, *indices)

    def _member(self, node: n.Member) -> E:
        base = self._any(node.base, None, ())
        kind = base.type.component(node.component.lower())
        if kind is None or base.dims:
            self.fault(f"{base.type.name} has no component {node.component}", node)
        return E(f"{base.code}.{attribute(node.component)}", kind, ops=1, exact=True).take(base)

    def _function_call(self, node: n.FunctionCall, want: Type | None) -> E:
        routine = self.program.find_routine(self.module, node.name.lower())
        if routine is None or routine.kind != "FUNC":
            unknown = f"FAIL('ERR_REFUNKFUN', {node.name!r})"
            return E(unknown, want or NUM, fails=True, effect=SHARED, exact=True)
        return self.call(routine, node)

    def _aggregate(self, node: n.Aggregate, want: Type | None, dims: tuple[int, ...]) -> E:
        if want is None:
            self.fault("an aggregate has no type here", node)
        if dims:
            if dims[0] not in (0, len(node.members)):
                self.fault(f"{len(node.members)} members for {dims[0]} elements", node)
            parts = [self.value_of(m, want, dims[1:], "member") for m in node.members]
            inside = ", ".join(
                f"{i}: {self.by_value(p, want)}" for i, p in enumerate(parts, start=1)
            )
            return E(f"{{{inside}}}", want, (len(parts), *dims[1:]), fresh=True).take(*parts)
        if want.kind != "record" or want.make is None:
            self.fault(f"an aggregate is no {want.name}", node)
        if len(want.components) != len(node.members):
            self.fault(f"{want.name} has {len(want.components)} components", node)
        parts = [
            self.value_of(m, kind, (), "component")
            for m, (_, kind) in zip(node.members, want.components, strict=True)
        ]
        inside = ", ".join(
            self.by_value(p, kind) for p, (_, kind) in zip(parts, want.components, strict=True)
        )
        cls = self.program.record_code(want)
        return E(f"{cls}({inside})", want, fresh=True).take(*parts)

    def _unary(self, node: n.Unary, want: Type | None) -> E:
        if node.operator == "NOT":
            inner = self.value_of(node.operand, BOOL, (), "operand of NOT")
            return E(f"(not {inner.code})", BOOL, ops=1).take(inner)
        inner = self.expression(node.operand, want)
        if inner.type.kind in ("num", "dnum"):
            if node.operator == "+":
                return inner
            limits = inner.range and (-inner.range[1], -inner.range[0])
            e = E(
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
            return E(f"PNEG({inner.code})", POS, ops=1, fresh=True).take(inner)
        self.fault(f"{node.operator} takes num, dnum or pos, not {inner.type.name}", node)

    # -- operators -------------------------------------------------------------------------------

    def _binary(self, node: n.Binary, want: Type | None) -> E:
        operator = node.operator
        if operator in ("AND", "OR", "XOR"):
            left = self.value_of(node.left, BOOL, (), f"left operand of {operator}")
            right = self.value_of(node.right, BOOL, (), f"right operand of {operator}")
            word = {"AND": "and", "OR": "or", "XOR": "is not"}[operator]
            return E(f"({left.code} {word} {right.code})", BOOL, ops=1).take(left, right)
        if operator in _COMPARE:
            return self._comparison(node)
        left, right = self._operands(node, want)
        a, b = left.type, right.type
        if left.dims or right.dims:
            self.fault(f"{operator} does not take arrays", node)
        if a.kind == b.kind and a.kind in ("num", "dnum"):
            return self._arithmetic(node, left, right)
        if a.kind == b.kind == "string" and operator == "+":
            return E(f"CAT({left.code}, {right.code})", STRING, ops=1, fails=True).take(left, right)
        function = {
            ("+", "pos", "pos"): "PADD",
            ("-", "pos", "pos"): "PSUB",
            ("*", "pos", "pos"): "PCROSS",
            ("*", "pos", "num"): "PMUL",
            ("*", "num", "pos"): "PMUL",
            ("*", "orient", "orient"): "QMUL",
        }.get((operator, a.name, b.name))
        if function is None:
            self.fault(f"{operator} does not take {a.name} and {b.name}", node)
        kind = ORIENT if function == "QMUL" else POS
        first, second = (right, left) if (a.kind, b.name) == ("num", "pos") else (left, right)
        code = f"{function}({first.code}, {second.code})"
        return E(code, kind, ops=1, fails=True, fresh=True).take(left, right)

    def _operands(self, node: n.Binary, want: Type | None) -> tuple[E, E]:
        """Both operands; a literal takes the type of the other one."""
        wanted = want if want is not None and want.kind in ("num", "dnum") else None
        if isinstance(node.left, n.Aggregate):
            right = self.expression(node.right, wanted)
            return self.expression(node.left, right.type), right
        if isinstance(node.right, n.Aggregate):
            left = self.expression(node.left, wanted)
            return left, self.expression(node.right, left.type)
        left = self.expression(node.left, wanted)
        right = self.expression(node.right, wanted)
        if left.type.kind != right.type.kind and {left.type.kind, right.type.kind} == {
            "num",
            "dnum",
        }:
            # A literal, or an operator on literals, adapts to its partner.
            left = self.expression(node.left, right.type if right.type.kind == "dnum" else DNUM)
            right = self.expression(node.right, left.type if left.type.kind == "dnum" else DNUM)
            if left.type.kind != right.type.kind:
                self.fault("num and dnum do not mix: use NumToDnum or DnumToNum", node)
        return left, right

    def _comparison(self, node: n.Binary) -> E:
        word = _COMPARE[node.operator]
        if isinstance(node.left, n.Aggregate):
            right = self.expression(node.right)
            left = self.expression(node.left, right.type, right.dims)
        else:
            left = self.expression(node.left)
            right = self.expression(node.right, left.type, left.dims)
            if left.type.kind == "num" and right.type.kind == "dnum":
                left = self.expression(node.left, DNUM)
        if not same_type(left.type, right.type) or len(left.dims) != len(right.dims):
            self.fault(f"{node.operator} compares {left.type.name} with {right.type.name}", node)
        if not left.type.is_value:
            self.fault(f"{left.type.name} cannot be compared", node)
        if node.operator not in ("=", "<>") and left.type.kind not in ("num", "dnum"):
            self.fault(f"{node.operator} takes num or dnum, not {left.type.name}", node)
        return E(f"({left.code} {word} {right.code})", BOOL, ops=1).take(left, right)

    def _arithmetic(self, node: n.Binary, left: E, right: E) -> E:
        operator, kind = node.operator, left.type
        dialect = self.options.dialect
        if operator in ("DIV", "MOD"):
            e = E(self._integer(operator, left, right), kind, ops=1, fails=True, whole=True)
            if operator == "MOD" and right.range is not None:
                e.range = (-right.range[1], right.range[1])
            elif left.range is not None:
                limit = max(abs(left.range[0]), abs(left.range[1]))
                e.range = (-limit, limit)
            return e.take(left, right)
        e = E(f"({left.code} {operator} {right.code})", kind, ops=1)
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
        if dialect.num_rounding == "operation" and kind.kind == "num" and not _is_exact(e):
            e.code, e.exact, e.risky, e.fails = f"RND({e.code})", True, False, True
        return e

    def _integer(self, operator: str, left: E, right: E) -> str:
        """DIV or MOD; a whole left and a positive literal right side need no call."""
        dialect = self.options.dialect
        plain = dialect.integer_division == "truncate" and dialect.negative_mod == "allow"
        if plain and left.whole and right.range is not None and right.range[0] > 0 and right.whole:
            python = "//" if operator == "DIV" else "%"
            a, b = left.code, right.code
            if left.range is not None and left.range[0] >= 0:
                return f"({a} {python} {b})"
            return f"(_y {python} {b} if (_y := {a}) >= 0 else -(-_y {python} {b}))"
        return f"{operator}({left.code}, {right.code})"

    def known_routine(self, name: str) -> Routine | None:
        """A routine by name, as seen from this routine's module."""
        return self.program.find_routine(self.module, name.lower())


def _normal(code: str) -> str:
    """Test whether a rounded value is a normal single, or 0; evaluates `code` first and once."""
    name = "_x" if ":=" in code else code
    return (
        f"{_SMALLEST} <= {code} <= {_LARGEST} or -{_LARGEST} <= {name} <= -{_SMALLEST}"
        f" or {name} == 0"
    )


def _is_exact(e: E) -> bool:
    """Whether no single would have to be rounded."""
    return e.whole and e.range is not None and e.range[0] >= -EXACT and e.range[1] <= EXACT


def _grows(operator: str, left: E, right: E, e: E) -> bool:
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
