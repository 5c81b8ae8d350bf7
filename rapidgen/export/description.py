"""A RAPID program as frozen data, in RAPID's units: mm, deg, kg, s.

A `Routine` lists instructions with values. The writer decides how they become text: which values
have a predefined name, and where targets are declared. The reader makes the same data from text.
"""

from dataclasses import dataclass
from typing import Literal, NamedTuple, TypeAlias

NOT_CONNECTED = (9e9,) * 6
"""External axes of a robot without any."""
SignalKind = Literal["DO", "GO", "AO", "DI", "GI", "AI"]
Reference = Literal["start", "end", "time"]


class JointTarget(NamedTuple):
    """jointtarget: deg, mm of linear axes; absent external axes are 9E9."""

    robax: tuple[float, ...]
    extax: tuple[float, ...] = NOT_CONNECTED


class RobTarget(NamedTuple):
    """robtarget: mm, unit quaternion (q1 the scalar), confdata, external axes."""

    trans: tuple[float, ...]
    rot: tuple[float, ...]
    conf: tuple[int, ...]
    extax: tuple[float, ...] = NOT_CONNECTED


Target: TypeAlias = JointTarget | RobTarget


class Speed(NamedTuple):
    """speeddata: mm/s and deg/s."""

    tcp: float
    orientation: float = 500.0
    linear: float = 5000.0
    rotary: float = 1000.0


class Zone(NamedTuple):
    """zonedata: a stop point, or radii in mm and deg."""

    finep: bool
    sizes: tuple[float, ...] = (0.0,) * 6


FINE = Zone(True)


@dataclass(frozen=True, slots=True)
class Trigger:
    """A signal set on the path of a move.

    `place` is in mm from its start or before its end, or in s before its end.
    """

    signal: str
    kind: SignalKind
    value: float
    reference: Reference
    place: float


@dataclass(frozen=True, slots=True)
class Move:
    """MoveAbsJ, MoveJ, MoveL or MoveC; with triggers TriggJ, TriggL or TriggC."""

    kind: Literal["AbsJ", "J", "L", "C"]
    target: Target
    speed: Speed
    zone: Zone
    tool: str = "tool0"
    work_object: str = "wobj0"
    via: RobTarget | None = None
    triggers: tuple[Trigger, ...] = ()
    seconds: float = 0.0
    """\\T: duration of the move instead of its speed; 0: none."""


@dataclass(frozen=True, slots=True)
class SetSignal:
    """SetDO, SetGO or SetAO."""

    signal: str
    kind: SignalKind
    value: float


@dataclass(frozen=True, slots=True)
class WaitSignal:
    """WaitDI and its like; `seconds` is the time-out."""

    signal: str
    kind: SignalKind
    value: float
    seconds: float


@dataclass(frozen=True, slots=True)
class Wait:
    """WaitTime."""

    seconds: float


@dataclass(frozen=True, slots=True)
class PathMode:
    """SingArea \\Wrist or \\Off, ConfL \\Off or \\On."""

    singularities: bool
    configurations: bool


class Argument(NamedTuple):
    """An argument; an `inout` one is passed in a variable of its type."""

    value: float | bool | str | Target
    type: str = "num"
    inout: bool = False


@dataclass(frozen=True, slots=True)
class Call:
    """A call of a procedure, or of a function that `returns` a type."""

    routine: str
    arguments: tuple[Argument, ...] = ()
    returns: str = ""


@dataclass(frozen=True, slots=True)
class Comment:
    """A line of comment, without its `!`."""

    text: str


Instruction: TypeAlias = Move | SetSignal | WaitSignal | Wait | PathMode | Call | Comment


@dataclass(frozen=True, slots=True)
class Load:
    """loaddata: kg, mm, unit quaternion, kg m2."""

    mass: float
    centre: tuple[float, ...]
    axes: tuple[float, ...] = (1.0, 0.0, 0.0, 0.0)
    inertia: tuple[float, ...] = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Frame:
    """pose: mm, unit quaternion."""

    trans: tuple[float, ...] = (0.0, 0.0, 0.0)
    rot: tuple[float, ...] = (1.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class ToolData:
    """A declaration of a tool."""

    name: str
    held: bool
    frame: Frame
    load: Load


@dataclass(frozen=True, slots=True)
class WorkObjectData:
    """A declaration of a work object; `held` by the robot, or stationary."""

    name: str
    held: bool
    user: Frame
    object: Frame


@dataclass(frozen=True, slots=True)
class Routine:
    """The exported module: names, declarations and instructions.

    `payload` is the name of a loaddata of the controller, empty for none. With `loads_moves` each
    move gets it as \\TLoad, else GripLoad does.
    """

    module: str
    name: str
    instructions: tuple[Instruction, ...]
    tools: tuple[ToolData, ...] = ()
    work_objects: tuple[WorkObjectData, ...] = ()
    payload: str = ""
    loads_moves: bool = False
    header: tuple[str, ...] = ()
