"""The methods under RAPID's socket built-ins; none of them ever waits.

Whoever has to wait does so on `Endpoint.changed`, which is notified whenever a method may now
answer otherwise: data, room to send, a client to accept, a connection made, refused or lost.
Two implementations: `memory.py` (virtual clock) and `system.py` (the operating system's
sockets); `faulty.py` puts a fault plan before either.
"""

from abc import ABC, abstractmethod

from rapidgen._compat import StrEnum
from rapidgen.machine.scheduler import WaitSet

SocketAddress = tuple[str, int]

BUFFER = 65_536
"""Bytes that one direction of a connection holds before its sender has to wait."""


class NetworkReason(StrEnum):
    """Why a network method failed."""

    ADDRESS_IN_USE = "address in use"
    ADDRESS_INVALID = "address invalid"
    UNREACHABLE = "network unreachable"
    REFUSED = "connection refused"
    RESET = "connection reset"
    CLOSED = "connection closed"
    FAILED = "failed"


class NetworkFault(Exception):
    """A network method failed for good; the text is for the log."""

    def __init__(self, reason: NetworkReason, text: str = "") -> None:
        super().__init__(text or reason.value)
        self.reason = reason


class Endpoint:
    """One end: a listener, one side of a connection, or a datagram socket.

    `connected` is False while a connect is under way. `sender` is where the last datagram
    came from.
    """

    __slots__ = ("changed", "closed", "connected", "fault", "local", "peer", "sender")

    def __init__(self, local: SocketAddress, peer: SocketAddress | None = None) -> None:
        self.local = local
        self.peer = peer
        self.connected = False
        self.closed = False
        self.fault: NetworkFault | None = None
        """Why it cannot be used any more."""
        self.sender: SocketAddress | None = None
        self.changed = WaitSet()

    def check(self) -> None:
        """NetworkFault when it cannot be used any more."""
        if self.fault is not None:
            raise self.fault
        if self.closed:
            raise NetworkFault(NetworkReason.CLOSED)


def taken(buffer: bytearray, count: int, *, exact: bool, peek: bool) -> bytes | None:
    """What `Network.receive` gives of the bytes that are there; None: not enough."""
    if not buffer or (exact and len(buffer) < count):
        return None
    data = bytes(buffer[:count])
    if not peek:
        del buffer[:count]
    return data


class Network(ABC):
    """What a socket built-in can ask for. Every method returns at once; NetworkFault otherwise."""

    def __init__(self) -> None:
        self.address = "127.0.0.1"
        """The controller's LAN address, as GetSysInfo tells it."""
        self.listeners: dict[int, SocketAddress] = {}
        """Port that the program asked for: where its clients find it, for all that listen now."""
        self.listening = WaitSet()
        """Notified when `listeners` changes."""

    @abstractmethod
    def bind(self, host: str, port: int, *, datagram: bool = False) -> Endpoint:
        """Take a port. Port 0 takes any free one; `Endpoint.local` tells which."""

    @abstractmethod
    def listen(self, endpoint: Endpoint) -> None:
        """Let clients connect to a bound endpoint."""

    @abstractmethod
    def accept(self, endpoint: Endpoint) -> Endpoint | None:
        """The next client of a listener, or None when there is none yet."""

    @abstractmethod
    def connect(self, host: str, port: int) -> Endpoint:
        """Begin to connect; `connected` turns True, or `receive` and `send` raise the fault."""

    @abstractmethod
    def send(self, endpoint: Endpoint, data: bytes, to: SocketAddress | None = None) -> int:
        """Take as much of `data` as there is room for; the number of bytes taken, 0 for none."""

    @abstractmethod
    def receive(
        self, endpoint: Endpoint, count: int, *, exact: bool = False, peek: bool = False
    ) -> bytes | None:
        """Up to `count` bytes; None when there is nothing yet, b"" when the peer has ended.

        `exact`: `count` bytes (at most `BUFFER`) or nothing; what there is stays for the next
        call. `peek`: the bytes stay. A datagram endpoint gives one datagram, cut to `count`.
        """

    @abstractmethod
    def close(self, endpoint: Endpoint, *, abort: bool = False) -> None:
        """Give an endpoint back; what was sent is still delivered, with `abort` it is not."""

    @abstractmethod
    def shut_down(self) -> None:
        """Close everything: the controller is going away."""
