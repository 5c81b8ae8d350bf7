"""`rapidgen monitor`: what a robot says about itself, live."""

import sys
from typing import Annotated

import typer

from rapidgen.cli import options


def monitor(
    config: options.ConfigOrHost,
    to: options.RobotAddress = "",
    group: options.Group = "",
    lines: Annotated[
        bool, typer.Option("--lines", help="One line a state, no table; deg and mm.")
    ] = False,
    as_json: Annotated[
        bool, typer.Option("--json", help="One JSON object a line; rad and m.")
    ] = False,
    count: Annotated[
        int, typer.Option(help="End after so many states; 0: with Ctrl-C.", min=0)
    ] = 0,
    reconnect: Annotated[
        float, typer.Option(help="Try a lost connection again for so many seconds.", min=0)
    ] = 0.0,
) -> int:
    """Watch a robot: joints against limits, mode, rate, jitter, last event. Ctrl-C ends it.

    A rapidgen driver tells three clients at once. A plain one tells the newest: watching takes
    the connection from a program that moves the robot, which then stops.
    """
    from contextlib import nullcontext

    from rich.live import Live

    from rapidgen.client import Robot
    from rapidgen.viewer import state_lines

    robot = Robot(config, address=to or None, group=group, watch=True, reconnect=reconnect)
    watcher = state_lines.StateStatistics()
    is_live = not (lines or as_json) and sys.stdout.isatty()
    with robot, Live(refresh_per_second=10) if is_live else nullcontext() as screen:
        for number, state in enumerate(robot.states(), 1):
            watcher.take(state, robot.events[-1] if robot.events else None)
            if screen is not None:
                width, place = screen.console.width, str(robot.address)
                screen.update(state_lines.as_table(state, watcher, robot.group, place, width))
            else:
                text = state_lines.as_json(state, watcher) if as_json else None
                typer.echo(text or state_lines.as_line(state, watcher, robot.group))
            if number == count:
                break
    return 0
