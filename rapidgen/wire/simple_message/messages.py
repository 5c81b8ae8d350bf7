"""The messages as typed values. Their fields are the specification's (a test compares)."""

from typing import NamedTuple

from rapidgen.wire.simple_message import spec

Joints = tuple[float, ...]
"""Ten controller axis values in wire order, rad or m, padded with zeros."""


class TrajectoryPoint(NamedTuple):
    """JOINT_TRAJ_PT: `duration` is s from the point before; `velocity` is not used."""

    sequence: int
    joints: Joints
    velocity: float
    duration: float


class JointPosition(NamedTuple):
    """JOINT_POSITION: where the controller axes are, rad or m."""

    sequence: int
    joints: Joints


class Status(NamedTuple):
    """STATUS: what the robot is doing, as the numbers of the wire."""

    drives_powered: int
    e_stopped: int
    error_code: int
    in_error: int
    in_motion: int
    mode: int
    motion_possible: int


class Ping(NamedTuple):
    """PING has no data."""


class TrajectoryPointFull(NamedTuple):
    """JOINT_TRAJ_PT_FULL."""

    robot_id: int
    sequence: int
    valid_fields: int
    time: float
    positions: Joints
    velocities: Joints
    accelerations: Joints


class JointFeedback(NamedTuple):
    """JOINT_FEEDBACK."""

    robot_id: int
    valid_fields: int
    time: float
    positions: Joints
    velocities: Joints
    accelerations: Joints


class Hello(NamedTuple):
    """HELLO as the client asks it."""

    protocol: int
    client: tuple[int, int, int]
    subscribe: int


class HelloReply(NamedTuple):
    """HELLO as a rapidgen driver answers it; limits are those of the controller axes."""

    protocol: int
    driver: tuple[int, int, int]
    build_id: str
    mapping: str
    features: int
    capacity: int
    joint_count: int
    prismatic: int
    state_period: float
    min_segment: float
    start_tolerance: float
    start_tolerance_linear: float
    lower: Joints
    upper: Joints
    speed: Joints
    control_port: int
    ring: int
    preload: float
    batch: int
    signals: int

    def same_driver(self, other: "HelloReply") -> bool:
        """Whether both are of one driver: the same build for the same joints."""
        return (self.build_id, self.mapping) == (other.build_id, other.mapping)


class HelloRefusal(NamedTuple):
    """HELLO answered by a driver whose protocol version does not fit."""

    protocol: int


class Progress(NamedTuple):
    """PROGRESS of the newest trajectory; `point` from 0, `joint` from 1 (0: none)."""

    trajectory: int
    state: int
    received: int
    planned: int
    reached: int
    reason: int
    point: int
    joint: int


class Points(NamedTuple):
    """POINTS: a batch of a stream; `bulk` makes and reads whole ones.

    `pairs` are the numbers of all points in turn (s, rad or m), an even count of each.
    """

    stream: int
    flags: int
    first: int
    points: int
    pairs: tuple[float, ...]
    checksum: int


class Stopped(NamedTuple):
    """STOPPED: where the robot stands after a halt."""

    trajectory: int
    reached: int
    reason: int
    joints: Joints


class Pause(NamedTuple):
    """PAUSE: 1 hold, 0 go on."""

    paused: int


class Speed(NamedTuple):
    """SPEED: percent of the programmed speed, 1 to 100."""

    percent: float


class Heartbeat(NamedTuple):
    """HEARTBEAT: s until the next one must come; 0 ends the watch."""

    timeout: float


class Signal(NamedTuple):
    """SIGNAL: read, or with `write` 1 write, the configuration's signal, from 0."""

    signal: int
    write: int
    value: float


class Event(NamedTuple):
    """EVENT of the controller's log."""

    domain: int
    number: int
    type: int
    title: str


class PointsAccepted(NamedTuple):
    """Reply to POINTS: all of them are in; counts of points are modulo 2^23."""

    stream: int
    trajectory: int
    accepted: int
    room: int
    planned: int
    reached: int
    state: int


