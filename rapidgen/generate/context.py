"""The names that templates see, all in RAPID's units (deg, mm, s) and as RAPID literals."""

import math
import re
from dataclasses import asdict
from pathlib import Path

from rapidgen import __version__
from rapidgen.config.model import Frame, Joint, Load, MotionGroup, RobotConfig, Tool, WorkObject
from rapidgen.generate import layout
from rapidgen.generate.numbers import inward, literal
from rapidgen.protocol import rapid, spec
from rapidgen.protocol.mapping import mapping_hash
from rapidgen.protocol.spec import Feature, ReplyCode, Wire

RING = 128
# Clients that the state port serves at a time.
STATE_CLIENTS = 3
# A multiple of the ring's size within the integers that a num counts exactly, 2^23 [K §2.13].
WRAP = 2**22
FEATURES = Feature.PROGRESS | Feature.EVENTS | Feature.FEEDBACK
_HEADER_AND_PREFIX = spec.PREFIX_BYTES + spec.HEADER_BYTES
# Speed that rounding to single on the way must not push a point over.
_SPEED_MARGIN = 1.001
_DEFAULT_TCP_SPEED = 5.0
_MM = 1000.0
_FACTORS = (
    {"name": "ROS_DEG", "value": "57.29578", "text": "rad to deg"},
    {"name": "ROS_MM", "value": "1000", "text": "m to mm"},
)


def group_context(
    config: RobotConfig, group: MotionGroup, build_id: str, templates: Path
) -> dict[str, object]:
    """What the modules of one motion group are rendered from."""
    x = layout.suffix(config, group)
    joints = [_joint(config, group, n) for n in range(1, len(group.joints) + 1)]
    constants = used_constants(templates)
    roles = [
        {"role": role.name, "task": layout.task_name(config, group, role)} for role in layout.ROLES
    ]
    return {
        "name": config.name,
        "group": group.name,
        "task": group.task,
        "version": __version__,
        "build": build_id,
        "x": x,
        "tasks": roles,
        "constants": constants,
        "reasons": _reasons(constants),
        "factors": [f for f in _FACTORS if any(j["factor"] == f["name"] for j in joints)],
        "ring": RING,
        "wrap": WRAP,
        "joints": joints,
        "robax": _axes(group, [f"rax_{n}" for n in range(1, 7)], "0"),
        "extax": _axes(group, [f"eax_{c}" for c in "abcdef"], "9E9"),
        "padding": _padding(len(joints)),
        "signals": [
            {
                "name": layout.signal_name(config, group, signal),
                "constant": f"NAME_{signal.function.upper()}",
                "variable": f"do_{signal.function}",
                "known": f"has_{signal.function}",
                "function": signal.function,
                "text": signal.text,
            }
            for signal in layout.STATUS_SIGNALS
        ],
        "ports": asdict(group.ports),
        "capacity": config.trajectory.capacity,
        "zone": config.trajectory.zone,
        "min_segment": config.trajectory.min_segment,
        "approach": config.trajectory.approach_speed,
        "slow_down": config.trajectory.too_fast == "slow_down",
        "state_period": config.state_period,
        "tcp_speed": group.tcp_speed_limit * _MM,
        "tcp_check": group.tcp_speed_limit < _DEFAULT_TCP_SPEED,
        "receive_timeout": config.receive_timeout,
        "bind": config.bind,
        "allowed": config.allowed_clients,
        "call_main": config.call_main,
        "tool": _tool(group.tool),
        "wobj": _work_object(group.work_object),
        "head_point": spec.JOINT_TRAJ_PT.length + (spec.JOINT_TRAJ_PT.number << 32),
        # A clock counts microseconds only on newer controllers [mem].
        "high_res": " \\HighRes" if config.robotware[0] >= 6 else "",
        "slots": STATE_CLIENTS + 1,
        "feedback_wrap": literal(spec.FEEDBACK_WRAP),
        "status_at": spec.JOINT_POSITION.length + spec.PREFIX_BYTES + 1,
        "hello": _hello(config, group, build_id),
    }


def used_constants(templates: Path) -> list[dict[str, object]]:
    """Constants of the wire that some template names, in the order of the specification."""
    words: set[str] = set()
    for path in sorted(templates.glob("ROS_*.j2")):
        words.update(re.findall(r"\bROS_[A-Z_]+\b", path.read_text(encoding="utf-8")))
    return [
        {"name": constant.name, "value": constant.value, "type": constant.type}
        for constant in rapid.rapid_constants()
        if constant.name in words
    ]


def _reasons(constants: list[dict[str, object]]) -> list[dict[str, str]]:
    """Reasons that the driver can give, with their texts."""
    known = {constant["name"] for constant in constants}
    named = [(f"ROS_REASON_{reason.name}", text) for reason, text in spec.REASON_TEXTS.items()]
    return [{"name": name, "text": text} for name, text in named if name in known]


