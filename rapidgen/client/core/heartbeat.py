"""When the controller must hear from this client, while something moves. Sans-IO."""

from rapidgen.client.core.request_port import PendingReply
from rapidgen.wire.simple_message import messages

_OFTEN = 4
"""Heartbeats in the time within which the controller awaits one, ..."""
_PERIOD = 0.5
"""... and s between two, at most: a simulation's clock may run faster than this one."""


class HeartbeatSchedule:
    """Begins with a motion and ends with it; the controller stops the robot when one is late.

    At most one is unanswered, so that a controller that does not read is not written to.
    """

    def __init__(self, timeout: float) -> None:
        """`timeout` s until the controller stops the robot; 0: no heartbeats at all."""
        self.timeout = timeout
        self._sent = 0.0
        self._in_force = False
        self._pending: PendingReply | None = None

    def forget(self) -> None:
        """Nothing more is awaited on this connection, or it is a new one.

        Where the controller still awaits one it stops the robot, which is then wanted.
        """
        self._in_force = False
        self._pending = None

    @property
    def is_armed(self) -> bool:
        """Whether the controller counts on the next one."""
        return self._in_force

    def due(self, now: float, *, moves: bool) -> float | None:
        """The time-out to be sent now, None: nothing. 0 tells that none will follow."""
        if self.timeout <= 0 or self._is_waiting:
            return None
        if not moves:
            return 0.0 if self._in_force else None
        if self._in_force and now - self._sent < min(self.timeout / _OFTEN, _PERIOD):
            return None
        return self.timeout

    def sent(self, now: float, timeout: float, pending: PendingReply) -> None:
        """It was."""
        self._sent = now
        self._in_force = timeout > 0
        self._pending = pending

    def is_late(self, now: float, listening: float) -> bool:
        """Whether the controller does not answer any more a client that has been listening."""
        return self._is_waiting and now - max(self._sent, listening) > self.timeout

    @property
    def is_refused(self) -> bool:
        """Whether the controller did not take the last one."""
        reply = self._pending.reply if self._pending is not None else None
        return reply is not None and not isinstance(reply, messages.HeartbeatReply)

    @property
    def _is_waiting(self) -> bool:
        return self._pending is not None and self._pending.reply is None
