"""The command `sim`: a virtual controller in real time, until it is interrupted."""

from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from rapidgen.cli import options
from rapidgen.cli.terminal import letters, use_colour
from rapidgen.diagnostics import Diagnostic, refusal, render

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from rapidgen._json import Members
    from rapidgen.controller.boot_targets import Bootable
    from rapidgen.controller.controller import VirtualController
    from rapidgen.controller.runner import ControllerRunner
    from rapidgen.viewer.appearance import Appearance


def sim(
    targets: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="TARGET",
            help="Configuration, shipped name, generated folder, ABB backup or RAPID files.",
        ),
    ] = None,
    host: Annotated[
        str, typer.Option(help="Address to serve on; loopback is private.", metavar="ADDRESS")
    ] = "127.0.0.1",
    port_offset: Annotated[
        int, typer.Option(help="Offset added to every port of the program.", metavar="N")
    ] = 0,
    ports: Annotated[
        Literal["auto"] | None, typer.Option(help="Use free ports.", metavar="auto")
    ] = None,
    speed: Annotated[
        float,
        typer.Option(help="Simulated seconds per second.", min=0.001, max=1000.0, metavar="FACTOR"),
    ] = 1.0,
    motors_off: Annotated[
        bool, typer.Option("--motors-off", help="Start with motors off and the program stopped.")
    ] = False,
    faults: Annotated[
        Path | None,
        typer.Option(help="Faults to inject: `rapidgen explain RG421`.", metavar="FILE.yaml"),
    ] = None,
    task: options.Tasks = None,
    robot: options.RobotModel = "",
    robotware: options.Release = "",
    entry: options.Entry = "",
    cell: options.Cell = "",
    start: options.Start = "",
    ftp: Annotated[
        int | None,
        typer.Option(
            help="Port to serve HOME over FTP; 0: any free port.", min=0, max=65_535, metavar="PORT"
        ),
    ] = None,
    sftp: Annotated[
        int | None,
        typer.Option(
            help="Port to serve HOME over SFTP; 0: any free port.",
            min=0,
            max=65_535,
            metavar="PORT",
        ),
    ] = None,
    rws: Annotated[
        Literal["1", "2", "8"] | None,
        typer.Option(help="Serve Robot Web Services 1.0, 2.0, or 2.0 as in RobotWare 8."),
    ] = None,
    rws_port: Annotated[
        int,
        typer.Option(
            help="Port of Robot Web Services; 0: any free port.",
            min=0,
            max=65_535,
            metavar="PORT",
        ),
    ] = 0,
    rws_lenient: Annotated[
        bool,
        typer.Option("--rws-lenient", help="Accept requests that real controllers reject."),
    ] = False,
    rws_deny: Annotated[
        list[str] | None,
        typer.Option(help="UAS grant to deny to `Default User`; repeatable.", metavar="GRANT"),
    ] = None,
    egm: Annotated[
        list[str] | None,
        typer.Option(
            help="Partner of an EGM device; repeatable. Others are on this computer.",
            metavar="DEVICE=HOST:PORT",
        ),
    ] = None,
    view: Annotated[
        bool,
        typer.Option("--view", help="Serve a page that shows the robot; `ready` contains its URL."),
    ] = False,
    view_port: Annotated[
        int,
        typer.Option(help="Port of the page; 0: any free port.", min=0, max=65_535, metavar="PORT"),
    ] = 0,
    record: Annotated[
        Path | None,
        typer.Option(help="Recording; after a restart NAME-2.mcap and so on.", metavar="NAME.mcap"),
    ] = None,
    watch: Annotated[
        list[str] | None,
        typer.Option(help="RAPID expression to record; repeatable.", metavar="TASK:EXPRESSION"),
    ] = None,
    collisions: Annotated[
        Literal["error", "warn", "off"] | None,
        typer.Option(
            "--collisions",
            help="Stop at a collision in the cell, or log it; default: error if the cell file has "
            "`collision:`.",
            show_default=False,
        ),
    ] = None,
    assume: Annotated[
        str,
        typer.Option(
            "--assume", metavar="SWITCH=VALUE,...", help="Assumptions about the controller."
        ),
    ] = "",
    answers: Annotated[
        Path | None,
        typer.Option(help="Operator's answers: `rapidgen explain RG420`.", metavar="FILE.yaml"),
    ] = None,
    coverage: options.Coverage = None,
    plot: options.Plot = None,
    overrides: options.Overrides = None,
    backup: options.TargetBackup = None,
    check: options.LoadCheck = True,
) -> int:
    """Run a virtual controller in real time.

    Rejects programs that a controller would not load, and lists all their errors. When the
    servers accept connections, stdout gets one line: `ready` and a JSON object with the ports of
    each group, the control socket with its token, and the file servers with their login. Operator
    messages and the event log go to stderr. Ctrl-C ends it. Other commands find it by `--to sim`.
    """
    from rapidgen.cli.boot_options import assumptions, load_boot_target
    from rapidgen.cli.run_outputs import Outputs, observing, read_appearance
    from rapidgen.controller.faults import FaultPlan, read_plan
    from rapidgen.controller.runner import ControllerRunner
    from rapidgen.machine.operator import read_answers

    if ports is not None and port_offset:
        raise typer.BadParameter("use either --port-offset or --ports auto")
    requested = Outputs(coverage=tuple(coverage or ()), plots=tuple(plot or ()))
    requested.check_files_writable()
    result = load_boot_target(
        targets or (),
        tasks=task,
        robot=robot,
        robotware=robotware,
        entry=entry,
        cell=cell,
        start=start,
        backup=backup,
        overrides=overrides,
        check=check,
    )
    # The page can inject network faults without a plan.
    plan = read_plan(faults) if faults is not None else FaultPlan() if view else None
    script = read_answers(answers) if answers is not None else None
    _check_host(host)
    _check_release(result, rws)
    denied = _denied(rws_deny or ())
    partners = {**result.surroundings.partners, **_partners(egm or ())}
    if ports is None and result.driver:
        _check_ports(result, host, port_offset)
    detection = result.collisions(collisions)
    look = read_appearance(result) if view or record is not None else None
    with ControllerRunner.boot(
        result,
        clock="real",
        speed=speed,
        host=host,
        ports=ports or port_offset,
        faults=plan,
        answers=script,
        tracing=requested.tracing,
        dialect=assumptions(assume),
        detection=detection,
        autostart=not motors_off,
    ) as runner:
        _print_notes(runner.controller.diagnostics)
        if runner.controller.collisions is not None:
            world = runner.controller.collisions.world
            _print_notes(world.diagnostics)
            for text in world.unchecked:
                typer.echo(f"not checked for collisions: {text}", err=True)
        if motors_off:
            _start_background_tasks(runner.controller)
        with (
            _control(runner) as control,
            _guided(runner, partners),
            _servers(runner, host, ftp, sftp, (rws, rws_port, not rws_lenient, denied)) as servers,
            _page(runner, look if view else None, host, view_port) as page,
            _recording(runner, look, record, watch or ()),
            observing(runner, requested),
        ):
            return _serve(runner, result, host, speed, {**control, **servers, **page})


