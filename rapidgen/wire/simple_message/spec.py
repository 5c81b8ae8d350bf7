"""simple_message and ABB's range 1300-1399, as frozen data.

The only place that knows a number of the wire. The codec, the constants of the generated
RAPID modules and docs/develop/protocol.md derive from it. Sources: the headers of industrial_core
for the standard part (little endian, int32 and float32, rad, m, s), recordings of the
ROS-Industrial nodes for what they really send.
"""

from dataclasses import dataclass
from enum import IntEnum, IntFlag, StrEnum

PROTOCOL_VERSION = 2
"""Version of the messages in ABB's range. The standard messages have none: `since` 0."""

PREFIX_BYTES = 4
HEADER_BYTES = 12
MIN_LENGTH = HEADER_BYTES
"""Smallest value of the length field: a header without data."""
MAX_MESSAGE_BYTES = 1024
"""Largest message, length field included: more than this crashes a ROS-Industrial node."""
MAX_LENGTH = MAX_MESSAGE_BYTES - PREFIX_BYTES
MAX_JOINTS = 10

INDEX_WRAP = 2**23
"""Streams, trajectories and the points of a stream count modulo this: a num holds it exactly."""
PAIR_SCALE = 1_000_000
"""Steps of a fixed-point number in one rad, m or s."""
PAIR_BITS = 26
PAIR_ZERO = 2 ** (PAIR_BITS - 1)
"""What stands for the value 0."""
PAIR_BASE = 2**PAIR_BITS
PAIR_LIMIT = (PAIR_ZERO - 1) / PAIR_SCALE
"""Largest magnitude of a fixed-point number, rad, m or s."""
CHECKSUM_MODULUS = 2**51 - 129
"""A prime: with words below 2^52 every step is exact in a RAPID dnum, a 64-bit float."""
FEEDBACK_WRAP = 1000.0
"""s after which the time stamp of JOINT_FEEDBACK begins again at 0."""


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


class StreamFlag(IntFlag):
    """What a batch of points says about its stream."""

    BEGIN = 1
    """A new trajectory begins with it, in the place of what is under way."""
    END = 2
    """Nothing follows; the last point is a stop point."""
    FLUSH = 4
    """Start with what is there, though it is less than the driver likes to have."""


class EventType(IntEnum):
    """Kind of an event of the controller's log."""

    STATE_CHANGE = 1
    WARNING = 2
    ERROR = 3


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
    STARVED = 7
    """Stands at the last point of a stream that came, and waits for more."""
    PAUSED = 8
    """Stands on its path by request."""


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
    OVERRUN = 15
    CHECKSUM = 16
    NO_SIGNAL = 17
    READ_ONLY = 18
    BAD_VALUE = 19
    NOT_EXECUTING = 20
    MOTORS_OFF = 21
    EMERGENCY_STOP = 22
    NOT_AUTO = 23
    BUILD_MISMATCH = 24
    MOVING = 25
    NOT_ALLOWED = 26
    IDLE = 27
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
    Reason.OVERRUN: "more points than there is room for",
    Reason.CHECKSUM: "the checksum of a batch is wrong",
    Reason.NO_SIGNAL: "the driver does not have this signal",
    Reason.READ_ONLY: "this signal may not be written",
    Reason.BAD_VALUE: "a value is outside its range",
    Reason.NOT_EXECUTING: "the motion task is not executing",
    Reason.MOTORS_OFF: "the motors are off",
    Reason.EMERGENCY_STOP: "an emergency stop is active",
    Reason.NOT_AUTO: "the controller is not in automatic mode",
    Reason.BUILD_MISMATCH: "the modules on the controller are not of one build",
    Reason.MOVING: "another trajectory is being executed",
    Reason.NOT_ALLOWED: "the client's address may not move this robot",
    Reason.IDLE: "no trajectory is under way",
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
    UINT64 = "uint64"
    PAIR = "pair"
    """Two fixed-point numbers (a, b) in one uint64, each in steps of 1 / PAIR_SCALE from
    PAIR_ZERO: `a * PAIR_BASE + b`. Below 2^52, so that a RAPID dnum holds it exactly."""
    CHAR = "char"
    """One byte of ASCII; a text is filled up with zero bytes."""

    @property
    def size(self) -> int:
        """Bytes of one value."""
        return _WIRE_SIZES.get(self, 4)


