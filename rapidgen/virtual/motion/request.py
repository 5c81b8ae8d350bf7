"""Move instructions as requests: one place where RAPID's arguments become a Move."""

from dataclasses import dataclass
from typing import Any, TypeAlias

from rapidgen.virtual.motion.access import here, moving_group
from rapidgen.virtual.motion.arguments import dwell_of, frame, speed_of, time_of, zone_of
from rapidgen.virtual.motion.group import MotionGroup
from rapidgen.virtual.motion.moves import FINE, CartesianMove, JointMove, Move, PathEvent
from rapidgen.virtual.motion.targets import (
    carrier_of,
    configuration_of,
    external_posture,
    joints_for,
)
from rapidgen.virtual.task import Task
from rapidgen.virtual.values import Ref

Data: TypeAlias = Any


@dataclass(frozen=True, slots=True, kw_only=True)
class Request:
    """What MoveJ, MoveL, MoveC and their relatives have in common, as RAPID values."""

    speed: Data
    tool: Ref
    zone: Data = None
    """None: a stop point (searches)."""
    work_object: Ref | None = None
    tcp_speed: float | None = None
    time: float | None = None
    radius: float | None = None
    stop: Data = None
    concurrent: bool | None = None
    events: tuple[PathEvent, ...] = ()

    def _common(self, task: Task, group: MotionGroup) -> dict[str, Any]:
        tool = self.tool.get()
        work_object = self.work_object.get() if self.work_object is not None else None
        carrier = carrier_of(group, tool, work_object)
        group.use(tool, work_object)
        fine = self.zone is None
        return {
            "speed": speed_of(self.speed, self.tcp_speed, group.modal),
            "zone": FINE if fine else zone_of(self.zone, self.radius, self.stop),
            "time": time_of(self.time, group.modal),
            "concurrent": bool(self.concurrent),
            "dwell": dwell_of(self.stop),
            "carrier": carrier,
            "place": here(task),
            "events": self.events,
        }

    def joint(self, task: Task, target: Data) -> tuple[MotionGroup, Move]:
        """To a robtarget with all axes together."""
        group = moving_group(task)
        kinematics = group.geometry()
        common = self._common(task, group)
        near = external_posture(group, target.extax)
        flange = common["carrier"].at(near).flange(frame(target))
        wanted = configuration_of(target.robconf) if group.modal.check_joint else None
        posture = joints_for(kinematics, flange, near, wanted)
        return group, JointMove(target=posture, **common)

    def cartesian(self, task: Task, target: Data, via: Data = None) -> tuple[MotionGroup, Move]:
        """To a robtarget on a line, or on the circle through `via`."""
        group = moving_group(task)
        group.geometry()
        common = self._common(task, group)
        wanted = configuration_of(target.robconf) if group.modal.check_linear else None
        return group, CartesianMove(
            target=frame(target),
            external=external_posture(group, target.extax),
            via=None if via is None else frame(via),
            wanted=wanted,
            singularities=group.modal.singularities,
            circle=group.modal.circle,
            **common,
        )
