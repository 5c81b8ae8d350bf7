"""The tree of one RAPID module.

Every node has its first and last token (indexes into `Module.source`, both inclusive), from which
places are computed on demand. Comments and blanks are not in the tree: they are in the gaps between
tokens. Nodes are plain slotted classes, because frozen ones cost a third more of the parser's time;
they do not change after parsing.

Names keep the spelling of the source; RAPID compares them without case.
"""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal, TypeAlias

from rapidgen.diagnostics import Diagnostic

if TYPE_CHECKING:
    from rapidgen.rapid.syntax.source import Source

Scope = Literal["", "LOCAL", "TASK"]
Mode = Literal["", "VAR", "PERS", "INOUT", "REF"]
DataKind = Literal["VAR", "PERS", "CONST"]
RoutineKind = Literal["PROC", "FUNC", "TRAP"]


@dataclass(slots=True, eq=False)
class Node:
    """A node with a place."""

    first: int
    last: int


# -- expressions ---------------------------------------------------------------------------


@dataclass(slots=True, eq=False)
class NumberLiteral(Node):
    """`3`, `.5`, `2.5E-3`, `0x1F`; an int without point and exponent."""

    value: float
    text: str


@dataclass(slots=True, eq=False)
class StringLiteral(Node):
    """A string after escapes: one code point (0..255) a byte."""

    value: str


@dataclass(slots=True, eq=False)
class BoolLiteral(Node):
    """TRUE or FALSE."""

    value: bool


@dataclass(slots=True, eq=False)
class Name(Node):
    """A whole datum, parameter or loop variable."""

    name: str


@dataclass(slots=True, eq=False)
class Index(Node):
    """`base{i, j}`."""

    base: "Expression"
    indices: "list[Expression]"


@dataclass(slots=True, eq=False)
class Member(Node):
    """`base.component`."""

    base: "Expression"
    component: str


@dataclass(slots=True, eq=False)
class FunctionCall(Node):
    """`Name(arguments)`."""

    name: str
    arguments: "list[Argument]"


Shape: TypeAlias = "int | tuple[Shape, ...]"
"""Shape of an aggregate of numbers: their count in a row of numbers, else the shapes of the
members, where 0 is a number. Equal shapes fit equal types."""


@dataclass(slots=True, eq=False)
class Aggregate(Node):
    """`[a, b, [c, d]]`, with the type of its place."""

    members: "list[Expression]"
    shape: "Shape | None" = None
    """Of an aggregate of numbers alone; None: it has other members."""


@dataclass(slots=True, eq=False)
class Unary(Node):
    """`+ - NOT` before an operand."""

    operator: str
    operand: "Expression"


@dataclass(slots=True, eq=False)
class Binary(Node):
    """`* / DIV MOD + - < <= > >= = <> AND OR XOR` (upper case)."""

    operator: str
    left: "Expression"
    right: "Expression"

    @property
    def has_type_of_place(self) -> bool:
        """True if both operands of + or - are aggregates.

        Only their place gives them a type.
        """
        if self.operator not in ("+", "-"):
            return False
        return isinstance(self.left, Aggregate) and isinstance(self.right, Aggregate)


@dataclass(slots=True, eq=False)
class Parenthesis(Node):
    """`( inner )`, preserved for the binding of NOT and signs."""

    inner: "Expression"


@dataclass(slots=True, eq=False)
class Placeholder(Node):
    """`<SMT>`, `<EXP>`, ...: it loads, and fails when executed."""

    text: str


@dataclass(slots=True, eq=False)
class Star(Node):
    """`*` in place of a robtarget: an inlined position."""


Expression = (
    NumberLiteral
    | StringLiteral
    | BoolLiteral
    | Name
    | Index
    | Member
    | FunctionCall
    | Aggregate
    | Unary
    | Binary
    | Parenthesis
    | Placeholder
    | Star
)


@dataclass(slots=True, eq=False)
class Argument(Node):
    """An argument of a call.

    `kind` is `required` (with `name` if written `Par:=value`), `optional` (`\\Opt:=value`),
    `switch` (`\\Sw`) or `conditional` (`\\Opt?par`, `value` is then the Name of `par`).
    """

    kind: Literal["required", "optional", "switch", "conditional"]
    name: str | None
    value: Expression | None


# -- declarations --------------------------------------------------------------------------


@dataclass(slots=True, eq=False)
class Component(Node):
    """A component of a record."""

    type: str
    name: str


@dataclass(slots=True, eq=False)
class RecordDeclaration(Node):
    """`RECORD name ... ENDRECORD`."""

    scope: Scope
    name: str
    components: list[Component]


@dataclass(slots=True, eq=False)
class AliasDeclaration(Node):
    """`ALIAS type name;`."""

    scope: Scope
    type: str
    name: str


@dataclass(slots=True, eq=False)
class DataDeclaration(Node):
    """`VAR`, `PERS` or `CONST` in a module or a routine."""

    scope: Scope
    kind: DataKind
    type: str
    name: str
    dimensions: list[Expression]
    initial: Expression | None
    name_token: int


@dataclass(slots=True, eq=False)
class Parameter(Node):
    """A formal parameter.

    Alternatives (`
    um a | string b`) share a `group` number >= 0. `dimensions` is the number of `*` in `name{*,*}`,
    0 for a scalar. A switch has type `switch`.
    """

    mode: Mode
    type: str
    name: str
    dimensions: int
    optional: bool
    group: int
    name_token: int


