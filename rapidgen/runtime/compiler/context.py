"""What the parts of the compiler share: options, compiled expressions, the routine at hand."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypeAlias

from rapidgen.rapid.binding.names import RoutineScope
from rapidgen.rapid.binding.symbols import Symbol
from rapidgen.rapid.switches import Switches
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.linking import Linker
from rapidgen.runtime.compiler.symbols import CannotCompile, Data, LoadedModule, Routine
from rapidgen.runtime.values import BOOL, NUM, Type

UNBOUNDED = 1 << 60
"""Upper end of the range of a whole number of which only the lower end is known."""

SILENT, SHARED, CALLS = 0, 1, 2
"""What an expression touches: the routine's own data; data that traps or others see; calls
that may wait, so that the budget has to be written back around them."""


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
    """A record or array that nobody else holds."""
    risky: bool = False
    """May leave the range of IEEE single."""
    literal: bool = False

    def take(self, *parts: "CompiledExpression") -> "CompiledExpression":
        """Add what the operands cost and touch."""
        for part in parts:
            self.ops += part.ops
            self.cost += part.cost
            self.effect = max(self.effect, part.effect)
            self.fails = self.fails or part.fails
        return self


def failing(
    error: str, name: str = "", kind: Type = NUM, dims: tuple[int, ...] = ()
) -> CompiledExpression:
    """An expression that fails when it is reached; `name` is what is not there."""
    inside = f"{error!r}, {name!r}" if name else repr(error)
    return CompiledExpression(f"FAIL({inside})", kind, dims, fails=True, effect=SHARED, exact=True)


def calling(code: str, kind: Type, *parts: CompiledExpression, cost: int = 0) -> CompiledExpression:
    """A call that may wait and fail."""
    e = CompiledExpression(code, kind, cost=cost, exact=True).take(*parts)
    e.effect, e.fails = CALLS, True
    return e


@dataclass(slots=True)
class Options:
    """How routines are compiled."""

    accounting: str = "block"
    """`none` (nothing interrupts), `block` or `statement`."""
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
    """Type equality after aliases [K §2.17]."""
    return a is b or a.name == b.name


CompileExpression: TypeAlias = (
    "Callable[[Unit, n.Expression, Type | None, tuple[int, ...]], CompiledExpression]"
)


@dataclass(slots=True, eq=False)
class Unit:
    """The routine that is being compiled, and what names in it stand for."""

    linker: Linker
    module: LoadedModule
    routine: Routine
    node: n.RoutineDeclaration
    options: Options
    compile: CompileExpression
    """expressions.compile_expression: operands are compiled by way of it."""
    names: RoutineScope
    """What names stand for where the compiler is: in the routine, or in a FOR of it."""
    boxed: set[str]
    """Locals that are passed by reference, lower case."""
    locals: dict[Symbol, Data] = field(default_factory=dict)
    """How parameters, data and loop variables are kept."""
    globals_written: set[str] = field(default_factory=set)
    temporaries: int = 0

    def temporary(self) -> str:
        """A fresh Python name."""
        self.temporaries += 1
        return f"_{self.temporaries}"

    def data(self, name: str) -> Data | None:
        """What a name stands for when it is a datum."""
        symbol = self.names.find(name)
        if symbol is None:
            return None
        return self.locals.get(symbol) or self.linker.datum(symbol)

    def routine_named(self, name: str) -> Routine | None:
        """What a name stands for when it is a routine."""
        return self.linker.routine(self.names.find(name))

    def expression(
        self, node: n.Expression, expected: Type | None = None, dims: tuple[int, ...] = ()
    ) -> CompiledExpression:
        """Compile an expression to a value (signals are read); `expected` types aggregates and
        literals."""
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
        """Compile an expression that has to have a given type."""
        e = self.expression(node, kind, dims)
        if not same_type(e.type, kind):
            raise CannotCompile(f"the {what} is {e.type.name}, not {kind.name}", node)
        if len(e.dims) != len(dims):
            raise CannotCompile(f"the {what} has {len(e.dims)} dimensions, not {len(dims)}", node)
        return e

    def condition(self, node: n.Expression) -> CompiledExpression:
        """Compile a bool."""
        return self.value_of(node, BOOL, (), "condition")
