"""`rapidgen record`: joints to CSV as they come."""

import time
from pathlib import Path
from typing import Annotated

import typer


def record(
    config: Annotated[str, typer.Argument(help="Configuration file, shipped name or HOST[:M,S].")],
    out: Annotated[Path, typer.Option("--out", "-o", help="CSV file.", metavar="FILE")],
    to: Annotated[
        str,
        typer.Option(help="Where the robot is; default this machine.", metavar="HOST[:M,S]"),
    ] = "",
    group: Annotated[str, typer.Option(help="Motion group, where there are several.")] = "",
    seconds: Annotated[
        float, typer.Option(help="End after so many seconds; 0: with Ctrl-C.", min=0)
    ] = 0.0,
    reconnect: Annotated[
        float, typer.Option(help="Try a lost connection again for so many seconds.", min=0)
    ] = 0.0,
) -> int:
    """Write every joint message to a CSV: `time,<joint names>` in s and rad (m).

    A driver serves one state connection: the newest. Recording takes it from a program that
    moves the robot; `rapidgen move --record` does both.
    """
    from rapidgen.client import Robot
    from rapidgen.client.recording import CsvWriter

    robot = Robot(config, address=to or None, group=group, watch=True, reconnect=reconnect)
    with robot, CsvWriter(out, robot.group) as writer:
        end = time.monotonic() + (seconds or float("inf"))
        try:
            for state in robot.states():
                writer.write(state)
                if state.time >= end:
                    break
        except KeyboardInterrupt:
            # The usual way to end a recording.
            typer.echo("", err=True)
        typer.echo(f"{writer.count} states in {out}", err=True)
    return 0
