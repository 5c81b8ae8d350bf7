"""Numbers of simple_message and of ABB's range 1300 to 1399.

This is the only module with numbers of the wire; messages.py has the messages. The codec, the
constants of the generated RAPID modules and docs/develop/protocol.md derive from it. Sources: the
headers of industrial_core for the standard part (little endian, int32 and float32, rad, m, s),
recordings of the ROS-Industrial nodes for actual messages.
"""

from enum import IntEnum, IntFlag

PROTOCOL_VERSION = 4
"""Version of the messages in ABB's range.

The standard messages have none: `since` 0.
"""

PREFIX_BYTES = 4
HEADER_BYTES = 12
MIN_LENGTH = HEADER_BYTES
"""Smallest value of the length field: a header without data."""
MAX_MESSAGE_BYTES = 1024
"""Largest message, length field included: a larger one crashes a ROS-Industrial node."""
MAX_LENGTH = MAX_MESSAGE_BYTES - PREFIX_BYTES
MAX_JOINTS = 10

MOST_ARGUMENTS = 8
"""Maximum number of parameters of a routine."""
LONGEST_TEXT = 80
"""Characters of a RAPID string."""
INDEX_WRAP = 2**23
"""Streams, trajectories and the points of a stream count modulo this: a num holds it exactly."""
FIXED_SCALE = 1_000_000
"""Steps of a fixed-point number in one rad, m or s."""
FIXED_LIMIT = (2**31 - 1) / FIXED_SCALE
"""Largest magnitude of a fixed-point number, rad, m or s."""
LONGEST_SEGMENT = 3600.0
"""s that a driver accepts from one point to the next: ROS_MAX_DURATION of ROS_motionServer."""
CHECKSUM_OFFSET = 2**31
"""Added to each word of a checksum: MOD of a negative number is not specified."""
CHECKSUM_MODULUS = 2**31 - 19
"""A prime of which 2 is a primitive root, so that no two places of a message have the same weight.

RAPID promises whole numbers of a dnum to 2^52; eleven words at a time stay below 2^44.
"""
FEEDBACK_WRAP = 1000.0
"""s after which the time stamp of JOINT_FEEDBACK begins again at 0."""


class Port(IntEnum):
    """Standard TCP ports of the first motion group.

    CONTROL is 11001, simple_message's SYSTEM.
    """

    MOTION = 11000
    CONTROL = 11001
    STATE = 11002
    IO = 11003


class Comm(IntEnum):
    """comm_type: communication type of a message."""

    TOPIC = 1
    REQUEST = 2
    REPLY = 3


class ReplyCode(IntEnum):
    """reply_code: result of a request.

    Anything but NONE in a topic makes a ROS-Industrial node drop the link.
    """

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
    """A boolean that the controller may not know."""

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
    """Features of a driver beyond the standard messages, reported in HELLO."""

    PROGRESS = 1
    """PROGRESS follows every JOINT on a connection that sent HELLO."""
    CONTROL = 2
    """The control port takes STOP from a connection of its own."""
    STREAMING = 4
    SIGNALS = 8
    EVENTS = 16
    FEEDBACK = 32
    PROGRAMS = 64
    EGM = 128
    """The control port starts and ends sessions of externally guided motion."""


class StreamFlag(IntFlag):
    """Flags of a batch in its stream."""

    BEGIN = 1
    """A new trajectory begins and replaces the current one."""
    END = 2
    """Nothing follows; the last point is a stop point."""
    FLUSH = 4
    """Start with the points that are there, even if they are fewer than `preload`."""
    WHOLE = 8
    """For a program: nothing moves before its end has arrived and all of it is checked."""


class Instruction(IntEnum):
    """Kinds of program instructions: the lower eight bits of the first word."""

    MOVE_ABSJ = 1
    MOVE_J = 2
    MOVE_L = 3
    MOVE_C = 4
    WAIT = 5
    WAIT_SIGNAL = 6
    SET = 7
    CALL = 8
    SETTINGS = 9
    TOOL = 10
    WORK_OBJECT = 11


class Modal(IntFlag):
    """Flags of values before an instruction's operands, in this order.

    All but SIGNALS stay in force.
    """

    SPEED = 256
    ZONE = 512
    FRAMES = 1024
    SIGNALS = 2048


class MarkPlace(IntEnum):
    """Reference of a signal's place on its move."""

    START = 0
    """m from the beginning of the move"""
    END = 1
    """m before its end"""
    TIME = 2
    """s before its end"""


class EventType(IntEnum):
    """Kind of an event of the controller's log."""

    STATE_CHANGE = 1
    WARNING = 2
    ERROR = 3


