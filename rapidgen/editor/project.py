"""Discovery of the program that a file belongs to.

The first of these that has the file decides:

1. a backup (SYSPAR/SYS.cfg), whose tasks load their modules as on the controller;
2. a folder that rapidgen generated;
3. a project file (rapidgen.toml) whose tasks list the file;
4. a program file (.pgf) beside it, which lists it;
5. the modules in its folder, with those of PROGMOD and SYSMOD side by side;
6. the file alone.

Backups and generated folders are looked for in the folders above, up to the workspace folder that
the client has opened. What cannot be read is a note, and the next possibility is taken: an editor
always has an answer.
"""

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final, Literal

from rapidgen.config.plausibility import LARGEST_PAYLOAD
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, Span, error
from rapidgen.editor.documents import is_below, is_file, real_path
from rapidgen.rapid.checks import Payload
from rapidgen.rapid.dialect import Dialect
from rapidgen.system import (
    System,
    is_backup,
    is_generated,
    read_backup,
    read_files,
    read_folder,
)
from rapidgen.system.loading import expand
from rapidgen.system.paths import MODULE_SUFFIXES, module_files
from rapidgen.system.project import PROJECT_FILE, Project, read_project
from rapidgen.system.releases import UNKNOWN_ROBOTWARE, release

Kind = Literal["backup", "generated", "project", "program", "folder", "file"]
_SHELVES: Final = ("PROGMOD", "SYSMOD")
_MAX_MODULES: Final = 1_000
"""Modules of a folder that are analysed together; of more, each file is alone."""
_ANY_ROBOT: Final = Payload("any robot of ABB", LARGEST_PAYLOAD)


@dataclass(frozen=True, slots=True)
class Settings:
    """Settings of the client."""

    robotware: str = ""
    strict: bool = False
    encoding: str = "auto"
    backup: str = ""
    """The controller's backup for generated folders."""
    inlay_hints: bool = True
    code_lenses: bool = True

    @property
    def dialect(self) -> Dialect | None:
        """The release that the settings name, None without one or with a wrong one."""
        if not self.robotware:
            return None
        try:
            return Dialect(release(self.robotware))
        except DiagnosticError:
            return None


@dataclass(frozen=True, slots=True, eq=False)
class Program:
    """Modules that belong together, as paths or as a system with its configuration."""

    kind: Kind
    root: str
    files: tuple[str, ...] = ()
    """Modules of one group, without a system."""
    system: System | None = None
    dialect: Dialect = field(default_factory=Dialect)
    gaps: bool = False
    strict: bool = False
    configured: bool = False
    payloads: Mapping[str, Payload] = field(default_factory=dict)
    notes: tuple[Diagnostic, ...] = ()
    ignored: frozenset[str] = frozenset()
    """Codes that the project file does not want to be reported."""
    robot: str = ""
    """Robot that the project file names."""

    @property
    def paths(self) -> frozenset[str]:
        """Real paths of all modules."""
        if self.system is None:
            return frozenset(map(real_path, self.files))
        return frozenset(
            real_path(file.path) for task in self.system.tasks for file in task.modules
        )


def is_module(path: str) -> bool:
    """Return True for the name of a RAPID file."""
    return path.casefold().endswith(MODULE_SUFFIXES)


def discover(path: str, folders: Sequence[str], settings: Settings) -> Program:
    """Return the program that a file belongs to; never fails."""
    if not is_file(path):
        return _alone(path, settings)
    notes: list[Diagnostic] = []
    for folder in _folders_above(Path(path), folders):
        try:
            program = _whole(folder, settings, notes)
        except (DiagnosticError, OSError) as fault:
            notes += _as_notes(fault, str(folder))
            break
        if program is not None and (program.kind != "project" or real_path(path) in program.paths):
            if real_path(path) in program.paths:
                return program
            break  # a file in HOME of a backup that no task loads
    try:
        return _group(Path(path), settings, notes)
    except FileNotFoundError:
        return _alone(path, settings)  # a document that is not saved yet
    except (DiagnosticError, OSError) as fault:
        return _alone(path, settings, _as_notes(fault, path))


def _folders_above(path: Path, folders: Sequence[str]) -> list[Path]:
    """Return the folders in which a file lies, up to the workspace folder around it."""
    limits = [folder for folder in folders if is_below(str(path), folder)]
    top = max(limits, key=len) if limits else ""
    result = [folder for folder in path.parents if not top or is_below(str(folder), top)]
    return result if top else result[:8]


