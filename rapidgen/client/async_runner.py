"""Runner of flows on asyncio, also on a simulated clock.

It uses only `create_connection`, `time`, `create_future` and `call_later` of the running loop.
"""

import asyncio
import os
import weakref
from contextlib import nullcontext, suppress
from dataclasses import dataclass, field
from typing import TypeVar, cast

from rapidgen.client import deadline
from rapidgen.client.address import Address
from rapidgen.client.core.robot import STOP_FRAME
from rapidgen.client.errors import (
    MotionStopped,
    RobotError,
    RobotTimeout,
    not_reached,
    os_reason,
)
from rapidgen.client.flows.effects import (
    Close,
    CloseAll,
    Effect,
    Flow,
    Open,
    Send,
    SendAtOnce,
    Wait,
)
from rapidgen.client.runner import FlowRunner, MakeCore, release_frames
from rapidgen.client.unclosed import warn_unclosed
from rapidgen.wire.simple_message.numpy_codec import FRAME_BYTES
from rapidgen.wire.simple_message.spec import Port

T = TypeVar("T")
_BREATH = 64
"""Frames after which a sender yields to other tasks of its loop."""


class Connection(asyncio.Protocol):
    """One connection as an asyncio protocol.

    Its loop holds it; it holds its runner weakly, so that a dropped one is finalized.
    """

    def __init__(self, runner: "AsyncFlowRunner", port: Port) -> None:
        self.port = port
        self.transport: asyncio.Transport | None = None
        self.is_writable = asyncio.Event()
        self.is_writable.set()
        self._runner = weakref.ref(runner)

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self.transport = cast("asyncio.Transport", transport)
        # The transport must not buffer: a STOP would wait for the buffered bytes.
        self.transport.set_write_buffer_limits(high=0)
        runner = self._runner()
        if runner is not None:
            runner.opened(self)

    def data_received(self, data: bytes) -> None:
        runner = self._runner()
        if runner is not None:
            runner.received(self, data)

    def connection_lost(self, exc: Exception | None) -> None:
        why = "the controller closed it"
        if isinstance(exc, OSError):
            why = os_reason(exc)
        self.is_writable.set()
        runner = self._runner()
        if runner is not None:
            runner.lost(self, why)

    def pause_writing(self) -> None:
        self.is_writable.clear()

    def resume_writing(self) -> None:
        self.is_writable.set()


@dataclass(slots=True, eq=False)
class Connections:
    """Connections of one robot, apart from the runner that its user may drop."""

    where: str
    loop: asyncio.AbstractEventLoop | None = None
    """The loop of the last call."""
    by_port: dict[Port, Connection] = field(default_factory=dict)
    may_move: bool = False
    """True if a motion of this client may move the robot."""

    def time(self) -> float:
        """Return the time of the loop in s."""
        return self.loop.time() if self.loop is not None else 0.0

    def close_dropped(self) -> None:
        """Close with a warning; a STOP goes out during a motion.

        It may run on any thread, at any moment at which Python collects garbage.
        """
        if self.loop is None or not self.by_port:
            return
        # A closed loop has no transports; asyncio closes their sockets with them.
        with suppress(RuntimeError):
            self.loop.call_soon_threadsafe(self._close_all_at_once)
        warn_unclosed(self.where, stopped=self.may_move)

    def _close_all_at_once(self) -> None:
        for port, connection in self.by_port.items():
            if connection.transport is not None:
                if self.may_move and port is not Port.STATE:
                    connection.transport.write(STOP_FRAME)
                connection.transport.close()
        self.by_port.clear()

    def forked(self) -> None:
        """Close the sockets of a forked process; the connections stay the parent's."""
        for connection in self.by_port.values():
            socket = (
                connection.transport.get_extra_info("socket")
                if connection.transport is not None
                else None
            )
            if socket is not None and socket.fileno() >= 0:
                # The transport keeps its descriptor: to close it would remove the parent's
                # connection from the selector that both processes share.
                null = os.open(os.devnull, os.O_RDWR)
                os.dup2(null, socket.fileno(), inheritable=False)
                os.close(null)
        self.by_port.clear()
        self.may_move = False


