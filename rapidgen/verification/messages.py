"""Independent simple_message codec with hand-written layouts.

Source: docs/develop/protocol.md. This module uses nothing of the codec in `wire`: the driver's
constants come from there, and a wrong number in both would go unnoticed. Little endian; rad, m and
s.
"""

import struct
from enum import IntEnum, IntFlag
from itertools import islice
from typing import NamedTuple, TypeAlias

from rapidgen.verification.model import CheckFailed
from rapidgen.wire.simple_message import spec

PROTOCOL_VERSION = 4
MAX_JOINTS = 10
SHORTEST, LONGEST = 12, 1020
"""Values of the length field: a header without data, and the largest message."""
INDEX_WRAP = 2**23
"""Point numbers of a stream wrap at this value."""

PING, JOINT_POSITION, JOINT_TRAJ_PT, STATUS, JOINT_FEEDBACK = 1, 10, 11, 13, 15
HELLO, PROGRESS, POINTS, STOPPED, PAUSE, SPEED, HEARTBEAT, SIGNAL, EVENT = range(1300, 1309)
PROGRAM, RESULT, DATA, TARGET, EGM = range(1309, 1314)
POINT_BYTES, STATE_BYTES = 68, 60 + 44
"""Bytes of a JOINT_TRAJ_PT, and of the messages to every state client: JOINT and STATUS."""


class RawComm(IntEnum):
    """Communication type of a message."""

    TOPIC = 1
    REQUEST = 2
    REPLY = 3


class RawReplyCode(IntEnum):
    """Result of a request."""

    NONE = 0
    SUCCESS = 1
    FAILURE = 2


class RawSpecial(IntEnum):
    """Special point numbers: start and end of a trajectory, and STOP."""

    BEGIN = -1
    END = -3
    STOP = -4


class RawTriState(IntEnum):
    """A boolean that the controller may not know."""

    UNKNOWN = -1
    FALSE = 0
    TRUE = 1


class RawMode(IntEnum):
    """Operating mode of the controller."""

    MANUAL = 1
    AUTO = 2


class RawFeature(IntFlag):
    """Features of a driver in HELLO; a client requests them there."""

    PROGRESS = 1
    CONTROL = 2
    STREAMING = 4
    SIGNALS = 8
    EVENTS = 16
    FEEDBACK = 32
    PROGRAMS = 64
    EGM = 128


class RawStreamFlag(IntFlag):
    """Flags of a batch of points."""

    BEGIN = 1
    END = 2
    FLUSH = 4
    WHOLE = 8


class RawInstruction(IntEnum):
    """Kinds of program instructions."""

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


class RawModal(IntFlag):
    """Flags that precede an instruction's operands."""

    SPEED = 256
    ZONE = 512
    FRAMES = 1024
    SIGNALS = 2048


class RawTrajectoryState(IntEnum):
    """State of the newest trajectory, reported in PROGRESS."""

    NONE = 0
    RECEIVING = 1
    MOVING = 2
    DONE = 3
    REFUSED = 4
    FAILED = 5
    STOPPED = 6
    STARVED = 7
    PAUSED = 8


class RawReason(IntEnum):
    """Reasons of a rejected trajectory, or of an early end."""

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
    BUILD_MISMATCH = 24
    MOVING = 25
    IDLE = 27
    NOT_SERVING = 28
    NO_INSTRUCTION = 29
    BAD_SPEED = 30
    BAD_ZONE = 31
    POSE_MISMATCH = 32
    NO_GEOMETRY = 33
    NO_FRAME = 34
    NO_ROUTINE = 35
    IN_ROUTINE = 36
    NO_DATUM = 37
    NO_CIRCLE = 38
    STOPPED = 40
    SUPERSEDED = 41
    CLIENT_LOST = 42
    PROGRAM_STOPPED = 43
    MOTION_ERROR = 44
    COLLISION = 45
    POWER_FAILURE = 46
    MODE_CHANGED = 47
    INTERNAL = 49
    WAITED = 50
    ROUTINE = 51
    OVERTIME = 52
    TASK_ENDED = 53
    GUIDED = 54
    NO_EGM = 55
    NO_HEARTBEAT = 56


