"""The cycle-time report of a run: time by move, by line of RAPID and by routine.

Standing time belongs to the statement at which the robot's task is meanwhile.
"""

import json
import re
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from math import isfinite
from pathlib import Path
from typing import TypeVar

from rapidgen import _json
from rapidgen._reading import read_foreign
from rapidgen.config.accelerations import ERROR_BAND
from rapidgen.controller.controller import VirtualController
from rapidgen.motion.accelerations import duration_error_band
from rapidgen.motion.cycle_times import CycleTimes, MoveTime
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.symbols import Routine
from rapidgen.runtime.errors import Location

FORMAT = "rapidgen cycle report"
VERSION = 1
START = "start of the program"
PROGRAM = "program"
_LARGEST = 500_000_000
"""Bytes of a report that is read."""
_MM = 1000.0
_DIGITS = 6
"""Decimals of seconds in the report."""
_STATEMENTS = {"IF", "ELSEIF", "FOR", "WHILE", "TEST", "CASE", "GOTO", "RETURN", "RAISE", "CONNECT"}
_K = TypeVar("_K")
Limits = dict[str, float]
"""Limits with the seconds for which they were active, the longest first."""


@dataclass(frozen=True, slots=True)
class ProgramLine:
    """A line of RAPID; all empty before the first statement and off the program."""

    module: str
    routine: str
    line: int
    text: str


_BEFORE = ProgramLine("", "", 0, START)


@dataclass(frozen=True, slots=True)
class MoveRow:
    """One executed move; s, mm, mm/s."""

    module: str
    routine: str
    line: int
    text: str
    start: float
    end: float
    seconds: float
    length: float
    mean_speed: float
    max_speed: float
    zone: float | str
    """mm, or `fine`."""
    stop: str
    """Why the robot stands at the end; empty if it does not."""
    limit: str
    limits: Limits


@dataclass(frozen=True, slots=True)
class LineRow:
    """All executions of one line."""

    module: str
    routine: str
    line: int
    text: str
    moves: int
    seconds: float
    moving: float
    waiting: float
    mean_speed: float
    max_speed: float
    limit: str
    limits: Limits


@dataclass(frozen=True, slots=True)
class RoutineRow:
    """All lines of one routine, without the routines that it calls."""

    module: str
    routine: str
    moves: int
    seconds: float
    moving: float
    waiting: float
    limit: str
    limits: Limits


@dataclass(frozen=True, slots=True)
class RobotReport:
    """One robot."""

    group: str
    model: str
    tasks: list[str]
    accelerations: str
    """`measured` or `estimated`."""
    note: str
    """Source of measured accelerations, error band of estimated ones."""
    error: float
    """Relative error that 90 % of the durations are within."""
    seconds: float
    moving: float
    waiting: float
    limits: Limits
    routines: list[RoutineRow]
    lines: list[LineRow]
    moves: list[MoveRow]
    standing: list[tuple[float, float]]
    """Intervals in which the robot stands."""


@dataclass(frozen=True, slots=True)
class CycleReport:
    """The report of all robots of one run."""

    system: str
    seconds: float
    robots: list[RobotReport]

    def json(self) -> str:
        """Return the report as a JSON document."""
        head: dict[str, object] = {"format": FORMAT, "version": VERSION}
        return json.dumps(head | asdict(self), indent=1, ensure_ascii=False) + "\n"


# -- recording --------------------------------------------------------------------------------


@dataclass(slots=True)
class _Total:
    """Sums; s, m, m/s."""

    passes: int = 0
    moving: float = 0.0
    waiting: float = 0.0
    length: float = 0.0
    fastest: float = 0.0
    limits: Limits = field(default_factory=dict)

    def add(self, other: "_Total") -> None:
        self.passes += other.passes
        self.moving += other.moving
        self.waiting += other.waiting
        self.length += other.length
        self.fastest = max(self.fastest, other.fastest)
        for name, seconds in other.limits.items():
            self.limits[name] = self.limits.get(name, 0.0) + seconds


class _Waits:
    """Standing time of a robot by the line at which its task is."""

    def __init__(self, controller: VirtualController, times: CycleTimes, tasks: list[str]) -> None:
        self.by_line: dict[ProgramLine, float] = {}
        self._scheduler = controller.scheduler
        self._times = times
        self._tasks = tasks
        self._line = _BEFORE
        self._stood = 0.0
        controller.statements.listen(self._statement)

    def _statement(self, task: str, routine: Routine, node: n.Statement) -> None:
        if task in self._tasks:
            self.count()
            module = routine.module
            assert module is not None
            source = module.tree.source
            line = source.line(node.first)
            text = source.text[source.starts[node.first] :].split("\n", 1)[0].strip()
            self._line = ProgramLine(module.name, routine.name, line, text)

    def count(self) -> None:
        """Count the time since the last statement."""
        stood = self._times.stood(self._scheduler.now)
        if stood > self._stood:
            known = self.by_line.get(self._line, 0.0)
            self.by_line[self._line] = known + stood - self._stood
            self._stood = stood


