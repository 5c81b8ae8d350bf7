"""Convert cfg text, backups, folders and files to a `System`, and back."""

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from rapidgen.diagnostics import Diagnostic

if TYPE_CHECKING:
    from rapidgen.system.backup import is_backup, read_backup
    from rapidgen.system.cfg import (
        Attribute,
        CfgText,
        Instance,
        Section,
        cfg_bytes,
        parse_cfg,
        write_cfg,
    )
    from rapidgen.system.cfg_writer import eio_cfg, sys_cfg
    from rapidgen.system.folder import expand_lines, is_generated, read_folder, read_manifest
    from rapidgen.system.loose_files import read_files, task_folders
    from rapidgen.system.model import (
        CrossConnection,
        EventRoutine,
        MechanicalUnitGroup,
        ModuleFile,
        SignalSpec,
        System,
        SystemInput,
        SystemOutput,
        TaskSpec,
    )

# Most users need one of these files; a build should not load the reader of backups.
_FILES = {
    name: file
    for file, names in {
        "backup": "is_backup read_backup",
        "cfg": "Attribute CfgText Instance Section cfg_bytes parse_cfg write_cfg",
        "folder": "expand_lines is_generated read_folder read_manifest",
        "cfg_writer": "eio_cfg sys_cfg",
        "loose_files": "read_files task_folders",
        "model": "CrossConnection EventRoutine MechanicalUnitGroup ModuleFile SignalSpec System "
        "SystemInput SystemOutput TaskSpec",
    }.items()
    for name in names.split()
}

__all__ = [
    "Attribute",
    "CfgText",
    "CrossConnection",
    "EventRoutine",
    "Instance",
    "MechanicalUnitGroup",
    "ModuleFile",
    "Section",
    "SignalSpec",
    "System",
    "SystemInput",
    "SystemOutput",
    "TaskSpec",
    "cfg_bytes",
    "eio_cfg",
    "expand_lines",
    "is_backup",
    "is_generated",
    "parse_cfg",
    "read_backup",
    "read_files",
    "read_folder",
    "read_manifest",
    "read_system",
    "sys_cfg",
    "task_folders",
    "write_cfg",
]


def __getattr__(name: str) -> object:
    if name not in _FILES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_FILES[name]}"), name)


def read_system(path: Path | str, *, notes: list[Diagnostic] | None = None) -> "System":
    """Read a generated folder, a backup, a module folder or a module.

    Raises DiagnosticError RG701..RG712.
    """
    from rapidgen.diagnostics import refusal
    from rapidgen.system.backup import is_backup, read_backup
    from rapidgen.system.folder import is_generated, read_folder
    from rapidgen.system.loose_files import read_files

    path = Path(path)
    if path.is_dir():
        if is_generated(path):
            return read_folder(path)
        if is_backup(path):
            return read_backup(path, notes=notes)
    elif not path.exists():
        raise refusal("RG704", None, f"there is no {path}", "check the path for a slip")
    return read_files([path], name=path.resolve().stem)
