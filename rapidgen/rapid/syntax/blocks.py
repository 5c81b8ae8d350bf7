"""Blocks of statements, and recovery from errors in them [K §4.2].

The innermost statement list reports an error once. It continues after the next `;`, or at the next
token that can only start or end a statement. A block without its end is closed where an outer one
ends.
"""

from typing import Final

from rapidgen.diagnostics import error
from rapidgen.rapid.syntax import errors
from rapidgen.rapid.syntax.errors import CLOSER, ParseAborted, SyntaxFault
from rapidgen.rapid.syntax.expressions import MAX_BLOCK_DEPTH, ExpressionParser
from rapidgen.rapid.syntax.lexer import EOF, NAME, UNTERMINATED

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
"""Tokens that end a statement list, by its block."""

STARTERS: Final = frozenset(
    """IF FOR WHILE TEST GOTO RETURN RAISE RETRY TRYNEXT EXIT CONNECT VAR PERS CONST LOCAL TASK
    PROC FUNC TRAP RECORD ALIAS MODULE ENDMODULE ENDPROC ENDFUNC ENDTRAP ENDIF ENDFOR ENDWHILE
    ENDTEST ENDRECORD ELSE ELSEIF CASE DEFAULT ERROR UNDO BACKWARD""".split()  # noqa: SIM905  # reads better
) | {EOF}
"""Keywords at which a statement, a declaration or an end begins."""

_DIVIDERS: Final = {"ELSE": "ENDIF", "ELSEIF": "ENDIF", "CASE": "ENDTEST", "DEFAULT": "ENDTEST"}
BLOCK_ENDS: Final = {"ENDIF": "IF", "ENDFOR": "FOR", "ENDWHILE": "WHILE", "ENDTEST": "TEST"}


class Blocks:
    """Open blocks, and recovery from errors."""

    def __init__(self, expressions: ExpressionParser) -> None:
        self.expressions = expressions
        self.kinds = expressions.kinds
        self.open = expressions.open
        self.suspect = (-1, -1)
        """The last compact IF, and its statement: if on another line, a THEN may be missing."""
        self.forgiven: list[str] = []
        """Ends of blocks whose start was reported as missing."""

    def start(self, keyword: str, i: int) -> None:
        """Open a routine and forget earlier suspicions."""
        self.open.append((keyword, i))
        self.forgiven.clear()
        self.suspect = (-1, -1)

    def resume(self, start: int, at: int, expected: str = "") -> int:
        """Return the index to continue from after an error at token `at`.

        `start` is the first token of the construct.
        """
        kinds = self.kinds
        if kinds[at] is UNTERMINATED:
            return at + 1  # the quote took the rest of its line
        # A keyword in the midst of a line, where an operand should be, starts no statement.
        operand = expected == "an expression" and kinds[at] in STARTERS
        if kinds[at] is not EOF and (
            at == start or (operand and not self.expressions.starts_line(at))
        ):
            if kinds[at] == ";":
                return at + 1
            at += 1
        while True:
            kind = kinds[at]
            if kind == ";":
                return at + 1
            if kind in STARTERS:
                # An error that takes the rest of the text takes its ends with it.
                self.expressions.end_reported |= kind is EOF
                return at
            if kind is NAME and self.expressions.starts_line(at):
                following = kinds[at + 1]
                if following == ":=" or following is NAME:
                    return at
            at += 1

    def misplaced(self, i: int, kind: str) -> int:
        """Handle a token that neither starts a statement nor ends this list.

        Returns the index to continue from, or -1 if the list ends here.
        """
        blocks = self.open
        if blocks[-1][1] < 0:
            return -1
        expected = f"a statement or {CLOSER[blocks[-1][0]]}"
        for outer in range(len(blocks) - 2, -1, -1):
            if kind in ENDS[blocks[outer][0]]:
                missing = len(blocks) - 1 - outer
                self.expressions.unclosed(i, missing)
                self._close(missing)
                return -1
        if kind in self.forgiven:
            self.forgiven.remove(kind)
            return self._index_after(i)
        inner = blocks[-1][0]
        if kind in BLOCK_ENDS:
            if inner in BLOCK_ENDS.values() and self._ends_this(i, inner):
                self.expressions.fault(
                    SyntaxFault(i, CLOSER[inner], f"{inner} ends with {CLOSER[inner]}")
                )
                return -1
            self._stray(i, expected)
            return self._index_after(i)
        if kind in _DIVIDERS:
            self._stray(i, expected)
            self.forgiven.append(_DIVIDERS[kind])
            marker = {"CASE": ":", "DEFAULT": ":", "ELSEIF": "THEN"}.get(kind)
            if marker and self.reaches(i + 1, marker):
                return self.kinds.index(marker, i) + 1
            return i + 1
        help = "a statement has no ';' before it" if kind == ";" else ""
        self.expressions.fault(SyntaxFault(i, expected, help))
        return self.resume(i, i)

    def _stray(self, i: int, expected: str) -> None:
        suspect, statement = self.suspect
        self.suspect = (-1, -1)
        wrong_word = self.kinds[i] not in ("ELSE", "ELSEIF", "ENDIF")
        if suspect < 0 or wrong_word or not self.expressions.starts_line(statement):
            suspect = -1
        self.expressions.report(
            errors.unmatched(self.expressions.source, self.kinds, i, expected, self.open, suspect)
        )

    def _index_after(self, i: int) -> int:
        return i + 2 if self.kinds[i + 1] == ";" else i + 1

    def _close(self, missing: int) -> None:
        """Mark the `missing` innermost blocks as closed by the last report."""
        for k in range(1, missing + 1):
            keyword, _ = self.open[-k]
            self.open[-k] = (keyword, -1)

    def _ends_this(self, i: int, inner: str) -> bool:
        """Return True if a wrong END belongs to the innermost block.

        That is the case if the block's own END does not follow.
        """
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

    def reaches(self, at: int, expected: str) -> bool:
        """Return True if `expected` follows before the end of the statement."""
        kinds = self.kinds
        while kinds[at] != expected:
            if kinds[at] == ";" or kinds[at] in STARTERS:
                return False
            at += 1
        return True

    def enter(self, keyword: str, i: int) -> None:
        """Open a block."""
        if len(self.open) >= MAX_BLOCK_DEPTH + 2:  # module and routine come on top
            raise ParseAborted(
                error(
                    "RG210",
                    errors.place(self.expressions.source, i),
                    f"blocks are nested more than {MAX_BLOCK_DEPTH} deep",
                    "move inner blocks into a procedure of their own",
                )
            )
        self.open.append((keyword, i))

    def leave(self, end: int) -> int:
        """Close the innermost block and return its last token.

        Its list ended at token `end`.
        """
        keyword, at = self.open.pop()
        kind = self.kinds[end]
        if kind == CLOSER[keyword]:
            return end
        if at < 0:
            return end - 1
        if kind in BLOCK_ENDS and keyword in BLOCK_ENDS.values():
            return end  # reported as the end of this block
        return end - 1

    def header(self, i: int, result: SyntaxFault, wanted: str) -> int:
        """Report an error in a block's header.

        Returns the index after the header, or -1 without an end.
        """
        self.expressions.fault(result)
        kinds, at = self.kinds, result.at
        while True:
            kind = kinds[at]
            if kind == wanted:
                return at + 1
            if kind == ";" or (kind in STARTERS and at > i):
                return result.at if wanted in result.expected else -1
            at += 1
