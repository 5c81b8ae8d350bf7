"""When a controller in real time may be called ready, and why it is not."""

from typing import TYPE_CHECKING

from rapidgen.diagnostics import refusal

if TYPE_CHECKING:
    from rapidgen.controller.boot_targets import Bootable
    from rapidgen.controller.controller import VirtualController

PATIENCE = 10.0
"""Seconds that servers may take to come up."""
_LOOK = 0.02
"""Seconds between two looks: nothing else happens while every task waits for a client."""
_ENOUGH = 0.2
"""Simulated seconds after which a program that serves nobody is under way."""


def wanted_ports(target: "Bootable") -> list[int]:
    """Ports that a driver must listen on before it may be called ready."""
    if not target.driver:
        return []
    ports = [group.ports for group in target.groups]
    return [n for p in ports for n in (p.motion, p.control, p.state) if n]


class Readiness:
    """Looks at a controller until its servers listen, or its tasks have come to a wait."""

    def __init__(self, controller: "VirtualController", target: "Bootable") -> None:
        self._controller = controller
        self._target = target
        self._wanted = wanted_ports(target)
        self._begin = controller.now
        self._serving = [
            task
            for task in controller.rapid_tasks.values()
            if any(b"socketlisten" in module.data.lower() for module in task.spec.modules)
        ]
        self._look()

    def _look(self) -> None:
        scheduler = self._controller.scheduler
        if not self.decided and self._controller.now - self._begin < PATIENCE * scheduler.speed:
            scheduler.after(round(_LOOK * scheduler.speed * 1e9), self._look)

    @property
    def decided(self) -> bool:
        """Whether it is up, or will not come up."""
        return self.up or self.failed

    @property
    def up(self) -> bool:
        """Whether clients may come: a driver's ports listen; every task of a stranger's that
        listens at all has come to where it waits for somebody, or ended."""
        listeners = self._controller.network.listeners
        if self._target.driver:
            return all(port in listeners for port in self._wanted)
        tasks = self._serving or list(self._controller.rapid_tasks.values())
        if self.failed or not all(
            task.state != "running" or task.waits_for is not None for task in tasks
        ):
            return not self._serving and self._controller.now - self._begin > _ENOUGH
        return True

    @property
    def failed(self) -> bool:
        """Whether an error stopped a stranger's task that would have served, or all of them."""
        if self._target.driver or self._controller.network.listeners:
            return False
        tasks = self._serving or list(self._controller.rapid_tasks.values())
        return any(task.state == "error" for task in tasks)

    def refusal(self) -> Exception:
        """Why nothing listens."""
        controller = self._controller
        missing = [port for port in self._wanted if port not in controller.network.listeners]
        ports = f" on port {', '.join(map(str, missing))}" if missing else ""
        states = tuple(f"{task.name} is {task.state}" for task in controller.tasks.values())
        faults = tuple(
            f"{task.name}: {task.fault.title}"
            for task in controller.tasks.values()
            if task.fault is not None
        )
        when = "any more" if self.failed else f"after {PATIENCE:g} s"
        return refusal(
            "RG430",
            None,
            f"nothing listens{ports} {when}",
            "the event log above tells why the tasks do not get there",
            notes=(*states, *faults, *controller.where()),
            exit_code=1,
        )
