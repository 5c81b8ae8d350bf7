"""Network of a virtual controller: connections, data, faults."""

from collections import deque
from collections.abc import Iterable, Iterator, Mapping

from rapidgen.controller.runner import ControllerRunner
from rapidgen.machine.network.fault_injection import FaultyNetwork, NetworkRule
from rapidgen.machine.network.interface import SocketAddress
from rapidgen.machine.network.sockets import SocketDevice, SocketNews
from rapidgen.viewer.messages import Request, ToPage
from rapidgen.viewer.panel_messages import (
    Ailment,
    Connections,
    Conversation,
    InjectFault,
    Listen,
    ResetConnection,
    ShownSocket,
    SocketLogLine,
)
from rapidgen.viewer.provider import Handler, RequestRejected
from rapidgen.viewer.socket_log import Interpreter, SocketPiece

_KEPT = 500
"""Data between two updates; older ones are only counted."""
_MOST_LINES = 300
"""Lines sent to a new listener."""
RULES: Mapping[Ailment, NetworkRule] = {
    "well": NetworkRule("delay", seconds=0.0),
    "delay": NetworkRule("delay", seconds=0.5),
    "split": NetworkRule("split", bytes=3, seconds=0.005),
    "slow": NetworkRule("slow", bytes=400),
    "silent": NetworkRule("silent"),
    "half-open": NetworkRule("half-open"),
}


class ConnectionsProvider:
    """Sockets in use, their data while a viewer listens, and link faults."""

    def __init__(self, runner: ControllerRunner) -> None:
        self._controller = runner.controller
        self._sockets = runner.controller.sockets
        self._last_sent: tuple[ShownSocket, ...] = ()
        self._ailments: dict[SocketDevice, Ailment] = {}
        self._interpreter: Interpreter | None = None
        self._received: deque[SocketPiece] = deque(maxlen=_KEPT)
        self._count = 0
        self._latest: deque[Conversation] = deque(maxlen=_MOST_LINES // 4)
        self._listened = False

    def whole(self) -> Iterable[ToPage]:
        """Return all sockets and the latest data."""
        yield Connections(sockets=self._now())
        lines = [line for message in self._latest for line in message.lines][-_MOST_LINES:]
        listening = self._interpreter is not None
        yield Conversation(listening=listening, lines=tuple(lines), fresh=True)

    def changes(self) -> Iterable[ToPage]:
        """Return all sockets if one has changed, and new data."""
        now = self._now()
        if now != self._last_sent:
            self._last_sent = now
            yield Connections(sockets=now)
        listening = self._interpreter is not None
        if self._count or listening != self._listened:
            self._listened = listening
            message = self._new_lines()
            self._latest.append(message)
            yield message

    def _new_lines(self) -> Conversation:
        received, self._received = self._received, deque(maxlen=_KEPT)
        missed, self._count = self._count - len(received), 0
        lines = [line for piece in received for line in self._lines(piece)]
        return Conversation(
            listening=self._interpreter is not None, lines=tuple(lines), missed=missed
        )

    def _lines(self, piece: SocketPiece) -> Iterator[SocketLogLine]:
        if self._interpreter is not None:
            yield from self._interpreter.lines(piece)

    def handlers(self) -> Mapping[type, Handler]:
        """Handlers that cut a connection, inject a fault, or listen."""
        return {ResetConnection: self._cut, InjectFault: self._inject_fault, Listen: self._listen}

    def _now(self) -> tuple[ShownSocket, ...]:
        return tuple(
            _shown(device, task, self._ailments.get(device, "well"))
            for device, task in self._sockets.in_use.items()
        )

    def _connected(self, number: int) -> SocketDevice:
        for device in self._sockets.in_use:
            if id(device) == number and _peer(device):
                return device
        raise RequestRejected("this connection is closed")

    def _cut(self, request: Request) -> str:
        assert isinstance(request, ResetConnection)
        self._sockets.cut(self._connected(request.number))
        return ""

    def _inject_fault(self, request: Request) -> str:
        assert isinstance(request, InjectFault)
        device, network = self._connected(request.number), self._controller.network
        if not isinstance(network, FaultyNetwork) or device.endpoint is None or device.udp:
            raise RequestRejected("this connection cannot be made worse")
        if self._ailments.get(device) in ("silent", "half-open") and request.ailment != "silent":
            raise RequestRejected("lost data is not sent again: cut the connection")
        network.inject_fault(device.endpoint, RULES[request.ailment])
        self._ailments = {d: a for d, a in self._ailments.items() if d in self._sockets.in_use}
        self._ailments[device] = request.ailment
        return ""

    def _listen(self, request: Request) -> str:
        assert isinstance(request, Listen)
        listeners = self._sockets.listeners
        if request.on and self._interpreter is None:
            self._interpreter = Interpreter()
            listeners.append(self._hear)
        elif not request.on and self._interpreter is not None:
            self._interpreter = None
            listeners.remove(self._hear)
            self._latest.clear()
        return ""

    def _hear(self, events: SocketNews) -> None:
        peer = "" if events.peer is None else _text(events.peer)
        self._count += 1
        self._received.append(
            SocketPiece(
                self._controller.now,
                events.change,
                events.task,
                _text(events.local),
                peer,
                events.data,
            )
        )


def _text(address: SocketAddress) -> str:
    return f"{address[0]}:{address[1]}"


def _peer(device: SocketDevice) -> str:
    peer = device.endpoint.peer if device.endpoint else None
    return _text(peer) if peer else ""


def _shown(device: SocketDevice, task: str, ailment: Ailment) -> ShownSocket:
    local = device.endpoint.local if device.endpoint else None
    return ShownSocket(
        number=id(device),
        task=task,
        status=device.status.name.lower(),
        local=_text(local) if local else "",
        peer=_peer(device),
        ailment=ailment if _peer(device) else "well",
    )
