"""RAPID programs with declared expectations, in both kinds of accounting.

They are in theme files, each below a line `!=== NAME` (tests/rapid_programs.py). Line numbers count
from the line below that. The head of a program names its source; comments describe the rest:
`! expect: TEXT` one TPWrite, in order · `! fault: NAME LINE` how a task ends ·
`! dialect: SWITCH=VALUE` · `! signal: NAME TYPE [BITS]` · `! robot: SHIPPED NAME` ·
`! cycle: N` main runs again, N lines are read · `! until: S` simulated seconds to run at most ·
`! task: NAME ENTRY [TYPE]` one more task (a ROB in the name: it has a robot) ·
`! hook: ROUTINE EVENT TASK` an event routine · `! arc: USE SIGNAL` a signal of welding ·
`! case: SWITCH=VALUE` the lines
after it run on a separate controller with this switch (or motion setting).

`! do: ACTION, ...` is an action of a user (`Run.act`). After it follow, in this order, rejected
actions, printed texts, and visible results: `! state:` of each task,
`! at: ROUTINE STATEMENT`, `! value: NAME = VALUE`, `! log: CODE TEXT` of an event since the `do`.
"""

import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.controller.mechanics import groups_for
from rapidgen.motion import MotionSettings
from rapidgen.rapid.switches import parse_switches
from rapidgen.runtime.task.pointer import CannotStep
from rapidgen.runtime.text import value_text
from rapidgen.system.model import ArcSignals, EventRoutine, ModuleFile, SignalSpec, System, TaskSpec
from tests.rapid_programs import Program, read_all

HERE = Path(__file__).parent
PROGRAMS = [
    program
    for folder in (HERE / "builtins" / "conformance", HERE / "conformance")
    for program in read_all(folder)
]
SCRIPT = ("do", "refused", "expect", "state", "at", "value", "log")


def marks(text: str, marker: str = r"\w+") -> list[tuple[str, str]]:
    """The comments that say something, in order."""
    match = re.findall(rf"^\s*! ({marker}):(.*)$", text, re.MULTILINE)
    return [(name, remaining.strip()) for name, remaining in match]


def words(text: str, marker: str) -> list[list[str]]:
    """The words of each comment of a kind."""
    return [remaining.split() for _, remaining in marks(text, marker)]


def modules(program: Program) -> Iterator[ModuleFile]:
    """Iterate over modules of a program, with its line numbers."""
    text, path = program.text, f"{program.file}/{program.name}.mod"
    starts = [m.start() for m in re.finditer(r"^MODULE", text, re.MULTILINE)]
    for start, end in zip([0, *starts[1:]], [*starts[1:], len(text)], strict=True):
        lines = "\n" * text.count("\n", 0, start)
        yield ModuleFile(program.name, path, (lines + text[start:end]).encode("latin-1"))


def system(program: Program) -> System:
    """Return the system that the head of a program describes."""
    text = program.text
    files = tuple(modules(program))
    tasks = [TaskSpec("T_ROB1", "NORMAL", "SysFail", "main", True, "", files)]
    for name, entry, *type_ in words(text, "task"):
        kind = type_[0] if type_ else "NORMAL"
        tasks.append(TaskSpec(name, kind, "NoSafety", entry, "ROB" in name, "", files))
    return System(
        program.name,
        tuple(tasks),
        signals=tuple(
            SignalSpec(name, kind, size=int(size[0]) if size else 1)
            for name, kind, *size in words(text, "signal")
        ),
        events=tuple(EventRoutine(*line) for line in words(text, "hook")),
        arc=(ArcSignals("stdIO_T_ROB1", tuple((use, s) for use, s in words(text, "arc"))),),
    )


