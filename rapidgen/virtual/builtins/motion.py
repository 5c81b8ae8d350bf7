"""Move instructions in joint space: MoveAbsJ and MoveExtJ.

Sources: 3HAC050917 (RobotWare 6) for arguments, S4 datasys 2-MoveAbsJ for behaviour.
"""

from typing import Any

from rapidgen.virtual.motion.access import here, moving_group
from rapidgen.virtual.motion.arguments import (
    dwell_of,
    speed_of,
    target_of,
    time_of,
    zone_of,
)
from rapidgen.virtual.motion.moves import JointMove
from rapidgen.virtual.registry import builtin
from rapidgen.virtual.task import Task
from rapidgen.virtual.values import Ref

Data = Any
_NO_OFFSETS = (0.0,) * 6


@builtin("MoveAbsJ", cost="move")
def move_abs_j(
    task: Task,
    concurrent: bool | None,
    to: Data,
    _identity: float | None,
    no_offsets: bool | None,
    speed: Data,
    tcp_speed: float | None,
    time: float | None,
    zone: Data,
    radius: float | None,
    stop: Data,
    tool: Ref,
    work_object: Ref | None,
    _load: Ref | None,
) -> None:
    """Displacement does not count here, offsets of external axes do (S4 datasys 2-MoveAbsJ-3)."""
    group = moving_group(task)
    modal = group.modal
    offsets = _NO_OFFSETS if no_offsets else modal.external_offset
    group.use(tool.get(), work_object.get() if work_object is not None else None)
    group.move(
        task,
        JointMove(
            target=target_of(to, group.map, group.path_target, offsets),
            speed=speed_of(speed, tcp_speed, modal),
            zone=zone_of(zone, radius, stop),
            time=time_of(time, modal),
            concurrent=bool(concurrent),
            dwell=dwell_of(stop),
            place=here(task),
        ),
    )


@builtin("MoveExtJ", cost="move")
def move_ext_j(
    task: Task,
    concurrent: bool | None,
    to: Data,
    _identity: float | None,
    use_offsets: bool | None,
    speed: Data,
    time: float | None,
    zone: Data,
    stop: Data,
) -> None:
    """Robot axes stay where the path ends."""
    group = moving_group(task)
    modal = group.modal
    ends = group.path_target
    target = target_of(to, group.map, ends, modal.external_offset if use_offsets else _NO_OFFSETS)
    target = tuple(
        new if joint.axis.startswith("eax") else old
        for joint, new, old in zip(group.config.joints, target, ends, strict=True)
    )
    group.move(
        task,
        JointMove(
            target=target,
            speed=speed_of(speed, None, modal),
            zone=zone_of(zone, None, stop),
            time=time_of(time, modal),
            concurrent=bool(concurrent),
            dwell=dwell_of(stop),
            place=here(task),
        ),
    )
