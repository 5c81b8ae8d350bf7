"""What the axes may do under the settings of now: AccSet, PathAccLim, WorldAccLim, SpeedLimAxis."""

from math import inf
from typing import Any

from rapidgen.axes.frames import IDENTITY, Pose, Vector, compose
from rapidgen.axes.kinematics import Kinematics
from rapidgen.config.model import GroupConfig
from rapidgen.motion.modal import ModalSettings
from rapidgen.motion.moves import Posture
from rapidgen.motion.pieces import AxisLimits
from rapidgen.motion.settings import MotionSettings
from rapidgen.runtime.builtins.motion.arguments import frame
from rapidgen.runtime.values import Record


def ramp_now(settings: MotionSettings, modal: ModalSettings) -> float:
    """s in which acceleration builds up."""
    return settings.ramp_time * modal.acceleration / modal.ramp


def tool_frame(tool: Record | None) -> Pose:
    """The TCP in the flange; the flange itself without a tool."""
    data: Any = tool
    return IDENTITY if data is None else frame(data.tframe)


def limits_now(
    config: GroupConfig,
    kinematics: Kinematics | None,
    settings: MotionSettings,
    modal: ModalSettings,
    tool: Record | None,
    ramp: float,
    *,
    limited: bool,
) -> AxisLimits:
    """Limits for moves that are executed now. `limited`: those of SpeedLimAxis hold."""
    slower = modal.axis_limits if limited else {}
    world = None
    if modal.world_acceleration < inf and kinematics is not None:
        own, held = kinematics, tool_frame(tool)

        def tcp(posture: Posture) -> Vector:
            return compose(own.forward(posture), held)[0]

        world = tcp, modal.world_acceleration
    return AxisLimits(
        [min(j.speed, slower.get(j.axis, inf)) for j in config.joints],
        [j.acceleration * modal.acceleration for j in config.joints],
        settings.corner_share,
        modal.path_acceleration,
        ramp,
        world,
    )
