"""Declarations of data and parameters [K §2.18-2.24, 5.1]."""

from typing import Final, cast

from rapidgen.rapid.syntax.errors import SyntaxFault
from rapidgen.rapid.syntax.expressions import ExpressionParser
from rapidgen.rapid.syntax.lexer import EOF, HOLDER, NAME
from rapidgen.rapid.syntax.nodes import (
    DataDeclaration,
    DataKind,
    Expression,
    Mode,
    Parameter,
    Scope,
)

DATA: Final = ("VAR", "PERS", "CONST")
_DECLARATIONS: Final = frozenset(
    ("VAR", "PERS", "CONST", "PROC", "FUNC", "TRAP", "RECORD", "ALIAS", "LOCAL", "TASK")
)
MODULE_STOPS: Final = _DECLARATIONS | {"ENDMODULE", "MODULE", EOF}
"""Where the declarations of a module go on, or end."""


class DataParser:
    """Parser of data and parameters.

    `builtin` permits REF, which only predefined routines have.
    """

    def __init__(self, expressions: ExpressionParser, *, builtin: bool) -> None:
        self.expressions = expressions
        self.kinds = expressions.kinds
        self.texts = expressions.texts
        self.builtin = builtin

    def semicolon_here(self, i: int, expected: str) -> int:
        """Return the index of the `;` at i.

        A missing one before a new line is reported and skipped.
        """
        if self.kinds[i] == ";":
            return i
        fault = SyntaxFault(i, expected)
        if self.kinds[i] in MODULE_STOPS or self.expressions.starts_line(i):
            self.expressions.fault(fault)
            return i - 1
        raise fault

    def data_declaration(self, i: int) -> DataDeclaration:
        """Parse VAR, PERS or CONST, after LOCAL or TASK [K §2.18-2.24]."""
        kinds, texts = self.kinds, self.texts
        first = i
        scope: Scope = ""
        kind = kinds[i]
        if kind == "LOCAL" or kind == "TASK":
            scope = cast(Scope, kind)
            i += 1
            kind = kinds[i]
        if kinds[i + 1] is NAME and kinds[i + 2] is NAME:
            type_name, name = texts[i + 1], texts[i + 2]
        else:
            type_name = self.expressions.identifier(i + 1, "the name of a type")
            name = self.expressions.identifier(i + 2, "the name of the datum")
        at = i + 3
        dimensions: list[Expression] = []
        if kinds[at] == "{":
            dimensions, at = self._dimensions(at)
        initial: Expression | None = None
        if kinds[at] == ":=":
            initial = self.expressions.expression(at + 1)
            at = initial.last + 1
            if kinds[at] != ";":
                at = self.semicolon_here(at, "';' or an operator")
        elif kind == "CONST":
            raise SyntaxFault(at, "':=' and the value of the constant")
        elif kinds[at] != ";":
            at = self.semicolon_here(at, "';', ':=' or '{'" if not dimensions else "';' or ':='")
        return DataDeclaration(
            first, at, scope, cast(DataKind, kind), type_name, name, dimensions, initial, i + 2
        )

    def _dimensions(self, i: int) -> tuple[list[Expression], int]:
        """Parse sizes in braces; return the index after them."""
        kinds = self.kinds
        sizes: list[Expression] = []
        at = i
        while True:
            if kinds[at + 1] == "*":
                raise SyntaxFault(at + 1, "a size", "only a parameter takes any size")
            size = self.expressions.expression(at + 1)
            sizes.append(size)
            at = size.last + 1
            if kinds[at] == "}":
                return sizes, at + 1
            if kinds[at] != ",":
                raise SyntaxFault(at, "'}', ',' or an operator")

    def parameters(self, i: int) -> tuple[list[Parameter], int]:
        """Parse parameters up to ')'; return the index after it [K §5.1]."""
        kinds = self.kinds
        result: list[Parameter] = []
        if kinds[i] == ")":
            return result, i + 1
        groups = 0
        while True:
            optional = kinds[i] == "\\"
            alternatives = [self._parameter(i, i + 1 if optional else i, optional=optional)]
            while kinds[alternatives[-1].last + 1] == "|" and (optional or self.builtin):
                at = alternatives[-1].last + 2
                if self.builtin and kinds[at] == "\\":  # an optional one in place of a required
                    alternatives.append(self._parameter(at, at + 1, optional=True))
                else:
                    alternatives.append(self._parameter(at, at, optional=optional))
            if len(alternatives) > 1:
                for parameter in alternatives:
                    parameter.group = groups
                groups += 1
            result += alternatives
            i = result[-1].last + 1
            kind = kinds[i]
            if kind == ")":
                return result, i + 1
            if kind == ",":
                i += 1
            elif kind != "\\":
                raise SyntaxFault(i, "',', '\\' or ')'")

    def _parameter(self, first: int, i: int, *, optional: bool) -> Parameter:
        kinds, texts = self.kinds, self.texts
        mode: Mode = ""
        if kinds[i] in ("VAR", "PERS", "INOUT"):
            mode = cast(Mode, kinds[i])
            i += 1
        elif kinds[i] is NAME and texts[i].upper() == "REF" and kinds[i + 2] is NAME:
            if not self.builtin:
                raise SyntaxFault(i, "a type, VAR, PERS or INOUT", "REF is for built-in routines")
            mode = "REF"
            i += 1
        elif kinds[i] is HOLDER:
            text_here = texts[i].upper()
            if text_here == "<PAR>" or (optional and text_here == "<ALT>"):
                return Parameter(first, i, "", "", text_here, 0, optional, -1, i)
        type_name = self.expressions.identifier(i, "a parameter: mode, type and name")
        name = self.expressions.identifier(i + 1, "the name of the parameter")
        end = i + 1
        dimensions = 0
        if kinds[end + 1] == "{":
            at = end + 2
            if kinds[at] is HOLDER and texts[at].upper() == "<DIM>":
                dimensions = 1
                at += 1
            else:
                while kinds[at] == "*":
                    dimensions += 1
                    at += 1
                    if kinds[at] != ",":
                        break
                    at += 1
            if dimensions == 0 or kinds[at - 1] == ",":
                raise SyntaxFault(at, "'*'", "an array parameter is written name{*} or name{*,*}")
            if kinds[at] != "}":
                raise SyntaxFault(at, "'}' or ','")
            end = at
        return Parameter(first, end, mode, type_name, name, dimensions, optional, -1, i + 1)
