"""A motion program: what it consists of, and how it is written down.

    program = Program(speed=0.2).move_joints(here).move_linear(pose, zone="z10")

Joints are URDF values, rad and m; poses are ((x, y, z), (w, x, y, z)) in m, of the tool in the
work object. `robot.check_program` and `robot.run` say whether a robot can do it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import astuple, dataclass
from importlib import import_module
from math import radians
from os import PathLike
from typing import TYPE_CHECKING, SupportsFloat, TypeAlias, TypedDict

from rapidgen._compat import Self, Unpack
from rapidgen.axes.kinematics import AxisConfiguration
from rapidgen.client.errors import InvalidProgram
from rapidgen.client.pose import IDENTITY, Pose, pose_of
from rapidgen.diagnostics import suggest
from rapidgen.wire.simple_message.spec import Instruction, MarkPlace

if TYPE_CHECKING:
    from rapidgen.config.model import RobotConfig
    from rapidgen.export.writer import ExportedModule, WriterOptions

_MM = 0.001
# Types of numbers and their checks.
_SPEED = "speed", "m/s of the TCP, or a Speed with all parts: m/s and rad/s"
_LEVEL = "value of a signal", "0 or 1, or a group's or an analog signal's number"
_TIME = "time", "seconds, such as 1.5"
_LENGTH = "length of a pulse", "m, such as 0.01"


def _malformed(message: str, help: str) -> InvalidProgram:
    return InvalidProgram.because("RG670", message, help, exit_code=2)


def _number(value: object, what: str, help: str) -> float:
    """Return a plain number.

    Raises InvalidProgram for other types, also for texts of numbers.
    """
    if isinstance(value, SupportsFloat):
        return float(value)
    raise _malformed(f"{value!r} is not a {what}", help)


@dataclass(frozen=True, slots=True)
class Speed:
    """speeddata: m/s of the TCP and rad/s of its orientation.

    Linear and rotary external axes have m/s and rad/s. All but the TCP default to RAPID's v100.
    """

    tcp: float
    orientation: float = radians(500)
    linear: float = 5.0
    rotary: float = radians(1000)

    def __post_init__(self) -> None:
        for value in astuple(self):
            _number(value, *_SPEED)

    @property
    def words(self) -> tuple[float, ...]:
        """Return the words in the order of the wire."""
        return astuple(self)


@dataclass(frozen=True, slots=True)
class Zone:
    """zonedata: radii of the TCP, its orientation and external axes, m.

    Orientation is in rad, linear external axes in m, rotary ones in rad. `stops`: the robot stops
    at the end.
    """

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
        """Return the zone of a radius in m, as RAPID's predefined zones.

        The other radii are 1.5 times as large, angles a tenth of it in degrees for each mm.
        """
        wide = 1.5 * radius
        angle = radians(0.1 * wide / _MM)
        return cls(radius, wide, wide, angle, wide, angle)

    @property
    def words(self) -> tuple[float, ...]:
        """Return the words in the order of the wire."""
        *sizes, stops = astuple(self)
        return (float(stops), *sizes)


SLOW = 0.1
"""Default speed of the TCP, m/s."""
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
"""Predefined zones of RAPID by name."""
SpeedLike: TypeAlias = float | Speed
"""m/s of the TCP, or all parts."""
Argument: TypeAlias = float | bool | str | Pose | Sequence[float]
"""Argument of a routine: num, bool, string, robtarget or jointtarget.

A robtarget is given by its pose, a jointtarget by its joints.
"""
ZoneLike: TypeAlias = float | str | Zone
"""m, a name of RAPID's such as "fine" and "z10", or all parts."""


@dataclass(frozen=True, slots=True)
class UserTool:
    """tooldata of the program, held by the robot.

    TCP in the flange's frame; mass in kg; centre of gravity and axes of inertia (m); moments, kg
    m2.
    """

    frame: Pose
    mass: float
    centre: tuple[float, float, float] = (0.0, 0.0, 0.0)
    axes: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)
    inertia: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class UserWorkObject:
    """wobjdata of the program, stationary.

    The user frame is in the world's, the object frame in the user frame.
    """

    user_frame: Pose
    object_frame: Pose = IDENTITY


