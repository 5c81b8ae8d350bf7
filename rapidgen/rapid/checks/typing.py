"""Types of expressions [K §2.17, 3].

`type_of` gives the type of an expression that is read; `expect` checks one against the type
that its place wants, which is also where an aggregate gets its type from.
"""

from collections.abc import Callable, Sequence
from typing import Final, cast

from rapidgen.diagnostics import Severity
from rapidgen.rapid.checks.constants import (
    MAX_STRING,
    Constant,
    constant,
    is_exact_single,
    is_single,
)
from rapidgen.rapid.checks.given import Extent, closest
from rapidgen.rapid.checks.report import Reporter
from rapidgen.rapid.checks.symbols import DATA, Symbol, array, degree, element
from rapidgen.rapid.syntax.nodes import (
    Aggregate,
    Argument,
    Binary,
    BoolLiteral,
    DataDeclaration,
    Expression,
    FunctionCall,
    Index,
    Member,
    Name,
    Node,
    NumberLiteral,
    Parenthesis,
    Placeholder,
    Star,
    StringLiteral,
    Unary,
)

NUMBER: Final = "number"
"""A number that may still become num or dnum: a literal, or sums of literals."""
AGGREGATE: Final = "aggregate"
_NUMERIC: Final = frozenset((NUMBER, "num", "dnum"))
_ATOMIC: Final = frozenset(("num", "dnum", "bool", "string"))
"""What surely has no components; of some installed types they are not known."""
_RELATIONS: Final = frozenset(("<", "<=", ">", ">="))
_MAX_DEPTH: Final = 50
_HARDWARE: Final = frozenset(
    ("signaldi", "signaldo", "signalgi", "signalgo", "signalai", "signalao", "mecunit", "taskid")
)
"""Types whose objects the configuration installs."""


