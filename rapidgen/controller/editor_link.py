"""Link between the page of a controller and the editors that debug it.

An editor reports the place of its cursor, and the page shows the target there. The page asks for a
line, and the editors open it. All of it belongs to the thread that runs the controller.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import TypeAlias

from rapidgen.controller.inference.robot import MoveTarget, move_targets
from rapidgen.rapid.binding.names import DataSymbol, ModuleScope
from rapidgen.runtime.compiler.symbols import LoadedModule
from rapidgen.runtime.task.task import Task

Opener: TypeAlias = Callable[[str, int], None]
"""Opens a line of a module, by its name, in an editor."""


@dataclass(frozen=True, slots=True)
class EditorCursor:
    """The place under the cursor of an editor."""

    module: str
    line: int
    name: str = ""
    """The name under the cursor; empty: none."""


class EditorLink:
    """Editors with a debug session on one controller; it survives restarts."""

    def __init__(self) -> None:
        self.cursor: EditorCursor | None = None
        """The last one that an editor has shown; None: none since the last editor left."""
        self._openers: list[Opener] = []

    @property
    def is_attached(self) -> bool:
        """True if there is an editor."""
        return bool(self._openers)

    def attach(self, opener: Opener) -> None:
        """Add an editor."""
        self._openers.append(opener)

    def detach(self, opener: Opener) -> None:
        """Remove an editor; without any, there is no cursor."""
        self._openers.remove(opener)
        if not self._openers:
            self.cursor = None

    def open(self, module: str, line: int) -> bool:
        """Open a line in all editors; False: there is none."""
        for opener in tuple(self._openers):
            opener(module, line)
        return self.is_attached


def targets_at(
    tasks: Mapping[str, Task], cursor: EditorCursor
) -> Iterator[tuple[str, str, MoveTarget]]:
    """Iterate over task, module and target of the moves that a place names.

    A name selects all moves to that datum, a line without one the moves that begin there, or those
    to the datum that it declares. Only a move knows the tool and the work object of a target.
    """
    for task in tasks.values():
        modules = [m for m in task.program.modules.values() if not m.installed]
        for module in modules:
            if module.name.lower() == cursor.module.lower():
                for name, target in _targets(module, modules, cursor):
                    yield task.name, name, target


def _targets(
    module: LoadedModule, modules: Iterable[LoadedModule], cursor: EditorCursor
) -> Iterator[tuple[str, MoveTarget]]:
    scope = module.scope
    for key in (cursor.name.lower(), _declared(scope, cursor.line)):
        found = [
            (m.name, target)
            for m in modules
            for target in move_targets(m.scope)
            if key and target.name.lower() == key and _is_same(key, m.scope, scope)
        ]
        if found:
            yield from found
            return
    here = (target for target in move_targets(scope) if target.line == cursor.line)
    yield from ((module.name, target) for target in here)


def _declared(scope: ModuleScope, line: int) -> str:
    """Return the name, in lower case, of the module's datum that a line declares."""
    source = scope.tree.source
    for key, symbol in scope.own.items():
        node = symbol.node if isinstance(symbol, DataSymbol) else None
        if node is not None and source.line(node.first) <= line <= source.line(node.last):
            return key
    return ""


def _is_same(key: str, one: ModuleScope, other: ModuleScope) -> bool:
    """True if a name means the same datum in two modules."""
    return one is other or one.find(key) is other.find(key)
