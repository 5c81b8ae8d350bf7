"""The cycle-time report as one self-contained HTML file, for light and dark displays.

Texts of a program's author are text here, never markup.
"""

from collections.abc import Iterable, Mapping, Sequence
from html import escape

from rapidgen.controller.cycle_report import (
    CycleReport,
    Difference,
    EarlierRobot,
    MoveRow,
    RobotReport,
    differences,
)
from rapidgen.motion import active_limits

_MOST_MOVES = 2000
"""Moves in the table of the page; the JSON report has all of them."""
_MOST_BARS = 4000
"""Bars of the timeline; shorter moves share one."""
_SHOWN = 0.0005
"""s below which a time is displayed as 0."""
_WIDTH, _HEIGHT = 1000, 34
_KINDS = {
    active_limits.PROGRAMMED: "speed",
    active_limits.ORIENTATION: "speed",
    active_limits.EXTERNAL: "speed",
    active_limits.TIME: "speed",
    active_limits.CORNER: "corner",
    active_limits.FINE_POINT: "fine",
    active_limits.LATE: "late",
    active_limits.NO_CORNER: "late",
    active_limits.OVERRIDE: "other",
    active_limits.TCP_LIMIT: "other",
    active_limits.STOP: "other",
    active_limits.RETURN: "other",
    active_limits.GUIDED: "other",
    active_limits.PATH_ACCELERATION: "other",
    active_limits.WORLD_ACCELERATION: "other",
}
"""Colours of limits; those of axes have two, all others are waits."""
_STYLE = """
:root{color-scheme:light dark;--back:#fff;--text:#1d2129;--dim:#5b6472;--line:#d5d9e0;
--stripe:#f5f6f8;--speed:#3b76c4;--axis:#8356b5;--acceleration:#cf7a1c;--corner:#2a9487;
--fine:#c2a400;--late:#c43c3c;--other:#7a5c45;--wait:#a9b0bb}
@media(prefers-color-scheme:dark){:root{--back:#16191f;--text:#e4e7ec;--dim:#9aa4b2;--line:#363c47;
--stripe:#1d2129;--speed:#6a9fe6;--axis:#ac86d8;--acceleration:#e69a45;--corner:#4fb9ab;
--fine:#d9bd2c;--late:#e56b6b;--other:#b3917a;--wait:#5b6472}}
body{font:14px/1.45 system-ui,sans-serif;background:var(--back);color:var(--text);margin:1.5em auto;
max-width:76em;padding:0 1em}
h1{font-size:1.4em;margin:0 0 .2em}h2{font-size:1.15em;margin:1.6em 0 .3em}
h3{font-size:1em;margin:1.3em 0 .3em}
p{margin:.3em 0}.dim{color:var(--dim)}.total{font-size:1.9em;font-weight:600}
.total small{font-weight:400;font-size:.6em}
table{border-collapse:collapse}td,th{padding:.2em .6em;text-align:left;vertical-align:top}
th{border-bottom:1px solid var(--line);font-weight:600}
tr:nth-child(odd) td{background:var(--stripe)}
.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
code{font:12.5px/1.4 ui-monospace,monospace;overflow-wrap:anywhere}
.wide{overflow-x:auto;margin-bottom:.8em}.bar{display:flex;height:1.3em;width:100%;margin:.4em 0}
.bar span{height:100%;box-shadow:inset -1px 0 var(--back)}
.small{display:flex;height:.8em;min-width:7em;margin-top:.3em}
i.c{display:inline-block;width:.8em;height:.8em;margin-right:.45em;vertical-align:-.05em}
svg{display:block;width:100%;height:auto;margin:.4em 0}
svg text{fill:var(--dim);font:11px system-ui,sans-serif}
.speed{background:var(--speed);fill:var(--speed)}.axis{background:var(--axis);fill:var(--axis)}
.acceleration{background:var(--acceleration);fill:var(--acceleration)}
.corner{background:var(--corner);fill:var(--corner)}.fine{background:var(--fine);fill:var(--fine)}
.late{background:var(--late);fill:var(--late)}.other{background:var(--other);fill:var(--other)}
.wait{background:var(--wait);fill:var(--wait)}
.slower{color:var(--late)}.faster{color:var(--corner)}summary{cursor:pointer;margin:.6em 0}
"""


