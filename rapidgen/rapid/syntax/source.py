"""Text of a module and its tokens."""

import re
import sys
from bisect import bisect_right
from dataclasses import dataclass, field
from itertools import accumulate, chain, islice
from typing import Final

from rapidgen.diagnostics import Span

# -- Regular expressions ---------------------------------------------------------------------------
#
# Regular expressions for tokens of RAPID text [K §2.1-2.10].
#
# `TOKENS.findall` returns all tokens and nothing else, which suffices for a parse. `TILES` returns
# each token with the blanks and comments after it, so that the pieces tile the text. Both use the
# same token and the same blanks.


_PLACEHOLDERS: Final = "TDN|DDN|RDN|PAR|ALT|DIM|SMT|VAR|EIT|CSE|EXP|ARG|ID"
# K requires a blank between a number and a word [K §2.2], but programs of cells omit it before
# these words: `IF status = 1THEN`, in programs of three authors.
_GOING_ON: Final = r"(?i:THEN|DO|TO|STEP|AND|OR|XOR|MOD|DIV)\b"
# A token or the end always follows blanks and comments, so a repetition never backtracks. A
# possessive one (Python 3.11) need not record how, and is faster.
_ANY: Final = "*+" if sys.version_info >= (3, 11) else "*"
# Loops over single classes, unrolled: nested repeats cost twice the time.
_TRIVIA: Final = rf"[ \t\r\n\f]{_ANY}(?:![^\r\n]{_ANY}[ \t\r\n\f]{_ANY}){_ANY}"
# The most frequent alternative comes first. An unmatched character is a token of its own, so that
# any text can be split; the parser reports the error.
_TOKEN: Final = (
    r"([,;()\[\]{}\\]"
    r"|[^\W\d]\w*"
    rf"|(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?(?:(?![\w.])|(?={_GOING_ON}))"
    r"|:="
    r'|"(?:[^"\r\n]|"")*"'
    rf"|<(?i:{_PLACEHOLDERS})>"
    r"|<>|<=|>="
    r"|[0-9][\w.]*"
    r'|"[^\r\n]*'
    r"|[^ \t\r\n\f])"
)
TOKENS: Final = re.compile(rf"{_TRIVIA}(?:{_TOKEN}|\Z)")
"""An empty token represents the text after the last one."""
TILES: Final = re.compile(_TOKEN + "(" + _TRIVIA + ")")
TOUCHING: Final = re.compile(rf"[0-9.](?=[ADMOSTXadmostx]){_GOING_ON}")
"""A number and the word touching it; the look-ahead for letters makes the search fast."""
HEADER: Final = re.compile(r"\s*%%%(?:.*?)%%%[^\r\n]*", re.DOTALL)
LEAD: Final = re.compile(_TRIVIA)
_LINE_END: Final = re.compile(r"\r\n?|\n")


# -- Source ----------------------------------------------------------------------------------------
#
# The text of one module: its encoding, its tokens, and places in it.


@dataclass(slots=True, eq=False)
class Source:
    """Decoded text with its tokens.

    `tokens[i]` is the text of token i and `starts[i]` its offset in `text` (code points); `gaps[i]`
    is the text between token i and the next (blanks and comments); `lead` is the text before the
    first token. Lead, tokens and gaps in turn tile the text. Offsets and gaps are computed on
    demand, because most parses need none.
    """

    text: str
    path: str
    encoding: str
    lead: str = ""
    tokens: list[str] = field(default_factory=list)
    _gaps: list[str] = field(default_factory=list)
    _starts: list[int] = field(default_factory=list)
    _lines: list[int] = field(default_factory=list)

    @property
    def starts(self) -> list[int]:
        """Offset of each token."""
        if not self._starts:
            self._tile()
        return self._starts

    @property
    def gaps(self) -> list[str]:
        """Blanks and comments after each token."""
        if not self._starts:
            self._tile()
        return self._gaps

    def _tile(self) -> None:
        start = len(self.lead)
        pairs = TILES.findall(self.text, start)
        self._gaps = [gap for _, gap in pairs]
        ends = accumulate(map(len, chain.from_iterable(pairs)), initial=start)
        self._starts = list(islice(ends, 0, 2 * len(pairs), 2))

    @property
    def lines(self) -> list[int]:
        """Offset of each line; LF, CRLF and CR end a line."""
        if not self._lines:
            self._lines = [0, *(end.end() for end in _LINE_END.finditer(self.text))]
        return self._lines

    def position(self, offset: int) -> tuple[int, int]:
        """Return line and column (from 1, code points) of an offset."""
        lines = self.lines
        line = bisect_right(lines, offset)
        return line, offset - lines[line - 1] + 1

    def offset(self, line: int, column: int) -> int:
        """Return the offset of a line and column.

        A position after the last line means the end of the text.
        """
        lines = self.lines
        return lines[line - 1] + column - 1 if 0 < line <= len(lines) else len(self.text)

    def line(self, token: int) -> int:
        """Return the line (from 1) of a token's start."""
        return bisect_right(self.lines, self.starts[token])

    def span(self, first: int, last: int) -> Span:
        """Return the place of the tokens `first` to `last`."""
        line, column = self.position(self.starts[first])
        end_line, end_column = self.position(self.starts[last] + len(self.tokens[last]))
        return Span(self.path, line, column, end_line, end_column)
