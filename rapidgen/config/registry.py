"""Find models by name: `robots/*.yaml` and well-known variants."""

from collections.abc import Iterable
from difflib import SequenceMatcher
from itertools import takewhile
from pathlib import Path
from typing import Final

from rapidgen._data import data_folder
from rapidgen.diagnostics import Span, refusal, suggest

_ALIKE: Final = 0.5
"""Required similarity of the letters before a robot's figures."""


def shipped_names() -> tuple[str, ...]:
    """Return the names of all shipped models, sorted."""
    return tuple(sorted(path.stem for path in data_folder("robots").glob("*.yaml")))


def shipped_headings() -> dict[str, tuple[str, tuple[int, ...]]]:
    """Return description and RobotWare generations of all shipped models, by name.

    Their files have both on one line each, so that a list of them needs no YAML.
    """
    result = {}
    for name in shipped_names():
        heading: dict[str, str] = {}
        with (data_folder("robots") / f"{name}.yaml").open(encoding="utf-8") as file:
            for line in file:
                key, _, value = line.partition(": ")
                heading[key] = value.strip()
                if key == "generations":
                    break
        numbers = heading["generations"].strip("[]").split(",")
        result[name] = heading["description"], tuple(int(number) for number in numbers)
    return result


def find_shipped(name: str, span: Span | None = None) -> Path:
    """Return the file of a model.

    An unknown name raises DiagnosticError (RG009).
    """
    known = shipped_names()
    if name in known:
        return data_folder("robots") / f"{name}.yaml"
    # Reading the variant library takes time.
    from rapidgen.config import variant_model

    variant = variant_model.named(name)
    if variant:
        missing = variant_model.missing_figures(variant)
        if not missing:
            return variant_model.PATH
        raise refusal(
            "RG009",
            span,
            f"{variant.name} is known, but not well enough to be a model; it lacks: "
            + "; ".join(missing),
            "`rapidgen new --urdf` with a description of it uses the known figures and "
            "marks the others as open",
        )
    meant = suggest(name, _alike(name, (*known, *variant_model.names())))
    raise refusal(
        "RG009",
        span,
        f"no shipped model is called '{name}'",
        (f"{meant}; " if meant else "") + "`rapidgen robots` lists them; "
        "for a file of your own write its path with the suffix .yaml",
    )


def _alike(name: str, known: Iterable[str]) -> list[str]:
    """Return the names that `name` may misspell.

    Another maker's robot has other letters, but similar figures.
    """
    letters = _letters(name)
    return [
        one
        for one in known
        if not letters or SequenceMatcher(None, letters, _letters(one)).ratio() > _ALIKE
    ]


def _letters(name: str) -> str:
    return "".join(takewhile(str.isalpha, name.casefold()))


def is_path(text: str) -> bool:
    """True if the text is a file name: it has a suffix or a separator."""
    return "/" in text or "\\" in text or "." in text
