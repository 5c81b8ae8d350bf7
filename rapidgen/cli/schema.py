"""`rapidgen schema`: the JSON schema of the configuration, for editors."""

import typer


def schema() -> None:
    """Print the JSON schema of the configuration file."""
    import json

    from rapidgen.config.reference import json_schema

    typer.echo(json.dumps(json_schema(), indent=2, ensure_ascii=False))