class AsyncFlowRunner(FlowRunner):
    """Runner of flows on the running loop."""

    def __init__(self, address: Address, make_core: MakeCore) -> None:
        self._connections = Connections(str(address))
        self._by_port = self._connections.by_port
        super().__init__(address, make_core(self._connections.time), nullcontext())
        self._waiters: set[asyncio.Future[None]] = set()
        self._timer: asyncio.TimerHandle | None = None
        weakref.finalize(self, self._connections.close_dropped)

    def forked(self) -> None:
        """Drop the connections in a forked process."""
        self._connections.forked()
        self._waiters.clear()
        self._timer = None
        super().forked()

    async def run(self, flow: Flow[T]) -> T:
        """Run a flow on this loop."""
        try:
            return await self._run(flow)
        except (RobotError, asyncio.CancelledError) as error:
            release_frames(error)
            raise

    async def _run(self, flow: Flow[T]) -> T:
        self._connections.loop = asyncio.get_running_loop()
        outcome: bool | None = None
        failure: BaseException | None = None
        while True:
            error, failure = failure, None
            try:
                try:
                    effect = flow.send(outcome) if error is None else flow.throw(error)
                finally:
                    self._pump()
            except StopIteration as end:
                value: T = end.value
                return value
            try:
                outcome = await self._perform(effect)
            except (RobotError, asyncio.CancelledError) as raised:
                failure = raised

    def _pump(self) -> None:
        """Send the frames that are due, as far as the buffer is empty."""
        core = self.core
        self._connections.may_move = core.may_move
        stops = core.unmonitored_stops()
        for port, connection in self._by_port.items():
            if connection.transport is None:
                continue
            if port in stops:
                connection.transport.write(STOP_FRAME)
            while connection.is_writable.is_set() and (data := core.due(port)) is not None:
                connection.transport.write(data)
        loop = self._connections.loop
        if core.is_busy and self._timer is None and loop is not None:
            self._timer = loop.call_later(core.tick, _tick, weakref.ref(self))

    def tick(self) -> None:
        """Check the clock and send what is due."""
        self._timer = None
        self.core.poll()
        self._pump()
        self._notify()

    async def _perform(self, effect: Effect) -> bool:
        if isinstance(effect, Wait):
            return await self._wait(effect)
        if isinstance(effect, Close):
            self._close(effect.port)
            return True
        if isinstance(effect, Open):
            await self._open(effect)
            return True
        if isinstance(effect, CloseAll):
            self._close_all()
            return True
        if isinstance(effect, SendAtOnce):
            for port in effect.ports:
                connection = self._by_port.get(port)
                if connection is None or connection.transport is None:
                    effect.failures[port] = self.core.disconnected()
                else:
                    # At most the rest of one frame is queued: senders wait for an empty buffer.
                    connection.transport.write(effect.data)
            return True
        connection = self._by_port.get(effect.port)
        if connection is None or connection.transport is None:
            raise self.core.disconnected()
        await self._send(connection, connection.transport, effect)
        return True

    async def _send(
        self, connection: Connection, transport: asyncio.Transport, effect: Send
    ) -> None:
        data, motion = effect.data, effect.motion
        for count, at in enumerate(range(0, len(data), FRAME_BYTES), 1):
            if motion is not None and motion.stopping:
                raise MotionStopped.because("RG631", "stopped before the trajectory was sent")
            if self._by_port.get(connection.port) is not connection:
                raise self.core.disconnected()
            transport.write(data[at : at + FRAME_BYTES])
            if not connection.is_writable.is_set():
                await self._wait_writable(connection, effect.timeout)
            elif count % _BREATH == 0:
                await asyncio.sleep(0)

    async def _wait_writable(self, connection: Connection, timeout: float) -> None:
        try:
            async with deadline.timeout(timeout):
                await connection.is_writable.wait()
        except TimeoutError as error:
            raise RobotTimeout.because(
                "RG603", f"the controller read no byte for {timeout:g} s", "look at the controller"
            ) from error

    async def _wait(self, effect: Wait) -> bool:
        loop = asyncio.get_running_loop()
        deadline = loop.time() + effect.timeout
        while not effect.until():
            left = deadline - loop.time()
            if left <= 0:
                return False
            waiter: asyncio.Future[None] = loop.create_future()
            timer = loop.call_later(min(left, self.core.tick), _wake, waiter)
            self._waiters.add(waiter)
            try:
                await waiter
            finally:
                timer.cancel()
                self._waiters.discard(waiter)
            self.core.poll()
            self._pump()
        return True

    def _close(self, port: Port) -> None:
        connection = self._by_port.pop(port, None)
        self.core.dropped(port)
        if connection is not None and connection.transport is not None:
            connection.transport.close()

    def _notify(self) -> None:
        for waiter in self._waiters:
            _wake(waiter)
        self._waiters.clear()

    async def _open(self, effect: Open) -> None:
        loop = asyncio.get_running_loop()
        number, name = self.address.port(effect.port), effect.port.name.lower()
        where = f"{self.address.host} port {number} ({name} port of {self.address})"
        old = self._by_port.pop(effect.port, None)
        if old is not None and old.transport is not None:
            old.transport.close()
        try:
            async with deadline.timeout(effect.timeout):
                await loop.create_connection(
                    lambda: Connection(self, effect.port), self.address.host, number
                )
        except OSError as error:
            raise not_reached(where, error, effect.timeout) from error

    def opened(self, connection: Connection) -> None:
        self._by_port[connection.port] = connection
        self.core.opened(connection.port)

    def received(self, connection: Connection, data: bytes) -> None:
        if self._by_port.get(connection.port) is connection:
            if not self.core.received(connection.port, data):
                del self._by_port[connection.port]
                if connection.transport is not None:
                    connection.transport.close()
            self._pump()
            self._notify()

    def lost(self, connection: Connection, why: str) -> None:
        if self._by_port.get(connection.port) is connection:
            del self._by_port[connection.port]
            self.core.lost(connection.port, why)
            self._pump()
            self._notify()

    def _close_all(self) -> None:
        self.core.closed()
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        connections = list(self._by_port.values())
        self._by_port.clear()
        for connection in connections:
            if connection.transport is not None:
                connection.transport.close()
        self._notify()


def _tick(runner: "weakref.ref[AsyncFlowRunner]") -> None:
    owner = runner()
    if owner is not None:
        owner.tick()


def _wake(waiter: "asyncio.Future[None]") -> None:
    if not waiter.done():
        waiter.set_result(None)
