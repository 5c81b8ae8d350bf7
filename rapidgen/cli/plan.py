"""`rapidgen plan`: what a deployment would do to a controller. Changes nothing."""

from pathlib import Path
from typing import Annotated

import typer

from rapidgen.cli import options


def plan(
    config: options.ConfigOrFolder,
    to: options.Controllers,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="Write the plan for `deploy --plan`.", metavar="FILE"),
    ] = None,
    detailed_exitcode: Annotated[
        bool, typer.Option("--detailed-exitcode", help="0 nothing to do, 1 error, 2 changes.")
    ] = False,
    diff: Annotated[bool, typer.Option("--diff", help="Show the files' lines, too.")] = False,
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
    """Show what `deploy` would do: files, cfg instances, restarts.

    What is left to people, and what cannot be seen over the transport, is a line of it.
    The password comes from --secrets, RAPIDGEN_PASSWORD or a prompt.

    rapidgen plan cell1.yaml --to "ftp://192.168.125.1/hd0a/SYSTEM/HOME" --output plan.json
    """
    import json

    from rapidgen.cli.run_outputs import refuse_unwritable
    from rapidgen.cli.rws_session import agree
    from rapidgen.deploy.command_run import FleetJob, desired_set, plan_all, write_plans
    from rapidgen.deploy.fleet import parse_targets
    from rapidgen.deploy.plan import plan_json
    from rapidgen.deploy.plan_text import plans_text
    from rapidgen.deploy.target import Access

    if output is not None:
        refuse_unwritable([output])
    requested = desired_set(config, overrides or ())
    access = Access(
        user, secrets, identity, known_hosts, ask=True, fingerprint=fingerprint, agree=agree()
    )
    job = FleetJob(
        "deploy",
        parse_targets(to),
        access,
        lambda _: requested,
        parallel=parallel,
        backup=backup,
    )
    plans = plan_all(job)
    if output is not None:
        write_plans(output, plans)
    if as_json:
        typer.echo(json.dumps([plan_json(made) for made in plans], indent=2))
    else:
        typer.echo(plans_text(plans, diff=diff), nl=False)
    changed = any(not made.is_empty for made in plans)
    return 2 if changed and detailed_exitcode else 0
