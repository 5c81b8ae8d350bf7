"""`rapidgen rollback`: put an earlier set back on a controller."""

from typing import Annotated

import typer

from rapidgen.cli import options


def rollback(
    config: options.ConfigOrFolder,
    to: options.Controllers,
    number: Annotated[
        int | None, typer.Argument(help="Backup to restore; default the newest.", metavar="[ID]")
    ] = None,
    list_backups: Annotated[
        bool, typer.Option("--list", help="Change nothing; list the backups.")
    ] = False,
    overwrite: options.Overwrite = False,
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
    """Go back to the set before the last deployment, or to backup ID. Undoes a run that was cut.

    Files are written anew, so their time stamps are fresh: a controller may re-read only newer
    ones.

    rapidgen rollback cell1.yaml --to "ftp://192.168.125.1/hd0a/SYSTEM/HOME" --list
    """
    import json

    from rapidgen.cli.driver_query import hello
    from rapidgen.cli.plan_execution import confirm_plan, execute, show_plans
    from rapidgen.cli.rws_session import agree
    from rapidgen.deploy.command_run import (
        FleetJob,
        config_name,
        earlier_set,
        history,
        plan_all,
        refuse_conflicts,
    )
    from rapidgen.deploy.fleet import parse_targets
    from rapidgen.deploy.target import Access

    name = config_name(config)
    targets = parse_targets(to)
    access = Access(
        user, secrets, identity, known_hosts, ask=True, fingerprint=fingerprint, agree=agree()
    )
    if list_backups:
        rows = []
        for target in targets:
            saved = history(target, access, name)
            if not saved:
                typer.echo(f"{target.shown}  no backup of {name}", err=True)
            for past in saved:
                result = {"id": past.id, "time": past.time, "build_id": past.build_id}
                rows.append({"target": target.shown, **result})
        if as_json:
            typer.echo(json.dumps(rows))
        for row in () if as_json else rows:
            typer.echo("{target}  {id}  {time}  build {build_id}".format(**row))
        return 0
    job = FleetJob(
        "rollback",
        targets,
        access,
        lambda transport: earlier_set(transport, name, number),
        overwrite,
        parallel,
        backup,
        restart=restart,
        wait=wait,
        hello=hello,
    )
    plans = plan_all(job)
    show_plans(plans)
    refuse_conflicts(job, plans)
    confirm_plan(f"Roll back {len(plans)} controller(s)?", yes=yes)
    return execute(job, plans, as_json=as_json)
