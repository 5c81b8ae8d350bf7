"""A configured robot in the page's words."""

from dataclasses import dataclass

from rapidgen.axes import frames
from rapidgen.axes.kinematics import Kinematics, Posture
from rapidgen.config.model import GroupConfig, Placement
from rapidgen.view.drawing import Drawing
from rapidgen.view.messages import Axis, Pose, SeenRobot


def group_of(config: GroupConfig, description: Drawing) -> SeenRobot:
    """What the page draws of a robot, and how its axes are called and bounded."""
    return SeenRobot(
        name=config.name,
        task=config.task,
        unit=config.mechanical_unit,
        urdf=description.urdf,
        flange=description.flange,
        movable=description.movable,
        axes=tuple(
            Axis(
                name=joint.name,
                axis=joint.axis,
                kind=joint.kind,
                lower=joint.lower,
                upper=joint.upper,
                speed=joint.speed,
            )
            for joint in config.joints
        ),
        has_geometry=bool(config.chain),
    )


def pose_of(frame: frames.Pose) -> Pose:
    """A frame as the page has it."""
    return Pose(position=frame[0], orientation=frame[1])


@dataclass(frozen=True, slots=True)
class Carried:
    """Tool and work object: in the flange what the robot holds, in the world what stands."""

    tool: frames.Pose
    held: bool
    object: frames.Pose

    @classmethod
    def configured(cls, config: GroupConfig) -> "Carried":
        """Those of the configuration."""
        placed = config.work_object
        whole = frames.compose(_frame(placed.user_frame), _frame(placed.object_frame))
        return cls(_frame(config.tool.frame), config.tool.held, whole)

    def tcp(self, kinematics: Kinematics | None, posture: Posture) -> frames.Pose | None:
        """The TCP in the world (a stationary one stands); None: there is no geometry."""
        if not self.held:
            return self.tool
        return frames.compose(kinematics.forward(posture), self.tool) if kinematics else None


def _frame(placement: Placement) -> frames.Pose:
    return placement.position, placement.orientation
