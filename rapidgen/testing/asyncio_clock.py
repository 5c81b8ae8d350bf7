"""asyncio on the virtual clock, for unchanged clients.

`VirtualLoop` is an event loop whose selector is the scheduler: when asyncio has nothing to do,
simulated time passes. `asyncio.sleep`, `timeout`, `open_connection` work unchanged; the network is
the controller's own in memory. If no event is ahead and no task can continue, `Deadlock` is raised
instead of a hang.

    with VirtualController(...) as controller:
        run(controller, client_coroutine())

A test pins the few private names of asyncio that this needs.
"""

import asyncio
import math
import selectors
from collections.abc import Awaitable, Callable, Mapping
from io import UnsupportedOperation
from typing import TYPE_CHECKING, NoReturn, TypeVar

from rapidgen.controller.controller import Deadlock, VirtualController
from rapidgen.machine.network.interface import (
    BUFFER,
    Endpoint,
    Network,
    NetworkFault,
    NetworkReason,
)

if TYPE_CHECKING:
    from _typeshed import FileDescriptorLike

_T = TypeVar("_T")
HIGH_WATER = BUFFER
"""Bytes that a transport buffers before it asks its writer to pause."""

_ERRORS: dict[NetworkReason, type[OSError]] = {
    NetworkReason.REFUSED: ConnectionRefusedError,
    NetworkReason.RESET: ConnectionResetError,
    NetworkReason.CLOSED: BrokenPipeError,
}


def run(controller: VirtualController, main: Awaitable[_T]) -> _T:
    """Run a coroutine on the controller's clock and return its result."""
    loop = VirtualLoop(controller)
    try:
        return loop.run_until_complete(main)
    finally:
        loop.run_until_complete(loop.shutdown_asyncgens())
        loop.close()


class _SchedulerSelector(selectors.BaseSelector):
    """Selector of BaseEventLoop that lets simulated time pass.

    It watches no files.
    """

    def __init__(self, loop: "VirtualLoop") -> None:
        self._loop = loop

    def select(self, timeout: float | None = None) -> list[tuple[selectors.SelectorKey, int]]:
        """Let time pass until asyncio has something to do, or `timeout` s."""
        self._loop.pass_time(timeout)
        return []

    def register(self, fileobj: "FileDescriptorLike", events: int, data: object = None) -> NoReturn:
        """Raise UnsupportedOperation: files are not watched on the virtual clock."""
        raise UnsupportedOperation("files are not watched on the virtual clock")

    def unregister(self, fileobj: "FileDescriptorLike") -> NoReturn:
        """Raise UnsupportedOperation: no file is registered."""
        raise UnsupportedOperation("files are not watched on the virtual clock")

    def get_map(self) -> "Mapping[FileDescriptorLike, selectors.SelectorKey]":
        """Return an empty mapping."""
        return {}

    def close(self) -> None:
        """Do nothing: there are no resources."""


class VirtualLoop(asyncio.BaseEventLoop):
    """An event loop on the clock of a virtual controller."""

    def __init__(self, controller: VirtualController) -> None:
        super().__init__()
        self.controller = controller
        self._scheduler = controller.scheduler
        self._selector = _SchedulerSelector(self)
        self._clock_resolution = 1e-9

    def time(self) -> float:
        """Return the simulated seconds."""
        return self._scheduler.now * 1e-9

    def pass_time(self, timeout: float | None) -> None:
        """Advance the controller until a callback is ready or `timeout` s have passed."""
        ready = self._ready  # type: ignore[attr-defined]
        if timeout is not None and timeout <= 0:
            return
        scheduler = self._scheduler
        until = None if timeout is None else scheduler.now + math.ceil(timeout * 1e9)
        outcome = scheduler.advance(until, lambda: bool(ready))
        if outcome == "paused":
            raise Deadlock("asyncio waits, and a debugger holds the controller")
        if outcome == "idle":
            where = "\n".join(self.controller.where())
            raise Deadlock(f"asyncio waits for something that cannot happen\n{where}")

    def _process_events(self, event_list: list[tuple[selectors.SelectorKey, int]]) -> None:
        """Do nothing: the scheduler's events wake transports."""

    def _write_to_self(self) -> None:
        """Let the scheduler look, after `call_soon_threadsafe` of a thread."""
        self._scheduler.post(lambda: None)

    async def create_connection(  # type: ignore[override]
        self,
        protocol_factory: Callable[[], asyncio.Protocol],
        host: str | None = None,
        port: int | None = None,
        **_options: object,
    ) -> tuple[asyncio.Transport, asyncio.Protocol]:
        """Connect to a port of the controller's network in memory."""
        network = self.controller.network
        if host is None or port is None:
            raise ValueError("the virtual clock has connections to a host and a port only")
        try:
            endpoint = network.connect(host, port)
            await self._connected(network, endpoint)
        except NetworkFault as fault:
            raise _os_error(fault) from fault
        protocol = protocol_factory()
        transport = MemoryTransport(self, network, endpoint, protocol)
        # As in every event loop: `connection_made` has been called.
        await asyncio.sleep(0)
        return transport, protocol

    async def _connected(self, network: Network, endpoint: Endpoint) -> None:
        while not endpoint.connected:
            changed = self.create_future()

            def wake(changed: asyncio.Future[None] = changed) -> None:
                if not changed.done():
                    changed.set_result(None)

            endpoint.changed.add(wake)
            try:
                network.receive(endpoint, 0, peek=True)
                if not endpoint.connected:
                    await changed
            except BaseException:
                network.close(endpoint, abort=True)
                raise
            finally:
                endpoint.changed.remove(wake)


