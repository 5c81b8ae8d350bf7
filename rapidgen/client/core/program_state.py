"""State of a traversal of a program: position, frames and findings."""

from collections.abc import Sequence
from math import isfinite, sqrt

from rapidgen.axes import frames
from rapidgen.axes.frames import Pose
from rapidgen.axes.kinematics import Posture
from rapidgen.axes.limits import LimitFault, outside
from rapidgen.client.core.frames import Frames
from rapidgen.client.core.group import Group
from rapidgen.diagnostics import Diagnostic, Severity, Span, error

_UNIT = 1e-3
"""Tolerance of a quaternion's length."""


class ProgramTraversal:
    """A traversal of a program: the position so far, and the findings."""

    def __init__(self, group: Group, start: Posture, spans: Sequence[Span] = ()) -> None:
        self.group = group
        self.spans = spans
        self.here = start
        self.index = 0
        self.singular = self.any_posture = False
        """True if singularities and other configurations are allowed."""
        self.chosen = (0, 0)
        """Numbers of the tool and of the work object."""
        self.geometry = group.geometry
        """Frames with the program's own tool and work object, once defined."""
        self.own: tuple[Pose | None, Pose | None] = (None, None)
        self.found: list[Diagnostic] = []
        self.arguments: list[float | bool | str | tuple[float, ...]] = []
        """Arguments of the called routine, as they go onto the wire."""
        self.path: list[tuple[int, Posture]] = [(0, start)]
        """Samples of the path, each with its instruction."""

    def say(
        self, code: str, message: str, help: str = "", *, severity: Severity = Severity.ERROR
    ) -> None:
        """Add a finding about the current instruction."""
        place = f"instruction {self.index}: "
        at = self.spans[self.index] if self.spans else None
        self.found.append(error(code, at, place + message, help, severity=severity))

    @property
    def frames(self) -> Frames | None:
        """Return the geometry with tool and work object; report if it is missing."""
        geometry = self.geometry
        result = geometry.frames(*self.chosen) if geometry is not None else None
        if result is None:
            self.say(
                "RG671",
                "the joints of this pose are not known",
                "connect with a configuration that has the robot's chain, its tool and its work "
                "object",
            )
        return result


def operands(pose: Pose, posture: Posture) -> tuple[float, ...]:
    return (*pose[0], *pose[1], *posture)


def unit(walk: ProgramTraversal, pose: Pose | None) -> Pose | None:
    """Return a pose with a quaternion of length 1."""
    if pose is None or not all(isfinite(value) for part in pose for value in part):
        walk.say("RG670", f"{pose} is not a pose", "finite numbers")
        return None
    size = sqrt(sum(value * value for value in pose[1]))
    if abs(size - 1) > _UNIT:
        walk.say(
            "RG670",
            f"the quaternion {pose[1]} has the length {size:.4g}",
            "unit quaternions, the scalar first (w, x, y, z)",
        )
        return None
    return pose[0], frames.normalise(pose[1])


def within(walk: ProgramTraversal, posture: Posture) -> bool:
    faults: list[LimitFault] = outside(walk.group.joints, posture)
    for fault in faults[:1]:
        walk.say("RG614", str(fault))
    return not faults
