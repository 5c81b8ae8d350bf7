"""A session as its user sees it; the loop is in `process.py`.

`EgmSession` and `AsyncEgmSession` have the same methods. Those that wait are coroutines of the
latter; the others return at once and are shared.
"""

import asyncio
import contextlib
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from math import isfinite
from typing import TYPE_CHECKING

from rapidgen._compat import Self
from rapidgen._extras import named
from rapidgen.axes.mapping import JointMap
from rapidgen.client.egm.envelope import Envelope, Joints
from rapidgen.client.errors import NotReady, NotSupported, RobotTimeout, TargetRejected
from rapidgen.client.pose import Pose
from rapidgen.config import load_config
from rapidgen.config.model import GroupConfig, RobotConfig
from rapidgen.wire.egm.values import MAX_NUMBERS, RapidData

with named():
    from rapidgen.client.egm.exchange import (
        EgmState,
        Guidance,
        Order,
        PartnerExchange,
        Path,
        Stop,
        Target,
        sample,
    )

from rapidgen.client.egm.lag import Lag, LagMeter
from rapidgen.client.egm.loop import Loop, LoopProcess

if TYPE_CHECKING:
    from rapidgen.client.collisions import CellCheck, GuidanceCheck
    from rapidgen.client.trajectory import Trajectory

DEFAULT_PORT = 6510


def listen(
    config: str | RobotConfig,
    *,
    guidance: Guidance = "joints",
    port: int = DEFAULT_PORT,
    host: str = "127.0.0.1",
    group: str = "",
    envelope: Envelope | None = None,
    fraction: float = 0.25,
    step: float = 0.1,
    timeout: float = 0.1,
    cell: "CellCheck | None" = None,
) -> "EgmSession":
    """Wait for frames of a controller and answer them.

    Nothing moves before the first `send` or `follow`: until then answers repeat the position of the
    robot, or for guidance of the TCP have no pose.

    Args:
        config: Configuration, its file, or a shipped name.
        guidance: What the program guides: "joints" (EGMRunJoint) or "pose" (EGMRunPose).
        port: UDP port to which the controller sends: RemotePortNumber of its UdpUc device.
        host: Address of this computer in the network of the robot; loopback is the simulator's.
        group: Motion group; empty: the only one.
        envelope: Limits of what is sent; None: those of the configuration, with
            `fraction` and `step`.
        fraction: Of the speeds and accelerations of the configuration (0 to 1) that are sent.
        step: Largest difference between two targets, rad and m.
        timeout: s without a new target after which the robot stops.
        cell: Check of a cell: targets are rejected if the robot may come too near to something.

    Raises:
        DiagnosticError: No such configuration or group.
        NotSupported: Guidance of the TCP with a cell, which cannot be checked.
        ConnectionFailed: The port cannot be opened.
    """
    chosen = choose_group(config, group)
    limits = envelope or Envelope.of(chosen, fraction, step)
    exchange = PartnerExchange(JointMap.of(chosen), limits, timeout, guidance)
    guard = _guard(cell, guidance, limits, timeout)
    return EgmSession(limits, guidance, partial(LoopProcess, exchange, host, port), guard=guard)


def listen_async(
    config: str | RobotConfig,
    *,
    guidance: Guidance = "joints",
    port: int = DEFAULT_PORT,
    host: str = "127.0.0.1",
    group: str = "",
    envelope: Envelope | None = None,
    fraction: float = 0.25,
    step: float = 0.1,
    timeout: float = 0.1,
    cell: "CellCheck | None" = None,
) -> "AsyncEgmSession":
    """Return a session for asyncio; arguments and errors are those of `listen`."""
    chosen = choose_group(config, group)
    limits = envelope or Envelope.of(chosen, fraction, step)
    exchange = PartnerExchange(JointMap.of(chosen), limits, timeout, guidance)
    guard = _guard(cell, guidance, limits, timeout)
    loop = partial(LoopProcess, exchange, host, port)
    return AsyncEgmSession(limits, guidance, loop, guard=guard)


def _guard(
    cell: "CellCheck | None", guidance: Guidance, envelope: Envelope, timeout: float
) -> "GuidanceCheck | None":
    """Return the check of targets in a cell (RG840: guidance of the TCP)."""
    if cell is None:
        return None
    if guidance == "pose":
        raise NotSupported.because(
            "RG840",
            "guidance of the TCP cannot be checked for collisions",
            'guide joints (guidance="joints"), or listen without a cell',
        )
    from rapidgen.client.collisions import GuidanceCheck

    return GuidanceCheck(cell, envelope, timeout)


