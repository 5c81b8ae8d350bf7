"""The command `check`: findings in configurations and RAPID sources."""

import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rapidgen.cli.project import FileEncoding, project_folders, project_robots
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
from rapidgen.diagnostics.render import read_lines
from rapidgen.system.project import find_project

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from rapidgen.config.model import GroupConfig, RobotConfig
    from rapidgen.generate.existing_controller import Cell
    from rapidgen.rapid import Dialect
    from rapidgen.rapid.checks import Payload
    from rapidgen.rapid.syntax.nodes import Declaration, Module
    from rapidgen.system import System
    from rapidgen.system.project import Project


_CONFIG_SUFFIXES = (".yaml", ".yml")
_TASK_FOLDERS = ("PROGMOD", "SYSMOD")
_MAX_ROUNDS = 5
"""Rounds of fixes in one command."""


@dataclass(frozen=True, slots=True, eq=False)
class _Settings:
    """Settings of a check: those of the command line, else of the project file."""

    dialect: "Dialect | None"
    robot_payload: "Payload | None"
    strict: bool
    project: "Project | None"
    encoding: FileEncoding = FileEncoding.LATIN_1

    @property
    def payload(self) -> "Payload":
        """Return the maximum payload of the robot, else that of the strongest ABB robot."""
        from rapidgen.config.plausibility import LARGEST_PAYLOAD
        from rapidgen.rapid.checks import Payload

        return self.robot_payload or Payload("any robot of ABB", LARGEST_PAYLOAD)

    def dialect_of(self, system: "System | None" = None) -> "Dialect":
        """Return the dialect that was asked for, else that of a system's release."""
        from rapidgen.rapid import Dialect

        if self.dialect is not None:
            return self.dialect
        other = self.encoding.value
        if system is None:
            return Dialect(encoding=other)
        return Dialect(system.robotware, not system.is_robotware_known, other)


def check(
    paths: Annotated[
        list[str] | None,
        typer.Argument(
            help="Configurations, shipped names, RAPID files, folders or backups; default: those "
            "of the project file.",
            metavar="PATH",
        ),
    ] = None,
    robotware: Annotated[
        str | None,
        typer.Option(help="RobotWare version, such as 6.15; default: 6.", metavar="VERSION"),
    ] = None,
    backup: Annotated[
        Path | None,
        typer.Option(
            help="Backup of the controller for configurations and generated folders.",
            metavar="FOLDER",
        ),
    ] = None,
    robot: Annotated[
        str, typer.Option(help="Robot of the RAPID files, for its maximum payload.", metavar="NAME")
    ] = "",
    in_cell: Annotated[
        Path | None,
        typer.Option(
            "--cell",
            help="Cell file: check trajectories (.csv, .json) or a program for collisions.",
            metavar="FILE",
        ),
    ] = None,
    plot: Annotated[
        Path | None,
        typer.Option(help="Plot of the clearance over time: .html, .png, .svg.", metavar="FILE"),
    ] = None,
    srdf: Annotated[
        Path | None,
        typer.Option(
            help="Write the pairs of links that --cell does not check into an SRDF of MoveIt.",
            metavar="FILE",
        ),
    ] = None,
    strict: Annotated[
        bool | None,
        typer.Option(
            "--strict/--no-strict",
            help="Report each undeclared name as an error.",
            show_default=False,
        ),
    ] = None,
    format: Annotated[Format, typer.Option(help="Format of the findings.")] = Format.FULL,
    as_json: Annotated[bool, typer.Option("--json", help="Same as --format json.")] = False,
    fix: Annotated[
        bool, typer.Option("--fix", help="Write safe corrections into RAPID files first.")
    ] = False,
    encoding: Annotated[
        FileEncoding | None,
        typer.Option(help="Encoding of RAPID files that are not UTF-8; default: Latin-1."),
    ] = None,
) -> int:
    """Check configurations and RAPID files.

    A single file may use names of other modules; a backup may not. With --backup, configurations
    and generated folders are checked for that controller. With --cell, the path of a trajectory
    or a program is checked for collisions. Defaults are in the project file, rapidgen.toml. Reads
    only, unless --fix is given.
    """
    format = Format.JSON if as_json else format
    for option, value in (("--plot", plot), ("--srdf", srdf)):
        if value is not None and in_cell is None:
            raise refusal("RG901", None, f"{option} needs --cell", "add --cell FILE")
    if srdf is not None and in_cell is not None:
        from rapidgen.cli.collisions import write_cell_srdf

        write_cell_srdf(in_cell, srdf)
        if not paths:
            return 0
    trajectories: list[Path] = []
    if in_cell is not None:
        from rapidgen.cli.collisions import TRAJECTORIES

        trajectories = [Path(p) for p in paths or () if Path(p).suffix.lower() in TRAJECTORIES]
        paths = [name for name in paths or () if Path(name) not in trajectories]
    cell = _cell(backup)
    names = paths or ([] if trajectories else _paths_of_project())
    other = encoding or FileEncoding.LATIN_1

    def settings_of(project: "Project | None") -> _Settings:
        return _settings(project, robotware, robot, strict, other)

    findings = _findings_of(names, cell, backup, settings_of)
    if fix:
        from rapidgen.cli.safe_fixes import apply_safe_fixes

        # A syntax error hides other findings of its routine, so that a fix may bring further ones.
        for _ in range(_MAX_ROUNDS):
            if not apply_safe_fixes(findings, other):
                break
            findings = _findings_of(names, cell, backup, settings_of)
    if in_cell is not None and not any(d.severity is Severity.ERROR for d in findings):
        from rapidgen.cli.collisions import check_in_cell

        findings += check_in_cell([*trajectories, *map(Path, names)], in_cell, plot)
    import sys

    lines_of = partial(read_lines, otherwise=other.value)
    colour = use_colour(sys.stdout)
    typer.echo(render(findings, format, lines_of=lines_of, colour=colour), nl=False)
    errors = sum(d.severity is Severity.ERROR for d in findings)
    if format is Format.FULL:
        warnings = sum(d.severity is Severity.WARNING for d in findings)
        typer.echo(f"{errors} error(s), {warnings} warning(s)", err=True)
    return 1 if errors else 0


