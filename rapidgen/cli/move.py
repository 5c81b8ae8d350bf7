"""`rapidgen move`: to joints, to a pose, or along a file; checked, shown, confirmed, executed."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rapidgen.cli import options
from rapidgen.cli.target_text import (
    Figures,
    Units,
    figure,
    joints_of,
    named_text,
    read_figures,
    read_pose,
)
from rapidgen.cli.terminal import use_colour
from rapidgen.diagnostics import render

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rapidgen.axes.frames import Pose, Quaternion, Vector
    from rapidgen.client import InvalidTrajectory, Result, Robot, Trajectory
    from rapidgen.client.core.checks import Way
    from rapidgen.client.core.group import Group


def move(
    config: options.Config,
    points: Annotated[
        Path | None, typer.Argument(help="CSV `time,<joint names>` (s, rad, m), or JSON.")
    ] = None,
    joints: Annotated[
        str,
        typer.Option(help="Go there: all joints, or some as NAME=VALUE.", metavar="J1,J2,..."),
    ] = "",
    pose: Annotated[
        str,
        typer.Option(
            help="Go there: the tool in the work object; X,Y,Z alone keeps the orientation.",
            metavar="X,Y,Z,Q1..Q4",
        ),
    ] = "",
    to: options.RobotAddress = "",
    group: options.Group = "",
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Check and show; send nothing.")
    ] = False,
    yes: options.YesHere = False,
    move_real_robot: options.RealRobot = "",
    speed: Annotated[
        float | None,
        typer.Option(
            help="Share of the file's speed, or of the axes'; a first run on a real host has 0.1."
        ),
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
    plot: Annotated[
        Path | None,
        typer.Option(help="Draw commanded and executed joints: .html, .png, .svg.", metavar="FILE"),
    ] = None,
    rad: options.InRad = False,
    as_json: options.AsJson = False,
    stream: Annotated[
        bool | None,
        typer.Option(
            "--stream/--download",
            help="Send points while the robot moves, or all before it does; default what fits.",
        ),
    ] = None,
) -> int:
    """Move a robot to joints, to a pose, or along a file. Ctrl-C stops it.

    To joints and to a pose all axes go together, from where the robot stands. Figures are deg and
    mm, with --rad rad and m; files are always rad and m.

    rapidgen move cell.yaml --joints 0,10,0,0,30,0 --to sim
    """
    from rapidgen.cli.motion_commands import confirm_at, execute_motion, permitted
    from rapidgen.cli.plot import draw_motion
    from rapidgen.client import Robot
    from rapidgen.client.permission import first_speed, remember

    _one_goal(points, joints, pose, approach)
    for option, value in (("--speed", speed), ("--approach", approach), ("--resample", resample)):
        _positive(option, value)
    files = _writable(record, plot)
    units = Units(rad)
    asked = _from_file(points) if points is not None else None
    figures = read_figures(joints) if joints else None
    requested = read_pose(pose, units) if pose else None
    robot = Robot(config, address=to or None, group=group, watch=dry_run)
    must_ask = not dry_run and permitted(robot, to, yes=yes, real_robot=move_real_robot)
    with robot:
        used = first_speed(robot.address, asked) if speed is None else speed
        if asked is not None:
            trajectory = asked.scaled(used)
        elif figures is not None:
            trajectory = _straight(robot, _joints(robot, units, figures), used)
        else:
            assert requested is not None, "_one_goal has seen to it"
            trajectory = _straight(robot, _posture(robot, *requested), used)
        if resample is not None:
            trajectory = _resampled(trajectory, resample)
        if approach is not None:
            trajectory = trajectory.starting_at(robot.state, approach)
        warnings = robot.check(trajectory)
        way = _way(robot, trajectory, stream)
        whose = "the axes'" if asked is None else "the file's"
        _show_plan(robot, trajectory, f"{used:.0%} of {whose} speed", way, units)
        sys.stderr.write(render(warnings, colour=use_colour()))
        if dry_run:
            if files:
                draw_motion(files, robot, trajectory, None)
            _report_dry(trajectory, way, as_json)
            return 0
        if must_ask:
            confirm_at(robot)
        with robot.recording() as recording:
            try:
                result = execute_motion(robot, trajectory, way, units)
            finally:
                if record is not None:
                    recording.to_csv(record)
                if files:
                    draw_motion(files, robot, trajectory, recording)
    if asked is not None and not robot.address.is_loopback:
        remember(robot.address, asked)
    _report(robot, result, units, as_json)
    return 0


def _one_goal(points: Path | None, joints: str, pose: str, approach: float | None) -> None:
    given = [name for name, message in (("--joints", joints), ("--pose", pose)) if message]
    if points is not None:
        given.insert(0, "a file")
    if len(given) != 1:
        raise typer.BadParameter(
            f"where to? {' and '.join(given)} were given"
            if given
            else "where to? Give a file of points, --joints, or --pose"
        )
    if approach is not None and points is None:
        raise typer.BadParameter(f"{given[0]} begins where the robot is", param_hint="--approach")


def _writable(record: Path | None, plot: Path | None) -> list[Path]:
    """The plot's files; all that is to be written is refused now where it cannot be."""
    from rapidgen.cli.run_outputs import refuse_unwritable
    from rapidgen.viewer.plotting import files_of

    files = files_of(plot) if plot is not None else []
    refuse_unwritable([*([record] if record is not None else []), *files])
    return files


