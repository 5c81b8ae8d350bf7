"""The commands `move`, `jog` and `stop`: motions of a robot."""

import math
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
    named_of,
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
    from rapidgen.client.core.checks import TransferMode
    from rapidgen.client.core.group import Group


def move(
    config: options.Config,
    points: Annotated[
        Path | None,
        typer.Argument(help="CSV `time,<joint names>` (s, rad, m), or JSON.", metavar="FILE"),
    ] = None,
    joints: Annotated[
        str,
        typer.Option(help="Target joint values: all, or some as NAME=VALUE.", metavar="J1,J2,..."),
    ] = "",
    pose: Annotated[
        str,
        typer.Option(
            help="Target pose of the tool in the work object; X,Y,Z keeps the orientation.",
            metavar="X,Y,Z,Q1..Q4",
        ),
    ] = "",
    to: options.RobotAddress = "",
    group: options.Group = "",
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Check and show the motion without sending it.")
    ] = False,
    yes: options.YesOnLoopback = False,
    move_real_robot: options.RealRobot = "",
    speed: Annotated[
        float | None,
        typer.Option(
            help="Fraction of the file's or axes' speed; default: 100 mm/s of the tool at most "
            "to a target, 0.1 for the first run of a file on a real robot.",
            metavar="FRACTION",
        ),
    ] = None,
    approach: Annotated[
        float | None,
        typer.Option(help="Duration of a first motion to the first point.", metavar="SECONDS"),
    ] = None,
    resample: Annotated[
        float | None,
        typer.Option(help="Distance in time between resampled points.", metavar="SECONDS"),
    ] = None,
    record: Annotated[
        Path | None, typer.Option(help="CSV file for the executed joint positions.", metavar="FILE")
    ] = None,
    plot: Annotated[
        Path | None,
        typer.Option(
            help="Plot of commanded and executed joints: .html, .png, .svg.", metavar="FILE"
        ),
    ] = None,
    rad: options.InRad = False,
    as_json: options.AsJson = False,
    stream: Annotated[
        bool | None,
        typer.Option(
            "--stream/--download",
            help="Send points during the motion, or all of them before it; default: automatic.",
        ),
    ] = None,
) -> int:
    """Move a robot to joint values, to a pose or along a file.

    Ctrl-C stops the robot. To joint values and to a pose, all axes move together from the current
    position. Values are deg and mm, with --rad rad and m; files are always rad and m.

    rapidgen move cell.yaml --joints 0,10,0,0,30,0 --to sim
    """
    from rapidgen.cli.motion_execution import confirm_at, execute_motion, permitted
    from rapidgen.cli.observation import draw_motion
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
    if robot.configuration is not None:
        # What is wrong with the target itself needs no connection.
        if figures is not None:
            joints_of(figures, units, robot.group, [0.0] * len(robot.group.names))
        if asked is not None:
            used = first_speed(robot.address, asked) if speed is None else speed
            path = asked.scaled(used)
            _check_file(_resampled(path, resample) if resample else path, robot.group)
    must_ask = not dry_run and permitted(robot, to, yes=yes, real_robot=move_real_robot)
    with robot:
        if asked is not None:
            used = first_speed(robot.address, asked) if speed is None else speed
            trajectory = asked.scaled(used)
        else:
            if figures is not None:
                goal = _joints(robot, units, figures)
            else:
                assert requested is not None, "checked by _one_goal"
                goal = _posture(robot, *requested)
            used = slow_share(robot, goal) if speed is None else speed
            trajectory = _straight(robot, goal, used)
        if resample is not None:
            trajectory = _resampled(trajectory, resample)
        if approach is not None:
            trajectory = trajectory.starting_at(robot.state, approach)
        warnings = robot.check(trajectory)
        mode = _mode(robot, trajectory, stream)
        whose = "the axes'" if asked is None else "the file's"
        _show_plan(robot, trajectory, f"{100 * used:.2g} % of {whose} speed", mode, units)
        sys.stderr.write(render(warnings, colour=use_colour()))
        if dry_run:
            if files:
                draw_motion(files, robot, trajectory, None)
            _report_dry(trajectory, mode, as_json)
            return 0
        if must_ask:
            confirm_at(robot)
        with robot.recording() as recording:
            try:
                result = execute_motion(robot, trajectory, mode, units)
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
            f"more than one target: {' and '.join(given)}"
            if given
            else "no target: give a file of points, --joints or --pose"
        )
    if approach is not None and points is None:
        raise typer.BadParameter(
            f"{given[0]} starts at the current position", param_hint="--approach"
        )


