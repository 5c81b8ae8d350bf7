"""Sockets of programs, and the controller's table of used sockets."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import IntEnum
from types import MappingProxyType
from typing import Literal

from rapidgen.machine.network.interface import (
    Endpoint,
    Network,
    NetworkFault,
    NetworkReason,
    SocketAddress,
)

MAX_SOCKETS = 32
"""Sockets of one controller at a time (switch `sockets_limited`)."""


class SocketStatus(IntEnum):
    """Numbers of the `socketstatus` constants."""

    CREATED = 1
    CONNECTED = 2
    BOUND = 3
    LISTENING = 4
    CLOSED = 5


class SocketDevice:
    """A socketdev: the program's view of a socket."""

    __slots__ = ("endpoint", "status", "udp")

    def __init__(self) -> None:
        self.endpoint: Endpoint | None = None
        self.status = SocketStatus.CLOSED
        self.udp = False


SocketChange = Literal["open", "in", "out", "close"]
"""A connection begins or ends, or the program received or sent bytes of one."""


@dataclass(frozen=True, slots=True)
class SocketNews:
    """An action of a program's socket."""

    change: SocketChange
    task: str
    local: SocketAddress
    peer: SocketAddress | None
    data: bytes = b""


class SocketTable:
    """Used sockets of a network, by task."""

    def __init__(self, network: Network, *, limited: bool = True) -> None:
        self._network = network
        self._limited = limited
        self._owners: dict[SocketDevice, str] = {}
        self.listeners: list[Callable[[SocketNews], None]] = []
        """Receive socket actions when the program notices them."""
        self.on_awaited: Callable[[Endpoint | None, int, int], None] | None = None
        """Receives that a program is about to wait: for a client of a listener, for a number of
        bytes (0: any) of a connection, or, without an endpoint, for a server at a port."""

    @property
    def full(self) -> bool:
        """True if no further socket can be created."""
        return self._limited and len(self._owners) >= MAX_SOCKETS

    def add(self, device: SocketDevice, task: str) -> None:
        """Register a used socket."""
        self._owners[device] = task

    @property
    def in_use(self) -> Mapping[SocketDevice, str]:
        """Used sockets and their tasks."""
        return MappingProxyType(self._owners)

    def cut(self, device: SocketDevice) -> None:
        """Reset the connection, as a crashed peer does.

        The program notices it at its next access.
        """
        if device.endpoint is not None:
            device.endpoint.fault = NetworkFault(NetworkReason.RESET, "by hand")
            self._network.close(device.endpoint, abort=True)

    def release(self, device: SocketDevice, *, abort: bool = False) -> None:
        """Close a socket; ignore a closed one."""
        if device.status is SocketStatus.CONNECTED:
            self.tell("close", device)
        self._owners.pop(device, None)
        device.status = SocketStatus.CLOSED
        endpoint, device.endpoint = device.endpoint, None
        if endpoint is not None:
            self._network.close(endpoint, abort=abort)

    def tell(
        self,
        change: SocketChange,
        device: SocketDevice,
        data: bytes = b"",
        peer: SocketAddress | None = None,
    ) -> None:
        """Notify listeners of a socket action; `peer` of a datagram."""
        at, task = device.endpoint, self._owners.get(device, "")
        if at is not None:
            for listener in self.listeners:
                listener(SocketNews(change, task, at.local, peer or at.peer, data))

    def connections(self) -> list[SocketNews]:
        """Return open connections as actions of their beginning."""
        return [
            SocketNews("open", task, device.endpoint.local, device.endpoint.peer)
            for device, task in self._owners.items()
            if device.status is SocketStatus.CONNECTED and device.endpoint is not None
        ]

    def close_task(self, task: str) -> None:
        """Close all sockets of a task (PP to main, restart)."""
        for device in [d for d, owner in self._owners.items() if owner == task]:
            self.release(device)
