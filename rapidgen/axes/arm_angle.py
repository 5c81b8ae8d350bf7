"""ABB's arm angle and cfx: eax_a and robconf of arms with seven axes.

Only jointtargets contain the seventh axis' own value. In a robtarget eax_a is the angle of the
elbow about the line from shoulder to wrist: with e along that line, h along axis 3 (the fourth of
the arm) and r the reference direction, atan2(-(e x (e x r)) . h, -(e x r) . h). Shoulder: on axis 1
at axis 2; wrist: on axis 6 at axis 5. After A. Elias, J. Wen, "Redundancy Parameterization of the
ABB YuMi Robot Arm" (arXiv 2505.23111), whose ten postures read in RobotStudio are the tests.

cf1, cf4 and cf6 are the closest multiples of 90 degrees, not the quarters of arms with six axes;
cfx is +4 axis 2 negative, +2 elbow turned over, +1 axis 5 negative. Source: 51 targets of five
public programs in wobj0, whose postures follow from pose and arm angle.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import atan2, pi
from typing import TYPE_CHECKING

from rapidgen.axes import frames
from rapidgen.axes.frames import Axis, Pose, Vector, error

if TYPE_CHECKING:
    from rapidgen.axes.numeric_ik import Search

_ROUNDS = 25
_EXACT = 1e-9
_LARGEST = 0.4
_STARTS = 160


@dataclass(frozen=True)
class ArmAngle:
    """The arm angle of one arm; `reference` is r in the chain's first frame."""

    reference: Vector

    def of(self, axes: Sequence[Axis]) -> float:
        """Return the angle (rad) of an arm with these seven axes, in chain order."""
        shoulder, wrist = _foot(axes[0], axes[1]), _foot(axes[6], axes[5])
        along = frames.unit(frames.subtract(wrist, shoulder))
        across = frames.cross(along, self.reference)
        elbow = axes[3][1]
        return atan2(-frames.dot(frames.cross(along, across), elbow), -frames.dot(across, elbow))

    def slopes(self, axes: Sequence[Axis]) -> list[float]:
        """Return the derivatives of the angle by each of the seven axes (rad/rad).

        The shoulder stays; the wrist moves with each axis but the last, axis 3 with those before.
        All 0 if the arm has no angle because its line is along the reference.
        """
        dot, cross = frames.dot, frames.cross
        shoulder, wrist = _foot(axes[0], axes[1]), _foot(axes[6], axes[5])
        path = frames.subtract(wrist, shoulder)
        length = frames.norm(path)
        along = frames.scale(path, 1 / length)
        across = cross(along, self.reference)
        over = cross(along, across)
        elbow = axes[3][1]
        sine, cosine = -dot(over, elbow), -dot(across, elbow)
        size = sine * sine + cosine * cosine
        if size == 0.0:
            return [0.0] * len(axes)
        result = []
        for n, (point, axis) in enumerate(axes):
            moved = cross(axis, frames.subtract(wrist, point)) if n < 6 else frames.ORIGIN
            turned = cross(axis, elbow) if n < 3 else frames.ORIGIN
            moved = frames.subtract(moved, frames.scale(along, dot(along, moved)))
            d_along = frames.scale(moved, 1 / length)
            d_across = cross(d_along, self.reference)
            d_over = frames.add(cross(d_along, across), cross(along, d_across))
            d_sine = -dot(d_over, elbow) - dot(over, turned)
            d_cosine = -dot(d_across, elbow) - dot(across, turned)
            result.append((cosine * d_sine - sine * d_cosine) / size)
        return result

    def cfx(self, axes: Sequence[Axis], second: float, fifth: float) -> int:
        """Return cfx of an arm with these axes, and its axes 2 and 5 (rad) [code].

        The elbow turns over where the wrist, axis 4 at axis 5, is on the line from axis 2 to axis 3
        (-72 degrees of axis 3); public targets only show that it is between -31 and -88.
        """
        shoulder, wrist = _foot(axes[2], axes[1]), _foot(axes[4], axes[5])
        elbow, across = axes[3]
        upper, fore = frames.subtract(elbow, shoulder), frames.subtract(wrist, elbow)
        over = frames.dot(frames.cross(upper, fore), across) < 0.0
        return 4 * (second < 0.0) + 2 * over + (fifth < 0.0)

    def postures(
        self, search: "Search", pose: Pose, angle: float, start: Sequence[float]
    ) -> Iterator[tuple[float, ...]]:
        """Yield values for a pose and an arm angle, those near the start first."""
        result = self._near(search, pose, angle, start)
        if result is not None:
            yield result
        for row in search.closest(pose, _STARTS):
            result = self._near(search, pose, angle, row)
            if result is not None:
                yield result

    def _near(
        self, search: "Search", pose: Pose, angle: float, start: Sequence[float]
    ) -> tuple[float, ...] | None:
        import numpy as np  # only for arms with seven axes

        from rapidgen.axes.numeric_ik import solved

        values, last = list(start), 1e9
        for _ in range(_ROUNDS):
            flange, axes = search.lines(values)
            turned = angle - self.of(axes)
            current = (*error(flange, pose), turned - 2 * pi * round(turned / (2 * pi)))
            size = max(map(abs, current))
            if size < _EXACT:
                return tuple(values)
            if size > 3 * last:
                return None
            last = size
            columns = [
                (*column, slope)
                for column, slope in zip(
                    search.columns(flange, axes), self.slopes(axes), strict=True
                )
            ]
            jacobian = search.by_value(columns, len(values))
            normal = jacobian.T @ jacobian + 1e-8 * size * np.eye(len(values))
            step = solved(normal, jacobian.T @ np.array(current))
            fraction = min(1.0, _LARGEST / max(1e-12, float(np.max(np.abs(step)))))
            for n, change in enumerate(step):
                values[n] += fraction * float(change)
        return None


def _foot(axis: Axis, other: Axis) -> Vector:
    """Return the point of an axis that is closest to another one."""
    (p, a), (q, b) = axis, other
    normal = frames.cross(a, b)
    path = frames.subtract(q, p)
    along = frames.dot(frames.cross(path, b), normal) / frames.dot(normal, normal)
    return frames.add(p, frames.scale(a, along))
