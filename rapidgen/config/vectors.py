"""Vectors of three numbers as plain tuples.

For single vectors they are faster than arrays.
"""

import math
from typing import TypeAlias

Vector: TypeAlias = tuple[float, float, float]


def add(a: Vector, b: Vector) -> Vector:
    """Return the sum."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def subtract(a: Vector, b: Vector) -> Vector:
    """Return the difference."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(a: Vector, by: float) -> Vector:
    """Return a multiple."""
    return (a[0] * by, a[1] * by, a[2] * by)


def dot(a: Vector, b: Vector) -> float:
    """Return the inner product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """Return the cross product."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def norm(a: Vector) -> float:
    """Return the length."""
    return math.sqrt(dot(a, a))


def unit(a: Vector) -> Vector:
    """Return the direction of a vector.

    ZeroDivisionError for the zero vector.
    """
    return scale(a, 1 / norm(a))


def rotated(q: tuple[float, float, float, float], v: Vector) -> Vector:
    """Return a vector turned by a unit quaternion, scalar first."""
    w, u = q[0], (q[1], q[2], q[3])
    across = cross(u, v)
    return add(v, add(scale(across, 2 * w), scale(cross(u, across), 2)))


def quaternion(x: Vector, y: Vector, z: Vector) -> tuple[float, float, float, float]:
    """Return the unit quaternion, scalar first, of a frame with these unit axes."""
    # Four times the products of its components; the largest square divides without loss.
    table = (
        (1 + x[0] + y[1] + z[2], y[2] - z[1], z[0] - x[2], x[1] - y[0]),
        (y[2] - z[1], 1 + x[0] - y[1] - z[2], y[0] + x[1], z[0] + x[2]),
        (z[0] - x[2], y[0] + x[1], 1 - x[0] + y[1] - z[2], z[1] + y[2]),
        (x[1] - y[0], z[0] + x[2], z[1] + y[2], 1 - x[0] - y[1] + z[2]),
    )
    best = max(range(4), key=lambda i: table[i][i])
    a, b, c, d = table[best]
    size = math.sqrt(a * a + b * b + c * c + d * d)
    return a / size, b / size, c / size, d / size
