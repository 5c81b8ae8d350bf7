"""Access to data: compiled expressions, copies and references.

A compiled expression is Python source together with all that its users must know: RAPID type, cost,
whether it can fail, what it touches, and the range of a whole number. Operators combine these
properties (`take`), so that the writer can pay for a statement once and omit roundings, copies and
guards that have no effect.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypeAlias

from rapidgen.rapid.binding.names import RoutineScope, Symbol, TypeSymbol
from rapidgen.rapid.numbers import EXACT
from rapidgen.rapid.switches import Switches
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk_own
from rapidgen.runtime.compiler.link import Linker
from rapidgen.runtime.compiler.symbols import (
    CannotCompile,
    Data,
    FormalParameter,
    LoadedModule,
    Routine,
)
from rapidgen.runtime.values import BOOL, NUM, Type, Value, attribute

# -- Compiled expressions --------------------------------------------------------------------------
#
# Options, compiled expressions and the routine in progress, shared by all parts of the emitter.


UNBOUNDED = 1 << 60
"""Upper end of the range of a whole number of which only the lower end is known."""

SILENT, SHARED, CALLS = 0, 1, 2
"""Effects of an expression: it uses only the routine's data; data visible to traps or other tasks;
or calls that may wait, which need the budget written back around them."""


@dataclass(slots=True)
class CompiledExpression:
    """A compiled expression."""

    code: str
    type: Type
    dims: tuple[int, ...] = ()
    ops: int = 0
    """Operators and accesses, for the cost model."""
    cost: int = 0
    """Nanoseconds of calls."""
    effect: int = SILENT
    fails: bool = False
    whole: bool = False
    """An int at run time."""
    range: tuple[int, int] | None = None
    exact: bool = False
    """A num that is already rounded."""
    fresh: bool = False
    """A record or array without another reference."""
    risky: bool = False
    """May leave the range of IEEE single."""
    literal: bool = False

    def take(self, *parts: "CompiledExpression") -> "CompiledExpression":
        """Add costs and effects of operands."""
        for part in parts:
            self.ops += part.ops
            self.cost += part.cost
            self.effect = max(self.effect, part.effect)
            self.fails = self.fails or part.fails
        return self


def failing(
    error: str, name: str = "", kind: Type = NUM, dims: tuple[int, ...] = ()
) -> CompiledExpression:
    """Return an expression that raises an error for `name` when executed."""
    inside = f"{error!r}, {name!r}" if name else repr(error)
    return CompiledExpression(f"FAIL({inside})", kind, dims, fails=True, effect=SHARED, exact=True)


def calling(code: str, kind: Type, *parts: CompiledExpression, cost: int = 0) -> CompiledExpression:
    """Return a call that may wait and fail."""
    e = CompiledExpression(code, kind, cost=cost, exact=True).take(*parts)
    e.effect, e.fails = CALLS, True
    return e


@dataclass(frozen=True, slots=True)
class Options:
    """Compiler options."""

    accounting: str = "block"
    """`none` (no interruption), `block` or `statement`."""
    statement: int = 5_000
    operator: int = 1_000
    call: int = 5_000
    builtin_scale: float = 1.0
    switching: bool = False
    """A switch point at every access to a PERS."""
    tracing: bool = False
    """Report every statement (trace, profile, coverage)."""
    dialect: Switches = field(default_factory=Switches)


def same_type(a: Type, b: Type) -> bool:
    """Return True if types are equal after aliases [K §2.17]."""
    return a is b or a.name == b.name


CompileExpression: TypeAlias = (
    "Callable[[Unit, n.Expression, Type | None, tuple[int, ...]], CompiledExpression]"
)


@dataclass(slots=True, eq=False)
class Unit:
    """The routine in progress, and the meaning of names in it."""

    linker: Linker
    module: LoadedModule
    routine: Routine
    node: n.RoutineDeclaration
    options: Options
    compile: CompileExpression
    """expressions.compile_expression: operands are compiled by way of it."""
    names: RoutineScope
    """The current scope: the routine, or a FOR inside it."""
    boxed: set[str]
    """Locals that are passed by reference, lower case."""
    keep: Callable[[Value], str]
    """Returns a global name for any object."""
    locals: dict[Symbol, Data] = field(default_factory=dict)
    """Storage of parameters, data and loop variables."""
    globals_written: set[str] = field(default_factory=set)
    temporaries: int = 0

    def temporary(self) -> str:
        """Return a new Python name."""
        self.temporaries += 1
        return f"_{self.temporaries}"

    def data(self, name: str) -> Data | None:
        """Return the datum of a name, None for other names."""
        symbol = self.names.find(name)
        if symbol is None:
            return None
        return self.locals.get(symbol) or self.linker.datum(symbol)

    def routine_named(self, name: str) -> Routine | None:
        """Return the routine of a name, None for other names."""
        return self.linker.routine(self.names.find(name))

    def expression(
        self, node: n.Expression, expected: Type | None = None, dims: tuple[int, ...] = ()
    ) -> CompiledExpression:
        """Compile an expression to a value; signals are read.

        `expected` gives aggregates and literals their type.
        """
        e = self.compile(self, node, expected, dims)
        if e.type.kind == "semivalue":
            value = CompiledExpression(
                f"{e.code}.value", NUM, exact=True, effect=SHARED, fails=e.fails
            )
            return value.take(e)
        return e

    def value_of(
        self, node: n.Expression, kind: Type, dims: tuple[int, ...] = (), what: str = "value"
    ) -> CompiledExpression:
        """Compile an expression of a required type."""
        e = self.expression(node, kind, dims)
        if not same_type(e.type, kind):
            raise CannotCompile(f"the {what} is {e.type.name}, not {kind.name}", node)
        if len(e.dims) != len(dims):
            raise CannotCompile(f"the {what} has {len(e.dims)} dimensions, not {len(dims)}", node)
        return e

    def condition(self, node: n.Expression) -> CompiledExpression:
        """Compile a bool."""
        return self.value_of(node, BOOL, (), "condition")


# -- Values ----------------------------------------------------------------------------------------
#
# Python that stores, passes and returns values: rounded to IEEE single, or copied.
#
# Rounding splits at 24 bits (Veltkamp), which is exact inside the normal range; what may leave it
# is tested, and NaN takes the slow way, too.


_LARGEST = "3.4028234663852886e+38"
_SMALLEST = "1.1754943508222875e-38"
"""Below it a single has fewer digits."""


def rounded(e: CompiledExpression, kind: Type) -> str:
    """Return code of `e` as a num for a store, a parameter or a result.

    The code rounds only where the value may not be a single.
    """
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


def store_lines(target: str, e: CompiledExpression, kind: Type, *, keep: bool = False) -> list[str]:
    """Return statements that store `e`, rounded, in a simple Python target.

    Rounding splits at 24 bits (Veltkamp), which is exact in the normal range. A test follows where
    a value may leave the range; NaN fails the test as well.
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
    # A failing store must not change the target. Without ERROR the local is not read again.
    held = "_x" if keep else target
    lines = [
        f"{held} = (_t := (_y := {e.code}) * 536870913.0) - (_t - _y)",
        f"if not ({_normal(held)}): {held} = RND(_y)",
    ]
    if keep:
        lines.append(f"{target} = {held}")
    return lines


