"""`rapidgen robots`: the shipped models, and the known variants in figures."""

from typing import Annotated

import typer


def robots(
    text: Annotated[
        list[str] | None,
        typer.Argument(help="Words that a line has to hold; or `show NAME` for one in figures."),
    ] = None,
    known: Annotated[
        bool, typer.Option("--all", help="Also the variants that `new` recognises.")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON array on stdout.")] = False,
) -> None:
    """List the shipped models. `robots show NAME` prints axes, reach and sources."""
    from rapidgen.config.catalogue import shipped_models, variant_named, variant_text
    from rapidgen.config.variant_library import variants
    from rapidgen.config.variant_model import missing_figures, model_name, names
    from rapidgen.diagnostics import refusal

    if text and text[0] == "show":
        for variant in variant_named(" ".join(text[1:])):
            typer.echo(variant_text(variant))
        return
    requested = [word.casefold() for word in text or ()]
    models = shipped_models()
    if as_json:
        import json

        typer.echo(json.dumps([model.as_json() for model in models], indent=2))
        return
    lines = []
    width = max(len(name) for name in (*(model.name for model in models), *names()))
    for model in models:
        versions = ", ".join(f"RW{g}" for g in model.generations)
        lines.append(f"{model.name:<{width}}  {model.description} ({versions})")
    if known or requested:
        for variant in (v for v in variants() if not v.model):
            missing = missing_figures(variant)
            name = "-" if missing else model_name(variant)
            lines.append(f"{name:<{width}}  ABB {variant.name}" + _shown(missing))
    displayed = [line for line in lines if all(word in line.casefold() for word in requested)]
    if not displayed:
        message = f"no robot has {' and '.join(text or ())} in its line"
        raise refusal("RG009", None, message, "`rapidgen robots --all` lists all that are known")
    for line in displayed:
        typer.echo(line)


def _shown(missing: list[str]) -> str:
    """What a variant lacks, behind its name."""
    return f" (recognised only; lacks {'; '.join(missing)})" if missing else ""
