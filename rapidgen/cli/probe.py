"""`rapidgen probe`: a RAPID module that asks a real controller what no manual settles."""

from pathlib import Path
from typing import Annotated

import typer

from rapidgen.diagnostics import refusal


def probe(
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="File to write; default stdout.", metavar="FILE"),
    ] = None,
    moving: Annotated[
        bool,
        typer.Option("--moving", help="Questions about motion: THE ROBOT TURNS ITS AXIS 6."),
    ] = False,
) -> int:
    """Write a module that asks a controller what is only assumed about it.

    Load it alone into a NORMAL task and start it: each line on the pendant is an answer that
    `rapidgen run --assume` takes. It moves nothing and sets no output, unless `--moving` asks
    for the other module: that one turns axis 6 by 10 degrees, after a question on the pendant.
    """
    from rapidgen._atomic_write import write_whole
    from rapidgen._data import data_folder

    name = "ROS_probe_motion.mod" if moving else "ROS_probe.mod"
    text = (data_folder("templates") / name).read_text(encoding="latin-1")
    if output is None:
        typer.echo(text, nl=False)
        return 0
    try:
        write_whole(output, text.encode("latin-1"))
    except OSError as fault:
        raise refusal(
            "RG802",
            None,
            f"{output} cannot be written: {fault.strerror}",
            "name a file in a folder that exists and may be written",
        ) from fault
    typer.echo(f"{output}: load it alone into a NORMAL task, PP to main, Start", err=True)
    return 0
