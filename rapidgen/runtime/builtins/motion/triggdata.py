"""triggdata: what TriggIO and its relatives prepare and TriggL fires."""

from collections.abc import Callable
from dataclasses import dataclass

from rapidgen.motion.moves import From, PathEvent
from rapidgen.runtime.values import register_type


@dataclass(slots=True)
class TriggData:
    """One prepared event; empty until TriggIO, TriggInt, TriggEquip or TriggCheckIO."""

    event: PathEvent | None = None

    def set(self, where: From, amount: float, act: Callable[[], None], lag: float = 0.0) -> None:
        """Prepare: `amount` m or s, see PathEvent."""
        self.event = PathEvent(where, amount, act, lag)


register_type("triggdata", TriggData)
