"""Motion settings that stay until changed or until PP to main (S4 datasys 1-motsetdata-3)."""

from dataclasses import dataclass, field
from math import inf

from rapidgen.axes.frames import IDENTITY, Pose


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
    check_linear: bool = True
    """ConfL"""
    check_joint: bool = True
    """ConfJ"""
    wrist: bool = False
    """SingArea \\Wrist"""
    displacement: Pose = IDENTITY
    """Program displacement, m."""
    external_offset: tuple[float, ...] = (0.0,) * 6
    """Offsets of eax_a to eax_f in RAPID units."""
    path_acceleration: float = inf
    """PathAccLim, m/s^2 of the TCP along its path."""
    circle_in_object: bool = False
    """CirPathMode \\ObjectFrame: orientation on a circle turns relative to the object."""
    extra: dict[str, object] = field(default_factory=dict)
    """Settings that change no motion here: kept so that a program can set them."""