@dataclass(frozen=True, slots=True)
class Target:
    """A robtarget that a routine has set, as `move_to` accepts it.

    Pose (m), configuration, and values of external axes by name (rad, m). Its values are not
    checked.
    """

    pose: Pose
    configuration: AxisConfiguration
    external: Mapping[str, float]


Left: TypeAlias = float | bool | str | Target | tuple[float, ...]
"""Value of a parameter after a call: num, bool, string, robtarget, joints."""


@dataclass(frozen=True, slots=True)
class Trigger:
    """A signal set on the path of a move.

    `place` is m from its start, m before its end, or s before its end, by `kind`.
    """

    signal: str
    value: float
    kind: MarkPlace
    place: float

    def __post_init__(self) -> None:
        _number(self.place, "place on a path", "m or s, such as 0.02")
        _number(self.value, *_LEVEL)

    @classmethod
    def after(cls, metres: float, signal: str, value: float = 1.0) -> "Trigger":
        """Trigger so many m after the start of the move."""
        return cls(signal, value, MarkPlace.START, metres)

    @classmethod
    def before(cls, metres: float, signal: str, value: float = 1.0) -> "Trigger":
        """Trigger so many m before the end of the move."""
        return cls(signal, value, MarkPlace.END, metres)

    @classmethod
    def ahead(cls, seconds: float, signal: str, value: float = 1.0) -> "Trigger":
        """Trigger so many s before the end of the move."""
        return cls(signal, value, MarkPlace.TIME, seconds)


def pulse(signal: str, after: float, length: float) -> tuple[Trigger, Trigger]:
    """Set a signal to 1 from `after` m after the start for `length` m."""
    on = Trigger.after(after, signal)
    return on, Trigger.after(on.place + _number(length, *_LENGTH), signal, 0.0)


