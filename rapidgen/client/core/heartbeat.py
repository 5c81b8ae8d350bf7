"""Schedule of the client's heartbeats during a motion. Sans-IO.

The first heartbeat of a motion arms the controller: it stops the robot if the next one does not
arrive within the time-out that each carries. A time-out of 0 at the end of the motion disarms it.
After `forget` (a lost connection, a failed motion) no heartbeat follows, so an armed controller
stops the robot by itself.
"""

from rapidgen.client.core.request_port import PendingReply
from rapidgen.wire.simple_message import messages

_OFTEN = 4
"""Heartbeats within the controller's time-out, ..."""
_PERIOD = 0.5
"""... and at most so many s apart: a simulated clock may run faster."""


class HeartbeatSchedule:
    """Heartbeats from the start of a motion to its end.

    The controller stops the robot when one is late. At most one is unanswered, so that a controller
    that does not read is not sent more.
    """

    def __init__(self, timeout: float) -> None:
        """`timeout` s until the controller stops the robot; 0: no heartbeats."""
        self.timeout = timeout
        self._sent = 0.0
        self._in_force = False
        self._pending: PendingReply | None = None

    def forget(self) -> None:
        """Forget awaited answers of a closed or new connection.

        A controller that still awaits a heartbeat stops the robot, as intended.
        """
        self._in_force = False
        self._pending = None

    @property
    def is_armed(self) -> bool:
        """True if the controller expects another heartbeat."""
        return self._in_force

    def due(self, now: float, *, moves: bool) -> float | None:
        """Return the time-out to send now, or None.

        0 announces that no heartbeat follows.
        """
        if self.timeout <= 0 or self._is_waiting:
            return None
        if not moves:
            return 0.0 if self._in_force else None
        if self._in_force and now - self._sent < min(self.timeout / _OFTEN, _PERIOD):
            return None
        return self.timeout

    def sent(self, now: float, timeout: float, pending: PendingReply) -> None:
        """Record that a heartbeat was sent."""
        self._sent = now
        self._in_force = timeout > 0
        self._pending = pending

    def is_late(self, now: float, listening: float) -> bool:
        """True if the controller stopped answering a client that reads."""
        return self._is_waiting and now - max(self._sent, listening) > self.timeout

    @property
    def is_refused(self) -> bool:
        """True if the controller refused the last heartbeat."""
        reply = self._pending.reply if self._pending is not None else None
        return reply is not None and not isinstance(reply, messages.HeartbeatReply)

    @property
    def _is_waiting(self) -> bool:
        return self._pending is not None and self._pending.reply is None
