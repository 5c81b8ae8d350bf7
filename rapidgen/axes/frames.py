"""Positions, quaternions and poses as plain tuples, in m; q = (scalar, x, y, z).

Written for speed on single poses: no arrays, no classes with methods to look up.
"""

from math import acos, asin, atan2, cos, pi, sin, sqrt
from typing import TypeAlias

from rapidgen.config.vectors import Vector as Vector
from rapidgen.config.vectors import add as add
from rapidgen.config.vectors import cross as cross
from rapidgen.config.vectors import dot as dot
from rapidgen.config.vectors import norm as norm
from rapidgen.config.vectors import scale as scale
from rapidgen.config.vectors import subtract as subtract
from rapidgen.config.vectors import unit as unit

Quaternion: TypeAlias = tuple[float, float, float, float]
Pose: TypeAlias = tuple[Vector, Quaternion]
"""Position and orientation of one frame in another."""
Axis: TypeAlias = tuple[Vector, Vector]
"""A point of an axis, and its direction."""
Matrix: TypeAlias = tuple[Vector, Vector, Vector]
"""Rotation matrix by rows."""

ORIGIN: Vector = (0.0, 0.0, 0.0)
UNIT: Quaternion = (1.0, 0.0, 0.0, 0.0)
IDENTITY: Pose = (ORIGIN, UNIT)


def distance(a: Vector, b: Vector) -> float:
    """Return the distance of two points."""
    return norm(subtract(a, b))


def multiply(a: Quaternion, b: Quaternion) -> Quaternion:
    """Return rotation b in the frame that a turns."""
    aw, ax, ay, az = a
    bw, bx, by, bz = b
    return (
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    )


def conjugate(q: Quaternion) -> Quaternion:
    """Return the inverse rotation of a unit quaternion."""
    return q[0], -q[1], -q[2], -q[3]


def normalise(q: Quaternion) -> Quaternion:
    """Return q / |q|. ZeroDivisionError for zero."""
    size = 1 / sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    return q[0] * size, q[1] * size, q[2] * size, q[3] * size


def rotate(q: Quaternion, v: Vector) -> Vector:
    """Return v rotated by q."""
    w, x, y, z = q
    tx = 2 * (y * v[2] - z * v[1])
    ty = 2 * (z * v[0] - x * v[2])
    tz = 2 * (x * v[1] - y * v[0])
    return (
        v[0] + w * tx + y * tz - z * ty,
        v[1] + w * ty + z * tx - x * tz,
        v[2] + w * tz + x * ty - y * tx,
    )


def compose(a: Pose, b: Pose) -> Pose:
    """Return frame b, given in frame a, relative to a's reference (PoseMult)."""
    moved = rotate(a[1], b[0])
    return add(a[0], moved), multiply(a[1], b[1])


def invert(p: Pose) -> Pose:
    """Return the outer frame relative to p (PoseInv)."""
    back = conjugate(p[1])
    x, y, z = rotate(back, p[0])
    return (-x, -y, -z), back


def within(outer: Pose, p: Pose) -> Pose:
    """Return a pose relative to a frame; both are given in one frame."""
    if outer[1] == UNIT:
        return subtract(p[0], outer[0]), p[1]
    back = conjugate(outer[1])
    return rotate(back, subtract(p[0], outer[0])), multiply(back, p[1])


def transform(p: Pose, v: Vector) -> Vector:
    """Return a point of frame p, relative to p's reference (PoseVect)."""
    return add(p[0], rotate(p[1], v))


def about(axis: Vector, angle: float) -> Quaternion:
    """Return the rotation by `angle` rad about a unit axis."""
    s = sin(angle / 2)
    return cos(angle / 2), axis[0] * s, axis[1] * s, axis[2] * s


def to_axis(q: Quaternion) -> tuple[Vector, float]:
    """Return unit axis and angle, 0 to pi; the z axis for no rotation."""
    w, x, y, z = q if q[0] >= 0 else (-q[0], -q[1], -q[2], -q[3])
    size = sqrt(x * x + y * y + z * z)
    if size < 1e-12:
        return (0.0, 0.0, 1.0), 0.0
    return (x / size, y / size, z / size), 2 * atan2(size, w)


