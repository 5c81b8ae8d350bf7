"""Reader of a recording: state at a moment, series for plots, frames."""

import csv
import json
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import BinaryIO, TypeVar

from pydantic import TypeAdapter, ValidationError

from rapidgen._compat import Self
from rapidgen._reading import open_foreign
from rapidgen.config.manifest import group_from_manifest
from rapidgen.config.model import GroupConfig
from rapidgen.diagnostics import refusal
from rapidgen.viewer.appearance import PLAIN, Appearance
from rapidgen.viewer.recording import appearance
from rapidgen.viewer.recording import messages as m
from rapidgen.viewer.recording.mcap_chunks import (
    Chunks,
    Contents,
    RecordingDamaged,
    StoredChunk,
    StoredMessage,
    look,
)

_NS = 1_000_000_000
_M = TypeVar("_M", bound=m.Recorded)
_T = TypeVar("_T")
EVENTS_KEPT = 50
_WHOLE = frozenset({"joints", "carried", "task", "panel"})
"""Topics whose messages are complete: only the last one counts."""
_SIGNALS: TypeAdapter[dict[str, m.RecordedSignal]] = TypeAdapter(dict[str, m.RecordedSignal])
_Row = tuple[float, tuple[float, ...], tuple[float, ...]]
_OVERVIEW: TypeAdapter[dict[str, list[_Row]]] = TypeAdapter(dict[str, list[_Row]])


@dataclass(slots=True, eq=False)
class Moment:
    """Complete state at a moment.

    Positions by robot, pointers by task.
    """

    time: float
    """s from the controller's start."""
    joints: dict[str, m.Joints] = field(default_factory=dict)
    carried: dict[str, m.CarriedFrames] = field(default_factory=dict)
    tasks: dict[str, m.TaskPointers] = field(default_factory=dict)
    panel: m.RecordedPanel | None = None
    signals: dict[str, float] = field(default_factory=dict)
    watch: dict[tuple[str, str], m.WatchedValue] = field(default_factory=dict)
    """By task and expression."""
    connections: list[m.SocketFrame] = field(default_factory=list)
    """Open sockets."""
    log: list[m.LogLine] = field(default_factory=list)
    """The latest events."""


