"""`rapidgen view`: a robot or a recording in the browser; neither moves from there."""

from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rapidgen.cli import options
from rapidgen.diagnostics import refusal

if TYPE_CHECKING:
    from collections.abc import Mapping

    from rapidgen.client import Robot
    from rapidgen.client.address import Address
    from rapidgen.config.model import GroupConfig
    from rapidgen.viewer.appearance import Appearance
    from rapidgen.viewer.provider import Subject

_LOOK = 3.0
"""s that a controller may take to answer a look at a port."""


def view(
    target: Annotated[
        str,
        typer.Argument(
            help="Recording (`rapidgen sim --record`), configuration, shipped name, HOST[:M,S,C], "
            "or `sim`."
        ),
    ],
    to: options.RobotAddress = "",
    group: options.Group = "",
    take_connection: Annotated[
        bool,
        typer.Option("--take-connection", help="Take the only state connection of a plain driver."),
    ] = False,
    host: Annotated[str, typer.Option(help="Address of this machine to serve on.")] = "127.0.0.1",
    port: Annotated[
        int, typer.Option(help="Port of the page; 0: any free port.", min=0, max=65_535)
    ] = 0,
    reconnect: Annotated[
        float, typer.Option(help="Try a lost connection again for so many seconds.", min=0)
    ] = 3600.0,
    csv: Annotated[
        Path | None, typer.Option(help="Write a recording's positions of a robot, and no page.")
    ] = None,
    robot: Annotated[str, typer.Option(help="Whose, with --csv; default: the first.")] = "",
) -> int:
    """Show a robot or a recording in the browser, read only. Ctrl-C ends it.

    When it is served, stdout gets one line: `ready` and a JSON object with the link. With a
    configuration the robot is drawn, with an address alone there are its axes. It takes one of the
    three places of a rapidgen driver's state port; the one place of a plain driver only with
    `--take-connection`: a program that moves the robot loses it, and stops. A recording shows
    everything as it was at any moment; one that was cut off is shown up to there.
    """
    with ExitStack() as stack:
        if not _is_recording(target):
            if csv is not None:
                raise typer.BadParameter("--csv is of a recording")
            viewed, look = _robots(stack, target, to, group, take_connection, reconnect)
            return _serve(viewed, host, port, look.files)
        from rapidgen.viewer.recording.playback import RecordingSubject
        from rapidgen.viewer.recording.reader import RecordingFile

        recording = stack.enter_context(RecordingFile(Path(target)))
        if csv is None:
            return _serve(RecordingSubject(recording), host, port, recording.look.files)
        try:
            recording.write_csv(csv, robot)
        except KeyError as error:
            known = ", ".join(group.name for group in recording.robots)
            raise typer.BadParameter(f"--robot is one of {known}") from error
        typer.echo(csv)
    return 0


def _is_recording(target: str) -> bool:
    path = Path(target)
    return path.suffix.lower() == ".mcap" or (
        path.is_file() and path.suffix.lower() not in (".yaml", ".yml")
    )


def _serve(viewed: "Subject", host: str, port: int, files: "Mapping[str, bytes]") -> int:
    """Serve the page until a signal comes; the exit code."""
    import json
    import threading

    from rapidgen.cli.termination import on_signal
    from rapidgen.viewer.server import serve_page

    finished = threading.Event()
    with on_signal(finished.set):
        page = serve_page(viewed, host, port, files)
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
    """All robots of a configuration, or one at an address, connected until the stack closes; and
    what they look like."""
    from rapidgen.client import Robot
    from rapidgen.client.connect_target import groups_of
    from rapidgen.viewer.appearance import appearance
    from rapidgen.viewer.robot.observed import ObservedRobots

    robots = []
    for name in [group] if group else groups_of(target):
        robot = Robot(target, address=to or None, group=name, watch=True, reconnect=reconnect)
        stack.enter_context(robot)
        if not (take_connection or robot.driver.is_rapidgen):
            raise _plain(robot.address)
        robot.next_state(_LOOK)
        robots.append((robot, _known(target, name, robot)))
    configs = [config for _, config in robots]
    file = Path(target)
    described = {config.name: file for config in configs} if file.is_file() else {}
    look = appearance(configs, described)
    return ObservedRobots(f"{target} at {robots[0][0].address.host}", robots, look), look


def _known(target: str, group: str, robot: "Robot") -> "GroupConfig":
    """The robot's configuration; of an address alone what the driver has told of its joints."""
    from rapidgen.config import load_config
    from rapidgen.config.model import GroupConfig, Ports

    if group:
        result = {own.name: own for own in load_config(target).groups}
        return result[group]
    return GroupConfig(robot.group.name or "robot", "", "", robot.group.map.joints, Ports())


def _plain(address: "Address") -> Exception:
    return refusal(
        "RG923",
        None,
        f"{address} does not answer HELLO and may serve one client: looking would take its place",
        "with `--take-connection` it is taken, and a program that moves the robot then stops it",
        exit_code=1,
    )
