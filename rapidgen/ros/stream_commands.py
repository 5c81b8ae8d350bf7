"""Commands of the streaming topics: what a message means, and why one is ignored.

Times are s of ROS time; positions and speeds rad and m (per s). A command that is not understood
completely is ignored as a whole, with a code and a reason, and moves nothing. The meaning of a
trajectory is that of joint_trajectory_controller (ros2_controllers, trajectory.cpp: points in the
past are skipped, the first one in the future is reached from where the robot is).
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TypeAlias

from rapidgen.config.model import GroupConfig
from rapidgen.ros.goals import Point

SILENCE = 0.1
"""s after which a speed is not in force any more, from its stamp and its receipt."""
AHEAD = 0.1
"""s by which a stamp may be in the future: clocks of two computers differ."""
HELD = 5e-4
"""rad, rad/s, m, m/s: positions this close repeat the held one, lower speeds are none."""
TOPICS = (
    "joint_trajectory",
    "joint_commands",
    "position_commands",
    "velocity_commands",
    "twist_commands",
)

Values: TypeAlias = tuple[float, ...]


class CommandIgnored(Exception):
    """A command that moves nothing: a code of the diagnostics, and the reason."""

    def __init__(self, code: str, text: str, help: str = "") -> None:
        super().__init__(text)
        self.code, self.help = code, help

    @property
    def text(self) -> str:
        """Reason and help in one line."""
        return f"{self}; {self.help}" if self.help else str(self)


# Messages as plain values


@dataclass(frozen=True, slots=True)
class TwistCommand:
    """geometry_msgs/TwistStamped: (6,) m/s along and rad/s about x, y and z."""

    stamp: float
    frame: str
    twist: Sequence[float]


@dataclass(frozen=True, slots=True)
class JointCommand:
    """sensor_msgs/JointState; std_msgs/Float64MultiArray has no names and no stamp."""

    positions: Sequence[float] = ()
    velocities: Sequence[float] = ()
    names: Sequence[str] | None = None
    stamp: float = 0.0
    layout: Sequence[int] = ()
    """Sizes of the dimensions that a Float64MultiArray declares."""


@dataclass(frozen=True, slots=True)
class TrajectoryCommand:
    """trajectory_msgs/JointTrajectory."""

    names: Sequence[str]
    points: Sequence[Point]
    stamp: float = 0.0


Command: TypeAlias = TwistCommand | JointCommand | TrajectoryCommand


# What they ask for, in the robot's order


@dataclass(frozen=True, slots=True)
class Speeds:
    """Speeds from `at` on: of the joints, or of the TCP along and about the axes of `axes`."""

    at: float
    values: Values
    axes: str = "joints"

    @property
    def is_rest(self) -> bool:
        """True if nothing moves."""
        return all(abs(value) <= HELD for value in self.values)


@dataclass(frozen=True, slots=True)
class Positions:
    """Positions of the joints at `at`, and speeds with which they move on, if there are any."""

    at: float
    values: Values
    speeds: Values | None = None


@dataclass(frozen=True, slots=True)
class Spline:
    """Points of a trajectory; `since` is the time in it at which it begins.

    Without velocities it is made of lines.
    """

    times: Values
    positions: tuple[Values, ...]
    velocities: tuple[Values, ...] | None
    since: float


@dataclass(frozen=True, slots=True)
class Hold:
    """Slow down and stay."""


Request: TypeAlias = Speeds | Positions | Spline | Hold


@dataclass(frozen=True)
class CommandReader:
    """Reads commands for one motion group.

    `frames` gives the axes of a twist (`base`, `flange`, `tool`) by `frame_id`.
    """

    names: tuple[str, ...]
    frames: Mapping[str, str] = field(default_factory=dict)

    @classmethod
    def of(cls, group: GroupConfig, prefix: str = "", space: str = "") -> "CommandReader":
        """Return the reader of a group; links are those of the generated URDF.

        `prefix` is tf_prefix; `space` is in front of the links of one group of several.
        """
        links = f"{prefix}{space}"
        known = {f"{links}base_link": "base", f"{links}tool0": "flange"}
        if group.tool.name != "tool0":
            known[f"{prefix}{group.tool.name}"] = "tool"
        return cls(tuple(joint.name for joint in group.joints), known)

    def read(self, topic: str, command: Command, now: float) -> Request:
        """Return what a command of a topic asks for. Raises CommandIgnored."""
        if isinstance(command, TwistCommand):
            return self._twist(command, now)
        if isinstance(command, TrajectoryCommand):
            return self._trajectory(command, now)
        return self._joints(topic, command, now)

    def _twist(self, command: TwistCommand, now: float) -> Speeds:
        at = moment(command.stamp, now)
        if command.frame not in self.frames:
            known = ", ".join(self.frames)
            raise _malformed(
                f"header.frame_id '{command.frame}' is not known", f"it is one of {known}"
            )
        return Speeds(at, _finite("twist", command.twist), self.frames[command.frame])

    def _joints(self, topic: str, command: JointCommand, now: float) -> Speeds | Positions | Hold:
        at = moment(command.stamp, now)
        order = self._order(command.names)
        if len([size for size in command.layout if size != 1]) > 1:
            raise _malformed("layout.dim has several dimensions", "send one value for each joint")
        if len(command.positions) and all(map(math.isnan, command.positions)):
            # Hardware of ros2_control, of which no controller is active yet.
            return Hold()
        positions = self._columns("position", command.positions, order)
        velocities = self._columns("velocity", command.velocities, order)
        if positions is not None:
            return Positions(at, positions, velocities)
        if velocities is not None:
            return Speeds(at, velocities)
        raise _malformed(
            f"{topic} has no values", f"send {len(self.names)} positions or velocities"
        )

    def _order(self, names: Sequence[str] | None) -> Sequence[int]:
        """Return the columns in the robot's order."""
        if names is None:
            return range(len(self.names))
        if sorted(names) != sorted(self.names):
            missing = [name for name in self.names if name not in names]
            unknown = [name for name in names if name not in self.names]
            parts = [
                f"{what}: {', '.join(some)}"
                for what, some in (("missing", missing), ("unknown", unknown))
                if some
            ] or ["a name is given twice"]
            raise _malformed(
                f"the joint names do not fit ({'; '.join(parts)})",
                f"name each of {', '.join(self.names)}",
            )
        return [list(names).index(name) for name in self.names]

    def _columns(self, what: str, values: Sequence[float], order: Sequence[int]) -> Values | None:
        if not len(values):
            return None
        if len(values) != len(order):
            raise _malformed(f"{len(values)} values of {what} for {len(order)} joints")
        given = _finite(what, values)
        return tuple(given[i] for i in order)

    def _trajectory(self, command: TrajectoryCommand, now: float) -> Spline | Hold:
        if not command.points:
            return Hold()
        order = self._order(command.names)
        times = _finite("time_from_start", [point.time for point in command.points])
        if times[0] < 0 or any(b <= a for a, b in pairwise(times)):
            raise _malformed("time_from_start is below 0, or does not increase")
        positions, velocities = [], []
        for number, point in enumerate(command.points):
            row = self._columns(f"positions at point {number}", point.positions, order)
            if row is None:
                raise _malformed(f"point {number} has no positions")
            positions.append(row)
            rates = self._columns(f"velocities at point {number}", point.velocities, order)
            if rates is not None:
                velocities.append(rates)
        if velocities and len(velocities) != len(positions):
            raise _malformed("some points have velocities, and others have none")
        since = now - command.stamp if command.stamp else 0.0
        if since > 0 and since >= times[-1]:
            raise CommandIgnored(
                "RG694",
                f"header.stamp is {since:.3f} s in the past, and the trajectory ends before now",
                "synchronize the clocks; stamp 0 starts at once",
            )
        if since < -60:
            raise _malformed(
                f"header.stamp is {-since:.0f} s in the future", "synchronize the clocks"
            )
        return Spline(times, tuple(positions), tuple(velocities) or None, since)


