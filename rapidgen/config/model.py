"""The checked configuration of one controller: frozen, in SI units.

All packages above `config` read only this. Angles are rad, lengths m, times s unless a name says
otherwise; `limits` are those of the controller's axis (after sign, offset and, for coupled robots,
in ABB's coupled sense), rounded inwards.
"""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from rapidgen.diagnostics import Diagnostic

SPARSE = {"sparse": True}
"""Marks a field that a manifest omits while it is empty: a feature of some robots does not change
the BUILD_ID of the others.
"""
AxisKind = Literal["revolute", "prismatic"]
Generation = Literal[5, 6, 7, 8]


@dataclass(frozen=True, slots=True)
class Joint:
    """One joint: its URDF name and the controller axis that it drives.

    Controller value = sign * URDF value + offset (rad or m). `axis` is `rax_1`..`rax_6` or
    `eax_a`..`eax_f`; `rad`/`m` become deg/mm only in RAPID.
    """

    name: str
    axis: str
    kind: AxisKind
    lower: float
    upper: float
    speed: float
    acceleration: float
    sign: int = 1
    offset: float = 0.0
    source: str = ""
    unsure: bool = False
    brake_deceleration: float = field(default=0.0, metadata=SPARSE)
    """By the brakes (stop category 0); 0: not known."""
    stop_deceleration: float = field(default=0.0, metadata=SPARSE)
    """Of a quick stop on the path (stop category 1); 0: not known."""


@dataclass(frozen=True, slots=True)
class AxisInertia:
    """How the acceleration of an axis depends on the posture; s^2/rad, rad/s^2.

    The inverse of the acceleration is constant + elbow * e^2 + wrist * w^2 + cosine * cos(q3) +
    sine * sin(q3), with the distances e of axis 3 and w of the wrist's centre from axis 1 in m.
    """

    axis: str
    most: float
    constant: float
    elbow: float = 0.0
    wrist: float = 0.0
    cosine: float = 0.0
    sine: float = 0.0


@dataclass(frozen=True, slots=True)
class KeptAxis:
    """A robot axis without a joint, held at its position during motion.

    `must_stand`: the driver accepts motion only if the axis is at `value` (rad); else a simulation
    assumes 0.
    """

    axis: str
    value: float = 0.0
    must_stand: bool = False


@dataclass(frozen=True, slots=True)
class ChainLink:
    """One step of the kinematic chain: fixed transform to the joint, then the joint's axis.

    `xyz` m, `rpy` rad (fixed axes x, y, z as in URDF), `axis` unit vector; `joint` is the
    URDF joint name or empty for a fixed step. A passive step has no joint but `follows`:
    its angle (URDF sense, rad) is the sum of factor * joint, as in a palletiser's wrist.
    """

    joint: str
    xyz: tuple[float, float, float]
    rpy: tuple[float, float, float]
    axis: tuple[float, float, float] = (0.0, 0.0, 1.0)
    follows: tuple[tuple[str, float], ...] = ()


@dataclass(frozen=True, slots=True)
class Load:
    """Mass kg, centre of gravity m, orientation of the axes (q1..q4), inertia kg m2."""

    mass: float = 0.0
    centre: tuple[float, float, float] = (0.0, 0.0, 0.0)
    axes: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)
    inertia: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Placement:
    """Position in m and unit quaternion q1..q4 (q1 the scalar)."""

    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    orientation: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Tool:
    """A tool; `name` is `tool0` or a PERS, of the generated module or another."""

    name: str = "tool0"
    elsewhere: bool = False
    held: bool = True
    frame: Placement = field(default_factory=Placement)
    load: Load = field(default_factory=Load)


@dataclass(frozen=True, slots=True)
class Payload:
    """Payload: loaddata of a user program; load0: not specified."""

    name: str = "load0"
    with_moves: bool = False
    """By \\TLoad of each move, not by GripLoad."""


@dataclass(frozen=True, slots=True)
class RoutineParameter:
    """A parameter of a routine; `inout`: its value is also a result."""

    name: str
    type: Literal["num", "bool", "string", "robtarget", "jointtarget"]
    inout: bool = False


