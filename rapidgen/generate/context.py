"""Names for templates, in RAPID's units (deg, mm, s) and literals."""

import math
import re
from collections.abc import Iterable
from dataclasses import asdict

from rapidgen import __version__
from rapidgen.axes.mapping import JointMap
from rapidgen.config.model import (
    GroupConfig,
    Joint,
    KeptAxis,
    Load,
    Payload,
    Placement,
    RobotConfig,
    Tool,
    UserRoutine,
    WorkObject,
    WorldZone,
)
from rapidgen.generate import layout
from rapidgen.generate.hello_reply import hello_reply
from rapidgen.generate.lint import MAX_LINE
from rapidgen.generate.numbers import inward, literal
from rapidgen.generate.parameters import REMOTE_ADDRESS, UDP_SECTIONS
from rapidgen.generate.status import STATUS_SIGNALS
from rapidgen.wire.simple_message import messages, rapid, spec
from rapidgen.wire.simple_message.instructions import MOST_SIGNALS
from rapidgen.wire.simple_message.spec import MOST_ARGUMENTS, ReplyCode

HEARTBEAT_SINCE = (7, 7)
"""RobotWare from which RAPID receives data of the EGM partner."""
# Frames of a program's own values, before a program sets any.
_OWN_TOOL = Tool("ROS_own_tool", load=Load(1.0, (0.0, 0.0, 0.001)))
_OWN_WORK_OBJECT = WorkObject("ROS_own_wobj")
# Clients that the state port serves at a time.
STATE_CLIENTS = 3
# A multiple of every ring's size within the integers that a num counts exactly, 2^23 [K §2.13].
WRAP = 2**22
_HEADER_AND_PREFIX = spec.PREFIX_BYTES + spec.HEADER_BYTES
# Slack for the rounding to single on the wire.
_SPEED_MARGIN = 1.001
_DEFAULT_TCP_SPEED = 5.0
# Part of an axis' acceleration that a tight corner may use: ABB publishes none, so those of the
# configuration are estimates.
_TURN_SHARE = 0.3
_MM = 1000.0
# deg of rotation allowed for each mm of a pose's tolerance.
_TURN_PER_MM = 0.2
# Axes of a kind share one component of a corner's zone.
_SUMS = (
    {"name": "robot_speed_sum", "field": "zone_ori", "least": "MIN_ZONE_DEG"},
    {"name": "axis_speed_sum", "field": "zone_reax", "least": "MIN_ZONE_DEG"},
    {"name": "linear_speed_sum", "field": "zone_leax", "least": "MIN_ZONE_MM"},
)
# The driver believes the controller's movement report for this time, s, and this number of
# messages.
_BELIEF = 10.0
_BELIEF_MESSAGES = 5
# The driver writes no event for these reasons.
_ON_THE_WIRE_ALONE = {spec.Reason.NONE, spec.Reason.SUPERSEDED, spec.Reason.POWER_FAILURE}
# Numbers of a robtarget on the wire: in m, and without a unit.
_TARGET_PARTS = (
    *((f"trans.{axis}", " / 1000") for axis in "xyz"),
    *((f"rot.q{n}", "") for n in range(1, 5)),
    *((f"robconf.{name}", "") for name in ("cf1", "cf4", "cf6", "cfx")),
)
_FACTORS = (
    {"name": "ROS_DEG", "value": "57.29578", "text": "Factor from rad to deg."},
    {"name": "ROS_MM", "value": "1000", "text": "Factor from m to mm."},
)


