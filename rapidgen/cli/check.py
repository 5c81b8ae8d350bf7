"""`rapidgen check`: configurations, RAPID files, folders, generated folders and backups."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rapidgen.cli.terminal import use_colour
from rapidgen.diagnostics import (
    Diagnostic,
    DiagnosticError,
    Format,
    Severity,
    Span,
    error,
    refusal,
    render,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rapidgen.config.model import GroupConfig, RobotConfig
    from rapidgen.generate.existing_controller import Cell
    from rapidgen.rapid import Dialect
    from rapidgen.rapid.checks import Payload
    from rapidgen.rapid.syntax.nodes import Declaration, Module
    from rapidgen.system import System

_CONFIG_SUFFIXES = (".yaml", ".yml")
_TASK_FOLDERS = ("PROGMOD", "SYSMOD")


def check(
    paths: Annotated[
        list[str],
        typer.Argument(
            help="Configurations (or shipped names), RAPID files, folders, backups.",
            metavar="PATH...",
        ),
    ],
    robotware: Annotated[
        str | None,
        typer.Option(help="RobotWare to check for, such as 6.15; default 6.", metavar="V"),
    ] = None,
    backup: Annotated[
        Path | None,
        typer.Option(
            help="Backup of the controller that configurations and generated folders are for.",
            metavar="FOLDER",
        ),
    ] = None,
    robot: Annotated[
        str, typer.Option(help="Robot that RAPID files are for: what it may carry.", metavar="NAME")
    ] = "",
    format: Annotated[Format, typer.Option(help="How findings are shown.")] = Format.FULL,
    as_json: Annotated[bool, typer.Option("--json", help="As --format json.")] = False,
) -> int:
    """Say everything that is wrong with configurations and RAPID.

    What is unknown is judged by what was given: a lone file may use names of modules that are
    not there, a backup may not. With --backup a configuration is built for that controller, and a
    generated folder is loaded onto it; nothing is written.
    """
    format = Format.JSON if as_json else format
    dialect = _dialect(robotware)
    payload = _payload(robot)
    cell = _cell(backup)
    findings: list[Diagnostic] = []
    modules: list[Path] = []
    for given in paths:
        path = Path(given)
        is_name = not path.exists() and not path.suffix and len(path.parts) == 1
        try:
            if is_name or path.suffix.lower() in _CONFIG_SUFFIXES:
                findings += _configuration(given, cell)
            elif path.is_dir():
                findings += _folder(path, dialect, backup, payload)
            elif not path.exists():
                raise _nothing(given)
            elif path.suffix.lower() == ".cfg":
                _cfg(path)
            else:
                modules += _modules(path)
        except DiagnosticError as fault:
            if not path.exists():
                raise
            findings += fault.diagnostics
    findings += _files(modules, dialect, payload)
    import sys

    typer.echo(render(findings, format, colour=use_colour(sys.stdout)), nl=False)
    errors = sum(d.severity is Severity.ERROR for d in findings)
    if format is Format.FULL:
        warnings = sum(d.severity is Severity.WARNING for d in findings)
        typer.echo(f"{errors} error(s), {warnings} warning(s)", err=True)
    return 1 if errors else 0


def _dialect(robotware: str | None) -> "Dialect | None":
    from rapidgen.rapid import Dialect
    from rapidgen.system.releases import release

    if robotware is None:
        return None
    return Dialect(release(robotware))


def _payload(robot: str) -> "Payload":
    """What a robot may carry; without a name what no robot exceeds."""
    from rapidgen.config.plausibility import LARGEST_PAYLOAD
    from rapidgen.rapid.checks import Payload

    result = _payload_of(robot, _robots(robot)) if robot else None
    return result or Payload("any robot of ABB", LARGEST_PAYLOAD)


def _robots(name: str) -> "Sequence[GroupConfig]":
    from rapidgen.controller.mechanics import robots_named

    return robots_named(name)


def _payload_of(name: str, groups: "Sequence[GroupConfig]") -> "Payload | None":
    """That of the strongest one; None where one is not known."""
    from rapidgen.rapid.checks import Payload

    if not groups or not all(group.max_payload for group in groups):
        return None
    return Payload(name, max(group.max_payload for group in groups))


def _payloads(groups: "Sequence[GroupConfig]", otherwise: "Payload") -> "dict[str, Payload]":
    """By the lower-case name of the task that moves the robot."""
    return {
        group.task.lower(): _payload_of(group.model or group.name, [group]) or otherwise
        for group in groups
    }


def _configuration(given: str, cell: "Cell | None") -> list[Diagnostic]:
    from rapidgen.config import load_config

    model = load_config(given)
    return [*model.diagnostics, *(_built(model) if cell is None else _on(cell, model))]


def _built(model: "RobotConfig") -> list[Diagnostic]:
    """What a build would refuse, for any controller."""
    from rapidgen.generate import build

    try:
        build(model)
    except DiagnosticError as fault:
        return list(fault.diagnostics)
    return []


def _on(cell: "Cell", model: "RobotConfig") -> list[Diagnostic]:
    """What is wrong with a configuration on the controller that it is for."""
    from rapidgen.generate import build
    from rapidgen.generate.existing_controller import fit

    notes = [note for note in cell.notes if note.code != "RG710"]
    try:
        build(fit(model, cell), cell)
    except DiagnosticError as fault:
        return [*notes, *fault.diagnostics]
    return notes


def _cell(backup: Path | None) -> "Cell | None":
    if backup is None:
        return None
    from rapidgen.generate.existing_controller import read_cell

    return read_cell(backup)


def _cfg(path: Path) -> None:
    from rapidgen.system import parse_cfg
    from rapidgen.system.paths import read_limited

    parse_cfg(read_limited(path), path=str(path))


def _modules(path: Path) -> list[Path]:
    """Module files that a file stands for: itself, or those of a program."""
    from rapidgen.system.loading import expand

    return expand(path)


def _parsed(paths: list[Path], dialect: "Dialect | None") -> "list[Module]":
    from rapidgen.rapid import parse
    from rapidgen.system.paths import read_limited

    return [parse(read_limited(path), path=str(path), dialect=dialect) for path in paths]


def _files(paths: list[Path], dialect: "Dialect | None", payload: "Payload") -> list[Diagnostic]:
    """Files named one by one: they know each other."""
    from rapidgen.rapid import check as check_rapid

    modules: list[Module] = []
    findings: list[Diagnostic] = []
    for path in paths:
        try:
            modules += _parsed([path], dialect)
        except DiagnosticError as fault:
            findings += fault.diagnostics
    return findings + check_rapid(modules, dialect=dialect, payloads={"": payload})


def _folder(
    path: Path, dialect: "Dialect | None", backup: Path | None, payload: "Payload"
) -> list[Diagnostic]:
    """A generated folder, a backup, or a folder with modules or such folders in it."""
    from rapidgen.rapid import check as check_rapid
    from rapidgen.system import is_backup, is_generated

    if is_generated(path) or is_backup(path):
        return _system(path, dialect, backup, payload)
    groups: list[list[Path]] = []
    systems: list[Path] = []
    _search(path, groups, systems)
    if not groups and not systems:
        raise _nothing(str(path))
    findings: list[Diagnostic] = []
    for system in systems:
        findings += _system(system, dialect, backup, payload)
    parsed = [_rapid(_parsed(files, dialect), findings) for files in groups]
    declared = [{_name(d).lower() for m in modules for d in m.declarations} for modules in parsed]
    for k, modules in enumerate(parsed):
        elsewhere = frozenset().union(*declared[:k], *declared[k + 1 :])
        findings += check_rapid(
            modules, dialect=dialect, elsewhere=elsewhere, payloads={"": payload}
        )
    return findings


def _rapid(modules: "list[Module]", findings: list[Diagnostic]) -> "list[Module]":
    """The modules of a folder that are RAPID; of the others a note is made."""
    from rapidgen.rapid.syntax.text import is_rapid

    saved = []
    for module in modules:
        wrong = any(d.severity is Severity.ERROR for d in module.diagnostics)
        if is_rapid(module) or not wrong:
            saved.append(module)
        else:
            at = Span(module.source.path, 1, 1)
            message = "the file is named like a module, but it is no RAPID: left out"
            findings.append(error("RG208", at, message, severity=Severity.INFO))
    return saved


def _name(declaration: "Declaration") -> str:
    return getattr(declaration, "name", "")


def _system(
    path: Path, dialect: "Dialect | None", backup: Path | None, payload: "Payload"
) -> list[Diagnostic]:
    from rapidgen.config import from_manifest
    from rapidgen.rapid import Dialect
    from rapidgen.rapid import check as check_rapid
    from rapidgen.system import is_generated, read_backup, read_folder, read_manifest

    if is_generated(path):
        own = from_manifest(read_manifest(path)["configuration"]).groups
        carried = _payloads(own, payload)
        return check_rapid(read_folder(path, backup), dialect=dialect, payloads=carried)
    notes: list[Diagnostic] = []
    system = read_backup(path, notes=notes)
    carried = _of_backup(system, payload)
    result = [
        *notes,
        *check_rapid(system, dialect=dialect, gaps=bool(notes), payloads=carried),
    ]
    dialect = dialect or Dialect(system.robotware, some=not system.is_robotware_known)
    return [*result, *_not_loaded(path, system, dialect, payload)]


def _of_backup(system: "System", otherwise: "Payload") -> "dict[str, Payload]":
    """Those of the robots of a backup, as far as they are known; what stands in says nothing."""
    from rapidgen.controller.mechanics import mechanics, motion_tasks

    try:
        return _payloads(mechanics(system)[0], otherwise)
    except DiagnosticError:
        # A type of robot that is not known: `run` says so, here it is no fault.
        return {task.lower(): otherwise for task in motion_tasks(system)}


def _not_loaded(
    path: Path, system: "System", dialect: "Dialect", payload: "Payload"
) -> list[Diagnostic]:
    """Errors in RAPID of a backup's HOME that no task loads: a program may, while it runs.

    Each is judged as a lone file. Its warnings are left out: HOME keeps old copies.
    """
    from rapidgen.system.paths import module_files

    if system.home is None:
        return []
    loaded = {file.path for task in system.tasks for file in task.modules}
    findings: list[Diagnostic] = []
    for folder in (system.home, *(f for f in sorted(system.home.rglob("*")) if f.is_dir())):
        try:
            files = [file for file in module_files(folder) if str(file) not in loaded]
        except DiagnosticError as fault:
            findings += fault.diagnostics
            continue
        for file in files:
            findings += _files([file], dialect, payload)
    return [d for d in findings if d.severity is Severity.ERROR]


def _search(folder: Path, groups: list[list[Path]], systems: list[Path]) -> None:
    """Groups of modules that belong together, and systems."""
    from rapidgen.system import is_backup, is_generated
    from rapidgen.system.paths import module_files

    subfolders = [f for f in sorted(folder.iterdir()) if f.is_dir() and not f.is_symlink()]
    together = [f for f in subfolders if f.name.upper() in _TASK_FOLDERS]
    modules = list(module_files(folder))
    for subfolder in together:
        modules += module_files(subfolder)
    if modules:
        groups.append(modules)
    for subfolder in subfolders:
        if is_generated(subfolder) or is_backup(subfolder):
            systems.append(subfolder)
        elif subfolder not in together:
            _search(subfolder, groups, systems)


def _nothing(given: str) -> Exception:
    return refusal(
        "RG904",
        None,
        f"there is nothing to check at {given}",
        "name a configuration, a RAPID file, a folder with modules or a backup",
    )
