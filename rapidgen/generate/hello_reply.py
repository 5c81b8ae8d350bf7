"""Contents of the driver's HELLO reply: identity, features, limits."""

import re

from rapidgen import __version__
from rapidgen.config.model import GroupConfig, RobotConfig
from rapidgen.generate.numbers import literal
from rapidgen.wire.simple_message import messages, spec
from rapidgen.wire.simple_message.declaration import Wire
from rapidgen.wire.simple_message.mapping import mapping_hash
from rapidgen.wire.simple_message.spec import Feature, ReplyCode


def features(config: RobotConfig, group: GroupConfig) -> Feature:
    """Return the features of a group's driver beyond the standard messages."""
    result = Feature.PROGRESS
    if config.profile == "basic":
        return result
    result |= Feature.STREAMING | Feature.EVENTS | Feature.FEEDBACK | Feature.PROGRAMS
    if group.ports.control:
        result |= Feature.CONTROL
        if config.signals:
            result |= Feature.SIGNALS
        if group.egm is not None:
            result |= Feature.EGM
    return result


def hello_reply(config: RobotConfig, group: GroupConfig, build_id: str) -> dict[str, object]:
    """Return the HELLO reply as pack instructions, in specified order.

    The first nonzero value of a field has its `label`, for readers of the module.
    """
    joints = group.joints
    policy, streams = config.trajectory, config.profile == "full"
    numbers = range(1, len(joints) + 1)
    filled = ["0"] * (spec.MAX_JOINTS - len(joints))
    values: dict[str, list[str]] = {
        "protocol": [str(spec.PROTOCOL_VERSION)],
        "driver": re.findall(r"\d+", __version__)[:3],
        "build_id": [f'"{build_id}"'],
        "mapping": [
            '"'
            + mapping_hash(
                ((j.name, j.axis, j.kind, j.sign, j.offset) for j in joints), group.coupling
            )
            + '"'
        ],
        "features": [str(int(features(config, group)))],
        "capacity": ["ROS_CAPACITY"],
        "joint_count": [str(len(joints))],
        "prismatic": [str(sum(1 << i for i, j in enumerate(joints) if j.kind == "prismatic"))],
        "state_period": [literal(config.state_period)],
        "min_segment": [literal(policy.min_segment)],
        "start_tolerance": [literal(policy.start_tolerance)],
        "start_tolerance_linear": [literal(policy.start_tolerance_linear)],
        "lower": [*(f"ROS_lower{{{n}}}" for n in numbers), *filled],
        "upper": [*(f"ROS_upper{{{n}}}" for n in numbers), *filled],
        "speed": [*(literal(j.speed) for j in joints), *filled],
        "control_port": [str(group.ports.control)],
        # One place of the ring stays free.
        "ring": [str(policy.ring - 1 if streams else 0)],
        "preload": [literal(policy.preload if streams else 0)],
        "batch": [str(messages.batch_points(len(joints)) if streams else 0)],
        "signals": [str(len(config.signals) if group.ports.control else 0)],
    }
    forms = {
        Wire.INT32: "PackRawBytes {}, data, {} \\IntX:=DINT",
        Wire.FLOAT32: "PackRawBytes {}, data, {} \\Float4",
        Wire.CHAR: "ROS_pack_text {}, data, {}",
    }
    items = []
    offset = spec.PREFIX_BYTES + spec.HEADER_BYTES + 1
    for field in messages.HELLO.reply(ReplyCode.SUCCESS).fields:
        given = values[field.name]
        step = field.size if field.type is Wire.CHAR else field.type.size
        label = field.name.replace("_", " ") + (f", {field.unit}" if field.unit else "")
        if given[0].endswith("{1}"):
            # Limits in force: one after the other, the rest stays zero.
            packed = forms[field.type].format(
                given[0].replace("1", "joint"), f"{offset - step} + {step} * joint"
            )
            items.append({"value": "", "packed": packed, "label": label, "joints": len(joints)})
            offset += field.size
            continue
        for value in given:
            packed = forms[field.type].format(value, offset)
            part = {"value": value, "packed": packed, "label": "", "joints": 0}
            if value != "0":
                part["label"], label = label, ""
            items.append(part)
            offset += step
    return {"length": offset - 1 - spec.PREFIX_BYTES, "parts": items}