class TypeChecker(Reporter):
    """Finds types, and says where they do not fit."""

    _depth = 0

    def check_arguments(self, symbol: Symbol, node: FunctionCall) -> None:
        """Check a call's arguments against its routine."""
        raise NotImplementedError

    # -- reading -------------------------------------------------------------------------

    def type_of(self, node: Expression) -> str | None:
        """Type of an expression whose value is read; None when it is not known.

        An expression that is nested deeper than anybody writes is not judged further in.
        """
        if self._depth >= _MAX_DEPTH:
            return None
        self._depth += 1
        found = _READERS[type(node)](self, node)
        self._depth -= 1
        return found

    def _number(self, node: NumberLiteral) -> str:
        if not is_single(node.value) and not self.given.dialect.has_dnum:
            self.report("RG319", f"num cannot hold {node.text}", node)
        return NUMBER

    def _string(self, node: StringLiteral) -> str:
        if len(node.value) > MAX_STRING:
            self.report(
                "RG319",
                f"the string has {len(node.value)} characters; {MAX_STRING} is the limit",
                node,
                notes=("strings [K §2.13]",),
            )
        return "string"

    def _bool(self, node: BoolLiteral) -> str:
        return "bool"

    def _nothing(self, node: Placeholder | Star) -> None:
        return None

    def _aggregate(self, node: Aggregate) -> str:
        for member in node.members:
            self.type_of(member)
        return AGGREGATE

    def _parenthesis(self, node: Parenthesis) -> str | None:
        return self.type_of(node.inner)

    def _read(self, node: Name | Index | Member) -> str | None:
        """A datum in value context: a signal reads as num, a non-value cannot be read."""
        found = self.datum(node)
        if found is None:
            return None
        kind = self.scope.type_class(found)
        if kind == "semivalue":
            return array("num", degree(found))
        if kind == "nonvalue":
            self.report(
                "RG309",
                f"{element(found)} has no value that could be used in an expression",
                node,
                help="hand it to a routine with a VAR parameter",
                notes=("value classes [K §2.16]",),
            )
            return None
        return found

    def _call(self, node: FunctionCall) -> str | None:
        symbol = self.find(node.name)
        if symbol is None:
            self.unknown("function", node.name, node.first, certain=self.given.judges_routines)
            for argument in node.arguments:
                self.loose_argument(argument)
            return None
        if symbol.kind != "FUNC":
            what = "an array: its index stands in braces" if symbol.kind in DATA else "no function"
            self.report(
                "RG306",
                f"'{symbol.name}' is {what}",
                node.first,
                label=f"a {symbol.kind}",
                related=self.declared(symbol),
            )
            return None
        self.check_arguments(symbol, node)
        return self.scope.type_of(symbol)

    def used(self, node: Expression) -> None:
        """Look at an expression whose place says nothing about its type."""
        if isinstance(node, Name | Index | Member):
            self.datum(node)
        else:
            self.type_of(node)

    def loose_argument(self, argument: Argument) -> None:
        """Look at an argument of a routine that is not known."""
        if argument.value is not None:
            self.used(argument.value)

    # -- data ----------------------------------------------------------------------------

    def root(self, node: Expression) -> Symbol | None:
        """The datum that a reference starts from, without marking or reporting."""
        while isinstance(node, Index | Member):
            node = node.base
        if isinstance(node, Name):
            return self.locals.get(node.name.lower()) or self.scope.find(node.name)
        return None

    def datum(self, node: Name | Index | Member, wanted: str | None = None) -> str | None:
        """Declared type of a data reference, signals and non-values included."""
        if isinstance(node, Name):
            symbol = self.find(node.name)
            if symbol is None:
                self._unknown_datum(node, wanted)
                return None
            if symbol.kind not in DATA:
                self._no_datum(symbol, node)
                return None
            return self.scope.type_of(symbol)
        if isinstance(node, Index):
            return self._indexed(node)
        base = self.datum(cast("Name | Index | Member", node.base))
        if base is None:
            return None
        components = self.scope.components(base)
        if components is None:
            if base in _ATOMIC or degree(base):
                self.report("RG304", f"{base} has no components", node.last, label="no record")
            return None
        if node.component.lower() not in components:
            likely = closest(node.component, components)
            listed = ", ".join(components)
            self.report(
                "RG304",
                f"{base} has no component '{node.component}'",
                node.last,
                help=f"did you mean '{likely}'?" if likely else f"it has {listed}",
            )
            return None
        return components[node.component.lower()]

    def _unknown_datum(self, node: Name, wanted: str | None) -> None:
        given = self.given
        certain = given.judges_data and wanted != "mecunit"
        if given.extent == Extent.TASK and not given.gaps and wanted not in _HARDWARE:
            certain = wanted is not None and wanted not in ("num", "dnum", "anytype")
        if wanted in _HARDWARE and not given.judges_data:
            return
        self.unknown("datum", node.name, node, certain=certain)

    def _no_datum(self, symbol: Symbol, node: Name) -> None:
        help = ""
        if symbol.kind == "FUNC":
            help = f"a function is called with parentheses: {symbol.name}()"
        # A module that is not here may declare a datum that hides the built-in routine.
        hidden = symbol.signature is not None and self.given.extent < Extent.TASK
        self.report(
            "RG306",
            f"'{symbol.name}' is no datum",
            node,
            label=f"a {symbol.kind}",
            help=help,
            related=self.declared(symbol),
            severity=Severity.WARNING if hidden else Severity.ERROR,
        )

    def _indexed(self, node: Index) -> str | None:
        for index in node.indices:
            self.expect(index, "num", "an index")
        base = self.datum(cast(Name, node.base))
        if base is None:
            return None
        dimensions = degree(base)
        if dimensions == 0:
            self.report("RG318", "only an array has an index", node, label=f"this is {base}")
            return None
        if dimensions != len(node.indices):
            self.report(
                "RG318",
                f"the array has {dimensions} dimension(s), not {len(node.indices)}",
                node,
                notes=("a whole element is named, never a part of the array [K §3.5]",),
            )
            return None
        self._bounds(node)
        return element(base)

    def _bounds(self, node: Index) -> None:
        symbol = self.root(node)
        declared = symbol.node if symbol else None
        sizes: list[Expression] = []
        if isinstance(declared, DataDeclaration):
            sizes = declared.dimensions
        for k, index in enumerate(node.indices):
            value = self.constant(index)
            if value is None or isinstance(value, str | bool):
                continue
            size = self.constant(sizes[k]) if k < len(sizes) else None
            if value != int(value) or value < 1:
                self.report("RG318", f"an index is a whole number from 1, not {value:g}", index)
            elif isinstance(size, int | float) and not isinstance(size, bool) and value > size:
                self.report(
                    "RG318",
                    f"the index {value:g} is outside the array of {size:g}",
                    index,
                    related=self.declared(symbol) if symbol else (),
                )

    def constant(self, node: Expression) -> Constant | None:
        """Value of a constant expression in this place."""
        if isinstance(node, NumberLiteral):
            return node.value
        return constant(node, lambda n: self.locals.get(n.lower()) or self.scope.find(n))

    # -- operators -----------------------------------------------------------------------

    def _unary(self, node: Unary) -> str | None:
        if node.operator == "NOT":
            self.expect(node.operand, "bool", "the operand of NOT")
            return "bool"
        found = self.type_of(node.operand)
        if found is None or found in _NUMERIC or found == "pos":
            return found
        self._operator(node, node.operator, found, None)
        return None

    def _binary(self, node: Binary) -> str | None:
        operator = node.operator
        if operator in ("AND", "OR", "XOR"):
            self.expect(node.left, "bool", f"the left operand of {operator}")
            self.expect(node.right, "bool", f"the right operand of {operator}")
            return "bool"
        left, right = self._operands(node)
        if operator in ("=", "<>"):
            if left is not None and right is not None:
                if not _equal(left, right):
                    self._operator(node, operator, left, right)
                elif degree(left):
                    self.same_sizes(node, node.left, node.right)
            return "bool"
        if operator in _RELATIONS:
            if left is not None and right is not None:
                fits = left in _NUMERIC and right in _NUMERIC and _equal(left, right)
                if not fits:
                    self._operator(node, operator, left, right)
            return "bool"
        if left is None or right is None:
            known = left or right
            return known if known in ("string", "dnum") else None
        result = _arithmetic(operator, left, right)
        if result is None:
            self._operator(node, operator, left, right)
        elif result == "string":
            self._long_string(node)
        return result

    def _operands(self, node: Binary) -> tuple[str | None, str | None]:
        """Types of both operands; one aggregate gets its type from the other side."""
        if isinstance(node.left, Aggregate) and isinstance(node.right, Aggregate):
            self.report(
                "RG330",
                "neither side of the operator has a type",
                node,
                help="put one of the aggregates into a datum first",
                notes=("an aggregate has the type of its place [K §3.9]",),
            )
            return None, None
        if isinstance(node.left, Aggregate):
            right = self.type_of(node.right)
            return (self.expect(node.left, right, "the left operand"), right)
        left = self.type_of(node.left)
        if isinstance(node.right, Aggregate):
            return left, self.expect(node.right, left, "the right operand")
        return left, self.type_of(node.right)

    def _operator(self, node: Expression, operator: str, left: str, right: str | None) -> None:
        both = shown(left) if right is None else f"{shown(left)} and {shown(right)}"
        help = ""
        if {left, right} == {"num", "dnum"}:
            help = "convert with NumToDnum or DnumToNum"
        elif operator == "+" and "string" in (left, right):
            help = "convert with ValToStr or NumToStr"
        self.report(
            "RG308",
            f"the operator {operator} does not take {both}",
            node,
            help=help,
            notes=("operators and their operands [K §3.11]",),
        )

    def _long_string(self, node: Binary) -> None:
        value = self.constant(node)
        if isinstance(value, str) and len(value) > MAX_STRING:
            self.report(
                "RG319", f"the string has {len(value)} characters; {MAX_STRING} is the limit", node
            )

    # -- places --------------------------------------------------------------------------

    def expect(self, node: Expression, wanted: str | None, place: str) -> str | None:
        """Check that an expression has the type `wanted`; gives `wanted` when it fits."""
        if wanted is None or wanted == "anytype":
            return self.type_of(node)
        if isinstance(node, Aggregate):
            self._members(node, wanted, place)
            return wanted
        if isinstance(node, NumberLiteral):
            if wanted == "num":
                self._single(node)
                return wanted
            if wanted == "dnum":
                return wanted
        if isinstance(node, Name) and self.root(node) is None:
            self._unknown_datum(node, wanted)
            return wanted
        found = self.type_of(node)
        if found is None or found == wanted or _equal(found, wanted):
            return wanted
        self.mismatch(node, wanted, found, place)
        return wanted

    def same_sizes(self, node: Node, target: Expression, value: Expression) -> None:
        """Whole arrays have the same sizes [K §2.17], where both show them."""
        ours = self._sizes(target)
        if isinstance(value, Aggregate):
            self.members_of(value, ours)
            return
        theirs = self._sizes(value)
        known = len(ours) == len(theirs) and None not in (*ours, *theirs)
        if known and ours != theirs:
            self.report("RG318", "the arrays differ in size", node)

    def _sizes(self, node: Expression) -> list[Constant | None]:
        """Declared sizes of a whole array; None where one is not known, none for what is none."""
        root = self.root(node) if isinstance(node, Name) else None
        if root is None or not isinstance(root.node, DataDeclaration):
            return []
        # Names in another module's declaration mean what they mean there.
        away = root.module not in (None, self.scope)
        return [
            None if away and type(size) is not NumberLiteral else self.constant(size)
            for size in root.node.dimensions
        ]

    def members_of(self, value: Expression, sizes: Sequence[Constant | None]) -> None:
        """Members of an aggregate against the declared sizes of an array."""
        if not sizes or not isinstance(value, Aggregate):
            return
        size = sizes[0]
        if isinstance(size, int | float) and len(value.members) != size:
            self.report(
                "RG318",
                f"the array has {size:g} elements here, the aggregate {len(value.members)}",
                value,
                notes=("an aggregate has a member for each element [K §2.22, 3.9]",),
            )
            return
        for member in value.members:
            self.members_of(member, sizes[1:])

    def mismatch(self, node: Expression, wanted: str, found: str, place: str) -> None:
        """Say that types differ."""
        help = ""
        if {wanted, found} == {"num", "dnum"}:
            help = "convert with NumToDnum or DnumToNum"
        elif wanted == "string" and found in _NUMERIC:
            help = "convert with ValToStr or NumToStr"
        elif wanted == "bool" and found in _NUMERIC:
            help = "compare it: x = 1"
        self.report(
            "RG307",
            f"{place} is {shown(found)}, not {shown(wanted)}",
            node,
            label=f"this is {shown(found)}",
            help=help,
            notes=("types must be equal; nothing is converted [K §2.17]",),
        )

    def _single(self, node: NumberLiteral) -> None:
        """A literal in a place of type num."""
        value = node.value
        if not is_single(value):
            self.report("RG319", f"num cannot hold {node.text}", node, notes=("num [K §2.5]",))
        elif isinstance(value, int) and value > 8_388_608 and not is_exact_single(value):
            self.report(
                "RG319",
                f"num cannot hold {node.text} exactly",
                node,
                help="use dnum, or a number that single precision holds",
                notes=("whole numbers are exact up to 8388608 [K §2.13]",),
                severity=Severity.WARNING,
            )

    def _members(self, node: Aggregate, wanted: str, place: str) -> None:
        """Members of an aggregate against the array or record that its place wants."""
        members = node.members
        dimensions = degree(wanted)
        if dimensions:
            inner = array(element(wanted), dimensions - 1)
            for member in members:
                self.expect(member, inner, "the element")
            return
        components = self.scope.components(wanted)
        if components is None:
            if wanted in _ATOMIC:
                self.report(
                    "RG330", f"{place} is an aggregate, but {wanted} has no components", node
                )
            return
        if len(members) != len(components):
            names = ", ".join(components)
            self.report(
                "RG330",
                f"{wanted} has {len(components)} components, the aggregate {len(members)}",
                node,
                help=f"the components are {names}",
                notes=("an aggregate has a member for each component [K §3.9]",),
            )
            return
        for member, (name, type_name) in zip(members, components.items(), strict=True):
            if type(member) is NumberLiteral and type_name == "num":
                if member.value > 8_388_608:
                    self._single(member)
                continue
            self.expect(member, type_name, f"the component {name}")


