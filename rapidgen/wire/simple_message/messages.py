"""The messages, each declared once: a class with its fields and a row.

The driver's answers are in templates/, the requests of the client in client/.
"""

from typing import Annotated, NamedTuple

from rapidgen.wire.simple_message.declaration import (
    ANY,
    Field,
    MessageType,
    Reply,
    Wire,
    chars,
    float32,
    int32,
)
from rapidgen.wire.simple_message.spec import (
    LONGEST_TEXT,
    MAX_JOINTS,
    MAX_LENGTH,
    MOST_ARGUMENTS,
    Port,
    ReplyCode,
)

Joints = tuple[float, ...]
"""Ten controller axis values in wire order, rad or m, padded with zeros."""
Version = tuple[int, int, int]
"""Major, minor, patch."""

_CLIENT, _CONTROLLER = "client", "controller"
_TRAJECTORY = int32("its number, as in PROGRESS")
_STATE = int32("see the table of trajectory states")
_REASON = int32("see the table of reasons")
_REFUSAL = int32("number of the refusal, see the table of reasons")
_POINT = int32("point at fault, from 0; -1 none")
_JOINT = int32("joint at fault, from 1; 0 none")
_ACCEPTED = int32("points accepted, modulo 2^23")
_REACHED = int32("points that the robot has reached")
_VALID = int32("bits: 1 time, 2 position, 4 velocity, 8 acceleration")
_POSITIONS = float32("rad, m", count=MAX_JOINTS)
_VELOCITIES = float32("rad/s, m/s", count=MAX_JOINTS)
_ACCELERATIONS = float32("rad/s2, m/s2", count=MAX_JOINTS)


class Acknowledged(NamedTuple):
    """A success reply without data: to STOP and PING, and all that abb_driver sends."""


class Failure(NamedTuple):
    """A failure reply without data."""


class NotDone(NamedTuple):
    """Reply to a request on the control port: it was not done."""

    reason: Annotated[int, _REASON]


_DONE = Reply(ReplyCode.SUCCESS, Acknowledged)
_NOT_DONE = Reply(ReplyCode.FAILURE, NotDone, "it was not done")


class Ping(NamedTuple):
    """Asks for a reply, to check the connection. abb_driver does not accept it."""


PING = MessageType("PING", 1, Ping, _CLIENT, (Port.MOTION,), replies=(_DONE,))


class JointPosition(NamedTuple):
    """Positions of the controller axes."""

    sequence: Annotated[int, int32("0 from abb_driver")]
    joints: Annotated[Joints, _POSITIONS]


JOINT_POSITION = MessageType("JOINT_POSITION", 10, JointPosition, _CONTROLLER, (Port.STATE,))


class TrajectoryPoint(NamedTuple):
    """One point of a trajectory.

    As a topic it gets no reply. The control port accepts only STOP.
    """

    sequence: Annotated[int, int32("1, 2, 3, ... or a special sequence number")]
    joints: Annotated[
        Joints,
        float32("rad, m", "controller axes in wire order, padded with zeros", MAX_JOINTS),
    ]
    velocity: Annotated[float, float32("1", "not used")]
    duration: Annotated[float, float32("s", "time from the point before to this one")]


class Accepted(NamedTuple):
    """Reply to an end frame: the driver accepted the trajectory under this number."""

    trajectory: Annotated[int, int32("number of the accepted trajectory, as in PROGRESS")]


class Refused(NamedTuple):
    """Reply to an end frame: nothing moves; `point` from 0 (-1: none), `joint` from 1."""

    reason: Annotated[int, _REFUSAL]
    point: Annotated[int, _POINT]
    joint: Annotated[int, _JOINT]


JOINT_TRAJ_PT = MessageType(
    "JOINT_TRAJ_PT",
    11,
    TrajectoryPoint,
    _CLIENT,
    (Port.MOTION, Port.CONTROL),
    replies=(
        Reply(ReplyCode.SUCCESS, Acknowledged, "the reply to STOP, and every reply of abb_driver"),
        Reply(
            ReplyCode.SUCCESS,
            Accepted,
            "the reply of a rapidgen driver to an end frame that is a request",
        ),
        Reply(ReplyCode.FAILURE, Refused, "the trajectory was refused; nothing moves"),
    ),
)


