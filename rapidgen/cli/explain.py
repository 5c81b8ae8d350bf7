"""`rapidgen explain`: the page of a diagnostic's code, or what an event number means."""

from typing import Annotated

import typer

from rapidgen.diagnostics import refusal, suggest


def explain(
    code: Annotated[
        str,
        typer.Argument(
            help="A code such as RG012, or an event number of a controller such as 50024; "
            "`all` and `events` list them."
        ),
    ],
) -> None:
    """Explain a diagnostic's code or a controller's event number."""
    if code == "events" or code.isdecimal():
        _event(code)
        return
    from rapidgen.diagnostics.pages import codes, page, title

    if code == "all":
        for known in codes():
            typer.echo(f"{known}  {title(known)}")
        return
    requested = code.upper()
    if requested not in codes():
        raise refusal(
            "RG902",
            None,
            f"no diagnostic has the code '{code}'",
            suggest(requested, codes()) or "`rapidgen explain all` lists them",
        )
    typer.echo(page(requested), nl=False)


def _event(code: str) -> None:
    from rapidgen.cli.event_texts import explained, listed
    from rapidgen.machine.event_table import KINDS

    if code == "events":
        for line in listed():
            typer.echo(line)
        return
    kind = KINDS.get(int(code)) if len(code) < 9 else None
    if kind is None:
        raise refusal(
            "RG902",
            None,
            f"event {code} is not known",
            "`rapidgen explain events` lists the known ones",
        )
    typer.echo(explained(kind), nl=False)
