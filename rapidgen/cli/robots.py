"""`rapidgen robots`: the shipped models."""

from typing import Annotated

import typer


def robots(
    as_json: Annotated[bool, typer.Option("--json", help="One JSON array on stdout.")] = False,
) -> None:
    """List the shipped models."""
    from rapidgen.config.catalogue import shipped_models

    models = shipped_models()
    if as_json:
        import json

        typer.echo(json.dumps([model.as_json() for model in models], indent=2))
        return
    width = max(len(model.name) for model in models)
    for model in models:
        versions = ", ".join(f"RW{g}" for g in model.generations)
        typer.echo(f"{model.name:<{width}}  {model.description} ({versions})")
