"""A configured robot in the page's words."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import hypot

from rapidgen.axes import frames
from rapidgen.axes.kinematics import Kinematics, Posture
from rapidgen.config.model import GroupConfig, Placement
from rapidgen.view.drawing import Drawing
from rapidgen.view.messages import Axis, Pose, SeenRobot

_SAME = 0.05
"""m between two feet that are one place."""
_ROOM = 1.4
"""Of an arm's length, between two robots."""


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


def side_by_side(configs: Sequence[GroupConfig], seen: Sequence[SeenRobot]) -> Iterator[SeenRobot]:
    """The robots, those apart that would stand in one another: nothing tells where they are."""
    standing: list[frames.Vector] = []
    y = 0.0
    for config, robot in zip(configs, seen, strict=True):
        foot = config.chain[0].xyz if config.chain else (0.0, 0.0, 0.0)
        if any(hypot(foot[0] - x, foot[1] - y) < _SAME for x, y, _ in standing):
            y += _ROOM * sum(hypot(*step.xyz) for step in config.chain)
            robot = robot.model_copy(
                update={"base": Pose(position=(0.0, -y, 0.0), orientation=frames.UNIT)}
            )
        standing.append(foot)
        yield robot


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
