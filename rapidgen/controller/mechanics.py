"""Which robot model moves which task, for a system that does not say it by itself."""

from dataclasses import replace

from rapidgen.config.model import GroupConfig, RobotConfig
from rapidgen.system.model import System

DEFAULT_ROBOT = "irb120"


def motion_tasks(system: System) -> list[str]:
    """Names of the tasks that move robots; the first one when none says so."""
    moving = [task.name for task in system.tasks if task.motion]
    return moving or [task.name for task in system.tasks[:1]]


def groups_for(system: System, config: RobotConfig) -> tuple[GroupConfig, ...]:
    """The configuration's groups, given to the system's motion tasks in order.

    More motion tasks than groups get copies of the last one.
    """
    groups = []
    for i, task in enumerate(motion_tasks(system)):
        group = config.groups[min(i, len(config.groups) - 1)]
        name = group.name if i < len(config.groups) else f"{group.name}_{i + 1}"
        groups.append(replace(group, name=name, task=task))
    return tuple(groups)
