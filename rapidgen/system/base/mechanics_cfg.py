"""MOC of a delivered controller, and the instances that no controller saves.

Names are those of backups: ARM rob1_1 to rob1_6 of ROB_1, rob_R_7 the seventh axis of a YuMi. A
controller has a JOINT and a TRANSMISSION for every axis, and saves only those of additional axes
that its owner has defined (KRAKER, backups with gantries). Robot Web Services return all of them;
abb_librws reads JOINT (logical_axis, kinematic_axis_number, use_arm, use_transmission) and
TRANSMISSION (rotating_move) [code].
"""

from collections.abc import Sequence

from rapidgen.config.model import GroupConfig, Joint
from rapidgen.system.base.factory_cfg import unit_group
from rapidgen.system.cfg import Attribute, CfgText, Instance, Scalar, Section
from rapidgen.system.controller_cfg import ControllerCfg

FIRST_EXTERNAL = 7
"""Logical axis of eax_a."""
OPTIONS = ("616-1 PC Interface",)
"""Options of a delivered controller."""
MECHANICAL_UNITS = tuple(f"MechanicalUnit_{n}" for n in range(1, 7))


def row(*flags: str, **values: Scalar) -> Instance:
    """Return an instance with these attributes, then flags."""
    attributes = [Attribute(name, (value,)) for name, value in values.items()]
    return Instance((*attributes, *map(Attribute, flags)))


def arm_name(group: GroupConfig, joint: Joint) -> str:
    """Return the ARM name of a joint, as in backups and public RAPID.

    An external axis has the name of its mechanical unit, with a number if the unit has several.
    """
    kind, _, axis = joint.axis.partition("_")
    robot = group.mechanical_unit
    robot = robot.lower().replace("_", "") if robot[-1:].isdigit() else f"rob{robot[3:]}"
    if kind == "rax":
        return f"{robot}_{axis}"
    if not group.external_units:
        return f"{robot}_{FIRST_EXTERNAL + 'abcdef'.index(axis)}"
    external = [j for j in group.joints if j.axis.startswith("eax_")]
    if len(external) == len(group.external_units):
        return group.external_units[external.index(joint)]
    return f"{group.external_units[0]}_{1 + external.index(joint)}"


def delivered_sections(groups: Sequence[GroupConfig]) -> tuple[Section, ...]:
    """Return ROBOT, SINGLE, MECHANICAL_UNIT and ARM of robots that no backup describes."""
    robots, singles, units, arms = [], [], [], []
    for group in groups:
        if not group.mechanical_unit:
            continue
        names = {j.axis: arm_name(group, j) for j in group.joints}
        own = {
            f"use_joint_{int(axis[-1]) - 1}": name
            for axis, name in names.items()
            if axis.startswith("rax_")
        }
        robots.append(row(name=group.mechanical_unit, **own))
        external = [name for axis, name in names.items() if axis.startswith("eax_")]
        singles += [row(name=name, use_joint=name) for name in external]
        for number, unit in enumerate(group.external_units):
            last = number == len(group.external_units) - 1
            own_axes = external[number:] if last else external[number : number + 1]
            used = {f"use_single_{n}": name for n, name in enumerate(own_axes)}
            units.append(row("activate_at_start_up", name=unit, **used))
        arms += [
            row(
                name=names[joint.axis],
                lower_joint_bound=joint.lower,
                upper_joint_bound=joint.upper,
            )
            for joint in group.joints
        ]
    rows = {"ROBOT": robots, "SINGLE": singles, "MECHANICAL_UNIT": units, "ARM": arms}
    return tuple(Section(name, tuple(own)) for name, own in rows.items() if own)


