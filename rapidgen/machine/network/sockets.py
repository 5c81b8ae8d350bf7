"""Sockets as a program holds them, and the controller's table of those that are in use."""

from collections.abc import Mapping
from enum import IntEnum
from types import MappingProxyType

from rapidgen.machine.network.interface import Endpoint, Network, NetworkFault, NetworkReason

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
    """A socketdev: the program's own view of a socket."""

    __slots__ = ("endpoint", "status", "udp")

    def __init__(self) -> None:
        self.endpoint: Endpoint | None = None
        self.status = SocketStatus.CLOSED
        self.udp = False


class SocketTable:
    """Which sockets of a network are in use, and by which task."""

    def __init__(self, network: Network, *, limited: bool = True) -> None:
        self._network = network
        self._limited = limited
        self._owners: dict[SocketDevice, str] = {}

    @property
    def full(self) -> bool:
        """Whether no further socket can be created."""
        return self._limited and len(self._owners) >= MAX_SOCKETS

    def add(self, device: SocketDevice, task: str) -> None:
        """A socket comes into use."""
        self._owners[device] = task

    @property
    def in_use(self) -> Mapping[SocketDevice, str]:
        """Sockets and the tasks that have them."""
        return MappingProxyType(self._owners)

    def cut(self, device: SocketDevice) -> None:
        """The connection is reset, as a peer that has crashed does; the program finds out."""
        if device.endpoint is not None:
            device.endpoint.fault = NetworkFault(NetworkReason.RESET, "by hand")
            self._network.close(device.endpoint, abort=True)

    def release(self, device: SocketDevice, *, abort: bool = False) -> None:
        """Close a socket; harmless when it is closed."""
        self._owners.pop(device, None)
        device.status = SocketStatus.CLOSED
        endpoint, device.endpoint = device.endpoint, None
        if endpoint is not None:
            self._network.close(endpoint, abort=abort)

    def close_task(self, task: str) -> None:
        """Close every socket that a task has created or accepted (PP to main, restart)."""
        for device in [d for d, owner in self._owners.items() if owner == task]:
            self.release(device)
