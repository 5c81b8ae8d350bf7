"""A debug session on a recording: read only, with steps forward and back in time.

The recording has the call stacks of all tasks, the signals, the robots and the watched
expressions. A step goes to the next or previous change of a task's place, `continue` to the next
breakpoint. Expressions have a value only if `sim --watch` recorded them.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING

from rapidgen._json import Members
from rapidgen.dap.client import Client, RequestRefused, objects, text, whole
from rapidgen.system.loading import module_name

if TYPE_CHECKING:
    from rapidgen.viewer.recording.messages import StackEntry
    from rapidgen.viewer.recording.reader import Moment, RecordingFile

CAPABILITIES: Members = {
    "supportsStepBack": True,
    "supportsSetVariable": False,
    "supportsSetExpression": False,
    "supportsGotoTargetsRequest": False,
    "supportsRestartRequest": False,
    "supportsConditionalBreakpoints": False,
    "supportsHitConditionalBreakpoints": False,
    "supportsLogPoints": False,
    "supportsFunctionBreakpoints": False,
    "supportsExceptionInfoRequest": False,
}
"""What differs from a program that is executed; sent as an event."""
_SCOPES = ("Watched", "Signals", "Robots", "System")
_FIRST_WINDOW = 1.0
"""s that a search back in time reads first; each further part is twice as long."""
_HERE = 1e-9
"""s by which a search leaves the present moment."""


class RecordedSession:
    """One client's view of a recording."""

    def __init__(self, file: "RecordingFile", client: Client) -> None:
        self._file = file
        self._client = client
        self._moment: Moment = file.at(file.begin)
        self._tasks = sorted({task for task, _ in file.sources(file.end)} | {*self._moment.tasks})
        self._lines: dict[str, set[tuple[str, int]]] = {}
        """Breakpoints, lower-case module and line, by source."""
        self._references: list[tuple[str, str]] = []
        self._due: tuple[str, str, str] | None = None
        """Reason, task and note of a moment that the client does not know of yet."""
        self._handlers: Mapping[str, Callable[[Members], Members | None]] = {
            "configurationDone": self._begin,
            "setBreakpoints": self._set_breakpoints,
            "setExceptionBreakpoints": lambda _a: None,
            "threads": self._threads,
            "stackTrace": self._stack_trace,
            "scopes": self._scopes,
            "variables": self._variables,
            "evaluate": self._evaluate,
            "source": self._source,
            "pause": lambda _a: None,
            "next": lambda a: self._step(a, forward=True),
            "stepIn": lambda a: self._step(a, forward=True),
            "stepOut": lambda a: self._step(a, forward=True),
            "stepBack": lambda a: self._step(a, forward=False),
            "continue": lambda _a: self._search(forward=True),
            "reverseContinue": lambda _a: self._search(forward=False),
        }

    def execute(self, command: str, arguments: Members) -> Members | None:
        """Execute a request and return the body of its response. RequestRefused."""
        handler = self._handlers.get(command)
        if handler is None:
            raise RequestRefused(f"a recording is read only: it has no '{command}'")
        return handler(arguments)

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def report(self) -> None:
        """Tell the client of a new moment, after the response of its request."""
        if self._due is None:
            return
        (reason, task, note), self._due = self._due, None
        thread = self._tasks.index(task) + 1 if task in self._tasks else 1
        body: Members = {"reason": reason, "threadId": thread, "allThreadsStopped": True}
        self._client.event("stopped", body | ({"description": note, "text": note} if note else {}))
        self._client.event("rapidgen/time", {"time": self._moment.time})

    def _begin(self, _arguments: Members) -> None:
        self._due = ("entry", "", "")

    # -- time ------------------------------------------------------------------------------------

    def _task(self, arguments: Members) -> str:
        number = whole(arguments, "threadId")
        if not 0 < number <= len(self._tasks):
            raise RequestRefused("there is no such task")
        return self._tasks[number - 1]

    def _places(self, forward: bool) -> Iterator[tuple[float, str, "StackEntry | None"]]:
        """Return later or earlier places of all tasks, the nearest first."""
        now, file = self._moment.time, self._file
        if forward:
            for time, task, pointers in file.pointers(now + _HERE, file.end):
                yield time, task, pointers.stack[-1] if pointers.stack else None
            return
        last, width = now - _HERE, _FIRST_WINDOW
        while last >= file.begin:
            first = max(file.begin, last - width)
            for time, task, pointers in reversed(list(file.pointers(first, last))):
                yield time, task, pointers.stack[-1] if pointers.stack else None
            last, width = first - _HERE, 2 * width

    def _step(self, arguments: Members, *, forward: bool) -> None:
        own = self._task(arguments)
        before = self._innermost(own)
        for time, task, place in self._places(forward):
            if task == own and place is not None and place != before:
                self._go_to(time, "step", own)
                return
        self._go_to_end(forward, own)

    def _search(self, *, forward: bool) -> Members:
        wanted = set().union(*self._lines.values())
        before = {task: self._innermost(task) for task in self._tasks}
        for time, task, place in self._places(forward):
            here = place is not None and (place.module.lower(), place.line) in wanted
            if here and place != before.get(task):
                self._go_to(time, "breakpoint", task)
                return {"allThreadsContinued": True}
            before[task] = place
        self._go_to_end(forward, "")
        return {"allThreadsContinued": True}

    def _go_to(self, time: float, reason: str, task: str, note: str = "") -> None:
        self._moment = self._file.at(time)
        self._due = (reason, task, note)

    def _go_to_end(self, forward: bool, task: str) -> None:
        edge = self._file.end if forward else self._file.begin
        self._go_to(edge, "pause", task, f"{'end' if forward else 'begin'} of the recording")

    def _innermost(self, task: str) -> "StackEntry | None":
        pointers = self._moment.tasks.get(task)
        return pointers.stack[-1] if pointers is not None and pointers.stack else None

    # -- sources ---------------------------------------------------------------------------------

    def _set_breakpoints(self, arguments: Members) -> Members:
        source = arguments.get("source")
        source = source if isinstance(source, dict) else {}
        module = self._module(source)
        asked = [self._client.line_of(one) for one in objects(arguments, "breakpoints")]
        key = str(source.get("path") or source.get("sourceReference"))
        self._lines[key] = {(module.lower(), line) for line in asked}
        known = {name.lower() for _, name in self._file.sources(self._file.end)}
        return {
            "breakpoints": [
                {"verified": module.lower() in known, "line": self._client.line(line)}
                for line in asked
            ]
        }

    def _module(self, source: Members) -> str:
        number, name = source.get("sourceReference"), source.get("name")
        if isinstance(number, int) and 0 < number <= len(self._references):
            return self._references[number - 1][1]
        path = source.get("path")
        if not isinstance(path, str) or "\0" in path:
            raise RequestRefused("a source has a path or a reference")
        stem = path.replace("\\", "/").rpartition("/")[2].rpartition(".")[0]
        for (_, module), _text in self._file.sources(self._file.end).items():
            if module.lower() == stem.lower():
                return module
        return module_name(str(name).encode("latin-1", "replace"), stem)

    def _source_of(self, task: str, module: str) -> Members:
        for known, name in self._file.sources(self._moment.time):
            if known == task and name.lower() == module.lower():
                if (task, name) not in self._references:
                    self._references.append((task, name))
                number = self._references.index((task, name)) + 1
                return {"name": name, "sourceReference": number, "origin": "recording"}
        return {"name": module}

    def _source(self, arguments: Members) -> Members:
        number = whole(arguments, "sourceReference")
        if not 0 < number <= len(self._references):
            raise RequestRefused("the recording has no such source")
        content = self._file.sources(self._file.end)[self._references[number - 1]]
        return {"content": content, "mimeType": "text/x-rapid"}

    # -- the moment ------------------------------------------------------------------------------

    def _threads(self, _arguments: Members) -> Members:
        states = {name: pointers.state for name, pointers in self._moment.tasks.items()}
        return {
            "threads": [
                {"id": i, "name": f"{name} ({states.get(name, 'unknown')})"}
                for i, name in enumerate(self._tasks, 1)
            ]
        }

    def _stack_trace(self, arguments: Members) -> Members:
        task = self._task(arguments)
        pointers = self._moment.tasks.get(task)
        stack = pointers.stack if pointers is not None else ()
        frames: list[Members] = [
            {
                "id": self._tasks.index(task) * 1000 + level,
                "name": place.routine,
                "source": self._source_of(task, place.module),
                "line": self._client.line(place.line),
                "column": self._client.column(1),
            }
            for level, place in reversed(list(enumerate(stack, 1)))
        ]
        return {"stackFrames": [*frames], "totalFrames": len(frames)}

    def _scopes(self, arguments: Members) -> Members:
        task = min(max(0, whole(arguments, "frameId") // 1000), len(self._tasks) - 1)
        first = task * len(_SCOPES) + 1
        return {
            "scopes": [
                {"name": name, "variablesReference": first + i, "expensive": False}
                for i, name in enumerate(_SCOPES)
            ]
        }

    def _variables(self, arguments: Members) -> Members:
        number = whole(arguments, "variablesReference") - 1
        task, kind = divmod(number, len(_SCOPES))
        if not 0 <= task < len(self._tasks):
            raise RequestRefused("these values do not exist any more")
        values = [self._watched, self._signals, self._robots, self._system][kind](self._tasks[task])
        return {"variables": [_variable(name, value) for name, value in values]}

    def _watched(self, task: str) -> list[tuple[str, str]]:
        return [(e, v.text) for (t, e), v in self._moment.watch.items() if t == task]

    def _signals(self, _task: str) -> list[tuple[str, str]]:
        return [(name, f"{value:g}") for name, value in sorted(self._moment.signals.items())]

    def _robots(self, _task: str) -> list[tuple[str, str]]:
        result = []
        for robot in self._file.robots:
            joints = self._moment.joints.get(robot.name)
            for joint, value in zip(robot.joints, joints.actual if joints else (), strict=False):
                turns = joint.kind == "revolute"
                shown = f"{math.degrees(value):.3f} deg" if turns else f"{value * 1e3:.3f} mm"
                result.append((f"{robot.name} {joint.axis}", shown))
        return result

    def _system(self, task: str) -> list[tuple[str, str]]:
        panel, pointers = self._moment.panel, self._moment.tasks.get(task)
        result = [("time", f"{self._moment.time:.6f} s")]
        if pointers is not None:
            result += [("state", pointers.state), ("fault", pointers.fault)]
        if panel is not None:
            motors = "on" if panel.motors_on else "off"
            result += [("mode", panel.mode), ("motors", motors)]
        return result

    def _evaluate(self, arguments: Members) -> Members:
        expression = text(arguments, "expression").strip()
        if expression.startswith(":time "):
            try:
                time = float(expression.removeprefix(":time "))
            except ValueError:
                time = math.nan
            if not math.isfinite(time):
                raise RequestRefused("':time SECONDS' goes to a moment")
            self._go_to(time, "goto", "")
            return {"result": f"{self._moment.time:.6f} s", "variablesReference": 0}
        for (_, watched), value in self._moment.watch.items():
            if watched.lower() == expression.lower():
                return {"result": value.text, "variablesReference": 0}
        known = {name.lower(): value for name, value in self._moment.signals.items()}
        if expression.lower() in known:
            return {"result": f"{known[expression.lower()]:g}", "variablesReference": 0}
        raise RequestRefused("not recorded: `rapidgen sim --watch TASK:EXPRESSION` records it")


def _variable(name: str, value: str) -> Members:
    return {
        "name": name,
        "value": value,
        "variablesReference": 0,
        "presentationHint": {"attributes": ["readOnly"]},
    }
