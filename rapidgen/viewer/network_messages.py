"""What server and page say about the network: who is connected, what is said, what goes wrong."""

from typing import Literal

from rapidgen.viewer.message_base import MessageModel

Ailment = Literal["well", "delay", "split", "slow", "silent", "half-open"]


class ShownSocket(MessageModel):
    """A socket of a task. Addresses are empty where there is none."""

    number: int
    task: str
    status: str
    local: str
    peer: str
    ailment: Ailment = "well"


class Connections(MessageModel):
    """All sockets in use."""

    type: Literal["connections"] = "connections"
    sockets: tuple[ShownSocket, ...]


class SocketLogLine(MessageModel):
    """A frame of simple_message, or bytes that are none; `way` is seen from the program."""

    time: float
    way: Literal["open", "in", "out", "close"]
    task: str
    local: str
    peer: str
    name: str
    """Of the message; empty: no frame."""
    text: str
    fault: bool = False
    """The bytes are no good frame."""


class Conversation(MessageModel):
    """What sockets said, oldest first; only while somebody listens."""

    type: Literal["conversation"] = "conversation"
    listening: bool
    lines: tuple[SocketLogLine, ...]
    missed: int = 0
    """Lines before these that were too many to be told."""
    fresh: bool = False
    """Those that were told before are not of this moment."""


# -- from the page --------------------------------------------------------------------------------


class ResetConnection(MessageModel):
    """Cut a connection: the task's socket is reset, and so is the other end."""

    do: Literal["cut"] = "cut"
    number: int


class InjectFault(MessageModel):
    """Let a connection be slow, silent and so on from now on."""

    do: Literal["afflict"] = "afflict"
    number: int
    ailment: Ailment


class Listen(MessageModel):
    """Tell what sockets say from now on, or no more."""

    do: Literal["listen"] = "listen"
    on: bool
