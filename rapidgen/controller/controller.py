"""The virtual controller: one scheduler, tasks, I/O, motion, files, network and event log."""

import threading
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Literal, Self

from rapidgen.config.model import GroupConfig, RobotConfig
from rapidgen.controller.cell import in_its_cell
from rapidgen.controller.event_log import ControllerLog
from rapidgen.controller.faults import FaultPlan
from rapidgen.controller.faults import schedule as schedule_faults
from rapidgen.controller.state import ControllerState
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity
from rapidgen.machine.costs import Costs
from rapidgen.machine.files import FileSystem
from rapidgen.machine.io import IOSystem
from rapidgen.machine.network.faulty import FaultyNetwork
from rapidgen.machine.network.interface import Network
from rapidgen.machine.network.memory import MemoryNetwork
from rapidgen.machine.network.system import PortMap, SystemNetwork
from rapidgen.machine.operator import Answer, Operator
from rapidgen.machine.scheduler import ClockKind, Schedule, Scheduler
from rapidgen.machine.system_parameters import SystemParameters
from rapidgen.motion.recorder import Recorder
from rapidgen.motion.system import MotionSystem
from rapidgen.rapid import Dialect as TextDialect
from rapidgen.rapid import parse
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.context import Options
from rapidgen.runtime.compiler.linking import Shared
from rapidgen.runtime.compiler.predefined import find_type
from rapidgen.runtime.compiler.symbols import Data, Routine
from rapidgen.runtime.errors import FatalError
from rapidgen.runtime.loading import ModuleTable
from rapidgen.runtime.queues import QueueSystem
from rapidgen.runtime.robot_data import RobotData
from rapidgen.runtime.sockets import SocketTable
from rapidgen.runtime.switches import Dialect
from rapidgen.runtime.task.recovery import Place
from rapidgen.runtime.task.running import RapidTask
from rapidgen.runtime.texts import TextTables
from rapidgen.runtime.values import Type
from rapidgen.system.model import ModuleFile, System

_NS = 1_000_000_000
Cycle = Literal["once", "forever"]
_THREAD_LOOK = 0.1
"""s between two looks whether the controller's thread is still there to answer."""


class Deadlock(Exception):
    """Every task waits and nothing is ahead that could wake one."""


class Signals(Mapping[str, float]):
    """Values of the signals by name; assigning sets one."""

    def __init__(self, io: IOSystem) -> None:
        self._io = io

    def __getitem__(self, name: str) -> float:
        return self._io[name].value

    def __setitem__(self, name: str, value: float) -> None:
        self._io.set(self._io[name], value)

    def __iter__(self) -> Iterator[str]:
        return iter([s.name for s in self._io.signals.values()])

    def __len__(self) -> int:
        return len(self._io.signals)


