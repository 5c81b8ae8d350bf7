"""TCP and UDP on the virtual clock, in memory.

Segments, 64 kB buffers, back-pressure, FIN, RST and silence are simulated. One machine with one
range of ports, as on a loopback interface: controller and clients connect by port number alone. A
connection is two pipes. Bytes travel in segments of at most `MSS` that arrive in order, `latency`
nanoseconds after they were sent. (Bytes are never lost: an interrupted connection becomes silent,
as TCP without acknowledgements: the sender's buffer fills.)
"""

from collections import deque
from functools import partial

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

MSS = 1460
LATENCY = 100_000
BACKLOG = 16
"""Connections that wait for accept; a listener ignores further ones until then."""
_FIRST_EPHEMERAL = 49_152
_LAST_PORT = 65_535


class _Pipe:
    """A direction of a connection, from `sender` to `receiver`."""

    __slots__ = (
        "arrived",
        "ended",
        "finished",
        "flying",
        "receiver",
        "sender",
        "silent",
        "waiting",
    )

    def __init__(self, sender: "MemoryEndpoint", receiver: "MemoryEndpoint") -> None:
        self.sender = sender
        self.receiver = receiver
        self.waiting = bytearray()
        """Written and not yet sent."""
        self.flying = 0
        self.arrived = bytearray()
        """Arrived and not yet read."""
        self.ended = False
        """The sender has closed: FIN follows the last byte."""
        self.finished = False
        """FIN has arrived."""
        self.silent = False
        """No data pass any more, without notification; written data stay in `waiting`."""


class MemoryEndpoint(Endpoint):
    """An endpoint in memory, used through the network's methods."""

    __slots__ = ("backlog", "datagrams", "incoming", "listening", "outgoing")

    def __init__(self, local: SocketAddress, peer: SocketAddress | None = None) -> None:
        super().__init__(local, peer)
        self.listening = False
        self.backlog: deque[MemoryEndpoint] = deque()
        self.datagrams: deque[tuple[SocketAddress, bytes]] | None = None
        self.incoming: _Pipe | None = None
        self.outgoing: _Pipe | None = None


