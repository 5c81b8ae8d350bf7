"""`AsyncRobot`: the same surface on asyncio, also on a loop whose clock is simulated.

Only `create_connection`, `time`, `create_future` and `call_later` of the running loop are used.
"""

import asyncio
from collections.abc import AsyncIterable, AsyncIterator, Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from os import PathLike
from types import TracebackType
from typing import Self, TypeVar, cast

import numpy.typing as npt

from rapidgen.client.address import Address
from rapidgen.client.core.feed import Feed, batches
from rapidgen.client.core.group import Group
from rapidgen.client.core.motion import CommandedMotion, Result, Way
from rapidgen.client.core.robot import STOP_FRAME, Core, Timeouts
from rapidgen.client.core.state import Driver, Event, Feedback, Progress, State
from rapidgen.client.core.view import StreamView, View
from rapidgen.client.errors import (
    MotionStopped,
    RobotError,
    RobotTimeout,
    fault,
    not_reached,
    os_reason,
)
from rapidgen.client.flows import connect as connect_flows
from rapidgen.client.flows import control as control_flows
from rapidgen.client.flows import download as flows
from rapidgen.client.flows import state as state_flows
from rapidgen.client.flows import stop as stop_flows
from rapidgen.client.flows import stream as stream_flows
from rapidgen.client.flows.effects import Close, Effect, Flow, Open, Send, Wait
from rapidgen.client.recording import JointRecording
from rapidgen.client.target import resolve
from rapidgen.client.trajectory import Trajectory
from rapidgen.config.model import RobotConfig
from rapidgen.diagnostics import Diagnostic
from rapidgen.wire.simple_message.bulk import FRAME_BYTES
from rapidgen.wire.simple_message.spec import Port

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
        feedback: bool = False,
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
            feedback=feedback,
            # No robot is at this machine's own address.
            simulated=self.address.is_loopback,
        )
        self._links: dict[Port, _Link] = {}
        self._waiters: set[asyncio.Future[None]] = set()
        self._timer: asyncio.TimerHandle | None = None

    def _time(self) -> float:
        return self._loop.time() if self._loop is not None else 0.0

    # Connection

    async def connect(self) -> Self:
        """Connect and find out who is there.

        Raises ConnectionFailed, RobotTimeout, ProtocolError, IncompatibleDriver.
        """
        try:
            await self._run(connect_flows.connect(self._core))
        except BaseException:
            self._hang_up()
            raise
        return self

    async def close(self) -> None:
        """Close all connections. A motion under way is stopped first."""
        run = self._core.motion
        try:
            if run is not None and not run.is_over and Port.MOTION in self._links:
                await self.stop()
        finally:
            self._hang_up()

    def _hang_up(self) -> None:
        self._core.closed()
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
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
        return self._core.state_port.driver

    @property
    def group(self) -> Group:
        """Joints, limits and policy. Raises ConnectionLost before they are known."""
        if self._core.group is None:
            raise self._core.disconnected()
        return self._core.group

    @property
    def messages(self) -> tuple[tuple[float, str], ...]:
        """The last messages received, as (time, text)."""
        return self._core.state_port.messages

    # State

    @property
    def state(self) -> State:
        """The newest state. Raises ConnectionLost before the first."""
        state = self._core.state_port.state
        if state is None:
            raise self._core.disconnected()
        return state

    async def next_state(self, timeout: float | None = None) -> State:
        """The state of the next joint message. Raises RobotTimeout, ConnectionLost."""
        return await self._run(state_flows.next_state(self._core, timeout))

    async def states(self, timeout: float | None = None) -> AsyncIterator[State]:
        """Each new state as it comes; `timeout` s for each."""
        while True:
            yield await self.next_state(timeout)

    async def wait_until(self, condition: Callable[[State], bool], timeout: float) -> State:
        """The first state for which `condition` holds. Raises RobotTimeout, ConnectionLost."""
        flow = state_flows.wait_until(self._core, condition, timeout, "what was waited for")
        return await self._run(flow)

    @contextmanager
    def recording(self) -> Iterator[JointRecording]:
        """Keep every joint message while the block runs."""
        recording = JointRecording(self.group)
        self._core.state_port.listeners.append(recording.add)
        try:
            yield recording
        finally:
            self._core.state_port.listeners.remove(recording.add)

    @property
    def events(self) -> tuple[Event, ...]:
        """The last entries of the controller's event log, where the driver tells them."""
        return tuple(self._core.state_port.events)

    async def next_event(
        self, timeout: float | None = None, *, after: Event | None = None
    ) -> Event:
        """The next event, or the one behind `after`. Raises RobotTimeout, ConnectionLost."""
        return await self._run(state_flows.next_event(self._core, timeout, after))

    async def next_feedback(self, timeout: float | None = None) -> Feedback:
        """The next joints with the controller's time.

        Raises NotSupported where nobody sends them, RobotTimeout, ConnectionLost.
        """
        return await self._run(state_flows.next_feedback(self._core, timeout))

    # Motion

    def check(self, trajectory: Trajectory) -> tuple[Diagnostic, ...]:
        """Warnings about a trajectory. Raises InvalidTrajectory with every fault; sends nothing."""
        return self._core.plan(trajectory).warnings

    async def execute(self, trajectory: Trajectory, *, way: Way | None = None) -> "AsyncExecution":
        """Send a trajectory; returns when the controller has taken it and begins to move.

        `way` is `download` (whole, before anything moves) or `stream` (the rest is sent while
        the robot moves); by default a trajectory that the driver's ring does not hold is
        streamed. Raises InvalidTrajectory and NotReady before a byte is sent, TrajectoryRefused
        when nothing will move, NotSupported, RobotTimeout, ConnectionLost. Cancelling it stops
        the robot.
        """
        run = await self._run(stream_flows.execute(self._core, trajectory, way))
        return AsyncExecution(self, run)

    def way_for(self, trajectory: Trajectory) -> Way:
        """The way that `execute` takes by default. Raises InvalidTrajectory, NotReady."""
        return self._core.way_for(trajectory)

    def stream(self, names: Sequence[str] = (), *, fallback: bool = True) -> "AsyncStream":
        """A trajectory without an end that is known: see `AsyncStream`. Nothing is sent yet.

        `names` are those of the columns, by default the robot's own. With `fallback` a driver
        that does not stream gets the points as a whole, at the end.
        """
        return AsyncStream(self, Feed(names, may_download=fallback))

    async def pause(self) -> None:
        """Hold what moves on its path. Raises NotSupported, RequestRefused, RobotTimeout."""
        await self._run(control_flows.pause(self._core, True))

    async def resume(self) -> None:
        """Go on behind a pause. Raises as `pause`."""
        await self._run(control_flows.pause(self._core, False))

    async def set_speed(self, percent: float) -> None:
        """Go at 1 to 100 % of the programmed speed, until the next motion. Raises as `pause`."""
        await self._run(control_flows.speed(self._core, percent))

    async def read_signal(self, signal: str | int) -> float:
        """A signal that the configuration exposes, by name or number. Raises as `pause`."""
        return await self._run(control_flows.signal(self._core, signal, None))

    async def write_signal(self, signal: str | int, value: float) -> float:
        """Set a signal; the value as it was read then. Raises as `pause`."""
        return await self._run(control_flows.signal(self._core, signal, value))

    async def stop(self) -> State | None:
        """Stop at once; the state in which the robot stands.

        STOP is written before anything is awaited, if there is a connection. Without one the
        motion port alone is opened and None is returned. Raises StopFailed: use the emergency
        stop.
        """
        return await self._run(stop_flows.stop(self._core))

    async def _run(self, flow: Flow[T]) -> T:
        """Carry out a flow on this loop."""
        self._loop = asyncio.get_running_loop()
        outcome: object = None
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
        """Send what is due, as far as there is room for it."""
        core = self._core
        stops = core.blind_stops()
        for port, link in self._links.items():
            if link.transport is None:
                continue
            if port in stops:
                link.transport.write(STOP_FRAME)
            while link.room.is_set() and (data := core.due(port)) is not None:
                link.transport.write(data)
        if core.is_busy and self._timer is None and self._loop is not None:
            self._timer = self._loop.call_later(_SLICE, self._tick)

    def _tick(self) -> None:
        self._timer = None
        self._core.poll()
        self._pump()
        self._notify()

    async def _perform(self, effect: Effect) -> bool:
        if isinstance(effect, Wait):
            return await self._wait(effect)
        if isinstance(effect, Close):
            self._close(effect.port)
            return True
        if isinstance(effect, Open):
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
            self._pump()
        return True

    def _close(self, port: Port) -> None:
        link = self._links.pop(port, None)
        self._core.ports[port].is_open = False
        if link is not None and link.transport is not None:
            link.transport.close()

    def _notify(self) -> None:
        for waiter in self._waiters:
            _wake(waiter)
        self._waiters.clear()

    async def _connect(self, effect: Open) -> None:
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
        except OSError as error:
            raise not_reached(where, error, effect.timeout) from error

    def _opened(self, link: _Link) -> None:
        self._links[link.port] = link
        self._core.opened(link.port)

    def _received(self, link: _Link, data: bytes) -> None:
        if self._links.get(link.port) is link:
            if not self._core.received(link.port, data):
                del self._links[link.port]
                if link.transport is not None:
                    link.transport.close()
            self._pump()
            self._notify()

    def _lost(self, link: _Link, why: str) -> None:
        if self._links.get(link.port) is link:
            del self._links[link.port]
            self._core.lost(link.port, why)
            self._pump()
            self._notify()


