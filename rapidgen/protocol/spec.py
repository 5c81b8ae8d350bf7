"""simple_message and ABB's range 1300-1399, as frozen data.

The only place that knows a number of the wire. The codec, the constants of the generated
RAPID modules and docs/protocol.md are derived from it. Sources: the headers of industrial_core
for the standard part (little endian, int32 and float32, rad, m, s), recordings of the
ROS-Industrial nodes for what they really send.
"""

from dataclasses import dataclass
from enum import IntEnum, IntFlag, StrEnum

PROTOCOL_VERSION = 1
"""Version of the messages in ABB's range. The standard messages have none: `since` 0."""

PREFIX_BYTES = 4
HEADER_BYTES = 12
MIN_LENGTH = HEADER_BYTES
"""Smallest value of the length field: a header without data."""
MAX_MESSAGE_BYTES = 1024
"""Largest message, length field included: more than this crashes a ROS-Industrial node."""
MAX_LENGTH = MAX_MESSAGE_BYTES - PREFIX_BYTES
MAX_JOINTS = 10


class Port(IntEnum):
    """Standard TCP ports of the first motion group. CONTROL is 11001, simple_message's SYSTEM."""

    MOTION = 11000
    CONTROL = 11001
    STATE = 11002
    IO = 11003


class Comm(IntEnum):
    """comm_type: what a message asks of its receiver."""

    TOPIC = 1
    REQUEST = 2
    REPLY = 3


class ReplyCode(IntEnum):
    """reply_code. Anything but NONE in a topic makes a ROS-Industrial node drop the link."""

    NONE = 0
    SUCCESS = 1
    FAILURE = 2


class Sequence(IntEnum):
    """Special sequence numbers of a trajectory point; the others count 1, 2, 3, ...

    START_DOWNLOAD and END carry a point each; STOP carries zeros.
    """

    START_DOWNLOAD = -1
    START_STREAMING = -2
    END = -3
    STOP = -4


class TriState(IntEnum):
    """A yes or no that the controller may not know."""

    UNKNOWN = -1
    FALSE = 0
    TRUE = 1


class Mode(IntEnum):
    """Operating mode of the controller."""

    UNKNOWN = -1
    MANUAL = 1
    AUTO = 2


class Valid(IntFlag):
    """valid_fields: which fields of JOINT_TRAJ_PT_FULL and JOINT_FEEDBACK hold values."""

    TIME = 1
    POSITION = 2
    VELOCITY = 4
    ACCELERATION = 8


class Feature(IntFlag):
    """What a driver can do beyond the standard messages, told in HELLO."""

    PROGRESS = 1
    """PROGRESS follows every JOINT on a connection that said HELLO."""
    CONTROL = 2
    """The control port takes STOP from a connection of its own."""
    STREAMING = 4
    SIGNALS = 8
    EVENTS = 16
    FEEDBACK = 32


class TrajectoryState(IntEnum):
    """State of the newest trajectory, told in PROGRESS."""

    NONE = 0
    """Nothing was sent since the driver started."""
    RECEIVING = 1
    MOVING = 2
    DONE = 3
    REFUSED = 4
    """Nothing of it was executed."""
    FAILED = 5
    """Ended before its last point; what was executed is a prefix."""
    STOPPED = 6
    """Ended by a STOP."""


class Reason(IntEnum):
    """Why a trajectory was refused, or ended early. Texts: REASON_TEXTS."""

    NONE = 0
    CAPACITY = 1
    SEQUENCE_GAP = 2
    NOT_FINITE = 3
    JOINT_LIMIT = 4
    START_TOO_FAR = 5
    TOO_FAST = 6
    TCP_TOO_FAST = 7
    BAD_DURATION = 8
    SEGMENT_TOO_SHORT = 9
    NO_START = 10
    INCOMPLETE = 11
    FRAMING = 12
    UNKNOWN_MESSAGE = 13
    BAD_PADDING = 14
    NOT_EXECUTING = 20
    MOTORS_OFF = 21
    EMERGENCY_STOP = 22
    NOT_AUTO = 23
    BUILD_MISMATCH = 24
    MOVING = 25
    NOT_ALLOWED = 26
    STOPPED = 40
    SUPERSEDED = 41
    CLIENT_LOST = 42
    PROGRAM_STOPPED = 43
    MOTION_ERROR = 44
    COLLISION = 45
    POWER_FAILURE = 46
    MODE_CHANGED = 47
    STARVED = 48
    INTERNAL = 49


