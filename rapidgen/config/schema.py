"""Schema of the configuration file: names, types, ranges, descriptions.

Units are ABB's: degrees, mm, mm/s, kg, s. `build.py` turns them into the SI model. Every field is
optional here if a shipped model or a URDF may supply it; `build.py` reports missing values.
"""

import re
from dataclasses import dataclass, field, fields
from typing import Annotated, Any, ClassVar, Literal, get_args

from rapidgen.config.rules import Rule
from rapidgen.config.yaml_tree import Number

# fmt: off
Axis = Literal[
    "rax_1", "rax_2", "rax_3", "rax_4", "rax_5", "rax_6",
    "eax_a", "eax_b", "eax_c", "eax_d", "eax_e", "eax_f",
]
RobotAxis = Literal["rax_1", "rax_2", "rax_3", "rax_4", "rax_5", "rax_6"]
Figure = Literal["lower", "upper", "speed", "acceleration", "axis", "sign", "offset"]
GroupFigure = Literal[
    "limits", "speeds", "accelerations", "chain", "coupling", "mapping", "tcp_speed_limit",
    "max_payload",
]
Zone = Literal[
    "fine", "z0", "z1", "z5", "z10", "z15", "z20", "z30",
    "z40", "z50", "z60", "z80", "z100", "z150", "z200",
]
# fmt: on
ROBOT_AXES = list(get_args(RobotAxis))
NAME = r"^[A-Za-z][A-Za-z0-9_]{0,31}$"
"""A name of RAPID."""
Identifier = Annotated[str, Rule(pattern=NAME)]
_DATUM = r"^[A-Za-z][A-Za-z0-9_]{0,31}:[A-Za-z][A-Za-z0-9_]{0,31}$"
_PROCEDURE = r"^[A-Za-z][A-Za-z0-9_]{0,31}(:[A-Za-z][A-Za-z0-9_]{0,31})?$"
_GROUP = r"^[a-z][a-z0-9_]{0,11}$"
_CONFIG = r"^[A-Za-z][A-Za-z0-9_-]{0,39}$"
_BIND = r"^(lan|service|[0-9]{1,3}(\.[0-9]{1,3}){3})$"
_DIGITS = r"^[0-9]{1,2}:[0-9]{1,3}$"
DatumName = Annotated[str, Rule(pattern=_DATUM)]
GroupName = Annotated[str, Rule(pattern=_GROUP)]
ConfigName = Annotated[str, Rule(pattern=_CONFIG)]
Port = Annotated[int, Rule(ge=1025, le=65535)]
Vector = Annotated[list[float], Rule(min_length=3, max_length=3)]
Quaternion = Annotated[list[float], Rule(min_length=4, max_length=4)]
Text = Annotated[str, Rule(max_length=2000)]
CfgDigits = Annotated[str, Rule(pattern=_DIGITS)]
_NAMES = "RAPID's names begin with a letter; letters, digits and _ follow, 32 in all"
FORMS = {
    NAME: ("a name of RAPID", _NAMES),
    _DATUM: ("MODULE:NAME", _NAMES),
    _PROCEDURE: ("PROCEDURE or MODULE:PROCEDURE", _NAMES),
    _GROUP: ("the name of a group", "a small letter, then small letters, digits and _, 12 in all"),
    _CONFIG: ("a name for a folder", "a letter, then letters, digits, _ and -, 40 in all"),
    _BIND: ("lan, service or an IPv4 address", "such as 192.168.125.1"),
    _DIGITS: ("two numbers with a colon", 'such as "6:0", from the first line of a saved cfg'),
}
"""Each pattern of the schema in words, and its allowed parts."""