def text_of(reason: RawReason) -> str:
    """Return the operator's text for a reason."""
    return spec.Reason(reason).text


def split_error_code(code: int) -> tuple[int, int]:
    """Split STATUS.error_code into reason and joint (0: none)."""
    joint, reason = divmod(code, 100)
    return reason, joint


Joints: TypeAlias = tuple[float, ...]
"""Ten controller axis values in wire order."""


class RawTrajectoryPoint(NamedTuple):
    """JOINT_TRAJ_PT: `duration` is s from the point before."""

    sequence: int
    joints: Joints
    velocity: float
    duration: float


class RawJointPosition(NamedTuple):
    """JOINT_POSITION."""

    sequence: int
    joints: Joints


class RawStatus(NamedTuple):
    """STATUS."""

    drives_powered: int
    e_stopped: int
    error_code: int
    in_error: int
    in_motion: int
    mode: int
    motion_possible: int


class RawPing(NamedTuple):
    """PING has no data."""


class RawJointFeedback(NamedTuple):
    """JOINT_FEEDBACK."""

    robot_id: int
    valid_fields: int
    time: float
    positions: Joints
    velocities: Joints
    accelerations: Joints


class RawHello(NamedTuple):
    """HELLO request of a client."""

    protocol: int
    client: tuple[int, int, int]
    subscribe: int


class RawHelloReply(NamedTuple):
    """HELLO reply of the driver."""

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


class RawHelloRefusal(NamedTuple):
    """HELLO reply to an unsupported version."""

    protocol: int


class RawProgress(NamedTuple):
    """PROGRESS; `point` from 0 (-1: none), `joint` from 1 (0: none)."""

    trajectory: int
    state: int
    received: int
    planned: int
    reached: int
    reason: int
    point: int
    joint: int


class RawStopped(NamedTuple):
    """STOPPED: position of the robot after a halt."""

    trajectory: int
    reached: int
    reason: int
    joints: Joints


class RawPause(NamedTuple):
    """PAUSE: 1 pause, 0 resume."""

    paused: int


class RawSpeed(NamedTuple):
    """SPEED, 1 to 100 %."""

    percent: float


class RawHeartbeat(NamedTuple):
    """HEARTBEAT: s until the next one must arrive; 0 ends the monitoring."""

    timeout: float


class RawSignal(NamedTuple):
    """SIGNAL: read, or with `write` 1 write."""

    signal: int
    write: int
    value: float


class RawDatum(NamedTuple):
    """DATA: read, or with `write` 1 write."""

    datum: int
    write: int
    value: float
    text: str


class RawDatumReply(NamedTuple):
    """Reply to DATA: the value after any write."""

    datum: int
    value: float
    text: str


class RawEvent(NamedTuple):
    """EVENT of the controller's log."""

    domain: int
    number: int
    type: int
    title: str
    first: str
    second: str


class RawPointsAccepted(NamedTuple):
    """Reply to POINTS: all points accepted."""

    stream: int
    trajectory: int
    accepted: int
    room: int
    planned: int
    reached: int
    state: int


class RawPointsRefused(NamedTuple):
    """Reply to POINTS: points from `accepted` on are not executed."""

    stream: int
    trajectory: int
    accepted: int
    reason: int
    point: int
    joint: int


class RawNotDone(NamedTuple):
    """Failure reply to PAUSE, SPEED, HEARTBEAT and SIGNAL."""

    reason: int


class RawHeartbeatReply(NamedTuple):
    """Reply to HEARTBEAT: the newest trajectory and its state."""

    trajectory: int
    state: int


class RawSignalReply(NamedTuple):
    """Reply to SIGNAL: the value after any write."""

    signal: int
    value: float


class RawResult(NamedTuple):
    """RESULT: a text parameter of the routine that was called last."""

    parameter: int


