"""`rapidgen build`: a configuration becomes a folder of RAPID modules and controller files."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rapidgen.cli import options
from rapidgen.cli.terminal import use_colour
from rapidgen.diagnostics import Diagnostic, refusal, render

if TYPE_CHECKING:
    from rapidgen.config.model import RobotConfig
    from rapidgen.generate import Change, Output


def build(
    config: options.Config,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", "-o", help="Output folder; default rapid_out/NAME.", metavar="DIR"
        ),
    ] = None,
    overrides: options.Overrides = None,
    backup: options.VeryBackup = None,
    package_path: Annotated[
        list[Path] | None,
        typer.Option(help="Folder with ROS packages, for $(find ...) in a xacro.", metavar="DIR"),
    ] = None,
    check: Annotated[
        bool, typer.Option("--check", help="Write nothing; exit 1 if the folder differs.")
    ] = False,
    diff: Annotated[
        bool, typer.Option("--diff", help="Write nothing; show what would change.")
    ] = False,
    list_files: Annotated[
        bool, typer.Option("--list", help="Write nothing; list the files.")
    ] = False,
) -> int:
    """Generate the driver for one controller.

    The folder is replaced as a whole, or left as it was when something is wrong.
    """
    from rapidgen.config import load_config
    from rapidgen.generate import build as generate
    from rapidgen.generate import compare, write

    model = load_config(config, overrides=overrides or (), package_paths=package_path or ())
    _tell(model.diagnostics)
    cell = None
    if backup is not None:
        from rapidgen.generate.existing_controller import fit, read_cell

        cell = read_cell(backup)
        # What modules a backup lacks is no matter of cfg.
        _tell(tuple(note for note in cell.notes if note.code != "RG710"))
        model = fit(model, cell)
        typer.echo(_fitted(backup, model), err=True)
    files = generate(model, cell)
    folder = output if output is not None else Path("rapid_out") / model.name
    if list_files:
        for file in files.files:
            typer.echo(file.path)
        return 0
    if diff or check:
        changes = compare(files, folder)
        if diff:
            typer.echo(_diff(changes), nl=False)
        if check and changes:
            _differs(folder, changes)
        return 1 if changes else 0
    write(files, folder)
    typer.echo(_summary(files, folder), err=True)
    return 0


def _tell(diagnostics: tuple[Diagnostic, ...]) -> None:
    typer.echo(render(diagnostics, colour=use_colour()), err=True, nl=False)


def _fitted(backup: Path, model: "RobotConfig") -> str:
    """What was taken from a backup."""
    groups = ", ".join(f"{g.task} moves {g.mechanical_unit}" for g in model.groups)
    main = "" if model.call_main else "; its own main calls ROS_run"
    return f"for {backup}: RobotWare {model.robotware[0]}.{model.robotware[1]:02d}, {groups}{main}"


def _summary(output: "Output", folder: Path) -> str:
    return f"{folder}: {len(output.files)} files, build {output.build_id}"


def _differs(folder: Path, changes: "list[Change]") -> None:
    paths = ", ".join(change.path for change in changes[:5])
    more = f" and {len(changes) - 5} more" if len(changes) > 5 else ""
    raise refusal(
        "RG104",
        None,
        f"{folder} is not what the configuration gives: {paths}{more}",
        "look with --diff, then build",
        exit_code=1,
    )


def _diff(changes: "list[Change]") -> str:
    from difflib import unified_diff

    out: list[str] = []
    for change in changes:
        old, new = (
            (data or b"").decode("latin-1").splitlines(keepends=True)
            for data in (change.old, change.new)
        )
        before = f"a/{change.path}" if change.old is not None else "/dev/null"
        after = f"b/{change.path}" if change.new is not None else "/dev/null"
        out += unified_diff(old, new, before, after)
    return "".join(line if line.endswith("\n") else line + "\n" for line in out)