def _serve(
    runner: "ControllerRunner", target: "Bootable", host: str, speed: float, servers: "Members"
) -> int:
    """Run until a signal comes; return the exit code."""
    import json
    import os

    from rapidgen._simulator_registry import Simulator, published
    from rapidgen.cli.readiness import READY_TIMEOUT, Readiness
    from rapidgen.cli.terminal import on_signal

    finished = False

    def end() -> None:
        # Set at once: nothing can be posted during a restart. The post wakes the runner.
        nonlocal finished
        finished = True
        runner.post(lambda: None)

    def follow() -> None:
        runner.controller.log.subscribe(lambda event: typer.echo(event, err=True))
        runner.controller.operator.subscribe(
            lambda task, text: typer.echo(f"{task}: {letters(text)}", err=True)
        )
        for event in runner.controller.log:
            typer.echo(event, err=True)

    follow()
    runner.on_boot.append(follow)
    controller = runner.controller
    scheduler = controller.scheduler
    scheduler.rebase()
    with on_signal(end):
        readiness = Readiness(controller, target)
        timeout = scheduler.now + round(READY_TIMEOUT * speed * 1e9)
        scheduler.advance(timeout, lambda: finished or readiness.decided)
        if finished:
            return 0
        if not readiness.up:
            raise readiness.refusal()
        addresses = _addresses(controller, target, host)
        result = {
            "name": target.name,
            "host": host,
            "ports": _ports(controller, target),
            "address": addresses,
            "listeners": {str(p): at[1] for p, at in controller.network.listeners.items()},
            **servers,
        }
        if not target.driver:
            for place in controller.where():
                typer.echo(place, err=True)
        # For clients on this computer, as in `_addresses`.
        services = str(servers.get("rws", "")).replace("//0.0.0.0:", "//127.0.0.1:")
        fingerprint = str(servers.get("fingerprint", ""))
        own = Simulator(target.name, os.getpid(), addresses, services, fingerprint)
        with published(own):
            typer.echo(f"ready {json.dumps(result)}")
            runner.run(lambda: finished)
    return 0


