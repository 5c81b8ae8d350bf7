"""The commands `check` and `fmt`: configurations and RAPID sources."""

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
            help="Configurations, shipped names, RAPID files, folders or backups.",
            metavar="PATH",
        ),
    ],
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
    format: Annotated[Format, typer.Option(help="Format of the findings.")] = Format.FULL,
    as_json: Annotated[bool, typer.Option("--json", help="Same as --format json.")] = False,
) -> int:
    """Check configurations and RAPID files.

    A single file may use names of other modules; a backup may not. With --backup, configurations
    and generated folders are checked for that controller. Reads only.
    """
    format = Format.JSON if as_json else format
    dialect = _dialect(robotware)
    payload = _payload(robot)
    cell = _cell(backup)
    findings: list[Diagnostic] = []
    modules: list[Path] = []
    for name in paths:
        path = Path(name)
        is_name = not path.exists() and not path.suffix and len(path.parts) == 1
        try:
            if is_name or path.suffix.lower() in _CONFIG_SUFFIXES:
                findings += _configuration(name, cell)
            elif path.is_dir():
                findings += _folder(path, dialect, backup, payload)
            elif not path.exists():
                raise _nothing_to_check(name)
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
    """Return a robot's maximum payload; without a name, that of the strongest ABB robot."""
    from rapidgen.config.plausibility import LARGEST_PAYLOAD
    from rapidgen.rapid.checks import Payload

    result = _payload_of(robot, _robots(robot)) if robot else None
    return result or Payload("any robot of ABB", LARGEST_PAYLOAD)


def _robots(name: str) -> "Sequence[GroupConfig]":
    from rapidgen.controller.mechanics import robots_named

    return robots_named(name)


def _payload_of(name: str, groups: "Sequence[GroupConfig]") -> "Payload | None":
    """Return the largest payload of some groups; None if one is unknown."""
    from rapidgen.rapid.checks import Payload

    if not groups or not all(group.max_payload for group in groups):
        return None
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


def _parsed(paths: list[Path], dialect: "Dialect | None") -> "list[Module]":
    from rapidgen.rapid import parse
    from rapidgen.system.paths import read_limited

    return [parse(read_limited(path), path=str(path), dialect=dialect) for path in paths]


def _files(paths: list[Path], dialect: "Dialect | None", payload: "Payload") -> list[Diagnostic]:
    """Check files that were named one by one; they see each other's names."""
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
    """Check a generated folder, a backup, or a folder that contains modules or such folders."""
    from rapidgen.rapid import check as check_rapid
    from rapidgen.system import is_backup, is_generated

    if is_generated(path) or is_backup(path):
        return _system(path, dialect, backup, payload)
    groups: list[list[Path]] = []
    systems: list[Path] = []
    _search(path, groups, systems)
    if not groups and not systems:
        raise _nothing_to_check(str(path))
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
    """Return the payloads of the robots of a backup, as far as they are known."""
    from rapidgen.controller.mechanics import mechanics, motion_tasks

    try:
        return _payloads(mechanics(system)[0], otherwise)
    except DiagnosticError:
        # An unknown robot type is an error of `run` only.
        return {task.lower(): otherwise for task in motion_tasks(system)}


def _not_loaded(
    path: Path, system: "System", dialect: "Dialect", payload: "Payload"
) -> list[Diagnostic]:
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
            findings += _files([file], dialect, payload)
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


_SUFFIXES = (".mod", ".modx", ".sys", ".sysx", ".prg")


def fmt(
    paths: Annotated[list[Path], typer.Argument(help="RAPID files or folders.", metavar="PATH")],
    check: Annotated[
        bool, typer.Option("--check", help="Do not write; exit with 1 if a file would change.")
    ] = False,
    diff: Annotated[bool, typer.Option("--diff", help="Do not write; show the changes.")] = False,
) -> int:
    """Format RAPID source files.

    Writes keywords in upper case and indents by four spaces; comments stay. The encoding and the
    line ends stay, unless a file mixes line ends: it gets the most frequent one, with a message.
    Files with syntax errors are not changed.
    """
    from rapidgen._atomic_write import write_whole
    from rapidgen.rapid import format_source
    from rapidgen.system.paths import read_limited

    wrong: list[Diagnostic] = []
    changed = 0
    for path in _files_to_format(paths):
        before = read_limited(path)
        try:
            after = format_source(before, path=str(path))
        except DiagnosticError as fault:
            if any(d.severity is Severity.ERROR for d in fault.diagnostics):
                wrong += fault.diagnostics
            else:
                typer.echo(f"skipped {path}: {fault.diagnostics[0].message}", err=True)
            continue
        if after == before:
            continue
        changed += 1
        ends = _line_ends(before)
        if len(ends) > 1:
            displayed = ", ".join(f"{number} {name}" for name, number in ends)
            typer.echo(
                f"{path} mixes line ends ({displayed}): all changed to {ends[0][0]}", err=True
            )
        if diff:
            typer.echo(_difference(path, before, after), nl=False)
        elif check:
            typer.echo(f"would format {path}", err=True)
        else:
            write_whole(path, after)
            typer.echo(f"formatted {path}", err=True)
    if wrong:
        raise DiagnosticError(wrong, exit_code=1)
    return 1 if changed and (check or diff) else 0


def _line_ends(data: bytes) -> list[tuple[str, int]]:
    """Count the line ends of a file; the most frequent is first."""
    pairs, feeds, returns = data.count(b"\r\n"), data.count(b"\n"), data.count(b"\r")
    result = {"CRLF": pairs, "LF": feeds - pairs, "CR": returns - pairs}
    return sorted(((k, v) for k, v in result.items() if v), key=lambda pair: -pair[1])


def _files_to_format(paths: list[Path]) -> list[Path]:
    result: list[Path] = []
    for path in paths:
        if path.is_dir():
            inside = sorted(
                file
                for file in path.rglob("*")
                if file.suffix.lower() in _SUFFIXES and file.is_file()
            )
            if not inside:
                help = f"RAPID files end in {', '.join(sorted(_SUFFIXES))}"
                raise refusal("RG904", None, f"no RAPID file in {path}", help)
            result += inside
        elif path.exists():
            result.append(path)
        else:
            raise refusal("RG904", None, f"{path} does not exist", "use RAPID files or folders")
    return result


def _difference(path: Path, before: bytes, after: bytes) -> str:
    from difflib import unified_diff

    from rapidgen.rapid.syntax.lexer import decode

    old = [line + "\n" for line in decode(before)[0].splitlines()]
    new = [line + "\n" for line in decode(after)[0].splitlines()]
    return "".join(unified_diff(old, new, f"a/{path}", f"b/{path}"))
