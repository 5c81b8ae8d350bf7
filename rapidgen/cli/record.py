"""`rapidgen record`: joints to CSV as they come."""

import time
from pathlib import Path
from typing import Annotated

import typer

from rapidgen.cli import options


def record(
    config: options.ConfigOrHost,
    output: Annotated[Path, typer.Option("--output", "-o", help="CSV file.", metavar="FILE")],
    to: options.RobotAddress = "",
    group: options.Group = "",
    seconds: Annotated[
        float, typer.Option(help="End after so many seconds; 0: with Ctrl-C.", min=0)
    ] = 0.0,
    reconnect: Annotated[
        float, typer.Option(help="Try a lost connection again for so many seconds.", min=0)
    ] = 0.0,
    feedback: Annotated[
        bool,
        typer.Option("--feedback", help="Times of the controller's clock, not of this machine's."),
    ] = False,
) -> int:
    """Write every joint message to a CSV: `time,<joint names>` in s and rad (m).

    A rapidgen driver tells three clients at once. A plain one tells the newest: recording takes
    the connection from a program that moves the robot; `rapidgen move --record` does both.
    """
    from rapidgen.client import Robot
    from rapidgen.client.recording import CsvWriter

    robot = Robot(
        config, address=to or None, group=group, watch=True, reconnect=reconnect, feedback=feedback
    )
    with robot, CsvWriter(output, robot.group) as writer:
        end = time.monotonic() + (seconds or float("inf"))
        try:
            while time.monotonic() < end:
                writer.write(robot.next_feedback() if feedback else robot.next_state())
        except KeyboardInterrupt:
            # The usual way to end a recording.
            typer.echo("", err=True)
        typer.echo(f"{writer.count} states in {output}", err=True)
    return 0
