"""Start position of an inferred robot.

With all axes at 0, most arms have their wrist in a singularity, where a real robot does not wait
for a program: the first MoveL would fail. The robot of a generated driver starts at 0, as its tests
expect. Every boot imports this module, so it is separate from the choice of a model.
"""

import math
from collections.abc import Mapping, Sequence

from rapidgen.axes.default_postures import usual_start
from rapidgen.axes.kinematics import Kinematics
from rapidgen.axes.mapping import JointMap
from rapidgen.config.model import GroupConfig
from rapidgen.diagnostics import refusal


def table_pose(group: GroupConfig) -> tuple[float, float, float]:
    """Return a reachable place for a table.

    It is below the flange of the usual start, at a third of the height. A model without geometry
    yields the origin.
    """
    kinematics = Kinematics.of(group)
    if kinematics is None:
        return (0.0, 0.0, 0.0)
    (x, y, z), _ = kinematics.forward(usual_start(group))
    return (x, y, z / 3)


def start_targets(group: GroupConfig) -> Mapping[str, str]:
    """Return the robot's start as RAPID robtarget and jointtarget.

    The robtarget is in world and flange. A model without geometry has none.
    """
    kinematics = Kinematics.of(group)
    if kinematics is None:
        return {}
    posture = usual_start(group)
    place, turn = kinematics.forward(posture)
    robax, extax = JointMap.of(group).to_rapid(posture)
    robtarget = (
        [round(1000 * value, 3) for value in place],
        [round(value, 6) for value in turn],
        list(kinematics.configuration(posture)),
        list(extax),
    )
    return {"robtarget": f"{list(robtarget)}", "jointtarget": f"{[list(robax), list(extax)]}"}


def start_of(group: GroupConfig, values: Sequence[float], where: str) -> tuple[float, ...]:
    """Return `values` (deg, mm) as a start posture.

    They are robot axes, then the external axes of the group. `where` names their source.
    DiagnosticError RG435: too few, too many, or outside the range.
    """
    joints = sorted(group.joints, key=lambda joint: joint.axis.replace("rax", "0"))
    names = ", ".join(joint.axis for joint in joints)
    if len(values) != len(joints):
        raise refusal(
            "RG435",
            None,
            f"{where} has {len(values)} values, {group.task} has {len(joints)} axes",
            f"one for each of {names}, deg or mm",
        )
    result = {}
    for joint, value in zip(joints, values, strict=True):
        turning = joint.kind == "revolute"
        result[joint.axis] = math.radians(value) if turning else value / 1000
        if not joint.lower - 1e-9 <= result[joint.axis] <= joint.upper + 1e-9:
            low, high = (
                f"{math.degrees(b) if turning else b * 1000:g}" for b in (joint.lower, joint.upper)
            )
            raise refusal(
                "RG435",
                None,
                f"{where}: {joint.axis} at {value:g} is outside of {low} to {high}",
                f"the limits are those of {group.model or group.name}",
            )
    return tuple(result[joint.axis] for joint in group.joints)


def shown(group: GroupConfig, posture: Sequence[float]) -> str:
    """Return a posture in RAPID's format, deg and mm.

    Example: `[0,0,0,0,30,0]`, followed by external axes.
    """
    robax, extax = JointMap.of(group).to_rapid(posture)
    there = [f"{value:g}" for value in extax if value < 1e9]
    return f"[{','.join(f'{v:g}' for v in robax)}]" + (f" [{','.join(there)}]" if there else "")
