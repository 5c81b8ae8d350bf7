"""SocketCreate to SocketReceiveFrom.

Sources: 3HAC16581-1 as quoted on CSDN [manual] for limits, default times and ERR_SOCK_CLOSED;
abb_driver and open_abb [code] for states and buffers. Remembered only [mem]: a send without buffer
space for 60 s raises ERR_SOCK_TIMEOUT. Open questions are dialect switches: `refused_connect`,
`failed_connect`, `receive_timeout`, `send_attends`, `sockets_limited`.
"""

from collections.abc import Callable

from rapidgen.machine.network.interface import (
    BUFFER,
    Endpoint,
    Network,
    NetworkFault,
    NetworkReason,
)
from rapidgen.machine.network.sockets import SocketDevice, SocketStatus
from rapidgen.machine.scheduler import S
from rapidgen.rapid.numbers import MAX_STRING
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.rawbytes import CAPACITY, RawBytes, byte_value, whole
from rapidgen.runtime.registry import Arguments, builtin, builtins, by_name
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value, register_type

DEFAULT_TIME = 60.0
WAIT_MAX = 9_999_999
"""A \\Time of this or more waits for ever."""
_REPEAT = 1.0
"""Seconds until a rejected connection request is repeated, as TCP does without an answer."""

register_type("socketdev", SocketDevice)

_REFUSED = {
    "unreachable": "ERR_SOCK_NET_UNREACH",
    "closed": "ERR_SOCK_CLOSED",
}
_ERRORS = {
    NetworkReason.ADDRESS_IN_USE: "ERR_SOCK_ADDR_INUSE",
    NetworkReason.ADDRESS_INVALID: "ERR_SOCK_ADDR_INVALID",
    NetworkReason.UNREACHABLE: "ERR_SOCK_NET_UNREACH",
    NetworkReason.REFUSED: "ERR_SOCK_TIMEOUT",
    NetworkReason.RESET: "ERR_SOCK_CLOSED",
    NetworkReason.CLOSED: "ERR_SOCK_CLOSED",
    NetworkReason.FAILED: "ERR_SOCK_UNSPEC",
}


def _error(fault: NetworkFault) -> RapidError:
    return RapidError(_ERRORS[fault.reason], str(fault))


def _lost(task: Task, socket: SocketDevice, fault: NetworkFault) -> RapidError:
    """Close a lost connection and return its RAPID error."""
    if fault.reason in (NetworkReason.RESET, NetworkReason.CLOSED):
        task.controller.sockets.release(socket, abort=True)
    return _error(fault)


def _seconds(time: float | None) -> float | None:
    if time is None:
        return DEFAULT_TIME
    if time < 0:
        raise RapidError("ERR_ARGVALERR", f"\\Time:={time:g}")
    return None if time >= WAIT_MAX else time


def _port(number: float) -> int:
    if number != int(number) or not 0 < number < 65_536:
        raise RapidError("ERR_SOCK_ADDR_INVALID", f"port {number:g}")
    return int(number)


def _require(socket: SocketDevice, *, udp: bool = False) -> None:
    if socket.status is SocketStatus.CLOSED:
        raise RapidError("ERR_SOCK_CLOSED")
    if socket.udp is not udp:
        raise RapidError("ERR_SOCK_UNSPEC", "TCP and UDP have instructions of their own")


def _stream(socket: SocketDevice) -> Endpoint:
    _require(socket)
    if socket.status is not SocketStatus.CONNECTED or socket.endpoint is None:
        raise RapidError("ERR_SOCK_NOT_CONN")
    return socket.endpoint


# -- making connections -----------------------------------------------------------------------


@builtin("SocketCreate", cost="socket")
def socket_create(task: Task, socket: SocketDevice, udp: bool | None) -> None:
    """Create a socket; ERR_SOCK_UNSPEC: in use, or none is left."""
    if socket.status is not SocketStatus.CLOSED:
        raise RapidError("ERR_SOCK_UNSPEC", "the socket is in use")
    table = task.controller.sockets
    if table.full:
        raise RapidError("ERR_SOCK_UNSPEC", "all sockets of the controller are in use")
    socket.udp = bool(udp)
    socket.status = SocketStatus.CREATED
    table.add(socket, task.name)


