"""Convert URDF limits and speeds to controller figures, with checks."""

import math
from collections.abc import Iterator

from rapidgen.config.draft import JointDraft
from rapidgen.config.placeholders import OPEN
from rapidgen.config.urdf.robot import UrdfJoint
from rapidgen.config.yaml_text import yaml_text
from rapidgen.diagnostics import Diagnostic, Severity, Span, error

DEGREES_AS_RADIANS = 10.0
"""rad: no axis of a robot turns further (the widest known has 460 degrees = 8.03 rad)."""
FAST_TURN = 45.0
"""rad/s: above the fastest known axis (a SCARA's, 2400 deg/s = 41.9 rad/s)."""
PLACEHOLDER_SPEED = 50.0
LONG = 100.0
INDEPENDENT = 18000.0
"""deg: range of a continuous external axis; a warning reports it."""
SHORT = 0.001
LOOKS_LIKE_MM = 50.0
_ROUNDING = 0.15


def fill(draft: JointDraft, joint: UrdfJoint, place: Span | None) -> list[Diagnostic]:
    """Complete `draft` from the URDF; return findings."""
    span = joint.span or place
    findings: list[Diagnostic] = []
    linear = joint.kind == "prismatic"
    unit = "mm" if linear else "deg"
    if draft.unit not in ("", unit):
        text = f"joint '{joint.name}' is {joint.kind}, yet its unit is {draft.unit}"
        return [error("RG041", span, text, f"set joints.{joint.name}.unit: {unit}")]
    draft.unit = unit
    needs_range = draft.lower is None or draft.upper is None
    if joint.kind == "continuous" and needs_range:
        findings.append(_continuous(draft, joint, span))
    elif needs_range:
        findings += _range(draft, joint, span)
    if draft.speed is None:
        findings += _speed(draft, joint, span)
    if linear and needs_range and not findings:
        findings.append(
            error(
                "RG041",
                span,
                f"'{joint.name}' is linear: metres of the URDF become mm "
                f"({draft.lower:g}..{draft.upper:g} mm)",
                severity=Severity.INFO,
            )
        )
    if needs_range:
        draft.source = draft.source or "URDF"
    return findings


def _open(draft: JointDraft, joint: UrdfJoint, *, of_range: bool = True) -> str:
    """Return placeholder lines for a joint's range, and for its speed.

    The speed is included if the description has none.
    """
    figures = {} if draft.axis else {"axis": OPEN}
    if of_range:
        figures |= {"lower": OPEN, "upper": OPEN}
    if draft.speed is None and not (joint.velocity or 0.0) > 0.0:
        figures["speed"] = OPEN
    displayed = ", ".join(f"{key}: {value}" for key, value in figures.items())
    return f"joints:\n  {yaml_text(joint.name)}: {{{displayed}}}"


def _continuous(draft: JointDraft, joint: UrdfJoint, span: Span | None) -> Diagnostic:
    name, axis = draft.name, draft.axis
    if axis.startswith("eax"):
        own = draft.lower, draft.upper
        draft.lower, draft.upper = -INDEPENDENT, INDEPENDENT
        _keep(draft, *own)
        draft.unsure = (*draft.unsure, "lower", "upper")
        return error(
            "RG040",
            span,
            f"joint '{name}' is continuous; taken as an independent axis of "
            f"{INDEPENDENT / 360:g} turns to each side",
            f"add the range that the controller has for {axis} under joints.{name}",
            label="turns without end",
            severity=Severity.WARNING,
        )
    return error(
        "RG040",
        span,
        f"joint '{name}' is continuous; {axis or 'a controller axis'} has limits",
        f"add the range of the axis from the robot's data sheet:\n{_open(draft, joint)}",
        label="turns without end",
    )