def _findings_of(
    names: "Sequence[str]",
    cell: "Cell | None",
    backup: Path | None,
    settings_of: "Callable[[Project | None], _Settings]",
) -> list[Diagnostic]:
    """Return the findings of all that a command names, each with the settings of its project."""
    findings: list[Diagnostic] = []
    modules: dict[_Settings, list[Path]] = {}
    known: dict[Path | None, _Settings] = {}
    for name in names:
        path = Path(name)
        is_name = not path.exists() and not path.suffix and len(path.parts) == 1
        project = find_project(path)
        key = project.path if project is not None else None
        if key not in known:
            known[key] = settings_of(project)
        settings = known[key]
        found: list[Diagnostic] = []
        try:
            if is_name or path.suffix.lower() in _CONFIG_SUFFIXES:
                found += _configuration(name, cell)
            elif path.is_dir():
                found += _folder(path, backup, settings)
            elif not path.exists():
                raise _nothing_to_check(name)
            elif path.suffix.lower() == ".cfg":
                _cfg(path)
            else:
                modules.setdefault(settings, []).extend(_modules(path))
        except DiagnosticError as fault:
            if not path.exists():
                raise
            found += fault.diagnostics
        findings += _reported(found, settings)
    for settings, files in modules.items():
        findings += _reported(_named(files, settings), settings)
    return findings


def _paths_of_project() -> list[str]:
    """Return what to check if the command names nothing."""
    help = "name a configuration, a RAPID file, a folder with modules or a backup"
    return list(map(str, project_folders("check", help)))


def _settings(
    project: "Project | None",
    robotware: str | None,
    robot: str,
    strict: bool | None,
    encoding: FileEncoding,
) -> _Settings:
    """Combine options and project file; options take precedence."""
    if project is None:
        dialect = _dialect(robotware, encoding)
        return _Settings(dialect, _payload(robot), bool(strict), None, encoding)
    is_strict = project.strict if strict is None else strict
    if robotware is None:
        robotware = project.robotware or None
    if robot or not project.robot:
        payload = _payload(robot)
    else:
        payload = _payload_of(project.robot, project_robots(project))
    dialect = _dialect(robotware, encoding)
    return _Settings(dialect, payload, is_strict, project, encoding)


def _reported(findings: "Iterable[Diagnostic]", settings: _Settings) -> list[Diagnostic]:
    project = settings.project
    found = [d for d in findings if project is None or project.is_reported(d)]
    return _without_repetitions(found)


def _without_repetitions(findings: list[Diagnostic]) -> list[Diagnostic]:
    """Report findings of equal files, and the encoded modules of a folder, once."""
    encoded = [d for d in findings if d.code == "RG219" and d.span is not None]
    if len(encoded) > 1:
        names = tuple(d.span.path for d in encoded if d.span is not None)
        message = f"{len(encoded)} modules are encoded: only a controller can read them"
        one = replace(encoded[0], message=message, notes=names)
        findings = [
            one if d is encoded[0] else d for d in findings if d is encoded[0] or d not in encoded
        ]
    return _of_different_files(findings)


