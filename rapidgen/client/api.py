"""Methods that both clients share, each a flow with its docstring.

`Robot` waits for a method's outcome (`sync`), `AsyncRobot` returns an awaitable (`aio`); so do
their `Execution` and `Stream`. The clients themselves add `with`, `async with` and iterators only.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from functools import partial
from html import escape
from operator import attrgetter
from os import PathLike
from typing import Concatenate, Generic, ParamSpec, Protocol, TypeVar

from rapidgen.axes.frames import Pose
from rapidgen.axes.kinematics import AxisConfiguration
from rapidgen.client import display, flows
from rapidgen.client.address import Address
from rapidgen.client.connect_target import resolve
from rapidgen.client.core.checks import TransferMode
from rapidgen.client.core.group import Group
from rapidgen.client.core.job import Job
from rapidgen.client.core.robot import Core, Timeouts
from rapidgen.client.core.state import Driver, Event, Feedback, Progress, State
from rapidgen.client.errors import InvalidProgram, InvalidTarget
from rapidgen.client.flow_methods import Method, method
from rapidgen.client.flows.effects import Flow
from rapidgen.client.program import Program, joints_of, pose_of
from rapidgen.client.recording import JointRecording
from rapidgen.client.trajectory import Trajectory
from rapidgen.config.model import RobotConfig
from rapidgen.diagnostics import Diagnostic

P = ParamSpec("P")
T = TypeVar("T")
Owner = TypeVar("Owner")
MakeCore = Callable[[Callable[[], float]], Core]
"""A core on a clock that returns s."""


class FlowRunner(Protocol):
    """A runner of flows: on the caller's thread or on the caller's loop."""

    core: Core
    guard: AbstractContextManager[object]
    """Lock of data that another thread may change."""

    def __init__(self, address: Address, make_core: MakeCore) -> None: ...


def _on_axes(group: Group, joints: Sequence[float]) -> tuple[float, ...]:
    """Map joints to axis values.

    Raises InvalidProgram for values that are not joints of the robot.
    """
    values = joints_of(joints)
    if len(values) != len(group.names):
        raise InvalidProgram.because(
            "RG670",
            f"{len(values)} joints, the robot has {len(group.names)}",
            f"numbers, rad and m, of {', '.join(group.names)}",
        )
    return group.map.to_controller(values)


def _of_core(flow: Callable[Concatenate[Core, P], Flow[T]]) -> Method[P, T]:
    return method(flow, attrgetter("_core"))


def _of_job(flow: Callable[Concatenate[Job, P], Flow[T]]) -> Method[P, T]:
    return method(flow, attrgetter("_job"))


def _own(flow: Callable[Concatenate[Owner, P], Flow[T]]) -> Method[P, T]:
    return method(flow, lambda owner: owner)


C_co = TypeVar("C_co", bound=FlowRunner, covariant=True)


class JobApi(Generic[C_co]):
    """Methods common to an active trajectory and a stream."""

    def __init__(self, carrier: C_co, job: Job) -> None:
        self._carrier = carrier
        self._job = job

    def __repr__(self) -> str:
        with self._carrier.guard:
            return f"<{type(self).__name__} {self._job}>"

    def _repr_html_(self) -> str:
        with self._carrier.guard:
            text, progress = str(self._job), self._job.progress
        bar = f'<progress value="{progress.fraction:.3f}"></progress>'
        return f"<p>{escape(type(self).__name__)} {escape(text)} {bar}</p>"

    result = _of_job(flows.job.result)
    cancel = _of_job(flows.job.cancel)

    @property
    def progress(self) -> Progress:
        """Current progress; `total` of a stream is the number of points so far."""
        with self._carrier.guard:
            return self._job.progress

    @property
    def is_over(self) -> bool:
        """True if the result is known, good or bad."""
        return self._job.is_over

    @property
    def stopped_position(self) -> tuple[float, ...] | None:
        """Joints at which the robot stopped.

        None while it moves, or if no state showed that it is at rest.
        """
        return self._job.stopped_position


class ExecutionApi(JobApi[C_co]):
    """A trajectory that the controller has accepted."""

    @property
    def trajectory(self) -> Trajectory:
        """The commanded trajectory, in the robot's order of joints."""
        assert self._job.motion is not None
        assert self._job.motion.trajectory is not None
        return self._job.motion.trajectory

    @property
    def warnings(self) -> Sequence[Diagnostic]:
        """Warnings of the checks."""
        assert self._job.motion is not None
        return self._job.motion.warnings

    @property
    def planned_seconds(self) -> float:
        """Commanded duration in s."""
        assert self._job.motion is not None
        return self._job.motion.planned_seconds

    @property
    def mode(self) -> TransferMode:
        """`stream` (sent during the motion) or `download` (sent before it)."""
        assert self._job.motion is not None
        return self._job.motion.mode


