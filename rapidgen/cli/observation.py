"""The commands `pose`, `monitor`, `record`, `view` and `plot`."""

import sys
import time
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rapidgen.cli import options
from rapidgen.cli.target_text import Units, joints_of, joints_text, pose_text, read_figures
from rapidgen.diagnostics import DiagnosticError, Span, error, refusal

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from rapidgen.client import Robot, Trajectory
    from rapidgen.client.address import Address
    from rapidgen.client.recording import JointRecording
    from rapidgen.config.model import GroupConfig
    from rapidgen.motion.recorder import Recording
    from rapidgen.viewer.appearance import Appearance
    from rapidgen.viewer.provider import Subject


def pose(
    config: options.Config,
    joints: Annotated[
        str,
        typer.Option(
            help="Joint values to compute the pose for, without a robot.", metavar="J1,J2,..."
        ),
    ] = "",
    to: options.RobotAddress = "",
    group: options.Group = "",
    rad: options.InRad = False,
    as_json: options.AsJson = False,
) -> int:
    """Show the pose of the tool and the joint values.

    The pose is X,Y,Z in mm and the quaternion Q1,Q2,Q3,Q4 in the work object; joints are in deg
    and mm. `rapidgen move` takes both in this form.

    rapidgen pose cell.yaml --to sim
    """
    import json

    from rapidgen.client import Robot

    units = Units(rad)
    robot = Robot(config, address=to or None, group=group, watch=True)
    if joints:
        from rapidgen.client.connect_target import resolve

        _, known = resolve(config, robot.address, group)
        assert known is not None
        at = joints_of(read_figures(joints), units, known, [0.0] * len(known.names))
        where = known.poses.pose(known.map.to_controller(at))
    else:
        with robot:
            known, at = robot.group, robot.state.joints
            where = robot.pose_of(at)
    if as_json:
        text = {"position": where[0], "orientation": where[1]}
        typer.echo(json.dumps({**text, "joints": dict(zip(known.names, at, strict=True))}))
        return 0
    typer.echo(f"pose    {pose_text(units, where)}  ({units.length[0]}, quaternion)")
    typer.echo(f"joints  {joints_text(units, known, at)}  ({units.text})")
    return 0


def monitor(
    config: options.ConfigOrHost,
    to: options.RobotAddress = "",
    group: options.Group = "",
    lines: Annotated[
        bool, typer.Option("--lines", help="One line per state, deg and mm, instead of a table.")
    ] = False,
    as_json: Annotated[
        bool, typer.Option("--json", help="One JSON object per state; rad and m.")
    ] = False,
    count: Annotated[
        int,
        typer.Option(help="Number of states to show; 0: until Ctrl-C.", min=0, metavar="N"),
    ] = 0,
    reconnect: options.Reconnect = 0.0,
) -> int:
    """Show the joints, mode and message rate of a robot live.

    Ctrl-C ends it. A rapidgen driver serves three clients. A standard abb_driver serves only the
    newest: monitoring then takes the connection from a program that moves the robot, which stops.
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


def record(
    config: options.ConfigOrHost,
    output: Annotated[
        Path, typer.Option("--output", "-o", help="CSV file to write.", metavar="FILE")
    ],
    to: options.RobotAddress = "",
    group: options.Group = "",
    seconds: Annotated[
        float,
        typer.Option(help="Duration; 0: until Ctrl-C.", min=0, metavar="SECONDS"),
    ] = 0.0,
    reconnect: options.Reconnect = 0.0,
    feedback: Annotated[
        bool,
        typer.Option("--feedback", help="Time stamps of the controller's clock."),
    ] = False,
) -> int:
    """Record the joint positions of a robot as CSV.

    The columns are `time,<joint names>` in s and rad (m). A rapidgen driver serves three clients.
    A standard abb_driver serves only the newest: recording then takes the connection from a
    program that moves the robot; `rapidgen move --record` moves and records.
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
            # Ctrl-C is the usual end of a recording.
            typer.echo("", err=True)
        typer.echo(f"{writer.count} states in {output}", err=True)
    return 0


