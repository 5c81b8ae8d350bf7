"""`rapidgen check`: configurations, RAPID files, folders, generated folders and backups."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rapidgen.diagnostics import Format

if TYPE_CHECKING:
    from rapidgen.diagnostics import Diagnostic
    from rapidgen.rapid import Dialect
    from rapidgen.rapid.nodes import Module

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
    format: Annotated[Format, typer.Option(help="How findings are shown.")] = Format.FULL,
) -> int:
    """Say everything that is wrong with configurations and RAPID.

    What is unknown is judged by what was given: a lone file may use names of modules that are
    not there, a backup may not.
    """
    from rapidgen.cli.terminal import use_colour
    from rapidgen.diagnostics import DiagnosticError, Severity, render

    dialect = _dialect(robotware)
    found: list[Diagnostic] = []
    modules: list[Path] = []
    for given in paths:
        path = Path(given)
        is_name = not path.exists() and not path.suffix and len(path.parts) == 1
        try:
            if is_name or path.suffix.lower() in _CONFIG_SUFFIXES:
                found += _configuration(given)
            elif path.is_dir():
                found += _folder(path, dialect)
            elif not path.exists():
                raise _nothing(given)
            elif path.suffix.lower() == ".cfg":
                _cfg(path)
            else:
                modules += _modules(path)
        except DiagnosticError as error:
            if not path.exists():
                raise
            found += error.diagnostics
    found += _files(modules, dialect)
    import sys

    typer.echo(render(found, format, colour=use_colour(sys.stdout)), nl=False)
    errors = sum(d.severity is Severity.ERROR for d in found)
    if format is Format.FULL:
        warnings = sum(d.severity is Severity.WARNING for d in found)
        typer.echo(f"{errors} error(s), {warnings} warning(s)", err=True)
    return 1 if errors else 0


def _dialect(robotware: str | None) -> "Dialect | None":
    from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity
    from rapidgen.rapid import Dialect

    if robotware is None:
        return None
    major, _, minor = robotware.partition(".")
    if not major.isdigit() or not (minor == "" or minor.isdigit()) or not 5 <= int(major) <= 7:
        raise DiagnosticError(
            Diagnostic(
                "RG901",
                Severity.ERROR,
                f"'{robotware}' is not a RobotWare version",
                help="give 5, 6 or 7, with a minor version if it matters: 6.15",
            )
        )
    # A major version alone means all of that line.
    return Dialect((int(major), int(minor) if minor else 99))


def _configuration(given: str) -> "list[Diagnostic]":
    from rapidgen.config import load_config

    return list(load_config(given).diagnostics)


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


def _files(paths: list[Path], dialect: "Dialect | None") -> "list[Diagnostic]":
    """Files named one by one: they know each other, but hardly make a whole task."""
    from rapidgen.diagnostics import Diagnostic, DiagnosticError
    from rapidgen.rapid import check as check_rapid

    modules: list[Module] = []
    found: list[Diagnostic] = []
    for path in paths:
        try:
            modules += _parsed([path], dialect)
        except DiagnosticError as error:
            found += error.diagnostics
    if len(modules) == 1:
        return found + check_rapid(modules[0], dialect=dialect)
    return found + check_rapid(modules, dialect=dialect, gaps=True)


def _folder(path: Path, dialect: "Dialect | None") -> "list[Diagnostic]":
    """A generated folder, a backup, or a folder with modules somewhere in it."""
    from rapidgen.rapid import check as check_rapid
    from rapidgen.system import is_backup, is_generated, read_backup, read_folder

    notes: list[Diagnostic] = []
    if is_generated(path):
        return check_rapid(read_folder(path), dialect=dialect)
    if is_backup(path):
        system = read_backup(path, notes=notes)
        return [*notes, *check_rapid(system, dialect=dialect, gaps=bool(notes))]
    found: list[Diagnostic] = []
    groups = list(_groups(path))
    if not groups:
        raise _nothing(str(path))
    for modules, whole in groups:
        gaps = path.name.upper() in _TASK_FOLDERS
        found += check_rapid(
            _parsed(modules, dialect), dialect=dialect, whole_task=whole, gaps=gaps
        )
    return found


def _groups(folder: Path) -> Iterator[tuple[list[Path], bool]]:
    """Module files that belong together, and whether they are all of a task."""
    from rapidgen.system.paths import module_files

    subfolders = [f for f in sorted(folder.iterdir()) if f.is_dir() and not f.is_symlink()]
    together = [f for f in subfolders if f.name.upper() in _TASK_FOLDERS]
    modules = list(module_files(folder))
    for subfolder in together:
        modules += module_files(subfolder)
    if modules:
        yield modules, bool(together)
    for subfolder in subfolders:
        if subfolder not in together:
            yield from _groups(subfolder)


def _nothing(given: str) -> Exception:
    from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity

    return DiagnosticError(
        Diagnostic(
            "RG904",
            Severity.ERROR,
            f"there is nothing to check at {given}",
            help="name a configuration, a RAPID file, a folder with modules or a backup",
        )
    )
