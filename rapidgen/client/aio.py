"""`AsyncRobot`: the client for asyncio, also on a simulated clock."""

import warnings
from collections.abc import AsyncIterable, AsyncIterator, Callable, Iterable, Sequence
from contextlib import asynccontextmanager
from functools import partial
from typing import TYPE_CHECKING

import numpy.typing as npt

from rapidgen._compat import Self
from rapidgen.client import flows
from rapidgen.client.api import ExecutionApi, RobotApi, RunApi, StreamApi
from rapidgen.client.async_runner import AsyncFlowRunner
from rapidgen.client.core.checks import TransferMode
from rapidgen.client.core.motion import CommandedMotion, Result
from rapidgen.client.core.point_source import PointSource, batches
from rapidgen.client.core.state import Event, Feedback, State
from rapidgen.client.flows.data import Datum
from rapidgen.client.pose import Pose
from rapidgen.client.program import SLOW, Argument, Left, Program, SpeedLike
from rapidgen.client.trajectory import Trajectory

if TYPE_CHECKING:
    from rapidgen.client.egm import AsyncEgmSession


class _AsyncEnding:
    """Calls that end an accepted motion."""

    _runner: AsyncFlowRunner
    _subject: CommandedMotion

    async def result(self, timeout: float | None = None) -> Result:
        """Wait for the end, by default while the robot progresses or is paused.

        Raises MotionStopped, MotionFailed, ConnectionLost; RobotTimeout if it did not end in time
        (the motion continues). Ctrl-C or cancelling this call stops the robot.
        """
        flow = flows.motion.result(self._runner.core, self._subject, timeout)
        return await self._runner.run(flow)

    async def cancel(self) -> State | None:
        """Stop this motion; return the state at rest, or None if it has ended."""
        return await self._runner.run(flows.motion.cancel(self._runner.core, self._subject))


class AsyncExecution(_AsyncEnding, ExecutionApi[AsyncFlowRunner]):
    """`Execution` with awaitable methods."""


class AsyncProgramRun(_AsyncEnding, RunApi[AsyncFlowRunner]):
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

    async def append(self, times: npt.ArrayLike, positions: npt.ArrayLike) -> None:
        """Add points: `times` (n,) s from the start, `positions` (n, k).

        Or add one point, its time and its joints (k,). Waits while the controller has no space.
        Raises InvalidTrajectory (nothing of these was sent), NotReady, TrajectoryRefused,
        MotionFailed, MotionStopped, NotSupported, RobotTimeout, ConnectionLost. Ctrl-C or
        cancelling this call stops the robot.
        """
        await self._runner.run(flows.stream.append(self._subject, times, positions))

    async def flush(self) -> None:
        """Start the robot with the points sent so far. Raises as `append`."""
        await self._runner.run(flows.stream.flush(self._subject))

    async def end(self) -> None:
        """End the stream: the last point is a stop point. Raises as `append`."""
        await self._runner.run(flows.stream.end(self._subject))

    async def result(self, timeout: float | None = None) -> Result:
        """Wait for the end, by default while the robot progresses or is paused.

        Raises MotionStopped, MotionFailed, ConnectionLost; RobotTimeout if it did not end in time
        (the motion continues). Ctrl-C or cancelling this call stops the robot. The stream ends with
        it: all points are executed first.
        """
        return await self._runner.run(flows.stream.result(self._subject, timeout))

    async def cancel(self) -> State | None:
        """Stop this motion; return the state at rest, or None if it has ended."""
        return await self._runner.run(flows.stream.cancel(self._subject))

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
        for times, positions in batches(points, self._runner.core.batch):
            await self.append(times, positions)


