"""Virtual controller: scheduler, tasks, I/O, motion, files, network, log."""

import logging
import threading
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property, partial
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Literal, TypedDict, TypeVar, get_args

from rapidgen._compat import Self, Unpack
from rapidgen.config.model import GroupConfig, RobotConfig
from rapidgen.controller.boot_targets import Bootable, BootOptions, load_target
from rapidgen.controller.cell_setup import CellSetup, place_robots
from rapidgen.controller.event_log import ControllerLog
from rapidgen.controller.faults import FaultPlan
from rapidgen.controller.faults import schedule as schedule_faults
from rapidgen.controller.loading import configured, load
from rapidgen.controller.operation import OperatingMode, Operation, SystemSignals
from rapidgen.controller.thread import ControllerThread
from rapidgen.controller.views import Signals, TaskView, unknown
from rapidgen.machine.arc_equipment import ArcEquipment
from rapidgen.machine.cost_model import Costs
from rapidgen.machine.files import FileSystem
from rapidgen.machine.io import IOSystem
from rapidgen.machine.network.fault_injection import FaultyNetwork
from rapidgen.machine.network.interface import Network
from rapidgen.machine.network.memory import MemoryNetwork
from rapidgen.machine.network.sockets import SocketTable
from rapidgen.machine.network.system import PortMap, SystemNetwork
from rapidgen.machine.operator import Answer, Operator
from rapidgen.machine.scheduler import AdvanceEnd, ClockKind, Schedule, Scheduler, SyncPoints
from rapidgen.machine.sensors import ForceSensors, cameras
from rapidgen.machine.smart_gripper import Hands
from rapidgen.machine.text_tables import TextTables
from rapidgen.motion.egm.law import Profile
from rapidgen.motion.egm.sessions import Behaviour, Conditions, EgmSessions, profile_of
from rapidgen.motion.group import MotionGroup
from rapidgen.motion.recorder import Recorder
from rapidgen.motion.system import MotionSystem
from rapidgen.rapid import Dialect
from rapidgen.rapid.module_trees import tree_of
from rapidgen.rapid.switches import Switches
from rapidgen.rapid.syntax.nodes import Module
from rapidgen.runtime.compiler.emit.access import Options
from rapidgen.runtime.compiler.link import Shared
from rapidgen.runtime.motion_interface import RobotData
from rapidgen.runtime.queues import QueueSystem
from rapidgen.runtime.task.statement_hooks import Statements
from rapidgen.runtime.task.task import Task
from rapidgen.system.cfg_composition import database_of
from rapidgen.system.cfg_database import CfgDatabase
from rapidgen.system.model import ModuleFile, System
from rapidgen.system.releases import ANY_MINOR, UNKNOWN_ROBOTWARE

if TYPE_CHECKING:
    from rapidgen.controller.collision_monitor import CollisionMonitor
    from rapidgen.controller.collisions import CollisionSetup

_LOG = logging.getLogger("rapidgen.controller")

_T = TypeVar("_T")
_NS = 1_000_000_000
Cycle = Literal["once", "forever"]
Accounting = Literal["block", "statement", "none"]


_EGM_DEAD_TIMES = {"none": 0.0, "short": 0.008, "typical": 0.016, "long": 0.048}
_EGM_START = 1_700_000_000.0
"""s since 1970 at which a controller starts; any date, the same in each run."""


def _egm_release(system: System) -> tuple[int, int]:
    known = system.is_robotware_known and system.robotware != UNKNOWN_ROBOTWARE
    return system.robotware if known else (system.robotware[0], ANY_MINOR)


class Deadlock(Exception):
    """Every task waits, and no future event can wake one."""


class ControllerOptions(TypedDict, total=False):
    """Keyword arguments of `VirtualController`."""

    robots: Sequence[GroupConfig]
    clock: ClockKind
    seed: int
    speed: float
    costs: Costs | None
    dialect: Switches | None
    host: str
    ports: PortMap
    cycle: Cycle
    schedule: Schedule
    switch_at_pers: bool
    accounting: Accounting
    tracing: bool
    answers: Iterable[Answer] | None
    network: Network | None
    folder: Path | None
    faults: FaultPlan | None
    surroundings: CellSetup
    detection: "CollisionSetup | None"
    autostart: bool
    entry_needed: bool


