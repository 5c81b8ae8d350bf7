"""Expressions and arguments: the most frequently executed parser part.

[K §3]: precedence, high to low, `* / DIV MOD`, `+ -`, relations (one a level), AND, / OR XOR. K
derives NOT only at the start of an expression and a sign only at the start of a sum; both are
accepted elsewhere with a warning, where they bind to the next operand.

The functions take the index of the first token and return the node; the next token is at `node.last
+ 1`. There is no cursor that they consume.
"""

from typing import Final

from rapidgen.diagnostics import Diagnostic, Severity, error
from rapidgen.rapid.syntax import errors, lexer
from rapidgen.rapid.syntax.errors import Block, ParseAborted, SyntaxFault
from rapidgen.rapid.syntax.lexer import HOLDER, NAME, NUMBER, STRING, Tokens
from rapidgen.rapid.syntax.nodes import (
    Aggregate,
    Argument,
    Binary,
    BoolLiteral,
    Expression,
    FunctionCall,
    Index,
    Member,
    Name,
    NumberLiteral,
    Parenthesis,
    Placeholder,
    Shape,
    Star,
    StringLiteral,
    Unary,
)

MAX_EXPRESSION_DEPTH: Final = 200
MAX_BLOCK_DEPTH: Final = 100
MAX_ERRORS: Final = 100

_AND_LEVEL: Final = 2
_RELATION_LEVEL: Final = 4
_SIGN_LEVEL: Final = 5
_TIGHT: Final = 9
_LEVELS: Final = {
    "OR": 0, "XOR": 0,
    "AND": _AND_LEVEL,
    "<": _RELATION_LEVEL, "<=": _RELATION_LEVEL, ">": _RELATION_LEVEL,
    ">=": _RELATION_LEVEL, "=": _RELATION_LEVEL, "<>": _RELATION_LEVEL,
    "+": _SIGN_LEVEL, "-": _SIGN_LEVEL,
    "*": 6, "/": 6, "DIV": 6, "MOD": 6,
}  # fmt: skip
_AFTER_NAMES: Final = frozenset(("(", "{", "."))
"""Tokens that make a name part of a longer reference."""
_AFTER_DECLARED: Final = frozenset((";", ":=", "{", "(", ")", ",", "\\", "|", "FROM"))
"""Tokens after a reserved word that was meant as a name."""
_PLAIN_OPERANDS: Final = frozenset((NAME, NUMBER, STRING, "(", "[", "TRUE", "FALSE"))
_AFTER_ARGUMENTS: Final = frozenset((",", ";", "\\", ")"))
_NOT_LEVEL: Final = 1
"""NOT takes a whole chain of ANDs, and ends at OR or XOR."""
_INNER_NOT_LEVEL: Final = 3
"""A NOT that K does not derive takes one relation."""


class _Numbers(dict[str, float]):
    """Spelling to value of a number."""

    def __missing__(self, text: str) -> float:
        value = self[text] = lexer.number_value(text)
        return value


