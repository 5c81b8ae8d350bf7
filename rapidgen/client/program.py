"""A motion program: what it consists of, and how it is written down.

    program = Program(speed=0.2).move_joints(here).move_linear(pose, zone="z10")

Joints are URDF values, rad and m; poses are ((x, y, z), (w, x, y, z)) in m, of the tool in the
work object. `robot.check_program` and `robot.run` say whether a robot can do it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import astuple, dataclass
from math import radians
from typing import SupportsFloat, TypeAlias, TypedDict

from rapidgen._compat import Self, Unpack
from rapidgen.axes.frames import Pose
from rapidgen.axes.kinematics import AxisConfiguration
from rapidgen.client.errors import InvalidProgram
from rapidgen.diagnostics import suggest
from rapidgen.wire.simple_message.spec import Instruction, MarkPlace

_MM = 0.001
# What a number is, and what it has to be.
_SPEED = "speed", "m/s of the TCP, or a Speed with all parts: m/s and rad/s"
_LEVEL = "value of a signal", "0 or 1, or a group's or an analog signal's number"
_TIME = "time", "seconds, such as 1.5"
_LENGTH = "length of a pulse", "m, such as 0.01"


def _malformed(message: str, help: str) -> InvalidProgram:
    return InvalidProgram.because("RG670", message, help, exit_code=2)


def _number(value: object, what: str, help: str) -> float:
    """A plain number. Raises InvalidProgram for anything else, texts of numbers too."""
    if isinstance(value, SupportsFloat):
        return float(value)
    raise _malformed(f"{value!r} is no {what}", help)


@dataclass(frozen=True, slots=True)
class Speed:
    """speeddata: of the TCP m/s and its orientation rad/s; of linear m/s and rotary external axes
    rad/s. By default all but the TCP as in RAPID's v100."""

    tcp: float
    orientation: float = radians(500)
    linear: float = 5.0
    rotary: float = radians(1000)

    def __post_init__(self) -> None:
        for value in astuple(self):
            _number(value, *_SPEED)

    @property
    def words(self) -> tuple[float, ...]:
        """In the order of the wire."""
        return astuple(self)


@dataclass(frozen=True, slots=True)
class Zone:
    """zonedata: radii of the TCP, its orientation and external axes, m; of orientation rad, of
    linear m and of rotary external axes rad. `stops`: the robot stops at the end."""

    tcp: float = 0.0
    orientation: float = 0.0
    external: float = 0.0
    angle: float = 0.0
    linear: float = 0.0
    rotary: float = 0.0
    stops: bool = False

    def __post_init__(self) -> None:
        for value in astuple(self):
            _number(value, "radius", "m and rad; `Zone.of(m)` has all that belongs to a radius")

    @classmethod
    def of(cls, radius: float) -> "Zone":
        """As RAPID's predefined ones are made of their radius, m: half as much again, and a tenth
        of that in degrees for each mm."""
        wide = 1.5 * radius
        angle = radians(0.1 * wide / _MM)
        return cls(radius, wide, wide, angle, wide, angle)

    @property
    def words(self) -> tuple[float, ...]:
        """In the order of the wire."""
        *sizes, stops = astuple(self)
        return (float(stops), *sizes)


