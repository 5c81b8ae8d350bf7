"""A robot alone: scheduler, log, I/O and motion; Python functions stand for RAPID tasks."""

from collections.abc import Callable
from types import SimpleNamespace

import numpy as np

from rapidgen.config import load_config
from rapidgen.machine.event_log import EventLog
from rapidgen.machine.io import IOSystem
from rapidgen.machine.scheduler import S, Scheduler
from rapidgen.motion import MotionSettings, MotionSystem
from rapidgen.motion.moves import Zone
from rapidgen.rapid.switches import Switches
from rapidgen.runtime.compiler.emit.access import Options
from rapidgen.runtime.compiler.link import Shared
from rapidgen.runtime.task.task import Task
from rapidgen.system.model import System, TaskSpec

PLANNED = MotionSettings(ramp_time=0.0, corner_size=1.0, shortest_corner=0.0)
"""The motion as planned: parabolas of the whole zone, and no smoothing, which rounds every bend of
a path in space by up to some 0.1 mm at the speeds of these tests."""


def zone(millimetres: float) -> Zone:
    """A zone with the proportions of the predefined ones; 0 = fine."""
    if millimetres == 0:
        return Zone(fine=True)
    m = millimetres / 1000
    return Zone(tcp=m, orientation=1.5 * m, external=1.5 * m, angle=m * 2.6, linear=1.5 * m,
                rotary=m * 2.6)  # fmt: skip


class Cell:
    """One group of a shipped robot."""

    def __init__(self, robot: str = "irb120", settings: MotionSettings | None = None) -> None:
        self.config = load_config(robot).groups[0]
        self.scheduler = Scheduler()
        self.log = EventLog(self.scheduler)
        io = IOSystem(self.scheduler, self.log, System("cell", ()))
        self.motion = MotionSystem(self.scheduler, [self.config], self.log, io, settings)
        self.group = self.motion.group(self.config.name)
        self.times: list[int] = []
        self.samples: list[tuple[float, ...]] = []

    def start(self, program: Callable[[Task], None]) -> Task:
        """Launch a program."""
        controller = SimpleNamespace(dialect=Switches(), options=Options())
        task = Task(self.scheduler, TaskSpec("T_ROB1"), controller, Shared())
        task.launch(lambda: program(task))
        return task

    def at(self, seconds: float, act: Callable[[], None]) -> None:
        """Do something at a time."""
        self.scheduler.at(round(seconds * S), act)

    def run(self, program: Callable[[Task], None], *, period: float = 0.002, limit: float = 60.0):
        """Run a program to its end and standstill, sampling the axes."""
        task = self.start(program)
        self.sample(lambda: not task.alive and self.group.is_standing, period, limit)
        assert not task.alive, "the program did not end"
        return task

    def sample(self, done: Callable[[], bool], period: float = 0.002, limit: float = 60.0) -> None:
        """Let time pass until `done()`, sampling the axes."""
        over = False
        end = self.scheduler.now + round(limit * S)

        def look() -> None:
            nonlocal over
            self.times.append(self.scheduler.now)
            self.samples.append(self.group.positions())
            over = done() or self.scheduler.now > end
            if not over:
                self.scheduler.after(round(period * S), look)

        self.scheduler.after(0, look)
        self.scheduler.advance(until=end + S, stop=lambda: over)

    @property
    def path(self) -> np.ndarray:
        """Sampled axes."""
        return np.array(self.samples)

    def shares(self, period: float = 0.002) -> tuple[float, float]:
        """Largest speed and acceleration of the samples, as shares of the axes' limits."""
        speeds = np.diff(self.path, axis=0) / period
        bends = np.diff(speeds, axis=0) / period
        fastest = np.array([j.speed for j in self.config.joints])
        strongest = np.array([j.acceleration for j in self.config.joints])
        return (
            float((np.abs(speeds) / fastest).max(initial=0)),
            float((np.abs(bends) / strongest).max(initial=0)),
        )

    def events(self, code: int) -> int:
        """How often an event is in the log."""
        return sum(1 for event in self.log if event.code == code)