class AsyncRobot(RobotApi[AsyncFlowRunner]):
    """One motion group of a robot on asyncio.

    Arguments and methods are those of `Robot`.
    """

    _runner_type = AsyncFlowRunner

    async def connect(self) -> Self:
        """Connect and find out who is there.

        Raises ConnectionFailed, RobotTimeout, ProtocolError, IncompatibleDriver.
        """
        await self._runner.run(flows.connect.connect(self._core))
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

    # Connection

    async def close(self) -> None:
        """Close all connections. An active motion is stopped first."""
        await self._runner.run(flows.stop.close(self._core))

    async def drop_connections(self) -> None:
        """Close all connections without a STOP, as a lost cable does.

        An active motion fails with ConnectionLost; the driver stops the robot by itself.
        """
        await self._runner.run(flows.stop.drop(self._core))

    # State

    async def next_state(self, timeout: float | None = None) -> State:
        """Return the state of the next joint message.

        Raises RobotTimeout, ConnectionLost.
        """
        return await self._runner.run(flows.state.next_state(self._core, timeout))

    async def wait_until(self, condition: Callable[[State], bool], timeout: float) -> State:
        """Return the first state for which `condition` holds.

        Raises RobotTimeout, ConnectionLost.
        """
        return await self._runner.run(flows.state.wait_until(self._core, condition, timeout))

    async def next_event(
        self, timeout: float | None = None, *, after: Event | None = None
    ) -> Event:
        """Return the next entry of the controller's log, or the one after `after`.

        Without a time-out it waits while there is a connection. Raises RobotTimeout,
        ConnectionLost.
        """
        return await self._runner.run(flows.state.next_event(self._core, timeout, after=after))

    async def next_feedback(self, timeout: float | None = None) -> Feedback:
        """Return the next joints with the controller's time.

        Raises NotSupported without feedback, RobotTimeout, ConnectionLost.
        """
        return await self._runner.run(flows.state.next_feedback(self._core, timeout))

    # Motion

    async def pause(self) -> None:
        """Pause the motion on its path.

        Raises NotSupported, RequestRefused, RobotTimeout.
        """
        await self._runner.run(flows.control.pause(self._core))

    async def resume(self) -> None:
        """Resume after a pause. Raises as `pause`."""
        await self._runner.run(flows.control.resume(self._core))

    async def set_speed(self, percent: float) -> None:
        """Move at 1 to 100 % of the programmed speed, until the next motion.

        Raises as `pause`.
        """
        await self._runner.run(flows.control.set_speed(self._core, percent))

    async def read_signal(self, signal: str | int) -> float:
        """Read an exposed signal, by name or number. Raises as `pause`."""
        return await self._runner.run(flows.control.read_signal(self._core, signal))

    async def write_signal(self, signal: str | int, value: float) -> float:
        """Set a signal; return its value as read afterwards. Raises as `pause`."""
        return await self._runner.run(flows.control.write_signal(self._core, signal, value))

    async def read_data(self, name: str) -> Datum:
        """Read a PERS of `data:` by its name there.

        Raises NotSupported for an unlisted name, RequestRefused if the robot's program does not
        have it, RobotTimeout.
        """
        return await self._runner.run(flows.data.read(self._core, name))

    async def write_data(self, name: str, value: Datum) -> Datum:
        """Write a PERS of `data:`; return its value as read afterwards.

        Raises as `read_data`, and ValueError for a value that does not fit its type.
        """
        return await self._runner.run(flows.data.write(self._core, name, value))

    async def stop(self) -> State | None:
        """Stop at once, whatever else is active; return the state at rest.

        STOP is written to both ports before anything is awaited. Without a connection only the
        motion port is opened, no state shows the robot at rest, and None is returned. Raises
        StopFailed: use the emergency stop.
        """
        return await self._runner.run(flows.stop.stop(self._core))

    async def move_to(
        self, joints: Sequence[float], *, speed: SpeedLike = SLOW, timeout: float | None = None
    ) -> Result:
        """Move all axes to joints (rad, m) together, and wait for the end.

        Raises as `run`.
        """
        return await self._runner.run(
            flows.program.move_to(self._core, joints, speed=speed, timeout=timeout)
        )

    async def move_linear(
        self, pose: Pose, *, speed: SpeedLike = SLOW, timeout: float | None = None
    ) -> Result:
        """Move to a pose on a line, and wait for the end. Raises as `run`."""
        return await self._runner.run(
            flows.program.move_linear(self._core, pose, speed=speed, timeout=timeout)
        )

    async def jog(self, /, *, speed: SpeedLike = SLOW, **by: float) -> Result:
        """Move joints by name, or the tool along x, y, z, by a small step.

        A step has at most 0.2 rad or 0.1 m, in the work object; the method waits for the end. The
        tool moves on a line and keeps its orientation; joints and directions exclude each other.
        During the motion the controller stops the robot if this client is silent for 0.2 s. Raises
        NotSupported without a control connection, otherwise as `run`.
        """
        return await self._runner.run(flows.program.jog(self._core, speed=speed, **by))

    async def call(
        self, routine: str, *arguments: Argument, timeout: float | None = None
    ) -> tuple[Left, ...]:
        """Call a procedure of the controller's program and wait for its end.

        Returns its `inout` parameters in their order, then the value of a function. Without a
        time-out it may take any time; if it exceeds a time-out, the controller leaves it and its
        state is unknown (MotionFailed, OVERTIME). Raises RoutineFailed with number and name of its
        error, or if the error stopped the robot's program; otherwise as `run`.
        """
        return await self._runner.run(
            flows.program.call(self._core, routine, *arguments, timeout=timeout)
        )

    async def execute(
        self, trajectory: Trajectory, *, mode: TransferMode | None = None
    ) -> AsyncExecution:
        """Send a trajectory; return when the controller has accepted it.

        `mode` is `download` (all points are sent before the motion) or `stream` (the rest is sent
        during the motion); by default a trajectory that exceeds the driver's ring buffer is
        streamed. Raises InvalidTrajectory and NotReady before a byte is sent, TrajectoryRefused if
        the robot will not move, NotSupported, RobotTimeout, ConnectionLost. Ctrl-C or cancelling
        this call stops the robot.
        """
        motion = await self._runner.run(flows.motion.execute(self._core, trajectory, mode))
        return AsyncExecution(self._runner, motion)

    @asynccontextmanager
    async def egm(
        self, *, fraction: float = 0.25, step: float = 0.1, timeout: float = 0.1
    ) -> "AsyncIterator[AsyncEgmSession]":
        """Guide the robot at 250 Hz: `async with robot.egm() as session:`.

        A session of the driver begins with the block and ends with it: the robot then stays where
        it is. `fraction`, `step` and `timeout` are those of `rapidgen.client.egm.listen`; the
        controller itself enforces `max_deviation` and `max_speed` of the configuration. Raises
        NotSupported, NotReady, RequestRefused, ConnectionFailed, RobotTimeout, ConnectionLost.
        """
        from rapidgen.client.egm import listen_async

        config, egm, host = self._egm_partner()
        async with listen_async(
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
            number = await self._runner.run(flows.guidance.start(self._core, beat))
            session.explain = partial(flows.guidance.reason, self._core, number)
            try:
                await session.wait_until_guided()
                yield session
            finally:
                await self._runner.run(flows.guidance.end(self._core))

    def stream(self, names: Sequence[str] = (), *, fallback: bool = True) -> AsyncStream:
        """Return a `Stream`, a trajectory without a known end; sends no data.

        `names` are those of the columns, by default the robot's own. With `fallback` a driver that
        does not stream receives all points at the end.
        """
        return AsyncStream(self._runner, PointSource(self._core, names, may_download=fallback))

    async def run(self, program: Program, *, mode: TransferMode | None = None) -> AsyncProgramRun:
        """Send a program; return when the controller has accepted it.

        `mode` is `download` (sent and checked by the controller before the motion) or `stream` (the
        rest is sent during the motion); by default a program that fits the driver's ring buffer is
        downloaded. Raises InvalidProgram, NotReady and NotSupported before a byte is sent,
        TrajectoryRefused if the robot will not move, RobotTimeout, ConnectionLost. Ctrl-C or
        cancelling this call stops the robot.
        """
        motion = await self._runner.run(flows.program.run(self._core, program, mode))
        return AsyncProgramRun(self._runner, motion, program)
