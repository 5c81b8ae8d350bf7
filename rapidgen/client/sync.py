"""`Robot`: the synchronous client."""

import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy.typing as npt

from rapidgen._compat import Self
from rapidgen.client import flows
from rapidgen.client.api import ExecutionApi, RobotApi, RunApi, StreamApi
from rapidgen.client.core.checks import TransferMode
from rapidgen.client.core.motion import CommandedMotion, Result
from rapidgen.client.core.point_source import PointSource, batches
from rapidgen.client.core.state import Event, Feedback, State
from rapidgen.client.flows.data import Datum
from rapidgen.client.pose import Pose
from rapidgen.client.program import SLOW, Argument, Left, Program, SpeedLike
from rapidgen.client.sync_runner import SyncFlowRunner
from rapidgen.client.trajectory import Trajectory

if TYPE_CHECKING:
    from rapidgen.client.egm import EgmSession


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


class _Ending:
    """Calls that end an accepted motion."""

    _runner: SyncFlowRunner
    _subject: CommandedMotion

    def result(self, timeout: float | None = None) -> Result:
        """Wait for the end, by default while the robot progresses or is paused.

        Raises MotionStopped, MotionFailed, ConnectionLost; RobotTimeout if it did not end in time
        (the motion continues). Ctrl-C or cancelling this call stops the robot.
        """
        flow = flows.motion.result(self._runner.core, self._subject, timeout)
        return self._runner.run(flow)

    def cancel(self) -> State | None:
        """Stop this motion; return the state at rest, or None if it has ended."""
        return self._runner.run(flows.motion.cancel(self._runner.core, self._subject))


class Execution(_Ending, ExecutionApi[SyncFlowRunner]):
    """A trajectory that the controller has accepted."""


class ProgramRun(_Ending, RunApi[SyncFlowRunner]):
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

    def append(self, times: npt.ArrayLike, positions: npt.ArrayLike) -> None:
        """Add points: `times` (n,) s from the start, `positions` (n, k).

        Or add one point, its time and its joints (k,). Waits while the controller has no space.
        Raises InvalidTrajectory (nothing of these was sent), NotReady, TrajectoryRefused,
        MotionFailed, MotionStopped, NotSupported, RobotTimeout, ConnectionLost. Ctrl-C or
        cancelling this call stops the robot.
        """
        self._runner.run(flows.stream.append(self._subject, times, positions))

    def flush(self) -> None:
        """Start the robot with the points sent so far. Raises as `append`."""
        self._runner.run(flows.stream.flush(self._subject))

    def end(self) -> None:
        """End the stream: the last point is a stop point. Raises as `append`."""
        self._runner.run(flows.stream.end(self._subject))

    def result(self, timeout: float | None = None) -> Result:
        """Wait for the end, by default while the robot progresses or is paused.

        Raises MotionStopped, MotionFailed, ConnectionLost; RobotTimeout if it did not end in time
        (the motion continues). Ctrl-C or cancelling this call stops the robot. The stream ends with
        it: all points are executed first.
        """
        return self._runner.run(flows.stream.result(self._subject, timeout))

    def cancel(self) -> State | None:
        """Stop this motion; return the state at rest, or None if it has ended."""
        return self._runner.run(flows.stream.cancel(self._subject))

    def extend(self, points: Iterable[tuple[float, Sequence[float]]]) -> None:
        """Add points (time, joints) from an iterable, batch by batch.

        The iterable may be infinite.
        """
        for times, positions in batches(points, self._runner.core.batch):
            self.append(times, positions)


