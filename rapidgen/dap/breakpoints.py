"""Breakpoints of a client, kept equal to those of the controller's debugger.

The client sends all breakpoints of a source; the debugger has one for each module and task. Others
may set breakpoints in the same debugger (the page of the simulator): the client learns them by
events, and they become its own when it sends them back.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field

from rapidgen._json import Json, Members
from rapidgen.controller.debugger import Breakpoint, Debugger
from rapidgen.controller.debugger.breakpoints import statements
from rapidgen.dap.client import Client, objects, text
from rapidgen.dap.sources import FoundModule, Sources
from rapidgen.runtime.compiler.symbols import LoadedModule


@dataclass(slots=True, eq=False)
class ClientBreakpoint:
    """A breakpoint of the client with its numbers in the debugger."""

    id: int
    asked: Breakpoint
    """Without a task."""
    source: Members
    numbers: list[int] = field(default_factory=list)
    refused: str = ""
    """Reason why the debugger did not take it."""
    doubt: str = ""
    """Doubt about the source."""
    sent: Members = field(default_factory=dict)
    """State that the client has."""


class Breakpoints:
    """All breakpoints of one client."""

    def __init__(self, client: Client, sources: Sources, debugger: Debugger) -> None:
        self._client = client
        self._sources = sources
        self._debugger = debugger
        self._ids = 0
        self._of: dict[str, list[ClientBreakpoint]] = {}
        """By source."""
        self._is_changing = False

    def ids_of(self, number: int) -> list[int]:
        """Return the client's breakpoints with a number of the debugger."""
        return [one.id for one in self._all() if number in one.numbers]

    def _all(self) -> Iterator[ClientBreakpoint]:
        for those in self._of.values():
            yield from those

    # -- requests --------------------------------------------------------------------------------

    def set_lines(self, arguments: Members) -> list[Members]:
        """Replace the breakpoints of a source; return their states."""
        source = arguments.get("source")
        source = source if isinstance(source, dict) else {}
        found = self._sources.find(source)
        asked = [
            (
                Breakpoint(
                    found.name,
                    self._client.line_of(one),
                    "",
                    text(one, "condition", ""),
                    text(one, "hitCondition", ""),
                    text(one, "logMessage", ""),
                ),
                source,
            )
            for one in objects(arguments, "breakpoints")
        ]
        return self._replace(found.key, asked, found)

    def set_routines(self, arguments: Members) -> list[Members]:
        """Replace the breakpoints at routines, `name` or `module:name`."""
        asked: list[tuple[Breakpoint, Members]] = []
        for one in objects(arguments, "breakpoints"):
            module, line = self._routine(text(one, "name"))
            hits, condition = text(one, "hitCondition", ""), text(one, "condition", "")
            asked.append((Breakpoint(module, line, "", condition, hits), {}))
        return self._replace("\0routines", asked, None)

    def _routine(self, name: str) -> tuple[str, int]:
        wanted, _, key = name.lower().rpartition(":")
        for _, module in self._sources.modules():
            routine = module.routines.get(key)
            node = None if routine is None else routine.node
            if node is not None and wanted in ("", module.name.lower()):
                return module.name, module.tree.source.line(node.first)
        return wanted, 0

    def _replace(
        self,
        key: str,
        asked: list[tuple[Breakpoint, Members]],
        found: FoundModule | None,
    ) -> list[Members]:
        self._is_changing = True
        old = self._of.pop(key, [])
        new: list[ClientBreakpoint] = []
        for expression, source in asked:
            same = next((one for one in old if one.asked == expression and not one.refused), None)
            if same is not None:
                old.remove(same)
                new.append(same)
                continue
            self._ids += 1
            new.append(self._added(ClientBreakpoint(self._ids, expression, source), found))
        for one in old:
            for number in one.numbers:
                self._debugger.remove(number)
        if new:
            self._of[key] = new
        for one in new:
            one.sent = self._state(one)
        self._is_changing = False
        return [one.sent for one in new]

    def _added(self, one: ClientBreakpoint, found: FoundModule | None) -> ClientBreakpoint:
        asked = one.asked
        # A module of the same name in another task may be another file.
        tasks = {task for task, _ in found.loaded} if found is not None else set()
        others = {t for t, m in self._sources.modules() if m.name.lower() == asked.module.lower()}
        one.doubt = found.doubt if found is not None else ""
        if found is None and not asked.line:
            one.refused = "no loaded module has this routine"
            return one
        for task in sorted(tasks) if found is not None and tasks != others else [""]:
            expression = Breakpoint(
                asked.module, asked.line, task, asked.condition, asked.hits, asked.log
            )
            try:
                one.numbers.append(self._debugger.add(expression).number)
            except ValueError as error:
                one.refused = str(error)
        return one

    def _state(self, one: ClientBreakpoint) -> Members:
        placed = [self._debugger.placed[number] for number in one.numbers]
        line = next((at.line for at in placed if at.line), 0)
        doubt = next((at.doubt for at in placed if at.doubt), "")
        result: Members = {"id": one.id, "verified": line > 0}
        if line:
            result["line"] = self._client.line(line)
        elif not one.refused and not self._is_loaded(one.asked.module):
            doubt = f"no task has loaded the module {one.asked.module}"
        message = one.refused or doubt or one.doubt
        if message:
            result["message"] = message
        if one.source:
            result["source"] = one.source
        return result

    def _is_loaded(self, module: str) -> bool:
        return any(m.name.lower() == module.lower() for _, m in self._sources.modules())

    def locations(self, arguments: Members) -> list[Members]:
        """Return the lines of a source, within a range, in which a statement begins."""
        source = arguments.get("source")
        found = self._sources.find(source if isinstance(source, dict) else {})
        first = self._client.line_of(arguments)
        last = self._client.line_of(arguments, "endLine") if "endLine" in arguments else first
        lines = {line for _, module in found.loaded for line in statement_lines(module)}
        return [
            {"line": self._client.line(line)} for line in sorted(lines) if first <= line <= last
        ]

    def remove_all(self) -> None:
        """Remove the client's breakpoints from the debugger."""
        self._is_changing = True
        for one in self._all():
            for number in one.numbers:
                self._debugger.remove(number)
        self._of.clear()

    # -- events ----------------------------------------------------------------------------------

    def renew(self, debugger: Debugger, sources: Sources) -> None:
        """Use the debugger of a restarted controller, with the same breakpoints in its order."""
        self._sources = sources
        numbers = dict(zip(self._debugger.placed, debugger.placed, strict=True))
        for one in self._all():
            one.numbers = [numbers[number] for number in one.numbers]
        self._debugger = debugger
        self.report()

    def report(self) -> None:
        """Send what has changed without a request of this client."""
        if self._is_changing:
            return
        known = {number for one in self._all() for number in one.numbers}
        for key, those in tuple(self._of.items()):
            for one in tuple(those):
                left = [number for number in one.numbers if number in self._debugger.placed]
                if one.numbers and not left:
                    those.remove(one)
                    self._event("removed", {"id": one.id, "verified": False})
                    continue
                one.numbers = left
                state = self._state(one)
                if state != one.sent:
                    one.sent = state
                    self._event("changed", state)
            if not those:
                del self._of[key]
        for number, placed in self._debugger.placed.items():
            if number not in known:
                self._adopt(number, placed.asked)

    def _adopt(self, number: int, asked: Breakpoint) -> None:
        for task, module in self._sources.modules():
            if module.name.lower() == asked.module.lower() and asked.task in ("", task):
                source = self._sources.of(module)
                key = self._sources.find(source).key
                self._ids += 1
                general = Breakpoint(
                    module.name, asked.line, "", asked.condition, asked.hits, asked.log
                )
                one = ClientBreakpoint(self._ids, general, source, [number])
                self._of.setdefault(key, []).append(one)
                one.sent = self._state(one)
                self._event("new", one.sent)
                return

    def _event(self, reason: str, state: Members) -> None:
        body: dict[str, Json] = {"reason": reason, "breakpoint": state}
        self._client.event("breakpoint", body)


def statement_lines(module: LoadedModule) -> Iterator[int]:
    """Return the lines of a module in which statements begin."""
    for routine in module.tree.routines:
        yield from (module.tree.source.line(node.first) for node in statements(routine))
