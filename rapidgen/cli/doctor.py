"""`rapidgen doctor`: what stands between a configuration and its controller."""

from typing import Annotated

import typer

from rapidgen.cli import options


def doctor(
    config: options.ConfigOrFolder,
    to: Annotated[
        str,
        typer.Option(
            help="Controller: dir://, ftp://, sftp://, rws:// or rwss:// [USER@]HOST...",
            metavar="URL",
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
    fingerprint: options.Fingerprint = "",
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

    from rapidgen.cli.driver_query import error_reason, hello
    from rapidgen.cli.rws_session import agree
    from rapidgen.deploy.command_run import desired_set
    from rapidgen.deploy.doctor import run_checks
    from rapidgen.deploy.target import Access, parse_target

    checks = run_checks(
        parse_target(to),
        Access(
            user, secrets, identity, known_hosts, ask=True, fingerprint=fingerprint, agree=agree()
        ),
        desired_set(config, overrides or ()),
        hello=hello,
        text=error_reason,
        robot_host=host,
        backup=backup,
    )
    if as_json:
        typer.echo(json.dumps([asdict(check) for check in checks], indent=2))
    else:
        width = max(len(check.area) for check in checks)
        for check in checks:
            typer.echo(f"{check.verdict:<7}  {check.area:<{width}}  {check.found}")
            if check.help and check.verdict != "ok":
                typer.echo(f"{'':<7}  {'':<{width}}  -> {check.help}")
    return 1 if any(check.verdict == "fail" for check in checks) else 0