class VirtualController:
    """A controller that executes the RAPID of a `System`.

    It belongs to the thread that steps it, or, after `start()`, to a thread of its own. Positions
    are rad and m by motion group; `tasks[name]["Module:name"]` is a raw RAPID value.
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
        dialect: Switches | None = None,
        host: str = "",
        ports: PortMap = 0,
        cycle: Cycle = "forever",
        schedule: Schedule = "round-robin",
        switch_at_pers: bool = False,
        accounting: Accounting = "block",
        tracing: bool = False,
        answers: Iterable[Answer] | None = None,
        network: Network | None = None,
        folder: Path | None = None,
        faults: FaultPlan | None = None,
        surroundings: CellSetup = CellSetup(),  # noqa: B008 - frozen
        detection: "CollisionSetup | None" = None,
        autostart: bool = True,
        entry_needed: bool = True,
    ) -> None:
        """Load every module; with `autostart` start all tasks in automatic mode.

        `detection` is the cell in which a collision stops the robots (`Bootable.collisions`).
        `host` selects the operating system's network (an address to bind); empty means in memory on
        the virtual clock and 127.0.0.1 on the real one. DiagnosticError: a module cannot be loaded
        or, with `entry_needed`, a task with modules has no entry routine.
        """
        self.system = system
        self.costs = costs if costs is not None else Costs()
        self.dialect = dialect if dialect is not None else Switches()
        for option, given, known in (
            ("cycle", cycle, get_args(Cycle)),
            ("accounting", accounting, get_args(Accounting)),
        ):
            if given not in known:
                raise ValueError(f"{option}={given!r} is none of {', '.join(known)}")
        if ports != "auto" and not isinstance(ports, int):
            raise ValueError(f'ports={ports!r} is neither "auto" nor a number to add to every port')
        if not speed >= 0:
            raise ValueError(f"speed={speed!r}: 1 is real time, 2 twice as fast, 0 stops time")
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
        """Settings of programs, by motion group."""
        self._connect_background_tasks()
        if network is None:
            network = (
                SystemNetwork(self.scheduler, host=host or "127.0.0.1", ports=ports)
                if host or clock == "real"
                else MemoryNetwork(self.scheduler)
            )
        if faults is not None:
            network = FaultyNetwork(network, self.scheduler, faults.network)
        self.network = network
        self.sockets = SocketTable(network, limited=self.dialect.sockets_limited)
        self.files = FileSystem(folder, home=system.home, home_below=system.home_below)
        self.operator = Operator(self.scheduler, answers)
        self.texts = TextTables()
        self.statements = Statements()
        self.queues = QueueSystem(system.tasks)
        self.test_signals: dict[int, float] = {}
        """Values of the servos' test signals by channel."""
        self.booked: set[int] = set()
        """Error numbers that BookErrNo gave."""
        self.meetings = SyncPoints()
        self.arcs = {t.name: ArcEquipment(self.io, system.arc, t.name) for t in system.tasks}
        """Welding equipment by task: `gas` flow, burning `arc`, and its `data`."""
        calibrated = self.dialect.hands_calibrated or surroundings.is_guess
        self.hands = Hands(self.scheduler, self.io, calibrated=calibrated)
        """Hands of a YuMi: `hands["L"].part = 12.0` puts a part between the fingers."""
        self.cameras = cameras(system.cameras, surroundings.cameras)
        """By lower-case name."""
        self.egm = EgmSessions(
            self.scheduler,
            self.log,
            # A release that is not known has all fields of its generation.
            _egm_release(system),
            system.udp_devices,
            self._guided_state,
            self._egm_profiles,
            Behaviour(
                _EGM_DEAD_TIMES[self.dialect.egm_dead_time],
                self.dialect.egm_convergence == "cycles",
                _EGM_START if self.dialect.egm_clock == "epoch" else 0.0,
            ),
        )
        """Externally guided motion: `egm.connect(device, partner)` gives a device a partner."""
        self.force = ForceSensors(surroundings.force)
        """Of the robots."""
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
        self.shared = Shared(configured(system, robots, self.io))
        release = Dialect(system.robotware)
        self.parse_module: Callable[[ModuleFile], Module] = partial(tree_of, dialect=release)
        self.recovered = self.log.recovered
        self.operation: Operation = Operation(self)
        signals = SystemSignals(self, self.operation)
        self._thread = ControllerThread(
            self.scheduler,
            f"virtual controller {system.name}",
            lambda: self.scheduler.close_processes(self.rapid_tasks.values()),
        )
        self.rapid_tasks: dict[str, Task] = {
            spec.name: Task(self.scheduler, spec, self, self.shared) for spec in system.tasks
        }
        self.statements.programs.extend(task.program for task in self.rapid_tasks.values())
        self.tasks: Mapping[str, TaskView] = {
            name: TaskView(task, self.operation) for name, task in self.rapid_tasks.items()
        }
        self.diagnostics = load(
            self.rapid_tasks.values(),
            self.parse_module,
            entries_wanted=entry_needed and not system.robot_types,
        )
        signals.connect()
        self.operation.power_up()
        loaded = sum(len(spec.modules) for spec in system.tasks)
        _LOG.info("%s: %d tasks, %d modules loaded", system.name, len(system.tasks), loaded)
        self.guessed = place_robots(self, surroundings)
        self.collisions: "CollisionMonitor | None" = None  # noqa: UP037 - imported below
        """Collision detection; None: there is none."""
        if detection is not None:
            # Slow to import, with NumPy and perhaps coal.
            from rapidgen.controller.collision_monitor import CollisionMonitor

            self.collisions = CollisionMonitor(self, detection)
        if faults is not None:
            schedule_faults(faults, self)
        if autostart:
            self.start_program()

    @cached_property
    def cfg(self) -> CfgDatabase:
        """The cfg database: all domains, instances and defaults."""
        return database_of(self.system, [g.config for g in self.motion.groups.values()])

    def _guided_state(self, task: str) -> Conditions:
        """Return the state that messages of externally guided motion contain."""
        return Conditions(self.operation.motors_on, self.rapid_tasks[task].state == "running")

    def _egm_profiles(self) -> dict[str, Profile]:
        """Return the external motion data of the configuration (MOC)."""
        rows = self.cfg.instances("MOC", "EXT_MOTION_DATA")
        return {row.text("name"): profile_of(row) for row in rows}

    def _connect_background_tasks(self) -> None:
        """Connect background tasks to the robot of UseMechanicalUnitGroup."""
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
    def boot(cls, result: Bootable, **options: Unpack[ControllerOptions]) -> Self:
        """Boot a target of `load_target`.

        Its robots and surroundings apply unless options replace them.
        """
        if "robots" not in options:
            options["robots"] = result.groups
            options.setdefault("surroundings", result.surroundings)
        return cls(result.system, **options)

    @classmethod
    def from_folder(
        cls,
        path: Path | str,
        *,
        backup: Path | str | None = None,
        robot: str = "",
        cell: Path | str = "",
        collisions: Literal["error", "warn", "off"] = "off",
        **options: Unpack[ControllerOptions],
    ) -> Self:
        """Boot a generated folder (robots from its manifest) or a backup.

        `backup` is that of the controller below a generated folder; `robot`, `cell` and
        `collisions` as in `from_files`. DiagnosticError: a file cannot be read, or a controller
        would not load it.
        """
        booted = load_target([path], BootOptions(backup=backup, robot=robot, cell=cell))
        options.setdefault("detection", booted.collisions(collisions))
        return cls.boot(booted, **options)

    @classmethod
    def from_files(
        cls,
        files: Mapping[str, Sequence[Path | str]] | Sequence[Path | str],
        *,
        entry: str = "main",
        robot: str = "",
        cell: Path | str = "",
        start: Sequence[float] = (),
        collisions: Literal["error", "warn", "off"] = "off",
        **options: Unpack[ControllerOptions],
    ) -> Self:
        """Boot loose module files: one task T_ROB1, or one for each key.

        `robot` is a shipped name or a configuration (default irb120), `cell` a cell description or
        "infer", `start` the robot's start position (deg, mm). With `collisions` "error", a contact
        in the cell stops the robots as collision detection does; "warn" only logs it.
        """
        if isinstance(files, str | Path):
            raise TypeError(f"files are a list, or a mapping of tasks to lists: [{str(files)!r}]")
        tasks = files if isinstance(files, Mapping) else {"T_ROB1": files}
        for task, names in tasks.items():
            if isinstance(names, str | Path):
                raise TypeError(f"the files of {task} are a list: [{str(names)!r}]")
        boot_options = BootOptions(tasks, robot=robot, entry=entry, cell=cell, start=start)
        booted = load_target((), boot_options)
        options.setdefault("detection", booted.collisions(collisions))
        return cls.boot(booted, **options)

    @classmethod
    def from_config(
        cls,
        config: "RobotConfig | str | PathLike[str]",
        *,
        overrides: Sequence[str] = (),
        **options: Unpack[ControllerOptions],
    ) -> Self:
        """Boot the driver generated from a configuration, without files.

        The configuration is a file or a shipped name; `overrides` are `key.path=value` texts.
        DiagnosticError: the configuration has faults.
        """
        if not isinstance(config, RobotConfig):
            return cls.boot(load_target([str(config)], BootOptions(overrides=overrides)), **options)
        from rapidgen.controller.cell import in_its_cell
        from rapidgen.generate import build, make_system

        options.setdefault("robots", tuple(config.groups))
        return cls(in_its_cell(make_system(config, build(config)), config), **options)

    # -- stepping --------------------------------------------------------------------------------

    @property
    def now(self) -> float:
        """Virtual seconds since the creation of the controller."""
        return self.scheduler.now / _NS

    def task(self, name: str) -> TaskView:
        """Return a task by name, or raise KeyError."""
        if name not in self.tasks:
            raise unknown("task", name, list(self.tasks))
        return self.tasks[name]

    @property
    def signals(self) -> Signals:
        """Values of the signals by name."""
        return Signals(self.io)

    def positions(self, group: str = "") -> dict[str, float]:
        """Return a robot's joint positions as controller axes, rad and m.

        The default is the first group. KeyError: unknown group.
        """
        result = self._group(group)
        return dict(zip(result.map.names, result.positions(), strict=True))

    def _group(self, name: str) -> MotionGroup:
        groups = self.motion.groups
        if name and name not in groups:
            raise unknown("motion group", name, list(groups))
        return groups[name or next(iter(groups))]

    def record(self) -> dict[str, Recorder]:
        """Record the motion of every group from now on.

        `["rob1"].recording()` returns arrays.
        """
        return self.motion.record()

    def run_for(self, seconds: float) -> None:
        """Let virtual time pass.

        RuntimeError: another thread lets time pass.
        """
        self._step(until=self.scheduler.now + round(seconds * _NS))

    def run_until(self, condition: Callable[[], bool], *, timeout: float | None = None) -> bool:
        """Let time pass until `condition()` is true.

        It is evaluated after every event and slice. Returns False after `timeout` s, or if a
        debugger paused. Deadlock: no future event could change the state.
        """
        until = None if timeout is None else self.scheduler.now + round(timeout * _NS)
        outcome = self._step(until, condition)
        if outcome == "idle":
            raise Deadlock("\n".join(self.where()))
        return outcome == "stop"

    def run(
        self, *, max_time: float | None = None, max_statements: int | None = None
    ) -> Literal["finished", "time", "statements", "deadlock", "paused"]:
        """Let time pass until no task runs and the robots stand still.

        A program that ends after a fly-by point finishes its movement. The result is `paused` if a
        debugger stops the clock. `max_statements` limits the work of all tasks, at the statement
        cost of the cost model.
        """
        scheduler = self.scheduler
        until = None if max_time is None else scheduler.now + round(max_time * _NS)
        price = max(1, self.costs.statement)
        spent = scheduler.now - scheduler.idle

        def exhausted() -> bool:
            if max_statements is None:
                return False
            return scheduler.now - scheduler.idle - spent > max_statements * price

        outcome = self._step(until, lambda: self._is_over() or exhausted())
        if self._is_over():
            return "finished"
        if outcome == "paused":
            return "paused"
        if outcome == "stop":
            return "statements"
        # No event before the time limit is a deadlock, even with a long limit.
        busy = scheduler.ready or scheduler.preempted is not None
        idle = scheduler.next_event() is None and not busy
        return "deadlock" if outcome == "idle" or idle else "time"

    def _step(self, until: int | None, stop: Callable[[], bool] | None = None) -> AdvanceEnd:
        if self._thread.owns_tasks:
            raise RuntimeError(
                "the controller runs in another thread, its own since start(): time passes there "
                "by itself, call() runs a function there"
            )
        return self.scheduler.advance(until, stop)

    def _is_over(self) -> bool:
        finished = all(task.state != "running" for task in self.rapid_tasks.values())
        return finished and all(group.is_standing for group in self.motion.groups.values())

    def where(self) -> list[str]:
        """Return `task: file:line (routine)` of each running task."""
        lines = []
        for task in self.rapid_tasks.values():
            if task.state not in ("running", "stopped"):
                continue
            stack = task.stack()
            if stack:
                at = stack[-1]
                why = f", {task.waits_for()}" if task.waits_for is not None else ""
                lines.append(f"{task.name}: {at.span.path}:{at.span.line} ({at.routine}){why}")
            else:
                lines.append(f"{task.name}: not started")
        return lines

    def address(self, group: str = "", *, timeout: float = 10.0) -> str:
        """Return the address of a group's servers once they listen.

        The format is `HOST:MOTION,STATE[,CONTROL]`. The controller must run in its own thread
        (`start()`). TimeoutError: not within `timeout` s; KeyError: unknown group.
        """
        ports = self._group(group).config.ports
        expected = [port for port in (ports.motion, ports.state, ports.control) if port]
        listeners = self.network.listeners
        listening = threading.Event()

        def look() -> None:
            if all(port in listeners for port in expected):
                listening.set()

        def watch() -> None:
            self.network.listening.add(look)
            look()

        self.call(watch)
        came = listening.wait(timeout)
        self.call(lambda: self.network.listening.remove(look))
        if not came:
            raise TimeoutError(f"no server listens on {expected}: {'; '.join(self.where())}")
        numbers = ",".join(str(listeners[port][1]) for port in expected)
        return f"{listeners[ports.motion][0]}:{numbers}"

    # -- modes and stops ---------------------------------------------------------------------------

    @property
    def mode(self) -> OperatingMode:
        """`auto`, `manual_reduced` or `manual_full`."""
        return self.operation.mode

    @property
    def motors_on(self) -> bool:
        """True if the motors are on."""
        return self.operation.motors_on

    @property
    def e_stop(self) -> bool:
        """True if the emergency stop is pressed."""
        return self.operation.e_stop

    @property
    def execution_error(self) -> bool:
        """True if an error stopped a task, and no start followed."""
        return self.operation.execution_error

    @property
    def failed(self) -> bool:
        """SYS FAIL: no start is possible until a restart."""
        return self.operation.failed

    def perform(self, action: str) -> None:
        """Execute an action of a user (operation.ACTIONS).

        Examples: `e-stop`, `motors-on`, `manual`.
        """
        self.operation.perform(action)

    def start_program(self) -> bool:
        """Start all tasks; return False if the state forbids it."""
        return self.operation.start_program()

    def stop_program(self) -> None:
        """Stop all NORMAL tasks and the robots, not (semi)static tasks."""
        self.operation.stop_program()

    def pp_to_main(self) -> None:
        """Set the program pointer of all NORMAL tasks to main."""
        self.operation.pp_to_main()

    def set_motors(self, on: bool) -> None:
        """Switch the motors on or off; off stops the program."""
        self.operation.set_motors(on)

    def set_e_stop(self, pressed: bool) -> None:
        """Press or reset the emergency stop; motors stay off after a reset."""
        self.operation.set_e_stop(pressed)

    def set_mode(self, mode: str) -> None:
        """Change the operating mode; the motors go off.

        ValueError: unknown mode.
        """
        self.operation.set_mode(mode)

    def power_loss(self) -> None:
        """Simulate a power failure and restart: a warm start."""
        self.operation.power_loss()

    def before_statement(
        self, task: str, module: str, line: int, count: int, action: Callable[[], None]
    ) -> None:
        """Call `action` before the `count`-th execution of a statement."""
        self.statements.before(task, module, line, count, action)

    # -- real time -------------------------------------------------------------------------------

    def start(self) -> None:
        """Run in a separate thread from now on.

        ValueError: the clock is not the real one. RuntimeError: the controller is closed, or its
        tasks run in the calling thread.
        """
        if not self._thread.owns_tasks and any(task.body for task in self.rapid_tasks.values()):
            raise RuntimeError(
                "its tasks run in the thread that has let time pass: call start() before run_for "
                "and run_until, or go on with these"
            )
        self._thread.start()

    def stop(self) -> None:
        """Stop the thread, and time with it; `start()` continues."""
        self._thread.stop()

    def call(self, function: Callable[[], _T]) -> _T:
        """Run `function` on the controller's thread and return its result.

        Exceptions of the function are raised here.
        """
        return self._thread.call(function)

    def close(self) -> None:
        """Stop and release thread, sockets and files."""
        # One call on the thread: nothing may run between the end of the tasks and of the thread.
        self._thread.close()
        for name in self.rapid_tasks:
            self.sockets.close_task(name)
        self.network.shut_down()
        self.files.close()
        self.scheduler.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