def _range(draft: JointDraft, joint: UrdfJoint, span: Span | None) -> Iterator[Diagnostic]:
    name, lower, upper = joint.name, joint.lower, joint.upper
    linear = joint.kind == "prismatic"
    widest = max(abs(lower or 0.0), abs(upper or 0.0))
    if lower is None or upper is None:
        help = f"add, from the robot's data sheet\n{_open(draft, joint)}"
        yield error("RG038", span, f"joint '{name}' has no limits", help)
    elif lower > upper:
        message = f"joint '{name}': lower {lower:g} is above upper {upper:g}"
        help = f"swap the two in the description, or add the range\n{_open(draft, joint)}"
        yield error("RG053", span, message, help)
    elif lower == upper:
        yield error(
            "RG039",
            span,
            f"joint '{name}' has the range {lower:g}..{upper:g}",
            f"name it under urdf.ignore_joints, or add its range\n{_open(draft, joint)}",
            label="a placeholder",
        )
    elif not linear and widest > DEGREES_AS_RADIANS:
        yield error(
            "RG037",
            span,
            f"joint '{name}': limit {widest:g} rad looks like degrees",
            "a URDF has radians",
            label=f"{math.degrees(widest):,.0f} deg",
        )
    elif linear and widest > LONG:
        message = f"joint '{name}': {widest:g} m is no stroke; are these mm?"
        yield error("RG041", span, message, "a URDF has metres")
    elif linear and upper - lower < SHORT:
        message = f"joint '{name}': a stroke of {upper - lower:g} m is no axis"
        help = f"name it under urdf.ignore_joints, or add its range\n{_open(draft, joint)}"
        yield error("RG041", span, message, help)
    else:
        if linear and upper - lower > LOOKS_LIKE_MM:
            message = f"joint '{name}': a stroke of {upper - lower:g} m; are these mm?"
            yield error("RG041", span, message, severity=Severity.WARNING)
        factor = 1000.0 if linear else 180 / math.pi
        ends = sorted(draft.sign * end * factor + draft.offset for end in (lower, upper))
        own = draft.lower, draft.upper
        draft.lower, draft.upper = ends
        yield from _rounded(draft, span)
        _keep(draft, *own)


def _keep(draft: JointDraft, lower: float | None, upper: float | None) -> None:
    """Keep the configured end of a range; the URDF gives the other one."""
    draft.lower = draft.lower if lower is None else lower
    draft.upper = draft.upper if upper is None else upper


def _rounded(draft: JointDraft, span: Span | None) -> Iterator[Diagnostic]:
    """Report a limit that was rounded outwards: 3.1416 rad is 180.0004 deg."""
    if draft.unit == "mm" or draft.lower is None or draft.upper is None:
        return
    lower, upper = draft.lower, draft.upper
    ends = []
    if 0.0001 < upper - round(upper) < _ROUNDING:
        draft.upper = float(round(upper))
        ends.append(f"{upper:.4f} to {draft.upper:g}")
    if 0.0001 < round(lower) - lower < _ROUNDING:
        draft.lower = float(round(lower))
        ends.append(f"{lower:.4f} to {draft.lower:g}")
    if ends:
        message = f"joint '{draft.name}': limits rounded inwards, {' and '.join(ends)} deg"
        yield error("RG054", span, message, severity=Severity.INFO)


def _speed(draft: JointDraft, joint: UrdfJoint, span: Span | None) -> Iterator[Diagnostic]:
    name, velocity = joint.name, joint.velocity
    linear = joint.kind == "prismatic"
    help = f"add joints.{name}.speed, from the robot's data sheet"
    if velocity is None or velocity <= 0:
        help = f"add, from the robot's data sheet\n{_open(draft, joint, of_range=False)}"
    if velocity is None:
        yield error("RG038", span, f"joint '{name}' has no velocity", help)
        return
    if velocity <= 0:
        message = f"joint '{name}' has the velocity {velocity:g}"
        yield error("RG039", span, message, help, label="a placeholder")
        return
    draft.speed = velocity * 1000 if linear else math.degrees(velocity)
    if velocity >= PLACEHOLDER_SPEED:
        draft.unsure = (*draft.unsure, "speed")
        unit = "m/s" if linear else "rad/s"
        message = f"joint '{name}': {velocity:g} {unit} looks like a placeholder"
        yield error("RG039", span, message, help, severity=Severity.WARNING)
    elif not linear and velocity > FAST_TURN:
        draft.unsure = (*draft.unsure, "speed")
        message = f"joint '{name}': {velocity:g} rad/s looks like degrees per second"
        yield error("RG037", span, message, severity=Severity.WARNING)