class RawResultReply(NamedTuple):
    """Reply to RESULT: the routine's output parameters, or its error."""

    trajectory: int
    error: int
    values: tuple[float, ...]
    text: str


class RawTarget(NamedTuple):
    """TARGET: a jointtarget (1) or robtarget (0) of that routine."""

    joints: int
    parameter: int


class RawTargetReply(NamedTuple):
    """Reply to TARGET."""

    trajectory: int
    position: tuple[float, ...]
    orientation: tuple[float, ...]
    configuration: tuple[float, ...]
    joints: tuple[float, ...]


class RawEgm(NamedTuple):
    """EGM: start (1) or end (0) a session of externally guided motion."""

    active: int


class RawEgmReply(NamedTuple):
    """Reply to EGM: number of the session."""

    trajectory: int


class RawAccepted(NamedTuple):
    """Reply to an end frame: number of the accepted trajectory."""

    trajectory: int


class RawRefused(NamedTuple):
    """Reply to a rejected point: the robot does not move."""

    reason: int
    point: int
    joint: int


class RawAcknowledged(NamedTuple):
    """A success reply without data."""


class RawFailure(NamedTuple):
    """A failure reply without data."""


_Report: TypeAlias = RawJointPosition | RawStatus | RawJointFeedback | RawProgress | RawStopped
_Request: TypeAlias = (
    RawTrajectoryPoint
    | RawHello
    | RawPause
    | RawSpeed
    | RawHeartbeat
    | RawSignal
    | RawResult
    | RawTarget
    | RawDatum
    | RawEgm
)
_Done: TypeAlias = (
    RawHelloReply
    | RawHeartbeatReply
    | RawSignalReply
    | RawPointsAccepted
    | RawResultReply
    | RawTargetReply
    | RawDatumReply
    | RawEgmReply
)
_Refused: TypeAlias = RawHelloRefusal | RawPointsRefused | RawNotDone | RawRefused | RawFailure
RawContent: TypeAlias = (
    _Report | _Request | _Done | _Refused | RawEvent | RawPing | RawAccepted | RawAcknowledged
)
_LAYOUTS: tuple[tuple[int, int, type[RawContent], str], ...] = (
    # Number, reply code (0: a topic or a request), and a struct code for each field.
    (PING, 0, RawPing, ""),
    (JOINT_POSITION, 0, RawJointPosition, "i 10f"),
    (JOINT_TRAJ_PT, 0, RawTrajectoryPoint, "i 10f f f"),
    (JOINT_TRAJ_PT, 1, RawAccepted, "i"),
    (JOINT_TRAJ_PT, 2, RawRefused, "i i i"),
    (STATUS, 0, RawStatus, "i i i i i i i"),
    (JOINT_FEEDBACK, 0, RawJointFeedback, "i i f 10f 10f 10f"),
    (HELLO, 0, RawHello, "i 3i i"),
    (HELLO, 1, RawHelloReply, "i 3i 12s 12s i i i i f f f f 10f 10f 10f i i f i i"),
    (HELLO, 2, RawHelloRefusal, "i"),
    (PROGRESS, 0, RawProgress, "i i i i i i i i"),
    (POINTS, 1, RawPointsAccepted, "i i i i i i i"),
    (POINTS, 2, RawPointsRefused, "i i i i i i"),
    (PROGRAM, 1, RawPointsAccepted, "i i i i i i i"),
    (PROGRAM, 2, RawPointsRefused, "i i i i i i"),
    (RESULT, 0, RawResult, "i"),
    (RESULT, 1, RawResultReply, "i i 8f 80s"),
    (TARGET, 0, RawTarget, "i i"),
    (TARGET, 1, RawTargetReply, "i 3f 4f 4f 10f"),
    (STOPPED, 0, RawStopped, "i i i 10f"),
    (PAUSE, 0, RawPause, "i"),
    (PAUSE, 2, RawNotDone, "i"),
    (SPEED, 0, RawSpeed, "f"),
    (SPEED, 2, RawNotDone, "i"),
    (HEARTBEAT, 0, RawHeartbeat, "f"),
    (HEARTBEAT, 1, RawHeartbeatReply, "i i"),
    (HEARTBEAT, 2, RawNotDone, "i"),
    (SIGNAL, 0, RawSignal, "i i f"),
    (SIGNAL, 1, RawSignalReply, "i f"),
    (SIGNAL, 2, RawNotDone, "i"),
    (EVENT, 0, RawEvent, "i i i 80s 80s 80s"),
    (DATA, 0, RawDatum, "i i f 80s"),
    (DATA, 1, RawDatumReply, "i f 80s"),
    (DATA, 2, RawNotDone, "i"),
    (EGM, 0, RawEgm, "i"),
    (EGM, 1, RawEgmReply, "i"),
    (EGM, 2, RawNotDone, "i"),
)
_ASKED = {kind: (number, layout) for number, code, kind, layout in _LAYOUTS if code == 0}
_KNOWN = {
    (number, code, struct.calcsize("<" + layout)): (kind, layout)
    for number, code, kind, layout in _LAYOUTS
}
_HEAD = struct.Struct("<4i")


