"""`rapidgen schema`: the JSON schema of the configuration or of a cell, for editors."""

from typing import Annotated

import typer


def schema(
    cell: Annotated[
        bool, typer.Option("--cell", help="Of the description of a cell (`run --cell FILE`).")
    ] = False,
) -> None:
    """Print the JSON schema of the configuration file."""
    import json

    from rapidgen.config.schema_reference import cell_schema, json_schema

    made = cell_schema() if cell else json_schema()
    typer.echo(json.dumps(made, indent=2, ensure_ascii=False))
