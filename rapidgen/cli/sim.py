"""`rapidgen sim`: a virtual controller in real time, until it is interrupted."""

from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from rapidgen.cli import options
from rapidgen.cli.terminal import letters, use_colour
from rapidgen.diagnostics import Diagnostic, refusal, render

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from rapidgen.controller.booting import Bootable
    from rapidgen.controller.controller import VirtualController
    from rapidgen.faces.control_socket import ControlSocket


def sim(
    targets: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="TARGET...",
            help="Configuration, shipped name, generated folder, ABB backup, or RAPID files.",
        ),
    ] = None,
    host: Annotated[
        str, typer.Option(help="Address of this machine to serve on; loopback stays private.")
    ] = "127.0.0.1",
    port_offset: Annotated[
        int, typer.Option(help="Added to every port of the program.", metavar="N")
    ] = 0,
    ports: Annotated[
        Literal["auto"] | None, typer.Option(help="`auto`: any free ports.", metavar="auto")
    ] = None,
    speed: Annotated[
        float, typer.Option(help="Simulated seconds in a second.", min=0.001, max=1000.0)
    ] = 1.0,
    cold: Annotated[bool, typer.Option("--cold", help="Motors off, program not started.")] = False,
    faults: Annotated[
        Path | None, typer.Option(help="What is to go wrong: `rapidgen explain RG421`.")
    ] = None,
    task: options.Tasks = None,
    robot: options.RobotModel = "",
    entry: options.Entry = "",
    cell: options.Cell = "",
    start: options.Start = "",
    ftp: Annotated[
        int | None,
        typer.Option(help="Serve HOME over FTP; 0: any free port.", min=0, max=65_535),
    ] = None,
    sftp: Annotated[
        int | None,
        typer.Option(help="Serve HOME over SFTP; 0: any free port.", min=0, max=65_535),
    ] = None,
    answers: Annotated[
        Path | None, typer.Option(help="The operator's answers: `rapidgen explain RG420`.")
    ] = None,
    overrides: options.Overrides = None,
    backup: options.Backup = None,
    check: options.LoadCheck = True,
) -> int:
    """Run a virtual controller in real time.

    What a controller would not load is refused: all its errors are told, nothing runs. When
    its servers may be reached, stdout gets one line: `ready` and a JSON object with the ports of
    each group, of the control socket, and of the file servers with their login. What the
    operator and the event log would show goes to stderr. Ctrl-C ends it.
    """
    from rapidgen.cli.bootable import chosen
    from rapidgen.controller.controller import VirtualController
    from rapidgen.controller.faults import read_plan
    from rapidgen.faces.control_commands import commands, subscribe
    from rapidgen.faces.control_socket import ControlSocket
    from rapidgen.machine.operator import read_answers

    if ports is not None and port_offset:
        raise typer.BadParameter("either --port-offset or --ports auto")
    found = chosen(
        targets or (),
        tasks=task,
        robot=robot,
        entry=entry,
        cell=cell,
        start=start,
        backup=backup,
        overrides=overrides,
        check=check,
    )
    plan = read_plan(faults) if faults is not None else None
    script = read_answers(answers) if answers is not None else None
    _check_host(host)
    if ports is None and found.driver:
        _check_ports(found, host, port_offset)
    with VirtualController.boot(
        found,
        clock="real",
        speed=speed,
        host=host,
        ports=ports or port_offset,
        faults=plan,
        answers=script,
        autostart=not cold,
    ) as controller:
        _tell(controller.diagnostics)
        if cold:
            _start_cold(controller)
        # Whoever may command the controller is on this machine, whoever may reach its servers.
        control = ControlSocket(
            controller.scheduler,
            commands(controller),
            lambda listener: subscribe(controller, listener),
        )
        try:
            with _files(controller, host, ftp, sftp) as files:
                return _serve(controller, found, control, host, speed, files)
        finally:
            control.close()


