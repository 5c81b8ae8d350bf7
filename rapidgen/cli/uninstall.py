"""`rapidgen uninstall`: take a driver off a controller."""

from pathlib import Path
from typing import Annotated

import typer

from rapidgen.cli import options


def uninstall(
    config: options.ConfigOrFolder,
    to: options.Controllers,
    overwrite: Annotated[
        bool,
        typer.Option("--overwrite", help="Take hand edits away too; copies go to .rapidgen/."),
    ] = False,
    restart: options.Restart = False,
    wait: options.WaitForPeople = 0.0,
    yes: options.Yes = False,
    as_json: options.AsJson = False,
    user: options.User = "",
    secrets: options.Secrets = None,
    identity: options.Identity = "",
    known_hosts: options.KnownHosts = "",
    fingerprint: options.Fingerprint = "",
    parallel: options.Parallel = 8,
    backup: options.LoadedCfg = None,
) -> int:
    """Go back to the state before the first deployment.

    Our files go, strangers' come back. cfg instances that were loaded at the pendant are listed:
    they are deleted there.

    rapidgen uninstall cell1.yaml --to "sftp://admin@192.168.125.1/HOME"
    """
    from rapidgen.cli.driver_query import hello
    from rapidgen.cli.plan_execution import confirm_plan, execute, show_plans
    from rapidgen.cli.rws_session import agree
    from rapidgen.deploy.command_run import (
        FleetJob,
        check_names,
        config_name,
        plan_all,
        refuse_conflicts,
        save_edits,
    )
    from rapidgen.deploy.fleet import parse_targets
    from rapidgen.deploy.target import Access

    name = config_name(config)
    access = Access(
        user, secrets, identity, known_hosts, ask=True, fingerprint=fingerprint, agree=agree()
    )
    targets = parse_targets(to)
    job = FleetJob(
        "uninstall",
        targets,
        access,
        lambda _: None,
        overwrite,
        parallel,
        backup,
        restart=restart,
        wait=wait,
        hello=hello,
    )
    plans = plan_all(job)
    check_names(plans, name)
    show_plans(plans)
    refuse_conflicts(job, plans)
    confirm_plan(f"Uninstall from {len(plans)} controller(s)?", yes=yes)
    for path in save_edits(plans, Path(".rapidgen") / "edited"):
        typer.echo(f"kept a copy of a hand edit: {path}", err=True)
    return execute(job, plans, as_json=as_json)
