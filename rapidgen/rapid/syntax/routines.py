"""Data declarations and routines [K §2.18-2.24, 5]."""

from typing import Final, cast

from rapidgen.rapid.syntax import faults
from rapidgen.rapid.syntax.blocks import ROUTINE_END_WORDS
from rapidgen.rapid.syntax.faults import CLOSER, SyntaxFault
from rapidgen.rapid.syntax.lexer import EOF, HOLDER, NAME, NUMBER, Tokens
from rapidgen.rapid.syntax.nodes import (
    DataDeclaration,
    DataKind,
    ErrorHandler,
    Expression,
    Handler,
    Mode,
    Name,
    NumberLiteral,
    Parameter,
    RoutineDeclaration,
    RoutineKind,
    Scope,
)
from rapidgen.rapid.syntax.statements import StatementParser

DATA: Final = ("VAR", "PERS", "CONST")
ROUTINES: Final = ("PROC", "FUNC", "TRAP")
_DECLARATIONS: Final = frozenset(
    ("VAR", "PERS", "CONST", "PROC", "FUNC", "TRAP", "RECORD", "ALIAS", "LOCAL", "TASK")
)
MODULE_STOPS: Final = _DECLARATIONS | {"ENDMODULE", "MODULE", EOF}
"""Where the declarations of a module go on, or end."""


