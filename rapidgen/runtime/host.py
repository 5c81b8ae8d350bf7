"""Interfaces between tasks and their controller.

`Host` is the controller as tasks and built-ins use it. `RapidTask` is a task as its parts, its
controller and other tasks use it. Both are protocols, because the classes themselves would import
each other.
"""

from collections.abc import Mapping
from types import FrameType
from typing import Literal, Protocol, TypeAlias

from rapidgen.machine.arc_equipment import ArcEquipment
from rapidgen.machine.cost_model import Costs
from rapidgen.machine.event_log import EventLog
from rapidgen.machine.files import FileSystem
from rapidgen.machine.io import IOSystem
from rapidgen.machine.network.interface import Network
from rapidgen.machine.network.sockets import SocketTable
from rapidgen.machine.operator import Operator
from rapidgen.machine.scheduler import Scheduler, SyncPoints
from rapidgen.machine.sensors import Camera, ForceSensors
from rapidgen.machine.smart_gripper import Hands
from rapidgen.machine.text_tables import TextTables
from rapidgen.motion.egm.sessions import EgmSessions
from rapidgen.motion.group import MotionWaiter
from rapidgen.motion.system import MotionSystem
from rapidgen.rapid.switches import Switches
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.emit.access import Options
from rapidgen.runtime.compiler.program import Program
from rapidgen.runtime.errors import FatalError, Location, RapidError
from rapidgen.runtime.motion_interface import RobotData
from rapidgen.runtime.queues import QueueSystem
from rapidgen.runtime.signals import CyclicBools
from rapidgen.runtime.task.statement_hooks import Statements
from rapidgen.system.cfg_database import CfgDatabase
from rapidgen.system.model import ModuleFile, System, TaskSpec

TaskState: TypeAlias = Literal["ready", "running", "stopped", "finished", "error", "empty"]


class TaskObserver(Protocol):
    """Reports from tasks, for stopping other tasks and the robots."""

    def task_changed(self) -> None:
        """Report a changed task state."""

    def task_failed(self, task: "RapidTask", fatal: FatalError) -> None:
        """Report a task that stopped with an error."""

    def program_stopped(self, task: "RapidTask") -> None:
        """Report Stop or Break in a task."""

    def step_moves(self) -> None:
        """Permit robot motion during a step."""

    def step_ended(self) -> None:
        """Report the end of a task's step."""


class Host(Protocol):
    """A controller, as its tasks and built-ins use it."""

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
    texts: TextTables
    queues: QueueSystem
    robot_data: dict[str, RobotData]
    """Settings of programs, by motion group."""
    test_signals: dict[int, float]
    """Values of the servos' test signals by channel."""
    booked: set[int]
    """Error numbers that BookErrNo gave."""
    meetings: SyncPoints
    arcs: dict[str, ArcEquipment]
    """Welding equipment, by task."""
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
    """Tracers and breakpoints."""

    @property
    def cfg(self) -> CfgDatabase:
        """The cfg database."""

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
        """State of every task, by name."""

    def parse_module(self, file: ModuleFile) -> n.Module:
        """Parse a module file."""

    def recovered(
        self, task: "RapidTask", error: RapidError, place: tuple[str, int] | None
    ) -> None:
        """Record an error that a handler recovered, raised at a place of the compiled program."""

    def set_motors(self, on: bool) -> None:
        """Switch the motors on or off; off stops the program."""

    def stop_program(self) -> None:
        """Stop all NORMAL tasks and the robots."""

    def power_loss(self) -> None:
        """Simulate a power failure with restart."""


class RapidTask(MotionWaiter, Protocol):
    """A `Task`, as its parts, its controller and other tasks use it."""

    name: str
    spec: TaskSpec
    scheduler: Scheduler
    controller: Host
    program: Program
    b: int
    """Remaining budget, ns."""
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
        """Innermost Python frame while the task is suspended."""

    @property
    def leaving(self) -> bool:
        """True while routines are left for PP to main."""

    @property
    def is_stopped(self) -> bool:
        """True if the program is stopped."""

    def stack(self) -> tuple[Location, ...]:
        """Call stack, outermost routine first."""

    def charge(self, cost: int) -> None:
        """Spend `cost` nanoseconds of CPU time."""

    def wake_at_next_statement(self) -> None:
        """Call `process_pending()` before the next statement."""

    def process_pending(self) -> None:
        """Execute pending orders, stops and traps."""

    def order(self, order: BaseException) -> None:
        """Raise `order` in the current code."""

    def obey(self) -> None:
        """Raise a pending order."""

    def enter(self, state: TaskState) -> None:
        """Change the state and report it."""

    def stand(self) -> None:
        """Wait until the program is started again."""
