"""Where tasks of one controller wait for each other."""

from dataclasses import dataclass, field

from rapidgen.machine.scheduler import WaitSet


@dataclass(slots=True)
class SyncPoint:
    """Tasks that have come to one synchronisation point."""

    members: frozenset[str]
    arrived: set[str] = field(default_factory=set)
    changed: WaitSet = field(default_factory=WaitSet)
    complete: bool = False


@dataclass(slots=True)
class SyncMoveGroup:
    """Tasks that have come to a move of one \\ID, and how long each of them would take (s)."""

    times: dict[str, float] = field(default_factory=dict)
    changed: WaitSet = field(default_factory=WaitSet)
    longest: float | None = None
    """Known when all have come."""


class SyncPoints:
    """The synchronisation points of one controller at which somebody waits."""

    def __init__(self) -> None:
        self.points: dict[tuple[object, frozenset[str]], SyncPoint] = {}
        """WaitSyncTask and its like: by point and members."""
        self.moves: dict[tuple[frozenset[str], float], SyncMoveGroup] = {}
        """Moves of one \\ID: by partners and \\ID."""
        self.any_task = False
        """Whether tasks that are named and not there are left out (a guessed cell)."""
