"""`rapidgen view`: a page that shows a robot or a recording, and never moves anything."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rapidgen.cli import options
from rapidgen.diagnostics import refusal

if TYPE_CHECKING:
    from rapidgen.client import Robot
    from rapidgen.client.address import Address
    from rapidgen.config.model import GroupConfig
    from rapidgen.view.aspect import Viewed

_LOOK = 3.0
"""s that a controller may take to answer a look at a port."""


def view(
    config: Annotated[
        str,
        typer.Argument(
            metavar="TARGET",
            help="Configuration file, shipped name, HOST[:M,S,C], `sim`, or FILE.mcap.",
        ),
    ],
    to: options.RobotAddress = "",
    group: options.Group = "",
    take: Annotated[
        bool,
        typer.Option("--take", help="Take the only state connection of a plain driver."),
    ] = False,
    host: Annotated[str, typer.Option(help="Address of this machine to serve on.")] = "127.0.0.1",
    port: Annotated[
        int, typer.Option(help="Port of the page; 0: any free port.", min=0, max=65_535)
    ] = 0,
    reconnect: Annotated[
        float, typer.Option(help="Try a lost connection again for so many seconds.", min=0)
    ] = 3600.0,
    csv: Annotated[
        Path | None,
        typer.Option(help="Of a recording: write the positions of a robot, and no page."),
    ] = None,
) -> int:
    """Show a robot or a recording in the browser, read only. Ctrl-C ends it.

    FILE.mcap is what `rapidgen sim --record` has written: everything as it was at any moment.

    When it is served, stdout gets one line: `ready` and a JSON object with the link. With a
    configuration the robot is drawn, with an address alone there are its axes. It takes one of the
    three places of a rapidgen driver's state port; the one place of a plain driver only with
    `--take`: a program that moves the robot loses it, and stops.
    """
    from contextlib import ExitStack

    if config.endswith(".mcap"):
        return _recording(Path(config), csv, group, host, port)
    if csv is not None:
        raise typer.BadParameter("--csv is for a recording: FILE.mcap")

    from rapidgen.client import Robot
    from rapidgen.client.target import groups_of
    from rapidgen.view.robot.observed import ObservedRobots

    names = [group] if group else groups_of(config)
    with ExitStack() as stack:
        robots = []
        for name in names:
            robot = Robot(config, address=to or None, group=name, watch=True, reconnect=reconnect)
            if not take:
                _refuse_plain(robot.address)
            stack.enter_context(robot)
            if not (take or robot.driver.is_rapidgen):
                raise _plain(robot.address)
            robot.next_state(_LOOK)
            robots.append((robot, _known(config, name, robot)))
        title = f"{config} at {robots[0][0].address.host}"
        _serve(ObservedRobots(title, robots), host, port)
    return 0


def _recording(path: Path, csv: Path | None, group: str, host: str, port: int) -> int:
    """Show a recording, or write its positions. Raises DiagnosticError RG930."""
    from rapidgen.view.recording.reader import RecordingFile
    from rapidgen.view.recording.viewing import RecordingSubject

    with RecordingFile(path) as recording:
        if csv is None:
            _serve(RecordingSubject(recording), host, port)
            return 0
        known = [own.name for own in recording.robots]
        if group and group not in known:
            raise typer.BadParameter(f"--group is one of {', '.join(known)}")
        recording.write_csv(csv, group)
    typer.echo(csv)
    return 0


def _serve(subject: "Viewed", host: str, port: int) -> None:
    """Serve the page until a signal comes."""
    import json
    import signal
    import threading
    from contextlib import ExitStack

    from rapidgen.view.server import serve_page

    with ExitStack() as stack:
        page = serve_page(subject, host, port)
        stack.callback(page.close)
        ended = threading.Event()
        for number in (signal.SIGINT, signal.SIGTERM):
            stack.callback(signal.signal, number, signal.signal(number, lambda *_: ended.set()))
        typer.echo(f"ready {json.dumps({'view': page.url})}")
        ended.wait()


def _known(target: str, group: str, robot: "Robot") -> "GroupConfig":
    """The robot's configuration; of an address alone what the driver has told of its joints."""
    from rapidgen.config import load_config
    from rapidgen.config.model import GroupConfig, Ports

    if group:
        found = {own.name: own for own in load_config(target).groups}
        return found[group]
    joints = robot.group.map.joints
    return GroupConfig(robot.group.name or "robot", "", "", joints, Ports())


def _refuse_plain(address: "Address") -> None:
    """Refuse what has no control port, before its state port is touched."""
    import socket

    try:
        socket.create_connection((address.host, address.control), _LOOK).close()
    except OSError as fault:
        raise _plain(address) from fault


def _plain(address: "Address") -> Exception:
    return refusal(
        "RG923",
        None,
        f"{address} has no control port, so it may serve one client: looking would take its place",
        "with `--take` it is taken, and a program that moves the robot then stops it",
        exit_code=1,
    )
