"""A checklist as Markdown and as an HTML page that prints on paper."""

from collections.abc import Iterator
from html import escape

from rapidgen.commission.checklist import Checklist, Step

_MARKS = {"ok": "passed", "assumed": "assumed", "skipped": "skipped", "fail": "FAILED"}
_ENDS = {
    "running": "not finished",
    "complete": "complete",
    "failed": "ended at the first failed step",
    "interrupted": "interrupted by the user",
}
_STYLE = """
body{font:14px/1.45 sans-serif;max-width:60em;margin:2em auto;padding:0 1em;color:#111;
background:#fff}table{border-collapse:collapse;width:100%}tr{break-inside:avoid}
th,td{border:1px solid #999;padding:.3em .5em;text-align:left;vertical-align:top}
td.fail{font-weight:bold;color:#a00}figure{display:inline-block;margin:.5em;break-inside:avoid}
p.sign{margin-top:3em}svg{border:1px solid #ccc;max-width:100%}
"""


def head(checklist: Checklist) -> list[tuple[str, str]]:
    """Return what was commissioned, when, by which versions, and the result."""
    target = checklist.target + (" (simulator)" if checklist.simulated else "")
    rows = [
        ("Robot", f"{checklist.robot}, {checklist.model or 'model unknown'}"),
        ("Motion group", checklist.group),
        ("Target", target),
        ("Date", checklist.date),
        ("rapidgen", checklist.version),
        ("Driver", f"{checklist.driver or 'unknown'}, build {checklist.build_id or 'unknown'}"),
        ("RobotWare", checklist.robotware or "unknown"),
        ("Result", _ENDS[checklist.end]),
    ]
    assumed = sum(step.verdict == "assumed" for step in checklist.steps)
    if assumed:
        rows.append(("Assumed", f"{assumed} steps rest on prepared answers, not on a person"))
    return rows


def figures_of(step: Step) -> Iterator[str]:
    """Yield `name value` of each figure."""
    for name, value in step.figures.items():
        yield f"{name} {value:g}"


def markdown(checklist: Checklist) -> str:
    """Return the checklist as Markdown."""
    lines = ["# Commissioning checklist", ""]
    lines += [f"- {name}: {_cell(text)}" for name, text in head(checklist)]
    lines += ["", "| Step | Result | Found | Figures |", "|---|---|---|---|"]
    for step in checklist.steps:
        found = step.found + (f" ({step.code}; {step.help})" if step.code else "")
        cells = (step.title, _MARKS[step.verdict], found, ", ".join(figures_of(step)))
        lines.append(f"| {' | '.join(map(_cell, cells))} |")
    lines += ["", "Operator: ______________________  Signature: ______________________", ""]
    return "\n".join(lines)


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")


def html(checklist: Checklist) -> str:
    """Return the checklist as one HTML page without scripts; every text is escaped."""
    title = escape(f"Commissioning checklist: {checklist.robot}")
    rows = "".join(
        f"<tr><th>{escape(name)}</th><td>{escape(text)}</td></tr>" for name, text in head(checklist)
    )
    steps = "".join(
        f"<tr><td>{escape(step.title)}</td>"
        f'<td class="{step.verdict}">{_MARKS[step.verdict]}</td><td>{escape(step.found)}'
        + (f"<br>{escape(step.code)}: {escape(step.help)}" if step.code else "")
        + f"</td><td>{'<br>'.join(map(escape, figures_of(step)))}</td></tr>"
        for step in checklist.steps
    )
    drawings = "".join(
        f"<figure>{svg}<figcaption>{escape(name)}: grey before, red ten times the announced move"
        "</figcaption></figure>"
        for name, svg in checklist.drawings.items()
        if svg
    )
    return (
        f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>{title}</title>'
        f"<style>{_STYLE}</style></head><body><h1>{title}</h1><table>{rows}</table>"
        "<h2>Steps</h2><table><tr><th>Step</th><th>Result</th><th>Found</th><th>Figures</th></tr>"
        f"{steps}</table><h2>Announced moves</h2>{drawings}"
        '<p class="sign">Operator: ______________________ &nbsp; '
        "Signature: ______________________</p></body></html>\n"
    )
