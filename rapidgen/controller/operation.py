"""Operating modes, stops and system signals of a controller."""

from collections.abc import Callable, Iterator, Mapping
from typing import Literal, Protocol, TypeAlias, get_args

from rapidgen.controller.event_log import error_event, reach_arguments
from rapidgen.machine.event_log import EventType
from rapidgen.machine.event_table import Domain, domain_of
from rapidgen.machine.scheduler import WaitSet
from rapidgen.motion.group import MotionGroup
from rapidgen.runtime.errors import FatalError, MotionError
from rapidgen.runtime.host import Host, RapidTask
from rapidgen.runtime.task.interrupts import StopEvent
from rapidgen.runtime.task.pointer import CannotStep
from rapidgen.runtime.task.task import Task

# -- Operation -------------------------------------------------------------------------------------
#
# Modes, motors, emergency stop, and what starts and stops the tasks of a controller.


OperatingMode: TypeAlias = Literal["auto", "manual_reduced", "manual_full"]
_LOGS_ERROR_NUMBER = (5, 60)
"""First release whose logs have 40228 (and a warning before it) in place of 40223."""
_START_COMMAND = {True: "66", False: "142"}
"""Argument of a refused start, from 6.0 on and before."""


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
        self.e_stop_pressed = False
        """The button of the emergency stop; `e_stop` lasts until it is reset, too."""
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
        self._host.log.record(10_011)
        self.changed.notify()

    def set_motors(self, on: bool, *, event: StopEvent = "STOP") -> None:
        """Switch the motors on or off.

        Off stops the program and runs the routines of `event`.
        """
        if on and (self.e_stop or self.failed):
            if self.e_stop:
                self._host.log.record(20_202)
            else:
                self._host.log.record(192_095, self._why_not())
            return
        if on == self.motors_on:
            return
        self.motors_on = on
        if on:
            self.halted = False
            self._host.log.record(10_011)
        else:
            if not self.e_stop:
                self._host.log.record(10_010 if self.mode == "auto" else 10_012)
            self.stop_program(quick=True, event=event)
        self.changed.notify()

    def set_e_stop(self, pressed: bool) -> None:
        """Press the emergency stop, or release and reset it; motors stay off after a reset."""
        self.e_stop_pressed = pressed
        if pressed == self.e_stop:
            self.changed.notify()
            return
        if pressed:
            self._host.log.record(10_012)
            self._host.log.record(10_013)
            self.e_stop = True
            for group in self._groups:
                by_brakes = group.settings.emergency_stop == "brakes"
                group.stop("program", quick=True, brakes=by_brakes)
            self.set_motors(False, event="QSTOP" if self._host.dialect.e_stop_routines else "")
        else:
            self.e_stop = False
            self._host.log.record(10_010 if self.mode == "auto" else 10_012)
        self.changed.notify()

    def release_e_stop(self) -> None:
        """Release the button; the emergency stop lasts until it is reset."""
        self.e_stop_pressed = False
        self.changed.notify()

    def reset_e_stop(self) -> None:
        """Reset the emergency stop by a system input, which a pressed button prevents."""
        if self.e_stop_pressed:
            self._host.log.record(20_148, "ResetEstop")
        else:
            self.set_e_stop(False)

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
            for code in (10_016, 10_010, 10_017):
                self._host.log.record(code)
        else:
            for code in (10_015, 10_012):
                self._host.log.record(code)
        for group in self._groups:
            group.reduced = expected == "manual_reduced"
        if self.motors_on:
            self.motors_on = False
            self.stop_program(quick=True)
        self.changed.notify()

    def fail(self) -> None:
        """Enter SYS FAIL: motors off, no start until a restart."""
        self.failed = True
        self.motors_on = False
        self._host.log.record(10_014)
        self.changed.notify()

    def power_loss(self) -> None:
        """Simulate a power failure and restart: a warm start.

        Sockets and files are closed.
        """
        host = self._host
        host.log.record(192_140)
        host.log.record(10_045)
        for task in host.rapid_tasks.values():
            if task.interrupts.queue:
                host.log.record(40_210, task.name, task=task.name)
            host.sockets.close_task(task.name)
            host.files.close_task(task.name)
            if task.spec.type == "SEMISTATIC":
                task.pp_to_main()
            else:
                task.stop("")
        for group in self._groups:
            group.stop("program", brakes=True)
        self.failed = self.halted = False
        self.e_stop = self.e_stop_pressed = False
        self.motors_on = False
        host.io.power_up()
        host.motion.zones.drop_all()
        for task in host.rapid_tasks.values():
            task.power_up()
            if task.spec.type != "NORMAL":
                if task.spec.type == "SEMISTATIC":
                    host.log.record(10_002, self._number(task), "0", task.name, task=task.name)
                host.log.record(10_150, self._number(task), task.name, task=task.name)
                task.start()
        self.changed.notify()

    # -- the program -----------------------------------------------------------------------------

    def start_program(self) -> bool:
        """Start all tasks; return False if the state forbids it."""
        log = self._host.log
        if self._is_start_refused():
            return False
        tasks = [
            task
            for task in self._host.rapid_tasks.values()
            if task.spec.type != "NORMAL" or task.name not in self.omitted
        ]
        for task in tasks:
            if task.name in self.in_error:
                log.record(10_021, self._number(task), task.name, task=task.name)
        self.in_error.clear()
        log.record(10_052, "0")
        log.record(10_053, "0")
        for task in tasks:
            is_normal = task.spec.type == "NORMAL"
            if is_normal and task.state == "error" and task.pointer.place is None:
                log.record(10_097, task.name, task=task.name)
            elif task.no_start and task.spec.modules:
                log.record(192_097, task.no_start, task=task.name)
            elif is_normal and (task.run.fresh or task.state in ("ready", "finished")):
                log.record(10_151, self._number(task), task.name, task=task.name)
            elif is_normal and task.state in ("stopped", "error"):
                log.record(10_156, self._number(task), task.name, task=task.name)
            task.start()
        self.step_moves()
        self.changed.notify()
        return True

    def _is_start_refused(self) -> bool:
        """Return whether the state forbids a start, and record why."""
        log = self._host.log
        command = _START_COMMAND[self._host.system.robotware >= (6, 0)]
        if self.e_stop:
            log.record(20_075, command)
        elif self.failed or self.halted:
            log.record(192_095, self._why_not())
        elif not self.motors_on:
            log.record(20_072 if self.mode == "auto" else 20_074, command)
        else:
            for group in self._groups:
                distance, _ = group.off_path
                if distance > group.settings.regain_distance:
                    text = f"{group.name} is {distance:.3f} m from its path"
                    log.record(192_096, text, texts=("move it back, or PP to main",))
                    return True
            return False
        return True

    def _number(self, task: RapidTask) -> str:
        """Return the number of a task in the log: its place among the tasks, from 1."""
        return str(1 + list(self._host.rapid_tasks).index(task.name))

    def _log_stop(self, code: int, task: RapidTask) -> None:
        self._host.log.record(code, self._number(task), task.name, task=task.name)

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
            if task.state == "running":
                self._log_stop(10_125, task)
            task.stop(event)
        self._stop_motion(quick=quick)
        self.changed.notify()

    def pp_to_main(self) -> None:
        """Set the program pointer of all NORMAL tasks to main."""
        for task in self._normal():
            task.pp_to_main()
        for group in self._groups:
            group.reset()
        for arc in self._host.arcs.values():
            arc.reset()
        for task in self._normal():
            self._host.log.record(10_002, self._number(task), "0", task.name, task=task.name)

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
        """Record an error that stopped a task, and do what its trust level says.

        Trust levels: [S4 overview 4-45]. The order of the events is that of saved logs.
        """
        log = self._host.log
        is_motion_error = self._log_error(task, fatal)
        self.in_error.add(task.name)
        number, trust = self._number(task), task.spec.trust
        if task.spec.type == "NORMAL":
            log.record(10_020, number, task.name, task=task.name)
            if is_motion_error:
                self._fail_moving_tasks(task)
                self._log_stop(10_125, task)
            else:
                self._log_stop(10_126, task)
            self._stop_others(task)
            self._stop_motion()
            return
        log.record(10_020, number, task.name, task=task.name)
        if trust == "NoSafety":
            self._log_stop(10_126, task)
            return
        log.record(10_048, task.name, task=task.name)
        if trust == "SysFail":
            log.record(10_082, task.name, task=task.name)
        self._log_stop(10_126, task)
        if trust == "SysFail":
            self.fail()
        self.halted = self.halted or trust == "SysHalt"
        self._stop_others(task)
        self._stop_motion()
        if trust == "SysHalt":
            self.motors_on = False
            log.record(10_010)

    def _fail_moving_tasks(self, task: RapidTask) -> None:
        """Put the other motion tasks of MultiMove into the error state, too (RobotWare 6.03)."""
        for other in self._normal():
            if other is not task and other.spec.motion and other.state == "running":
                self.in_error.add(other.name)
                self._host.log.record(10_020, self._number(other), other.name, task=other.name)

    def _log_error(self, task: RapidTask, fatal: FatalError) -> bool:
        """Record the error itself; return whether it is one of the motion system."""
        log = self._host.log
        where = fatal.stack[-1] if fatal.stack else None
        place = str(where) if where is not None else ""
        calls = " < ".join(str(p) for p in reversed(fatal.stack[-8:]))
        texts = [t for t in fatal.arguments if t]
        if fatal.span is not None:
            place = f"{fatal.span.path}:{fatal.span.line}"
        code, arguments = fatal.event, (task.name, where.reference if where else "", *texts)
        if isinstance(fatal.cause, MotionError):
            arguments = reach_arguments(task, fatal.cause.text)
        elif fatal.cause is not None:
            name, text = fatal.arguments[0], fatal.cause.text
            code, arguments = error_event(task, name, text, where.reference if where else "")
        is_motion_error = domain_of(code) is Domain.MOTION
        has_number = self._host.system.robotware >= _LOGS_ERROR_NUMBER
        entry = (code, fatal.title, (place, *texts, calls), task.name, arguments)
        if has_number and not is_motion_error:
            log.add(EventType.WARNING, *entry)
        log.add(EventType.ERROR, *entry)
        if is_motion_error:
            return True
        if has_number:
            log.record(40_228, task.name, str(code), task=task.name)
        else:
            log.record(40_223, task.name, task=task.name)
        return False

    def program_stopped(self, task: RapidTask) -> None:
        """Stop the other NORMAL tasks after Stop or Break in a task."""
        self._log_stop(10_122, task)
        if task.spec.type == "NORMAL":
            self._stop_others(task)

    def _stop_others(self, task: RapidTask) -> None:
        for other in self._normal():
            if other is not task:
                if other.state == "running":
                    self._log_stop(10_125, other)
                other.stop()

    def _stop_motion(self, *, quick: bool = False) -> None:
        for arc in self._host.arcs.values():
            arc.hold()
        for group in self._groups:
            group.stop("program", quick=quick)


ACTIONS: Mapping[str, Callable[[Operation], object]] = {
    "e-stop": lambda operation: operation.set_e_stop(True),
    "release-e-stop": lambda operation: operation.release_e_stop(),
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
                operation.reset_e_stop()
            case "ResetError":
                operation.reset_error()
            case "LimitSpeed":
                self._limit_speed(True)
            case _:
                self._host.log.record(197_103, action, argument)

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
        until_reset = self._host.dialect.e_stop_output == "reset"
        report("EmStop", operation.e_stop if until_reset else operation.e_stop_pressed)
        report("RunchOk", not operation.e_stop)
        report("ExecError", operation.execution_error)
        report("Error", operation.execution_error or operation.failed)
