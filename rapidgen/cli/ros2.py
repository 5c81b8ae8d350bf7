"""`rapidgen ros2`: a configuration becomes a ROS 2 package."""

from pathlib import Path
from typing import Annotated

import typer

from rapidgen.cli import options


def ros2(
    config: options.Config,
    out: Annotated[Path, typer.Option("--out", "-o", help="Folder of the package.", metavar="DIR")],
    overrides: options.Overrides = None,
) -> None:
    """Write a ROS 2 package: launch files, URDF, SRDF and MoveIt configuration.

    The node itself is `python -m rapidgen.ros`.
    """
    from rapidgen.config import load_config, shipped_names
    from rapidgen.ros.package import ros2_package, write

    model = load_config(config, overrides=overrides or ())
    source = config if config in shipped_names() else str(Path(config).resolve())
    files = ros2_package(model, source)
    write(files, out)
    typer.echo(f"{len(files)} files in {out}")
