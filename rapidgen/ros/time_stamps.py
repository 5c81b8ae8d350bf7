"""Moments of the controller's clock as ROS time.

A message is stamped with the time of the position, not of its arrival: spacing is the controller's,
whatever the network does to it.
"""

_DRIFT = 1e-4
"""Drift between the clocks: the rate at which the offset may grow."""


class RosTimeEstimator:
    """ROS time of a controller's moments.

    It never goes backwards and never exceeds the time of reception. The offset between the clocks
    is the smallest observed (the message with the shortest delay), and may grow by the drift of two
    quartzes.
    """

    def __init__(self, *, is_clock: bool = False) -> None:
        """With `is_clock` ROS time is the controller's own.

        It runs at the speed of the simulation, starts at the current time of this machine and
        continues after a restart.
        """
        self._is_clock = is_clock
        self._offset: float | None = None
        self._at = 0.0
        self._last = 0

    def stamp(self, time: float, received: float) -> int:
        """Return ns of ROS time for `time` s of the controller's clock.

        The message arrived at `received` s of ROS time. A clock that went back (a restart, a
        wrap-around, a new simulation) counts as a new one.
        """
        if self._is_clock:
            return self._ticked(time, received)
        offset = received - time
        if self._offset is None or time < self._at or self._went_back(received):
            self._offset = offset
        else:
            self._offset = min(offset, self._offset + _DRIFT * (time - self._at))
        self._at = time
        stamp = round((time + self._offset) * 1e9)
        self._last = max(stamp, self._last + 1)
        return self._last

    @property
    def last(self) -> int:
        """ns of ROS time last returned; 0 before."""
        return self._last

    def _ticked(self, time: float, received: float) -> int:
        if self._offset is None:
            self._offset = received - time
        elif time < self._at:
            self._offset = self._last * 1e-9 - time
        self._at = time
        self._last = max(round((time + self._offset) * 1e9), self._last + 1)
        return self._last

    def _went_back(self, received: float) -> bool:
        """Handle a simulated ROS time that begins again, and its stamps."""
        if round(received * 1e9) >= self._last:
            return False
        self._last = 0
        return True
