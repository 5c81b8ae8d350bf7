"""A debug session: requests of a client on one controller, and events of the controller.

All methods run on the thread that lets the controller's time pass. A pause of the debugger stops
all tasks, the robots and the clock, so a client sees every task as stopped.
"""

from collections.abc import Callable, Mapping
from typing import TypeAlias

from rapidgen._json import Json, Members
from rapidgen.controller.debugger import NotPaused, PauseReason, StackFrame
from rapidgen.controller.debugger.breakpoints import statements
from rapidgen.controller.editor_link import EditorCursor, targets_at
from rapidgen.controller.runner import ControllerRunner
from rapidgen.dap.breakpoints import Breakpoints, statement_lines
from rapidgen.dap.client import Client, RequestRefused, objects, text, texts, whole
from rapidgen.dap.console import Console
from rapidgen.dap.sources import Sources
from rapidgen.dap.variables import Variables
from rapidgen.machine.event_log import Event, EventType
from rapidgen.machine.scheduler import MS
from rapidgen.runtime.errors import Location

Handler: TypeAlias = Callable[[Members], Members | None]

_REASONS = {"cursor": "goto", "error": "exception", "time": "pause"}
"""Reasons of the protocol, where they differ from the debugger's."""
_OVER = frozenset({"finished", "error", "empty"})
_LOOK = 50 * MS
"""Controller's time between two looks whether the robots stand at the end of a program."""