_STATE_TIMEOUT = 3.0
"""Seconds to wait for the first state of a robot."""


def view(
    target: Annotated[
        str,
        typer.Argument(
            help="Recording (`sim --record`), configuration, shipped name, HOST[:M,S,C] or `sim`.",
            metavar="TARGET",
        ),
    ],
    to: options.RobotAddress = "",
    group: options.Group = "",
    take_connection: Annotated[
        bool,
        typer.Option(
            "--take-connection", help="Take the only state connection of a standard abb_driver."
        ),
    ] = False,
    host: Annotated[
        str, typer.Option(help="Address to serve the page on.", metavar="ADDRESS")
    ] = "127.0.0.1",
    port: Annotated[
        int,
        typer.Option(help="Port of the page; 0: any free port.", min=0, max=65_535, metavar="PORT"),
    ] = 0,
    reconnect: options.Reconnect = 3600.0,
    csv: Annotated[
        Path | None,
        typer.Option(
            help="Write the positions of a robot of a recording, without a page.", metavar="FILE"
        ),
    ] = None,
    robot: Annotated[
        str, typer.Option(help="Robot for --csv; default: the first.", metavar="NAME")
    ] = "",
) -> int:
    """Show a robot or a recording in the browser, read only.

    Ctrl-C ends it. When the page is ready, stdout gets one line: `ready` and a JSON object with
    the URL. With a configuration the page shows the robot, with an address only its axes. It uses
    one of the three state connections of a rapidgen driver. It uses the only one of a standard
    abb_driver with --take-connection: a program that moves the robot then loses its connection
    and stops. A truncated recording is shown up to its last complete data.
    """
    with ExitStack() as stack:
        if not _is_recording(target):
            if csv is not None:
                raise typer.BadParameter("--csv needs a recording")
            subject, look = _robots(stack, target, to, group, take_connection, reconnect)
            return _serve(subject, host, port, look.files)
        from rapidgen.viewer.recording.playback import RecordingSubject
        from rapidgen.viewer.recording.reader import RecordingFile

        recording = stack.enter_context(RecordingFile(Path(target)))
        if csv is None:
            return _serve(RecordingSubject(recording), host, port, recording.look.files)
        try:
            recording.write_csv(csv, robot)
        except KeyError as error:
            known = ", ".join(group.name for group in recording.robots)
            raise typer.BadParameter(f"--robot must be one of {known}") from error
        typer.echo(csv)
    return 0


def _is_recording(target: str) -> bool:
    path = Path(target)
    return path.suffix.lower() == ".mcap" or (
        path.is_file() and path.suffix.lower() not in (".yaml", ".yml")
    )


def _serve(subject: "Subject", host: str, port: int, files: "Mapping[str, bytes]") -> int:
    """Serve the page until a signal comes; return the exit code."""
    import json
    import threading

    from rapidgen.cli.terminal import on_signal
    from rapidgen.viewer.server import serve_page

    finished = threading.Event()
    with on_signal(finished.set):
        page = serve_page(subject, host, port, files)
        try:
            typer.echo(f"ready {json.dumps({'view': page.url})}")
            finished.wait()
        finally:
            page.close()
    return 0


# -- robots ---------------------------------------------------------------------------------------


def _robots(
    stack: ExitStack, target: str, to: str, group: str, take_connection: bool, reconnect: float
) -> "tuple[Subject, Appearance]":
    """Connect to all robots of a configuration, or to one address; return their appearance too.

    They stay connected until the stack closes.
    """
    from rapidgen.client import Robot
    from rapidgen.client.connect_target import groups_of
    from rapidgen.viewer.appearance import appearance
    from rapidgen.viewer.robot.observed import ObservedRobots

    robots = []
    for name in [group] if group else groups_of(target):
        robot = Robot(target, address=to or None, group=name, watch=True, reconnect=reconnect)
        stack.enter_context(robot)
        if not (take_connection or robot.driver.is_rapidgen):
            raise _connection_in_use(robot.address)
        robot.next_state(_STATE_TIMEOUT)
        robots.append((robot, _configuration_of(target, name, robot)))
    configs = [config for _, config in robots]
    file = Path(target)
    described = {config.name: file for config in configs} if file.is_file() else {}
    look = appearance(configs, described)
    return ObservedRobots(f"{target} at {robots[0][0].address.host}", robots, look), look