class RawFrame(NamedTuple):
    """One message: the header's three numbers and the data."""

    number: int
    comm: int
    reply: int
    data: bytes


class Splitter:
    """Split a byte stream into messages, however TCP divides it."""

    def __init__(self) -> None:
        self._rest = b""

    def feed(self, data: bytes) -> list[RawFrame]:
        """Add bytes; return the completed messages.

        Raises CheckFailed for an invalid length.
        """
        self._rest += data
        failures = []
        while len(self._rest) >= 4:
            length = int.from_bytes(self._rest[:4], "little", signed=True)
            if not SHORTEST <= length <= LONGEST:
                raise CheckFailed(f"length field is {length}, must be {SHORTEST} to {LONGEST}")
            if len(self._rest) < 4 + length:
                break
            _, number, comm, reply = _HEAD.unpack_from(self._rest)
            failures.append(RawFrame(number, comm, reply, self._rest[16 : 4 + length]))
            self._rest = self._rest[4 + length :]
        return failures


def framed(number: int, data: bytes, comm: int = RawComm.REQUEST, *, more: int = 0) -> bytes:
    """Frame any data as a message whose length field is `more` bytes too large."""
    return _HEAD.pack(12 + len(data) + more, number, comm, 0) + data


def encode(content: RawContent, comm: RawComm = RawComm.TOPIC) -> bytes:
    """Encode a topic or request."""
    number, layout = _ASKED[type(content)]
    flat: list[object] = []
    for value in content:
        plain = value.encode("latin-1") if isinstance(value, str) else value
        flat.extend(plain if isinstance(plain, tuple) else (plain,))
    return framed(number, struct.pack("<" + layout, *flat), comm)


def decode(frame: RawFrame) -> RawContent:
    """Decode a message.

    Raises CheckFailed for a message that docs/develop/protocol.md does not contain.
    """
    number, comm, code, data = frame
    good = code in (1, 2) if comm == RawComm.REPLY else (comm in (1, 2) and code == 0)
    if good and comm == RawComm.REPLY and not data:
        return RawAcknowledged() if code == RawReplyCode.SUCCESS else RawFailure()
    if not good or (number, code, len(data)) not in _KNOWN:
        raise CheckFailed(f"no message has type {number}, {comm=}, {code=} and {len(data)} bytes")
    kind, layout = _KNOWN[number, code, len(data)]
    values = iter(struct.unpack("<" + layout, data))
    fields: list[object] = []
    for field in layout.split():
        count = int(field[:-1] or 1)
        if field[-1] == "s":
            fields.append(next(values).rstrip(b"\0").decode("latin-1"))
        else:
            fields.append(next(values) if count == 1 else tuple(islice(values, count)))
    return kind._make(fields)