SLOW = 0.1
"""m/s of the TCP where nobody says more."""
FINE = Zone(stops=True)
# RAPID's predefined zonedata: pzone_tcp, pzone_ori, pzone_eax mm, zone_ori deg, zone_leax mm,
# zone_reax deg (S4 datasys 1-zonedata).
_ZONES = {
    "z0": (0.3, 0.3, 0.3, 0.03, 0.3, 0.03),
    "z1": (1, 1, 1, 0.1, 1, 0.1),
    "z5": (5, 8, 8, 0.8, 8, 0.8),
    "z10": (10, 15, 15, 1.5, 15, 1.5),
    "z15": (15, 23, 23, 2.3, 23, 2.3),
    "z20": (20, 30, 30, 3.0, 30, 3.0),
    "z30": (30, 45, 45, 4.5, 45, 4.5),
    "z40": (40, 60, 60, 6.0, 60, 6.0),
    "z50": (50, 75, 75, 7.5, 75, 7.5),
    "z60": (60, 90, 90, 9.0, 90, 9.0),
    "z80": (80, 120, 120, 12, 120, 12),
    "z100": (100, 150, 150, 15, 150, 15),
    "z150": (150, 225, 225, 23, 225, 23),
    "z200": (200, 300, 300, 30, 300, 30),
}
ZONES: Mapping[str, Zone] = {
    "fine": FINE,
    **{
        name: Zone(a * _MM, b * _MM, c * _MM, radians(d), e * _MM, radians(f))
        for name, (a, b, c, d, e, f) in _ZONES.items()
    },
}
"""RAPID's own, by name."""
SpeedLike: TypeAlias = float | Speed
"""m/s of the TCP, or all parts."""
Argument: TypeAlias = float | bool | str | Pose | Sequence[float]
"""Of a routine: a num, a bool, a string; the pose of a robtarget, the joints of a jointtarget."""
ZoneLike: TypeAlias = float | str | Zone
"""m, a name of RAPID's such as "fine" and "z10", or all parts."""


@dataclass(frozen=True, slots=True)
class UserTool:
    """tooldata of a program's own, held by the robot: where its TCP is in the flange's frame, its
    mass in kg, where that is and how the axes of inertia lie (m), and its moments, kg m2."""

    frame: Pose
    mass: float
    centre: tuple[float, float, float] = (0.0, 0.0, 0.0)
    axes: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)
    inertia: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class UserWorkObject:
    """wobjdata of a program's own, which stands: its user frame in the world's, its object frame in
    that."""

    user_frame: Pose
    object_frame: Pose = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))


@dataclass(frozen=True, slots=True)
class Target:
    """A robtarget that a routine has left: pose (m), configuration, and values of external axes by
    name (rad, m), as `move_to` takes them. What it left is not checked."""

    pose: Pose
    configuration: AxisConfiguration
    external: Mapping[str, float]


Left: TypeAlias = float | bool | str | Target | tuple[float, ...]
"""What a routine leaves in a parameter: a num, bool or string, a robtarget, joints."""


@dataclass(frozen=True, slots=True)
class Trigger:
    """A signal that is set on the way of a move: `place` is m from its beginning, m
    before its end, or s before its end, as `kind` says."""

    signal: str
    value: float
    kind: MarkPlace
    place: float

    def __post_init__(self) -> None:
        _number(self.place, "place on a way", "m or s, such as 0.02")
        _number(self.value, *_LEVEL)

    @classmethod
    def after(cls, metres: float, signal: str, value: float = 1.0) -> "Trigger":
        """So many m behind the beginning of the move."""
        return cls(signal, value, MarkPlace.START, metres)

    @classmethod
    def before(cls, metres: float, signal: str, value: float = 1.0) -> "Trigger":
        """So many m before its end."""
        return cls(signal, value, MarkPlace.END, metres)

    @classmethod
    def ahead(cls, seconds: float, signal: str, value: float = 1.0) -> "Trigger":
        """So many s before its end."""
        return cls(signal, value, MarkPlace.TIME, seconds)


def pulse(signal: str, after: float, length: float) -> tuple[Trigger, Trigger]:
    """A signal that is 1 from `after` m behind the beginning of a move for `length` m."""
    on = Trigger.after(after, signal)
    return on, Trigger.after(on.place + _number(length, *_LENGTH), signal, 0.0)


@dataclass(frozen=True, slots=True)
class ProgramStep:
    """One instruction. `speed`, `zone`, `tool` and `work_object` (empty: the group's own) hold for
    it; a pose may say the configuration of its posture, and values of external axes by name. `own`
    is what TOOL and WORK_OBJECT say."""

    kind: Instruction
    speed: Speed
    zone: Zone
    joints: tuple[float, ...] = ()
    pose: Pose | None = None
    via: Pose | None = None
    configuration: AxisConfiguration | None = None
    external: tuple[tuple[str, float], ...] = ()
    triggers: tuple[Trigger, ...] = ()
    tool: str | UserTool = ""
    work_object: str | UserWorkObject = ""
    own: UserTool | UserWorkObject | None = None
    signal: str = ""
    value: float = 0.0
    seconds: float = 0.0
    routine: str = ""
    arguments: tuple[Argument, ...] = ()


