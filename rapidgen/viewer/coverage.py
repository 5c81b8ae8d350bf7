"""Coverage of RAPID as one self-contained HTML file.

Texts of a program's author (names, paths, comments) are text here, never markup.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from html import escape

_STYLE = """
body{font:14px/1.4 system-ui,sans-serif;color:#222;margin:1.5em}
table{border-collapse:collapse}td,th{padding:.15em .8em;text-align:left}
th{border-bottom:1px solid #999}.n{text-align:right;color:#777;font-variant-numeric:tabular-nums}
pre{margin:0;font:13px/1.45 ui-monospace,monospace;border:1px solid #ddd;overflow-x:auto}
pre span{display:block;min-height:1.45em;padding-left:.5em;white-space:pre}
pre i{display:inline-block;width:8em;text-align:right;margin-right:1em;color:#777;font-style:normal}
.hit{background:#e6f4e6}.miss{background:#fbe3e3}
.bar{display:inline-block;width:8em;height:.7em;background:#f2b8b8}
.bar b{display:block;height:100%;background:#6fbf73}
"""


@dataclass(frozen=True, slots=True)
class CoveredFile:
    """A module: its text, and the executions of each statement line."""

    path: str
    text: str
    hits: Mapping[int, int]


def coverage_page(title: str, files: Iterable[CoveredFile]) -> str:
    """Return the page: a table of the files, then every file with its lines."""
    given = list(files)
    reached = sum(_counts(file)[0] for file in given)
    lines = sum(_counts(file)[1] for file in given)
    parts = [
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">',
        f"<title>{escape(title)}</title><style>{_STYLE}</style></head><body>",
        f"<h1>{escape(title)}</h1>",
        f"<p>{reached} of {lines} lines with statements were executed"
        f" ({_percent(reached, lines)}).</p>",
        "<table><tr><th>module</th><th></th><th>lines</th></tr>",
        *(_row(number, file) for number, file in enumerate(given)),
        "</table>",
        *(_source(number, file) for number, file in enumerate(given)),
        "</body></html>",
    ]
    return "\n".join(parts) + "\n"


def _counts(file: CoveredFile) -> tuple[int, int]:
    return sum(1 for hits in file.hits.values() if hits), len(file.hits)


def _percent(reached: int, lines: int) -> str:
    return f"{100 * reached / lines:.0f} %" if lines else "none"


def _row(number: int, file: CoveredFile) -> str:
    reached, lines = _counts(file)
    share = 100 * reached / lines if lines else 0
    return (
        f'<tr><td><a href="#m{number}">{escape(file.path)}</a></td>'
        f'<td><span class="bar"><b style="width:{share:.1f}%"></b></span></td>'
        f'<td class="n">{reached} of {lines}</td></tr>'
    )


def _source(number: int, file: CoveredFile) -> str:
    lines = []
    for at, text in enumerate(file.text.splitlines(), 1):
        hits = file.hits.get(at)
        kind = "" if hits is None else ' class="hit"' if hits else ' class="miss"'
        count = "" if hits is None else f"{hits}&times;"
        lines.append(f"<span{kind}><i>{count} {at}</i>{escape(text)}</span>")
    return f'<h2 id="m{number}">{escape(file.path)}</h2>\n<pre>{"".join(lines)}</pre>'
