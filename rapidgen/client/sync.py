"""`Robot`: the synchronous client.

The caller's threads write, one thread a robot reads.
"""

import threading
import time
import warnings
import weakref
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from inspect import GEN_CLOSED, getgeneratorstate
from typing import TypeVar

from rapidgen._compat import Self
from rapidgen.client import flows
from rapidgen.client.address import Address
from rapidgen.client.api import ExecutionApi, MakeCore, RobotApi, RunApi, StreamApi
from rapidgen.client.channels import Channel, Connections, Reader
from rapidgen.client.core.job import batches
from rapidgen.client.core.motion import CommandedMotion
from rapidgen.client.core.robot import STOP_FRAME
from rapidgen.client.core.state import State
from rapidgen.client.errors import ConnectionLost, MotionStopped, RobotError, RobotTimeout
from rapidgen.client.flows.data import Datum
from rapidgen.client.flows.effects import Close, Effect, Flow, HangUp, Open, SendAtOnce, Wait
from rapidgen.client.unclosed import drop_in_child
from rapidgen.wire.simple_message.spec import Port


@dataclass(frozen=True, eq=False)
class CellData(Mapping[str, Datum]):
    """Entries of the configuration's `data:` by `MODULE:NAME`.

    They are read and written at the robot. Raises as `read_data` and `write_data`, so NotSupported
    for an unlisted name.
    """

    names: tuple[str, ...]
    read: Callable[[str], Datum]
    write: Callable[[str, Datum], Datum]

    def __getitem__(self, name: str) -> Datum:
        return self.read(name)

    def __setitem__(self, name: str, value: Datum) -> None:
        self.write(name, value)

    def __contains__(self, name: object) -> bool:
        return name in self.names

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __len__(self) -> int:
        return len(self.names)


T = TypeVar("T")
_SLICE = 0.1
"""s between two checks of the clock while no data arrives."""


class SyncFlowRunner:
    """Runner of flows: the caller's thread decides and writes, another reads."""

    def __init__(self, address: Address, make_core: MakeCore) -> None:
        self.address = address
        self.core = make_core(time.monotonic)
        self.guard = threading.Condition()
        self._connections = Connections(str(address))
        self._channels = self._connections.channels
        weakref.finalize(self, self._connections.close_dropped, STOP_FRAME)
        drop_in_child(self)

    def forked(self) -> None:
        """Drop the connections in a forked process."""
        # A thread that the child does not have may hold the old lock.
        self.guard = threading.Condition()
        self._connections.forked()
        self.core.forked()

    @property
    def is_busy(self) -> bool:
        """True if the clock must be checked regularly."""
        return self.core.is_busy

    def run(self, flow: Flow[T]) -> T:
        """Run a flow: effects without the lock, its own steps with it.

        Ctrl-C may arrive anywhere here, and the flow must receive it to stop the robot.
        """
        outcome: bool | None = None
        failure: BaseException | None = None
        before = self.core.motion
        while True:
            error, failure = failure, None
            try:
                try:
                    with self.guard:
                        try:
                            effect = flow.send(outcome) if error is None else flow.throw(error)
                        finally:
                            self._pump()
                except StopIteration as end:
                    value: T = end.value
                    return value
                outcome = self._perform(effect)
            except (RobotError, KeyboardInterrupt) as raised:
                if getgeneratorstate(flow) == GEN_CLOSED:
                    self._stop_unnoticed(raised, before)
                    raise
                failure = raised

    def _stop_unnoticed(
        self, raised: RobotError | KeyboardInterrupt, before: CommandedMotion | None
    ) -> None:
        """Stop a motion that Ctrl-C hides from the caller.

        It arrived after the last step of the flow that started the motion, before the caller got
        it.
        """
        motion = self.core.motion
        if isinstance(raised, KeyboardInterrupt) and motion not in (None, before):
            assert motion is not None
            if not motion.is_over or motion.needs_stop:
                self.run(flows.stop.stop(self.core))

    def _pump(self) -> None:
        """Send due frames as far as possible without waiting.

        The lock is held.
        """
        core = self.core
        self._connections.may_move = core.may_move
        stops = core.unmonitored_stops()
        for port, channel in self._channels.items():
            try:
                if port in stops:
                    channel.offer_after(STOP_FRAME)
                channel.offer(partial(core.due, port))
            except RobotError as error:
                # The reader receives it too.
                core.state_port.note(str(error))

    def tick(self) -> None:
        """Check the clock and send what is due."""
        with self.guard:
            self.core.poll()
            self._pump()
            self.guard.notify_all()

    def _perform(self, effect: Effect) -> bool:
        if isinstance(effect, Wait):
            return self._wait(effect)
        if isinstance(effect, Close):
            self._close(effect.port)
            return True
        if isinstance(effect, Open):
            self._open(effect)
            return True
        if isinstance(effect, HangUp):
            self._hang_up()
            return True
        if isinstance(effect, SendAtOnce):
            self._send_at_once(effect)
            return True
        channel = self._channels.get(effect.port)
        if channel is None:
            raise self.core.disconnected()
        try:
            if not channel.send(effect.data, effect.timeout, lambda: effect.is_stopped):
                raise MotionStopped.because("RG631", "stopped before the trajectory was sent")
        except ConnectionLost as error:
            with self.guard:
                # The reader was faster and knows the cause better.
                if self._channels.get(effect.port) is not channel:
                    raise self.core.disconnected() from error
            raise
        return True

    def _send_at_once(self, effect: SendAtOnce) -> None:
        channels = {port: self._channels.get(port) for port in effect.ports}
        # Write to all connections before waiting for a blocked one.
        steps: tuple[Callable[[Channel], None], ...] = (
            lambda channel: channel.offer_after(effect.data),
            lambda channel: channel.finish(effect.timeout),
        )
        for step in steps:
            for port, channel in channels.items():
                if port in effect.failures:
                    continue
                if channel is None:
                    effect.failures[port] = self.core.disconnected()
                    continue
                try:
                    step(channel)
                except (ConnectionLost, RobotTimeout) as error:
                    effect.failures[port] = error

    def _wait(self, effect: Wait) -> bool:
        deadline = time.monotonic() + effect.timeout
        with self.guard:
            while not effect.until():
                left = deadline - time.monotonic()
                if left <= 0:
                    return False
                self.guard.wait(min(left, _SLICE))
                self.core.poll()
                self._pump()
            return True

    def _close(self, port: Port) -> None:
        with self.guard:
            channel = self._channels.pop(port, None)
            self.core.dropped(port)
            if channel is not None and self._connections.reader is not None:
                self._connections.reader.remove(channel)

    def _open(self, effect: Open) -> None:
        channel = Channel(self.address, effect.port, effect.timeout)
        with self.guard:
            reader = self._connections.reader
            if reader is None:
                reader = self._connections.reader = Reader(self, str(self.address))
            old = self._channels.get(effect.port)
            if old is not None:
                reader.remove(old)
            self._channels[effect.port] = channel
            self.core.opened(effect.port)
            reader.add(channel)

    def received(self, channel: Channel, data: bytes) -> None:
        """Process bytes of a channel."""
        with self.guard:
            if self._channels.get(channel.port) is channel:
                if not self.core.received(channel.port, data):
                    del self._channels[channel.port]
                    assert self._connections.reader is not None
                    self._connections.reader.remove(channel)
                self._pump()
                self.guard.notify_all()

    def lost(self, channel: Channel, why: str) -> None:
        """Record that the peer closed a channel."""
        with self.guard:
            if self._channels.get(channel.port) is channel:
                del self._channels[channel.port]
                self.core.lost(channel.port, why)
                self._pump()
                self.guard.notify_all()

    def _hang_up(self) -> None:
        with self.guard:
            self.core.closed()
            channels = list(self._channels.values())
            self._channels.clear()
            reader, self._connections.reader = self._connections.reader, None
        if reader is not None:
            for channel in channels:
                reader.remove(channel)
            reader.close()


