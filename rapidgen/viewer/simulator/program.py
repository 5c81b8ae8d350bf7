"""Programs of a virtual controller: sources, pointers, debugger."""

from collections.abc import Callable, Iterable, Mapping

from rapidgen.controller.debugger import (
    Breakpoint,
    DisplayedValue,
    NotPaused,
    PauseReason,
    PlacedBreakpoint,
)
from rapidgen.controller.debugger.stack import Level, StackFrame
from rapidgen.controller.runner import ControllerRunner
from rapidgen.controller.tracing import Coverage
from rapidgen.generate.source_map import origin_of
from rapidgen.runtime.errors import Location
from rapidgen.viewer import panel_messages as p
from rapidgen.viewer.messages import Request, ToPage
from rapidgen.viewer.provider import Handler, RequestRejected

_LINES = 200
"""Lines of log points that are sent."""
_COVERED_EVERY = 1.0
"""s of the controller's time between two counts of lines."""


class ProgramProvider:
    """Execution state and breakpoints, which survive a restart."""

    def __init__(self, runner: ControllerRunner) -> None:
        self._controller = runner.controller
        self._tasks = runner.controller.rapid_tasks
        self._debugger = runner.debugger
        self._texts: dict[str, int] = {}
        self._task = next(iter(self._tasks), "")
        self._level = -1
        self._watch: tuple[str, ...] = ()
        self._coverage: Coverage | None = None
        self._counted = -_COVERED_EVERY
        self._covered: dict[int, dict[int, int]] = {}
        self._rejecting: dict[type, ToPage] = {}

    # -- state
    # ---------------------------------------------------------------------------------------

    def whole(self) -> Iterable[ToPage]:
        """Return the complete state."""
        yield self._loaded()
        yield self._pointers()
        yield self._debugging()
        yield self._values()
        for source, lines in self._covered.items():
            yield p.Covered(source=source, lines=lines)

    def changes(self) -> Iterable[ToPage]:
        """Return the differences to the last sent state."""
        for now in (self._loaded(), self._pointers(), self._debugging(), self._values()):
            before = self._rejecting.get(type(now))
            if isinstance(now, p.Pointers) and isinstance(before, p.Pointers):
                before = before.model_copy(update={"time": now.time})
            if now != before:
                self._rejecting[type(now)] = now
                yield now
        yield from self._lines()

    def _loaded(self) -> p.LoadedPrograms:
        return p.LoadedPrograms(
            tasks=tuple(
                p.LoadedModules(
                    task=name,
                    modules={
                        module.name: self._number(module.tree.source.text)
                        for module in task.program.modules.values()
                        if not module.installed
                    },
                )
                for name, task in self._tasks.items()
            )
        )

    def _number(self, text: str) -> int:
        return self._texts.setdefault(text, len(self._texts))

    def _pointers(self) -> p.Pointers:
        seen = []
        for name, task in self._tasks.items():
            motion = self._debugger.motion_pointer(name)
            seen.append(
                p.TaskPosition(
                    name=name,
                    state=task.state,
                    stack=tuple(map(_of_frame, self._debugger.frames(name))),
                    motion=_place(motion) if motion is not None else None,
                )
            )
        return p.Pointers(time=self._controller.now, tasks=tuple(seen))

    def _debugging(self) -> p.Debugging:
        debugger = self._debugger
        return p.Debugging(
            halt=_halt(debugger.halt, self._controller.now) if debugger.halt is not None else None,
            breakpoints=tuple(map(_breakpoint, debugger.placed.values())),
            errors=debugger.errors,
            output=tuple(
                f"{entry.time:.3f}  {entry.task}  {entry.text}"
                for entry in debugger.output[-_LINES:]
            ),
        )

    def _values(self) -> p.FrameValues:
        """Return values, only while all tasks are stopped.

        Otherwise they would flicker, and evaluation is costly.
        """
        debugger = self._debugger
        halted = debugger.halt is not None
        frames = debugger.frames(self._task) if halted and self._task in self._tasks else ()
        level = len(frames) - 1 if self._level < 0 else min(self._level, len(frames) - 1)
        variables = debugger.variables(self._task, level) if frames else ()
        return p.FrameValues(
            task=self._task,
            level=level,
            variables=tuple(map(_value, variables)),
            watch=tuple(self._watched(text, level) for text in self._watch),
        )

    def _watched(self, text: str, level: int) -> p.SeenValue:
        if self._debugger.halt is None:
            return p.SeenValue(name=text, kind="", text="", settable=False)
        try:
            return _value(self._debugger.evaluate(self._task, text, level))
        except NotPaused as reason:
            return p.SeenValue(name=text, kind="", text=f"({reason})", settable=False)

    def _lines(self) -> Iterable[ToPage]:
        now = self._controller.now
        if self._coverage is None or now < self._counted + _COVERED_EVERY:
            return
        self._counted = now
        result = self._coverage.lines()
        for task in self._tasks.values():
            for module in task.program.modules.values():
                lines, number = (
                    result.get(module.file.path, {}),
                    self._texts.get(module.tree.source.text),
                )
                if number is not None and self._covered.get(number) != lines:
                    self._covered[number] = lines
                    yield p.Covered(source=number, lines=lines)

    # -- requests
    # ------------------------------------------------------------------------------------

    def handlers(self) -> Mapping[type, Handler]:
        """Handlers of all debugger commands."""
        result: dict[type, Handler] = {
            p.ReadSource: self._source,
            p.ReadOrigin: self._origin,
            p.SetBreakpoint: self._break,
            p.RemoveBreakpoint: self._unbreak,
            p.DebugCommand: self._drive,
            p.RunTo: self._run_to,
            p.RunFor: self._run_for,
            p.StopOnErrors: self._stop_on,
            p.SelectFrame: self._look,
            p.Evaluate: self._evaluate,
            p.Assign: self._assign,
            p.SetWatch: self._set_watch,
            p.CountLines: self._cover,
        }
        return {kind: _rejecting(handler) for kind, handler in result.items()}

    def _source(self, request: Request) -> str:
        assert isinstance(request, p.ReadSource)
        match = next((t for t, number in self._texts.items() if number == request.number), None)
        if match is None:
            raise RequestRejected("it is no longer loaded")
        return match

    def _origin(self, request: Request) -> str:
        assert isinstance(request, p.ReadOrigin)
        for task in self._tasks.values():
            for module in task.program.modules.values():
                text = module.tree.source.text
                if self._texts.get(text) == request.number and module.file.origin:
                    result = origin_of(text, module.file.origin)
                    entry = p.SourceOrigin(lines=result.lines, templates=dict(result.templates))
                    return entry.model_dump_json()
        raise RequestRejected("no template made it")

    def _break(self, request: Request) -> str:
        assert isinstance(request, p.SetBreakpoint)
        requested = Breakpoint(
            request.module,
            request.line,
            request.task,
            request.condition,
            request.hits,
            request.log,
        )
        try:
            if request.number:
                self._debugger.change(request.number, requested)
                return str(request.number)
            placed = self._debugger.add(requested)
        except KeyError as error:
            raise RequestRejected("that breakpoint has been deleted") from error
        except ValueError as error:
            raise RequestRejected(str(error)) from error
        if not placed.line:
            self._debugger.remove(placed.number)
            raise RequestRejected(placed.doubt)
        return str(placed.number)

    def _unbreak(self, request: Request) -> str:
        assert isinstance(request, p.RemoveBreakpoint)
        self._debugger.remove(request.number)
        return ""

    def _drive(self, request: Request) -> str:
        assert isinstance(request, p.DebugCommand)
        match request.how:
            case "pause":
                self._debugger.pause()
            case "resume":
                self._debugger.resume()
            case kind:
                self._known(request.task)
                self._debugger.step(request.task, kind)
        return ""

    def _run_to(self, request: Request) -> str:
        assert isinstance(request, p.RunTo)
        self._known(request.task)
        self._debugger.run_to(request.task, request.module, request.line)
        return ""

    def _run_for(self, request: Request) -> str:
        assert isinstance(request, p.RunFor)
        self._debugger.run_for(request.seconds)
        return ""

    def _stop_on(self, request: Request) -> str:
        assert isinstance(request, p.StopOnErrors)
        self._debugger.errors = request.errors
        return ""

    def _look(self, request: Request) -> str:
        assert isinstance(request, p.SelectFrame)
        self._known(request.task)
        self._task, self._level = request.task, request.level
        return ""

    def _evaluate(self, request: Request) -> str:
        assert isinstance(request, p.Evaluate)
        result = self._debugger.evaluate(self._task, request.expression, self._here())
        return f"{result.text}  ({result.type})"

    def _assign(self, request: Request) -> str:
        assert isinstance(request, p.Assign)
        current = self._here()
        return self._debugger.assign(self._task, request.target, request.value, current).text

    def _here(self) -> int:
        return min(self._level, len(self._debugger.frames(self._task)) - 1)

    def _set_watch(self, request: Request) -> str:
        assert isinstance(request, p.SetWatch)
        self._watch = request.expressions
        return ""

    def _cover(self, request: Request) -> str:
        assert isinstance(request, p.CountLines)
        if request.on and self._coverage is None:
            self._coverage = Coverage(self._controller)
            for task in self._tasks.values():
                task.report_statements()
        elif not request.on and self._coverage is not None:
            self._coverage.stop()
            self._coverage = None
        return ""

    def _known(self, task: str) -> None:
        if task not in self._tasks:
            raise RequestRejected(f"there is no task {task}")


