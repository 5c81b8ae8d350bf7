"""Lines and circles of the TCP in the object's frame.

The path parameter is a share from 0 to 1.
"""

from dataclasses import dataclass
from enum import Enum
from itertools import pairwise
from math import atan2, pi, radians, sin

from rapidgen.axes import frames
from rapidgen.axes.frames import ORIGIN, Pose, Quaternion, Vector

LARGEST_ARC = radians(240)
SMALLEST_ANGLE = radians(1)
"""rad: minimum of one MoveC, and between its other two points seen from the first (3HAC16581-1)."""


class CircleMode(Enum):
    """CirPathMode: how the orientation turns on a circle."""

    PATH = "evenly relative to the path"
    OBJECT = "evenly relative to the object, as on a line"
    POINT = "relative to the path, through the orientation of the circle point"


@dataclass(frozen=True, slots=True)
class Line:
    """Straight line with a constant rotation about one axis, the short way.

    The share may be outside 0 to 1.
    """

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

    def position(self, fraction: float) -> Vector:
        """m"""
        (ax, ay, az), (bx, by, bz) = self.start[0], self.end[0]
        return ax + (bx - ax) * fraction, ay + (by - ay) * fraction, az + (bz - az) * fraction

    def tangent(self, _share: float) -> Vector:
        """m per share"""
        return frames.subtract(self.end[0], self.start[0])

    def orientation(self, fraction: float) -> Quaternion:
        """Unit quaternion."""
        return frames.slerp(self.start[1], self.end[1], fraction)


@dataclass(frozen=True, slots=True)
class Arc:
    """Part of a circle; the orientation turns evenly relative to the path.

    Equal orientation relative to the path at both ends keeps it so along the path (S4 datasys
    2-MoveC-3): the turn of the path itself and an even turn in the tool's own frame.
    """

    start: Pose
    end: Pose
    centre: Vector
    normal: Vector
    sweep: float
    """rad, positive about `normal`"""
    swept: float
    """rad of the path's turn that the tool follows: all of it, or none."""
    turn: Vector
    """The tool's own turn, in the frame of `start`: about this axis, rad."""
    bend: Vector = ORIGIN
    """Additional turn per share squared, so that it passes the circle point's orientation."""

    @property
    def length(self) -> float:
        """m"""
        return frames.distance(self.start[0], self.centre) * self.sweep

    @property
    def angle(self) -> float:
        """Total rad of the tool's turn."""
        rows = [self.orientation(k / 8) for k in range(9)]
        return sum(frames.angle_between(a, b) for a, b in pairwise(rows))

    def position(self, fraction: float) -> Vector:
        """m"""
        arm = frames.subtract(self.start[0], self.centre)
        return frames.add(
            self.centre, frames.rotate(frames.about(self.normal, self.sweep * fraction), arm)
        )

    def tangent(self, fraction: float) -> Vector:
        """m per share"""
        arm = frames.subtract(self.position(fraction), self.centre)
        return frames.scale(frames.cross(self.normal, arm), self.sweep)

    def orientation(self, fraction: float) -> Quaternion:
        """Unit quaternion."""
        turned = frames.add(
            frames.scale(self.turn, fraction), frames.scale(self.bend, fraction * fraction)
        )
        own = frames.multiply(self.start[1], _about(turned))
        return frames.multiply(frames.about(self.normal, self.swept * fraction), own)


def arc_through(
    start: Pose,
    via: Pose,
    end: Pose,
    mode: CircleMode = CircleMode.PATH,
    smallest: float = SMALLEST_ANGLE,
) -> Arc | None:
    """Return the circle through three points, or None.

    Points closer than 0.1 mm do not make a circle, nor do two that are less than 1 degree apart
    from the first one (ABB's limits of MoveC, as RobotComponents' path generator names them). The
    orientation at `via` only decides between the short and the long way of the tool's own turn (S4
    datasys 2-MoveC-3), unless the mode requires it.
    """
    a, b, c = start[0], via[0], end[0]
    to_via, to_end = frames.subtract(b, a), frames.subtract(c, a)
    if min(frames.norm(to_via), frames.norm(to_end), frames.distance(b, c)) < 1e-4:
        return None
    normal = frames.cross(to_via, to_end)
    area = frames.dot(normal, normal)
    seen = frames.dot(to_via, to_via) * frames.dot(to_end, to_end)
    if area < sin(smallest) ** 2 * seen:
        return None
    # Circumcentre from a.
    first = frames.scale(frames.cross(normal, to_via), frames.dot(to_end, to_end))
    second = frames.scale(frames.cross(to_end, normal), frames.dot(to_via, to_via))
    centre = frames.add(a, frames.scale(frames.add(first, second), 1 / (2 * area)))
    normal = frames.unit(normal)
    sweep = _turned(frames.subtract(a, centre), frames.subtract(c, centre), normal)
    fraction = _turned(frames.subtract(a, centre), frames.subtract(b, centre), normal) / sweep
    swept = 0.0 if mode is CircleMode.OBJECT else sweep

    def own(orientation: Quaternion, at: float) -> Vector:
        """Return the tool's own turn at a share, as axis times angle."""
        back = frames.multiply(frames.about(normal, -swept * at), orientation)
        axis, angle = frames.to_axis(frames.multiply(frames.conjugate(start[1]), back))
        return frames.scale(axis, angle)

    turn = own(end[1], 1.0)
    if mode is CircleMode.OBJECT:
        return Arc(start, end, centre, normal, sweep, swept, turn)
    angle = frames.norm(turn)
    long = frames.scale(turn, 1 - 2 * pi / angle) if angle > 1e-9 else turn
    ways = [Arc(start, end, centre, normal, sweep, swept, path) for path in (turn, long)]
    best = min(ways, key=lambda path: frames.angle_between(path.orientation(fraction), via[1]))
    if mode is CircleMode.PATH:
        return best
    # turn * s + bend * s^2 is the turn of the circle point at `fraction`, and that of the end at 1.
    off = frames.subtract(own(via[1], fraction), frames.scale(best.turn, fraction))
    bend = frames.scale(off, 1 / (fraction * fraction - fraction))
    turn = frames.subtract(best.turn, bend)
    return Arc(start, end, centre, normal, sweep, swept, turn, bend)


def _about(turn: Vector) -> Quaternion:
    angle = frames.norm(turn)
    return frames.about(frames.scale(turn, 1 / angle), angle) if angle > 1e-12 else frames.UNIT


def _turned(first: Vector, last: Vector, normal: Vector) -> float:
    """Return rad from one arm to another about a normal, 0 to 2 pi."""
    angle = atan2(frames.dot(frames.cross(first, last), normal), frames.dot(first, last))
    return angle if angle > 0 else angle + 2 * pi