def _robotware(value: object) -> object:
    """Convert 6, 6.10 and "6.15.03" to (main version, minor version)."""
    text = value.text if isinstance(value, Number) else value
    if isinstance(text, bool) or not isinstance(text, str | int | float):
        raise ValueError("write a RobotWare version such as 6.15")
    if not re.fullmatch(r"[0-9]{1,3}(\.[0-9]{1,5}){0,4}", str(text)):
        raise ValueError("write a RobotWare version such as 6.15")
    main, _, remaining = str(text).partition(".")
    version = int(main), int(remaining.partition(".")[0] or 0)
    if not (5, 15) <= version < (9, 0):
        raise ValueError("RobotWare 5.15 to 8 is supported")
    return version


def _held_axes(value: object) -> object:
    """Convert [rax_5] to {rax_5: None}; {rax_5: 30} stays."""
    return dict.fromkeys(value) if isinstance(value, list) else value


RobotWare = Annotated[
    Any,
    Rule(before=_robotware, json={"anyOf": [{"type": "number"}, {"type": "string"}]}),
]


def _origin() -> list[float]:
    return [0.0, 0.0, 0.0]


def _unturned() -> list[float]:
    return [1.0, 0.0, 0.0, 0.0]


class StrictModel:
    """Base class; pydantic rejects unknown keys."""

    __pydantic_config__: ClassVar[dict[str, Any]] = {"extra": "forbid"}


@dataclass(frozen=True)
class ControllerKeys(StrictModel):
    """The controller and its software."""

    type: Annotated[
        Literal["irc5", "irc5_compact", "omnicore", "virtual"],
        Rule("Controller family. `virtual` is for a robot that exists nowhere; any RobotWare."),
    ] = "irc5"
    robotware: Annotated[
        RobotWare, Rule("RobotWare version, 5.15 to 8; 6.10 is read as written, not as 6.1.")
    ] = (6, 15)
    multimove: Annotated[
        bool,
        Rule("One robot on a controller with MultiMove (604-1): its tasks name a unit group."),
    ] = False
    cfg_header: Annotated[
        dict[Literal["SYS", "EIO", "SIO"], CfgDigits],
        Rule("Digits in the first line of the controller's cfg files, where they are not known."),
    ] = field(default_factory=dict)


@dataclass(frozen=True)
class JointKeys(StrictModel):
    """One joint: which controller axis it drives and what that axis can do.

    Controller value = sign x URDF value + offset. Limits and speeds are those of the
    controller's axis, as ABB's data sheets give them.
    """

    axis: Annotated[Axis | None, Rule("`rax_1`..`rax_6` or `eax_a`..`eax_f`.")] = None
    unit: Annotated[
        Literal["deg", "mm"] | None, Rule("`deg` for a turning, `mm` for a linear axis.")
    ] = None
    lower: Annotated[float | None, Rule("Lower limit, deg or mm.")] = None
    upper: Annotated[float | None, Rule("Upper limit, deg or mm.")] = None
    speed: Annotated[float | None, Rule("Largest speed, deg/s or mm/s.", ge=0.001)] = None
    acceleration: Annotated[
        float | None,
        Rule("Acceleration, deg/s² or mm/s²; without it `acceleration_time` decides.", ge=0.001),
    ] = None
    acceleration_time: Annotated[
        float | None,
        Rule("Seconds from standstill to full speed, instead of `acceleration`.", ge=0.01, le=2.5),
    ] = None
    brake_deceleration: Annotated[
        float | None,
        Rule(
            "Deceleration by the brakes (stop category 0), deg/s² or mm/s²; without it twice the "
            "acceleration.",
            ge=0.001,
        ),
    ] = None
    stop_deceleration: Annotated[
        float | None,
        Rule(
            "Deceleration of a quick stop on the path (stop category 1), deg/s² or mm/s²; without "
            "it twice the acceleration.",
            ge=0.001,
        ),
    ] = None
    sign: Annotated[
        Literal[1, -1] | None, Rule("-1 when the URDF turns against the controller's axis.")
    ] = None
    offset: Annotated[float | None, Rule("Controller value at the URDF's 0, deg or mm.")] = None
    source: Annotated[Text | None, Rule("Source of the figures.")] = None
    unsure: Annotated[
        list[Figure], Rule("Figures without a reliable source; a build reports them.")
    ] = field(default_factory=list)


