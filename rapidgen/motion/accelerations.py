"""Accelerations of the axes in a posture, where the configuration has the axes' inertias.

What a motor accelerates grows with the distance of arm and wrist from its axis: for axis 1
with the squares of the distances of axis 3 and of the wrist's centre, for axis 2 with the fold of
axis 3.
"""

from collections.abc import Callable, Sequence
from math import cos, sin

from rapidgen.axes.kinematics import Posture
from rapidgen.config.accelerations import ESTIMATED_BAND, MEASURED_BAND
from rapidgen.config.model import AxisInertia, GroupConfig


def duration_error_band(group: GroupConfig) -> tuple[bool, float]:
    """Return whether accelerations are measured, and the relative error of durations.

    90 % of the durations are within that error.
    """
    measured = bool(group.acceleration_source)
    return measured, MEASURED_BAND if measured else ESTIMATED_BAND


def duration_note(group: GroupConfig) -> str:
    """Return the text after a simulated duration: `estimated, ±16 %`, or `±3 %`."""
    measured, band = duration_error_band(group)
    return f"{'' if measured else 'estimated, '}±{band:.0%}".replace("%", " %")


def of_posture(group: GroupConfig) -> Callable[[Posture], Sequence[float]] | None:
    """Accelerations (rad/s^2, m/s^2, wire order) by posture; None: they are constant."""
    if not group.inertias:
        return None
    axes = [joint.axis for joint in group.joints]
    second, third = axes.index("rax_2"), axes.index("rax_3")
    shoulder, upper, forward, up = _lengths(group)
    usual = [joint.acceleration for joint in group.joints]
    own = [(axes.index(inertia.axis), inertia) for inertia in group.inertias]

    def accelerations(posture: Posture) -> Sequence[float]:
        q2, q3 = posture[second], posture[third]
        elbow = shoulder + upper * sin(q2)
        wrist = elbow + forward * cos(q2 + q3) + up * sin(q2 + q3)
        result = usual[:]
        for i, inertia in own:
            result[i] = _acceleration(inertia, elbow * elbow, wrist * wrist, q3)
        return result

    return accelerations


def _acceleration(inertia: AxisInertia, elbow: float, wrist: float, q3: float) -> float:
    inverse = inertia.constant + inertia.elbow * elbow + inertia.wrist * wrist
    inverse += inertia.cosine * cos(q3) + inertia.sine * sin(q3)
    return min(inertia.most, 1 / inverse) if inverse > 0.0 else inertia.most


def _lengths(group: GroupConfig) -> tuple[float, float, float, float]:
    """Distance of axis 2 from axis 1, length of the upper arm, and from axis 3 to the wrist's
    centre the ways forward and up where all axes are at 0; m."""
    names = {joint.name: joint.axis for joint in group.joints}
    x = z = 0.0
    places = {}
    for link in group.chain:
        x, z = x + link.xyz[0], z + link.xyz[2]
        if link.joint:
            places[names[link.joint]] = x, z
    (x2, z2), (x3, z3), (x5, z5) = (places[axis] for axis in ("rax_2", "rax_3", "rax_5"))
    return x2, z3 - z2, x5 - x3, z5 - z3
