"""How fast a driver's clock runs, by the states that it sends at a period of its own. Sans-IO."""

from collections import deque
from itertools import pairwise

_READS = 6
"""Reads with states that tell a pace, at least, ..."""
_KEPT = 16
"""... and at most."""
_LASTS = 0.04
"""s that they last at least: less may be one read of a tunnel that was held up, in pieces."""
_EVEN = 1.8
"""By how much one read may differ from the average: in time both ways, lest a clock that was held
up seems faster, and in how many states it brought."""
_ANYHOW = 2.0
"""s after which the average since the first states counts, if they never came evenly."""
_LATER = 0.3
"""s between the two reads since which it is taken: the lower counts, as for a controller."""


class ClockRateEstimator:
    """States per second of this clock, measured where they come evenly.

    A moment in which the simulation or this process had no time says nothing of the clock's speed:
    what was measured before counts on. A heartbeat's time-out by such a moment would be over
    before the next heartbeat.
    """

    def __init__(self) -> None:
        self._reads: deque[tuple[float, int]] = deque(maxlen=_KEPT)
        """When something was read, and how many states had come by then."""
        self._first: tuple[float, int] | None = None
        self._later = (0.0, 0)
        self._measured: float | None = None

    def add_sample(self, now: float, number: int) -> None:
        """The state `number` was read at `now` s; several of one read have the same moment."""
        # What was held up before it is read at once: the later of the two counts without it.
        if self._first is None or self._first[0] == now:
            self._first = self._later = now, number
        elif self._later[0] in (now, self._first[0]) and now > self._first[0] + _LATER:
            self._later = now, number
        if self._reads and self._reads[-1][0] == now:
            self._reads.pop()
        self._reads.append((now, number))
        if self._is_even:
            self._measured = _rate(self._reads[0], self._reads[-1])

    @property
    def rate(self) -> float | None:
        """States per s; None before it is known."""
        if self._measured is not None or self._first is None:
            return self._measured
        last = self._reads[-1]
        if last[0] - self._later[0] < _ANYHOW:
            return None
        return min(_rate(self._first, last), _rate(self._later, last))

    @property
    def _is_even(self) -> bool:
        steps = len(self._reads) - 1
        if steps < _READS - 1:
            return False
        (first, before), (last, number) = self._reads[0], self._reads[-1]
        if last - first < _LASTS:
            return False
        usual, most = (last - first) / steps, _EVEN * (number - before) / steps
        return all(
            usual / _EVEN <= later - sooner <= _EVEN * usual and more - fewer <= most
            for (sooner, fewer), (later, more) in pairwise(self._reads)
        )


def _rate(first: tuple[float, int], last: tuple[float, int]) -> float:
    return (last[1] - first[1]) / (last[0] - first[0])
