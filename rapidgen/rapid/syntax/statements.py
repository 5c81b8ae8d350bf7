"""Statements, simple and compound [K §4]."""

from collections.abc import Callable

from rapidgen.diagnostics import error
from rapidgen.rapid.syntax.blocks import BLOCK_ENDS, ENDS, STARTERS, Blocks
from rapidgen.rapid.syntax.data import DATA, DataParser
from rapidgen.rapid.syntax.errors import SyntaxFault
from rapidgen.rapid.syntax.expressions import ExpressionParser
from rapidgen.rapid.syntax.lexer import HOLDER, NAME
from rapidgen.rapid.syntax.nodes import (
    Argument,
    Assignment,
    Branch,
    Case,
    CompactIf,
    Connect,
    DataDeclaration,
    Exit,
    Expression,
    For,
    Goto,
    If,
    Label,
    LateCall,
    Name,
    Placeholder,
    PlaceholderStatement,
    ProcedureCall,
    Raise,
    Retry,
    Return,
    Statement,
    Test,
    TryNext,
    While,
)


class StatementParser:
    """Parser of statement lists."""

    def __init__(self, expressions: ExpressionParser, blocks: Blocks, data: DataParser) -> None:
        self.expressions = expressions
        self.blocks = blocks
        self.data = data
        self.kinds = expressions.kinds
        self.texts = expressions.texts
        self.open = expressions.open
        self.fault = expressions.fault
        self.expression = expressions.expression
        self.identifier = expressions.identifier
        self.after = 0
        """Index of what ended the last list."""
        self.late_data: list[DataDeclaration] = []
        """Data declared among statements of the present routine: accepted and reported."""
        self.nested = -1
        """A block statement in the place of the statement of a compact IF."""
        self.handlers: dict[str, Callable[[int], Statement]] = {
            NAME: self._named_statement,
            HOLDER: self._placeholder,
            "IF": self._if,
            "FOR": self._for,
            "WHILE": self._while,
            "TEST": self._test,
            "RETURN": self._return,
            "RAISE": self._raise,
            "GOTO": self._goto,
            "EXIT": self._exit,
            "RETRY": self._retry,
            "TRYNEXT": self._trynext,
            "CONNECT": self._connect,
            "%": self._late_call,
        }
        """Parsers of statements, by the kind of the first token."""

    # -- lists ---------------------------------------------------------------------------

    def statements(self, i: int) -> list[Statement]:
        """Parse statements up to the end of the innermost open block.

        The index of the end goes to `after`.
        """
        kinds, texts, handlers = self.kinds, self.texts, self.handlers
        ends = ENDS[self.open[-1][0]]
        body: list[Statement] = []
        append = body.append
        node: Statement
        while True:
            kind = kinds[i]
            try:
                if kind is NAME:
                    following = kinds[i + 1]
                    if following == ":=":
                        value = self.expression(i + 2)
                        end = value.last + 1
                        if kinds[end] != ";":
                            raise SyntaxFault(end, "';' or an operator")
                        append(Assignment(i, end, Name(i, i, texts[i]), value))
                        i = end + 1
                        continue
                    if following == ";":
                        append(ProcedureCall(i, i + 1, texts[i], []))
                        i += 2
                        continue
                    node = handlers[NAME](i)
                elif kind in ends:
                    self.after = i
                    return body
                else:
                    handler = handlers.get(kind)
                    if handler is None:
                        late = kind in DATA and self.open[-1][1] >= 0
                        current = self._late_datum(i) if late else self.blocks.misplaced(i, kind)
                        if current < 0:
                            self.after = i
                            return body
                        i = current
                        continue
                    node = handler(i)
                append(node)
                i = node.last + 1
            except SyntaxFault as result:
                self.fault(result)
                i = self.blocks.resume(i, result.at, result.expected)

    def _late_datum(self, i: int) -> int:
        """Accept data among statements to avoid follow-up errors.

        Returns the index after them.
        """
        declaration = self.data.data_declaration(i)
        self.late_data.append(declaration)
        source = self.expressions.source
        self.expressions.report(
            error(
                "RG213",
                source.span(i, i),
                f"the declaration of '{declaration.name}' follows a statement",
                "move it to the head of the routine",
                label="data come first in a routine",
                notes=("data declarations come before the statements [K §5.3]",),
            )
        )
        return declaration.last + 1

    # -- simple statements ---------------------------------------------------------------

    def _semicolon(self, i: int, expected: str = "';'") -> int:
        if self.kinds[i] != ";":
            raise SyntaxFault(i, expected)
        return i

    def _named_statement(self, i: int) -> Statement:
        kinds = self.kinds
        following = kinds[i + 1]
        # `=` as in other languages, too: no argument begins with it.
        if following in (":=", "{", ".", "="):
            target = self.expressions.reference(i)
            at = target.last + 1
            if kinds[at] != ":=":
                raise SyntaxFault(at, "':='")
            value = self.expression(at + 1)
            end = self._semicolon(value.last + 1, "';' or an operator")
            return Assignment(i, end, target, value)
        if following == ":":
            return Label(i, i + 1, self.texts[i])
        if following == "(" and kinds[i + 2] == ")":
            raise SyntaxFault(
                i + 2, "an argument", "a procedure is called without parentheses: Name a, b;"
            )
        arguments = self.expressions.arguments(i + 1, ";")
        return ProcedureCall(i, self.expressions.after, self.texts[i], arguments)

    def _placeholder(self, i: int) -> Statement:
        text = self.texts[i].upper()
        kinds = self.kinds
        if kinds[i + 1] == ":=" and text == "<VAR>":
            value = self.expression(i + 2)
            end = self._semicolon(value.last + 1, "';' or an operator")
            return Assignment(i, end, Placeholder(i, i, text), value)
        inner = self.open[-1][0]
        if text == "<ID>":
            if kinds[i + 1] == ":":
                return Label(i, i + 1, text)
            arguments: list[Argument] = self.expressions.arguments(i + 1, ";")
            return ProcedureCall(i, self.expressions.after, text, arguments)
        fits = {"<SMT>": True, "<EIT>": inner == "IF", "<CSE>": inner == "TEST"}
        if not fits.get(text, False):
            raise SyntaxFault(i, "a statement or <SMT>")
        end = i + 1 if kinds[i + 1] == ";" else i
        return PlaceholderStatement(i, end, text)

    def _late_call(self, i: int) -> LateCall:
        procedure = self.expression(i + 1)
        at = procedure.last + 1
        if self.kinds[at] != "%":
            raise SyntaxFault(at, "'%' or an operator")
        arguments = self.expressions.arguments(at + 1, ";")
        return LateCall(i, self.expressions.after, procedure, arguments)

    def _return(self, i: int) -> Return:
        if self.kinds[i + 1] == ";":
            return Return(i, i + 1, None)
        value = self.expression(i + 1)
        return Return(i, self._semicolon(value.last + 1, "';' or an operator"), value)

    def _raise(self, i: int) -> Raise:
        if self.kinds[i + 1] == ";":
            return Raise(i, i + 1, None)
        number = self.expression(i + 1)
        return Raise(i, self._semicolon(number.last + 1, "';' or an operator"), number)

    def _goto(self, i: int) -> Goto:
        name = self.identifier(i + 1, "a label")
        return Goto(i, self._semicolon(i + 2), name)

    def _exit(self, i: int) -> Exit:
        return Exit(i, self._semicolon(i + 1))

    def _retry(self, i: int) -> Retry:
        return Retry(i, self._semicolon(i + 1))

    def _trynext(self, i: int) -> TryNext:
        return TryNext(i, self._semicolon(i + 1))

    def _connect(self, i: int) -> Connect:
        kinds = self.kinds
        target: Expression
        if kinds[i + 1] is HOLDER and self.texts[i + 1].upper() == "<VAR>":
            target = Placeholder(i + 1, i + 1, "<VAR>")
        elif kinds[i + 1] is NAME:
            target = self.expressions.reference(i + 1)
        else:
            raise SyntaxFault(i + 1, "an interrupt variable")
        at = target.last + 1
        if kinds[at] != "WITH":
            raise SyntaxFault(at, "WITH")
        trap = self.identifier(at + 1, "the name of a trap")
        return Connect(i, self._semicolon(at + 2), target, trap)

    # -- compound statements -------------------------------------------------------------

    def _if(self, i: int) -> Statement:
        condition, at = self._condition(i, "THEN")
        if self.kinds[at] != "THEN":
            try:
                return self._compact_if(i, condition, at)
            except SyntaxFault:
                missing = SyntaxFault(at, "THEN, an operator or a simple statement")
                if not self.blocks.reaches(at, "THEN"):
                    raise
            at = self.blocks.header(i, missing, "THEN") - 1
        self.blocks.enter("IF", i)
        branches: list[Branch] = []
        otherwise: list[Statement] | None = None
        first = i
        while True:
            body = self.statements(at + 1)
            end = self.after
            branches.append(Branch(first, end - 1, condition, body))
            kind = self.kinds[end] if self.open[-1][1] >= 0 else ""
            if kind != "ELSEIF":
                break
            first = end
            try:
                condition = self.expression(end + 1)
                at = condition.last + 1
                if self.kinds[at] != "THEN":
                    raise SyntaxFault(at, "THEN or an operator")
            except SyntaxFault as result:
                condition = Placeholder(end, end, "<EXP>")
                after = self.blocks.header(end, result, "THEN")
                at = (after if after >= 0 else self.blocks.resume(end, result.at)) - 1
        if kind == "ELSE":
            otherwise = self.statements(end + 1)
            while self.kinds[self.after] in ("ELSE", "ELSEIF") and self.open[-1][1] >= 0:
                self.fault(SyntaxFault(self.after, "ENDIF", "ELSE is the last branch of an IF"))
                otherwise += self.statements(self._after_branch(self.after))
        return If(i, self.blocks.leave(self.after), branches, otherwise)

    def _after_branch(self, i: int) -> int:
        """Return the index after a wrong ELSE or ELSEIF ... THEN."""
        if self.kinds[i] == "ELSE" or not self.blocks.reaches(i + 1, "THEN"):
            return i + 1
        return self.kinds.index("THEN", i) + 1

    def _condition(self, i: int, expected: str) -> tuple[Expression, int]:
        """Parse a condition after IF or WHILE; return the index after it."""
        try:
            condition = self.expression(i + 1)
            return condition, condition.last + 1
        except SyntaxFault as result:
            after = self.blocks.header(i, result, expected)
            if after < 0:
                raise
            return Placeholder(i, i, "<EXP>"), after - 1

    def _compact_if(self, i: int, condition: Expression, at: int) -> CompactIf:
        kind = self.kinds[at]
        handler = self.handlers.get(kind)
        if handler is None or kind in ("IF", "FOR", "WHILE", "TEST"):
            fault = SyntaxFault(at, "THEN, an operator or a simple statement")
            # Of IF a IF b IF c ... the first is enough.
            fault.reported = i == self.nested
            self.nested = at
            raise fault
        self.blocks.suspect = (i, at)
        statement = handler(at)
        if isinstance(statement, Label):
            raise SyntaxFault(at, "THEN, an operator or a simple statement")
        return CompactIf(i, statement.last, condition, statement)

    def _while(self, i: int) -> While:
        condition, at = self._condition(i, "DO")
        at = self._keyword(i, at, "DO")
        self.blocks.enter("WHILE", i)
        body = self.statements(at)
        return While(i, self.blocks.leave(self.after), condition, body)

    def _keyword(self, i: int, at: int, expected: str) -> int:
        """Return the index after DO; report and assume a missing one."""
        if self.kinds[at] == expected:
            return at + 1
        after = self.blocks.header(i, SyntaxFault(at, f"{expected} or an operator"), expected)
        return after if after >= 0 else at

    def _for(self, i: int) -> For:
        kinds = self.kinds
        variable = "<ID>"
        holder = Placeholder(i, i, "<EXP>")
        start: Expression = holder
        end: Expression = holder
        step: Expression | None = None
        try:
            variable = self.identifier(i + 1, "a loop variable")
            if kinds[i + 2] != "FROM":
                raise SyntaxFault(i + 2, "FROM")
            start = self.expression(i + 3)
            at = start.last + 1
            if kinds[at] != "TO":
                raise SyntaxFault(at, "TO or an operator")
            end = self.expression(at + 1)
            at = end.last + 1
            if kinds[at] == "STEP":
                step = self.expression(at + 1)
                at = step.last + 1
            if kinds[at] != "DO":
                raise SyntaxFault(at, "DO or an operator" if step else "DO, STEP or an operator")
            at += 1
        except SyntaxFault as result:
            at = self.blocks.header(i, result, "DO")
            if at < 0:
                at = self.blocks.resume(i, result.at)
        self.blocks.enter("FOR", i)
        body = self.statements(at)
        return For(i, self.blocks.leave(self.after), variable, start, end, step, body)

    def _test(self, i: int) -> Test:
        kinds = self.kinds
        subject: Expression
        text = -1
        try:
            subject = self.expression(i + 1)
            at = subject.last + 1
            if kinds[at] not in ("CASE", "DEFAULT", "ENDTEST") and kinds[at] is not HOLDER:
                raise SyntaxFault(at, "CASE, DEFAULT, ENDTEST or an operator")
        except SyntaxFault as result:
            self.fault(result)
            subject = Placeholder(i, i, "<EXP>")
            text = at = (
                result.at
                if self.expressions.starts_line(result.at)
                else self.blocks.resume(i, result.at)
            )
        self.blocks.enter("TEST", i)
        cases: list[Case] = []
        default: list[Statement] | None = None
        self.after = at
        while self.open[-1][1] >= 0:
            at = self.after
            kind = kinds[at]
            if kind == "CASE":
                if default is not None:
                    self.fault(SyntaxFault(at, "ENDTEST", "DEFAULT is the last branch of a TEST"))
                cases.append(self._case(at))
            elif kind == "DEFAULT":
                if default is not None:
                    self.fault(SyntaxFault(at, "ENDTEST", "a TEST has one DEFAULT"))
                after = at + 1
                if kinds[after] == ":":
                    after += 1
                else:
                    self.fault(SyntaxFault(after, "':'"))
                default = self.statements(after)
            elif kind is HOLDER and self.texts[at].upper() == "<CSE>":
                cases.append(Case(at, at, [Placeholder(at, at, "<CSE>")], []))
                self.after = at + 1
            elif kind == "ENDTEST" or kind in BLOCK_ENDS:
                break
            else:
                if at != text:
                    self.fault(SyntaxFault(at, "CASE, DEFAULT or ENDTEST"))
                self.statements(at + 1 if kind is HOLDER else at)
                if self.after == at:
                    break
        return Test(i, self.blocks.leave(self.after), subject, cases, default)

    def _case(self, i: int) -> Case:
        kinds = self.kinds
        values: list[Expression] = []
        try:
            at = i
            while True:
                value = self.expression(at + 1)
                values.append(value)
                at = value.last + 1
                if kinds[at] != ",":
                    break
            if kinds[at] != ":":
                raise SyntaxFault(at, "':', ',' or an operator")
            at += 1
        except SyntaxFault as result:
            self.fault(result)
            at = result.at
            while kinds[at] != ":" and kinds[at] != ";" and kinds[at] not in STARTERS:
                at += 1
            at = at + 1 if kinds[at] == ":" else result.at
            values = values or [Placeholder(i, i, "<EXP>")]
        body = self.statements(at)
        return Case(i, self.after - 1, values, body)
