"""The configuration file as pydantic models: names, types, ranges and the words of the reference.

Units are ABB's: degrees, mm, mm/s, kg, s. `build.py` turns them into the SI model. Every field
is optional here where a shipped model or a URDF may supply it; what is missing in the end is
said by `build.py`.
"""

import re
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, WithJsonSchema

from rapidgen.config.tree import Number

ZONES = ("fine", *(f"z{n}" for n in (0, 1, 5, 10, 15, 20, 30, 40, 50, 60, 80, 100, 150, 200)))
ROBOT_AXES = tuple(f"rax_{n}" for n in range(1, 7))
EXTERNAL_AXES = tuple(f"eax_{c}" for c in "abcdef")

Identifier = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_]{0,31}$")]
GroupName = Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]{0,11}$")]
Port = Annotated[int, Field(ge=1025, le=65535)]
Vector = Annotated[list[float], Field(min_length=3, max_length=3)]
Quaternion = Annotated[list[float], Field(min_length=4, max_length=4)]
Text = Annotated[str, Field(max_length=2000)]


def _robotware(value: object) -> object:
    """6, 6.10 and "6.15.03" to (main version, minor version)."""
    text = value.text if isinstance(value, Number) else value
    if isinstance(text, bool) or not isinstance(text, str | int | float):
        raise ValueError("write a RobotWare version such as 6.15")
    if not re.fullmatch(r"[0-9]{1,3}(\.[0-9]{1,5}){0,4}", str(text)):
        raise ValueError("write a RobotWare version such as 6.15")
    main, _, rest = str(text).partition(".")
    version = int(main), int(rest.partition(".")[0] or 0)
    if not (5, 15) <= version < (9, 0):
        raise ValueError("RobotWare 5.15 to 8 is supported")
    return version


RobotWare = Annotated[
    Any,
    BeforeValidator(_robotware),
    WithJsonSchema({"anyOf": [{"type": "number"}, {"type": "string"}]}),
]


class _Part(BaseModel):
    model_config = ConfigDict(
        strict=True,
        extra="forbid",
        frozen=True,
        allow_inf_nan=False,
        defer_build=True,  # one validator for the whole, not one more for each part
    )


class Controller(_Part):
    """The controller and its software."""

    type: Literal["irc5", "irc5_compact", "omnicore", "virtual"] = Field(
        "irc5",
        description="Controller family. `virtual` is for a robot that exists nowhere; it takes "
        "every RobotWare.",
    )
    robotware: RobotWare = Field(
        (6, 15), description="RobotWare version, 5.15 to 8; 6.10 is read as written, not as 6.1."
    )


Figure = Literal["lower", "upper", "speed", "acceleration", "axis", "sign", "offset"]


class Joint(_Part):
    """One joint: which controller axis it drives and what that axis can do.

    Controller value = sign x URDF value + offset. Limits and speeds are those of the
    controller's axis, as ABB's data sheets give them.
    """

    axis: Literal[ROBOT_AXES + EXTERNAL_AXES] | None = Field(  # type: ignore[valid-type]
        None, description="`rax_1`..`rax_6` or `eax_a`..`eax_f`."
    )
    unit: Literal["deg", "mm"] | None = Field(
        None, description="`deg` for a turning, `mm` for a linear axis."
    )
    lower: float | None = Field(None, description="Lower limit, deg or mm.")
    upper: float | None = Field(None, description="Upper limit, deg or mm.")
    speed: float | None = Field(None, gt=0, description="Largest speed, deg/s or mm/s.")
    acceleration: float | None = Field(
        None,
        gt=0,
        description="Acceleration for planning and simulation, deg/s² or mm/s²; without it, "
        "`acceleration_time` decides.",
    )
    sign: Literal[1, -1] | None = Field(
        None, description="-1 when the URDF turns against the controller's axis."
    )
    offset: float | None = Field(
        None, description="Controller value where the URDF says 0, deg or mm."
    )
    source: Text | None = Field(None, description="Where the figures come from.")
    unsure: list[Figure] = Field([], description="Figures without a sure source; a build says so.")


