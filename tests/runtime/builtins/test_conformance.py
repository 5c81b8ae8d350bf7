"""Programs in RAPID that say what they expect: see tests/runtime/test_conformance.py.

`! source:`, `! expect:` (one TPWrite, in order), `! fault: NUMBER LINE`, `! signal: NAME TYPE`,
`! dialect: SWITCH=VALUE`, `! task: NAME ENTRY` (a ROB in the name: it has a robot),
`! robot: SHIPPED NAME`.
"""

import re
from pathlib import Path

import pytest

from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.controller.mechanics import groups_for
from rapidgen.runtime.switches import parse_switches
from rapidgen.system.model import ModuleFile, SignalSpec, System, TaskSpec

HERE = Path(__file__).parent / "conformance"
FILES = sorted(HERE.glob("*.mod"))


def _marks(text, mark):
    return [m.strip() for m in re.findall(rf"^\s*! {mark}:(.*)$", text, re.MULTILINE)]


def _execute(path):
    text = path.read_text(encoding="utf-8")
    signals = tuple(SignalSpec(*line.split()) for line in _marks(text, "signal"))
    modules = (ModuleFile(path.stem, str(path), path.read_bytes()),)
    tasks = [TaskSpec("T_ROB1", "NORMAL", "SysFail", "main", True, "", modules)]
    for line in _marks(text, "task"):
        name, entry = line.split()
        tasks.append(TaskSpec(name, "NORMAL", "SysFail", entry, "ROB" in name, "", modules))
    printed = []
    system = System(path.stem, tuple(tasks), signals)
    robots = [g for name in _marks(text, "robot") for g in groups_for(system, load_config(name))]
    with VirtualController(
        system,
        robots,
        cycle="once",
        autostart=False,
        dialect=parse_switches(",".join(_marks(text, "dialect"))),
    ) as controller:
        controller.operator.subscribe(lambda _, line: printed.append(line))
        controller.start_program()
        assert controller.run(max_time=100) == "finished", controller.where()
        faults = [t.fault for t in controller.tasks.values() if t.fault is not None]
        return printed, [f"{f.event} {f.stack[-1].span.line}" for f in faults]


@pytest.mark.parametrize("path", FILES, ids=lambda p: p.stem)
def test_program_does_what_its_source_says(path):
    text = path.read_text(encoding="utf-8")
    assert _marks(text, "source"), "name the source"
    printed, faults = _execute(path)
    assert printed == _marks(text, "expect")
    assert faults == _marks(text, "fault")


def test_there_are_programs():
    assert len(FILES) >= 14