@dataclass(frozen=True)
class StreamSettings:
    """The user's settings of the streaming topics of one group."""

    group: GroupConfig
    reader: CommandReader
    preempt: bool = False
    """A command ends a goal that is executed; else it is ignored."""
    speed: float = 0.25
    """Share of the configuration's speeds and accelerations."""
    idle: float = 10.0
    """s without motion after which the session is ended."""
    allow_delayed: bool = False
    """Without EGM: execute commands over the client's stream, half a second late and slowly."""
    is_hardware: bool = False
    """Commands are those of ros2_control: they never cease, and may be old when they begin.

    A session begins when they have rested where the robot stands, and lasts while they come.
    """


@dataclass(frozen=True, slots=True)
class StreamReport:
    """What is published about the streaming topics: a code and a reason, empty if all is well."""

    code: str = ""
    text: str = ""
    topic: str = ""


def moment(stamp: float, now: float) -> float:
    """Return the moment from which a command counts. Raises CommandIgnored for an old one.

    A stamp of 0 is now. A command never counts from later than its receipt.
    """
    if stamp == 0:
        return now
    if not math.isfinite(stamp) or now - stamp > SILENCE:
        raise _malformed(
            f"header.stamp is {now - stamp:.3f} s in the past",
            "synchronize the clocks; stamp 0 is now",
        )
    if stamp - now > AHEAD:
        raise _malformed(
            f"header.stamp is {stamp - now:.3f} s in the future",
            "synchronize the clocks; stamp 0 is now",
        )
    return min(stamp, now)


def distance(request: Positions, joints: Sequence[float]) -> tuple[float, int]:
    """Return the largest difference to positions of joints, and the index of its joint."""
    pairs = zip(request.values, joints, strict=True)
    return max((abs(a - b), i) for i, (a, b) in enumerate(pairs))


def repeats(request: Request, held: Sequence[float]) -> bool:
    """True if a request leaves a standing robot where it is."""
    if isinstance(request, Hold):
        return True
    if isinstance(request, Speeds):
        return request.is_rest
    if isinstance(request, Positions):
        moves_on = request.speeds is not None and any(abs(v) > HELD for v in request.speeds)
        return _close(request.values, held) and not moves_on
    rates = request.velocities or ()
    return all(_close(row, held) for row in request.positions) and all(
        abs(rate) <= HELD for row in rates for rate in row
    )


def _close(values: Sequence[float], held: Sequence[float]) -> bool:
    return all(abs(a - b) <= HELD for a, b in zip(values, held, strict=True))


def _finite(what: str, values: Sequence[float]) -> Values:
    result = tuple(map(float, values))
    if not all(map(math.isfinite, result)):
        raise _malformed(f"{what} has a value that is no finite number")
    return result


def _malformed(text: str, help: str = "") -> CommandIgnored:
    return CommandIgnored("RG694", text, help)
