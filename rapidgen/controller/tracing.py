"""Trace, profile by line, and coverage as lcov."""

from collections import Counter
from collections.abc import Iterator
from typing import TextIO

from rapidgen.controller.controller import VirtualController
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk
from rapidgen.runtime.compiler.symbols import LoadedModule, Routine

STATEMENTS = (
    n.Assignment,
    n.ProcedureCall,
    n.LateCall,
    n.If,
    n.CompactIf,
    n.For,
    n.While,
    n.Test,
    n.Goto,
    n.Return,
    n.Raise,
    n.Retry,
    n.TryNext,
    n.Exit,
    n.Connect,
    n.PlaceholderStatement,
)


class Trace:
    """Writes one line per statement: time (s), task, place, text.

    The place is module/routine:line.
    """

    def __init__(self, controller: VirtualController, stream: TextIO) -> None:
        self._stream = stream
        self._scheduler = controller.scheduler
        controller.statements.listen(self._statement)

    def _statement(self, task: str, routine: Routine, node: n.Statement) -> None:
        module = routine.module
        assert module is not None
        source = module.tree.source
        line = source.line(node.first)
        # The line as it is written, from where the statement begins.
        text = source.text[source.starts[node.first] :].split("\n", 1)[0].rstrip()
        place = f"{module.name}/{routine.name}:{line}"
        self._stream.write(f"{self._scheduler.now * 1e-9:12.6f}  {task:9} {place:28} {text[:90]}\n")


class Profile:
    """Virtual time and passes by line.

    A statement lasts until the next one of its task.
    """

    def __init__(self, controller: VirtualController) -> None:
        self._scheduler = controller.scheduler
        self._open: dict[str, tuple[tuple[str, str, str, int], int]] = {}
        self.time: Counter[tuple[str, str, str, int]] = Counter()
        self.passes: Counter[tuple[str, str, str, int]] = Counter()
        controller.statements.listen(self._statement)

    def _statement(self, task: str, routine: Routine, node: n.Statement) -> None:
        module = routine.module
        assert module is not None
        now = self._scheduler.now
        self._finish(task, now)
        key = (task, module.name, routine.name, module.tree.source.line(node.first))
        self.passes[key] += 1
        self._open[task] = (key, now)

    def _finish(self, task: str, now: int) -> None:
        before = self._open.pop(task, None)
        if before is not None:
            self.time[before[0]] += now - before[1]

    def as_data(self) -> list[dict[str, object]]:
        """Return rows, most time first.

        Columns are task, module, routine, line, passes, seconds.
        """
        for task in list(self._open):
            self._finish(task, self._scheduler.now)
        rows = sorted(self.passes, key=lambda k: (-self.time[k], k))
        return [
            {
                "task": task,
                "module": module,
                "routine": routine,
                "line": line,
                "passes": self.passes[task, module, routine, line],
                "seconds": self.time[task, module, routine, line] * 1e-9,
            }
            for task, module, routine, line in rows
        ]


class Coverage:
    """Executed lines and branches of RAPID."""

    def __init__(self, controller: VirtualController) -> None:
        self._controller = controller
        self._hits: Counter[int] = Counter()
        controller.statements.listen(self._statement)

    def stop(self) -> None:
        """Stop counting."""
        self._controller.statements.tracers.remove(self._statement)

    def _statement(self, task: str, routine: Routine, node: n.Statement) -> None:
        self._hits[id(node)] += 1

    def lines(self) -> dict[str, dict[int, int]]:
        """Return line counts by module file, for lines with a statement."""
        result: dict[str, dict[int, int]] = {}
        for module in self._modules():
            if module.file.path not in result:
                result[module.file.path] = self._lines(module)
        return result

    def _lines(self, module: LoadedModule) -> dict[int, int]:
        source = module.tree.source
        lines: Counter[int] = Counter()
        for routine in module.tree.routines:
            for node in walk(routine):
                if isinstance(node, STATEMENTS):
                    line = source.line(node.first)
                    lines[line] = max(lines[line], self._hits[id(node)])
        return lines

    def lcov(self) -> str:
        """Return the tracefile.

        A module of several tasks appears once, with the counts of all tasks.
        """
        records: dict[str, list[str]] = {}
        for module in self._modules():
            if module.file.path not in records:
                records[module.file.path] = list(self._record(module))
        return "".join(line + "\n" for record in records.values() for line in record)

    def _modules(self) -> Iterator[LoadedModule]:
        for task in self._controller.rapid_tasks.values():
            yield from task.program.modules.values()

    def _record(self, module: LoadedModule) -> Iterator[str]:
        source = module.tree.source
        lines = self._lines(module)
        branches: list[str] = []
        yield f"SF:{module.file.path}"
        for routine in module.tree.routines:
            yield f"FN:{source.line(routine.name_token)},{routine.name}"
            hit = 0
            for node in walk(routine):
                if not isinstance(node, STATEMENTS):
                    continue
                branches += self._branches(node, source.line(node.first))
            if routine.body:
                hit = self._hits[id(routine.body[0])]
            yield f"FNDA:{hit},{routine.name}"
        yield from branches
        in_use = sum(1 for b in branches if not b.endswith((",0", ",-")))
        yield f"BRF:{len(branches)}"
        yield f"BRH:{in_use}"
        for line, hits in sorted(lines.items()):
            yield f"DA:{line},{hits}"
        yield f"LF:{len(lines)}"
        yield f"LH:{sum(1 for hits in lines.values() if hits)}"
        yield "end_of_record"

    def _branches(self, node: n.Node, line: int) -> Iterator[str]:
        """Iterate over BRDA rows: counts of each branch of a decision."""
        ways = _ways(node)
        if ways is None:
            return
        bodies, has_rest = ways
        reached = self._hits[id(node)]
        counts: list[int | None] = [self._hits[id(b[0])] if b else None for b in bodies]
        if has_rest:
            counts.append(max(0, reached - sum(c or 0 for c in counts)))
        for i, count in enumerate(counts):
            displayed = "-" if not reached or count is None else str(count)
            yield f"BRDA:{line},{node.first},{i},{displayed}"


def _ways(node: n.Node) -> tuple[list[list[n.Statement]], bool] | None:
    """Return bodies of a decision, and True if it can skip all of them."""
    match node:
        case n.If():
            bodies = [b.body for b in node.branches]
            if node.otherwise is not None:
                bodies.append(node.otherwise)
            return bodies, node.otherwise is None
        case n.CompactIf():
            return [[node.statement]], True
        case n.Test():
            bodies = [c.body for c in node.cases]
            if node.default is not None:
                bodies.append(node.default)
            return bodies, node.default is None
    return None
