"""Default start postures of models."""

import math
import re

from rapidgen.config.model import GroupConfig

# Model (first that fits) and its RAPID axis values. IRB 14000: the calibration position of its
# arms, `MoveAbsJ [[0,-130,30,0,40,0],[135,...]]`, `-135` on the right (public programs of eight
# cells). Arms with a wrist: `[[0,0,0,0,30,0],...]`, the start of RobotStudio stations, which their
# programs call home (public programs). Four axes have no such singularity.
_STARTS = (
    (re.compile(r"irb140[05]0"), {"rax_2": -130.0, "rax_3": 30.0, "rax_5": 40.0, "eax_a": 135.0}),
    (re.compile(r""), {"rax_5": 30.0}),
)
_RIGHT = re.compile(r"(^|_)r(ight)?(_|$)", re.I)


def usual_start(group: GroupConfig) -> tuple[float, ...]:
    """Return a model's usual start, within its limits.

    Controller axes, rad and m, wire order.
    """
    values = next(values for model, values in _STARTS if model.match(group.model))
    wrist = {joint.axis for joint in group.joints} >= {"rax_4", "rax_5", "rax_6"}
    degrees = dict(values) if wrist else {}
    if "eax_a" in degrees and (_RIGHT.search(group.name) or _RIGHT.search(group.mechanical_unit)):
        degrees["eax_a"] *= -1
    return tuple(
        min(max(math.radians(degrees.get(joint.axis, 0.0)), joint.lower), joint.upper)
        for joint in group.joints
    )
