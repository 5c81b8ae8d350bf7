"""The models, found by name: `robots/*.yaml`, and the known variants that are known enough."""

from pathlib import Path

from rapidgen._data import data_folder
from rapidgen.diagnostics import Span, refusal, suggest


def shipped_names() -> tuple[str, ...]:
    """Names of all shipped models, sorted."""
    return tuple(sorted(path.stem for path in data_folder("robots").glob("*.yaml")))


def find_shipped(name: str, span: Span | None = None) -> Path:
    """File of a model; an unknown name raises DiagnosticError (RG009)."""
    known = shipped_names()
    if name in known:
        return data_folder("robots") / f"{name}.yaml"
    # What is known of other variants takes a while to read.
    from rapidgen.config import variant_model

    variant = variant_model.named(name)
    if variant:
        missing = variant_model.lacks(variant)
        if not missing:
            return variant_model.PATH
        raise refusal(
            "RG009",
            span,
            f"{variant.name} is known, but not well enough to be a model; it lacks: "
            + "; ".join(missing),
            "`rapidgen new --urdf` with a description of it takes what is known and leaves the "
            "rest open",
        )
    meant = suggest(name, (*known, *variant_model.names()))
    raise refusal(
        "RG009",
        span,
        f"no shipped model is called '{name}'",
        (f"{meant}; " if meant else "") + "`rapidgen robots` lists them; "
        "for a file of your own write its path with the suffix .yaml",
    )


def is_path(text: str) -> bool:
    """True for what names a file: it has a suffix or a separator; else it is a shipped name."""
    return "/" in text or "\\" in text or "." in text
