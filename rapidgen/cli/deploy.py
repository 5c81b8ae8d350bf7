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
    yes: options.Yes = False,
    overrides: options.Overrides = None,
    user: options.User = "",
    secrets: options.Secrets = None,
    identity: options.Identity = "",
    known_hosts: options.KnownHosts = "",
    parallel: options.Parallel = 8,
) -> int:
    """Put the driver on one or several controllers: backup, upload, verify, switch.

    Starts no motors, changes no mode, restarts nothing: the plan says what people do then.
    A run that was cut is finished or undone by the next.

    rapidgen deploy cell1.yaml --to "ftp://192.168.125.1/hd0a/SYSTEM/HOME"
    """
    from rapidgen.deploy.fleet import parse_targets
    from rapidgen.deploy.session import (
        Job,
        apply_all,
        check_plans,
        confirm,
        plan_all,
        refuse_conflicts,
        wanted_set,
    )
    from rapidgen.deploy.show import plan_text, table
    from rapidgen.deploy.target import Access
    from rapidgen.diagnostics import DiagnosticError

    wanted = wanted_set(config, overrides or ())
    access = Access(user, secrets, identity, known_hosts, ask=True)
    job = Job("deploy", parse_targets(to), access, lambda _: wanted, overwrite, parallel)
    plans = plan_all(job)
    for made in plans:
        typer.echo(plan_text(made), err=True, nl=False)
    if plan is not None:
        check_plans(plan, plans)
    refuse_conflicts(job, plans)
    if all(made.is_empty for made in plans):
        return 0
    confirm(
        f"Change {sum(not p.is_empty for p in plans)} controller(s)?",
        yes=yes,
        ask=lambda text: typer.confirm(text, err=True),
    )
    outcomes = apply_all(job, plans, lambda line: typer.echo(line, err=True))
    typer.echo(table(outcomes), nl=False)
    failures = [o.error for o in outcomes if o.error is not None]
    if failures:
        raise DiagnosticError([d for f in failures for d in f.diagnostics], exit_code=1)
    return 0
