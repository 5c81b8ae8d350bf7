"""What names in RAPID stand for, and how compiled code reaches it."""

from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from rapidgen.diagnostics import Span
from rapidgen.rapid.binding.names import ModuleScope
from rapidgen.rapid.binding.symbols import DataSymbol
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.registry import Builtin
from rapidgen.runtime.values import Type, Value
from rapidgen.system.model import ModuleFile


class CannotCompile(Exception):
    """The routine breaks a rule that the checker would have told; `node` is the place."""

    def __init__(self, message: str, node: n.Node) -> None:
        super().__init__(message)
        self.node = node


class LabelUnreachable(CannotCompile):
    """A jump has no way to its label: not a matter of one statement."""


Storage: TypeAlias = Literal["inline", "global", "cell", "local", "box", "ref", "object"]
"""How a datum is kept:

inline  the value itself stands in the code (atomic CONST, ERR_ numbers)
global  a global of the task's namespace
cell    a global `PersistentCell` (PERS)
local   a Python local
box     a Python local that holds a `ValueRef` (a variable that is passed by reference)
ref     a Python local that holds a `Ref` or `PersistentCell` (VAR, INOUT and PERS parameters)
object  a Python local that is the record, array or non-value object of a VAR parameter
"""


@dataclass(slots=True, eq=False)
class Data:
    """A datum, parameter or loop variable."""

    name: str
    kind: Literal["VAR", "PERS", "CONST", "LOOP", "PARAMETER"]
    type: Type
    dims: tuple[int, ...]
    """Sizes; of an array parameter zeros."""
    storage: Storage
    code: str
    """Python expression of what is kept."""
    mode: n.Mode = ""
    optional: bool = False
    whole: bool = False
    """Always a whole number, kept as int."""
    range: tuple[int, int] | None = None
    value: Value = None
    """Of `inline` data."""
    readonly: bool = False


@dataclass(slots=True, eq=False)
class FormalParameter:
    """One formal parameter."""

    name: str
    mode: n.Mode
    type: Type | None
    """None: anytype."""
    type_name: str
    dims: int
    optional: bool
    group: int
    switch: bool


def formal(p: n.Parameter, kind: Type | None) -> FormalParameter:
    """A declared parameter with its type."""
    switch = p.type.lower() == "switch"
    return FormalParameter(p.name, p.mode, kind, p.type, p.dimensions, p.optional, p.group, switch)


@dataclass(slots=True, eq=False)
class Routine:
    """A routine of the program, or a built-in."""

    name: str
    kind: Literal["PROC", "FUNC", "TRAP"]
    type: Type | None
    parameters: tuple[FormalParameter, ...]
    code: str
    """Python expression of the function."""
    node: n.RoutineDeclaration | None = None
    module: "LoadedModule | None" = None
    builtin: Builtin | None = None
    missing: bool = False
    """A built-in that exists on controllers but not here."""
    lazy: tuple[str, ...] = ()
    """Parameters of a built-in that looks at their arguments again and again, lower case."""
    by_name: dict[str, int] = field(default_factory=dict)

    refers: bool = False
    """Some argument is passed by reference."""

    def __post_init__(self) -> None:
        self.refers = any(p.mode for p in self.parameters)
        self.by_name = {p.name.lower(): i for i, p in enumerate(self.parameters)}


@dataclass(frozen=True, slots=True)
class Origin:
    """How a module came that the program loaded itself; the words of the Load are its path."""

    dynamic: bool
    seconds: int
    """Time of the file, since 1970."""


@dataclass(slots=True, eq=False)
class LoadedModule:
    """A module in a task."""

    index: int
    tree: n.Module
    file: ModuleFile
    scope: ModuleScope
    routines: dict[str, Routine] = field(default_factory=dict)
    """Its own, by lower-case name."""
    types: dict[str, Type | None] = field(default_factory=dict)
    """What names of types mean here, as far as it was asked."""
    origin: Origin | None = None
    """None: it belongs to the configuration."""

    @property
    def name(self) -> str:
        """As it is declared."""
        return self.tree.name

    @property
    def declarations(self) -> dict[str, n.DataDeclaration]:
        """Its data, by lower-case name."""
        return {
            key: symbol.node
            for key, symbol in self.scope.own.items()
            if isinstance(symbol, DataSymbol) and isinstance(symbol.node, n.DataDeclaration)
        }

    @property
    def installed(self) -> bool:
        """Whether it is built in: it does not see the program, which may hide its names."""
        return self.scope.installed

    def span(self, node: n.Node) -> Span:
        """Place of a node."""
        return self.tree.source.span(node.first, node.last)