@builtin("SocketBind", cost="socket")
def socket_bind(task: Task, socket: SocketDevice, address: str, port: float) -> None:
    """Bind a socket to a port of the controller."""
    _require(socket, udp=socket.udp)
    if socket.status is not SocketStatus.CREATED:
        raise RapidError("ERR_SOCK_IS_BOUND")
    try:
        socket.endpoint = task.controller.network.bind(address, _port(port), datagram=socket.udp)
    except NetworkFault as fault:
        raise _error(fault) from fault
    socket.status = SocketStatus.BOUND


@builtin("SocketListen", cost="socket")
def socket_listen(task: Task, socket: SocketDevice) -> None:
    """Accept connections from now on."""
    _require(socket)
    if socket.status is SocketStatus.CONNECTED:
        raise RapidError("ERR_SOCK_IS_CONN")
    if socket.endpoint is None or socket.status is SocketStatus.CREATED:
        raise RapidError("ERR_SOCK_NOT_BOUND")
    try:
        task.controller.network.listen(socket.endpoint)
    except NetworkFault as fault:
        raise _error(fault) from fault
    socket.status = SocketStatus.LISTENING


@builtin("SocketAccept", cost="socket")
def socket_accept(
    task: Task,
    socket: SocketDevice,
    client: SocketDevice,
    client_address: Ref | None,
    time: float | None,
) -> None:
    """Wait for a client."""
    _require(socket)
    if socket.status is SocketStatus.CONNECTED or client.status is SocketStatus.CONNECTED:
        raise RapidError("ERR_SOCK_IS_CONN")
    listener = socket.endpoint
    if listener is None or socket.status is not SocketStatus.LISTENING:
        raise RapidError("ERR_SOCK_NOT_BOUND")
    network, table = task.controller.network, task.controller.sockets
    accepted: list[Endpoint] = []

    def try_it() -> bool:
        endpoint = network.accept(listener)
        if endpoint is not None:
            accepted.append(endpoint)
        return endpoint is not None

    _tell_awaited(task, listener)
    try:
        there = task.wait_for(
            try_it,
            on=(listener.changed,),
            timeout=_seconds(time),
            why=lambda: f"SocketAccept waits for a client on port {_asked(network, listener)}",
        )
    except NetworkFault as fault:
        raise _lost(task, socket, fault) from fault
    if not there:
        raise RapidError("ERR_SOCK_TIMEOUT")
    table.release(client)
    if table.full:
        network.close(accepted[0], abort=True)
        raise RapidError("ERR_SOCK_UNSPEC", "all sockets of the controller are in use")
    client.endpoint = accepted[0]
    client.udp = False
    client.status = SocketStatus.CONNECTED
    table.add(client, task.name)
    table.tell("open", client)
    if client_address is not None:
        peer = accepted[0].peer
        client_address.set(peer[0] if peer is not None else "")


@builtin("SocketConnect", cost="socket")
def socket_connect(
    task: Task, socket: SocketDevice, address: str, port: float, time: float | None
) -> None:
    """Connect to a server.

    See `Switches.failed_connect` for the socket's state after a failure, and
    `Switches.refused_connect` for a partner that rejects it.
    """
    _require(socket)
    if socket.status is SocketStatus.CONNECTED:
        raise RapidError("ERR_SOCK_IS_CONN")
    if socket.status is not SocketStatus.CREATED or socket.endpoint is not None:
        raise RapidError("ERR_SOCK_UNSPEC", "close the socket and create it again")
    network = task.controller.network
    again = task.controller.dialect.failed_connect == "again"
    _tell_awaited(task, None, port=_port(port))
    seconds = _seconds(time)
    end = None if seconds is None else task.scheduler.now + round(seconds * S)
    try:
        while not _connected(task, socket, address, port, end):
            # The partner is not there yet. TCP repeats the request until it answers.
            left = _REPEAT if end is None else min(_REPEAT, (end - task.scheduler.now) / S)
            if left <= 0:
                raise RapidError("ERR_SOCK_TIMEOUT")
            task.wait_for(lambda: False, timeout=left, why=lambda: _connecting(address, port))
        socket.status = SocketStatus.CONNECTED
        task.controller.sockets.tell("open", socket)
    except NetworkFault as fault:
        if fault.reason is NetworkReason.REFUSED:
            raise RapidError(_REFUSED[task.controller.dialect.refused_connect]) from fault
        raise _error(fault) from fault
    finally:
        if again and socket.status is SocketStatus.CREATED and socket.endpoint is not None:
            network.close(socket.endpoint, abort=True)
            socket.endpoint = None