_WIRE_SIZES = {Wire.CHAR: 1, Wire.UINT64: 8, Wire.PAIR: 8}
ANY = 0
"""Count of a field that has as many values as the length of the message says."""


@dataclass(frozen=True, slots=True)
class Field:
    """One field: `count` values of `type`; a CHAR field of any count is one text.

    At most one field of a message has the count ANY.
    """

    name: str
    type: Wire
    count: int = 1
    unit: str = ""
    text: str = ""

    @property
    def size(self) -> int:
        """Bytes on the wire; of a field with the count ANY, those of no value."""
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
        """Bytes of the data; the fewest where a field has any number of values."""
        return sum(field.size for field in self.fields)

    @property
    def length(self) -> int:
        """Value of the length field; the smallest where a field has any number of values."""
        return HEADER_BYTES + self.size

    @property
    def is_fixed(self) -> bool:
        """Whether the length is always the same."""
        return all(field.count != ANY for field in self.fields)


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
        _int("robot_id", "0"),
        _int("valid_fields", "bits: 1 time, 2 position, 4 velocity, 8 acceleration"),
        _real("time", "s", "of the controller's clock, 0 to 1000, then again from 0"),
        _POSITIONS,
        _real("velocities", "rad/s, m/s", count=MAX_JOINTS),
        _real("accelerations", "rad/s2, m/s2", count=MAX_JOINTS),
    ),
    text="Where the axes are, with time and derivatives. Only on connections that asked for it "
    "in HELLO.",
)
HELLO = Message(
    "HELLO",
    1300,
    1,
    "client",
    (Port.STATE, Port.CONTROL),
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
                _int("control_port", "TCP port of the control connection, 0 none"),
                _int("ring", "points of a stream that the driver takes ahead"),
                _real("preload", "s", "that it likes to have before it starts"),
                _int("batch", "points of one POINTS, 0 when it does not stream"),
                _int("signals", "signals that SIGNAL reaches"),
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
    "so is not disturbed; no reply within a second means a plain simple_message driver. On the "
    "control port it tells whose port that is. A reply of another length is one of another "
    "version: its first field still says which.",
)
PROGRESS = Message(
    "PROGRESS",
    1301,
    1,
    "controller",
    (Port.STATE,),
    (
        _int("trajectory", "number of the newest trajectory, from 1; 0 follows 2^22 - 1"),
        _int("state", "see the table of trajectory states"),
        _int("received", "points received"),
        _int("planned", "points given to the path planner"),
        _int("reached", "points that the robot has reached"),
        *_REFUSAL,
    ),
    text="How far the newest trajectory is. Only on connections that asked for it in HELLO.",
)
POINTS = Message(
    "POINTS",
    1302,
    2,
    "client",
    (Port.MOTION,),
    (
        _int("stream", "the client's number of the stream, 1 to 2^23 - 1"),
        _int("flags", "bits: 1 BEGIN, 2 END, 4 FLUSH"),
        _int("first", "index of the first point, from 0, modulo 2^23"),
        _int("points", "how many follow, from 0"),
        Field("pairs", Wire.PAIR, ANY, "s, rad, m", "per point: duration, joints, then 0 if odd"),
        Field("checksum", Wire.UINT64, 1, "", "of all words before it, see below"),
    ),
    replies=(
        Reply(
            ReplyCode.SUCCESS,
            (
                _int("stream"),
                _int("trajectory", "its number, as in PROGRESS"),
                _int("accepted", "points accepted, modulo 2^23"),
                _int("room", "points that may follow"),
                _int("planned", "points given to the path planner, modulo 2^23"),
                _int("reached", "points that the robot has reached, modulo 2^23"),
                _int("state", "see the table of trajectory states"),
            ),
            "all points of the batch are accepted",
        ),
        Reply(
            ReplyCode.FAILURE,
            (
                _int("stream"),
                _int("trajectory", "its number, as in PROGRESS; 0 when there is none"),
                _int("accepted", "points accepted, modulo 2^23"),
                *_REFUSAL,
            ),
            "points from `accepted` on are refused, and so is what follows them",
        ),
    ),
    text="Points of a trajectory without end. As a topic it is not answered.",
)
STOPPED = Message(
    "STOPPED",
    1303,
    2,
    "controller",
    (Port.CONTROL,),
    (
        _int("trajectory", "as in PROGRESS"),
        _int("reached", "points that the robot has reached"),
        _int("reason", "see the table of reasons"),
        _real("joints", "rad, m", "where the axes stand", MAX_JOINTS),
    ),
    text="Where the robot stands after a halt, when its path is gone. Sent by itself.",
)
_REASON = _int("reason", "see the table of reasons")
_NOT_DONE = Reply(ReplyCode.FAILURE, (_REASON,), "it was not done")
PAUSE = Message(
    "PAUSE",
    1304,
    2,
    "client",
    (Port.CONTROL,),
    (_int("paused", "1 stop on the path and keep it, 0 go on"),),
    replies=(Reply(ReplyCode.SUCCESS), _NOT_DONE),
    text="Holds a motion on its path, or lets it go on.",
)
SPEED = Message(
    "SPEED",
    1305,
    2,
    "client",
    (Port.CONTROL,),
    (_real("percent", "1", "1 to 100 % of the programmed speed"),),
    replies=(Reply(ReplyCode.SUCCESS), _NOT_DONE),
    text="Speed override; 100 again with every new trajectory.",
)
HEARTBEAT = Message(
    "HEARTBEAT",
    1306,
    2,
    "client",
    (Port.CONTROL,),
    (_real("timeout", "s", "until the next one must come; 0: none is awaited any more"),),
    replies=(
        Reply(
            ReplyCode.SUCCESS,
            (
                _int("trajectory", "number of the newest trajectory"),
                _int("state", "see the table of trajectory states"),
            ),
        ),
        _NOT_DONE,
    ),
    text="A sign of life of the client. When the next one is late, or the connection breaks while "
    "one is awaited, the robot is stopped (CLIENT_LOST).",
)
SIGNAL = Message(
    "SIGNAL",
    1307,
    2,
    "client",
    (Port.CONTROL,),
    (
        _int("signal", "of the configuration, from 0"),
        _int("write", "1 write `value`, 0 read"),
        _real("value", "1"),
    ),
    replies=(
        Reply(
            ReplyCode.SUCCESS,
            (_int("signal"), _real("value", "1", "as it was read, after any writing")),
        ),
        _NOT_DONE,
    ),
    text="Reads or writes one of the signals that the configuration exposes.",
)
EVENT = Message(
    "EVENT",
    1308,
    2,
    "controller",
    (Port.STATE,),
    (
        _int("domain", "of the event's number: 1 to 14; 0: so many were not told"),
        _int("number", "within the domain"),
        _int("type", "1 state change, 2 warning, 3 error"),
        Field("title", Wire.CHAR, 80, "", "in the controller's language"),
    ),
    text="An event of the controller's log. Only on connections that asked for it in HELLO.",
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
    POINTS,
    STOPPED,
    PAUSE,
    SPEED,
    HEARTBEAT,
    SIGNAL,
    EVENT,
)
BY_NUMBER: dict[int, Message] = {message.number: message for message in MESSAGES}


def point_pairs(joint_count: int) -> int:
    """PAIRs of one point in POINTS: a duration and the joints, two by two."""
    return (2 + joint_count) // 2


def points_length(count: int, joint_count: int) -> int:
    """Value of the length field of a POINTS with so many points."""
    return POINTS.length + count * point_pairs(joint_count) * Wire.PAIR.size


def batch_points(joint_count: int) -> int:
    """Points that fit in one POINTS: 30 for six axes, 20 for ten."""
    return (MAX_LENGTH - POINTS.length) // (point_pairs(joint_count) * Wire.PAIR.size)


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
