"""Formatting of documents, ranges and lines, and quick fixes as edits.

A range is formatted as whole lines: the result is that of the whole document, cut to the changed
lines of the range. A text with syntax errors is not formatted as a whole. A range of it is: each
declaration that parses alone, and the statements of the range in a routine that does not, if they
parse alone. A line needs its own tokens only.
"""

import re
from bisect import bisect_left
from collections.abc import Iterator
from dataclasses import dataclass
from difflib import SequenceMatcher
from typing import Final

from rapidgen.diagnostics import Diagnostic, DiagnosticError, Fix, Span, refusal
from rapidgen.editor.documents import TextEdit
from rapidgen.editor.workspace import View
from rapidgen.rapid.syntax.format import INDENT, format_source
from rapidgen.rapid.syntax.lexer import KEYWORDS, Kinds
from rapidgen.rapid.syntax.nodes import RoutineDeclaration

_OPENERS: Final = frozenset(("MODULE", "PROC", "FUNC", "TRAP", "RECORD", "FOR", "WHILE", "TEST"))
_LINES: Final = re.compile(r"[^\r\n]*(?:\r\n|\r|\n|\Z)")
_ROUTINES: Final = frozenset(("PROC", "FUNC", "TRAP"))
_ROUTINE_ENDS: Final = frozenset(("ENDPROC", "ENDFUNC", "ENDTRAP"))
_DIVIDERS: Final = frozenset(("ELSE", "ELSEIF", "CASE", "DEFAULT"))
_HANDLERS: Final = frozenset(("ERROR", "UNDO", "BACKWARD"))
_MANY: Final = 200_000
"""Tokens of a module that is not formatted."""


def format_document(view: View, lines: tuple[int, int] | None = None) -> list[TextEdit]:
    """Return the edits that format a module, or its lines first to last (from 1).

    Raises DiagnosticError for a text with syntax errors, unless parts of the lines are complete,
    and for one that is too large to be formatted within a second.
    """
    source = view.source
    if len(source.tokens) > _MANY:
        message = f"the module has more than {_MANY:,} words and signs"
        raise refusal("RG337", Span(source.path, 1, 1), message, "format it with `rapidgen fmt`")
    before = _with_ends(source.text)
    try:
        after = _with_ends(format_source(source.text, path=source.path))
    except DiagnosticError:
        parts = _complete_parts(view, before, *lines) if lines is not None else []
        if not parts:
            raise
        after, done = [], 0
        for first, last, text in parts:
            after += before[done:first] + text
            done = last
        after += before[done:]
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


def _complete_parts(
    view: View, lines: list[str], first: int, last: int
) -> list[tuple[int, int, list[str]]]:
    """Return formatted parts of a text with errors that meet lines first to last (from 1).

    Each is the index of its first line, the one behind its last line, and its new lines.
    """
    source = view.source
    count = len(source.tokens)
    result: list[tuple[int, int, list[str]]] = []
    tokens = [token.upper() for token in source.tokens]
    done = 0
    for node in view.module.tree.declarations:
        # Data of a routine with a wrong header are not those of the module.
        if not isinstance(node, RoutineDeclaration) and _open_routine(tokens, node.first) >= 0:
            continue
        end = min(node.last, count - 1)
        start, stop = source.line(node.first) - 1, source.line(end)
        # Whole lines only: another declaration on one of them would be cut.
        is_shared = (node.first > 0 and source.line(node.first - 1) == start + 1) or (
            end + 1 < count and source.line(end + 1) == stop
        )
        if is_shared or start < done or start >= last or stop < first:
            continue
        text = _formatted(lines[start:stop], "")
        if text is not None:
            result.append((start, stop, text))
            done = stop
    taken = {line for start, stop, _ in result for line in range(start, stop)}
    rest = [line for line in range(first - 1, min(last, len(lines))) if line not in taken]
    for start, stop in _runs(rest):
        text = _statements(view, lines, start, stop)
        if text is not None:
            result.append((start, stop, text))
    return sorted(result)


def _runs(numbers: list[int]) -> Iterator[tuple[int, int]]:
    """Yield runs of following numbers: the first, and the one behind the last."""
    start = 0
    for at in range(1, len(numbers) + 1):
        if at == len(numbers) or numbers[at] != numbers[at - 1] + 1:
            yield numbers[start], numbers[at - 1] + 1
            start = at


def _statements(view: View, lines: list[str], start: int, stop: int) -> list[str] | None:
    """Return the statements of whole lines, indented; None if they are not complete."""
    source = view.source
    first = bisect_left(source.starts, source.offset(start + 1, 1))
    behind = bisect_left(source.starts, source.offset(stop + 1, 1))
    tokens = [token.upper() for token in source.tokens]
    if first == behind or not _begins_statement(view, first) or tokens[behind - 1] == ":":
        return None
    head = _open_routine(tokens, first)
    text = _formatted(lines[start:stop], "PROC p()") if head >= 0 else None
    if text is None:
        return None
    # An error above the routine does not change the depth: it is counted from its head.
    indent = INDENT * (_depth_before(view, first, head) + 1)
    own = len(INDENT * 2)
    if any(line[:own].strip() for line in text):
        return None  # a handler, whose depth is not that of statements
    return [indent + line[own:] if line.strip() else line for line in text]


def _open_routine(tokens: list[str], token: int) -> int:
    """Return the token that begins the routine around a token (upper case), or -1."""
    for at in range(token - 1, -1, -1):
        if tokens[at] in _ROUTINES:
            return at
        if tokens[at] in _ROUTINE_ENDS:
            return -1
    return -1


def _formatted(lines: list[str], head: str) -> list[str] | None:
    """Return lines in the style of `fmt`, as they are in a module; None if they do not parse."""
    end = next((found for line in lines if (found := line[len(line.rstrip("\r\n")) :])), "\n")
    tail = "ENDPROC" if head else ""
    before, behind = ["MODULE m", *filter(None, [head])], [*filter(None, [tail]), "ENDMODULE"]
    body = "".join(lines)
    body += "" if body.endswith(("\r", "\n")) else end
    try:
        text = format_source(end.join([*before, ""]) + body + end.join([*behind, ""]))
    except DiagnosticError:
        return None
    return _with_ends(text)[len(before) : -len(behind)]


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


def _depth_before(view: View, token: int, start: int = 0) -> int:
    """Return the depth of the statement that begins with a token, from token `start` on."""
    tokens = [text.upper() for text in view.source.tokens[start : token + 1]]
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