class TaskView:
    """A task for tests: `task["Module:name"]` is a raw RAPID value (deg, mm)."""

    def __init__(self, task: RapidTask) -> None:
        self.rapid = task

    @property
    def name(self) -> str:
        """Name of the task."""
        return self.rapid.name

    @property
    def state(self) -> str:
        """`ready`, `running`, `stopped`, `finished`, `error` or `empty`."""
        return self.rapid.state

    @property
    def fault(self) -> FatalError | None:
        """Why the task stopped with an error."""
        return self.rapid.fault

    @property
    def stack(self) -> tuple[Place, ...]:
        """Where it is, outermost routine first."""
        return self.rapid.stack()

    def _data(self, name: str) -> tuple[Data, Any]:
        program = self.rapid.program
        where, colon, key = name.lower().rpartition(":")
        module = program.modules.get(where) if colon else None
        if colon and module is None:
            raise KeyError(name)
        data = program.find_data(module, key)
        if data is None:
            raise KeyError(name)
        return data, program.space.get(data.code)

    def __getitem__(self, name: str) -> Any:  # noqa: ANN401
        data, kept = self._data(name)
        if data.storage == "inline":
            return data.value
        return kept.v if data.storage == "cell" else kept

    def __setitem__(self, name: str, value: Any) -> None:  # noqa: ANN401
        data, kept = self._data(name)
        if data.readonly:
            raise KeyError(f"{name} is a constant")
        if data.storage == "cell":
            kept.set(value)
        else:
            program = self.rapid.program
            program.space[program.global_ref(data)].set(value)

    def type_of(self, name: str) -> tuple[Type, tuple[int, ...]]:
        """Type and dimensions of a datum. KeyError: there is none."""
        data, _ = self._data(name)
        return data.type, data.dims

    def start(self) -> None:
        """Start or go on."""
        self.rapid.start()

    def stop(self) -> None:
        """Stop the program."""
        self.rapid.stop()

    def step(self, *, back: bool = False, over: bool = False) -> None:
        """Execute one statement; `over`: calls as a whole. CannotStep says why not.

        Time has to pass for it; the task is `stopped` again then.
        """
        self.rapid.controller.step_program(self.rapid, back=back, over=over)

    @property
    def place(self) -> Place | None:
        """The statement before which a stopped task stands; None when that is unknown."""
        return self.rapid.stands_before()

    def pp_to_routine(self, name: str) -> None:
        """Set the program pointer to a procedure without parameters. CannotStep: no such one."""
        self.rapid.pp_to_routine(name)
        self.rapid.controller.drop_paths()

    def pp_to_statement(self, line: int) -> None:
        """Set the program pointer to another statement of the routine (PP to cursor).

        Data and interrupts are kept, the path is gone. CannotStep: it cannot go on there.
        """
        self.rapid.pp_to_statement(line)
        self.rapid.controller.drop_paths()

    def call_service(self, name: str) -> None:
        """Execute a service routine of a stopped task. CannotStep: it runs, or no such one."""
        self.rapid.call_service(name)

    def pp_to_main(self) -> None:
        """Set the program pointer to main."""
        self.rapid.pp_to_main()


