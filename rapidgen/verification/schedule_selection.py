"""Select the next schedule by expected new coverage.

It is either a new schedule with most new combinations, or a change of a schedule that found new
pairs. The choice for a number depends on results of schedules some numbers before it. These results
do not depend on the workers, so that as many schedules as the gap can run at the same time.
"""

import random
from collections.abc import Iterable
from dataclasses import dataclass, replace

from rapidgen.verification.interleaving_coverage import Pair
from rapidgen.verification.schedule import (
    DriverLine,
    ScheduleName,
    ScheduleSpace,
    TaskSchedule,
    drawn,
)
from rapidgen.verification.schedule_exploration import ScheduleResult

CANDIDATES = 12
"""Candidates, of which the one with most new combinations is selected."""
CHANGED = 0.25
"""Share of schedules that are changes of one with new pairs."""
FEWEST_UNDER_WAY = 8
DEEPEST = 6
"""Maximum number of changes of a schedule."""


@dataclass(frozen=True, slots=True)
class Parent:
    """A schedule that found new pairs: number, name, count."""

    number: int
    name: ScheduleName
    gain: int


class ScheduleSelector:
    """Select schedules from number `first` on, using results in order."""

    def __init__(self, ground: ScheduleSpace, first: int = 0) -> None:
        self._ground = ground
        self._first = first
        self._names: list[ScheduleName] = []
        self._done: set[tuple[str, DriverLine, int]] = set()
        self._acted: set[tuple[str, DriverLine]] = set()
        self._parents: list[Parent] = []
        self._pairs: set[Pair] = set()
        self._taken = 0
        self.curve: list[tuple[int, int]] = []
        """(schedules, pairs seen), one entry for each new pair."""

    @staticmethod
    def needs(number: int) -> int:
        """Return how many results a schedule's name depends on."""
        return number - max(FEWEST_UNDER_WAY, number // 4)

    def name(self, number: int) -> str:
        """Return the schedule of a number; called in order."""
        chance = random.Random(f"{self._first} {number} guide")
        parents = [parent for parent in self._parents if parent.number < self.needs(number)]
        if parents and chance.random() < CHANGED:
            # A schedule that found many pairs recently is likely to lead to more.
            weights = [(1 + p.gain) * (1 + at) for at, p in enumerate(parents)]
            made = self._best(_changes(chance.choices(parents, weights)[0].name, chance))
        else:
            begin = (self._first + number) * CANDIDATES
            made = self._best(ScheduleName(seed) for seed in range(begin, begin + CANDIDATES))
        doings = _doings(drawn(made, self._ground))
        self._done |= doings
        self._acted |= {(act, place) for act, place, _ in doings}
        self._names.append(made)
        return str(made)

    def take(self, explored: ScheduleResult) -> ScheduleResult:
        """Add the next result, and return it with the new pairs only."""
        new = set(explored.pairs) - self._pairs
        self._pairs |= new
        if new:
            self._parents.append(Parent(self._taken, self._names[self._taken], len(new)))
            self.curve.append((self._taken + 1, len(self._pairs)))
        self._taken += 1
        return replace(explored, pairs=tuple(sorted(new)))

    def _best(self, names: Iterable[ScheduleName]) -> ScheduleName:
        return max(names, key=lambda name: self._news(_doings(drawn(name, self._ground))))

    def _news(self, doings: set[tuple[str, DriverLine, int]]) -> float:
        """Rate new actions; a new place counts more than a new duration."""
        first = {(act, place) for act, place, _ in doings} - self._acted
        return len(first) + 0.3 * len(doings - self._done)


def _doings(plan: TaskSchedule) -> set[tuple[str, DriverLine, int]]:
    """Return the actions of a plan: step, place, ms."""
    return {(s.act, s.where.place, s.where.busy) for s in plan.steps if s.where is not None}


def _changes(parent: ScheduleName, chance: random.Random) -> list[ScheduleName]:
    before = parent.changes[: DEEPEST - 1]
    changes = (chance.randrange(1000) for _ in range(CANDIDATES))
    return [replace(parent, changes=(*before, change)) for change in changes]
