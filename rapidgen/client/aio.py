"""`AsyncRobot`: the same surface on asyncio, also on a loop whose clock is simulated.

Only `create_connection`, `time`, `create_future` and `call_later` of the running loop are used.
"""

import asyncio
from collections.abc import AsyncIterator, Callable, Iterator
from contextlib import contextmanager
from os import PathLike
from types import TracebackType
from typing import Self, TypeVar, cast

from rapidgen.client import flows
from rapidgen.client.address import Address
from rapidgen.client.core import Core, Timeouts
from rapidgen.client.errors import (
    ConnectionFailed,
    MotionStopped,
    RobotError,
    RobotTimeout,
    fault,
    os_reason,
)
from rapidgen.client.flows import Connect, Flow, Send, Wait
from rapidgen.client.group import Group
from rapidgen.client.recording import Recording
from rapidgen.client.run import Result, Run
from rapidgen.client.state import Driver, Progress, State
from rapidgen.client.target import resolve
from rapidgen.client.trajectory import Trajectory
from rapidgen.client.view import View
from rapidgen.config.model import RobotConfig
from rapidgen.diagnostics import Diagnostic
from rapidgen.protocol.bulk import FRAME_BYTES
from rapidgen.protocol.spec import Port

T = TypeVar("T")
_SLICE = 0.1
"""s: time itself is looked at this often while nothing comes."""
_BREATH = 64
"""Frames after which a sender lets the others of its loop do something."""


class _Link(asyncio.Protocol):
    """One connection as asyncio sees it."""

    def __init__(self, robot: "AsyncRobot", port: Port) -> None:
        self.port = port
        self.transport: asyncio.Transport | None = None
        self.room = asyncio.Event()
        self.room.set()
        self._robot = robot

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self.transport = cast("asyncio.Transport", transport)
        # Nothing may lie in a buffer of ours: a STOP would have to wait behind it.
        self.transport.set_write_buffer_limits(high=0)
        self._robot._opened(self)

    def data_received(self, data: bytes) -> None:
        self._robot._received(self, data)

    def connection_lost(self, exc: Exception | None) -> None:
        why = "the controller closed it"
        if isinstance(exc, OSError):
            why = os_reason(exc)
        self.room.set()
        self._robot._lost(self, why)

    def pause_writing(self) -> None:
        self.room.clear()

    def resume_writing(self) -> None:
        self.room.set()


