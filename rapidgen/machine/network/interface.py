"""Interface of RAPID's socket built-ins; no method waits.

A waiting task uses `Endpoint.changed`, which is notified when a method may return another result:
data, free buffer space, a client to accept, a connection established, rejected or lost.
Implementations: `memory.py` (virtual clock) and `system.py` (the operating system's sockets);
`fault_injection.py` adds a fault plan to either.
"""

from abc import ABC, abstractmethod

from rapidgen._compat import StrEnum
from rapidgen.machine.scheduler import WaitSet

SocketAddress = tuple[str, int]

BUFFER = 65_536
"""Bytes in one direction of a connection before its sender waits."""


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
    """A method failed permanently; the text is for the log."""

    def __init__(self, reason: NetworkReason, text: str = "") -> None:
        super().__init__(text or reason.value)
        self.reason = reason


class Endpoint:
    """An end: a listener, a side of a connection, or a datagram socket.

    `connected` is False during a connect. `sender` is the source of the last datagram.
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
        """Raise NetworkFault if the endpoint is no longer usable."""
        if self.fault is not None:
            raise self.fault
        if self.closed:
            raise NetworkFault(NetworkReason.CLOSED)


def taken(buffer: bytearray, count: int, *, exact: bool, peek: bool) -> bytes | None:
    """Return the bytes for `Network.receive`, None for too few."""
    if not buffer or (exact and len(buffer) < count):
        return None
    data = bytes(buffer[:count])
    if not peek:
        del buffer[:count]
    return data


class Network(ABC):
    """Operations of socket built-ins.

    Every method returns at once or raises NetworkFault.
    """

    def __init__(self) -> None:
        self.address = "127.0.0.1"
        """The controller's LAN address, for GetSysInfo."""
        self.listeners: dict[int, SocketAddress] = {}
        """Port of the program to actual address, for all listeners."""
        self.listening = WaitSet()
        """Notified when `listeners` changes."""

    @abstractmethod
    def bind(self, host: str, port: int, *, datagram: bool = False) -> Endpoint:
        """Bind a port; port 0 means any free one (`Endpoint.local`)."""

    @abstractmethod
    def listen(self, endpoint: Endpoint) -> None:
        """Let clients connect to a bound endpoint."""

    @abstractmethod
    def accept(self, endpoint: Endpoint) -> Endpoint | None:
        """Return the next client of a listener, None without one."""

    @abstractmethod
    def connect(self, host: str, port: int) -> Endpoint:
        """Begin to connect.

        `connected` becomes True, or `receive` and `send` raise the fault.
        """

    @abstractmethod
    def send(self, endpoint: Endpoint, data: bytes, to: SocketAddress | None = None) -> int:
        """Take as much of `data` as the buffer can store.

        Returns the number of bytes, 0 for none.
        """

    @abstractmethod
    def receive(
        self, endpoint: Endpoint, count: int, *, exact: bool = False, peek: bool = False
    ) -> bytes | None:
        """Return up to `count` bytes, None without data, b"" at the end.

        `exact`: `count` bytes (at most `BUFFER`) or None, which leaves the bytes. `peek`: the bytes
        stay. A datagram endpoint returns one datagram, cut to `count`.
        """

    @abstractmethod
    def close(self, endpoint: Endpoint, *, abort: bool = False) -> None:
        """Release an endpoint; sent data are delivered unless `abort`."""

    @abstractmethod
    def shut_down(self) -> None:
        """Close all endpoints at the end of the controller."""
