"""Queues of clients (DIPC), part of the application's state."""

from collections import deque
from dataclasses import dataclass, field
from typing import Final

from rapidgen.runtime.queues import Queue
from rapidgen.runtime.text import literal_text

MESSAGE_KINDS: Final = ("IPC_SEND", "IPC_PACKAGE")
"""Kinds of messages, by `dipc-msgtype`."""


@dataclass(frozen=True, slots=True)
class ClientText:
    """Message from one client to another."""

    sender: str
    data: str
    command: str
    user: str
    kind: str


@dataclass(slots=True, eq=False)
class ClientQueue:
    """A queue that a client has made; tasks put their answers into `queue`."""

    name: str
    queue: Queue
    texts: deque[ClientText] = field(default_factory=deque)

    def __len__(self) -> int:
        return len(self.texts) + len(self.queue.messages)

    def take(self) -> ClientText | None:
        """Remove and return the first message; None if the queue is empty."""
        if self.texts:
            return self.texts.popleft()
        if not self.queue.messages:
            return None
        message = self.queue.messages.popleft()
        data = f"{message.type.name};{literal_text(message.value, message.type)}"
        return ClientText(message.sender, data, "0", f"{message.user:g}", MESSAGE_KINDS[1])
