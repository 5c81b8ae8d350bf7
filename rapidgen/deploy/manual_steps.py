"""Manual steps of a deployment: loading parameters, restarts.

The type of a task decides which restart makes it read its modules again: a SEMISTATIC task starts
from the beginning at every restart and reads its modules then [manual]; a STATIC one continues and
needs its program reset; modules of NORMAL tasks that CAB_TASK_MODULES names are loaded at a restart
if the file is newer ([mem]). This module restarts nothing.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from rapidgen.deploy.cfg import CfgChange, is_delivered, is_unconfirmed, shown_key
from rapidgen.deploy.other_driver import OtherDriver
from rapidgen.system import CfgText

_TOPICS = {
    "CAB_TASKS": "Controller > Task",
    "CAB_TASK_MODULES": "Controller > Automatic Loading of Modules",
    "CAB_EXEC_HOOKS": "Controller > Event Routine",
    "MECHANICAL_UNIT_GROUP": "Controller > Mechanical Unit Group",
    "EIO_SIGNAL": "I/O System > Signal",
    "SYSSIG_OUT": "I/O System > System Output",
    "FIREWALL_MANAGEMENT": "Communication > Firewall Manager",
}
"""Topic and type of each domain.

The first two from abb_driver's page, the last from ABB's, others [mem].
"""


@dataclass(frozen=True, slots=True)
class ManualStep:
    """One manual step; `stops_motion` means that every motion ends."""

    who: str
    what: str
    stops_motion: bool = False


CFG_FIRST = ManualStep(
    "you",
    "have the instances below deleted and the controller restarted before the files are removed: "
    "else it starts with tasks whose modules are missing; a new backup shows it (--backup)",
)
"""Notes of an uninstall if loaded cfg is unknown or still present."""


def steps_of(
    modules: Sequence[tuple[str, tuple[str, ...]]],
    cfg: Sequence[CfgChange],
    desired: Sequence[CfgText],
    old: Sequence[CfgText],
    *,
    gone: bool,
    written: bool,
) -> tuple[ManualStep, ...]:
    """Return steps after the switch; none if no loaded file changes.

    `modules` are the new and changed ones with their tasks, `gone` that some were deleted,
    `desired` and `old` the cfg files of the new and the last set, `written` that SYSPAR itself was
    changed.
    """
    steps = [] if written else [*_delete(cfg), *_load(cfg, desired), *_give_back(cfg)]
    types = {
        i.text("Name"): i.text("Type") or "SEMISTATIC"
        for text in (*old, *desired)
        for i in text.instances("CAB_TASKS")
    }
    tasks: dict[str, list[str]] = {}
    for path, names in modules:
        for name in names:
            tasks.setdefault(name, []).append(path.rpartition("/")[2])
    for restart in ("Restart", "Reset RAPID"):
        kinds: dict[str, list[str]] = {}
        for name, files in tasks.items():
            kind = types.get(name, "NORMAL")
            if (kind == "STATIC") == (restart == "Reset RAPID"):
                kinds.setdefault(kind, []).append(f"{name} {_files(files)}")
        if kinds:
            read = "; ".join(f"{', '.join(names)} ({kind})" for kind, names in kinds.items())
            what = f"{restart} (menu > {restart}), so that tasks read again: {read}"
            steps.append(ManualStep("pendant", what, stops_motion=True))
    changed = gone or any(c.action not in ("same", "use") for c in cfg)
    if changed and not any(step.stops_motion for step in steps):
        steps.append(
            ManualStep("pendant", "Restart of the controller (menu > Restart)", stops_motion=True)
        )
    if tasks or changed:
        start = "program pointer to main, motors on and start: a person at the robot"
        steps.append(ManualStep("pendant", start))
    return tuple(steps)


def _files(names: Sequence[str]) -> str:
    """Return one file by name, several by their number; the plan lists them."""
    return names[0] if len(names) == 1 else f"{len(names)} files"


def other_driver_steps(neighbour: OtherDriver) -> tuple[ManualStep, ...]:
    """Return the steps that remove another driver before ours is loaded."""
    steps = [ManualStep("pendant", "back the controller up: a restore returns to the other driver")]
    sections: dict[str, list[str]] = {}
    for one in neighbour.instances:
        name = one.shown.removeprefix(one.section).strip()
        sections.setdefault(one.section, []).append(name)
    steps += [
        ManualStep("pendant", f"delete in {_where(section)}: {'; '.join(names)}")
        for section, names in sections.items()
    ]
    if not neighbour.instances:
        what = "delete the other driver's tasks, automatic loading of modules and event routines"
        steps.append(ManualStep("pendant", f"{what}, if they are still there"))
    return (
        *steps,
        ManualStep("pendant", "Restart of the controller (menu > Restart)", stops_motion=True),
        ManualStep(
            "pendant",
            "unload what of its modules is still in a task (Program Editor > Modules), ROS_motion "
            "with its main above all",
        ),
        ManualStep(
            "you", "plan again (over FTP and SFTP with a new backup: --backup); its files stay"
        ),
    )


def _delete(cfg: Sequence[CfgChange]) -> list[ManualStep]:
    """Return the steps that delete instances.

    Loading deletes none, and cannot identify an instance without a name.
    """
    sections: dict[str, list[str]] = {}
    for change in cfg:
        if change.action == "remove" or (change.action == "change" and not change.named):
            section, _, name = change.key.partition(" ")
            again = "" if change.action == "remove" else " (restored with changes)"
            sections.setdefault(section, []).append(name + again)
    sections = {s: _by_file(n) if s == "CAB_TASK_MODULES" else n for s, n in sections.items()}
    return [
        ManualStep("pendant", f"loading removes nothing: delete in {_where(s)}: {'; '.join(names)}")
        for s, names in sections.items()
    ]


def _by_file(names: Sequence[str]) -> list[str]:
    """Return `FILE TASK` of many as `FILE, FILE in TASK, TASK`.

    Files of the same tasks are grouped, their folder is given once.
    """
    files: dict[str, list[str]] = {}
    for name in names:
        file, _, task = name.partition(" ")
        files.setdefault(file, []).append(task)
    alike: dict[tuple[str, str], list[str]] = {}
    for path, tasks in files.items():
        folder, _, file = path.rpartition("/")
        alike.setdefault((folder, ", ".join(tasks)), []).append(file)
    return [
        f"{folder}/{' ' if len(own) > 1 else ''}{', '.join(own)} in {tasks}"
        for (folder, tasks), own in alike.items()
    ]


def _load(cfg: Sequence[CfgChange], desired: Sequence[CfgText]) -> list[ManualStep]:
    """Return files with new instances.

    Adding refuses existing ones (120006 [real 6.03]).
    """
    changes = {(c.domain, c.key): c for c in cfg}
    steps = []
    # Signals precede instances that name them.
    for text in sorted(desired, key=lambda text: text.path):
        rows = [(s.name, i) for s in text.sections for i in s.instances]
        own = [changes[text.domain, f"{name} {shown_key(name, i)}"] for name, i in rows]
        new = sum(c.action == "add" for c in own)
        changed = sum(c.action == "change" for c in own)
        if not new and not changed:
            continue
        there = any(is_delivered(name, i) for name, i in rows) or any(
            c.action == "same" or (c.action == "change" and c.named) for c in own
        )
        mode = "and replace duplicates" if there else "if no duplicates"
        what = f"load HOME:/{text.path} ({new} instances to add, {changed} to change): "
        what += f"Control Panel > Configuration > File > Load parameters {mode}"
        foreign = [c.key.partition(" ")[2] for c in own if c.action == "use"]
        if foreign:
            what += f"; in a copy without {', '.join(foreign)}: foreign instances, used as they are"
        if is_unconfirmed(text):
            what += "; it may be refused: leave it out, the driver serves and stops without it"
        steps.append(ManualStep("pendant", what))
    return steps


def _give_back(cfg: Sequence[CfgChange]) -> list[ManualStep]:
    return [
        ManualStep(
            "pendant",
            f"keep {c.key.partition(' ')[2]} in {_where(c.key.partition(' ')[0])}, it is the "
            f"controller's own: take out what it did not have before the driver ({c.note})",
        )
        for c in cfg
        if c.action == "leave" and c.note
    ]


def _where(section: str) -> str:
    return f"Control Panel > Configuration > {_TOPICS.get(section, section)}"
