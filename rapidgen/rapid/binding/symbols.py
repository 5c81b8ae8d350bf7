"""What a name stands for. Symbols are made once and not changed.

They are compared by identity. `module` is the scope that declares one; None for what is built
in or installed by the configuration. Names keep the spelling of the declaration.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, Literal

from rapidgen.diagnostics import Span
from rapidgen.rapid.builtins.signatures import Signature
from rapidgen.rapid.syntax.nodes import (
    AliasDeclaration,
    DataDeclaration,
    Expression,
    For,
    Label,
    Mode,
    Module,
    Node,
    Parameter,
    RecordDeclaration,
    RoutineDeclaration,
)

if TYPE_CHECKING:
    from rapidgen.rapid.binding.names import ModuleScope

DataRole = Literal["VAR", "PERS", "CONST", "PARAMETER", "LOOP", "INSTALLED"]
TypeRole = Literal["RECORD", "ALIAS", "TYPE"]
Role = Literal[DataRole, TypeRole, "PROC", "FUNC", "TRAP", "MODULE", "LABEL"]

ROUTINES: Final[frozenset[Role]] = frozenset(("PROC", "FUNC", "TRAP"))
TYPES: Final[frozenset[Role]] = frozenset(("RECORD", "ALIAS", "TYPE"))
DATA: Final[frozenset[Role]] = frozenset(("VAR", "PERS", "CONST", "PARAMETER", "LOOP", "INSTALLED"))


@dataclass(slots=True, eq=False)
class Symbol:
    """One named thing."""

    name: str
    kind: Role
    module: "ModuleScope | None" = None
    local: bool = False
    """Declared LOCAL."""
    node: Node | None = None
    """Its declaration; None for what is built in or installed."""

    @property
    def token(self) -> int:
        """Index of the name in the declaring module's tokens; -1 where there is none."""
        return -1

    @property
    def declared_at(self) -> Span | None:
        """Place of the name in its declaration; None for built-in and installed objects."""
        if self.module is None or self.token < 0:
            return None
        return self.module.tree.source.span(self.token, self.token)


@dataclass(slots=True, eq=False)
class DataSymbol(Symbol):
    """A variable, persistent, constant, parameter, loop variable or installed object."""

    node: DataDeclaration | Parameter | For | None = None
    type: str = "num"
    """As declared: before aliases, and without dimensions."""
    degree: int = 0
    routine: RoutineDeclaration | None = None
    """Whose parameter, datum or loop variable it is; None for module data."""
    readonly: bool = False
    """A program cannot assign it: CONST, loop variables, ERRNO, INTNO."""

    @property
    def token(self) -> int:
        """See `Symbol.token`."""
        node = self.node
        if node is None:
            return -1
        return node.first + 1 if isinstance(node, For) else node.name_token

    @property
    def mode(self) -> Mode:
        """Of a parameter: how it is passed."""
        return self.node.mode if isinstance(self.node, Parameter) else ""

    @property
    def optional(self) -> bool:
        """Whether it is an optional parameter."""
        return isinstance(self.node, Parameter) and self.node.optional

    @property
    def initial(self) -> Expression | None:
        """Initial value of a declaration."""
        return self.node.initial if isinstance(self.node, DataDeclaration) else None

    @property
    def dimensions(self) -> Sequence[Expression]:
        """Sizes of a declaration; of an array parameter none, see `degree`."""
        return self.node.dimensions if isinstance(self.node, DataDeclaration) else ()


@dataclass(slots=True, eq=False)
class RoutineSymbol(Symbol):
    """A routine of the program (`node`) or a built-in one (`signature`)."""

    node: RoutineDeclaration | None = None
    type: str | None = None
    """Type of a function's value, as declared."""
    signature: Signature | None = None

    @property
    def token(self) -> int:
        """See `Symbol.token`."""
        return -1 if self.node is None else self.node.name_token

    @property
    def parameters(self) -> Sequence[Parameter] | None:
        """In the order of the call; None when they are not known."""
        if self.signature is not None:
            return self.signature.parameters if self.signature.checked else None
        if self.node is None or any(p.name.startswith("<") for p in self.node.parameters):
            return None
        return self.node.parameters


@dataclass(slots=True, eq=False)
class TypeSymbol(Symbol):
    """A record, an alias or a predefined type; predefined records are of kind `TYPE`."""

    node: RecordDeclaration | AliasDeclaration | None = None
    base: str | None = None
    """Of an alias: the type that it names."""
    components: Sequence[tuple[str, str]] | None = None
    """(type, name) of a record's components in order, as declared; None for what is no record."""
    newer: int = 0
    """So many of the last components are missing in values that older releases saved."""
    partly: bool = False
    """Not all names of the components of a predefined record are public."""

    @property
    def token(self) -> int:
        """See `Symbol.token`."""
        node = self.node
        if isinstance(node, AliasDeclaration):
            return node.last - 1
        return -1 if node is None else node.first + 1 + bool(node.scope)


@dataclass(slots=True, eq=False)
class ModuleSymbol(Symbol):
    """The name of a module: global in its task, and of use to nobody but a late call."""

    node: Module | None = None

    @property
    def token(self) -> int:
        """See `Symbol.token`."""
        return -1 if self.node is None else self.node.first + 1


@dataclass(slots=True, eq=False)
class LabelSymbol(Symbol):
    """A label of a routine."""

    node: Label | None = None

    @property
    def token(self) -> int:
        """See `Symbol.token`."""
        return -1 if self.node is None else self.node.first
