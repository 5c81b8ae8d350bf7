"""Events on the path that are still to come, and when each of them is due."""

from collections.abc import Iterable
from math import inf

from rapidgen.motion.legs import Leg
from rapidgen.motion.motion import Motion
from rapidgen.motion.moves import NO_WAY, MeasuredFrom, PathEvent

_Entry = tuple[Leg, PathEvent]


class PathEvents:
    """What TriggIO and its relatives have put on the legs of one path."""

    __slots__ = ("_waiting",)

    def __init__(self) -> None:
        self._waiting: list[_Entry] = []

    def add(self, leg: Leg) -> None:
        """The events of a move that is now on the path."""
        self._waiting += [(leg, event) for event in leg.move.events]

    def add_at_end(self, leg: Leg, events: Iterable[PathEvent]) -> None:
        """Events of a move that goes nowhere, behind a leg."""
        self._waiting += [(leg, PathEvent(MeasuredFrom.END, 0.0, event.act)) for event in events]

    def times(self, motion: Motion) -> list[float]:
        """Scheduler s of all that this motion reaches."""
        return [when for entry in self._waiting if (when := _when(entry, motion)) < inf]

    def fire(self, motion: Motion, now: float) -> None:
        """Do what is due. An act may change the motion: what is due is decided before."""
        if not self._waiting:
            return
        due = [entry for entry in self._waiting if _when(entry, motion) <= now]
        self._waiting = [e for e in self._waiting if e not in due and not e[0].cleared]
        for _, event in due:
            event.act()


def times_of_events(leg: Leg, motion: Motion) -> list[float]:
    """Return scheduler s of the events of a leg that this motion reaches."""
    return [when for event in leg.move.events if (when := _when((leg, event), motion)) < inf]


def _when(entry: _Entry, motion: Motion) -> float:
    """Scheduler s of an event; infinite when the motion stops short of it."""
    leg, event = entry
    place = leg.end
    if event.where in (MeasuredFrom.END, MeasuredFrom.START):
        length = leg.way.measure.tcp
        fraction = min(1.0, event.amount / length) if length > NO_WAY else 0.0
        path = fraction * (leg.end - leg.begin)
        place = leg.begin + path if event.where is MeasuredFrom.START else leg.end - path
    early = event.lag + (event.amount if event.where is MeasuredFrom.BEFORE_END else 0.0)
    if motion.law.place < place - 1e-9:
        return inf
    return motion.time_at(place) - early
