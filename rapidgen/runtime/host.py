"""What tasks and built-ins may ask of their controller, and what is asked of a task in turn."""

from collections.abc import Mapping
from types import FrameType
from typing import Literal, Protocol, TypeAlias

from rapidgen.machine.arc_equipment import ArcEquipment
from rapidgen.machine.cost_model import Costs
from rapidgen.machine.egm import EgmSessions
from rapidgen.machine.event_log import EventLog
from rapidgen.machine.files import FileSystem
from rapidgen.machine.io import IOSystem
from rapidgen.machine.network.interface import Network
from rapidgen.machine.network.sockets import SocketTable
from rapidgen.machine.operator import Operator
from rapidgen.machine.scheduler import Scheduler, SyncPoints
from rapidgen.machine.sensors import Camera, ForceSensors
from rapidgen.machine.smart_gripper import Hands
from rapidgen.machine.system_parameters import SystemParameters, TextTables
from rapidgen.motion.group import MotionWaiter
from rapidgen.motion.system import MotionSystem
from rapidgen.rapid.switches import Switches
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.emit.access import Options
from rapidgen.runtime.compiler.program import Program
from rapidgen.runtime.errors import FatalError, Location
from rapidgen.runtime.motion_interface import RobotData
from rapidgen.runtime.queues import QueueSystem
from rapidgen.runtime.signals import CyclicBools
from rapidgen.runtime.task.statement_hooks import Statements
from rapidgen.system.model import ModuleFile, System, TaskSpec

TaskState: TypeAlias = Literal["ready", "running", "stopped", "finished", "error", "empty"]


class TaskObserver(Protocol):
    """What tasks tell of themselves, for the controller to stop others and the robots."""

    def task_changed(self) -> None:
        """The state of a task changed."""

    def task_failed(self, task: "RapidTask", fatal: FatalError) -> None:
        """A task stopped with an error."""

    def program_stopped(self, task: "RapidTask") -> None:
        """Stop or Break in a task."""

    def step_moves(self) -> None:
        """The robots may move during a step."""

    def step_ended(self) -> None:
        """A task has done its step."""


class Host(Protocol):
    """A controller, as its tasks and built-ins know it."""

    # How it executes programs.
    system: System
    costs: Costs
    dialect: Switches
    cycle: Literal["once", "forever"]
    options: Options

    # What programs read and write.
    io: IOSystem
    motion: MotionSystem
    network: Network
    sockets: SocketTable
    files: FileSystem
    operator: Operator
    configuration: SystemParameters
    texts: TextTables
    queues: QueueSystem
    robot_data: dict[str, RobotData]
    """What programs have set, by motion group."""
    test_signals: dict[int, float]
    """Values of the servos' test signals by channel."""
    booked: set[int]
    """Error numbers that BookErrNo gave."""
    meetings: SyncPoints
    arcs: dict[str, ArcEquipment]
    """What tasks weld with."""
    cameras: dict[str, Camera]
    """By lower-case name."""
    egm: EgmSessions
    """Of externally guided motion."""
    force: ForceSensors
    """Of the robots."""
    hands: Hands
    """The hands of a YuMi."""

    # What runs.
    statements: Statements
    """Who wants to know of statements."""

    @property
    def rapid_tasks(self) -> "Mapping[str, RapidTask]":
        """All tasks by name."""

    @property
    def log(self) -> EventLog:
        """The event log."""

    @property
    def operation(self) -> TaskObserver:
        """Modes and stops."""

    @property
    def mode(self) -> str:
        """`auto`, `manual_reduced` or `manual_full`."""

    @property
    def tasks(self) -> Mapping[str, object]:
        """What there is of every task, by name."""

    def parse_module(self, file: ModuleFile) -> n.Module:
        """The tree of a module file."""

    def recovered(self, task: str, number: int, text: str) -> None:
        """A handler dealt with an error."""

    def set_motors(self, on: bool) -> None:
        """Motors on or off; off stops the program."""

    def stop_program(self) -> None:
        """Stop all NORMAL tasks and the robots."""

    def power_loss(self) -> None:
        """Power goes and comes back."""


class RapidTask(MotionWaiter, Protocol):
    """A `Task`, as its parts, its controller and other tasks know it."""

    name: str
    spec: TaskSpec
    scheduler: Scheduler
    controller: Host
    program: Program
    b: int
    """What is left of the budget, ns."""
    state: TaskState
    fault: FatalError | None
    cycles: int
    held: bool
    in_trap: bool
    errno: int
    intno: int
    cyclic: CyclicBools

    @property
    def frame(self) -> FrameType | None:
        """Innermost Python frame while it is suspended."""

    @property
    def leaving(self) -> bool:
        """Whether routines are still being left for PP to main."""

    @property
    def is_stopped(self) -> bool:
        """Whether the program is stopped."""

    def stack(self) -> tuple[Location, ...]:
        """Call stack, outermost first."""

    def charge(self, cost: int) -> None:
        """Spend `cost` nanoseconds of CPU."""

    def wake_at_next_statement(self) -> None:
        """Let `process_pending()` be called before the next statement."""

    def process_pending(self) -> None:
        """Obey, stand, serve traps, as is due."""

    def order(self, order: BaseException) -> None:
        """Leave what is being executed by raising `order` in it."""

    def obey(self) -> None:
        """Raise what was ordered."""

    def enter(self, state: TaskState) -> None:
        """Change the state, and tell the controller."""

    def stand(self) -> None:
        """Stand here until the program is started again."""