def cycle_page(report: CycleReport, earlier: Sequence[EarlierRobot] = (), name: str = "") -> str:
    """Return the page; with `earlier`, the report of the file `name`, also the differences."""
    title = f"Cycle time of {report.system}"
    before = {robot.group: robot for robot in earlier}
    parts = [
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width">',
        f"<title>{escape(title)}</title><style>{_STYLE}</style></head><body>",
        f"<h1>{escape(title)}</h1>",
    ]
    for robot in report.robots:
        if len(report.robots) > 1:
            parts.append(f"<h2>{escape(robot.group)}</h2>")
        parts += _robot(robot, before.get(robot.group), name)
    parts.append("</body></html>")
    return "\n".join(parts) + "\n"


def limit_kind(limit: str) -> str:
    """Return the class of a limit: its colour."""
    if limit.startswith("acceleration of "):
        return "acceleration"
    return "axis" if limit.startswith("speed of ax") else _KINDS.get(limit, "wait")


def _robot(robot: RobotReport, before: EarlierRobot | None, name: str) -> Iterable[str]:
    estimated = "estimated, " if robot.accelerations == "estimated" else ""
    yield (
        f'<p class="total">{robot.seconds:.3f} s <small class="dim">({estimated}'
        f"±{100 * robot.error:.0f} %)</small></p>"
    )
    model = f"{robot.model}, " if robot.model else ""
    yield (
        f"<p>{escape(model)}{len(robot.moves)} moves: {robot.moving:.3f} s of movement,"
        f" {robot.waiting:.3f} s of standing.</p>"
    )
    yield f'<p class="dim">Accelerations are {robot.accelerations}: {escape(robot.note)}.</p>'
    if before is not None:
        yield from _comparison(robot, before, name)
    yield "<h3>What limits the time</h3>"
    yield _bar(robot.limits, robot.seconds, "bar")
    yield _table(
        ("limit", "s", "%"),
        (
            (_limit(limit), _n(f"{s:.3f}"), _n(f"{_percent(s, robot.seconds):.1f}"))
            for limit, s in _few(robot.limits, robot.seconds).items()
        ),
    )
    yield "<h3>Over time</h3>"
    yield _timeline(robot)
    yield "<h3>By routine</h3>"
    yield '<p class="dim">Without the routines that a routine calls.</p>'
    yield _table(
        ("routine", "moves", "s", "moving", "waiting", "limits", "longest limit"),
        (
            (
                _routine(row.module, row.routine),
                _n(row.moves),
                _n(f"{row.seconds:.3f}"),
                _n(f"{row.moving:.3f}"),
                _n(f"{row.waiting:.3f}"),
                f"<td>{_bar(row.limits, row.seconds, 'small')}</td>",
                _limit(row.limit),
            )
            for row in robot.routines
        ),
    )
    yield "<h3>By line</h3>"
    yield _table(
        ("line", "", "moves", "s", "waiting", "mean mm/s", "max. mm/s", "limits", "longest limit"),
        (
            (
                _place(row.module, row.routine, row.line),
                f"<td><code>{escape(row.text)}</code></td>",
                _n(row.moves or ""),
                _n(f"{row.seconds:.3f}"),
                _n(f"{row.waiting:.3f}" if row.waiting else ""),
                _n(f"{row.mean_speed:.0f}" if row.moves else ""),
                _n(f"{row.max_speed:.0f}" if row.moves else ""),
                f"<td>{_bar(row.limits, row.seconds, 'small')}</td>",
                _limit(row.limit),
            )
            for row in robot.lines
            if row.moves or row.seconds >= _SHOWN
        ),
    )
    yield from _moves(robot.moves)