def internal_cfg(cfg: ControllerCfg, groups: Sequence[GroupConfig]) -> tuple[CfgText, ...]:
    """Return the instances that a controller with this cfg has and does not save."""
    linear = {arm_name(g, j).casefold() for g in groups for j in g.joints if j.kind == "prismatic"}
    joints, transmissions, units, unit_groups = [], [], [], []
    further = _external_units(cfg)
    for robot in cfg.instances("MOC", "ROBOT"):
        unit = robot.text("Name")
        own = [name for n in range(6) if (name := robot.text(f"use_joint_{n}"))]
        joints += [_joint(cfg, name, number, number) for number, name in enumerate(own, 1)]
        transmissions += [
            row(*(() if name.casefold() in linear else ("rotating_move",)), name=name)
            for name in own
        ]
        units.append(row(name=unit, use_robot=unit))
        named = dict(zip(MECHANICAL_UNITS, further.get(unit.casefold(), ()), strict=False))
        unit_groups.append(row(Name=unit_group(unit), Robot=unit, **named))
    singles = [single.text("use_joint") for single in cfg.instances("MOC", "SINGLE")]
    places = {name.casefold(): place for place, name in _single_axes(cfg)}
    for name in filter(None, singles):
        place = places.get(name.casefold(), FIRST_EXTERNAL)
        joints.append(_joint(cfg, name, place, 1))
        transmissions.append(row(name=name))
    moc = {"JOINT": joints, "TRANSMISSION": transmissions, "MECHANICAL_UNIT": units}
    sys = {
        "PRESENT_OPTIONS": [row(name=o, desc=o.partition(" ")[2]) for o in OPTIONS],
        "MECHANICAL_UNIT_GROUP": [] if cfg.unit_groups else unit_groups,
    }
    return tuple(
        CfgText(domain, None, tuple(Section(name, tuple(rows)) for name, rows in own.items()))
        for domain, own in (("MOC", moc), ("SYS", sys))
    )


def _joint(cfg: ControllerCfg, name: str, logical: int, kinematic: int) -> Instance:
    return row(
        name=name,
        logical_axis=logical,
        kinematic_axis_number=kinematic,
        use_arm=arm_of_joint(cfg, name),
        use_transmission=name,
    )


def arm_of_joint(cfg: ControllerCfg, joint: str) -> str:
    """Return the ARM of a joint that is not in the file.

    Its name is that of the joint; that of a track of ABB is a product's, and its arm type has the
    name of the joint (EBRUUN: joint track1, arm T4004_3.9_1).
    """
    arms = tuple(cfg.instances("MOC", "ARM"))
    for attribute in ("name", "use_arm_type"):
        for arm in arms:
            if arm.text(attribute).casefold() == joint.casefold():
                return arm.text("name")
    return joint


def _external_units(cfg: ControllerCfg) -> dict[str, tuple[str, ...]]:
    """Return the external units of each robot; without groups, all belong to the first one."""
    groups = {
        group.text("Robot").casefold(): tuple(
            unit for key in MECHANICAL_UNITS if (unit := group.text(key))
        )
        for group in cfg.instances("SYS", "MECHANICAL_UNIT_GROUP")
    }
    if groups:
        return groups
    carried = {
        instance.text("use_robot").casefold()
        for instance in cfg.instances("MOC", "MECHANICAL_UNIT")
    }
    robots = [
        robot.text("Name")
        for robot in cfg.instances("MOC", "ROBOT")
        if robot.text("Name").casefold() not in carried
    ]
    named = [unit.text("Name") for unit in cfg.instances("MOC", "MECHANICAL_UNIT")]
    known = {name.casefold() for name in named} | {name.casefold() for name in _in_units(cfg)}
    singles = (single.text("Name") for single in cfg.instances("MOC", "SINGLE"))
    named += [name for name in singles if name.casefold() not in known]
    if len(robots) > 1:
        # HONG: the seventh axis of each arm of a YuMi.
        return {
            robot.casefold(): tuple(n for n in named if n.casefold().startswith(robot.casefold()))
            for robot in robots
        }
    return {robot.casefold(): tuple(named) for robot in robots}


def _in_units(cfg: ControllerCfg) -> list[str]:
    """Return the SINGLEs that a MECHANICAL_UNIT consists of."""
    return [
        single
        for unit in cfg.instances("MOC", "MECHANICAL_UNIT")
        for n in range(6)
        if (single := unit.text(f"use_single_{n}"))
    ]


def external_units(cfg: ControllerCfg, robot: str) -> tuple[str, ...]:
    """Return the names of the units whose axes move with a robot, in the order of their group."""
    return _external_units(cfg).get(robot.casefold(), ())


def _single_axes(cfg: ControllerCfg) -> list[tuple[int, str]]:
    """Return logical axis and joint of each SINGLE, in the order of the units of a robot."""
    units = {unit.text("Name").casefold(): unit for unit in cfg.instances("MOC", "MECHANICAL_UNIT")}
    singles = {one.text("Name").casefold(): one for one in cfg.instances("MOC", "SINGLE")}
    result = []
    for robot in cfg.instances("MOC", "ROBOT"):
        place = FIRST_EXTERNAL
        for name in external_units(cfg, robot.text("Name")):
            unit = units.get(name.casefold())
            used = [unit.text(f"use_single_{n}") for n in range(6)] if unit is not None else [name]
            for one in filter(None, used):
                single = singles.get(one.casefold())
                if single is not None:
                    result.append((place, single.text("use_joint")))
                    place += 1
    return result
