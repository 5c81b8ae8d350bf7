"""Routines [K §5.2-5.5]."""

from typing import Final, cast

from rapidgen.diagnostics import error
from rapidgen.rapid.syntax import errors
from rapidgen.rapid.syntax.blocks import ROUTINE_END_WORDS, Blocks
from rapidgen.rapid.syntax.data import DATA, MODULE_STOPS, DataParser
from rapidgen.rapid.syntax.errors import CLOSER, SyntaxFault
from rapidgen.rapid.syntax.expressions import ExpressionParser
from rapidgen.rapid.syntax.lexer import HOLDER, NAME, NUMBER
from rapidgen.rapid.syntax.nodes import (
    DataDeclaration,
    ErrorHandler,
    Expression,
    Handler,
    Name,
    NumberLiteral,
    Parameter,
    RoutineDeclaration,
    RoutineKind,
    Scope,
)
from rapidgen.rapid.syntax.statements import StatementParser

ROUTINES: Final = ("PROC", "FUNC", "TRAP")


class RoutineParser:
    """Parser of routines."""

    def __init__(self, expressions: ExpressionParser, blocks: Blocks, data: DataParser) -> None:
        self.expressions = expressions
        self.blocks = blocks
        self.data = data
        self.list = StatementParser(expressions, blocks, data)
        self.kinds = expressions.kinds
        self.texts = expressions.texts
        self.open = expressions.open

    def routine(self, first: int, i: int, scope: Scope) -> RoutineDeclaration:
        """Parse PROC, FUNC or TRAP with its keyword at i [K §5.3-5.5]."""
        kinds = self.kinds
        kind = kinds[i]
        self.blocks.start(kind, i)
        type_name: str | None = None
        name, name_token = "", i
        parameters: list[Parameter] = []
        try:
            at = i + 1
            if kind == "FUNC":
                type_name = self.expressions.identifier(at, "the type of the function")
                at += 1
            name_token = at
            name = self.expressions.identifier(at, "the name of the routine")
            at += 1
            if kind != "TRAP":
                if kinds[at] != "(":
                    raise SyntaxFault(at, "'('", "the parentheses are there even when empty")
                parameters, at = self.data.parameters(at + 1)
            elif kinds[at] == "(":
                raise SyntaxFault(at, "the body of the trap", "a TRAP has no parameters")
        except SyntaxFault as result:
            self.expressions.fault(result)
            at = self.after_header(result.at)
        return self._routine_body(first, i, at, scope, type_name, name, parameters, name_token)

    def after_header(self, at: int) -> int:
        """Return the index after a header with an error at token `at`."""
        kinds, starts_line = self.kinds, self.expressions.starts_line
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
                or (depth <= 0 and starts_line(at) and kind not in (",", "\\", "|"))
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
        self.list.late_data = data
        while kinds[at] in DATA or kinds[at] is HOLDER:
            if kinds[at] is HOLDER:
                if self.texts[at].upper() != "<DDN>":
                    break
                at += 1
                continue
            try:
                declaration = self.data.data_declaration(at)
                data.append(declaration)
                at = declaration.last + 1
            except SyntaxFault as result:
                self.expressions.fault(result)
                at = self.blocks.resume(at, result.at)
        body = self.list.statements(at)
        backward: Handler | None = None
        error: ErrorHandler | None = None
        undo: Handler | None = None
        seen: list[str] = []
        while self.open[-1][1] >= 0:
            at = self.list.after
            keyword = kinds[at]
            if keyword not in ("BACKWARD", "ERROR", "UNDO"):
                break
            self._handler_order(at, keyword, kind, seen)
            seen.append(keyword)
            if keyword == "ERROR":
                numbers, start = self._error_numbers(at + 1)
                statements = self.list.statements(start)
                error = error or ErrorHandler(at, self.list.after - 1, numbers, statements)
                continue
            statements = self.list.statements(at + 1)
            handler = Handler(at, self.list.after - 1, statements)
            if keyword == "UNDO":
                undo = undo or handler
            else:
                backward = backward or handler
        end = self.list.after
        if kinds[end] in ROUTINE_END_WORDS:
            if kinds[end] != CLOSER[kind]:
                expected = CLOSER[kind]
                self.expressions.fault(SyntaxFault(end, expected, f"{kind} ends with {expected}"))
        else:
            self.expressions.unclosed(end, 1)
            end -= 1
        self.open.pop()
        return RoutineDeclaration(
            first, end, scope, cast(RoutineKind, kind), type_name, name, parameters, data,
            body, backward, error, undo, name_token,
        )  # fmt: skip

    def _handler_order(self, at: int, keyword: str, kind: str, seen: list[str]) -> None:
        order = ("BACKWARD", "ERROR", "UNDO")
        if keyword == "BACKWARD" and kind != "PROC":
            message = f"a {kind} has no BACKWARD handler"
        elif keyword in seen:
            message = f"a second {keyword} handler"
        elif seen and order.index(keyword) < max(order.index(s) for s in seen):
            message = f"the {keyword} handler follows {seen[-1]}"
        else:
            return
        self.expressions.report(
            error(
                "RG216",
                errors.place(self.expressions.source, at),
                message,
                "the order is BACKWARD (PROC only), ERROR, UNDO, at most one of each",
                notes=("handlers of a routine [K §5.3-5.5]",),
            )
        )

    def _whole(self, i: int) -> Expression:
        """Parse the number or whole datum at token i."""
        text = self.texts[i]
        if self.kinds[i] is NUMBER:
            return NumberLiteral(i, i, self.expressions.numbers[text], text)
        return Name(i, i, text)

    def _error_numbers(self, i: int) -> tuple[list[Expression] | None, int]:
        """Parse the list after ERROR; return the index after it [K §7.2]."""
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
        except SyntaxFault as result:
            self.expressions.fault(result)
            return numbers, self.after_header(result.at)