@contextmanager
def _control(runner: "ControllerRunner") -> "Iterator[Members]":
    """Open the control socket, also after each restart; yield its port and token."""
    from rapidgen.dap.attach import Endpoint
    from rapidgen.servers.control_commands import READABLE, commands, subscribe
    from rapidgen.servers.control_socket import ControlSocket

    def opened(port: int, token: str) -> ControlSocket:
        controller = runner.controller
        # Always loopback, independent of `--host`.
        return ControlSocket(
            controller.scheduler,
            {**commands(controller), "debug": Endpoint(runner).open},
            lambda listener, trusted: subscribe(controller, listener, trusted),
            readable=READABLE,
            port=port,
            token=token,
        )

    control = opened(0, "")
    port, token = control.address[1], control.token

    def reopen() -> None:
        nonlocal control
        control = opened(port, token)

    def close() -> None:
        control.close()

    runner.on_restart.append(close)
    runner.on_boot.append(reopen)
    try:
        yield {"control": port, "token": token}
    finally:
        control.close()


@contextmanager
def _servers(
    runner: "ControllerRunner",
    host: str,
    ftp: int | None,
    sftp: int | None,
    rws: tuple[str | None, int, bool, frozenset[str]],
) -> "Iterator[Members]":
    """Serve HOME over FTP and SFTP, and Robot Web Services; yield their entries in `ready`.

    Raises DiagnosticError RG560, RG561.
    """
    import os
    from contextlib import ExitStack

    from rapidgen.servers import serve_ftp, serve_sftp

    text: Members = {}
    with ExitStack() as stack:
        for name, serve, at in (("ftp", serve_ftp, ftp), ("sftp", serve_sftp, sftp)):
            if at is None:
                continue
            service = serve(runner.controller.files.path("HOME:"), host, at)
            stack.callback(service.close)
            # The login is new in every run and valid on this computer only.
            login: Members = {
                "port": service.port,
                "user": service.user,
                "password": service.password,
            }
            if service.host_key:
                login["host_key"] = service.host_key
            text[name] = login
        generation, port, strict, denied = rws
        if generation is not None:
            from rapidgen.servers.rws.application import Accounts
            from rapidgen.servers.rws.server import KNOWN, serve_rws
            from rapidgen.wire.rws.bodies import Generation

            own = os.environ.get("RAPIDGEN_PASSWORD") or KNOWN
            users = {"Default User": own, "Admin": own}
            accounts = Accounts(users, denied)
            which = Generation(int(generation))
            service = serve_rws(runner, which, host, port, accounts, strict=strict)
            stack.callback(service.close)
            scheme = "rws" if which is Generation.ONE else "rwss"
            text["rws"] = f"{scheme}://{service.host}:{service.port}"
            if service.host_key:
                text["fingerprint"] = service.host_key
        yield text


def _partners(texts: "Iterable[str]") -> dict[str, tuple[str, int]]:
    """Return addresses by device of DEVICE=HOST:PORT."""
    import socket

    result = {}
    for text in texts:
        device, _, address = text.partition("=")
        host, _, port = address.rpartition(":")
        if not (device and host and port.isdecimal() and 0 < int(port) < 65_536):
            raise typer.BadParameter(f"--egm takes DEVICE=HOST:PORT, not '{text}'")
        try:
            result[device.lower()] = (socket.gethostbyname(host), int(port))
        except OSError as fault:
            raise typer.BadParameter(f"--egm {text}: {fault.strerror}") from fault
    return result


@contextmanager
def _guided(runner: "ControllerRunner", partners: "dict[str, tuple[str, int]]") -> "Iterator[None]":
    """Exchange datagrams of externally guided motion, also after each restart."""
    from rapidgen.servers.egm import serve_egm

    end = serve_egm(runner.controller, partners)

    def begin() -> None:
        nonlocal end
        end = serve_egm(runner.controller, partners)

    def stop() -> None:
        end()

    runner.on_restart.append(stop)
    runner.on_boot.append(begin)
    try:
        yield
    finally:
        end()


@contextmanager
def _page(
    runner: "ControllerRunner", look: "Appearance | None", host: str, port: int
) -> "Iterator[Members]":
    """Serve the page that shows the robot; yield its entry in `ready`.

    Raises DiagnosticError RG920, RG921.
    """
    if look is None:
        yield {}
        return
    from rapidgen.viewer.server import serve_page
    from rapidgen.viewer.simulator.simulation import Simulation

    page = serve_page(Simulation(runner, look), host, port, look.files)
    runner.on_boot.append(page.renew)
    try:
        yield {"view": page.url}
    finally:
        page.close()