class Execution(ExecutionApi[SyncFlowRunner]):
    """A trajectory that the controller has accepted."""


class ProgramRun(RunApi[SyncFlowRunner]):
    """A program that the controller has accepted."""


class Stream(StreamApi[SyncFlowRunner]):
    """Points that the robot executes while later ones are added.

    `with robot.stream() as stream:` ends the stream and waits for the robot at the end of the
    block; an exception in the block stops the robot. Each point has the time s from the start of
    the stream and joints in rad or m; the first is the robot's position. Motion begins when the
    driver has enough points, or at `flush`, `end` and `result`.

    Faults of points are reported before they are sent (InvalidTrajectory, the stream continues), by
    the controller at the first points (TrajectoryRefused, the robot did not move) or at later ones:
    then the robot executes the earlier points, and MotionFailed gives reason, point and joint.
    """

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        if kind is not None:
            self.cancel()
        elif self.total:
            self.result()

    def extend(self, points: Iterable[tuple[float, Sequence[float]]]) -> None:
        """Add points (time, joints) from an iterable, batch by batch.

        The iterable may be infinite.
        """
        for times, positions in batches(points, self._carrier.core.batch):
            self.append(times, positions)


class Robot(RobotApi[SyncFlowRunner, Execution, Stream, ProgramRun]):
    """One motion group of a robot with rapidgen's driver or abb_driver.

    `target` is a configuration file, a shipped name, a RobotConfig, or an address
    `HOST[:MOTION[,STATE]]`; the robot of a configuration is expected at `address`, else on this
    machine. `group` names the motion group if there are several. `watch` never opens the motion
    port. `plain` does not expect a rapidgen driver. `reconnect` is the time in s for which the next
    call tries a lost connection again; nothing is ever sent again. `feedback` requests joints with
    the controller's own time and velocities.

    All methods may be called from any thread. Joints are rad and m in URDF order.
    """

    _carrier_type = SyncFlowRunner
    _execution_type = Execution
    _stream_type = Stream
    _run_type = ProgramRun

    def connect(self) -> Self:
        """Connect and find out who is there.

        Raises ConnectionFailed, RobotTimeout, ProtocolError, IncompatibleDriver.
        """
        self._carrier.run(flows.connect.connect(self._core))
        return self

    @property
    def data(self) -> CellData:
        """PERS of the robot's own program: `robot.data["cell:count"] = 3`."""
        names = tuple(datum.name for datum in self.group.data)
        return CellData(names, self.read_data, self.write_data)

    def __enter__(self) -> Self:
        return self if self.is_connected else self.connect()

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        unfinished = "" if kind is not None else self._unfinished()
        self.close()
        if unfinished:
            # Not ResourceWarning, which Python hides: the user would not learn why the robot stayed
            # at rest.
            warnings.warn(unfinished, RuntimeWarning, stacklevel=2)

    def states(self, timeout: float | None = None) -> Iterator[State]:
        """Yield each new state; wait at most `timeout` s for each."""
        while True:
            yield self.next_state(timeout)
