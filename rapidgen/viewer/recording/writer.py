"""Recorder of a running virtual controller.

It samples by the controller's own clock, so that a recording of the virtual clock does not depend
on the machine; positions are computed afterwards, from the formulas of the motion. The controller's
actions and their times do not change: a schedule is the same when recorded.
"""

import json
import math
from base64 import b64encode
from collections import deque
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import BinaryIO

from mcap.writer import Writer
from pydantic import BaseModel

from rapidgen import __version__
from rapidgen._json import Json, Members, items, members, text
from rapidgen.axes.kinematics import Posture
from rapidgen.config.manifest import group_to_manifest
from rapidgen.controller.controller import VirtualController
from rapidgen.controller.debugger.stack import StackFrame, frames_of, motion_pointer, where_it_looks
from rapidgen.controller.debugger.values import NotPaused, evaluate
from rapidgen.machine.event_log import Event
from rapidgen.machine.io import Signal
from rapidgen.machine.network.sockets import SocketNews
from rapidgen.motion.group import MotionGroup
from rapidgen.motion.recorder import Recorder
from rapidgen.runtime.errors import Location
from rapidgen.runtime.task.task import Task
from rapidgen.viewer.appearance import PLAIN, Appearance
from rapidgen.viewer.recording import appearance
from rapidgen.viewer.recording import messages as m
from rapidgen.viewer.robots import ToolAndWorkObject

TICK_NS = 16_666_667
"""Time between two samples of pointers and values: 60 a second."""
LATEST_EVENTS = 20
"""Number of events that a snapshot repeats."""
_ENDED = 192_800
"""Code of the event that reports it: a user's, as a program's own are."""
_CHUNK = 262_144
"""Size of a chunk in bytes: a few seconds, which a scrub has to read."""