class MemoryTransport(asyncio.Transport):
    """A stream over an endpoint of the network in memory."""

    def __init__(
        self,
        loop: VirtualLoop,
        network: Network,
        endpoint: Endpoint,
        protocol: asyncio.Protocol,
    ) -> None:
        super().__init__({"peername": endpoint.peer, "sockname": endpoint.local, "socket": None})
        self._loop = loop
        self._network = network
        self._endpoint = endpoint
        self._protocol: asyncio.BaseProtocol = protocol
        self._buffer = bytearray()
        self._closing = False
        self._lost = False
        self._reading = True
        self._ended = False
        self._paused = False
        self._woken = False
        self._high_water, self._low_water = HIGH_WATER, HIGH_WATER // 4
        endpoint.changed.add(self._wake)
        loop.call_soon(protocol.connection_made, self)
        self._wake()

    def _wake(self) -> None:
        if not self._woken:
            self._woken = True
            self._loop.call_soon(self._pump)

    def _pump(self) -> None:
        self._woken = False
        if self._lost:
            return
        try:
            self._flush()
            self._read()
        except NetworkFault as fault:
            self._lose(_os_error(fault))
            return
        if self._closing and not self._buffer:
            self._lose(None)

    def _flush(self) -> None:
        while self._buffer:
            in_use = self._network.send(self._endpoint, bytes(self._buffer[:BUFFER]))
            if not in_use:
                break
            del self._buffer[:in_use]
        if self._paused and len(self._buffer) <= self._low_water:
            self._paused = False
            self._protocol.resume_writing()

    def _read(self) -> None:
        protocol = self._protocol
        assert isinstance(protocol, asyncio.Protocol)
        while self._reading and not self._ended and not self._closing:
            data = self._network.receive(self._endpoint, BUFFER)
            if data is None:
                return
            if data:
                protocol.data_received(data)
                continue
            self._ended = True
            if not protocol.eof_received():
                self.close()

    def _lose(self, error: Exception | None) -> None:
        self._lost = self._closing = True
        self._endpoint.changed.remove(self._wake)
        self._network.close(self._endpoint, abort=error is not None)
        self._loop.call_soon(self._protocol.connection_lost, error)

    # -- asyncio.Transport ----------------------------------------------------------------------

    def write(self, data: bytes | bytearray | memoryview) -> None:
        """Send what fits now, and buffer the rest."""
        if self._lost or not data:
            return
        self._buffer += data
        try:
            self._flush()
        except NetworkFault as fault:
            self._lose(_os_error(fault))
            return
        if len(self._buffer) > self._high_water and not self._paused:
            self._paused = True
            self._protocol.pause_writing()

    def close(self) -> None:
        """Send the buffered bytes, then close."""
        if not self._closing:
            self._closing = True
            self._wake()

    def abort(self) -> None:
        """Close immediately."""
        if not self._lost:
            self._buffer.clear()
            self._lose(None)

    def is_closing(self) -> bool:
        """True after `close` or a lost connection."""
        return self._closing

    def pause_reading(self) -> None:
        """Leave arriving bytes in the network."""
        self._reading = False

    def resume_reading(self) -> None:
        """Read again."""
        self._reading = True
        self._wake()

    def is_reading(self) -> bool:
        """True if the protocol gets data."""
        return self._reading and not self._closing

    def get_write_buffer_size(self) -> int:
        """Return the number of bytes not sent yet."""
        return len(self._buffer)

    def set_write_buffer_limits(self, high: int | None = None, low: int | None = None) -> None:
        """Set the limits at which the writer pauses and resumes."""
        self._high_water = HIGH_WATER if high is None else high
        self._low_water = self._high_water // 4 if low is None else low

    def can_write_eof(self) -> bool:
        """Return False: the network closes both directions at once."""
        return False

    def set_protocol(self, protocol: asyncio.BaseProtocol) -> None:
        """Hand the connection to another protocol."""
        self._protocol = protocol

    def get_protocol(self) -> asyncio.BaseProtocol:
        """Return the protocol that gets the data."""
        return self._protocol


def _os_error(fault: NetworkFault) -> OSError:
    return _ERRORS.get(fault.reason, OSError)(str(fault))
