"""Closed-form kinematics of six-axis arms with a spherical wrist.

The last three axes meet in one point (ABB's six-axis robots). At zero axis 1 points up, axes 2, 3
and 5 across, axes 4 and 6 along the forearm. Angles are URDF joint angles with positive axes (up,
left, forward), rad.

Rules of the inverse:

- The flange pose fixes the wrist centre, a point behind the flange along axis 6.
- Axes 1 to 3 place the wrist centre. Axis 1 turns its plane to the front or the rear of the arm;
  axes 2 and 3 are two links in that plane, with the elbow up or turned over.
- Axes 4 to 6 give the remaining orientation. Both signs of axis 5 are solutions, with axes 4 and 6
  turned by pi.
- A branch is one choice of each: eight branches. The order of the flags is that of cfx.
- With axis 5 at zero only the sum of axes 4 and 6 is determined. The caller gives axis 4.
- A wrist centre on axis 1 leaves axis 1 free, and one out of the links' reach has no solution.
"""

from dataclasses import dataclass
from math import acos, atan2, cos, hypot, pi, sin, sqrt
from typing import TypeAlias

from rapidgen.axes.frames import Pose, Quaternion, Vector, conjugate, multiply, rotate

Angles: TypeAlias = tuple[float, float, float, float, float, float]
ArmBranch: TypeAlias = tuple[bool, bool, bool]
"""(wrist centre on the rear side of axis 1, elbow turned over, axis 5 negative)"""
BRANCHES: tuple[ArmBranch, ...] = tuple(
    (back, elbow, flip)
    for back in (False, True)
    for elbow in (False, True)
    for flip in (False, True)
)
SINGULAR = 1e-5
"""rad of axis 5 taken as zero.

A quaternion of six decimals causes some 5e-6 there, one of single precision 3e-7, which would turn
axes 4 and 6 anywhere; the ignored error is 10 um at 1 m.
"""


@dataclass(frozen=True, slots=True)
class WristArm:
    """Geometry at zero, seen from the base: plane x, z; y to the left."""

    shoulder: tuple[float, float]
    """x, z of axis 2"""
    upper: tuple[float, float]
    """Length and elevation (rad) of the link from axis 2 to axis 3."""
    fore: tuple[float, float]
    """The same from axis 3 to the wrist centre."""
    lateral: float
    """y of the wrist centre."""
    flange: Vector
    """From the wrist centre to the flange, in the flange's own frame."""
    turn: Quaternion
    """Orientation of the flange."""

    def forward(self, angles: Angles) -> Pose:
        """Return the flange in the base frame."""
        a1, a2, a3, a4, a5, a6 = angles
        (length2, rise2), (length3, rise3) = self.upper, self.fore
        bend = a2 + a3
        along = self.shoulder[0] + length2 * cos(rise2 - a2) + length3 * cos(rise3 - bend)
        up = self.shoulder[1] + length2 * sin(rise2 - a2) + length3 * sin(rise3 - bend)
        c, s = cos(a1), sin(a1)
        half5 = a5 / 2
        plus, minus = (a4 + a6) / 2, (a4 - a6) / 2
        ch, sh = cos(half5), sin(half5)
        wrist = ch * cos(plus), ch * sin(plus), sh * cos(minus), sh * sin(minus)
        q = multiply(multiply(self._arm(a1, bend), wrist), self.turn)
        tx, ty, tz = rotate(q, self.flange)
        return (
            (c * along - s * self.lateral + tx, s * along + c * self.lateral + ty, up + tz),
            q,
        )

    @staticmethod
    def _arm(a1: float, bend: float) -> Quaternion:
        c1, s1 = cos(a1 / 2), sin(a1 / 2)
        cb, sb = cos(bend / 2), sin(bend / 2)
        return c1 * cb, -s1 * sb, c1 * sb, s1 * cb

    def branch(self, angles: Angles) -> ArmBranch:
        """Return the branch of a posture, one of eight."""
        (length2, rise2), (length3, rise3) = self.upper, self.fore
        along = (
            self.shoulder[0]
            + length2 * cos(rise2 - angles[1])
            + length3 * cos(rise3 - angles[1] - angles[2])
        )
        # The forearm is forward of the upper arm while it is turned clockwise from it.
        return along < 0.0, sin(rise3 - angles[2] - rise2) > 0.0, angles[4] < 0.0

    def solve(self, pose: Pose, branch: ArmBranch, near4: float) -> Angles | None:
        """Return angles within +-pi of a flange pose on one branch, or None.

        None: out of reach. `near4` is axis 4 where axes 4 and 6 are in line and only their sum is
        determined.
        """
        back, elbow, flip = branch
        (px, py, pz), q = pose
        tx, ty, tz = rotate(q, self.flange)
        wx, wy, wz = px - tx, py - ty, pz - tz
        planar = wx * wx + wy * wy - self.lateral * self.lateral
        if planar < 0.0:
            return None
        along = -sqrt(planar) if back else sqrt(planar)
        a1 = atan2(wy, wx) - atan2(self.lateral, along)
        ux, uz = along - self.shoulder[0], wz - self.shoulder[1]
        (length2, rise2), (length3, rise3) = self.upper, self.fore
        reach = hypot(ux, uz)
        square = reach * reach
        if reach == 0.0:
            return None
        cosine = (square + length2 * length2 - length3 * length3) / (2 * reach * length2)
        if not -1.0 <= cosine <= 1.0:
            if abs(cosine) > 1.0 + 1e-9:
                return None
            cosine = max(-1.0, min(1.0, cosine))
        lift = acos(cosine)
        elevation = atan2(uz, ux) + (-lift if elbow else lift)
        a2 = rise2 - elevation
        fx, fz = ux - length2 * cos(elevation), uz - length2 * sin(elevation)
        bend = rise3 - atan2(fz, fx)
        a3 = bend - a2
        w, x, y, z = multiply(conjugate(self._arm(a1, bend)), multiply(q, conjugate(self.turn)))
        across, level = hypot(y, z), hypot(w, x)
        plus = atan2(x, w)
        if across < SINGULAR / 2:
            a4 = near4
            a6 = 2 * plus - a4
            a5 = 0.0
        else:
            minus = atan2(z, y)
            a4, a5, a6 = plus + minus, 2 * atan2(across, level), plus - minus
            if flip:
                a4, a5, a6 = a4 + pi, -a5, a6 - pi
        return _wrap(a1), _wrap(a2), _wrap(a3), _wrap(a4), a5, _wrap(a6)


def _wrap(angle: float) -> float:
    if -pi < angle <= pi:
        return angle
    return angle - 2 * pi * round(angle / (2 * pi))
