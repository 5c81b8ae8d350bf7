"""What both runners of flows share."""

from collections.abc import Callable
from contextlib import AbstractContextManager

from rapidgen.client.address import Address
from rapidgen.client.core.robot import Core
from rapidgen.client.unclosed import drop_in_child

MakeCore = Callable[[Callable[[], float]], Core]
"""A core on a clock that returns s."""


class FlowRunner:
    """Runner of flows: it opens the connections of one robot and moves their bytes.

    `guard` locks data that another thread may change.
    """

    def __init__(self, address: Address, core: Core, guard: AbstractContextManager[object]) -> None:
        self.address = address
        self.core = core
        self.guard = guard
        drop_in_child(self)

    def forked(self) -> None:
        """Drop the connections in a forked process."""
        self.core.forked()
