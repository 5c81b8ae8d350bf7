"""docs/develop/protocol.md, written from the declarations.

`python -m rapidgen.wire.simple_message.protocol_page > docs/develop/protocol.md`; a test compares.
"""

import sys
from collections.abc import Iterable, Sequence
from enum import IntEnum, IntFlag

from rapidgen.wire.simple_message import messages, spec
from rapidgen.wire.simple_message.declaration import ANY, Field, MessageType
from rapidgen.wire.simple_message.instructions import MODALS, OPERANDS
from rapidgen.wire.simple_message.spec import Port

_INTRODUCTION = """\
# The wire

Written from `rapidgen/wire/simple_message/` by
`python -m rapidgen.wire.simple_message.protocol_page`.

A rapidgen driver speaks ROS-Industrial's simple_message, so that its C++ nodes work unchanged,
and adds messages in ABB's range 1300 to 1399 for the paired client. Everything is little endian;
`int32`, `float32` and `fixed` have four bytes. Joints are values of the
**controller's axes**, in rad and m, in the order of `joints:` in the configuration, padded with
zeros to ten. Sign, offset and coupling of joint 2 and 3 are the client's business.
"""

_RULES = """\
## Rules of a trajectory

- A trajectory of N points has the sequence numbers -1, 1, 2, ..., N-2, -3. There is no 0. A
  single point is sent twice, as -1 and as -3. Nothing moves before the end frame.
- Points are topics and are not answered. An end frame or a STOP that is a request is answered
  once: STOP with a header alone, as abb_driver does.
- A request of a type that a driver does not have is answered by FAILURE and a header alone: SIGNAL,
  DATA, RESULT and TARGET, too, where its configuration has no signals, data, routines or targets.
- Every point is checked before anything moves. The robot executes a prefix of the commanded
  points; it is shorter only with a reported reason and point.
- No message is longer than 1,024 bytes: a ROS-Industrial node crashes on one.
- A topic has reply_code 0: a ROS-Industrial node drops the connection otherwise.
- HELLO goes to the state port, where abb_driver reads nothing. The reply comes between the
  topics; PROGRESS follows only on a connection that subscribed to it.
"""

_LISTED = [m.name for m in messages.MESSAGES if m.sender == "client" and m.ports == (Port.CONTROL,)]
_CONTROL = f"{', '.join(_LISTED[:-1])} and {_LISTED[-1]}"
_STREAMS = f"""\
## Streams

- A `fixed` is an int32 of steps of 1e-6 s, rad or m: magnitudes up to {spec.FIXED_LIMIT}. It
  cannot be NaN.
- A point is its duration and its joints. A message holds {messages.batch_points(6)} points of six
  axes, {messages.batch_points(10)} of ten.
- The checksum goes over the int32 words of the data before it, `stream` being the first: `c := 0`,
  then for each word `c := (2 * c + word + 2^31) MOD (2^31 - 19)`. Also eleven words at a time, the
  points of ten axes, are whole numbers below 2^44, which a RAPID dnum holds exactly (to 2^52).
- BEGIN belongs to a first batch, whose `first` is 0; it replaces the current trajectory, as
  sequence -1 does, and it belongs to its connection. Nothing follows END. A batch without points
  asks for the reply, and may carry END or FLUSH.
- A client sends no more points than `room` of the last reply, at the beginning than `ring` of
  HELLO. A point given to the planner frees a place: `accepted` may always grow to
  `planned` + `ring`, for `planned` of a reply and of PROGRESS alike. `first` is the number of
  points that the driver has accepted.
- Motion begins when `preload` seconds are buffered, or the ring is full, or after END or FLUSH.
- A batch with a wrong checksum, a length that does not fit, a gap or more points than `room` is
  refused as a whole. At a fault in one point those before it are accepted. Either way the stream
  is cut: accepted points are executed in order, the last as a stop point, then it has FAILED with
  the reason and the point. Later batches of this stream are answered with the same refusal.
- Without a next point the robot stops at the last one, on its path: STARVED. It resumes when
  `preload` seconds are buffered again, or END or FLUSH arrived.

## Control connection

If HELLO reports a control port, STOP, {_CONTROL} have a connection of
their own, which no point delays. STOP is JOINT_TRAJ_PT with the sequence number -4 there too; its
reply confirms the stop, STOPPED gives the position of the robot. PAUSE keeps the path;
every event that halts a motion halts a paused one. No motion restarts by itself.
"""