class CycleRecorder:
    """Watches all robots of a controller from before its program starts.

    The controller has to be booted with tracing.
    """

    def __init__(self, controller: VirtualController) -> None:
        self._controller = controller
        self._texts: dict[str, list[str]] = {}
        self._routines = {
            routine.name.lower()
            for task in controller.rapid_tasks.values()
            for module in task.program.modules.values()
            for routine in module.tree.routines
        }
        self._groups: list[tuple[CycleTimes, _Waits, list[str]]] = []
        motion = controller.motion
        for group in motion.groups.values():
            tasks = [name for name in controller.rapid_tasks if motion.moved_by(name) is group]
            times = CycleTimes(controller.scheduler, group)
            self._groups.append((times, _Waits(controller, times, tasks), tasks))

    def report(self) -> CycleReport:
        """Return the report up to now, and end."""
        for times, waits, _ in self._groups:
            waits.count()
            times.finish()
        controller = self._controller
        robots = [self._robot(*entry) for entry in self._groups]
        return CycleReport(controller.system.name, _s(controller.now), robots)

    def _robot(self, times: CycleTimes, waits: _Waits, tasks: list[str]) -> RobotReport:
        moves = [(self._line(move), move) for move in times.moves]
        lines: dict[ProgramLine, _Total] = {}
        for line, move in moves:
            own = _Total(1, move.duration, 0.0, move.length, move.fastest, move.limits)
            lines.setdefault(line, _Total()).add(own)
        for line, seconds in waits.by_line.items():
            own = _Total(waiting=seconds, limits={self._wait(line): seconds})
            lines.setdefault(line, _Total()).add(own)
        routines: dict[tuple[str, str], _Total] = {}
        whole = _Total()
        for line, total in lines.items():
            routines.setdefault((line.module, line.routine), _Total()).add(total)
            whole.add(total)
        config = times.group.config
        measured, error = duration_error_band(config)
        return RobotReport(
            group=times.group.name,
            model=config.model,
            tasks=tasks,
            accelerations="measured" if measured else "estimated",
            note=config.acceleration_source if measured else ERROR_BAND,
            error=error,
            seconds=_s(times.end - times.start),
            moving=_s(whole.moving),
            waiting=_s(whole.waiting),
            limits=_limits(whole.limits),
            routines=[_routine_row(*key, total) for key, total in _by_time(routines)],
            lines=[_line_row(line, total) for line, total in _by_time(lines)],
            moves=[_move_row(line, move) for line, move in moves],
            standing=[(_s(begin), _s(end)) for begin, end in times.standing],
        )

    def _wait(self, line: ProgramLine) -> str:
        """Return the instruction at which the task is; `program` for other statements."""
        if not line.line:
            return START
        first = re.match(r"(\w+)\s*(?!\w|\s*(:=|[.{]))", line.text)
        name = first[1] if first else ""
        own = name.upper() in _STATEMENTS or name.lower() in self._routines
        return PROGRAM if own or not name else name

    def _line(self, move: MoveTime) -> ProgramLine:
        place = move.place
        if not isinstance(place, Location):
            return ProgramLine("", "", 0, "not programmed")
        path, line = place.span.path, place.span.line
        if path not in self._texts:
            self._texts[path] = self._text(path)
        texts = self._texts[path]
        text = texts[line - 1].strip() if line <= len(texts) else place.instruction
        return ProgramLine(place.module, place.routine, line, text)

    def _text(self, path: str) -> list[str]:
        for task in self._controller.rapid_tasks.values():
            for module in task.program.modules.values():
                if module.tree.source.path == path:
                    return module.tree.source.text.splitlines()
        return []


def _by_time(totals: dict[_K, _Total]) -> list[tuple[_K, _Total]]:
    """Return totals, the longest first; equal ones stay in the order of the run."""
    return sorted(totals.items(), key=lambda item: -item[1].moving - item[1].waiting)


def _routine_row(module: str, routine: str, total: _Total) -> RoutineRow:
    return RoutineRow(
        module=module,
        routine=routine,
        moves=total.passes,
        seconds=_s(total.moving + total.waiting),
        moving=_s(total.moving),
        waiting=_s(total.waiting),
        limit=_first(total.limits),
        limits=_limits(total.limits),
    )


def _line_row(line: ProgramLine, total: _Total) -> LineRow:
    return LineRow(
        module=line.module,
        routine=line.routine,
        line=line.line,
        text=line.text,
        moves=total.passes,
        seconds=_s(total.moving + total.waiting),
        moving=_s(total.moving),
        waiting=_s(total.waiting),
        mean_speed=_speed(total.length, total.moving),
        max_speed=round(total.fastest * _MM, 1),
        limit=_first(total.limits),
        limits=_limits(total.limits),
    )


