"""A connection whose requests are answered in order within a type.

Sans-IO.
"""

from collections import deque
from dataclasses import dataclass, field

from rapidgen.wire.simple_message import FrameSplitter, messages
from rapidgen.wire.simple_message.declaration import Content


@dataclass(slots=True, eq=False)
class PendingReply:
    """A request that awaits its reply."""

    number: int
    reply: Content | None = None
    is_stop: bool = False


@dataclass(slots=True)
class RequestPort:
    """Pending requests of one connection."""

    splitter: FrameSplitter = field(default_factory=FrameSplitter)
    pending: deque[PendingReply] = field(default_factory=deque)
    is_open: bool = False

    def request(self, number: int, *, is_stop: bool = False) -> PendingReply:
        """Expect a reply of this message type; `is_stop`: to a STOP."""
        waiting = PendingReply(number, is_stop=is_stop)
        self.pending.append(waiting)
        return waiting

    def forget_orders(self) -> None:
        """Drop the awaited replies except those to STOP."""
        self.pending = deque(waiting for waiting in self.pending if waiting.is_stop)

    def answered(self, number: int, reply: Content, *, orders_have_data: bool) -> bool:
        """Assign a reply to the oldest matching request; False if none matches.

        An answer may be lost: a STOP never matches the reply to a trajectory, and where the driver
        answers an order with data, a bare reply belongs to a STOP.
        """
        of_order = isinstance(reply, messages.Accepted | messages.Refused)
        stops = any(waiting.is_stop for waiting in self.pending)
        of_stop = stops and orders_have_data and isinstance(reply, messages.Acknowledged)
        for waiting in self.pending:
            fits = not (waiting.is_stop and of_order) and (waiting.is_stop or not of_stop)
            if waiting.number == number and fits:
                waiting.reply = reply
                self.pending.remove(waiting)
                return True
        return False