def _wake(waiter: "asyncio.Future[None]") -> None:
    if not waiter.done():
        waiter.set_result(None)


class AsyncExecution(View):
    """A trajectory that the controller has taken."""

    def __init__(self, robot: AsyncRobot, run: CommandedMotion) -> None:
        super().__init__(run)
        self._robot = robot

    @property
    def progress(self) -> Progress:
        """How far it is, now."""
        return self._run.progress

    async def result(self, timeout: float | None = None) -> Result:
        """Wait for the end; by default for as long as the robot gets on or is paused.

        Raises MotionStopped, MotionFailed, ConnectionLost; RobotTimeout when it did not end in
        time (it goes on). Cancelling this stops the robot.
        """
        return await self._robot._run(flows.result(self._robot._core, self._run, timeout))

    async def cancel(self) -> State | None:
        """Stop this motion; the state in which the robot stands. Nothing when it is over."""
        if not self._run.is_over:
            self._stopped = await self._robot.stop()
        return self._stopped


class AsyncStream(StreamView):
    """Points that the robot executes while more of them come.

    `async with robot.stream() as stream:` ends it and waits for the robot at the end of the block;
    when the block is left by an exception, the robot is stopped. Each point has the time s from
    the stream's beginning and joints in rad or m; the first is where the robot stands. Motion
    begins when the driver has enough of them, or at `flush`, `end` and `result`.

    What is wrong with points is told before they are sent (InvalidTrajectory, the stream goes
    on), by the controller at the first ones (TrajectoryRefused, nothing moved) or at later ones:
    then the robot executes those before, and MotionFailed tells reason, point and joint.
    """

    def __init__(self, robot: AsyncRobot, feed: Feed) -> None:
        super().__init__(feed)
        self._robot = robot

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        if error is not None:
            await self.cancel()
        elif self.total:
            await self.result()

    @property
    def progress(self) -> Progress:
        """How far it is, now; `total` are the points so far."""
        return self._feed.progress

    async def append(self, times: npt.ArrayLike, positions: npt.ArrayLike) -> None:
        """Add points: `times` (n,) s from the beginning, `positions` (n, k).

        Waits while the controller has no room. Raises InvalidTrajectory (nothing of these was
        sent), NotReady, TrajectoryRefused, MotionFailed, MotionStopped, NotSupported,
        RobotTimeout, ConnectionLost. Cancelling this stops the robot.
        """
        await self._do(stream_flows.append(self._robot._core, self._feed, times, positions))

    async def extend(
        self,
        points: Iterable[tuple[float, Sequence[float]]]
        | AsyncIterable[tuple[float, Sequence[float]]],
    ) -> None:
        """Add points (time, joints) from an iterable, also one without end, batch by batch.

        Those of an asynchronous one, which may let itself be waited for, go one by one.
        """
        if isinstance(points, AsyncIterable):
            async for time, joints in points:
                await self.append([time], [joints])
            return
        for times, positions in batches(points, stream_flows.batch_size(self._robot._core)):
            await self.append(times, positions)

    async def flush(self) -> None:
        """Let the robot start with what there is. Raises as `append`."""
        await self._do(stream_flows.flush(self._robot._core, self._feed))

    async def end(self) -> None:
        """Nothing follows: the last point is a stop point. Raises as `append`."""
        await self._do(stream_flows.end(self._robot._core, self._feed))

    async def result(self, timeout: float | None = None) -> Result:
        """End it, and wait until all was executed; by default for as long as the robot gets on.

        Raises as `Execution.result`.
        """
        return await self._do(stream_flows.finish(self._robot._core, self._feed, timeout))

    async def cancel(self) -> State | None:
        """Stop the robot; the state in which it stands. Nothing when it is over."""
        if self._feed.run is not None and not self._feed.run.is_over:
            self._stopped = await self._robot.stop()
        return self._stopped

    async def _do(self, flow: Flow[T]) -> T:
        return await self._robot._run(flow)
