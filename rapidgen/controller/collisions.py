"""Collisions of robots on a virtual controller: worlds over time, and a proof of the planned path.

The path is that of the path planner, with its corners, circles and reorientations: samples every
4 ms, between which `Path.sampled` bounds the deviation. Robots of one controller share its clock.
`WorldHistory` knows which parts are gripped at which time.
"""

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path as FilePath
from typing import Literal, Protocol

import numpy as np

from rapidgen.collision import gripping
from rapidgen.collision.check import (
    Clearances,
    CollisionReport,
    PlaceOf,
    check_stages,
    stage_clearances,
)
from rapidgen.collision.gripping import grip_of, with_parts
from rapidgen.collision.path import Path
from rapidgen.collision.shapes import Array
from rapidgen.collision.timing import Together
from rapidgen.collision.world import World, build_world, sources_of
from rapidgen.config.cell import AttachKeys, CellDescription
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, Span
from rapidgen.machine.event_log import EventLog
from rapidgen.machine.io import IOSystem
from rapidgen.machine.scheduler import S, Scheduler, SyncPoints
from rapidgen.motion.recorder import PERIOD
from rapidgen.motion.system import MotionSystem

_SAMPLES = 2000
"""Times at which clearances are computed."""
OUT_OF_REACH = 191_911
"""Event: no part in reach of a gripper. The number is ours."""


@dataclass(frozen=True, slots=True)
class CollisionSetup:
    """The cell of a controller that is checked for collisions."""

    cell: CellDescription
    configurations: Mapping[str, FilePath] = field(default_factory=dict)
    """Files with descriptions of robots, by group."""
    mode: Literal["error", "warn"] = "error"


class WatchedRobots(Protocol):
    """The parts of a controller that a collision check uses."""

    scheduler: Scheduler
    io: IOSystem
    motion: MotionSystem
    meetings: SyncPoints

    @property
    def log(self) -> EventLog:
        """The event log."""


class WorldHistory:
    """The robots of a controller and what they hold, from its creation.

    Signals of the program attach and release parts (`attach:` of the cell file). Raises
    DiagnosticError for a cell that describes no world (RG825 to RG833), and ModuleNotFoundError
    for meshes without coal.
    """

    def __init__(self, controller: WatchedRobots, setup: CollisionSetup) -> None:
        self._controller = controller
        groups = [group.config for group in controller.motion.groups.values()]
        recorders = controller.motion.record()
        now = controller.scheduler.now
        home = {name: recorder.commanded([now])[0] for name, recorder in recorders.items()}
        robots = sources_of(setup.cell, groups, setup.configurations)
        world = with_parts(build_world(setup.cell, robots, home))
        self.recorders = {name: r for name, r in recorders.items() if name in world.columns}
        self._worlds: list[tuple[int, World]] = [(now, world)]
        self.findings: list[Diagnostic] = []
        """Grips without a part in reach (RG830)."""
        self.before_change: list[Callable[[], None]] = []
        """Called before a part is attached or released."""
        self.after_change: list[Callable[[], None]] = []
        self._follow_signals()

    @property
    def world(self) -> World:
        """The present world."""
        return self._worlds[-1][1]

    def stages(self) -> list[tuple[int, World]]:
        """Return the worlds with the times in ns from which they hold."""
        return list(self._worlds)

    def values(self, times: Sequence[int]) -> Array:
        """Return commanded values (n, columns) of the world at times in ns."""
        return self.world.values(
            {name: np.array(recorder.commanded(times)) for name, recorder in self.recorders.items()}
        )

    def forget(self, before: int) -> None:
        """Drop the motions and worlds of earlier times."""
        for recorder in self.recorders.values():
            recorder.forget(before)
        del self._worlds[:-1]

    def place(self, time: int) -> tuple[str, Span | None]:
        """Return the moves of all robots at a time, and the place of the first in its file."""
        texts, span = [], None
        for recorder in self.recorders.values():
            place = recorder.place(time)
            if place is not None:
                texts.append(place.reference)
                span = span or place.span
        return ", ".join(texts), span

    # -- gripped parts ---------------------------------------------------------------------------

    def attach(self, part: str, to: str = "") -> None:
        """Let a tool hold a part from now on. Raises DiagnosticError RG829, RG830."""
        now = [self._controller.scheduler.now]
        self._change(gripping.attach(self.world, grip_of(self.world, part, to), self.values(now)))

    def release(self, part: str) -> None:
        """Let a part stay where it is; nothing happens if no tool holds it."""
        if part in self.world.held:
            now = [self._controller.scheduler.now]
            self._change(gripping.release(self.world, part, self.values(now)))

    def _change(self, world: World) -> None:
        for notice in self.before_change:
            notice()
        self._worlds.append((self._controller.scheduler.now, world))
        for notice in self.after_change:
            notice()

    def _follow_signals(self) -> None:
        """Attach parts while the signals of their grips hold; the nearest one of each tool."""
        io = self._controller.io
        by_condition: dict[tuple[tuple[str, float], ...], list[AttachKeys]] = {}
        for grip in self.world.cell.attach:
            condition = tuple(sorted(grip.when.items()))
            if condition:
                by_condition.setdefault(condition, []).append(grip)
        for condition, grips in by_condition.items():
            look = _Condition(self, condition, grips).look
            for name, _ in condition:
                io[name].changed.add(look)
            if self.holds(condition):
                self.grip(grips, at_start=True)

    def holds(self, condition: tuple[tuple[str, float], ...]) -> bool:
        """Return True if all signals have their values."""
        io = self._controller.io
        return all(io[name].value == value for name, value in condition)

    def grip(self, grips: Sequence[AttachKeys], *, at_start: bool = False) -> None:
        """Attach all parts in reach; note if there is none (RG830), except at the start."""
        values = self.values([self._controller.scheduler.now])
        refused: list[DiagnosticError] = []
        for grip in sorted(grips, key=lambda one: gripping.gap(self.world, one, values)):
            try:
                self._change(gripping.attach(self.world, grip, values))
            except DiagnosticError as fault:
                refused.append(fault)
        if len(refused) == len(grips) and not at_start:
            found = refused[0].diagnostics[0]
            self._controller.log.record(OUT_OF_REACH, found.message)
            self.findings.append(found)


