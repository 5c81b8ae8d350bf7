"""Closed-form kinematics of arms with four axes: palletisers and SCARAs.

Axis 1 points up. A palletiser's axes 2 and 3 place the wrist in a plane, rods keep the flange
level, its last axis turns it about the vertical. A SCARA's axes 1 and 2 place it in the horizontal,
axis 3 slides and axis 4 turns about the vertical. Values are URDF joint values, axis by axis.

Rules of the inverse:

- The height of the flange and its distance from axis 1 give a triangle of two links, whose third
  side is known. The law of cosines gives the elbow angle.
- Each sign of the elbow is a branch. A palletiser also reaches behind itself: its wrist is on the
  other side of axis 1. It has four branches, a SCARA two.
- The last axis takes the rotation about the vertical that is left. A pose whose flange is not level
  has no solution.
- `solve` returns values within +-pi. The caller adds full turns and checks ranges.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import acos, atan2, cos, hypot, pi, sin, sqrt
from typing import TypeAlias

from rapidgen.axes.frames import Pose, Quaternion, Vector, conjugate, multiply

Four: TypeAlias = tuple[float, float, float, float]
Branch: TypeAlias = tuple[bool, bool]
"""(wrist on the rear side of axis 1, elbow turned over)"""
BRANCHES: tuple[Branch, ...] = tuple((a, b) for a in (False, True) for b in (False, True))
_LEVEL = 1e-6


@dataclass(frozen=True, slots=True)
class Palletiser:
    """Geometry at zero, seen from axis 1: plane x, z.

    Signs are those of the four joints.
    """

    shoulder: tuple[float, float]
    upper: tuple[float, float]
    """Length and elevation (rad) of the link from axis 2 to axis 3."""
    fore: tuple[float, float]
    """The same from axis 3 to the wrist."""
    hand: Vector
    """From the wrist to the flange, always level."""
    turn: Quaternion
    """Orientation of the flange."""
    signs: tuple[int, int, int, int]

    def branch(self, values: Sequence[float]) -> Branch:
        """Return the branch of a posture, one of four."""
        a2, a3 = self.signs[1] * values[1], self.signs[2] * values[2]
        (length2, rise2), (length3, rise3) = self.upper, self.fore
        along = self.shoulder[0] + length2 * cos(rise2 - a2) + length3 * cos(rise3 - a2 - a3)
        return along + self.hand[0] < 0.0, sin(rise3 - a3 - rise2) > 0.0

    def solve(self, pose: Pose, branch: Branch) -> Four | None:
        """Return the values of a flange pose on one branch, or None.

        Turns are within +-pi; None: out of reach.
        """
        back, elbow = branch
        (px, py, pz), q = pose
        w, x, y, z = multiply(q, conjugate(self.turn))
        if hypot(x, y) > _LEVEL:
            return None
        planar = px * px + py * py - self.hand[1] ** 2
        if planar < 0.0:
            return None
        reach = -sqrt(planar) if back else sqrt(planar)
        a1 = atan2(py, px) - atan2(self.hand[1], reach)
        result = _two_links(
            reach - self.hand[0] - self.shoulder[0],
            pz - self.hand[2] - self.shoulder[1],
            self.upper,
            self.fore,
            over=elbow,
        )
        if result is None:
            return None
        a2, bend = result
        yaw = 2 * atan2(z, w)
        s1, s2, s3, s4 = self.signs
        return (
            s1 * _wrap(a1),
            s2 * _wrap(a2),
            s3 * _wrap(bend - a2),
            s4 * _wrap(yaw - a1),
        )


@dataclass(frozen=True, slots=True)
class Scara:
    """Lengths and bearings (rad) of the two links at zero, seen from above; heights in m."""

    upper: tuple[float, float]
    fore: tuple[float, float]
    hand: Vector
    """From axis 4 to the flange at zero."""
    height: float
    """Of the flange at zero."""
    turn: Quaternion
    signs: tuple[int, int, int, int]

    def branch(self, values: Sequence[float]) -> Branch:
        """Return the side to which the elbow is turned."""
        return False, sin(self.fore[1] + self.signs[1] * values[1] - self.upper[1]) < 0.0

    def solve(self, pose: Pose, branch: Branch) -> Four | None:
        """Return the values of a flange pose on one branch, or None.

        Turns are within +-pi; None: out of reach.
        """
        back, over = branch
        (px, py, pz), q = pose
        w, x, y, z = multiply(q, conjugate(self.turn))
        if back or hypot(x, y) > _LEVEL:
            return None
        yaw = 2 * atan2(z, w)
        c, s = cos(yaw), sin(yaw)
        hx, hy, _ = self.hand
        wx, wy = px - (c * hx - s * hy), py - (s * hx + c * hy)
        # From above, angles count upwards; in an upright plane they count downwards.
        result = _two_links(
            wx, -wy, (self.upper[0], -self.upper[1]), (self.fore[0], -self.fore[1]), over=over
        )
        if result is None:
            return None
        a1, both = result
        s1, s2, s3, s4 = self.signs
        return (
            s1 * _wrap(a1),
            s2 * _wrap(both - a1),
            s3 * (pz - self.height),
            s4 * _wrap(yaw - both),
        )


FourAxes: TypeAlias = Palletiser | Scara


def _two_links(
    x: float, z: float, upper: tuple[float, float], fore: tuple[float, float], *, over: bool
) -> tuple[float, float] | None:
    """Return the angles of two links in a plane, or None.

    Downwards, both relative to their zero; None: out of reach.
    """
    (length2, rise2), (length3, rise3) = upper, fore
    reach = hypot(x, z)
    if reach == 0.0:
        return None
    cosine = (reach * reach + length2 * length2 - length3 * length3) / (2 * reach * length2)
    if abs(cosine) > 1.0 + 1e-9:
        return None
    lift = acos(max(-1.0, min(1.0, cosine)))
    elevation = atan2(z, x) + (-lift if over else lift)
    remaining = atan2(z - length2 * sin(elevation), x - length2 * cos(elevation))
    return rise2 - elevation, rise3 - remaining


def _wrap(angle: float) -> float:
    return angle if -pi < angle <= pi else angle - 2 * pi * round(angle / (2 * pi))


def palletiser(
    points: Sequence[Vector], axes: Sequence[Vector], wrist: Vector, flange: Pose
) -> Palletiser | None:
    """Return the palletiser with these axes at zero, or None.

    Axis 1 is up, 2 and 3 across, the last one upright; the rods keep `wrist` level.
    """
    signs = _signs(axes, (2, 1, 1, 2))
    if signs is None or max(abs(points[0][0]), abs(points[0][1])) > _LEVEL:
        return None
    # The load of axis 6 must not swing with it.
    (x4, y4, _), (ex, ey, ez) = points[3], flange[0]
    if hypot(ex - x4, ey - y4) > _LEVEL:
        return None
    (x2, _, z2), (x3, _, z3), (x5, _, z5) = points[1], points[2], wrist
    made = Palletiser(
        (x2, z2),
        (hypot(x3 - x2, z3 - z2), atan2(z3 - z2, x3 - x2)),
        (hypot(x5 - x3, z5 - z3), atan2(z5 - z3, x5 - x3)),
        (ex - x5, ey, ez - z5),
        flange[1],
        signs,
    )
    return made if min(made.upper[0], made.fore[0]) > _LEVEL else None


def scara(points: Sequence[Vector], axes: Sequence[Vector], flange: Pose) -> Scara | None:
    """Return the SCARA of four upright axes at zero, the third of which slides."""
    signs = _signs(axes, (2, 2, 2, 2))
    if signs is None or max(abs(points[0][0]), abs(points[0][1])) > _LEVEL:
        return None
    (x2, y2, _), (x4, y4, _), (ex, ey, ez) = points[1], points[3], flange[0]
    made = Scara(
        (hypot(x2, y2), atan2(y2, x2)),
        (hypot(x4 - x2, y4 - y2), atan2(y4 - y2, x4 - x2)),
        (ex - x4, ey - y4, 0.0),
        ez,
        flange[1],
        signs,
    )
    return made if min(made.upper[0], made.fore[0]) > _LEVEL else None


def _signs(axes: Sequence[Vector], along: Sequence[int]) -> tuple[int, int, int, int] | None:
    result = []
    for axis, n in zip(axes, along, strict=True):
        if abs(abs(axis[n]) - 1.0) > _LEVEL:
            return None
        result.append(1 if axis[n] > 0 else -1)
    a, b, c, d = result
    return a, b, c, d
