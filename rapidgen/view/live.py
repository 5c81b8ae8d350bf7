"""What a monitor shows of a robot: rate, jitter, and what happened last. No terminal here."""

from collections import deque

import numpy as np

from rapidgen.client.core.state import Event, State, Status
from rapidgen.wire.simple_message.spec import Mode, TrajectoryState, TriState

_WINDOW = 500
_ACTIVITIES = {TrajectoryState.STARVED: "starved", TrajectoryState.PAUSED: "paused"}
_WORDS: dict[TrajectoryState | None, str] = {
    TrajectoryState.STARVED: "the stream ran out of points",
    TrajectoryState.PAUSED: "paused",
    TrajectoryState.FAILED: "the trajectory failed",
}


class Watcher:
    """Takes states one by one."""

    def __init__(self) -> None:
        self._intervals: deque[float] = deque(maxlen=_WINDOW)
        self._last: State | None = None
        self.event = ""
        """What changed last, empty before anything did."""
        self._told: Event | None = None

    def take(self, state: State) -> None:
        """The next state."""
        if self._last is not None:
            if state.number == self._last.number + 1:
                self._intervals.append(state.time - self._last.time)
            changed = changes(self._last.status, state.status)
            if state.trajectory is not self._last.trajectory and state.trajectory in _WORDS:
                changed.append(_WORDS[state.trajectory])
            if changed:
                self.event = "; ".join(changed)
        self._last = state

    def tell(self, event: Event | None) -> None:
        """The newest entry of the controller's log."""
        if event is not None and event != self._told:
            self._told = event
            self.event = str(event)

    def jitter(self) -> tuple[float, float]:
        """Median and 99th percentile of how far intervals are from their median, s."""
        if len(self._intervals) < 2:
            return 0.0, 0.0
        intervals = np.array(self._intervals)
        away = np.abs(intervals - np.median(intervals))
        return float(np.percentile(away, 50)), float(np.percentile(away, 99))


def activity(state: State) -> str:
    """What the robot is at, in a word."""
    if state.trajectory is not None and state.trajectory in _ACTIVITIES:
        return _ACTIVITIES[state.trajectory]
    return "moving" if state.is_moving else "standing"


def changes(before: Status, after: Status) -> list[str]:
    """What a change of status means, in words."""
    found = []
    for name, true, false in (
        ("drives", "motors on", "motors off"),
        ("e_stopped", "emergency stop", "emergency stop released"),
        ("in_motion", "began to move", "stands"),
        ("motion_possible", "motion possible", "motion not possible"),
    ):
        old, new = getattr(before, name), getattr(after, name)
        if old is not new and new is not TriState.UNKNOWN:
            found.append(true if new is TriState.TRUE else false)
    if before.mode is not after.mode:
        found.append(
            {Mode.AUTO: "automatic mode", Mode.MANUAL: "manual mode"}.get(
                after.mode, "mode unknown"
            )
        )
    if (before.in_error, before.error_code) != (after.in_error, after.error_code):
        found.append(error_text(after) or "error gone")
    return found


def error_text(status: Status) -> str:
    """The error in words; empty without one."""
    if status.in_error is not TriState.TRUE:
        return ""
    if status.error:
        joint = f" (joint {status.error_joint})" if status.error_joint else ""
        return f"error: {status.error.text}{joint}"
    return f"error {status.error_code}" if status.error_code else "error"
