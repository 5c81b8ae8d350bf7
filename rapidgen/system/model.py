"""Parts of a controller, independent of their source: frozen data.

Names and values are those of ABB's cfg files (domains SYS and EIO).
"""

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from rapidgen.system.releases import UNKNOWN_ROBOTWARE

if TYPE_CHECKING:
    from rapidgen.system.controller_cfg import ControllerCfg

TaskType = Literal["NORMAL", "STATIC", "SEMISTATIC"]
TrustLevel = Literal["SysFail", "SysHalt", "SysStop", "NoSafety"]
SignalType = Literal["DI", "DO", "GI", "GO", "AI", "AO"]


class _Referable:
    """A base with slots that permits weak references."""

    __slots__ = ("__weakref__",)


@dataclass(frozen=True, slots=True)
class ModuleFile(_Referable):
    """One module file as bytes.

    `path` is for messages; `target` is its HOME: path, if any.
    """

    name: str
    path: str
    data: bytes
    target: str = ""
    origin: tuple[tuple[int, str, int], ...] = ()
    """Line map of a generated file: (RAPID line, template, template line), ascending."""
    shared: bool = False
    """Installed once for all tasks, which share its data [K §14]."""
    installed: bool = False
    """Built in: outermost scope, data outlive PP to main [K §13].

    Shared modules are, too.
    """


@dataclass(frozen=True, slots=True)
class QueueSpec:
    """A task's message queue (RmqType, RmqMaxMsgSize, RmqMaxNoOfMsg); the defaults are [mem]."""

    open: bool = True
    """False: RmqType is None, and no task can find the queue.

    By default a task has one.
    """
    max_size: int = 400
    max_messages: int = 5


@dataclass(frozen=True, slots=True)
class TaskSpec:
    """One RAPID task (CAB_TASKS) with the modules loaded into it, in loading order."""

    name: str
    type: TaskType = "NORMAL"
    trust: TrustLevel = "SysFail"
    entry: str = "main"
    motion: bool = False
    mechanical_unit_group: str = ""
    modules: tuple[ModuleFile, ...] = ()
    queue: QueueSpec = QueueSpec()


@dataclass(frozen=True, slots=True)
class MechanicalUnitGroup:
    """MECHANICAL_UNIT_GROUP: a robot, further units and the planner that moves them."""

    name: str
    robot: str = ""
    units: tuple[str, ...] = ()
    planner: str = ""


@dataclass(frozen=True, slots=True)
class SignalSpec:
    """EIO_SIGNAL. A signal without a device is a virtual one."""

    name: str
    type: SignalType
    access: str = "Default"
    default: float = 0.0
    device: str = ""
    size: int = 1
    """Bits of a group signal."""
    bits: tuple[int, ...] = ()
    """Bits of the device, least significant first; signals that share some change together."""
    low: float = 0.0
    high: float = 0.0
    """Limits of an analogue signal; both 0: none."""


@dataclass(frozen=True, slots=True)
class SystemOutput:
    """SYSSIG_OUT: a status of the controller that drives a DO."""

    status: str
    signal: str
    unit: str = ""
    """Mechanical unit that the status is of (-Arg1)."""
    task: str = ""
    """Task that the status is of (-Arg2)."""


@dataclass(frozen=True, slots=True)
class SystemInput:
    """SYSSIG_IN: a DI that makes the controller act."""

    action: str
    signal: str
    argument: str = ""
    """-Arg1, such as CONT or CYCLE of Start."""
    task: str = ""
    """-Arg7, which RobotWare 7 has in PpToMain."""


@dataclass(frozen=True, slots=True)
class CrossConnection:
    """EIO_CROSS: result := actor (op actor ...); `operators` has one less than `actors`."""

    name: str
    result: str
    actors: tuple[tuple[str, bool], ...]
    """(signal, inverted)"""
    operators: tuple[Literal["AND", "OR"], ...] = ()


@dataclass(frozen=True, slots=True)
class EventRoutine:
    """CAB_EXEC_HOOKS: a routine run at POWER_ON, START, STOP, QSTOP, RESTART, RESET or STEP."""

    routine: str
    event: str
    task: str = ""
    all_motion_tasks: bool = False
    all_tasks: bool = False
    order: int = 0
    """-SeqNo: of the routines of one event those with lower numbers come first."""


@dataclass(frozen=True, slots=True)
class ArcSignals:
    """ARC_EQUIP_IO_...: what arc welding equipment has for signals: (`WeldOn`, name), ..."""

    instance: str
    """Such as stdIO_T_ROB1: its end names the task."""
    names: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True, slots=True)
class UdpDevice:
    """A UDP device: COM_TRP of type UDPUC (RobotWare 6), UDPUC_HOST (7)."""

    name: str
    address: str = ""
    """Empty: not configured."""
    port: int = 6510

    def __str__(self) -> str:
        return f"{self.name} at {self.address}:{self.port}" if self.address else self.name


@dataclass(frozen=True, slots=True)
class System:
    """A whole controller: tasks in order, I/O, mechanical units, RobotWare, HOME:."""

    name: str
    tasks: tuple[TaskSpec, ...]
    signals: tuple[SignalSpec, ...] = ()
    outputs: tuple[SystemOutput, ...] = ()
    inputs: tuple[SystemInput, ...] = ()
    cross: tuple[CrossConnection, ...] = ()
    events: tuple[EventRoutine, ...] = ()
    groups: tuple[MechanicalUnitGroup, ...] = ()
    robotware: tuple[int, int] = UNKNOWN_ROBOTWARE
    is_robotware_known: bool = True
    """True if the minor version is known; else the second number is 0."""
    home: Path | None = None
    """Folder with the initial files of HOME:; it is copied, never written."""
    home_below: Path | None = None
    """HOME of the controller onto which a build is loaded; `home` is copied over it."""
    build_id: str = ""
    """BUILD_ID of a generated folder, else empty."""
    robot_types: tuple[tuple[str, str], ...] = ()
    """(mechanical unit, -use_robot_type of MOC), if a backup has them."""
    arc: tuple[ArcSignals, ...] = ()
    """Of PROC.cfg, if a backup has it."""
    cameras: tuple[str, ...] = ()
    """Names of cameras: COM_APP of SIO.cfg, or of a cell."""
    udp_devices: tuple[UdpDevice, ...] | None = None
    """Of SIO.cfg; None: there is no SIO configuration."""
    cfg: "ControllerCfg | None" = field(default=None, compare=False, repr=False)
    """All domains that the system was read from; None: it was composed."""
