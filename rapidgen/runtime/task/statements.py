"""Who wants to know of statements before they are executed: tracers, faults, steps."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.symbols import Routine

if TYPE_CHECKING:
    from rapidgen.runtime.task.task import Task

Tracer: TypeAlias = "Callable[[Task, Routine, n.Statement], None]"


@dataclass(slots=True)
class Breakpoint:
    """An action that waits for a statement."""

    left: int
    """Passes until it is due."""
    action: Callable[[], None]


class Statements:
    """Tracers and breakpoints of one controller. Its programs have to be compiled with tracing."""

    def __init__(self) -> None:
        self.tracers: list[Tracer] = []
        self._breakpoints: dict[tuple[str, str, int], list[Breakpoint]] = {}

    def before(
        self,
        tasks: "Mapping[str, Task]",
        task: str,
        module: str,
        line: int,
        count: int,
        action: Callable[[], None],
    ) -> None:
        """Call `action` when a statement of one of `tasks` is reached for the `count`-th time."""
        key = (task.lower(), module.lower(), line)
        self._breakpoints.setdefault(key, []).append(Breakpoint(count, action))
        for own in tasks.values():
            if own.name.lower() == key[0]:
                own.program.trace_from_now()

    def reached(self, task: "Task", point: int) -> None:
        """A traced statement is about to be executed."""
        routine, node = task.program.trace_points[point]
        for tracer in self.tracers:
            tracer(task, routine, node)
        module = routine.module
        if task.stepper.reached(module):
            task.stepper.end()
        if not self._breakpoints or module is None:
            return
        line = module.tree.source.line(node.first)
        for waiting in self._breakpoints.get((task.name.lower(), module.name.lower(), line), ()):
            waiting.left -= 1
            if waiting.left == 0:
                waiting.action()
                task.attend()
