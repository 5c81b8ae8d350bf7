"""`rapidgen plot`: commanded against executed joints as PNG and HTML."""

from pathlib import Path
from typing import Annotated

import typer


def plot(
    commanded: Annotated[Path, typer.Argument(help="CSV `time,<joint names>` (s, rad, m).")],
    executed: Annotated[
        Path | None, typer.Argument(help="A recording of the same, to draw over it.")
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option("--out", "-o", help="Without suffix; default beside the first file."),
    ] = None,
    linear: Annotated[
        list[str] | None, typer.Option(help="A joint that is in m; may be repeated.")
    ] = None,
) -> int:
    """Draw joints over time: FILE.png and FILE.html (which shows values at the pointer)."""
    from rapidgen.client.plot import Curve, write_plot
    from rapidgen.client.trajectory import Trajectory

    curves = [Curve("commanded" if executed else commanded.stem, Trajectory.from_csv(commanded))]
    if executed is not None:
        curves.append(Curve("executed", Trajectory.from_csv(executed)))
    base = out if out is not None else commanded.with_suffix("")
    paths = base.parent / f"{base.name}.png", base.parent / f"{base.name}.html"
    title = " against ".join(str(path.name) for path in (commanded, executed) if path)
    write_plot(*paths, curves, title=title, prismatic=linear or ())
    for path in paths:
        typer.echo(path)
    return 0
