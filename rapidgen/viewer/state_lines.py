"""Live state of a robot as a line, a JSON object or a table."""

import json
import math
import time
from collections import deque
from datetime import datetime, timezone

import numpy as np
from rich.table import Table

from rapidgen.client.core.group import Group
from rapidgen.client.core.motion import fix_of
from rapidgen.client.core.state import Event, State, Status
from rapidgen.wire.simple_message.spec import Mode, TrajectoryState, TriState

_WINDOW = 500
_ACTIVITIES = {TrajectoryState.STARVED: "starved", TrajectoryState.PAUSED: "paused"}
_TRUTH = {TriState.TRUE: True, TriState.FALSE: False, TriState.UNKNOWN: None}
_OTHER_COLUMNS = 53
"""Columns of the table without its bars, for names of twelve letters."""
_WORDS: dict[TrajectoryState | None, str] = {
    TrajectoryState.STARVED: "the stream ran out of points",
    TrajectoryState.PAUSED: "paused",
    TrajectoryState.FAILED: "the trajectory failed",
}


class StateStatistics:
    """Statistics of states: rate, jitter and the last change."""

    def __init__(self) -> None:
        self._intervals: deque[float] = deque(maxlen=_WINDOW)
        self._last: State | None = None
        self.event = ""
        """Last change, empty before the first."""
        self._last_sent: Event | None = None

    def take(self, state: State, text: Event | None = None) -> None:
        """The next state, and the newest entry of the controller's log."""
        if self._last is not None:
            if state.number == self._last.number + 1:
                self._intervals.append(state.time - self._last.time)
            changed = changes(self._last.status, state.status)
            if state.trajectory is not self._last.trajectory and state.trajectory in _WORDS:
                changed.append(_WORDS[state.trajectory])
            if changed:
                self.event = "; ".join(changed)
        self._last = state
        if text is not None and text != self._last_sent:
            self._last_sent = text
            self.event = str(text)

    def jitter(self) -> tuple[float, float]:
        """Median and 99th percentile of deviations of intervals, s.

        The deviation is that from their median.
        """
        if len(self._intervals) < 2:
            return 0.0, 0.0
        intervals = np.array(self._intervals)
        away = np.abs(intervals - np.median(intervals))
        return float(np.percentile(away, 50)), float(np.percentile(away, 99))


def activity(state: State) -> str:
    """Return the activity in a word, and whether a motion would be refused."""
    if state.trajectory is not None and state.trajectory in _ACTIVITIES:
        return _ACTIVITIES[state.trajectory]
    if state.is_moving:
        return "moving"
    held = state.status.motion_possible is TriState.FALSE
    return "standing, motion not possible" if held else "standing"


def changes(before: Status, after: Status) -> list[str]:
    """Describe the changes between two statuses."""
    result = []
    for name, true, false in (
        ("drives", "motors on", "motors off"),
        ("e_stopped", "emergency stop", "emergency stop released"),
        ("in_motion", "began to move", "stands"),
        ("motion_possible", "motion possible", "motion not possible"),
    ):
        old, new = getattr(before, name), getattr(after, name)
        if old is not new and new is not TriState.UNKNOWN:
            result.append(true if new is TriState.TRUE else false)
    if before.mode is not after.mode:
        result.append(
            {Mode.AUTO: "automatic mode", Mode.MANUAL: "manual mode"}.get(
                after.mode, "mode unknown"
            )
        )
    if (before.in_error, before.error_code) != (after.in_error, after.error_code):
        result.append(error_text(after) or "error gone")
    return result


def error_text(status: Status) -> str:
    """The error in words; empty without one."""
    if status.in_error is not TriState.TRUE:
        return ""
    if status.error:
        joint = f" (joint {status.error_joint})" if status.error_joint else ""
        fix = fix_of(status.error, "")
        return f"error: {status.error.text}{joint}{': ' if fix else ''}{fix}"
    return f"error {status.error_code}" if status.error_code else "error"