def shown(type_name: str) -> str:
    """How a type is called in a message."""
    return "a number" if type_name == NUMBER else type_name


def _equal(left: str, right: str) -> bool:
    if left == right:
        return True
    if left == NUMBER:
        return right in _NUMERIC
    return right == NUMBER and left in _NUMERIC


def _arithmetic(operator: str, left: str, right: str) -> str | None:
    """Type of the result, or None when the operator does not take these [K §3.11]."""
    if left in _NUMERIC and right in _NUMERIC:
        if not _equal(left, right):
            return None
        return right if left == NUMBER else left
    if operator in ("+", "-") and left == right == "pos":
        return "pos"
    if operator == "+" and left == right == "string":
        return "string"
    if operator == "*":
        if left == right and left in ("pos", "orient"):
            return left
        if "pos" in (left, right) and {left, right} & {NUMBER, "num"}:
            return "pos"
    return None


_READERS: Final = cast(
    "dict[type, Callable[[TypeChecker, Expression], str | None]]",
    {
        NumberLiteral: TypeChecker._number,
        StringLiteral: TypeChecker._string,
        BoolLiteral: TypeChecker._bool,
        Name: TypeChecker._read,
        Index: TypeChecker._read,
        Member: TypeChecker._read,
        FunctionCall: TypeChecker._call,
        Aggregate: TypeChecker._aggregate,
        Unary: TypeChecker._unary,
        Binary: TypeChecker._binary,
        Parenthesis: TypeChecker._parenthesis,
        Placeholder: TypeChecker._nothing,
        Star: TypeChecker._nothing,
    },
)