@dataclass(frozen=True)
class InertiaKeys(StrictModel):
    """How the acceleration of an axis depends on the posture, s²/rad.

    1 / acceleration = constant + elbow e² + wrist w² + cosine cos q3 + sine sin q3, with the
    distances e of axis 3 and w of the wrist's centre from axis 1 in m.
    """

    most: Annotated[float, Rule("Largest acceleration, deg/s².", ge=0.001)]
    constant: Annotated[float, Rule("Constant part, s²/rad.", ge=0)]
    elbow: Annotated[float, Rule("Part by the square of the distance of axis 3, s²/rad/m².")] = 0.0
    wrist: Annotated[float, Rule("The same for the wrist's centre, s²/rad/m².")] = 0.0
    cosine: Annotated[float, Rule("Part by the cosine of axis 3, s²/rad.")] = 0.0
    sine: Annotated[float, Rule("Part by the sine of axis 3, s²/rad.")] = 0.0


@dataclass(frozen=True)
class ChainStepKeys(StrictModel):
    """One step of the kinematic chain, from the base to the flange."""

    joint: Annotated[str, Rule("Joint of this step; none: a fixed step.")] = ""
    xyz: Annotated[Vector, Rule("Shift before the joint, mm.")] = field(default_factory=_origin)
    rpy: Annotated[Vector, Rule("Rotation before the joint about fixed x, y, z, deg.")] = field(
        default_factory=_origin
    )
    axis: Annotated[Vector, Rule("Axis of the joint.")] = field(
        default_factory=lambda: [0.0, 0.0, 1.0]
    )
    follows: Annotated[
        dict[str, float], Rule("For a passive step: its value is the sum of factor x joint.")
    ] = field(default_factory=dict)


@dataclass(frozen=True)
class FrameKeys(StrictModel):
    """A position with an orientation."""

    position: Annotated[Vector, Rule("x, y, z in mm.")] = field(default_factory=_origin)
    orientation: Annotated[Quaternion, Rule("Quaternion q1..q4, q1 the scalar.")] = field(
        default_factory=_unturned
    )


@dataclass(frozen=True)
class LoadKeys(StrictModel):
    """What the tool weighs."""

    mass: Annotated[float, Rule("kg", ge=0)] = 0.0
    centre: Annotated[Vector, Rule("Centre of gravity, mm.")] = field(default_factory=_origin)
    axes: Annotated[Quaternion, Rule("Orientation of the axes of inertia.")] = field(
        default_factory=_unturned
    )
    inertia: Annotated[Vector, Rule("Moments ix, iy, iz, kg m².")] = field(default_factory=_origin)


@dataclass(frozen=True)
class ToolDataKeys(StrictModel):
    """A tool: where its TCP is and what it weighs."""

    held: Annotated[bool, Rule("False: a stationary tool.")] = True
    frame: Annotated[FrameKeys, Rule("TCP in the flange's frame.")] = field(
        default_factory=FrameKeys
    )
    load: Annotated[LoadKeys, Rule("Load of the tool.")] = field(default_factory=LoadKeys)


@dataclass(frozen=True)
class ToolKeys(ToolDataKeys):
    """The tool that the driver moves with.

    Another name than tool0 declares that tooldata.
    """

    name: Annotated[Identifier, Rule("Name of the tooldata.")] = "tool0"
    declared: Annotated[
        Literal["here", "elsewhere"],
        Rule(
            "`elsewhere`: a module of yours declares it, `PERS` and global; its value is taken at "
            "the beginning of each trajectory."
        ),
    ] = "here"


@dataclass(frozen=True)
class WorkObjectDataKeys(StrictModel):
    """A work object: where it is."""

    held: Annotated[bool, Rule("True: the robot holds the work object.")] = False
    user_frame: Annotated[FrameKeys, Rule("User frame in the world.")] = field(
        default_factory=FrameKeys
    )
    object_frame: Annotated[FrameKeys, Rule("Object frame in the user frame.")] = field(
        default_factory=FrameKeys
    )