def _writable(record: Path | None, plot: Path | None) -> list[Path]:
    """Return the files of the plot. Raises RG901 if an output file cannot be written."""
    from rapidgen.cli.run_outputs import check_files_writable
    from rapidgen.viewer.plotting import files_of

    files = files_of(plot) if plot is not None else []
    check_files_writable([*([record] if record is not None else []), *files])
    return files


def _from_file(points: Path) -> "Trajectory":
    from rapidgen.client import Trajectory

    if points.suffix == ".json":
        return Trajectory.from_json(points)
    return Trajectory.from_csv(points)


def _check_file(path: "Trajectory", group: "Group") -> None:
    """Reject a file that no driver of a group would take. Raises InvalidTrajectory."""
    from rapidgen.client.core.checks import check_trajectory

    if len(path) <= group.policy.capacity:
        check_trajectory(path, group)


def _joints(robot: "Robot", units: Units, figures: Figures) -> tuple[float, ...]:
    goal = joints_of(figures, units, robot.group, robot.state.joints)
    within_limits(robot.group, goal, units)
    return goal


def _posture(robot: "Robot", place: "Vector", turn: "Quaternion | None") -> tuple[float, ...]:
    """Return the nearest joint values for a pose; without `turn`, the orientation stays."""
    from rapidgen.client import Pose

    pose = Pose(place, robot.pose.orientation if turn is None else turn)
    result = robot.joints_for(pose)
    if not result:
        raise _unreached(robot, pose)
    return result[0]


def _straight(robot: "Robot", goal: "Sequence[float]", speed: float) -> "Trajectory":
    """Move all axes together to a goal, at a fraction of their speed."""
    from rapidgen.client import Trajectory

    ends = [robot.state.joints, goal]
    return Trajectory.from_points(ends, seconds=1.0, names=robot.group.names).timed(
        robot.group, speed
    )


def slow_share(robot: "Robot", goal: "Sequence[float]") -> float:
    """Return the default share of the axes' speed for a motion to a target.

    The tool moves at most as fast as in Python without a speed, the axes at most at FIRST_SPEED.
    """
    import numpy as np

    from rapidgen.client import NotSupported
    from rapidgen.client.permission import FIRST_SPEED
    from rapidgen.client.program import SLOW

    group, start, end = robot.group, np.array(robot.state.joints), np.array(goal)
    if not group.has_limits:
        return FIRST_SPEED
    way = np.abs(np.diff(group.to_wire(np.array([start, end])), axis=0))
    seconds = float((way / group.speed).max())
    shares = np.linspace(0.0, 1.0, _STEPS + 1)[:, None]
    try:
        places = np.array([robot.pose_of(p)[0] for p in start + shares * (end - start)])
    except NotSupported:
        return FIRST_SPEED
    step = float(np.linalg.norm(np.diff(places, axis=0), axis=1).max())
    return min(FIRST_SPEED, SLOW * seconds / max(_STEPS * step, 1e-9)) if seconds else FIRST_SPEED


def within_limits(group: "Group", goal: "Sequence[float]", units: Units) -> None:
    """Reject a goal outside the axes' limits, in the units in which it was typed."""
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
                f"use a value from {lower} to {upper} {unit} for {joint.axis}",
            )


