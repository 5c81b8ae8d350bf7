"""The shipped models: `robots/*.yaml`, found by name."""

from pathlib import Path

from rapidgen._data import data_folder
from rapidgen.diagnostics import Span, refusal, suggest


def shipped_names() -> tuple[str, ...]:
    """Names of all shipped models, sorted."""
    return tuple(sorted(path.stem for path in data_folder("robots").glob("*.yaml")))


def find_shipped(name: str, span: Span | None = None) -> Path:
    """File of a shipped model; an unknown name raises DiagnosticError (RG009)."""

    known = shipped_names()
    if name in known:
        return data_folder("robots") / f"{name}.yaml"
    meant = suggest(name, known)
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
