"""Limits and speeds of URDF joints as controller figures, and the figures that cannot be."""

import math

from rapidgen.config.draft import JointDraft
from rapidgen.config.urdf.robot import UrdfJoint
from rapidgen.diagnostics import Diagnostic, Severity, Span, error

DEGREES_AS_RADIANS = 10.0
"""rad: no axis of a robot turns further (the widest known has 460 degrees = 8.03 rad)."""
FAST_TURN = 45.0
"""rad/s: above the fastest known axis (a SCARA's, 2400 deg/s = 41.9 rad/s)."""
PLACEHOLDER_SPEED = 50.0
LONG = 100.0
INDEPENDENT = 18000.0
"""deg: range given to a continuous external axis, which a warning says."""
SHORT = 0.001
LOOKS_LIKE_MM = 50.0
_ROUNDING = 0.15


def fill(draft: JointDraft, joint: UrdfJoint, place: Span | None) -> list[Diagnostic]:
    """Complete `draft` from the URDF where the configuration says nothing; findings."""
    span = joint.span or place
    found: list[Diagnostic] = []
    linear = joint.kind == "prismatic"
    unit = "mm" if linear else "deg"
    if draft.unit not in ("", unit):
        text = f"joint '{joint.name}' is {joint.kind}, yet its unit is {draft.unit}"
        return [error("RG041", span, text, f"set joints.{joint.name}.unit: {unit}")]
    draft.unit = unit
    needs_range = draft.lower is None or draft.upper is None
    if joint.kind == "continuous" and needs_range:
        found.append(_continuous(draft, span))
    elif needs_range:
        found += _range(draft, joint, span)
    if draft.speed is None:
        found += _speed(draft, joint, span)
    if linear and needs_range and not found:
        found.append(
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
    return found


def _continuous(draft: JointDraft, span: Span | None) -> Diagnostic:
    name, axis = draft.name, draft.axis
    if axis.startswith("eax"):
        draft.lower, draft.upper = -INDEPENDENT, INDEPENDENT
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
        f"add the range of the axis:\njoints:\n  {name}: "
        f"{{axis: {axis or 'eax_a'}, lower: -180, upper: 180, speed: 90}}",
        label="turns without end",
    )


def _range(draft: JointDraft, joint: UrdfJoint, span: Span | None) -> list[Diagnostic]:
    name, lower, upper = joint.name, joint.lower, joint.upper
    linear = joint.kind == "prismatic"
    if lower is None or upper is None:
        return [
            error(
                "RG038",
                span,
                f"joint '{name}' has no limits",
                f"add\njoints:\n  {name}: {{axis: {draft.axis}, lower: ..., upper: ...}}",
            )
        ]
    if lower > upper:
        return [error("RG053", span, f"joint '{name}': lower {lower:g} is above upper {upper:g}")]
    if lower == upper:
        return [
            error(
                "RG039",
                span,
                f"joint '{name}' has the range {lower:g}..{upper:g}",
                f"add its range under joints.{name}, or name it under urdf.ignore_joints",
                label="a placeholder",
            )
        ]
    found: list[Diagnostic] = []
    widest = max(abs(lower), abs(upper))
    if not linear and widest > DEGREES_AS_RADIANS:
        return [
            error(
                "RG037",
                span,
                f"joint '{name}': limit {widest:g} rad looks like degrees",
                "a URDF has radians",
                label=f"{math.degrees(widest):,.0f} deg",
            )
        ]
    if linear and widest > LONG:
        return [error("RG041", span, f"joint '{name}': {widest:g} m is no stroke; are these mm?")]
    if linear and upper - lower < SHORT:
        return [error("RG041", span, f"joint '{name}': a stroke of {upper - lower:g} m is no axis")]
    if linear and upper - lower > LOOKS_LIKE_MM:
        found.append(
            error(
                "RG041",
                span,
                f"joint '{name}': a stroke of {upper - lower:g} m; are these mm?",
                severity=Severity.WARNING,
            )
        )
    factor = 1000.0 if linear else 180 / math.pi
    ends = sorted(draft.sign * end * factor + draft.offset for end in (lower, upper))
    draft.lower, draft.upper = ends
    found += _rounded(draft, span)
    return found


def _rounded(draft: JointDraft, span: Span | None) -> list[Diagnostic]:
    """3.1416 rad is 180.0004 deg: a limit that someone rounded outwards."""
    if draft.unit == "mm" or draft.lower is None or draft.upper is None:
        return []
    lower, upper = draft.lower, draft.upper
    ends = []
    if 0.0001 < upper - round(upper) < _ROUNDING:
        draft.upper = float(round(upper))
        ends.append(f"{upper:.4f} to {draft.upper:g}")
    if 0.0001 < round(lower) - lower < _ROUNDING:
        draft.lower = float(round(lower))
        ends.append(f"{lower:.4f} to {draft.lower:g}")
    if not ends:
        return []
    return [
        error(
            "RG054",
            span,
            f"joint '{draft.name}': limits rounded inwards, {' and '.join(ends)} deg",
            severity=Severity.INFO,
        )
    ]


def _speed(draft: JointDraft, joint: UrdfJoint, span: Span | None) -> list[Diagnostic]:
    name, velocity = joint.name, joint.velocity
    if velocity is None:
        return [
            error(
                "RG038",
                span,
                f"joint '{name}' has no velocity",
                f"add joints.{name}.speed, from the robot's data sheet",
            )
        ]
    if velocity <= 0:
        return [
            error(
                "RG039",
                span,
                f"joint '{name}' has the velocity {velocity:g}",
                f"add joints.{name}.speed, from the robot's data sheet",
                label="a placeholder",
            )
        ]
    linear = joint.kind == "prismatic"
    draft.speed = velocity * 1000 if linear else math.degrees(velocity)
    if velocity >= PLACEHOLDER_SPEED:
        draft.unsure = (*draft.unsure, "speed")
        return [
            error(
                "RG039",
                span,
                f"joint '{name}': {velocity:g} {'m/s' if linear else 'rad/s'} looks like a "
                "placeholder",
                f"add joints.{name}.speed, from the robot's data sheet",
                severity=Severity.WARNING,
            )
        ]
    if not linear and velocity > FAST_TURN:
        draft.unsure = (*draft.unsure, "speed")
        return [
            error(
                "RG037",
                span,
                f"joint '{name}': {velocity:g} rad/s looks like degrees per second",
                severity=Severity.WARNING,
            )
        ]
    return []
