"""A path of joint positions with times, as frozen arrays."""

from collections.abc import Iterator, Mapping, Sequence, Sized
from dataclasses import dataclass, fields, replace
from importlib import import_module
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, overload

import numpy as np
import numpy.typing as npt

from rapidgen.axes.timing import parametrise, resample
from rapidgen.client import files
from rapidgen.client.errors import InvalidTrajectory
from rapidgen.client.html_tables import table

if TYPE_CHECKING:
    import pandas

    from rapidgen.client.core.group import Group
    from rapidgen.client.core.state import State
    from rapidgen.client.program import ZoneLike
    from rapidgen.config.model import RobotConfig
    from rapidgen.export.writer import ExportedModule, WriterOptions

Array = npt.NDArray[np.float64]
_SHOWN = 4
"""Points that a notebook shows at each end."""


class Waypoint(NamedTuple):
    """One point: `time` s, and `joints` in rad or m.

    The joints are in the trajectory's order.
    """

    time: float
    joints: tuple[float, ...]


def _uneven(positions: npt.ArrayLike) -> str:
    """Return which point has another number of values than the first; empty if none has."""
    rows = positions if isinstance(positions, list | tuple) else ()
    counts = [len(row) if isinstance(row, Sized) else 0 for row in rows]
    for number, count in enumerate(counts):
        if count != counts[0]:
            return f"point {number} has {count} values, point 0 has {counts[0]}"
    return ""