@dataclass(frozen=True, slots=True)
class UserRoutine:
    """A user procedure that a program may call; `call` is its late-bound name.

    One that `returns` a value is a function; a module that calls it must be linked to it.
    """

    name: str
    call: str
    parameters: tuple[RoutineParameter, ...] = ()
    returns: Literal["", "num", "bool", "string"] = field(default="", metadata=SPARSE)


@dataclass(frozen=True, slots=True)
class UserDatum:
    """A user PERS that clients may read, and write if `access` allows it.

    `name` is MODULE:DATUM.
    """

    name: str
    type: Literal["num", "bool", "string"]
    access: Literal["read", "write"] = "read"


@dataclass(frozen=True, slots=True)
class WorkObject:
    """A work object; `name` is `wobj0` or a PERS, of the generated module or another."""

    name: str = "wobj0"
    elsewhere: bool = False
    held: bool = False
    user_frame: Placement = field(default_factory=Placement)
    object_frame: Placement = field(default_factory=Placement)


@dataclass(frozen=True, slots=True)
class Ports:
    """TCP ports of one motion group; `control` 0: no control port."""

    motion: int = 11000
    control: int = 11001
    state: int = 11002


@dataclass(frozen=True, slots=True)
class EgmSettings:
    """Externally guided motion of one group: partner, and what the controller enforces."""

    device: str
    """Name of the UdpUc device, and of the external motion interface data."""
    address: str
    port: int
    max_deviation: float
    """rad from the position at the beginning of a session, each axis."""
    max_speed: float
    """rad/s, each axis."""
    filter: float = 20.0
    """Hz; 0: none."""
    gain: float = 5.0
    """1/s"""
    ramp: float = 0.5
    """s from the beginning until the robot follows completely."""
    stop_ramp: float = 0.2
    """s from a stop until the robot stands."""
    timeout: float = 0.5
    """s without a heartbeat of the client until the robot is stopped."""
    idle_timeout: float = 600.0
    """s at the target after which a session ends."""
    feedback: bool = False
    """Positions are sent during trajectories, too."""


@dataclass(frozen=True, slots=True)
class Positioner:
    """A mechanical unit with work objects: chain from root to user frame.

    Its joints are external axes of the group.
    """

    unit: str
    chain: tuple[ChainLink, ...]


@dataclass(frozen=True, slots=True)
class ExternalUnit:
    """A mechanical unit of external axes, as the cfg of a controller describes it."""

    name: str
    axes: tuple[str, ...]
    """Such as `eax_a`."""
    active: bool = True
    """Active after the start of the controller."""
    may_deactivate: bool = True


@dataclass(frozen=True, slots=True)
class WorldZone:
    """A volume that the controller supervises for the TCP, in its world: m.

    `values`: lowest and highest corner of a box; centre of the lower end, radius and height of a
    vertical cylinder; centre and radius of a sphere.
    """

    name: str
    kind: Literal["box", "cylinder", "sphere"]
    keep: Literal["inside", "out"]
    values: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class GroupConfig:
    """One motion task with its mechanical unit: `joints` in wire order (1 to 10)."""

    name: str
    task: str
    mechanical_unit: str
    joints: tuple[Joint, ...]
    ports: Ports
    model: str = ""
    chain: tuple[ChainLink, ...] = ()
    coupling: float = 0.0
    """Factor k of controller axis 3 = J3 + k * J2 (0: not coupled)."""
    tool: Tool = field(default_factory=Tool)
    payload: Payload = field(default_factory=Payload)
    work_object: WorkObject = field(default_factory=WorkObject)
    tcp_speed_limit: float = 5.0
    """m/s"""
    external_units: tuple[str, ...] = ()
    """Mechanical units of the external axes."""
    units: tuple[ExternalUnit, ...] = field(default=(), metadata=SPARSE)
    """Their axes, if the cfg of a controller gives them."""
    positioners: tuple[Positioner, ...] = field(default=(), metadata=SPARSE)
    tools: tuple[Tool, ...] = field(default=(), metadata=SPARSE)
    """Additional tools for motion programs."""
    work_objects: tuple[WorkObject, ...] = field(default=(), metadata=SPARSE)
    routines: tuple[UserRoutine, ...] = field(default=(), metadata=SPARSE)
    data: tuple[UserDatum, ...] = field(default=(), metadata=SPARSE)
    kept: tuple[KeptAxis, ...] = field(default=(), metadata=SPARSE)
    """Robot axes without a joint."""
    max_payload: float = field(default=0.0, metadata=SPARSE)
    """kg; 0: not known."""
    inertias: tuple[AxisInertia, ...] = field(default=(), metadata=SPARSE)
    """Axes whose acceleration depends on the posture."""
    acceleration_source: str = field(default="", metadata=SPARSE)
    """Where accelerations were measured; empty: they are estimated."""
    egm: EgmSettings | None = field(default=None, metadata=SPARSE)
    """None: the driver has no externally guided motion."""
    world_zones: tuple[WorldZone, ...] = field(default=(), metadata=SPARSE)
    """Volumes that the generated driver gives to the controller (option 608-1)."""
    unit_group: str = field(default="", metadata=SPARSE)
    """Name of the mechanical unit group, if a backup has another than the unit's."""


