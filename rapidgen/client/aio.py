"""`AsyncRobot`: the client for asyncio, also on a simulated clock.

Uses only `create_connection`, `time`, `create_future` and `call_later` of the running loop.
"""

import asyncio
import os
import warnings
import weakref
from collections.abc import AsyncIterable, AsyncIterator, Iterable, Sequence
from contextlib import nullcontext, suppress
from dataclasses import dataclass, field
from typing import TypeVar, cast

from rapidgen._compat import Self
from rapidgen.client import deadline, flows
from rapidgen.client.address import Address
from rapidgen.client.api import ExecutionApi, MakeCore, RobotApi, RunApi, StreamApi
from rapidgen.client.core.job import batches
from rapidgen.client.core.robot import STOP_FRAME
from rapidgen.client.core.state import State
from rapidgen.client.errors import (
    MotionStopped,
    RobotError,
    RobotTimeout,
    not_reached,
    os_reason,
)
from rapidgen.client.flows.effects import (
    Close,
    Effect,
    Flow,
    HangUp,
    Open,
    Send,
    SendAtOnce,
    Wait,
)
from rapidgen.client.unclosed import drop_in_child, warn_unclosed
from rapidgen.wire.simple_message.numpy_codec import FRAME_BYTES
from rapidgen.wire.simple_message.spec import Port

T = TypeVar("T")
_SLICE = 0.1
"""s between two checks of the clock while no data arrives."""
_BREATH = 64
"""Frames after which a sender yields to other tasks of its loop."""


class _Link(asyncio.Protocol):
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
class _Connections:
    """Connections of one robot, apart from the runner that its user may drop."""

    where: str
    loop: asyncio.AbstractEventLoop | None = None
    """The loop of the last call."""
    links: dict[Port, _Link] = field(default_factory=dict)
    may_move: bool = False
    """True if a motion of this client may move the robot."""

    def time(self) -> float:
        """Return the time of the loop in s."""
        return self.loop.time() if self.loop is not None else 0.0

    def close_dropped(self) -> None:
        """Close with a warning; a STOP goes out during a motion.

        It may run on any thread, at any moment at which Python collects garbage.
        """
        if self.loop is None or not self.links:
            return
        # A closed loop has no transports; asyncio closes their sockets with them.
        with suppress(RuntimeError):
            self.loop.call_soon_threadsafe(self._close_links)
        warn_unclosed(self.where, stopped=self.may_move)

    def _close_links(self) -> None:
        for port, link in self.links.items():
            if link.transport is not None:
                if self.may_move and port is not Port.STATE:
                    link.transport.write(STOP_FRAME)
                link.transport.close()
        self.links.clear()

    def forked(self) -> None:
        """Close the sockets of a forked process; the connections stay the parent's."""
        for link in self.links.values():
            socket = link.transport.get_extra_info("socket") if link.transport is not None else None
            if socket is not None and socket.fileno() >= 0:
                # The transport keeps its descriptor: to close it would remove the parent's
                # connection from the selector that both processes share.
                null = os.open(os.devnull, os.O_RDWR)
                os.dup2(null, socket.fileno(), inheritable=False)
                os.close(null)
        self.links.clear()
        self.may_move = False


