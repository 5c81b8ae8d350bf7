"""Types of expressions [K §2.17, 3].

`type_of` returns the type of a read expression. `expect` checks an expression against the type of
its place, which also gives an aggregate its type.
"""

import re
from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Final, cast

from rapidgen.diagnostics import Severity
from rapidgen.rapid.binding import (
    DATA,
    DataSymbol,
    RoutineSymbol,
    Symbol,
    TypeSymbol,
    constant,
    root,
    sizes_of,
)
from rapidgen.rapid.binding.names import (
    AGGREGATE,
    ATOMIC,
    EQUALITY,
    LOGICAL,
    NUMBER,
    NUMERIC,
    RELATIONS,
    arithmetic,
    array,
    called,
    degree,
    element,
    equal,
)
from rapidgen.rapid.builtins.signatures import Value
from rapidgen.rapid.checks.calls import CallChecker
from rapidgen.rapid.checks.context import closest
from rapidgen.rapid.checks.findings import Findings
from rapidgen.rapid.numbers import MAX_STRING, is_exact_single, is_single
from rapidgen.rapid.syntax.nodes import (
    Aggregate,
    Binary,
    BoolLiteral,
    Expression,
    FunctionCall,
    Index,
    Member,
    Name,
    Node,
    NumberLiteral,
    Parenthesis,
    Placeholder,
    Shape,
    Star,
    StringLiteral,
    Unary,
)

_LOADED: Final = ("the error comes when it is executed",)
"""Two controllers' backups hold a module with an index outside its array: it is loaded."""
_MAX_DEPTH: Final = 50
_GEOMETRIC: Final = frozenset(
    ("num", "pos", "orient", "pose", "confdata", "extjoint", "robjoint", "robtarget", "jointtarget")
)
"""Types of which a num that can hold its value is all that the checks require."""
_MANY_DIGITS: Final = re.compile(r"\d{8,}\Z|\d{31}|0[xXoObB]|[\d.]+[eE]\+?(?:[3-9]\d|\d{3})")
"""Numbers that a num perhaps cannot hold."""


