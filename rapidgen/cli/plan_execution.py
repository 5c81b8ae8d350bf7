"""What `deploy`, `rollback` and `uninstall` do alike: show plans, ask, work, tell what became."""

import json
from collections.abc import Sequence
from typing import TYPE_CHECKING

import typer

from rapidgen.diagnostics import DiagnosticError

if TYPE_CHECKING:
    from rapidgen.deploy import Plan
    from rapidgen.deploy.command_run import FleetJob


def show_plans(plans: "Sequence[Plan]") -> None:
    """All plans, on stderr."""
    from rapidgen.deploy.plan_text import plans_text

    typer.echo(plans_text(plans), err=True, nl=False)


def confirm_plan(question: str, *, yes: bool) -> None:
    """Ask before anything is changed. Raises DiagnosticError RG533."""
    from rapidgen.deploy.command_run import confirm

    confirm(question, yes=yes, ask=lambda text: typer.confirm(text, err=True))


def execute(job: "FleetJob", plans: "Sequence[Plan]", *, as_json: bool = False) -> int:
    """Do what was planned; a table of the controllers, or JSON with their errors; the exit code.

    Raises DiagnosticError where one failed and that was not told in JSON, KeyboardInterrupt behind
    the table when somebody has given up."""
    from dataclasses import replace

    from rapidgen.cli.termination import on_signal
    from rapidgen.deploy.command_run import apply_all
    from rapidgen.deploy.fleet import Interruption
    from rapidgen.deploy.plan_text import outcomes_json, table

    def say(line: str) -> None:
        typer.echo(line, err=True)

    giving_up = Interruption(say)
    with on_signal(giving_up.begin):
        outcomes = apply_all(replace(job, giving_up=giving_up), plans, say)
    if as_json:
        typer.echo(json.dumps(outcomes_json(outcomes), indent=2))
    else:
        typer.echo(table(outcomes), nl=False)
    if giving_up:
        if as_json:
            # What became of each has been told: a second object would be none.
            return 130
        raise KeyboardInterrupt
    failures = [o.error for o in outcomes if o.error is not None]
    if failures and as_json:
        return 1
    if failures:
        raise DiagnosticError([d for f in failures for d in f.diagnostics], exit_code=1)
    return 0
