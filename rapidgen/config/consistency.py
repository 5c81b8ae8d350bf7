"""Compare a group with its arm: coupling, senses, dimensions, ranges.

All inputs use one check: a shipped model with keys over it, a URDF, axes written by hand. An arm
without a `model:` is recognised by its axes in space.
"""

import json
import math
import re
from collections.abc import Iterator
from typing import TypeAlias

from rapidgen.config import variant_model
from rapidgen.config.draft import DraftFindings, GroupDraft, JointDraft
from rapidgen.config.draft import Path as KeyPath
from rapidgen.config.geometry import ArmAxes, Difference, compare, skeleton
from rapidgen.config.variant_library import (
    SAME_PLACE,
    SAME_TURN,
    KnownAxis,
    Variant,
    family,
    of_model,
    recognise,
)
from rapidgen.diagnostics import Severity

Range: TypeAlias = tuple[float | None, float | None]
_CLOSE = 0.6
"""deg or mm by which sources round a range"""
_FASTER = 1.01
_SHORTEST_ARM = 0.05
"""m; the shortest arm of ABB reaches 0.37 (IRB 1010)"""
_LONGEST_LINK, _LONGEST_ARM, _FARTHEST_BASE = 5.0, 10.0, 1000.0
"""m; the longest arm of ABB reaches 4.2 (IRB 8700)"""
_SAME_END = 0.005
"""m between flanges of one variant in its sources."""


def contradictions(
    draft: GroupDraft, path: KeyPath, names: tuple[str, ...], report: DraftFindings
) -> None:
    """Report contradictions of a group (RG047, RG048, RG049, RG055).

    `names` may contain the family.
    """
    if any(not joint.axis for joint in draft.joints):
        return
    _lengths(draft, path, report)
    arm = _arm(draft)
    model = draft.model
    variant = (of_model(model, draft.name) or variant_model.named(model)) if model else None
    difference, is_named = None, True
    if variant and arm:
        difference = compare(arm, variant.skeleton)
    elif arm:
        match = recognise(arm, *names)
        own = family(*names)
        if match:
            variant, difference = match.variant, match.difference
            # Another type may have the same dimensions, but its own ranges, speeds and rods.
            is_named = not own or own == variant.family
    if variant is None:
        for joint in draft.joints:
            _against_urdf(draft, joint, path, report)
        return
    for axis in difference.turned if difference else ():
        _turned(draft, axis, variant, path, report)
    if difference:
        _dimensions(difference, variant, path, report)
    if not is_named:
        return
    if not draft.max_payload:
        draft.max_payload = variant.max_payload
        draft.arm = variant.name
    _coupling(draft, variant, path, report)
    if not (difference and difference.turned):
        for joint in draft.joints:
            known = variant.axis(joint.axis)
            if known:
                _figures(joint, known, variant, draft, path, report)


def _lengths(draft: GroupDraft, path: KeyPath, report: DraftFindings) -> None:
    """Report links that are too long (RG062): mm instead of m."""
    robot = {joint.name for joint in draft.joints if joint.axis.startswith("rax")}
    inside, total = False, 0.0
    for number, step in enumerate(draft.chain):
        length = math.dist(step.xyz, (0.0, 0.0, 0.0))
        most = _LONGEST_LINK if inside else _FARTHEST_BASE
        total += length if inside else 0.0
        if not length <= most or not total <= _LONGEST_ARM:
            where = f"'{step.joint}'" if step.joint else f"step {number + 1}"
            at: KeyPath = (*path, "urdf", "file") if draft.urdf_chain else (*path, "chain", number)
            report.error(
                "RG062",
                f"the chain is {length:.4g} m long before {where}"
                if not length <= most
                else f"the arm is {total:.4g} m long as far as {where}",
                at,
                "no robot is",
                "lengths are m in a URDF and mm in a configuration",
            )
            return
        inside = inside or step.joint in robot
    if len(robot) > 2 and 0 < total < _SHORTEST_ARM:
        report.error(
            "RG062",
            f"the arm is {total * 1000:.4g} mm long",
            (*path, "urdf", "file") if draft.urdf_chain else (*path, "chain"),
            "no robot is",
            "lengths are m in a URDF and mm in a configuration",
        )


def _arm(draft: GroupDraft) -> ArmAxes | None:
    chain = draft.urdf_chain or draft.chain
    moved = {step.joint for step in chain if step.joint} | {n for s in chain for n, _ in s.follows}
    if not chain or moved - {joint.name for joint in draft.joints}:
        return None
    arm = skeleton(draft, chain)
    return arm if len(arm.lines) > 1 else None


def _named(draft: GroupDraft, axis: str) -> JointDraft:
    return next(joint for joint in draft.joints if joint.axis == axis)


def _turned(
    draft: GroupDraft, axis: str, variant: Variant, path: KeyPath, report: DraftFindings
) -> None:
    joint = _named(draft, axis)
    report.error(
        "RG048",
        f"joint '{joint.name}' with sign {joint.sign} turns {axis} against {variant.name}",
        (*path, "joints", joint.name, "sign"),
        "turns the other way",
        _lines(draft, joint, f"sign: {-joint.sign}"),
    )