class TypeChecker:
    """Determines types of expressions and reports violations."""

    def __init__(self, findings: Findings) -> None:
        self.findings = findings
        self.report, self.declared = findings.report, findings.declared
        self.calls = CallChecker(findings, self)
        self.is_placeholder = False
        """The initial value of a tool or load that no module uses: its mass may be -1."""
        self._depth = 0
        self._sound: set[tuple[str, Shape | None]] = set()
        """Types and shapes of aggregates that were checked without a finding."""

    # -- reading -------------------------------------------------------------------------

    def type_of(self, node: Expression) -> str | None:
        """Return the type of a read expression, None if unknown.

        Expressions nested beyond the limit are not checked further.
        """
        if self._depth >= _MAX_DEPTH:
            return None
        self._depth += 1
        result = _READERS[type(node)](self, node)
        self._depth -= 1
        return result

    def _number(self, node: NumberLiteral) -> str:
        if not is_single(node.value) and not self.findings.given.dialect.has_dnum:
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
        """Check a datum in value context.

        A signal reads as num; a non-value datum cannot be read.
        """
        result = self.datum(node)
        if result is None:
            return None
        kind = self.findings.module.type_class(result)
        if kind == "semivalue":
            return array("num", degree(result))
        if kind == "nonvalue":
            self.report(
                "RG309",
                f"{element(result)} has no value that could be used in an expression",
                node,
                help="hand it to a routine with a VAR parameter",
                notes=("value classes [K §2.16]",),
            )
            return None
        return result

    def _call(self, node: FunctionCall) -> str | None:
        symbol = called(self.findings.find(node.name))
        if symbol is None:
            self.findings.unknown("function", node.name, node.first)
            self.calls.loose_arguments(node.arguments)
            return None
        if not isinstance(symbol, RoutineSymbol) or symbol.kind != "FUNC":
            what = (
                "an array: its index is written in braces" if symbol.kind in DATA else "no function"
            )
            self.report(
                "RG306",
                f"'{symbol.name}' is {what}",
                node.first,
                label=f"a {symbol.kind}",
                related=self.declared(symbol),
            )
            return None
        self.calls.check_arguments(symbol, node)
        return self.findings.module.type_of(symbol)

    def used(self, node: Expression) -> None:
        """Check an expression in a place without a required type."""
        if isinstance(node, Name | Index | Member):
            self.datum(node)
        elif isinstance(node, Binary) and node.has_type_of_place:
            self.used(node.left)
            self.used(node.right)
        else:
            self.type_of(node)

    # -- data ----------------------------------------------------------------------------

    def root(self, node: Expression) -> Symbol | None:
        """Return the first symbol of a data reference.

        It neither marks nor reports.
        """
        return root(node, self.findings.here)

    def datum(self, node: Name | Index | Member, expected: str | None = None) -> str | None:
        """Return the declared type of a data reference.

        It includes signals and non-value types.
        """
        if isinstance(node, Name):
            symbol = self.findings.find(node.name)
            if symbol is None:
                self._unknown_datum(node, expected)
                return None
            if symbol.kind not in DATA:
                self._no_datum(symbol, node, expected)
                return None
            return self.findings.module.type_of(symbol)
        if isinstance(node, Index):
            return self._indexed(node)
        base = self.datum(cast("Name | Index | Member", node.base))
        if base is None:
            return None
        components = self.findings.module.components(base)
        if components is None:
            if base in ATOMIC or degree(base):
                self.report("RG304", f"{base} has no components", node.last, label="no record")
            return None
        if node.component.lower() not in components:
            likely = closest(node.component, components)
            listed = ", ".join(components)
            partly = self.findings.module.knows_in_part(base)
            self.report(
                "RG304",
                f"{base} has no component '{node.component}'",
                node.last,
                help=f"did you mean '{likely}'?" if likely else f"it has {listed}",
                notes=("not all names of its components are public",) if partly else (),
                severity=Severity.WARNING if partly else Severity.ERROR,
                fixes=self.findings.spelling(likely, node.last),
            )
            return None
        return components[node.component.lower()]

    def _unknown_datum(self, node: Name, expected: str | None) -> None:
        self.findings.unknown("datum", node.name, node, expected)

    def _no_datum(self, symbol: Symbol, node: Name, expected: str | None) -> None:
        if symbol.module is None and isinstance(symbol, TypeSymbol) and self._may_be_hidden:
            self._unknown_datum(node, expected)  # WaitDI SENSOR, 1;
            return
        help = ""
        if symbol.kind == "FUNC":
            help = f"a function is called with parentheses: {symbol.name}()"
        # A module outside the input may declare a datum that hides the built-in routine.
        hidden = isinstance(symbol, RoutineSymbol) and symbol.node is None
        hidden = hidden and self._may_be_hidden
        self.report(
            "RG306",
            f"'{symbol.name}' is no datum",
            node,
            label=f"a {symbol.kind}",
            help=help,
            related=self.declared(symbol),
            severity=Severity.WARNING if hidden else Severity.ERROR,
        )

    @property
    def _may_be_hidden(self) -> bool:
        """True if an unknown object, such as a signal, may hide a predefined one."""
        given = self.findings.given
        return not (given.is_complete and given.configured)

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
        sizes = self._sizes(node.base)
        for k, index in enumerate(node.indices):
            value = self.constant(index)
            if value is None or isinstance(value, str | bool | tuple):
                continue
            size = sizes[k] if k < len(sizes) else None
            if value != int(value) or value < 1:
                self.report(
                    "RG318",
                    f"an index is a whole number from 1, not {value:g}",
                    index,
                    notes=_LOADED,
                    severity=Severity.WARNING,
                )
            elif isinstance(size, int | float) and not isinstance(size, bool) and value > size:
                self.report(
                    "RG318",
                    f"the index {value:g} is outside the array of {size:g}",
                    index,
                    notes=_LOADED,
                    related=self.declared(symbol) if symbol else (),
                    severity=Severity.WARNING,
                )

    def constant(self, node: Expression) -> Value | None:
        """Return the value of a constant expression."""
        return constant(node, self.findings.here)

    # -- operators -----------------------------------------------------------------------

    def _unary(self, node: Unary) -> str | None:
        if node.operator == "NOT":
            self.expect(node.operand, "bool", "the operand of NOT")
            return "bool"
        result = self.type_of(node.operand)
        if result is None or result in NUMERIC or result == "pos":
            return result
        self._operator(node, node.operator, result, None)
        return None

    def _binary(self, node: Binary) -> str | None:
        operator = node.operator
        if operator in LOGICAL:
            self.expect(node.left, "bool", f"the left operand of {operator}")
            self.expect(node.right, "bool", f"the right operand of {operator}")
            return "bool"
        left, right = self._operands(node)
        if operator in EQUALITY:
            if left is not None and right is not None:
                if not equal(left, right):
                    self._operator(node, operator, left, right)
                elif degree(left):
                    self.same_sizes(node, node.left, node.right)
            return "bool"
        if operator in RELATIONS:
            if left is not None and right is not None:
                fits = left in NUMERIC and right in NUMERIC and equal(left, right)
                if not fits:
                    self._operator(node, operator, left, right)
            return "bool"
        if left is None or right is None:
            known = left or right
            return known if known in ("string", "dnum") else None
        result = arithmetic(operator, left, right)
        if result is None:
            self._operator(node, operator, left, right)
        elif result == "string":
            self._long_string(node)
        return result

    def _operands(self, node: Binary) -> tuple[str | None, str | None]:
        """Return the types of both operands.

        An aggregate takes its type from the other side.
        """
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

    def expect(self, node: Expression, expected: str | None, place: str) -> str | None:
        """Check that an expression has the type `expected` and return it."""
        if expected is None or expected == "anytype":
            return self.type_of(node)
        if isinstance(node, Aggregate):
            self._aggregate_of(node, expected, place)
            return expected
        if expected == "pos" and isinstance(node, Binary) and node.has_type_of_place:
            self.expect(node.left, expected, place)
            return self.expect(node.right, expected, place)
        if isinstance(node, NumberLiteral):
            if expected == "num":
                self._single(node)
                return expected
            if expected == "dnum":
                return expected
        if isinstance(node, Name) and self.root(node) is None:
            self._unknown_datum(node, expected)
            return expected
        result = self.type_of(node)
        if result is None or result == expected or equal(result, expected):
            return expected
        self.mismatch(node, expected, result, place)
        return expected

    def same_sizes(self, node: Node, target: Expression, value: Expression) -> None:
        """Check that whole arrays have the same sizes, if known [K §2.17]."""
        ours = self._sizes(target)
        if isinstance(value, Aggregate):
            self.members_of(value, ours)
            return
        theirs = self._sizes(value)
        known = len(ours) == len(theirs) and None not in (*ours, *theirs)
        if known and ours != theirs:
            self.report("RG318", "the arrays differ in size", node)

    def _sizes(self, node: Expression) -> Sequence[Value | None]:
        """Return the declared sizes of a whole array.

        None marks an unknown size; other expressions have none.
        """
        symbol = self.root(node) if isinstance(node, Name) else None
        return sizes_of(symbol, self.findings.here) if isinstance(symbol, DataSymbol) else ()

    def members_of(self, value: Expression, sizes: Sequence[Value | None]) -> None:
        """Check the members of an aggregate against an array's sizes."""
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

    def mismatch(self, node: Expression, expected: str, result: str, place: str) -> None:
        """Report that types differ."""
        help = ""
        if {expected, result} == {"num", "dnum"}:
            help = "convert with NumToDnum or DnumToNum"
        elif expected == "string" and result in NUMERIC:
            help = "convert with ValToStr or NumToStr"
        elif expected == "bool" and result in NUMERIC:
            help = "compare it: x = 1"
        self.report(
            "RG307",
            f"{place} is {shown(result)}, not {shown(expected)}",
            node,
            label=f"this is {shown(result)}",
            help=help,
            notes=("types must be equal; nothing is converted [K §2.17]",),
        )

    def _single(self, node: NumberLiteral) -> None:
        """Check a literal in a place of type num."""
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

    def load(self, node: Expression) -> None:
        """Check the mass of a load, if known.

        It must not be negative, or above the payload of the robot.
        """
        mass = self.constant(node)
        if isinstance(mass, bool) or not isinstance(mass, int | float):
            return
        payload = self.findings.given.payload
        if mass < 0:
            if self.is_placeholder:
                return
            self.report(
                "RG333",
                f"a load of {mass:g} kg: its first move stops the program",
                node,
                help="weigh it, or let the service routine LoadIdentify measure it",
                notes=("event 41438, undefined load",),
                severity=Severity.WARNING,
            )
        elif payload is not None and mass > payload.mass:
            self.report(
                "RG333",
                f"a load of {mass:g} kg is more than {payload.robot} carries, {payload.mass:g} kg",
                node,
                help="the unit is kg",
                severity=Severity.WARNING,
            )

    def _aggregate_of(self, node: Aggregate, expected: str, place: str) -> None:
        """Check an aggregate; of those of numbers with equal types and shapes the first one."""
        key = expected, node.shape
        if key in self._sound:
            return
        count = len(self.findings.found)
        self._members(node, expected, place)
        if (
            node.shape is not None
            and element(expected) in _GEOMETRIC
            and len(self.findings.found) == count
            and self._has_plain_numbers
        ):
            self._sound.add(key)

    @cached_property
    def _has_plain_numbers(self) -> bool:
        """True if a num can hold each number that is written in the module."""
        distinct = set(self.findings.module.tree.source.tokens)
        return not any(_MANY_DIGITS.match(token) for token in distinct)

    def _members(self, node: Aggregate, expected: str, place: str) -> None:
        """Check the members of an aggregate against its type."""
        members = node.members
        dimensions = degree(expected)
        if dimensions:
            inner = array(element(expected), dimensions - 1)
            for member in members:
                self.expect(member, inner, "the element")
            return
        if expected == "loaddata" and members:
            self.load(members[0])
        components = self.findings.module.components(expected)
        if components is None:
            if expected in ATOMIC:
                self.report(
                    "RG330", f"{place} is an aggregate, but {expected} has no components", node
                )
            return
        if not self.findings.module.takes(expected, len(members)):
            names = ", ".join(components)
            self.report(
                "RG330",
                f"{expected} has {len(components)} components, the aggregate {len(members)}",
                node,
                help=f"the components are {names}",
                notes=("an aggregate has a member for each component [K §3.9]",),
            )
            return
        for member, (name, type_name) in zip(members, components.items(), strict=False):
            if type(member) is NumberLiteral and type_name == "num":
                if member.value > 8_388_608:
                    self._single(member)
                continue
            self.expect(member, type_name, f"the component {name}")


def shown(type_name: str) -> str:
    """Return the display name of a type."""
    return "a number" if type_name == NUMBER else type_name


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
