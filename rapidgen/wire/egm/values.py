"""Values of the messages between a controller and its EGM partner.

Lengths are mm, angles degrees, times s, as on the wire.
"""

from dataclasses import dataclass
from typing import Final, Literal, TypeAlias

MAX_JOINTS: Final = 6
"""Of EgmJoints; a seventh axis is the first external one."""
MAX_NUMBERS: Final = 40
"""EGM_MAX_RAPID_DNUM."""
MAX_BYTES: Final = 65_507
"""Of a UDP datagram."""
Values: TypeAlias = tuple[float, ...]
Mode: TypeAlias = Literal["undefined", "error", "stopped", "running"]


class EgmMessageError(ValueError):
    """A datagram that is not the expected message; the text is the reason."""


@dataclass(frozen=True, slots=True)
class CartesianPose:
    """A position in mm and a unit quaternion, scalar first."""

    position: tuple[float, float, float]
    orientation: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class AxisPositions:
    """Positions of the robot: measured, or as planned."""

    joints: Values
    """Six at most, degrees."""
    external: Values = ()
    """Degrees or mm; first the third axis of a robot with seven."""
    pose: CartesianPose | None = None
    time: float | None = None
    """s since the start of the controller; None: a release before 6.07."""


@dataclass(frozen=True, slots=True)
class RapidData:
    """Data that RAPID exchanges in a session: a digital value and numbers."""

    digital: bool | None = None
    numbers: Values = ()


@dataclass(frozen=True, slots=True)
class RobotMessage:
    """EgmRobot: the controller to its partner, one in each cycle."""

    sequence: int
    milliseconds: int
    """Of the controller's clock."""
    measured: AxisPositions
    planned: AxisPositions
    motors_on: bool
    state: Mode
    """Of the guidance: running between EGMRunJoint or EGMRunPose and its end."""
    program_runs: bool
    converged: bool
    utilization: float | None = None
    """Per cent; above 100 the controller shortens motions."""
    data: RapidData | None = None
    move_index: int | None = None
    collision: bool | None = None


@dataclass(frozen=True, slots=True)
class SensorMessage:
    """EgmSensor: the partner to the controller. None: not in the message."""

    sequence: int | None = None
    milliseconds: int | None = None
    joints: Values | None = None
    external: Values | None = None
    pose: CartesianPose | None = None
    joint_speeds: Values | None = None
    """Degrees/s."""
    external_speeds: Values | None = None
    cartesian_speeds: Values | None = None
    """mm/s along and degrees/s about x, y and z."""
    data: RapidData | None = None
