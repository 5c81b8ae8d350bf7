"""Lines and circles of the TCP in the object's frame, over a share from 0 to 1."""

from dataclasses import dataclass
from math import atan2, pi

from rapidgen.axes import frames
from rapidgen.axes.frames import Pose, Quaternion, Vector

LARGEST_ARC = 240 * pi / 180
"""rad of one MoveC (3HAC16581-1)."""


@dataclass(frozen=True, slots=True)
class Line:
    """Straight, turning evenly about one axis the short way. The share may leave 0..1."""

    start: Pose
    end: Pose

    @property
    def length(self) -> float:
        """m"""
        return frames.distance(self.start[0], self.end[0])

    @property
    def angle(self) -> float:
        """rad"""
        return frames.angle_between(self.start[1], self.end[1])

    def position(self, share: float) -> Vector:
        """m"""
        (ax, ay, az), (bx, by, bz) = self.start[0], self.end[0]
        return ax + (bx - ax) * share, ay + (by - ay) * share, az + (bz - az) * share

    def tangent(self, _share: float) -> Vector:
        """m per share"""
        return frames.subtract(self.end[0], self.start[0])

    def orientation(self, share: float) -> Quaternion:
        """Unit quaternion."""
        return frames.slerp(self.start[1], self.end[1], share)


@dataclass(frozen=True, slots=True)
class Arc:
    """Part of a circle; the orientation turns evenly relative to the path.

    Same orientation relative to the path at both ends keeps it so all along (S4 datasys
    2-MoveC-3): the turn of the path itself is added to an even turn of what is left.
    """

    start: Pose
    end: Pose
    centre: Vector
    normal: Vector
    sweep: float
    """rad, positive about `normal`"""
    with_path: bool = True
    """False: the orientation turns as on a line (CirPathMode \\ObjectFrame)."""

    @property
    def length(self) -> float:
        """m"""
        return frames.distance(self.start[0], self.centre) * self.sweep

    @property
    def angle(self) -> float:
        """rad that the tool turns in all, at most."""
        if not self.with_path:
            return frames.angle_between(self.start[1], self.end[1])
        return self.sweep + frames.angle_between(self.start[1], self._unswept())

    def _unswept(self) -> Quaternion:
        return frames.multiply(frames.about(self.normal, -self.sweep), self.end[1])

    def position(self, share: float) -> Vector:
        """m"""
        arm = frames.subtract(self.start[0], self.centre)
        return frames.add(
            self.centre, frames.rotate(frames.about(self.normal, self.sweep * share), arm)
        )

    def tangent(self, share: float) -> Vector:
        """m per share"""
        arm = frames.subtract(self.position(share), self.centre)
        return frames.scale(frames.cross(self.normal, arm), self.sweep)

    def orientation(self, share: float) -> Quaternion:
        """Unit quaternion."""
        if not self.with_path:
            return frames.slerp(self.start[1], self.end[1], share)
        own = frames.slerp(self.start[1], self._unswept(), share)
        return frames.multiply(frames.about(self.normal, self.sweep * share), own)


def arc_through(start: Pose, via: Vector, end: Pose, *, with_path: bool = True) -> Arc | None:
    """The circle through three points; None: they do not make one.

    Points closer than 0.1 mm, or in one line, are no circle.
    """
    a, b, c = start[0], via, end[0]
    to_via, to_end = frames.subtract(b, a), frames.subtract(c, a)
    if min(frames.norm(to_via), frames.norm(to_end), frames.distance(b, c)) < 1e-4:
        return None
    normal = frames.cross(to_via, to_end)
    area = frames.dot(normal, normal)
    if area < 1e-6 * frames.dot(to_via, to_via) * frames.dot(to_end, to_end):
        return None
    # Circumcentre from a.
    first = frames.scale(frames.cross(normal, to_via), frames.dot(to_end, to_end))
    second = frames.scale(frames.cross(to_end, normal), frames.dot(to_via, to_via))
    centre = frames.add(a, frames.scale(frames.add(first, second), 1 / (2 * area)))
    normal = frames.unit(normal)
    arm, last = frames.subtract(a, centre), frames.subtract(c, centre)
    sweep = atan2(frames.dot(frames.cross(arm, last), normal), frames.dot(arm, last))
    if sweep <= 0:
        sweep += 2 * pi
    return Arc(start, end, centre, normal, sweep, with_path)
