"""Reported state of the robot, in the caller's units and names."""

from collections.abc import Callable
from dataclasses import dataclass, field

from rapidgen.client.html_tables import table
from rapidgen.wire.simple_message import messages
from rapidgen.wire.simple_message.spec import (
    EventType,
    Feature,
    Mode,
    Reason,
    TrajectoryState,
    TriState,
    split_error_code,
)

_TRAJECTORY_STATES = {int(state): state for state in TrajectoryState}


@dataclass(frozen=True, slots=True)
class Status:
    """STATUS with its numbers as enums.

    `error` is None if the driver does not report it.
    """

    drives: TriState = TriState.UNKNOWN
    e_stopped: TriState = TriState.UNKNOWN
    in_error: TriState = TriState.UNKNOWN
    in_motion: TriState = TriState.UNKNOWN
    motion_possible: TriState = TriState.UNKNOWN
    mode: Mode = Mode.UNKNOWN
    error_code: int = 0
    error: Reason | None = None
    error_joint: int = 0
    """1 to 10; 0 if no joint has the error."""

    def __str__(self) -> str:
        message = [self.mode.name if self.mode is not Mode.UNKNOWN else "mode unknown"]
        if self.drives is not TriState.UNKNOWN:
            message.append("motors on" if self.drives is TriState.TRUE else "motors off")
        if self.e_stopped is TriState.TRUE:
            message.append("EMERGENCY STOP")
        if self.in_error is TriState.TRUE:
            message.append("in error")
        message.append("moving" if self.in_motion is TriState.TRUE else "standing")
        return ", ".join(message)


@dataclass(frozen=True, slots=True)
class Progress:
    """Progress of a trajectory.

    Numbers of points are None if the driver does not report them.
    """

    state: TrajectoryState
    total: int
    received: int | None = None
    planned: int | None = None
    reached: int | None = None
    fraction: float = 0.0
    """0 to 1; by time if the driver does not report it."""


@dataclass(frozen=True, slots=True, repr=False)
class State:
    """Joints and status at one moment.

    `joints` and `velocity` are in rad and m (per s), in URDF order, as `names`; `time` is the
    moment of reception on the client's clock, s; `rate` is the measured number of joint messages
    per s.
    """

    names: tuple[str, ...]
    joints: tuple[float, ...]
    velocity: tuple[float, ...]
    status: Status
    time: float
    rate: float
    number: int
    """Joint messages since the connection was made."""
    clock: Callable[[], float] = field(compare=False)
    trajectory: TrajectoryState | None = None
    """State of the newest trajectory; None if the driver does not report it."""

    def __repr__(self) -> str:
        joints = ", ".join(f"{name} {value:.4f}" for name, value in self.by_name.items())
        return f"<State {self.number}: {joints}; {self.status}>"

    def _repr_html_(self) -> str:
        rows = zip(self.names, self.joints, self.velocity, strict=True)
        cells = [(name, f"{value:.4f}", f"{rate:.4f}") for name, value, rate in rows]
        return table(str(self.status), ("joint", "rad, m", "per s"), cells)

    def __getitem__(self, name: str) -> float:
        """The value of the joint `name`. Raises KeyError."""
        try:
            return self.joints[self.names.index(name)]
        except ValueError:
            raise KeyError(name) from None

    @property
    def by_name(self) -> dict[str, float]:
        """Joint values by URDF name."""
        return dict(zip(self.names, self.joints, strict=True))

    @property
    def age(self) -> float:
        """Seconds since this state was received."""
        return self.clock() - self.time

    @property
    def is_moving(self) -> bool:
        """True if the controller reports that the robot moves."""
        return self.status.in_motion is TriState.TRUE


@dataclass(frozen=True, slots=True)
class Feedback:
    """Joints with the controller's own time, sent on request.

    `joints` and `velocity` are as in State, `time` is s of the controller's clock, continued when
    the wire's wraps around; `received` is s of the client's.
    """

    names: tuple[str, ...]
    joints: tuple[float, ...]
    velocity: tuple[float, ...]
    time: float
    received: float
    number: int
    """Feedbacks since the connection was made."""


@dataclass(frozen=True, slots=True)
class Event:
    """An entry of the controller's event log; `time` s of the client's clock."""

    time: float
    code: int
    """Domain and number as on the pendant: 50024 is number 24 of domain 5.

    0: the title gives the number of events that the driver dropped.
    """
    type: EventType
    title: str
    number: int
    """Events since the connection was made."""
    texts: tuple[str, ...] = ()
    """The first lines below the title, at most two.

    For an error in a program they hold its place.
    """

    def __str__(self) -> str:
        return f"{self.code} {self.title}" if self.code else self.title


@dataclass(frozen=True, slots=True)
class Driver:
    """The driver that answered: rapidgen's (by HELLO) or plain simple_message."""

    hello: messages.HelloReply | None = None
    control_fault: str = ""
    """Reason for a missing control connection to a driver with that port."""

    @property
    def is_rapidgen(self) -> bool:
        """True if the driver answered HELLO."""
        return self.hello is not None

    @property
    def features(self) -> Feature:
        """Features beyond the standard messages."""
        return Feature(self.hello.features) if self.hello else Feature(0)

    @property
    def version(self) -> str:
        """Version of rapidgen that generated it, or an empty text."""
        return ".".join(map(str, self.hello.driver)) if self.hello else ""

    @property
    def cannot(self) -> tuple[str, ...]:
        """Missing features of this driver for a paired client."""
        missing = []
        if not self.is_rapidgen:
            missing.append("report its version, joint map and capacity")
            missing.append("report why it refuses or stops")
        if Feature.PROGRESS not in self.features:
            missing.append("report the end of a trajectory: position, in_motion and time decide")
        if Feature.STREAMING not in self.features:
            missing.append("accept points during a motion: a trajectory is sent whole, and ends")
        if Feature.CONTROL not in self.features or self.control_fault:
            why = f" ({self.control_fault})" if self.control_fault else ""
            missing.append(f"accept STOP in parallel to points: it waits after earlier data{why}")
            missing.append("pause, change the speed, or watch for this client's heartbeat")
        return tuple(missing)


def trajectory_state(value: int) -> TrajectoryState | None:
    """Return a trajectory state of the wire; None for an unknown number."""
    return _TRAJECTORY_STATES.get(value)


def tri_state(value: int) -> TriState:
    """A tri-state of the wire; anything unknown is UNKNOWN."""
    return TriState(value) if value in (0, 1) else TriState.UNKNOWN


def status_of(raw: messages.StatusReport, driver: Driver) -> Status:
    """STATUS with enums. Only a rapidgen driver's error_code is a reason."""
    error, joint = split_error_code(raw.error_code) if driver.is_rapidgen else (None, 0)
    return Status(
        drives=tri_state(raw.drives_powered),
        e_stopped=tri_state(raw.e_stopped),
        in_error=tri_state(raw.in_error),
        in_motion=tri_state(raw.in_motion),
        motion_possible=tri_state(raw.motion_possible),
        mode=Mode(raw.mode) if raw.mode in (1, 2) else Mode.UNKNOWN,
        error_code=raw.error_code,
        error=error,
        error_joint=joint,
    )
