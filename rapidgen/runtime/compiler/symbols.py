"""Data, parameters, routines and modules as the compiler knows them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from types import CodeType, FrameType
from typing import Final, Literal, TypeAlias

from rapidgen.diagnostics import Span
from rapidgen.rapid.binding.names import DataSymbol, ModuleScope
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


# -- Compiled code ---------------------------------------------------------------------------------
#
# What is known about compiled code when something looks at its frames: errors, steps, stops.
#
# A routine becomes one Python function and, inside it, one for each handler and for statements that
# are nested more deeply than CPython takes. The compiler registers the role of each with the code;
# what they and their variables are called is said here alone.


HANDLER: Final = "_h"
"""Function of an ERROR handler, and the variable of its routine that holds it."""
UNDO: Final = "_u"
"""Function of an UNDO handler."""
LISTED: Final = "_l"
"""Function with the numbers of ERROR (list); None: the handler is for all."""
BUDGET: Final = "b"
"""What the task has left, while its routine counts down."""


class CodeRole(Enum):
    """What a Python function of a compiled routine is."""

    ROUTINE = ""
    HANDLER = "ERROR"
    UNDO = "UNDO"
    PART = "part"
    """Deeply nested statements of a routine or handler, whose frame is the next one out."""

    @property
    def is_handler(self) -> bool:
        """Whether it is an ERROR or UNDO handler."""
        return self is CodeRole.HANDLER or self is CodeRole.UNDO


@dataclass(slots=True, eq=False)
class Compiled:
    """The code of one routine."""

    file: str
    """Its Python file name, by which frames are known."""
    routine: Routine
    module: LoadedModule
    text: str
    tokens: list[int]
    """RAPID token by Python line."""
    refunds: dict[int, int]
    """By Python line: what the rest of its block was paid, ns."""
    synced: set[int]
    """Python lines before which the budget was written back."""
    roles: dict[str, CodeRole]
    """Of the functions inside the routine's, by name."""

    traced: bool
    """Whether it reports its statements; it takes no local for a whole number for good then."""

    @property
    def handled(self) -> bool:
        """Whether the routine has an ERROR clause."""
        node = self.routine.node
        return node is not None and node.error is not None

    def role(self, code: CodeType) -> CodeRole:
        """What one of the routine's functions is."""
        return self.roles.get(code.co_name, CodeRole.ROUTINE)

    def handler(self, frame: FrameType) -> Callable[[], int] | None:
        """The ERROR handler of a routine that is being executed, once it is made."""
        match: Callable[[], int] | None = frame.f_locals.get(HANDLER)
        return match

    def listed(self, frame: FrameType) -> tuple[float, ...] | None:
        """Numbers of ERROR (list) of a routine that is being executed; None: there is no list."""
        numbers: Callable[[], tuple[float, ...]] | None = frame.f_locals.get(LISTED)
        return None if numbers is None else numbers()

    def budget(self, frame: FrameType, line: int) -> int | None:
        """What an error at a line leaves of the task's budget, ns; None: that is written back."""
        if line in self.synced:
            return None
        left: int | None = frame.f_locals.get(BUDGET)
        return None if left is None else left + self.refunds.get(line, 0)


Codes: TypeAlias = Mapping[str, Compiled]
"""Code of a program by Python file name."""
