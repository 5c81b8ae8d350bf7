"""A plan and a fleet's table as text."""

import difflib
from collections import Counter
from collections.abc import Sequence
from itertools import groupby

from rapidgen._json import Members
from rapidgen.deploy.cfg import CfgChange
from rapidgen.deploy.config_diff import changed_keys
from rapidgen.deploy.fleet import TargetOutcome
from rapidgen.deploy.online.plan import BY_SERVICES
from rapidgen.deploy.plan import FileChange, Plan, lines_of
from rapidgen.diagnostics import as_data

_SIGNS = {
    "add": "+",
    "change": "~",
    "same": "=",
    "remove": "-",
    "restore": "<",
    "use": "=",
    "leave": "=",
    "clash": "x",
}

_ACTION_TEXTS = {
    "add": "new, {size}",
    "same": "same",
    "remove": "were deployed by rapidgen, no longer belong there",
    "restore": "restores the state before the first deployment",
}


def plan_text(plan: Plan) -> str:
    """Return the plan in lines.

    Files, cfg instances, manual steps (`!`), unknowns (`?`).
    """
    ware = f"RobotWare {plan.robotware[0]}.{plan.robotware[1]:02d}" if plan.wanted else "uninstall"
    build = f", build {plan.build_id}" if plan.build_id else ""
    where = f": {plan.live.shown}" if plan.live else ""
    out = [f"{plan.name or 'driver'} ({ware}{build})  via {plan.target}{where}"]
    if plan.interrupted:
        out.append(f"  * {plan.interrupted}: this run repairs it")
    if plan.damaged:
        in_use = "the newest backup's" if plan.had and plan.had.history else "no backup's"
        out.append(f"  ? {plan.damaged}: {in_use} is assumed  -> needs --overwrite")
    out += _changed_keys(plan)
    out += _file_lines(plan)
    for change in plan.conflicts:
        out.append(f"  ? {change.shown}: {change.doubt}  -> needs --overwrite")
    if plan.neighbour is not None:
        out += [f"  x {n.domain}: {n.shown}: another driver's" for n in plan.neighbour.instances]
        out += [f"  x HOME:/{path}: another driver's, stays" for path in plan.neighbour.files]
    out += [f"  x {path}: would be restored in the place of ours" for path in plan.in_memory]
    for domain in sorted({c.domain for c in plan.cfg}):
        out += _cfg_lines(plan, domain)
    if plan.is_pending:
        out.append("  * everything is loaded, and counts after a restart: restart pending")
    elif plan.live is not None and plan.live.orphans:
        names = ", ".join(plan.live.orphans)
        out.append(f"  * cfg no longer has {names}, there until a restart: restart pending")
    for step in plan.steps:
        stop = " (stops motion)" if step.stops_motion else ""
        if step.who == BY_SERVICES:
            out.append(f"  > {step.what}")
        else:
            out.append(f"  ! {step.who}: {step.what}{stop}")
    if not plan.steps and not plan.is_empty:
        out.append("  = no restart: no module and no loaded file changes")
    if plan.live is None or not plan.files_match:
        out.append(f"  ? switching: {plan.rename}")
    out += [f"  ? {line}" for line in plan.unseen]
    out.append(_summary(plan))
    return "\n".join(out) + "\n"


def plans_text(plans: Sequence[Plan], *, diff: bool = False) -> str:
    """Return all plans: common parts once, then one line a controller."""
    alike: dict[tuple[str, str], list[Plan]] = {}
    for plan in plans:
        body = plan_text(plan).partition("\n")[2] + (diff_text(plan) if diff else "")
        alike.setdefault((f"{plan.name} {plan.build_id}", body), []).append(plan)
    out = []
    for (_, body), (first, *more) in alike.items():
        head = plan_text(first).partition("\n")[0]
        if more:
            head += f" and {len(more)} more controller{'s' * (len(more) > 1)}, alike"
        out.append(f"{head}\n{body}")
    if len(plans) > 1:
        width = max(len(plan.target) for plan in plans)
        rows = (f"  {p.target:<{width}}  {_summary(p).removeprefix('Plan: ')}\n" for p in plans)
        out.append(f"{len(plans)} controllers:\n{''.join(rows)}")
    return "\n".join(out)


def diff_text(plan: Plan) -> str:
    """Return a unified diff of all text files, including new and deleted ones."""
    out: list[str] = []
    for change in plan.changes:
        if change.action == "same" or _is_new_id(plan, change):
            continue
        before, after = lines_of(change.before), lines_of(change.after)
        current = change.shown if change.before is not None else "/dev/null"
        there = change.shown if change.after is not None else "/dev/null"
        out += difflib.unified_diff(before, after, current, there, lineterm="")
    return "".join(f"{line}\n" for line in out)


def table(outcomes: Sequence[TargetOutcome]) -> str:
    """Return a table with one line a controller."""
    width = max(len(o.target.shown) for o in outcomes)
    return "".join(f"{o.target.shown:<{width}}  {o.word:<8}  {o.detail}\n" for o in outcomes)


