"""`rapidgen ros1`: a configuration becomes a package for the ROS-Industrial nodes."""

from pathlib import Path
from typing import Annotated

import typer

from rapidgen.cli import options


def ros1(
    config: options.Config,
    output: Annotated[
        Path, typer.Option("--output", "-o", help="Folder of the package.", metavar="DIR")
    ],
    overrides: options.Overrides = None,
) -> None:
    """Write a catkin package for the unmodified ROS-Industrial nodes.

    Launch file, parameters and a watcher that cancels a goal when the driver reports an error.
    """
    from rapidgen.config import load_config, shipped_names
    from rapidgen.ros.package import ros1_package, write

    model = load_config(config, overrides=overrides or ())
    source = config if config in shipped_names() else str(Path(config).resolve())
    files = ros1_package(model, source)
    write(files, output)
    typer.echo(f"{len(files)} files in {output}")
