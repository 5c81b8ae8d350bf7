"""Poses of a group's tool in its work object, and the postures that reach them. Sans-IO.

Postures are controller axis values in wire order, rad and m; poses are of the TCP in the object's
frame, m.
"""

from dataclasses import dataclass

from rapidgen.axes import frames
from rapidgen.axes.frames import Pose
from rapidgen.axes.kinematics import AxisConfiguration, Kinematics, Posture
from rapidgen.config.model import GroupConfig, Placement


@dataclass(frozen=True, slots=True)
class Frames:
    """A robot's geometry with the tool in the hand and the object before it."""

    kinematics: Kinematics
    tool: Pose
    work_object: Pose

    @classmethod
    def of(cls, group: GroupConfig) -> "Frames | None":
        """Those of a group; None where its geometry, its tool or its work object is not known, or
        the tool stands beside the robot."""
        kinematics = Kinematics.of(group)
        tool, wobj = group.tool, group.work_object
        if kinematics is None or tool.elsewhere or wobj.elsewhere or wobj.held or not tool.held:
            return None
        placed = frames.compose(_frame(wobj.user_frame), _frame(wobj.object_frame))
        return cls(kinematics, _frame(tool.frame), placed)

    def pose(self, posture: Posture) -> Pose:
        """Where the TCP is; the quaternion's scalar is not negative."""
        flange = self.kinematics.forward(posture)
        place, q = frames.compose(
            frames.compose(frames.invert(self.work_object), flange), self.tool
        )
        return (place, q) if q[0] >= 0 else (place, (-q[0], -q[1], -q[2], -q[3]))

    def _flange(self, pose: Pose) -> Pose:
        placed = frames.compose(self.work_object, pose)
        return frames.compose(placed, frames.invert(self.tool))

    def follow(self, pose: Pose, near: Posture) -> Posture | None:
        """The posture on the branch of `near`, whose external axes it has; None: there is none."""
        return self.kinematics.follow(self._flange(pose), near)

    def postures(
        self, pose: Pose, near: Posture, configuration: AxisConfiguration | None = None
    ) -> list[Posture]:
        """All postures within the ranges, closest to `near` first; those of a configuration."""
        found = self.kinematics.solutions(self._flange(pose), near)
        if configuration is None:
            return found
        return [p for p in found if self.kinematics.matches(p, configuration)]

    def reaches(self, pose: Pose, near: Posture) -> bool:
        """Whether any posture reaches a pose, ranges apart."""
        return self.kinematics.reaches(self._flange(pose), near)


def _frame(placement: Placement) -> Pose:
    return placement.position, placement.orientation
