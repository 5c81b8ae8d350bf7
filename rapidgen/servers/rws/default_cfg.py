"""Default cfg that a small SYSPAR does not have: options, mechanics.

Types and attributes as abb_librws reads them of an IRC5 [code]; limits in rad and m.
"""

from typing import TYPE_CHECKING

from rapidgen.machine.system_parameters import arm_name
from rapidgen.motion.group import MotionGroup
from rapidgen.system.base.factory_cfg import unit_group
from rapidgen.system.cfg import Attribute, Instance, Scalar

if TYPE_CHECKING:
    from rapidgen.servers.rws.context import RwsContext

DOMAINS = ("EIO", "MMC", "MOC", "PROC", "SIO", "SYS")
"""Domains of every controller."""
OPTIONS = ("616-1 PC Interface",)
"""Installed options."""


def built_in(context: "RwsContext") -> dict[tuple[str, str], tuple[Instance, ...]]:
    """Return default instances by domain and type."""
    groups = [g for g in context.controller.motion.groups.values() if g.config.mechanical_unit]
    joints = [row for group in groups for row in _joints(group)]
    return {
        ("SYS", "PRESENT_OPTIONS"): tuple(_row(name=o, desc=o.partition(" ")[2]) for o in OPTIONS),
        ("SYS", "MECHANICAL_UNIT_GROUP"): tuple(map(_unit_group, groups)),
        ("MOC", "ROBOT"): tuple(_row(name=g.config.mechanical_unit) for g in groups),
        ("MOC", "MECHANICAL_UNIT"): tuple(
            _row(name=g.config.mechanical_unit, use_robot=g.config.mechanical_unit) for g in groups
        ),
        ("MOC", "ARM"): tuple(arm for arm, _ in joints),
        ("MOC", "JOINT"): tuple(joint for _, joint in joints),
    }


def _row(**values: Scalar) -> Instance:
    return Instance(tuple(Attribute(name, (value,)) for name, value in values.items()))


def _unit_group(group: MotionGroup) -> Instance:
    unit = group.config.mechanical_unit
    return _row(Name=group.config.unit_group or unit_group(unit), Robot=unit)


def _joints(group: MotionGroup) -> list[tuple[Instance, Instance]]:
    """Return ARM and JOINT of each axis."""
    result = []
    for number, joint in enumerate(group.config.joints, 1):
        arm = arm_name(group.config, joint)
        bounds = {"lower_joint_bound": joint.lower, "upper_joint_bound": joint.upper}
        row = _row(
            name=arm,
            logical_axis=number,
            kinematic_axis_number=number,
            use_arm=arm,
            use_transmission=arm,
        )
        result.append((_row(name=arm, **bounds), row))
    return result
