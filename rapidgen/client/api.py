"""What `Robot` and `AsyncRobot`, and what their calls return, have in common.

Calls that wait run a flow (`flows/`). They are written out in `sync.py` and `aio.py`, so that
editors and `help` show their signatures.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from html import escape
from os import PathLike
from typing import TYPE_CHECKING, Generic, TypeVar

from rapidgen.axes.kinematics import AxisConfiguration
from rapidgen.client import display, flows
from rapidgen.client.address import LOOPBACK, Address
from rapidgen.client.connect_target import configuration_of, resolve
from rapidgen.client.core.checks import TransferMode
from rapidgen.client.core.group import Group
from rapidgen.client.core.motion import CommandedMotion
from rapidgen.client.core.point_source import PointSource
from rapidgen.client.core.robot import Core, Timeouts
from rapidgen.client.core.state import Driver, Event, Feedback, Progress, State
from rapidgen.client.errors import InvalidProgram, InvalidTarget, NotSupported
from rapidgen.client.pose import Pose, pose_of
from rapidgen.client.program import Program, joints_of
from rapidgen.client.recording import JointRecording
from rapidgen.client.runner import FlowRunner, MakeCore
from rapidgen.client.trajectory import Trajectory
from rapidgen.config.model import EgmSettings, RobotConfig
from rapidgen.diagnostics import Diagnostic

if TYPE_CHECKING:
    from rapidgen.client.collisions import CellCheck

R = TypeVar("R", bound=FlowRunner)
Subject = TypeVar("Subject", bound="CommandedMotion | PointSource")


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


class MotionHandle(Generic[R, Subject]):
    """What the caller of a motion holds: its progress and its end."""

    def __init__(self, runner: R, subject: Subject) -> None:
        self._runner = runner
        self._subject = subject

    def __repr__(self) -> str:
        with self._runner.guard:
            return f"<{type(self).__name__} {self._subject}>"

    def _repr_html_(self) -> str:
        with self._runner.guard:
            text, progress = str(self._subject), self._subject.progress
        bar = f'<progress value="{progress.fraction:.3f}"></progress>'
        return f"<p>{escape(type(self).__name__)} {escape(text)} {bar}</p>"

    @property
    def progress(self) -> Progress:
        """Current progress; `total` of a stream is the number of points so far."""
        with self._runner.guard:
            return self._subject.progress

    @property
    def is_over(self) -> bool:
        """True if the result is known, good or bad."""
        return self._subject.is_over

    @property
    def stopped_position(self) -> tuple[float, ...] | None:
        """Joints at which the robot stopped.

        None while it moves, or if no state showed that it is at rest.
        """
        return self._subject.stopped_position


class AcceptedMotion:
    """A trajectory or program that the controller has accepted."""

    _subject: CommandedMotion

    @property
    def warnings(self) -> Sequence[Diagnostic]:
        """Warnings of the checks."""
        return self._subject.warnings

    @property
    def mode(self) -> TransferMode:
        """`stream` (sent during the motion) or `download` (sent before it)."""
        return self._subject.mode


class ExecutionApi(AcceptedMotion, MotionHandle[R, CommandedMotion]):
    """A trajectory that the controller has accepted."""

    @property
    def trajectory(self) -> Trajectory:
        """The commanded trajectory, in the robot's order of joints."""
        assert self._subject.trajectory is not None
        return self._subject.trajectory

    @property
    def planned_seconds(self) -> float:
        """Commanded duration in s."""
        return self._subject.planned_seconds


class RunApi(AcceptedMotion, MotionHandle[R, CommandedMotion]):
    """A program that the controller has accepted, or its first part."""

    def __init__(self, runner: R, motion: CommandedMotion, program: Program) -> None:
        super().__init__(runner, motion)
        self._program = program

    @property
    def program(self) -> Program:
        """The commanded program."""
        return self._program


class StreamApi(MotionHandle[R, PointSource]):
    """Points that the robot executes while later ones are added."""

    @property
    def total(self) -> int:
        """Number of added points."""
        return self._subject.total

    @property
    def time(self) -> float:
        """Time of the last point in s from the start; 0 before the first."""
        return self._subject.last.time if self._subject.last is not None else 0.0

    @property
    def mode(self) -> TransferMode | None:
        """`stream`, or `download` if the driver does not stream.

        None before the first point.
        """
        return self._subject.mode

    @property
    def starved(self) -> int:
        """Number of stops because the stream ran out of points."""
        return self._subject.motion.starved if self._subject.motion is not None else 0