class StatusReport(NamedTuple):
    """State of the robot. It carries no sequence number."""

    drives_powered: Annotated[int, int32("tri-state")]
    e_stopped: Annotated[int, int32("tri-state")]
    error_code: Annotated[int, int32("reason + 100 x joint; abb_driver: an ERRNO")]
    in_error: Annotated[int, int32("tri-state")]
    in_motion: Annotated[int, int32("tri-state")]
    mode: Annotated[int, int32("1 manual, 2 automatic, -1 unknown")]
    motion_possible: Annotated[int, int32("tri-state")]


STATUS = MessageType("STATUS", 13, StatusReport, _CONTROLLER, (Port.STATE,))


class TrajectoryPointFull(NamedTuple):
    """A point with derivatives.

    Neither abb_driver nor a rapidgen driver accepts it.
    """

    robot_id: Annotated[int, int32()]
    sequence: Annotated[int, int32()]
    valid_fields: Annotated[int, _VALID]
    time: Annotated[float, float32("s")]
    positions: Annotated[Joints, _POSITIONS]
    velocities: Annotated[Joints, _VELOCITIES]
    accelerations: Annotated[Joints, _ACCELERATIONS]


JOINT_TRAJ_PT_FULL = MessageType(
    "JOINT_TRAJ_PT_FULL", 14, TrajectoryPointFull, _CLIENT, (Port.MOTION,)
)


class JointFeedback(NamedTuple):
    """Positions of the axes, with time and derivatives.

    Only on connections that requested it in HELLO.
    """

    robot_id: Annotated[int, int32("0")]
    valid_fields: Annotated[int, _VALID]
    time: Annotated[float, float32("s", "of the controller's clock, 0 to 1000, then again from 0")]
    positions: Annotated[Joints, _POSITIONS]
    velocities: Annotated[Joints, _VELOCITIES]
    accelerations: Annotated[Joints, _ACCELERATIONS]


JOINT_FEEDBACK = MessageType("JOINT_FEEDBACK", 15, JointFeedback, _CONTROLLER, (Port.STATE,))


class HelloRequest(NamedTuple):
    """Identification of client and driver.

    Sent as a request on the state port, where abb_driver reads nothing and so is not disturbed; no
    reply within a second means a plain simple_message driver. On the control port it identifies the
    driver of that port. A reply of another length belongs to another version: its first field
    contains the version.
    """

    protocol: Annotated[int, int32("newest protocol version of the client")]
    client: Annotated[Version, int32("version of the client: major, minor, patch", 3)]
    subscribe: Annotated[int, int32("features requested for this connection, as bits")]


class HelloReply(NamedTuple):
    """HELLO reply of a rapidgen driver; limits are those of the controller axes."""

    protocol: Annotated[int, int32("protocol version of the driver")]
    driver: Annotated[
        Version, int32("version of rapidgen that generated it: major, minor, patch", 3)
    ]
    build_id: Annotated[str, chars(12, "12 hexadecimal digits")]
    mapping: Annotated[str, chars(12, "hash of the joint map, 12 digits")]
    features: Annotated[int, int32("bits")]
    capacity: Annotated[int, int32("points of one trajectory")]
    joint_count: Annotated[int, int32("joints of the group, 1 to 10")]
    prismatic: Annotated[int, int32("bit i: joint i is in m")]
    state_period: Annotated[float, float32("s")]
    min_segment: Annotated[float, float32("s", "shortest duration that the planner follows")]
    start_tolerance: Annotated[float, float32("rad", "of the first point, rotary axes")]
    start_tolerance_linear: Annotated[float, float32("m", "of the first point, linear axes")]
    lower: Annotated[Joints, float32("rad, m", "limits of the controller axes", MAX_JOINTS)]
    upper: Annotated[Joints, _POSITIONS]
    speed: Annotated[Joints, _VELOCITIES]
    control_port: Annotated[int, int32("TCP port of the control connection, 0 none")]
    ring: Annotated[int, int32("points of a stream that the driver buffers")]
    preload: Annotated[float, float32("s", "buffered before it starts")]
    batch: Annotated[int, int32("points of one POINTS, 0 when it does not stream")]
    signals: Annotated[int, int32("number of signals for SIGNAL")]

    def same_driver(self, other: "HelloReply") -> bool:
        """True if both come from one driver: the same build for the same joints."""
        return (self.build_id, self.mapping) == (other.build_id, other.mapping)