REASON_TEXTS: dict[Reason, str] = {
    Reason.NONE: "no error",
    Reason.CAPACITY: "more points than the driver holds",
    Reason.SEQUENCE_GAP: "a point is missing: its sequence number is not the next one",
    Reason.NOT_FINITE: "a value is not a finite number",
    Reason.JOINT_LIMIT: "a joint is outside its limits",
    Reason.START_TOO_FAR: "the first point is too far from where the robot stands",
    Reason.TOO_FAST: "a duration needs more speed than an axis has",
    Reason.TCP_TOO_FAST: "a duration needs more speed than the TCP may have",
    Reason.BAD_DURATION: "a duration is zero, negative or too long",
    Reason.SEGMENT_TOO_SHORT: "a segment is shorter than the path planner can follow",
    Reason.NO_START: "a point came before the start of a trajectory",
    Reason.INCOMPLETE: "the trajectory did not end: no end frame came",
    Reason.FRAMING: "the length of a message does not fit its type",
    Reason.UNKNOWN_MESSAGE: "the message type is not known on this port",
    Reason.BAD_PADDING: "a joint that the robot does not have is not zero",
    Reason.NOT_EXECUTING: "the motion task is not executing",
    Reason.MOTORS_OFF: "the motors are off",
    Reason.EMERGENCY_STOP: "an emergency stop is active",
    Reason.NOT_AUTO: "the controller is not in automatic mode",
    Reason.BUILD_MISMATCH: "the modules on the controller are not of one build",
    Reason.MOVING: "another trajectory is being executed",
    Reason.NOT_ALLOWED: "the client's address may not move this robot",
    Reason.STOPPED: "stopped on request",
    Reason.SUPERSEDED: "a newer trajectory took its place",
    Reason.CLIENT_LOST: "the connection to the client was lost",
    Reason.PROGRAM_STOPPED: "the program was stopped on the controller",
    Reason.MOTION_ERROR: "the controller reported an error while moving",
    Reason.COLLISION: "the controller detected a collision",
    Reason.POWER_FAILURE: "the controller lost its power",
    Reason.MODE_CHANGED: "the operating mode changed",
    Reason.STARVED: "the next point came too late",
    Reason.INTERNAL: "the driver met a state that it does not know",
}


def error_code(reason: Reason, joint: int = 0) -> int:
    """STATUS.error_code of a rapidgen driver: reason + 100 x joint number (1 to 10, 0 none)."""
    return int(reason) + 100 * joint


def split_error_code(code: int) -> tuple[Reason | None, int]:
    """(reason, joint number or 0) of an error code; reason None when it is not one of ours."""
    joint, number = divmod(code, 100)
    if not 0 <= joint <= MAX_JOINTS or number not in Reason.__members__.values():
        return None, 0
    return Reason(number), joint


class Wire(StrEnum):
    """Types on the wire, little endian."""

    INT32 = "int32"
    FLOAT32 = "float32"
    CHAR = "char"
    """One byte of ASCII; a text is filled up with zero bytes."""

    @property
    def size(self) -> int:
        """Bytes of one value."""
        return 1 if self is Wire.CHAR else 4


@dataclass(frozen=True, slots=True)
class Field:
    """One field: `count` values of `type`; a CHAR field of any count is one text."""

    name: str
    type: Wire
    count: int = 1
    unit: str = ""
    text: str = ""

    @property
    def size(self) -> int:
        """Bytes on the wire."""
        return self.type.size * self.count


