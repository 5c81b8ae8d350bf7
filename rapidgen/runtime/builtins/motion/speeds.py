"""MaxRobReorientSpeed and its relatives, CornerPathWarning.

Sources: 3HAC050917 for the names; the speeds are those of the predefined vmax [mem].
"""

from collections.abc import Callable

from rapidgen.rapid.builtins.signatures import constant
from rapidgen.runtime.builtins.motion.task_group import group_of
from rapidgen.runtime.registry import builtins
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Value


def _part_of_vmax(place: int) -> Callable[[Task], Value]:
    vmax = constant("vmax")
    assert vmax is not None
    assert isinstance(vmax.value, tuple)
    speed = vmax.value[place]
    return lambda _task: speed


def _corner_path_warning(task: Task, warning: bool) -> None:
    """Whether corners that become stop points are told (50024), until PP to main."""
    group_of(task).modal.corner_warning = warning


_PLAIN: dict[str, Callable[..., Value]] = {
    "MaxRobReorientSpeed": _part_of_vmax(1),
    "MaxExtLinearSpeed": _part_of_vmax(2),
    "MaxExtReorientSpeed": _part_of_vmax(3),
    "CornerPathWarning": _corner_path_warning,
}
builtins(_PLAIN)
