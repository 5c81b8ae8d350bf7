"""Whether moves took their \\T: a controller says nothing, this one does, once a standstill."""

from collections.abc import Sequence

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

    def look(self, legs: Sequence[Leg], motion: Motion, place: float) -> None:
        """Note when legs up to a place were passed, before a new motion forgets it."""
        for i, leg in enumerate(legs):
            if leg.end > place:
                break
            if _counts(leg, legs[i + 1] if i + 1 < len(legs) else None):
                _note(leg, motion)

    def finished(self, leg: Leg, following: Leg | None, motion: Motion) -> None:
        """A leg is done; another one follows on the path, or none yet."""
        if not _counts(leg, following):
            self._last = None
            return
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


def _counts(leg: Leg, following: Leg | None) -> bool:
    """True if the time at which a leg is passed ends or begins a \\T, as far as is known."""
    return leg.move.time is not None or following is None or following.move.time is not None


def _note(leg: Leg, motion: Motion) -> float:
    if leg.passed_at is None:
        leg.passed_at = motion.time_at(leg.end)
    return leg.passed_at
