"""`Robot`: the synchronous client. Callers' threads write, one thread a robot reads."""

import threading
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from os import PathLike
from types import TracebackType
from typing import Self, TypeVar

import numpy.typing as npt

from rapidgen.client.address import Address
from rapidgen.client.channels import Channel, Reader
from rapidgen.client.core.feed import Feed, batches
from rapidgen.client.core.group import Group
from rapidgen.client.core.motion import CommandedMotion, Result, Way
from rapidgen.client.core.robot import STOP_FRAME, Core, Timeouts
from rapidgen.client.core.state import Driver, Event, Feedback, Progress, State
from rapidgen.client.core.view import StreamView, View
from rapidgen.client.errors import ConnectionLost, MotionStopped, RobotError, fault
from rapidgen.client.flows import connect as connect_flows
from rapidgen.client.flows import control as control_flows
from rapidgen.client.flows import download as flows
from rapidgen.client.flows import state as state_flows
from rapidgen.client.flows import stop as stop_flows
from rapidgen.client.flows import stream as stream_flows
from rapidgen.client.flows.effects import Close, Effect, Flow, Open, Wait
from rapidgen.client.recording import JointRecording
from rapidgen.client.target import resolve
from rapidgen.client.trajectory import Trajectory
from rapidgen.config.model import RobotConfig
from rapidgen.diagnostics import Diagnostic
from rapidgen.wire.simple_message.spec import Port

T = TypeVar("T")
_SLICE = 0.1
"""s: time itself is looked at this often while nothing comes."""


