"""Published state of a robot: joint_states, status, diagnostics.

industrial_msgs/RobotStatus and diagnostic_msgs/DiagnosticStatus as plain values; `node` makes
messages of them.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import IntEnum

from rapidgen.client.core.motion import fix_of
from rapidgen.client.core.state import Driver, State, Status
from rapidgen.wire.simple_message.spec import Mode, TrajectoryState, TriState


class Level(IntEnum):
    """level of diagnostic_msgs/DiagnosticStatus."""

    OK = 0
    WARN = 1
    ERROR = 2
    STALE = 3


@dataclass(frozen=True, slots=True)
class JointStates:
    """sensor_msgs/JointState.

    `stamp` ns of ROS time, rad or m (per s), in the robot's order.
    """

    stamp: int
    names: tuple[str, ...]
    positions: tuple[float, ...]
    velocities: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class RobotStatus:
    """industrial_msgs/RobotStatus.

    Tri-states are 1, 0, -1 unknown; mode 1 manual, 2 automatic.
    """

    mode: int
    e_stopped: int
    drives_powered: int
    motion_possible: int
    in_motion: int
    in_error: int
    error_code: int


@dataclass(frozen=True, slots=True)
class RobotHealth:
    """A diagnostic_msgs/DiagnosticStatus without its name.

    It says why the robot would not move now.
    """

    level: Level
    message: str
    values: dict[str, str] = field(default_factory=dict)


_UNKNOWN = Status()
_MODES = {Mode.MANUAL: "manual", Mode.AUTO: "automatic", Mode.UNKNOWN: "unknown"}


PERIOD = 1.0
"""s between two diagnostics that say the same."""
_GONE = 3 * PERIOD
"""s without diagnostics after which another node has ended."""


class DiagnosticsFilter:
    """Which diagnostics a node publishes, and what those of other nodes say about its robot.

    Two nodes on one robot stop each other's motions. A node cannot see that from its own
    connection, but each publishes the robot's address and its own identity.
    """

    def __init__(self, identity: str) -> None:
        """`identity` is the node's name and something that no other process has."""
        self._identity = identity
        self._address = ""
        self._others: dict[str, float] = {}
        self._last: tuple[float, Level, str] | None = None

    def received(self, address: str, values: Mapping[str, str], now: float) -> str:
        """Return the identity of another node on the same robot when it is first seen, or ""."""
        identity = values.get("node", "")
        if address != self._address or identity in ("", self._identity):
            return ""
        is_new = identity not in self._others
        self._others[identity] = now
        return identity if is_new else ""

    def to_publish(self, health: RobotHealth, now: float) -> RobotHealth | None:
        """Return what is to be published at `now` (s, monotonic); None for nothing new."""
        self._address = health.values.get("address", self._address)
        self._others = {one: at for one, at in self._others.items() if now - at < _GONE}
        values = {**health.values, "node": self._identity}
        level, message = health.level, health.message
        if self._others:
            names = ", ".join(sorted(one.split()[0] for one in self._others))
            values["other nodes"] = names
            if level is Level.OK:
                level, message = Level.WARN, f"another node is connected to this robot: {names}"
        if self._last is not None:
            at, *same = self._last
            if now - at < PERIOD and same == [level, message]:
                return None
        self._last = now, level, message
        return replace(health, level=level, message=message, values=values)


def robot_status(status: Status) -> RobotStatus:
    """The driver's STATUS, one to one."""
    return RobotStatus(
        mode=int(status.mode),
        e_stopped=int(status.e_stopped),
        drives_powered=int(status.drives),
        motion_possible=int(status.motion_possible),
        in_motion=int(status.in_motion),
        in_error=int(status.in_error),
        error_code=status.error_code,
    )


def unknown_status() -> RobotStatus:
    """Status without a link: everything is unknown, nothing possible."""
    return robot_status(_UNKNOWN)


def health(state: State, driver: Driver, address: str) -> RobotHealth:
    """Return the blockers of the robot, the worst first."""
    status = state.status
    values = {
        "address": address,
        "driver": driver.hello.build_id if driver.hello else "plain simple_message",
        "mode": _MODES[status.mode],
        "drives": _word(status.drives),
        "emergency stop": _word(status.e_stopped),
        "motion possible": _word(status.motion_possible),
        "in motion": _word(status.in_motion),
        "state messages per s": f"{state.rate:.1f}",
    }
    if state.trajectory is not None:
        values["trajectory"] = state.trajectory.name
    if status.error:
        values["last refusal"] = status.error.text
    level, message = _worst(status, state.trajectory)
    return RobotHealth(level, message, values)


def no_link(why: str, address: str) -> RobotHealth:
    """Return the status of a missing link: the last state is outdated."""
    return RobotHealth(Level.STALE, f"no link to the robot: {why}", {"address": address})


def _worst(status: Status, trajectory: TrajectoryState | None) -> tuple[Level, str]:
    lasting = fix_of(status.error, "") if status.in_error is TriState.TRUE else ""
    if status.error is not None and lasting:
        # Before that, neither releasing the emergency stop nor Start helps.
        return Level.ERROR, f"{status.error.text}: {lasting}"
    if status.e_stopped is TriState.TRUE:
        return Level.ERROR, "an emergency stop is active"
    if status.drives is TriState.FALSE:
        return Level.WARN, "the motors are off"
    if status.mode is Mode.MANUAL:
        return Level.WARN, "manual mode: the robot moves while the enabling device is held"
    if trajectory is TrajectoryState.PAUSED:
        # During a pause no motion is possible either.
        return Level.WARN, "paused"
    if status.motion_possible is TriState.FALSE:
        return Level.WARN, "the motion task is not executing"
    return Level.OK, "ready" if status.in_motion is not TriState.TRUE else "moving"


def _word(value: TriState) -> str:
    return {TriState.TRUE: "yes", TriState.FALSE: "no", TriState.UNKNOWN: "unknown"}[value]
