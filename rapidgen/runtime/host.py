"""What a task and the built-ins may ask of the controller that runs them."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Literal, Protocol

from rapidgen.machine.costs import Costs
from rapidgen.machine.files import FileSystem
from rapidgen.machine.io import IOSystem
from rapidgen.machine.log import EventLog
from rapidgen.machine.meetings import Meetings
from rapidgen.machine.network.interface import Network
from rapidgen.machine.network.sockets import SocketTable
from rapidgen.machine.operator import Operator
from rapidgen.machine.system_parameters import SystemParameters
from rapidgen.machine.texts import TextTables
from rapidgen.motion.system import MotionSystem
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.context import Options
from rapidgen.runtime.errors import FatalError
from rapidgen.runtime.queues import QueueSystem
from rapidgen.runtime.robot_data import RobotData
from rapidgen.runtime.switches import Switches
from rapidgen.system.model import ModuleFile, System

if TYPE_CHECKING:
    from rapidgen.runtime.loading import ModuleTable
    from rapidgen.runtime.task.statements import Statements
    from rapidgen.runtime.task.task import Task


class Operation(Protocol):
    """What tasks tell of themselves, for the controller to stop others and the robots."""

    def task_changed(self) -> None:
        """The state of a task changed."""

    def task_failed(self, task: "Task", fatal: FatalError) -> None:
        """A task stopped with an error."""

    def program_stopped(self, task: "Task") -> None:
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
    meetings: Meetings

    # What runs.
    rapid_tasks: "dict[str, Task]"
    modules: "ModuleTable"
    """Modules that tasks have loaded themselves."""
    statements: "Statements"
    """Who wants to know of statements."""

    @property
    def log(self) -> EventLog:
        """The event log."""

    @property
    def operation(self) -> Operation:
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
