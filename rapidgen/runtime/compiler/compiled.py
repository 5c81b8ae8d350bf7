"""What is known about compiled code when something looks at its frames: errors, steps, stops.

Everything about names and variables that the compiler gives to Python functions is said here;
who walks a call stack asks for roles.
"""

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum, auto
from types import CodeType, FrameType
from typing import TYPE_CHECKING

from rapidgen.runtime.compiler.symbols import Routine

if TYPE_CHECKING:
    from rapidgen.runtime.compiler.program import LoadedModule

HANDLER = "_h"
"""Function of an ERROR handler, and the variable of its routine that holds it."""
UNDO = "_u"
"""Function of an UNDO handler."""
LISTED = "_l"
"""Function with the numbers of ERROR (list); None: the handler is for all."""
PART = "_a"
"""Functions of statements that are nested too deeply begin so."""
BUDGET = "b"
"""What the task has left, while its routine counts down."""


class Role(Enum):
    """What a Python function of a compiled routine is."""

    ROUTINE = auto()
    HANDLER = auto()
    UNDO = auto()
    PART = auto()
    """Deeply nested statements of a routine or handler, whose frame is the next one out."""

    @property
    def is_handler(self) -> bool:
        """Whether it is an ERROR or UNDO handler."""
        return self is Role.HANDLER or self is Role.UNDO


_ROLES = {HANDLER: Role.HANDLER, UNDO: Role.UNDO}


@dataclass(slots=True, eq=False)
class Compiled:
    """The code of one routine."""

    routine: Routine
    module: "LoadedModule"
    text: str
    tokens: list[int]
    """RAPID token by Python line."""
    refunds: dict[int, int]
    synced: set[int]

    @property
    def handled(self) -> bool:
        """Whether the routine has an ERROR clause."""
        node = self.routine.node
        return node is not None and node.error is not None

    def role(self, code: CodeType) -> Role:
        """What one of the routine's functions is."""
        name = code.co_name
        return _ROLES.get(name) or (Role.PART if name.startswith(PART) else Role.ROUTINE)

    def handler(self, frame: FrameType) -> Callable[[], int] | None:
        """The ERROR handler of a routine that is being executed, once it is made."""
        found: Callable[[], int] | None = frame.f_locals.get(HANDLER)
        return found

    def listed(self, frame: FrameType) -> tuple[float, ...] | None:
        """Numbers of ERROR (list) of a routine that is being executed; None: there is no list."""
        numbers: Callable[[], tuple[float, ...]] | None = frame.f_locals.get(LISTED)
        return None if numbers is None else numbers()

    def budget(self, frame: FrameType, line: int) -> int | None:
        """What an error at a line leaves of the task's budget, ns; None: that is written back."""
        if line in self.synced:
            return None
        left: int | None = frame.f_locals.get(BUDGET)
        return None if left is None else left + self.refunds.get(line, 0)
