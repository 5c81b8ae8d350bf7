"""Numbers of the wire as RAPID constants, for the templates."""

from dataclasses import dataclass

from rapidgen.wire.simple_message import messages, spec


@dataclass(frozen=True, slots=True)
class RapidConstant:
    """`CONST <type> <name> := <value>;` with its meaning."""

    name: str
    value: int
    text: str
    type: str = "num"
    """dnum for values in the arithmetic of a checksum."""


def rapid_constants() -> tuple[RapidConstant, ...]:
    """Return every number of the wire as a constant (`ROS_...`).

    The generated modules use these names.
    """
    result = [
        RapidConstant("ROS_HEADER_BYTES", spec.HEADER_BYTES, "bytes of a header"),
        RapidConstant("ROS_MAX_LENGTH", spec.MAX_LENGTH, "largest length field"),
        RapidConstant("ROS_MAX_JOINTS", spec.MAX_JOINTS, "joints of a message"),
        RapidConstant("ROS_PROTOCOL", spec.PROTOCOL_VERSION, "version of messages from 1300 on"),
        RapidConstant("ROS_INDEX_WRAP", spec.INDEX_WRAP, "points of a stream count modulo this"),
        RapidConstant("ROS_CHECKSUM_OFFSET", spec.CHECKSUM_OFFSET, "added to each word", "dnum"),
        RapidConstant("ROS_CHECKSUM_MODULUS", spec.CHECKSUM_MODULUS, "of a checksum", "dnum"),
    ]
    for message in messages.MESSAGES:
        name = message.name
        result.append(RapidConstant(f"ROS_MSG_{name}", message.number, "message type"))
        result.append(RapidConstant(f"ROS_LEN_{name}", message.length, "its length field"))
    result += [RapidConstant(f"ROS_COMM_{c.name}", c, "comm_type") for c in spec.Comm]
    result += [RapidConstant(f"ROS_REPLY_{r.name}", r, "reply_code") for r in spec.ReplyCode]
    result += [RapidConstant(f"ROS_SEQ_{s.name}", s, "special sequence") for s in spec.Sequence]
    result += [RapidConstant(f"ROS_TRI_{t.name}", t, "tri-state") for t in spec.TriState]
    result += [RapidConstant(f"ROS_MODE_{m.name}", m, "operating mode") for m in spec.Mode]
    result += [RapidConstant(f"ROS_VALID_{v.name}", v, "bit of valid_fields") for v in spec.Valid]
    result += [RapidConstant(f"ROS_FEATURE_{f.name}", f, "bit in HELLO") for f in spec.Feature]
    result += [
        RapidConstant(f"ROS_TRAJ_{s.name}", s, "trajectory state") for s in spec.TrajectoryState
    ]
    result += [RapidConstant(f"ROS_STREAM_{f.name}", f, "flag of POINTS") for f in spec.StreamFlag]
    result += [RapidConstant(f"ROS_DO_{i.name}", i, "instruction") for i in spec.Instruction]
    result += [
        RapidConstant(f"ROS_TRIGG_{m.name}", m, "where a signal is set") for m in spec.MarkPlace
    ]
    result += [RapidConstant(f"ROS_SET_{m.name}", m, "before operands") for m in spec.Modal]
    result += [RapidConstant(f"ROS_EVENT_{e.name}", e, "type of an event") for e in spec.EventType]
    result += [RapidConstant(f"ROS_REASON_{r.name}", r, r.text) for r in spec.Reason]
    return tuple(RapidConstant(c.name, int(c.value), c.text, c.type) for c in result)
