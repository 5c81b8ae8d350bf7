"""Text of diagnostics in the formats of `--format`.

Formats: full, concise, json, github.
"""

import json
import re
from collections.abc import Callable, Iterable, Sequence

from rapidgen._compat import StrEnum
from rapidgen._json import Json
from rapidgen._reading import read_foreign
from rapidgen.diagnostics.model import Diagnostic, Severity, Span

_COLOURS = {Severity.ERROR: "1;31", Severity.WARNING: "1;33", Severity.INFO: "1;36"}
_LARGEST = 20_000_000
"""Maximum bytes of a file that is shown in parts: that of text files."""
_TAB = "    "
# Texts of files and robots may be shown; they must not control the terminal.
_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]")


class Format(StrEnum):
    """Output formats of diagnostics."""

    FULL = "full"
    CONCISE = "concise"
    JSON = "json"
    GITHUB = "github"


def read_lines(path: str, otherwise: str = "latin-1") -> list[str]:
    """Return lines of a file for display; none if unreadable.

    A file that is not UTF-8 has the encoding `otherwise`, or Latin-1 if it does not fit.
    """
    try:
        data = read_foreign(path, _LARGEST)
    except OSError:
        return []
    for encoding in ("utf-8-sig", otherwise):
        try:
            return data.decode(encoding).splitlines()
        except UnicodeDecodeError:
            continue
    return data.decode("latin-1").splitlines()


def render(
    diagnostics: Iterable[Diagnostic],
    format: Format = Format.FULL,
    *,
    lines_of: Callable[[str], Sequence[str]] = read_lines,
    colour: bool = False,
) -> str:
    """Return all diagnostics as one text that ends with a newline.

    The text is empty if there is no diagnostic. `json` is one array, also when empty; line and
    column are `null` without a place.
    """
    result = list(diagnostics)
    if format is Format.JSON:
        return json.dumps(as_data(result), indent=2, ensure_ascii=False) + "\n"
    if format is Format.CONCISE:
        return "".join(_concise(d) + "\n" for d in result)
    if format is Format.GITHUB:
        return "".join(_github(d) + "\n" for d in result)
    cache: dict[str, Sequence[str]] = {}

    def cached(path: str) -> Sequence[str]:
        if path not in cache:
            cache[path] = lines_of(path)
        return cache[path]

    return "".join(_full(d, cached, colour) + "\n" for d in result)


def _clean(text: str) -> str:
    return _CONTROL.sub("\N{REPLACEMENT CHARACTER}", text)


def as_data(diagnostics: Iterable[Diagnostic]) -> list[Json]:
    """Return diagnostics as data.

    Line and column count from 1, in characters; `None` without a place.
    """
    return [_as_json(d) for d in diagnostics]


def _as_json(d: Diagnostic) -> Json:
    span = d.span
    return {
        "code": d.code,
        "severity": d.severity.value,
        "path": span.path if span else None,
        "line": span.line if span else None,
        "column": span.column if span else None,
        "end_line": (span.end_line or span.line) if span else None,
        "end_column": (span.end_column or span.column + 1) if span else None,
        "message": d.message,
        "label": d.label,
        "help": d.help,
        "notes": list(d.notes),
        "related": [
            {
                "path": r.span.path,
                "line": r.span.line,
                "column": r.span.column,
                "message": r.text,
            }
            for r in d.related
        ],
        "fixes": [
            {
                "title": fix.title,
                "safe": fix.is_safe,
                "edits": [
                    {
                        "path": e.span.path,
                        "line": e.span.line,
                        "column": e.span.column,
                        "end_line": e.span.end_line,
                        "end_column": e.span.end_column,
                        "text": e.text,
                    }
                    for e in fix.edits
                ],
            }
            for fix in d.fixes
        ],
    }


def _concise(d: Diagnostic) -> str:
    place = f"{d.span.path}:{d.span.line}:{d.span.column}: " if d.span else ""
    fix = f" ({d.help})" if d.help else ""
    return _clean(f"{place}{d.severity.value}[{d.code}]: {d.message}{fix}")


def _github(d: Diagnostic) -> str:
    level = {"error": "error", "warning": "warning", "info": "notice"}[d.severity.value]
    text = _escape(d.message + (f". {d.help}" if d.help else ""))
    if d.span is None:
        return f"::{level} title={d.code}::{text}"
    path = _escape(d.span.path).replace(",", "%2C").replace(":", "%3A")
    place = f"file={path},line={d.span.line},col={d.span.column},title={d.code}"
    return f"::{level} {place}::{text}"


def _escape(text: str) -> str:
    return _clean(text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A"))


def _full(d: Diagnostic, lines_of: Callable[[str], Sequence[str]], colour: bool) -> str:
    def paint(text: str, sgr: str) -> str:
        return f"\x1b[{sgr}m{text}\x1b[0m" if colour else text

    sgr = _COLOURS[d.severity]
    head = f"{d.severity.value}[{d.code}]"
    out = [paint(head, sgr) + paint(f": {_clean(d.message)}", "1")]
    bar = paint("|", "1;34")
    explained = [r for r in d.related if r.text]
    numbers = [s.line for s in ([d.span] if d.span else []) + [r.span for r in explained]]
    width = len(str(max(numbers, default=0)))
    pad = " " * width
    if d.span:
        arrow = paint("-->", "1;34")
        out.append(f"{pad}{arrow} {_clean(d.span.path)}:{d.span.line}:{d.span.column}")
        out += _excerpt(d.span, d.label, lines_of(d.span.path), width, bar, lambda t: paint(t, sgr))
    for related in explained:
        if d.span is None or related.span.path != d.span.path:
            out.append(
                f"{pad}{paint(':::', '1;34')} {_clean(related.span.path)}:"
                f"{related.span.line}:{related.span.column}"
            )
        out += _excerpt(
            related.span,
            related.text,
            lines_of(related.span.path),
            width,
            bar,
            lambda t: paint(t, "1;34"),
            marker="-",
        )
    for note in d.notes:
        out.append(f"{pad} = {paint('note', '1')}: {_clean(note)}")
    if d.help:
        first, *remaining = d.help.splitlines()
        out.append(f"{pad} = {paint('help', '1')}: {_clean(first)}")
        out += [f"{pad}         {_clean(line)}" for line in remaining]
    return "\n".join(out)


def _excerpt(
    span: Span,
    label: str,
    lines: Sequence[str],
    width: int,
    bar: str,
    paint: Callable[[str], str],
    marker: str = "^",
) -> list[str]:
    if not 1 <= span.line <= len(lines):
        return [f"{' ' * width} = {_clean(label)}"] if label else []
    source = lines[span.line - 1]
    start = min(span.column, len(source) + 1) - 1
    same_line = span.end_line in (0, span.line)
    end = span.end_column - 1 if same_line and span.end_column else start + 1
    if not same_line:
        end = len(source)
    end = max(start + 1, min(end, len(source) + 1))
    # A line of a megabyte is shown as the part around the mark.
    cut = max(0, start - 60)
    window = source[cut : cut + 120]
    before = _clean(source[cut:start]).replace("\t", _TAB)
    marked = _clean(source[start : min(end, cut + 120)]).replace("\t", _TAB)
    underline = " " * len(before) + marker * max(1, len(marked))
    displayed = _clean(window).replace("\t", _TAB)
    return [
        f"{' ' * width} {bar}",
        f"{span.line:>{width}} {bar} {displayed}",
        f"{' ' * width} {bar} " + paint(f"{underline} {_clean(label)}".rstrip()),
    ]