@dataclass(frozen=True, slots=True)
class ProgramStep:
    """One instruction.

    `speed`, `zone`, `tool` and `work_object` (empty: the group's own) apply to it. A pose may have
    a configuration, and values of external axes by name. `own` holds the values of TOOL and
    WORK_OBJECT.
    """

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
    """Operands that an instruction may have."""

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
    """Instructions in order; each method adds one and returns the program.

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
        """Move to joints, rad and m, all axes together (MoveAbsJ).

        With `triggers` it is a TriggJ to the pose of the joints.
        """
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
        """Move to a pose, all axes together (MoveJ).

        It uses the given configuration, else the posture nearest to the one before.
        """
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
        """Move to a pose on a line (MoveL).

        The posture at its end must have the configuration, if one is given.
        """
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
        """Move to a pose on the circle through the position of `via` (MoveC)."""
        self._hold(speed, zone)
        return self._to_pose(Instruction.MOVE_C, pose, via, configuration, external, triggers)

    def use(
        self,
        *,
        tool: str | UserTool | None = None,
        work_object: str | UserWorkObject | None = None,
    ) -> Self:
        """Use a tool and a work object for later poses.

        Names select those of the configuration (empty: the group's own); values define new ones,
        with an instruction. The robot stops before the first move with them.
        """
        if isinstance(tool, UserTool):
            self._add(Instruction.TOOL, own=tool)
        if isinstance(work_object, UserWorkObject):
            self._add(Instruction.WORK_OBJECT, own=work_object)
        self._tool = self._tool if tool is None else tool
        self._work_object = self._work_object if work_object is None else work_object
        return self

    def allow(self, *, singularities: bool = False, configurations: bool = False) -> Self:
        """Allow singularities or other configurations on later paths.

        `singularities` of the wrist: the tool turns otherwise on the path (SingArea Wrist).
        `configurations`: any configuration at the end (ConfL Off). An omitted argument forbids it
        again. The robot stops for this instruction.
        """
        bits = singularities + 2 * configurations
        return self._add(Instruction.SETTINGS, value=float(bits))

    def wait(self, seconds: float) -> Self:
        """Wait at rest for so many s. The move before it ends in a stop point."""
        return self._add(Instruction.WAIT, seconds=_number(seconds, *_TIME))

    def wait_for(self, signal: str, value: float = 1.0, *, timeout: float) -> Self:
        """Wait at rest until an exposed signal has a value.

        If it does not within `timeout` s, the program fails. The move before it ends in a stop
        point.
        """
        return self._add(
            Instruction.WAIT_SIGNAL,
            signal=signal,
            value=_number(value, *_LEVEL),
            seconds=_number(timeout, *_TIME),
        )

    def set(self, signal: str, value: float = 1.0) -> Self:
        """Set a signal at rest.

        The move before it ends in a stop point; `triggers` of a move set signals on its path.
        """
        return self._add(Instruction.SET, signal=signal, value=_number(value, *_LEVEL))

    def call(self, routine: str, *arguments: Argument, timeout: float = 0.0) -> Self:
        """Call a procedure of the controller's program.

        Its name is that in the configuration, with a value for each parameter; a pose is reached in
        the nearest posture, with the current tool. It runs in the motion task while the robot is at
        rest and all earlier moves have ended. An error that it raises ends the program; a STOP
        leaves it at any point, and so does the controller after `timeout` s (0: never).
        """
        return self._add(
            Instruction.CALL,
            routine=routine,
            arguments=arguments,
            seconds=_number(timeout, *_TIME),
        )

    def to_rapid(
        self,
        robot: "RobotConfig | str | PathLike[str]",
        *,
        group: str = "",
        module: str = "exported",
        routine: str = "main",
        start: Sequence[float] | None = None,
        options: "WriterOptions | None" = None,
    ) -> "ExportedModule":
        """Return the program as a RAPID module that runs without rapidgen.

        `robot` is a configuration; `start` are joints where the robot stands before the program.
        Without them the program starts at its first position if it begins with `move_joints`, else
        at the robot's usual start. The module is formatted and checked, not executed. Raises
        InvalidProgram with all faults, and DiagnosticError for names that RAPID does not allow.
        """
        from rapidgen.export.writer import WriterOptions

        # By name: it imports this module, and moving a robot does not need it.
        export = import_module("rapidgen.client.rapid_export")
        config, chosen = export.robot_of(robot, group)
        result: ExportedModule = export.export_program(
            self,
            config,
            chosen,
            module=module,
            routine=routine,
            start=start,
            options=options or WriterOptions(),
        )
        return result

    @classmethod
    def from_rapid(
        cls,
        text: str,
        robot: "RobotConfig | str | PathLike[str]",
        *,
        routine: str = "main",
        group: str = "",
        path: str = "module",
    ) -> "Program":
        """Read a straight-line routine of a RAPID module, such as an exported one.

        `robot` is a configuration, whose tools, work objects, signals and routines the module uses;
        others are read from its declarations. `path` names the text in findings. Raises
        DiagnosticError RG763 for statements without counterpart.
        """
        result: Program = import_module("rapidgen.client.rapid_import").import_program(
            text, robot, routine=routine, group=group, path=path
        )
        return result

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
    """Return all parts of a speed. Raises InvalidProgram for other values."""
    return speed if isinstance(speed, Speed) else Speed(_number(speed, *_SPEED))


def zone_of(zone: ZoneLike) -> Zone:
    """Return all parts of a zone.

    Raises InvalidProgram for an unknown name and for other values.
    """
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
    """Return joints as plain numbers. Raises InvalidProgram for other values."""
    try:
        return tuple(map(float, joints))
    except (TypeError, ValueError) as error:
        help = "joints are numbers in rad and m, one for each, such as [0, 0.1, 0, 0, 0.5, 0]"
        raise _malformed(f"{joints!r} are not joints", help) from error
