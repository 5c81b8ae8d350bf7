"""`rapidgen explain`: the page of a diagnostic's code."""

from typing import Annotated

import typer

from rapidgen.diagnostics import refusal, suggest


def explain(
    code: Annotated[str, typer.Argument(help="A code such as RG012; `all` lists them.")],
) -> None:
    """Explain what a diagnostic's code means, with a bad and a good example."""
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
