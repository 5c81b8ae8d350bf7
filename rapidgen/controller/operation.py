"""Operating modes, stops and system signals of a controller."""

from collections.abc import Callable, Iterator, Mapping
from typing import Literal, Protocol, TypeAlias, get_args

from rapidgen.machine.scheduler import WaitSet
from rapidgen.motion.group import MotionGroup
from rapidgen.runtime.errors import FatalError
from rapidgen.runtime.host import Host, RapidTask
from rapidgen.runtime.task.interrupts import StopEvent
from rapidgen.runtime.task.pointer import CannotStep
from rapidgen.runtime.task.task import Task

# -- Operation -------------------------------------------------------------------------------------
#
# Modes, motors, emergency stop, and what starts and stops the tasks of a controller.


OperatingMode: TypeAlias = Literal["auto", "manual_reduced", "manual_full"]
_REFUSED = 10_126


class Tasks(Host, Protocol):
    """A controller whose tasks can be started and stopped."""

    @property
    def rapid_tasks(self) -> Mapping[str, Task]:
        """All tasks by name."""


class Operation:
    """State of one controller, and its effects on tasks and robots."""

    def __init__(self, host: Tasks) -> None:
        self._host = host
        self.mode: OperatingMode = "auto"
        self.motors_on = True
        self.e_stop = False
        self.failed = False
        """SYS FAIL: a task of trust level SysFail stopped; no start is possible until a restart."""
        self.halted = False
        self.in_error: set[str] = set()
        """Tasks that an error has stopped since the last start."""
        self.omitted: set[str] = set()
        """NORMAL tasks that are not selected: a start does not start them."""
        self.changed = WaitSet()
        """Whatever of the state changed."""

    @property
    def execution_error(self) -> bool:
        """True if an error has stopped a task."""
        return bool(self.in_error)

    @property
    def _groups(self) -> tuple[MotionGroup, ...]:
        return tuple(self._host.motion.groups.values())

    def _normal(self) -> Iterator[Task]:
        """Iterate over tasks that a program stop concerns.

        (Semi)static tasks continue.
        """
        return (task for task in self._host.rapid_tasks.values() if task.spec.type == "NORMAL")

    # -- power, motors, modes --------------------------------------------------------------------

    def power_up(self) -> None:
        """Set outputs to defaults and queue POWER_ON routines."""
        self._host.io.power_up()
        self._host.motion.zones.drop_all()
        for task in self._host.rapid_tasks.values():
            task.power_up()
        self._host.log.info(10_011, "Motors ON state")
        self.changed.notify()

    def set_motors(self, on: bool, *, event: StopEvent = "STOP") -> None:
        """Switch the motors on or off.

        Off stops the program and runs the routines of `event`.
        """
        if on and (self.e_stop or self.failed):
            self._host.log.warning(_REFUSED, "Motors on refused", self._why_not())
            return
        if on == self.motors_on:
            return
        self.motors_on = on
        if on:
            self.halted = False
            self._host.log.info(10_011, "Motors ON state")
        else:
            self._host.log.info(10_010, "Motors OFF state")
            self.stop_program(quick=True, event=event)
        self.changed.notify()

    def set_e_stop(self, pressed: bool) -> None:
        """Press or reset the emergency stop; motors stay off after a reset."""
        if pressed == self.e_stop:
            return
        if pressed:
            self._host.log.error(10_013, "Emergency stop state")
            self.e_stop = True
            for group in self._groups:
                by_brakes = group.settings.emergency_stop == "brakes"
                group.stop("program", quick=True, brakes=by_brakes)
            self.set_motors(False, event="QSTOP" if self._host.dialect.e_stop_routines else "")
        else:
            self.e_stop = False
            self._host.log.info(10_010, "Motors OFF state")
        self.changed.notify()

    def set_mode(self, mode: str) -> None:
        """Change the operating mode.

        A running program stops and the motors go off. ValueError: unknown mode.
        """
        expected = next((m for m in get_args(OperatingMode) if m == mode), None)
        if expected is None:
            raise ValueError(f"{mode!r} is none of {', '.join(get_args(OperatingMode))}")
        if expected == self.mode:
            return
        self.stop_program()
        self.mode = expected
        if expected == "auto":
            self._host.log.info(10_017, "Automatic mode confirmed")
        else:
            self._host.log.info(10_015, "Manual mode selected")
        for group in self._groups:
            group.reduced = expected == "manual_reduced"
        self.set_motors(False)
        self.changed.notify()

    def fail(self) -> None:
        """Enter SYS FAIL: motors off, no start until a restart."""
        self.failed = True
        self.motors_on = False
        self._host.log.error(20_095, "System failure state", "a warm start is needed")
        self.changed.notify()

    def power_loss(self) -> None:
        """Simulate a power failure and restart: a warm start.

        Sockets and files are closed.
        """
        host = self._host
        host.log.error(10_140, "Power failure")
        for task in host.rapid_tasks.values():
            host.sockets.close_task(task.name)
            host.files.close_task(task.name)
            if task.spec.type == "SEMISTATIC":
                task.pp_to_main()
            else:
                task.stop("")
        for group in self._groups:
            group.stop("program", brakes=True)
        self.failed = self.halted = False
        self.e_stop = False
        self.motors_on = False
        host.io.power_up()
        host.motion.zones.drop_all()
        for task in host.rapid_tasks.values():
            task.power_up()
            if task.spec.type != "NORMAL":
                task.start()
        self.changed.notify()

    # -- the program -----------------------------------------------------------------------------

    def start_program(self) -> bool:
        """Start all tasks; return False if the state forbids it."""
        log = self._host.log
        obstacle = self._why_not()
        for group in () if obstacle else self._groups:
            way, _ = group.off_path
            if not obstacle and way > group.settings.regain_distance:
                obstacle = f"{group.name} is {way:.3f} m from its path: move it back or PP to main"
        if obstacle:
            log.warning(_REFUSED, "Program start refused", obstacle)
            return False
        if self.execution_error:
            self.in_error.clear()
            log.info(10_021, "Execution error reset")
        log.info(10_151, "Program started")
        for task in self._host.rapid_tasks.values():
            if task.spec.type == "NORMAL" and task.name in self.omitted:
                continue
            lost = task.state == "error" and task.pointer.place is None
            if lost and task.spec.type == "NORMAL":
                log.warning(_REFUSED, "Program start refused", "PP to main first", task=task.name)
            if task.no_start and task.spec.modules:
                log.warning(_REFUSED, "Program start refused", task.no_start, task=task.name)
            task.start()
        self.step_moves()
        self.changed.notify()
        return True

    def _why_not(self) -> str:
        """Return why a start is forbidden, "" otherwise."""
        if self.e_stop:
            return "emergency stop"
        if self.failed:
            return "system failure state"
        if self.halted:
            return "a task halted the system"
        return "" if self.motors_on else "motors are off"

    def stop_program(self, *, quick: bool = False, event: StopEvent = "STOP") -> None:
        """Stop all NORMAL tasks and the robots, not (semi)static tasks.

        The routines of `event` run in every stopped task.
        """
        for task in self._normal():
            task.stop(event)
        self._stop_motion(quick=quick)
        self._host.log.info(10_125, "Program stopped")
        self.changed.notify()

    def pp_to_main(self) -> None:
        """Set the program pointer of all NORMAL tasks to main."""
        for task in self._normal():
            task.pp_to_main()
        for group in self._groups:
            group.reset()
        for arc in self._host.arcs.values():
            arc.reset()
        self._host.log.info(10_002, "Program pointer has been reset")

    def drop_paths(self) -> None:
        """Discard paths after a moved program pointer [S4 overview 4-24].

        It concerns moves other than to main; settings stay.
        """
        for group in self._groups:
            group.clear_path()

    def step_program(self, task: Task, *, back: bool = False, over: bool = False) -> None:
        """Execute one statement of a task.

        CannotStep: not in this state, or not at this place.
        """
        obstacle = self._why_not()
        if obstacle:
            raise CannotStep(obstacle)
        task.step(back=back, over=over)
        if not back:
            self.step_moves()
        self.changed.notify()

    def step_moves(self) -> None:
        """Permit robot motion during a step."""
        for arc in self._host.arcs.values():
            arc.go_on()
        for group in self._groups:
            group.start("program")

    def step_ended(self) -> None:
        """Record the end of a task's step."""
        self._stop_motion()

    def reset_error(self) -> None:
        """Acknowledge the error that stopped a task."""
        self.in_error.clear()
        self.changed.notify()

    def perform(self, action: str) -> None:
        """Execute one of ACTIONS. ValueError: unknown action."""
        if action not in ACTIONS:
            raise ValueError(f"unknown action {action}")
        ACTIONS[action](self)

    # -- reports of tasks ------------------------------------------------------------------------

    def task_changed(self) -> None:
        """Handle a changed task state."""
        self.changed.notify()

    def task_failed(self, task: RapidTask, fatal: FatalError) -> None:
        """Handle a task that stopped with an error.

        The trust level decides on the reaction [S4 overview 4-45].
        """
        log = self._host.log
        place = str(fatal.stack[-1]) if fatal.stack else ""
        calls = " < ".join(str(p) for p in reversed(fatal.stack[-8:]))
        text = [t for t in fatal.arguments if t]
        if fatal.span is not None:
            place = f"{fatal.span.path}:{fatal.span.line}"
        log.error(fatal.event, fatal.title, place, *text, calls, task=task.name)
        self.in_error.add(task.name)
        trust = task.spec.trust
        if task.spec.type == "NORMAL":
            self._stop_others(task)
            self._stop_motion()
            log.error(10_020, "Execution error state", task=task.name)
        elif trust != "NoSafety":
            self.halted = self.halted or trust == "SysHalt"
            self._stop_others(task)
            self._stop_motion()
            if trust == "SysFail":
                self.fail()
            elif trust == "SysHalt":
                self.motors_on = False
                log.error(10_010, "Motors OFF state")

    def program_stopped(self, task: RapidTask) -> None:
        """Stop the other NORMAL tasks after Stop or Break in a task."""
        self._host.log.info(10_122, "Program stopped", task=task.name)
        if task.spec.type == "NORMAL":
            self._stop_others(task)

    def _stop_others(self, task: RapidTask) -> None:
        for other in self._normal():
            if other is not task:
                other.stop()

    def _stop_motion(self, *, quick: bool = False) -> None:
        for arc in self._host.arcs.values():
            arc.hold()
        for group in self._groups:
            group.stop("program", quick=quick)


