"""The command `load`: one module into a task of a controller."""

import json
from dataclasses import asdict
from datetime import datetime
from pathlib import Path
from typing import Annotated

import typer

from rapidgen.cli import options

_LARGEST = 8_388_608
"""Bytes of a module."""
BEFORE = Path(".rapidgen") / "before"
"""Folder for replaced modules."""


def load(
    module: Annotated[Path, typer.Argument(help="Module to load.", metavar="NAME.mod")],
    to: Annotated[
        str,
        typer.Option(
            help="Controller: HOST[:PORT], rws://HOST or rwss://HOST; sim: the simulator here.",
            metavar="TARGET",
        ),
    ],
    task: Annotated[
        str,
        typer.Option(help="Task; default: the only one that has the module.", metavar="NAME"),
    ] = "",
    plan_only: Annotated[bool, typer.Option("--plan", help="Only show what would change.")] = False,
    expect: Annotated[
        str,
        typer.Option(help="`id` of the plan to apply; any difference is an error.", metavar="ID"),
    ] = "",
    yes: options.Yes = False,
    user: options.User = "",
    secrets: options.Secrets = None,
    fingerprint: options.Fingerprint = "",
    as_json: options.AsJson = False,
) -> int:
    """Load a module into a task of a controller.

    Shows the changed lines, asks for confirmation, saves the replaced module in .rapidgen/before,
    loads the new one and verifies it. Does not start or stop a task; if the module has build
    errors, the earlier one is loaded again.

    rapidgen load part.mod --to 192.168.125.1 --task T_ROB1
    """
    from rapidgen._atomic_write import write_whole
    from rapidgen._reading import read_foreign
    from rapidgen.cli.deployment import confirm_plan
    from rapidgen.cli.rws_session import ask_pendant, controller
    from rapidgen.deploy.online.module_upload import make_upload_plan, upload_module
    from rapidgen.diagnostics import refusal

    data = read_foreign(module, _LARGEST)
    saved = BEFORE / f"{module.stem}-{datetime.now():%Y%m%d-%H%M%S}.mod"

    def keep(replaced: bytes) -> None:
        BEFORE.mkdir(parents=True, exist_ok=True)
        write_whole(saved, replaced)
        typer.echo(f"saved the replaced module: {saved}", err=True)

    with controller(to, user, secrets, fingerprint) as services:
        plan = make_upload_plan(services, data, str(module), task=task)
        shown = {**asdict(plan), "text": plan.text()}
        if as_json and plan_only:
            typer.echo(json.dumps(shown, indent=2))
        else:
            typer.echo(plan.text(), nl=False, err=as_json or not plan_only)
        if plan_only or plan.action == "keep":
            return 0
        if expect and expect != plan.id:
            message = f"{plan.module} or its controller has changed since the plan"
            raise refusal("RG341", None, message, "make the plan again and read it", exit_code=1)
        if plan.obstacles:
            raise refusal("RG340", None, plan.obstacles[0], exit_code=1)
        confirm_plan(f"Load {plan.module} into {plan.task} at {to}?", yes=yes)
        ask_pendant(services, "modify", plan.mode)
        upload_module(
            services,
            plan,
            data,
            str(module),
            keep=keep,
            say=lambda line: typer.echo(line, err=True),
        )
    if as_json:
        typer.echo(json.dumps(shown, indent=2))
    return 0