def choose_group(config: str | RobotConfig, name: str) -> GroupConfig:
    """Return a motion group; without a name the only one.

    Raises NotReady (no such group), DiagnosticError (no such configuration).
    """
    robot = config if isinstance(config, RobotConfig) else load_config(config)
    names = [group.name for group in robot.groups]
    if not name and len(names) == 1:
        return robot.groups[0]
    for group in robot.groups:
        if group.name == name:
            return group
    raise NotReady.because("RG681", f"no motion group {name!r}", f"groups: {', '.join(names)}")


class _Session:
    """States and targets of a session: all that does not wait."""

    def __init__(
        self,
        envelope: Envelope,
        guidance: Guidance,
        connect: Callable[[Callable[[EgmState], None], Callable[[], None]], Loop],
        clock: Callable[[], float] = time.monotonic,
        guard: "GuidanceCheck | None" = None,
    ) -> None:
        self.envelope = envelope
        self._cell = guard
        self._earlier: EgmState | None = None
        self.guidance = guidance
        self._clock = clock
        self._last: Joints | None = None
        self._last_pose: Pose | None = None
        self._state: EgmState | None = None
        self._meter = LagMeter()
        self._changed = threading.Condition()
        self._listeners: list[Callable[[], object]] = []
        self._closed = False
        self.explain: Callable[[], str] = str
        """Return why guidance has ended, empty if unknown; `robot.egm` asks the driver."""
        self._loop = connect(self._receive, self._receive_end)

    @property
    def port(self) -> int:
        """Return the UDP port to which the controller sends."""
        return self._loop.port

    def _receive(self, state: EgmState) -> None:
        if state.ended:
            state = replace(state, ended=self.explain() or state.ended)
        with self._changed:
            self._earlier, self._state = self._state, state
            self._meter.add(state)
            if not state.guided or state.stopped:
                self._last = self._last_pose = None
            self._notify()

    def _receive_end(self) -> None:
        with self._changed:
            self._closed = True
            if (state := self._state) is not None:
                ended = state.ended or "the session is closed"
                self._state = replace(state, guided=False, ended=ended)
            self._notify()

    def _notify(self) -> None:
        self._changed.notify_all()
        for listener in self._listeners:
            listener()

    # -- states -----------------------------------------------------------------------------

    @property
    def state(self) -> EgmState | None:
        """Return the last state; None: no frame came yet."""
        return self._state

    @property
    def lag(self) -> Lag | None:
        """Return how far the robot is behind what is sent; None: it has not moved enough."""
        with self._changed:
            return self._meter.lag()

    # -- targets ----------------------------------------------------------------------------

    def send(
        self,
        joints: Sequence[float] | None = None,
        *,
        pose: Pose | None = None,
        speeds: Sequence[float] | None = None,
        lasts: float | None = None,
        at: float | None = None,
    ) -> None:
        """Send a target.

        Args:
            joints: (k,) positions.
            pose: TCP in the `SensorFrame` of EGMActPose, which
                must be the work object of that instruction.
            speeds: (k,) of the joints, or (6,) of the TCP: m/s along and rad/s about x, y and z.
                The target moves on with them until the next one. Without a target the robot takes
                them over.
            lasts: s for which the target is in force. The robot then slows down and waits for the
                next one. None: the session's `timeout`, which ends its targets.
            at: Moment from which the target counts, s of `time.monotonic`; None: now.

        Raises TargetRejected: it is beyond the envelope, the session guides the other, or the robot
        is not guided.
        """
        if (joints is not None and pose is not None) or (joints, pose, speeds) == (None,) * 3:
            raise _rejected("a target is joints, a pose, or speeds")
        given = "joints" if joints is not None else "pose" if pose is not None else self.guidance
        if given != self.guidance:
            raise _other_guidance(given, self.guidance)
        if pose is not None and not isinstance(pose, Pose):
            raise _rejected(f"{pose!r} is not a Pose")
        with self._changed:
            state = self._guided()
            limits = self.envelope if self.guidance == "joints" else self.envelope.tcp
            rates = None if speeds is None else limits.check_speeds(speeds)
            values = None if joints is None else self.envelope.check(joints, self._before(state))
            place = None if pose is None else self.envelope.tcp.check(pose, self._pose(state))
            if self._cell is not None:
                targets = [t for t in (self._last, values) if t is not None] or [state.reference]
                self._cell.check_target(state, self._speeds(state), targets, rates)
            self._last, self._last_pose = values, place
            moment = self._clock() if at is None else at
            self._post(Target(moment, values, place, rates, lasts))

    def _speeds(self, state: EgmState) -> Joints:
        """Return the speeds of the reference, from the last two states."""
        earlier = self._earlier
        time_ = 0.0 if earlier is None else state.controller_time - earlier.controller_time
        if earlier is None or not time_ > 0:
            return (0.0,) * len(state.reference)
        pairs = zip(earlier.reference, state.reference, strict=True)
        return tuple((b - a) / time_ for a, b in pairs)

    def _before(self, state: EgmState) -> Joints:
        return self._last or state.reference

    def _pose(self, state: EgmState) -> Pose:
        pose = self._last_pose or state.reference_pose or state.pose
        if pose is None:
            raise _rejected("the controller sends no pose")
        return pose

    def write(self, numbers: Sequence[float] = (), digital: bool | None = None) -> None:
        """Send data to the RAPID program with every answer, RobotWare 7.7 and later.

        Args:
            numbers: At most 40, for the array of `\\DataFromSensor`.
            digital: For the signal of `\\DIfromSensor`; None: not sent.

        Raises TargetRejected: too many numbers, or not finite.
        """
        values = tuple(map(float, numbers))
        if len(values) > MAX_NUMBERS or not all(map(isfinite, values)):
            raise _rejected(f"data are at most {MAX_NUMBERS} finite numbers")
        with self._changed:
            self._post(RapidData(digital, values))

    def _begin_path(self, trajectory: "Trajectory") -> tuple[float, Joints]:
        """Send a trajectory; return its duration and its end."""
        if self.guidance != "joints":
            raise _other_guidance("joints", self.guidance)
        times = tuple(float(t) for t in trajectory.times)
        names = self.envelope.names
        if trajectory.names and sorted(trajectory.names) != sorted(names):
            raise _rejected(f"the trajectory has other joints than {', '.join(names)}")
        order = [(trajectory.names or names).index(name) for name in names]
        if trajectory.positions.shape[1] != len(names):
            raise _rejected(f"{trajectory.positions.shape[1]} columns for {len(names)} joints")
        positions = tuple(tuple(float(row[i]) for i in order) for row in trajectory.positions)
        if len(times) < 2 or times[0] != 0.0:
            raise _rejected("a trajectory has two points or more, and begins at 0 s")
        self.begin(Path(times, positions))
        return times[-1], positions[-1]

    def begin(self, path: Path) -> None:
        """Follow a path from now on, without waiting for its end; it replaces what is executed.

        Position and speed of the robot stay continuous. The first point may be later than
        `path.since`: the robot goes there from where it is. Raises TargetRejected.
        """
        with self._changed:
            state = self._guided()
            self._check_path(path, state.reference)
            if self._cell is not None:
                self._cell.check_path(path, state, self._speeds(state))
            self._last = None
            self._post(path)

    def _check_path(self, path: Path, reference: Joints) -> None:
        envelope, times, positions = self.envelope, path.times, path.positions
        for row in positions:
            envelope.check(row, row)
        for row in path.velocities or ():
            envelope.check_speeds(row)
        if times[0] > path.since:
            times, positions = (path.since, *times), (reference, *positions)
        elif len(times) > 1:
            envelope.check(sample(path, path.since)[0], reference)
        else:
            envelope.check(positions[0], reference)
        for i in range(1, len(times)):
            time_ = times[i] - times[i - 1]
            if not time_ > 0:
                raise _rejected(f"point {i} is not later than the one before")
            for j, (a, b) in enumerate(zip(positions[i - 1], positions[i], strict=True)):
                if abs(b - a) / time_ > envelope.speed[j] * (1 + 1e-6):
                    rate, top = abs(b - a) / time_, envelope.speed[j]
                    raise _rejected(
                        f"{envelope.names[j]} has {rate:.3f} at point {i}, allowed is {top:.3f}"
                    )

    def stop(self) -> None:
        """Slow down and stay; a new EGMRun of the program ends that."""
        with self._changed:
            self._last = self._last_pose = None
            self._post(Stop())

    def _guided(self) -> EgmState:
        state = self._state
        if self._closed or state is None or not state.guided:
            reason = f": {state.ended}" if state is not None and state.ended else ""
            raise _rejected(f"the controller does not guide the robot{reason}")
        if state.stopped:
            raise _rejected("the robot was stopped; a new EGMRun is needed")
        return state

    def _post(self, order: Order) -> None:
        try:
            self._loop.post(order)
        except OSError as fault:
            raise _rejected("the process of the session has ended") from fault

    # -- waiting and end --------------------------------------------------------------------

    def _ready(self, ready: Callable[[EgmState], bool]) -> EgmState | None:
        """Return the state if it is what is waited for. NotReady: there will be none."""
        if self._closed:
            raise NotReady.because("RG681", "the EGM session is closed", "listen again")
        return self._state if self._state is not None and ready(self._state) else None

    def _check_end(self, end: Joints) -> None:
        if self._state is None or self._state.reference != end:
            raise _rejected("the trajectory was interrupted by a stop")


