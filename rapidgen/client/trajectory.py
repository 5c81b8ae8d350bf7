"""A path of joint positions with times: frozen arrays, and where they came from."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from rapidgen.axes.timing import parametrise, resample
from rapidgen.client import files
from rapidgen.client.errors import InvalidTrajectory

if TYPE_CHECKING:
    from rapidgen.client.core.group import Group
    from rapidgen.client.core.state import State

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False, init=False)
class Trajectory:
    """`n` points of `k` joints.

    `positions` (n, k) in rad or m, columns as `names` (URDF joint names; empty: the robot's own
    order); `times` (n,) in s from the start, the first point's too. The arrays are read-only.
    Whether a robot can do it is asked by `Robot.check`; making one only asks for the shapes.
    """

    times: Array
    positions: Array
    names: tuple[str, ...]
    path: str
    """The file it was read from."""
    lines: tuple[int, ...] = field(repr=False)
    """The file's line of each point, where there is one."""

    def __init__(
        self,
        times: npt.ArrayLike,
        positions: npt.ArrayLike,
        names: Sequence[str] = (),
        path: str = "",
        lines: Sequence[int] = (),
    ) -> None:
        try:
            times = np.array(times, dtype=np.float64)
            positions = np.array(positions, dtype=np.float64)
        except (TypeError, ValueError) as error:
            raise InvalidTrajectory.because(
                "RG611", f"a trajectory needs numbers: {error}", exit_code=2
            ) from error
        if positions.ndim != 2 or times.shape != (len(positions),):
            raise InvalidTrajectory.because(
                "RG611",
                f"times of shape {times.shape} do not fit positions of shape {positions.shape}",
                "give times of shape (n,) and positions of shape (n, joints)",
                exit_code=2,
            )
        if names and positions.shape[1] != len(names):
            raise InvalidTrajectory.because(
                "RG611", f"{positions.shape[1]} columns for {len(names)} joint names", exit_code=2
            )
        times.flags.writeable = positions.flags.writeable = False
        told = {"times": times, "positions": positions, "names": tuple(names)}
        for name, value in {**told, "path": path, "lines": tuple(lines)}.items():
            object.__setattr__(self, name, value)

    def __len__(self) -> int:
        return len(self.times)

    @property
    def duration(self) -> float:
        """Time of the last point, s; 0 without points."""
        return float(self.times[-1]) if len(self) else 0.0

    @classmethod
    def from_points(
        cls,
        points: Sequence[Sequence[float]],
        *,
        seconds: float | Sequence[float],
        names: Sequence[str] = (),
    ) -> "Trajectory":
        """Points with `seconds` from each to the next: one number, or n-1 of them.

        The first point is where the robot stands, at time 0.
        """
        positions = np.asarray(points, dtype=np.float64)
        steps = np.broadcast_to(np.asarray(seconds, dtype=np.float64), (max(len(points) - 1, 0),))
        times = np.concatenate([[0.0], np.cumsum(steps)])[: len(points)]
        return cls(times, positions, names)

    @classmethod
    def from_csv(cls, path: str | PathLike[str]) -> "Trajectory":
        """Read `time,<joint names>` in s and rad (m). Raises InvalidTrajectory, all faults."""
        return cls(*files.read_csv(Path(path)))

    @classmethod
    def from_json(cls, path: str | PathLike[str]) -> "Trajectory":
        """Read a JSON file of the shape of `to_dict` or of trajectory_msgs/JointTrajectory."""
        return cls(*files.read_json(Path(path)))

    @classmethod
    def from_ros(cls, message: Mapping[str, Any]) -> "Trajectory":
        """A trajectory_msgs/JointTrajectory as a dict (`joint_names`, `points`)."""
        return cls(*files.from_ros(message))

    def to_dict(self) -> dict[str, Any]:
        """`{"joint_names", "times", "positions"}` with plain lists."""
        return {
            "joint_names": list(self.names),
            "times": self.times.tolist(),
            "positions": self.positions.tolist(),
        }

    def to_csv(self, path: str | PathLike[str]) -> None:
        """Write `time,<joint names>`; numbers read back to the same values."""
        files.write_csv(Path(path), self.times, self.positions, self.names)

    def reordered(self, names: Sequence[str]) -> "Trajectory":
        """The same with columns in the order of `names`; without names of its own, unchanged.

        Raises KeyError for a name that it lacks.
        """
        if not self.names or self.names == tuple(names):
            return replace(self, names=tuple(names)) if not self.names else self
        column = {name: i for i, name in enumerate(self.names)}
        order = [column[name] for name in names]
        return replace(self, positions=self.positions[:, order], names=tuple(names))

    def scaled(self, speed: float) -> "Trajectory":
        """The same path at `speed` times the speed (0.5: twice the time)."""
        if not 0 < speed < float("inf"):
            raise ValueError(f"speed must be above 0, not {speed}")
        return replace(self, times=self.times / speed)

    def resampled(self, period: float) -> "Trajectory":
        """The same path with points about every `period` s, linear between; ends kept.

        Raises ValueError when times do not increase.
        """
        if len(self) < 2:
            return self
        times, positions = resample(self.times, self.positions, period)
        return replace(self, times=times, positions=positions, lines=())

    def starting_at(self, state: "State", seconds: float) -> "Trajectory":
        """The same behind a way of `seconds` s from where the robot stands.

        Raises KeyError for a joint that the robot does not have.
        """
        if not 0 < seconds < float("inf"):
            raise ValueError(f"seconds must be above 0, not {seconds}")
        here = [state[name] for name in self.names] if self.names else list(state.joints)
        first = float(self.times[0]) if len(self) else 0.0
        times = np.concatenate([[0.0], self.times - first + seconds])
        positions = np.concatenate([[here], self.positions])
        return replace(self, times=times, positions=positions, lines=())

    def timed(self, robot: "Group", speed: float = 1.0) -> "Trajectory":
        """The same points with times of their own: short, within the axes' limits x `speed`.

        `robot` is `Robot.group`. Raises InvalidTrajectory when names do not fit or limits are
        not known, ValueError for fewer than two points.
        """
        if not robot.has_limits:
            raise InvalidTrajectory.because(
                "RG615", "the robot's speeds are not known", "connect with a configuration"
            )
        ordered = self.reordered(robot.names)
        wire = robot.to_wire(ordered.positions)
        acceleration = np.where(np.isfinite(robot.acceleration), robot.acceleration, 1e6)
        times = parametrise(wire, robot.speed * speed, acceleration * speed)
        # Rounded up to what the planner follows: a shorter segment would be refused.
        steps = np.maximum(np.diff(times), robot.policy.min_segment)
        return replace(ordered, times=np.concatenate([[0.0], np.cumsum(steps)]))

    def reversed(self) -> "Trajectory":
        """The way back, in the same time."""
        if not len(self):
            return self
        times = self.times[0] + (self.times[-1] - self.times[::-1])
        return replace(self, times=times, positions=self.positions[::-1], lines=self.lines[::-1])