def _dimensions(
    difference: Difference, variant: Variant, path: KeyPath, report: DraftFindings
) -> None:
    far, wide = difference.distance > SAME_PLACE, difference.angle > SAME_TURN
    if far or wide:
        off = [f"{difference.distance * 1000:.1f} mm"] if far else []
        off += [f"{math.degrees(difference.angle):.1f} deg"] if wide else []
        report.error(
            "RG055",
            f"these are not the dimensions of {variant.name}: with every axis at 0 one axis is "
            f"{' and '.join(off)} off, {difference.axis} most; "
            f"the flange {difference.end * 1000:.0f} mm",
            (*path, "model"),
            "another variant?",
            "take the model of your variant (`rapidgen robots`), or leave `model:` out and keep "
            "the URDF's dimensions; an `offset` moves an axis' zero",
        )
    elif difference.end > _SAME_END or difference.facing > SAME_TURN:
        off = [f"{difference.end * 1000:.0f} mm"] if difference.end > _SAME_END else []
        turned = math.degrees(difference.facing)
        off += [f"turned by {turned:.0f} deg"] if difference.facing > SAME_TURN else []
        report.add(
            "RG055",
            Severity.WARNING,
            f"the axes are those of {variant.name}, the end is {' and '.join(off)} from its flange",
            (*path, "model"),
            "",
            "poses are those of the chain's end: a `tip:` at the flange (tool0) has ABB's",
        )


def _coupling(draft: GroupDraft, variant: Variant, path: KeyPath, report: DraftFindings) -> None:
    if variant.coupling is None or draft.coupling == variant.coupling:
        return
    if draft.coupling is None:
        if variant.coupling and not any(d.code == "RG047" for d in report.found):
            report.error(
                "RG047",
                f"{variant.name} couples axes 2 and 3; `coupling` is not given",
                path,
                help=f"coupling: {variant.coupling:g}",
            )
        return
    own = not draft.model and not draft.coupling  # a URDF may have ABB's sense already
    report.add(
        "RG047",
        Severity.WARNING if own or "coupling" in variant.unsure else Severity.ERROR,
        f"{variant.name} has the coupling {variant.coupling:g}; here it is {draft.coupling:g}",
        (*path, "coupling"),
        "",
        f"coupling: {variant.coupling:g}",
    )


def _figures(
    joint: JointDraft,
    known: KnownAxis,
    variant: Variant,
    draft: GroupDraft,
    path: KeyPath,
    report: DraftFindings,
) -> None:
    current: KeyPath = (*path, "joints", joint.name)
    unit = "mm" if joint.unit == "mm" else "deg"
    lower, upper = joint.lower, joint.upper
    span = (known.lower, known.upper)
    if is_mirror((lower, upper), span):
        report.error(
            "RG048",
            f"joint '{joint.name}': {lower:g}..{upper:g} {unit} is the mirror of the range of "
            f"{variant.name}, {known.lower:g}..{known.upper:g} {unit}",
            current,
            "mirrored",
            f"its axis turns as {variant.name}'s does, so the range is wrong:\n"
            + _lines(draft, joint, f"lower: {known.lower:g}, upper: {known.upper:g}"),
        )
        return
    if draft.model:
        return  # reported where a key exceeds the model's
    wider = list(_wider(joint, known, unit))
    if wider:
        report.add(
            "RG049",
            Severity.WARNING,
            f"joint '{joint.name}' is beyond what is known of {variant.name}: {'; '.join(wider)}",
            current,
            "",
            "keep it only if the data sheet of your robot says so, and give `source:`",
        )


def _wider(joint: JointDraft, known: KnownAxis, unit: str) -> Iterator[str]:
    if joint.lower is not None and known.lower is not None and joint.lower < known.lower - _CLOSE:
        yield f"lower {joint.lower:.4g} {unit}, known {known.lower:g}"
    if joint.upper is not None and known.upper is not None and joint.upper > known.upper + _CLOSE:
        yield f"upper {joint.upper:.4g} {unit}, known {known.upper:g}"
    if joint.speed and known.speed and joint.speed > known.speed * _FASTER:
        yield f"speed {joint.speed:.4g} {unit}/s, known {known.speed:g}"


def _lines(draft: GroupDraft, changed: JointDraft, figures: str) -> str:
    """Return all joint lines, with other figures for one of them."""
    lines = ["joints:"]
    for joint in draft.joints:
        sign = f", sign: {joint.sign}" if joint.sign < 0 and joint is not changed else ""
        unit = ", unit: mm" if joint.unit == "mm" else ""
        more = f", {figures}" if joint is changed else ""
        name = joint.name if re.fullmatch(r"\w+", joint.name) else json.dumps(joint.name)
        lines.append(f"  {name}: {{axis: {joint.axis}{unit}{sign}{more}}}")
    return "\n".join(lines)


def _against_urdf(
    draft: GroupDraft, joint: JointDraft, path: KeyPath, report: DraftFindings
) -> None:
    """Report a range that mirrors the URDF's, of an unknown arm."""
    if joint.described and is_mirror((joint.lower, joint.upper), joint.described):
        lower, upper = joint.described
        report.error(
            "RG048",
            f"joint '{joint.name}': {joint.lower:g}..{joint.upper:g} is the mirror of the URDF's "
            f"range, {lower:.4g}..{upper:.4g}",
            (*path, "joints", joint.name),
            "one of the two turns the other way",
            _lines(
                draft,
                joint,
                f"sign: {-joint.sign}, lower: {joint.lower:g}, upper: {joint.upper:g}",
            ),
        )


def is_mirror(own: Range, of: Range) -> bool:
    """True if a range is another one mirrored."""
    (lower, upper), (low, high) = own, of
    if lower is None or upper is None or low is None or high is None:
        return False
    same = _near(lower, low) and _near(upper, high)
    return not same and _near(lower, -high) and _near(upper, -low)


def _near(a: float, b: float) -> bool:
    return abs(a - b) <= _CLOSE
