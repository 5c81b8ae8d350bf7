"""System inputs and outputs: signals that act on the whole controller, and show its state."""

from rapidgen.controller.operation import Operation
from rapidgen.runtime.host import Host


class SystemSignals:
    """Ties the system inputs and outputs of one controller to its operation."""

    def __init__(self, host: Host, operation: Operation) -> None:
        self._host = host
        self._operation = operation
        operation.changed.add(self._report)

    def connect(self) -> None:
        """Obey system inputs from now on."""
        self._host.io.on_action = self._rose
        self._host.io.on_end = self._fell

    def _rose(self, action: str, argument: str) -> None:
        """A signal of a system input rose (SYSSIG_IN)."""
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