class HelloRefusal(NamedTuple):
    """HELLO reply of a driver with another protocol version."""

    protocol: Annotated[int, int32("protocol version of the driver")]


HELLO = MessageType(
    "HELLO",
    1300,
    HelloRequest,
    _CLIENT,
    (Port.STATE, Port.CONTROL),
    since=1,
    replies=(
        Reply(ReplyCode.SUCCESS, HelloReply, "a rapidgen driver of the same version"),
        Reply(ReplyCode.FAILURE, HelloRefusal, "the versions differ"),
    ),
)


class ProgressReport(NamedTuple):
    """Progress of the newest trajectory.

    Only on connections that requested it in HELLO.
    """

    trajectory: Annotated[int, int32("number of the newest trajectory, from 1; 0 follows 2^22 - 1")]
    state: Annotated[int, _STATE]
    received: Annotated[int, int32("points received")]
    planned: Annotated[int, int32("points given to the path planner")]
    reached: Annotated[int, _REACHED]
    reason: Annotated[int, _REFUSAL]
    point: Annotated[int, _POINT]
    joint: Annotated[int, _JOINT]


PROGRESS = MessageType("PROGRESS", 1301, ProgressReport, _CONTROLLER, (Port.STATE,), since=1)


class Points(NamedTuple):
    """Points of a trajectory without end. As a topic it gets no reply."""

    # `numpy_codec` encodes and decodes whole batches.
    stream: Annotated[int, int32("the client's number of the stream, 1 to 2^23 - 1")]
    flags: Annotated[int, int32("bits: 1 BEGIN, 2 END, 4 FLUSH")]
    first: Annotated[int, int32("index of the first point, from 0, modulo 2^23")]
    points: Annotated[int, int32("how many follow, from 0")]
    values: Annotated[
        tuple[float, ...],
        Field(Wire.FIXED, ANY, "s, rad, m", "per point: duration, joints"),
    ]
    checksum: Annotated[int, int32("of all words before it, see below")]


class PointsAccepted(NamedTuple):
    """Reply to POINTS: the driver accepted all of them."""

    stream: Annotated[int, int32()]
    trajectory: Annotated[int, _TRAJECTORY]
    accepted: Annotated[int, _ACCEPTED]
    room: Annotated[int, int32("points that may follow")]
    planned: Annotated[int, int32("points given to the path planner, modulo 2^23")]
    reached: Annotated[int, int32("points that the robot has reached, modulo 2^23")]
    state: Annotated[int, _STATE]


class PointsRefused(NamedTuple):
    """Reply to POINTS: those from `accepted` on are not executed."""

    stream: Annotated[int, int32()]
    trajectory: Annotated[int, int32("its number, as in PROGRESS; 0 when there is none")]
    accepted: Annotated[int, _ACCEPTED]
    reason: Annotated[int, _REFUSAL]
    point: Annotated[int, _POINT]
    joint: Annotated[int, _JOINT]


POINTS = MessageType(
    "POINTS",
    1302,
    Points,
    _CLIENT,
    (Port.MOTION,),
    since=2,
    replies=(
        Reply(ReplyCode.SUCCESS, PointsAccepted, "all points of the batch are accepted"),
        Reply(
            ReplyCode.FAILURE,
            PointsRefused,
            "points from `accepted` on are refused, and so are later ones",
        ),
    ),
)


class Stopped(NamedTuple):
    """Position of the robot after a halt, when its path is cleared.

    Sent without a request.
    """

    trajectory: Annotated[int, int32("as in PROGRESS")]
    reached: Annotated[int, _REACHED]
    reason: Annotated[int, _REASON]
    joints: Annotated[Joints, float32("rad, m", "positions of the axes", MAX_JOINTS)]


STOPPED = MessageType("STOPPED", 1303, Stopped, _CONTROLLER, (Port.CONTROL,), since=2)


class PauseRequest(NamedTuple):
    """Holds a motion on its path, or resumes it."""

    paused: Annotated[int, int32("1 stop on the path and keep it, 0 resume")]


