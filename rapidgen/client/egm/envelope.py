"""Limits that a client keeps on its own, and the checks of targets before they are sent.

They are apart from the limits that the controller enforces (`\\MaxPosDeviation` and
`\\MaxSpeedDeviation`), and hold for whatever a program sends. All values are rad and m, rad/s and
m/s, rad/s^2 and m/s^2; joints are in the order of the URDF.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import inf, isfinite, sqrt
from typing import TypeAlias

from rapidgen.axes import frames
from rapidgen.axes.frames import Vector
from rapidgen.client.errors import TargetRejected
from rapidgen.client.pose import Pose
from rapidgen.config.model import GroupConfig

Joints: TypeAlias = tuple[float, ...]
_TOLERANCE = 1e-9
_ANYWHERE: Vector = (inf, inf, inf)


@dataclass(frozen=True, slots=True)
class TcpLimits:
    """Limits of a TCP, for guidance by poses.

    Attributes:
        lower, upper: Positions, m, in the frame in which the controller reports the TCP.
        speed, rotation: Highest speeds, m/s and rad/s.
        acceleration, rotation_acceleration: m/s^2 and rad/s^2, also of a stop.
        step, turn: Largest difference between a target and the one before, m and rad.
    """

    lower: Vector = (-inf, -inf, -inf)
    upper: Vector = _ANYWHERE
    speed: float = 0.25
    acceleration: float = 1.0
    rotation: float = 0.5
    rotation_acceleration: float = 2.0
    step: float = 0.05
    turn: float = 0.1

    def check(self, target: frames.Pose, before: frames.Pose) -> Pose:
        """Return a target with a unit quaternion. Raises TargetRejected."""
        place, orientation = target
        if len(place) != 3 or len(orientation) != 4:
            raise _rejected("a pose is ((x, y, z), (w, x, y, z))")
        if not all(map(isfinite, (*place, *orientation))):
            raise _rejected(f"pose {target}")
        x, y, z = map(float, place)
        for axis, value, low, high in zip("xyz", (x, y, z), self.lower, self.upper, strict=True):
            if not low <= value <= high:
                raise _rejected(f"{axis} = {value:.4f}, allowed are {low:.4f} to {high:.4f}")
        size = sqrt(sum(value * value for value in orientation))
        if not 0.99 <= size <= 1.01:
            raise _rejected(f"the quaternion has length {size:.3f}")
        a, b, c, d = (float(value) for value in orientation)
        result = Pose((x, y, z), frames.normalise((a, b, c, d)))
        step = frames.distance(result[0], before[0])
        if step > self.step:
            raise _rejected(f"the TCP would step by {step:.4f}, allowed is {self.step:g}")
        turn = frames.angle_between(before[1], result[1])
        if turn > self.turn:
            raise _rejected(f"the TCP would turn by {turn:.4f}, allowed is {self.turn:g}")
        return result

    def check_speeds(self, speeds: Sequence[float]) -> Joints:
        """Return (6,) speeds of the TCP as a tuple. Raises TargetRejected."""
        values = tuple(map(float, speeds))
        if len(values) != 6 or not all(map(isfinite, values)):
            raise _rejected("speeds of a TCP are vx, vy, vz, wx, wy and wz")
        for name, limit, three in (
            ("speed", self.speed, values[:3]),
            ("rotation", self.rotation, values[3:]),
        ):
            size = sqrt(sum(value * value for value in three))
            if size > limit * (1 + _TOLERANCE):
                raise _rejected(f"{name} = {size:.4f}, allowed is {limit:.4f}")
        return values


@dataclass(frozen=True, slots=True)
class Envelope:
    """Limits of one robot.

    Attributes:
        names: Joints.
        lower, upper: Positions.
        speed: Highest speeds.
        acceleration: Highest accelerations, also of a stop.
        step: Largest difference between a target and the one before, or the robot's position.
        tcp: Limits for guidance by poses.
    """

    names: tuple[str, ...]
    lower: Joints
    upper: Joints
    speed: Joints
    acceleration: Joints
    step: float = inf
    tcp: TcpLimits = field(default_factory=TcpLimits)

    @classmethod
    def of(
        cls,
        group: GroupConfig,
        fraction: float = 0.25,
        step: float = 0.1,
        tcp: TcpLimits | None = None,
    ) -> "Envelope":
        """Return the limits of a configuration, speeds and accelerations times a fraction.

        ValueError: the fraction is not in (0, 1], or the step is not positive.
        """
        if not 0 < fraction <= 1:
            raise ValueError(f"fraction={fraction!r} is not above 0 and at most 1")
        if not step > 0:
            raise ValueError(f"step={step!r} is not positive")
        joints = group.joints
        low_high = [
            _urdf_range(joint.lower, joint.upper, joint.sign, joint.offset) for joint in joints
        ]
        return cls(
            tuple(joint.name for joint in joints),
            tuple(low for low, _ in low_high),
            tuple(high for _, high in low_high),
            tuple(joint.speed * fraction for joint in joints),
            tuple(joint.acceleration * fraction for joint in joints),
            step,
            tcp or TcpLimits(),
        )

    def check(self, target: Sequence[float], before: Joints) -> Joints:
        """Return a target as a tuple. Raises TargetRejected."""
        values = self._of_joints(target)
        for i, (value, last) in enumerate(zip(values, before, strict=True)):
            name = self.names[i]
            if not self.lower[i] <= value <= self.upper[i]:
                low, high = self.lower[i], self.upper[i]
                raise _rejected(f"{name} = {value:.4f}, allowed are {low:.4f} to {high:.4f}")
            if abs(value - last) > self.step:
                raise _rejected(
                    f"{name} would step by {value - last:.4f}, allowed is {self.step:g}"
                )
        return values

    def check_speeds(self, speeds: Sequence[float]) -> Joints:
        """Return speeds as a tuple. Raises TargetRejected."""
        values = self._of_joints(speeds)
        for name, value, top in zip(self.names, values, self.speed, strict=True):
            if abs(value) > top * (1 + _TOLERANCE):
                raise _rejected(f"{name} would have speed {value:.4f}, allowed is {top:.4f}")
        return values

    def _of_joints(self, given: Sequence[float]) -> Joints:
        values = tuple(map(float, given))
        if len(values) != len(self.names):
            raise _rejected(f"{len(values)} values for {len(self.names)} joints")
        for name, value in zip(self.names, values, strict=True):
            if not isfinite(value):
                raise _rejected(f"{name} = {value}")
        return values


def _urdf_range(lower: float, upper: float, sign: int, offset: float) -> tuple[float, float]:
    """Return a range of controller values as values of the URDF joint."""
    low, high = sorted((sign * (lower - offset), sign * (upper - offset)))
    return low, high


def _rejected(text: str) -> TargetRejected:
    return TargetRejected.because(
        "RG680", f"target not sent: {text}", "send targets close to the position of the robot"
    )