@dataclass(frozen=True, slots=True)
class Reply:
    """The data of one reply to a request; `when` says which."""

    code: ReplyCode
    fields: tuple[Field, ...] = ()
    when: str = ""


@dataclass(frozen=True, slots=True)
class Message:
    """One message type.

    `since` is the protocol version that brought it (0: standard simple_message); `sender` is
    `client` or `controller`; `ports` are those on which it travels.
    """

    name: str
    number: int
    since: int
    sender: str
    ports: tuple[Port, ...]
    fields: tuple[Field, ...] = ()
    replies: tuple[Reply, ...] = ()
    text: str = ""

    @property
    def size(self) -> int:
        """Bytes of the data."""
        return sum(field.size for field in self.fields)

    @property
    def length(self) -> int:
        """Value of the length field."""
        return HEADER_BYTES + self.size


def _int(name: str, text: str = "", count: int = 1) -> Field:
    return Field(name, Wire.INT32, count, "", text)


def _real(name: str, unit: str, text: str = "", count: int = 1) -> Field:
    return Field(name, Wire.FLOAT32, count, unit, text)


_REFUSAL = (
    _int("reason", "number of the refusal, see the table of reasons"),
    _int("point", "point at fault, from 0; -1 none"),
    _int("joint", "joint at fault, from 1; 0 none"),
)
_POSITIONS = _real("positions", "rad, m", count=MAX_JOINTS)

