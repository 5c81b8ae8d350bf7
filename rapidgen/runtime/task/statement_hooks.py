"""Hooks before statements: tracers, breakpoints and injected faults."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TypeAlias

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.program import Program
from rapidgen.runtime.compiler.symbols import LoadedModule, Routine
from rapidgen.runtime.errors import FatalError, RapidError

Tracer: TypeAlias = Callable[[str, Routine, n.Statement], bool | None]
"""Receives task name, routine and statement. True: do not report this statement again."""


@dataclass(slots=True)
class WaitingAction:
    """An action that waits for a statement."""

    left: int
    """Passes until it is due."""
    action: Callable[[], None]


class Statements:
    """Tracers and breakpoints of one controller.

    They require programs compiled with tracing.
    """

    def __init__(self) -> None:
        self.programs: list[Program] = []
        """Programs of all tasks."""
        self.tracers: list[Tracer] = []
        self.errors: list[Callable[[str, RapidError], None]] = []
        """Receive a task name and the error before its handler runs."""
        self.failures: list[Callable[[str, FatalError], None]] = []
        """Receive a task name and the error that stopped the task."""
        self.breakpoints: dict[tuple[str, str], dict[int, list[WaitingAction]]] = {}
        """By task and module, then line."""
        self.waiting = 0
        """How many actions wait."""
        self._watched: dict[tuple[str, str], dict[int, list[WaitingAction]]] = {}
        """The same lines by the names as they are written."""

    def listen(self, tracer: Tracer) -> None:
        """Report every statement to a tracer from now on."""
        self.tracers.append(tracer)
        for program in self.programs:
            program.report_all()

    def before(
        self, task: str, module: str, line: int, count: int, action: Callable[[], None]
    ) -> None:
        """Call `action` when `task` reaches a line for the `count`-th time."""
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
        """Return pending actions of a statement, to be executed in order.

        None: no action waits in the module.
        """
        # This is called for every statement.
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
