"""Breakpoints: place, condition, hit counts, and the actual line."""

import re
from collections.abc import Iterable
from dataclasses import dataclass, field

from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk
from rapidgen.runtime.compiler.symbols import LoadedModule

_HITS = re.compile(r"\s*(>=|%|=|==)?\s*(\d+)\s*")
_INSERT = re.compile(r"\{([^{}]*)\}")


@dataclass(frozen=True, slots=True)
class Breakpoint:
    """A breakpoint as requested.

    `hits` counts passes with a true `condition`: "3" or "=3" the third, ">=3" from the third on,
    "%3" every third. With `log` nothing pauses: the text is output, with each `{expression}`
    evaluated.
    """

    module: str
    line: int
    task: str = ""
    """Empty: every task that has the module."""
    condition: str = ""
    hits: str = ""
    log: str = ""


@dataclass(slots=True, eq=False)
class PlacedBreakpoint:
    """A breakpoint in a controller."""

    number: int
    asked: Breakpoint
    line: int = 0
    """Line of its statement; 0: it has no place."""
    points: set[tuple[int, int]] = field(default_factory=set)
    """Trees by identity, and the token of the statement in each."""
    doubt: str = ""
    """Reason for a missing place, or when the breakpoint has no effect yet."""
    count: int = 0
    """Passes with a true condition."""


def due(hits: str, count: int) -> bool:
    """Return True if a pass counts. ValueError: invalid `hits`."""
    if not hits:
        return True
    match = _HITS.fullmatch(hits)
    if match is None or int(match[2]) == 0:
        raise ValueError(f'{hits!r} is no number of passes: "3", ">=3" or "%3"')
    kind, number = match[1], int(match[2])
    if kind == ">=":
        return count >= number
    return count % number == 0 if kind == "%" else count == number


def pieces(log: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return alternating texts and expressions of a log point."""
    parts = _INSERT.split(log)
    return tuple(parts[::2]), tuple(parts[1::2])


def place(placed: PlacedBreakpoint, modules: Iterable[LoadedModule]) -> None:
    """Find the first statement at or below the requested line."""
    placed.line, placed.points = 0, set()
    for module in modules:
        if module.name.lower() == placed.asked.module.lower():
            result = _statement_at(module, placed.asked.line)
            if result is not None:
                placed.line = module.tree.source.line(result)
                placed.points.add((id(module.tree), result))
    placed.doubt = "" if placed.line else "no statement begins there"


def _statement_at(module: LoadedModule, line: int) -> int | None:
    source = module.tree.source
    for routine in module.tree.routines:
        if source.line(routine.first) <= line <= source.line(routine.last):
            tokens = sorted(node.first for node in statements(routine))
            return next((token for token in tokens if source.line(token) >= line), None)
    return None


def statements(routine: n.RoutineDeclaration) -> Iterable[n.Statement]:
    """Iterate over statements of a routine that tracers receive."""
    for node in walk(routine):
        if isinstance(node, n.Statement) and not isinstance(node, n.Label):
            yield node
