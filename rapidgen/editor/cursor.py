"""The text before a cursor: what is being written, and in which call.

Everything here works on tokens, because the statement at the cursor is seldom complete: a tree has
no node for `MoveL p,` or `IF `.
"""

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from rapidgen.editor.workspace import View
from rapidgen.rapid.binding import RoutineSymbol, Scope
from rapidgen.rapid.binding.lookup import scope_at
from rapidgen.rapid.binding.names import called
from rapidgen.rapid.syntax.blocks import STARTERS
from rapidgen.rapid.syntax.lexer import HOLDER, NAME, Kinds
from rapidgen.rapid.syntax.nodes import Parameter

_ENDS: Final = frozenset((";", "THEN", "DO", "ELSE", ":"))
"""Tokens behind which a statement begins, unless a bracket is open."""
_HEADERS: Final = frozenset(("PROC", "FUNC", "TRAP", "MODULE", "RECORD", "LOCAL"))
"""Words before parentheses that are no call."""
_MOST: Final = 400
"""Tokens of a statement that are looked at."""


@dataclass(frozen=True, slots=True)
class Cursor:
    """A place in a text. `token` is the last token that ends before the typed word."""

    offset: int
    word: str
    """The letters of a name before the cursor."""
    start: int
    """Offset of the word."""
    token: int
    statement: int
    """First token of the statement; `token + 1` if none has begun."""
    scope: Scope
    is_text: bool
    """In a comment or a string."""


@dataclass(frozen=True, slots=True)
class OpenCall:
    """The innermost call around a cursor."""

    routine: RoutineSymbol
    parameters: tuple[Parameter, ...]
    active: int
    """Index of the parameter that is written; -1: none is left."""
    given: frozenset[str]
    """Lower-case names of the optional arguments before the cursor."""
    is_procedure: bool


def cursor_at(view: View, line: int, column: int) -> Cursor:
    """Return the cursor at a line and column (from 1, code points)."""
    source = view.source
    offset = min(source.offset(line, column), len(source.text))
    start = offset
    while start > 0 and (source.text[start - 1].isalnum() or source.text[start - 1] == "_"):
        start -= 1
    if source.text[start:offset][:1].isdigit():
        start = offset
    token = bisect_left(source.starts, start) - 1
    at = bisect_right(source.starts, offset) - 1
    return Cursor(
        offset,
        source.text[start:offset],
        start,
        token,
        _statement(source.tokens, token),
        scope_at(view.module, max(0, min(token + 1, len(source.tokens) - 1))),
        _is_text(view, at, offset),
    )


def _is_text(view: View, token: int, offset: int) -> bool:
    """Return True in a string or in a comment."""
    source = view.source
    if token < 0:
        gap, start = source.lead, 0
    else:
        end = source.starts[token] + len(source.tokens[token])
        if source.tokens[token].startswith('"'):
            closed = len(source.tokens[token]) > 1 and source.tokens[token].endswith('"')
            if offset < end or (not closed and source.line(token) == source.position(offset)[0]):
                return offset > source.starts[token]
        gap, start = source.gaps[token], end
    before = gap[: max(0, offset - start)]
    line = before[max(before.rfind("\n"), before.rfind("\r")) + 1 :]
    return "!" in line


def _statement(tokens: Sequence[str], token: int) -> int:
    """Return the index of the first token of the statement that has `token`."""
    kinds = Kinds()
    depth = 0
    for at in range(token, max(-1, token - _MOST), -1):
        kind = kinds[tokens[at]]
        if kind in (")", "]", "}"):
            depth += 1
        elif kind in ("(", "[", "{"):
            depth -= 1
        elif kind == ":" and tokens[at : at + 2] == [":", "="]:
            continue
        elif depth <= 0 and kind in _ENDS:
            return at + 1
        elif kind in STARTERS or (kind == "MODULE" and at == 0):
            return at
    return max(0, token - _MOST + 1)


