"""Compare a URDF with the known model: coupling by name, and ranges."""

import math
import re
from collections.abc import Iterator

from rapidgen.config.draft import GroupDraft, JointDraft
from rapidgen.config.urdf.robot import UrdfJoint, UrdfRobot
from rapidgen.diagnostics import Diagnostic, Severity, Span, error

COUPLED = frozenset({"2400", "4400", "6660", "260", "460", "660", "760"})
ODDLY = frozenset({"8700"})
"""Coupled in another sense, with a coupled range (RobotComponents issue 181): factor not known."""
SERIAL = frozenset(
    {"120", "140", "1100", "1200", "1300", "1600", "2600", "4600", "6640", "6650", "6700", "7600"}
)
_FAMILY = re.compile(r"[ic]rb[_ -]?(\d{3,5})", re.IGNORECASE)
_PALLETISER = {"rax_1", "rax_2", "rax_3", "rax_6"}
_CLOSE = 0.6
"""deg or mm"""


def family(*names: str) -> str:
    """Return the number of an ABB type in a name (model, robot, file)."""
    for name in names:
        hit = _FAMILY.search(name)
        if hit:
            return hit[1]
    return ""


def check_coupling(
    draft: GroupDraft, robot: UrdfRobot, file: str, place: Span | None
) -> Iterator[Diagnostic]:
    """Check that a lever robot has `coupling` and a serial one not (RG047)."""
    known = family(draft.model, robot.name, file)
    axes = {joint.axis for joint in draft.joints if joint.axis.startswith("rax_")}
    who = f"IRB {known}" if known in COUPLED else ""
    if not who and known not in SERIAL and axes == _PALLETISER:
        who = "a palletiser (axes 1, 2, 3 and 6)"
    if draft.coupling is None and known in ODDLY:
        yield error(
            "RG047",
            place,
            f"IRB {known} couples axes 2 and 3 in a special way; `coupling` is missing",
            "compare postures with the controller, and give the factor that you find",
        )
    elif draft.coupling is None and who:
        yield error(
            "RG047",
            place,
            f"{who} couples axes 2 and 3; `coupling` is not given",
            "add `coupling: 1` (controller axis 3 = joint_3 + joint_2), or 0 where the URDF "
            "already has ABB's sense",
        )
    elif draft.coupling and known in SERIAL:
        yield error(
            "RG047",
            place,
            f"IRB {known} is a serial robot, yet `coupling` is {draft.coupling:g}",
            "launch files of ROS-Industrial before 2025 were wrong for some models",
            severity=Severity.WARNING,
        )


def check_joint(draft: JointDraft, joint: UrdfJoint, group: GroupDraft) -> str:
    """Record the URDF's range; describe its difference from the model."""
    if joint.lower is None or joint.upper is None or joint.kind == "continuous":
        return ""
    factor = 1000.0 if joint.kind == "prismatic" else 180 / math.pi
    lower, upper = sorted(
        draft.sign * end * factor + draft.offset for end in (joint.lower, joint.upper)
    )
    draft.described = (lower, upper)
    known_lower = group.known.get((draft.axis, "lower"))
    known_upper = group.known.get((draft.axis, "upper"))
    if known_lower is None or known_upper is None:
        return ""
    if _near(lower, known_lower) and _near(upper, known_upper):
        return ""
    unit = "mm" if joint.kind == "prismatic" else "deg"
    return f"{joint.name} {lower:.4g}..{upper:.4g} (known {known_lower:g}..{known_upper:g} {unit})"


def differences(phrases: list[str], place: Span | None) -> Iterator[Diagnostic]:
    """Yield one warning for all ranges that differ from the model's (RG049)."""
    if phrases:
        yield error(
            "RG049",
            place,
            f"the URDF contradicts the known ranges: {'; '.join(phrases)}",
            "give the right ones with their `source:` under `joints:`",
            label="the configuration's figures are used",
            severity=Severity.WARNING,
        )


def _near(a: float, b: float) -> bool:
    return abs(a - b) <= _CLOSE