_PROGRAMS = """\
## Programs

A program counts among the trajectories: it has a number and PROGRESS, and the same events halt
it. If HELLO reports PROGRAMS, a PROGRAM carries a batch of instructions as POINTS carries
points, with the same rules for BEGIN, END, `first`, checksum, `room` and order. In addition:

- Its words are int32. The first batch begins with the position of the robot, a word for each joint:
  the client has checked the program from there, and elsewhere it does not start (START_TOO_FAR).
- An instruction has a first word, a whole number: its kind, and a bit for each value that it
  changes. These values follow and stay in force until changed; then come the operands. All other
  words are `fixed`. The first instruction sets speed and zone.
- With WHOLE in every batch the driver checks the whole program: nothing moves before END, and
  the driver accepts or refuses all of it. It may have as many instructions as the ring holds.
  Otherwise the robot moves as soon as the first batch is accepted, and a prefix is executed.
- A move to a pose also contains the joints at its end: the driver asks the controller for their
  pose, and refuses one more than 1 mm or 0.2 degrees away (POSE_MISMATCH;
  `pose_tolerance` of the configuration may allow more). The driver checks the limits of the
  joints, and the controller computes the configuration from them.
- A circle begins where the move before ends. Two of its points closer than 0.1 mm, or seen from
  the first one less than 1 degree apart, and more than 240 degrees are refused (NO_CIRCLE): a
  controller would end the program there.
- Without a next instruction the robot stops at the end of the last received one (STARVED).

{}"""


def protocol_markdown() -> str:
    """Return the whole page."""
    parts = [
        _INTRODUCTION,
        _frame(),
        _enum_section("comm_type", spec.Comm),
        _enum_section("reply_code", spec.ReplyCode),
        _ports(),
        "## Messages\n\n" + _overview(),
        *(_message(message) for message in messages.MESSAGES),
        _reserved(),
        _RULES,
        _STREAMS,
        _programs(),
        _enum_section("Special sequence numbers", spec.Sequence),
        _enum_section("Tri-states", spec.TriState),
        _enum_section("Modes", spec.Mode),
        _enum_section("Bits of valid_fields", spec.Valid),
        _enum_section("Bits of features and subscribe", spec.Feature),
        _enum_section("Flags of POINTS", spec.StreamFlag),
        _enum_section("Types of events", spec.EventType),
        _enum_section("Trajectory states", spec.TrajectoryState),
        _reasons(),
        _versions(),
    ]
    return "\n".join(parts)


def _table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def _frame() -> str:
    rows = [
        (0, "length", "int32", f"bytes that follow: {spec.MIN_LENGTH} to {spec.MAX_LENGTH}"),
        (4, "msg_type", "int32", "number of the message"),
        (8, "comm_type", "int32", "communication type"),
        (12, "reply_code", "int32", "0 in topics and requests"),
        (16, "data", "", "by message type"),
    ]
    return "## Frame\n\n" + _table(("byte", "field", "type", "meaning"), rows)


def _enum_section(title: str, members: type[IntEnum] | type[IntFlag]) -> str:
    rows = [(int(member), member.name) for member in members]
    return f"## {title}\n\n" + _table(("value", "name"), rows)