def _few(limits: Mapping[str, float], whole: float) -> dict[str, float]:
    """Return limits with at least 0.1 % of the time each, and the sum of all others."""
    result = {name: s for name, s in limits.items() if s * 1000 >= whole}
    others = sum(limits.values()) - sum(result.values())
    return {**result, "others": others} if len(result) < len(limits) else result


def _moves(moves: Sequence[MoveRow]) -> Iterable[str]:
    yield f"<details><summary>All moves ({len(moves)})</summary>"
    if len(moves) > _MOST_MOVES:
        yield f'<p class="dim">The first {_MOST_MOVES}; a report in JSON has all of them.</p>'
    yield _table(
        (
            "start s",
            "line",
            "",
            "s",
            "mm",
            "mean mm/s",
            "max. mm/s",
            "zone",
            "longest limit",
            "stop",
        ),
        (
            (
                _n(f"{move.start:.3f}"),
                _place(move.module, move.routine, move.line),
                f"<td><code>{escape(move.text)}</code></td>",
                _n(f"{move.seconds:.3f}"),
                _n(f"{move.length:.1f}"),
                _n(f"{move.mean_speed:.0f}"),
                _n(f"{move.max_speed:.0f}"),
                f"<td>{escape(str(move.zone))}</td>",
                _limit(move.limit),
                f"<td>{escape(move.stop)}</td>",
            )
            for move in moves[:_MOST_MOVES]
        ),
    )
    yield "</details>"


# -- comparison -------------------------------------------------------------------------------


def _comparison(robot: RobotReport, before: EarlierRobot, name: str) -> Iterable[str]:
    yield f"<h3>Compared with {escape(name)}</h3>"
    totals = (
        ("all", before.seconds, robot.seconds),
        ("movement", before.moving, robot.moving),
        ("standing", before.waiting, robot.waiting),
    )
    limits = dict.fromkeys([*robot.limits, *before.limits])
    rows = [(limit, before.limits.get(limit), robot.limits.get(limit)) for limit in limits]
    yield _table(
        ("total", "before s", "now s", "change s", "%"),
        ((f"<td>{what}</td>", *_values(old, new)) for what, old, new in totals),
    )
    yield _table(
        ("limit", "before s", "now s", "change s", "%"),
        ((_limit(limit), *_values(old, new)) for limit, old, new in rows),
    )
    changed = [row for row in differences(before, robot) if abs(row.change) >= _SHOWN]
    if not changed:
        yield "<p>No line has another duration.</p>"
        return
    yield _table(
        ("line", "", "before s", "now s", "change s", "%"),
        (
            (*_two_lines(row), *_values(*(k[1] if k else None for k in (row.before, row.after))))
            for row in changed
        ),
    )


def _two_lines(row: Difference) -> tuple[str, str]:
    """Return cells of the place and of the text, which may have changed."""
    lines = [known[0] for known in (row.before, row.after) if known is not None]
    texts = dict.fromkeys(line.text for line in lines)
    codes = "<br>→ ".join(f"<code>{escape(text)}</code>" for text in texts)
    last = lines[-1]
    return _place(last.module, last.routine, last.line), f"<td>{codes}</td>"


def _values(before: float | None, after: float | None) -> tuple[str, str, str, str]:
    change = (after or 0.0) - (before or 0.0)
    kind = "slower" if change > _SHOWN else "faster" if change < -_SHOWN else "dim"
    share = f"{100 * change / before:+.1f}" if before else ""
    return (
        _n("" if before is None else f"{before:.3f}"),
        _n("" if after is None else f"{after:.3f}"),
        f'<td class="n {kind}">{change:+.3f}</td>',
        _n(share),
    )


