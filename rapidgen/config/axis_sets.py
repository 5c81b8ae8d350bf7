"""Check the axes of an arm: a known set, or all six with `held_axes`.

Sets: six robot axes; 1, 2, 3 and 6 of a palletiser (ABB PR10284EN_D: "no axes 4 and 5"); 1 to 4 of
a SCARA, whose axis 3 slides (IRB 910SC); six and eax_a, which sits between axes 2 and 3 of a YuMi
arm (libegm, yumipy). A missing axis would get a command value that no user gave.
"""

import math
from collections.abc import Iterator, Mapping
from itertools import pairwise

from rapidgen.config import model
from rapidgen.config.draft import DraftFindings, GroupDraft
from rapidgen.config.draft import Path as KeyPath

ROBOT_AXES = tuple(f"rax_{n}" for n in range(1, 7))
PALLETISER = frozenset({"rax_1", "rax_2", "rax_3", "rax_6"})
SCARA = frozenset({"rax_1", "rax_2", "rax_3", "rax_4"})


def resolve_held_axes(
    draft: GroupDraft, held: Mapping[str, float | None], path: KeyPath, report: DraftFindings
) -> tuple[model.KeptAxis, ...]:
    """Return the robot axes without a joint.

    RG021 and RG046 report a set that is not an arm.
    """
    where: KeyPath = (*path, "joints")
    axes = {joint.axis for joint in draft.joints}
    faulty = "" in axes or len(axes) < len(draft.joints)
    driven = axes & set(ROBOT_AXES)
    for axis in held:
        if axis in axes:
            name = next(j.name for j in draft.joints if j.axis == axis)
            report.error(
                "RG021",
                f"{axis} is kept and driven by joint '{name}'",
                (*path, "held_axes"),
                help="take it out of one of the two",
            )
        elif axis not in ROBOT_AXES:
            report.error(
                "RG021",
                f"{axis} cannot be kept: only axes of the robot",
                (*path, "held_axes"),
                help="take it out: without a joint an external axis is not moved",
            )
    missing = [axis for axis in ROBOT_AXES if axis not in driven]
    unkept = [axis for axis in _needed(draft, driven) if axis not in driven and axis not in held]
    if draft.coupling and {"rax_2", "rax_3"} & set(missing):
        report.error(
            "RG021",
            "axes 2 and 3 are coupled: both need a joint",
            where,
            "one of them has none",
            "with one of them kept, the other could not move",
            key=True,
        )
    if not faulty and draft.joints:
        if not driven:
            report.error(
                "RG021",
                f"group '{draft.name}' has no axis of a robot",
                where,
                "only external axes",
                "a positioner or track belongs to its robot's group: map it there to eax_a..eax_f",
                key=True,
            )
        elif unkept:
            displayed = ", ".join(unkept)
            report.error(
                "RG021",
                f"{displayed} of the arm {'has' if len(unkept) == 1 else 'have'} no joint",
                where,
                f"drives {', '.join(sorted(driven))}",
                "map a joint to each, or let the robot hold them where they stand when a "
                "trajectory is accepted"
                + ("" if any(held.values()) else f":\nheld_axes: [{', '.join([*held, *unkept])}]"),
                key=True,
            )
        elif len(draft.ignored) > len(missing):
            report.error(
                "RG021",
                f"ignored, and no axis is kept for it: {', '.join(draft.ignored)} of the arm",
                where,
                "a part of the arm that nothing drives",
                "map it (the seventh axis of a YuMi arm is eax_a), or make it fixed in the URDF",
                key=True,
            )
        for first, second, why in _disorder(draft):
            report.error(
                "RG046",
                f"{second} cannot come after {first} in the chain: {why}",
                where,
                help="give each joint the `axis:` that it drives on the robot",
            )
    return tuple(
        model.KeptAxis(
            axis,
            math.radians(held.get(axis) or 0.0),
            must_stand=held.get(axis) is not None,
        )
        for axis in missing
    )


def _needed(draft: GroupDraft, driven: set[str]) -> list[str]:
    """Return the axes of the robot that has these."""
    third = next((j for j in draft.joints if j.axis == "rax_3"), None)
    if third is not None and third.unit == "mm" and driven <= SCARA:
        return sorted(SCARA)
    if driven == PALLETISER and draft.coupling and not draft.ignored:
        return sorted(PALLETISER)
    return list(ROBOT_AXES)


def _disorder(draft: GroupDraft) -> Iterator[tuple[str, str, str]]:
    """Yield neighbouring joints in an order that no ABB robot has."""
    by_name = {joint.name: joint for joint in draft.joints}
    order = [by_name[step.joint] for step in draft.chain if step.joint in by_name]
    axes = [joint.axis for joint in order]
    robot = [axis for axis in axes if axis in ROBOT_AXES]
    for first, second in pairwise(robot):
        if first > second:
            yield first, second, "the axes of an arm follow one another"
    if not robot:
        return
    begin, end = axes.index(robot[0]), len(axes) - 1 - axes[::-1].index(robot[-1])
    for place in range(begin + 1, end):
        axis = axes[place]
        is_seventh = (
            axis == "eax_a"
            and (axes[place - 1], axes[place + 1]) == ("rax_2", "rax_3")
            and len(robot) == 6
            and order[place].unit != "mm"
        )
        if axis not in ROBOT_AXES and not is_seventh:
            why = "only eax_a of a seven-axis arm is part of it, between rax_2 and rax_3"
            yield axes[place - 1], axis, why
    if len(axes) > end + 1 and not draft.external_units and "eax_a" in axes[end + 1 :]:
        why = "an axis on the flange is a unit of its own; name it under `external_units`"
        yield axes[end], axes[end + 1], why
