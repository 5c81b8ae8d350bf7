"""`rapidgen deploy`: bring a driver onto a controller, exactly as planned."""

from pathlib import Path
from typing import Annotated

import typer

from rapidgen.cli import options


def deploy(
    config: options.ConfigOrFolder,
    to: options.Controllers,
    plan: Annotated[
        Path | None, typer.Option(help="Do exactly this plan, or refuse.", metavar="FILE")
    ] = None,
    overwrite: options.Overwrite = False,
    restart: options.Restart = False,
    wait: options.WaitForPeople = 0.0,
    yes: options.Yes = False,
    as_json: options.AsJson = False,
    overrides: options.Overrides = None,
    user: options.User = "",
    secrets: options.Secrets = None,
    identity: options.Identity = "",
    known_hosts: options.KnownHosts = "",
    fingerprint: options.Fingerprint = "",
    parallel: options.Parallel = 8,
    backup: options.LoadedCfg = None,
) -> int:
    """Put the driver on one or several controllers: backup, upload, verify, switch.

    Starts no motors and changes no mode; the plan says what people do then. Over web services
    (rws://) cfg is loaded, too, and with --restart the controller restarted and read back.
    A run that was cut is finished or undone by the next.

    rapidgen deploy cell1.yaml --to "ftp://192.168.125.1/hd0a/SYSTEM/HOME"
    """
    from rapidgen.cli.driver_query import hello
    from rapidgen.cli.plan_execution import confirm_plan, execute, show_plans
    from rapidgen.cli.rws_session import agree
    from rapidgen.deploy.command_run import (
        FleetJob,
        check_plans,
        desired_set,
        plan_all,
        refuse_conflicts,
        save_neighbours,
    )
    from rapidgen.deploy.fleet import parse_targets
    from rapidgen.deploy.target import Access

    desired = desired_set(config, overrides or ())
    access = Access(
        user, secrets, identity, known_hosts, ask=True, fingerprint=fingerprint, agree=agree()
    )
    targets = parse_targets(to)
    job = FleetJob(
        "deploy",
        targets,
        access,
        lambda _: desired,
        overwrite,
        parallel,
        backup,
        restart=restart,
        wait=wait,
        hello=hello,
    )
    plans = plan_all(job)
    show_plans(plans)
    if plan is not None:
        check_plans(plan, plans)
    for path in save_neighbours(plans, Path(".rapidgen") / "before"):
        typer.echo(f"kept a copy of what loads the other driver: {path}", err=True)
    refuse_conflicts(job, plans)
    if all(made.is_empty for made in plans):
        return execute(job, plans, as_json=True) if as_json else 0
    confirm_plan(f"Change {sum(not p.is_empty for p in plans)} controller(s)?", yes=yes)
    return execute(job, plans, as_json=as_json)