@dataclass(frozen=True)
class WorkObjectKeys(WorkObjectDataKeys):
    """The work object. Another name than wobj0 declares that wobjdata."""

    name: Annotated[Identifier, Rule("Name of the wobjdata.")] = "wobj0"
    declared: Annotated[Literal["here", "elsewhere"], Rule("`elsewhere`: as with the tool.")] = (
        "here"
    )


@dataclass(frozen=True)
class ParameterKeys(StrictModel):
    """A parameter of a routine."""

    name: Annotated[Identifier, Rule("Name of the parameter, for people.")]
    type: Annotated[
        Literal["num", "bool", "string", "robtarget", "jointtarget"],
        Rule("Type; a string has 80 characters."),
    ]
    mode: Annotated[Literal["in", "inout"], Rule("`inout`: its value then is a result.")] = "in"


@dataclass(frozen=True)
class RoutineKeys(StrictModel):
    """A procedure of yours that a program may call, in the motion task."""

    call: Annotated[
        str,
        Rule(
            "`MODULE:PROCEDURE` as late binding finds it; a global one also by its name alone.",
            pattern=_PROCEDURE,
        ),
    ]
    parameters: Annotated[
        list[ParameterKeys], Rule("Its parameters, in their order.", max_length=8)
    ] = field(default_factory=list)
    returns: Annotated[
        Literal["", "num", "bool", "string"],
        Rule(
            "It is a function of this type. It is linked: without it the motion task does not run."
        ),
    ] = ""


@dataclass(frozen=True)
class DatumKeys(StrictModel):
    """A PERS of a module of yours in the motion task, global there, that clients may reach."""

    type: Annotated[Literal["num", "bool", "string"], Rule("Type.")]
    access: Annotated[Literal["read", "write"], Rule("`write`: read and written.")] = "read"


@dataclass(frozen=True)
class PayloadKeys(StrictModel):
    """What the robot carries: loaddata that a module of yours declares, `PERS` and global."""

    name: Annotated[Identifier, Rule("Name of the loaddata; load0: none.")] = "load0"
    given_by: Annotated[
        Literal["GripLoad", "TLoad"],
        Rule("`TLoad`: with each move, where the system parameter ModalPayLoadMode is 0."),
    ] = "GripLoad"


@dataclass(frozen=True)
class PortsKeys(StrictModel):
    """TCP ports of one group.

    Defaults: 11000, 11001, 11002, and 10 more for each next group.
    """

    motion: Annotated[Port | None, Rule("Trajectories and stop.")] = None
    control: Annotated[
        Port | Literal[0] | None,
        Rule("The paired client's own connection, for STOP among others; 0: none."),
    ] = None
    state: Annotated[Port | None, Rule("Joint positions and status.")] = None


@dataclass(frozen=True)
class EgmKeys(StrictModel):
    """Externally guided motion of the group: options 689-1 and 3124-1, RobotWare 6.07 or later."""

    address: Annotated[str, Rule("IPv4 address of the computer that guides the robot.")]
    max_deviation: Annotated[
        float,
        Rule(
            "Largest distance of an axis from its position at the beginning of a session, deg; the "
            "controller itself enforces it.",
            gt=0,
            le=1000,
        ),
    ]
    max_speed: Annotated[
        float,
        Rule("Largest speed of an axis, deg/s; the controller itself enforces it.", gt=0, le=1000),
    ]
    port: Annotated[
        int | None,
        Rule("UDP port of that computer; 6510, and one more for each next group.", ge=1, le=65535),
    ] = None
    device: Annotated[
        Identifier | None,
        Rule("UdpUc device and motion profile that the build declares; `ROS_EGM` without one."),
    ] = None
    filter: Annotated[
        float, Rule("Low-pass filter of the references, Hz; 0: none.", ge=0, le=100)
    ] = 20.0
    gain: Annotated[float, Rule("Gain of the position, 1/s.", gt=0, le=20)] = 5.0
    ramp: Annotated[
        float,
        Rule("Seconds at the beginning until the robot follows completely.", ge=0.5, le=10),
    ] = 0.5
    stop_ramp: Annotated[
        float, Rule("Seconds from a stop until the robot stands.", ge=0.005, le=1)
    ] = 0.2
    timeout: Annotated[
        float,
        Rule("Seconds without a sign of the client until the robot is stopped.", ge=0.05, le=1),
    ] = 0.5
    idle_timeout: Annotated[
        float,
        Rule("Seconds at the target after which a session ends by itself.", ge=1, le=86400),
    ] = 600.0
    feedback: Annotated[
        bool, Rule("Positions at 250 Hz during trajectories, too; nothing is guided then.")
    ] = False


