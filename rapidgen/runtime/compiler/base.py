"""What the parts of the routine compiler share: its state and the shape of an expression."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NoReturn

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.symbols import Data, Routine
from rapidgen.runtime.switches import Switches
from rapidgen.runtime.values import Type

if TYPE_CHECKING:
    from rapidgen.runtime.compiler.program import LoadedModule, Program

EXACT = 1 << 24
"""IEEE single holds every whole number up to here."""

UNBOUNDED = 1 << 60
"""Upper end of the range of a whole number of which only the lower end is known."""

SILENT, SHARED, CALLS = 0, 1, 2
"""What an expression touches: the routine's own data; data that traps or others see; calls
that may wait, so that the budget has to be written back around them."""


class CannotCompile(Exception):
    """The routine breaks a rule that the checker would have told; `node` is the place."""

    def __init__(self, message: str, node: n.Node) -> None:
        super().__init__(message)
        self.node = node


@dataclass(slots=True)
class E:
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

    def take(self, *parts: "E") -> "E":
        """Add what the operands cost and touch."""
        for part in parts:
            self.ops += part.ops
            self.cost += part.cost
            self.effect = max(self.effect, part.effect)
            self.fails = self.fails or part.fails
        return self


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


class CompilerBase:
    """State of the compilation of one routine."""

    program: "Program"
    module: "LoadedModule"
    routine: Routine
    options: Options
    locals: dict[str, Data]
    boxed: set[str]
    globals_written: set[str]
    temporaries: int

    def fault(self, message: str, node: n.Node) -> NoReturn:
        """Give up: the routine cannot run."""
        raise CannotCompile(message, node)

    def temporary(self) -> str:
        """A fresh Python name."""
        self.temporaries += 1
        return f"_{self.temporaries}"

    def expression(
        self, node: n.Expression, want: Type | None = None, dims: tuple[int, ...] | None = None
    ) -> E:
        """Compile an expression; `want` types aggregates and literals."""
        raise NotImplementedError

    def call(self, routine: Routine, node: n.FunctionCall | n.ProcedureCall) -> E:
        """Compile a call."""
        raise NotImplementedError