class _Condition:
    """Signals that hold parts."""

    def __init__(
        self,
        history: WorldHistory,
        condition: tuple[tuple[str, float], ...],
        grips: Sequence[AttachKeys],
    ) -> None:
        self._history, self._condition, self._grips = history, condition, grips
        self._held = history.holds(condition)

    def look(self) -> None:
        """Attach or release the parts if the condition has changed."""
        holds = self._history.holds(self._condition)
        if holds and not self._held:
            self._history.grip(self._grips)
        elif self._held and not holds:
            for grip in self._grips:
                self._history.release(grip.part)
        self._held = holds


class CollisionWatch:
    """Records all robots of a controller from its creation, and proves their paths.

    Raises DiagnosticError for a cell that describes no world (RG825 to RG833), and
    ModuleNotFoundError for meshes without coal.
    """

    def __init__(self, controller: WatchedRobots, setup: CollisionSetup) -> None:
        self._controller = controller
        self.history = WorldHistory(controller, setup)
        self._severity = Severity.ERROR if setup.mode == "error" else Severity.WARNING

    @property
    def world(self) -> World:
        """The present world."""
        return self.history.world

    def _stages(self) -> list[tuple[World, Path]]:
        """Return the worlds so far with the paths in them; times in s of the controller."""
        recorders = self.history.recorders.values()
        times = sorted({t for r in recorders for t in r.sample_times(PERIOD)})
        stages = self.history.stages()
        result = []
        for number, (since, world) in enumerate(stages):
            is_last = number + 1 == len(stages)
            until = max(times[-1], since) if is_last else stages[number + 1][0]
            own = times[bisect_left(times, since) : bisect_right(times, until)]
            rows = sorted({since, *own, until})
            path = Path.sampled(np.array(rows) / S, self.history.values(rows))
            result.append((world, path))
        return result

    def path(self) -> Path:
        """Return the path since the last grip or release, in the columns of the world; s."""
        return self._stages()[-1][1]

    def report(self) -> CollisionReport:
        """Prove the path so far."""
        result = check_stages(
            [(world, path, self._place_on(path)) for world, path in self._stages()],
            self._severity,
            self.together(),
        )
        found = [replace(one, severity=self._severity) for one in self.history.findings]
        return replace(result, diagnostics=(*found, *result.diagnostics))

    def _place_on(self, path: Path) -> PlaceOf:
        return lambda position: self.history.place(round(path.time(position) * S))

    def together(self) -> list[Together]:
        """Return the intervals of synchronised movement so far, with the groups of their tasks."""
        motion, meetings = self._controller.motion, self._controller.meetings
        names = {group.config.task.lower(): name for name, group in motion.groups.items()}
        return [
            (start / S, end / S, frozenset(names[task] for task in tasks if task in names))
            for start, end, tasks in meetings.together(self._controller.scheduler.now)
        ]

    def clearance(self) -> Clearances:
        """Return the clearances along the path so far."""
        return stage_clearances(self._stages(), _SAMPLES)