def to_rapid(joint: Joint, value: float) -> float:
    """rad to deg, m to mm."""
    return math.degrees(value) if joint.kind == "revolute" else value * _MM


def _joint(config: RobotConfig, group: MotionGroup, n: int) -> dict[str, object]:
    joint = group.joints[n - 1]
    policy = config.trajectory
    revolute = joint.kind == "revolute"
    part = "robax" if joint.axis.startswith("rax") else "extax"
    tolerance = policy.start_tolerance if revolute else policy.start_tolerance_linear
    return {
        "n": n,
        "name": joint.name,
        "axis": joint.axis,
        "unit": "deg" if revolute else "mm",
        "field": f"{part}.{joint.axis}",
        "low": literal(inward(to_rapid(joint, joint.lower), up=True)),
        "high": literal(inward(to_rapid(joint, joint.upper), up=False)),
        "speed": literal(round(to_rapid(joint, joint.speed) * _SPEED_MARGIN, 4)),
        "lower": literal(joint.lower),
        "upper": literal(joint.upper),
        "arm": layout.arm(group, joint),
        "tolerance": literal(round(to_rapid(joint, tolerance), 4)),
        "factor": "ROS_DEG" if revolute else "ROS_MM",
    }


def _axes(group: MotionGroup, names: list[str], absent: str) -> list[str]:
    """Members of a robjoint or extjoint: the variable of each joint, `absent` where is none."""
    joints = {joint.axis: f"joint_{n}" for n, joint in enumerate(group.joints, 1)}
    return [joints.get(name, absent) for name in names]


def _padding(joints: int) -> dict[str, object]:
    """Offsets from the first byte of a point at which joints that are not there are read.

    Two float32 at a time, as one 64-bit number; an odd one is last.
    """
    first = _HEADER_AND_PREFIX + 4 + 4 * joints
    missing = spec.MAX_JOINTS - joints
    pairs = [first + 8 * n for n in range(missing // 2)]
    return {"pairs": pairs, "last": first + 4 * (missing - 1) if missing % 2 else 0}


def _hello(config: RobotConfig, group: MotionGroup, build_id: str) -> dict[str, object]:
    """The reply to HELLO as pack instructions, in the order of the specification."""
    joints = group.joints
    policy = config.trajectory
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
        "features": [str(int(FEATURES))],
        "capacity": ["ROS_CAPACITY"],
        "joint_count": [str(len(joints))],
        "prismatic": [str(sum(1 << i for i, j in enumerate(joints) if j.kind == "prismatic"))],
        "state_period": [literal(config.state_period)],
        "min_segment": [literal(policy.min_segment)],
        "start_tolerance": [literal(policy.start_tolerance)],
        "start_tolerance_linear": [literal(policy.start_tolerance_linear)],
        "lower": [*(f"ROS_lower_{n}" for n in numbers), *filled],
        "upper": [*(f"ROS_upper_{n}" for n in numbers), *filled],
        "speed": [*(literal(j.speed) for j in joints), *filled],
        "control_port": ["0"],
        "ring": [str(RING)],
        "preload": ["0"],
        "batch": ["0"],
        "signals": ["0"],
    }
    forms = {Wire.INT32: "\\IntX:=DINT", Wire.FLOAT32: "\\Float4", Wire.CHAR: "\\ASCII"}
    reply = next(r for r in spec.HELLO.replies if r.code is ReplyCode.SUCCESS)
    items = []
    offset = _HEADER_AND_PREFIX + 1
    for field in reply.fields:
        given = values[field.name]
        step = field.size if field.type is Wire.CHAR else field.type.size
        for value in given:
            items.append({"value": value, "offset": offset, "form": forms[field.type]})
            offset += step
    return {"length": offset - 1 - spec.PREFIX_BYTES, "parts": items}


def _tool(tool: Tool) -> dict[str, object]:
    value = f"[{_bool(tool.held)},{_frame(tool.frame)},{_load(tool.load)}]"
    return {"name": tool.name, "declared": tool.name != "tool0", "value": value}


def _work_object(wobj: WorkObject) -> dict[str, object]:
    value = f'[{_bool(wobj.held)},TRUE,"",{_frame(wobj.user_frame)},{_frame(wobj.object_frame)}]'
    return {"name": wobj.name, "declared": wobj.name != "wobj0", "value": value}


def _bool(value: bool) -> str:
    return "TRUE" if value else "FALSE"


def _list(values: tuple[float, ...], factor: float = 1.0) -> str:
    return "[" + ",".join(literal(v * factor) for v in values) + "]"


def _frame(frame: Frame) -> str:
    return f"[{_list(frame.position, _MM)},{_list(frame.orientation)}]"


def _load(load: Load) -> str:
    inertia = ",".join(literal(v) for v in load.inertia)
    return f"[{literal(load.mass)},{_list(load.centre, _MM)},{_list(load.axes)},{inertia}]"
