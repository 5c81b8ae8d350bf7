"""Collisions of robots on a virtual controller: a proof of the planned path.

The path is that of the path planner, with its corners, circles and reorientations: samples every
4 ms, between which `Path.sampled` bounds the deviation. Robots of one controller share its clock.
"""

from collections.abc import Mapping
from pathlib import Path as FilePath
from typing import TYPE_CHECKING

import numpy as np

from rapidgen.collision.check import Clearances, CollisionReport, check_path, clearances
from rapidgen.collision.path import Path
from rapidgen.collision.timing import Together
from rapidgen.collision.world import World, build_world, sources_of
from rapidgen.config.cell import CellDescription
from rapidgen.diagnostics import Severity, Span
from rapidgen.machine.scheduler import S
from rapidgen.motion.recorder import PERIOD

if TYPE_CHECKING:
    from rapidgen.controller.controller import VirtualController

_SAMPLES = 2000
"""Times at which clearances are computed."""


class CollisionWatch:
    """Records all robots of a controller from its creation, and proves their paths.

    Raises DiagnosticError for a cell that describes no world (RG825 to RG833), and
    ModuleNotFoundError for meshes without coal.
    """

    def __init__(
        self,
        controller: "VirtualController",
        cell: CellDescription,
        configurations: Mapping[str, FilePath] | None = None,
    ) -> None:
        """`configurations` are the files of groups with descriptions, by group."""
        self._controller = controller
        groups = [group.config for group in controller.motion.groups.values()]
        recorders = controller.record()
        now = [controller.scheduler.now]
        home = {name: recorder.postures(now)[0][0] for name, recorder in recorders.items()}
        robots = sources_of(cell, groups, configurations)
        self.world: World = build_world(cell, robots, home)
        self._recorders = {
            name: recorder for name, recorder in recorders.items() if name in self.world.columns
        }

    def path(self) -> Path:
        """Return the path so far in the columns of the world; times in s of the controller."""
        times = sorted({t for r in self._recorders.values() for t in r.sample_times(PERIOD)})
        postures = {
            name: np.array([commanded for commanded, _ in recorder.postures(times)])
            for name, recorder in self._recorders.items()
        }
        return Path.sampled(np.array(times) / S, self.world.values(postures))

    def report(self, severity: Severity = Severity.ERROR) -> CollisionReport:
        """Prove the path so far."""
        path = self.path()

        def place_of(position: float) -> tuple[str, Span | None]:
            return self._place(round(path.time(position) * S))

        return check_path(self.world, path, place_of, severity, self.together())

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
        path = self.path()
        times = np.linspace(path.times[0], path.times[-1], _SAMPLES)
        return clearances(self.world.scene, path, times)

    def _place(self, time: int) -> tuple[str, Span | None]:
        """Return the moves of all robots at a time, and the place of the first in its file."""
        texts, span = [], None
        for recorder in self._recorders.values():
            place = recorder.place(time)
            if place is not None:
                texts.append(place.reference)
                span = span or place.span
        return ", ".join(texts), span