class AsyncRobot:
    """One motion group of a robot; see `Robot`, whose arguments and methods it has."""

    def __init__(
        self,
        target: "str | PathLike[str] | RobotConfig",
        *,
        address: str | Address | None = None,
        group: str = "",
        timeouts: Timeouts | None = None,
        watch: bool = False,
        plain: bool = False,
        reconnect: float = 0.0,
    ) -> None:
        self._loop: asyncio.AbstractEventLoop | None = None
        self.address, known = resolve(target, address, group)
        self._core = Core(
            known,
            timeouts or Timeouts(),
            self._time,
            watch=watch,
            plain=plain,
            reconnect=reconnect,
        )
        self._links: dict[Port, _Link] = {}
        self._waiters: set[asyncio.Future[None]] = set()

    def _time(self) -> float:
        return self._loop.time() if self._loop is not None else 0.0

    # Connection

    async def connect(self) -> Self:
        """Connect and find out who is there.

        Raises ConnectionFailed, RobotTimeout, ProtocolError, IncompatibleDriver.
        """
        try:
            await self._run(flows.connect(self._core))
        except BaseException:
            self._hang_up()
            raise
        return self

    async def close(self) -> None:
        """Close all connections. A motion under way is stopped first."""
        run = self._core.run
        try:
            if run is not None and not run.is_over and Port.MOTION in self._links:
                await self.stop()
        finally:
            self._hang_up()

    def _hang_up(self) -> None:
        self._core.closed()
        links, self._links = list(self._links.values()), {}
        for link in links:
            if link.transport is not None:
                link.transport.close()
        self._notify()

    async def __aenter__(self) -> Self:
        return self if self.is_connected else await self.connect()

    async def __aexit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        await self.close()

    @property
    def is_connected(self) -> bool:
        """Whether all connections stand."""
        return self._core.is_connected

    @property
    def driver(self) -> Driver:
        """Who answered, and what it cannot do."""
        return self._core.tracker.driver

    @property
    def group(self) -> Group:
        """Joints, limits and policy. Raises ConnectionLost before they are known."""
        if self._core.group is None:
            raise self._core.disconnected()
        return self._core.group

    @property
    def messages(self) -> tuple[tuple[float, str], ...]:
        """The last messages received, as (time, text)."""
        return self._core.tracker.messages

    # State

    @property
    def state(self) -> State:
        """The newest state. Raises ConnectionLost before the first."""
        state = self._core.tracker.state
        if state is None:
            raise self._core.disconnected()
        return state

    async def next_state(self, timeout: float | None = None) -> State:
        """The state of the next joint message. Raises RobotTimeout, ConnectionLost."""
        return await self._run(flows.next_state(self._core, timeout))

    async def states(self, timeout: float | None = None) -> AsyncIterator[State]:
        """Each new state as it comes; `timeout` s for each."""
        while True:
            yield await self.next_state(timeout)

    async def wait_until(self, condition: Callable[[State], bool], timeout: float) -> State:
        """The first state for which `condition` holds. Raises RobotTimeout, ConnectionLost."""
        flow = flows.wait_until(self._core, condition, timeout, "what was waited for")
        return await self._run(flow)

    @contextmanager
    def recording(self) -> Iterator[Recording]:
        """Keep every joint message while the block runs."""
        recording = Recording(self.group)
        self._core.tracker.listeners.append(recording.add)
        try:
            yield recording
        finally:
            self._core.tracker.listeners.remove(recording.add)

    # Motion

    def check(self, trajectory: Trajectory) -> tuple[Diagnostic, ...]:
        """Warnings about a trajectory. Raises InvalidTrajectory with every fault; sends nothing."""
        return self._core.plan(trajectory).warnings

    async def execute(self, trajectory: Trajectory) -> "AsyncExecution":
        """Send a trajectory; returns when the controller has taken it and begins to move.

        Raises InvalidTrajectory and NotReady before a byte is sent, TrajectoryRefused when
        nothing will move, RobotTimeout, ConnectionLost. Cancelling it stops the robot.
        """
        return AsyncExecution(self, await self._run(flows.execute(self._core, trajectory)))

    async def stop(self) -> State | None:
        """Stop at once; the state in which the robot stands.

        STOP is written before anything is awaited, if there is a connection. Without one the
        motion port alone is opened and None is returned. Raises StopFailed: use the emergency
        stop.
        """
        return await self._run(flows.stop(self._core))

    async def _run(self, flow: Flow[T]) -> T:
        """Carry out a flow on this loop."""
        self._loop = asyncio.get_running_loop()
        outcome: object = None
        failure: BaseException | None = None
        while True:
            error, failure = failure, None
            try:
                effect = flow.send(outcome) if error is None else flow.throw(error)
            except StopIteration as end:
                value: T = end.value
                return value
            try:
                outcome = await self._perform(effect)
            except (RobotError, asyncio.CancelledError) as raised:
                failure = raised

    async def _perform(self, effect: Connect | Send | Wait) -> bool:
        if isinstance(effect, Wait):
            return await self._wait(effect)
        if isinstance(effect, Connect):
            await self._connect(effect)
            return True
        link = self._links.get(effect.port)
        if link is None or link.transport is None:
            raise self._core.disconnected()
        if effect.urgent:
            # Behind at most the rest of one frame: senders wait for an empty buffer.
            link.transport.write(effect.data)
        else:
            await self._send(link, link.transport, effect)
        return True

    async def _send(self, link: _Link, transport: asyncio.Transport, effect: Send) -> None:
        data = effect.data
        for count, at in enumerate(range(0, len(data), FRAME_BYTES), 1):
            if effect.is_stopped:
                raise MotionStopped(fault("RG631", "stopped before the trajectory was sent"))
            if self._links.get(link.port) is not link:
                raise self._core.disconnected()
            transport.write(data[at : at + FRAME_BYTES])
            if not link.room.is_set():
                await self._room(link, effect.timeout)
            elif count % _BREATH == 0:
                await asyncio.sleep(0)

    async def _room(self, link: _Link, timeout: float) -> None:
        try:
            async with asyncio.timeout(timeout):
                await link.room.wait()
        except TimeoutError as error:
            raise RobotTimeout(
                fault("RG603", f"the controller took no byte for {timeout:g} s", "look at it")
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
            self._core.poll()
        return True

    def _notify(self) -> None:
        for waiter in self._waiters:
            _wake(waiter)
        self._waiters.clear()

    async def _connect(self, effect: Connect) -> None:
        loop = asyncio.get_running_loop()
        number, name = self.address.port(effect.port), effect.port.name.lower()
        where = f"{self.address.host} port {number} ({name})"
        old = self._links.pop(effect.port, None)
        if old is not None and old.transport is not None:
            old.transport.close()
        try:
            async with asyncio.timeout(effect.timeout):
                await loop.create_connection(
                    lambda: _Link(self, effect.port), self.address.host, number
                )
        except TimeoutError as error:
            raise ConnectionFailed(
                fault(
                    "RG601",
                    f"no answer from {where} within {effect.timeout:g} s",
                    "is the controller on, and this machine in its network?",
                )
            ) from error
        except OSError as error:
            raise ConnectionFailed(
                fault(
                    "RG601",
                    f"cannot connect to {where}: {os_reason(error)}",
                    "is the driver's task running? `rapidgen sim` starts a virtual controller",
                )
            ) from error

    def _opened(self, link: _Link) -> None:
        self._links[link.port] = link
        self._core.opened(link.port)

    def _received(self, link: _Link, data: bytes) -> None:
        if self._links.get(link.port) is link:
            if not self._core.received(link.port, data):
                del self._links[link.port]
                if link.transport is not None:
                    link.transport.close()
            self._notify()

    def _lost(self, link: _Link, why: str) -> None:
        if self._links.get(link.port) is link:
            del self._links[link.port]
            self._core.lost(link.port, why)
            self._notify()


def _wake(waiter: "asyncio.Future[None]") -> None:
    if not waiter.done():
        waiter.set_result(None)


class AsyncExecution(View):
    """A trajectory that the controller has taken."""

    def __init__(self, robot: AsyncRobot, run: Run) -> None:
        super().__init__(run)
        self._robot = robot

    @property
    def progress(self) -> Progress:
        """How far it is, now."""
        return self._run.progress

    async def result(self, timeout: float | None = None) -> Result:
        """Wait for the end; by default four times the planned time and 30 s.

        Raises MotionStopped, MotionFailed, ConnectionLost; RobotTimeout when it did not end in
        time (it goes on). Cancelling this stops the robot.
        """
        return await self._robot._run(flows.result(self._robot._core, self._run, timeout))

    async def cancel(self) -> State | None:
        """Stop this motion; the state in which the robot stands. Nothing when it is over."""
        if not self._run.is_over:
            self._stopped = await self._robot.stop()
        return self._stopped
