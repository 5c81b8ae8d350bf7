"""Options of `run` and `sim` for booting, the load check, and reports on inference."""

import shlex
import sys
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rapidgen.cli.project import project_robots
from rapidgen.cli.terminal import letters, use_colour
from rapidgen.diagnostics import DiagnosticError, Severity, refusal, render, suggest
from rapidgen.system.project import find_project

if TYPE_CHECKING:
    from rapidgen.controller.boot_targets import Bootable
    from rapidgen.controller.cell_setup import InferenceLog
    from rapidgen.controller.inference.answers import Answer
    from rapidgen.controller.inference.cell import UndeclaredName
    from rapidgen.rapid.switches import Switches
    from rapidgen.system.project import Project

_UNKNOWN_NAMES = frozenset(("RG301", "RG302", "RG303"))


_DEPTH, _WIDTH, _SHOWN = 3, 100, 4
"""Search for builds and backups: levels of folders, folders of each, names shown."""


def load_boot_target(
    targets: Sequence[str],
    *,
    tasks: Iterable[str] | None = None,
    robot: str = "",
    robotware: str = "",
    entry: str = "",
    cell: str = "",
    start: str = "",
    backup: Path | None = None,
    overrides: Sequence[str] | None = None,
    check: bool = True,
) -> "Bootable":
    """Read the files to boot; reject what no controller loads, unless `check` is False.

    Prints notes and inferred declarations on stderr. Raises DiagnosticError.
    """
    from rapidgen.controller.boot_targets import INFER, BootOptions, load_target

    if cell and cell != INFER and not Path(cell).exists():
        help = suggest(cell, [INFER]) or f"use the file of a cell description, or `{INFER}`"
        raise refusal("RG001", None, f"cannot read {cell}: No such file or directory", help)

    by_task: Mapping[str, Sequence[Path | str]] = _tasks(tasks or ())
    files = [*targets, *(file for files in by_task.values() for file in files)]
    project = find_project(Path(files[0]) if files else Path())
    if project is not None:
        if not files:
            by_task = project.sources
        if not _describes_itself(targets):
            if project.robot and not robot:
                project_robots(project)
                robot = project.robot
            robotware = robotware or project.robotware
    options = BootOptions(
        by_task,
        robot=robot,
        robotware=_release(robotware),
        entry=entry,
        cell=cell,
        start=_numbers(start),
        backup=backup,
        overrides=tuple(overrides or ()),
    )
    try:
        result = load_target(targets, options)
    except DiagnosticError as fault:
        raise _with_systems_below(fault, targets) from fault
    notes = [d for d in result.notes if project is None or project.is_reported(d)]
    if notes:
        sys.stderr.write(render(notes, colour=use_colour()))
    if result.likely is not None:
        robot_model = result.likely
        reach = f"reaches {robot_model.reached} of {robot_model.targets} targets of the program"
        sys.stderr.write(f"inferred robot: {robot_model.model}, {reach}\n")
    if result.guessed is not None:
        sys.stderr.write(_table("inferred", result.guessed.named))
        sys.stderr.write(_table("undeclared, and not inferred", result.guessed.unknown))
    if check:
        _reject_unloadable(result, project)
    return result


def _with_systems_below(fault: DiagnosticError, targets: Sequence[str]) -> DiagnosticError:
    """Add builds and backups below a folder without modules to its error."""
    from rapidgen.system import is_backup, is_generated

    folder = Path(targets[0]) if len(targets) == 1 else None
    if fault.diagnostics[0].code != "RG709" or folder is None or not folder.is_dir():
        return fault
    found: list[Path] = []
    level = [folder]
    for _ in range(_DEPTH):
        level = [below for one in level for below in _folders(one)]
        found += [one for one in level if is_generated(one) or is_backup(one)]
    if not found:
        return fault
    names = ", ".join(letters(str(one)) for one in found[:_SHOWN])
    more = f" and {len(found) - _SHOWN} more" if len(found) > _SHOWN else ""
    return refusal(
        "RG709",
        None,
        f"{fault.diagnostics[0].message} itself; below it: {names}{more}",
        f"name one: `rapidgen run {shlex.quote(str(found[0]))}`",
    )


def _folders(folder: Path) -> list[Path]:
    """Return the first folders in a folder; hidden and unreadable ones are left out."""
    try:
        inside = sorted(one for one in folder.iterdir() if not one.name.startswith("."))
        return [one for one in inside if one.is_dir()][:_WIDTH]
    except OSError:
        return []


