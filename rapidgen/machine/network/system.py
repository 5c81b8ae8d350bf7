"""Sockets of the operating system, non-blocking, with a selector.

The default is loopback. A controller with a loopback host cannot be reached from another machine
and does not connect to one; every address that a program binds or connects to becomes this host.
Ports may be mapped, so that many controllers run on one machine.
"""

import errno
import ipaddress
import selectors
import socket
import struct
from typing import Literal

from rapidgen.machine.network.interface import (
    BUFFER,
    Endpoint,
    Network,
    NetworkFault,
    NetworkReason,
    SocketAddress,
    taken,
)
from rapidgen.machine.scheduler import Scheduler

PortMap = int | Literal["auto"]
"""Added to every port, or "auto": any free port."""

_LAST_PORT = 65_535
_BACKLOG = 16
_READ = selectors.EVENT_READ
_WRITE = selectors.EVENT_WRITE
_REASONS = {
    errno.EADDRINUSE: NetworkReason.ADDRESS_IN_USE,
    errno.EADDRNOTAVAIL: NetworkReason.ADDRESS_INVALID,
    errno.EACCES: NetworkReason.ADDRESS_INVALID,
    errno.ECONNREFUSED: NetworkReason.REFUSED,
    errno.ECONNRESET: NetworkReason.RESET,
    errno.ECONNABORTED: NetworkReason.RESET,
    errno.EPIPE: NetworkReason.RESET,
    errno.ETIMEDOUT: NetworkReason.RESET,
    errno.ENETUNREACH: NetworkReason.UNREACHABLE,
    errno.EHOSTUNREACH: NetworkReason.UNREACHABLE,
}


class SystemEndpoint(Endpoint):
    """An endpoint with a socket of the operating system."""

    __slots__ = ("buffer", "datagram", "ended", "interest", "port", "socket")

    def __init__(
        self,
        own: socket.socket,
        local: SocketAddress,
        peer: SocketAddress | None = None,
        *,
        port: int = 0,
    ) -> None:
        super().__init__(local, peer)
        self.socket = own
        self.port = port
        """Port of the program, before mapping."""
        self.datagram = own.type == socket.SOCK_DGRAM
        self.interest = 0
        self.buffer = bytearray()
        self.ended = False