def outcomes_json(outcomes: Sequence[TargetOutcome]) -> Members:
    """Return the results of the controllers as data, with all errors."""
    return {
        "controllers": [
            {
                "target": one.target.shown,
                "result": one.word,
                "detail": one.detail,
                "errors": as_data(one.error.diagnostics if one.error else ()),
            }
            for one in outcomes
        ],
        "errors": as_data(d for one in outcomes if one.error for d in one.error.diagnostics),
    }


def size_text(size: int) -> str:
    """Format a number of bytes for people."""
    return f"{size} B" if size < 1000 else f"{size / 1000:.1f} kB"


def _changed_keys(plan: Plan) -> list[str]:
    """Return the differences to the configuration of the last deployment."""
    if plan.had is None or plan.wanted is None:
        return []
    old = plan.had.generated.get("configuration")
    new = plan.wanted.generated.get("configuration")
    return [f"  ~ {line}" for line in changed_keys(old, new)] if old else []


def _file_lines(plan: Plan) -> list[str]:
    """Return lines of files, grouped by folder and action."""
    width = max((len(c.shown) for c in plan.changes), default=0)

    def alike(change: FileChange) -> tuple[str, str]:
        if change.conflict or change.foreign or change.kind == "syspar":
            return "", ""
        folder = change.shown.rpartition("/")[0]
        if change.action != "change":
            return folder, _ACTION_TEXTS[change.action]
        return (folder, "only the build's id") if _is_new_id(plan, change) else ("", "")

    together: dict[tuple[str, str], list[FileChange]] = {}
    for change in plan.changes:
        folder, message = alike(change)
        together.setdefault((folder, message) if message else (change.path, ""), []).append(change)
    out = []
    for (folder, message), changes in together.items():
        sign = _SIGNS[changes[0].action]
        if message and len(changes) > 1:
            size = sum(len(c.after or b"") for c in changes)
            text = message.format(size=size_text(size))
            out.append(f"  {sign} {folder}: {len(changes)} files, {text}")
        else:
            out += [f"  {_SIGNS[c.action]} {c.shown:<{width}}  {_words(c)}" for c in changes]
    return out


def _is_new_id(plan: Plan, change: FileChange) -> bool:
    """True if only the id of the build differs."""
    if plan.had is None or change.before is None:
        return False
    return change.before.replace(plan.had.build_id.encode(), plan.build_id.encode()) == change.after


def _words(change: FileChange) -> str:
    if change.action == "add":
        return f"new, {size_text(len(change.after or b''))}"
    if change.action == "remove":
        return "was deployed by rapidgen, no longer belongs there"
    if change.action == "restore":
        return "restores the state before the first deployment"
    if change.action == "same":
        return "same, not created by rapidgen" if change.foreign else "same"
    added, removed = change.counts()
    return f"+{added} -{removed}"


def _cfg_lines(plan: Plan, domain: str) -> list[str]:
    changes = [c for c in plan.cfg if c.domain == domain]
    out = []
    text = [c for c in changes if c.action != "same"]
    for _, group in groupby(text, _line_key):
        first, *more = group
        names = [c.key.partition(" ")[2] for c in (first, *more)]
        displayed = f"{_first(names)}{f': {note}' if (note := _note(first)) else ''}"
        out.append(f"  {_SIGNS[first.action]} {domain}: {first.key.partition(' ')[0]} {displayed}")
    same = sum(1 for c in changes if c.action == "same")
    if same:
        seen = "" if plan.cfg_present else " as last deployed"
        out.append(f"  = {domain}: {same} instances{seen}")
    return out


def _line_key(change: CfgChange) -> str:
    """Return the key by which instances share a line.

    New and deleted ones share a line by section, others never.
    """
    alone = change.action not in ("add", "remove") or change.note
    return change.key if alone else f"{change.action} {change.key.partition(' ')[0]}"


def _first(names: Sequence[str]) -> str:
    """Return the first names of a line, and the number of further ones."""
    displayed = [
        name for n, name in enumerate(names) if n == 0 or len(", ".join(names[: n + 1])) < 70
    ]
    return ", ".join(displayed) + (
        f" and {len(names) - len(displayed)} more" * (len(names) > len(displayed))
    )


def _note(change: CfgChange) -> str:
    if change.action == "restore":
        return "gets back what it had before the first deployment"
    if change.action == "leave":
        return "the controller's own, no longer in our files"
    return change.note


def _summary(plan: Plan) -> str:
    if plan.is_empty:
        return "Plan: nothing to do."
    if plan.files_match:
        return f"Plan: no file; {'a restart' if plan.is_pending else 'the steps above'}."
    counts = Counter(c.action for c in plan.changes)
    text = [
        f"{counts['add']} to add",
        f"{counts['change']} to change",
        f"{counts['remove']} to remove",
    ]
    if counts["restore"]:
        text.append(f"{counts['restore']} to restore")
    if plan.conflicts:
        text.append(f"{len(plan.conflicts)} conflict{'s' if len(plan.conflicts) > 1 else ''}")
    return f"Plan: {', '.join(text)}."
