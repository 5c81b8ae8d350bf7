"""Data of a finding.

This module formats no text for a terminal: see render.py.
"""

import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from difflib import get_close_matches

from rapidgen._compat import StrEnum


class Severity(StrEnum):
    """Severity of a finding.

    Only `ERROR` makes a command fail.
    """

    ERROR = "error"
    WARNING = "warning"
    INFO = "info"


@dataclass(frozen=True, slots=True)
class Span:
    """A place in a text: lines and columns from 1, in code points; the end is exclusive.

    `end_line` and `end_column` of 0 mean a point: one character is marked.
    """

    path: str
    line: int
    column: int
    end_line: int = 0
    end_column: int = 0


@dataclass(frozen=True, slots=True)
class Label:
    """A second place that explains the first ("declared here").

    Without a text it is a further place of the same finding, which only editors show.
    """

    span: Span
    text: str


@dataclass(frozen=True, slots=True)
class Edit:
    """Replacement of a span by a text; an empty span (both ends equal) is an insertion."""

    span: Span
    text: str


@dataclass(frozen=True, slots=True)
class Fix:
    """Edits that remove a finding.

    A safe fix does not change what the program does, or is the only meaning of a wrong text:
    `check --fix` applies safe ones. Editors offer all.
    """

    title: str
    edits: tuple[Edit, ...]
    is_safe: bool = False


class Tag(StrEnum):
    """Properties of the marked text that editors show: faded out, or struck through."""

    UNNECESSARY = "unnecessary"
    DEPRECATED = "deprecated"


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One finding.

    `message` is a short phrase without a full stop; `label` explains the marked place; `help` says
    what to do; `notes` add facts, such as the rule's source.
    """

    code: str
    severity: Severity
    message: str
    span: Span | None = None
    label: str = ""
    help: str = ""
    notes: tuple[str, ...] = ()
    related: tuple[Label, ...] = ()
    fixes: tuple[Fix, ...] = ()
    tags: tuple[Tag, ...] = ()


def error(
    code: str,
    at: Span | None,
    message: str,
    help: str = "",
    *,
    label: str = "",
    notes: Sequence[str] = (),
    related: Sequence[Label] = (),
    severity: Severity = Severity.ERROR,
    fixes: Sequence[Fix] = (),
    tags: Sequence[Tag] = (),
) -> Diagnostic:
    """Create an error.

    `at` is its place, `help` says what to do.
    """
    return Diagnostic(
        code, severity, message, at, label, help, tuple(notes), tuple(related), tuple(fixes),
        tuple(tags),
    )  # fmt: skip


def replacement(title: str, at: Span, text: str, *, is_safe: bool = False) -> tuple[Fix, ...]:
    """Return the fix that replaces one span."""
    return (Fix(title, (Edit(at, text),), is_safe),)


def apply_edits(text: str, edits: Iterable[Edit], offset: Callable[[int, int], int]) -> str:
    """Return a text after edits of its own spans.

    `offset` converts line and column to an offset. Of edits that overlap, the first one counts.
    """
    ranges = sorted(
        (offset(e.span.line, e.span.column), offset(e.span.end_line, e.span.end_column), e.text)
        for e in edits
    )
    result, end = [], 0
    for start, stop, replaced in ranges:
        if start < end:
            continue
        result += [text[end:start], replaced]
        end = stop
    return "".join([*result, text[end:]])


def _notes(d: Diagnostic) -> list[str]:
    place = f"{d.span.path}:{d.span.line}" if d.span else ""
    return [f"{d.code}: {line}" for line in (place, *d.notes, d.help) if line]


class DiagnosticError(Exception):
    """A user error that ends an operation.

    The text and the notes are those of the first error; `diagnostics` has all. Commands show
    only this exception. `exit_code` is 2 for bad input or usage and 1 for a rejection or a failure.
    """

    def __init__(
        self, diagnostics: Diagnostic | Iterable[Diagnostic], *, exit_code: int = 2
    ) -> None:
        result = (diagnostics,) if isinstance(diagnostics, Diagnostic) else tuple(diagnostics)
        errors = [d for d in result if d.severity is Severity.ERROR] or result
        text = "; ".join(f"{d.code}: {d.message}" for d in errors[:1])
        if len(result) > 1:
            text += f" (and {len(result) - 1} more, see `diagnostics`)"
        super().__init__(text)
        # Python shows these notes below a traceback: callers of the library also see place and
        # help.
        if sys.version_info >= (3, 11):
            for line in [line for d in errors[:1] for line in _notes(d)]:
                self.add_note(line)
        self.diagnostics: tuple[Diagnostic, ...] = result
        self.exit_code = exit_code

    def __reduce__(self) -> tuple[object, ...]:
        # Worker processes pass it on; an Exception would take its text for the diagnostics.
        return type(self), (self.diagnostics,), {"exit_code": self.exit_code}


def refusal(
    code: str,
    at: Span | None,
    message: str,
    help: str = "",
    *,
    label: str = "",
    notes: Sequence[str] = (),
    related: Sequence[Label] = (),
    exit_code: int = 2,
) -> DiagnosticError:
    """Create an exception with one error."""
    result = error(code, at, message, help, label=label, notes=notes, related=related)
    return DiagnosticError(result, exit_code=exit_code)


def suggest(word: str, known: Sequence[str]) -> str:
    """Return a "did you mean" sentence for `word`, or an empty text."""
    folded = {name.casefold(): name for name in known}
    close = get_close_matches(word.casefold(), list(folded), n=1, cutoff=0.6)
    return f"did you mean '{folded[close[0]]}'?" if close else ""
