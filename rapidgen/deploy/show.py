"""A plan and a fleet's table as text."""

from collections import Counter
from collections.abc import Sequence

from rapidgen.deploy.cfg import CfgChange
from rapidgen.deploy.fleet import TargetOutcome
from rapidgen.deploy.live.plan import BY_SERVICES
from rapidgen.deploy.plan import FileChange, Plan

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


def plan_text(plan: Plan) -> str:
    """The plan in lines: files, cfg instances, what people do (`!`), what is not seen (`?`)."""
    ware = f"RobotWare {plan.robotware[0]}.{plan.robotware[1]:02d}" if plan.wanted else "uninstall"
    build = f", build {plan.build_id}" if plan.build_id else ""
    where = f": {plan.live.shown}" if plan.live else ""
    out = [f"{plan.name or 'driver'} ({ware}{build})  via {plan.target}{where}"]
    if plan.interrupted:
        out.append(f"  * {plan.interrupted}: this run puts it right")
    if plan.damaged:
        taken = "the newest backup's" if plan.had and plan.had.history else "no backup's"
        out.append(f"  ? {plan.damaged}: {taken} is taken  -> needs --overwrite")
    shown = [(c.shown, c) for c in plan.changes]
    width = max((len(name) for name, _ in shown), default=0)
    out += [f"  {_SIGNS[c.action]} {name:<{width}}  {_words(c)}" for name, c in shown]
    for change in plan.conflicts:
        what = (
            f"edited by hand since the last deployment{': ' + change.note if change.note else ''}"
            if change.conflict == "edited"
            else "not put there by rapidgen"
        )
        out.append(f"  ? {change.shown}: {what}  -> needs --overwrite")
    if plan.neighbour is not None:
        out += [f"  x {n.domain}: {n.shown}: another driver's" for n in plan.neighbour.instances]
        out += [f"  x HOME:/{path}: another driver's, stays" for path in plan.neighbour.files]
    out += [f"  x {path}: would be restored in the place of ours" for path in plan.in_memory]
    for domain in sorted({c.domain for c in plan.cfg}):
        out += _cfg_lines(plan, domain)
    if plan.is_pending:
        out.append("  * everything is loaded, and counts after a restart: restart pending")
    for step in plan.steps:
        stop = " (stops motion)" if step.stops_motion else ""
        if step.who == BY_SERVICES:
            out.append(f"  > {step.what}")
        else:
            out.append(f"  ! {step.who}: {step.what}{stop}")
    if not plan.steps and not plan.is_empty:
        out.append("  = no restart: no module and nothing that is loaded changes")
    out.append(f"  ? switching: {plan.rename}")
    out += [f"  ? {line}" for line in plan.unseen]
    out.append(_summary(plan))
    return "\n".join(out) + "\n"


def table(outcomes: Sequence[TargetOutcome]) -> str:
    """One line a controller."""
    width = max(len(o.target.shown) for o in outcomes)
    return "".join(f"{o.target.shown:<{width}}  {o.word:<8}  {o.detail}\n" for o in outcomes)


def size_text(size: int) -> str:
    """Bytes as people read them."""
    return f"{size} B" if size < 1000 else f"{size / 1000:.1f} kB"


def _words(change: FileChange) -> str:
    if change.action == "add":
        return f"new, {size_text(len(change.after or b''))}"
    if change.action == "remove":
        return "was deployed by rapidgen, no longer belongs there"
    if change.action == "restore":
        return "what was there before the first deployment comes back"
    if change.action == "same":
        return "same, not put there by rapidgen" if change.foreign else "same"
    added, removed = change.counts()
    return f"+{added} -{removed}"


def _cfg_lines(plan: Plan, domain: str) -> list[str]:
    changes = [c for c in plan.cfg if c.domain == domain]
    out = [
        f"  {_SIGNS[c.action]} {domain}: {c.key}{f': {note}' if (note := _note(c)) else ''}"
        for c in changes
        if c.action != "same"
    ]
    same = sum(1 for c in changes if c.action == "same")
    if same:
        seen = "" if plan.cfg_present else " as last deployed"
        out.append(f"  = {domain}: {same} instances{seen}")
    return out


def _note(change: CfgChange) -> str:
    if change.action == "restore":
        return "gets back what it had before the first deployment"
    if change.action == "leave":
        return "the controller's own, no longer in our files"
    return change.note


def _summary(plan: Plan) -> str:
    if plan.is_empty:
        return "Plan: nothing to do."
    counts = Counter(c.action for c in plan.changes)
    words = [
        f"{counts['add']} to add",
        f"{counts['change']} to change",
        f"{counts['remove']} to remove",
    ]
    if counts["restore"]:
        words.append(f"{counts['restore']} to restore")
    if plan.conflicts:
        words.append(f"{len(plan.conflicts)} conflict{'s' if len(plan.conflicts) > 1 else ''}")
    return f"Plan: {', '.join(words)}."
