"""Formatting of documents, ranges and lines, and quick fixes as edits.

A range is formatted as whole lines: the result is that of the whole document, cut to the changed
lines of the range. A text with syntax errors is not formatted as a whole; a line of it is, because
that needs its own tokens only.
"""

import re
from dataclasses import dataclass
from difflib import SequenceMatcher
from typing import Final

from rapidgen.diagnostics import Diagnostic, Fix, Span
from rapidgen.editor.documents import TextEdit
from rapidgen.editor.workspace import View
from rapidgen.rapid.syntax.format import INDENT, format_source
from rapidgen.rapid.syntax.lexer import KEYWORDS, Kinds

_OPENERS: Final = frozenset(("MODULE", "PROC", "FUNC", "TRAP", "RECORD", "FOR", "WHILE", "TEST"))
_LINES: Final = re.compile(r"[^\r\n]*(?:\r\n|\r|\n|\Z)")
_DIVIDERS: Final = frozenset(("ELSE", "ELSEIF", "CASE", "DEFAULT"))
_HANDLERS: Final = frozenset(("ERROR", "UNDO", "BACKWARD"))


def format_document(view: View, lines: tuple[int, int] | None = None) -> list[TextEdit]:
    """Return the edits that format a module, or its lines first to last (from 1).

    Raises DiagnosticError for a text with syntax errors.
    """
    source = view.source
    before = _with_ends(source.text)
    after = _with_ends(format_source(source.text, path=source.path))
    matcher = SequenceMatcher(None, before, after, autojunk=False)
    edits = []
    for tag, i, j, k, m in matcher.get_opcodes():
        if tag == "equal":
            continue
        if lines is not None and (i + 1 > lines[1] or max(j, i + 1) < lines[0]):
            continue
        span = _line_span(source.path, before, i, j)
        edits.append(TextEdit(source.path, span, "".join(after[k:m])))
    return edits


def _with_ends(text: str) -> list[str]:
    """Return lines with their ends; LF, CRLF and CR end a line."""
    return [line for line in _LINES.findall(text) if line]


def _line_span(path: str, lines: list[str], first: int, last: int) -> Span:
    """Return the span of lines `first` up to, without, `last` (from 0)."""
    if last < len(lines) or not lines or lines[-1].endswith(("\n", "\r")):
        return Span(path, first + 1, 1, last + 1, 1)
    return Span(path, first + 1, 1, last, len(lines[-1]) + 1)


def format_line(view: View, line: int) -> list[TextEdit]:
    """Return the edit that indents a line (from 1) and writes its keywords in upper case.

    The depth is that of the blocks that are open before the line, by the tokens alone.
    """
    source = view.source
    if not 1 <= line <= len(source.lines):
        return []
    start = source.offset(line, 1)
    end = source.offset(line + 1, 1)
    text = source.text[start:end].rstrip("\r\n")
    tokens = [at for at, offset in enumerate(source.starts) if start <= offset < start + len(text)]
    if not tokens or (tokens[0] > 0 and not _begins_statement(view, tokens[0])):
        return []
    depth = _depth_before(view, tokens[0])
    kinds = Kinds()
    body = list(text)
    for at in tokens:
        token = source.tokens[at]
        if kinds[token] in KEYWORDS:
            column = source.starts[at] - start
            body[column : column + len(token)] = token.upper()
    after = INDENT * depth + "".join(body).strip()
    if after == text:
        return []
    return [TextEdit(source.path, Span(source.path, line, 1, line, len(text) + 1), after)]


def _begins_statement(view: View, token: int) -> bool:
    """Return True unless a line goes on with the statement of the line before."""
    before = view.source.tokens[token - 1].upper()
    if before in (";", "THEN", "DO", "ELSE", ":", ")") or before.startswith("END"):
        return True
    return before in _HANDLERS or Kinds()[view.source.tokens[token]] in KEYWORDS


def _depth_before(view: View, token: int) -> int:
    """Return the depth of the statement that begins with a token."""
    tokens = [text.upper() for text in view.source.tokens[: token + 1]]
    depth = 0
    for at, word in enumerate(tokens[:-1]):
        if word in _OPENERS or (word == "THEN" and _opens_if(tokens, at)):
            depth += 1
        elif word.startswith("END") and word[3:] in _OPENERS | {"IF"}:
            depth -= 1
    word = tokens[-1]
    if word.startswith("END") and word[3:] in _OPENERS | {"IF"}:
        return max(0, depth - 1)
    if word in _DIVIDERS or word in _HANDLERS:
        return max(0, depth - 1)
    return max(0, depth)


def _opens_if(tokens: list[str], at: int) -> bool:
    """Return True if a THEN belongs to IF, not to ELSEIF, which continues the block."""
    for k in range(at, max(-1, at - 200), -1):
        if tokens[k] in ("IF", "ELSEIF"):
            return tokens[k] == "IF"
    return False


# -- fixes ---------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class QuickFix:
    """A fix with the finding that it removes."""

    finding: Diagnostic
    fix: Fix
    is_only: bool


def quick_fixes(found: list[Diagnostic], first: int, last: int) -> list[QuickFix]:
    """Return the fixes of findings in lines first to last (from 1)."""
    result = []
    for d in found:
        if d.span is None:
            continue
        end = d.span.end_line or d.span.line
        if d.span.line <= last and end >= first:
            result += [QuickFix(d, fix, len(d.fixes) == 1) for fix in d.fixes]
    return result


def safe_fixes(found: list[Diagnostic]) -> list[Fix]:
    """Return the safe fixes of a document, without such that overlap."""
    result: list[Fix] = []
    taken: list[Span] = []
    for d in found:
        for fix in d.fixes:
            if fix.is_safe and not any(_meet(e.span, t) for e in fix.edits for t in taken):
                taken += [edit.span for edit in fix.edits]
                result.append(fix)
                break
    return result


def _meet(one: Span, other: Span) -> bool:
    start, end = (one.line, one.column), (one.end_line, one.end_column)
    first, last = (other.line, other.column), (other.end_line, other.end_column)
    return (start < last and first < end) or one == other