def group_context(config: RobotConfig, group: GroupConfig, build_id: str) -> dict[str, object]:
    """Return the context of one group's modules, without `used_constants`."""
    x = layout.suffix(config, group)
    joints = [_joint(config, group, n) for n in range(1, len(group.joints) + 1)]
    roles = layout.roles(config, group)
    payload = _payload(group.payload)
    exposed = _exposed(config)
    return {
        "name": config.name,
        "group": group.name,
        "task": group.task,
        "version": __version__,
        "build": build_id,
        "x": x,
        "tasks": [
            {"role": role.name, "task": layout.task_name(config, group, role)} for role in roles
        ],
        "one_build": {role.name: _one_build(role) for role in roles},
        "factors": [f for f in _FACTORS if any(j["factor"] == f["name"] for j in joints)],
        "ring": config.trajectory.ring,
        "wrap": WRAP,
        "joints": joints,
        "sums": [s for s in _SUMS if any(j["sum"] == s["name"] for j in joints)],
        "robax": _robot_axes(group),
        "extax": _external_axes(group),
        "kept": [_kept(config, axis) for axis in group.kept],
        "absent": list(range(len(joints) + 1, spec.MAX_JOINTS + 1)),
        "signals": [
            {
                "name": layout.signal_name(config, group, signal),
                "constant": f"NAME_{signal.function.upper()}",
                "variable": f"do_{signal.function}",
                "known": f"has_{signal.function}",
                "function": signal.function,
                "text": signal.text,
                "by_routines": signal.by_routines,
                "doubted": signal.one_when_well and signal.is_open(config.robotware[0]),
            }
            for signal in STATUS_SIGNALS
        ],
        "ports": asdict(group.ports),
        "capacity": config.trajectory.capacity,
        "zone": config.trajectory.zone,
        "tight": _tight(config, group),
        "min_segment": config.trajectory.min_segment,
        **_near(config.trajectory.pose_tolerance),
        "approach": config.trajectory.approach_speed,
        "slow_down": config.trajectory.too_fast == "slow_down",
        "commissioning": config.commissioning,
        "full": config.profile == "full",
        # The motion server asks for the pose of joints.
        "calculates": config.profile == "full" or group.tcp_speed_limit < _DEFAULT_TCP_SPEED,
        # Without its geometry no client can compute the joints of a pose.
        "cartesian": bool(group.chain),
        "two_sided": JointMap.of(group).two_sided,
        "state_period": config.state_period,
        "belief": max(_BELIEF, _BELIEF_MESSAGES * config.state_period),
        "tcp_speed": group.tcp_speed_limit * _MM,
        "tcp_check": group.tcp_speed_limit < _DEFAULT_TCP_SPEED,
        "receive_timeout": config.receive_timeout,
        "bind": config.bind,
        "allowed": config.allowed_clients,
        "call_main": config.call_main,
        "tool": _tool(group.tool),
        "payload": payload,
        "wobj": _work_object(group.work_object),
        **_frames(group),
        "tload": f" \\TLoad:={payload['name']}" if payload["with_moves"] else "",
        # A clock counts microseconds only on newer controllers [mem].
        "high_res": " \\HighRes" if config.robotware[0] >= 6 else "",
        # UnpackRawBytes has no \ASCII on RobotWare 7; for PackRawBytes there is no source.
        "text_by_bytes": config.robotware[0] >= 7,
        "slots": STATE_CLIENTS + 1,
        "feedback_wrap": literal(spec.FEEDBACK_WRAP),
        "status_at": messages.JOINT_POSITION.length + spec.PREFIX_BYTES + 1,
        "hello": hello_reply(config, group, build_id),
        **_streams(config, joints),
        "exposed": exposed,
        # Programs set these, or wait for them.
        "used_signals": [s for s in exposed if s["is_set"] or str(s["kind"])[0] != "A"],
        "sets_signals": any(signal["is_set"] for signal in exposed),
        "routines": _routines(group),
        "data": _data(group),
        "data_reply": messages.DATA.reply(ReplyCode.SUCCESS).length,
        "most_arguments": MOST_ARGUMENTS,
        "max_robtargets": _most(group, "robtarget"),
        "max_jointtargets": _most(group, "jointtarget"),
        # Some routine returns a target.
        "target_results": any(
            p.inout and p.type.endswith("target") for r in group.routines for p in r.parameters
        ),
        "target_parts": _TARGET_PARTS,
        "target_reply": messages.TARGET.reply(ReplyCode.SUCCESS).length,
        "result_reply": messages.RESULT.reply(ReplyCode.SUCCESS).length,
        "max_trigg_events": MOST_SIGNALS,
        "egm": _egm(config, group),
        "world_zones": [_world_zone(n, zone) for n, zone in enumerate(group.world_zones, 1)],
        "busy": _busy(group),
        "heartbeat_reply": messages.HEARTBEAT.reply(ReplyCode.SUCCESS).length,
        "signal_reply": messages.SIGNAL.reply(ReplyCode.SUCCESS).length,
    }


