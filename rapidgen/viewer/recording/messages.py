"""Channels of a recording and their messages, JSON with a schema each.

Times are the controller's, ns from its start. Angles are rad, lengths m, quaternions q1..q4.
Changes are written when they occur; every second a `Snapshot` has everything once more, so that any
moment is a snapshot plus later changes. `/joints` has a sample every 4 ms with a motion; between
samples a robot is at rest.
"""

import json
import zlib
from collections.abc import Mapping
from typing import Final, Literal

from pydantic import BaseModel, ConfigDict

PROFILE: Final = "rapidgen"
FORMAT: Final = "2"
METADATA: Final = "rapidgen"
"""Name of the metadata: format, title, version, checksum."""
ROBOTS: Final = "robots.json"
"""Attachment: the configured groups."""
SIGNALS: Final = "signals.json"
"""Attachment: properties of each signal, `RecordedSignal` by name."""
OVERVIEW: Final = "overview.json"
"""Attachment at the end: positions of each robot once a second.

`[[time s, [..], [..]], ..]`
"""
LOOK: Final = "look.json"
"""Attachment: appearance of robots and cell, `RecordedAppearance`."""
MESHES: Final = "mesh/"
"""Attachments: meshes by their names in the appearance."""
SOURCES: Final = "source/"
"""Attachments TASK/MODULE: loaded sources, from their time on."""
JOINTS_PERIOD_NS: Final = 4_000_000
SNAPSHOT_EVERY_NS: Final = 1_000_000_000


def with_checksum(values: Mapping[str, str]) -> dict[str, str]:
    """Metadata with a checksum over the others: MCAP has none for them."""
    others = {key: value for key, value in values.items() if key != "checksum"}
    text = json.dumps(sorted(others.items()))
    return {**others, "checksum": f"{zlib.crc32(text.encode()):08x}"}


class Recorded(BaseModel):
    """Base of the parts of messages."""

    model_config = ConfigDict(frozen=True)


class Joints(Recorded):
    """Controller axes of a robot, in wire order."""

    commanded: tuple[float, ...]
    actual: tuple[float, ...]


class RecordedFrame(Recorded):
    """A frame: position m, orientation q1..q4."""

    position: tuple[float, float, float]
    orientation: tuple[float, float, float, float]


class CarriedFrames(Recorded):
    """Tool and work object.

    A tool is in the flange, or in the world if it is stationary.
    """

    tool: RecordedFrame
    held: bool
    work_object: RecordedFrame
    standing: bool


class ProgramPlace(Recorded):
    """Position in a program."""

    module: str
    routine: str
    line: int


class StackEntry(ProgramPlace):
    """A routine of a call stack, and the reason of its call."""

    level: Literal["program", "trap", "event"]


class TaskPointers(Recorded):
    """A task: its state, stack (outermost first), and its robot's move."""

    state: str
    stack: tuple[StackEntry, ...]
    motion: ProgramPlace | None
    fault: str = ""


class RecordedPanel(Recorded):
    """State of the controller."""

    mode: str
    motors_on: bool
    e_stop: bool
    execution_error: bool
    failed: bool
    override: float


class RecordedSignals(Recorded):
    """Signals that have changed."""

    values: dict[str, float]


class RecordedSignal(Recorded):
    """Properties of a signal."""

    kind: Literal["DI", "DO", "GI", "GO", "AI", "AO"]
    device: str
    largest: float | None


class LogLine(Recorded):
    """An event of the controller's log."""

    sequence: int
    time: float
    code: int
    kind: Literal["info", "warning", "error"]
    title: str
    texts: tuple[str, ...]
    task: str


class SocketFrame(Recorded):
    """Data of a socket of the program; `data` in base64."""

    change: Literal["open", "in", "out", "close"]
    task: str
    local: str
    peer: str
    data: str = ""


class WatchedValue(Recorded):
    """An expression of the watch list."""

    task: str
    expression: str
    type: str
    text: str


class Snapshot(Recorded):
    """Complete state at one time."""

    joints: dict[str, Joints]
    carried: dict[str, CarriedFrames]
    tasks: dict[str, TaskPointers]
    panel: RecordedPanel
    signals: dict[str, float]
    watch: tuple[WatchedValue, ...]
    connections: tuple[SocketFrame, ...]
    log: tuple[LogLine, ...]
    """The latest events."""


CHANNELS: Final[Mapping[str, type[Recorded]]] = {
    "joints": Joints,
    "carried": CarriedFrames,
    "task": TaskPointers,
    "panel": RecordedPanel,
    "signals": RecordedSignals,
    "log": LogLine,
    "sockets": SocketFrame,
    "watch": WatchedValue,
    "snapshot": Snapshot,
}
"""Prefix of each topic; a name follows `joints`, `carried` and `task`."""