@dataclass(frozen=True, slots=True, eq=False, init=False, repr=False)
class Trajectory:
    """`n` points of `k` joints.

    `positions` (n, k) in rad or m, columns as `names` (URDF joint names; empty: the robot's own
    order); `times` (n,) in s from the start, also the first point's. The arrays are read-only. The
    constructor checks the shapes only; `Robot.check` checks whether a robot can execute it.

    It is a sequence of points: `trajectory[3]` is one, `trajectory[2:5]` a trajectory of some, with
    their times, and `trajectory["joint_3"]` the values of a joint (n,).
    """

    times: Array
    positions: Array
    names: tuple[str, ...]
    path: str
    """Path of the file, if it was read from one."""
    lines: tuple[int, ...]
    """The file's line of each point, if there is one."""

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
                "RG611", f"a trajectory needs numbers: {_uneven(positions) or error}", exit_code=2
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
        twice = sorted({name for name in names if list(names).count(name) > 1})
        if twice:
            raise InvalidTrajectory.because(
                "RG611", f"joint names are there twice: {', '.join(twice)}", exit_code=2
            )
        times.flags.writeable = positions.flags.writeable = False
        report = {"times": times, "positions": positions, "names": tuple(names)}
        for name, value in {**report, "path": path, "lines": tuple(lines)}.items():
            object.__setattr__(self, name, value)

    def __len__(self) -> int:
        return len(self.times)

    @overload
    def __getitem__(self, which: int) -> Waypoint: ...
    @overload
    def __getitem__(self, which: slice) -> "Trajectory": ...
    @overload
    def __getitem__(self, which: str) -> Array: ...
    def __getitem__(self, which: int | slice | str) -> "Waypoint | Trajectory | Array":
        """A point, some points, or a joint's values. Raises IndexError, KeyError."""
        if isinstance(which, str):
            if which not in self.names:
                raise KeyError(which)
            column: Array = self.positions[:, self.names.index(which)]
            return column
        if isinstance(which, slice):
            times, positions = self.times[which], self.positions[which]
            return replace(self, times=times, positions=positions, lines=self.lines[which])
        return Waypoint(float(self.times[which]), tuple(self.positions[which].tolist()))

    def __iter__(self) -> Iterator[Waypoint]:
        return map(Waypoint, self.times.tolist(), map(tuple, self.positions.tolist()))

    def __repr__(self) -> str:
        return f"<Trajectory {self}>"

    def __str__(self) -> str:
        named = ", ".join(self.names) or f"{self.positions.shape[1]} joints"
        origin = f", {self.path}" if self.path else ""
        return f"{len(self)} points in {self.duration:.3f} s: {named}{origin}"

    def _repr_html_(self) -> str:
        names = self.names or [f"{i + 1}" for i in range(self.positions.shape[1])]
        rows = [
            (str(i), f"{point.time:.3f}", *(f"{value:.4f}" for value in point.joints))
            for i, point in enumerate(self)
            if min(i, len(self) - 1 - i) < _SHOWN
        ]
        if len(self) > len(rows):
            rows.insert(_SHOWN, ("…",) * (len(names) + 2))
        return table(str(self), ("", "time s", *names), rows)

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
        """Create a trajectory from points and the `seconds` between them.

        `seconds` is one number, or n-1 of them. The first point is the robot's position, at time 0.
        """
        count = len(points)
        try:
            steps = np.broadcast_to(np.asarray(seconds, dtype=np.float64), (max(count - 1, 0),))
        except (TypeError, ValueError) as error:
            raise InvalidTrajectory.because(
                "RG611",
                f"seconds {seconds!r} do not fit {count} points",
                f"give one number of s, or {max(count - 1, 0)} of them",
                exit_code=2,
            ) from error
        return cls(np.concatenate([[0.0], np.cumsum(steps)])[:count], points, names)

    @classmethod
    def from_csv(cls, path: str | PathLike[str]) -> "Trajectory":
        """Read `time,<joint names>` in s and rad (m).

        Raises InvalidTrajectory with all faults.
        """
        return cls(*files.read_csv(Path(path)))

    @classmethod
    def from_json(cls, path: str | PathLike[str]) -> "Trajectory":
        """Read JSON in the shape of `to_dict` or JointTrajectory.

        The latter is trajectory_msgs/JointTrajectory.
        """
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

    def to_rapid(
        self,
        robot: "RobotConfig | str | PathLike[str]",
        *,
        group: str = "",
        module: str = "exported",
        routine: str = "main",
        zone: "ZoneLike" = "z10",
        options: "WriterOptions | None" = None,
    ) -> "ExportedModule":
        """Return the trajectory as a RAPID module of MoveAbsJ with the times of its points.

        `robot` is a configuration, `zone` the zone of all points but the first and last. The module
        is formatted and checked, not executed. Raises InvalidTrajectory with all faults, and
        DiagnosticError for names that RAPID does not allow.
        """
        from rapidgen.export.writer import WriterOptions

        # By name: it imports this module, and moving a robot does not need it.
        export = import_module("rapidgen.client.rapid_export")
        config, chosen = export.robot_of(robot, group)
        result: ExportedModule = export.export_trajectory(
            self,
            config,
            chosen,
            module=module,
            routine=routine,
            zone=zone,
            options=options or WriterOptions(),
        )
        return result

    def to_csv(self, path: str | PathLike[str]) -> None:
        """Write `time,<joint names>`; numbers read back to the same values."""
        files.write_csv(Path(path), self.times, self.positions, self.names)

    def to_dataframe(self) -> "pandas.DataFrame":
        """Return a pandas DataFrame: index `time` in s, a column for each joint in rad or m.

        Joints without names are `joint_1` and so on. Raises ModuleNotFoundError without pandas.
        """
        import pandas

        names = self.names or [f"joint_{i + 1}" for i in range(self.positions.shape[1])]
        index = pandas.Index(self.times, name="time")
        return pandas.DataFrame(self.positions, index=index, columns=list(names))

    def reordered(self, names: Sequence[str]) -> "Trajectory":
        """Return a copy with columns in the order of `names`.

        Without names of its own it is unchanged. Raises KeyError for a missing name.
        """
        names = tuple(names)
        if self.names == names:
            return self
        positions = self.positions
        if self.names:
            column = {name: i for i, name in enumerate(self.names)}
            positions = positions[:, [column[name] for name in names]]
            positions.flags.writeable = False
        if not len(set(names)) == len(names) == positions.shape[1]:
            return replace(self, positions=positions, names=names)
        # The arrays are known to fit: they are neither checked nor copied again.
        result = object.__new__(Trajectory)
        values = self.times, positions, names, self.path, self.lines
        for field, value in zip(fields(self), values, strict=True):
            object.__setattr__(result, field.name, value)
        return result

    def scaled(self, speed: float) -> "Trajectory":
        """The same path at `speed` times the speed (0.5: twice the time)."""
        if not 0 < speed < float("inf"):
            raise ValueError(f"speed must be above 0, not {speed}")
        return replace(self, times=self.times / speed)

    def resampled(self, period: float) -> "Trajectory":
        """Return the path with points about every `period` s.

        Points between are interpolated linearly; first and last point stay. Raises ValueError if
        times do not increase.
        """
        if len(self) < 2:
            return self
        times, positions = resample(self.times, self.positions, period)
        return replace(self, times=times, positions=positions, lines=())

    def starting_at(self, state: "State", seconds: float) -> "Trajectory":
        """Prepend a move of `seconds` s from the current position.

        Raises KeyError for a joint that the robot does not have.
        """
        if not 0 < seconds < float("inf"):
            raise ValueError(f"seconds must be above 0, not {seconds}")
        current = [state[name] for name in self.names] if self.names else list(state.joints)
        first = float(self.times[0]) if len(self) else 0.0
        times = np.concatenate([[0.0], self.times - first + seconds])
        positions = np.concatenate([[current], self.positions])
        return replace(self, times=times, positions=positions, lines=())

    def timed(self, robot: "Group", speed: float = 1.0) -> "Trajectory":
        """Return the points with short times within the axes' limits x `speed`.

        `robot` is `Robot.group`. Raises InvalidTrajectory if names do not fit or limits are
        unknown, ValueError for fewer than two points.
        """
        faults = robot.name_faults(self.names, self.positions.shape[1])
        if faults:
            raise InvalidTrajectory(faults, exit_code=1)
        if not robot.has_limits:
            raise InvalidTrajectory.because(
                "RG615", "the robot's speeds are not known", "connect with a configuration"
            )
        ordered = self.reordered(robot.names)
        wire = robot.to_wire(ordered.positions)
        acceleration = np.where(np.isfinite(robot.acceleration), robot.acceleration, 1e6)
        times = parametrise(wire, robot.speed * speed, acceleration * speed)
        # Rounded up to the planner's minimum: a shorter segment would be refused.
        steps = np.maximum(np.diff(times), robot.policy.min_segment)
        return replace(ordered, times=np.concatenate([[0.0], np.cumsum(steps)]))

    def reversed(self) -> "Trajectory":
        """Return the path reversed, in the same time."""
        if not len(self):
            return self
        times = self.times[0] + (self.times[-1] - self.times[::-1])
        return replace(self, times=times, positions=self.positions[::-1], lines=self.lines[::-1])