@dataclass(frozen=True, slots=True)
class TrajectoryPolicy:
    """Acceptance rules of the motion server.

    Tolerances are rad (m for prismatic axes).
    """

    capacity: int = 1000
    zone: str = "z50"
    start_tolerance: float = 0.00873
    start_tolerance_linear: float = 0.005
    pose_tolerance: float = 0.001
    """m between a pose and the pose of its joints on the controller."""
    too_fast: Literal["refuse", "slow_down"] = "refuse"
    min_segment: float = 0.1
    approach_speed: float = 0.1
    """Fraction of the axis speeds for the motion to the first point, if allowed."""
    ring: int = 128
    """Size of the ring between motion server and motion task; one place stays free."""
    preload: float = 0.5
    """s of buffered points of a stream before the robot moves."""
    corners: Literal["zone", "tight"] = "tight"


@dataclass(frozen=True, slots=True)
class ExposedSignal:
    """A signal that the driver exposes to the client."""

    name: str
    kind: Literal["DI", "DO", "GI", "GO", "AI", "AO"]
    access: Literal["read", "write"]


@dataclass(frozen=True, slots=True)
class RobotConfig:
    """One controller with its motion groups."""

    name: str
    path: Path = field(compare=False)
    controller: Literal["irc5", "irc5_compact", "omnicore", "virtual"]
    robotware: tuple[int, int]
    groups: tuple[GroupConfig, ...]
    trajectory: TrajectoryPolicy = field(default_factory=TrajectoryPolicy)
    state_period: float = 0.1
    bind: str = "lan"
    """`lan` (the controller's LAN address), `service`, or an address."""
    allowed_clients: tuple[str, ...] = ()
    receive_timeout: float = 0.0
    commissioning: bool = False
    profile: Literal["basic", "full"] = "full"
    """`basic`: whole trajectories, STOP and state only; no features for the paired client."""
    """Background tasks NORMAL instead of SEMISTATIC, so that they can be stopped and edited."""
    call_main: bool = True
    """False: the motion task's own `main` calls the driver's entry routine."""
    signals: tuple[ExposedSignal, ...] = ()
    multimove: bool = field(default=False, metadata=SPARSE)
    """One robot on a controller with MultiMove; several groups always mean MultiMove."""
    cfg_header: tuple[tuple[str, int, int], ...] = field(default=(), metadata=SPARSE)
    """(domain, digits) in the first line of the controller's cfg files, if given."""
    generations: tuple[Generation, ...] = ()
    """RobotWare generations of the robot; empty: not known."""
    inputs: tuple[tuple[str, bytes], ...] = field(default=(), compare=False)
    """Source texts of the configuration (name, bytes): BUILD_ID hashes them."""
    diagnostics: tuple[Diagnostic, ...] = field(default=(), compare=False)
    """Warnings and notes found while loading, uncertain figures among them."""