def angle_between(a: Quaternion, b: Quaternion) -> float:
    """Return the smallest rotation angle from a to b, 0 to pi."""
    w, x, y, z = multiply(conjugate(a), b)
    return 2 * atan2(sqrt(x * x + y * y + z * z), abs(w))


def slerp(a: Quaternion, b: Quaternion, fraction: float) -> Quaternion:
    """Interpolate from a to b at a constant rate, the short way.

    `fraction` may be outside 0 to 1.
    """
    cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]
    if cosine < 0.0:
        b = (-b[0], -b[1], -b[2], -b[3])
        cosine = -cosine
    if cosine > 1 - 1e-10:
        # At such small angles the chord is exact and avoids division by a small sine.
        w, x, y, z = (p + (q - p) * fraction for p, q in zip(a, b, strict=True))
        return normalise((w, x, y, z))
    angle = acos(min(1.0, cosine))
    size = 1 / sin(angle)
    first, second = sin((1 - fraction) * angle) * size, sin(fraction * angle) * size
    return (
        first * a[0] + second * b[0],
        first * a[1] + second * b[1],
        first * a[2] + second * b[2],
        first * a[3] + second * b[3],
    )


def to_matrix(q: Quaternion) -> Matrix:
    """Return the rotation matrix of a unit quaternion."""
    w, x, y, z = q
    return (
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )


def from_matrix(m: Matrix) -> Quaternion:
    """Return the unit quaternion of a rotation matrix, scalar not negative."""
    (a, b, c), (d, e, f), (g, h, i) = m
    trace = a + e + i
    if trace > 0:
        s = 2 * sqrt(trace + 1)
        return s / 4, (h - f) / s, (c - g) / s, (d - b) / s
    if a >= e and a >= i:
        s = 2 * sqrt(max(0.0, 1 + a - e - i))
        q = (h - f) / s, s / 4, (b + d) / s, (c + g) / s
    elif e >= i:
        s = 2 * sqrt(max(0.0, 1 + e - a - i))
        q = (c - g) / s, (b + d) / s, s / 4, (f + h) / s
    else:
        s = 2 * sqrt(max(0.0, 1 + i - a - e))
        q = (d - b) / s, (c + g) / s, (f + h) / s, s / 4
    return (-q[0], -q[1], -q[2], -q[3]) if q[0] < 0 else q


def from_zyx(z: float, y: float, x: float) -> Quaternion:
    """Return rotations by z, then new y, then new x (rad): Rz Ry Rx."""
    cz, sz = cos(z / 2), sin(z / 2)
    cy, sy = cos(y / 2), sin(y / 2)
    cx, sx = cos(x / 2), sin(x / 2)
    return (
        cz * cy * cx + sz * sy * sx,
        cz * cy * sx - sz * sy * cx,
        cz * sy * cx + sz * cy * sx,
        sz * cy * cx - cz * sy * sx,
    )


def to_zyx(q: Quaternion) -> Vector:
    """Return the angles (z, y, x) in rad of `from_zyx`; y within +-pi/2."""
    m = to_matrix(q)
    sine = -m[2][0]
    if abs(sine) > 1 - 1e-12:
        # Only z - x (or z + x) is determined: x is taken as 0.
        y = pi / 2 if sine > 0 else -pi / 2
        return atan2(-m[0][1], m[1][1]), y, 0.0
    return atan2(m[1][0], m[0][0]), asin(sine), atan2(m[2][1], m[2][2])


def from_rpy(roll: float, pitch: float, yaw: float) -> Quaternion:
    """Return the rotation of URDF's rpy: about fixed x, y, z.

    This is `from_zyx(yaw, pitch, roll)`.
    """
    return from_zyx(yaw, pitch, roll)


def error(have: Pose, want: Pose) -> tuple[float, float, float, float, float, float]:
    """Return position (m) and rotation vector (rad) between two poses."""
    w, x, y, z = multiply(want[1], conjugate(have[1]))
    if w < 0:
        w, x, y, z = -w, -x, -y, -z
    size = sqrt(x * x + y * y + z * z)
    factor = 2.0 if size < 1e-12 else 2 * atan2(size, w) / size
    (a, b, c), (d, e, f) = want[0], have[0]
    return a - d, b - e, c - f, factor * x, factor * y, factor * z