def _of_different_files(findings: list[Diagnostic]) -> list[Diagnostic]:
    """Merge findings that are the same in equal files, such as copies in several backups."""
    paths = {d.span.path for d in findings if d.span is not None}
    contents = {path: _content(path) for path in paths} if len(paths) > 1 else {}
    first: dict[object, Diagnostic] = {}
    further: dict[object, int] = {}
    for d in findings:
        content = contents.get(d.span.path, b"") if d.span is not None else b""
        key = (d.code, d.message, content, replace(d.span, path="")) if content and d.span else d
        if key in first:
            further[key] = further.get(key, 0) + 1
        else:
            first[key] = d
    return [
        d if key not in further else replace(d, notes=(*d.notes, _also_in(further[key])))
        for key, d in first.items()
    ]


def _content(path: str) -> bytes:
    """Return a digest of a file; empty if it cannot be read."""
    from hashlib import sha256

    try:
        return sha256(Path(path).read_bytes()).digest()
    except OSError:
        return b""


def _also_in(count: int) -> str:
    return f"also in {count} equal file{'' if count == 1 else 's'}"


def _dialect(robotware: str | None, encoding: FileEncoding) -> "Dialect | None":
    from rapidgen.rapid import Dialect
    from rapidgen.system.releases import release

    if robotware is None:
        return None
    return Dialect(release(robotware), encoding=encoding.value)


def _payload(robot: str) -> "Payload | None":
    """Return a robot's maximum payload; None without a name, or if it is unknown."""
    return _payload_of(robot, _robots(robot)) if robot else None


def _robots(name: str) -> "Sequence[GroupConfig]":
    from rapidgen.controller.mechanics import robots_named

    return robots_named(name)


def _payload_of(name: str, groups: "Sequence[GroupConfig]") -> "Payload | None":
    """Return the largest payload of some groups; None if one is unknown."""
    if not groups or not all(group.max_payload for group in groups):
        return None
    from rapidgen.rapid.checks import Payload

    return Payload(name, max(group.max_payload for group in groups))


def _payloads(groups: "Sequence[GroupConfig]", otherwise: "Payload") -> "dict[str, Payload]":
    """Map the lower-case name of each motion task to its payload."""
    return {
        group.task.lower(): _payload_of(group.model or group.name, [group]) or otherwise
        for group in groups
    }


def _configuration(name: str, cell: "Cell | None") -> list[Diagnostic]:
    from rapidgen.config import load_config

    model = load_config(name)
    return [*model.diagnostics, *(_built(model) if cell is None else _on(cell, model))]


def _built(model: "RobotConfig") -> list[Diagnostic]:
    """Return the errors of a build for any controller."""
    from rapidgen.generate import build

    try:
        build(model)
    except DiagnosticError as fault:
        return list(fault.diagnostics)
    return []


def _on(cell: "Cell", model: "RobotConfig") -> list[Diagnostic]:
    """Return the findings about a configuration on one controller."""
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
    """Return the module files of a path: the file, or those of a program file."""
    from rapidgen.system.loading import expand

    return expand(path)


def _parsed(paths: list[Path], dialect: "Dialect") -> "list[Module]":
    from rapidgen.rapid import parse
    from rapidgen.system.paths import read_limited

    return [parse(read_limited(path), path=str(path), dialect=dialect) for path in paths]


def _named(paths: list[Path], settings: _Settings) -> list[Diagnostic]:
    """Check files that were named one by one; those of a project in its tasks."""
    findings, remaining = _in_tasks(paths, settings)
    return findings + _files(remaining, settings)


def _files(paths: list[Path], settings: _Settings) -> list[Diagnostic]:
    """Check files that belong together; they see each other's names."""
    from rapidgen.rapid import check as check_rapid

    modules: list[Module] = []
    findings: list[Diagnostic] = []
    for path in paths:
        try:
            modules += _parsed([path], settings.dialect_of())
        except DiagnosticError as fault:
            findings += fault.diagnostics
    return findings + check_rapid(
        modules,
        dialect=settings.dialect_of(),
        payloads={"": settings.payload},
        strict=settings.strict,
    )


def _in_tasks(paths: list[Path], settings: _Settings) -> tuple[list[Diagnostic], list[Path]]:
    """Check files in the tasks of their project; return the files that are in none."""
    from rapidgen.rapid import check as check_rapid
    from rapidgen.system import read_files
    from rapidgen.system.releases import UNKNOWN_ROBOTWARE, release

    project = settings.project
    if project is None or not project.tasks or not paths:
        return [], paths
    robotware = release(project.robotware) if project.robotware else UNKNOWN_ROBOTWARE
    system = read_files(project.sources, robotware=robotware)
    loaded = {os.path.realpath(file.path) for task in system.tasks for file in task.modules}
    here = {os.path.realpath(path) for path in paths}
    if not loaded & here:
        return [], paths
    found = check_rapid(
        system,
        dialect=settings.dialect_of(system),
        gaps=not settings.strict,
        payloads={task.name.lower(): settings.payload for task in system.tasks if task.motion},
        strict=settings.strict,
        configured=bool(project.cfg),
    )
    findings = [d for d in found if d.span is None or os.path.realpath(d.span.path) in here]
    return findings, [path for path in paths if os.path.realpath(path) not in loaded]