class Robot:
    """One motion group of a robot, driven over its rapidgen driver or a plain abb_driver.

    `target` is a configuration file, a shipped name, a RobotConfig, or an address
    `HOST[:MOTION[,STATE]]`; a configuration is looked for at `address`, else on this machine.
    `group` names the motion group where there are several. `watch` never opens the motion port.
    `plain` does not ask for a rapidgen driver. `reconnect` is for how many s a lost connection
    is tried again by the next call; nothing is ever sent again. `feedback` asks for joints with
    the controller's own time and velocities.

    All methods may be called from any thread. Joints are rad and m in URDF order.
    """

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
        self.address, known = resolve(target, address, group)
        self._core = Core(
            known,
            timeouts or Timeouts(),
            time.monotonic,
            watch=watch,
            plain=plain,
            reconnect=reconnect,
            feedback=feedback,
            # No robot is at this machine's own address.
            simulated=self.address.is_loopback,
        )
        self._changed = threading.Condition()
        self._channels: dict[Port, Channel] = {}
        self._reader: Reader | None = None

    # Connection

    def connect(self) -> Self:
        """Connect and find out who is there.

        Raises ConnectionFailed, RobotTimeout, ProtocolError, IncompatibleDriver.
        """
        try:
            self._run(connect_flows.connect(self._core))
        except BaseException:
            self._hang_up()
            raise
        return self

    def close(self) -> None:
        """Close all connections. A motion under way is stopped first."""
        run = self._core.motion
        try:
            if run is not None and not run.is_over and Port.MOTION in self._channels:
                self.stop()
        finally:
            self._hang_up()

    def _hang_up(self) -> None:
        with self._changed:
            self._core.closed()
            channels, self._channels = list(self._channels.values()), {}
            reader, self._reader = self._reader, None
        if reader is not None:
            for channel in channels:
                reader.remove(channel)
            reader.close()

    def __enter__(self) -> Self:
        return self if self.is_connected else self.connect()

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()

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
        with self._changed:
            return self._core.state_port.messages

    # State

    @property
    def state(self) -> State:
        """The newest state. Raises ConnectionLost before the first."""
        with self._changed:
            state = self._core.state_port.state
            if state is None:
                raise self._core.disconnected()
            return state

    def next_state(self, timeout: float | None = None) -> State:
        """The state of the next joint message. Raises RobotTimeout, ConnectionLost."""
        return self._run(state_flows.next_state(self._core, timeout))

    def states(self, timeout: float | None = None) -> Iterator[State]:
        """Each new state as it comes; `timeout` s for each."""
        while True:
            yield self.next_state(timeout)

    def wait_until(self, condition: Callable[[State], bool], timeout: float) -> State:
        """The first state for which `condition` holds. Raises RobotTimeout, ConnectionLost."""
        flow = state_flows.wait_until(self._core, condition, timeout, "what was waited for")
        return self._run(flow)

    @contextmanager
    def recording(self) -> Iterator[JointRecording]:
        """Keep every joint message while the block runs."""
        with self._changed:
            recording = JointRecording(self.group)
            self._core.state_port.listeners.append(recording.add)
        try:
            yield recording
        finally:
            with self._changed:
                self._core.state_port.listeners.remove(recording.add)

    @property
    def events(self) -> tuple[Event, ...]:
        """The last entries of the controller's event log, where the driver tells them."""
        with self._changed:
            return tuple(self._core.state_port.events)

    def next_event(self, timeout: float | None = None, *, after: Event | None = None) -> Event:
        """The next event, or the one behind `after`. Raises RobotTimeout, ConnectionLost."""
        return self._run(state_flows.next_event(self._core, timeout, after))

    def next_feedback(self, timeout: float | None = None) -> Feedback:
        """The next joints with the controller's time.

        Raises NotSupported where nobody sends them, RobotTimeout, ConnectionLost.
        """
        return self._run(state_flows.next_feedback(self._core, timeout))

    # Motion

    def check(self, trajectory: Trajectory) -> tuple[Diagnostic, ...]:
        """Warnings about a trajectory. Raises InvalidTrajectory with every fault; sends nothing."""
        with self._changed:
            return self._core.plan(trajectory).warnings

    def execute(self, trajectory: Trajectory, *, way: Way | None = None) -> "Execution":
        """Send a trajectory; returns when the controller has taken it and begins to move.

        `way` is `download` (whole, before anything moves) or `stream` (the rest is sent while
        the robot moves); by default a trajectory that the driver's ring does not hold is
        streamed. Raises InvalidTrajectory and NotReady before a byte is sent, TrajectoryRefused
        when nothing will move, NotSupported, RobotTimeout, ConnectionLost.
        """
        return Execution(self, self._run(stream_flows.execute(self._core, trajectory, way)))

    def way_for(self, trajectory: Trajectory) -> Way:
        """The way that `execute` takes by default. Raises InvalidTrajectory, NotReady."""
        with self._changed:
            return self._core.way_for(trajectory)

    def stream(self, names: Sequence[str] = (), *, fallback: bool = True) -> "Stream":
        """A trajectory without an end that is known: see `Stream`. Nothing is sent yet.

        `names` are those of the columns, by default the robot's own. With `fallback` a driver
        that does not stream gets the points as a whole, at the end.
        """
        return Stream(self, Feed(names, may_download=fallback))

    def pause(self) -> None:
        """Hold what moves on its path. Raises NotSupported, RequestRefused, RobotTimeout."""
        self._run(control_flows.pause(self._core, True))

    def resume(self) -> None:
        """Go on behind a pause. Raises as `pause`."""
        self._run(control_flows.pause(self._core, False))

    def set_speed(self, percent: float) -> None:
        """Go at 1 to 100 % of the programmed speed, until the next motion. Raises as `pause`."""
        self._run(control_flows.speed(self._core, percent))

    def read_signal(self, signal: str | int) -> float:
        """A signal that the configuration exposes, by name or number. Raises as `pause`."""
        return self._run(control_flows.signal(self._core, signal, None))

    def write_signal(self, signal: str | int, value: float) -> float:
        """Set a signal; the value as it was read then. Raises as `pause`."""
        return self._run(control_flows.signal(self._core, signal, value))

    def stop(self) -> State | None:
        """Stop at once, from any thread; the state in which the robot stands.

        Also without a connection: then the motion port alone is opened, nobody sees the robot
        stand, and None is returned. Raises StopFailed: use the emergency stop.
        """
        return self._run(stop_flows.stop(self._core))

    def _run(self, flow: Flow[T]) -> T:
        """Carry out a flow: effects without the lock, its own steps with it."""
        outcome: object = None
        failure: BaseException | None = None
        while True:
            error, failure = failure, None
            try:
                with self._changed:
                    try:
                        effect = flow.send(outcome) if error is None else flow.throw(error)
                    finally:
                        self._pump()
            except StopIteration as end:
                value: T = end.value
                return value
            try:
                outcome = self._perform(effect)
            except (RobotError, KeyboardInterrupt) as raised:
                failure = raised

    def _pump(self) -> None:
        """Send what is due, as far as it goes without waiting. The lock is held."""
        core = self._core
        stops = core.blind_stops()
        for port, channel in self._channels.items():
            try:
                if port in stops:
                    channel.offer_behind(STOP_FRAME)
                channel.offer(lambda port=port: core.due(port))  # type: ignore[misc]
            except RobotError as error:
                # The reader hears of it too.
                core.state_port.note(str(error))

    def _tick(self) -> None:
        with self._changed:
            self._core.poll()
            self._pump()
            self._changed.notify_all()

    def _perform(self, effect: Effect) -> bool:
        if isinstance(effect, Wait):
            return self._wait(effect)
        if isinstance(effect, Close):
            self._close(effect.port)
            return True
        if isinstance(effect, Open):
            self._connect(effect)
            return True
        channel = self._channels.get(effect.port)
        if channel is None:
            raise self._core.disconnected()
        try:
            if effect.urgent:
                channel.send_urgent(effect.data, effect.timeout)
            elif not channel.send(effect.data, effect.timeout, lambda: effect.is_stopped):
                raise MotionStopped(fault("RG631", "stopped before the trajectory was sent"))
        except ConnectionLost as error:
            with self._changed:
                # The reader was first, and knows better why.
                if self._channels.get(effect.port) is not channel:
                    raise self._core.disconnected() from error
            raise
        return True

    def _wait(self, effect: Wait) -> bool:
        deadline = time.monotonic() + effect.timeout
        with self._changed:
            while not effect.until():
                left = deadline - time.monotonic()
                if left <= 0:
                    return False
                self._changed.wait(min(left, _SLICE))
                self._core.poll()
                self._pump()
            return True

    def _close(self, port: Port) -> None:
        with self._changed:
            channel = self._channels.pop(port, None)
            self._core.ports[port].is_open = False
            if channel is not None and self._reader is not None:
                self._reader.remove(channel)

    def _connect(self, effect: Open) -> None:
        channel = Channel(self.address, effect.port, effect.timeout)
        with self._changed:
            if self._reader is None:
                self._reader = Reader(
                    self._received,
                    self._lost,
                    self._tick,
                    lambda: self._core.is_busy,
                    str(self.address),
                )
            old = self._channels.get(effect.port)
            if old is not None:
                self._reader.remove(old)
            self._channels[effect.port] = channel
            self._core.opened(effect.port)
            self._reader.add(channel)

    def _received(self, channel: Channel, data: bytes) -> None:
        with self._changed:
            if self._channels.get(channel.port) is channel:
                if not self._core.received(channel.port, data):
                    del self._channels[channel.port]
                    assert self._reader is not None
                    self._reader.remove(channel)
                self._pump()
                self._changed.notify_all()

    def _lost(self, channel: Channel, why: str) -> None:
        with self._changed:
            if self._channels.get(channel.port) is channel:
                del self._channels[channel.port]
                self._core.lost(channel.port, why)
                self._pump()
                self._changed.notify_all()