def by_value(e: CompiledExpression, kind: Type) -> str:
    """Return code of a value that the receiver may keep.

    Numbers are rounded, records and arrays copied.
    """
    if e.dims or kind.kind == "record":
        if e.fresh:
            return e.code
        return f"COPY({e.code})" if e.dims else f"{e.code}.copy()"
    return rounded(e, kind)


def _normal(code: str) -> str:
    """Return a test that a rounded value is a normal single or 0.

    The test evaluates `code` first and once.
    """
    name = "_x" if ":=" in code else code
    return (
        f"{_SMALLEST} <= {code} <= {_LARGEST} or -{_LARGEST} <= {name} <= -{_SMALLEST}"
        f" or {name} == 0"
    )


# -- References ------------------------------------------------------------------------------------
#
# References to data: reading them, and passing them by reference [K §5.1].


@dataclass(slots=True)
class DataReference:
    """A reference to a whole datum, an element or a component."""

    data: Data
    e: CompiledExpression
    """Reads it, without the test of an optional parameter's presence."""
    holder: str
    """Container of the last element or component; empty for a whole datum."""
    key: str
    """Code of the index, or the attribute, within the container."""
    member: bool
    cell: str
    """Code of its cell (may be None at run time), or empty."""
    index_range: tuple[int, int] | None = None
    """Of the last index."""

    @property
    def atomic(self) -> bool:
        """True for a single num, dnum, bool or string."""
        return not self.e.dims and self.e.type.kind in ("num", "dnum", "bool", "string")