class RecordingFile:
    """A recording.

    DiagnosticError RG930: the file is not a recording, or a part is unreadable.
    """

    def __init__(self, path: Path | str) -> None:
        self.path = Path(path)
        try:
            self._file: BinaryIO = open_foreign(self.path)
        except OSError as error:
            raise self._refused(error.strerror or str(error)) from error
        try:
            self._open()
        except BaseException:
            self._file.close()
            raise

    def _open(self) -> None:
        size = self.path.stat().st_size
        try:
            self._contents: Contents = look(self._file, size)
        except RecordingDamaged as error:
            raise self._refused(str(error)) from error
        known = self._contents.metadata.get(m.METADATA)
        if known is None:
            raise self._refused("rapidgen has not written it")
        if known.get("format") != m.FORMAT:
            raise self._refused(f"it has format {known.get('format')!r}, of another version")
        if known != m.with_checksum(known):
            raise self._refused("its title or version has been changed: the checksum is wrong")
        self.title = known.get("title", "")
        self.cut = self._contents.cut
        """True if it was interrupted; the rest can be viewed."""
        self._chunks = Chunks(self._file)
        self._topics = {n: topic.removeprefix("/") for n, topic in self._contents.channels.items()}
        pieces = self._contents.pieces
        if not pieces:
            raise self._refused("nothing is recorded in it")
        self.begin = min(piece.begin for piece in pieces) / _NS
        self.end = max(piece.end for piece in pieces) / _NS
        self.robots = self._robots()
        self.signals = self._attached(m.SIGNALS, _SIGNALS, {})
        """Properties of each signal by name."""
        self._overview = self._attached(m.OVERVIEW, _OVERVIEW, {})
        self.look = self._look()
        """Appearance of robots.

        Those without a drawing are drawn from their chain.
        """

    def _refused(self, why: str) -> Exception:
        return refusal(
            "RG930",
            None,
            f"{self.path}: {why}",
            "record again with `rapidgen sim --record FILE.mcap`",
        )

    def _robots(self) -> tuple[GroupConfig, ...]:
        for name, _, data in self._contents.attachments:
            if name == m.ROBOTS:
                try:
                    result = json.loads(data)
                    return tuple(group_from_manifest(one, self.path) for one in result)
                except (ValueError, TypeError, RecursionError) as error:
                    raise self._refused(f"its robots cannot be read: {error}") from error
        raise self._refused("it contains no robots")

    def _attached(self, name: str, kind: TypeAdapter[_T], otherwise: _T) -> _T:
        """Return the content of an attachment, if it exists."""
        for own, _, data in self._contents.attachments:
            if own == name:
                try:
                    return kind.validate_json(data)
                except ValidationError as error:
                    raise self._refused(f"its {name} cannot be read") from error
        return otherwise

    def _look(self) -> Appearance:
        saved = self._contents.attachments
        meshes = {
            name.removeprefix(m.MESHES): data
            for name, _, data in saved
            if name.startswith(m.MESHES)
        }
        for name, _, data in saved:
            if name == m.LOOK:
                try:
                    return appearance.read(data, meshes, self.robots)
                except ValueError as error:
                    raise self._refused(f"its look cannot be read: {error}") from error
        return PLAIN

    def sources(self, time: float) -> dict[tuple[str, str], str]:
        """Return the loaded text at a time, by task and module."""
        result = {}
        for name, at, data in self._contents.attachments:
            task, slash, module = name.removeprefix(m.SOURCES).partition("/")
            # A loaded module is noticed up to a second later.
            if name.startswith(m.SOURCES) and slash and at <= time * _NS + m.SNAPSHOT_EVERY_NS:
                result[task, module] = data.decode(errors="replace")
        return result

    # -- a moment --------------------------------------------------------------------------------

    def at(self, time: float) -> Moment:
        """Return the state at a time (s), limited to begin and end."""
        now = round(min(max(time, self.begin), self.end) * _NS)
        start = self._snapshot_before(now)
        moment = Moment(now / _NS)
        latest: dict[int, StoredMessage] = {}
        for message in self._messages(start, now):
            if self._topics.get(message.channel, "").partition("/")[0] in _WHOLE:
                latest[message.channel] = message
            else:
                self._apply(moment, message)
        for message in latest.values():
            self._apply(moment, message)
        return moment

    def _snapshot_before(self, time: int) -> int:
        """Time of the last snapshot up to a time.

        Without a snapshot it is that of the first message.
        """
        for piece in reversed(self._pieces(0, time)):
            for message in reversed(self._read(piece)):
                if message.time <= time and self._topics.get(message.channel) == "snapshot":
                    return message.time
        return 0

    def _apply(self, moment: Moment, message: StoredMessage) -> None:
        kind, _, name = self._topics.get(message.channel, "").partition("/")
        match kind:
            case "joints":
                moment.joints[name] = self._decoded(m.Joints, message)
            case "carried":
                moment.carried[name] = self._decoded(m.CarriedFrames, message)
            case "task":
                moment.tasks[name] = self._decoded(m.TaskPointers, message)
            case "panel":
                moment.panel = self._decoded(m.RecordedPanel, message)
            case "signals":
                moment.signals |= self._decoded(m.RecordedSignals, message).values
            case "log":
                moment.log = [*moment.log, self._decoded(m.LogLine, message)][-EVENTS_KEPT:]
            case "sockets":
                _connect(moment, self._decoded(m.SocketFrame, message))
            case "watch":
                value = self._decoded(m.WatchedValue, message)
                moment.watch[value.task, value.expression] = value
            case "snapshot":
                complete = self._decoded(m.Snapshot, message)
                moment.joints, moment.carried = dict(complete.joints), dict(complete.carried)
                moment.tasks, moment.panel = dict(complete.tasks), complete.panel
                moment.signals = dict(complete.signals)
                moment.watch = {(v.task, v.expression): v for v in complete.watch}
                moment.connections, moment.log = list(complete.connections), list(complete.log)

    # -- ranges ----------------------------------------------------------------------------------

    def pointers(self, begin: float, end: float) -> Iterator[tuple[float, str, m.TaskPointers]]:
        """Return times, tasks and their places between two times, s."""
        for message in self._messages(round(begin * _NS), round(end * _NS)):
            kind, _, name = self._topics.get(message.channel, "").partition("/")
            if kind == "task":
                yield message.time / _NS, name, self._decoded(m.TaskPointers, message)

    def frames(self, begin: float, end: float) -> Iterator[tuple[float, m.SocketFrame]]:
        """Return socket data between two times, s."""
        for message in self._messages(round(begin * _NS), round(end * _NS), "sockets"):
            yield message.time / _NS, self._decoded(m.SocketFrame, message)

    def log(self, begin: float, end: float) -> list[m.LogLine]:
        """Return events between two times, s."""
        result = self._messages(round(begin * _NS), round(end * _NS), "log")
        return [self._decoded(m.LogLine, message) for message in result]

    def joints(
        self, robot: str, begin: float, end: float, most: int = 2000
    ) -> list[tuple[float, m.Joints]]:
        """Return positions between two times, s; about `most`, evenly chosen.

        For a long time they are the samples of the snapshots, one a second.
        """
        first, last = round(begin * _NS), round(end * _NS)
        if (last - first) // m.JOINTS_PERIOD_NS > 20 * most and robot in self._overview:
            rows = [row for row in self._overview[robot] if begin <= row[0] <= end]
            step = max(1, len(rows) // most)
            return [(at, m.Joints(commanded=c, actual=a)) for at, c, a in rows[::step]]
        result = list(self._messages(first, last, f"joints/{robot}"))
        step = max(1, len(result) // most)
        chosen = [*result[::step], *result[-1:]]
        return [(x.time / _NS, self._decoded(m.Joints, x)) for x in chosen]

    def signal(self, name: str, begin: float, end: float) -> list[tuple[float, float]]:
        """Return times and values of a signal between two times, s.

        The value at the start, and each change.
        """
        result = [(begin, self.at(begin).signals[name])] if name in self.at(begin).signals else []
        for message in self._messages(round(begin * _NS) + 1, round(end * _NS), "signals"):
            values = self._decoded(m.RecordedSignals, message).values
            if name in values:
                result.append((message.time / _NS, values[name]))
        return result

    def write_csv(self, path: Path | str, robot: str = "") -> None:
        """Write positions of a robot (the first by default), one row a sample.

        Raises KeyError.
        """
        group = next((g for g in self.robots if robot in ("", g.name)), None)
        if group is None:
            raise KeyError(robot)
        names = [joint.name for joint in group.joints]
        with Path(path).open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(["time", *names, *(f"actual_{name}" for name in names)])
            topic = f"joints/{group.name}"
            for message in self._messages(0, round(self.end * _NS), topic):
                row = self._decoded(m.Joints, message)
                values = (*row.commanded, *row.actual)
                writer.writerow([f"{message.time / _NS:.6f}", *(f"{v:.9f}" for v in values)])

    # -- reading ---------------------------------------------------------------------------------

    def _messages(self, begin: int, end: int, topic: str = "") -> Iterator[StoredMessage]:
        """Return messages of a topic between two times inclusive, by time."""
        pieces = self._pieces(begin, end)
        # Chunks overlap a little: samples are written after other messages of the same time.
        for message in self._in_order(pieces):
            if begin <= message.time <= end and topic in ("", self._topics.get(message.channel)):
                yield message

    def _in_order(self, pieces: Sequence[StoredChunk]) -> Iterator[StoredMessage]:
        waiting: list[StoredMessage] = []
        for i, piece in enumerate(pieces):
            waiting = sorted([*waiting, *self._read(piece)], key=lambda x: (x.time, x.order))
            ahead = pieces[i + 1].begin if i + 1 < len(pieces) else None
            ready = (
                len(waiting)
                if ahead is None
                else bisect_right(waiting, ahead - 1, key=lambda x: x.time)
            )
            yield from waiting[:ready]
            waiting = waiting[ready:]
        yield from waiting

    def _pieces(self, begin: int, end: int) -> list[StoredChunk]:
        return [p for p in self._contents.pieces if p.begin <= end and p.end >= begin]

    def _read(self, piece: StoredChunk) -> tuple[StoredMessage, ...]:
        try:
            return self._chunks.messages(piece)
        except RecordingDamaged as error:
            raise self._refused(f"damaged at byte {piece.offset}: {error}") from error

    def _decoded(self, kind: type[_M], message: StoredMessage) -> _M:
        try:
            return kind.model_validate_json(message.data)
        except ValidationError as error:
            fault = error.errors(include_url=False, include_input=False)[0]
            raise self._refused(f"a message cannot be read: {fault['msg']}") from error

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _connect(moment: Moment, frame: m.SocketFrame) -> None:
    ends = (frame.task, frame.local, frame.peer)
    if frame.change in ("open", "close"):
        others = [c for c in moment.connections if (c.task, c.local, c.peer) != ends]
        moment.connections = [*others, frame] if frame.change == "open" else others