class TrajectoryState(IntEnum):
    """State of the newest trajectory, reported in PROGRESS."""

    NONE = 0
    """Nothing was sent since the driver started."""
    RECEIVING = 1
    MOVING = 2
    DONE = 3
    REFUSED = 4
    """No point of it was executed."""
    FAILED = 5
    """Ended before its last point; a prefix was executed."""
    STOPPED = 6
    """Ended by a STOP."""
    STARVED = 7
    """At the last point of a stream, waiting for more."""
    PAUSED = 8
    """Paused on its path."""


class Reason(IntEnum):
    """Reasons of a rejected trajectory, or of an early end."""

    text: str

    def __new__(cls, number: int, text: str = "") -> "Reason":
        made = int.__new__(cls, number)
        made._value_ = number
        made.text = text
        return made

    NONE = 0, "no error"
    CAPACITY = 1, "more points than the driver holds"
    SEQUENCE_GAP = 2, "a point is missing: its sequence number is not the next one"
    NOT_FINITE = 3, "a value is not a finite number"
    JOINT_LIMIT = 4, "a joint is outside its limits"
    START_TOO_FAR = 5, "the first point is too far from where the robot stands"
    TOO_FAST = 6, "a duration needs more speed than an axis has"
    TCP_TOO_FAST = 7, "a duration needs more speed than the TCP may have"
    BAD_DURATION = 8, "a duration is zero, negative or too long"
    SEGMENT_TOO_SHORT = 9, "a segment is shorter than the path planner can follow"
    NO_START = 10, "a point came before the start of a trajectory"
    INCOMPLETE = 11, "the trajectory did not end: no end frame came"
    FRAMING = 12, "the length of a message does not fit its type"
    UNKNOWN_MESSAGE = 13, "the message type is not known on this port"
    BAD_PADDING = 14, "a joint that the robot does not have is not zero"
    OVERRUN = 15, "more points than there is room for"
    CHECKSUM = 16, "the checksum of a batch is wrong"
    NO_SIGNAL = 17, "the driver does not have this signal"
    READ_ONLY = 18, "this signal or datum may not be written"
    BAD_VALUE = 19, "a value is outside its range"
    NOT_EXECUTING = 20, "the motion task is not executing"
    MOTORS_OFF = 21, "the motors are off"
    EMERGENCY_STOP = 22, "an emergency stop is active"
    NOT_AUTO = 23, "the controller is not in automatic mode"
    BUILD_MISMATCH = 24, "the modules on the controller are not of one build"
    MOVING = 25, "another trajectory is being executed"
    NOT_ALLOWED = 26, "the client's address may not move this robot"
    IDLE = 27, "no trajectory is under way"
    NOT_SERVING = 28, "the program of the robot is not in ROS_run"
    NO_INSTRUCTION = 29, "the driver does not have this instruction"
    BAD_SPEED = 30, "a speed is missing, or outside its range"
    BAD_ZONE = 31, "a zone is missing, or outside its range"
    POSE_MISMATCH = 32, "the joints do not reach the pose on this controller"
    NO_GEOMETRY = 33, "the controller does not tell what pose the joints reach"
    NO_FRAME = 34, "the driver does not have this tool or work object"
    NO_ROUTINE = 35, "there is no such routine, or not with these parameters"
    IN_ROUTINE = 36, "a routine is under way: its moves have speeds of their own"
    NO_DATUM = 37, "the robot's program does not have this datum, or not of this type"
    NO_CIRCLE = 38, "the three points make no circle, or one of more than 240 degrees"
    STOPPED = 40, "stopped on request"
    SUPERSEDED = 41, "a newer trajectory took its place"
    CLIENT_LOST = 42, "the connection to the client was lost"
    PROGRAM_STOPPED = 43, "the program was stopped on the controller"
    MOTION_ERROR = 44, "the controller reported an error while moving"
    COLLISION = 45, "the controller detected a collision"
    POWER_FAILURE = 46, "the controller lost its power"
    MODE_CHANGED = 47, "the operating mode changed"
    STARVED = 48, "the next point came too late"
    INTERNAL = 49, "the driver met a state that it does not know"
    WAITED = 50, "a signal did not come in time"
    ROUTINE = 51, "a routine has raised an error"
    OVERTIME = 52, "a routine took longer than it may"
    TASK_ENDED = 53, "a server task of the driver has ended"
    GUIDED = 54, "another program guides the robot (EGM)"
    NO_EGM = 55, "the controller does not have the device or profile for EGM"
    NO_HEARTBEAT = 56, "the client sends no heartbeat, or one that is too slow"


def error_code(reason: Reason, joint: int = 0) -> int:
    """Return STATUS.error_code of a rapidgen driver.

    It is reason + 100 x joint number (1 to 10, 0 none).
    """
    return int(reason) + 100 * joint


def split_error_code(code: int) -> tuple[Reason | None, int]:
    """Split an error code into reason and joint number (0: none).

    The reason is None if it is not a rapidgen code.
    """
    joint, number = divmod(code, 100)
    if not 0 <= joint <= MAX_JOINTS or number not in Reason.__members__.values():
        return None, 0
    return Reason(number), joint


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
