"""Rate of a driver's clock, from its periodic states. Sans-IO."""

from collections import deque
from itertools import pairwise

_READS = 6
"""Minimum number of reads with states for an estimate, ..."""
_KEPT = 16
"""... and at most."""
_LASTS = 0.04
"""... and their minimum duration, s.

Fewer could be the pieces of one read of a delayed tunnel.
"""
_EVEN = 1.8
"""Largest deviation of one read from the average.

It applies to the time in both directions, so that a delayed clock does not appear faster, and to
the number of states of the read.
"""
_ANYHOW = 2.0
"""s after which the average counts even if states never came evenly."""
_LATER = 0.3
"""s between the two reads of an estimate; the lower rate counts."""


class ClockRateEstimator:
    """Estimator of states per second, from evenly spaced states.

    A moment in which the simulation or this process was delayed says nothing about the clock's
    rate: the earlier estimate stays valid. Otherwise the heartbeat's time-out derived from it would
    end before the next heartbeat.
    """

    def __init__(self) -> None:
        self._reads: deque[tuple[float, int]] = deque(maxlen=_KEPT)
        """Times of reads, with the number of states so far."""
        self._first: tuple[float, int] | None = None
        self._later = (0.0, 0)
        self._measured: float | None = None

    def add_sample(self, now: float, number: int) -> None:
        """Add state `number`, read at `now` s.

        Several states of one read have the same time.
        """
        # Delayed states are read at once: the later of two reads counts without the earlier.
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
