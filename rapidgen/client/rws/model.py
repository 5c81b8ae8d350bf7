"""Data of a controller, as frozen dataclasses."""

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Identity:
    """Identity of a controller; `id` is unique."""

    name: str
    id: str
    kind: str
    system: str
    robotware: str

    @property
    def is_virtual(self) -> bool:
        """True if the controller reports that it is virtual."""
        return "virtual" in self.kind.lower()


@dataclass(frozen=True, slots=True)
class Panel:
    """State of the panel.

    `state`: motoron, motoroff, guardstop, emergencystop, sysfail; `mode`: AUTO, MANR, MANF; `speed`
    in percent.
    """

    state: str
    mode: str
    speed: int


@dataclass(frozen=True, slots=True)
class ProgramState:
    """Execution state of the program; `cycle` is once or forever."""

    running: bool
    cycle: str


@dataclass(frozen=True, slots=True)
class TaskState:
    """One RAPID task.

    `kind` is normal, static or semistatic; `state` is linked or loaded; `execution` is ready,
    started, stopped or uninitialized.
    """

    name: str
    kind: str
    state: str
    execution: str
    active: bool
    motion: bool


@dataclass(frozen=True, slots=True)
class TaskModule:
    """A module in a task."""

    name: str
    is_system: bool


@dataclass(frozen=True, slots=True)
class JointTarget:
    """Axes as in RAPID: deg, external ones deg or mm; 9E9 for missing axes."""

    robax: tuple[float, ...]
    extax: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class RobTarget:
    """Pose of a TCP as in RAPID: mm, quaternion (w first), cf1 cf4 cf6 cfx.

    External axes are in deg or mm.
    """

    trans: tuple[float, ...]
    rot: tuple[float, ...]
    robconf: tuple[float, ...]
    extax: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class BuildError:
    """A build error in a task's program."""

    module: str
    row: int
    column: int
    text: str


@dataclass(frozen=True, slots=True)
class ProgramPointer:
    """Position of a program pointer; empty texts and 0: not set."""

    module: str
    routine: str
    row: int
    column: int


@dataclass(frozen=True, slots=True)
class SymbolInfo:
    """One RAPID datum: `path` is TASK/MODULE/NAME, `kind` per, var or con."""

    path: str
    name: str
    kind: str
    type: str
    dims: tuple[int, ...]
    is_local: bool
    read_only: bool


@dataclass(frozen=True, slots=True)
class MechanicalUnit:
    """A robot, with the names of its task and of the tool and load that the pendant shows."""

    name: str
    task: str
    tool: str
    load: str


@dataclass(frozen=True, slots=True)
class SignalState:
    """One signal; `path` is the controller's name with network and device."""

    name: str
    path: str
    type: str
    value: float
    simulated: bool


@dataclass(frozen=True, slots=True)
class LogEvent:
    """One entry of the event log.

    `type` is info, warning or error; `time` is the controller's.
    """

    domain: int
    number: int
    type: str
    code: int
    time: str
    title: str
    description: str
    arguments: tuple[str, ...] = ()

    def __str__(self) -> str:
        text = f" ({', '.join(a for a in self.arguments if a)})" if any(self.arguments) else ""
        return f"{self.time} {self.type:7} {self.code} {self.title}{text}"


@dataclass(frozen=True, slots=True)
class FileInfo:
    """A file or a folder of a volume; `size` in bytes, 0 of a folder."""

    name: str
    is_folder: bool
    size: int = 0


@dataclass(frozen=True, slots=True)
class MastershipHolder:
    """Holder of mastership."""

    domain: str
    user: str
    application: str
    location: str
    mine: bool

    def __str__(self) -> str:
        return (
            f"{self.user or '?'} ({self.application or 'no application'}, {self.location or '?'})"
        )


@dataclass(frozen=True, slots=True)
class Dialog:
    """Dialog of a program on the pendant.

    `kind` is its instruction (TPReadFK, UIMsgBox, ...), `stack` its place, `parameters` RAPID
    literals by name (empty if the controller reports none).
    """

    kind: str
    stack: str
    parameters: Mapping[str, str]

    @property
    def task(self) -> str:
        """Task of the dialog."""
        return self.stack.removeprefix("RAPID/").partition("/")[0]


@dataclass(frozen=True, slots=True)
class QueueMessage:
    """A message of a queue; from a task it is `type;value`."""

    data: str
    user: int


@dataclass(frozen=True, slots=True)
class ResourceEvent:
    """An event of a subscription: its resource and its new value."""

    resource: str
    kind: str
    value: str


@dataclass(frozen=True, slots=True)
class CfgInstance:
    """One instance of a cfg type; attributes are texts, flags `true`."""

    name: str
    attributes: Mapping[str, str]