def _world_zone(number: int, zone: WorldZone) -> dict[str, object]:
    """Return a World Zone in mm, with the arguments of its definition."""
    values = [literal(round(value * _MM, 4)) for value in zone.values]
    names = {
        "box": (
            ("LOW", "[" + ",".join(values[:3]) + "]"),
            ("HIGH", "[" + ",".join(values[3:]) + "]"),
        ),
        "cylinder": (("BASE", "[" + ",".join(values[:3]) + "]"),),
        "sphere": (("CENTRE", "[" + ",".join(values[:3]) + "]"),),
    }[zone.kind]
    constants = [{"name": f"ZONE_{number}_{part}", "value": value} for part, value in names]
    sizes = [] if zone.kind == "box" else values[3:]
    return {
        "datum": f"zone_{number}",
        "name": zone.name,
        "keep": zone.keep,
        "kind": zone.kind,
        "define": {"box": "WZBoxDef", "cylinder": "WZCylDef", "sphere": "WZSphDef"}[zone.kind],
        # The robot must not be in the volume of the shape.
        "side": "Inside" if zone.keep == "out" else "Outside",
        "constants": constants,
        "arguments": ", ".join([*(str(c["name"]) for c in constants), *sizes]),
    }


def _egm(config: RobotConfig, group: GroupConfig) -> dict[str, object] | None:
    """Return the settings of externally guided motion in RAPID's units."""
    egm = group.egm
    if egm is None:
        return None
    return {
        "address": egm.address,
        "port": egm.port,
        "device": egm.device,
        "section": UDP_SECTIONS[config.robotware[0] >= 7],
        "attribute": REMOTE_ADDRESS[config.robotware[0] >= 7],
        "unit": group.mechanical_unit,
        "ranges": " ".join(f"\\J{n}:=AT_TARGET" for n in range(1, len(group.joints) + 1)),
        "axes": " ".join(f"\\J{n}" for n in range(1, len(group.joints) + 1)),
        "max_deviation": literal(round(math.degrees(egm.max_deviation), 4)),
        "max_speed": literal(round(math.degrees(egm.max_speed), 4)),
        "filter": literal(egm.filter),
        "ramp": literal(egm.ramp),
        "stop_ramp": literal(egm.stop_ramp),
        "timeout": literal(egm.timeout),
        "idle_timeout": literal(egm.idle_timeout),
        "feedback": egm.feedback,
        # \\DataFromSensor [manual 3HAC073318, revisions].
        "heartbeat": config.robotware >= HEARTBEAT_SINCE,
        "reply": messages.EGM.reply(ReplyCode.SUCCESS).length,
    }


def _busy(group: GroupConfig) -> str:
    """Return the condition under which no other motion may take the place of the active one."""
    conditions = ["ROS_is_guided()"] * bool(group.egm) + ["ROS_is_in_routine()"] * bool(
        group.routines
    )
    return f"({' OR '.join(conditions)})" if len(conditions) > 1 else "".join(conditions)


def _near(tolerance: float) -> dict[str, str]:
    """Return the tolerance of a pose: mm, and the cosine of half an angle."""
    angle = math.radians(_TURN_PER_MM * tolerance * _MM)
    return {"near": literal(tolerance * _MM), "unturned": literal(round(math.cos(angle / 2), 6))}


