"""Limit the number and length of findings.

The first of each kind are kept, with the number of the others.
"""

from collections.abc import Iterable
from dataclasses import replace

from rapidgen.diagnostics import Diagnostic, error

_OF_A_KIND = 8
_TOGETHER = 30
_MESSAGE, _LABEL, _HELP = 300, 100, 900
_WHOLE = 3000
"""Total characters above which only messages are kept."""


def limit_findings(findings: Iterable[Diagnostic]) -> list[Diagnostic]:
    """Return the findings, with long texts of a hostile file truncated."""
    saved: list[Diagnostic] = []
    counts: dict[str, int] = {}
    first: dict[str, Diagnostic] = {}
    length = 0
    for d in findings:
        counts[d.code] = counts.get(d.code, 0) + 1
        first.setdefault(d.code, d)
        if counts[d.code] > _OF_A_KIND or len(saved) >= _TOGETHER:
            continue
        short = replace(
            d,
            message=truncate(d.message, _MESSAGE),
            label=truncate(d.label, _LABEL),
            help=truncate(d.help, _HELP),
        )
        length += len(short.message) + len(short.help) + len(short.label)
        saved.append(short if length <= _WHOLE else replace(short, help="", label=""))
    for code, count in counts.items():
        left = count - sum(d.code == code for d in saved)
        if left:
            one = first[code]
            saved.append(error(code, one.span, f"and {left} more", severity=one.severity))
    return saved


def truncate(text: str, most: int) -> str:
    """Return a text, truncated in its middle if too long."""
    if len(text) <= most:
        return text
    half = most // 2 - 3
    return f"{text[:half]} ... {text[-half:]}"
