"""The command `export`: RAPID modules from programs, plans and toolpaths."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from rapidgen.cli import options
from rapidgen.cli.terminal import is_quiet, use_colour
from rapidgen.diagnostics import DiagnosticError, refusal, render

if TYPE_CHECKING:
    from rapidgen.export.writer import ExportedModule

_LARGEST = 1_000_000
"""Bytes of a prologue, an epilogue or a file of routines."""


def export(
    source: Annotated[Path, typer.Argument(help="Trajectory: CSV or JSON.", metavar="FILE")],
    output: Annotated[
        Path, typer.Option("--output", "-o", help="Module to write.", metavar="NAME.mod")
    ],
    config: Annotated[
        str, typer.Option(help="Configuration file or shipped name.", metavar="CONFIG")
    ],
    group: options.Group = "",
    routine: Annotated[str, typer.Option(help="Name of the routine.", metavar="NAME")] = "main",
    zone: Annotated[
        str, typer.Option(help="Zone between moves: a RAPID name, or mm.", metavar="ZONE")
    ] = "z10",
    targets: Annotated[
        Literal["inline", "named", "arrays"], typer.Option(help="Place of the targets.")
    ] = "inline",
    prologue: Annotated[
        Path | None, typer.Option(help="RAPID statements before the moves.", metavar="FILE")
    ] = None,
    epilogue: Annotated[
        Path | None, typer.Option(help="RAPID statements after the moves.", metavar="FILE")
    ] = None,
    routines: Annotated[
        Path | None, typer.Option(help="RAPID declarations for the module.", metavar="FILE")
    ] = None,
    templates: Annotated[
        Path | None, typer.Option(help="Folder with your module.mod.j2.", metavar="FOLDER")
    ] = None,
    run: Annotated[
        bool, typer.Option("--run/--no-run", help="Run the module on the virtual controller first.")
    ] = True,
) -> None:
    """Write a RAPID module that runs without rapidgen.

    The module is checked for RobotWare 5, 6 and 7 and executed on the virtual controller. It is
    written only if all this succeeds.

    rapidgen export plan.csv --config cell.yaml -o plan.mod
    """
    from rapidgen._atomic_write import write_whole
    from rapidgen.client import Trajectory
    from rapidgen.export.writer import WriterOptions

    module = _module_name(output)
    choices = WriterOptions(
        targets,
        _text(prologue),
        _text(epilogue),
        _text(routines),
        templates,
    )
    path = str(source)
    read = Trajectory.from_json if source.suffix.lower() == ".json" else Trajectory.from_csv
    result = read(path).to_rapid(
        config, group=group, module=module, routine=routine, zone=_zone(zone), options=choices
    )
    sys.stderr.write(render(list(result.notes), colour=use_colour()))
    if run:
        _run(result)
    write_whole(output, result.text.encode("latin-1"))
    if not is_quiet():
        sys.stderr.write(f"{output}: {len(result.lines)} instructions\n")


def _run(result: "ExportedModule") -> None:
    """Execute a module; report its duration and warnings. Raises DiagnosticError for errors."""
    from rapidgen.controller.module_trial import run_module

    trial, errors = run_module(
        result.module,
        result.group,
        start=result.start_values,
        robotware=result.config.robotware,
        lines=result.lines,
        spans=result.spans,
    )
    sys.stderr.write(render(list(trial.warnings), colour=use_colour()))
    if errors:
        raise DiagnosticError(errors, exit_code=1)
    if not is_quiet():
        inferred = f"; inferred: {', '.join(trial.inferred)}" if trial.inferred else ""
        sys.stderr.write(f"virtual controller: {trial.seconds:.3f} s{inferred}\n")


def _module_name(output: Path) -> str:
    if output.suffix.lower() not in (".mod", ".modx"):
        raise refusal(
            "RG901", None, f"{output} is not a module's file", "such as -o NAME.mod (or .modx)"
        )
    return output.stem


def _zone(text: str) -> str | float:
    """Return a zone as `Program` takes it: a name, or m."""
    try:
        return float(text) / 1000
    except ValueError:
        return text


def _text(path: Path | None) -> str:
    from rapidgen._reading import read_foreign

    if path is None:
        return ""
    try:
        return read_foreign(path, _LARGEST).decode("latin-1")
    except OSError as fault:
        reason = (fault.strerror or str(fault)).lower()
        raise refusal("RG901", None, f"cannot read {path}: {reason}", "name a file") from fault