class AsyncFlowRunner:
    """Runner of flows on the running loop."""

    def __init__(self, address: Address, make_core: MakeCore) -> None:
        self._connections = _Connections(str(address))
        self._links = self._connections.links
        self.address = address
        self.core = make_core(self._connections.time)
        self.guard = nullcontext()
        self._waiters: set[asyncio.Future[None]] = set()
        self._timer: asyncio.TimerHandle | None = None
        weakref.finalize(self, self._connections.close_dropped)
        drop_in_child(self)

    def forked(self) -> None:
        """Drop the connections in a forked process."""
        self._connections.forked()
        self._waiters.clear()
        self._timer = None
        self.core.forked()

    async def run(self, flow: Flow[T]) -> T:
        """Run a flow on this loop."""
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
        for port, link in self._links.items():
            if link.transport is None:
                continue
            if port in stops:
                link.transport.write(STOP_FRAME)
            while link.is_writable.is_set() and (data := core.due(port)) is not None:
                link.transport.write(data)
        loop = self._connections.loop
        if core.is_busy and self._timer is None and loop is not None:
            self._timer = loop.call_later(_SLICE, _tick, weakref.ref(self))

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
        if isinstance(effect, HangUp):
            self._hang_up()
            return True
        if isinstance(effect, SendAtOnce):
            for port in effect.ports:
                link = self._links.get(port)
                if link is None or link.transport is None:
                    effect.failures[port] = self.core.disconnected()
                else:
                    # At most the rest of one frame is queued: senders wait for an empty buffer.
                    link.transport.write(effect.data)
            return True
        link = self._links.get(effect.port)
        if link is None or link.transport is None:
            raise self.core.disconnected()
        await self._send(link, link.transport, effect)
        return True

    async def _send(self, link: _Link, transport: asyncio.Transport, effect: Send) -> None:
        data = effect.data
        for count, at in enumerate(range(0, len(data), FRAME_BYTES), 1):
            if effect.is_stopped:
                raise MotionStopped.because("RG631", "stopped before the trajectory was sent")
            if self._links.get(link.port) is not link:
                raise self.core.disconnected()
            transport.write(data[at : at + FRAME_BYTES])
            if not link.is_writable.is_set():
                await self._wait_writable(link, effect.timeout)
            elif count % _BREATH == 0:
                await asyncio.sleep(0)

    async def _wait_writable(self, link: _Link, timeout: float) -> None:
        try:
            async with deadline.timeout(timeout):
                await link.is_writable.wait()
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
            timer = loop.call_later(min(left, _SLICE), _wake, waiter)
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
        link = self._links.pop(port, None)
        self.core.dropped(port)
        if link is not None and link.transport is not None:
            link.transport.close()

    def _notify(self) -> None:
        for waiter in self._waiters:
            _wake(waiter)
        self._waiters.clear()

    async def _open(self, effect: Open) -> None:
        loop = asyncio.get_running_loop()
        number, name = self.address.port(effect.port), effect.port.name.lower()
        where = f"{self.address.host} port {number} ({name})"
        old = self._links.pop(effect.port, None)
        if old is not None and old.transport is not None:
            old.transport.close()
        try:
            async with deadline.timeout(effect.timeout):
                await loop.create_connection(
                    lambda: _Link(self, effect.port), self.address.host, number
                )
        except OSError as error:
            raise not_reached(where, error, effect.timeout) from error

    def opened(self, link: _Link) -> None:
        self._links[link.port] = link
        self.core.opened(link.port)

    def received(self, link: _Link, data: bytes) -> None:
        if self._links.get(link.port) is link:
            if not self.core.received(link.port, data):
                del self._links[link.port]
                if link.transport is not None:
                    link.transport.close()
            self._pump()
            self._notify()

    def lost(self, link: _Link, why: str) -> None:
        if self._links.get(link.port) is link:
            del self._links[link.port]
            self.core.lost(link.port, why)
            self._pump()
            self._notify()

    def _hang_up(self) -> None:
        self.core.closed()
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        links = list(self._links.values())
        self._links.clear()
        for link in links:
            if link.transport is not None:
                link.transport.close()
        self._notify()


def _tick(runner: "weakref.ref[AsyncFlowRunner]") -> None:
    owner = runner()
    if owner is not None:
        owner.tick()


def _wake(waiter: "asyncio.Future[None]") -> None:
    if not waiter.done():
        waiter.set_result(None)


class AsyncExecution(ExecutionApi[AsyncFlowRunner]):
    """`Execution` with awaitable methods."""


class AsyncProgramRun(RunApi[AsyncFlowRunner]):
    """`ProgramRun` with awaitable methods."""


class AsyncStream(StreamApi[AsyncFlowRunner]):
    """`Stream` with awaitable methods.

    The block is `async with robot.stream()`.
    """

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(self, kind: type[BaseException] | None, *_: object) -> None:
        if kind is not None:
            await self.cancel()
        elif self.total:
            await self.result()

    async def extend(
        self,
        points: Iterable[tuple[float, Sequence[float]]]
        | AsyncIterable[tuple[float, Sequence[float]]],
    ) -> None:
        """Add points (time, joints) from an iterable, batch by batch.

        The iterable may be infinite. Points of an asynchronous iterable, which may wait for each,
        are added one by one.
        """
        if isinstance(points, AsyncIterable):
            async for time, joints in points:
                await self.append([time], [joints])
            return
        for times, positions in batches(points, self._carrier.core.batch):
            await self.append(times, positions)


class AsyncRobot(RobotApi[AsyncFlowRunner, AsyncExecution, AsyncStream, AsyncProgramRun]):
    """One motion group of a robot on asyncio.

    Arguments and methods are those of `Robot`.
    """

    _carrier_type = AsyncFlowRunner
    _execution_type = AsyncExecution
    _stream_type = AsyncStream
    _run_type = AsyncProgramRun

    async def connect(self) -> Self:
        """Connect and find out who is there.

        Raises ConnectionFailed, RobotTimeout, ProtocolError, IncompatibleDriver.
        """
        await self._carrier.run(flows.connect.connect(self._core))
        return self

    async def __aenter__(self) -> Self:
        return self if self.is_connected else await self.connect()

    async def __aexit__(self, kind: type[BaseException] | None, *_: object) -> None:
        unfinished = "" if kind is not None else self._unfinished()
        await self.close()
        if unfinished:
            warnings.warn(unfinished, RuntimeWarning, stacklevel=2)

    async def states(self, timeout: float | None = None) -> AsyncIterator[State]:
        """Yield each new state; wait at most `timeout` s for each."""
        while True:
            yield await self.next_state(timeout)