def _whole(folder: Path, settings: Settings, notes: list[Diagnostic]) -> Program | None:
    """Return the backup, generated folder or project in a folder."""
    if is_backup(folder):
        collected: list[Diagnostic] = []
        system = read_backup(folder, notes=collected)
        payloads = {task.name.lower(): _ANY_ROBOT for task in system.tasks if task.motion}
        return _of_system(
            "backup", folder, system, settings, bool(collected), True, payloads, collected
        )
    if is_generated(folder):
        system = read_folder(folder, settings.backup or None)
        return _of_system("generated", folder, system, settings, False, True, {}, notes)
    file = folder / PROJECT_FILE
    if file.is_file():
        return _of_project(read_project(file), settings)
    return None


def _of_system(
    kind: Kind,
    folder: Path,
    system: System,
    settings: Settings,
    gaps: bool,
    configured: bool,
    payloads: Mapping[str, Payload],
    notes: Sequence[Diagnostic],
) -> Program:
    own = Dialect(system.robotware, some=not system.is_robotware_known)
    return Program(
        kind, str(folder), (), system, settings.dialect or own, gaps, settings.strict, configured,
        payloads, tuple(notes),
    )  # fmt: skip


def _of_project(project: Project, settings: Settings) -> Program | None:
    if not project.tasks:
        return None
    robotware = release(project.robotware) if project.robotware else UNKNOWN_ROBOTWARE
    system = read_files(project.sources, robotware=robotware)
    payloads = {task.name.lower(): _ANY_ROBOT for task in system.tasks if task.motion}
    strict = project.strict or settings.strict
    return Program(
        "project",
        str(project.path.parent),
        (),
        system,
        settings.dialect or Dialect(robotware),
        not strict,
        strict,
        bool(project.cfg),
        payloads,
        ignored=project.ignore,
        robot=project.robot,
    )


def _group(path: Path, settings: Settings, notes: list[Diagnostic]) -> Program:
    """Return the program file's modules, or those around a module."""
    real = real_path(str(path))
    project = _project_above(path)
    strict = settings.strict or (project is not None and project.strict)
    dialect = settings.dialect
    if dialect is None and project is not None and project.robotware:
        dialect = Dialect(release(project.robotware))
    ignored = project.ignore if project is not None else frozenset()
    kind: Kind = "folder"
    files: list[str] = []
    for program in sorted(path.parent.glob("*.[pP][gG][fF]")):
        try:
            listed = [str(file) for file in expand(program) if is_module(str(file))]
        except (DiagnosticError, OSError) as fault:
            notes += _as_notes(fault, str(program))
            continue
        if real in map(real_path, listed):
            kind, files = "program", listed
            break
    if not files:
        files = _neighbours(path)
    if len(files) > _MAX_MODULES or real not in map(real_path, files):
        kind, files = "file", [str(path)]
    return Program(
        kind,
        str(path.parent if kind != "file" else path),
        tuple(files),
        dialect=dialect or Dialect(),
        strict=strict,
        payloads={"": _ANY_ROBOT},
        notes=tuple(notes),
        ignored=ignored,
    )


def _neighbours(path: Path) -> list[str]:
    """Return the modules of a file's folder, and of PROGMOD and SYSMOD side by side."""
    folder = path.parent
    if folder.name.upper() in _SHELVES:
        folder = folder.parent
    folders = [folder]
    with os.scandir(folder) as entries:
        folders += sorted(Path(e.path) for e in entries if e.name.upper() in _SHELVES)
    return [str(file) for one in folders for file in module_files(one)]


def _project_above(path: Path) -> Project | None:
    for folder in path.parents:
        file = folder / PROJECT_FILE
        if file.is_file():
            try:
                return read_project(file)
            except DiagnosticError:
                return None  # the file's own findings say what is wrong
    return None


def _alone(path: str, settings: Settings, notes: Sequence[Diagnostic] = ()) -> Program:
    return Program(
        "file",
        path,
        (path,),
        dialect=settings.dialect or Dialect(),
        strict=settings.strict,
        payloads={"": _ANY_ROBOT},
        notes=tuple(notes),
    )


def _as_notes(fault: DiagnosticError | OSError, path: str) -> list[Diagnostic]:
    if isinstance(fault, DiagnosticError):
        return list(fault.diagnostics)
    message = f"cannot read {path}: {fault.strerror}"
    return [error("RG704", Span(path, 1, 1), message, severity=Severity.WARNING)]
