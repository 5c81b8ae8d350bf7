"""Programs in RAPID that say what they expect, in both kinds of accounting.

The head of a file names its source; comments tell the rest:
`! expect: TEXT` one TPWrite, in order · `! fault: NAME LINE` how the task ends ·
`! dialect: SWITCH=VALUE` · `! signal: NAME TYPE` · `! cycle: N` main runs again, N lines are read ·
`! until: S` simulated seconds to run at most.
"""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from rapidgen.controller.controller import VirtualController
from rapidgen.runtime.switches import parse_switches
from rapidgen.system.model import ModuleFile, SignalSpec, System, TaskSpec

HERE = Path(__file__).parent / "conformance"
FILES = sorted(HERE.rglob("*.mod"))


def _marks(text: str, mark: str) -> list[str]:
    return [m.strip() for m in re.findall(rf"^\s*! {mark}:(.*)$", text, re.MULTILINE)]


def _modules(path: Path, text: str) -> Iterator[ModuleFile]:
    """The modules of a file; the lines of each are counted from the file's beginning."""
    starts = [m.start() for m in re.finditer(r"^MODULE", text, re.MULTILINE)]
    for start, end in zip([0, *starts[1:]], [*starts[1:], len(text)], strict=True):
        lines = "\n" * text.count("\n", 0, start)
        yield ModuleFile(path.stem, str(path), (lines + text[start:end]).encode("latin-1"))


def _execute(path: Path, accounting: str) -> tuple[list[str], str, int]:
    text = path.read_text(encoding="utf-8")
    signals = tuple(SignalSpec(*line.split()) for line in _marks(text, "signal"))
    modules = tuple(_modules(path, text))
    tasks = [TaskSpec("T_ROB1", "NORMAL", "SysFail", "main", True, "", modules)]
    for line in _marks(text, "task"):
        name, entry = line.split()
        tasks.append(TaskSpec(name, "NORMAL", "NoSafety", entry, False, "", modules))
    cycles = _marks(text, "cycle")
    printed: list[str] = []
    with VirtualController(
        System(path.stem, tuple(tasks), signals),
        dialect=parse_switches(",".join(_marks(text, "dialect"))),
        cycle="forever" if cycles else "once",
        accounting=accounting,
        autostart=False,
    ) as controller:
        controller.operator.subscribe(lambda _, line: printed.append(line))
        controller.start_program()
        if cycles:
            limit = int(cycles[0])
            controller.run_until(
                lambda: len(printed) >= limit or controller.task("T_ROB1").state != "running",
                timeout=60,
            )
            del printed[limit:]
        else:
            until = float((_marks(text, "until") or ["60"])[0])
            ended = controller.run(max_time=until)
            assert ended == "finished" or _marks(text, "until"), controller.where()
        fault = ""
        for view in controller.tasks.values():
            if view.fault is not None:
                error = view.fault.cause
                name = error.name if error is not None else str(view.fault.event)
                line = view.fault.stack[-1].span.line if view.fault.stack else 0
                fault = f"{name} {line}"
        return printed, fault, controller.scheduler.now


@pytest.mark.parametrize("path", FILES, ids=lambda p: str(p.relative_to(HERE)))
def test_program_does_what_its_source_says(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert _marks(text, "source"), "name the source"
    expected = _marks(text, "expect")
    printed, fault, now = _execute(path, "block")
    assert printed == expected
    assert fault == "".join(_marks(text, "fault"))
    exact = _execute(path, "statement")
    assert exact == (printed, fault, now), "block and statement accounting differ"


def test_there_are_programs() -> None:
    assert len(FILES) >= 50