class Execution(View):
    """A trajectory that the controller has taken."""

    def __init__(self, robot: Robot, run: CommandedMotion) -> None:
        super().__init__(run)
        self._robot = robot

    @property
    def progress(self) -> Progress:
        """How far it is, now."""
        with self._robot._changed:
            return self._run.progress

    def result(self, timeout: float | None = None) -> Result:
        """Wait for the end; by default for as long as the robot gets on or is paused.

        Raises MotionStopped, MotionFailed, ConnectionLost; RobotTimeout when it did not end in
        time (it goes on). Ctrl-C here stops the robot.
        """
        return self._robot._run(flows.result(self._robot._core, self._run, timeout))

    def cancel(self) -> State | None:
        """Stop this motion; the state in which the robot stands. Nothing when it is over."""
        if not self._run.is_over:
            self._stopped = self._robot.stop()
        return self._stopped


class Stream(StreamView):
    """Points that the robot executes while more of them come.

    `with robot.stream() as stream:` ends it and waits for the robot at the end of the block;
    when the block is left by an exception, the robot is stopped. Each point has the time s from
    the stream's beginning and joints in rad or m; the first is where the robot stands. Motion
    begins when the driver has enough of them, or at `flush`, `end` and `result`.

    What is wrong with points is told before they are sent (InvalidTrajectory, the stream goes
    on), by the controller at the first ones (TrajectoryRefused, nothing moved) or at later ones:
    then the robot executes those before, and MotionFailed tells reason, point and joint.
    """

    def __init__(self, robot: Robot, feed: Feed) -> None:
        super().__init__(feed)
        self._robot = robot

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        if error is not None:
            self.cancel()
        elif self.total:
            self.result()

    @property
    def progress(self) -> Progress:
        """How far it is, now; `total` are the points so far."""
        with self._robot._changed:
            return self._feed.progress

    def append(self, times: npt.ArrayLike, positions: npt.ArrayLike) -> None:
        """Add points: `times` (n,) s from the beginning, `positions` (n, k).

        Waits while the controller has no room. Raises InvalidTrajectory (nothing of these was
        sent), NotReady, TrajectoryRefused, MotionFailed, MotionStopped, NotSupported,
        RobotTimeout, ConnectionLost. Ctrl-C here stops the robot.
        """
        self._do(stream_flows.append(self._robot._core, self._feed, times, positions))

    def extend(self, points: Iterable[tuple[float, Sequence[float]]]) -> None:
        """Add points (time, joints) from an iterable, also one without end, batch by batch."""
        for times, positions in batches(points, stream_flows.batch_size(self._robot._core)):
            self.append(times, positions)

    def flush(self) -> None:
        """Let the robot start with what there is. Raises as `append`."""
        self._do(stream_flows.flush(self._robot._core, self._feed))

    def end(self) -> None:
        """Nothing follows: the last point is a stop point. Raises as `append`."""
        self._do(stream_flows.end(self._robot._core, self._feed))

    def result(self, timeout: float | None = None) -> Result:
        """End it, and wait until all was executed; by default for as long as the robot gets on.

        Raises as `Execution.result`.
        """
        return self._do(stream_flows.finish(self._robot._core, self._feed, timeout))

    def cancel(self) -> State | None:
        """Stop the robot; the state in which it stands. Nothing when it is over."""
        if self._feed.run is not None and not self._feed.run.is_over:
            self._stopped = self._robot.stop()
        return self._stopped

    def _do(self, flow: Flow[T]) -> T:
        return self._robot._run(flow)