def _connecting(address: str, port: float) -> str:
    return f"SocketConnect waits for {address}:{port:g}"


def _connected(
    task: Task, socket: SocketDevice, address: str, port: float, end: int | None
) -> bool:
    """Connect once; return False if no connection exists and the program must wait."""
    network = task.controller.network
    endpoint = socket.endpoint = network.connect(address, _port(port))
    try:
        return task.wait_for(
            # An attempt to send raises why there is no connection.
            lambda: endpoint.connected or network.send(endpoint, b"") > 0,
            on=(endpoint.changed,),
            timeout=None if end is None else max(0.0, (end - task.scheduler.now) / S),
            why=lambda: _connecting(address, port),
        )
    except NetworkFault as fault:
        waits = task.controller.dialect.refused_connect == "timeout"
        if fault.reason is not NetworkReason.REFUSED or not waits:
            raise
        network.close(endpoint, abort=True)
        return False


# -- data ---------------------------------------------------------------------------------------


def _payload(
    text: str | None, raw: RawBytes | None, data: dict[int, float] | None, count: float | None
) -> bytes:
    if text is not None:
        payload = text.encode("latin-1")
    elif raw is not None:
        payload = bytes(raw.data)
    elif data is not None:
        if len(data) > CAPACITY:
            raise RapidError("ERR_ARGVALERR", f"{len(data)} bytes; {CAPACITY} go")
        payload = bytes(byte_value(data[i]) for i in range(1, len(data) + 1))
    else:
        raise FatalError(194_660, "Nothing to send", "one of \\Str, \\RawData and \\Data")
    if count is None:
        return payload
    expected = whole(count, "ERR_ARGVALERR")
    if not 0 < expected <= len(payload):
        raise RapidError("ERR_ARGVALERR", f"\\NoOfBytes:={expected} of {len(payload)}")
    return payload[:expected]


@builtin("SocketSend", cost="socket")
def socket_send(task: Task, socket: SocketDevice, *content: Value) -> None:
    """Send bytes; wait while the connection has no buffer space."""
    payload = _payload(*content)
    endpoint = _stream(socket)
    network = task.controller.network
    left = payload

    def some_go() -> bool:
        nonlocal left
        in_use = network.send(endpoint, left)
        if in_use:
            task.controller.sockets.tell("out", socket, left[:in_use])
        left = left[in_use:]
        return in_use > 0

    interrupts = task.interrupts
    disabled = interrupts.disabled
    try:
        if not task.controller.dialect.send_attends:
            interrupts.disabled = True
        while left:
            if not task.wait_for(
                some_go,
                on=(endpoint.changed,),
                timeout=DEFAULT_TIME,
                why=lambda: f"SocketSend waits for {_peer(endpoint)} to read",
            ):
                raise RapidError("ERR_SOCK_TIMEOUT", "the peer does not read")
    except NetworkFault as fault:
        raise _lost(task, socket, fault) from fault
    finally:
        if not task.controller.dialect.send_attends:
            interrupts.disabled = disabled


@by_name("SocketReceive", cost="socket")
def socket_receive(task: Task, _name: str, arguments: Arguments) -> None:
    """Wait for bytes: some, or exactly \\ReadNoOfBytes."""
    endpoint = _stream(arguments["Socket"])
    _receive(task, arguments, endpoint, exact=arguments["ReadNoOfBytes"] is not None)


def _receive(task: Task, arguments: Arguments, endpoint: Endpoint, *, exact: bool) -> None:
    """Wait for bytes and store them in the argument."""
    text, raw, data = arguments["Str"], arguments["RawData"], arguments["Data"]
    limit = _limit(text, raw, data, arguments["ReadNoOfBytes"])
    received = _wait_for_bytes(task, arguments, endpoint, limit, exact=exact)
    if text is not None:
        text.set(received.decode("latin-1"))
    elif raw is not None:
        raw.data[:] = received
    elif data is not None:
        data.set({**data.get(), **dict(enumerate(received, 1))})
    if arguments["NoRecBytes"] is not None:
        arguments["NoRecBytes"].set(len(received))


def _tell_awaited(task: Task, endpoint: Endpoint | None, *, port: int = 0, count: int = 0) -> None:
    if task.controller.sockets.on_awaited is not None:
        task.controller.sockets.on_awaited(endpoint, port, count)