class EgmSession(_Session):
    """The partner of one robot. Joints are rad and m in URDF order.

    All methods may be called from any thread.
    """

    def wait_until_guided(self, timeout: float = 10.0) -> EgmState:
        """Wait until the controller executes answers. Raises RobotTimeout, NotReady."""
        return self._wait(lambda state: state.guided, timeout, "the controller does not guide")

    def next_state(self, timeout: float = 1.0) -> EgmState:
        """Wait for the next state. Raises RobotTimeout, NotReady."""
        before = self._state
        return self._wait(lambda state: state is not before, timeout, "no frame has come")

    def follow(self, trajectory: "Trajectory", timeout: float | None = None) -> None:
        """Follow a trajectory from now on, and wait for its end.

        Raises:
            TargetRejected: It does not begin where the robot is, or is faster than the envelope.
            RobotTimeout: It did not end within `timeout` s; None: its time and 5 s.
        """
        duration, end = self._begin_path(trajectory)
        self._wait(
            lambda state: state.reference == end or state.stopped or not state.guided,
            duration + 5.0 if timeout is None else timeout,
            "the trajectory did not end",
        )
        self._check_end(end)

    def close(self) -> None:
        """Stop answering; the controller then ends the run by its time-out."""
        self._loop.close()

    def _wait(self, ready: Callable[[EgmState], bool], timeout: float, missing: str) -> EgmState:
        due = time.monotonic() + timeout
        with self._changed:
            while (state := self._ready(ready)) is None:
                left = due - time.monotonic()
                if left <= 0:
                    raise _late(missing, timeout)
                self._changed.wait(left)
            return state

    def __enter__(self) -> Self:
        # A controller that sends frames before allows about a second until the first answer.
        self._loop.wait_started()
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class AsyncEgmSession(_Session):
    """`EgmSession` with awaitable methods, used by `async with`."""

    async def wait_until_guided(self, timeout: float = 10.0) -> EgmState:
        """Wait until the controller executes answers. Raises RobotTimeout, NotReady."""
        return await self._wait(
            lambda state: state.guided, timeout, "the controller does not guide"
        )

    async def next_state(self, timeout: float = 1.0) -> EgmState:
        """Wait for the next state. Raises RobotTimeout, NotReady."""
        before = self._state
        return await self._wait(lambda state: state is not before, timeout, "no frame has come")

    async def follow(self, trajectory: "Trajectory", timeout: float | None = None) -> None:
        """Follow a trajectory from now on, and wait for its end.

        Raises:
            TargetRejected: It does not begin where the robot is, or is faster than the envelope.
            RobotTimeout: It did not end within `timeout` s; None: its time and 5 s.
        """
        duration, end = self._begin_path(trajectory)
        await self._wait(
            lambda state: state.reference == end or state.stopped or not state.guided,
            duration + 5.0 if timeout is None else timeout,
            "the trajectory did not end",
        )
        self._check_end(end)

    async def close(self) -> None:
        """Stop answering; the controller then ends the run by its time-out."""
        await asyncio.to_thread(self._loop.close)

    async def _wait(
        self, ready: Callable[[EgmState], bool], timeout: float, missing: str
    ) -> EgmState:
        loop, changed = asyncio.get_running_loop(), asyncio.Event()

        def listener() -> None:
            # The loop may be closed while the process still sends states.
            with contextlib.suppress(RuntimeError):
                loop.call_soon_threadsafe(changed.set)

        with self._changed:
            self._listeners.append(listener)
        due = loop.time() + timeout
        try:
            while True:
                changed.clear()
                with self._changed:
                    state = self._ready(ready)
                if state is not None:
                    return state
                try:
                    await asyncio.wait_for(changed.wait(), due - loop.time())
                except asyncio.TimeoutError:
                    raise _late(missing, timeout) from None
        finally:
            with self._changed:
                self._listeners.remove(listener)

    async def __aenter__(self) -> Self:
        # A controller that sends frames before allows about a second until the first answer.
        try:
            await asyncio.to_thread(self._loop.wait_started)
        except asyncio.CancelledError:
            await self.close()
            raise
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.close()


def _late(missing: str, timeout: float) -> RobotTimeout:
    return RobotTimeout.because(
        "RG681",
        f"{missing} within {timeout:g} s",
        "start the program with EGMRunJoint, and check address and port of the UdpUc device",
    )


def _rejected(text: str) -> TargetRejected:
    return TargetRejected.because(
        "RG680", f"target not sent: {text}", "`session.state` shows what the robot does"
    )


def _other_guidance(given: str, guidance: str) -> TargetRejected:
    return TargetRejected.because(
        "RG682",
        f"target not sent: {given} in a session that guides by {guidance}",
        f'open the session with guidance="{given}", and execute the matching EGMRun',
    )
