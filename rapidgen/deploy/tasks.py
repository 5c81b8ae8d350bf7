"""Tasks that a set needs and does not write.

Checks that they exist, start our main and stay. A task starts with `main` unless its -Entry says
otherwise [backup 5.15]; abb_driver's page tells users to rename main and set it.
"""

import re
from collections.abc import Sequence

from rapidgen._json import members
from rapidgen.deploy.cfg import CfgChange
from rapidgen.deploy.driver_set import DriverSet
from rapidgen.deploy.manual_steps import ManualStep
from rapidgen.deploy.transports.transport import refused
from rapidgen.system import CfgText, Instance

MAIN = re.compile(rb"^\s*PROC\s+main\s*\(", re.I | re.M)


def entry_steps(desired: DriverSet, loaded: Sequence[CfgText], target: str) -> list[ManualStep]:
    """Return steps if a motion task starts another routine than our main.

    Raises DiagnosticError RG538 if the loaded cfg has no such motion task.
    """
    there = {i.text("Name").casefold(): i for t in loaded for i in t.instances("CAB_TASKS")}
    own_files = {
        i.text("Name").casefold() for text in desired.cfg for i in text.instances("CAB_TASKS")
    }
    steps = []
    for name in _motion_tasks(desired) if there else ():
        task = there.get(name.casefold())
        if task is None and name.casefold() not in own_files:
            raise _missing(name, list(there.values()), target)
        entry = task.text("Entry") or "main" if task is not None else "main"
        starts = any(name in f.tasks and MAIN.search(f.data) for f in desired.files)
        if starts and entry.casefold() != "main" and name.casefold() not in own_files:
            what = f"set Entry of {name} to main (it starts with {entry} there)"
            steps.append(ManualStep("pendant", f"{what}: Configuration > Controller > Task"))
    return steps


def check_complete(desired: DriverSet, cfg: Sequence[CfgChange]) -> None:
    """Raise DiagnosticError RG539 if a needed task would be deleted.

    A build for a cell writes what the cell's backup lacks; a backup with this driver lacks nothing.
    """
    needed = {task.casefold() for file in desired.files for task in file.tasks}
    for change in cfg:
        section, _, name = change.key.partition(" ")
        if change.action == "remove" and section == "CAB_TASKS" and name.casefold() in needed:
            raise refused(
                "RG539",
                f"the build needs task {name} and does not bring it: it was made with a backup "
                "that had this driver already",
                "build without --backup, or with a backup from before the first deployment",
            )


def _motion_tasks(desired: DriverSet) -> list[str]:
    groups = members(desired.generated.get("groups") or {})
    return [str(members(group).get("task")) for group in groups.values()]


def _missing(name: str, tasks: Sequence[Instance], target: str) -> Exception:
    motion = [task.text("Name") for task in tasks if task.flag("MotionTask")]
    return refused(
        "RG538",
        f"{target} has no task {name}; its motion tasks are {', '.join(motion) or 'none'}",
        "set `task` of the group in the configuration, and build again",
    )
