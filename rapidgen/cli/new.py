"""`rapidgen new`: a commented configuration to start from."""

from pathlib import Path
from typing import Annotated

import typer

from rapidgen.diagnostics import refusal, render


def new(
    file: Annotated[Path, typer.Argument(help="The configuration to write, FILE.yaml.")],
    robot: Annotated[str | None, typer.Option("--robot", help="A shipped model.")] = None,
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
    tip: Annotated[
        str | None, typer.Option("--tip", help="Last link of the robot, where several fit.")
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace an existing file.")] = False,
) -> None:
    """Write a commented configuration that checks and builds."""
    from rapidgen.config.scaffold import assignments, from_shipped, from_urdf, write_new

    if (robot is None) == (urdf is None):
        raise refusal(
            "RG020",
            None,
            "give either --robot NAME or --urdf PATH",
            "`rapidgen robots` lists the shipped models",
        )
    if robot is not None:
        text = from_shipped(robot)
    else:
        assert urdf is not None
        text = from_urdf(
            urdf,
            folder=file.parent,
            package_paths=package_path or (),
            macro=macro,
            arguments=assignments(arg or ()),
            macro_arguments=assignments(macro_arg or ()),
            tip=tip,
        )
    for notes in write_new(file, text, package_paths=package_path or (), force=force):
        typer.echo(render([notes]), err=True, nl=False)
    typer.echo(f"wrote {file}; next: rapidgen build {file}", err=True)
