"""Which schedule comes next: one that does what none has done, or a change of one that met news.

The choice for a number depends on that and on the results of schedules some way before it, which
are the same whatever the workers: as many may be under way as lie between.
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
"""Of which the one is taken that does most what none before has done."""
CHANGED = 0.25
"""Share of schedules that are changed from one which brought new pairs."""
FEWEST_UNDER_WAY = 8
DEEPEST = 6
"""How often a schedule is changed."""


@dataclass(frozen=True, slots=True)
class Parent:
    """A schedule that brought new pairs: its number, its name, how many."""

    number: int
    name: ScheduleName
    gain: int


class ScheduleSelector:
    """Names schedules, the first one `first`; hears what came of them, in order."""

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
        """Schedules, and the pairs that they have met; where there was a new one."""

    @staticmethod
    def needs(number: int) -> int:
        """How many results must have been heard before a schedule is named."""
        return number - max(FEWEST_UNDER_WAY, number // 4)

    def name(self, number: int) -> str:
        """The schedule of that number; asked for in order."""
        chance = random.Random(f"{self._first} {number} guide")
        parents = [parent for parent in self._parents if parent.number < self.needs(number)]
        if parents and chance.random() < CHANGED:
            # What has brought much lately is likely to bring more.
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
        """Hear a result, the next one; what is new of its pairs is left of it."""
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
        """What is done somewhere for the first time counts more than what only takes longer."""
        first = {(act, place) for act, place, _ in doings} - self._acted
        return len(first) + 0.3 * len(doings - self._done)


def _doings(plan: TaskSchedule) -> set[tuple[str, DriverLine, int]]:
    """What is done where, and for how many ms."""
    return {(s.act, s.where.place, s.where.busy) for s in plan.steps if s.where is not None}


def _changes(parent: ScheduleName, chance: random.Random) -> list[ScheduleName]:
    before = parent.changes[: DEEPEST - 1]
    changes = (chance.randrange(1000) for _ in range(CANDIDATES))
    return [replace(parent, changes=(*before, change)) for change in changes]