def _ports() -> str:
    rows = [(int(port), port.name.lower()) for port in spec.Port]
    text = "Further motion groups add 10 each, unless the configuration says otherwise.\n"
    return "## Ports\n\n" + _table(("port", "name"), rows) + "\n" + text


def _overview() -> str:
    rows = [
        (
            message.number,
            message.name,
            message.sender,
            ", ".join(port.name.lower() for port in message.ports),
            message.length if message.is_fixed else f"{message.length} and more",
            message.since or "standard",
        )
        for message in messages.MESSAGES
    ]
    return _table(("number", "name", "sender", "ports", "length field", "since version"), rows)


def _message(message: MessageType) -> str:
    text = f"### {message.number} {message.name}\n\n{message.text}\n"
    if message.fields:
        text += "\n" + _fields(message.fields)
    for reply in message.replies:
        when = f": {reply.when}" if reply.when else ""
        text += f"\nReply, {reply.code.name.lower()}{when}."
        text += "\n\n" + _fields(reply.fields) if reply.fields else " No data.\n"
    return text


def _fields(fields: Sequence[Field]) -> str:
    rows = []
    more = ""
    at = spec.PREFIX_BYTES + spec.HEADER_BYTES
    for field in fields:
        count = "n" if field.count == ANY else str(field.count)
        kind = field.type.value if count == "1" else f"{count} x {field.type.value}"
        rows.append((f"{at}{more}", field.name, kind, field.unit, field.text))
        at += field.size
        if field.count == ANY:
            more = f" + {field.type.size} n"
    return _table(("byte", "field", "type", "unit", "meaning"), rows)


def _programs() -> str:
    rows = [
        *((int(i), i.name, text) for i, text in OPERANDS.items()),
        *((f"+ {int(m)}", m.name, text) for m, text in MODALS.items()),
    ]
    return _PROGRAMS.format(_table(("first word", "name", "words after it"), rows))


def _reserved() -> str:
    standard = _table(("number", "name"), [(number, name) for name, number in spec.RESERVED])
    ranges = _table(("from", "to", "vendor"), [(a, b, name) for name, a, b in spec.VENDOR_RANGES])
    return (
        "## Numbers of others\n\nStandard messages that no ABB driver speaks:\n\n"
        f"{standard}\nRanges of the vendors:\n\n{ranges}"
    )


def _reasons() -> str:
    rows = [(int(reason), reason.name, reason.text) for reason in spec.Reason]
    return (
        "## Reasons\n\nWhy a trajectory was refused (1 to 39) or ended early (40 and above). "
        "STATUS carries reason + 100 x joint number in error_code (joint 0: none), so 203 is "
        "reason 3 at joint 2.\n\n" + _table(("reason", "name", "meaning"), rows)
    )


def _new(version: int) -> str:
    return ", ".join(m.name for m in messages.MESSAGES if m.since == version)


def _versions() -> str:
    rows = [
        ("1", f"{_new(1)}, data in the replies to an end frame", "none"),
        (
            "2",
            f"{_new(2)}; HELLO on the control port; JOINT_FEEDBACK; reasons 15 to 19 and 27, "
            "states 7 and 8",
            "the reply to HELLO is longer: a driver refuses a client of version 1, a client of "
            "version 2 a driver of version 1",
        ),
        (
            "3",
            f"{_new(3)}, if HELLO reports PROGRAMS; reasons 28 to 38, 50 to 52",
            "values and checksum of POINTS are int32, no number of eight bytes is left; refused as "
            "between 1 and 2",
        ),
        (
            "4",
            "reason 53: while a server task of the driver does not run, motion_possible is 0 and "
            "every motion is refused",
            "no layout of a message; refused as between 1 and 2",
        ),
    ]
    return (
        "## Versions\n\nHELLO carries it; client and driver must have the same. The standard "
        "messages have none and do not change.\n\n" + _table(("version", "new", "breaks"), rows)
    )


if __name__ == "__main__":
    sys.stdout.write(protocol_markdown())
