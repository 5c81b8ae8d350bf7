"""Who wants to know of statements before they are executed: tracers and faults."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TypeAlias

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.program import Program
from rapidgen.runtime.compiler.symbols import LoadedModule, Routine
from rapidgen.runtime.errors import FatalError, RapidError

Tracer: TypeAlias = Callable[[str, Routine, n.Statement], bool | None]
"""Is told a task's name, its routine, and the statement. True: of this one it wants no more."""


@dataclass(slots=True)
class WaitingAction:
    """An action that waits for a statement."""

    left: int
    """Passes until it is due."""
    action: Callable[[], None]


class Statements:
    """Tracers and breakpoints of one controller. Its programs have to be compiled with tracing."""

    def __init__(self) -> None:
        self.programs: list[Program] = []
        """Those of all tasks."""
        self.tracers: list[Tracer] = []
        self.errors: list[Callable[[str, RapidError], None]] = []
        """Are told a task's name and the error before its handler is executed."""
        self.failures: list[Callable[[str, FatalError], None]] = []
        """Are told a task's name and the error that has stopped it."""
        self.breakpoints: dict[tuple[str, str], dict[int, list[WaitingAction]]] = {}
        """By task and module, then line."""
        self.waiting = 0
        """How many actions wait."""
        self._watched: dict[tuple[str, str], dict[int, list[WaitingAction]]] = {}
        """The same lines by the names as they are written."""

    def listen(self, tracer: Tracer) -> None:
        """Let a tracer hear of every statement from now on."""
        self.tracers.append(tracer)
        for program in self.programs:
            program.tell_all()

    def before(
        self, task: str, module: str, line: int, count: int, action: Callable[[], None]
    ) -> None:
        """Let `action` be due when a statement of `task` is reached for the `count`-th time."""
        key = (task.lower(), module.lower())
        lines = self.breakpoints.setdefault(key, {})
        lines.setdefault(line, []).append(WaitingAction(count, action))
        self.waiting += 1
        for program in self.programs:
            if program.name.lower() == key[0]:
                program.trace_from_now()

    def due(
        self, task: str, module: LoadedModule, node: n.Statement
    ) -> Iterator[Callable[[], None]] | None:
        """Actions that a statement brings which is about to be executed, one after the other.

        None: nothing waits for any statement of its module."""
        # Every statement comes by here.
        written = (task, module.name)
        lines = self._watched.get(written)
        if lines is None:
            lines = self.breakpoints.setdefault((task.lower(), module.name.lower()), {})
            self._watched[written] = lines
        return self._due(lines, module, node) if lines else None

    def _due(
        self, lines: dict[int, list[WaitingAction]], module: LoadedModule, node: n.Statement
    ) -> Iterator[Callable[[], None]]:
        line = module.tree.source.line(node.first)
        for waiting in tuple(lines.get(line, ())):
            waiting.left -= 1
            if waiting.left == 0:
                lines[line].remove(waiting)
                self.waiting -= 1
                if not lines[line]:
                    del lines[line]
                yield waiting.action