def read(unit: Unit, data: Data) -> CompiledExpression:
    """Return a whole datum as an expression."""
    code, effect, fails = _kept(data)
    kind, dims = data.type, data.dims
    if data.storage == "inline":
        value = data.value
        complete = isinstance(value, int) and not isinstance(value, bool)
        return CompiledExpression(
            repr(value),
            kind,
            whole=complete,
            exact=True,
            range=(value, value) if complete else None,
        )
    if data.storage in ("box", "ref", "cell"):
        code = f"{code}.v"
    if data.storage == "cell" and unit.options.switching:
        code = f"R.touch({data.code}.v)"
        effect = CALLS
    return CompiledExpression(
        code, kind, dims, effect=effect, fails=fails, exact=True, whole=data.whole, range=data.range
    )


def _kept(data: Data) -> tuple[str, int, bool]:
    """Return code of a datum's storage, its effect and its risk."""
    effect = SHARED if data.storage in ("global", "cell") and data.kind != "CONST" else 0
    if data.storage in ("ref", "object"):
        effect = SHARED
    if data.optional:
        return f"PRESENT({data.code})", effect, True
    return data.code, effect, False


def undeclared(unit: Unit, node: n.Node) -> str:
    """Return the first undeclared name in an expression or statement.

    Returns "" without one. Nested statements report their own names.
    """
    for part in walk_own(node):
        if isinstance(part, n.Name):
            symbol = unit.names.find(part.name)
            # An unknown signal may have the name of a predefined type.
            if symbol is None or (isinstance(symbol, TypeSymbol) and symbol.module is None):
                return part.name
    return ""


def unknown_type(unit: Unit, node: n.Node) -> str:
    """Return the first datum in a statement with an undeclared type.

    Returns a text, "" without one.
    """
    for part in walk_own(node):
        data = unit.data(part.name) if isinstance(part, n.Name) else None
        if data is not None and data.type.name in unit.linker.shared.unknown:
            return f"{data.type.name}, which {data.name} needs"
    return ""


def place_of(unit: Unit, node: n.Expression) -> DataReference | None:
    """Return the data reference of `node`, None for other expressions."""
    match node:
        case n.Parenthesis():
            return None
        case n.Name():
            data = unit.data(node.name)
            if data is None or data.storage == "inline":
                return None
            return DataReference(data, read(unit, data), "", "", False, _cell(data))
        case n.Index():
            base = place_of(unit, node.base)
            if base is None or len(base.e.dims) != len(node.indices):
                return None
            indices = [unit.value_of(i, NUM, (), "index") for i in node.indices]
            holder = base.e.code + "".join(f"[{i.code}]" for i in indices[:-1])
            key = indices[-1].code
            e = CompiledExpression(
                f"{holder}[{key}]", base.e.type, ops=len(indices), fails=True, exact=True
            )
            e.take(base.e, *indices)
            limits = indices[-1].range if indices[-1].whole else None
            return DataReference(base.data, e, holder, key, False, base.cell, limits)
        case n.Member():
            base = place_of(unit, node.base)
            kind = base.e.type.component(node.component.lower()) if base else None
            if base is None or kind is None or base.e.dims:
                return None
            key = attribute(node.component)
            e = CompiledExpression(f"{base.e.code}.{key}", kind, ops=1, exact=True).take(base.e)
            return DataReference(base.data, e, base.e.code, key, True, base.cell)
    return None