class MemoryNetwork(Network):
    """All endpoints of one scheduler."""

    def __init__(self, scheduler: Scheduler, *, latency: int = LATENCY) -> None:
        super().__init__()
        self._scheduler = scheduler
        self._latency = latency
        self._ports: dict[tuple[bool, int], MemoryEndpoint] = {}
        self._open: dict[MemoryEndpoint, None] = {}

    # -- the six methods --------------------------------------------------------------------

    def bind(self, host: str, port: int, *, datagram: bool = False) -> MemoryEndpoint:
        """See `Network.bind`."""
        if port == 0:
            port = self._free_port(datagram)
        elif not 0 < port <= _LAST_PORT:
            raise NetworkFault(NetworkReason.ADDRESS_INVALID, f"port {port}")
        if (datagram, port) in self._ports:
            raise NetworkFault(NetworkReason.ADDRESS_IN_USE, f"port {port}")
        endpoint = MemoryEndpoint((host, port))
        if datagram:
            endpoint.datagrams = deque()
            endpoint.connected = True
        self._ports[datagram, port] = endpoint
        self._open[endpoint] = None
        return endpoint

    def listen(self, endpoint: Endpoint) -> None:
        """See `Network.listen`."""
        own = _mine(endpoint)
        own.listening = True
        self.listeners[own.local[1]] = own.local
        self.listening.notify()

    def accept(self, endpoint: Endpoint) -> MemoryEndpoint | None:
        """See `Network.accept`."""
        own = _mine(endpoint)
        own.check()
        return own.backlog.popleft() if own.backlog else None

    def connect(self, host: str, port: int) -> MemoryEndpoint:
        """See `Network.connect`."""
        if not 0 < port <= _LAST_PORT:
            raise NetworkFault(NetworkReason.ADDRESS_INVALID, f"port {port}")
        client = MemoryEndpoint((host, self._free_port(False)), (host, port))
        self._open[client] = None
        self._scheduler.after(self._latency, lambda: self._answer(client, port))
        return client

    def send(self, endpoint: Endpoint, data: bytes, to: SocketAddress | None = None) -> int:
        """See `Network.send`."""
        own = _mine(endpoint)
        own.check()
        if own.datagrams is not None:
            return self._send_datagram(own, data, to)
        pipe = own.outgoing
        if pipe is None:
            return 0
        free = BUFFER - len(pipe.waiting)
        sent = data[:free]
        pipe.waiting += sent
        self._pump(pipe)
        return len(sent)

    def receive(
        self, endpoint: Endpoint, count: int, *, exact: bool = False, peek: bool = False
    ) -> bytes | None:
        """See `Network.receive`."""
        own = _mine(endpoint)
        if own.datagrams is not None:
            return _take_datagram(own, count, peek=peek)
        pipe = own.incoming
        data = taken(pipe.arrived, count, exact=exact, peek=peek) if pipe is not None else None
        if pipe is not None and data is not None:
            if not peek:
                self._pump(pipe)
            return data
        own.check()
        if pipe is not None and pipe.finished:
            return b""
        return None

    def close(self, endpoint: Endpoint, *, abort: bool = False) -> None:
        """See `Network.close`; unread bytes cause a reset, as with TCP."""
        own = _mine(endpoint)
        if own.closed:
            return
        own.closed = True
        self._open.pop(own, None)
        for key, bound in tuple(self._ports.items()):
            if bound is own:
                del self._ports[key]
        if own.listening:
            self.listeners.pop(own.local[1], None)
            self.listening.notify()
        for client in own.backlog:
            self.close(client, abort=True)
        own.backlog.clear()
        pipe = own.outgoing
        if pipe is not None:
            unread = own.incoming is not None and bool(own.incoming.arrived)
            if abort or unread:
                self._reset_peer(pipe)
            else:
                pipe.ended = True
                self._pump(pipe)
        own.changed.notify()

    def shut_down(self) -> None:
        """See `Network.shut_down`."""
        for endpoint in tuple(self._open):
            self.close(endpoint, abort=True)

    # -- for tests and fault plans ----------------------------------------------------------

    def silence(self, endpoint: Endpoint) -> None:
        """Silence a connection: no data pass in either direction."""
        own = _mine(endpoint)
        for pipe in (own.incoming, own.outgoing):
            if pipe is not None:
                pipe.silent = True

    def reset(self, endpoint: Endpoint) -> None:
        """Break a connection with RST; both sides are notified."""
        own = _mine(endpoint)
        for pipe in (own.incoming, own.outgoing):
            if pipe is not None:
                self._reset_peer(pipe)

    # -- inside -----------------------------------------------------------------------------

    def _free_port(self, datagram: bool) -> int:
        used = {endpoint.local[1] for endpoint in self._open}
        for port in range(_FIRST_EPHEMERAL, _LAST_PORT + 1):
            if port not in used and (datagram, port) not in self._ports:
                return port
        raise NetworkFault(NetworkReason.ADDRESS_IN_USE, "no free port")

    def _answer(self, client: MemoryEndpoint, port: int) -> None:
        if client.closed:
            return
        listener = self._ports.get((False, port))
        if listener is None or not listener.listening:
            self._fail(client, NetworkFault(NetworkReason.REFUSED, f"port {port}"))
            return
        if len(listener.backlog) >= BACKLOG:
            # The connection request is repeated until the backlog has space, as in TCP.
            self._scheduler.after(1_000_000_000, lambda: self._answer(client, port))
            return
        server = MemoryEndpoint(listener.local, client.local)
        self._open[server] = None
        forth, back = _Pipe(client, server), _Pipe(server, client)
        client.outgoing = server.incoming = forth
        client.incoming = server.outgoing = back
        client.connected = server.connected = True
        listener.backlog.append(server)
        client.changed.notify()
        listener.changed.notify()

    def _pump(self, pipe: _Pipe) -> None:
        if pipe.silent:
            return
        had_space = len(pipe.waiting) < BUFFER
        while pipe.waiting:
            window = BUFFER - len(pipe.arrived) - pipe.flying
            size = min(MSS, window, len(pipe.waiting))
            if size <= 0:
                break
            segment = bytes(pipe.waiting[:size])
            del pipe.waiting[:size]
            pipe.flying += size
            self._scheduler.after(self._latency, partial(self._arrive, pipe, segment))
        if not pipe.waiting and pipe.ended and not pipe.finished:
            self._scheduler.after(self._latency, lambda: self._finish(pipe))
        if not had_space and len(pipe.waiting) < BUFFER:
            pipe.sender.changed.notify()

    def _arrive(self, pipe: _Pipe, segment: bytes) -> None:
        if pipe.silent:
            return
        pipe.flying -= len(segment)
        if pipe.receiver.closed:
            # The receiver no longer exists: the sender gets a reset.
            if not pipe.sender.closed:
                self._fail(pipe.sender, NetworkFault(NetworkReason.RESET))
            return
        pipe.arrived += segment
        pipe.receiver.changed.notify()

    def _finish(self, pipe: _Pipe) -> None:
        if not pipe.silent and not pipe.finished:
            pipe.finished = True
            pipe.receiver.changed.notify()

    def _reset_peer(self, pipe: _Pipe) -> None:
        pipe.waiting.clear()

        def arrive() -> None:
            if not pipe.silent and not pipe.receiver.closed:
                self._fail(pipe.receiver, NetworkFault(NetworkReason.RESET))

        self._scheduler.after(self._latency, arrive)

    @staticmethod
    def _fail(endpoint: MemoryEndpoint, fault: NetworkFault) -> None:
        if endpoint.fault is None:
            endpoint.fault = fault
            endpoint.changed.notify()

    def _send_datagram(self, own: MemoryEndpoint, data: bytes, to: SocketAddress | None) -> int:
        if to is None:
            raise NetworkFault(NetworkReason.FAILED, "a datagram needs an address")
        _, port = to

        def arrive() -> None:
            target = self._ports.get((True, port))
            if target is None or target.datagrams is None:
                return
            if sum(len(d) for _, d in target.datagrams) + len(data) <= BUFFER:
                target.datagrams.append((own.local, data))
                target.changed.notify()

        self._scheduler.after(self._latency, arrive)
        return len(data)


def _mine(endpoint: Endpoint) -> MemoryEndpoint:
    if not isinstance(endpoint, MemoryEndpoint):
        raise TypeError("an endpoint of another network")
    return endpoint


def _take_datagram(own: MemoryEndpoint, count: int, *, peek: bool) -> bytes | None:
    if not own.datagrams:
        own.check()
        return None
    sender, data = own.datagrams[0] if peek else own.datagrams.popleft()
    own.sender = sender
    return data[:count]
