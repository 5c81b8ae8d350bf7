"""Messages between server and page about the network.

Connections, their data, and injected faults.
"""

from typing import Literal

from rapidgen.viewer.message_base import MessageModel

Ailment = Literal["well", "delay", "split", "slow", "silent", "half-open"]


class ShownSocket(MessageModel):
    """A socket of a task. Addresses are empty if there are none."""

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
    """A frame of simple_message, or other bytes.

    `way` is seen from the program.
    """

    time: float
    way: Literal["open", "in", "out", "close"]
    task: str
    local: str
    peer: str
    name: str
    """Name of the message; empty: no frame."""
    text: str
    fault: bool = False
    """True if the bytes are not a valid frame."""


class Conversation(MessageModel):
    """Data of sockets, oldest first; only while a viewer listens."""

    type: Literal["conversation"] = "conversation"
    listening: bool
    lines: tuple[SocketLogLine, ...]
    missed: int = 0
    """Number of earlier lines that were dropped."""
    fresh: bool = False
    """True if the lines are older than the request."""


# -- from the page --------------------------------------------------------------------------------


class ResetConnection(MessageModel):
    """Cut a connection: the task's socket and its peer are reset."""

    do: Literal["cut"] = "cut"
    number: int


class InjectFault(MessageModel):
    """Make a connection slow, silent and so on from now on."""

    do: Literal["afflict"] = "afflict"
    number: int
    ailment: Ailment


class Listen(MessageModel):
    """Start or stop sending the data of sockets."""

    do: Literal["listen"] = "listen"
    on: bool
