"""Load a build's cfg files onto their target controller."""

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from rapidgen._json import Members, items, members, text, whole
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Span, refusal
from rapidgen.system.base import Robot, base_system
from rapidgen.system.cfg import parse_cfg
from rapidgen.system.cfg_loading import CfgFileLoad, add
from rapidgen.system.cfg_reader import ModuleEntry, modules_of, tasks_of, udp_devices_of, with_cfg
from rapidgen.system.controller_cfg import ControllerCfg
from rapidgen.system.model import ModuleFile, System, TaskSpec

Load = Callable[[TaskSpec, tuple[ModuleEntry, ...], str], tuple[ModuleFile, ...]]
"""Return a task's modules, with those that the entries of a cfg file add."""


@dataclass(frozen=True, slots=True)
class BaseController:
    """A controller before loading: its cfg, and its tasks with modules."""

    cfg: ControllerCfg
    system: System
    common: tuple[ModuleFile, ...] = ()
    """Modules loaded into every task, including added ones."""


def of_backup(cfg: ControllerCfg, system: System) -> BaseController:
    """Return the controller of a backup."""
    sys = cfg.domain("SYS")
    loaded = {m.name.casefold(): m for task in system.tasks for m in task.modules}
    names = [
        (instance.text("ModName") or module_stem(entry.file)).casefold()
        for instance, entry in zip(sys.instances("CAB_TASK_MODULES"), modules_of(sys), strict=True)
        if entry.all_tasks or entry.shared
    ]
    return BaseController(cfg, system, tuple(loaded[name] for name in names if name in loaded))


def module_stem(file: str) -> str:
    """Return the name of a module file without folder and suffix."""
    return file.replace("\\", "/").rpartition("/")[2].rpartition(".")[0]


def delivered(manifest: Members) -> BaseController:
    """Return a delivered controller, as a manifest describes it.

    Raises DiagnosticError RG711.
    """
    try:
        configuration = members(manifest["configuration"])
        robots = []
        for group in map(members, items(configuration["groups"])):
            further = [text(unit) for unit in items(group["external_units"])]
            further += [text(members(one)["unit"]) for one in items(group.get("positioners") or [])]
            unit = text(group["mechanical_unit"])
            named = text(group.get("unit_group") or "")
            robots.append(Robot(text(group["task"]), unit, tuple(dict.fromkeys(further)), named))
        header = {
            text(domain): (whole(major), whole(minor))
            for domain, major, minor in map(items, items(configuration.get("cfg_header") or []))
        }
        major, minor = map(whole, items(manifest["robotware"]))
        multimove = bool(configuration.get("multimove"))
        cfg = base_system((major, minor), robots, multimove=multimove, digits=header)
        # Built for a cell: its signals that the build uses but does not add.
        used = members(manifest.get("cell_signals") or {}).items()
        signals = "".join(f' -Name "{name}" -SignalType "{text(kind)}"\n' for name, kind in used)
        if signals:
            cfg = cfg.plus(parse_cfg(f"EIO:CFG_1.0::\nEIO_SIGNAL:\n{signals}", path="the cell"))
    except (KeyError, TypeError, ValueError) as fault:
        label = "its 'configuration' does not tell the robots"
        raise bad_manifest(Path("manifest.json"), label) from fault
    return BaseController(cfg, System("", (), robotware=(major, minor)))


def additions(
    manifest: Members, texts: Mapping[str, bytes], without: Collection[str], folder: Path
) -> tuple[CfgFileLoad, ...]:
    """Return a build's cfg files in order.

    Raises DiagnosticError RG701, RG702, RG711.
    """
    try:
        optional = {text(name) for name in items(manifest.get("optional") or [])}
    except TypeError as fault:
        raise bad_manifest(folder / "manifest.json", "'optional' is no list of names") from fault
    result = []
    for name, data in texts.items():
        if name not in without:
            file = parse_cfg(data, path=str(folder / name))
            # Services of the firewall exist on a delivered controller: they are replaced, not
            # added.
            result.append(CfgFileLoad(file, name in optional, file.domain == "SIO", data.isascii()))
    return tuple(result)


def onto(
    under: BaseController,
    source: Iterable[CfgFileLoad],
    load: Load,
    *,
    open_words: bool = True,
    notes: list[Diagnostic] | None = None,
) -> System:
    """Return the controller with the files loaded in mode "add".

    Raises DiagnosticError RG720..RG723 for a file that a controller rejects.
    """
    files = tuple(source)
    loaded = add(under.cfg, files, open_words=open_words)
    if loaded.faults:
        raise DiagnosticError(loaded.faults)
    if notes is not None:
        notes += loaded.notes
    sys, eio = loaded.cfg.domain("SYS"), loaded.cfg.domain("EIO")
    own = [addition.file for addition in files if addition.file.domain == "SYS"]
    entries = tuple(entry for file in own for entry in modules_of(file))
    before = {task.name.casefold(): task.modules for task in under.system.tasks}
    tasks = []
    for task in tasks_of(sys):
        known = replace(task, modules=before.get(task.name.casefold(), under.common))
        tasks.append(replace(task, modules=load(known, entries, own[0].path if own else "")))
    # Without a device the cell's are unknown, as before.
    devices = udp_devices_of(loaded.cfg.domain("SIO")) or under.system.udp_devices
    system = replace(under.system, tasks=tuple(tasks), cfg=loaded.cfg, udp_devices=devices)
    return with_cfg(system, sys, eio)


def bad_manifest(path: Path, label: str) -> DiagnosticError:
    """RG711: the manifest is damaged or foreign."""
    return refusal(
        "RG711",
        Span(str(path), 1, 1),
        "manifest.json is not one that rapidgen wrote",
        "build the folder again with 'rapidgen build'",
        label=label,
    )
