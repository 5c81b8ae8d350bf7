"""What both runners of flows share."""

import traceback
from collections.abc import Callable
from contextlib import AbstractContextManager, suppress

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


def release_frames(error: BaseException) -> None:
    """Drop the local variables of the client's finished calls that an error passed.

    A motion holds its error, whose traceback holds these calls and they the motion with all its
    points: only a garbage collection would free a stopped trajectory.
    """
    chain: BaseException | None = error
    while chain is not None:
        for frame, _ in traceback.walk_tb(chain.__traceback__):
            if frame.f_globals.get("__name__", "").startswith("rapidgen.client."):
                # A frame that still runs cannot be cleared.
                with suppress(RuntimeError):
                    frame.clear()
        chain = chain.__context__
