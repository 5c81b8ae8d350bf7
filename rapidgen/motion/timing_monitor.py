"""Whether moves took their \\T: a controller says nothing, this one does, once a standstill."""

from collections.abc import Iterable

from rapidgen.machine.event_log import EventLog
from rapidgen.motion import events
from rapidgen.motion.legs import Leg
from rapidgen.motion.motion import Motion

LATE = 0.002
"""s by which a move may miss its \\T unreported."""


class TimingMonitor:
    """Compares the times at which moves were passed with what they promised."""

    __slots__ = ("_last", "_late", "_moves")

    def __init__(self) -> None:
        self._late = 0.0
        self._moves = 0
        self._last: float | None = None
        """Scheduler time (s) at which the last finished move was passed."""

    def look(self, legs: Iterable[Leg], motion: Motion, now: int) -> None:
        """Note when legs were passed, before a new motion forgets it."""
        place = motion.place(now)
        for leg in legs:
            if leg.end > place:
                break
            _note(leg, motion)

    def finished(self, leg: Leg, motion: Motion) -> None:
        """A leg is done."""
        passed = _note(leg, motion)
        began = leg.began if leg.began is not None else self._last
        self._last = passed
        if leg.move.time is None or began is None:
            return
        late = passed - began - leg.move.time
        if late > LATE:
            self._late += late
            self._moves += 1

    def report(self, log: EventLog, name: str) -> None:
        """Say what was late since the last report."""
        if self._moves:
            log.record(
                events.TIME_NOT_MET,
                f"{name}: {self._moves} moves with \\T took {self._late:.3f} s longer",
                texts=("the axes' limits, the override or a stop",),
            )
        self._late, self._moves = 0.0, 0


def _note(leg: Leg, motion: Motion) -> float:
    if leg.passed_at is None:
        leg.passed_at = motion.time_at(leg.end)
    return leg.passed_at
