"""What files alone do not do: loading parameters, restarts, and who does it where.

Which restart makes a task read its modules again follows the task's type: a SEMISTATIC task
starts from the beginning at every restart and reads its modules then [manual]; a STATIC one goes
on where it was and needs its program reset; modules of NORMAL tasks that CAB_TASK_MODULES names
are loaded at a restart when the file is newer ([mem]). Nothing here restarts anything.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from rapidgen.deploy.cfg import CfgChange, keyed
from rapidgen.deploy.driverset import STATE
from rapidgen.system import CfgText

OPTIONAL = ("EIO_open.cfg", "SYS_open.cfg")
"""Files of a build that no controller's file was seen to agree with (docs/rapid/cfg.md)."""
_LOAD = "Control Panel > Configuration > (topic) > File > Load parameters, replacing duplicates"


@dataclass(frozen=True, slots=True)
class ManualStep:
    """One thing that a person does; `stops_motion` means that every motion ends with it."""

    who: str
    what: str
    stops_motion: bool = False


def steps_of(
    modules: Sequence[tuple[str, tuple[str, ...]]],
    cfg: Sequence[CfgChange],
    texts: Sequence[CfgText],
    *,
    written: bool,
    touched: bool,
) -> tuple[ManualStep, ...]:
    """Steps after the files have been switched.

    `modules` are the changed ones with their tasks, `texts` the cfg that names the tasks,
    `written` that SYSPAR itself was changed, `touched` that any file was.
    """
    steps: list[ManualStep] = []
    # Signals come before what names them.
    for text in sorted(texts, key=lambda text: text.path) if not written else ():
        own = {f"{section} {name}" for _, section, name in keyed([text])}
        actions = [c.action for c in cfg if c.domain == text.domain and c.key in own]
        added, changed = actions.count("add"), actions.count("change")
        if added or changed:
            words = f"{added} instances to add, {changed} to change"
            file = text.path.rpartition("/")[2]
            refused = "; it may be refused, then leave it out" if file in OPTIONAL else ""
            what = f"load HOME:/{STATE}/{file} ({words}): {_LOAD}{refused}"
            steps.append(ManualStep("pendant", what))
    gone = [c.key for c in cfg if c.action == "remove"] if not written else []
    if gone:
        what = "loading removes nothing: delete in Control Panel > Configuration: "
        steps.append(ManualStep("pendant", what + "; ".join(gone)))
    if not touched:
        return tuple(steps)
    types = {
        i.text("Name"): i.text("Type") or "SEMISTATIC"
        for text in texts
        for i in text.instances("CAB_TASKS")
    }
    tasks: dict[str, list[str]] = {}
    for path, names in modules:
        for name in names:
            tasks.setdefault(name, []).append(path.rpartition("/")[2])
    for name, files in tasks.items():
        kind = types.get(name, "NORMAL")
        restart = "Reset RAPID" if kind == "STATIC" else "Restart"
        steps.append(
            ManualStep(
                "pendant",
                f"{name} ({kind}) reads {', '.join(files)} at the next {restart} "
                f"of the controller (menu > {restart})",
                stops_motion=True,
            )
        )
    if not tasks:
        steps.append(
            ManualStep("pendant", "Restart of the controller (menu > Restart)", stops_motion=True)
        )
    steps.append(
        ManualStep("pendant", "program pointer to main, motors on and start: a person at the robot")
    )
    return tuple(steps)