class SystemNetwork(Network):
    """Sockets on `host`, for a scheduler on the real clock."""

    def __init__(
        self, scheduler: Scheduler, *, host: str = "127.0.0.1", ports: PortMap = 0
    ) -> None:
        super().__init__()
        self.address = host
        self._scheduler = scheduler
        self._host = host
        self._loopback = ipaddress.IPv4Address(host).is_loopback
        self._map = ports
        self._actual: dict[tuple[bool, int], int] = {}
        self._open: dict[SystemEndpoint, None] = {}

    # -- the six methods --------------------------------------------------------------------

    def bind(self, host: str, port: int, *, datagram: bool = False) -> SystemEndpoint:
        """See `Network.bind`; any local address becomes the host's."""
        _check_address(host)
        if any(e.port == port != 0 and e.datagram == datagram for e in self._open):
            raise NetworkFault(NetworkReason.ADDRESS_IN_USE, f"port {port}")
        place = self._place(port, datagram)
        own = _new_socket(datagram)
        try:
            if not datagram:
                own.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            own.bind((self._host, place))
        except OSError as error:
            own.close()
            raise _fault(error) from error
        local: SocketAddress = own.getsockname()[:2]
        self._actual[datagram, port] = local[1]
        endpoint = SystemEndpoint(own, local, port=port)
        endpoint.connected = datagram
        self._open[endpoint] = None
        return endpoint

    def listen(self, endpoint: Endpoint) -> None:
        """See `Network.listen`."""
        own = _mine(endpoint)
        try:
            own.socket.listen(_BACKLOG)
        except OSError as error:
            raise _fault(error) from error
        self.listeners[own.port] = own.local
        self.listening.notify()

    def accept(self, endpoint: Endpoint) -> SystemEndpoint | None:
        """See `Network.accept`."""
        own = _mine(endpoint)
        own.check()
        try:
            client, peer = own.socket.accept()
        except BlockingIOError:
            self._want(own, _READ)
            return None
        except OSError as error:
            raise _fault(error) from error
        _prepare(client)
        accepted = SystemEndpoint(client, client.getsockname()[:2], peer[:2])
        accepted.connected = True
        self._open[accepted] = None
        return accepted

    def connect(self, host: str, port: int) -> SystemEndpoint:
        """See `Network.connect`."""
        _check_address(host)
        target = self._outward(host, port, datagram=False)
        own = _new_socket(datagram=False)
        code = own.connect_ex(target)
        if code not in (0, errno.EINPROGRESS):
            own.close()
            raise _fault(OSError(code, "connect"))
        endpoint = SystemEndpoint(own, own.getsockname()[:2], (host, port))
        self._open[endpoint] = None
        self._want(endpoint, _WRITE)
        return endpoint

    def send(self, endpoint: Endpoint, data: bytes, to: SocketAddress | None = None) -> int:
        """See `Network.send`."""
        own = _mine(endpoint)
        own.check()
        if not own.connected:
            return 0
        try:
            if own.datagram:
                if to is None:
                    raise NetworkFault(NetworkReason.FAILED, "a datagram needs an address")
                _check_address(to[0])
                return own.socket.sendto(data, self._outward(*to, datagram=True))
            return own.socket.send(data)
        except BlockingIOError:
            self._want(own, _WRITE)
            return 0
        except OSError as error:
            own.fault = _fault(error)
            raise own.fault from error

    def receive(
        self, endpoint: Endpoint, count: int, *, exact: bool = False, peek: bool = False
    ) -> bytes | None:
        """See `Network.receive`."""
        own = _mine(endpoint)
        if own.datagram:
            return self._receive_datagram(own, count, peek=peek)
        self._fill(own, count)
        data = taken(own.buffer, count, exact=exact, peek=peek)
        if data is not None:
            return data
        own.check()
        if own.ended:
            return b""
        if own.connected:
            self._want(own, _READ)
        return None

    def close(self, endpoint: Endpoint, *, abort: bool = False) -> None:
        """See `Network.close`."""
        own = _mine(endpoint)
        if own.closed:
            return
        own.closed = True
        self._open.pop(own, None)
        if own.interest:
            self._scheduler.selector.unregister(own.socket)
            own.interest = 0
        # As TCP does by itself for bytes that we have not taken from it yet.
        if abort or own.buffer:
            own.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        own.socket.close()
        if self.listeners.get(own.port) == own.local and not own.peer:
            del self.listeners[own.port]
            self.listening.notify()
        own.changed.notify()

    def shut_down(self) -> None:
        """See `Network.shut_down`."""
        for endpoint in tuple(self._open):
            self.close(endpoint)

    # -- inside -----------------------------------------------------------------------------

    def _place(self, port: int, datagram: bool) -> int:
        if port == 0:
            return 0
        if not 0 < port <= _LAST_PORT:
            raise NetworkFault(NetworkReason.ADDRESS_INVALID, f"port {port}")
        if self._map == "auto":
            # A server that closes and reopens keeps its port.
            return self._actual.get((datagram, port), 0)
        if port + self._map > _LAST_PORT:
            raise NetworkFault(NetworkReason.ADDRESS_INVALID, f"port {port} + {self._map}")
        return port + self._map

    def _outward(self, host: str, port: int, *, datagram: bool) -> SocketAddress:
        if not 0 < port <= _LAST_PORT:
            raise NetworkFault(NetworkReason.ADDRESS_INVALID, f"port {port}")
        if not self._loopback:
            return host, port
        return self._host, self._actual.get((datagram, port), port)

    def _fill(self, own: SystemEndpoint, count: int) -> None:
        expected = min(count, BUFFER)
        while len(own.buffer) < expected and own.connected and not (own.ended or own.closed):
            if own.fault is not None:
                return
            try:
                data = own.socket.recv(expected - len(own.buffer))
            except BlockingIOError:
                return
            except OSError as error:
                own.fault = _fault(error)
                return
            if data:
                own.buffer += data
            else:
                own.ended = True

    def _receive_datagram(self, own: SystemEndpoint, count: int, *, peek: bool) -> bytes | None:
        own.check()
        try:
            data, sender = own.socket.recvfrom(BUFFER, socket.MSG_PEEK if peek else 0)
        except BlockingIOError:
            self._want(own, _READ)
            return None
        except OSError as error:
            raise _fault(error) from error
        own.sender = sender[:2]
        return data[:count]

    def _want(self, own: SystemEndpoint, event: int) -> None:
        """Request one notification of `event`; avoids wake-ups without a waiter."""
        if own.interest & event:
            return
        if own.interest:
            own.interest |= event
            self._scheduler.selector.modify(own.socket, own.interest, lambda m: self._ready(own, m))
        else:
            own.interest = event
            self._scheduler.selector.register(own.socket, event, lambda m: self._ready(own, m))

    def _ready(self, own: SystemEndpoint, mask: int) -> None:
        if own.closed or not own.interest:
            return
        own.interest &= ~mask
        if own.interest:
            self._scheduler.selector.modify(own.socket, own.interest, lambda m: self._ready(own, m))
        else:
            self._scheduler.selector.unregister(own.socket)
        if own.peer is not None and not own.connected and own.fault is None:
            code = own.socket.getsockopt(socket.SOL_SOCKET, socket.SO_ERROR)
            if code:
                own.fault = _fault(OSError(code, "connect"))
            else:
                own.connected = True
        own.changed.notify()


def _new_socket(datagram: bool) -> socket.socket:
    kind = socket.SOCK_DGRAM if datagram else socket.SOCK_STREAM
    try:
        own = socket.socket(socket.AF_INET, kind)
    except OSError as error:
        raise _fault(error) from error
    if datagram:
        own.setblocking(False)
        own.setsockopt(socket.SOL_SOCKET, socket.SO_BROADCAST, 1)
    else:
        _prepare(own)
    return own


def _prepare(own: socket.socket) -> None:
    own.setblocking(False)
    own.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    own.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, BUFFER)


def _check_address(host: str) -> None:
    try:
        ipaddress.IPv4Address(host)
    except ValueError as error:
        raise NetworkFault(NetworkReason.ADDRESS_INVALID, f"'{host}' is no IPv4 address") from error


def _mine(endpoint: Endpoint) -> SystemEndpoint:
    if not isinstance(endpoint, SystemEndpoint):
        raise TypeError("an endpoint of another network")
    return endpoint


def _fault(error: OSError) -> NetworkFault:
    return NetworkFault(_REASONS.get(error.errno or 0, NetworkReason.FAILED), str(error))