def _folder(path: Path, backup: Path | None, settings: _Settings) -> list[Diagnostic]:
    """Check a generated folder, a backup, or a folder that contains modules or such folders."""
    from rapidgen.rapid import check as check_rapid
    from rapidgen.system import is_backup, is_generated

    if is_generated(path) or is_backup(path):
        return _system(path, backup, settings)
    groups: list[list[Path]] = []
    systems: list[Path] = []
    _search(path, groups, systems)
    if not groups and not systems:
        raise _nothing_to_check(str(path))
    findings: list[Diagnostic] = []
    for system in systems:
        findings += _system(system, backup, settings)
    in_tasks, remaining = _in_tasks([file for group in groups for file in group], settings)
    findings += in_tasks
    groups = [rest for group in groups if (rest := [f for f in group if f in remaining])]
    parsed = [_rapid(_parsed(files, settings.dialect_of()), findings) for files in groups]
    declared = [{_name(d).lower() for m in modules for d in m.declarations} for modules in parsed]
    for k, modules in enumerate(parsed):
        elsewhere = frozenset().union(*declared[:k], *declared[k + 1 :])
        findings += check_rapid(
            modules,
            dialect=settings.dialect_of(),
            elsewhere=elsewhere,
            payloads={"": settings.payload},
            strict=settings.strict,
        )
    return findings


def _rapid(modules: "list[Module]", findings: list[Diagnostic]) -> "list[Module]":
    """Return the modules that are RAPID; add a finding for each other file."""
    from rapidgen.rapid.syntax.text import is_rapid

    saved = []
    for module in modules:
        wrong = any(d.severity is Severity.ERROR for d in module.diagnostics)
        if is_rapid(module) or not wrong:
            saved.append(module)
        else:
            at = Span(module.source.path, 1, 1)
            message = "the file has the suffix of a module, but contains no RAPID: skipped"
            findings.append(error("RG208", at, message, severity=Severity.INFO))
    return saved


def _name(declaration: "Declaration") -> str:
    return getattr(declaration, "name", "")


def _system(path: Path, backup: Path | None, settings: _Settings) -> list[Diagnostic]:
    from rapidgen.config import from_manifest
    from rapidgen.rapid import check as check_rapid
    from rapidgen.system import is_generated, read_backup, read_folder, read_manifest

    payload, strict = settings.payload, settings.strict
    if is_generated(path):
        own = from_manifest(read_manifest(path)["configuration"]).groups
        carried = _payloads(own, payload)
        system = read_folder(path, backup)
        dialect = settings.dialect_of(system)
        return check_rapid(system, dialect=dialect, payloads=carried, strict=strict)
    notes: list[Diagnostic] = []
    system = read_backup(path, notes=notes)
    carried = _of_backup(system, payload)
    dialect = settings.dialect_of(system)
    result = [
        *notes,
        *check_rapid(system, dialect=dialect, gaps=bool(notes), payloads=carried, strict=strict),
    ]
    return [*result, *_not_loaded(system, replace(settings, dialect=dialect, strict=False))]


def _of_backup(system: "System", otherwise: "Payload") -> "dict[str, Payload]":
    """Return the payloads of the robots of a backup, as far as they are known."""
    from rapidgen.controller.mechanics import mechanics, motion_tasks

    try:
        return _payloads(mechanics(system)[0], otherwise)
    except DiagnosticError:
        # An unknown robot type is an error of `run` only.
        return {task.lower(): otherwise for task in motion_tasks(system)}


def _not_loaded(system: "System", settings: _Settings) -> list[Diagnostic]:
    """Return errors in RAPID files of a backup's HOME that no task loads.

    A program may load them while it runs. Each is checked as a single file, without warnings,
    because HOME often contains old copies.
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
            findings += _files([file], settings)
    return [d for d in findings if d.severity is Severity.ERROR]


def _search(folder: Path, groups: list[list[Path]], systems: list[Path]) -> None:
    """Collect the modules of each task, and the systems, below a folder."""
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


def _nothing_to_check(path: str) -> Exception:
    return refusal(
        "RG904",
        None,
        f"nothing to check at {path}",
        "use a configuration, a RAPID file, a folder with modules or a backup",
    )
