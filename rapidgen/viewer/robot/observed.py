"""Robots observed over their state ports, read only."""

import queue
import threading
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Literal

from rapidgen.axes.kinematics import Kinematics
from rapidgen.client import Robot
from rapidgen.client.core.state import Event, State
from rapidgen.client.errors import RobotError
from rapidgen.config.model import GroupConfig
from rapidgen.viewer.appearance import PLAIN, Appearance
from rapidgen.viewer.messages import (
    Copy,
    Log,
    LogEntry,
    PanelState,
    Positions,
    Request,
    RobotPlace,
    Scene,
    ToPage,
)
from rapidgen.viewer.pose_snippets import copied
from rapidgen.viewer.provider import Handler, RequestRejected, StateProvider
from rapidgen.viewer.robots import ToolAndWorkObject, pose_of, side_by_side
from rapidgen.wire.simple_message.spec import EventType, Mode, TriState

_MODES: dict[Mode, Literal["auto", "manual_reduced"]] = {
    Mode.AUTO: "auto",
    Mode.MANUAL: "manual_reduced",
}
_KINDS: dict[EventType, Literal["info", "warning", "error"]] = {
    EventType.STATE_CHANGE: "info",
    EventType.WARNING: "warning",
    EventType.ERROR: "error",
}


class ObservedRobots:
    """Subject of the server: connected robots and their states."""

    def __init__(
        self, title: str, robots: Sequence[tuple[Robot, GroupConfig]], look: Appearance = PLAIN
    ) -> None:
        self._aspects = (
            _StateProvider(title, robots, look),
            _EventsProvider([r for r, _ in robots]),
        )
        self._functions: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()
        threading.Thread(target=self._run, name="view of robots", daemon=True).start()

    def _run(self) -> None:
        while True:
            self._functions.get()()

    def post(self, function: Callable[[], None]) -> bool:
        """Run a function on the thread of this view."""
        self._functions.put(function)
        return True

    def aspects(self) -> tuple[StateProvider, ...]:
        """Providers of states and events."""
        return self._aspects


class _StateProvider:
    """Positions and status of the robots."""

    def __init__(
        self, title: str, robots: Sequence[tuple[Robot, GroupConfig]], look: Appearance
    ) -> None:
        self._look = look
        self._title = title
        self._robots = [robot for robot, _ in robots]
        self._configs = [config for _, config in robots]
        self._drawings = [look.of(config) for config in self._configs]
        self._kinematics = [Kinematics.of(config) for config in self._configs]
        self._numbers: list[int] = []
        self._last_sent: PanelState | None = None
        # The client's clock has an arbitrary origin.
        self._began = min(robot.state.time for robot in self._robots)

    def whole(self) -> Iterable[ToPage]:
        """Return the robots, their positions and status."""
        yield Scene(
            title=self._title,
            kind="robot",
            may_command=False,
            groups=tuple(side_by_side(self._configs, self._drawings)),
            faults=self._look.faults,
        )
        states = [robot.state for robot in self._robots]
        yield self._positions(states)
        yield self._panel(states)

    def changes(self) -> Iterable[ToPage]:
        """Return positions of a new state, and a changed status."""
        states = [robot.state for robot in self._robots]
        numbers = [state.number for state in states]
        if numbers != self._numbers:
            self._numbers = numbers
            yield self._positions(states)
        panel = self._panel(states)
        if (
            self._last_sent is None
            or panel.model_copy(update={"time": self._last_sent.time}) != self._last_sent
        ):
            self._last_sent = panel
            yield panel

    def handlers(self) -> Mapping[type, Handler]:
        """Handlers of positions as text; the page cannot command a real robot."""
        return {Copy: self._copy}

    def _copy(self, request: Request) -> str:
        assert isinstance(request, Copy)
        for i, config in enumerate(self._configs):
            if config.name == request.group:
                map = self._robots[i].group.map
                posture = map.to_controller(self._robots[i].state.joints)
                carried = ToolAndWorkObject.configured(config)
                return copied(request, map, self._kinematics[i], posture, carried)
        raise RequestRejected(f"there is no robot {request.group}")

    def _positions(self, states: Sequence[State]) -> Positions:
        return Positions(
            time=max(state.time for state in states) - self._began,
            groups=tuple(self._place(i, state) for i, state in enumerate(states)),
        )

    def _place(self, i: int, state: State) -> RobotPlace:
        posture = self._robots[i].group.map.to_controller(state.joints)
        joints = self._drawings[i].values(state.joints)
        carried = ToolAndWorkObject.configured(self._configs[i])
        tcp = carried.tcp(self._kinematics[i], posture)
        return RobotPlace(
            joints=joints,
            commanded=joints,
            axes=posture,
            tcp=None if tcp is None else pose_of(tcp),
            tool=pose_of(carried.tool),
            tool_held=carried.held,
            work_object=pose_of(carried.object),
            standing=not state.is_moving,
        )

    def _panel(self, states: Sequence[State]) -> PanelState:
        status = states[0].status
        return PanelState(
            time=states[0].time - self._began,
            mode=_MODES.get(status.mode),
            motors_on=_known(status.drives),
            e_stop=_known(status.e_stopped),
            execution_error=any(state.status.in_error is TriState.TRUE for state in states),
            failed=False,
            running=_known(status.motion_possible),
            connected=all(map(_connected, self._robots)),
            tasks={},
            override=None,
            pace=None,
        )


class _EventsProvider:
    """The controller's event log, if the driver sends it."""

    def __init__(self, robots: Sequence[Robot]) -> None:
        self._robots = robots
        self._last_sent = 0

    def whole(self) -> Iterable[ToPage]:
        """Return the entries so far."""
        yield Log(entries=tuple(_entry(event) for event in self._robots[0].events))

    def changes(self) -> Iterable[ToPage]:
        """Return new entries."""
        new = [event for event in self._robots[0].events if event.number > self._last_sent]
        if new:
            self._last_sent = new[-1].number
            yield Log(entries=tuple(map(_entry, new)))

    def handlers(self) -> Mapping[type, Handler]:
        """There are no requests."""
        return {}


def _connected(robot: Robot) -> bool:
    try:
        return robot.is_connected
    except RobotError:
        return False


def _known(value: TriState) -> bool | None:
    return None if value is TriState.UNKNOWN else value is TriState.TRUE


def _entry(event: Event) -> LogEntry:
    return LogEntry(
        sequence=event.number,
        time=event.time,
        code=event.code,
        kind=_KINDS.get(event.type, "info"),
        title=event.title,
        texts=event.texts,
        task="",
    )
