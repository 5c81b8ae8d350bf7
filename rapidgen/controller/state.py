"""State of the whole controller: modes, motors, emergency stop, events, trust levels."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, get_args

from rapidgen.controller.event_log import ControllerLog
from rapidgen.machine.costs import Costs
from rapidgen.machine.files import FileSystem
from rapidgen.machine.io import IOSystem
from rapidgen.machine.scheduler import Scheduler, WaitSet
from rapidgen.motion.system import MotionSystem
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.symbols import Routine
from rapidgen.runtime.errors import FatalError
from rapidgen.runtime.loading import ModuleTable
from rapidgen.runtime.sockets import SocketTable
from rapidgen.runtime.switches import Dialect
from rapidgen.runtime.task.stepping import CannotStep
from rapidgen.runtime.task.task import Task
from rapidgen.system.model import System

if TYPE_CHECKING:
    from rapidgen.runtime.task.running import RapidTask

Tracer = Callable[[Task, Routine, n.Statement], None]


@dataclass(slots=True)
class Breakpoint:
    """An action that waits for a statement."""

    left: int
    action: Callable[[], None]


Mode = Literal["auto", "manual_reduced", "manual_full"]


class ControllerState:
    """Modes and stops, and what they do to tasks, motion and system outputs."""

    system: System
    scheduler: Scheduler
    log: ControllerLog
    io: IOSystem
    motion: MotionSystem
    files: FileSystem
    modules: ModuleTable
    sockets: SocketTable
    costs: Costs
    dialect: Dialect
    cycle: str
    rapid_tasks: "dict[str, RapidTask]"

    def __init__(self) -> None:
        self.mode: Mode = "auto"
        self.motors_on = True
        self.e_stop = False
        self.failed = False
        """SYS FAIL: a task of trust level SysFail stopped; nothing starts until a restart."""
        self.halted = False
        self.execution_error = False
        self.changed = WaitSet()
        """Whatever of the state changed."""
        self.booked: set[int] = set()
        """Error numbers that BookErrNo gave."""
        self.meetings: dict[object, object] = {}
        """Where tasks wait for each other (WaitSyncTask)."""
        self.tracers: list[Tracer] = []
        self._breakpoints: dict[tuple[str, str, int], list[Breakpoint]] = {}

    # -- power, motors, modes --------------------------------------------------------------------

    def power_up(self) -> None:
        """After switching on: outputs at their defaults, POWER_ON routines are due."""
        self.io.power_up()
        for task in self.rapid_tasks.values():
            task.power_up()
        self.log.info(10_011, "Motors ON state")
        self._report()

    def start_program(self) -> bool:
        """Start all tasks; False when the state does not allow it."""
        if self.failed or self.halted or self.e_stop or not self.motors_on:
            self.log.warning(10_126, "Program start refused", self._why_not())
            return False
        for group in self.motion.groups.values():
            way, _ = group.off_path
            if way > group.settings.regain_distance:
                far = f"{group.name} is {way:.3f} m from its path: move it back or PP to main"
                self.log.warning(10_126, "Program start refused", far)
                return False
        if self.execution_error:
            self.execution_error = False
            self.log.info(10_021, "Execution error reset")
        self.log.info(10_151, "Program started")
        for task in self.rapid_tasks.values():
            if task.state == "error" and task.place is None and task.spec.type == "NORMAL":
                self.log.warning(
                    10_126, "Program start refused", "PP to main first", task=task.name
                )
            task.start()
        for group in self.motion.groups.values():
            group.start("program")
        self._report()
        return True

    def _why_not(self) -> str:
        if self.e_stop:
            return "emergency stop"
        if self.failed:
            return "system failure state"
        return "a task halted the system" if self.halted else "motors are off"

    def step_program(self, task: "RapidTask", *, back: bool = False, over: bool = False) -> None:
        """Execute one statement of a task. CannotStep: not in this state, or not from there."""
        if self.failed or self.halted or self.e_stop or not self.motors_on:
            raise CannotStep(self._why_not())
        task.step(back=back, over=over)
        if not back:
            self.step_moves()
        self._report()

    def step_moves(self) -> None:
        """The robots may move during a step."""
        for group in self.motion.groups.values():
            group.start("program")

    def step_ended(self, task: "RapidTask") -> None:
        """A task has done its step."""
        self._stop_motion()

    def stop_program(
        self, *, quick: bool = False, event: Literal["STOP", "QSTOP", ""] = "STOP"
    ) -> None:
        """Stop all NORMAL tasks and the robots; (semi)static tasks go on.

        The routines of `event` run in every task that is stopped.
        """
        for task in self.rapid_tasks.values():
            if task.spec.type == "NORMAL":
                task.stop(event)
        for group in self.motion.groups.values():
            group.stop("program", quick=quick)
        self.log.info(10_125, "Program stopped")
        self._report()

    def pp_to_main(self) -> None:
        """Set the program pointer of all NORMAL tasks to main."""
        for task in self.rapid_tasks.values():
            if task.spec.type == "NORMAL":
                task.pp_to_main()
        for group in self.motion.groups.values():
            group.reset()
        self.log.info(10_002, "Program pointer has been reset")

    def drop_paths(self) -> None:
        """PP was moved, not to main: the path is gone, settings stay [S4 overview 4-24]."""
        for group in self.motion.groups.values():
            group.clear_path()

    def set_motors(self, on: bool, *, event: Literal["STOP", "QSTOP", ""] = "STOP") -> None:
        """Motors on or off; off stops the program, and the routines of `event` run."""
        if on and (self.e_stop or self.failed):
            self.log.warning(10_126, "Motors on refused", self._why_not())
            return
        if on == self.motors_on:
            return
        self.motors_on = on
        if on:
            self.halted = False
            self.log.info(10_011, "Motors ON state")
        else:
            self.log.info(10_010, "Motors OFF state")
            self.stop_program(quick=True, event=event)
        self._report()

    def set_e_stop(self, pressed: bool) -> None:
        """Press or reset the emergency stop; motors stay off after a reset."""
        if pressed == self.e_stop:
            return
        if pressed:
            self.log.error(10_013, "Emergency stop state")
            self.e_stop = True
            for group in self.motion.groups.values():
                by_brakes = group.settings.emergency_stop == "brakes"
                group.stop("program", quick=True, brakes=by_brakes)
            self.set_motors(False, event="QSTOP" if self.dialect.e_stop_routines else "")
        else:
            self.e_stop = False
            self.log.info(10_010, "Motors OFF state")
        self._report()

    def set_mode(self, mode: Mode) -> None:
        """Change the operating mode; a running program stops, the motors go off.

        ValueError: there is no such mode.
        """
        if mode not in get_args(Mode):
            raise ValueError(f"{mode!r} is none of {', '.join(get_args(Mode))}")
        if mode == self.mode:
            return
        self.stop_program()
        self.mode = mode
        if mode == "auto":
            self.log.info(10_017, "Automatic mode confirmed")
        else:
            self.log.info(10_015, "Manual mode selected")
        for group in self.motion.groups.values():
            group.reduced = mode == "manual_reduced"
        self.set_motors(False)
        self._report()

    def power_loss(self) -> None:
        """Power goes and comes back: a warm start. Sockets and files are closed."""
        self.log.error(10_140, "Power failure")
        for task in self.rapid_tasks.values():
            self.sockets.close_task(task.name)
            self.files.close_task(task.name)
            if task.spec.type == "SEMISTATIC":
                task.pp_to_main()
            else:
                task.stop("")
        for group in self.motion.groups.values():
            group.stop("program", brakes=True)
        self.failed = self.halted = False
        self.e_stop = False
        self.motors_on = False
        self.io.power_up()
        for task in self.rapid_tasks.values():
            task.power_up()
            if task.spec.type != "NORMAL":
                task.start()
        self._report()

    def perform(self, action: str) -> None:
        """One action of a fault plan or of the control socket."""
        match action:
            case "e-stop":
                self.set_e_stop(True)
            case "reset-e-stop":
                self.set_e_stop(False)
            case "motors-on":
                self.set_motors(True)
            case "motors-off":
                self.set_motors(False)
            case "auto":
                self.set_mode("auto")
            case "manual":
                self.set_mode("manual_reduced")
            case "start":
                self.start_program()
            case "stop":
                self.stop_program()
            case "pp-to-main":
                self.pp_to_main()
            case "power-loss":
                self.power_loss()
            case _:
                raise ValueError(f"unknown action {action}")

    def system_input(self, action: str, argument: str) -> None:
        """A signal of a system input rose (SYSSIG_IN)."""
        match action:
            case "Start":
                self.start_program()
            case "StartMain":
                self.pp_to_main()
                self.start_program()
            case "Stop" | "StopCycle" | "StopInstr":
                self.stop_program()
            case "QuickStop":
                self.stop_program(quick=True, event="QSTOP")
            case "MotorOn" | "MotOn":
                self.set_motors(True)
            case "MotorOff" | "MotOff":
                self.set_motors(False)
            case "MotOnStart" | "MotorOnStart":
                self.set_motors(True)
                self.start_program()
            case "PPMain":
                self.pp_to_main()
            case "ResetEstop":
                self.set_e_stop(False)
            case "ResetError":
                self.execution_error = False
                self._report()
            case "LimitSpeed":
                self._limit_speed(True)
            case _:
                self.log.warning(71_103, "System input not simulated", action, argument)

    def system_input_ended(self, action: str) -> None:
        """A signal of a system input fell."""
        if action == "LimitSpeed":
            self._limit_speed(False)

    def _limit_speed(self, limited: bool) -> None:
        for group in self.motion.groups.values():
            group.speed_limited = limited

    # -- tasks tell ------------------------------------------------------------------------------

    def task_changed(self, task: "RapidTask") -> None:
        """The state of a task changed."""
        self._report()

    def task_failed(self, task: "RapidTask", fatal: FatalError) -> None:
        """A task stopped with an error: log, and what its trust level says [S4 overview 4-45]."""
        place = str(fatal.stack[-1]) if fatal.stack else ""
        calls = " < ".join(str(p) for p in reversed(fatal.stack[-8:]))
        text = [t for t in fatal.arguments if t]
        if fatal.span is not None:
            place = f"{fatal.span.path}:{fatal.span.line}"
        self.log.error(fatal.event, fatal.title, place, *text, calls, task=task.name)
        self.execution_error = True
        if task.spec.type == "NORMAL":
            for other in self.rapid_tasks.values():
                if other is not task and other.spec.type == "NORMAL":
                    other.stop()
            self._stop_motion()
            self.log.error(10_020, "Execution error state", task=task.name)
            return
        match task.spec.trust:
            case "SysFail":
                self.failed = True
                self._stop_normal()
                self.motors_on = False
                self.log.error(20_095, "System failure state", "a warm start is needed")
            case "SysHalt":
                self.halted = True
                self._stop_normal()
                self.motors_on = False
                self.log.error(10_010, "Motors OFF state")
            case "SysStop":
                self._stop_normal()
            case "NoSafety":
                pass

    def _stop_normal(self) -> None:
        for other in self.rapid_tasks.values():
            if other.spec.type == "NORMAL":
                other.stop()
        self._stop_motion()

    def _stop_motion(self) -> None:
        for group in self.motion.groups.values():
            group.stop("program")

    def program_stopped(self, task: "RapidTask") -> None:
        """Stop or Break in a task: the other NORMAL tasks stop, too."""
        self.log.info(10_122, "Program stopped", task=task.name)
        if task.spec.type == "NORMAL":
            for other in self.rapid_tasks.values():
                if other is not task and other.spec.type == "NORMAL":
                    other.stop()

    def reset_task(self, task: Task, *, settings: bool = True) -> None:
        """PP to main of a task: its sockets and files are closed, its dynamic modules go.

        Without `settings` (PP to a routine) those of motion stay.
        """
        self.modules.drop_dynamic(task)
        self.sockets.close_task(task.name)
        self.files.close_task(task.name)
        group = self.motion.of_task(task.name)
        if settings and group is not None and self.motion.is_motion_task(task.name):
            group.reset()

    def event_routines(self, task: "RapidTask", event: str) -> Iterator[str]:
        """Names of the routines of an event (CAB_EXEC_HOOKS)."""
        for entry in self.system.events:
            mine = entry.task.lower() == task.name.lower() or (
                entry.all_motion_tasks and task.spec.motion
            )
            if mine and entry.event.upper().replace("_", "") == event.replace("_", ""):
                yield entry.routine

    # -- statements ------------------------------------------------------------------------------

    def before_statement(
        self, task: str, module: str, line: int, count: int, action: Callable[[], None]
    ) -> None:
        """Call `action` when a statement is reached for the `count`-th time."""
        key = (task.lower(), module.lower(), line)
        self._breakpoints.setdefault(key, []).append(Breakpoint(count, action))
        for own in self.rapid_tasks.values():
            if own.name.lower() == key[0]:
                own.program.trace_from_now()

    def statement(self, task: Task, point: int) -> None:
        """A traced statement is about to be executed."""
        routine, node = task.program.trace_points[point]
        for tracer in self.tracers:
            tracer(task, routine, node)
        module = routine.module
        if task.reached(module):  # type: ignore[attr-defined]
            task.step_ends()  # type: ignore[attr-defined]
        if not self._breakpoints or module is None:
            return
        line = module.tree.source.line(node.first)
        for waiting in self._breakpoints.get((task.name.lower(), module.name.lower(), line), ()):
            waiting.left -= 1
            if waiting.left == 0:
                waiting.action()
                task.attend()

    # -- system outputs --------------------------------------------------------------------------

    def _report(self) -> None:
        """Tell the system outputs and whoever waits."""
        report = self.io.report
        running = [t.state == "running" for t in self.rapid_tasks.values()]
        for task, runs in zip(self.rapid_tasks.values(), running, strict=True):
            report("TaskExecuting", runs, task.name)
        report("CycleOn", any(running))
        report("MotorOn", self.motors_on)
        report("MotorOff", not self.motors_on)
        report("AutoOn", self.mode == "auto")
        report("EmStop", self.e_stop)
        report("RunchOk", not self.e_stop)
        report("ExecError", self.execution_error)
        report("Error", self.execution_error or self.failed)
        self.changed.notify()
