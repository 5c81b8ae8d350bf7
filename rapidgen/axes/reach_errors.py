"""Explain why no posture reaches a pose: robot, place, limiting axis."""

import math
from itertools import islice

from rapidgen.axes.frames import Pose
from rapidgen.axes.kinematics import Kinematics, Posture
from rapidgen.axes.limits import ROUNDING

_LOOKED_AT = 8
"""Postures beyond the ranges that are compared; a search may find any number."""


def unreached(
    kinematics: Kinematics, flange: Pose, start: Posture, arm_angle: float | None = None
) -> tuple[bool, str]:
    """Return if a posture ignoring ranges reaches the pose, and a sentence.

    `arm_angle` (rad) is the requested one, of an arm with seven axes.
    """
    group = kinematics.group
    place = ", ".join(f"{v * 1000:.1f}" for v in flange[0])
    robot = group.model or group.name
    postures = list(islice(kinematics.beyond(flange, start), _LOOKED_AT))
    if not postures:
        return False, f"{robot}: the flange cannot be at [{place}] mm with this orientation"
    worst = []
    for posture in postures:
        over = [
            (max(joint.lower - value, value - joint.upper, 0.0), joint, value)
            for joint, value in zip(group.joints, posture, strict=True)
        ]
        worst.append(max(over, key=lambda one: one[0]))
    over_by, joint, value = min(worst, key=lambda one: one[0])
    if over_by <= ROUNDING:
        if arm_angle is None:
            but = "not from the posture that the robot is in"
        else:
            but = f"not with an arm angle (eax_a) of {math.degrees(arm_angle):.1f} deg"
        return True, f"{robot}: the flange can be at [{place}] mm within the axis ranges, but {but}"
    turns = joint.kind == "revolute"
    at, low, high = (
        math.degrees(v) if turns else v * 1000 for v in (value, joint.lower, joint.upper)
    )
    unit = "deg" if turns else "mm"
    text = f"{joint.axis} would be at {at:.1f} {unit}, its range is {low:g} to {high:g}"
    return True, f"{robot}: for the flange at [{place}] mm {text}"
