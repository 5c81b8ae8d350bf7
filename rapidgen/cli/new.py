"""`rapidgen new`: a commented configuration to start from."""

import shlex
from pathlib import Path
from typing import Annotated

import typer

from rapidgen.diagnostics import DiagnosticError, refusal, render


def new(
    file: Annotated[Path, typer.Argument(help="The configuration to write, FILE.yaml.")],
    robot: Annotated[
        str | None, typer.Option("--robot", help="A shipped model, a variant.")
    ] = None,
    urdf: Annotated[Path | None, typer.Option("--urdf", help="A URDF or xacro file.")] = None,
    package_path: Annotated[
        list[Path] | None,
        typer.Option("--package-path", help="Folder in which $(find PACKAGE) looks."),
    ] = None,
    macro: Annotated[
        str | None, typer.Option("--macro", help="Macro to call when the file only defines macros.")
    ] = None,
    arg: Annotated[
        list[str] | None, typer.Option("--arg", help="xacro argument NAME=VALUE.")
    ] = None,
    macro_arg: Annotated[
        list[str] | None, typer.Option("--macro-arg", help="Argument of the macro, NAME=VALUE.")
    ] = None,
    joint: Annotated[
        list[str] | None, typer.Option("--joint", help="NAME=rax_1 .. eax_f: this joint's axis.")
    ] = None,
    track: Annotated[
        list[str] | None, typer.Option("--track", help="NAME=eax_a: as --joint, for what carries.")
    ] = None,
    ignore: Annotated[
        list[str] | None, typer.Option("--ignore", help="Joint that the controller does not move.")
    ] = None,
    hold_axis: Annotated[
        list[str] | None,
        typer.Option("--hold-axis", help="Robot axis without a joint, held where it stands."),
    ] = None,
    tip: Annotated[
        list[str] | None,
        typer.Option("--tip", help="Last link of an arm; several times: a group for each."),
    ] = None,
    coupling: Annotated[
        float | None, typer.Option("--coupling", help="1: a rod couples axes 2 and 3; 0: none.")
    ] = None,
    speed: Annotated[
        float | None,
        typer.Option("--speed", help="deg/s (mm/s) of axes of which nothing says a speed."),
    ] = None,
    range_: Annotated[
        list[str] | None,
        typer.Option(
            "--range",
            help="NAME=LOWER..UPPER, deg or mm; without NAME: for turning axes without one.",
        ),
    ] = None,
    controller: Annotated[
        str,
        typer.Option(
            "--controller",
            help="irc5, irc5_compact or omnicore; default: what the robot comes with, else irc5.",
        ),
    ] = "",
    robotware: Annotated[
        str,
        typer.Option(
            "--robotware", help="RobotWare version; default: of the robot, else 6.15 or 7.10."
        ),
    ] = "",
    force: Annotated[bool, typer.Option("--force", help="Replace an existing file.")] = False,
) -> None:
    """Write a commented configuration that checks and builds. What stays open is marked in it."""
    from rapidgen.cli.wizard import ask_open, ask_source, is_terminal
    from rapidgen.config.from_description import DescriptionChoices
    from rapidgen.config.scaffold import assignments, from_model, from_urdf, ranges, write_new

    if robot is None and urdf is None and is_terminal():
        robot, urdf = ask_source()
    if file.suffix not in (".yaml", ".yml"):
        raise refusal(
            "RG020",
            None,
            f"{file} would not be known as a configuration",
            f"by its suffix: {file.with_suffix('.yaml')}",
        )
    if (robot is None) == (urdf is None):
        raise refusal(
            "RG020",
            None,
            "give either --robot NAME or --urdf PATH",
            "`rapidgen robots` lists the shipped models",
        )
    if robot is not None:
        text = from_model(
            robot, DescriptionChoices(speed=speed, controller=controller, robotware=robotware)
        )
    else:
        described = urdf
        assert described is not None
        message = DescriptionChoices(
            joints=assignments([*(joint or ()), *(track or ())]),
            ignore=tuple(ignore or ()),
            tips=tuple(tip or ()),
            held_axes=tuple(hold_axis or ()),
            coupling=coupling,
            speed=speed,
            ranges=ranges(range_ or ()),
            controller=controller,
            robotware=robotware,
        )

        def make(answers: DescriptionChoices) -> str:
            return from_urdf(
                described,
                folder=file.parent,
                package_paths=package_path or (),
                macro=macro,
                arguments=assignments(arg or ()),
                macro_arguments=assignments(macro_arg or ()),
                answers=answers,
            )

        if is_terminal():
            message = ask_open(make, message)
        text = make(message)
    try:
        notes = write_new(file, text, package_paths=package_path or (), force=force)
    except DiagnosticError as result:
        # It is there as it is meant, or it was there before (RG020).
        if file.exists() and all(d.code != "RG020" for d in result.diagnostics):
            typer.echo(f"wrote {file}, which is not complete:", err=True)
        raise
    for note in notes:
        typer.echo(render([note]), err=True, nl=False)
    typer.echo(f"wrote {file}; next: rapidgen build {shlex.quote(str(file))}", err=True)