def _cell(data: Data) -> str:
    if data.storage == "cell":
        return data.code
    if data.storage == "ref" and data.mode in ("PERS", "INOUT"):
        return f"{data.code}.cell"
    return ""


def reference(
    unit: Unit, node: n.Expression, parameter: FormalParameter, *, builtin: bool
) -> CompiledExpression:
    """Compile `node` for a VAR, PERS, INOUT or REF parameter."""
    place = place_of(unit, node)
    mode = parameter.mode
    if place is None:
        if isinstance(node, n.Name | n.Index | n.Member) and (name := undeclared(unit, node)):
            return failing("ERR_REFUNKDAT", name, parameter.type or NUM, (0,) * parameter.dims)
        if mode in ("REF", ""):
            return _boxed(unit, node, parameter)
        raise CannotCompile(f"parameter {parameter.name} takes a datum, not an expression", node)
    data, kind = place.data, place.e.type
    if builtin and kind.name in unit.linker.shared.unknown:
        raise CannotCompile(f"{parameter.name} takes no {kind.name}", node)
    if parameter.type is not None:
        if not same_type(kind, parameter.type):
            raise CannotCompile(
                f"parameter {parameter.name} is {parameter.type_name}, not {kind.name}", node
            )
        if len(place.e.dims) != parameter.dims:
            raise CannotCompile(f"parameter {parameter.name} has {parameter.dims} dimensions", node)
    _check_mode(data, mode, node)
    code = _reference_code(unit, place, parameter, builtin=builtin)
    result = CompiledExpression(
        code, kind, place.e.dims, effect=place.e.effect, fails=place.e.fails
    )
    result.ops = place.e.ops
    return result


def _check_mode(data: Data, mode: n.Mode, node: n.Expression) -> None:
    """Check an access mode by the table of K §5.1.

    ASVAR and ASPERS check at run time what depends on the caller.
    """
    if mode in ("REF", ""):
        return
    if data.readonly:
        raise CannotCompile(f"{data.name} cannot be changed", node)
    if mode == "VAR" and (data.kind == "PERS" or data.mode == "PERS"):
        raise CannotCompile(f"{data.name} is a persistent: a VAR parameter takes a variable", node)
    is_persistent = data.kind == "PERS" or data.mode in ("PERS", "INOUT")
    if mode == "PERS" and not is_persistent:
        raise CannotCompile(f"{data.name} is no persistent", node)


def _reference_code(
    unit: Unit, place: DataReference, parameter: FormalParameter, *, builtin: bool
) -> str:
    data, e, kind = place.data, place.e, place.e.type
    if kind.kind in ("nonvalue", "semivalue") and not e.dims:
        return e.code
    as_object = not builtin and parameter.mode == "VAR" and not place.atomic
    if as_object:
        return e.code
    t, cell = unit.keep(kind), place.cell or "None"
    if place.holder:
        if not place.atomic:
            return f"PART({e.code}, {t}, {data.name!r}, {cell})"
        maker = "MEMBER" if place.member else "ITEM"
        key = repr(place.key) if place.member else place.key
        return f"{maker}({place.holder}, {key}, {t}, {data.name!r}, {cell})"
    if data.storage in ("box", "cell"):
        return data.code
    if data.storage == "ref":
        code = f"PRESENT({data.code})" if data.optional else data.code
        if data.mode == "INOUT" and parameter.mode == "VAR":
            return f"ASVAR({code})"
        if data.mode == "INOUT" and parameter.mode == "PERS":
            return f"ASPERS({code})"
        return code
    if data.storage == "global" and not data.readonly:
        return unit.linker.global_ref(data)
    return f"BOX({e.code}, {t}, {e.dims!r}, {data.name!r})"


def _boxed(unit: Unit, node: n.Expression, parameter: FormalParameter) -> CompiledExpression:
    """Return a box for an expression passed to REF or anytype."""
    e = unit.expression(node, parameter.type)
    t = unit.keep(e.type)
    name = node.name if isinstance(node, n.Name) else ""
    code = f"BOX({by_value(e, e.type)}, {t}, {e.dims!r}, {name!r})"
    return CompiledExpression(code, e.type, e.dims).take(e)
