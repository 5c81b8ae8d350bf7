"""Create a motion group from the library, for an arm without a model.

The result is good enough to run programs, if a backup names the type. A driver needs a
configuration file of the robot that gives every figure with its source (`rapidgen new`).
"""

import math
import re
from dataclasses import replace
from itertools import pairwise

from rapidgen.config.accelerations import usual_time
from rapidgen.config.geometry import compare
from rapidgen.config.model import ChainLink, GroupConfig, Joint, Ports
from rapidgen.config.variant_library import SAME_PLACE, SAME_TURN, KnownAxis, Variant, variants

_TYPE = re.compile(
    r"ROB_?[A-Z0-9]+?_(\d{2,5}[A-Z]{0,3})(?:_[A-Z]+)?(?:_(?:(\d+)[._](\d+)_)?(\d+))?", re.I
)
"""-use_robot_type of MOC.cfg: ROB1_4600_2.55_40, ROB1_910SC_0.55_3, ROB1_15000_0_95_5; without a
reach, ROB1_660_250."""
_NAME = re.compile(r"[IC]RB (\w+)-([\d.]+)/([\d.]+)")
ASSUMED_SPEED = 100.0
"""deg/s of an axis without a source for its speed: typical of large arms.

Times are estimates then.
"""


def variants_of(robot_type: str) -> tuple[Variant | None, tuple[Variant, ...]]:
    """Return the exact variant of a type in MOC.cfg, and all similar ones."""
    requested = _TYPE.match(robot_type)
    if requested is None:
        return None, ()
    very, kin = None, []
    for variant in variants():
        own = _NAME.match(variant.name)
        if own is None or own[1].lower() != requested[1].lower():
            continue
        kin.append(variant)
        if requested[4] and float(own[2]) == float(requested[4]):
            reach = float(f"{requested[2]}.{requested[3]}") if requested[2] else float(own[3])
            if float(own[3]) == reach:
                very = variant
    return very, tuple(kin)


def variant_named(name: str) -> Variant | None:
    """Return the variant of that name, such as `IRB 1300-11/0.9`."""
    return next((v for v in variants() if v.name.casefold() == name.casefold()), None)


def group_of(variant: Variant, name: str = "rob1") -> GroupConfig | None:
    """Return a group with the axes of a variant, or None.

    None if its geometry needs more than a chain. Six axes in a row, whose flange points along x at
    zero, as in ABB's arms with a wrist.
    """
    lines = variant.skeleton.lines
    last = lines[-1].direction
    if len(lines) != 6 or abs(last[0] - 1) > 1e-6:
        return None
    joints, links = [], []
    before = (0.0, 0.0, 0.0)
    length = sum(math.dist(a.point, b.point) for a, b in pairwise(lines))
    length += math.dist(lines[-1].point, variant.skeleton.end)
    for number, line in enumerate(lines, 1):
        known = variant.axis(line.axis)
        if known is None or known.lower is None or known.upper is None:
            return None
        speed = math.radians(known.speed or ASSUMED_SPEED)
        joint = f"joint_{number}"
        joints.append(
            Joint(
                joint,
                line.axis,
                "revolute",
                math.radians(known.lower),
                math.radians(known.upper),
                speed,
                _acceleration(known, speed, length),
                source=dict(variant.sources).get("limits", ""),
            )
        )
        links.append(
            ChainLink(joint, _between(before, line.point), (0.0, 0.0, 0.0), line.direction)
        )
        before = line.point
    links.append(ChainLink("", _between(before, variant.skeleton.end), (0.0, math.pi / 2, 0.0)))
    return GroupConfig(
        name,
        "T_ROB1",
        "ROB_1",
        tuple(joints),
        Ports(),
        variant.name,
        tuple(links),
        variant.coupling or 0.0,
        max_payload=variant.max_payload,
        inertias=variant.inertias,
        acceleration_source=dict(variant.sources).get("accelerations", ""),
    )


def group_like(variant: Variant, shipped: Variant, group: GroupConfig) -> GroupConfig | None:
    """Return the group of a shipped model with the dimensions and figures of another variant.

    It is for arms with four axes, which `group_of` does not create. None: the arms differ, and the
    chain has passive steps, of which the lines of the axes do not give the lengths.
    """
    difference = compare(variant.skeleton, shipped.skeleton)
    if difference is None or difference.angle > SAME_TURN:
        return None
    chain = group.chain
    if difference.distance > SAME_PLACE or difference.end > SAME_PLACE:
        if any(link.follows for link in chain):
            return None
        places = {line.axis: line.point for line in variant.skeleton.lines}
        axes = {joint.name: joint.axis for joint in group.joints}
        before, links = (0.0, 0.0, 0.0), []
        for link in chain:
            at = places[axes[link.joint]] if link.joint else variant.skeleton.end
            links.append(replace(link, xyz=_between(before, at)))
            before = at
        chain = tuple(links)
    joints = tuple(_with_figures(joint, variant.axis(joint.axis)) for joint in group.joints)
    return replace(
        group, joints=joints, chain=chain, model=variant.name, max_payload=variant.max_payload
    )


def _with_figures(joint: Joint, known: KnownAxis | None) -> Joint:
    """Return a joint with the range and speed of a variant, where they are known."""
    if known is None or known.lower is None or known.upper is None:
        return joint
    unit = math.radians(1.0) if joint.kind == "revolute" else 0.001
    return replace(
        joint,
        lower=known.lower * unit,
        upper=known.upper * unit,
        speed=known.speed * unit if known.speed is not None else joint.speed,
    )


def _acceleration(axis: KnownAxis, speed: float, length: float) -> float:
    """rad/s^2 of an axis of an arm that is `length` m long."""
    if axis.acceleration is not None:
        return math.radians(axis.acceleration)
    return speed / usual_time(axis.axis, length)


def _between(
    a: tuple[float, float, float], b: tuple[float, float, float]
) -> tuple[float, float, float]:
    return (b[0] - a[0], b[1] - a[1], b[2] - a[2])
