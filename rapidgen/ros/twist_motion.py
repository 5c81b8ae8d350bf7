"""Joint speeds for a speed of the TCP.

The Jacobian is that of the chain at the joints that were sent last. All joints are slowed down
alike, so the TCP keeps its direction at a joint's top speed, close to the end of a joint's range
and close to a singularity, and changes of speed do not bend its path.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rapidgen.axes import frames
from rapidgen.axes.chain import Step, steps_of
from rapidgen.axes.frames import Pose, Vector
from rapidgen.client.egm import Envelope
from rapidgen.client.trajectory import Array
from rapidgen.config.model import GroupConfig

_SINGULAR = 1e-6
"""Smallest singular value of a Jacobian (rad, m) whose inverse has a meaning."""
_EDGE = 1e-4
"""rad or m that stay free between a joint and the end of its range."""
_LATE = 0.02
"""s for which a joint goes on before a new speed is executed."""
SLOW = 0.5
"""Share of a requested speed below which the motion counts as slowed down."""


@dataclass(frozen=True, slots=True)
class JointSpeeds:
    """Speeds of the joints, rad/s or m/s, and the share of the requested speed that they give."""

    speeds: tuple[float, ...]
    share: float
    limit: str = ""
    """What slows it down: a joint, or a singularity."""


@dataclass(frozen=True)
class TwistMotion:
    """The TCP of one motion group within an envelope."""

    group: GroupConfig
    envelope: Envelope

    @cached_property
    def _steps(self) -> tuple[Step, ...]:
        return steps_of(self.group, self.group.chain)

    @cached_property
    def _tool(self) -> Pose:
        frame = self.group.tool.frame
        return frame.position, frame.orientation

    @property
    def is_possible(self) -> bool:
        """True if the group's geometry is known and the robot holds the tool."""
        return bool(self.group.chain) and self.group.tool.held

    def tcp(self, joints: Sequence[float]) -> Pose:
        """Return the TCP for URDF joint values, in the frame of the base."""
        return self._walk(joints)[0]

    def speeds(
        self,
        twist: Sequence[float],
        joints: Sequence[float],
        before: Sequence[float],
        time: float,
        axes: str = "base",
    ) -> JointSpeeds:
        """Return the joint speeds of the next `time` s.

        Args:
            twist: (6,) m/s along and rad/s about x, y and z, of the TCP.
            joints: (k,) URDF joint values.
            before: (k,) their speeds.
            time: s
            axes: Whose x, y and z: of the `base`, the `flange` or the `tool`.
        """
        tcp, flange, lines = self._walk(joints)
        wanted = _turned(twist, {"flange": flange, "tool": tcp}.get(axes))
        jacobian = self._jacobian(tcp, lines)
        left, values, right = np.linalg.svd(jacobian, full_matrices=False)
        if values[-1] < _SINGULAR:
            # Speeds along the lost direction would be infinite; others are left.
            parts = left.T @ wanted
            if abs(parts[values < _SINGULAR]).max() > _SINGULAR:
                return self._ramped(np.zeros(len(joints)), before, time, 0.0, "a singularity")
            values = np.maximum(values, _SINGULAR)
        rates = right.T @ ((left.T @ wanted) / values)
        share, limit = self._share(rates, joints, before)
        return self._ramped(rates * share, before, time, share, limit)

    def _share(
        self, rates: Array, joints: Sequence[float], before: Sequence[float]
    ) -> tuple[float, str]:
        """Return the share of speeds that every joint may have, and the slowest joint."""
        share, limit = 1.0, ""
        for i, (rate, value) in enumerate(zip(rates, joints, strict=True)):
            if rate == 0:
                continue
            end = self.envelope.upper[i] if rate > 0 else self.envelope.lower[i]
            free = abs(end - value) if (end - value) * rate > 0 else 0.0
            free = max(free - _EDGE - abs(before[i]) * _LATE, 0.0)
            stops = math.sqrt(2 * self.envelope.acceleration[i] * free)
            allowed = min(self.envelope.speed[i], stops) / abs(rate)
            if allowed < share:
                share, limit = allowed, self.envelope.names[i]
        return share, limit

    def _ramped(
        self, rates: Array, before: Sequence[float], time: float, share: float, limit: str
    ) -> JointSpeeds:
        """Limit the change of all speeds alike."""
        change = rates - np.array(before)
        most = np.array(self.envelope.acceleration) * time
        part = min(1.0, float((most / np.maximum(np.abs(change), 1e-12)).min()))
        speeds = np.array(before) + part * change
        return JointSpeeds(tuple(float(v) for v in speeds), share, limit)

    def _jacobian(
        self, tcp: Pose, lines: Sequence[tuple[int, float, Vector, Vector, bool]]
    ) -> Array:
        """Return (6, k): speeds of the TCP for unit speeds of the joints."""
        result = np.zeros((6, len(self.group.joints)))
        x, y, z = tcp[0]
        for joint, factor, origin, (a, b, c), slides in lines:
            if slides:
                result[:3, joint] += (factor * a, factor * b, factor * c)
                continue
            # numpy.cross costs more than all the rest of a cycle.
            dx, dy, dz = x - origin[0], y - origin[1], z - origin[2]
            linear = (b * dz - c * dy, c * dx - a * dz, a * dy - b * dx)
            result[:, joint] += [factor * value for value in (*linear, a, b, c)]
        return result

    def _walk(
        self, joints: Sequence[float]
    ) -> tuple[Pose, Pose, list[tuple[int, float, Vector, Vector, bool]]]:
        """Return TCP, flange, and each joint's axis: factor, origin, direction, sliding."""
        pose: Pose = frames.IDENTITY
        lines: list[tuple[int, float, Vector, Vector, bool]] = []
        for step in self._steps:
            pose = frames.compose(pose, step.fixed)
            axis = frames.rotate(pose[1], step.axis)
            moved = [(step.joint, 1.0)] if step.joint >= 0 else step.follows
            lines += [(joint, factor, pose[0], axis, step.prismatic) for joint, factor in moved]
            amount = sum(joints[joint] * factor for joint, factor in moved)
            if step.prismatic:
                pose = frames.compose(pose, (frames.scale(step.axis, amount), frames.UNIT))
            elif moved:
                pose = frames.compose(pose, ((0.0, 0.0, 0.0), frames.about(step.axis, amount)))
        return frames.compose(pose, self._tool), pose, lines


def _turned(twist: Sequence[float], pose: Pose | None) -> Array:
    """Return a twist in the axes of the base."""
    linear, angular = (twist[0], twist[1], twist[2]), (twist[3], twist[4], twist[5])
    if pose is not None:
        linear, angular = frames.rotate(pose[1], linear), frames.rotate(pose[1], angular)
    return np.array((*linear, *angular), dtype=np.float64)