PAUSE = MessageType("PAUSE", 1304, PauseRequest, _CLIENT, (Port.CONTROL,), 2, (_DONE, _NOT_DONE))


class SpeedRequest(NamedTuple):
    """Speed override; 100 again with every new trajectory."""

    percent: Annotated[float, float32("1", "1 to 100 % of the programmed speed")]


SPEED = MessageType("SPEED", 1305, SpeedRequest, _CLIENT, (Port.CONTROL,), 2, (_DONE, _NOT_DONE))


class HeartbeatRequest(NamedTuple):
    """Heartbeat of the client.

    When the next one is late, or the connection breaks while one is expected, the driver stops the
    robot (CLIENT_LOST).
    """

    timeout: Annotated[float, float32("s", "until the next one must arrive; 0: none is expected")]


class HeartbeatReply(NamedTuple):
    """Reply to HEARTBEAT: the newest trajectory and its state."""

    trajectory: Annotated[int, int32("number of the newest trajectory")]
    state: Annotated[int, _STATE]


HEARTBEAT = MessageType(
    "HEARTBEAT",
    1306,
    HeartbeatRequest,
    _CLIENT,
    (Port.CONTROL,),
    since=2,
    replies=(Reply(ReplyCode.SUCCESS, HeartbeatReply), _NOT_DONE),
)


class SignalRequest(NamedTuple):
    """Reads or writes one of the signals that the configuration exposes."""

    signal: Annotated[int, int32("of the configuration, from 0")]
    write: Annotated[int, int32("1 write `value`, 0 read")]
    value: Annotated[float, float32("1")]


class SignalReply(NamedTuple):
    """Reply to SIGNAL: the value after any write."""

    signal: Annotated[int, int32()]
    value: Annotated[float, float32("1", "value after any write")]


SIGNAL = MessageType(
    "SIGNAL",
    1307,
    SignalRequest,
    _CLIENT,
    (Port.CONTROL,),
    since=2,
    replies=(Reply(ReplyCode.SUCCESS, SignalReply), _NOT_DONE),
)


class EventReport(NamedTuple):
    """An event of the controller's log.

    Only on connections that requested it in HELLO.
    """

    domain: Annotated[int, int32("of the event's number: 1 to 14; 0: number of lost events")]
    number: Annotated[int, int32("within the domain")]
    type: Annotated[int, int32("1 state change, 2 warning, 3 error")]
    title: Annotated[str, chars(80, "in the controller's language")]
    first: Annotated[str, chars(80, "text below it: of an error its place, or its task")]
    second: Annotated[str, chars(80, "the next one")]


EVENT = MessageType("EVENT", 1308, EventReport, _CONTROLLER, (Port.STATE,), since=2)


class Instructions(NamedTuple):
    """Instructions of a program: moves to joints and to poses.

    As a topic it gets no reply.
    """

    # `instructions` encodes the words of one instruction, `numpy_codec` the frames.
    program: Annotated[int, int32("the client's number of the program, 1 to 2^23 - 1")]
    flags: Annotated[int, int32("bits: 1 BEGIN, 2 END, 8 WHOLE")]
    first: Annotated[int, int32("index of the first instruction, from 0, modulo 2^23")]
    instructions: Annotated[int, int32("how many follow, from 0")]
    values: Annotated[
        tuple[float, ...],
        Field(Wire.FIXED, ANY, "s, rad, m", "the instructions, see below"),
    ]
    checksum: Annotated[int, int32("as of POINTS")]


PROGRAM = MessageType(
    "PROGRAM",
    1309,
    Instructions,
    _CLIENT,
    (Port.MOTION,),
    since=3,
    replies=(
        Reply(ReplyCode.SUCCESS, PointsAccepted, "as to POINTS, of instructions"),
        Reply(
            ReplyCode.FAILURE,
            PointsRefused,
            "as to POINTS; with WHOLE nothing of the program is executed",
        ),
    ),
)


class ResultRequest(NamedTuple):
    """Asks for the result of a program's routine.

    The answer is that of the newest call that has ended.
    """

    parameter: Annotated[int, int32("parameter whose text is requested, from 1; 0: no text")]


