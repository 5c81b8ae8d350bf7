"""Joints of a group in SI units, with their errors and warnings."""

import math

from rapidgen.config import model, schema
from rapidgen.config.accelerations import usual_time
from rapidgen.config.draft import DraftFindings, GroupDraft, JointDraft
from rapidgen.config.draft import Path as KeyPath
from rapidgen.config.plausibility import axis_doubts, inertia_doubt, length_of
from rapidgen.diagnostics import Severity

MAX_JOINTS = 10
"""Maximum number of joints in a simple_message message."""


def joints_of(
    keys: schema.GroupKeys, draft: GroupDraft, path: KeyPath, report: DraftFindings
) -> tuple[model.Joint, ...]:
    """Return the valid joints; report the others.

    Codes: RG007, RG013, RG014 and RG037.
    """
    where: KeyPath = (*path, "joints")
    if not draft.joints:
        report.error(
            "RG013",
            f"group '{draft.name}' has no joints",
            where,
            help="give `model:` (see `rapidgen robots`), `urdf:` or `joints:`",
        )
    elif len(draft.joints) > MAX_JOINTS:
        report.error(
            "RG013",
            f"group '{draft.name}' has {len(draft.joints)} joints; the wire carries {MAX_JOINTS}",
            where,
            help="a message of simple_message holds 10 joint values: make two groups",
        )
    in_radians = _check_radians(draft, where, report)
    seen: dict[str, str] = {}
    length = length_of(draft.chain)
    joints = []
    for joint in draft.joints:
        current: KeyPath = (*where, joint.name)
        if joint.axis in seen:
            report.error(
                "RG013",
                f"joints '{seen[joint.axis]}' and '{joint.name}' both drive {joint.axis}",
                (*current, "axis"),
                "second time",
                "one joint drives an axis: give the other the `axis:` that it drives",
            )
        if joint.axis:
            seen.setdefault(joint.axis, joint.name)
        for key, message, help in axis_doubts(joint):
            if key == "upper" and joint.unit != "mm" and in_radians:
                continue  # said once for the group
            # A wrong acceleration makes every simulated duration wrong, without a sign of it.
            severity = Severity.ERROR if "celeration" in key else Severity.WARNING
            report.add("RG071", severity, message, (*current, key), help=help)
        _settle_acceleration(joint, draft, current, report)
        time = joint.acceleration_time or keys.acceleration_time or usual_time(joint.axis, length)
        made = _joint(joint, time, current, report)
        if made:
            joints.append(made)
    return tuple(joints)


def _settle_acceleration(
    joint: JointDraft, draft: GroupDraft, path: KeyPath, report: DraftFindings
) -> None:
    """Let a time replace the model's acceleration; both given by the user exclude each other."""
    if joint.acceleration_time is None or joint.acceleration is None:
        return
    if joint.acceleration != draft.known.get((joint.axis, "acceleration")):
        report.error(
            "RG006",
            f"joint '{joint.name}' has both acceleration and acceleration_time",
            (*path, "acceleration_time"),
            help=f"{joint.acceleration:g} {joint.unit or 'deg'}/s², or "
            f"{joint.acceleration_time:g} s to full speed: remove one of them",
        )
    joint.acceleration = None


def _check_radians(draft: GroupDraft, path: KeyPath, report: DraftFindings) -> bool:
    """Report four or more turning axes within 7: radians, not degrees; return whether."""
    turning = [joint for joint in draft.joints if joint.unit != "mm"]
    ends = [end for joint in turning for end in (joint.lower, joint.upper) if end is not None]
    is_odd = len(turning) >= 4 and len(ends) == 2 * len(turning) and max(map(abs, ends)) <= 7
    if is_odd:
        report.add(
            "RG037",
            Severity.WARNING,
            f"no axis of group '{draft.name}' turns more than {max(map(abs, ends)):g} degrees",
            path,
            "radians?",
            "a configuration has degrees, as ABB's data sheets",
            key=True,
        )
    return is_odd


def _joint(
    draft: JointDraft, ramp: float, path: KeyPath, report: DraftFindings
) -> model.Joint | None:
    missing = [
        name
        for name in ("axis", "lower", "upper", "speed")
        if getattr(draft, name) in (None, "") and not report.is_faulty((*path, name))
    ]
    if missing:
        unit = "mm" if draft.unit == "mm" else "deg"
        hints = {
            "axis": "`axis:` is rax_1 to rax_6 or eax_a to eax_f",
            "lower": f"limits are in {unit}",
            "upper": f"limits are in {unit}",
            "speed": f"`speed:` is in {unit}/s",
        }
        report.error(
            "RG007",
            f"joint '{draft.name}' lacks {', '.join(missing)}",
            path,
            "here",
            "; ".join(dict.fromkeys(hints[name] for name in missing)),
            key=True,
        )
    if draft.lower is None or draft.upper is None or draft.speed is None:
        return None
    if draft.lower >= draft.upper:
        report.error(
            "RG014",
            f"joint '{draft.name}': lower limit {draft.lower:g} is not below the upper limit "
            f"{draft.upper:g}",
            (*path, "upper"),
            help="the range goes from `lower:` to `upper:`, both from the robot's data sheet"
            + ("; the one that is not given here is the URDF's" if draft.described else ""),
        )
        return None
    lower, upper = inwards(draft.lower, draft.upper)
    factor = 0.001 if draft.unit == "mm" else math.pi / 180
    acceleration = draft.acceleration if draft.acceleration else draft.speed / ramp
    return model.Joint(
        name=draft.name,
        axis=draft.axis,
        kind="prismatic" if draft.unit == "mm" else "revolute",
        lower=_si(lower, draft.unit),
        upper=_si(upper, draft.unit),
        speed=_si(draft.speed, draft.unit),
        acceleration=acceleration * factor,
        sign=draft.sign,
        offset=_si(draft.offset, draft.unit),
        source=draft.source,
        unsure=bool(draft.unsure),
        brake_deceleration=draft.brake_deceleration * factor,
        stop_deceleration=draft.stop_deceleration * factor,
    )


def _si(value: float, unit: str) -> float:
    return value / 1000 if unit == "mm" else math.radians(value)


def inwards(lower: float, upper: float) -> tuple[float, float]:
    """Return limits rounded inwards to 0.01 (deg or mm).

    Noise below 1e-6 is ignored.
    """
    return math.ceil(lower * 100 - 1e-4) / 100, math.floor(upper * 100 + 1e-4) / 100


def inertias_of(
    keys: schema.GroupKeys, draft: GroupDraft, report: DraftFindings
) -> tuple[model.AxisInertia, ...]:
    """Return how accelerations depend on the posture, in SI units.

    An axis with another acceleration than its model's has that one in every posture.
    """
    speeds = {joint.axis: joint.speed for joint in draft.joints}
    for axis, given in keys.inertias.items():
        reason = inertia_doubt(given.most, speeds.get(axis) or 0.0)
        if reason:
            where: KeyPath = ("groups", draft.name, "inertias", axis, "most")
            report.add("RG071", Severity.ERROR, reason, where, help="the unit is deg/s²")
    own = {
        joint.axis: 0.0 if joint.acceleration_time else joint.acceleration for joint in draft.joints
    }
    return tuple(
        model.AxisInertia(
            axis,
            math.radians(given.most),
            given.constant,
            given.elbow,
            given.wrist,
            given.cosine,
            given.sine,
        )
        for axis, given in sorted(keys.inertias.items())
        if own.get(axis) == draft.known.get((axis, "acceleration"), own.get(axis))
    )