def _serve(
    controller: "VirtualController",
    target: "Bootable",
    control: "ControlSocket",
    host: str,
    speed: float,
    files: "dict[str, dict[str, str | int]]",
) -> int:
    """Run until a signal comes; the exit code."""
    import json
    import signal

    from rapidgen.cli.readiness import PATIENCE, Readiness

    ended = False

    def end(*_: object) -> None:
        def now() -> None:
            nonlocal ended
            ended = True

        controller.scheduler.post(now)

    before = {s: signal.signal(s, end) for s in (signal.SIGINT, signal.SIGTERM)}
    controller.log.subscribe(lambda event: typer.echo(event, err=True))
    controller.operator.subscribe(
        lambda task, text: typer.echo(f"{task}: {letters(text)}", err=True)
    )
    for event in controller.log:
        typer.echo(event, err=True)
    scheduler = controller.scheduler
    scheduler.rebase()
    try:
        readiness = Readiness(controller, target)
        patience = scheduler.now + round(PATIENCE * speed * 1e9)
        scheduler.advance(patience, lambda: ended or readiness.decided)
        if ended:
            return 0
        if not readiness.up:
            raise readiness.refusal()
        found = {
            "name": target.name,
            "host": host,
            "ports": _ports(controller, target),
            "listeners": {str(p): at[1] for p, at in controller.network.listeners.items()},
            "control": control.address[1],
            **files,
        }
        if not target.driver:
            for place in controller.where():
                typer.echo(place, err=True)
        typer.echo(f"ready {json.dumps(found)}")
        scheduler.advance(stop=lambda: ended)
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
    return 0


@contextmanager
def _files(
    controller: "VirtualController", host: str, ftp: int | None, sftp: int | None
) -> "Iterator[dict[str, dict[str, str | int]]]":
    """HOME over FTP and SFTP; what `ready` tells of each. Raises DiagnosticError RG560, RG561."""
    from contextlib import ExitStack

    from rapidgen.faces import serve_ftp, serve_sftp

    told: dict[str, dict[str, str | int]] = {}
    with ExitStack() as stack:
        for name, serve, port in (("ftp", serve_ftp, ftp), ("sftp", serve_sftp, sftp)):
            if port is None:
                continue
            service = serve(controller.files.path("HOME:"), host, port)
            stack.callback(service.close)
            # The login is new in every run and good on this machine only.
            told[name] = {
                "port": service.port,
                "user": service.user,
                "password": service.password,
            }
            if service.host_key:
                told[name]["host_key"] = service.host_key
        yield told


def _start_cold(controller: "VirtualController") -> None:
    """As after switching on: background tasks run, motors are off, the program waits."""
    controller.set_motors(False)
    for task in controller.rapid_tasks.values():
        if task.spec.type != "NORMAL":
            task.start()


# -- servers ------------------------------------------------------------------------------------


def _ports(controller: "VirtualController", target: "Bootable") -> dict[str, dict[str, int]]:
    listeners = controller.network.listeners
    if not target.driver:
        return {}
    return {
        group.name: {
            role: listeners[port][1]
            for role, port in (
                ("motion", group.ports.motion),
                ("control", group.ports.control),
                ("state", group.ports.state),
            )
            if port in listeners
        }
        for group in target.groups
    }


def _check_host(host: str) -> None:
    import ipaddress

    try:
        ipaddress.IPv4Address(host)
    except ValueError as fault:
        raise typer.BadParameter(f"--host takes an IPv4 address, not '{host}'") from fault


def _check_ports(target: "Bootable", host: str, offset: int) -> None:
    """Say at once that a port is taken, instead of letting the program fail at it."""
    import socket

    from rapidgen.cli.readiness import wanted_ports

    for port in wanted_ports(target):
        if not 0 < port + offset < 65_536:
            raise typer.BadParameter(f"--port-offset moves port {port} to {port + offset}")
        with socket.socket() as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                probe.bind((host, port + offset))
            except OSError as fault:
                raise refusal(
                    "RG431",
                    None,
                    f"port {port + offset} of {host} cannot be had: {fault.strerror}",
                    "move all ports with `--port-offset N`, or let `--ports auto` choose",
                    exit_code=1,
                ) from fault


def _tell(found: "Iterable[object]") -> None:
    import sys

    notes = [d for d in found if isinstance(d, Diagnostic)]
    if notes:
        sys.stderr.write(render(notes, colour=use_colour()))