ACTIONS: Mapping[str, Callable[[Operation], object]] = {
    "e-stop": lambda operation: operation.set_e_stop(True),
    "reset-e-stop": lambda operation: operation.set_e_stop(False),
    "motors-on": lambda operation: operation.set_motors(True),
    "motors-off": lambda operation: operation.set_motors(False),
    "auto": lambda operation: operation.set_mode("auto"),
    "manual": lambda operation: operation.set_mode("manual_reduced"),
    "start": Operation.start_program,
    "stop": Operation.stop_program,
    "pp-to-main": Operation.pp_to_main,
    "power-loss": Operation.power_loss,
}
"""Actions of fault plans, the control socket and users, by name."""


# -- System signals --------------------------------------------------------------------------------
#
# System inputs and outputs: signals that act on the whole controller, and show its state.


class SystemSignals:
    """Connection of system inputs and outputs with the operation."""

    def __init__(self, host: Host, operation: Operation) -> None:
        self._host = host
        self._operation = operation
        operation.changed.add(self._report)

    def connect(self) -> None:
        """React to system inputs from now on."""
        self._host.io.on_action = self._rose
        self._host.io.on_end = self._fell

    def _rose(self, action: str, argument: str) -> None:
        """React to a rising signal of a system input (SYSSIG_IN)."""
        operation = self._operation
        match action:
            case "Start":
                operation.start_program()
            case "StartMain":
                operation.pp_to_main()
                operation.start_program()
            case "Stop" | "StopCycle" | "StopInstr" | "SoftStop":
                operation.stop_program()
            case "QuickStop":
                operation.stop_program(quick=True, event="QSTOP")
            case "MotorOn" | "MotOn":
                operation.set_motors(True)
            case "MotorOff" | "MotOff":
                operation.set_motors(False)
            case "MotOnStart" | "MotorOnStart":
                operation.set_motors(True)
                operation.start_program()
            case "PPMain" | "PpToMain":
                operation.pp_to_main()
            case "ResetEstop":
                operation.set_e_stop(False)
            case "ResetError":
                operation.reset_error()
            case "LimitSpeed":
                self._limit_speed(True)
            case _:
                self._host.log.warning(71_103, "System input not simulated", action, argument)

    def _fell(self, action: str) -> None:
        if action == "LimitSpeed":
            self._limit_speed(False)

    def _limit_speed(self, limited: bool) -> None:
        for group in self._host.motion.groups.values():
            group.speed_limited = limited

    def _report(self) -> None:
        """Set the system outputs."""
        operation, report = self._operation, self._host.io.report
        tasks = self._host.rapid_tasks.values()
        running = [t.state == "running" for t in tasks]
        for task, runs in zip(tasks, running, strict=True):
            report("TaskExecuting", runs, task.name)
            report("Error", task.name in operation.in_error, task.name)
        report("CycleOn", any(running))
        report("MotorOn", operation.motors_on)
        report("MotorOff", not operation.motors_on)
        report("AutoOn", operation.mode == "auto")
        report("EmStop", operation.e_stop)
        report("RunchOk", not operation.e_stop)
        report("ExecError", operation.execution_error)
        report("Error", operation.execution_error or operation.failed)
