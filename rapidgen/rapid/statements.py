"""Statements and their recovery [K §4].

An error is caught by the innermost statement list: it is reported once, and the list goes on
behind the next `;` or at the next token that can only start or end a statement. A block that
lacks its end is closed where an outer one ends.
"""

from collections.abc import Callable
from typing import Final

from rapidgen.rapid import faults
from rapidgen.rapid.expressions import MAX_BLOCK_DEPTH, ExpressionParser
from rapidgen.rapid.faults import CLOSER, GivenUp, SyntaxFault
from rapidgen.rapid.lexer import EOF, HOLDER, KEYWORDS, NAME, UNTERMINATED, Tokens
from rapidgen.rapid.nodes import (
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

ROUTINE_END_WORDS: Final = frozenset(("ENDPROC", "ENDFUNC", "ENDTRAP"))
_ROUTINE_ENDS: Final = (
    frozenset(("ENDMODULE", "MODULE", "PROC", "FUNC", "TRAP", "LOCAL", "TASK", "RECORD", "ALIAS"))
    | ROUTINE_END_WORDS
    | {"BACKWARD", "ERROR", "UNDO", EOF}
)
ENDS: Final = {
    "MODULE": frozenset(("ENDMODULE", "MODULE", EOF)),
    "PROC": _ROUTINE_ENDS,
    "FUNC": _ROUTINE_ENDS,
    "TRAP": _ROUTINE_ENDS,
    "IF": frozenset(("ENDIF", "ELSE", "ELSEIF")),
    "FOR": frozenset(("ENDFOR",)),
    "WHILE": frozenset(("ENDWHILE",)),
    "TEST": frozenset(("ENDTEST", "CASE", "DEFAULT")),
}
"""What ends a statement list, by the block that it is in."""

_STARTERS: Final = frozenset(
    """IF FOR WHILE TEST GOTO RETURN RAISE RETRY TRYNEXT EXIT CONNECT VAR PERS CONST LOCAL TASK
    PROC FUNC TRAP RECORD ALIAS MODULE ENDMODULE ENDPROC ENDFUNC ENDTRAP ENDIF ENDFOR ENDWHILE
    ENDTEST ENDRECORD ELSE ELSEIF CASE DEFAULT ERROR UNDO BACKWARD""".split()  # noqa: SIM905  # reads better
) | {EOF}
"""Keywords at which a statement, a declaration or an end begins."""

_BEHIND_NAMES: Final = frozenset((";", ":=", "{", "(", ")", ",", "\\", "|", "FROM"))
_DIVIDERS: Final = {"ELSE": "ENDIF", "ELSEIF": "ENDIF", "CASE": "ENDTEST", "DEFAULT": "ENDTEST"}
_BLOCK_ENDS: Final = {"ENDIF": "IF", "ENDFOR": "FOR", "ENDWHILE": "WHILE", "ENDTEST": "TEST"}


class StatementParser(ExpressionParser):
    """Parses statement lists; `RoutineParser` gives it the data declarations."""

    late_data: list[DataDeclaration]
    """Data declared among statements of the present routine; kept, and reported."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__(tokens)
        self.late_data = []
        self.suspect = (-1, -1)
        """The last compact IF, and its statement: if on another line, a THEN may be missing."""
        self.forgiven: list[str] = []
        """Ends that belong to a block whose start was reported as missing."""
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

    def data_declaration(self, i: int) -> DataDeclaration:
        """The declaration that starts at VAR, PERS or CONST (or LOCAL, TASK)."""
        raise NotImplementedError

    # -- lists ---------------------------------------------------------------------------

    def statements(self, i: int) -> list[Statement]:
        """Statements up to what ends the innermost open block; its index is left in `after`."""
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
                    node = self._named_statement(i)
                elif kind in ends:
                    self.after = i
                    return body
                else:
                    handler = handlers.get(kind)
                    if handler is None:
                        here = self._misplaced(i, kind)
                        if here < 0:
                            self.after = i
                            return body
                        i = here
                        continue
                    node = handler(i)
                append(node)
                i = node.last + 1
            except SyntaxFault as found:
                self.depth = 0
                self.fault(found)
                i = self.resume(i, found.at, found.expected)

    def resume(self, start: int, at: int, expected: str = "") -> int:
        """Index from which to go on after an error at token `at` of what began at `start`."""
        kinds = self.kinds
        if kinds[at] is UNTERMINATED:
            return at + 1  # the quote took the rest of its line
        # A keyword in the midst of a line, where an operand should be, starts no statement.
        operand = expected == "an expression" and kinds[at] in _STARTERS
        if kinds[at] is not EOF and (at == start or (operand and not self._starts_line(at))):
            if kinds[at] == ";":
                return at + 1
            at += 1
        while True:
            kind = kinds[at]
            if kind == ";":
                return at + 1
            if kind in _STARTERS:
                return at
            if kind is NAME and self._starts_line(at):
                following = kinds[at + 1]
                if following == ":=" or following is NAME:
                    return at
            at += 1

    def _starts_line(self, at: int) -> bool:
        gap = self.source.gaps[at - 1] if at else self.source.lead
        return "\n" in gap or "\r" in gap

    def _misplaced(self, i: int, kind: str) -> int:
        """Deal with a token that starts no statement and does not end this list.

        The index from which to go on, or -1 when the list ends here all the same.
        """
        blocks = self.open
        if blocks[-1][1] < 0:
            return -1
        expected = f"a statement or {CLOSER[blocks[-1][0]]}"
        if kind in ("VAR", "PERS", "CONST"):
            declaration = self.data_declaration(i)
            self.late_data.append(declaration)
            self.report(
                faults.error(
                    "RG213",
                    f"the declaration of '{declaration.name}' stands behind a statement",
                    self.source.span(i, i),
                    label="data come first in a routine",
                    help="move it to the head of the routine",
                    notes=("data declarations come before the statements [K §5.3]",),
                )
            )
            return declaration.last + 1
        for outer in range(len(blocks) - 2, -1, -1):
            if kind in ENDS[blocks[outer][0]]:
                missing = len(blocks) - 1 - outer
                self.unclosed(i, missing)
                self._close(missing)
                return -1
        if kind in self.forgiven:
            self.forgiven.remove(kind)
            return self._behind(i)
        inner = blocks[-1][0]
        if kind in _BLOCK_ENDS:
            if inner in _BLOCK_ENDS.values() and self._ends_this(i, inner):
                self.fault(SyntaxFault(i, CLOSER[inner], f"{inner} ends with {CLOSER[inner]}"))
                return -1
            self._stray(i, expected)
            return self._behind(i)
        if kind in _DIVIDERS:
            self._stray(i, expected)
            self.forgiven.append(_DIVIDERS[kind])
            mark = {"CASE": ":", "DEFAULT": ":", "ELSEIF": "THEN"}.get(kind)
            if mark and self._reaches(i + 1, mark):
                return self.kinds.index(mark, i) + 1
            return i + 1
        help = "a statement has no ';' before it" if kind == ";" else ""
        self.fault(SyntaxFault(i, expected, help))
        return self.resume(i, i)

    def _stray(self, i: int, expected: str) -> None:
        suspect, statement = self.suspect
        self.suspect = (-1, -1)
        wrong_word = self.kinds[i] not in ("ELSE", "ELSEIF", "ENDIF")
        if suspect < 0 or wrong_word or not self._starts_line(statement):
            suspect = -1
        self.report(faults.stray(self.source, self.kinds, i, expected, self.open, suspect))

    def _behind(self, i: int) -> int:
        return i + 2 if self.kinds[i + 1] == ";" else i + 1

    def _close(self, missing: int) -> None:
        """Mark the `missing` innermost blocks as closed by the report just made."""
        for k in range(1, missing + 1):
            keyword, _ = self.open[-k]
            self.open[-k] = (keyword, -1)

    def _ends_this(self, i: int, inner: str) -> bool:
        """Whether a wrong END stands for the innermost block's own: does that come later?"""
        own = CLOSER[inner]
        opener = "THEN" if inner == "IF" else inner
        balance = 0
        for later in self.kinds[i + 1 :]:
            if later in _ROUTINE_ENDS:
                break
            if later == opener:
                balance += 1
            elif later == own or (opener == "THEN" and later == "ELSEIF"):
                balance -= 1
                if balance < 0:
                    return False
        return True

    def enter(self, keyword: str, i: int) -> None:
        """Open a block."""
        if len(self.open) >= MAX_BLOCK_DEPTH + 2:  # module and routine come on top
            raise GivenUp(
                faults.error(
                    "RG210",
                    f"blocks are nested more than {MAX_BLOCK_DEPTH} deep",
                    faults.place(self.source, i),
                    help="move inner blocks into a procedure of their own",
                )
            )
        self.open.append((keyword, i))

    def leave(self) -> int:
        """Close the innermost block at `after`; the index of its last token."""
        keyword, at = self.open.pop()
        end = self.after
        kind = self.kinds[end]
        if kind == CLOSER[keyword]:
            return end
        if at < 0:
            return end - 1
        if kind in _BLOCK_ENDS and keyword in _BLOCK_ENDS.values():
            return end  # reported as standing for this block's own end
        return end - 1

    def _header(self, i: int, found: SyntaxFault, wanted: str) -> int:
        """Report an error in a block's header; the index behind it, or -1 if it has no end."""
        self.depth = 0
        self.fault(found)
        kinds, at = self.kinds, found.at
        while True:
            kind = kinds[at]
            if kind == wanted:
                return at + 1
            if kind == ";" or (kind in _STARTERS and at > i):
                return found.at if wanted in found.expected else -1
            at += 1

    # -- simple statements ---------------------------------------------------------------

    def _semicolon(self, i: int, expected: str = "';'") -> int:
        if self.kinds[i] != ";":
            raise SyntaxFault(i, expected)
        return i

    def _named_statement(self, i: int) -> Statement:
        kinds = self.kinds
        following = kinds[i + 1]
        if following == ":=" or following == "{" or following == ".":
            target = self.reference(i)
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
        arguments = self.arguments(i + 1, ";")
        return ProcedureCall(i, self.after, self.texts[i], arguments)

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
            arguments: list[Argument] = self.arguments(i + 1, ";")
            return ProcedureCall(i, self.after, text, arguments)
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
        arguments = self.arguments(at + 1, ";")
        return LateCall(i, self.after, procedure, arguments)

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

    def identifier(self, i: int, expected: str) -> str:
        """The name at token i, or the placeholder <ID>."""
        if self.kinds[i] is NAME:
            return self.texts[i]
        if self.kinds[i] is HOLDER and self.texts[i].upper() == "<ID>":
            return "<ID>"
        if self.kinds[i] in KEYWORDS and self.kinds[i + 1] in _BEHIND_NAMES:
            # Taken as the name that it was meant for, so that nothing follows from it.
            self.fault(SyntaxFault(i, expected, f"{self.kinds[i]} is a reserved word"))
            return self.texts[i]
        raise SyntaxFault(i, expected)

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
            target = self.reference(i + 1)
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
                if not self._reaches(at, "THEN"):
                    raise
            at = self._header(i, missing, "THEN") - 1
        self.enter("IF", i)
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
            except SyntaxFault as found:
                condition = Placeholder(end, end, "<EXP>")
                behind = self._header(end, found, "THEN")
                at = (behind if behind >= 0 else self.resume(end, found.at)) - 1
        if kind == "ELSE":
            otherwise = self.statements(end + 1)
            while self.kinds[self.after] in ("ELSE", "ELSEIF") and self.open[-1][1] >= 0:
                self.fault(SyntaxFault(self.after, "ENDIF", "ELSE is the last branch of an IF"))
                otherwise += self.statements(self._behind_branch(self.after))
        return If(i, self.leave(), branches, otherwise)

    def _behind_branch(self, i: int) -> int:
        """Index behind a wrong ELSE or ELSEIF ... THEN."""
        if self.kinds[i] == "ELSE" or not self._reaches(i + 1, "THEN"):
            return i + 1
        return self.kinds.index("THEN", i) + 1

    def _condition(self, i: int, wanted: str) -> tuple[Expression, int]:
        """Condition behind IF or WHILE, and the index of the token behind it."""
        try:
            condition = self.expression(i + 1)
            return condition, condition.last + 1
        except SyntaxFault as found:
            behind = self._header(i, found, wanted)
            if behind < 0:
                raise
            return Placeholder(i, i, "<EXP>"), behind - 1

    def _compact_if(self, i: int, condition: Expression, at: int) -> CompactIf:
        kind = self.kinds[at]
        handler = self.handlers.get(kind)
        if handler is None or kind in ("IF", "FOR", "WHILE", "TEST"):
            raise SyntaxFault(at, "THEN, an operator or a simple statement")
        self.suspect = (i, at)
        statement = handler(at)
        if isinstance(statement, Label):
            raise SyntaxFault(at, "THEN, an operator or a simple statement")
        return CompactIf(i, statement.last, condition, statement)

    def _reaches(self, at: int, wanted: str) -> bool:
        """Whether `wanted` comes before the statement at token `at` can end."""
        kinds = self.kinds
        while kinds[at] != wanted:
            if kinds[at] == ";" or kinds[at] in _STARTERS:
                return False
            at += 1
        return True

    def _while(self, i: int) -> While:
        condition, at = self._condition(i, "DO")
        at = self._keyword(i, at, "DO")
        self.enter("WHILE", i)
        body = self.statements(at)
        return While(i, self.leave(), condition, body)

    def _keyword(self, i: int, at: int, wanted: str) -> int:
        """Index behind DO; a missing one is reported and taken as if it were there."""
        if self.kinds[at] == wanted:
            return at + 1
        behind = self._header(i, SyntaxFault(at, f"{wanted} or an operator"), wanted)
        return behind if behind >= 0 else at

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
        except SyntaxFault as found:
            at = self._header(i, found, "DO")
            if at < 0:
                at = self.resume(i, found.at)
        self.enter("FOR", i)
        body = self.statements(at)
        return For(i, self.leave(), variable, start, end, step, body)

    def _test(self, i: int) -> Test:
        kinds = self.kinds
        subject: Expression
        told = -1
        try:
            subject = self.expression(i + 1)
            at = subject.last + 1
            if kinds[at] not in ("CASE", "DEFAULT", "ENDTEST") and kinds[at] is not HOLDER:
                raise SyntaxFault(at, "CASE, DEFAULT, ENDTEST or an operator")
        except SyntaxFault as found:
            self.depth = 0
            self.fault(found)
            subject = Placeholder(i, i, "<EXP>")
            told = at = found.at if self._starts_line(found.at) else self.resume(i, found.at)
        self.enter("TEST", i)
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
                behind = at + 1
                if kinds[behind] == ":":
                    behind += 1
                else:
                    self.fault(SyntaxFault(behind, "':'"))
                default = self.statements(behind)
            elif kind is HOLDER and self.texts[at].upper() == "<CSE>":
                cases.append(Case(at, at, [Placeholder(at, at, "<CSE>")], []))
                self.after = at + 1
            elif kind == "ENDTEST" or kind in _BLOCK_ENDS:
                break
            else:
                if at != told:
                    self.fault(SyntaxFault(at, "CASE, DEFAULT or ENDTEST"))
                self.statements(at + 1 if kind is HOLDER else at)
                if self.after == at:
                    break
        return Test(i, self.leave(), subject, cases, default)

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
        except SyntaxFault as found:
            self.depth = 0
            self.fault(found)
            at = found.at
            while kinds[at] != ":" and kinds[at] != ";" and kinds[at] not in _STARTERS:
                at += 1
            at = at + 1 if kinds[at] == ":" else found.at
            values = values or [Placeholder(i, i, "<EXP>")]
        body = self.statements(at)
        return Case(i, self.after - 1, values, body)
