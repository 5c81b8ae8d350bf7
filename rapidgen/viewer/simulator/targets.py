"""Targets of the moves of the loaded programs, for the page."""

from collections.abc import Iterable, Iterator, Mapping
from itertools import islice
from typing import Literal

from rapidgen.axes import frames
from rapidgen.controller.inference.robot import MoveTarget, move_targets
from rapidgen.controller.runner import ControllerRunner
from rapidgen.motion.group import MotionGroup
from rapidgen.runtime.builtins.motion.targets import frame
from rapidgen.runtime.compiler.symbols import LoadedModule
from rapidgen.runtime.values import ToolData, Value, WobjData
from rapidgen.viewer.messages import Pose, SeenFrame, SeenTarget, Targets, ToPage
from rapidgen.viewer.provider import Handler
from rapidgen.viewer.robots import pose_of

_MOST = 400
"""Number of drawn targets; the first ones of each program."""
_FRAMES = 60
"""Number of drawn tools and work objects."""
_EVERY = 15
"""Looks of the page for one look at their values: about twice a second."""


class TargetsProvider:
    """Targets that programs declare, updated when modules are loaded."""

    def __init__(self, runner: ControllerRunner) -> None:
        self._controller = runner.controller
        self._tasks = runner.controller.rapid_tasks
        self._looks = 0
        self._groups = {g.config.task: g for g in runner.controller.motion.groups.values()}
        self._known: tuple[LoadedModule, ...] = ()
        self._now = Targets(targets=())

    def whole(self) -> Iterable[ToPage]:
        """Return all targets."""
        yield from self.changes()
        yield self._now

    def changes(self) -> Iterable[ToPage]:
        """Return all targets and frames if modules were loaded, or values have changed."""
        modules = tuple(self._modules())
        targets = self._now.targets
        self._looks += 1
        if modules != self._known:
            self._known = modules
            targets = tuple(self._targets())[:_MOST]
        elif self._looks % _EVERY:
            return
        result = Targets(targets=targets, frames=tuple(islice(self._frames(), _FRAMES)))
        if result != self._now:
            self._now = result
            yield result

    def handlers(self) -> Mapping[type, Handler]:
        """There are no requests."""
        return {}

    def _modules(self) -> Iterator[LoadedModule]:
        for name in self._groups:
            task = self._tasks.get(name)
            if task is not None:
                yield from (m for m in task.program.modules.values() if not m.installed)

    def _frames(self) -> Iterator[SeenFrame]:
        """Yield tools that the robot holds and work objects at rest, with their present values."""
        for name, group in self._groups.items():
            task = self._tasks.get(name)
            if task is None or group.kinematics is None:
                continue
            values = self._controller.task(name)
            for module in task.program.modules.values():
                for data in module.declarations.values():
                    if data.dimensions or data.type.lower() not in ("tooldata", "wobjdata"):
                        continue
                    frame = _frame_of(values[f"{module.name}:{data.name}"])
                    if frame is not None:
                        kind, pose = frame
                        yield SeenFrame(group=group.name, name=data.name, kind=kind, pose=pose)

    def _targets(self) -> Iterator[SeenTarget]:
        for name, group in self._groups.items():
            task = self._tasks.get(name)
            modules = task.program.modules.values() if task is not None else ()
            seen = set()
            for module in modules:
                for target in () if module.installed else move_targets(module.scope):
                    made = seen_target(group, module.name, target)
                    same = made and (made.name, made.pose)
                    if made is not None and same not in seen:
                        seen.add(same)
                        yield made


def seen_target(group: MotionGroup, module: str, target: MoveTarget) -> SeenTarget | None:
    """Return a target with its TCP in the world; None if the pose is unknown."""
    place = target.place
    if place is None and group.kinematics is not None:
        still = (0.0,) * len(group.config.joints)
        posture = group.map.from_rapid(target.axes, target.external, still)
        place = frames.compose(group.kinematics.forward(posture), target.tool)
    if place is None:
        return None
    return SeenTarget(
        group=group.name, name=target.name, module=module, line=target.line, pose=pose_of(place)
    )


def _frame_of(value: Value) -> tuple[Literal["tool", "work_object"], Pose] | None:
    """Return the frame of a tool or work object.

    None: another robot or unit carries it, or it is that of the flange or the world.
    """
    if isinstance(value, ToolData):
        pose = frame(value.tframe) if value.robhold else frames.IDENTITY
        return None if pose == frames.IDENTITY else ("tool", pose_of(pose))
    if not isinstance(value, WobjData) or value.robhold or not value.ufprog:
        return None
    pose = frames.compose(frame(value.uframe), frame(value.oframe))
    return None if pose == frames.IDENTITY else ("work_object", pose_of(pose))
