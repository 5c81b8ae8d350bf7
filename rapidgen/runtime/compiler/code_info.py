"""What is known about compiled code when something looks at its frames: errors, steps, stops.

A routine becomes one Python function and, inside it, one for each handler and for statements that
are nested more deeply than CPython takes. The compiler registers the role of each with the code;
what they and their variables are called is said here alone.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum
from types import CodeType, FrameType
from typing import Final, TypeAlias

from rapidgen.runtime.compiler.symbols import LoadedModule, Routine

HANDLER: Final = "_h"
"""Function of an ERROR handler, and the variable of its routine that holds it."""
UNDO: Final = "_u"
"""Function of an UNDO handler."""
LISTED: Final = "_l"
"""Function with the numbers of ERROR (list); None: the handler is for all."""
BUDGET: Final = "b"
"""What the task has left, while its routine counts down."""


class CodeRole(Enum):
    """What a Python function of a compiled routine is."""

    ROUTINE = ""
    HANDLER = "ERROR"
    UNDO = "UNDO"
    PART = "part"
    """Deeply nested statements of a routine or handler, whose frame is the next one out."""

    @property
    def is_handler(self) -> bool:
        """Whether it is an ERROR or UNDO handler."""
        return self is CodeRole.HANDLER or self is CodeRole.UNDO


@dataclass(slots=True, eq=False)
class Compiled:
    """The code of one routine."""

    file: str
    """Its Python file name, by which frames are known."""
    routine: Routine
    module: LoadedModule
    text: str
    tokens: list[int]
    """RAPID token by Python line."""
    refunds: dict[int, int]
    """By Python line: what the rest of its block was paid, ns."""
    synced: set[int]
    """Python lines before which the budget was written back."""
    roles: dict[str, CodeRole]
    """Of the functions inside the routine's, by name."""

    traced: bool
    """Whether it reports its statements; it takes no local for a whole number for good then."""

    @property
    def handled(self) -> bool:
        """Whether the routine has an ERROR clause."""
        node = self.routine.node
        return node is not None and node.error is not None

    def role(self, code: CodeType) -> CodeRole:
        """What one of the routine's functions is."""
        return self.roles.get(code.co_name, CodeRole.ROUTINE)

    def handler(self, frame: FrameType) -> Callable[[], int] | None:
        """The ERROR handler of a routine that is being executed, once it is made."""
        match: Callable[[], int] | None = frame.f_locals.get(HANDLER)
        return match

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


Codes: TypeAlias = Mapping[str, Compiled]
"""Code of a program by Python file name."""
