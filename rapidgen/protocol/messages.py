"""The messages as typed values. Their fields are the specification's (a test compares)."""

from typing import NamedTuple

from rapidgen.protocol import spec

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
}
"""Topics and requests by message number."""

REPLIES: dict[tuple[int, spec.ReplyCode, int], type[Content]] = {
    (spec.JOINT_TRAJ_PT.number, spec.ReplyCode.SUCCESS, 1): Accepted,
    (spec.JOINT_TRAJ_PT.number, spec.ReplyCode.FAILURE, 3): Refused,
    (spec.HELLO.number, spec.ReplyCode.SUCCESS, 15): HelloReply,
    (spec.HELLO.number, spec.ReplyCode.FAILURE, 1): HelloRefusal,
}
"""Replies with data by message number, reply code and number of fields."""
