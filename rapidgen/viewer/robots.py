"""A configured robot as messages of the page."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import hypot

from rapidgen.axes import frames
from rapidgen.axes.chain import along, steps_of
from rapidgen.axes.kinematics import Kinematics, Posture
from rapidgen.config.model import GroupConfig, Placement
from rapidgen.motion.accelerations import duration_note
from rapidgen.viewer.messages import Axis, Pose, SeenRobot
from rapidgen.viewer.primitive_urdf import Drawing

_SAME = 0.05
"""m between two feet that count as the same place."""
_SPACING = 1.4
"""Distance between two robots, as a share of an arm's length."""


def group_of(config: GroupConfig, description: Drawing) -> SeenRobot:
    """Return the page's description of a robot, its axes and limits."""
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
        durations=duration_note(config),
        base=pose_of(description.base or frames.IDENTITY),
    )


def side_by_side(
    configs: Sequence[GroupConfig], drawings: Sequence[Drawing]
) -> Iterator[SeenRobot]:
    """Return robots of unknown pose side by side if they would overlap."""
    standing: list[frames.Vector] = []
    y = 0.0
    for config, drawing in zip(configs, drawings, strict=True):
        robot = group_of(config, drawing)
        foot = frames.transform(drawing.base or frames.IDENTITY, _foot(config))
        if drawing.base is None and any(
            hypot(foot[0] - x, foot[1] - y) < _SAME for x, y, _ in standing
        ):
            y += _SPACING * sum(hypot(*step.xyz) for step in config.chain)
            robot = robot.model_copy(
                update={"base": Pose(position=(0.0, -y, 0.0), orientation=frames.UNIT)}
            )
        standing.append(foot)
        yield robot


def _foot(config: GroupConfig) -> frames.Vector:
    """Position of the first axis."""
    steps = steps_of(config, config.chain)
    first = next((i for i, step in enumerate(steps) if step.joint >= 0), -1)
    return along(steps[: first + 1], (0.0,) * len(config.joints))[0]


def pose_of(frame: frames.Pose) -> Pose:
    """Return a frame as a message."""
    return Pose(position=frame[0], orientation=frame[1])


@dataclass(frozen=True, slots=True)
class ToolAndWorkObject:
    """Tool and work object.

    A held one is in the flange, a stationary one in the world.
    """

    tool: frames.Pose
    held: bool
    object: frames.Pose

    @classmethod
    def configured(cls, config: GroupConfig) -> "ToolAndWorkObject":
        """Return tools and work objects of the configuration."""
        placed = config.work_object
        complete = frames.compose(_frame(placed.user_frame), _frame(placed.object_frame))
        return cls(_frame(config.tool.frame), config.tool.held, complete)

    def tcp(self, kinematics: Kinematics | None, posture: Posture) -> frames.Pose | None:
        """Return the TCP in the world; None if there is no geometry.

        A stationary tool has a fixed one.
        """
        if not self.held:
            return self.tool
        return frames.compose(kinematics.forward(posture), self.tool) if kinematics else None


def _frame(placement: Placement) -> frames.Pose:
    return placement.position, placement.orientation