class Robot(RobotApi[SyncFlowRunner]):
    """One motion group of a robot with rapidgen's driver or abb_driver.

    `target` is a configuration file, a shipped name, a RobotConfig, or an address
    `HOST[:MOTION[,STATE]]`; the robot of a configuration is expected at `address`, else on this
    machine. `group` names the motion group if there are several. `watch` never opens the motion
    port. `plain` does not expect a rapidgen driver. `reconnect` is the time in s for which the next
    call tries a lost connection again; nothing is ever sent again. `feedback` requests joints with
    the controller's own time and velocities. `cell` is a cell file: motions that do not keep its
    clearances are rejected before a byte is sent.

    All methods may be called from any thread. Joints are rad and m in URDF order.
    """

    _runner_type = SyncFlowRunner

    def connect(self) -> Self:
        """Connect and find out who is there.

        Raises ConnectionFailed, RobotTimeout, ProtocolError, IncompatibleDriver.
        """
        self._runner.run(flows.connect.connect(self._core))
        return self

    @property
    def data(self) -> CellData:
        """PERS of the robot's own program; `robot.data[name] = 3` writes one."""
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

    # Connection

    def close(self) -> None:
        """Close all connections. An active motion is stopped first."""
        self._runner.run(flows.stop.close(self._core))

    def drop_connections(self) -> None:
        """Close all connections without a STOP, as a lost cable does.

        An active motion fails with ConnectionLost; the driver stops the robot by itself.
        """
        self._runner.run(flows.stop.drop(self._core))

    # State

    def next_state(self, timeout: float | None = None) -> State:
        """Return the state of the next joint message.

        Raises RobotTimeout, ConnectionLost.
        """
        return self._runner.run(flows.state.next_state(self._core, timeout))

    def wait_until(self, condition: Callable[[State], bool], timeout: float) -> State:
        """Return the first state for which `condition` holds.

        Raises RobotTimeout, ConnectionLost.
        """
        return self._runner.run(flows.state.wait_until(self._core, condition, timeout))

    def next_event(self, timeout: float | None = None, *, after: Event | None = None) -> Event:
        """Return the next entry of the controller's log, or the one after `after`.

        Without a time-out it waits while there is a connection. Raises RobotTimeout,
        ConnectionLost.
        """
        return self._runner.run(flows.state.next_event(self._core, timeout, after=after))

    def next_feedback(self, timeout: float | None = None) -> Feedback:
        """Return the next joints with the controller's time.

        Raises NotSupported without feedback, RobotTimeout, ConnectionLost.
        """
        return self._runner.run(flows.state.next_feedback(self._core, timeout))

    # Motion

    def pause(self) -> None:
        """Pause the motion on its path.

        Raises NotSupported, RequestRefused, RobotTimeout.
        """
        self._runner.run(flows.control.pause(self._core))

    def resume(self) -> None:
        """Resume after a pause. Raises as `pause`."""
        self._runner.run(flows.control.resume(self._core))

    def set_speed(self, percent: float) -> None:
        """Move at 1 to 100 % of the programmed speed, until the next motion.

        Raises as `pause`.
        """
        self._runner.run(flows.control.set_speed(self._core, percent))

    def read_signal(self, signal: str | int) -> float:
        """Read an exposed signal, by name or number. Raises as `pause`."""
        return self._runner.run(flows.control.read_signal(self._core, signal))

    def write_signal(self, signal: str | int, value: float) -> float:
        """Set a signal; return its value as read afterwards. Raises as `pause`."""
        return self._runner.run(flows.control.write_signal(self._core, signal, value))

    def read_data(self, name: str) -> Datum:
        """Read a PERS of `data:` by its name there.

        Raises NotSupported for an unlisted name, RequestRefused if the robot's program does not
        have it, RobotTimeout.
        """
        return self._runner.run(flows.data.read(self._core, name))

    def write_data(self, name: str, value: Datum) -> Datum:
        """Write a PERS of `data:`; return its value as read afterwards.

        Raises as `read_data`, and ValueError for a value that does not fit its type.
        """
        return self._runner.run(flows.data.write(self._core, name, value))

    def stop(self) -> State | None:
        """Stop at once, whatever else is active; return the state at rest.

        STOP is written to both ports before anything is awaited. Without a connection only the
        motion port is opened, no state shows the robot at rest, and None is returned. Raises
        StopFailed: use the emergency stop.
        """
        return self._runner.run(flows.stop.stop(self._core))

    def move_to(
        self, joints: Sequence[float], *, speed: SpeedLike = SLOW, timeout: float | None = None
    ) -> Result:
        """Move all axes to joints (rad, m) together, and wait for the end.

        Raises as `run`.
        """
        return self._runner.run(
            flows.program.move_to(self._core, joints, speed=speed, timeout=timeout)
        )

    def move_linear(
        self, pose: Pose, *, speed: SpeedLike = SLOW, timeout: float | None = None
    ) -> Result:
        """Move to a pose on a line, and wait for the end. Raises as `run`."""
        return self._runner.run(
            flows.program.move_linear(self._core, pose, speed=speed, timeout=timeout)
        )

    def jog(self, /, *, speed: SpeedLike = SLOW, **by: float) -> Result:
        """Move joints by name, or the tool along x, y, z, by a small step.

        A step has at most 0.2 rad or 0.1 m, in the work object; the method waits for the end. The
        tool moves on a line and keeps its orientation; joints and directions exclude each other.
        During the motion the controller stops the robot if this client is silent for 0.2 s. Raises
        NotSupported without a control connection, otherwise as `run`.
        """
        return self._runner.run(flows.program.jog(self._core, speed=speed, **by))

    def call(
        self, routine: str, *arguments: Argument, timeout: float | None = None
    ) -> tuple[Left, ...]:
        """Call a procedure of the controller's program and wait for its end.

        Returns its `inout` parameters in their order, then the value of a function. Without a
        time-out it may take any time; if it exceeds a time-out, the controller leaves it and its
        state is unknown (MotionFailed, OVERTIME). Raises RoutineFailed with number and name of its
        error, or if the error stopped the robot's program; otherwise as `run`.
        """
        return self._runner.run(
            flows.program.call(self._core, routine, *arguments, timeout=timeout)
        )

    def execute(self, trajectory: Trajectory, *, mode: TransferMode | None = None) -> Execution:
        """Send a trajectory; return when the controller has accepted it.

        `mode` is `download` (all points are sent before the motion) or `stream` (the rest is sent
        during the motion); by default a trajectory that exceeds the driver's ring buffer is
        streamed. Raises InvalidTrajectory and NotReady before a byte is sent, TrajectoryRefused if
        the robot will not move, NotSupported, RobotTimeout, ConnectionLost. Ctrl-C or cancelling
        this call stops the robot.
        """
        motion = self._runner.run(flows.motion.execute(self._core, trajectory, mode))
        return Execution(self._runner, motion)

    @contextmanager
    def egm(
        self, *, fraction: float = 0.25, step: float = 0.1, timeout: float = 0.1
    ) -> "Iterator[EgmSession]":
        """Guide the robot at 250 Hz: `with robot.egm() as session:`.

        A session of the driver begins with the block and ends with it: the robot then stays where
        it is. `fraction`, `step` and `timeout` are those of `rapidgen.client.egm.listen`; the
        controller itself enforces `max_deviation` and `max_speed` of the configuration. Raises
        NotSupported, NotReady, RequestRefused, ConnectionFailed, RobotTimeout, ConnectionLost.
        """
        from rapidgen.client.egm import listen

        config, egm, host = self._egm_partner()
        with listen(
            config,
            port=egm.port,
            host=host,
            group=self._group_name,
            fraction=fraction,
            step=step,
            timeout=timeout,
            cell=self._core.collisions,
        ) as session:
            beat = session.write if config.robotware >= flows.guidance.DATA_SINCE else None
            number = self._runner.run(flows.guidance.start(self._core, beat))
            session.explain = partial(flows.guidance.reason, self._core, number)
            try:
                session.wait_until_guided()
                yield session
            finally:
                self._runner.run(flows.guidance.end(self._core))

    def stream(self, names: Sequence[str] = (), *, fallback: bool = True) -> Stream:
        """Return a `Stream`, a trajectory without a known end; sends no data.

        `names` are those of the columns, by default the robot's own. With `fallback` a driver that
        does not stream receives all points at the end.
        """
        return Stream(self._runner, PointSource(self._core, names, may_download=fallback))

    def run(self, program: Program, *, mode: TransferMode | None = None) -> ProgramRun:
        """Send a program; return when the controller has accepted it.

        `mode` is `download` (sent and checked by the controller before the motion) or `stream` (the
        rest is sent during the motion); by default a program that fits the driver's ring buffer is
        downloaded. Raises InvalidProgram, NotReady and NotSupported before a byte is sent,
        TrajectoryRefused if the robot will not move, RobotTimeout, ConnectionLost. Ctrl-C or
        cancelling this call stops the robot.
        """
        motion = self._runner.run(flows.program.run(self._core, program, mode))
        return ProgramRun(self._runner, motion, program)