@contextmanager
def _recording(
    runner: "ControllerRunner",
    look: "Appearance | None",
    path: Path | None,
    watches: "Iterable[str]",
) -> "Iterator[None]":
    """Record the run, into a new file after each restart. Raises OSError."""
    pairs = [(task, text) for task, _, text in (watch.partition(":") for watch in watches)]
    for task, text in pairs:
        if not text or task not in runner.controller.rapid_tasks:
            known = ", ".join(runner.controller.rapid_tasks)
            raise typer.BadParameter(f"--watch takes TASK:EXPRESSION; tasks: {known}")
    if path is None or look is None:
        if pairs:
            raise typer.BadParameter("--watch needs --record")
        yield
        return
    from rapidgen.viewer.recording.appearance import carried
    from rapidgen.viewer.recording.writer import record

    saved = carried(look)
    for fault in saved.faults[len(look.faults) :]:
        typer.echo(f"not recorded as described: {letters(fault)}", err=True)
    serial = 1
    end = record(runner.controller, path, pairs, saved)

    def reopen() -> None:
        nonlocal end, serial
        serial += 1
        end = record(runner.controller, path.with_stem(f"{path.stem}-{serial}"), pairs, saved)

    def stop() -> None:
        end()

    runner.on_restart.append(stop)
    runner.on_boot.append(reopen)
    try:
        yield
    finally:
        end()


def _start_background_tasks(controller: "VirtualController") -> None:
    """Start the background tasks only, with motors off, as after power-on."""
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


def _addresses(controller: "VirtualController", target: "Bootable", host: str) -> dict[str, str]:
    """Return HOST:MOTION,STATE[,CONTROL] of each group, for clients on this computer."""
    current = "127.0.0.1" if host == "0.0.0.0" else host
    result = {}
    for group, ports in _ports(controller, target).items():
        text = [str(ports[role]) for role in ("motion", "state", "control") if role in ports]
        result[group] = f"{current}:{','.join(text)}"
    return result


def _check_host(host: str) -> None:
    import ipaddress
    import socket

    try:
        ipaddress.IPv4Address(host)
    except ValueError as fault:
        raise typer.BadParameter(f"--host takes an IPv4 address, not '{host}'") from fault
    with socket.socket() as probe:
        try:
            probe.bind((host, 0))
        except OSError as fault:
            raise refusal(
                "RG901",
                None,
                f"--host {host} is not an address of this computer: {fault.strerror}",
                "use 127.0.0.1, or 0.0.0.0 for all addresses; `--to` of other commands takes a "
                "robot's address",
            ) from fault


def _check_release(target: "Bootable", rws: str | None) -> None:
    """Reject RWS 1.0 on RobotWare 7 and later, and 2.0 on RobotWare 6 and earlier."""
    from rapidgen.system.releases import UNKNOWN_ROBOTWARE

    major, minor = target.system.robotware
    fits = {None: True, "1": major <= 6, "2": major == 7, "8": major in (7, 8)}[rws]
    if not fits:
        if target.system.robotware == UNKNOWN_ROBOTWARE:
            raise refusal(
                "RG901",
                None,
                f"the RobotWare version of {target.name} is unknown, and --rws {rws} depends on it",
                "state it: --robotware 7.6",
            )
        requested = "1" if major <= 6 else "2 or 8"
        raise typer.BadParameter(
            f"{target.name} is for RobotWare {major}.{minor}, which serves --rws {requested}"
        )


def _denied(grants: "Iterable[str]") -> frozenset[str]:
    from rapidgen.wire.rws.grants import GRANTS

    unknown = sorted(set(grants) - set(GRANTS))
    if unknown:
        raise typer.BadParameter(
            f"unknown grant {unknown[0]} in --rws-deny; grants: {', '.join(GRANTS)}"
        )
    return frozenset(grants)


def _check_ports(target: "Bootable", host: str, offset: int) -> None:
    """Reject a port in use now, before the program fails at it."""
    import socket

    from rapidgen.cli.readiness import required_ports

    for port in required_ports(target):
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
                    f"port {port + offset} of {host} is not available: {fault.strerror}",
                    "move all ports with `--port-offset N`, or use `--ports auto`",
                    exit_code=1,
                ) from fault


def _print_notes(result: "Iterable[object]") -> None:
    import sys

    notes = [d for d in result if isinstance(d, Diagnostic)]
    if notes:
        sys.stderr.write(render(notes, colour=use_colour()))
