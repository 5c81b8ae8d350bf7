"""Pendant of a virtual controller: state, buttons, key, speed of time."""

from collections.abc import Iterable, Mapping

from rapidgen.controller.runner import ControllerRunner
from rapidgen.viewer.messages import (
    PanelState,
    PendantAction,
    Request,
    SetMode,
    SetOverride,
    SetPace,
    ToPage,
)
from rapidgen.viewer.provider import Handler, RequestRejected

_EVERY = 0.5
"""s of the controller's time between two updates of its clock alone."""


class PendantProvider:
    """State of the panel, and the requests that change it."""

    def __init__(self, runner: ControllerRunner) -> None:
        self._controller = runner.controller
        self._last_sent: PanelState | None = None

    def whole(self) -> Iterable[ToPage]:
        """Return the status."""
        yield self._status()

    def changes(self) -> Iterable[ToPage]:
        """Return the status if it differs or its time is old."""
        now, text = self._status(), self._last_sent
        same = text is not None and now.model_copy(update={"time": text.time}) == text
        if text is None or not same or now.time >= text.time + _EVERY:
            self._last_sent = now
            yield now

    def handlers(self) -> Mapping[type, Handler]:
        """Handlers of buttons, key, speed and pace."""
        return {
            PendantAction: self._act,
            SetMode: self._mode,
            SetOverride: self._override,
            SetPace: self._pace,
        }

    def _status(self) -> PanelState:
        c = self._controller
        tasks = {task.name: task.state for task in c.rapid_tasks.values()}
        return PanelState(
            time=c.now,
            mode=c.mode,
            motors_on=c.motors_on,
            e_stop=c.e_stop,
            e_stop_pressed=c.operation.e_stop_pressed,
            execution_error=c.execution_error,
            failed=c.failed,
            running=any(
                t.state == "running" for t in c.rapid_tasks.values() if t.spec.type == "NORMAL"
            ),
            tasks=tasks,
            override=min((g.override for g in c.motion.groups.values()), default=1.0),
            pace=c.scheduler.speed,
        )

    def _act(self, request: Request) -> str:
        assert isinstance(request, PendantAction)
        c = self._controller
        if request.action == "start" and not c.start_program():
            raise RequestRejected("the start was rejected: see the event log")
        if request.action == "pp-to-main" and self._status().running:
            raise RequestRejected("a program runs: stop it first")
        if request.action != "start":
            c.perform(request.action)
        if request.action == "motors-on" and not c.motors_on:
            raise RequestRejected("the motors stay off: see the event log")
        return ""

    def _mode(self, request: Request) -> str:
        assert isinstance(request, SetMode)
        self._controller.set_mode(request.mode)
        return ""

    def _override(self, request: Request) -> str:
        assert isinstance(request, SetOverride)
        for group in self._controller.motion.groups.values():
            group.override = request.value
        return ""

    def _pace(self, request: Request) -> str:
        assert isinstance(request, SetPace)
        self._controller.scheduler.pace(request.value)
        return ""