@dataclass(frozen=True)
class UrdfKeys(StrictModel):
    """A robot description.

    Its meshes are for the page alone; ROS is not needed.
    """

    file: Annotated[str, Rule("URDF or xacro file, relative to this file.")]
    macro: Annotated[str | None, Rule("Macro to call when the file only defines macros.")] = None
    macro_args: Annotated[
        dict[str, str | int | float | bool],
        Rule("Arguments of that macro; `prefix` is empty, `parent` is world without one."),
    ] = field(default_factory=dict)
    args: Annotated[
        dict[str, str | int | float | bool],
        Rule("xacro arguments; only those that the file declares."),
    ] = field(default_factory=dict)
    packages: Annotated[
        dict[str, str], Rule("ROS package: folder, for `$(find PACKAGE)`; relative to this file.")
    ] = field(default_factory=dict)
    tip: Annotated[
        str | None, Rule("Last link (or joint) of this group, when the file holds several robots.")
    ] = None
    ignore_joints: Annotated[list[str], Rule("Joints that the controller does not move.")] = field(
        default_factory=list
    )


@dataclass(frozen=True)
class GroupKeys(StrictModel):
    """One motion task with its mechanical unit; for one group these may stand at the top."""

    model: Annotated[str | None, Rule("A shipped model (`rapidgen robots`).")] = None
    urdf: Annotated[UrdfKeys | None, Rule("Robot description to read joints from.")] = None
    task: Annotated[
        Identifier | None, Rule("Motion task; `T_ROB1` for the first group without one.")
    ] = None
    mechanical_unit: Annotated[
        Identifier | None, Rule("Mechanical unit of the robot; `ROB_1` for the first group.")
    ] = None
    external_units: Annotated[
        list[Identifier], Rule("Mechanical units of the external axes.", max_length=6)
    ] = field(default_factory=list)
    joints: Annotated[
        dict[str, JointKeys],
        Rule("Joint name: its axis. The order is the order on the wire; at most 10."),
    ] = field(default_factory=dict)
    held_axes: Annotated[
        dict[RobotAxis, float | None],
        Rule(
            "Robot axes without a joint: `[rax_5]` is held at its position when a trajectory is "
            "accepted; `{rax_5: 30}` requires that position, deg.",
            before=_held_axes,
            json={
                "anyOf": [
                    {"type": "array", "items": {"enum": ROBOT_AXES}},
                    {
                        "type": "object",
                        "propertyNames": {"enum": ROBOT_AXES},
                        "additionalProperties": {"type": "number"},
                    },
                ]
            },
        ),
    ] = field(default_factory=dict)
    acceleration_time: Annotated[
        float | None,
        Rule(
            "Seconds from standstill to full speed, for axes without `acceleration`; without it "
            "0.07 s for axes 4 to 6, and 0.1 s (reach 0.9 m) to 0.25 s (2.55 m) for the others.",
            ge=0.01,
            le=2.5,
        ),
    ] = None
    inertias: Annotated[
        dict[RobotAxis, InertiaKeys],
        Rule("Axes whose acceleration depends on the posture, measured on this robot."),
    ] = field(default_factory=dict)
    chain: Annotated[list[ChainStepKeys], Rule("Kinematic chain from the base to the flange.")] = (
        field(default_factory=list)
    )
    positioners: Annotated[
        dict[str, list[ChainStepKeys]],
        Rule("External unit that carries work objects: its chain, from where the robot's begins."),
    ] = field(default_factory=dict)
    coupling: Annotated[
        float | None,
        Rule(
            "k in `controller axis 3 = J3 + k x J2`; 0 for a serial robot, 1 for IRB 2400.",
            ge=-1,
            le=1,
        ),
    ] = None
    max_payload: Annotated[
        float | None,
        Rule("What the robot can carry, tool included, kg; a load beyond it is reported.", gt=0),
    ] = None
    tool: Annotated[ToolKeys, Rule("Tool of the moves.")] = field(default_factory=ToolKeys)
    payload: Annotated[PayloadKeys, Rule("What the robot carries.")] = field(
        default_factory=PayloadKeys
    )
    work_object: Annotated[WorkObjectKeys, Rule("Work object of the moves.")] = field(
        default_factory=WorkObjectKeys
    )
    tools: Annotated[list[ToolKeys], Rule("Further tools, for motion programs.", max_length=16)] = (
        field(default_factory=list)
    )
    work_objects: Annotated[
        list[WorkObjectKeys], Rule("Further work objects, for motion programs.", max_length=16)
    ] = field(default_factory=list)
    routines: Annotated[
        dict[Identifier, RoutineKeys], Rule("Procedures of yours that clients may call, by name.")
    ] = field(default_factory=dict)
    data: Annotated[
        dict[DatumName, DatumKeys],
        Rule(
            "PERS of yours that clients may read and write, by `MODULE:NAME`.",
            max_length=64,
        ),
    ] = field(default_factory=dict)
    tcp_speed_limit: Annotated[
        float, Rule("Ceiling of the tool's speed, mm/s; at least 10.", gt=0, le=10000)
    ] = 5000.0
    ports: Annotated[PortsKeys, Rule("TCP ports.")] = field(default_factory=PortsKeys)
    egm: Annotated[EgmKeys | None, Rule("Externally guided motion; without it there is none.")] = (
        None
    )
    world_zones: Annotated[
        Text,
        Rule(
            "Cell file whose zones the controller supervises as World Zones (option 608-1), for "
            "the TCP only; in this file's folder or below."
        ),
    ] = ""
    source: Annotated[
        dict[GroupFigure, Text],
        Rule("Source of the group's figures."),
    ] = field(default_factory=dict)
    unsure: Annotated[
        list[Literal["chain", "coupling", "mapping", "tcp_speed_limit", "max_payload"]],
        Rule("Parts without a reliable source; a build reports them."),
    ] = field(default_factory=list)