class RunApi(JobApi[C_co]):
    """A program that the controller has accepted, or its first part."""

    @property
    def program(self) -> Program:
        """The commanded program."""
        assert self._job.program is not None
        return self._job.program

    @property
    def warnings(self) -> Sequence[Diagnostic]:
        """Warnings of the checks."""
        assert self._job.motion is not None
        return self._job.motion.warnings

    @property
    def mode(self) -> TransferMode:
        """`download` (sent before the motion) or `stream` (sent during it)."""
        assert self._job.motion is not None
        return self._job.motion.mode


class StreamApi(JobApi[C_co]):
    """Points that the robot executes while later ones are added."""

    append = _of_job(flows.job.append)
    flush = _of_job(flows.job.flush)
    end = _of_job(flows.job.end)

    @property
    def total(self) -> int:
        """Number of added points."""
        return self._job.total

    @property
    def time(self) -> float:
        """Time of the last point in s from the start; 0 before the first."""
        return self._job.last.time if self._job.last is not None else 0.0

    @property
    def mode(self) -> TransferMode | None:
        """`stream`, or `download` if the driver does not stream.

        None before the first point.
        """
        return self._job.mode

    @property
    def starved(self) -> int:
        """Number of stops because the stream ran out of points."""
        return self._job.motion.starved if self._job.motion is not None else 0


Execution = TypeVar("Execution", bound=ExecutionApi[FlowRunner], covariant=True)
Stream = TypeVar("Stream", bound=StreamApi[FlowRunner], covariant=True)
Run = TypeVar("Run", bound=RunApi[FlowRunner], covariant=True)


