"""A recording as the page's subject: the state at the current moment."""

import base64
import json
import threading
import time
from collections import deque
from collections.abc import Callable, Iterable, Mapping

from rapidgen.axes.kinematics import Kinematics
from rapidgen.axes.mapping import JointMap
from rapidgen.config.model import GroupConfig
from rapidgen.diagnostics import DiagnosticError
from rapidgen.viewer import messages as v
from rapidgen.viewer import panel_messages as p
from rapidgen.viewer.messages import Request, ToPage
from rapidgen.viewer.primitive_urdf import Drawing
from rapidgen.viewer.provider import Handler, RequestRejected, StateProvider
from rapidgen.viewer.recording import messages as m
from rapidgen.viewer.recording.reader import Moment, RecordingFile
from rapidgen.viewer.robots import ToolAndWorkObject, pose_of, side_by_side
from rapidgen.viewer.socket_log import Interpreter, SocketPiece

_CURVES = 1500
"""Number of points of a curve."""
_BACK, _PIECES = 3.0, 150
"""s before a moment, and data within them, shown of sockets."""


class RecordingSubject:
    """Subject of the server: `serve_page(RecordingSubject(file))`.

    One thread at a time uses it.
    """

    def __init__(self, file: RecordingFile) -> None:
        self._aspect = RecordedProvider(file)
        self._lock = threading.Lock()

    def post(self, function: Callable[[], None]) -> bool:
        """Run a function at once."""
        with self._lock:
            function()
        return True

    def aspects(self) -> tuple[StateProvider, ...]:
        """The only provider."""
        return (self._aspect,)


class _Seen:
    """A robot of the recording."""

    def __init__(self, config: GroupConfig, drawing: Drawing) -> None:
        self.config = config
        self.drawing = drawing
        self._map = JointMap.of(config)
        self._kinematics = Kinematics.of(config) if config.chain else None

    def place(self, moment: Moment) -> v.RobotPlace:
        """Recorded position."""
        joints = moment.joints.get(self.config.name)
        remaining = (0.0,) * len(self.config.joints)
        actual = joints.actual if joints else remaining
        commanded = joints.commanded if joints else remaining
        text = moment.carried.get(self.config.name)
        carried = _carried(text) if text is not None else ToolAndWorkObject.configured(self.config)
        tcp = carried.tcp(self._kinematics, actual)
        return v.RobotPlace(
            joints=self.drawing.values(self._map.to_urdf(actual)),
            commanded=self.drawing.values(self._map.to_urdf(commanded)),
            axes=actual,
            tcp=None if tcp is None else pose_of(tcp),
            tool=pose_of(carried.tool),
            tool_held=carried.held,
            work_object=pose_of(carried.object),
            standing=text is None or text.standing,
        )


