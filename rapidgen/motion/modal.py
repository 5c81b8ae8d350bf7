"""Motion settings that stay until changed or until PP to main (S4 datasys 1-motsetdata-3)."""

from dataclasses import dataclass, field
from math import inf

from rapidgen.axes.frames import IDENTITY, Pose
from rapidgen.axes.path_shapes import CircleMode
from rapidgen.motion.moves import Singularities


@dataclass(slots=True)
class ModalSettings:
    """What moves that are executed from now on obey. The fields' values are the defaults."""

    speed_override: float = 1.0
    """VelSet, share."""
    speed_limit: float = 5.0
    """VelSet, m/s of the TCP; moves with \\T ignore it."""
    acceleration: float = 1.0
    """AccSet, share."""
    ramp: float = 1.0
    """AccSet: how quickly acceleration builds up, share."""
    corner_warning: bool = True
    """CornerPathWarning: whether the log reports corners that became stop points."""
    check_linear: bool = True
    """ConfL"""
    check_joint: bool = True
    """ConfJ"""
    singularities: Singularities = Singularities.OFF
    """SingArea"""
    displacement: Pose = IDENTITY
    """Program displacement, m."""
    path_acceleration: float = inf
    """PathAccLim, m/s^2 of the TCP along its path."""
    world_acceleration: float = inf
    """WorldAccLim, m/s^2 of the TCP in all directions."""
    circle: CircleMode = CircleMode.PATH
    """CirPathMode: how the orientation turns on a circle."""
    axis_limits: dict[str, float] = field(default_factory=dict)
    """SpeedLimAxis: rad/s or m/s by axis, while the speed is limited."""
    point_limit: float = inf
    """SpeedLimCheckPoint: m/s of the TCP, while the speed is limited."""