def is_statement_start(view: View, cursor: Cursor) -> bool:
    """Return True if a statement or declaration begins at the cursor."""
    tokens = view.source.tokens
    if cursor.statement > cursor.token:
        return True
    head = tokens[cursor.statement].upper()
    if (
        head in ("ERROR", "UNDO", "BACKWARD", "ELSE", "DEFAULT")
        and cursor.token == cursor.statement
    ):
        return True
    following = view.source.position(cursor.start)[0] > view.source.line(cursor.token)
    last = tokens[cursor.token].upper()
    if head.startswith("END") and cursor.token <= cursor.statement + 1:
        return True
    # Behind the head of a routine, or of a module.
    if head in ("PROC", "FUNC", "TRAP", "MODULE", "LOCAL") and following:
        return last == ")" or (head in ("TRAP", "MODULE") and cursor.token == cursor.statement + 1)
    return False


def open_call(view: View, cursor: Cursor) -> OpenCall | None:
    """Return the innermost call whose arguments are being written, None without one."""
    tokens = view.source.tokens
    kinds = Kinds()
    depth = 0
    if cursor.statement <= cursor.token and kinds[tokens[cursor.statement]] in _HEADERS:
        return None
    for at in range(cursor.token, max(cursor.statement - 1, -1), -1):
        kind = kinds[tokens[at]]
        if kind in (")", "]", "}"):
            depth += 1
        elif kind in ("[", "{", "("):
            depth -= 1
            if depth < 0 and kind == "(" and at > 0 and kinds[tokens[at - 1]] is NAME:
                return _call(cursor, tokens, at - 1, at + 1, is_procedure=False)
            depth = max(depth, 0)  # the cursor is in an index or in parentheses
    head = _procedure(tokens, kinds, cursor)
    if head < 0 or head >= cursor.token + (not cursor.word and cursor.token == head):
        return None
    return _call(cursor, tokens, head, head + 1, is_procedure=True)


def _procedure(tokens: Sequence[str], kinds: Kinds, cursor: Cursor) -> int:
    """Return the token of the procedure's name in a call statement, or -1."""
    at = cursor.statement
    if at > cursor.token:
        return -1
    if kinds[tokens[at]] == "IF":
        # A compact IF has its call behind the condition: the last name that follows a value.
        for k in range(cursor.token, at, -1):
            if kinds[tokens[k]] is NAME and kinds[tokens[k - 1]] in (NAME, "TRUE", "FALSE", ")"):
                return k
        return -1
    if kinds[tokens[at]] not in (NAME, HOLDER):
        return -1
    following = tokens[at + 1] if at + 1 <= cursor.token else ""
    return -1 if following in (":=", ".", "{", ":", "(") else at


def _call(
    cursor: Cursor, tokens: Sequence[str], name: int, first: int, *, is_procedure: bool
) -> OpenCall | None:
    symbol = called(cursor.scope.find(tokens[name]))
    if not isinstance(symbol, RoutineSymbol):
        return None
    parameters = tuple(symbol.parameters or ())
    given: set[str] = set()
    required = 0
    optional = ""
    is_empty = True
    depth = 0
    for at in range(first, cursor.token + 1):
        text = tokens[at]
        if text in ("(", "[", "{"):
            depth += 1
        elif text in (")", "]", "}"):
            depth -= 1
        if depth == 0 and text in (",", "\\"):
            required += not is_empty and not optional
            optional, is_empty = "", True
            if text == "\\" and at < cursor.token:
                optional = tokens[at + 1].lower()
                given.add(optional)
            continue
        is_empty = False
    active = _active(parameters, required, optional)
    return OpenCall(symbol, parameters, active, frozenset(given), is_procedure)


def _active(parameters: Sequence[Parameter], required: int, optional: str) -> int:
    """Return the index of an optional parameter, or of the n-th required one."""
    if optional:
        for index, parameter in enumerate(parameters):
            if parameter.name.lower() == optional:
                return index
        return -1
    count = -1
    group = -1
    for index, parameter in enumerate(parameters):
        if parameter.optional:
            continue
        if parameter.group < 0 or parameter.group != group:
            count += 1
        group = parameter.group
        if count == required:
            return index
    return -1