class RecordingWriter:
    """Recorder of one controller, from its creation until `close()`.

    `watches` are expressions by task, evaluated at the task's position 60 times a second.
    """

    def __init__(
        self,
        controller: VirtualController,
        file: BinaryIO,
        watches: Iterable[tuple[str, str]] = (),
        look: Appearance = PLAIN,
    ) -> None:
        self._controller = controller
        self._scheduler = controller.scheduler
        # Rapidgen's reader checks each part that it reads. Other tools check the data as a whole.
        self._writer = Writer(file, chunk_size=_CHUNK, enable_data_crcs=True)
        self._writer.start(profile=m.PROFILE, library=f"rapidgen {__version__}")
        self._schemas: dict[type[m.Recorded], int] = {}
        self._channels: dict[str, int] = {}
        self.watches = list(watches)
        """The watch list, which may change at any time."""
        self._groups = controller.motion.groups
        self._recorders = {
            name: Recorder(self._scheduler, group) for name, group in self._groups.items()
        }
        self._next_sample = self._scheduler.now
        self._next_snapshot = self._scheduler.now
        self._last_sent: dict[str, m.Recorded] = {}
        self._stood: dict[str, tuple[Posture, Posture]] = {}
        """Last written sample by topic."""
        self._held: dict[str, int] = {}
        """Time until which the robot has been at rest since, by topic."""
        self._overview: dict[str, list[tuple[float, Posture, Posture]]] = {}
        self._sources: set[int] = set()
        self._events: deque[m.LogLine] = deque(map(_line, controller.log), LATEST_EVENTS)
        self._ends: list[Callable[[], None]] = []
        self._closed = False
        self._watch_controller()
        self._writer.add_metadata(
            m.METADATA,
            m.with_checksum(
                {"format": m.FORMAT, "title": controller.system.name, "version": __version__}
            ),
        )
        robots = [group_to_manifest(group.config) for group in self._groups.values()]
        self._attach(m.ROBOTS, json.dumps(robots).encode())
        kinds = {s.name: _kind(s).model_dump() for s in controller.io.signals.values()}
        self._attach(m.SIGNALS, json.dumps(kinds).encode())
        carried = appearance.carried(look)
        self._attach(m.LOOK, appearance.written(carried))
        for name, mesh in carried.files.items():
            self._attach(f"{m.MESHES}{name}", mesh, "application/octet-stream")
        self._tick()

    # -- state
    # ---------------------------------------------------------------------------------------

    def _watch_controller(self) -> None:
        controller = self._controller
        self._ends.append(controller.log.subscribe(self._event))
        controller.sockets.listeners.append(self._socket)
        self._ends.append(lambda: controller.sockets.listeners.remove(self._socket))
        for signal in controller.io.signals.values():
            self._follow(signal)

    def _follow(self, signal: Signal) -> None:
        def changed() -> None:
            self._write("signals", m.RecordedSignals(values={signal.name: signal.value}))

        signal.changed.add(changed)
        self._ends.append(lambda: signal.changed.remove(changed))

    def _event(self, event: Event) -> None:
        line = _line(event)
        self._events.append(line)
        self._write("log", line)

    def _socket(self, events: SocketNews) -> None:
        self._write("sockets", _frame(events))

    # -- samples
    # -------------------------------------------------------------------------------------

    def _tick(self) -> None:
        if self._closed:
            return
        self._samples()
        for name, group in self._groups.items():
            self._tell(f"carried/{name}", _carried(group, self._scheduler.now))
        for name, task in self._controller.rapid_tasks.items():
            self._tell(f"task/{name}", self._pointers(task))
        self._tell("panel", self._panel())
        for value in self._watched():
            self._tell("watch", value, f"watch {value.task} {value.expression}")
        if self._scheduler.now >= self._next_snapshot:
            self._new_sources()
            self._write_snapshot()
            self._next_snapshot = self._scheduler.now + m.SNAPSHOT_EVERY_NS
        self._scheduler.call_later_readonly(TICK_NS, self._tick)

    def _samples(self) -> None:
        """Write positions since the last sample."""
        now, first = self._scheduler.now, self._next_sample
        times = range(first, now + 1, m.JOINTS_PERIOD_NS)
        self._next_sample = first + len(times) * m.JOINTS_PERIOD_NS
        for name, recorder in self._recorders.items():
            topic = f"joints/{name}"
            text = self._stood.get(topic)
            for time, sample in zip(times, recorder.postures(times), strict=True):
                if sample == text:
                    self._held[topic] = time
                    continue
                if text is not None and (held := self._held.pop(topic, None)) is not None:
                    self._put(topic, _joints(text), held)
                text = self._stood[topic] = sample
                self._put(topic, _joints(sample), time)
            recorder.forget(self._next_sample)

    def _pointers(self, task: Task) -> m.TaskPointers:
        where = motion_pointer(self._controller, task.name)
        return m.TaskPointers.model_construct(
            state=task.state,
            stack=tuple(map(_entry, frames_of(task))),
            motion=_place(where) if where is not None else None,
            fault="" if task.fault is None else task.fault.title,
        )

    def _panel(self) -> m.RecordedPanel:
        c = self._controller
        return m.RecordedPanel.model_construct(
            mode=c.mode,
            motors_on=c.motors_on,
            e_stop=c.e_stop,
            execution_error=c.execution_error,
            failed=c.failed,
            override=min((g.override for g in self._groups.values()), default=1.0),
        )

    def _watched(self) -> Iterable[m.WatchedValue]:
        for name, expression in self.watches:
            task = self._controller.rapid_tasks.get(name)
            frame = where_it_looks(task) if task is not None else None
            kind, text = "", "(there is no program)"
            if task is not None and frame is not None:
                try:
                    displayed = evaluate(task.program, frame, expression)
                    kind, text = displayed.type, displayed.text
                except NotPaused as reason:
                    text = f"({reason})"
            yield m.WatchedValue(task=name, expression=expression, type=kind, text=text)

    def _write_snapshot(self) -> None:
        result = self._snapshot()
        self._write("snapshot", result)
        for name, joints in result.joints.items():
            row = (self._controller.now, joints.commanded, joints.actual)
            self._overview.setdefault(name, []).append(row)

    def _snapshot(self) -> m.Snapshot:
        now = self._scheduler.now
        positions = {name: r.postures([now])[0] for name, r in self._recorders.items()}
        controller = self._controller
        return m.Snapshot(
            joints={n: m.Joints(commanded=c, actual=a) for n, (c, a) in positions.items()},
            carried={name: _carried(group, now) for name, group in self._groups.items()},
            tasks={n: self._pointers(task) for n, task in controller.rapid_tasks.items()},
            panel=self._panel(),
            signals={s.name: s.value for s in controller.io.signals.values()},
            watch=tuple(self._watched()),
            connections=tuple(map(_frame, controller.sockets.connections())),
            log=tuple(self._events),
        )

    def _new_sources(self) -> None:
        for task in self._controller.rapid_tasks.values():
            for module in task.program.modules.values():
                if id(module) not in self._sources and not module.installed:
                    self._sources.add(id(module))
                    text = module.tree.source.text.encode()
                    self._attach(f"{m.SOURCES}{task.name}/{module.name}", text, "text/plain")

    # -- the file --------------------------------------------------------------------------------

    def _tell(self, topic: str, message: m.Recorded, key: str = "") -> None:
        """Write a message that differs from the last one of its type."""
        if self._last_sent.get(key or topic) != message:
            self._last_sent[key or topic] = message
            self._write(topic, message)

    def _write(self, topic: str, message: m.Recorded) -> None:
        self._put(topic, message.model_dump_json(), self._scheduler.now)

    def _put(self, topic: str, text: str, time: int) -> None:
        if self._closed:
            return
        data = text.encode()
        try:
            self._writer.add_message(self._channel(topic), time, data, time)
        except OSError as error:
            self._give_up(error)

    def _give_up(self, error: OSError) -> None:
        """Give up: the disk is full or missing.

        The controller continues; the written part is readable.
        """
        self._closed = True
        self._unsubscribe()
        self._controller.log.warning(_ENDED, "Recording ended", error.strerror or str(error))

    def _channel(self, topic: str) -> int:
        known = self._channels.get(topic)
        if known is None:
            kind = m.CHANNELS[topic.split("/", 1)[0]]
            schema = self._schemas.get(kind)
            if schema is None:
                names = [signal.name for signal in self._controller.io.signals.values()]
                text = json.dumps(plain_schema(kind, names)).encode()
                name = f"rapidgen.{kind.__name__}"
                schema = self._schemas[kind] = self._writer.register_schema(
                    name, "jsonschema", text
                )
            known = self._channels[topic] = self._writer.register_channel(
                f"/{topic}", "json", schema
            )
        return known

    def _attach(self, name: str, data: bytes, kind: str = "application/json") -> None:
        self._writer.add_attachment(0, self._scheduler.now, name, kind, data)

    def close(self) -> None:
        """End the recording and write the file's index.

        Harmless if it has ended.
        """
        if self._closed:
            return
        self._samples()
        for topic, time in self._held.items():
            self._put(topic, _joints(self._stood[topic]), time)
        self._new_sources()
        self._write_snapshot()
        if not self._closed:
            self._attach(m.OVERVIEW, json.dumps(self._overview).encode())
            self._closed = True
            self._unsubscribe()
            self._writer.finish()  # type: ignore[no-untyped-call]  # mcap's own

    def _unsubscribe(self) -> None:
        for end in self._ends:
            end()
        for recorder in self._recorders.values():
            recorder.stop()