class Session:
    """One client's view of a controller over its restarts."""

    def __init__(self, runner: ControllerRunner, client: Client, *, ends: bool) -> None:
        """`ends`: the session is over when the programs of all NORMAL tasks are."""
        self._runner = runner
        self._client = client
        self._ends = ends
        self._is_over = False
        self._halt: PauseReason | None = None
        self._asked_to_go_on = False
        self._entry = False
        self._paused_thread = 0
        self._targets: list[tuple[str, int]] = []
        """Places of gotoTargets: module and line."""
        self._loaded: dict[tuple[str, str], Members] = {}
        self._last_output: object = None
        self._unbind: list[Callable[[], None]] = []
        self._bind()
        self._breakpoints = Breakpoints(client, self._sources, self._debugger)
        runner.editor.attach(self._open)
        runner.on_restart.append(self._release)
        runner.on_boot.append(self._rebind)
        self._handlers: Mapping[str, Handler] = {
            "setBreakpoints": self._set_breakpoints,
            "setFunctionBreakpoints": self._set_function_breakpoints,
            "breakpointLocations": lambda a: {"breakpoints": [*self._breakpoints.locations(a)]},
            "setExceptionBreakpoints": self._set_exception_breakpoints,
            "threads": self._threads,
            "stackTrace": self._stack_trace,
            "scopes": self._scopes,
            "variables": self._read_variables,
            "setVariable": self._set_variable,
            "setExpression": self._set_expression,
            "evaluate": self._evaluate,
            "completions": self._completions,
            "continue": self._continue,
            "next": lambda a: self._step(a, "over"),
            "stepIn": lambda a: self._step(a, "in"),
            "stepOut": lambda a: self._step(a, "out"),
            "pause": self._pause,
            "gotoTargets": self._goto_targets,
            "goto": self._goto,
            "exceptionInfo": self._exception_info,
            "source": self._source,
            "loadedSources": lambda _a: {"sources": [*self._loaded.values()]},
            "rapidgen/answer": self._answer,
            "rapidgen/runTo": self._run_to,
            "rapidgen/showTarget": self._show_target,
            "rapidgen/runFor": self._run_for,
        }

    # -- life ------------------------------------------------------------------------------------

    def _bind(self) -> None:
        controller = self._runner.controller
        self._controller = controller
        self._debugger = self._runner.debugger
        self._tasks = controller.rapid_tasks
        self._names = list(self._tasks)
        self._sources = Sources(self._tasks)
        self._variables = Variables(controller, self._debugger)
        self._console = Console(controller, self._debugger, self._client)
        self._loaded = self._all_sources()
        debugged, tasks = self._debugger.changed, controller.operation.changed
        debugged.add(self._debugger_changed)
        tasks.add(self._tasks_changed)
        self._unbind += [
            lambda: debugged.remove(self._debugger_changed),
            lambda: tasks.remove(self._tasks_changed),
            controller.log.subscribe(self._event),
            controller.operator.subscribe(self._written),
            self._console.attach(),
        ]

    def _release(self) -> None:
        for end in self._unbind:
            end()
        self._unbind.clear()
        self._variables.clear()

    def _rebind(self) -> None:
        """Follow a restart of the controller."""
        self._halt = None
        self._bind()
        self._breakpoints.renew(self._debugger, self._sources)
        self._client.output("the controller has restarted", "important")
        self._client.event("invalidated", {"areas": ["all"]})

    def close(self) -> None:
        """End the session; the controller continues without its breakpoints."""
        self._runner.editor.detach(self._open)
        self._runner.on_restart.remove(self._release)
        self._runner.on_boot.remove(self._rebind)
        self._release()
        self._breakpoints.remove_all()
        if self._debugger.halt is not None:
            self._debugger.resume()

    def start(self, *, stop_on_entry: bool) -> None:
        """Start the program; with `stop_on_entry` pause before its first statement."""
        if not stop_on_entry:
            self._controller.start_program()
            return
        # The pause before the start is no stop of the program: the client does not learn of it.
        self._entry = True
        self._debugger.pause()
        self._controller.start_program()
        for task in self._tasks.values():
            routine = task.program.find_routine(None, task.spec.entry.lower())
            if task.state != "running" or routine is None or routine.node is None:
                continue
            first = min((node.first for node in statements(routine.node)), default=None)
            if first is not None and routine.module is not None:
                line = routine.module.tree.source.line(first)
                self._debugger.run_to(task.name, routine.module.name, line)
                return
        self._entry = False
        self._debugger.resume()

    def execute(self, command: str, arguments: Members) -> Members | None:
        """Execute a request and return the body of its response. RequestRefused."""
        handler = self._handlers.get(command)
        if handler is None:
            raise RequestRefused(f"the adapter does not know '{command}'")
        try:
            return handler(arguments)
        except NotPaused as reason:
            raise RequestRefused(str(reason)) from reason

    def report_pause(self) -> None:
        """Tell a client that has attached of a pause that exists already."""
        self._halt = self._debugger.halt
        if self._halt is not None:
            self._send_stopped(self._halt)

    # -- events ----------------------------------------------------------------------------------

    def _debugger_changed(self) -> None:
        self._send_log_points()
        self._send_loaded_sources()
        self._breakpoints.report()
        halt = self._debugger.halt
        if halt is self._halt:
            return
        self._halt = halt
        self._variables.clear()
        if halt is None:
            if not self._asked_to_go_on and self._names:
                self._client.event("continued", {"threadId": 1, "allThreadsContinued": True})
            return
        if self._entry and halt.reason == "pause":
            self._halt = None
            return
        self._send_stopped(halt)

    def _send_stopped(self, halt: PauseReason) -> None:
        reason = _REASONS.get(halt.reason, halt.reason)
        if self._entry and halt.reason == "cursor":
            reason = "entry"
        self._entry = False
        thread = self._thread(halt.task) if halt.task else self._paused_thread or 1
        body: dict[str, Json] = {"reason": reason, "threadId": thread, "allThreadsStopped": True}
        if halt.text:
            body["text"] = body["description"] = halt.text
        if halt.breakpoint:
            body["hitBreakpointIds"] = [*self._breakpoints.ids_of(halt.breakpoint)]
        self._client.event("stopped", body)
        self._client.event("rapidgen/time", {"time": self._controller.now})

    def _tasks_changed(self) -> None:
        if self._ends and not self._is_over and self._programs_are_over():
            self._controller.scheduler.after(0, self._look_for_end)

    def _programs_are_over(self) -> bool:
        normal = [task for task in self._tasks.values() if task.spec.type == "NORMAL"]
        return any(task.state != "empty" for task in normal) and all(
            task.state in _OVER for task in normal
        )

    def _look_for_end(self) -> None:
        if self._is_over or not self._programs_are_over():
            return
        if not all(group.is_standing for group in self._controller.motion.groups.values()):
            self._controller.scheduler.after(_LOOK, self._look_for_end)
            return
        self._is_over = True
        failed = any(task.state == "error" for task in self._tasks.values())
        self._client.event("exited", {"exitCode": int(failed)})
        self._client.event("terminated")

    def _send_loaded_sources(self) -> None:
        if len(self._loaded) == sum(1 for _ in self._sources.modules()) and all(
            (task, module.name) in self._loaded for task, module in self._sources.modules()
        ):
            return
        now = self._all_sources()
        for key, source in now.items():
            if key not in self._loaded:
                self._client.event("loadedSource", {"reason": "new", "source": source})
        for key, source in self._loaded.items():
            if key not in now:
                self._client.event("loadedSource", {"reason": "removed", "source": source})
        self._loaded = now

    def _all_sources(self) -> dict[tuple[str, str], Members]:
        return {(task, m.name): self._sources.of(m) for task, m in self._sources.modules()}

    def _send_log_points(self) -> None:
        new = []
        for entry in reversed(self._debugger.output):
            if entry is self._last_output:
                break
            new.append(entry)
        for entry in reversed(new):
            self._last_output = entry
            self._client.output(f"{entry.task}: {entry.text}", "console", **self._at(entry.place))

    def _at(self, place: Location) -> Members:
        for _, module in self._sources.modules():
            if module.name == place.module:
                line = self._client.line(place.span.line)
                return {"source": self._sources.of(module), "line": line}
        return {}

    def _event(self, event: Event) -> None:
        category = {EventType.ERROR: "stderr", EventType.WARNING: "important"}.get(event.type)
        lines = "".join(f"\n    {line}" for line in event.texts if line)
        task = f" {event.task}" if event.task else ""
        self._client.output(
            f"[{event.time:.3f} s]{task} {event.code} {event.title}{lines}", category or "console"
        )

    def _written(self, task: str, written: str) -> None:
        self._client.output(f"{task}: {written}", "stdout")

    # -- breakpoints -----------------------------------------------------------------------------

    def _set_breakpoints(self, arguments: Members) -> Members:
        return {"breakpoints": [*self._breakpoints.set_lines(arguments)]}

    def _set_function_breakpoints(self, arguments: Members) -> Members:
        return {"breakpoints": [*self._breakpoints.set_routines(arguments)]}

    def _set_exception_breakpoints(self, arguments: Members) -> Members:
        selected = dict.fromkeys(texts(arguments, "filters"), "")
        for option in objects(arguments, "filterOptions"):
            selected[text(option, "filterId")] = text(option, "condition", "")
        debugger = self._debugger
        debugger.errors = (
            "all" if "all" in selected else "unhandled" if "unhandled" in selected else "never"
        )
        debugger.only_errors = _keys(selected.get("all", ""))
        # Errors that stop a task pause with either filter; a filter that is off selects none.
        failures = selected.get("unhandled", selected.get("all", ""))
        debugger.only_failures = _keys(failures)
        return {"breakpoints": [{"verified": True} for _ in selected]}

    # -- stacks and values -----------------------------------------------------------------------

    def _thread(self, task: str) -> int:
        return self._names.index(task) + 1

    def _task(self, arguments: Members) -> str:
        number = whole(arguments, "threadId")
        if not 0 < number <= len(self._names):
            raise RequestRefused("there is no such task")
        return self._names[number - 1]

    def _threads(self, _arguments: Members) -> Members:
        return {
            "threads": [
                {"id": number, "name": f"{name} ({self._tasks[name].state})"}
                for number, name in enumerate(self._names, 1)
            ]
        }

    def _require_pause(self) -> None:
        if self._debugger.halt is None:
            raise RequestRefused("the program is being executed: pause it first")

    def _stack_trace(self, arguments: Members) -> Members:
        self._require_pause()
        task = self._task(arguments)
        frames = self._debugger.frames(task)
        first, most = whole(arguments, "startFrame", 0), whole(arguments, "levels", 0)
        shown = [self._frame(task, i, frame) for i, frame in enumerate(frames)][::-1]
        halt = self._debugger.halt
        if not shown and halt is not None and halt.task == task:
            shown = [self._place(task, place) for place in reversed(halt.stack)]
        last = first + most if most > 0 else None
        return {"stackFrames": [*shown[max(0, first) : last]], "totalFrames": len(shown)}

    def _frame(self, task: str, level: int, frame: StackFrame) -> Members:
        span, client = frame.place.span, self._client
        notes: list[str] = [frame.level] if frame.level != "program" else []
        notes += [f"{frame.handler} handler"] if frame.handler else []
        result: Members = {
            "id": self._variables.number_of_frame(task, level),
            "name": frame.place.routine + (f" ({', '.join(notes)})" if notes else ""),
            "source": self._sources.of(frame.module),
            "line": client.line(span.line),
            "column": client.column(span.column),
        }
        if span.end_line:
            result["endLine"] = client.line(span.end_line)
            result["endColumn"] = client.column(span.end_column)
        if frame.module.installed or "NOSTEPIN" in frame.module.tree.attributes:
            result["presentationHint"] = "subtle"
        return result

    def _place(self, task: str, place: Location) -> Members:
        """Return a frame of a stack that an error has left."""
        return {
            "id": self._variables.number_of_frame(task, -1),
            "name": f"{place.routine} (left)",
            "line": self._client.line(place.span.line),
            "column": self._client.column(place.span.column),
            **self._at(place),
        }

    def _scopes(self, arguments: Members) -> Members:
        self._require_pause()
        return {"scopes": [*self._variables.scopes(whole(arguments, "frameId"))]}

    def _read_variables(self, arguments: Members) -> Members:
        self._require_pause()
        start, count = whole(arguments, "start", 0), whole(arguments, "count", 0)
        number = whole(arguments, "variablesReference")
        return {"variables": [*self._variables.read(number, start, count)]}

    def _set_variable(self, arguments: Members) -> Members:
        self._require_pause()
        number, name = whole(arguments, "variablesReference"), text(arguments, "name")
        return self._variables.write(number, name, text(arguments, "value"))

    def _here(self, arguments: Members) -> tuple[str, int]:
        """Return task and level of a request, by default the innermost of the pause."""
        self._require_pause()
        if "frameId" in arguments:
            return self._variables.frame(whole(arguments, "frameId"))
        halt = self._debugger.halt
        task = halt.task if halt is not None and halt.task else next(iter(self._names), "")
        return task, -1

    def _set_expression(self, arguments: Members) -> Members:
        task, level = self._here(arguments)
        target, value = text(arguments, "expression"), text(arguments, "value")
        return self._variables.assign(task, level, target, value)

    def _evaluate(self, arguments: Members) -> Members:
        expression = text(arguments, "expression").strip()
        repl = arguments.get("context") == "repl"
        if repl and expression.startswith(":"):
            return {"result": self._console.command(expression), "variablesReference": 0}
        task, level = self._here(arguments)
        target, assigns, value = expression.partition(":=")
        if repl and assigns:
            shown = self._variables.assign(
                task, level, target.strip(), value.strip().removesuffix(";")
            )
        else:
            seen = self._debugger.evaluate(task, expression, level)
            shown = self._variables.shown(task, level, seen)
        return {"result": shown["value"], **{k: v for k, v in shown.items() if k != "value"}}

    def _completions(self, arguments: Members) -> Members:
        column = whole(arguments, "column") - self._client.first_column
        typed = text(arguments, "text")[: max(0, column)]
        if typed.startswith(":"):
            return {"targets": [*self._console.completions(typed)]}
        return {"targets": [*self._console.names(*self._here(arguments), typed)]}

    def _exception_info(self, _arguments: Members) -> Members:
        halt = self._debugger.halt
        if halt is None or halt.reason != "error":
            raise RequestRefused("no error has paused the program")
        trace = "\n".join(f"at {place}" for place in reversed(halt.stack))
        return {
            "exceptionId": halt.code,
            "description": halt.text,
            "breakMode": "unhandled" if halt.stack else "always",
            "details": {"message": halt.text, "typeName": halt.code, "stackTrace": trace},
        }

    # -- execution -------------------------------------------------------------------------------

    def _go_on(self, action: Callable[[], None]) -> None:
        """Continue by request: the response says so, not an event."""
        self._asked_to_go_on = True
        try:
            action()
        finally:
            self._asked_to_go_on = False

    def _continue(self, _arguments: Members) -> Members:
        self._go_on(self._debugger.resume)
        return {"allThreadsContinued": True}

    def _step(self, arguments: Members, kind: str) -> None:
        task = self._task(arguments)
        self._require_pause()
        frames = self._debugger.frames(task)
        if not frames or (kind == "out" and len(frames) < 2):
            # Nothing of this task is left to step to: it continues, as at the end of a program.
            self._go_on(self._debugger.resume)
        elif kind == "over":
            self._go_on(lambda: self._debugger.step(task, "over"))
        elif kind == "in":
            self._go_on(lambda: self._debugger.step(task, "in"))
        else:
            self._go_on(lambda: self._debugger.step(task, "out"))

    def _pause(self, arguments: Members) -> None:
        self._paused_thread = self._thread(self._task(arguments))
        self._debugger.pause()

    def _goto_targets(self, arguments: Members) -> Members:
        source = arguments.get("source")
        found = self._sources.find(source if isinstance(source, dict) else {})
        line = self._client.line_of(arguments)
        if not any(line in statement_lines(module) for _, module in found.loaded):
            return {"targets": []}
        self._targets.append((found.name, line))
        target: Members = {
            "id": len(self._targets),
            "label": f"program pointer to line {line}",
            "line": self._client.line(line),
        }
        return {"targets": [target]}

    def _goto(self, arguments: Members) -> None:
        task, number = self._task(arguments), whole(arguments, "targetId")
        if not 0 < number <= len(self._targets):
            raise RequestRefused("there is no such target")
        module, line = self._targets[number - 1]
        self._require_pause()
        frame = self._debugger.frame(task)
        if frame.module.name.lower() != module.lower():
            raise RequestRefused(f"line {line} is not in the routine that {task} executes")
        moves = self._controller.motion.moved_by(task)
        if moves is not None and not moves.is_standing:
            self._client.output(f"{task}: the rest of the robot's path is discarded", "important")
        self._go_on(lambda: self._debugger.move_to(task, line))

    def _run_to(self, arguments: Members) -> None:
        """Continue to a line: `threadId`, `source`, `line`."""
        source = arguments.get("source")
        found = self._sources.find(source if isinstance(source, dict) else {})
        task, line = self._task(arguments), self._client.line_of(arguments)
        self._go_on(lambda: self._debugger.run_to(task, found.name, line))

    def _run_for(self, arguments: Members) -> None:
        """Let time pass and pause again: `seconds`."""
        self._console.command(f":run {arguments.get('seconds')}")

    def _show_target(self, arguments: Members) -> Members:
        """Show a place on the page: `source`, `line`, and `name`, which is under the cursor.

        Returns the names of the targets of its moves; without one the page shows no target.
        """
        source = arguments.get("source")
        found = self._sources.find(source if isinstance(source, dict) else {})
        line, name = self._client.line_of(arguments), text(arguments, "name", "")
        cursor = EditorCursor(found.name, line, name)
        self._runner.editor.cursor = cursor
        names = (target.name or "*" for _, _, target in targets_at(self._tasks, cursor))
        return {"module": found.name, "targets": [*dict.fromkeys(names)], "doubt": found.doubt}

    def _open(self, module: str, line: int) -> None:
        """Let the client open a line, as the page asks."""
        for _, loaded in self._sources.modules():
            if loaded.name.lower() == module.lower():
                shown = self._client.line(line)
                source = self._sources.of(loaded)
                self._client.event("rapidgen/open", {"source": source, "line": shown})
                return

    def _answer(self, arguments: Members) -> None:
        """Answer a dialog: `number` and `value`."""
        self._console.answer(whole(arguments, "number"), text(arguments, "value"))

    def _source(self, arguments: Members) -> Members:
        source = arguments.get("source")
        reference = whole(arguments, "sourceReference", 0)
        content = self._sources.text(source if isinstance(source, dict) else {}, reference)
        return {"content": content, "mimeType": "text/x-rapid"}


def _keys(condition: str) -> frozenset[str]:
    """Return names and numbers of a condition, in upper case."""
    return frozenset(part.upper() for part in condition.replace(",", " ").split())
