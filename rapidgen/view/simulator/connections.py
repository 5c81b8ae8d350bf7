"""Who is connected to a virtual controller: its sockets by task."""

from collections.abc import Iterable, Mapping

from rapidgen.controller.cabinet import Cabinet
from rapidgen.machine.network.sockets import SocketDevice
from rapidgen.view.aspect import Declined, Handler
from rapidgen.view.messages import Connections, Cut, Request, ShownSocket, ToPage


class ConnectionsAspect:
    """Sockets in use, and a cable that is pulled."""

    def __init__(self, cabinet: Cabinet) -> None:
        self._sockets = cabinet.controller.sockets
        self._told: tuple[ShownSocket, ...] = ()

    def whole(self) -> Iterable[ToPage]:
        """All of them."""
        yield Connections(sockets=self._now())

    def changes(self) -> Iterable[ToPage]:
        """All of them, where one has changed."""
        now = self._now()
        if now != self._told:
            self._told = now
            yield Connections(sockets=now)

    def handlers(self) -> Mapping[type, Handler]:
        """Cutting one."""
        return {Cut: self._cut}

    def _now(self) -> tuple[ShownSocket, ...]:
        return tuple(_shown(*pair) for pair in self._sockets.in_use.items())

    def _cut(self, request: Request) -> str:
        assert isinstance(request, Cut)
        for device in self._sockets.in_use:
            if id(device) == request.number and _peer(device):
                self._sockets.cut(device)
                return ""
        raise Declined("this connection has gone")


def _peer(device: SocketDevice) -> str:
    peer = device.endpoint.peer if device.endpoint else None
    return f"{peer[0]}:{peer[1]}" if peer else ""


def _shown(device: SocketDevice, task: str) -> ShownSocket:
    local = device.endpoint.local if device.endpoint else None
    return ShownSocket(
        number=id(device),
        task=task,
        status=device.status.name.lower(),
        local=f"{local[0]}:{local[1]}" if local else "",
        peer=_peer(device),
    )