def _unreached(robot: "Robot", pose: "Pose") -> "InvalidTrajectory":
    from rapidgen.client import InvalidTrajectory

    current = robot.group.map.to_controller(robot.state.joints)
    return InvalidTrajectory.because(
        "RG614",
        f"no joint values within the limits reach the pose: "
        f"{robot.group.poses.why_not(pose, current)}",
        "`rapidgen pose` shows the current pose of the tool",
    )


def _resampled(trajectory: "Trajectory", period: float) -> "Trajectory":
    """Resample a trajectory; an invalid one is left to the checks."""
    import numpy as np

    times = trajectory.times
    sound = bool(np.isfinite(times).all() and (np.diff(times) > 0).all())
    return trajectory.resampled(period) if sound else trajectory


def _mode(robot: "Robot", trajectory: "Trajectory", stream: bool | None) -> "TransferMode":
    if stream is None:
        return robot.mode_for(trajectory)
    return "stream" if stream else "download"


def _positive(option: str, value: float | None) -> None:
    if value is not None and not 0 < value < float("inf"):
        raise typer.BadParameter(f"must be above 0, not {value}", param_hint=option)


def _show_plan(
    robot: "Robot", trajectory: "Trajectory", speed: str, mode: "TransferMode", units: Units
) -> None:
    from rich.console import Console
    from rich.table import Table

    console = Console(stderr=True, highlight=False)
    driver = robot.driver
    who = f"rapidgen driver {driver.version}" if driver.is_rapidgen else "standard abb_driver"
    console.print(
        f"{len(trajectory)} points, {trajectory.duration:.2f} s at {speed}, to {robot.address} "
        f"({who}), sent {'during' if mode == 'stream' else 'before'} the motion"
    )
    table = Table("joint", box=None)
    # min and max are of all points; lower and upper are limits of the controller's axes.
    for title in ("now", "min", "max", "end", "lower", "upper", ""):
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


def _report_dry(trajectory: "Trajectory", mode: "TransferMode", as_json: bool) -> None:
    if as_json:
        _print_json(
            {
                "dry_run": True,
                "points": len(trajectory),
                "planned_seconds": trajectory.duration,
                "way": mode,
                "joints": dict(
                    zip(trajectory.names, trajectory.positions[-1].tolist(), strict=False)
                ),
            }
        )
    else:
        typer.echo(f"dry run: {len(trajectory)} points checked, nothing sent")


def _print_json(text: dict[str, object]) -> None:
    import json

    typer.echo(json.dumps(text))


def _report(robot: "Robot", result: "Result", units: Units, as_json: bool) -> None:
    if as_json:
        _print_json(
            {
                "points": result.points,
                "seconds": result.seconds,
                "planned_seconds": result.planned_seconds,
                "deviation": result.deviation,
                "way": result.mode,
                "starved": result.starved,
                "joints": result.state.by_name,
            }
        )
        return
    typer.echo(
        f"done: {result.points} points in {result.seconds:.2f} s, "
        f"{result.deviation:.4f} (rad, m) from the last point ({result.mode})\n"
        f"at {named_text(units, robot.group, result.state.joints)}"
    )


_PLACE = "JOINT=STEP"
_STEPS = 50
"""Parts of a motion in which the tool's speed is measured."""