def record(
    controller: VirtualController,
    path: Path | str,
    watches: Iterable[tuple[str, str]] = (),
    look: Appearance = PLAIN,
) -> Callable[[], None]:
    """Record a controller into a file until the returned function is called.

    `look` (`rapidgen.viewer.appearance.appearance`) is the appearance of its robots. Raises
    OSError.
    """
    file = Path(path).open("wb")  # noqa: SIM115 - closed with the recording
    writer = RecordingWriter(controller, file, watches, look)

    def end() -> None:
        writer.close()
        file.close()

    return end


def _joints(sample: tuple[Posture, Posture]) -> str:
    """Write joints 250 times a second: `m.Joints` without the model."""
    return f'{{"commanded":{list(sample[0])},"actual":{list(sample[1])}}}'


def _kind(signal: Signal) -> m.RecordedSignal:
    largest = None if math.isinf(signal.largest) else signal.largest
    return m.RecordedSignal(kind=signal.spec.type, device=signal.spec.device, largest=largest)


def _line(event: Event) -> m.LogLine:
    return m.LogLine.model_construct(
        sequence=event.sequence,
        time=event.time,
        code=event.code,
        kind=event.type.name.lower(),
        title=event.title,
        texts=event.texts,
        task=event.task,
    )


def _frame(events: SocketNews) -> m.SocketFrame:
    return m.SocketFrame.model_construct(
        change=events.change,
        task=events.task,
        local="{}:{}".format(*events.local),
        peer="{}:{}".format(*events.peer) if events.peer is not None else "",
        data=b64encode(events.data).decode(),
    )


def _carried(group: MotionGroup, now: int) -> m.CarriedFrames:
    move = group.motion.move(now)
    if move is not None:
        carrier = move.carrier.at(group.positions())
        tool, held, placed = carrier.tool, not carrier.stationary, carrier.object
    else:
        configured = ToolAndWorkObject.configured(group.config)
        tool, held, placed = configured.tool, configured.held, configured.object
    return m.CarriedFrames.model_construct(
        tool=m.RecordedFrame.model_construct(position=tool[0], orientation=tool[1]),
        held=held,
        work_object=m.RecordedFrame.model_construct(position=placed[0], orientation=placed[1]),
        standing=group.is_standing,
    )


def _entry(frame: StackFrame) -> m.StackEntry:
    at = frame.place
    return m.StackEntry.model_construct(
        module=at.module, routine=at.routine, line=at.span.line, level=frame.level
    )


def _place(at: Location) -> m.ProgramPlace:
    return m.ProgramPlace.model_construct(module=at.module, routine=at.routine, line=at.span.line)


def plain_schema(kind: type[BaseModel], signals: Iterable[str] = ()) -> Members:
    """Return the schema of a message; `values` of signals have their names."""
    complete: Members = kind.model_json_schema()
    made = _plain(complete, members(complete.get("$defs", {})))
    if "values" in members(made["properties"]):
        numbers: Members = {name: {"type": "number"} for name in signals}
        members(made["properties"])["values"] = {"type": "object", "properties": numbers}
    return made


def _plain(schema: Members, definitions: Members) -> Members:
    def inner(part: Json) -> Members:
        return _plain(members(part), definitions)

    if "$ref" in schema:
        return inner(definitions[text(schema["$ref"]).rpartition("/")[2]])
    if "anyOf" in schema:
        # A field that may be absent is null then.
        return inner(next(o for o in items(schema["anyOf"]) if members(o).get("type") != "null"))
    made: Members = {key: schema[key] for key in ("type", "description", "enum") if key in schema}
    if made["type"] == "object":
        own = members(schema.get("properties", {}))
        made["properties"] = {name: inner(part) for name, part in own.items()}
    if made["type"] == "array":
        # Numbers of a frame are separate columns of the same type.
        several = items(schema.get("prefixItems", []))
        made["items"] = inner(several[0] if several else schema["items"])
    return made