class _Operands(TypedDict, total=False):
    """What an instruction may have."""

    joints: tuple[float, ...]
    pose: Pose | None
    via: Pose | None
    configuration: AxisConfiguration | None
    external: tuple[tuple[str, float], ...]
    triggers: tuple[Trigger, ...]
    own: UserTool | UserWorkObject | None
    signal: str
    value: float
    seconds: float
    routine: str
    arguments: tuple[Argument, ...]


class Program:
    """Instructions in their order; each method adds one and gives the program itself.

    `speed` and `zone` hold until another one is given.
    """

    def __init__(self, *, speed: SpeedLike = SLOW, zone: ZoneLike = "fine") -> None:
        self.steps: list[ProgramStep] = []
        self._speed = speed_of(speed)
        self._zone = zone_of(zone)
        self._tool: str | UserTool = ""
        self._work_object: str | UserWorkObject = ""

    def __len__(self) -> int:
        return len(self.steps)

    def move_joints(
        self,
        joints: Sequence[float],
        *,
        speed: SpeedLike | None = None,
        zone: ZoneLike | None = None,
        triggers: Sequence[Trigger] = (),
    ) -> Self:
        """To joints, rad and m, all axes together (MoveAbsJ; with `triggers` TriggJ to the pose
        that they have)."""
        self._hold(speed, zone)
        return self._add(Instruction.MOVE_ABSJ, joints=joints_of(joints), triggers=tuple(triggers))

    def move_to(
        self,
        pose: Pose,
        *,
        speed: SpeedLike | None = None,
        zone: ZoneLike | None = None,
        configuration: AxisConfiguration | None = None,
        external: Mapping[str, float] | None = None,
        triggers: Sequence[Trigger] = (),
    ) -> Self:
        """To a pose, all axes together (MoveJ): in the given configuration, else in the posture
        that is nearest to the one before."""
        self._hold(speed, zone)
        return self._to_pose(Instruction.MOVE_J, pose, None, configuration, external, triggers)

    def move_linear(
        self,
        pose: Pose,
        *,
        speed: SpeedLike | None = None,
        zone: ZoneLike | None = None,
        configuration: AxisConfiguration | None = None,
        external: Mapping[str, float] | None = None,
        triggers: Sequence[Trigger] = (),
    ) -> Self:
        """To a pose on a line (MoveL). A configuration is what the posture at its end must have."""
        self._hold(speed, zone)
        return self._to_pose(Instruction.MOVE_L, pose, None, configuration, external, triggers)

    def move_circular(
        self,
        via: Pose,
        pose: Pose,
        *,
        speed: SpeedLike | None = None,
        zone: ZoneLike | None = None,
        configuration: AxisConfiguration | None = None,
        external: Mapping[str, float] | None = None,
        triggers: Sequence[Trigger] = (),
    ) -> Self:
        """To a pose on the circle through the position of `via` (MoveC)."""
        self._hold(speed, zone)
        return self._to_pose(Instruction.MOVE_C, pose, via, configuration, external, triggers)

    def use(
        self,
        *,
        tool: str | UserTool | None = None,
        work_object: str | UserWorkObject | None = None,
    ) -> Self:
        """From here on poses are those of this tool in this work object: of the configuration, by
        name (empty: the group's own), or of the program's own, by values; these are an instruction.
        The robot stops before the first move with them."""
        if isinstance(tool, UserTool):
            self._add(Instruction.TOOL, own=tool)
        if isinstance(work_object, UserWorkObject):
            self._add(Instruction.WORK_OBJECT, own=work_object)
        self._tool = self._tool if tool is None else tool
        self._work_object = self._work_object if work_object is None else work_object
        return self

    def allow(self, *, singularities: bool = False, configurations: bool = False) -> Self:
        """From here on lines and circles may pass `singularities` of the wrist, the tool turning
        otherwise on the way (SingArea Wrist), and end in any of the `configurations` (ConfL Off).
        What is not said is forbidden again. The robot stops for it."""
        bits = singularities + 2 * configurations
        return self._add(Instruction.SETTINGS, value=float(bits))

    def wait(self, seconds: float) -> Self:
        """Stand for so long. The move before it ends in a stop point."""
        return self._add(Instruction.WAIT, seconds=_number(seconds, *_TIME))

    def wait_for(self, signal: str, value: float = 1.0, *, timeout: float) -> Self:
        """Stand until a signal that the configuration exposes has a value; when it has not within
        `timeout` s the program has failed. The move before it ends in a stop point."""
        return self._add(
            Instruction.WAIT_SIGNAL,
            signal=signal,
            value=_number(value, *_LEVEL),
            seconds=_number(timeout, *_TIME),
        )

    def set(self, signal: str, value: float = 1.0) -> Self:
        """Set a signal, standing. The move before it ends in a stop point; `triggers` of a move set
        signals on its way."""
        return self._add(Instruction.SET, signal=signal, value=_number(value, *_LEVEL))

    def call(self, routine: str, *arguments: Argument, timeout: float = 0.0) -> Self:
        """Call a procedure of the controller's program, by its name in the configuration, with a
        value for each of its parameters; a pose is reached in the nearest posture, with the tool in
        use. It runs in the motion task, while the robot stands and nothing of this program is left
        to move. What it raises ends the program; a STOP leaves it, wherever it is, and so does the
        controller after `timeout` s (0: never)."""
        return self._add(
            Instruction.CALL,
            routine=routine,
            arguments=arguments,
            seconds=_number(timeout, *_TIME),
        )

    def _hold(self, speed: SpeedLike | None, zone: ZoneLike | None) -> None:
        if speed is not None:
            self._speed = speed_of(speed)
        if zone is not None:
            self._zone = zone_of(zone)

    def _to_pose(
        self,
        kind: Instruction,
        pose: Pose,
        via: Pose | None,
        configuration: AxisConfiguration | None,
        external: Mapping[str, float] | None,
        triggers: Sequence[Trigger],
    ) -> Self:
        return self._add(
            kind,
            pose=pose_of(pose),
            via=None if via is None else pose_of(via),
            configuration=configuration,
            external=tuple((external or {}).items()),
            triggers=tuple(triggers),
        )

    def _add(self, kind: Instruction, **operands: Unpack[_Operands]) -> Self:
        self.steps.append(
            ProgramStep(
                kind,
                self._speed,
                self._zone,
                tool=self._tool,
                work_object=self._work_object,
                **operands,
            )
        )
        return self


