"""Validation of a control_msgs/FollowJointTrajectory goal before sending.

Its meaning is joint_trajectory_controller's: of tolerances 0 is the default and -1 none, the last
velocity is zero, times increase, names are in any order. A refusal has a reason: a ROS 2 rejection
has no field for one, so the goal is accepted and then aborted.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from enum import Enum, IntEnum

import numpy as np

from rapidgen.client.trajectory import Array, Trajectory

NONE = -1.0
"""A tolerance that is ignored (`ERASE_VALUE`).

The name is joint_trajectory_controller's.
"""
_STANDS = 1e-6
"""rad/s, m/s: a last velocity up to this is zero."""


class Code(IntEnum):
    """error_code of a FollowJointTrajectory result."""

    SUCCESSFUL = 0
    INVALID_GOAL = -1
    INVALID_JOINTS = -2
    OLD_HEADER_TIMESTAMP = -3
    PATH_TOLERANCE_VIOLATED = -4
    GOAL_TOLERANCE_VIOLATED = -5


class FinalStatus(Enum):
    """End of a goal, in the words of action_msgs/GoalStatus."""

    SUCCEEDED = "succeeded"
    CANCELED = "canceled"
    ABORTED = "aborted"


@dataclass(frozen=True, slots=True)
class Outcome:
    """The end of a goal: its status, error_code and error_string."""

    status: FinalStatus
    code: Code
    text: str


class GoalRefused(Exception):
    """A refused goal: no byte is sent and the robot does not move."""

    def __init__(self, code: Code, text: str) -> None:
        super().__init__(text)
        self.code = code

    @property
    def outcome(self) -> Outcome:
        """Result of the action."""
        return Outcome(FinalStatus.ABORTED, self.code, str(self))


@dataclass(frozen=True, slots=True)
class Tolerance:
    """control_msgs/JointTolerance: rad or m, per s; 0 default, -1 none."""

    name: str
    position: float = 0.0
    velocity: float = 0.0
    acceleration: float = 0.0


@dataclass(frozen=True, slots=True)
class Point:
    """trajectory_msgs/JointTrajectoryPoint: rad or m, per s.

    `time` s from the start.
    """

    time: float
    positions: Sequence[float]
    velocities: Sequence[float] = ()
    accelerations: Sequence[float] = ()
    effort: Sequence[float] = ()


@dataclass(frozen=True, slots=True)
class Goal:
    """A FollowJointTrajectory goal.

    `stamp` is its start in s of ROS time, 0: at once.
    """

    names: Sequence[str]
    points: Sequence[Point]
    stamp: float = 0.0
    path_tolerance: Sequence[Tolerance] = ()
    goal_tolerance: Sequence[Tolerance] = ()
    goal_time_tolerance: float = 0.0
    has_multi_dof: bool = False


@dataclass(frozen=True, slots=True)
class Defaults:
    """Defaults for a goal's 0; rad or m (per s), s; `math.inf`: ignored.

    They are those of joint_trajectory_controller's parameters `constraints`: by default the path is
    not watched and time is not limited. The default for the end is 0.01.
    """

    path: float = math.inf
    goal: float = 0.01
    goal_time: float = math.inf
    late: float = 0.2
    """Age of a stamp that counts as the delay of its message."""


@dataclass(frozen=True, slots=True, eq=False)
class ValidatedGoal:
    """A goal that may be sent, in the robot's order of joints.

    `velocities` (n, k) are rad/s or m/s if they were given; tolerances (k,) are `inf` if they are
    ignored.
    """

    trajectory: Trajectory
    velocities: Array | None
    start: float | None
    """s of ROS time; None: at once."""
    path: Array
    path_velocity: Array
    goal: Array
    goal_velocity: Array
    goal_time: float
    notes: tuple[str, ...] = field(default=())

    def desired(self, time: float) -> Array:
        """Return positions (k,) at `time` s from the start.

        They are linear between points, and constant beyond the ends.
        """
        positions, times = self.trajectory.positions, self.trajectory.times
        return np.array([np.interp(time, times, column) for column in positions.T])

    def desired_velocity(self, time: float) -> Array:
        """Return velocities (k,) of `desired` at `time` s; zero outside."""
        times, positions = self.trajectory.times, self.trajectory.positions
        at = int(np.searchsorted(times, time, side="right"))
        if not 0 < at < len(times):
            return np.zeros(positions.shape[1])
        rate: Array = (positions[at] - positions[at - 1]) / (times[at] - times[at - 1])
        return rate

    @property
    def watches_path(self) -> bool:
        """True if the path, not only its end, has a tolerance."""
        return bool(np.isfinite(self.path).any() or np.isfinite(self.path_velocity).any())

    def with_trajectory(self, trajectory: Trajectory, *notes: str) -> "ValidatedGoal":
        """Return the goal with other points of the same path."""
        return replace(self, trajectory=trajectory, velocities=None, notes=(*self.notes, *notes))


def validate_goal(
    goal: Goal, names: Sequence[str], defaults: Defaults, now: float
) -> ValidatedGoal:
    """Validate a goal for the joints `names`, at `now` s of ROS time.

    Raises GoalRefused.
    """
    _check_names(goal.names, names)
    if goal.has_multi_dof:
        raise GoalRefused(
            Code.INVALID_GOAL, "multi_dof_trajectory has points: this robot has joints only"
        )
    if not goal.points:
        raise GoalRefused(
            Code.INVALID_GOAL, "the trajectory has no points; to stop the robot cancel its goal"
        )
    column = {name: i for i, name in enumerate(goal.names)}
    order = [column[name] for name in names]
    positions = _columns(goal, "positions", order)
    assert positions is not None
    velocities = _columns(goal, "velocities", order)
    times = np.array([point.time for point in goal.points], dtype=np.float64)
    _check_times(times)
    _check_end(velocities, names)
    tolerances = _Tolerances(names, defaults)
    path = tolerances.read(goal.path_tolerance, "path_tolerance", defaults.path)
    end = tolerances.read(goal.goal_tolerance, "goal_tolerance", defaults.goal)
    return ValidatedGoal(
        Trajectory(times, positions, tuple(names)),
        velocities,
        _start(goal.stamp, now, defaults.late),
        *path,
        *end,
        tolerances.value("goal_time_tolerance", goal.goal_time_tolerance, defaults.goal_time),
        tuple(_ignored(goal)),
    )


def _check_names(given: Sequence[str], names: Sequence[str]) -> None:
    missing = [name for name in names if name not in given]
    unknown = [name for name in given if name not in names]
    twice = sorted({name for name in given if list(given).count(name) > 1})
    report = [
        f"{what}: {', '.join(some)}"
        for what, some in (("missing", missing), ("unknown", unknown), ("twice", twice))
        if some
    ]
    if report:
        raise GoalRefused(
            Code.INVALID_JOINTS,
            f"joint_names do not fit ({'; '.join(report)}): "
            f"a goal names each of {', '.join(names)}",
        )


def _columns(goal: Goal, what: str, order: Sequence[int]) -> Array | None:
    """Return a field of all points in the robot's order.

    None if no point has it. A point without velocities, beside others that have them, is as in
    joint_trajectory_controller, which judges each point alone; its row is zero.
    """
    rows: list[Sequence[float]] = [getattr(point, what) for point in goal.points]
    if what != "positions":
        if not any(len(row) for row in rows):
            return None
        rows = [row if len(row) else [0.0] * len(order) for row in rows]
    for number, row in enumerate(rows):
        if len(row) != len(order):
            raise GoalRefused(
                Code.INVALID_GOAL,
                f"point {number} has {len(row)} {what} for {len(order)} joints",
            )
    values = np.array(rows, dtype=np.float64)[:, order]
    bad = np.flatnonzero(~np.isfinite(values).all(axis=1))
    if bad.size:
        raise GoalRefused(Code.INVALID_GOAL, f"point {bad[0]} has {what} that are no numbers")
    return values


def _check_times(times: Array) -> None:
    if not np.isfinite(times).all() or times[0] < 0:
        raise GoalRefused(Code.INVALID_GOAL, "time_from_start is below 0 or no number")
    back = np.flatnonzero(np.diff(times) <= 0)
    if back.size:
        raise GoalRefused(
            Code.INVALID_GOAL,
            f"time_from_start does not increase at point {back[0] + 1}: "
            f"{times[back[0]]:g} s, then {times[back[0] + 1]:g} s",
        )


def _check_end(velocities: Array | None, names: Sequence[str]) -> None:
    if velocities is None:
        return
    moving = np.flatnonzero(np.abs(velocities[-1]) > _STANDS)
    if moving.size:
        raise GoalRefused(
            Code.INVALID_GOAL,
            f"the last point has a velocity ({names[moving[0]]} {velocities[-1][moving[0]]:g}): "
            "a trajectory ends at rest",
        )


def _start(stamp: float, now: float, late: float) -> float | None:
    if stamp == 0:
        return None
    if stamp < now - late:
        raise GoalRefused(
            Code.OLD_HEADER_TIMESTAMP,
            f"header.stamp is {now - stamp:.3f} s in the past; 0 starts at once",
        )
    return stamp


def _ignored(goal: Goal) -> list[str]:
    report = []
    if any(len(point.effort) for point in goal.points):
        report.append("effort was ignored: the controller accepts positions and times")
    requested = (*goal.path_tolerance, *goal.goal_tolerance)
    if any(tolerance.acceleration > 0 for tolerance in requested):
        report.append("tolerances of acceleration were ignored: acceleration is not measured")
    return report


@dataclass(frozen=True, slots=True)
class _Tolerances:
    names: Sequence[str]
    defaults: Defaults

    def read(
        self, requested: Sequence[Tolerance], where: str, default: float
    ) -> tuple[Array, Array]:
        """Return tolerances of positions and velocities (k,); `inf` for none."""
        position = np.full(len(self.names), default)
        velocity = np.full(len(self.names), math.inf)
        for tolerance in requested:
            if tolerance.name not in self.names:
                raise GoalRefused(
                    Code.INVALID_GOAL,
                    f"{where} names '{tolerance.name}', which is not a joint here",
                )
            i = list(self.names).index(tolerance.name)
            place = f"{where} of {tolerance.name}"
            position[i] = self.value(place, tolerance.position, default)
            velocity[i] = self.value(place, tolerance.velocity, math.inf)
            self.value(place, tolerance.acceleration, math.inf)
        return position, velocity

    def value(self, where: str, requested: float, default: float) -> float:
        """Return one tolerance.

        Raises GoalRefused for a value other than a size, 0 or -1.
        """
        if requested == 0:
            return default
        if requested == NONE:
            return math.inf
        if not 0 < requested < math.inf:
            raise GoalRefused(
                Code.INVALID_GOAL,
                f"{where} is {requested:g}: above 0, 0 for the default, -1 for none",
            )
        return requested
