"""Reports as JSON, JUnit XML and one self-contained HTML page."""

import html
import platform
from collections import Counter
from collections.abc import Sequence
from datetime import datetime, timezone
from pathlib import Path
from typing import TYPE_CHECKING
from xml.etree import ElementTree

from rapidgen import __version__
from rapidgen._json import Json
from rapidgen.verification.model import CaseResult, Series, SuiteResult

if TYPE_CHECKING:
    from rapidgen.verification.testbench import Bench

PLOTTED = 200
"""Approximate number of samples of a series in a plot."""

_COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#999999")
_STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; margin: 2rem auto; max-width: 62rem; color: #222 }
table { border-collapse: collapse; width: 100% }
td, th { text-align: left; vertical-align: top; padding: .25rem .6rem }
td, th { border-bottom: 1px solid #ddd }
.ok { color: #007a33 } .bad { color: #b00020; font-weight: 600 }
pre { background: #f6f6f6; padding: .6rem; overflow-x: auto }
svg { background: #fafafa; border: 1px solid #ddd }
summary { cursor: pointer; padding: .3rem 0 } input { font: inherit; width: 20rem; padding: .2rem }
"""
_SEARCH = """
const groups = [...document.querySelectorAll("details.group")];
const first = groups.map(group => group.open);
document.getElementById("search").addEventListener("input", event => {
  const wanted = event.target.value.toLowerCase();
  groups.forEach((group, number) => {
    let any = false;
    for (const row of [...group.querySelectorAll("tr")].slice(1)) {
      row.hidden = !row.textContent.toLowerCase().includes(wanted);
      any ||= !row.hidden;
    }
    group.hidden = !any;
    group.open = wanted ? any : first[number];
  });
});
"""


def as_json(report: SuiteResult) -> dict[str, Json]:
    """Return the report as JSON data.

    It holds every outcome, and the non-default assumptions of its setting.
    """
    reached, of = report.covered
    return {
        "name": report.name,
        "build_id": report.build_id,
        "passed": report.passed,
        "broken_off": report.broken_off,
        "left": report.left,
        "elapsed": round(report.elapsed, 3),
        "version": __version__,
        "lines": {"reached": reached, "of": of},
        "settings": {name: list(texts) for name, texts in report.rows.items()},
        "outcomes": [
            {
                "case": outcome.case,
                "group": outcome.group,
                "setting": outcome.setting,
                "passed": outcome.passed,
                "untried": outcome.untried,
                "detail": outcome.detail,
                "elapsed": round(outcome.elapsed, 3),
                "blamed": list(outcome.blamed),
            }
            for outcome in report.outcomes
        ],
        "schedules": report.schedules,
        "programs": report.programs,
        "pairs": [list(point) for point in report.curve],
        "findings": [{"schedule": f.schedule, "detail": f.detail} for f in report.findings],
    }


def write_junit(report: SuiteResult, path: Path) -> None:
    """Write JUnit XML.

    It has one test case for each outcome, and one for each schedule that violates the invariant.
    """
    failures = sum(not o.passed for o in report.outcomes) + len(report.findings)
    suite = ElementTree.Element(
        "testsuite",
        name=f"rapidgen {report.name}",
        tests=str(len(report.outcomes) + max(1, len(report.findings))),
        failures=str(failures),
        errors="0",
        skipped=str(len(report.outcomes) - len(report.tried)),
        time=f"{report.elapsed:.3f}",
    )
    for outcome in report.outcomes:
        case = ElementTree.SubElement(
            suite,
            "testcase",
            classname=f"{report.name}.{outcome.group}",
            name=_name(outcome),
            time=f"{outcome.elapsed:.3f}",
        )
        if outcome.untried:
            ElementTree.SubElement(case, "skipped", message=_xml(outcome.untried))
        if not outcome.passed:
            failure = ElementTree.SubElement(case, "failure", message=_xml(complaint(outcome)))
            failure.text = _xml("\n".join(outcome.log))
    if not report.findings:
        ElementTree.SubElement(
            suite, "testcase", classname=f"{report.name}.exploration", name="schedules"
        )
    for finding in report.findings:
        case = ElementTree.SubElement(
            suite,
            "testcase",
            classname=f"{report.name}.exploration",
            name=finding.title,
        )
        failure = ElementTree.SubElement(case, "failure", message=_xml(finding.detail))
        failure.text = _xml("\n".join((finding.plan, *finding.log)))
    root = ElementTree.Element("testsuites")
    root.append(suite)
    ElementTree.indent(root)
    path.write_bytes(ElementTree.tostring(root, encoding="utf-8", xml_declaration=True) + b"\n")


def write_html(report: SuiteResult, path: Path) -> None:
    """Write one HTML page with all results.

    It holds verdict, versions, a searchable table for each group, plots of commanded and executed
    joints, and logs of failures.
    """
    verdict = "passed" if report.passed else "failed"
    groups = dict.fromkeys(outcome.group for outcome in report.outcomes)
    tables = "".join(
        _group(name, [o for o in report.outcomes if o.group == name]) for name in groups
    )
    details = "".join(_details(o) for o in report.outcomes if o.series or not o.passed)
    findings = "".join(
        f"<h3>{f.title}</h3><p>{html.escape(f.detail)}</p>"
        f"<pre>{html.escape(chr(10).join((f.plan, *f.log)))}</pre>"
        for f in report.findings
    )
    path.write_text(
        f"""<!doctype html>
<html lang="en"><meta charset="utf-8"><title>{html.escape(report.name)}</title>
<style>{_STYLE}</style>
<h1>{html.escape(report.name)}: {verdict}</h1>
<p>BUILD_ID {html.escape(report.build_id)} · {len(report.tried)} cases ·
{report.schedules} schedules explored · {report.programs} programs compared with RAPID ·
tested on the virtual controller only.</p>
<p>{html.escape(_versions())}</p>
{_coverage(report)}
{_pairs(report)}
<p><input id="search" type="search" placeholder="search cases" aria-label="search cases"></p>
{tables}
{"<h2>Schedules and programs that did not hold</h2>" + findings if findings else ""}
{details}
<script>{_SEARCH}</script>
</html>
""",
        encoding="utf-8",
    )


def _versions() -> str:
    when = datetime.now(timezone.utc).isoformat(" ", "minutes")
    return f"rapidgen {__version__} · Python {platform.python_version()} · {when}"


def _group(name: str, outcomes: Sequence[CaseResult]) -> str:
    """Return the cases of a group, expanded if one failed."""
    tried = [outcome for outcome in outcomes if not outcome.untried]
    held = sum(outcome.passed for outcome in tried)
    marker, state = ("ok", "") if held == len(tried) else ("bad", " open")
    simulated = sum(outcome.simulated for outcome in outcomes)
    return (
        f'<details class="group"{state}><summary>{html.escape(name)}: '
        f'<span class="{marker}">{held} '
        f"of {len(tried)} held</span>, {simulated:.0f} s simulated</summary>\n"
        "<table><tr><th>case<th>what must hold<th>answers<th>simulated<th>verdict</tr>\n"
        f"{''.join(map(_row, outcomes))}</table></details>\n"
    )


def slowest(report: SuiteResult, count: int) -> list[tuple[str, float, int]]:
    """Return the slowest cases: name, CPU s over all settings, settings."""
    accepted: dict[str, list[float]] = {}
    for outcome in report.outcomes:
        accepted.setdefault(outcome.case, []).append(outcome.elapsed)
    rows = sorted(((sum(s), case, len(s)) for case, s in accepted.items()), reverse=True)
    return [(case, seconds, times) for seconds, case, times in rows[:count]]


def untried(report: SuiteResult) -> str:
    """Return how many cases do not apply and why, or an empty text."""
    cases = {outcome.case for outcome in report.tried}
    why = {o.case: o.untried for o in report.outcomes if o.case not in cases}
    reasons = Counter(why.values()).most_common()
    return "; ".join(f"{reason} ({count})" for reason, count in reasons)


def _coverage(report: SuiteResult) -> str:
    reached, of = report.covered
    if not of:
        return ""
    rows = "".join(f"<li>{html.escape(path)}: {lines}</li>" for path, lines in missed(report))
    return f"<p>RAPID lines that the cases reached: {reached} of {of}, {reached / of:.1%}.</p>" + (
        f"<details><summary>lines that none did</summary><ul>{rows}</ul></details>" if rows else ""
    )


def met(report: SuiteResult) -> str:
    """Describe how many statement pairs the schedules covered.

    The text says if the last schedules still found new pairs.
    """
    if not report.curve:
        return ""
    late = sum(1 for number, _ in report.curve if number > 0.9 * report.schedules)
    at, pairs = report.curve[-1]
    return (
        f"{pairs} pairs of statements of two tasks met in {report.schedules} schedules, the last "
        f"new one in schedule {at}; {late} of the last tenth brought new ones"
    )


def _pairs(report: SuiteResult) -> str:
    """Draw covered pairs over schedules."""
    if len(report.curve) < 2:
        return ""
    times = tuple(float(number) for number, _ in report.curve)
    values = tuple((float(pairs),) for _, pairs in report.curve)
    return f"<p>{met(report)}.</p>" + _drawn((Series("pairs", times, values),))


def missed(report: SuiteResult) -> list[tuple[str, str]]:
    """Return the unreached lines by file, as `12, 15-17`."""
    failures = []
    for path, lines in report.lines.items():
        # Lines without a statement do not split a range.
        ranges: list[list[int]] = []
        open_range = False
        for line in sorted(lines):
            if lines[line]:
                open_range = False
            elif open_range:
                ranges[-1][1] = line
            else:
                ranges.append([line, line])
                open_range = True
        if ranges:
            texts = [f"{a}" if a == b else f"{a}-{b}" for a, b in ranges]
            failures.append((path, ", ".join(texts)))
    return failures


def _name(outcome: CaseResult) -> str:
    return outcome.case + (f" [{outcome.setting}]" if outcome.setting else "")


def complaint(outcome: CaseResult) -> str:
    """Return the failure and the smallest set of assumptions that causes it."""
    reply = f", that is {' and '.join(outcome.blamed)}" if outcome.blamed else ""
    setting = f" [{outcome.setting}{reply}]" if outcome.setting else ""
    return f"{outcome.case}{setting}: {outcome.detail}"


def _xml(text: str) -> str:
    return "".join(c if c >= " " or c in "\n\t" else "?" for c in text)


def _row(outcome: CaseResult) -> str:
    verdict = '<td class="ok">ok' if outcome.passed else '<td class="bad">failed'
    if outcome.untried:
        verdict = f"<td>not applicable: {html.escape(outcome.untried)}"
    return (
        f"<tr><td>{html.escape(_name(outcome))}<td>{html.escape(outcome.title)}"
        f"<td>{html.escape(outcome.answers)}<td>{outcome.simulated:.2f} s{verdict}</tr>\n"
    )


def _details(outcome: CaseResult) -> str:
    text = f"<h2>{html.escape(_name(outcome))}</h2><p>{html.escape(complaint(outcome))}</p>"
    if outcome.series:
        text += _plot(outcome.series)
    if not outcome.passed and outcome.log:
        text += f"<pre>{html.escape(chr(10).join(outcome.log))}</pre>"
    return text


def series(bench: "Bench") -> tuple[Series, ...]:
    """Return executed and commanded joints for a plot.

    The result is empty if the robot did not move. A download is drawn from the start of its motion.
    """
    track, commanded = bench.track, bench.commanded
    if len(track) < 2:
        return ()
    displayed = [*track[:: max(1, len(track) // PLOTTED)], track[-1]]
    failures = [Series("executed", tuple(t for t, _ in displayed), tuple(p for _, p in displayed))]
    for number, (sent, points) in enumerate(commanded):
        over = commanded[number + 1][0] if number + 1 < len(commanded) else bench.now
        started = [t for t, _ in track if sent < t <= over]
        if not started:
            continue
        times, at = [], started[0]
        for index, (_, duration) in enumerate(points):
            at += duration if index else 0.0
            times.append(at)
        step = max(1, len(points) // PLOTTED)
        rows = tuple(joints for joints, _ in points[::step])
        failures.append(Series("commanded", tuple(times[::step]), rows))
    return tuple(failures)


def _plot(series: tuple[Series, ...]) -> str:
    drawing = _drawn(series)
    values = [v for s in series for row in s.values for v in row]
    times = [t for s in series for t in s.times]
    return drawing and (
        f"{drawing}<p>solid: executed, dashed: commanded; one colour a joint; {min(values):.3f} "
        f"to {max(values):.3f} rad (m) over {max(times) - min(times):.2f} s</p>"
    )


def _drawn(series: tuple[Series, ...], width: int = 900, height: int = 260) -> str:
    times = [t for s in series for t in s.times]
    values = [v for s in series for row in s.values for v in row]
    if not values or max(times) <= min(times):
        return ""
    left, low = min(times), min(values)
    across, up = max(times) - left, (max(values) - low) or 1.0
    lines = []
    for one in series:
        dash = ' stroke-dasharray="5 4"' if one.label == "commanded" else ""
        for joint in range(len(one.values[0]) if one.values else 0):
            points = " ".join(
                f"{(t - left) / across * width:.1f},{height - (row[joint] - low) / up * height:.1f}"
                for t, row in zip(one.times, one.values, strict=True)
            )
            colour = _COLOURS[joint % len(_COLOURS)]
            lines.append(f'<polyline fill="none" stroke="{colour}"{dash} points="{points}"/>')
    return (
        f'<svg viewBox="0 0 {width} {height}" width="{width}" height="{height}">'
        f"{''.join(lines)}</svg>"
    )