class ResultReply(NamedTuple):
    """Reply to RESULT: the routine's output parameters, or its error."""

    trajectory: Annotated[int, int32("trajectory of the call")]
    error: Annotated[int, int32("ERRNO of the error that it raised, 0: none")]
    values: Annotated[
        tuple[float, ...],
        float32(
            "1",
            "of its parameters num and bool (0, 1) in their order, then a function's value",
            MOST_ARGUMENTS,
        ),
    ]
    text: Annotated[str, chars(LONGEST_TEXT, "of the requested parameter; of an error its name")]


RESULT = MessageType(
    "RESULT",
    1310,
    ResultRequest,
    _CLIENT,
    (Port.MOTION,),
    since=3,
    replies=(Reply(ReplyCode.SUCCESS, ResultReply),),
)


class DataRequest(NamedTuple):
    """Reads or writes one of the PERS of the robot's own program that the configuration lists."""

    datum: Annotated[int, int32("of the group's configuration, from 0")]
    write: Annotated[int, int32("1 write, 0 read")]
    value: Annotated[float, float32("1", "of a num, or 0 and 1 of a bool")]
    text: Annotated[str, chars(LONGEST_TEXT, "of a string, a byte each character")]


class DataReply(NamedTuple):
    """Reply to DATA: the value after any write."""

    datum: Annotated[int, int32()]
    value: Annotated[float, float32("1", "of a num, or 0 and 1 of a bool")]
    text: Annotated[str, chars(LONGEST_TEXT, "of a string")]


DATA = MessageType(
    "DATA",
    1311,
    DataRequest,
    _CLIENT,
    (Port.CONTROL,),
    since=3,
    replies=(Reply(ReplyCode.SUCCESS, DataReply), _NOT_DONE),
)


class TargetRequest(NamedTuple):
    """Asks for a target parameter of the newest call that has ended."""

    joints: Annotated[int, int32("1 of a jointtarget, 0 of a robtarget")]
    parameter: Annotated[int, int32("which one of this type, from 1")]


class TargetReply(NamedTuple):
    """Reply to TARGET: the target of the routine, unchecked."""

    trajectory: Annotated[int, int32("trajectory of the call")]
    position: Annotated[tuple[float, ...], float32("m", "of a robtarget", 3)]
    orientation: Annotated[tuple[float, ...], float32("1", "w, x, y, z of a robtarget", 4)]
    configuration: Annotated[
        tuple[float, ...], float32("1", "cf1, cf4, cf6, cfx of a robtarget", 4)
    ]
    joints: Annotated[
        tuple[float, ...],
        float32("rad, m", "of a jointtarget; of a robtarget the external axes", MAX_JOINTS),
    ]


TARGET = MessageType(
    "TARGET",
    1312,
    TargetRequest,
    _CLIENT,
    (Port.MOTION,),
    since=3,
    replies=(Reply(ReplyCode.SUCCESS, TargetReply), Reply(ReplyCode.FAILURE, Failure)),
)


class EgmRequest(NamedTuple):
    """Starts or ends a session of externally guided motion.

    It starts only if heartbeats are expected on this connection, and nothing else is under way.
    Meanwhile trajectories are refused. The reply to the end is sent after EGMStop, before the robot
    stands.
    """

    active: Annotated[int, int32("1 start, 0 end")]


class EgmReply(NamedTuple):
    """Reply to EGM: the session has started, or it is being ended."""

    trajectory: Annotated[int, int32("number of the session among the trajectories")]


EGM = MessageType(
    "EGM",
    1313,
    EgmRequest,
    _CLIENT,
    (Port.CONTROL,),
    since=4,
    replies=(Reply(ReplyCode.SUCCESS, EgmReply), _NOT_DONE),
)

MESSAGES = tuple(row for row in tuple(globals().values()) if isinstance(row, MessageType))
"""All of them, by number."""


def point_values(joint_count: int) -> int:
    """Return the number of values of one point in POINTS.

    They are a duration and the joints.
    """
    return 1 + joint_count


def points_length(count: int, joint_count: int) -> int:
    """Return the length field of a POINTS with so many points."""
    return POINTS.length + count * point_values(joint_count) * Wire.FIXED.size


def batch_points(joint_count: int) -> int:
    """Return the points that fit in one POINTS: 35 for six axes, 22 for ten."""
    return (MAX_LENGTH - POINTS.length) // (point_values(joint_count) * Wire.FIXED.size)