def _wait_for_bytes(
    task: Task, arguments: Arguments, endpoint: Endpoint, limit: int, *, exact: bool
) -> bytes:
    socket: SocketDevice = arguments["Socket"]
    network = task.controller.network
    result: bytes | None = None

    def try_it() -> bool:
        nonlocal result
        result = network.receive(endpoint, limit, exact=exact)
        return result is not None

    _tell_awaited(task, endpoint, count=limit if exact else 0)
    try:
        there = task.wait_for(
            try_it,
            on=(endpoint.changed,),
            timeout=_seconds(arguments["Time"]),
            why=lambda: f"waits for bytes from {_peer(endpoint)}",
        )
    except NetworkFault as fault:
        raise _lost(task, socket, fault) from fault
    if not there or result is None:
        if task.controller.dialect.receive_timeout == "drop":
            network.receive(endpoint, limit)
        raise RapidError("ERR_SOCK_TIMEOUT")
    if not result and not socket.udp:
        raise _lost(task, socket, NetworkFault(NetworkReason.CLOSED, "the peer has closed"))
    task.controller.sockets.tell("in", socket, result, endpoint.sender if socket.udp else None)
    return result


def _asked(network: Network, listener: Endpoint) -> int:
    """Return the port of the program, before any port mapping."""
    ports = (port for port, at in network.listeners.items() if at == listener.local)
    return next(ports, listener.local[1])


def _peer(endpoint: Endpoint) -> str:
    return "{}:{}".format(*endpoint.peer) if endpoint.peer else f"port {endpoint.local[1]}"


def _limit(
    text: Ref | None, raw: RawBytes | None, data: Ref | None, read_count: float | None
) -> int:
    if text is not None:
        free = MAX_STRING
    elif raw is not None:
        free = CAPACITY
    elif data is not None:
        free = min(CAPACITY, len(data.get()))
    else:
        raise FatalError(194_660, "Nowhere to receive", "one of \\Str, \\RawData and \\Data")
    if read_count is None:
        return free
    expected = whole(read_count, "ERR_ARGVALERR")
    if not 0 < expected <= free:
        raise RapidError("ERR_ARGVALERR", f"\\ReadNoOfBytes:={expected} of at most {free}")
    return expected


@builtin("SocketPeek", cost="socket")
def socket_peek(task: Task, socket: SocketDevice) -> int:
    """Return the number of received bytes."""
    endpoint = _stream(socket) if not socket.udp else _datagrams(task, socket)
    try:
        waiting = task.controller.network.receive(endpoint, BUFFER, peek=True)
    except NetworkFault as fault:
        raise _lost(task, socket, fault) from fault
    if waiting == b"" and not socket.udp:
        raise _lost(task, socket, NetworkFault(NetworkReason.CLOSED, "the peer has closed"))
    if not waiting:
        _tell_awaited(task, endpoint)
    return len(waiting or b"")


# -- UDP ----------------------------------------------------------------------------------------


def _datagrams(task: Task, socket: SocketDevice) -> Endpoint:
    _require(socket, udp=True)
    if socket.endpoint is None:
        try:
            socket.endpoint = task.controller.network.bind(
                task.controller.network.address, 0, datagram=True
            )
        except NetworkFault as fault:
            raise _error(fault) from fault
    return socket.endpoint


@builtin("SocketSendTo", cost="socket")
def socket_send_to(
    task: Task, socket: SocketDevice, address: str, port: float, *content: Value
) -> None:
    """Send one datagram."""
    payload = _payload(*content)
    endpoint = _datagrams(task, socket)
    try:
        to = (address, _port(port))
        task.controller.network.send(endpoint, payload, to)
    except NetworkFault as fault:
        raise _error(fault) from fault
    task.controller.sockets.tell("out", socket, payload, to)


@by_name("SocketReceiveFrom", cost="socket")
def socket_receive_from(task: Task, _name: str, arguments: Arguments) -> None:
    """Wait for one datagram; the excess is lost, as with BSD sockets."""
    endpoint = _datagrams(task, arguments["Socket"])
    _receive(task, arguments, endpoint, exact=False)
    sender = endpoint.sender or ("", 0)
    arguments["RemoteAddress"].set(sender[0])
    arguments["RemotePort"].set(sender[1])


# SocketGetStatus reports the program's view: a peer that disappeared still shows as connected.
_PLAIN: dict[str, Callable[..., Value]] = {
    "SocketClose": lambda task, socket: task.controller.sockets.release(socket),
    "SocketGetStatus": lambda _task, socket: int(socket.status),
}
builtins(_PLAIN, cost="socket")
