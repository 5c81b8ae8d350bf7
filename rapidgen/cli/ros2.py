"""`rapidgen ros2`: a configuration becomes a ROS 2 package."""

import math
from pathlib import Path
from typing import Annotated

import typer

from rapidgen.cli import options


def ros2(
    config: Annotated[
        list[str],
        typer.Argument(help="Configuration file or shipped name; several share a MoveIt."),
    ],
    output: Annotated[
        Path, typer.Option("--output", "-o", help="Folder of the package.", metavar="DIR")
    ],
    base_pose: Annotated[
        list[str] | None,
        typer.Option(
            help="Of several robots: where the base of each is, m and rad.", metavar="PLACE"
        ),
    ] = None,
    overrides: options.Overrides = None,
) -> None:
    """Write a ROS 2 package: launch files, URDF, SRDF and MoveIt configuration.

    The node itself is `python -m rapidgen.ros`. Several robots, each with a controller of its own,
    are planned for together; PLACE is X,Y,Z or X,Y,Z,ROLL,PITCH,YAW, once for each.
    """
    from rapidgen.config import load_config, shipped_names
    from rapidgen.ros.package import CellMember, ros2_cell, ros2_package, write

    places = [_place(text) for text in base_pose or ()]
    if len(places) != (len(config) if len(config) > 1 else 0):
        told = "once for each of several robots" if len(config) > 1 else "for several robots only"
        raise typer.BadParameter(f"it is given {told}", param_hint="--base-pose")
    over = tuple(overrides or ())
    models = [load_config(one, overrides=over) for one in config]
    sources = [one if one in shipped_names() else str(Path(one).resolve()) for one in config]
    if len(models) == 1:
        files = ros2_package(models[0], sources[0], over)
    else:
        members = [
            CellMember(*one, overrides=over) for one in zip(models, sources, places, strict=True)
        ]
        files = ros2_cell(members, output.resolve().name.removesuffix("_rapidgen"))
    write(files, output)
    typer.echo(f"{len(files)} files in {output}")


def _place(text: str) -> tuple[float, ...]:
    """m and rad. Raises BadParameter."""
    try:
        result = tuple(float(number) for number in text.split(","))
    except ValueError:
        result = ()
    if len(result) not in (3, 6) or not all(map(math.isfinite, result)):
        raise typer.BadParameter(
            f"'{text}' is not X,Y,Z or X,Y,Z,ROLL,PITCH,YAW in m and rad", param_hint="--base-pose"
        )
    return (*result, 0.0, 0.0, 0.0)[:6]