def _configuration_of(target: str, group: str, robot: "Robot") -> "GroupConfig":
    """Return a robot's configuration; for an address, what the driver reports of its joints."""
    from rapidgen.config import load_config
    from rapidgen.config.model import GroupConfig, Ports

    if group:
        result = {own.name: own for own in load_config(target).groups}
        return result[group]
    return GroupConfig(robot.group.name or "robot", "", "", robot.group.map.joints, Ports())


def _connection_in_use(address: "Address") -> Exception:
    return refusal(
        "RG923",
        None,
        f"{address} does not answer HELLO: its only state connection may be in use",
        "`--take-connection` takes it; a program that moves the robot then stops",
        exit_code=1,
    )


def plot(
    commanded: Annotated[
        Path,
        typer.Argument(
            help="CSV `time,<joint names>` (s, rad, m), or a file of `controller.record()`.",
            metavar="COMMANDED",
        ),
    ],
    executed: Annotated[
        Path | None,
        typer.Argument(help="Recording to compare with.", metavar="EXECUTED"),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output",
            "-o",
            help="File: .html, .png or .svg; without suffix: .html and, if possible, .png.",
            metavar="FILE",
        ),
    ] = None,
    robot: Annotated[
        str, typer.Option(help="Configuration or shipped name, for the limits.", metavar="NAME")
    ] = "",
    linear: Annotated[
        list[str] | None, typer.Option(help="Joint with values in m; repeatable.", metavar="JOINT")
    ] = None,
) -> int:
    """Plot joints over time, from one or two recordings.

    The second file is compared with the first. The plot of a virtual controller's recording also
    shows the speed and the path of the tool.
    """
    from rapidgen.client.core.group import Group
    from rapidgen.client.trajectory import Trajectory
    from rapidgen.config import load_config
    from rapidgen.viewer import plot as draw
    from rapidgen.viewer.plotting import files_of

    group, metres = None, linear or ()
    if robot:
        config = load_config(robot)
        group = Group.of(config, config.groups[0])
    if executed is None and _is_joint_recording(commanded):
        made = draw(_recording(commanded), title=commanded.name, group=group, linear=metres)
    elif executed is None:
        trajectory = Trajectory.from_csv(commanded)
        title = commanded.name
        made = draw(trajectory, labels=[commanded.stem], title=title, group=group, linear=metres)
    else:
        both = Trajectory.from_csv(commanded), Trajectory.from_csv(executed)
        title = f"{commanded.name} against {executed.name}"
        labels = "commanded", "executed"
        made = draw(*both, labels=labels, title=title, group=group, linear=metres)
    for path in files_of(output if output is not None else commanded.with_suffix("")):
        typer.echo(made.save(path))
    return 0


def _is_joint_recording(path: Path) -> bool:
    from rapidgen.motion.recorder import is_recording

    return path.is_file() and is_recording(path)


def draw_motion(
    files: "Sequence[Path]",
    robot: "Robot",
    commanded: "Trajectory",
    executed: "JointRecording | None",
) -> None:
    """Plot a trajectory and its execution."""
    from rapidgen.viewer import plot as draw

    both = (commanded, executed) if executed is not None and len(executed) else (commanded,)
    labels = ["commanded" if len(both) > 1 else "planned"]
    made = draw(*both, labels=labels, group=robot.group, title=f"joints at {robot.address}")
    for path in files:
        typer.echo(f"wrote {made.save(path)}", err=True)


def _recording(path: Path) -> "Recording":
    """Read a recording. Raises DiagnosticError RG610 if it is damaged."""
    from rapidgen.motion.recorder import read_recording

    try:
        return read_recording(path)
    except ValueError as raised:
        help = "record again with `controller.record()` and `write_csv`"
        raise DiagnosticError(error("RG610", Span(str(path), 1, 1), str(raised), help)) from None