def speed_of(speed: SpeedLike) -> Speed:
    """All parts of a speed. Raises InvalidProgram for something that is none."""
    return speed if isinstance(speed, Speed) else Speed(_number(speed, *_SPEED))


def zone_of(zone: ZoneLike) -> Zone:
    """All parts of a zone. Raises InvalidProgram for a name that is none, and for what is none."""
    if isinstance(zone, Zone):
        return zone
    if not isinstance(zone, str):
        return Zone.of(_number(zone, "zone", "m, a Zone, or a name such as z10"))
    if zone not in ZONES:
        names = list(ZONES)
        raise _malformed(
            f"there is no zone '{zone}'",
            suggest(zone, names) or f"m, or one of {', '.join(names)}",
        )
    return ZONES[zone]


def joints_of(joints: Sequence[float]) -> tuple[float, ...]:
    """Joints as plain numbers. Raises InvalidProgram for something that has none."""
    try:
        return tuple(map(float, joints))
    except (TypeError, ValueError) as error:
        help = "joints are numbers in rad and m, one for each, such as [0, 0.1, 0, 0, 0.5, 0]"
        raise _malformed(f"{joints!r} are no joints", help) from error


def pose_of(pose: Pose) -> Pose:
    """A pose as plain tuples. Raises InvalidProgram for something that is none."""
    try:
        (x, y, z), (w, a, b, c) = pose
        return (float(x), float(y), float(z)), (float(w), float(a), float(b), float(c))
    except (TypeError, ValueError) as error:
        help = "a pose is ((x, y, z), (w, x, y, z)): m, and a unit quaternion with the scalar first"
        raise _malformed(f"{pose!r} is no pose", help) from error