class VirtualController(ControllerState):
    """Executes the RAPID of a `System`.

    Bound to the thread that steps it, or, after `start()`, to a thread of its own. Positions
    are rad and m by motion group; `tasks[name]["Module:name"]` gives raw RAPID values.
    """

    def __init__(
        self,
        system: System,
        robots: Sequence[GroupConfig] = (),
        *,
        clock: ClockKind = "virtual",
        seed: int = 0,
        speed: float = 1.0,
        costs: Costs | None = None,
        dialect: Dialect | None = None,
        host: str = "",
        ports: PortMap = 0,
        cycle: Cycle = "forever",
        schedule: Schedule = "round-robin",
        switch_at_pers: bool = False,
        accounting: Literal["block", "statement", "none"] = "block",
        tracing: bool = False,
        answers: Iterable[Answer] | None = None,
        network: Network | None = None,
        folder: Path | None = None,
        faults: FaultPlan | None = None,
        autostart: bool = True,
    ) -> None:
        """Load every module and, with `autostart`, start all tasks in automatic mode.

        `host` selects the operating system's network (an address to bind); empty = in memory
        on the virtual clock, 127.0.0.1 on the real one. DiagnosticError when a module cannot
        be loaded.
        """
        self.system = system
        self.costs = costs if costs is not None else Costs()
        self.dialect = dialect if dialect is not None else Dialect()
        self.cycle: Cycle = cycle
        self.scheduler = Scheduler(
            clock=clock,
            seed=seed,
            speed=speed,
            quantum=self.costs.quantum,
            schedule="random" if switch_at_pers else schedule,
        )
        self.log = ControllerLog(self.scheduler)
        self.io = IOSystem(
            self.scheduler, self.log, system, lowest_first=self.dialect.bit_order == "lowest"
        )
        self.motion = MotionSystem(self.scheduler, robots, self.log, self.io)
        self.robot_data = {g.name: RobotData.of(g) for g in self.motion.groups.values()}
        """What programs have set, by motion group."""
        self._connect_background_tasks()
        if network is None:
            network = (
                SystemNetwork(self.scheduler, host=host or "127.0.0.1", ports=ports)
                if host or clock == "real"
                else MemoryNetwork(self.scheduler)
            )
        if faults is not None and faults.network:
            network = FaultyNetwork(network, self.scheduler, faults.network)
        self.network = network
        self.sockets = SocketTable(network, limited=self.dialect.sockets_limited)
        self.files = FileSystem(folder, home=system.home)
        self.operator = Operator(self.scheduler, answers)
        self.texts = TextTables()
        self.modules = ModuleTable()
        self.queues = QueueSystem(system.tasks)
        self.test_signals: dict[int, float] = {}
        """Values of the servos' test signals by channel."""
        self.configuration = SystemParameters(system, tuple(robots))
        self.options = Options(
            accounting="statement" if tracing or switch_at_pers else accounting,
            statement=self.costs.statement,
            operator=self.costs.operator,
            call=self.costs.call,
            builtin_scale=self.costs.builtin_scale,
            switching=switch_at_pers,
            tracing=tracing,
            dialect=self.dialect,
        )
        self.shared = Shared(self._configured(robots))
        self._parsed: dict[bytes, n.Module] = {}
        self._thread: threading.Thread | None = None
        self._stopping = False
        super().__init__()
        self.rapid_tasks = {
            spec.name: RapidTask(self.scheduler, spec, self, self.shared) for spec in system.tasks
        }
        self._views = {name: TaskView(task) for name, task in self.rapid_tasks.items()}
        self.diagnostics: list[Diagnostic] = []
        self._load()
        self.io.on_action = self.system_input
        self.io.on_end = self.system_input_ended
        self.power_up()
        if faults is not None:
            schedule_faults(faults, self)
        if autostart:
            self.start_program()

    def _connect_background_tasks(self) -> None:
        """Let background tasks act on the robot that their UseMechanicalUnitGroup names."""
        robots = {
            spec.mechanical_unit_group.lower(): group.name
            for spec in self.system.tasks
            if (group := self.motion.of_task(spec.name)) is not None and spec.motion
        }
        for spec in self.system.tasks:
            robot = robots.get(spec.mechanical_unit_group.lower())
            if robot is not None and spec.mechanical_unit_group and not spec.motion:
                self.motion.assign(spec.name, robot)
            elif spec.motion and (group := self.motion.of_task(spec.name)) is not None:
                self.motion.assign(spec.name, group.name, moving=True)

    # -- other ways in ---------------------------------------------------------------------------

    @classmethod
    def from_folder(cls, path: Path | str, **options: Any) -> Self:  # noqa: ANN401
        """A generated folder (its manifest tells the robots) or an ABB backup.

        DiagnosticError when it cannot be read.
        """
        from rapidgen.config import from_manifest
        from rapidgen.system import is_generated, read_manifest, read_system

        folder = Path(path)
        system = read_system(folder)
        if is_generated(folder):
            config = from_manifest(read_manifest(folder)["configuration"])
            system = in_its_cell(system, config)
            options.setdefault("robots", tuple(config.groups))
        return cls(system, **options)

    @classmethod
    def from_files(
        cls,
        files: Mapping[str, Sequence[Path | str]] | Sequence[Path | str],
        *,
        entry: str = "main",
        **options: Any,  # noqa: ANN401
    ) -> Self:
        """Loose module files: one task T_ROB1, or one for each key."""
        from rapidgen.system import read_files

        return cls(read_files(files, entry=entry), **options)

    @classmethod
    def from_config(
        cls,
        config: "RobotConfig | str | PathLike[str]",
        *,
        overrides: Sequence[str] = (),
        **options: Any,  # noqa: ANN401
    ) -> Self:
        """The driver that a configuration (a file, a shipped name) generates, without files.

        `overrides` are `key.path=value` texts. DiagnosticError when it has faults.
        """
        from rapidgen.controller.booting import generated_system

        system, model = generated_system(config, tuple(overrides))
        return cls(system, tuple(model.groups), **options)

    # -- loading ---------------------------------------------------------------------------------

    def _configured(self, robots: Sequence[GroupConfig]) -> dict[str, tuple[Any, Any]]:
        """Objects that the configuration predefines: signals, mechanical units, taskids."""
        found: dict[str, tuple[Any, Any]] = {}
        for task in self.system.tasks:
            kind = find_type("taskid")
            if kind is not None:
                found[f"{task.name.lower()}id"] = (kind, self._named(kind, task.name))
        for group in robots:
            for unit in (group.mechanical_unit, *group.external_units):
                kind = find_type("mecunit")
                if kind is not None and unit:
                    found[unit.lower()] = (kind, self._named(kind, unit))
        for signal in self.io.signals.values():
            kind = find_type(f"signal{signal.spec.type.lower()}")
            if kind is not None:
                found[signal.name.lower()] = (kind, signal)
        return found

    @staticmethod
    def _named(kind: Any, name: str) -> Any:  # noqa: ANN401
        made = kind.default()
        made.value = name
        return made

    def parse_module(self, file: ModuleFile) -> n.Module:
        """The tree of a module file; the same bytes are parsed once."""
        tree = self._parsed.get(file.data)
        if tree is None or tree.source.path != file.path:
            tree = parse(
                file.data, path=file.path, dialect=TextDialect(robotware=self.system.robotware)
            )
            self._parsed[file.data] = tree
        return tree

    def _load(self) -> None:
        found: list[Diagnostic] = []
        for task in self.rapid_tasks.values():
            trees = [(self.parse_module(file), file) for file in task.spec.modules]
            for tree, _ in trees:
                found += [d for d in tree.diagnostics if d not in found]
            task.program.load([(t, f) for t, f in trees if t.name])
            found += task.program.faults
            entry = task.program.find_routine(None, task.spec.entry.lower())
            if isinstance(entry, Routine) and entry.kind == "PROC" and not entry.parameters:
                task.state = "ready"
            else:
                found.append(self._no_entry(task))
            found += self._missing(task)
        self.diagnostics = found
        errors = [d for d in found if d.severity is Severity.ERROR]
        if errors:
            raise DiagnosticError(found)

    def _no_entry(self, task: RapidTask) -> Diagnostic:
        return Diagnostic(
            "RG402",
            Severity.WARNING if not task.spec.modules else Severity.ERROR,
            f"task {task.name} has no procedure {task.spec.entry} without parameters",
            help=f"declare PROC {task.spec.entry}() in one of its modules, or name another entry",
        )

    def _missing(self, task: RapidTask) -> list[Diagnostic]:
        """Routines that are called and do not exist here: said once for each name."""
        from rapidgen.runtime.compiler.missing import missing_routines

        return missing_routines(task.program)

    # -- stepping --------------------------------------------------------------------------------

    @property
    def now(self) -> float:
        """Simulated seconds since the controller was made."""
        return self.scheduler.now / _NS

    @property
    def tasks(self) -> Mapping[str, TaskView]:
        """Tasks by name."""
        return self._views

    def task(self, name: str) -> TaskView:
        """A task by name."""
        return self._views[name]

    @property
    def signals(self) -> Signals:
        """Values of the signals by name."""
        return Signals(self.io)

    def record(self) -> dict[str, Recorder]:
        """Record the motion of every group from now on: `["rob1"].recording()` gives arrays."""
        return self.motion.record()

    def run_for(self, seconds: float) -> None:
        """Let simulated time pass."""
        self.scheduler.advance(until=self.scheduler.now + round(seconds * _NS))

    def run_until(self, condition: Callable[[], bool], *, timeout: float | None = None) -> bool:
        """Let time pass until `condition()`, looked at after every event and slice.

        False when `timeout` s passed first. Deadlock when nothing is ahead that could change
        anything.
        """
        until = None if timeout is None else self.scheduler.now + round(timeout * _NS)
        outcome = self.scheduler.advance(until, condition)
        if outcome == "idle":
            raise Deadlock("\n".join(self.where()))
        return outcome == "stop"

    def run(
        self, *, max_time: float | None = None, max_statements: int | None = None
    ) -> Literal["finished", "time", "statements", "deadlock"]:
        """Let time pass until no task runs any more.

        `max_statements` bounds the work of all tasks, at the cost model's price of a statement.
        """
        scheduler = self.scheduler
        until = None if max_time is None else scheduler.now + round(max_time * _NS)
        price = max(1, self.costs.statement)
        spent = scheduler.now - scheduler.idle

        def exhausted() -> bool:
            if max_statements is None:
                return False
            return scheduler.now - scheduler.idle - spent > max_statements * price

        outcome = scheduler.advance(until, lambda: self._all_ended() or exhausted())
        if self._all_ended():
            return "finished"
        if outcome == "stop":
            return "statements"
        # Nothing ahead before the limit of time is a deadlock, however long one would wait.
        idle = scheduler.next_event() is None and not scheduler.ready and not self._computing()
        return "deadlock" if outcome == "idle" or idle else "time"

    def _all_ended(self) -> bool:
        return all(t.state != "running" for t in self.rapid_tasks.values())

    def _computing(self) -> bool:
        return self.scheduler.preempted is not None

    def where(self) -> list[str]:
        """For each running task where it is, as `task: file:line (routine)`."""
        lines = []
        for task in self.rapid_tasks.values():
            if task.state not in ("running", "stopped"):
                continue
            stack = task.stack()
            if stack:
                at = stack[-1]
                asks = self.operator.waits(task.name)
                lines.append(
                    f"{task.name}: {at.span.path}:{at.span.line} ({at.routine})"
                    + (f", {asks}" if asks else "")
                )
            else:
                lines.append(f"{task.name}: not started")
        return lines

    def address(self, group: str = "", *, timeout: float = 10.0) -> str:
        """Where a client finds a group's servers, once they listen: `HOST:MOTION,STATE[,CONTROL]`.

        For a controller that runs in a thread of its own (`start()`). TimeoutError when they do
        not listen within `timeout` s; KeyError for an unknown group.
        """
        name = group or next(iter(self.motion.groups))
        ports = self.motion.group(name).config.ports
        wanted = [port for port in (ports.motion, ports.state, ports.control) if port]
        listeners = self.network.listeners
        listening = threading.Event()

        def look() -> None:
            if all(port in listeners for port in wanted):
                listening.set()

        def watch() -> None:
            self.network.listening.add(look)
            look()

        self.call(watch)
        came = listening.wait(timeout)
        self.call(lambda: self.network.listening.remove(look))
        if not came:
            raise TimeoutError(f"no server listens on {wanted}: {'; '.join(self.where())}")
        numbers = ",".join(str(listeners[port][1]) for port in wanted)
        return f"{listeners[ports.motion][0]}:{numbers}"

    # -- real time -------------------------------------------------------------------------------

    def start(self) -> None:
        """Run in a thread of its own from now on. ValueError: the clock is not the real one."""
        if self.scheduler.clock != "real":
            raise ValueError('only clock="real" runs by itself; else use run_for and run_until')
        if self._thread is not None:
            return
        self._stopping = False
        self.scheduler.rebase()
        self._thread = threading.Thread(
            target=self._run_thread, name=f"virtual controller {self.system.name}", daemon=True
        )
        self._thread.start()

    def _run_thread(self) -> None:
        self.scheduler.advance(stop=lambda: self._stopping)

    def stop(self) -> None:
        """End the thread; the controller can be started again."""
        thread = self._thread
        if thread is None:
            return

        def end() -> None:
            self._stopping = True

        self.scheduler.post(end)
        thread.join()
        self._thread = None

    def call(self, function: Callable[[], Any]) -> Any:  # noqa: ANN401
        """Run `function` on the controller's thread and return what it returns."""
        thread = self._thread
        if thread is None or thread is threading.current_thread() or not thread.is_alive():
            return function()
        done = threading.Event()
        result: list[Any] = []

        def run() -> None:
            try:
                result.append(function())
            finally:
                done.set()

        self.scheduler.post(run)
        while not done.wait(_THREAD_LOOK):
            if not thread.is_alive() and not done.is_set():
                # A fault has ended the thread: nobody else runs anything any more.
                return function()
        if not result:
            raise RuntimeError("the controller's thread could not carry out the request")
        return result[0]

    def close(self) -> None:
        """Stop and give everything back: thread, sockets, files."""

        def end() -> None:
            # In one go: nothing may run between the tasks' end and the thread's.
            self._stopping = True
            self.scheduler.close_processes(self.rapid_tasks.values())

        self.call(end)
        self.stop()
        for name in self.rapid_tasks:
            self.sockets.close_task(name)
        self.network.shut_down()
        self.files.close()
        self.scheduler.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
