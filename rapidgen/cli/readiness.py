"""The condition for the `ready` line of a controller in real time, and its failure."""

from typing import TYPE_CHECKING

from rapidgen.diagnostics import refusal

if TYPE_CHECKING:
    from rapidgen.controller.boot_targets import Bootable
    from rapidgen.controller.controller import VirtualController

READY_TIMEOUT = 10.0
"""Seconds in which the servers must accept connections."""
_POLL_PERIOD = 0.02
"""Seconds between two checks, which also wake a controller whose tasks all wait."""
_RUNNING_TIME = 0.2
"""Simulated seconds after which a program without servers counts as running."""


def required_ports(target: "Bootable") -> list[int]:
    """Return the ports on which a driver must listen before it is ready."""
    if not target.driver:
        return []
    ports = [group.ports for group in target.groups]
    return [n for p in ports for n in (p.motion, p.control, p.state) if n]


class Readiness:
    """Check a controller until its servers listen or its tasks wait."""

    def __init__(self, controller: "VirtualController", target: "Bootable") -> None:
        self._controller = controller
        self._target = target
        self._required = required_ports(target)
        self._begin = controller.now
        self._serving = [
            task
            for task in controller.rapid_tasks.values()
            if any(b"socketlisten" in module.data.lower() for module in task.spec.modules)
        ]
        self._check()

    def _check(self) -> None:
        scheduler = self._controller.scheduler
        if (
            not self.decided
            and self._controller.now - self._begin < READY_TIMEOUT * scheduler.speed
        ):
            scheduler.after(round(_POLL_PERIOD * scheduler.speed * 1e9), self._check)

    @property
    def decided(self) -> bool:
        """True if it is ready or will not become ready."""
        return self.up or self.failed

    @property
    def up(self) -> bool:
        """True if clients can connect.

        The ports of a driver listen. In other programs, each task with a server socket waits for
        a client or has ended.
        """
        listeners = self._controller.network.listeners
        if self._target.driver:
            return all(port in listeners for port in self._required)
        tasks = self._serving or list(self._controller.rapid_tasks.values())
        if self.failed or not all(
            task.state != "running" or task.waits_for is not None for task in tasks
        ):
            return not self._serving and self._controller.now - self._begin > _RUNNING_TIME
        return True

    @property
    def failed(self) -> bool:
        """True if an error stopped a task with a server socket, or any task without servers."""
        if self._target.driver or self._controller.network.listeners:
            return False
        tasks = self._serving or list(self._controller.rapid_tasks.values())
        return any(task.state == "error" for task in tasks)

    def refusal(self) -> Exception:
        """Return the error that explains why no server listens."""
        controller = self._controller
        missing = [port for port in self._required if port not in controller.network.listeners]
        ports = f" on port {', '.join(map(str, missing))}" if missing else ""
        states = tuple(f"{task.name} is {task.state}" for task in controller.tasks.values())
        faults = tuple(
            f"{task.name}: {task.fault.title}"
            for task in controller.tasks.values()
            if task.fault is not None
        )
        when = "any more" if self.failed else f"after {READY_TIMEOUT:g} s"
        return refusal(
            "RG430",
            None,
            f"no server listens{ports} {when}",
            "the event log above shows why the tasks did not start their servers",
            notes=(*states, *faults, *controller.where()),
            exit_code=1,
        )
