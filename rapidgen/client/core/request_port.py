"""A connection on which requests are answered, those of one type in their order. Sans-IO."""

from collections import deque
from dataclasses import dataclass, field

from rapidgen.wire.simple_message import FrameSplitter
from rapidgen.wire.simple_message.declaration import Content


@dataclass(slots=True, eq=False)
class PendingReply:
    """A request that waits for its reply."""

    number: int
    reply: Content | None = None


@dataclass(slots=True)
class RequestPort:
    """What is under way on one connection."""

    splitter: FrameSplitter = field(default_factory=FrameSplitter)
    pending: deque[PendingReply] = field(default_factory=deque)
    is_open: bool = False

    def request(self, number: int) -> PendingReply:
        """Expect a reply of this message type."""
        waiting = PendingReply(number)
        self.pending.append(waiting)
        return waiting

    def answered(self, number: int, reply: Content) -> bool:
        """Give a reply to the oldest request of its type; False when there is none."""
        for waiting in self.pending:
            if waiting.number == number:
                waiting.reply = reply
                self.pending.remove(waiting)
                return True
        return False
