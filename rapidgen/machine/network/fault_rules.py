"""Rules of what goes wrong with connections, as data; `faulty.py` carries them out."""

from dataclasses import dataclass
from typing import Literal

NetworkAction = Literal["split", "merge", "delay", "reset", "half-open", "silent", "slow"]
Direction = Literal["in", "out", "both"]


@dataclass(frozen=True, slots=True)
class NetworkRule:
    """What happens to the connections of a port once `after` bytes have passed.

    `port` 0 and `connection` 0 mean all; a direction is seen from the program (`in`: what it
    receives). `bytes`: the size of the pieces (split) or bytes a second (slow). `seconds`: the
    gap between pieces (split), how long bytes are gathered (merge) or held back (delay).
    """

    do: NetworkAction
    port: int = 0
    direction: Direction = "both"
    connection: int = 0
    after: int = 0
    bytes: int = 1
    seconds: float = 0.001

    def concerns(self, port: int, connection: int) -> bool:
        """Whether the rule is about that connection, counted from 1 for each port."""
        return self.port in (0, port) and self.connection in (0, connection)