@dataclass(frozen=True)
class TrajectoryKeys(StrictModel):
    """What the motion server accepts."""

    capacity: Annotated[
        int, Rule("Points of one trajectory; more are refused whole.", ge=2, le=100000)
    ] = 1000
    zone: Annotated[Zone, Rule("Zone of the points between the first and the last, at most.")] = (
        "z50"
    )
    corners: Annotated[
        Literal["zone", "tight"],
        Rule("Corners as small as the axes follow (known geometry only), or as large as `zone`."),
    ] = "tight"
    start_tolerance: Annotated[
        float, Rule("Distance of the first point from the robot, deg.", ge=0.001, le=20)
    ] = 0.5
    start_tolerance_linear: Annotated[
        float, Rule("The same for linear axes, mm.", ge=0.001, le=100)
    ] = 5.0
    pose_tolerance: Annotated[
        float,
        Rule(
            "Distance of a program's pose from what its joints reach on the controller, mm: more "
            "for a calibrated robot.",
            ge=0.1,
            le=20,
        ),
    ] = 1.0
    too_fast: Annotated[
        Literal["refuse", "slow_down"],
        Rule("What happens to a segment that an axis cannot follow."),
    ] = "refuse"
    min_segment: Annotated[
        float,
        Rule(
            "Shortest segment, s, but for a trajectory's last: shorter is refused.", ge=0.01, le=2
        ),
    ] = 0.1
    approach_speed: Annotated[
        float,
        Rule("Fraction of the axis speeds for an approach to the first point.", ge=0.001, le=1),
    ] = 0.1
    ring: Annotated[
        Literal[64, 128, 256, 512],
        Rule("Points between the server and the motion task: how far ahead a stream may be."),
    ] = 128
    preload: Annotated[
        float, Rule("Seconds of a stream that are there before the robot moves.", ge=0, le=10)
    ] = 0.5


