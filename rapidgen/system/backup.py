"""Read an ABB backup folder.

It has BACKINFO, HOME, RAPID/TASKn/{PROGMOD,SYSMOD} and SYSPAR. CAB_TASKS of SYSPAR/SYS.cfg in order
are TASK1..n, unless BACKINFO/backinfo.txt names the tasks of the folders (`>>TASK1: (T_ROB1,...)`).
The files that it lists were loaded, and no others of the folder [code]. RobotWare is the version in
backinfo.txt or system.xml, else the one in the cfg header.
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, Span, error, refusal
from rapidgen.system.base.releases import DOMAINS
from rapidgen.system.cfg import CfgText, parse_cfg
from rapidgen.system.cfg_loading import faults_within
from rapidgen.system.cfg_reader import (
    ModuleEntry,
    arc_signals,
    modules_of,
    tasks_of,
    udp_devices_of,
    with_cfg,
)
from rapidgen.system.controller_cfg import ControllerCfg
from rapidgen.system.loading import load_entries, load_module
from rapidgen.system.model import ModuleFile, System, TaskSpec
from rapidgen.system.paths import inside, is_there, module_files, read_limited

_TASK_LINE = re.compile(rb">>TASK(\d+):\s*\(\s*([^,()\s]+)")
_TASK_MODULES = re.compile(rb">>TASK(\d+):[^\r\n]*([^>]*)")
_LISTED = re.compile(rb"^(?:PROG|SYS)MOD[\\/]([^\r\n]+?) @", re.M | re.I)
_VERSIONS = (
    # RobotWare 7 lists its parts in any order: 7.6 has a RobotOS 5.0, 7.18 a RobotOS 16.0.
    re.compile(rb"RobotControl[^0-9\r\n]{0,40}(\d+)\.(\d+)", re.I),
    re.compile(rb"RobotWare[^0-9\r\n]{0,40}(\d+)\.(\d+)", re.I),
    re.compile(rb">>PRODUCTS_ID:\s*\D{0,80}?(\d+)\.(\d+)", re.I),
)
_DEFAULT = (6, 0)
"""If neither the backup nor a header gives it."""
_READ = ("SYS", "EIO")
"""Required domains."""
_INFO_FILES = ("BACKINFO/backinfo.txt", "BACKINFO/version.xml", "system.xml", "BACKINFO/system.xml")


def read_backup(folder: Path | str, *, notes: list[Diagnostic] | None = None) -> System:
    """Return the system in a backup; `notes` collects ignored parts.

    Raises DiagnosticError: RG701..RG708 for damaged or hostile content, RG712 when the folder is
    not a backup.
    """
    folder = Path(folder)
    collected: list[Diagnostic] = [] if notes is None else notes
    if not is_backup(folder):
        raise refusal(
            "RG712",
            None,
            f"{folder} is not an ABB backup: it has no SYSPAR/SYS.cfg",
            "give the folder that holds BACKINFO, HOME, RAPID and SYSPAR",
        )
    sys_cfg = _cfg(folder, "SYS.cfg")
    eio_path = inside(folder, "SYSPAR/EIO.cfg")
    eio_cfg = parse_cfg(read_limited(eio_path), path=str(eio_path)) if eio_path.exists() else None
    if eio_cfg is None:
        eio_cfg = CfgText("EIO", sys_cfg.version, ())
    info = _info(folder)
    numbers = {
        name.decode("latin-1").casefold(): int(number) for number, name in _TASK_LINE.findall(info)
    }
    listed = {int(number): _names(rows) for number, rows in _TASK_MODULES.findall(info)}
    entries = modules_of(sys_cfg)
    home = inside(folder, "HOME")
    tasks = tuple(
        _with_modules(
            task,
            _saved(folder, numbers.get(task.name.casefold(), n), listed, collected),
            home,
            entries,
            sys_cfg,
            collected,
        )
        for n, task in enumerate(tasks_of(sys_cfg), 1)
    )
    collected += _of_options(entries, tasks, sys_cfg.path)
    further = {
        text.domain: text
        for domain in DOMAINS
        if domain not in _READ and (text := _further(folder, domain, collected)) is not None
    }
    proc, sio, moc = further.get("PROC"), further.get("SIO"), further.get("MOC")
    report = _robotware(info)
    if report is None:
        collected.append(_unknown_release(sys_cfg))
    robotware = report or (_main(sys_cfg), 0)
    result = System(
        name=folder.resolve().name,
        tasks=tasks,
        robotware=robotware,
        is_robotware_known=report is not None,
        home=home if home.is_dir() else None,
        robot_types=() if moc is None else _robot_types(moc),
        arc=() if proc is None else arc_signals(proc),
        cameras=() if sio is None else _cameras(sio),
        udp_devices=None if sio is None else udp_devices_of(sio),
        cfg=ControllerCfg(robotware, (sys_cfg, eio_cfg, *further.values())),
    )
    return with_cfg(result, sys_cfg, eio_cfg)


def _of_options(
    entries: Sequence[ModuleEntry], tasks: Iterable[TaskSpec], path: str
) -> list[Diagnostic]:
    """Report the modules of options, which no backup contains, in one note."""
    loaded = {module.name.casefold() for task in tasks for module in task.modules}
    files = dict.fromkeys(
        entry.file
        for entry in entries
        if not entry.file.strip().upper().startswith("HOME:")
        and entry.file.replace("\\", "/").rpartition("/")[2].rpartition(".")[0].casefold()
        not in loaded
    )
    if not files:
        return []
    number = f"{len(files)} modules" if len(files) > 1 else "a module"
    return [
        error(
            "RG710",
            Span(path, 1, 1),
            f"{number} of installed options: no backup contains them",
            notes=tuple(files),
            severity=Severity.INFO,
        )
    ]


def _robot_types(moc: CfgText) -> tuple[tuple[str, str], ...]:
    """Return the robots with a TCP; a gantry that carries one is an external unit."""
    units = {unit.text("use_robot").casefold() for unit in moc.instances("MECHANICAL_UNIT")}
    return tuple(
        (robot.text("Name"), robot.text("use_robot_type"))
        for robot in moc.instances("ROBOT")
        if robot.text("Name").casefold() not in units
    )


def _cameras(sio: CfgText) -> tuple[str, ...]:
    """Return cameras: COM_APP instances of type CAMERA [cfg]."""
    rows = sio.instances("COM_APP")
    return tuple(row.text("Name") for row in rows if row.text("Type").upper() == "CAMERA")


def backup_cfg(folder: Path, robotware: tuple[int, int], notes: list[Diagnostic]) -> ControllerCfg:
    """Return all cfg domains of a backup, to load files onto.

    `notes` get the rules' findings. Raises DiagnosticError: RG701..RG706 for damaged or hostile
    content of SYS and EIO.
    """
    result = [_cfg(folder, "SYS.cfg")]
    if is_there(inside(folder, "SYSPAR/EIO.cfg")):
        result.append(_cfg(folder, "EIO.cfg"))
    further = (_further(folder, domain, notes) for domain in DOMAINS if domain not in _READ)
    result += [text for text in further if text is not None]
    cfg = ControllerCfg(robotware, tuple(result))
    notes += faults_within(cfg)
    return cfg


def _further(folder: Path, domain: str, notes: list[Diagnostic]) -> CfgText | None:
    """Return an optional domain; a read error becomes a note."""
    path = inside(folder, f"SYSPAR/{domain}.cfg")
    if not is_there(path):
        return None
    try:
        return parse_cfg(read_limited(path), path=str(path))
    except DiagnosticError as fault:
        notes += [replace(result, severity=Severity.WARNING) for result in fault.diagnostics]
        return None


def is_backup(folder: Path) -> bool:
    """True if `folder` looks like an ABB backup."""
    return is_there(inside(folder, "SYSPAR/SYS.cfg"))


def _names(rows: bytes) -> frozenset[str]:
    return frozenset(name.decode("latin-1").casefold() for name in _LISTED.findall(rows))


def _saved(
    folder: Path, number: int, listed: Mapping[int, frozenset[str]], notes: list[Diagnostic]
) -> tuple[ModuleFile, ...]:
    """Return the modules in a task's folder, those of backinfo.txt if listed.

    Folders into which one backup is copied over another keep modules of the earlier one.
    """
    names = listed.get(number, frozenset())
    loaded: list[ModuleFile] = []
    left: list[str] = []
    # System modules are loaded before a program [K §9].
    for place in ("SYSMOD", "PROGMOD"):
        for path in module_files(inside(folder, f"RAPID/TASK{number}/{place}")):
            if names and path.name.casefold() not in names:
                left.append(path.name)
            else:
                loaded.append(load_module(path))
    if left:
        notes.append(
            error(
                "RG715",
                None,
                f"not loaded in task folder TASK{number}: {', '.join(left)}",
                "add them to the list in BACKINFO/backinfo.txt if they belong to the task",
                notes=("backinfo.txt lists what the controller had loaded, and not these",),
                severity=Severity.INFO,
            )
        )
    return tuple(loaded)


def _with_modules(
    task: TaskSpec,
    saved: tuple[ModuleFile, ...],
    home: Path,
    entries: tuple[ModuleEntry, ...],
    sys_cfg: CfgText,
    notes: list[Diagnostic],
) -> TaskSpec:
    modules = load_entries(task, entries, home, saved, sys_cfg.path, notes)
    return replace(task, modules=modules)


def _cfg(folder: Path, name: str) -> CfgText:
    path = inside(folder, f"SYSPAR/{name}")
    return parse_cfg(read_limited(path), path=str(path))


def _info(folder: Path) -> bytes:
    result = [path for name in _INFO_FILES if is_there(path := inside(folder, name))]
    return b"\n".join(read_limited(path) for path in result)


def _robotware(info: bytes) -> tuple[int, int] | None:
    for pattern in _VERSIONS:
        match = pattern.search(info)
        if match and 5 <= int(match[1]) <= 9:
            return int(match[1]), int(match[2])
    return None


def _main(cfg: CfgText) -> int:
    return (cfg.version or _DEFAULT)[0]


def _unknown_release(cfg: CfgText) -> Diagnostic:
    return error(
        "RG713",
        None,
        f"the backup has no RobotWare version; {_main(cfg)}.0 is taken from SYS.cfg",
        "name it with --robotware",
        severity=Severity.WARNING,
    )
