"""Poses of a TCP or a frame: position in m, orientation as a unit quaternion."""

from collections.abc import Sequence
from math import atan2, cos, isfinite, radians, sin, sqrt
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from rapidgen.axes import frames
from rapidgen.axes.frames import Quaternion, Vector
from rapidgen.client.errors import InvalidProgram

Numbers: TypeAlias = Sequence[float] | npt.NDArray[np.float64]
"""Numbers in an array, a list or a tuple."""
_MM = 0.001
_FARTHEST = 100.0
"""Largest coordinate, m: a larger one is in mm."""
_LENGTH = 0.01
"""Tolerance of a quaternion's length: users write three digits."""
_ORTHOGONAL = 1e-3
"""Tolerance of a rotation matrix."""


class Pose(NamedTuple):
    """Position (x, y, z), m, and orientation as a unit quaternion (w, x, y, z).

    Conventions for quaternions differ (ROS, SciPy and many libraries end with w, RAPID begins with
    it), so that methods of a robot take no plain tuples. Create poses with `from_wxyz`,
    `from_xyzw`, `from_matrix`, `from_rotvec` or `from_mm`, or move another one:
    `robot.pose.moved(z=0.03)`.
    """

    position: Vector
    orientation: Quaternion = frames.UNIT

    @classmethod
    def from_wxyz(cls, position: Numbers, quaternion: Numbers) -> "Pose":
        """Return a pose from a position in m and a quaternion (w, x, y, z), as in RAPID.

        Raises InvalidProgram: not three and four finite numbers, a position beyond 100 m, or a
        quaternion that is not of length 1.
        """
        x, y, z = _numbers(position, 3, "position (x, y, z) in m")
        w, a, b, c = _numbers(quaternion, 4, "quaternion (w, x, y, z)")
        if max(abs(x), abs(y), abs(z)) > _FARTHEST:
            raise _invalid(
                f"the position ({x:g}, {y:g}, {z:g}) m is beyond {_FARTHEST:g} m",
                "positions are in m; `Pose.from_mm` takes mm",
            )
        length = sqrt(w * w + a * a + b * b + c * c)
        if abs(length - 1) > _LENGTH:
            raise _invalid(
                f"the quaternion ({w:g}, {a:g}, {b:g}, {c:g}) has length {length:.4g}, not 1",
                "divide it by its length, if its values are right",
            )
        return cls((x, y, z), frames.normalise((w, a, b, c)))

    @classmethod
    def from_xyzw(cls, position: Numbers, quaternion: Numbers) -> "Pose":
        """Return a pose from a position in m and a quaternion (x, y, z, w), as in ROS and SciPy.

        Raises as `from_wxyz`.
        """
        a, b, c, w = _numbers(quaternion, 4, "quaternion (x, y, z, w)")
        return cls.from_wxyz(position, (w, a, b, c))

    @classmethod
    def from_mm(cls, position: Numbers, quaternion: Numbers) -> "Pose":
        """Return a pose from RAPID's units: mm, and a quaternion (w, x, y, z).

        Raises as `from_wxyz`.
        """
        values = _numbers(position, 3, "position (x, y, z) in mm")
        return cls.from_wxyz([value * _MM for value in values], quaternion)

    @classmethod
    def from_matrix(cls, matrix: npt.ArrayLike) -> "Pose":
        """Return a pose from a homogeneous transform, shape (4, 4), m.

        Raises InvalidProgram: another shape, or a rotation that is not orthogonal and right-handed.
        """
        try:
            array = np.array(matrix, float)
        except (TypeError, ValueError) as fault:
            raise _invalid("the matrix is not of numbers", "give an array (4, 4)") from fault
        if array.shape != (4, 4) or not np.isfinite(array).all():
            shape = "x".join(map(str, array.shape))
            raise _invalid(f"the matrix is {shape}, or not finite", "give an array (4, 4)")
        turn = array[:3, :3]
        error = float(np.abs(turn @ turn.T - np.eye(3)).max())
        if error > _ORTHOGONAL or np.linalg.det(turn) < 0 or (array[3] != (0, 0, 0, 1)).any():
            raise _invalid(
                "the matrix is not a rotation and a translation",
                "its upper left 3x3 is orthogonal and right-handed, its last row 0, 0, 0, 1",
            )
        rows = [(float(a), float(b), float(c)) for a, b, c in turn]
        return cls.from_wxyz(array[:3, 3], frames.from_matrix((rows[0], rows[1], rows[2])))

    @classmethod
    def from_rotvec(cls, position: Numbers, rotvec: Numbers) -> "Pose":
        """Return a pose from a position in m and a rotation vector: unit axis times angle in rad.

        Raises as `from_wxyz`.
        """
        a, b, c = _numbers(rotvec, 3, "rotation vector, rad")
        angle = sqrt(a * a + b * b + c * c)
        # sin(angle / 2) / angle, with its limit at 0.
        factor = sin(angle / 2) / angle if angle > 1e-9 else 0.5
        return cls.from_wxyz(position, (cos(angle / 2), a * factor, b * factor, c * factor))

    @property
    def wxyz(self) -> npt.NDArray[np.float64]:
        """Quaternion (w, x, y, z), shape (4,)."""
        return np.array(self.orientation)

    @property
    def xyzw(self) -> npt.NDArray[np.float64]:
        """Quaternion (x, y, z, w), shape (4,)."""
        w, x, y, z = self.orientation
        return np.array([x, y, z, w])

    @property
    def matrix(self) -> npt.NDArray[np.float64]:
        """Homogeneous transform, shape (4, 4), m."""
        result = np.eye(4)
        result[:3, :3] = frames.to_matrix(self.orientation)
        result[:3, 3] = self.position
        return result

    @property
    def rotvec(self) -> npt.NDArray[np.float64]:
        """Rotation vector, shape (3,), rad: unit axis times angle from 0 to pi."""
        w, x, y, z = self.orientation if self.orientation[0] >= 0 else -self.wxyz
        size = sqrt(x * x + y * y + z * z)
        factor = 2 * atan2(size, w) / size if size > 1e-9 else 2.0
        return np.array([x, y, z]) * factor

    @property
    def mm(self) -> Vector:
        """Position, mm."""
        x, y, z = self.position
        return (x / _MM, y / _MM, z / _MM)

    def moved(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> "Pose":
        """Return the pose moved along the axes of its reference frame, m."""
        return Pose.from_wxyz(frames.add(self.position, (x, y, z)), self.orientation)

    def __repr__(self) -> str:
        x, y, z = self.position
        w, a, b, c = self.orientation
        return (
            f"Pose(x={x:.6g} m, y={y:.6g} m, z={z:.6g} m; "
            f"qw={w:.6g}, qx={a:.6g}, qy={b:.6g}, qz={c:.6g})"
        )


IDENTITY = Pose(frames.ORIGIN)
"""The reference frame itself."""


def from_degrees(*values: float) -> tuple[float, ...]:
    """Return joints given in degrees, in rad: `robot.move_to(from_degrees(0, 10, 0, 0, 30, 0))`.

    Linear axes are in m and need no conversion.
    """
    return tuple(radians(value) for value in _numbers(values, len(values), "list of joints, deg"))


def pose_of(pose: object) -> Pose:
    """Return a checked pose. Raises InvalidProgram for plain tuples and other values."""
    if not isinstance(pose, Pose):
        raise _invalid(
            f"{pose!r} is not a Pose",
            "Pose.from_wxyz((x, y, z), (w, x, y, z)) in m, or from_xyzw, from_mm, from_matrix",
        )
    return pose


def _numbers(values: Numbers, count: int, what: str) -> tuple[float, ...]:
    try:
        result = tuple(map(float, values))
    except (TypeError, ValueError) as fault:
        raise _invalid(f"{values!r} is not a {what}", f"give {count} numbers") from fault
    if len(result) != count or not all(map(isfinite, result)):
        raise _invalid(f"{values!r} is not a {what}", f"give {count} finite numbers")
    return result


def _invalid(message: str, help: str) -> InvalidProgram:
    return InvalidProgram.because("RG670", message, help, exit_code=2)
