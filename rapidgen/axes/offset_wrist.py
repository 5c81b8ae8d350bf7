"""Inverse kinematics of arms with an offset wrist (ABB's CRB 15000).

Axes 4 and 5 meet in a point, and axis 6 passes at a distance from it. Needs numpy.

Rules:

- A given angle of axis 6 fixes the point where axes 4 and 5 meet, because the flange pose fixes
  axis 6.
- That point gives axes 1 to 3, as for a spherical wrist, on four branches: wrist on the front or
  rear side of axis 1, elbow up or turned over.
- The remaining condition is that axis 4 is square to axis 5. It is one scalar equation in axis 6 on
  each branch.
- Its roots are bracketed between samples of a whole turn. Two roots may be close to each other, or
  at the end of the reach: such places are sampled more densely.
- Near a known posture the secant method finds the root of the same branch.
- Angles and geometry are those of `WristArm`.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from math import atan2, cos, pi, sin, sqrt
from typing import NamedTuple, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from rapidgen.axes import frames
from rapidgen.axes.frames import Pose, Vector
from rapidgen.axes.spherical_wrist import Angles, WristArm

Floats: TypeAlias = NDArray[np.float64]
Number = TypeVar("Number", float, Floats)
Side: TypeAlias = tuple[float, float]
"""Wrist on the front (+1) or rear (-1) side of axis 1, elbow up (+1) or turned over (-1)."""
_SIDES: tuple[Side, ...] = ((1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0))
_ANGLES = np.linspace(-pi, pi + pi / 90, 182)
"""A whole turn and one additional step."""
_SHARES = tuple(1.0 - u * u for u in (1.0, 0.75, 0.5, 0.3, 0.16, 0.08, 0.04, 0.02, 0.0))
"""Samples towards the end of the reach, where the equation follows the root of the distance."""
_GOLDEN = (sqrt(5.0) - 1) / 2
_NARROW = 1e-7
_HALVINGS = 40
_EXACT = 1e-13
_EXACT_STEPS = 1e-14
"""Product of two steps of the secant method, a bound for the error of the second."""
_GRAZING = 0.02
"""Distance of a minimum from zero below which the equation is sampled closely."""
_CLOSE = 0.5
"""rad of axis 6 around a posture within which its branch continues."""


@dataclass(frozen=True)
class OffsetWrist:
    """The arm up to the point where axes 4 and 5 meet, and the part after it."""

    arm: WristArm
    """Its `flange` begins on axis 6, where `offset` ends."""
    offset: tuple[float, float]
    """y, z from where axes 4 and 5 meet to axis 6 at zero."""

    @cached_property
    def figures(self) -> tuple[float, ...]:
        """Return the geometry values of the equation, in its order."""
        arm = self.arm
        (length2, _), (length3, rise3) = arm.upper, arm.fore
        square2, square3 = length2 * length2, length3 * length3
        return (
            *self.offset,
            arm.lateral,
            *arm.shoulder,
            square2,
            (square2 - square3) / 2,
            cos(rise3) / length3,
            sin(rise3) / length3,
        )

    def solutions(self, pose: Pose) -> Iterator[Angles]:
        """Yield all angles within +-pi of a flange pose."""
        wrist = _Wrist.of(self, pose)
        for side in _SIDES:
            for a6 in wrist.roots(side):
                yield wrist.angles(side, a6)

    def near(self, pose: Pose, angles: Angles) -> Angles | None:
        """Return angles of a flange pose on the branch of close ones, or None.

        None: not found from there.
        """
        wrist = _Wrist.of(self, pose)
        back, over, _ = self.arm.branch(angles)
        side = (-1.0 if back else 1.0, -1.0 if over else 1.0)
        start = last = angles[5]
        new = start + 1e-4
        before, current = wrist.value(side, last), wrist.value(side, new)
        for _ in range(12):
            if before is None or current is None or abs(new - start) > _CLOSE:
                return None
            if abs(current) < _EXACT:
                return wrist.angles(side, new)
            if current == before:
                return None
            step = current * (new - last) / (current - before)
            if abs(step * (new - last)) < _EXACT_STEPS:
                return wrist.angles(side, new - step)
            last, new = new, new - step
            before, current = current, wrist.value(side, new)
        return None


class _Wrist(NamedTuple):
    """A flange pose; axes 4 and 5 meet in `fixed` less the offset.

    The offset is turned back about axis 6.
    """

    geometry: OffsetWrist
    fixed: Vector
    x: Vector
    y: Vector
    z: Vector

    @classmethod
    def of(cls, geometry: OffsetWrist, pose: Pose) -> "_Wrist":
        place, q = pose
        m = frames.to_matrix(frames.multiply(q, frames.conjugate(geometry.arm.turn)))
        fixed = frames.subtract(place, frames.rotate(q, geometry.arm.flange))
        (a, b, c), (d, e, f), (g, h, i) = m
        return cls(geometry, fixed, (a, d, g), (b, e, h), (c, f, i))

    def value(self, side: Side, a6: float) -> float | None:
        """Return the equation at an angle; None: out of the arm's reach."""
        result, planar, bent = self._equation(side, cos(a6), sin(a6), _root)
        return result if planar >= 0.0 and bent >= 0.0 else None

    def _equation(
        self, side: Side, c: Number, s: Number, root: Callable[[Number], Number]
    ) -> tuple[Number, Number, Number]:
        """Return the cosine between axes 4 and 5, and two reach values.

        The values are negative if axes 1, or 2 and 3, do not reach the point.
        """
        geometry, (fx, fy, fz), _, (yx, yy, yz), (zx, zy, zz) = self
        oy, oz, lateral, x2, z2, square2, squares, cr, sr = geometry.figures
        along_y, along_z = oy * c + oz * s, oz * c - oy * s
        x, y, z = (
            fx - along_y * yx - along_z * zx,
            fy - along_y * yy - along_z * zy,
            fz - along_y * yz - along_z * zz,
        )
        flat = x * x + y * y
        planar = flat - lateral * lateral
        along = side[0] * root(planar)
        c1, s1 = (x * along + y * lateral) / flat, (y * along - x * lateral) / flat
        ux, uz = along - x2, z - z2
        square = ux * ux + uz * uz
        # The upper arm is at `lift` from the line to the wrist, as shares of that line's length.
        lift = 0.5 + squares / square
        bent = square2 / square - lift * lift
        tilt = side[1] * root(bent)
        ex, ez = ux - (lift * ux - tilt * uz), uz - (lift * uz + tilt * ux)
        level, down = cr * ex + sr * ez, sr * ex - cr * ez
        across = c * (c1 * yx + s1 * yy) - s * (c1 * zx + s1 * zy)
        return level * across - down * (c * yz - s * zz), planar, bent

    def angles(self, side: Side, a6: float) -> Angles:
        """Return all angles for a root of the equation."""
        geometry, (fx, fy, fz), (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = self
        arm, (oy, oz) = geometry.arm, geometry.offset
        c, s = cos(a6), sin(a6)
        across, up = oy * c + oz * s, oz * c - oy * s
        x = fx - across * yx - up * zx
        y = fy - across * yy - up * zy
        z = fz - across * yz - up * zz
        along = side[0] * _root(x * x + y * y - arm.lateral * arm.lateral)
        a1 = atan2(y, x) - atan2(arm.lateral, along)
        (length2, rise2), (length3, rise3) = arm.upper, arm.fore
        ux, uz = along - arm.shoulder[0], z - arm.shoulder[1]
        square = ux * ux + uz * uz
        lift = (square + length2 * length2 - length3 * length3) / (2 * square)
        tilt = side[1] * _root(length2 * length2 / square - lift * lift)
        dx, dz = lift * ux - tilt * uz, lift * uz + tilt * ux
        a2 = rise2 - atan2(dz, dx)
        bend = rise3 - atan2(uz - dz, ux - dx)
        c1, s1, cb, sb = cos(a1), sin(a1), cos(bend), sin(bend)
        # Axis 5, and the forearm with the remaining direction and the one above it.
        ax, ay, az = c * yx - s * zx, c * yy - s * zy, c * yz - s * zz
        fx, fy, fz = c1 * cb, s1 * cb, -sb
        a4 = atan2(sb * (c1 * ax + s1 * ay) + cb * az, c1 * ay - s1 * ax)
        lifted = xx * (fy * az - fz * ay) + xy * (fz * ax - fx * az) + xz * (fx * ay - fy * ax)
        a5 = atan2(-lifted, xx * fx + xy * fy + xz * fz)
        return _wrap(a1), _wrap(a2), _wrap(bend - a2), a4, a5, _wrap(a6)

    # -- its roots --------------------------------------------------------------------------

    def roots(self, side: Side) -> Iterator[float]:
        """Yield angles of axis 6 that solve the equation."""
        with np.errstate(divide="ignore", invalid="ignore"):
            value, planar, bent = self._equation(side, np.cos(_ANGLES), np.sin(_ANGLES), _roots)
        inside, above, size = (planar >= 0.0) & (bent >= 0.0), value > 0.0, np.abs(value)
        both = inside[:-2] & inside[1:-1]
        changed = both & (above[:-2] != above[1:-1])
        for n in np.flatnonzero(changed).tolist():
            yield self._between(side, float(_ANGLES[n]), float(_ANGLES[n + 1]))
        turning = (size[1:-1] <= size[:-2]) & (size[1:-1] <= size[2:]) & (size[1:-1] < _GRAZING)
        same = (above[:-2] == above[1:-1]) & (above[1:-1] == above[2:])
        for n in np.flatnonzero(both & inside[2:] & turning & same).tolist():
            yield from self._grazing(side, float(_ANGLES[n]), float(_ANGLES[n + 2]))
        for n in np.flatnonzero(inside[:-2] != inside[1:-1]).tolist():
            ends = (n, n + 1) if inside[n] else (n + 1, n)
            yield from self._at_edge(side, *(float(_ANGLES[end]) for end in ends))
        peaks = (bent[1:-1] >= bent[:-2]) & (bent[1:-1] >= bent[2:]) & (bent[1:-1] > -_GRAZING)
        for n in np.flatnonzero(peaks & ~inside[:-2] & ~inside[1:-1] & ~inside[2:]).tolist():
            yield from self._island(side, float(_ANGLES[n]), float(_ANGLES[n + 2]))

    def _between(self, side: Side, a: float, b: float) -> float:
        """Return the root between two angles of different signs (Illinois)."""
        before, current = self.value(side, a), self.value(side, b)
        for _ in range(_HALVINGS):
            if not before or not current or abs(current) < _EXACT:
                break
            c = b - current * (b - a) / (current - before)
            target = self.value(side, c)
            if target is None:
                break
            if target * current < 0.0:
                a, before = b, current
            else:
                before /= 2
            b, current = c, target
        return a if before == 0.0 else b

    def _grazing(self, side: Side, a: float, b: float) -> Iterator[float]:
        """Yield two roots, or none, around the minimum between two angles."""
        sign = 1.0 if (self.value(side, a) or 0.0) > 0.0 else -1.0

        def size(angle: float) -> float:
            value = self.value(side, angle)
            return 1.0 if value is None else sign * value

        least = _least(size, a, b)
        if least is not None:
            yield self._between(side, a, least)
            yield self._between(side, least, b)

    def _island(self, side: Side, a: float, b: float) -> Iterator[float]:
        """Yield roots between two angles, if only the interval is in reach."""

        def beyond(angle: float) -> float:
            return -self._equation(side, cos(angle), sin(angle), _root)[2]

        reached = _least(beyond, a, b)
        if reached is not None:
            yield from self._at_edge(side, reached, a)
            yield from self._at_edge(side, reached, b)

    def _at_edge(self, side: Side, within: float, beyond: float) -> Iterator[float]:
        """Yield roots between a sample and the end of the reach."""
        first, before = within, 2 * within - beyond
        for _ in range(_HALVINGS):
            middle = (within + beyond) / 2
            if self.value(side, middle) is None:
                beyond = middle
            else:
                within = middle
        steps = [first + fraction * (within - first) for fraction in _SHARES]
        values = [self.value(side, angle) or 0.0 for angle in steps]
        for n in range(len(steps) - 1):
            if values[n] * values[n + 1] <= 0.0:
                yield self._between(side, steps[n], steps[n + 1])
        earlier = self.value(side, before)
        if earlier is not None:
            steps, values = [before, *steps], [earlier, *values]
        for n in range(len(steps) - 2):
            a, b, c = values[n : n + 3]
            if min(a * b, b * c) > 0.0 and abs(b) <= min(abs(a), abs(c)):
                yield from self._grazing(side, steps[n], steps[n + 2])


def _least(of: Callable[[float], float], one: float, other: float) -> float | None:
    """Return a place where a function is not positive, or None.

    The golden-section search to its minimum stops there.
    """
    low, high = min(one, other), max(one, other)
    c, d = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
    at_c, at_d = of(c), of(d)
    while high - low > _NARROW:
        if min(at_c, at_d) <= 0.0:
            return c if at_c < at_d else d
        if at_c < at_d:
            high, d, at_d = d, c, at_c
            c = high - _GOLDEN * (high - low)
            at_c = of(c)
        else:
            low, c, at_c = c, d, at_d
            d = low + _GOLDEN * (high - low)
            at_d = of(d)
    return None


def _root(value: float) -> float:
    return sqrt(value) if value > 0.0 else 0.0


def _roots(values: Floats) -> Floats:
    result: Floats = np.sqrt(np.maximum(values, 0.0))
    return result


def _wrap(angle: float) -> float:
    return angle if -pi < angle <= pi else angle - 2 * pi * round(angle / (2 * pi))