@dataclass(frozen=True)
class StateKeys(StrictModel):
    """The state server."""

    rate: Annotated[
        float,
        Rule("Messages a second, Hz. Above 100 the controller may not keep up.", ge=0.2, le=250),
    ] = 10.0


@dataclass(frozen=True)
class NetworkKeys(StrictModel):
    """Who may talk to the driver."""

    bind: Annotated[
        str,
        Rule(
            "`lan` (the controller's LAN address), `service` (192.168.125.1) or an IPv4 address.",
            pattern=_BIND,
        ),
    ] = "lan"
    allowed_clients: Annotated[
        list[str], Rule("IPv4 addresses that may connect; empty: all.", max_length=16)
    ] = field(default_factory=list)
    receive_timeout: Annotated[
        float,
        Rule(
            "Seconds without a byte inside a message after which a client is dropped; 0: never.",
            ge=0,
            le=3600,
        ),
    ] = 0.0


@dataclass(frozen=True)
class SignalKeys(StrictModel):
    """A signal that a client may read or write."""

    kind: Annotated[Literal["DI", "DO", "GI", "GO", "AI", "AO"], Rule("Type of the signal.")]
    access: Annotated[
        Literal["read", "write"], Rule("`write` is for outputs (DO, GO, AO) only.")
    ] = "read"


@dataclass(frozen=True)
class ConfigurationKeys(StrictModel):
    """A controller with its motion groups."""

    name: Annotated[ConfigName | None, Rule("Name of the robot; the file's name without one.")] = (
        None
    )
    description: Annotated[Text, Rule("For people.")] = ""
    model: Annotated[str | None, Rule("A shipped model that this file starts from.")] = None
    generations: Annotated[
        list[Literal[5, 6, 7, 8]],
        Rule("RobotWare generations that the robot exists for; empty: not known."),
    ] = field(default_factory=list)
    controller: Annotated[ControllerKeys, Rule("Controller and software.")] = field(
        default_factory=ControllerKeys
    )
    groups: Annotated[
        dict[GroupName, GroupKeys],
        Rule("Motion groups by name; the keys of a single group may be at the top."),
    ] = field(default_factory=dict)
    trajectory: Annotated[TrajectoryKeys, Rule("What the motion server accepts.")] = field(
        default_factory=TrajectoryKeys
    )
    state: Annotated[StateKeys, Rule("The state server.")] = field(default_factory=StateKeys)
    network: Annotated[NetworkKeys, Rule("Who may talk to the driver.")] = field(
        default_factory=NetworkKeys
    )
    commissioning: Annotated[
        bool, Rule("True while setting up: background tasks are NORMAL, not SEMISTATIC.")
    ] = False
    profile: Annotated[
        Literal["full", "basic"],
        Rule(
            "`full`: also streams, a control connection, events and feedback for the paired "
            "client. `basic`: none of them, and less RAPID."
        ),
    ] = "full"
    main: Annotated[
        Literal["driver", "own"],
        Rule("`driver`: the module brings `main`. `own`: your `main` calls the entry routine."),
    ] = "driver"
    signals: Annotated[
        dict[Identifier, SignalKeys], Rule("Signals to expose, by name.", max_length=64)
    ] = field(default_factory=dict)


GROUP_KEYS = tuple(f.name for f in fields(GroupKeys))
TOP_KEYS = tuple(f.name for f in fields(ConfigurationKeys))