class ChainStep(_Part):
    """One step of the kinematic chain, from the base to the flange."""

    joint: str = Field("", description="Joint that turns or slides here; none: a fixed step.")
    xyz: Vector = Field([0.0, 0.0, 0.0], description="Shift before the joint, mm.")
    rpy: Vector = Field(
        [0.0, 0.0, 0.0], description="Rotation before the joint about fixed x, y, z, deg."
    )
    axis: Vector = Field([0.0, 0.0, 1.0], description="Axis of the joint.")
    follows: dict[str, float] = Field(
        {},
        description="For a passive step: its value is the sum of factor x joint (a palletiser's "
        "wrist, a hollow wrist).",
    )


class Frame(_Part):
    """A position with an orientation."""

    position: Vector = Field([0.0, 0.0, 0.0], description="x, y, z in mm.")
    orientation: Quaternion = Field(
        [1.0, 0.0, 0.0, 0.0], description="Quaternion q1..q4, q1 the scalar."
    )


class Load(_Part):
    """What the tool weighs."""

    mass: float = Field(0.0, ge=0, description="kg")
    centre: Vector = Field([0.0, 0.0, 0.0], description="Centre of gravity, mm.")
    axes: Quaternion = Field(
        [1.0, 0.0, 0.0, 0.0], description="Orientation of the axes of inertia."
    )
    inertia: Vector = Field([0.0, 0.0, 0.0], description="Moments ix, iy, iz, kg m².")


class Tool(_Part):
    """The tool that the driver moves with. Another name than tool0 declares that tooldata."""

    name: Identifier = Field("tool0", description="Name of the tooldata.")
    held: bool = Field(True, description="False: a stationary tool.")
    frame: Frame = Field(default_factory=Frame, description="TCP in the flange's frame.")
    load: Load = Field(default_factory=Load, description="Load of the tool.")


class WorkObject(_Part):
    """The work object. Another name than wobj0 declares that wobjdata."""

    name: Identifier = Field("wobj0", description="Name of the wobjdata.")
    held: bool = Field(False, description="True: the robot holds the work object.")
    user_frame: Frame = Field(default_factory=Frame, description="User frame in the world.")
    object_frame: Frame = Field(
        default_factory=Frame, description="Object frame in the user frame."
    )


class Ports(_Part):
    """TCP ports of one group. Defaults: 11000, 11001, 11002, and 10 more for each next group."""

    motion: Port | None = Field(None, description="Trajectories and stop.")
    control: Port | None = Field(None, description="The paired client's own connection.")
    state: Port | None = Field(None, description="Joint positions and status.")


class Urdf(_Part):
    """A robot description. Meshes are never opened; ROS is not needed."""

    file: str = Field(description="URDF or xacro file, relative to this file.")
    macro: str | None = Field(None, description="Macro to call when the file only defines macros.")
    macro_args: dict[str, str | int | float | bool] = Field(
        {}, description="Arguments of that macro; `prefix` is empty without one."
    )
    args: dict[str, str | int | float | bool] = Field(
        {}, description="xacro arguments; only those that the file declares."
    )
    packages: dict[str, str] = Field(
        {}, description="ROS package: folder, for `$(find PACKAGE)`; relative to this file."
    )
    tip: str | None = Field(
        None, description="Last link (or joint) of this group, when the file holds several robots."
    )
    ignore_joints: list[str] = Field([], description="Joints that the controller does not move.")


class GroupKeys(_Part):
    """One motion task with its mechanical unit; a file with one group may write these at its top."""

    model: str | None = Field(None, description="A shipped model (`rapidgen robots`).")
    urdf: Urdf | None = Field(None, description="Robot description to read joints from.")
    task: Identifier | None = Field(
        None, description="Motion task; `T_ROB1` for the first group without one."
    )
    mechanical_unit: Identifier | None = Field(
        None, description="Mechanical unit of the robot; `ROB_1` for the first group."
    )
    external_units: list[Identifier] = Field(
        [], max_length=6, description="Mechanical units of the external axes."
    )
    joints: dict[str, Joint] = Field(
        {},
        description="Joint name: its axis. The order is the order on the wire; at most 10.",
    )
    acceleration_time: float = Field(
        0.25,
        gt=0,
        le=10,
        description="Seconds from standstill to full speed, for axes without an acceleration. "
        "ABB publishes none: a choice of ours.",
    )
    chain: list[ChainStep] = Field([], description="Kinematic chain from the base to the flange.")
    coupling: float | None = Field(
        None,
        ge=-1,
        le=1,
        description="k in `controller axis 3 = J3 + k x J2`; 0 for a serial robot, 1 for IRB 2400.",
    )
    tool: Tool = Field(default_factory=Tool, description="Tool of the moves.")
    work_object: WorkObject = Field(
        default_factory=WorkObject, description="Work object of the moves."
    )
    tcp_speed_limit: float = Field(
        5000.0, gt=0, le=10000, description="Ceiling of the tool's speed, mm/s."
    )
    ports: Ports = Field(default_factory=Ports, description="TCP ports.")
    source: dict[Literal["limits", "speeds", "chain", "coupling", "mapping"], Text] = Field(
        {}, description="Where the group's figures come from."
    )
    unsure: list[Literal["chain", "coupling", "mapping"]] = Field(
        [], description="Parts without a sure source; a build says so."
    )


