"""All motion groups of one controller, and which task moves which."""

from collections.abc import Callable, Iterable

from rapidgen.config.model import GroupConfig
from rapidgen.machine.event_log import EventLog
from rapidgen.machine.io import IOSystem
from rapidgen.machine.scheduler import Scheduler
from rapidgen.motion.group import MotionGroup
from rapidgen.motion.recorder import Recorder
from rapidgen.motion.settings import MotionSettings
from rapidgen.motion.zones import WorldZones


class MotionSystem:
    """The motion side of a controller: `group(name)`, `of_task(name)`."""

    def __init__(
        self,
        scheduler: Scheduler,
        robots: Iterable[GroupConfig],
        log: EventLog,
        io: IOSystem,
        settings: MotionSettings | None = None,
    ) -> None:
        self._scheduler = scheduler
        self._settings = settings if settings is not None else MotionSettings()
        self.groups: dict[str, MotionGroup] = {
            config.name: MotionGroup(config, scheduler, log, io, self._settings)
            for config in robots
        }
        self.zones = WorldZones(scheduler, self.groups.values())
        self._tasks = {g.config.task.lower(): g for g in self.groups.values()}
        self._moving = set(self._tasks)
        self.on_missed: Callable[[str, str], None] | None = None
        """In inferred cells: called with (place in the program, how it moved there) for targets
        that the robots do not reach as programmed. None: such a target stops the program."""
        self.is_any_robot = False
        """True if the robots are inferred."""
        self.moved: set[str] = set()
        """Groups that a program has moved, or whose start position the user chose."""

    @property
    def settings(self) -> MotionSettings:
        """The switches of docs/rapid/motion-model.md; set them before anything moves."""
        return self._settings

    @settings.setter
    def settings(self, value: MotionSettings) -> None:
        self._settings = value
        for group in self.groups.values():
            group.settings = value

    def group(self, name: str) -> MotionGroup:
        """The group of that name. KeyError: there is none."""
        return self.groups[name]

    def record(self) -> dict[str, Recorder]:
        """Start recording every group; see `recorder.py`."""
        return {name: Recorder(self._scheduler, group) for name, group in self.groups.items()}

    def assign(self, task: str, group: str, *, moving: bool = False) -> None:
        """Let a task act on a group (UseMechanicalUnitGroup of a background task).

        `moving`: it is a motion task, whatever the robot's configuration calls its own.
        """
        self._tasks[task.lower()] = self.groups[group]
        if moving:
            self._moving.add(task.lower())

    def of_task(self, task: str) -> MotionGroup | None:
        """The group that a task moves or is connected to.

        A task without a connection of its own gets the only group of a one-robot controller.
        """
        match = self._tasks.get(task.lower())
        if match is None and len(self.groups) == 1:
            return next(iter(self.groups.values()))
        return match

    def moved_by(self, task: str) -> MotionGroup | None:
        """The group that a motion task moves; None for any other task."""
        return self.of_task(task) if self.is_motion_task(task) else None

    def is_motion_task(self, task: str) -> bool:
        """Whether a task may execute move instructions."""
        return task.lower() in self._moving
