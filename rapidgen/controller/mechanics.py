"""Assignment of robot models to tasks, for systems without them."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from rapidgen.config import load_config, shipped_names
from rapidgen.config.model import GroupConfig
from rapidgen.config.model_cache import shipped_groups
from rapidgen.controller.external_axes import with_cfg
from rapidgen.diagnostics import Diagnostic, Severity, error, refusal
from rapidgen.system.model import System

if TYPE_CHECKING:
    from rapidgen.config.cell import CellRobotKeys
    from rapidgen.config.variant_library import Variant

DEFAULT_ROBOT = "irb120"
# MOC.cfg of backups: ROB1_4600_2.55_40, ROB_R_14000_05_05, ROB1_910SC_0.55_3, ROB1_15000_0_95_5.
_TYPE = re.compile(r"ROB_?[A-Z0-9]+?_(\d{3,5}[A-Z]{0,3})", re.I)
_VARIANT = re.compile(r"(?:IRB|CRB)\s+(\d{2,5})[^/\\.]*(?:/[\d.]+)?", re.I)
"""Looks like the name of a robot, not of a file."""
_HELP = "name the robot with `--robot NAME`; `rapidgen robots` lists the models"
_SPEEDS = (
    "`rapidgen new robot.yaml --robot '{}'`, write the data sheet's speeds into it, and "
    "`--robot robot.yaml`"
)


def motion_tasks(system: System) -> list[str]:
    """Return the motion tasks; the first task if none is declared."""
    moving = [task.name for task in system.tasks if task.motion]
    return moving or [task.name for task in system.tasks[:1]]


def groups_for(system: System, robots: Sequence[GroupConfig]) -> tuple[GroupConfig, ...]:
    """Assign each of `robots` to the task that moves its mechanical unit.

    If the system does not name the units, the task's name decides, then the order. Further motion
    tasks receive copies of the last robot.
    """
    tasks = motion_tasks(system)
    units = _units(system)
    by_unit = {group.mechanical_unit.casefold(): group for group in robots}
    by_name = {group.task.casefold(): group for group in robots}
    result: dict[str, GroupConfig] = {}
    for known in (
        {task: by_unit.get(units.get(task, "").casefold()) for task in tasks},
        {task: by_name.get(task.casefold()) for task in tasks},
    ):
        for task, group in known.items():
            if group is not None and task not in result and group not in result.values():
                result[task] = group
    left = iter([group for group in robots if group not in result.values()])
    groups = []
    for i, task in enumerate(tasks):
        unit = units.get(task, "")
        last = robots[-1]
        copy = replace(last, name=unit.lower().replace("_", "") or f"{last.name}_{i + 1}")
        group = result.get(task) or next(left, copy)
        groups.append(replace(group, task=task, mechanical_unit=unit or group.mechanical_unit))
    return tuple(groups)


def mechanics(
    system: System, robot: str = "", own: "Mapping[str, CellRobotKeys] | None" = None
) -> tuple[tuple[GroupConfig, ...], tuple[Diagnostic, ...]]:
    """Return a robot for each motion task.

    The robot is named for it (`own`, by task) or for all (`robot`), else it has the type in the
    backup. Notes report replacements. DiagnosticError RG432: no shipped model has the type.
    """
    given = {task.casefold(): keys for task, keys in (own or {}).items()}
    types = {unit.casefold(): name for unit, name in system.robot_types}
    units = _units(system)
    groups: list[GroupConfig] = []
    notes: list[Diagnostic] = []
    for i, task in enumerate(motion_tasks(system)):
        keys = given.get(task.casefold())
        model = (keys.model if keys is not None else "") or robot
        robots: Sequence[GroupConfig] = ()
        if model:
            robots = robots_named(model)
        elif any(types.values()):
            unit = units.get(task) or list(types)[min(i, len(types) - 1)]
            robots, report = _of_type(types.get(unit.casefold(), ""), unit)
            notes += report
        else:
            robots = of_unknown_payload(shipped_groups(DEFAULT_ROBOT))
            notes.append(_replacement_note(f"the mechanics are unknown: moving an {DEFAULT_ROBOT}"))
        group = next(g for g in groups_for(system, robots) if g.task == task)
        in_use = any(other.name == group.name for other in groups)
        if in_use:
            group = replace(group, name=f"{group.name}_{i + 1}")
        if keys is not None:
            group = replace(
                group,
                mechanical_unit=keys.mechanical_unit or group.mechanical_unit,
                external_units=tuple(keys.external_units) or group.external_units,
            )
        group, of_units = with_cfg(group, system.cfg)
        notes += of_units
        groups.append(group)
    return tuple(groups), tuple(dict.fromkeys(notes))


def robots_named(name: str) -> Sequence[GroupConfig]:
    """Return the robots of a shipped model, configuration or variant.

    DiagnosticError RG009: a robot that is not known, or whose geometry is no simple chain.
    """
    if name in shipped_names():
        return shipped_groups(name)
    from rapidgen.config.variant_group import group_of, variant_named, variants_of

    variant = variant_named(name)
    group = group_of(variant) if variant is not None else None
    if group is not None:
        return (group,)
    likely = _VARIANT.fullmatch(name)
    if variant is None and (likely is None or Path(name).exists()):
        return load_config(name).groups
    reason = "is an unknown variant" if variant is None else "has axes that cannot be simulated"
    _, kin = variants_of(f"ROB1_{likely[1]}" if likely is not None else "")
    others = ", ".join(f"'{one.name}'" for one in kin if group_of(one) is not None)
    raise refusal(
        "RG009",
        None,
        f"'{name}' {reason}",
        (f"choose a similar one: {others}; " if others else "")
        + "`rapidgen robots --all` lists all",
    )


def _of_type(name: str, unit: str) -> tuple[Sequence[GroupConfig], list[Diagnostic]]:
    """Return the robots of a type in MOC.cfg.

    The exact variant precedes the model of its number.
    """
    from rapidgen.config.catalogue import model_description
    from rapidgen.config.variant_group import ASSUMED_SPEED, group_of, variants_of

    very, kin = variants_of(name)
    model = model_of(name)
    if very is not None and not very.model:
        guessed = any(axis.speed is None for axis in very.axes)
        no_speeds = f"no source has the speeds of a {name}: "
        group = group_of(very)
        if group is not None:
            note = no_speeds + f"{ASSUMED_SPEED:g} deg/s are used"
            return (group,), [_replacement_note(note, _SPEEDS.format(very.name))] if guessed else []
        group = _like_model(very, model) if model else None
        if group is not None:
            note = no_speeds + f"those of an {model_description(model)} are used"
            return (group,), [_replacement_note(note)] if guessed else []
    if not model:
        others = [f"'{variant.name}'" for variant in kin if group_of(variant) is not None]
        help = f"choose a similar one with `--robot`: {', '.join(others)}" if others else _HELP
        raise refusal("RG432", None, f"no known robot is a {name or unit}", help)
    if (very is not None and very.model) or not kin:
        return shipped_groups(model), []
    message = f"the controller has a {name}, moving an {model_description(model)}"
    return of_unknown_payload(shipped_groups(model)), [_replacement_note(message)]


def _like_model(variant: "Variant", model: str) -> GroupConfig | None:
    """Return the shipped model of the same family with the figures of a variant."""
    from rapidgen.config.variant_group import group_like
    from rapidgen.config.variant_library import of_model

    (group, *_) = shipped_groups(model)
    shipped = of_model(model, group.name)
    return group_like(variant, shipped, group) if shipped is not None else None


def of_unknown_payload(groups: Sequence[GroupConfig]) -> tuple[GroupConfig, ...]:
    """Return replacement robots, whose payload is unknown."""
    return tuple(replace(group, max_payload=0.0) for group in groups)


def model_of(robot_type: str) -> str:
    """Return the shipped model of a type in MOC.cfg, or ""."""
    found = _TYPE.match(robot_type)
    names = [f"{kind}{found[1].lower()}" for kind in ("irb", "crb")] if found else []
    return next((name for name in names if name in shipped_names()), "")


def _replacement_note(message: str, help: str = _HELP) -> Diagnostic:
    return error("RG432", None, message, help, severity=Severity.WARNING)


def _units(system: System) -> dict[str, str]:
    """Return the robot of each motion task by mechanical unit group."""
    robots = {group.name.casefold(): group.robot for group in system.groups}
    named = {
        task.name: robots.get(task.mechanical_unit_group.casefold(), "") for task in system.tasks
    }
    return {task: unit for task, unit in named.items() if unit}