def summary(report: CycleReport, earlier: Sequence[EarlierRobot]) -> str:
    """Return the totals of a comparison as text, a line for each robot."""
    before = {robot.group: robot for robot in earlier}
    lines = []
    for robot in report.robots:
        old = before.get(robot.group)
        if old is not None:
            change = robot.seconds - old.seconds
            share = f" ({100 * change / old.seconds:+.1f} %)" if old.seconds else ""
            lines.append(
                f"{robot.group}: {old.seconds:.3f} s before, {robot.seconds:.3f} s now,"
                f" {change:+.3f} s{share}\n"
            )
    return "".join(lines)


# -- elements ---------------------------------------------------------------------------------


def _timeline(robot: RobotReport) -> str:
    """Return bars of moves in the colour of their longest limit, and of standstills."""
    begin = robot.standing[0][0] if robot.standing else 0.0
    if robot.moves:
        begin = min(begin, robot.moves[0].start) if robot.standing else robot.moves[0].start
    spans = [(move.start, move.end, limit_kind(move.limit)) for move in robot.moves]
    spans += [(low, high, "wait") for low, high in robot.standing]
    end = max((high for _, high, _ in spans), default=0.0)
    if end <= begin:
        return '<p class="dim">The robot did not move.</p>'
    scale = _WIDTH / (end - begin)
    bars = []
    drawn = begin
    for low, high, kind in sorted(spans):
        if (high - max(low, drawn)) * _MOST_BARS < end - begin:
            continue
        x = (low - begin) * scale
        bars.append(
            f'<rect class="{kind}" x="{x:.2f}" y="0" width="{(high - low) * scale:.2f}"'
            f' height="{_HEIGHT - 14}"><title>{low:.3f} to {high:.3f} s</title></rect>'
        )
        drawn = high
    marks = [
        f'<text x="{k * _WIDTH / 4:.0f}" y="{_HEIGHT - 2}" text-anchor="{anchor}">'
        f"{begin + k * (end - begin) / 4:.2f} s</text>"
        for k, anchor in enumerate(("start", "middle", "middle", "middle", "end"))
    ]
    return (
        f'<svg viewBox="0 0 {_WIDTH} {_HEIGHT}" role="img" aria-label="limits over time">'
        f"{''.join(bars)}{''.join(marks)}</svg>"
    )


def _bar(limits: Mapping[str, float], whole: float, kind: str) -> str:
    parts = [
        f'<span class="{limit_kind(limit)}" style="width:{_percent(s, whole):.2f}%"'
        f' title="{escape(limit)}: {s:.3f} s"></span>'
        for limit, s in limits.items()
        if _percent(s, whole) >= 0.05
    ]
    return f'<div class="{kind}">{"".join(parts)}</div>'


def _table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    cells = "".join(f'<th class="{"n" if _is_number(head) else ""}">{head}</th>' for head in heads)
    body = "\n".join(f"<tr>{''.join(row)}</tr>" for row in rows)
    return f'<div class="wide"><table><tr>{cells}</tr>\n{body}</table></div>'


def _is_number(head: str) -> bool:
    return head.endswith((" s", "mm", "mm/s")) or head in ("s", "%", "moves", "moving", "waiting")


def _n(value: object) -> str:
    return f'<td class="n">{value}</td>'


def _limit(limit: str) -> str:
    colour = f'<i class="c {limit_kind(limit)}"></i>' if limit else ""
    return f"<td>{colour}{escape(limit)}</td>"


def _place(module: str, routine: str, line: int) -> str:
    return f"<td>{escape(f'{module}/{routine}:{line}') if line else ''}</td>"


def _routine(module: str, routine: str) -> str:
    return f"<td>{escape(f'{module}/{routine}') if routine else 'before the program'}</td>"


def _percent(seconds: float, whole: float) -> float:
    return 100 * seconds / whole if whole > 0.0 else 0.0