@dataclass(slots=True, eq=False)
class ErrorHandler(Node):
    """`ERROR` or `ERROR (list)`; `numbers` is None without a list."""

    numbers: list[Expression] | None
    body: "list[Statement]"


@dataclass(slots=True, eq=False)
class Handler(Node):
    """`BACKWARD` or `UNDO`."""

    body: "list[Statement]"


@dataclass(slots=True, eq=False)
class RoutineDeclaration(Node):
    """A PROC, FUNC or TRAP."""

    scope: Scope
    kind: RoutineKind
    type: str | None
    name: str
    parameters: list[Parameter]
    data: list[DataDeclaration]
    body: "list[Statement]"
    backward: Handler | None
    error: ErrorHandler | None
    undo: Handler | None
    name_token: int


@dataclass(slots=True, eq=False)
class PlaceholderDeclaration(Node):
    """`<TDN>`, `<DDN>` or `<RDN>` among declarations."""

    text: str


Declaration = (
    RecordDeclaration
    | AliasDeclaration
    | DataDeclaration
    | RoutineDeclaration
    | PlaceholderDeclaration
)


# -- statements ----------------------------------------------------------------------------


@dataclass(slots=True, eq=False)
class Assignment(Node):
    """`target := value;`."""

    target: Expression
    value: Expression


@dataclass(slots=True, eq=False)
class ProcedureCall(Node):
    """`Name arguments;`."""

    name: str
    arguments: list[Argument]


@dataclass(slots=True, eq=False)
class LateCall(Node):
    """`%expression% arguments;`."""

    procedure: Expression
    arguments: list[Argument]


@dataclass(slots=True, eq=False)
class Branch(Node):
    """`condition` THEN `body`, of IF and ELSEIF."""

    condition: Expression
    body: "list[Statement]"


@dataclass(slots=True, eq=False)
class If(Node):
    """`IF ... ELSEIF ... ELSE ... ENDIF`; `otherwise` is None without ELSE."""

    branches: list[Branch]
    otherwise: "list[Statement] | None"


@dataclass(slots=True, eq=False)
class CompactIf(Node):
    """`IF condition statement`, without THEN."""

    condition: Expression
    statement: "Statement"


@dataclass(slots=True, eq=False)
class For(Node):
    """`FOR variable FROM start TO end [STEP step] DO ... ENDFOR`."""

    variable: str
    start: Expression
    end: Expression
    step: Expression | None
    body: "list[Statement]"


@dataclass(slots=True, eq=False)
class While(Node):
    """`WHILE condition DO ... ENDWHILE`."""

    condition: Expression
    body: "list[Statement]"


@dataclass(slots=True, eq=False)
class Case(Node):
    """`CASE v1, v2:` of a TEST."""

    values: list[Expression]
    body: "list[Statement]"


@dataclass(slots=True, eq=False)
class Test(Node):
    """`TEST subject CASE ... DEFAULT: ... ENDTEST`; `default` is None without DEFAULT."""

    subject: Expression
    cases: list[Case]
    default: "list[Statement] | None"


@dataclass(slots=True, eq=False)
class Label(Node):
    """`name:`."""

    name: str


@dataclass(slots=True, eq=False)
class Goto(Node):
    """`GOTO name;`."""

    name: str


@dataclass(slots=True, eq=False)
class Return(Node):
    """`RETURN [value];`."""

    value: Expression | None


@dataclass(slots=True, eq=False)
class Raise(Node):
    """`RAISE [number];`."""

    number: Expression | None


@dataclass(slots=True, eq=False)
class Retry(Node):
    """`RETRY;`."""


@dataclass(slots=True, eq=False)
class TryNext(Node):
    """`TRYNEXT;`."""


@dataclass(slots=True, eq=False)
class Exit(Node):
    """`EXIT;`."""


@dataclass(slots=True, eq=False)
class Connect(Node):
    """`CONNECT target WITH trap;`."""

    target: Expression
    trap: str


@dataclass(slots=True, eq=False)
class PlaceholderStatement(Node):
    """`<SMT>` (or another placeholder) as a statement."""

    text: str


Statement = (
    Assignment
    | ProcedureCall
    | LateCall
    | If
    | CompactIf
    | For
    | While
    | Test
    | Label
    | Goto
    | Return
    | Raise
    | Retry
    | TryNext
    | Exit
    | Connect
    | PlaceholderStatement
)


# -- module --------------------------------------------------------------------------------


@dataclass(slots=True, eq=False)
class Module(Node):
    """A module and the errors of its text.

    A text without a module gives a Module with an empty name and diagnostics. `declarations` are in
    the order of the source.
    """

    name: str
    attributes: tuple[str, ...]
    declarations: list[Declaration]
    source: "Source"
    diagnostics: list[Diagnostic] = field(default_factory=list)

    @property
    def records(self) -> list[RecordDeclaration]:
        """RECORD declarations in source order."""
        return [d for d in self.declarations if isinstance(d, RecordDeclaration)]

    @property
    def aliases(self) -> list[AliasDeclaration]:
        """ALIAS declarations in source order."""
        return [d for d in self.declarations if isinstance(d, AliasDeclaration)]

    @property
    def data(self) -> list[DataDeclaration]:
        """Module data in source order."""
        return [d for d in self.declarations if isinstance(d, DataDeclaration)]

    @property
    def routines(self) -> list[RoutineDeclaration]:
        """Routines in source order."""
        return [d for d in self.declarations if isinstance(d, RoutineDeclaration)]