def _frames(group: GroupConfig) -> dict[str, object]:
    """Return tools and work objects by number; a program's own come last."""
    tools = [_tool(tool, n) for n, tool in enumerate((group.tool, *group.tools))]
    wobjs = [
        _work_object(wobj, n) for n, wobj in enumerate((group.work_object, *group.work_objects))
    ]
    if group.chain:
        tools.append(_tool(_OWN_TOOL))
        wobjs.append(_work_object(_OWN_WORK_OBJECT))
    return {"tools": tools, "wobjs": wobjs}


def _tight(config: RobotConfig, group: GroupConfig) -> bool:
    """True if corners have individual sizes.

    They need the TCP's speed, so the group's geometry.
    """
    policy = config.trajectory
    return policy.corners == "tight" and policy.zone != "fine" and bool(group.chain)


def _one_build(role: layout.TaskRole) -> list[str]:
    """Return the constants that must equal ROS_BUILD_ID in a task."""
    return [_build_constant(module) for module in role.modules if module != layout.COMMON]


def _build_constant(module: str) -> str:
    """Return the constant of a module.

    ROS_motionServer: ROS_BUILD_MOTION_SERVER.
    """
    return "ROS_BUILD_" + re.sub(r"(?<=[a-z])(?=[A-Z])", "_", module.removeprefix("ROS_")).upper()


def _streams(config: RobotConfig, joints: list[dict[str, object]]) -> dict[str, object]:
    """Return the layout of point batches for RAPID."""
    return {
        "preload": config.trajectory.preload,
        "words": messages.point_values(len(joints)),
        "weighted": _weighted(messages.point_values(len(joints))),
        "batch_head": _HEADER_AND_PREFIX + 16,
        "steps": spec.FIXED_SCALE,
        "units": {joint["factor"] for joint in joints},
        "deg_step": repr(math.degrees(1 / spec.FIXED_SCALE)).upper(),
        "mm_step": literal(_MM / spec.FIXED_SCALE),
        "points_accepted": messages.POINTS.reply(ReplyCode.SUCCESS).length,
        "points_refused": messages.POINTS.reply(ReplyCode.FAILURE).length,
    }


def _weighted(words: int) -> list[str]:
    """Return the checksum terms of a point's words, in line-sized pieces."""
    terms = [f"{2 ** (words - n)} * word_{n}" for n in range(1, words)]
    terms.append(f"word_{words}")
    return [" + ".join(terms[at : at + 6]) for at in range(0, words, 6)]


def _exposed(config: RobotConfig) -> list[dict[str, object]]:
    """Return the signals of SIGNAL, by number."""
    return [
        {
            "n": n,
            "name": signal.name,
            "kind": signal.kind,
            "access": signal.access,
            "is_set": signal.access == "write" and signal.kind[1] == "O",
            "reader": signal.kind[0] + ("Input" if signal.kind[1] == "I" else "Output"),
        }
        for n, signal in enumerate(config.signals, 1)
    ]


_FORMS = {
    # For a parameter's type: its RAPID variable, and its reader.
    "num": ("numbers{{{}}}", "read_num"),
    "bool": ("flag_{}", "read_bool"),
    "string": ("texts{{{}}}", "read_text"),
    "robtarget": ("robtargets{{{}}}", "read_robtarget"),
    "jointtarget": ("jointtargets{{{}}}", "read_jointtarget"),
}


def _routines(group: GroupConfig) -> list[dict[str, object]]:
    """Return the user's procedures and functions, by number."""
    return [_routine(routine, n) for n, routine in enumerate(group.routines, 1)]


