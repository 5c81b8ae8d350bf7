"""`rapidgen move`: a trajectory from a file, checked, shown, confirmed and executed."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rapidgen.cli import options
from rapidgen.cli.terminal import use_colour
from rapidgen.diagnostics import Diagnostic, render

if TYPE_CHECKING:
    from rapidgen.client import Result, Robot, Trajectory
    from rapidgen.client.core.checks import Way


def move(
    config: options.Config,
    points: Annotated[Path, typer.Argument(help="CSV `time,<joint names>` (s, rad, m), or JSON.")],
    to: options.RobotAddress = "",
    group: options.Group = "",
    yes: Annotated[
        bool, typer.Option("--yes", "-y", help="Do not ask; answers on this machine only.")
    ] = False,
    move_real_robot: Annotated[
        str, typer.Option(help="The host once more: its area is clear.", metavar="HOST")
    ] = "",
    speed: Annotated[
        float | None,
        typer.Option(help="Share of the file's speed; a first run on a real host has 0.1."),
    ] = None,
    approach: Annotated[
        float | None,
        typer.Option(help="Go to the first point first, in so many seconds.", metavar="S"),
    ] = None,
    resample: Annotated[
        float | None,
        typer.Option(help="A point about every so many seconds instead.", metavar="S"),
    ] = None,
    record: Annotated[
        Path | None, typer.Option(help="Write the executed joints as CSV.", metavar="FILE")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object on stdout.")] = False,
    stream: Annotated[
        bool | None,
        typer.Option(
            "--stream/--download",
            help="Send points while the robot moves, or all before it does; default what fits.",
        ),
    ] = None,
) -> int:
    """Execute a trajectory. Ctrl-C stops the robot."""
    from rapidgen.cli.following import follow
    from rapidgen.client import Robot, Trajectory
    from rapidgen.client.permission import first_speed, need_confirmation, remember

    asked = (
        Trajectory.from_json(points) if points.suffix == ".json" else Trajectory.from_csv(points)
    )
    _positive("--speed", speed)
    _positive("--approach", approach)
    _positive("--resample", resample)
    robot = Robot(config, address=to or None, group=group)
    must_ask = need_confirmation(robot.address, yes=yes, real_robot=move_real_robot)
    used = first_speed(robot.address, asked) if speed is None else speed
    with robot:
        trajectory = asked.scaled(used)
        if resample is not None:
            trajectory = _resampled(trajectory, resample)
        if approach is not None:
            trajectory = trajectory.starting_at(robot.state, approach)
        warnings = robot.check(trajectory)
        way = _way(robot, trajectory, stream)
        _show_plan(robot, trajectory, used, way)
        _tell(warnings)
        if must_ask:
            _ask(robot)
        with robot.recording() as recording:
            result = follow(robot.execute(trajectory, way=way))
        if record is not None:
            recording.to_csv(record)
    if not robot.address.is_loopback:
        remember(robot.address, asked)
    _report(result, as_json)
    return 0


def _resampled(trajectory: "Trajectory", period: float) -> "Trajectory":
    """Other points on the same path; a path without one is left for the checks to refuse."""
    import numpy as np

    times = trajectory.times
    sound = bool(np.isfinite(times).all() and (np.diff(times) > 0).all())
    return trajectory.resampled(period) if sound else trajectory


def _way(robot: "Robot", trajectory: "Trajectory", stream: bool | None) -> "Way":
    if stream is None:
        return robot.way_for(trajectory)
    return "stream" if stream else "download"


def _positive(option: str, value: float | None) -> None:
    if value is not None and not 0 < value < float("inf"):
        raise typer.BadParameter(f"must be above 0, not {value}", param_hint=option)


def _tell(warnings: tuple[Diagnostic, ...]) -> None:
    sys.stderr.write(render(warnings, colour=use_colour()))


def _show_plan(robot: "Robot", trajectory: "Trajectory", speed: float, way: "Way") -> None:
    from rich.console import Console
    from rich.table import Table

    console = Console(stderr=True, highlight=False)
    driver = robot.driver
    who = f"rapidgen driver {driver.version}" if driver.is_rapidgen else "plain simple_message"
    console.print(
        f"{len(trajectory)} points, {trajectory.duration:.2f} s at {speed:.0%} of the file's "
        f"speed, to {robot.address} ({who}), "
        + ("sent while it moves" if way == "stream" else "sent before it moves")
    )
    table = Table("joint", "here", "from", "to", "end", "least", "greatest", box=None)
    ordered = trajectory.reordered(robot.group.names)
    here = robot.state
    for index, joint in enumerate(robot.group.joints):
        column = ordered.positions[:, index]
        values = (here.joints[index], column.min(), column.max(), column[-1])
        table.add_row(
            joint.name,
            *(f"{value:.4f}" for value in values),
            f"{joint.lower:.4f}",
            f"{joint.upper:.4f}",
        )
    console.print(table)
    console.print("rad, m; least and greatest are limits of the controller's axes")


def _ask(robot: "Robot") -> None:
    from rapidgen.client.errors import NotReady

    if not sys.stdin.isatty():
        raise NotReady.because(
            "RG641", "nobody is here to be asked: nothing was sent", "--yes answers", exit_code=2
        )
    typer.confirm(f"Move the robot at {robot.address}?", abort=True, err=True)


def _report(result: "Result", as_json: bool) -> None:
    if as_json:
        import json

        typer.echo(
            json.dumps(
                {
                    "points": result.points,
                    "seconds": result.seconds,
                    "planned_seconds": result.planned_seconds,
                    "deviation": result.deviation,
                    "way": result.way,
                    "starved": result.starved,
                    "joints": result.state.by_name,
                }
            )
        )
        return
    typer.echo(
        f"done: {result.points} points in {result.seconds:.2f} s, "
        f"{result.deviation:.4f} (rad, m) from the last point ({result.way})"
    )
