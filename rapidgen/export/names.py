"""Names that an exported module may declare, and names of values that RAPID predefines."""

import re
from collections.abc import Collection, Iterable
from functools import cache

from rapidgen.diagnostics import Diagnostic, error
from rapidgen.export.description import Speed, Zone
from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.syntax.lexer import KEYWORDS, MAX_NAME

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")


def name_fault(name: str, taken: Collection[str] = ()) -> str:
    """Return why RAPID does not allow a name, or an empty text.

    `taken` are lower-case names. Sources: [K §2.2] for the form and 32 characters.
    """
    if not _NAME.fullmatch(name):
        return "a name of RAPID is a letter, then letters, digits and underscores"
    if len(name) > MAX_NAME:
        return f"it has {len(name)} characters, RAPID allows {MAX_NAME}"
    if name.upper() in KEYWORDS:
        return "it is a reserved word of RAPID"
    low = name.lower()
    if low in _predefined():
        return "RAPID has a type, a routine or a datum of that name"
    return "something else has this name" if low in taken else ""


def check_names(names: Iterable[tuple[str, str]], taken: Collection[str] = ()) -> list[Diagnostic]:
    """Return RG750 for each (kind, name) that RAPID does not allow or that exists already."""
    findings: list[Diagnostic] = []
    known = set(taken)
    for kind, name in names:
        reason = name_fault(name, known)
        if reason:
            message = f"{kind} '{name}' cannot be declared: {reason}"
            findings.append(error("RG750", None, message, "choose another name"))
        known.add(name.lower())
    return findings


@cache
def _predefined() -> frozenset[str]:
    names = (*signatures.routine_names(), *signatures.type_names(), *signatures.predefined())
    return frozenset(name.lower() for name in names)


class Names:
    """Unused names for declarations: a stem and a number."""

    def __init__(self, taken: Iterable[str]) -> None:
        self._taken = {name.lower() for name in taken}
        self._next: dict[str, int] = {}

    def new(self, stem: str, step: int = 1) -> str:
        """Return a free name; numbers of one stem grow by `step`."""
        number = self._next.get(stem, step)
        while name_fault(f"{stem}{number}", self._taken):
            number += step
        self._next[stem] = number + step
        name = f"{stem}{number}"
        self._taken.add(name.lower())
        return name


@cache
def speeds() -> dict[Speed, str]:
    """Return RAPID's predefined speeds by value; vmax depends on the robot."""
    return {
        Speed(*_numbers(datum.value)): datum.name
        for datum in signatures.predefined().values()
        if datum.type == "speeddata" and datum.name != "vmax" and isinstance(datum.value, tuple)
    }


@cache
def zones() -> dict[Zone, str]:
    """Return RAPID's predefined zones by value."""
    return {
        Zone(bool(datum.value[0]), _numbers(datum.value[1:])): datum.name
        for datum in signatures.predefined().values()
        if datum.type == "zonedata" and isinstance(datum.value, tuple)
    }


def _numbers(values: tuple[signatures.Value, ...]) -> tuple[float, ...]:
    return tuple(float(v) for v in values if isinstance(v, float | int))
