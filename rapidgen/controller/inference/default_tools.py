"""Tools and work objects of a program that nothing in it gives a value: persistents whose other
half is in a task that is in no file. In a guessed cell the predefined ones stand in, tool0 and
wobj0; with all figures 0 no move and no CRobT would be possible.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Final

from rapidgen.controller.inference.name_usage import scoped
from rapidgen.diagnostics import Span
from rapidgen.rapid.binding import ModuleScope
from rapidgen.rapid.syntax import nodes as n

_STANDS: Final[Mapping[str, str]] = {"tooldata": "tool0", "wobjdata": "wobj0"}


@dataclass(frozen=True, slots=True)
class DefaultedPersistent:
    """A persistent of a module, and the predefined datum that stands in for it."""

    task: str
    module: str
    name: str
    stands: str


def find_defaulted_persistents(
    tasks: Iterable[tuple[str, Iterable[ModuleScope]]],
) -> dict[DefaultedPersistent, tuple[str, Span]]:
    """All in the modules of tasks, each with its type and where it is declared."""
    result: dict[DefaultedPersistent, tuple[str, Span]] = {}
    filled: set[str] = set()
    for task, modules in tasks:
        for module in modules:
            filled |= set(_filled(module))
            for one in module.tree.data:
                kind = one.type.lower()
                if one.kind == "PERS" and kind in _STANDS and not (one.initial or one.dimensions):
                    row = DefaultedPersistent(task, module.tree.name, one.name, _STANDS[kind])
                    result[row] = kind, module.tree.source.span(one.name_token, one.name_token)
    return {row: at for row, at in result.items() if row.name.casefold() not in filled}


def _filled(module: ModuleScope) -> Iterator[str]:
    """Data of a module that have a value, or get one, whole or in part."""
    for node, _ in scoped(module):
        if isinstance(node, n.DataDeclaration) and node.initial is not None:
            yield node.name.casefold()
        elif isinstance(node, n.Assignment):
            target = node.target
            while isinstance(target, n.Index | n.Member):
                target = target.base
            if isinstance(target, n.Name):
                yield target.name.casefold()
