"""Data, parameters, routines and modules as the compiler knows them.

A `Data` says how compiled code reaches a datum (`Storage`). A `Compiled` says which Python
functions a routine became, and how lines map to RAPID tokens: tasks, the debugger and the error
handling read stacks through it.
"""

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
    """A violation of a language rule; `node` is its place."""

    def __init__(self, message: str, node: n.Node) -> None:
        super().__init__(message)
        self.node = node


class LabelUnreachable(CannotCompile):
    """A jump that cannot reach its label.

    The fault concerns the statement list, not one statement.
    """


Storage: TypeAlias = Literal["inline", "global", "cell", "local", "box", "ref", "object"]
"""Storage of a datum:

inline  the value itself is part of the code (atomic CONST, ERR_ numbers)
global  a global of the task's namespace
cell    a global `PersistentCell` (PERS)
local   a Python local
box     a Python local with a `ValueRef` (a variable passed by reference)
ref     a Python local with a `Ref` or `PersistentCell` (VAR, INOUT and PERS parameters)
object  a Python local with the record, array or non-value object of a VAR parameter
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
    """Python expression of the storage."""
    mode: n.Mode = ""
    optional: bool = False
    whole: bool = False
    """True for a datum that is always a whole number, an int."""
    range: tuple[int, int] | None = None
    value: Value = None
    """Of `inline` data."""
    readonly: bool = False


@dataclass(slots=True, eq=False)
class FormalParameter:
    """A formal parameter."""

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
    """Return a declared parameter with its type."""
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
    """True for a built-in without an implementation here."""
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
    """Origin of a module that the program loaded.

    The path text of its Load identifies it.
    """

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
    """Routines of the module, by lower-case name."""
    types: dict[str, Type | None] = field(default_factory=dict)
    """Resolved type names of the module."""
    origin: Origin | None = None
    """None: it belongs to the configuration."""

    @property
    def name(self) -> str:
        """Name as declared."""
        return self.tree.name

    @property
    def declarations(self) -> dict[str, n.DataDeclaration]:
        """Data of the module, by lower-case name."""
        return {
            key: symbol.node
            for key, symbol in self.scope.own.items()
            if isinstance(symbol, DataSymbol) and isinstance(symbol.node, n.DataDeclaration)
        }

    @property
    def installed(self) -> bool:
        """True for a built-in module.

        It does not see the program, which may hide its names.
        """
        return self.scope.installed

    def span(self, node: n.Node) -> Span:
        """Return the source span of a node."""
        return self.tree.source.span(node.first, node.last)


# -- Compiled code ---------------------------------------------------------------------------------
#
# Information on compiled code for look-ups in frames: errors, steps, stops.
#
# A routine becomes one Python function with nested functions for each handler and for statements
# nested more deeply than CPython permits. The compiler registers the role of each with the code.
# Only this section defines the names of these functions and variables.


HANDLER: Final = "_h"
"""Function of an ERROR handler, and the variable of its routine that refers to it."""
UNDO: Final = "_u"
"""Function of an UNDO handler."""
LISTED: Final = "_l"
"""Function with the numbers of ERROR (list); None: the handler is for all."""
BUDGET: Final = "b"
"""Python local with the remaining budget."""


class CodeRole(Enum):
    """Role of a Python function in a compiled routine."""

    ROUTINE = ""
    HANDLER = "ERROR"
    UNDO = "UNDO"
    PART = "part"
    """Nested statements of a routine or handler, whose frame is the caller."""

    @property
    def is_handler(self) -> bool:
        """True for an ERROR or UNDO handler."""
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
    """True for code that reports statements. Its locals may become fractional at any time."""

    @property
    def handled(self) -> bool:
        """True if the routine has an ERROR clause."""
        node = self.routine.node
        return node is not None and node.error is not None

    def role(self, code: CodeType) -> CodeRole:
        """Return the role of one of the routine's functions."""
        return self.roles.get(code.co_name, CodeRole.ROUTINE)

    def handler(self, frame: FrameType) -> Callable[[], int] | None:
        """Return the ERROR handler in a frame, None before its creation."""
        match: Callable[[], int] | None = frame.f_locals.get(HANDLER)
        return match

    def listed(self, frame: FrameType) -> tuple[float, ...] | None:
        """Return the numbers of ERROR (list) in a frame, None without a list."""
        numbers: Callable[[], tuple[float, ...]] | None = frame.f_locals.get(LISTED)
        return None if numbers is None else numbers()

    def budget(self, frame: FrameType, line: int) -> int | None:
        """Return the budget (ns) left by an error at a line.

        None: it is already written back.
        """
        if line in self.synced:
            return None
        left: int | None = frame.f_locals.get(BUDGET)
        return None if left is None else left + self.refunds.get(line, 0)


Codes: TypeAlias = Mapping[str, Compiled]
"""Code of a program by Python file name."""