def jog(
    config: options.Config,
    by: Annotated[
        list[str],
        typer.Argument(
            help="Steps: joint_1=5 joint_3=-2, or z=20 x=-5 in the work object.",
            metavar="JOINT=STEP",
        ),
    ],
    to: options.RobotAddress = "",
    group: options.Group = "",
    yes: options.YesOnLoopback = False,
    move_real_robot: options.RealRobot = "",
    speed: Annotated[
        float,
        typer.Option(
            help="Speed of the tool, mm/s (m/s with --rad).",
            metavar="SPEED",
            show_default="100 mm/s",
        ),
    ] = 0.0,
    rad: options.InRad = False,
    as_json: options.AsJson = False,
) -> int:
    """Move joints or the tool by a small step.

    A step is at most 11.4 deg or 100 mm. x, y and z move the tool on a line in the work object
    and keep its orientation. Ctrl-C stops the robot. The controller stops it if it receives no
    message for 0.2 s. Needs the driver's control port.

    rapidgen jog cell.yaml joint_1=5 joint_3=-2 --to sim

    rapidgen jog cell.yaml z=20 --to sim
    """
    from rapidgen.cli.motion_execution import confirm_at, permitted, report_interruption
    from rapidgen.client import Robot
    from rapidgen.client.program import SLOW

    units = Units(rad)
    if speed < 0 or not math.isfinite(speed):
        raise typer.BadParameter(f"must be above 0, not {speed}", param_hint="--speed")
    requested = _read(by)
    robot = Robot(config, address=to or None, group=group)
    if robot.configuration is not None:
        _steps(robot, units, requested)
    must_ask = permitted(robot, to, yes=yes, real_robot=move_real_robot)
    with robot:
        steps = _steps(robot, units, requested)
        if must_ask:
            confirm_at(robot)
        with report_interruption(robot, units):
            result = robot.jog(speed=speed / units.length[1] or SLOW, **steps)
        if as_json:
            import json

            typer.echo(json.dumps({"seconds": result.seconds, "joints": result.state.by_name}))
        else:
            typer.echo(f"at {named_text(units, robot.group, result.state.joints)}")
    return 0


def _read(by: list[str]) -> Figures:
    if not all("=" in step for step in by):
        raise typer.BadParameter(
            "write JOINT=STEP, such as joint_1=5, or x=5, y=5, z=5", param_hint=_PLACE
        )
    return read_figures(",".join(by), _PLACE)


def _steps(robot: "Robot", units: Units, requested: Figures) -> dict[str, float]:
    """Steps in rad and m by joint or direction. Raises typer.BadParameter."""
    from rapidgen.client.flows.program import DIRECTIONS, LONGEST_JOG

    kinds = {joint.name: joint.kind for joint in robot.group.joints}
    if not set(requested.names) & set(kinds) and set(requested.names) <= set(DIRECTIONS):
        kinds = {name: "prismatic" for name in DIRECTIONS}
    nothing = [0.0] * len(kinds)
    result = named_of(requested, units, kinds, nothing, _PLACE)
    steps = {}
    for name, step in zip(kinds, result, strict=True):
        most = LONGEST_JOG[kinds[name]]
        if abs(step) > most:
            unit, factor, _ = units.joint(kinds[name])
            raise typer.BadParameter(
                f"{name} by {figure(step, factor)} {unit} is too far: at most "
                f"{figure(most, factor)} {unit} at a time; `rapidgen move` goes farther",
                param_hint=_PLACE,
            )
        if step:
            steps[name] = step
    return steps


def stop(
    config: options.ConfigOrHost,
    to: options.RobotAddress = "",
    group: Annotated[
        str, typer.Option(help="Motion group to stop; default: all.", metavar="NAME")
    ] = "",
    rad: options.InRad = False,
    as_json: options.AsJson = False,
) -> int:
    """Stop all motion groups of a robot, or one.

    Not a safety function.
    """
    # `send_stop` has sent the first STOP before this module was imported.
    from rapidgen.client import Cell, Robot, Timeouts
    from rapidgen.client.connect_target import groups_of

    names = [group] if group else groups_of(config)
    quick = Timeouts(connect=2, stop=2)
    cell = Cell({n: Robot(config, address=to or None, group=n, timeouts=quick) for n in names})
    try:
        # All groups get STOP before the state of any is read.
        cell.stop()
    finally:
        cell.close()
    text = {}
    for name in names:
        with Robot(config, address=to or None, group=name, watch=True) as watcher:
            state = watcher.wait_until(lambda s: not s.is_moving, timeout=5)
            text[name] = state.by_name
            if not as_json:
                label = f"{name}: " if name else ""
                where = named_text(Units(rad), watcher.group, state.joints)
                typer.echo(f"{label}stopped at {where}")
    if as_json:
        import json

        typer.echo(json.dumps({"stopped": True, "groups": text}))
    return 0