class RoutineParser(StatementParser):
    """Parses data and routines. `builtin` allows what only predefined routines have: REF."""

    def __init__(self, tokens: Tokens, *, builtin: bool = False) -> None:
        super().__init__(tokens)
        self.builtin = builtin

    def semicolon_here(self, i: int, expected: str) -> int:
        """Index of the `;` at i. A missing one before a new line is reported and passed over."""
        if self.kinds[i] == ";":
            return i
        fault = SyntaxFault(i, expected)
        if self.kinds[i] in MODULE_STOPS or self._starts_line(i):
            self.fault(fault)
            return i - 1
        raise fault

    def data_declaration(self, i: int) -> DataDeclaration:
        """VAR, PERS or CONST, with LOCAL or TASK before it [K §2.18-2.24]."""
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
            type_name = self.identifier(i + 1, "the name of a type")
            name = self.identifier(i + 2, "the name of the datum")
        at = i + 3
        dimensions: list[Expression] = []
        if kinds[at] == "{":
            dimensions, at = self._dimensions(at)
        initial: Expression | None = None
        if kinds[at] == ":=":
            initial = self.expression(at + 1)
            at = initial.last + 1
            if kinds[at] != ";":
                at = self.semicolon_here(at, "';' or an operator")
        elif kind == "CONST":
            raise SyntaxFault(at, "':=' and the value of the constant")
        elif kinds[at] != ";":
            at = self.semicolon_here(at, "';', ':=' or '{'" if not dimensions else "';' or ':='")
        return DataDeclaration(
            first,
            at,
            scope,
            cast(DataKind, kind),
            type_name,
            name,
            dimensions,
            initial,
            i + 2,
        )

    def _dimensions(self, i: int) -> tuple[list[Expression], int]:
        """Sizes in braces, and the index behind them."""
        kinds = self.kinds
        sizes: list[Expression] = []
        at = i
        while True:
            if kinds[at + 1] == "*":
                raise SyntaxFault(at + 1, "a size", "only a parameter takes any size")
            size = self.expression(at + 1)
            sizes.append(size)
            at = size.last + 1
            if kinds[at] == "}":
                return sizes, at + 1
            if kinds[at] != ",":
                raise SyntaxFault(at, "'}', ',' or an operator")

    # -- routines ------------------------------------------------------------------------

    def routine(self, first: int, i: int, scope: Scope) -> RoutineDeclaration:
        """PROC, FUNC or TRAP whose keyword is token i [K §5.3-5.5]."""
        kinds = self.kinds
        kind = kinds[i]
        self.open.append((kind, i))
        self.forgiven.clear()
        self.suspect = (-1, -1)
        type_name: str | None = None
        name, name_token = "", i
        parameters: list[Parameter] = []
        try:
            at = i + 1
            if kind == "FUNC":
                type_name = self.identifier(at, "the type of the function")
                at += 1
            name_token = at
            name = self.identifier(at, "the name of the routine")
            at += 1
            if kind != "TRAP":
                if kinds[at] != "(":
                    raise SyntaxFault(at, "'('", "the parentheses are there even when empty")
                parameters, at = self.parameters(at + 1)
            elif kinds[at] == "(":
                raise SyntaxFault(at, "the body of the trap", "a TRAP has no parameters")
        except SyntaxFault as found:
            self.depth = 0
            self.fault(found)
            at = self.behind_header(found.at)
        return self._routine_body(first, i, at, scope, type_name, name, parameters, name_token)

    def behind_header(self, at: int) -> int:
        """Index behind the parentheses of a header with an error at token `at`."""
        kinds = self.kinds
        depth = 0
        while True:
            kind = kinds[at]
            if kind == "(":
                depth += 1
            elif kind == ")":
                depth -= 1
                if depth <= 0:
                    return at + 1
            elif (
                kind == ";"
                or (kind in MODULE_STOPS and kind not in DATA)
                or (depth <= 0 and self._starts_line(at) and kind not in (",", "\\", "|"))
            ):
                return at
            at += 1

    def _routine_body(
        self,
        first: int,
        i: int,
        at: int,
        scope: Scope,
        type_name: str | None,
        name: str,
        parameters: list[Parameter],
        name_token: int,
    ) -> RoutineDeclaration:
        kinds = self.kinds
        kind = kinds[i]
        data: list[DataDeclaration] = []
        self.late_data = data
        while kinds[at] in DATA or kinds[at] is HOLDER:
            if kinds[at] is HOLDER:
                if self.texts[at].upper() != "<DDN>":
                    break
                at += 1
                continue
            try:
                declaration = self.data_declaration(at)
                data.append(declaration)
                at = declaration.last + 1
            except SyntaxFault as found:
                self.depth = 0
                self.fault(found)
                at = self.resume(at, found.at)
        body = self.statements(at)
        backward: Handler | None = None
        error: ErrorHandler | None = None
        undo: Handler | None = None
        seen: list[str] = []
        while self.open[-1][1] >= 0:
            at = self.after
            word = kinds[at]
            if word not in ("BACKWARD", "ERROR", "UNDO"):
                break
            self._handler_order(at, word, kind, seen)
            seen.append(word)
            if word == "ERROR":
                numbers, start = self._error_numbers(at + 1)
                statements = self.statements(start)
                error = error or ErrorHandler(at, self.after - 1, numbers, statements)
                continue
            statements = self.statements(at + 1)
            handler = Handler(at, self.after - 1, statements)
            if word == "UNDO":
                undo = undo or handler
            else:
                backward = backward or handler
        end = self.after
        if kinds[end] in ROUTINE_END_WORDS:
            if kinds[end] != CLOSER[kind]:
                self.fault(SyntaxFault(end, CLOSER[kind], f"{kind} ends with {CLOSER[kind]}"))
        else:
            self.unclosed(end, 1)
            end -= 1
        self.open.pop()
        return RoutineDeclaration(
            first, end, scope, cast(RoutineKind, kind), type_name, name, parameters, data,
            body, backward, error, undo, name_token,
        )  # fmt: skip

    def _handler_order(self, at: int, word: str, kind: str, seen: list[str]) -> None:
        order = ("BACKWARD", "ERROR", "UNDO")
        if word == "BACKWARD" and kind != "PROC":
            message = f"a {kind} has no BACKWARD handler"
        elif word in seen:
            message = f"a second {word} handler"
        elif seen and order.index(word) < max(order.index(s) for s in seen):
            message = f"the {word} handler stands behind {seen[-1]}"
        else:
            return
        self.report(
            faults.error(
                "RG216",
                message,
                faults.place(self.source, at),
                help="the order is BACKWARD (PROC only), ERROR, UNDO, at most one of each",
                notes=("handlers of a routine [K §5.3-5.5]",),
            )
        )

    def _whole(self, i: int) -> Expression:
        """The number or whole datum that token i is."""
        text = self.texts[i]
        if self.kinds[i] is NUMBER:
            return NumberLiteral(i, i, self.numbers[text], text)
        return Name(i, i, text)

    def _error_numbers(self, i: int) -> tuple[list[Expression] | None, int]:
        """The list behind ERROR, if any, and the index behind it [K §7.2]."""
        kinds = self.kinds
        if kinds[i] != "(":
            return None, i
        numbers: list[Expression] = []
        try:
            at = i
            while True:
                if kinds[at + 1] is not NUMBER and kinds[at + 1] is not NAME:
                    raise SyntaxFault(at + 1, "a number or the name of a datum")
                numbers.append(self._whole(at + 1))
                at += 2
                if kinds[at] == ")":
                    return numbers, at + 1
                if kinds[at] != ",":
                    raise SyntaxFault(at, "',' or ')'", "numbers and whole data only [K §7.2]")
        except SyntaxFault as found:
            self.depth = 0
            self.fault(found)
            return numbers, self.behind_header(found.at)

    def parameters(self, i: int) -> tuple[list[Parameter], int]:
        """Parameters up to ')', and the index behind it [K §5.1]."""
        kinds = self.kinds
        found: list[Parameter] = []
        if kinds[i] == ")":
            return found, i + 1
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
            found += alternatives
            i = found[-1].last + 1
            kind = kinds[i]
            if kind == ")":
                return found, i + 1
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
        type_name = self.identifier(i, "a parameter: mode, type and name")
        name = self.identifier(i + 1, "the name of the parameter")
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