def _from_file(points: Path) -> "Trajectory":
    from rapidgen.client import Trajectory

    if points.suffix == ".json":
        return Trajectory.from_json(points)
    return Trajectory.from_csv(points)


def _joints(robot: "Robot", units: Units, figures: Figures) -> tuple[float, ...]:
    goal = joints_of(figures, units, robot.group, robot.state.joints)
    within_limits(robot.group, goal, units)
    return goal


def _posture(robot: "Robot", place: "Vector", turn: "Quaternion | None") -> tuple[float, ...]:
    """The posture nearest to where the robot stands; without a turn it keeps its own."""
    pose = (place, robot.pose[1] if turn is None else turn)
    result = robot.joints_for(pose)
    if not result:
        raise _unreached(robot, pose)
    return result[0]


def _straight(robot: "Robot", goal: "Sequence[float]", speed: float) -> "Trajectory":
    """From where the robot stands to a goal, all axes together, at a share of their speed."""
    from rapidgen.client import Trajectory

    ends = [robot.state.joints, goal]
    return Trajectory.from_points(ends, seconds=1.0, names=robot.group.names).timed(
        robot.group, speed
    )


def within_limits(group: "Group", goal: "Sequence[float]", units: Units) -> None:
    """Refuse a goal outside the axes' limits, in the units that it was typed in."""
    from rapidgen.axes.limits import ROUNDING
    from rapidgen.client import InvalidTrajectory

    wire = group.map.to_controller(goal)
    for joint, value in zip(group.joints, wire, strict=True):
        if not joint.lower - ROUNDING <= value <= joint.upper + ROUNDING:
            unit, factor, digits = units.joint(joint.kind)
            requested, lower, upper = (
                figure(v, factor, digits) for v in (value, joint.lower, joint.upper)
            )
            raise InvalidTrajectory.because(
                "RG614",
                f"{joint.name} is outside its limits: "
                f"axis {joint.axis} would be at {requested} {unit}",
                f"{joint.axis} goes from {lower} to {upper} {unit}",
            )


def _unreached(robot: "Robot", pose: "Pose") -> "InvalidTrajectory":
    from rapidgen.client import InvalidTrajectory

    current = robot.group.map.to_controller(robot.state.joints)
    return InvalidTrajectory.because(
        "RG614",
        f"no posture within the limits reaches the pose: "
        f"{robot.group.poses.why_not(pose, current)}",
        "`rapidgen pose` tells where the tool is now",
    )


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


def _show_plan(
    robot: "Robot", trajectory: "Trajectory", speed: str, way: "Way", units: Units
) -> None:
    from rich.console import Console
    from rich.table import Table

    console = Console(stderr=True, highlight=False)
    driver = robot.driver
    who = f"rapidgen driver {driver.version}" if driver.is_rapidgen else "plain simple_message"
    console.print(
        f"{len(trajectory)} points, {trajectory.duration:.2f} s at {speed}, to {robot.address} "
        f"({who}), sent {'while' if way == 'stream' else 'before'} it moves"
    )
    table = Table("joint", box=None)
    # Least and most are of all points; lower and upper are limits of the controller's axes.
    for title in ("now", "least", "most", "end", "lower", "upper", ""):
        table.add_column(title, justify="right" if title else "left")
    ordered = trajectory.reordered(robot.group.names)
    current = robot.state
    for index, joint in enumerate(robot.group.joints):
        column = ordered.positions[:, index]
        unit, factor, digits = units.joint(joint.kind)
        values = (current.joints[index], column.min(), column.max(), column[-1])
        displayed = (figure(value, factor, digits) for value in (*values, joint.lower, joint.upper))
        table.add_row(joint.name, *displayed, unit)
    console.print(table)


def _report_dry(trajectory: "Trajectory", way: "Way", as_json: bool) -> None:
    if as_json:
        _say_json(
            {
                "dry_run": True,
                "points": len(trajectory),
                "planned_seconds": trajectory.duration,
                "way": way,
                "joints": dict(
                    zip(trajectory.names, trajectory.positions[-1].tolist(), strict=False)
                ),
            }
        )
    else:
        typer.echo(f"dry run: {len(trajectory)} points would be executed; nothing was sent")


def _say_json(text: dict[str, object]) -> None:
    import json

    typer.echo(json.dumps(text))


def _report(robot: "Robot", result: "Result", units: Units, as_json: bool) -> None:
    if as_json:
        _say_json(
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
        return
    typer.echo(
        f"done: {result.points} points in {result.seconds:.2f} s, "
        f"{result.deviation:.4f} (rad, m) from the last point ({result.way})\n"
        f"at {named_text(units, robot.group, result.state.joints)}"
    )