def as_line(state: State, watcher: StateStatistics, group: Group) -> str:
    """Return one line.

    Time of day, joints in degrees or mm, rate, mode, activity, last change.
    """
    units = [_unit(joint.kind) for joint in group.joints]
    values = (v * factor for v, (_, factor) in zip(state.joints, units, strict=True))
    words = [
        _received(state).astimezone().strftime("%H:%M:%S.%f")[:-3],
        " ".join(f"{round(value, 2) + 0.0:.2f}" for value in values)
        + f" {', '.join(dict.fromkeys(unit for unit, _ in units))}",
        f"{state.rate:.1f}/s",
        state.status.mode.name.lower(),
        activity(state),
        error_text(state.status),
        watcher.event,
    ]
    return "  ".join(word for word in words if word)


def as_json(state: State, watcher: StateStatistics) -> str:
    """Return one object; unknown values are null.

    Time of reception (ISO 8601, UTC), rad or m and their rates by joint, rate in 1/s, jitter in s.
    """
    status = state.status
    p50, p99 = watcher.jitter()
    return json.dumps(
        {
            "time": _received(state).isoformat("T", "milliseconds"),
            "joints": state.by_name,
            "velocity": dict(zip(state.names, state.velocity, strict=True)),
            "rate": state.rate,
            "jitter_p50": p50,
            "jitter_p99": p99,
            "mode": status.mode.name.lower(),
            "drives": _TRUTH[status.drives],
            "e_stopped": _TRUTH[status.e_stopped],
            "in_motion": _TRUTH[status.in_motion],
            "motion_possible": _TRUTH[status.motion_possible],
            "in_error": _TRUTH[status.in_error],
            "error_code": status.error_code,
            "trajectory": state.trajectory.name.lower() if state.trajectory is not None else None,
            "event": watcher.event,
        }
    )


def _received(state: State) -> datetime:
    return datetime.fromtimestamp(time.time() - state.age, timezone.utc)


def _unit(kind: str) -> tuple[str, float]:
    """Unit of joints of a kind, and its factor from rad or m."""
    return ("deg", 180 / math.pi) if kind == "revolute" else ("mm", 1000.0)


def rows(state: State, group: Group, bar: int = 31) -> list[tuple[str, str, str, str]]:
    """Rows of joint, value, speed and position within the limits.

    Degrees or mm, a bar of `bar` letters.
    """
    result = []
    for joint, value, speed, wire in zip(
        group.joints,
        state.joints,
        state.velocity,
        group.map.to_controller(state.joints),
        strict=True,
    ):
        unit, factor = _unit(joint.kind)
        current, moving = f"{value * factor:8.2f} {unit}", f"{speed * factor:7.1f} {unit}/s"
        result.append((joint.name, current, moving, _bar(wire, joint.lower, joint.upper, bar)))
    return result


def as_table(
    state: State, watcher: StateStatistics, group: Group, place: str, width: int = 100
) -> Table:
    """Return the rows with a heading (`place`) and the last change.

    The table is `width` columns wide.
    """
    status = state.status
    p50, p99 = watcher.jitter()
    table = Table(
        "joint",
        "value",
        "speed",
        "limits",
        title=f"{place}  {status.mode.name.lower()}  {activity(state)}",
        caption=f"{state.rate:.1f} states/s, jitter p50 {p50 * 1000:.1f} ms, p99 "
        f"{p99 * 1000:.1f} ms, age {state.age * 1000:.0f} ms\n"
        f"{error_text(status) or watcher.event or 'nothing happened yet'}",
    )
    for row in rows(state, group, min(31, max(7, width - _OTHER_COLUMNS))):
        table.add_row(*row)
    return table


def _bar(value: float, lower: float, upper: float, width: int) -> str:
    if not upper > lower or upper - lower == float("inf"):
        return "unknown"
    place = round((value - lower) / (upper - lower) * (width - 1))
    if not 0 <= place < width:
        return "outside"
    return "-" * place + "|" + "-" * (width - 1 - place)