def assumptions(text: str) -> "Switches":
    """Return the switches of `--assume`. Raises DiagnosticError RG901."""
    from dataclasses import fields

    from rapidgen.rapid.switches import Switches, parse_switches

    try:
        return parse_switches(text)
    except ValueError as fault:
        names = ", ".join(switch.name for switch in fields(Switches))
        raise refusal(
            "RG901", None, f"--assume: {fault}", f"write SWITCH=VALUE; switches: {names}"
        ) from fault


def _describes_itself(targets: Sequence[str]) -> bool:
    """Return True if a target has its own robot and release: all except loose files."""
    from rapidgen.controller.boot_targets import is_configuration
    from rapidgen.system import is_backup, is_generated

    only = Path(targets[0]) if len(targets) == 1 else None
    return only is not None and (
        is_configuration(only) or (only.is_dir() and (is_generated(only) or is_backup(only)))
    )


def _release(text: str) -> tuple[int, int] | None:
    from rapidgen.system.releases import ANY_MINOR, release

    if not text:
        return None
    major, minor = release(text)
    if minor == ANY_MINOR:
        raise refusal(
            "RG901",
            None,
            f"--robotware {text} is not a single version",
            f"such as --robotware {major}.6",
        )
    return major, minor


def _tasks(options: Iterable[str]) -> dict[str, list[str]]:
    by_task: dict[str, list[str]] = {}
    for text in options:
        name, equals, names = text.partition("=")
        if not equals or not name or not names:
            raise refusal(
                "RG901",
                None,
                f"--task '{text}' is not NAME=FILE,FILE",
                "such as --task T_ROB1=main.mod,data.mod",
            )
        by_task.setdefault(name, []).extend(names.split(","))
    return by_task


def _numbers(text: str) -> tuple[float, ...]:
    try:
        return tuple(float(part) for part in text.strip("[] ").split(",")) if text else ()
    except ValueError as fault:
        help = "such as --start 0,0,0,0,30,0"
        raise refusal("RG901", None, f"--start '{text}' is not a list of numbers", help) from fault


def _table(title: str, rows: "Sequence[UndeclaredName]") -> str:
    if not rows:
        return ""
    width = max(len(row.name) for row in rows)
    kind = max(9, *(len(row.type) for row in rows))
    lines = (
        f"  {row.name:{width}}  {row.type or '?':{kind}}  "
        f"{Path(row.span.path).name}:{row.span.line}\n"
        for row in sorted(rows, key=lambda row: (row.type, row.name.casefold()))
    )
    return f"{title}:\n{''.join(lines)}"


def inference_report(log: "InferenceLog") -> str:
    """Report values of inferred inputs, answers to dialogs, restarts and missed targets."""
    answered = "inferred, because the program waited for it"
    missed = "the inferred robot did not reach it as programmed (`--robot` selects another)"
    restarted = "stopped after an inferred answer, restarted from main"
    disks = ", ".join(disk.upper() for disk in log.disks)
    return (
        (f"inferred disks, each an empty folder: {disks}\n" if disks else "")
        + _counted(answered, " = ", log.answered)
        + _counted(restarted, ": ", log.stopped)
        + _counted(missed, ": ", log.missed)
    )


def _counted(title: str, between: str, message: "Iterable[Answer]") -> str:
    texts = [
        f"{name}{between}{value if isinstance(value, str) else f'{value:g}'}"
        + (f" ({count} times)" if count > 1 else "")
        for (name, value), count in Counter(message).items()
    ]
    return f"{title}: {', '.join(texts)}\n" if texts else ""


def _reject_unloadable(result: "Bootable", project: "Project | None") -> None:
    """Raise the errors of the load check.

    Undeclared names are reported at run time, unless the project is strict.
    """
    from rapidgen.rapid import check

    strict = project is not None and project.strict and not result.driver
    configured = bool(result.system.signals)
    found = check(result.system, gaps=True, strict=strict, configured=configured)
    errors = [d for d in found if d.severity is Severity.ERROR]
    if project is not None:
        # What no controller loads cannot be ignored.
        errors = [d for d in errors if d.code not in _UNKNOWN_NAMES or project.is_reported(d)]
    if errors:
        raise DiagnosticError(errors)