def _routine(routine: UserRoutine, n: int) -> dict[str, object]:
    module, _, procedure = routine.call.rpartition(":")
    result = len(routine.parameters) + 1
    answers = [k for k, p in enumerate(routine.parameters, 1) if p.inout and p.type == "bool"] + [
        result
    ] * (routine.returns == "bool")
    return {
        "n": n,
        "name": routine.name,
        "call": routine.call,
        "module": module,
        "procedure": procedure,
        "returns": routine.returns,
        "result": _FORMS[routine.returns][0].format(result) if routine.returns else "",
        "answers": answers,
        "parameters": [
            {
                "n": k,
                "type": parameter.type,
                "place": _place(routine, k),
                "reader": _FORMS[parameter.type][1],
                "argument": _FORMS[parameter.type][0].format(_place(routine, k)),
            }
            for k, parameter in enumerate(routine.parameters, 1)
        ],
    }


def _place(routine: UserRoutine, k: int) -> int:
    """Return the place of a parameter's value, among those of its kind."""
    kind = routine.parameters[k - 1].type
    if kind in ("robtarget", "jointtarget"):
        return sum(parameter.type == kind for parameter in routine.parameters[:k])
    return k


def _most(group: GroupConfig, kind: str) -> int:
    """Return the maximum number of parameters of a kind in one routine."""
    counts = (sum(p.type == kind for p in routine.parameters) for routine in group.routines)
    return max(counts, default=0)


def _data(group: GroupConfig) -> list[dict[str, object]]:
    """Return the user's data, by number.

    A name has no module, as in GetDataVal.
    """
    return [
        {
            "n": n,
            "name": datum.name.partition(":")[2],
            "module": datum.name.partition(":")[0],
            "type": datum.type,
            "is_set": datum.access == "write",
        }
        for n, datum in enumerate(group.data)
    ]


def used_constants(texts: Iterable[str]) -> dict[str, object]:
    """Return the wire constants that some text names, in specified order.

    Also the driver's reasons, with their texts.
    """
    words: set[str] = set()
    for text in texts:
        words.update(re.findall(r"\bROS_[A-Z_]+\b", text))
    constants: list[dict[str, object]] = [
        {"name": constant.name, "value": constant.value, "type": constant.type}
        for constant in rapid.rapid_constants()
        if constant.name in words
    ]
    return {"constants": constants, "reasons": _reasons(constants)}


def _reasons(constants: list[dict[str, object]]) -> list[dict[str, str]]:
    """Return the reasons in the driver's event log, with their texts."""
    known = {constant["name"] for constant in constants}
    named = [(f"ROS_REASON_{r.name}", r.text) for r in spec.Reason if r not in _ON_THE_WIRE_ALONE]
    return [{"name": name, "text": text} for name, text in named if name in known]


def to_rapid(joint: Joint, value: float) -> float:
    """Convert rad to deg, m to mm."""
    return math.degrees(value) if joint.kind == "revolute" else value * _MM


def _speed_sum(part: str, revolute: bool) -> str:
    """Return the name of the sum of speeds to which an axis belongs (`_SUMS`)."""
    if not revolute:
        return "linear_speed_sum"
    return "robot_speed_sum" if part == "robax" else "axis_speed_sum"


def _joint(config: RobotConfig, group: GroupConfig, n: int) -> dict[str, object]:
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
        "sum": _speed_sum(part, revolute),
        "turn": literal(round(to_rapid(joint, joint.acceleration) * _TURN_SHARE, 4)),
        "lower": literal(joint.lower),
        "upper": literal(joint.upper),
        "arm": layout.arm(group, joint),
        "tolerance": literal(round(to_rapid(joint, tolerance), 4)),
        "factor": "ROS_DEG" if revolute else "ROS_MM",
        "step": "DEG_PER_STEP" if revolute else "MM_PER_STEP",
    }


def _robot_axes(group: GroupConfig) -> list[str]:
    """Return the members of a robjoint: joint variables or fixed values."""
    joints = {joint.axis: f"joint_{n}" for n, joint in enumerate(group.joints, 1)}
    return [joints.get(f"rax_{n}", f"ROS_fixed_axis_{n}") for n in range(1, 7)]