JOINT_TRAJ_PT = Message(
    "JOINT_TRAJ_PT",
    11,
    0,
    "client",
    (Port.MOTION, Port.CONTROL),
    (
        _int("sequence", "1, 2, 3, ... or a special sequence number"),
        _real("joints", "rad, m", "controller axes in wire order, padded with zeros", MAX_JOINTS),
        _real("velocity", "1", "not used"),
        _real("duration", "s", "time from the point before to this one"),
    ),
    replies=(
        Reply(ReplyCode.SUCCESS, (), "the reply to STOP, and every reply of abb_driver"),
        Reply(
            ReplyCode.SUCCESS,
            (_int("trajectory", "number of the accepted trajectory, as in PROGRESS"),),
            "the reply of a rapidgen driver to an end frame that is a request",
        ),
        Reply(ReplyCode.FAILURE, _REFUSAL, "the trajectory was refused; nothing moves"),
    ),
    text="One point of a trajectory. As a topic it is not answered. On the control port only "
    "STOP is taken.",
)
JOINT_POSITION = Message(
    "JOINT_POSITION",
    10,
    0,
    "controller",
    (Port.STATE,),
    (_int("sequence", "0 from abb_driver"), _real("joints", "rad, m", "", MAX_JOINTS)),
    text="Where the controller axes are.",
)
STATUS = Message(
    "STATUS",
    13,
    0,
    "controller",
    (Port.STATE,),
    (
        _int("drives_powered", "tri-state"),
        _int("e_stopped", "tri-state"),
        _int("error_code", "reason + 100 x joint; abb_driver: an ERRNO"),
        _int("in_error", "tri-state"),
        _int("in_motion", "tri-state"),
        _int("mode", "1 manual, 2 automatic, -1 unknown"),
        _int("motion_possible", "tri-state"),
    ),
    text="What the robot is doing. It carries no sequence number.",
)
PING = Message(
    "PING",
    1,
    0,
    "client",
    (Port.MOTION,),
    replies=(Reply(ReplyCode.SUCCESS),),
    text="Asks for a sign of life. abb_driver does not take it.",
)
JOINT_TRAJ_PT_FULL = Message(
    "JOINT_TRAJ_PT_FULL",
    14,
    0,
    "client",
    (Port.MOTION,),
    (
        _int("robot_id"),
        _int("sequence"),
        _int("valid_fields", "bits: 1 time, 2 position, 4 velocity, 8 acceleration"),
        _real("time", "s"),
        _POSITIONS,
        _real("velocities", "rad/s, m/s", count=MAX_JOINTS),
        _real("accelerations", "rad/s2, m/s2", count=MAX_JOINTS),
    ),
    text="A point with derivatives. Neither abb_driver nor a rapidgen driver takes it.",
)
JOINT_FEEDBACK = Message(
    "JOINT_FEEDBACK",
    15,
    0,
    "controller",
    (Port.STATE,),
    (
        _int("robot_id"),
        _int("valid_fields", "bits: 1 time, 2 position, 4 velocity, 8 acceleration"),
        _real("time", "s"),
        _POSITIONS,
        _real("velocities", "rad/s, m/s", count=MAX_JOINTS),
        _real("accelerations", "rad/s2, m/s2", count=MAX_JOINTS),
    ),
    text="Where the axes are, with time and derivatives.",
)
HELLO = Message(
    "HELLO",
    1300,
    1,
    "client",
    (Port.STATE,),
    (
        _int("protocol", "newest protocol version of the client"),
        _int("client", "version of the client: major, minor, patch", 3),
        _int("subscribe", "features that the client wants on this connection, as bits"),
    ),
    replies=(
        Reply(
            ReplyCode.SUCCESS,
            (
                _int("protocol", "protocol version of the driver"),
                _int("driver", "version of rapidgen that generated it: major, minor, patch", 3),
                Field("build_id", Wire.CHAR, 12, "", "12 hexadecimal digits"),
                Field("mapping", Wire.CHAR, 12, "", "hash of the joint map, 12 digits"),
                _int("features", "bits"),
                _int("capacity", "points of one trajectory"),
                _int("joint_count", "joints of the group, 1 to 10"),
                _int("prismatic", "bit i: joint i is in m"),
                _real("state_period", "s"),
                _real("min_segment", "s", "shortest duration that the planner follows"),
                _real("start_tolerance", "rad", "of the first point, rotary axes"),
                _real("start_tolerance_linear", "m", "of the first point, linear axes"),
                _real("lower", "rad, m", "limits of the controller axes", MAX_JOINTS),
                _real("upper", "rad, m", "", MAX_JOINTS),
                _real("speed", "rad/s, m/s", "", MAX_JOINTS),
            ),
            "a rapidgen driver of a version that fits",
        ),
        Reply(
            ReplyCode.FAILURE,
            (_int("protocol", "protocol version of the driver"),),
            "the versions do not fit",
        ),
    ),
    text="Who is there? Sent as a request on the state port, where abb_driver reads nothing and "
    "so is not disturbed; no reply within a second means a plain simple_message driver.",
)
PROGRESS = Message(
    "PROGRESS",
    1301,
    1,
    "controller",
    (Port.STATE,),
    (
        _int("trajectory", "number of the newest trajectory, from 1, wraps at 2^23"),
        _int("state", "see the table of trajectory states"),
        _int("received", "points received"),
        _int("planned", "points given to the path planner"),
        _int("reached", "points that the robot has reached"),
        *_REFUSAL,
    ),
    text="How far the newest trajectory is. Only on connections that asked for it in HELLO.",
)

MESSAGES: tuple[Message, ...] = (
    PING,
    JOINT_POSITION,
    JOINT_TRAJ_PT,
    STATUS,
    JOINT_TRAJ_PT_FULL,
    JOINT_FEEDBACK,
    HELLO,
    PROGRESS,
)
BY_NUMBER: dict[int, Message] = {message.number: message for message in MESSAGES}

RESERVED: tuple[tuple[str, int], ...] = (
    ("JOINT_TRAJ", 12),
    ("READ_INPUT", 20),
    ("WRITE_OUTPUT", 21),
)
"""Standard numbers whose messages no ABB driver speaks."""
VENDOR_RANGES: tuple[tuple[str, int, int], ...] = (
    ("SwRI", 1000, 1099),
    ("UR", 1100, 1199),
    ("Adept", 1200, 1299),
    ("ABB", 1300, 1399),
    ("Fanuc", 1400, 1499),
    ("Motoman", 2000, 2099),
)