def _move_row(line: ProgramLine, move: MoveTime) -> MoveRow:
    return MoveRow(
        module=line.module,
        routine=line.routine,
        line=line.line,
        text=line.text,
        start=_s(move.start),
        end=_s(move.end),
        seconds=_s(move.duration),
        length=round(move.length * _MM, 2),
        mean_speed=_speed(move.length, move.duration),
        max_speed=round(move.fastest * _MM, 1),
        zone="fine" if move.zone.fine else round(move.zone.tcp * _MM, 2),
        stop=move.stop,
        limit=_first(move.limits),
        limits=_limits(move.limits),
    )


def _first(limits: Limits) -> str:
    return max(limits, key=limits.__getitem__, default="")


def _limits(limits: Limits) -> Limits:
    longest = sorted(limits.items(), key=lambda item: -item[1])
    return {name: _s(seconds) for name, seconds in longest if _s(seconds)}


def _s(seconds: float) -> float:
    return round(seconds, _DIGITS)


def _speed(length: float, seconds: float) -> float:
    return round(length / seconds * _MM, 1) if seconds > 0.0 else 0.0


# -- an earlier report, to compare with -------------------------------------------------------


_Timed = tuple[ProgramLine, float]
"""A line and its seconds."""


@dataclass(frozen=True, slots=True)
class Difference:
    """A line in two reports; None: it was not executed in that one."""

    before: _Timed | None
    after: _Timed | None

    @property
    def change(self) -> float:
        """Seconds by which the second report is longer."""
        old, new = (known[1] if known else 0.0 for known in (self.before, self.after))
        return new - old


@dataclass(frozen=True, slots=True)
class EarlierRobot:
    """What a comparison needs of one robot; lines with their seconds."""

    group: str
    seconds: float
    moving: float
    waiting: float
    limits: Limits
    lines: list[_Timed]


def read_report(path: Path) -> list[EarlierRobot]:
    """Return the robots of a report in JSON. OSError; ValueError: it is none."""
    try:
        data = _json.members(json.loads(read_foreign(path, _LARGEST).decode()))
        if data.get("format") != FORMAT or data.get("version") != VERSION:
            raise ValueError(f"it is not a {FORMAT} of version {VERSION}")
        return [_earlier(_json.members(robot)) for robot in _json.items(data["robots"])]
    except (TypeError, KeyError, RecursionError) as fault:
        raise ValueError(f"a value is missing or has another type: {fault}") from None


def _earlier(robot: _json.Members) -> EarlierRobot:
    limits = _json.members(robot["limits"])
    return EarlierRobot(
        group=_json.text(robot["group"]),
        seconds=_seconds(robot["seconds"]),
        moving=_seconds(robot["moving"]),
        waiting=_seconds(robot["waiting"]),
        limits={name: _seconds(value) for name, value in limits.items()},
        lines=[_earlier_line(_json.members(line)) for line in _json.items(robot["lines"])],
    )


def _earlier_line(line: _json.Members) -> _Timed:
    place = ProgramLine(
        module=_json.text(line["module"]),
        routine=_json.text(line["routine"]),
        line=_json.whole(line["line"]),
        text=_json.text(line["text"]),
    )
    return place, _seconds(line["seconds"])


def _seconds(data: _json.Json) -> float:
    value = _json.number(data)
    if not (isfinite(value) and value >= 0.0):
        raise ValueError(f"{value} is no duration")
    return value


def differences(before: EarlierRobot, after: RobotReport) -> list[Difference]:
    """Compare lines, the largest change first. Line numbers may differ.

    Lines of one routine with the same text belong together, the first to the first and so on; then,
    of the remaining ones, those with the same instruction.
    """
    old = sorted(before.lines, key=lambda item: item[0].line)
    new = [
        (ProgramLine(row.module, row.routine, row.line, row.text), row.seconds)
        for row in sorted(after.lines, key=lambda row: row.line)
    ]
    result = []
    for key in (_text_key, _instruction_key):
        matches, old, new = _matched(old, new, key)
        result += matches
    result += [Difference(line, None) for line in old] + [Difference(None, line) for line in new]
    return sorted(result, key=lambda row: -abs(row.change))


def _text_key(line: ProgramLine) -> tuple[str, ...]:
    return line.module.lower(), line.routine.lower(), *line.text.split()


def _instruction_key(line: ProgramLine) -> tuple[str, ...]:
    return _text_key(line)[:3]


def _matched(
    old: list[_Timed], new: list[_Timed], key: Callable[[ProgramLine], tuple[str, ...]]
) -> tuple[list[Difference], list[_Timed], list[_Timed]]:
    """Return pairs with the same key, and what is left of both."""
    waiting: dict[tuple[str, ...], list[_Timed]] = {}
    for entry in old:
        waiting.setdefault(key(entry[0]), []).append(entry)
    pairs, left = [], []
    for entry in new:
        same = waiting.get(key(entry[0]))
        if same:
            pairs.append(Difference(same.pop(0), entry))
        else:
            left.append(entry)
    return pairs, [entry for entries in waiting.values() for entry in entries], left
