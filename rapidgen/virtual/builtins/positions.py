"""Reading positions. Sources: S4 datasys 3-CJointT, 3-CRobT; 3HAC050917 for arguments."""

from typing import Any

from rapidgen.virtual.motion.access import named_group
from rapidgen.virtual.motion.arguments import joint_target
from rapidgen.virtual.registry import builtin
from rapidgen.virtual.task import Task


@builtin("CJointT")
def c_joint_t(task: Task, reference: Any, name: str | None) -> Any:  # noqa: ANN401
    """Arm-side angles and external axes now, without external offsets' zero shifted."""
    group = named_group(task, reference, name)
    return joint_target(group.map, group.positions(), group.modal.external_offset)