class RobotApi(Generic[R]):
    """One motion group of a robot: what needs no wait.

    `Robot` and `AsyncRobot` add the calls that wait, with equal signatures and docstrings.
    """

    _runner_type: Callable[[Address, MakeCore], R]

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
        cell: "str | PathLike[str] | CellCheck | None" = None,
    ) -> None:
        self.address, known = resolve(target, address, group)
        self._target, self._group_name = target, group
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
        self._runner = self._runner_type(self.address, make_core)
        self._core = self._runner.core
        if cell is not None:
            # Imported on use: nothing of collision checks is loaded without a cell.
            from rapidgen.client.collisions import cell_check

            self._core.collisions = cell_check(cell, configuration_of(target), group)
            self._core.collisions.position = self._position

    def __repr__(self) -> str:
        with self._runner.guard:
            return f"<{type(self).__name__} {display.robot_text(self._core, self.address)}>"

    def _repr_html_(self) -> str:
        with self._runner.guard:
            caption, group = display.robot_text(self._core, self.address), self._core.group
            state = self._core.state_port.state
        if group is None or state is None:
            return f"<p>{escape(caption)}</p>"
        return display.state_table(caption, group, state.joints)

    def _position(self) -> tuple[float, ...]:
        with self._runner.guard:
            return self._core.start

    @property
    def cell(self) -> "CellCheck":
        """The collision check of `cell=...`: `robot.cell.attach("part")`.

        Raises NotSupported for a robot without one.
        """
        if self._core.collisions is None:
            raise NotSupported.because(
                "RG624", "the robot was created without a cell", 'Robot(..., cell="cell.yaml")'
            )
        return self._core.collisions

    # Connection

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
        with self._runner.guard:
            return self._core.state_port.messages

    def _unfinished(self) -> str:
        """Return a description of unfinished work at the end of a block.

        Empty if the caller has waited for everything.
        """
        with self._runner.guard:
            motion = self._core.motion
            if motion is None or motion.is_over:
                return ""
            done = f"{motion.progress.reached or 0} of {motion.total} {motion.noun}s"
        return (
            f"the robot was stopped at the end of the block, after {done} of an active motion: "
            "wait for it with `execution.result()`, or end it with `cancel()`"
        )

    def _egm_partner(self) -> tuple[RobotConfig, EgmSettings, str]:
        """Return configuration, settings, and the address on which the partner listens.

        Raises NotSupported without `egm:`.
        """
        with self._runner.guard:
            egm = flows.guidance.settings(self._core)
        config = self.configuration
        # A group with `egm:` comes from a configuration.
        assert config is not None
        return config, egm, LOOPBACK if self.address.is_loopback else egm.address

    # State

    @property
    def state(self) -> State:
        """The newest state. Raises ConnectionLost before the first."""
        with self._runner.guard:
            state = self._core.state_port.state
        if state is None:
            raise self._core.disconnected()
        return state

    @property
    def feedback(self) -> Feedback | None:
        """Newest feedback; None before the first and without feedback."""
        with self._runner.guard:
            return self._core.state_port.feedback

    @property
    def events(self) -> tuple[Event, ...]:
        """Last entries of the controller's event log, if the driver sends them."""
        with self._runner.guard:
            return tuple(self._core.state_port.events)

    @contextmanager
    def recording(self) -> Iterator[JointRecording]:
        """Record every joint message while the block runs.

        With `feedback` the times are those of the controller.
        """
        recording = JointRecording(self.group)
        with self._runner.guard:
            self._core.state_port.listeners.append(recording)
        try:
            yield recording
        finally:
            with self._runner.guard:
                self._core.state_port.listeners.remove(recording)

    # Motion

    @property
    def configuration(self) -> RobotConfig | None:
        """Configuration of the target; None for an address alone."""
        return configuration_of(self._target)

    @property
    def pose(self) -> Pose:
        """TCP pose in the work object, m, at the last known position.

        Raises as `pose_of`.
        """
        return self.pose_of(self.state.joints)

    def pose_of(self, joints: Sequence[float]) -> Pose:
        """Return the pose that joints (rad, m) reach.

        Raises NotSupported if the robot's geometry is unknown,
        InvalidProgram if the values are not its joints.
        """
        return Pose(*self.group.poses.pose(_on_axes(self.group, joints)))

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
        with self._runner.guard:
            return self._core.check(trajectory).warnings

    def mode_for(self, trajectory: Trajectory) -> TransferMode:
        """Return the default `mode` of `execute` for a trajectory.

        Raises InvalidTrajectory, NotReady.
        """
        with self._runner.guard:
            return self._core.check(trajectory).mode

    def check_program(self, program: Program) -> tuple[Diagnostic, ...]:
        """Check a program and return warnings; sends no data.

        Raises InvalidProgram with every fault.
        """
        with self._runner.guard:
            checked, _ = self._core.check_program(program)
        return checked.notes
