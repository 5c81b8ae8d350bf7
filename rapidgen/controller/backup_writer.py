"""A backup of a controller, as `rapidgen sim` and RobotStudio read one."""

from pathlib import Path

from rapidgen.controller.controller import VirtualController
from rapidgen.controller.programs import SYSTEM_ENDINGS, Programs
from rapidgen.machine.files import copy_files
from rapidgen.runtime.loading import module_text
from rapidgen.system.cfg import write_cfg
from rapidgen.system.controller_cfg import ControllerCfg

_INFO = ">>VERSION OF ROBOTWARE\nRobotWare {0}.{1:02}\n"


def back_up(
    controller: VirtualController, programs: Programs, cfg: ControllerCfg, folder: Path
) -> None:
    """Write BACKINFO, HOME, RAPID and SYSPAR into a new folder: what the controller is now.

    Persistents have their present values. OSError: the folder is there, or cannot be written.
    """
    folder.mkdir()
    for part in ("BACKINFO", "RAPID", "SYSPAR"):
        (folder / part).mkdir()
    home = controller.files.path("HOME:")
    copy_files(home, folder / "HOME", without=folder)
    lines = [_INFO.format(*controller.system.robotware)]
    for number, task in enumerate(controller.rapid_tasks.values(), 1):
        lines.append(f">>TASK{number}: ({task.name},,)\n")
        for module in programs.modules(task):
            loaded = task.program.modules.get(module.name.lower())
            data = module.file.data
            if loaded is not None and not (loaded.installed or module.file.shared):
                text = module_text(task, loaded)
                data = text.encode(loaded.tree.source.encoding, "replace")
            kind, ending = ("SYSMOD", "sys") if module.is_system else ("PROGMOD", "mod")
            if module.file.path.lower().endswith(SYSTEM_ENDINGS):
                ending = "sys"
            place = folder / "RAPID" / f"TASK{number}" / kind
            place.mkdir(parents=True, exist_ok=True)
            (place / f"{module.name}.{ending}").write_bytes(data)
    (folder / "BACKINFO" / "backinfo.txt").write_text("".join(lines), encoding="ascii")
    for domain in cfg.domains:
        path = folder / "SYSPAR" / f"{domain.domain}.cfg"
        path.write_text(write_cfg(domain), encoding="utf-8")