def _rejecting(handler: Callable[[Request], str]) -> Handler:
    """Turn an error of the debugger into RequestRejected."""

    def carried_out(request: Request) -> str:
        try:
            return handler(request)
        except NotPaused as reason:
            raise RequestRejected(str(reason)) from reason

    return carried_out


def _place(at: Location, level: Level = "program") -> p.SeenPlace:
    made = f"{at.origin[0]}:{at.origin[1]}" if at.origin is not None else ""
    return p.SeenPlace(
        module=at.module, routine=at.routine, line=at.span.line, made=made, level=level
    )


def _of_frame(frame: StackFrame) -> p.SeenPlace:
    return _place(frame.place, frame.level)


def _halt(halt: PauseReason, time: float) -> p.SeenHalt:
    place = _place(halt.place) if halt.place is not None else None
    return p.SeenHalt(reason=halt.reason, task=halt.task, place=place, text=halt.text, time=time)


def _breakpoint(placed: PlacedBreakpoint) -> p.SeenBreakpoint:
    requested = placed.asked
    return p.SeenBreakpoint(
        number=placed.number,
        task=requested.task,
        module=requested.module,
        line=placed.line,
        condition=requested.condition,
        hits=requested.hits,
        log=requested.log,
        count=placed.count,
        doubt=placed.doubt,
    )


def _value(displayed: DisplayedValue) -> p.SeenValue:
    return p.SeenValue(
        name=displayed.name, kind=displayed.type, text=displayed.text, settable=displayed.settable
    )