class RecordedProvider:
    """Complete state of a recording at a moment."""

    def __init__(self, file: RecordingFile) -> None:
        self._file = file
        self._robots = [_Seen(config, file.look.of(config)) for config in file.robots]
        self._moment = file.at(file.begin)
        self._rate = 0.0
        self._looked = 0.0
        self._fault = ""
        self._listening = False
        self._task = next((robot.config.task for robot in self._robots), "")
        self._seen: tuple[object, ...] = ()
        self._sources: dict[str, int] = {}
        self._last_sent: dict[type, ToPage] = {}

    # -- state
    # ---------------------------------------------------------------------------------------

    def whole(self) -> Iterable[ToPage]:
        """Return the complete state of the moment."""
        yield v.Scene(
            title=self._file.title,
            kind="recording",
            may_command=False,
            groups=tuple(side_by_side(self._file.robots, [r.drawing for r in self._robots])),
            things=self._file.look.things,
            faults=self._file.look.faults,
        )
        yield from self._now()

    def changes(self) -> Iterable[ToPage]:
        """Return the changes; during playback the time advances."""
        now = time.monotonic()
        if self._rate:
            self._go_on((now - self._looked) * self._rate)
        self._looked = now
        seen = (self._moment, self._rate, self._task, self._fault, self._listening)
        if seen == self._seen:
            return
        self._seen = seen
        for message in self._now():
            if self._last_sent.get(type(message)) != message:
                self._last_sent[type(message)] = message
                yield message

    def _go_on(self, seconds: float) -> None:
        ahead = self._moment.time + seconds
        try:
            self._moment = self._file.at(ahead)
        except DiagnosticError as error:
            self._fault, self._rate = error.diagnostics[0].message, 0.0
        if ahead >= self._file.end:
            self._rate = 0.0

    def _now(self) -> Iterable[ToPage]:
        moment = self._moment
        yield v.Positions(
            time=moment.time, groups=tuple(robot.place(moment) for robot in self._robots)
        )
        if moment.panel is not None:
            yield self._panel(moment, moment.panel)
        yield v.Log(entries=tuple(map(_entry, moment.log)), fresh=True)
        yield v.AllSignals(
            signals=tuple(
                v.ShownSignal(name=name, value=moment.signals[name], **known.model_dump())
                for name, known in self._file.signals.items()
                if name in moment.signals
            )
        )
        yield p.Connections(sockets=tuple(map(_socket, moment.connections)))
        yield self._conversation(moment)
        yield self._loaded(moment)
        yield _pointers(moment)
        yield self._values(moment)
        yield p.Playback(
            begin=self._file.begin,
            end=self._file.end,
            time=moment.time,
            rate=self._rate,
            fault=self._fault or ("it was interrupted, and ends here" if self._file.cut else ""),
        )

    def _conversation(self, moment: Moment) -> p.Conversation:
        """Return the latest socket data if a viewer listens."""
        received: deque[SocketPiece] = deque(maxlen=_PIECES)
        if self._listening:
            begin = max(self._file.begin, moment.time - _BACK)
            for at, frame in self._file.frames(begin, moment.time):
                ends = (frame.task, frame.local, frame.peer)
                data = base64.b64decode(frame.data)
                received.append(SocketPiece(at, frame.change, *ends, data))
        interpreter = Interpreter()
        lines = tuple(line for piece in received for line in interpreter.lines(piece))
        return p.Conversation(listening=self._listening, lines=lines, fresh=True)

    def _panel(self, moment: Moment, panel: m.RecordedPanel) -> v.PanelState:
        tasks = {name: task.state for name, task in moment.tasks.items()}
        return v.PanelState.model_validate(
            {
                **panel.model_dump(),
                "time": moment.time,
                "running": "running" in tasks.values(),
                "tasks": tasks,
                "pace": self._rate,
            }
        )

    def _values(self, moment: Moment) -> p.FrameValues:
        """Return values of the watch list; no others are recorded."""
        watch = (
            p.SeenValue(name=x.expression, kind=x.type, text=x.text, settable=False)
            for x in moment.watch.values()
            if x.task == self._task
        )
        return p.FrameValues(task=self._task, level=-1, variables=(), watch=tuple(watch))

    def _loaded(self, moment: Moment) -> p.LoadedPrograms:
        tasks: dict[str, dict[str, int]] = {name: {} for name in moment.tasks}
        for (task, module), text in self._file.sources(moment.time).items():
            number = self._sources.setdefault(text, len(self._sources))
            tasks.setdefault(task, {})[module] = number
        return p.LoadedPrograms(
            tasks=tuple(p.LoadedModules(task=t, modules=modules) for t, modules in tasks.items())
        )

    # -- requests
    # ------------------------------------------------------------------------------------

    def handlers(self) -> Mapping[type, Handler]:
        """Handlers of scrubbing, playback, curves and sources."""
        return {
            p.Seek: _read(self._seek),
            p.Play: _read(self._play),
            p.ReadCurves: _read(self._curves),
            p.ReadSource: _read(self._source),
            p.SelectFrame: _read(self._look),
            p.Listen: _read(self._listen),
        }

    def _listen(self, request: Request) -> str:
        assert isinstance(request, p.Listen)
        self._listening = request.on
        return ""

    def _look(self, request: Request) -> str:
        assert isinstance(request, p.SelectFrame)
        self._task = request.task
        return ""

    def _seek(self, request: Request) -> str:
        assert isinstance(request, p.Seek)
        self._moment = self._file.at(request.time)
        return ""

    def _play(self, request: Request) -> str:
        assert isinstance(request, p.Play)
        self._fault = ""
        self._rate, self._looked = request.rate, time.monotonic()
        if self._moment.time >= self._file.end and request.rate:
            self._moment = self._file.at(self._file.begin)
        return ""

    def _source(self, request: Request) -> str:
        assert isinstance(request, p.ReadSource)
        match = next((t for t, number in self._sources.items() if number == request.number), None)
        if match is None:
            raise RequestRejected("it is not in the recording")
        return match

    def _curves(self, request: Request) -> str:
        """Return the data of the page's plots (PlotData of plot.ts)."""
        assert isinstance(request, p.ReadCurves)
        begin = max(request.begin, self._file.begin)
        end = min(request.end, self._file.end)
        robot = next((r for r in self._robots if r.config.name == request.robot), None)
        if robot is not None:
            rows = self._file.joints(request.robot, begin, end, _CURVES)
            times = [at for at, _ in rows]
            curves = []
            for i, joint in enumerate(robot.config.joints):
                curves.append({"name": joint.name, "values": [row.actual[i] for _, row in rows]})
            charts = [{"title": f"{request.robot}, axes", "unit": "rad, m", "curves": curves}]
        elif request.signal in self._moment.signals:
            changes = self._file.signal(request.signal, begin, end)
            # A signal keeps its value until it changes: a step has two points.
            times, values = [], []
            for (at, value), (until, _) in zip(changes, [*changes[1:], (end, 0.0)], strict=True):
                times += [at, max(at, until - 1e-6)]
                values += [value, value]
            curves = [{"name": request.signal, "values": values}]
            charts = [{"title": request.signal, "curves": curves}]
        else:
            raise RequestRejected("there is nothing of that name in the recording")
        return json.dumps({"time": times, "charts": charts})


def _read(handler: Handler) -> Handler:
    """Read a part of the file; report an unreadable one and continue."""

    def carried_out(request: Request) -> str:
        try:
            return handler(request)
        except DiagnosticError as error:
            raise RequestRejected(error.diagnostics[0].message) from error

    return carried_out


def _carried(text: m.CarriedFrames) -> ToolAndWorkObject:
    tool, placed = text.tool, text.work_object
    return ToolAndWorkObject(
        (tool.position, tool.orientation), text.held, (placed.position, placed.orientation)
    )


def _entry(line: m.LogLine) -> v.LogEntry:
    return v.LogEntry.model_validate(line.model_dump())


def _socket(frame: m.SocketFrame) -> p.ShownSocket:
    return p.ShownSocket(
        number=0, task=frame.task, status="connected", local=frame.local, peer=frame.peer
    )


def _place(at: m.ProgramPlace) -> p.SeenPlace:
    return p.SeenPlace.model_validate(at.model_dump())


def _pointers(moment: Moment) -> p.Pointers:
    return p.Pointers(
        time=moment.time,
        tasks=tuple(
            p.TaskPosition(
                name=name,
                state=task.state,
                stack=tuple(map(_place, task.stack)),
                motion=_place(task.motion) if task.motion is not None else None,
            )
            for name, task in moment.tasks.items()
        ),
    )