def _external_axes(group: GroupConfig) -> list[str]:
    """Return the members of an extjoint: joint variables or 9E9."""
    joints = {joint.axis: f"joint_{n}" for n, joint in enumerate(group.joints, 1)}
    return [joints.get(f"eax_{letter}", "9E9") for letter in "abcdef"]


def _kept(config: RobotConfig, axis: KeptAxis) -> dict[str, object]:
    """Return the context of a robot axis without a joint."""
    return {
        "n": int(axis.axis[-1]),
        "field": f"robax.{axis.axis}",
        "at": literal(round(math.degrees(axis.value), 4)) if axis.must_stand else "",
        "tolerance": literal(round(math.degrees(config.trajectory.start_tolerance), 4)),
    }


def data_of_another(group: GroupConfig) -> list[tuple[str, str, str]]:
    """Return (type, name, value) of data that a user module declares."""
    data = (
        *(("tooldata", _tool(tool)) for tool in (group.tool, *group.tools)),
        *(("wobjdata", _work_object(wobj)) for wobj in (group.work_object, *group.work_objects)),
        ("loaddata", _payload(group.payload)),
    )
    return [(kind, str(d["source"]), str(d["value"])) for kind, d in data if d["source"]]


def tool_literal(tool: Tool) -> str:
    """Return a tool as RAPID's tooldata."""
    return f"[{_bool(tool.held)},{_frame(tool.frame)},{load_literal(tool.load)}]"


def work_object_literal(wobj: WorkObject) -> str:
    """Return a work object as RAPID's wobjdata."""
    return f'[{_bool(wobj.held)},TRUE,"",{_frame(wobj.user_frame)},{_frame(wobj.object_frame)}]'


def load_literal(load: Load) -> str:
    """Return a load as RAPID's loaddata."""
    inertia = ",".join(literal(v) for v in load.inertia)
    return f"[{literal(load.mass)},{_list(load.centre, _MM)},{_list(load.axes)},{inertia}]"


def _tool(tool: Tool, number: int = 0) -> dict[str, object]:
    kind, value = f"tool_{number}" if number else "tool", tool_literal(tool)
    return _datum(tool.name, kind, tool.name != "tool0", value, elsewhere=tool.elsewhere)


def _work_object(wobj: WorkObject, number: int = 0) -> dict[str, object]:
    kind, value = f"wobj_{number}" if number else "wobj", work_object_literal(wobj)
    return _datum(wobj.name, kind, wobj.name != "wobj0", value, elsewhere=wobj.elsewhere)


def _payload(payload: Payload) -> dict[str, object]:
    named = payload.name != "load0"
    value = "[0.001,[0,0,0.001],[1,0,0,0],0,0,0]"
    datum = _datum(payload.name, "load", named, value, elsewhere=named)
    return datum | {"with_moves": named and payload.with_moves}


def _datum(
    name: str, kind: str, declared: bool, value: str, *, elsewhere: bool
) -> dict[str, object]:
    """Return the context of a datum in the generated modules.

    `source` is the datum of another module that it copies.
    """
    return {
        "name": f"{kind}_now" if elsewhere else name,
        "source": name if elsewhere else "",
        "declared": declared,
        "value": _in_lines(value, len(f"    TASK PERS tooldata {name} := ;")),
    }


def _in_lines(value: str, in_use: int) -> str:
    """Return a record's value after `in_use` characters, split at commas."""
    lines, space = [""], MAX_LINE - in_use
    for part in re.findall("[^,]+,?", value):
        if len(lines[-1]) + len(part) > space:
            lines.append("        ")
            space = MAX_LINE - 1
        lines[-1] += part
    return "\n".join(lines)


def _bool(value: bool) -> str:
    return "TRUE" if value else "FALSE"


def _list(values: tuple[float, ...], factor: float = 1.0) -> str:
    return "[" + ",".join(literal(v * factor) for v in values) + "]"


def _frame(frame: Placement) -> str:
    return f"[{_list(frame.position, _MM)},{_list(frame.orientation)}]"
