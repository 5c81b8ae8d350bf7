"""The commands `plan`, `deploy`, `rollback`, `uninstall` and `doctor`."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from rapidgen.cli import options
from rapidgen.diagnostics import DiagnosticError

if TYPE_CHECKING:
    from rapidgen.deploy import Plan
    from rapidgen.deploy.command_run import FleetJob
    from rapidgen.deploy.doctor import Check


def plan(
    config: options.ConfigOrFolder,
    to: options.Controllers,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", "-o", help="File to write the plan to, for `deploy --plan`.", metavar="FILE"
        ),
    ] = None,
    detailed_exitcode: Annotated[
        bool,
        typer.Option("--detailed-exitcode", help="Exit code 0: no changes, 1: error, 2: changes."),
    ] = False,
    diff: Annotated[
        bool, typer.Option("--diff", help="Also show the changed lines of the files.")
    ] = False,
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
    """Show what `deploy` would change on a controller.

    The plan lists files, cfg instances, restarts, manual steps, and everything that cannot be
    seen over the transport. The password comes from --secrets, RAPIDGEN_PASSWORD or a prompt.

    rapidgen plan cell1.yaml --to "ftp://192.168.125.1/hd0a/SYSTEM/HOME" --output plan.json
    """
    import json

    from rapidgen.cli.run_outputs import check_files_writable
    from rapidgen.cli.rws_session import certificate_prompt
    from rapidgen.deploy.command_run import FleetJob, desired_set, plan_all, write_plans
    from rapidgen.deploy.fleet import parse_targets
    from rapidgen.deploy.plan import plan_json
    from rapidgen.deploy.plan_text import plans_text
    from rapidgen.deploy.target import Access

    if output is not None:
        check_files_writable([output])
    requested = desired_set(config, overrides or ())
    access = Access(
        user,
        secrets,
        identity,
        known_hosts,
        ask=True,
        fingerprint=fingerprint,
        agree=certificate_prompt(),
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


def deploy(
    config: options.ConfigOrFolder,
    to: options.Controllers,
    plan: Annotated[
        Path | None,
        typer.Option(help="Plan to execute; any difference is an error.", metavar="FILE"),
    ] = None,
    overwrite: options.Overwrite = False,
    restart: options.Restart = False,
    wait: options.OperatorWait = 0.0,
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
    """Install the driver on one or several controllers.

    Makes a backup, uploads, verifies and switches the files. Does not start motors or change the
    mode; the plan lists the manual steps. Over Robot Web Services (rws://) it also loads cfg and,
    with --restart, restarts the controller and verifies the result. The next run completes or
    undoes an interrupted one.

    rapidgen deploy cell1.yaml --to "ftp://192.168.125.1/hd0a/SYSTEM/HOME"
    """
    from rapidgen.cli.driver_query import hello
    from rapidgen.cli.rws_session import certificate_prompt
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
        user,
        secrets,
        identity,
        known_hosts,
        ask=True,
        fingerprint=fingerprint,
        agree=certificate_prompt(),
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
        typer.echo(f"saved a copy of the cfg that loads the other driver: {path}", err=True)
    refuse_conflicts(job, plans)
    if all(made.is_empty for made in plans):
        return execute(job, plans, as_json=True) if as_json else 0
    confirm_plan(f"Change {sum(not p.is_empty for p in plans)} controller(s)?", yes=yes)
    return execute(job, plans, as_json=as_json)


def rollback(
    config: options.ConfigOrFolder,
    to: options.Controllers,
    number: Annotated[
        int | None,
        typer.Argument(help="Number of the backup; default: the newest.", metavar="ID"),
    ] = None,
    list_backups: Annotated[bool, typer.Option("--list", help="Only list the backups.")] = False,
    overwrite: options.Overwrite = False,
    restart: options.Restart = False,
    wait: options.OperatorWait = 0.0,
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
    """Restore the driver files of an earlier deployment.

    Also undoes an interrupted run. The files get new time stamps, because a controller may only
    reload newer files.

    rapidgen rollback cell1.yaml --to "ftp://192.168.125.1/hd0a/SYSTEM/HOME" --list
    """
    import json

    from rapidgen.cli.driver_query import hello
    from rapidgen.cli.rws_session import certificate_prompt
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
        user,
        secrets,
        identity,
        known_hosts,
        ask=True,
        fingerprint=fingerprint,
        agree=certificate_prompt(),
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


def uninstall(
    config: options.ConfigOrFolder,
    to: options.Controllers,
    overwrite: Annotated[
        bool,
        typer.Option(
            "--overwrite", help="Also remove files edited by hand; copies go to .rapidgen/."
        ),
    ] = False,
    restart: options.Restart = False,
    wait: options.OperatorWait = 0.0,
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
    """Remove the driver and restore the original files.

    Restores the state before the first deployment. cfg instances that were loaded at the pendant
    have to be deleted there; they are listed.

    rapidgen uninstall cell1.yaml --to "sftp://admin@192.168.125.1/HOME"
    """
    from rapidgen.cli.driver_query import hello
    from rapidgen.cli.rws_session import certificate_prompt
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
        user,
        secrets,
        identity,
        known_hosts,
        ask=True,
        fingerprint=fingerprint,
        agree=certificate_prompt(),
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
        typer.echo(f"saved a copy of an edited file: {path}", err=True)
    return execute(job, plans, as_json=as_json)


def doctor(
    config: Annotated[
        str,
        typer.Argument(
            help="Configuration, shipped name or generated folder; or HOST[:M,S,C] or `sim` alone.",
            metavar="CONFIG|HOST",
        ),
    ],
    to: Annotated[
        str,
        typer.Option(
            help="Controller: HOST, `sim`, or dir://, ftp://, sftp://, rws://, rwss:// URL.",
            metavar="HOST|sim|URL",
        ),
    ] = "",
    host: Annotated[
        str,
        typer.Option(
            help="Host of the driver's ports; default: the host of the URL.", metavar="HOST"
        ),
    ] = "",
    overrides: options.Overrides = None,
    user: options.User = "",
    secrets: options.Secrets = None,
    identity: options.Identity = "",
    known_hosts: options.KnownHosts = "",
    fingerprint: options.Fingerprint = "",
    backup: options.LoadedCfg = None,
    as_json: Annotated[bool, typer.Option("--json", help="JSON array on stdout.")] = False,
) -> int:
    """Check a controller: connection, ports, RobotWare, tasks.

    Each check is ok, warn, fail or unknown, with a fix. The exit code is 1 if one fails. Reads
    only. A host without a scheme is asked over its state port; with a URL the files are compared,
    and the default password is tried once.

    rapidgen doctor 192.168.125.1

    rapidgen doctor cell1.yaml --to "ftp://192.168.125.1/hd0a/SYSTEM/HOME"
    """
    import json
    from dataclasses import asdict

    from rapidgen.cli.driver_query import error_reason, hello
    from rapidgen.cli.rws_session import certificate_prompt
    from rapidgen.deploy.command_run import desired_set
    from rapidgen.deploy.doctor import run_checks
    from rapidgen.deploy.target import Access, parse_target

    if "://" in to:
        checks = run_checks(
            parse_target(to),
            Access(
                user,
                secrets,
                identity,
                known_hosts,
                ask=True,
                fingerprint=fingerprint,
                agree=certificate_prompt(),
            ),
            desired_set(config, overrides or ()),
            hello=hello,
            text=error_reason,
            robot_host=host,
            backup=backup,
        )
    else:
        checks = _checked_host(config, to)
    if as_json:
        typer.echo(json.dumps([asdict(check) for check in checks], indent=2))
    else:
        width = max(len(check.area) for check in checks)
        for check in checks:
            typer.echo(f"{check.verdict:<7}  {check.area:<{width}}  {check.found}")
            if check.help and check.verdict != "ok":
                typer.echo(f"{'':<7}  {'':<{width}}  -> {check.help}")
    return 1 if any(check.verdict == "fail" for check in checks) else 0


def _checked_host(config: str, to: str) -> "tuple[Check, ...]":
    """Check a host over the state port of each motion group. Raises DiagnosticError."""
    from rapidgen.client import Robot
    from rapidgen.client.connect_target import configuration_of, groups_of
    from rapidgen.deploy.command_run import desired_set
    from rapidgen.deploy.host_checks import host_checks

    if (Path(config) / "manifest.json").is_file():
        raise typer.BadParameter("a generated folder is compared with a URL", param_hint="--to")
    known = configuration_of(config)
    if known is not None and not to:
        raise typer.BadParameter("which controller? HOST, `sim` or a URL", param_hint="--to")
    build_id = desired_set(config).build_id if known is not None else ""
    checks: list[Check] = []
    for group in groups_of(config):
        robot = Robot(config, address=to or None, group=group, watch=True)
        checks += host_checks(robot, build_id)
    return tuple(dict.fromkeys(checks))


def show_plans(plans: "Sequence[Plan]") -> None:
    """Print all plans on stderr."""
    from rapidgen.deploy.plan_text import plans_text

    typer.echo(plans_text(plans), err=True, nl=False)


def confirm_plan(question: str, *, yes: bool) -> None:
    """Ask for confirmation before a change. Raises DiagnosticError RG533."""
    from rapidgen.deploy.command_run import confirm

    confirm(question, yes=yes, ask=lambda text: typer.confirm(text, err=True))


def execute(job: "FleetJob", plans: "Sequence[Plan]", *, as_json: bool = False) -> int:
    """Execute the plans, print a table or JSON of the controllers, and return the exit code.

    Raises DiagnosticError if a controller failed and the output is not JSON, KeyboardInterrupt
    after the table if the user interrupted the run.
    """
    from dataclasses import replace

    from rapidgen.cli.terminal import on_signal
    from rapidgen.deploy.command_run import apply_all
    from rapidgen.deploy.fleet import Interruption
    from rapidgen.deploy.plan_text import outcomes_json, table

    def say(line: str) -> None:
        typer.echo(line, err=True)

    interruption = Interruption(say)
    with on_signal(interruption.begin):
        outcomes = apply_all(replace(job, giving_up=interruption), plans, say)
    if as_json:
        typer.echo(json.dumps(outcomes_json(outcomes), indent=2))
    else:
        typer.echo(table(outcomes), nl=False)
    if interruption:
        if as_json:
            # The results are printed already: a second object would make invalid JSON.
            return 130
        raise KeyboardInterrupt
    failures = [o.error for o in outcomes if o.error is not None]
    if failures and as_json:
        return 1
    if failures:
        raise DiagnosticError([d for f in failures for d in f.diagnostics], exit_code=1)
    return 0