class RobotApi(Generic[C_co, Execution, Stream, Run]):
    """One motion group of a robot; see `Robot`."""

    _carrier_type: type[C_co]
    _execution_type: type[Execution]
    _stream_type: type[Stream]
    _run_type: type[Run]

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
        if not isinstance(timeouts, Timeouts | None):
            raise InvalidTarget.because(
                "RG607",
                f"time-outs are a Timeouts, not {type(timeouts).__name__}",
                "Timeouts(reply=5) and the like, in s: each wait has its own time limit",
                exit_code=2,
            )
        make_core = partial(
            Core,
            known,
            timeouts or Timeouts(),
            watch=watch,
            plain=plain,
            reconnect=reconnect,
            feedback=feedback,
            # The client's own machine is not a robot.
            simulated=self.address.is_loopback,
            where=str(self.address),
        )
        self._carrier = self._carrier_type(self.address, make_core)
        self._core = self._carrier.core

    def __repr__(self) -> str:
        with self._carrier.guard:
            return f"<{type(self).__name__} {display.robot_text(self._core, self.address)}>"

    def _repr_html_(self) -> str:
        with self._carrier.guard:
            caption, group = display.robot_text(self._core, self.address), self._core.group
            state = self._core.state_port.state
        if group is None or state is None:
            return f"<p>{escape(caption)}</p>"
        return display.state_table(caption, group, state.joints)

    # Connection

    close = _of_core(flows.stop.close)

    @property
    def is_connected(self) -> bool:
        """True if all connections are open."""
        return self._core.is_connected

    @property
    def driver(self) -> Driver:
        """The driver that answered, and its missing features."""
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
        with self._carrier.guard:
            return self._core.state_port.messages

    def _unfinished(self) -> str:
        """Return a description of unfinished work at the end of a block.

        Empty if the caller has waited for everything.
        """
        with self._carrier.guard:
            motion = self._core.motion
            if motion is None or motion.is_over:
                return ""
            done = f"{motion.progress.reached or 0} of {motion.total} {motion.noun}s"
        return (
            f"the robot was stopped at the end of the block, after {done} of an active motion: "
            "wait for it with `execution.result()`, or end it with `cancel()`"
        )

    # State

    next_state = _of_core(flows.state.next_state)
    wait_until = _of_core(flows.state.wait_until)
    next_event = _of_core(flows.state.next_event)
    next_feedback = _of_core(flows.state.next_feedback)

    @property
    def state(self) -> State:
        """The newest state. Raises ConnectionLost before the first."""
        with self._carrier.guard:
            state = self._core.state_port.state
        if state is None:
            raise self._core.disconnected()
        return state

    @property
    def feedback(self) -> Feedback | None:
        """Newest feedback; None before the first and without feedback."""
        with self._carrier.guard:
            return self._core.state_port.feedback

    @property
    def events(self) -> tuple[Event, ...]:
        """Last entries of the controller's event log, if the driver sends them."""
        with self._carrier.guard:
            return tuple(self._core.state_port.events)

    @contextmanager
    def recording(self) -> Iterator[JointRecording]:
        """Record every joint message while the block runs.

        With `feedback` the times are those of the controller.
        """
        recording = JointRecording(self.group)
        with self._carrier.guard:
            self._core.state_port.listeners.append(recording)
        try:
            yield recording
        finally:
            with self._carrier.guard:
                self._core.state_port.listeners.remove(recording)

    # Motion

    pause = _of_core(flows.control.pause)
    resume = _of_core(flows.control.resume)
    set_speed = _of_core(flows.control.set_speed)
    read_signal = _of_core(flows.control.read_signal)
    write_signal = _of_core(flows.control.write_signal)
    read_data = _of_core(flows.data.read)
    write_data = _of_core(flows.data.write)
    stop = _of_core(flows.stop.stop)

    move_to = _of_core(flows.program.move_to)
    move_linear = _of_core(flows.program.move_linear)
    jog = _of_core(flows.program.jog)
    call = _of_core(flows.program.call)

    @property
    def pose(self) -> Pose:
        """TCP pose in the work object, m, at the last known position.

        Raises as `pose_of`.
        """
        return self.pose_of(self.state.joints)

    def pose_of(self, joints: Sequence[float]) -> Pose:
        """Return the pose that joints (rad, m) reach.

        It is ((x, y, z), (w, x, y, z)), m. Raises NotSupported if the robot's geometry is unknown,
        InvalidProgram if the values are not its joints.
        """
        return self.group.poses.pose(_on_axes(self.group, joints))

    def joints_for(
        self,
        pose: Pose,
        *,
        near: Sequence[float] | None = None,
        configuration: AxisConfiguration | None = None,
    ) -> tuple[tuple[float, ...], ...]:
        """Return all joints (rad, m) within limits that reach a pose.

        The nearest to `near` comes first, by default the nearest to the current position. A
        configuration (cf1, cf4, cf6, cfx) selects among them. Raises NotSupported if the robot's
        geometry is unknown, InvalidProgram if the arguments are not a pose or not joints of the
        robot.
        """
        group = self.group
        current = _on_axes(group, self.state.joints if near is None else near)
        result = group.poses.postures(pose_of(pose), current, configuration)
        return tuple(group.map.to_urdf(posture) for posture in result)

    @property
    def override(self) -> float:
        """Share of the programmed speed (0.01 to 1) last set by this client."""
        return self._core.override

    def check(self, trajectory: Trajectory) -> tuple[Diagnostic, ...]:
        """Check a trajectory and return warnings; sends no data.

        Raises InvalidTrajectory with every fault.
        """
        with self._carrier.guard:
            return self._core.check(trajectory).warnings

    def mode_for(self, trajectory: Trajectory) -> TransferMode:
        """Return the default `mode` of `execute` for a trajectory.

        Raises InvalidTrajectory, NotReady.
        """
        with self._carrier.guard:
            return self._core.check(trajectory).mode

    @_own
    def execute(
        self, trajectory: Trajectory, *, mode: TransferMode | None = None
    ) -> Flow[Execution]:
        """Send a trajectory; return when the controller has accepted it.

        `mode` is `download` (all points are sent before the motion) or `stream` (the rest is sent
        during the motion); by default a trajectory that exceeds the driver's ring buffer is
        streamed. Raises InvalidTrajectory and NotReady before a byte is sent, TrajectoryRefused if
        the robot will not move, NotSupported, RobotTimeout, ConnectionLost. Ctrl-C or cancelling
        this call stops the robot.
        """
        job = yield from flows.job.execute(self._core, trajectory, mode)
        return self._execution_type(self._carrier, job)

    def stream(self, names: Sequence[str] = (), *, fallback: bool = True) -> Stream:
        """Return a `Stream`, a trajectory without a known end; sends no data.

        `names` are those of the columns, by default the robot's own. With `fallback` a driver that
        does not stream receives all points at the end.
        """
        return self._stream_type(self._carrier, Job(self._core, names, may_download=fallback))

    def check_program(self, program: Program) -> tuple[Diagnostic, ...]:
        """Check a program and return warnings; sends no data.

        Raises InvalidProgram with every fault.
        """
        with self._carrier.guard:
            checked, _ = self._core.check_program(program)
        return checked.notes

    @_own
    def run(self, program: Program, *, mode: TransferMode | None = None) -> Flow[Run]:
        """Send a program; return when the controller has accepted it.

        `mode` is `download` (sent and checked by the controller before the motion) or `stream` (the
        rest is sent during the motion); by default a program that fits the driver's ring buffer is
        downloaded. Raises InvalidProgram, NotReady and NotSupported before a byte is sent,
        TrajectoryRefused if the robot will not move, RobotTimeout, ConnectionLost. Ctrl-C or
        cancelling this call stops the robot.
        """
        job = yield from flows.program.run(self._core, program, mode)
        return self._run_type(self._carrier, job)