class PointsRefused(NamedTuple):
    """Reply to POINTS: those from `accepted` on are not executed; `joint` from 1."""

    stream: int
    trajectory: int
    accepted: int
    reason: int
    point: int
    joint: int


class NotDone(NamedTuple):
    """Reply to PAUSE, SPEED, HEARTBEAT and SIGNAL: it was not done."""

    reason: int


class HeartbeatReply(NamedTuple):
    """Reply to HEARTBEAT: the newest trajectory and its state."""

    trajectory: int
    state: int


class SignalReply(NamedTuple):
    """Reply to SIGNAL: the value as it was read, after any writing."""

    signal: int
    value: float


class Accepted(NamedTuple):
    """Reply to an end frame: the trajectory was taken under this number."""

    trajectory: int


class Refused(NamedTuple):
    """Reply to an end frame: nothing moves; `point` from 0 (-1: none), `joint` from 1."""

    reason: int
    point: int
    joint: int


class Acknowledged(NamedTuple):
    """A success reply without data: to STOP and PING, and all that abb_driver sends."""


class Failure(NamedTuple):
    """A failure reply without data."""


Content = (
    TrajectoryPoint
    | JointPosition
    | Status
    | Ping
    | TrajectoryPointFull
    | JointFeedback
    | Hello
    | HelloReply
    | HelloRefusal
    | Progress
    | Points
    | Stopped
    | Pause
    | Speed
    | Heartbeat
    | Signal
    | Event
    | PointsAccepted
    | PointsRefused
    | NotDone
    | HeartbeatReply
    | SignalReply
    | Accepted
    | Refused
    | Acknowledged
    | Failure
)

CONTENTS: dict[int, type[Content]] = {
    spec.PING.number: Ping,
    spec.JOINT_POSITION.number: JointPosition,
    spec.JOINT_TRAJ_PT.number: TrajectoryPoint,
    spec.STATUS.number: Status,
    spec.JOINT_TRAJ_PT_FULL.number: TrajectoryPointFull,
    spec.JOINT_FEEDBACK.number: JointFeedback,
    spec.HELLO.number: Hello,
    spec.PROGRESS.number: Progress,
    spec.POINTS.number: Points,
    spec.STOPPED.number: Stopped,
    spec.PAUSE.number: Pause,
    spec.SPEED.number: Speed,
    spec.HEARTBEAT.number: Heartbeat,
    spec.SIGNAL.number: Signal,
    spec.EVENT.number: Event,
}
"""Topics and requests by message number."""

REPLIES: dict[tuple[int, spec.ReplyCode, int], type[Content]] = {
    (spec.JOINT_TRAJ_PT.number, spec.ReplyCode.SUCCESS, 1): Accepted,
    (spec.JOINT_TRAJ_PT.number, spec.ReplyCode.FAILURE, 3): Refused,
    (spec.HELLO.number, spec.ReplyCode.SUCCESS, 20): HelloReply,
    (spec.HELLO.number, spec.ReplyCode.FAILURE, 1): HelloRefusal,
    (spec.POINTS.number, spec.ReplyCode.SUCCESS, 7): PointsAccepted,
    (spec.POINTS.number, spec.ReplyCode.FAILURE, 6): PointsRefused,
    (spec.PAUSE.number, spec.ReplyCode.FAILURE, 1): NotDone,
    (spec.SPEED.number, spec.ReplyCode.FAILURE, 1): NotDone,
    (spec.HEARTBEAT.number, spec.ReplyCode.SUCCESS, 2): HeartbeatReply,
    (spec.HEARTBEAT.number, spec.ReplyCode.FAILURE, 1): NotDone,
    (spec.SIGNAL.number, spec.ReplyCode.SUCCESS, 2): SignalReply,
    (spec.SIGNAL.number, spec.ReplyCode.FAILURE, 1): NotDone,
}
"""Replies with data by message number, reply code and number of fields."""
