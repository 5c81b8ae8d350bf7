"""`rapidgen doctor`: what stands between a configuration and its controller."""

from typing import Annotated

import typer

from rapidgen.cli import options


def doctor(
    config: options.ConfigOrFolder,
    to: Annotated[
        str,
        typer.Option(
            help="Controller: dir://, ftp:// or sftp:// [USER@]HOST/HOME-FOLDER.", metavar="URL"
        ),
    ],
    host: Annotated[
        str, typer.Option(help="Where the robot's ports are; default the host of the URL.")
    ] = "",
    overrides: options.Overrides = None,
    user: options.User = "",
    secrets: options.Secrets = None,
    identity: options.Identity = "",
    known_hosts: options.KnownHosts = "",
    backup: options.LoadedCfg = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON array.")] = False,
) -> int:
    """Look at a controller: reach, ports, names, RobotWare, disk, what runs.

    Each line is ok, warn, fail or unknown, with the mend. Exits 1 if one fails. Changes nothing;
    tries once whether the delivered password is still accepted.

    rapidgen doctor cell1.yaml --to "ftp://192.168.125.1/hd0a/SYSTEM/HOME"
    """
    import json
    from dataclasses import asdict

    from rapidgen.deploy.doctor import examine
    from rapidgen.deploy.session import wanted_set
    from rapidgen.deploy.target import Access, parse_target

    checks = examine(
        parse_target(to),
        Access(user, secrets, identity, known_hosts, ask=True),
        wanted_set(config, overrides or ()),
        hello=_hello,
        robot_host=host,
        backup=backup,
    )
    if as_json:
        typer.echo(json.dumps([asdict(check) for check in checks], indent=2))
    else:
        width = max(len(check.area) for check in checks)
        for check in checks:
            typer.echo(f"{check.verdict:<7}  {check.area:<{width}}  {check.found}")
            if check.mend and check.verdict != "ok":
                typer.echo(f"{'':<7}  {'':<{width}}  -> {check.mend}")
    return 1 if any(check.verdict == "fail" for check in checks) else 0


def _hello(host: str, port: int, timeout: float = 3.0) -> str | None:
    """BUILD_ID that a driver tells on its state port; None for another program. OSError: nobody."""
    import socket
    import time

    from rapidgen import __version__
    from rapidgen.wire.simple_message.codec import decode, encode
    from rapidgen.wire.simple_message.frames import FrameSplitter, WireError
    from rapidgen.wire.simple_message.messages import HelloReply, HelloRequest
    from rapidgen.wire.simple_message.spec import PROTOCOL_VERSION, Comm

    major, minor, patch = (int(part) for part in __version__.split(".")[:3])
    end = time.monotonic() + timeout
    with socket.create_connection((host, port), timeout) as connection:
        connection.sendall(
            encode(HelloRequest(PROTOCOL_VERSION, (major, minor, patch), 0), Comm.REQUEST)
        )
        splitter = FrameSplitter()
        try:
            while (left := end - time.monotonic()) > 0:
                connection.settimeout(left)
                block = connection.recv(4096)
                if not block:
                    return None
                splitter.feed(block)
                while (frame := splitter.next()) is not None:
                    content = decode(frame)
                    if isinstance(content, HelloReply):
                        return content.build_id
        except (WireError, TimeoutError):
            return None
    return None
