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
    yes: options.Yes = False,
    user: options.User = "",
    secrets: options.Secrets = None,
    identity: options.Identity = "",
    known_hosts: options.KnownHosts = "",
    parallel: options.Parallel = 8,
) -> int:
    """Go back to the set before the last deployment, or to backup ID. Undoes a run that was cut.

    Files are written anew, so their time stamps are fresh: a controller may re-read only newer
    ones.

    rapidgen rollback cell1.yaml --to "ftp://192.168.125.1/hd0a/SYSTEM/HOME" --list
    """
    from rapidgen.deploy.fleet import parse_targets
    from rapidgen.deploy.session import (
        Job,
        apply_all,
        config_name,
        confirm,
        earlier_set,
        history,
        plan_all,
        refuse_conflicts,
    )
    from rapidgen.deploy.show import plan_text, table
    from rapidgen.deploy.target import Access
    from rapidgen.diagnostics import DiagnosticError

    name = config_name(config)
    targets = parse_targets(to)
    access = Access(user, secrets, identity, known_hosts, ask=True)
    if list_backups:
        for target in targets:
            for past in history(target, access, name):
                typer.echo(f"{target.shown}  {past.id}  {past.time}  build {past.build_id}")
        return 0
    job = Job(
        "rollback",
        targets,
        access,
        lambda transport: earlier_set(transport, name, number),
        overwrite,
        parallel,
    )
    plans = plan_all(job)
    for made in plans:
        typer.echo(plan_text(made), err=True, nl=False)
    refuse_conflicts(job, plans)
    confirm(
        f"Roll back {len(plans)} controller(s)?",
        yes=yes,
        ask=lambda text: typer.confirm(text, err=True),
    )
    outcomes = apply_all(job, plans, lambda line: typer.echo(line, err=True))
    typer.echo(table(outcomes), nl=False)
    failures = [o.error for o in outcomes if o.error is not None]
    if failures:
        raise DiagnosticError([d for f in failures for d in f.diagnostics], exit_code=1)
    return 0
