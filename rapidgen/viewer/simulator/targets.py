"""Targets of the moves of the loaded programs, for the page."""

from collections.abc import Iterable, Iterator, Mapping

from rapidgen.axes import frames
from rapidgen.controller.inference.robot import MoveTarget, move_targets
from rapidgen.controller.runner import ControllerRunner
from rapidgen.motion.group import MotionGroup
from rapidgen.runtime.compiler.symbols import LoadedModule
from rapidgen.viewer.messages import SeenTarget, Targets, ToPage
from rapidgen.viewer.provider import Handler
from rapidgen.viewer.robots import pose_of

_MOST = 400
"""Number of drawn targets; the first ones of each program."""


class TargetsProvider:
    """Targets that programs declare, updated when modules are loaded."""

    def __init__(self, runner: ControllerRunner) -> None:
        self._tasks = runner.controller.rapid_tasks
        self._groups = {g.config.task: g for g in runner.controller.motion.groups.values()}
        self._known: tuple[LoadedModule, ...] = ()
        self._now = Targets(targets=())

    def whole(self) -> Iterable[ToPage]:
        """Return all targets."""
        yield from self.changes()
        yield self._now

    def changes(self) -> Iterable[ToPage]:
        """Return all targets if modules were loaded or unloaded."""
        modules = tuple(self._modules())
        if modules != self._known:
            self._known = modules
            result = Targets(targets=tuple(self._targets())[:_MOST])
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
