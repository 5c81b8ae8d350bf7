"""TCP poses in a work object and the postures that reach them. Sans-IO.

Postures are controller axis values in wire order, rad and m; poses are of the TCP in the object's
frame, m.
"""

from dataclasses import dataclass, replace

from rapidgen.axes import frames
from rapidgen.axes.frames import Pose
from rapidgen.axes.kinematics import AxisConfiguration, Kinematics, Posture
from rapidgen.axes.reach_errors import unreached
from rapidgen.config.model import GroupConfig, Placement, Tool, WorkObject


@dataclass(frozen=True, slots=True)
class Frames:
    """A robot's geometry with a tool and a work object."""

    kinematics: Kinematics
    tool: Pose
    work_object: Pose

    def pose(self, posture: Posture) -> Pose:
        """Return the TCP pose; the quaternion's scalar is not negative."""
        flange = self.kinematics.forward(posture)
        place, q = frames.compose(
            frames.compose(frames.invert(self.work_object), flange), self.tool
        )
        return (place, q) if q[0] >= 0 else (place, (-q[0], -q[1], -q[2], -q[3]))

    def _flange(self, pose: Pose) -> Pose:
        placed = frames.compose(self.work_object, pose)
        return frames.compose(placed, frames.invert(self.tool))

    def follow(self, pose: Pose, near: Posture) -> Posture | None:
        """Return the posture on the branch of `near`; None if there is none.

        External axes are those of `near`.
        """
        return self.kinematics.follow(self._flange(pose), near)

    def postures(
        self, pose: Pose, near: Posture, configuration: AxisConfiguration | None = None
    ) -> list[Posture]:
        """Return all postures within the ranges, closest to `near` first.

        A configuration selects among them.
        """
        result = self.kinematics.solutions(self._flange(pose), near)
        if configuration is None:
            return result
        return [p for p in result if self.kinematics.matches(p, configuration)]

    def why_not(self, pose: Pose, near: Posture) -> str:
        """Explain in one sentence why no posture reaches a pose."""
        return unreached(self.kinematics, self._flange(pose), near)[1]


@dataclass(frozen=True, slots=True)
class GroupFrames:
    """Tools and work objects of a group by name, its own first."""

    kinematics: Kinematics
    tools: tuple[tuple[str, Pose | None], ...]
    work_objects: tuple[tuple[str, Pose | None], ...]

    @classmethod
    def of(cls, group: GroupConfig) -> "GroupFrames | None":
        """Return the frames of a group; None without a kinematic model."""
        kinematics = Kinematics.of(group)
        if kinematics is None:
            return None
        tools = tuple((tool.name, _tool(tool)) for tool in (group.tool, *group.tools))
        objects = (group.work_object, *group.work_objects)
        return cls(kinematics, tools, tuple((wobj.name, _object(wobj)) for wobj in objects))

    def owning(self, tool: Pose | None = None, work_object: Pose | None = None) -> "GroupFrames":
        """Return a copy with the program's own tool or work object added."""
        return replace(
            self,
            tools=self.tools if tool is None else (*self.tools, ("", tool)),
            work_objects=self.work_objects
            if work_object is None
            else (*self.work_objects, ("", work_object)),
        )

    def frames(self, tool: int = 0, work_object: int = 0) -> Frames | None:
        """Return the frames of a tool and a work object.

        None if one of them is unknown: declared elsewhere, or held on the wrong side.
        """
        held, placed = self.tools[tool][1], self.work_objects[work_object][1]
        if held is None or placed is None:
            return None
        return Frames(self.kinematics, held, placed)


def _tool(tool: Tool) -> Pose | None:
    return None if tool.elsewhere or not tool.held else _frame(tool.frame)


def _object(wobj: WorkObject) -> Pose | None:
    if wobj.elsewhere or wobj.held:
        return None
    return frames.compose(_frame(wobj.user_frame), _frame(wobj.object_frame))


def _frame(placement: Placement) -> Pose:
    return placement.position, placement.orientation
