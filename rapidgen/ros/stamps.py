"""Moments of the controller's clock as ROS time.

A message is stamped with when the robot was there, not with when it came: spacing is the
controller's, whatever the network does to it.
"""

_DRIFT = 1e-4
"""How much faster than the controller's clock this one may be: what the offset may grow by."""


class Stamps:
    """ROS time of a controller's moments: never backwards, never later than it was received.

    The offset between the clocks is the least that was seen (a message that was on its way
    shortest), and may grow by the drift of two quartzes.
    """

    def __init__(self) -> None:
        self._offset: float | None = None
        self._at = 0.0
        self._last = 0

    def stamp(self, time: float, received: float) -> int:
        """ns of ROS time, for `time` s of the controller's clock that came at `received` s of
        ROS time. A clock that went back (a restart, a lap, a simulation begun anew) is taken as
        a new one."""
        offset = received - time
        if self._offset is None or time < self._at or self._went_back(received):
            self._offset = offset
        else:
            self._offset = min(offset, self._offset + _DRIFT * (time - self._at))
        self._at = time
        stamp = round((time + self._offset) * 1e9)
        self._last = max(stamp, self._last + 1)
        return self._last

    def _went_back(self, received: float) -> bool:
        """ROS time may be simulated: where it begins again, stamps do."""
        if round(received * 1e9) >= self._last:
            return False
        self._last = 0
        return True