class Trajectory(_Part):
    """What the motion server accepts."""

    capacity: int = Field(
        1000, ge=2, le=100000, description="Points of one trajectory; more are refused whole."
    )
    zone: Literal[ZONES] = Field(  # type: ignore[valid-type]
        "z10", description="Zone of the points between the first and the last."
    )
    start_tolerance: float = Field(
        0.5, gt=0, le=20, description="Distance of the first point from the robot, deg."
    )
    start_tolerance_linear: float = Field(
        5.0, gt=0, le=100, description="The same for linear axes, mm."
    )
    too_fast: Literal["refuse", "slow_down"] = Field(
        "refuse", description="What happens to a segment that an axis cannot follow."
    )
    min_segment: float = Field(
        0.1, ge=0.01, le=2, description="Shortest segment that streaming accepts, s."
    )
    approach_speed: float = Field(
        0.1,
        gt=0,
        le=1,
        description="Fraction of the axis speeds for an approach to the first point.",
    )


class State(_Part):
    """The state server."""

    rate: float = Field(10.0, ge=0.2, le=100, description="Messages a second, Hz.")


class Network(_Part):
    """Who may talk to the driver."""

    bind: str = Field(
        "lan",
        pattern=r"^(lan|service|[0-9]{1,3}(\.[0-9]{1,3}){3})$",
        description="`lan` (the controller's LAN address), `service` (192.168.125.1) or an "
        "IPv4 address.",
    )
    allowed_clients: list[str] = Field(
        [], max_length=16, description="IPv4 addresses that may connect; empty: all."
    )
    receive_timeout: float = Field(
        0.0,
        ge=0,
        le=3600,
        description="Seconds without a byte inside a message after which a client is dropped; "
        "0: never.",
    )


class Signal(_Part):
    """A signal that a client may read or write."""

    kind: Literal["DI", "DO", "GI", "GO", "AI", "AO"] = Field(description="Type of the signal.")
    access: Literal["read", "write"] = Field(
        "read", description="`write` is for outputs (DO, GO, AO) only."
    )


class Configuration(_Part):
    """A controller with its motion groups."""

    name: Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_-]{0,39}$")] | None = Field(
        None, description="Name of the robot; the file's name without one."
    )
    description: Text = Field("", description="For people.")
    model: str | None = Field(None, description="A shipped model that this file starts from.")
    generations: list[Literal[5, 6, 7, 8]] = Field(
        [], description="RobotWare generations that the robot exists for; empty: not known."
    )
    controller: Controller = Field(
        default_factory=Controller, description="Controller and software."
    )
    groups: dict[GroupName, GroupKeys] = Field(
        {}, description="Motion groups by name; for one group its keys may stand at the top."
    )
    trajectory: Trajectory = Field(
        default_factory=Trajectory, description="What the motion server accepts."
    )
    state: State = Field(default_factory=State, description="The state server.")
    network: Network = Field(default_factory=Network, description="Who may talk to the driver.")
    commissioning: bool = Field(
        False,
        description="True while setting up: background tasks are NORMAL and can be stopped and "
        "edited, instead of SEMISTATIC.",
    )
    main: Literal["driver", "own"] = Field(
        "driver",
        description="`driver`: the module brings `main`. `own`: your `main` calls the driver's "
        "entry routine.",
    )
    signals: dict[Identifier, Signal] = Field(
        {}, max_length=64, description="Signals to expose, by name."
    )


GROUP_KEYS = tuple(GroupKeys.model_fields)
TOP_KEYS = tuple(Configuration.model_fields)