class ExpressionParser:
    """Parser of expressions from two parallel lists, texts and kinds.

    It collects the errors. Blocks, data, statements, routines and module are built on it.
    """

    def __init__(self, tokens: Tokens) -> None:
        self.source = tokens.source
        self.kinds = tokens.kinds
        self.texts = tokens.source.tokens
        self.numbers = _Numbers()
        self.diagnostics: list[Diagnostic] = []
        self.open: list[Block] = []
        self.depth = 0
        self.loose = -2
        """The last prefix operator that K does not derive."""
        self.end_reported = False
        """True after a report of an error at the end of the text."""
        self.after = 0
        """Index after the last list of arguments."""

    def report(self, diagnostic: Diagnostic) -> None:
        """Record a finding; too many end the parse."""
        self.diagnostics.append(diagnostic)
        if len(self.diagnostics) >= MAX_ERRORS:
            raise ParseAborted(errors.too_many(diagnostic, MAX_ERRORS))

    def fault(self, result: SyntaxFault) -> None:
        """Report the fault of a statement or declaration once."""
        self.depth = 0
        if result.reported or (self.kinds[result.at] is lexer.EOF and self.end_reported):
            return
        result.reported = True
        # A quote that takes the last line takes all that could close what is open.
        last = result.at if self.kinds[result.at] is not lexer.UNTERMINATED else result.at + 1
        self.end_reported = self.kinds[last] is lexer.EOF
        self.report(
            errors.unexpected(
                self.source, self.kinds, result.at, result.expected, self.open, result.help
            )
        )

    def unclosed(self, i: int, missing: int) -> None:
        """Report that token i ends an outer block.

        `missing` inner blocks are open.
        """
        if self.kinds[i] is lexer.EOF:
            if self.end_reported:
                return
            self.end_reported = True
        self.report(errors.unclosed(self.source, self.kinds, i, self.open, missing))

    def too_deep(self, at: int) -> ParseAborted:
        """Return the diagnostic of an expression beyond the depth limit."""
        return ParseAborted(
            error(
                "RG211",
                errors.place(self.source, at),
                f"the expression is nested more than {MAX_EXPRESSION_DEPTH} deep",
                "split the expression over several statements",
            )
        )

    def identifier(self, i: int, expected: str) -> str:
        """Return the name at token i, or the placeholder <ID>."""
        if self.kinds[i] is NAME:
            return self.texts[i]
        if self.kinds[i] is HOLDER and self.texts[i].upper() == "<ID>":
            return "<ID>"
        if self.kinds[i] in lexer.KEYWORDS and self.kinds[i + 1] in _AFTER_DECLARED:
            # Accept it as the intended name, to avoid follow-up errors.
            self.fault(SyntaxFault(i, expected, f"{self.kinds[i]} is a reserved word"))
            return self.texts[i]
        raise SyntaxFault(i, expected)

    def starts_line(self, at: int) -> bool:
        """Return True if token `at` is the first of its line."""
        gap = self.source.gaps[at - 1] if at else self.source.lead
        return "\n" in gap or "\r" in gap

    def expression(self, i: int) -> Expression:
        """Parse the expression that starts at token i."""
        kinds = self.kinds
        kind = kinds[i]
        node: Expression
        if kind is NUMBER:
            text = self.texts[i]
            node = NumberLiteral(i, i, self.numbers[text], text)
        elif kind is NAME:
            following = kinds[i + 1]
            if following in _AFTER_NAMES:
                node = self.named(i)
            else:
                node = Name(i, i, self.texts[i])
        elif kind == "[":
            node = self.aggregate(i)
        elif kind is STRING:
            node = StringLiteral(i, i, lexer.string_value(self.texts[i]))
        else:
            return self._operators(i, None)
        if kinds[node.last + 1] in _LEVELS:
            return self._operators(node.last + 1, node)
        return node

    def _operand(self, i: int) -> Expression:
        """Parse a primary [K §3]."""
        kind = self.kinds[i]
        if kind is NAME:
            following = self.kinds[i + 1]
            if following in _AFTER_NAMES:
                return self.named(i)
            return Name(i, i, self.texts[i])
        if kind is NUMBER:
            text = self.texts[i]
            return NumberLiteral(i, i, self.numbers[text], text)
        if kind is STRING:
            return StringLiteral(i, i, lexer.string_value(self.texts[i]))
        if kind == "(":
            self.depth += 1
            if self.depth > MAX_EXPRESSION_DEPTH:
                raise self.too_deep(i)
            inner = self.expression(i + 1)
            end = inner.last + 1
            if self.kinds[end] != ")":
                raise SyntaxFault(end, "')' or an operator")
            self.depth -= 1
            return Parenthesis(i, end, inner)
        if kind == "[":
            return self.aggregate(i)
        if kind == "TRUE":
            return BoolLiteral(i, i, True)
        if kind == "FALSE":
            return BoolLiteral(i, i, False)
        if kind is HOLDER and self.texts[i].upper() == "<EXP>":
            return Placeholder(i, i, "<EXP>")
        raise SyntaxFault(i, "an expression")

    def _operators(self, i: int, left: Expression | None) -> Expression:
        """Parse operators with two stacks.

        `left` is an operand already parsed.
        """
        kinds = self.kinds
        operands: list[Expression] = []
        pending: list[tuple[int, str, int]] = []
        """(level, operator, token); a negative token marks a prefix: ~token."""
        depth, chained = self.depth, 0
        if left is not None and kinds[i + 1] in _PLAIN_OPERANDS:
            # One operator between two operands is most of what there is.
            operator = kinds[i]
            right = self._operand(i + 1)
            if kinds[right.last + 1] not in _LEVELS:
                return Binary(left.first, right.last, operator, left, right)
            operands.append(left)
            pending.append((_LEVELS[operator], operator, i))
            left, chained, i = right, 1, right.last + 1
        while True:
            if left is None:
                kind = kinds[i]
                if kind == "NOT" or kind == "-" or kind == "+":
                    pending.append((self._prefix_level(i, kind, pending), kind, ~i))
                    self.depth += 1
                    if self.depth > MAX_EXPRESSION_DEPTH:
                        raise self.too_deep(i)
                    i += 1
                    continue
                left = self._operand(i)
                i = left.last + 1
            operands.append(left)
            operator = kinds[i]
            level = _LEVELS.get(operator, -1)
            while pending and pending[-1][0] >= level:
                top, sign, at = pending.pop()
                if top == level == _RELATION_LEVEL:
                    raise SyntaxFault(i, "an operator that can follow a relation, or its end")
                right = operands.pop()
                if at < 0:
                    operands.append(Unary(~at, right.last, sign, right))
                else:
                    base = operands.pop()
                    operands.append(Binary(base.first, right.last, sign, base, right))
            if level < 0:
                self.depth = depth
                return operands[0]
            chained += 1
            if chained + self.depth > MAX_EXPRESSION_DEPTH:
                raise self.too_deep(i)
            pending.append((level, operator, i))
            left = None
            i += 1

    def _prefix_level(self, i: int, kind: str, pending: list[tuple[int, str, int]]) -> int:
        if kind == "NOT":
            if not pending:
                return _NOT_LEVEL
            self._loose(i, pending, "NOT is permitted only at the start of an expression")
            return _INNER_NOT_LEVEL if pending[-1][0] < _RELATION_LEVEL else _TIGHT
        if pending and pending[-1][0] >= _SIGN_LEVEL:
            self._loose(i, pending, "a sign is permitted only at the start of a sum")
            return _TIGHT
        return _SIGN_LEVEL

    def _loose(self, i: int, pending: list[tuple[int, str, int]], rule: str) -> None:
        again = ~pending[-1][2] == self.loose
        self.loose = i
        if again:
            return  # one warning for a row of prefixes
        self.report(
            error(
                "RG212",
                errors.place(self.source, i),
                rule,
                "put it and its operand in parentheses",
                label="bound to the next operand",
                notes=("the RAPID kernel manual does not derive this form [K §3]",),
                severity=Severity.WARNING,
            )
        )

    def named(self, i: int) -> Expression:
        """Parse a datum with indices and components, or a function call."""
        kinds, texts = self.kinds, self.texts
        following = kinds[i + 1]
        if following == "(":
            self.depth += 2  # a call and its arguments are a level each
            if self.depth > MAX_EXPRESSION_DEPTH:
                raise self.too_deep(i)
            arguments = self.arguments(i + 2, ")")
            self.depth -= 2
            return FunctionCall(i, self.after, texts[i], arguments)
        return self.reference(i)

    def reference(self, i: int) -> Name | Index | Member:
        """Parse `name`, `name{i}`, `name.c`, `name{i}.c.d` [K §3.5].

        Only a whole datum has indices.
        """
        kinds, texts = self.kinds, self.texts
        node: Name | Index | Member = Name(i, i, texts[i])
        at = i + 1
        if kinds[at] == "{":
            self.depth += 1
            if self.depth > MAX_EXPRESSION_DEPTH:
                raise self.too_deep(i)
            indices = [self.expression(at + 1)]
            at = indices[0].last + 1
            while kinds[at] == ",":
                value = self.expression(at + 1)
                indices.append(value)
                at = value.last + 1
            if kinds[at] != "}":
                raise SyntaxFault(at, "'}', ',' or an operator")
            self.depth -= 1
            node = Index(i, at, node, indices)
            at += 1
        members = 0
        while kinds[at] == ".":
            if kinds[at + 1] is not NAME:
                raise SyntaxFault(at + 1, "the name of a component")
            node = Member(i, at + 1, node, texts[at + 1])
            at += 2
            members += 1
            if members > MAX_EXPRESSION_DEPTH:
                raise self.too_deep(i)
        return node

    def aggregate(self, i: int) -> Aggregate:
        """Parse `[a, b, ...]` [K §3.9] with at least one member."""
        kinds, texts, numbers = self.kinds, self.texts, self.numbers
        self.depth += 1
        if self.depth > MAX_EXPRESSION_DEPTH:
            raise self.too_deep(i)
        members: list[Expression] = []
        append = members.append
        is_row = True
        at = i
        # Positions are most of many files: numbers and rows of numbers go without a call.
        while True:
            at += 1
            kind = kinds[at]
            if kind is NUMBER:
                following = kinds[at + 1]
                if following == "," or following == "]":
                    text = texts[at]
                    append(NumberLiteral(at, at, numbers[text], text))
                    at += 1
                    if following == ",":
                        continue
                    self.depth -= 1
                    return Aggregate(i, at, members, len(members) if is_row else _shape(members))
            elif kind == "-" and kinds[at + 1] is NUMBER:
                following = kinds[at + 2]
                if following == "," or following == "]":
                    text = texts[at + 1]
                    number = NumberLiteral(at + 1, at + 1, numbers[text], text)
                    append(Unary(at, at + 1, "-", number))
                    at += 2
                    if following == ",":
                        continue
                    self.depth -= 1
                    return Aggregate(i, at, members, len(members) if is_row else _shape(members))
            is_row = False
            value = self.expression(at)
            append(value)
            at = value.last + 1
            kind = kinds[at]
            if kind == ",":
                continue
            if kind == "]":
                self.depth -= 1
                return Aggregate(i, at, members, _shape(members))
            raise SyntaxFault(at, "',', ']' or an operator")

    def arguments(self, i: int, close: str) -> list[Argument]:
        """Parse arguments up to `close`, whose index goes to `after`.

        Source: [K §3.10, 4.5].
        """
        kinds, texts = self.kinds, self.texts
        result: list[Argument] = []
        kind = kinds[i]
        if kind == close:
            self.after = i
            return result
        while True:
            if kind is NAME:
                following = kinds[i + 1]
                if following in _AFTER_ARGUMENTS:
                    argument = Argument(i, i, "required", None, Name(i, i, texts[i]))
                elif following == ":=":
                    value = self.expression(i + 2)
                    argument = Argument(i, value.last, "required", texts[i], value)
                else:
                    value = self.expression(i)
                    argument = Argument(i, value.last, "required", None, value)
            elif kind == "\\":
                argument = self._optional(i, close)
            elif kind == "*" and kinds[i + 1] in _AFTER_ARGUMENTS:
                argument = Argument(i, i, "required", None, Star(i, i))
            elif kind is HOLDER and close == ";" and texts[i].upper() == "<ARG>":
                argument = Argument(i, i, "required", None, Placeholder(i, i, "<ARG>"))
            elif (
                kind is HOLDER and close == ";" and kinds[i + 1] == ":=" and self._holder(i, "<ID>")
            ):
                value = self.expression(i + 2)
                argument = Argument(i, value.last, "required", "<ID>", value)
            else:
                value = self.expression(i)
                argument = Argument(i, value.last, "required", None, value)
            result.append(argument)
            i = argument.last + 1
            kind = kinds[i]
            if kind == ",":
                i += 1
                kind = kinds[i]
            elif kind == close:
                self.after = i
                return result
            elif kind != "\\":
                given = "':=', " if kind == "=" and argument.kind == "switch" else ""
                raise SyntaxFault(i, f"{given}',', '\\' or '{close}'")

    def _optional(self, i: int, close: str) -> Argument:
        """Parse the optional or conditional argument at a backslash.

        Includes <ID> and <VAR> for procedures.
        """
        kinds, texts = self.kinds, self.texts
        if kinds[i + 1] is not NAME and not (close == ";" and self._holder(i + 1, "<ID>")):
            raise SyntaxFault(i + 1, "the name of an optional argument")
        name = texts[i + 1]
        kind = kinds[i + 2]
        if kind == ":=":
            value = self.expression(i + 3)
            return Argument(i, value.last, "optional", name, value)
        if kind == "?":
            at = i + 3
            if kinds[at] is NAME or (close == ";" and self._holder(at, "<ID>")):
                return Argument(i, at, "conditional", name, Name(at, at, texts[at]))
            if close == ";" and self._holder(at, "<VAR>"):
                return Argument(i, at, "conditional", name, Placeholder(at, at, "<VAR>"))
            raise SyntaxFault(at, "the name of an optional parameter")
        return Argument(i, i + 1, "switch", name, None)

    def _holder(self, i: int, text: str) -> bool:
        return self.kinds[i] is HOLDER and self.texts[i].upper() == text


def _shape(members: list[Expression]) -> "Shape | None":
    """Return the shape of an aggregate with these members; None: not of numbers alone."""
    result: list[Shape] = []
    for member in members:
        if type(member) is Aggregate:
            if member.shape is None:
                return None
            result.append(member.shape)
        elif type(member) is NumberLiteral or (
            type(member) is Unary and type(member.operand) is NumberLiteral
        ):
            result.append(0)
        else:
            return None
    return tuple(result)