class Run:
    """A controller with a program."""

    def __init__(self, program: Program, case: str, accounting: str) -> None:
        text = program.text
        self.lines = text.splitlines()
        complete = system(program)
        given = [remaining for _, remaining in marks(text, "dialect")] + case.split(",")
        settings = dict(part.split("=") for part in given if part.startswith("motion."))
        switches = ",".join(part for part in given if not part.startswith("motion."))
        cycles = words(text, "cycle")
        self.controller = VirtualController(
            complete,
            [
                g
                for (name,) in words(text, "robot")
                for g in groups_for(complete, load_config(name).groups)
            ],
            dialect=parse_switches(switches),
            cycle="forever" if cycles else "once",
            accounting=accounting,
            autostart=False,
        )
        if settings:
            self.controller.motion.settings = replace(
                MotionSettings(),
                **{
                    name.removeprefix("motion."): {"true": True, "false": False}.get(value, value)
                    for name, value in settings.items()
                },
            )
        self.task = self.controller.task("T_ROB1")
        self.printed: list[str] = []
        self.controller.operator.subscribe(lambda _, line: self.printed.append(line))
        if not words(text, "do"):
            self._to_the_end(cycles, words(text, "until"))

    def _to_the_end(self, cycles: list[list[str]], until: list[list[str]]) -> None:
        self.controller.start_program()
        if cycles:
            limit = int(cycles[0][0])
            self.controller.run_until(
                lambda: len(self.printed) >= limit or self.task.state != "running", timeout=60
            )
            del self.printed[limit:]
        else:
            finished = self.controller.run(max_time=float(until[0][0]) if until else 100)
            assert finished == "finished" or until, self.controller.where()

    def act(self, action: str) -> bool:
        """Execute an action of a `do`; return True if permitted."""
        match action.split():
            case ["start"]:
                return self.controller.start_program()
            case ["run", seconds]:
                self.controller.run_for(float(seconds))
            case ["step", *how]:
                self.task.step(**{word: True for word in how})
                self.controller.run_until(lambda: self.task.state != "running", timeout=30)
                self.controller.run_for(0.1)
            case ["set", name, value]:
                self.task[name] = value == "TRUE" if value in ("TRUE", "FALSE") else float(value)
            case ["signal", name, value]:
                self.controller.signals[name] = float(value)
            case ["jog", angle]:
                (group,) = self.controller.motion.groups.values()
                group.jog(tuple(place + float(angle) for place in group.positions()))
            case ["routine", name]:
                self.task.pp_to_routine(name)
            case ["cursor", lines]:
                assert self.task.place is not None
                self.task.pp_to_statement(self.task.place.span.line + int(lines))
            case ["service", name]:
                self.task.call_service(name)
            case _:
                self.controller.perform(action)
        return True

    def seen(self, marker: str, remaining: str) -> str:
        """Return the observed value for a comment."""
        first = remaining.split()[0]
        if marker == "state":
            return " ".join(task.state for task in self.controller.tasks.values())
        if marker == "at":
            place = self.task.place
            if place is None or self.task.state != "stopped":
                return self.task.state
            return f"{place.routine} {self.lines[place.span.line - 1].strip()}"
        if marker == "value":
            signals = self.controller.signals
            value = signals[first] if first in signals else self.task[first]
            return f"{first} = {value_text(value)}"
        events = [e for e in self.controller.log if e.sequence > self.since]
        report = [
            " ".join([first, *filter(None, e.texts)][:2]) for e in events if str(e.code) == first
        ]
        return "; ".join(report) or first

    def script(self, report: list[tuple[str, str]]) -> list[tuple[str, str]]:
        """Execute the comments of a program; return expected and seen."""
        result: list[tuple[str, str]] = []
        for marker, remaining in report:
            if marker == "do":
                self.since = max((e.sequence for e in self.controller.log), default=0)
                for action in remaining.split(", "):
                    try:
                        allowed = self.act(action)
                    except CannotStep:
                        allowed = False
                    if not allowed:
                        result.append(("refused", action))
            elif marker not in ("expect", "refused"):
                result.append((marker, self.seen(marker, remaining)))
            result += [("expect", line) for line in self.printed]
            self.printed.clear()
        return result + [("expect", line) for line in self.printed]

    def faults(self) -> list[str]:
        """Return how tasks ended with an error."""
        result = [task.fault for task in self.controller.tasks.values() if task.fault is not None]
        return [
            f"{f.cause.name if f.cause is not None else f.event} "
            f"{f.stack[-1].span.line if f.stack else 0}"
            for f in result
        ]


def cases(text: str) -> Iterator[tuple[str, list[tuple[str, str]]]]:
    """Iterate over the switches and comments of each case."""
    result: list[tuple[str, list[tuple[str, str]]]] = [("", [])]
    for marker, remaining in marks(text):
        if marker == "case":
            result.append((remaining, []))
        elif marker in (*SCRIPT, "fault"):
            result[-1][1].append((marker, remaining))
    if len(result) > 1:
        assert not result.pop(0)[1], "what is before the first case belongs to none"
    return iter(result)


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda p: p.below(HERE))
def test_program_matches_its_source(program: Program) -> None:
    text = program.text
    assert marks(text, "source"), f"{program}: name the source"
    for case, lines in cases(text):
        ends = []
        where = f"{program} {case}"
        for accounting in ("block", "statement"):
            run = Run(program, case, accounting)
            with run.controller:
                result = run.script([line for line in lines if line[0] != "fault"])
                assert result == [line for line in lines if line[0] not in ("do", "fault")], where
                assert run.faults() == [
                    remaining for marker, remaining in lines if marker == "fault"
                ], where
                ends.append(run.controller.scheduler.now)
        assert ends[0] == ends[1], f"{where}: block and statement accounting differ"


def test_there_are_programs() -> None:
    assert len(PROGRAMS) >= 130
