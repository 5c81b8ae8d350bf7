"""Which robot model moves which task, for a system that does not say it by itself."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace

from rapidgen.config import load_config, shipped_names
from rapidgen.config.catalogue import model_description
from rapidgen.config.cell import CellRobotKeys
from rapidgen.config.model import GroupConfig, RobotConfig
from rapidgen.diagnostics import Diagnostic, Severity, error, refusal
from rapidgen.system.model import System

DEFAULT_ROBOT = "irb120"
# MOC.cfg of backups: ROB1_4600_2.55_40, ROB_R_14000_05_05, ROB1_910SC_0.55_3, ROB1_15000_0_95_5.
_TYPE = re.compile(r"ROB_?[A-Z0-9]+?_(\d{3,5}[A-Z]{0,3})(?:_(\d)[._](\d{2}|\d)_(\d+))?", re.I)
_VARIANT = re.compile(r"(\d+)/(\d+\.\d+)")
_MEND = "name the robot with `--robot NAME`; `rapidgen robots` lists the models"


def motion_tasks(system: System) -> list[str]:
    """Names of the tasks that move robots; the first one when none says so."""
    moving = [task.name for task in system.tasks if task.motion]
    return moving or [task.name for task in system.tasks[:1]]


def groups_for(system: System, config: RobotConfig) -> tuple[GroupConfig, ...]:
    """The configuration's groups, each given to the motion task that moves its mechanical unit.

    Where the system does not tell the units, to the task of its name; what is left goes by
    order, and more motion tasks than groups get copies of the last one.
    """
    tasks = motion_tasks(system)
    units = _units(system)
    by_unit = {group.mechanical_unit.casefold(): group for group in config.groups}
    by_name = {group.task.casefold(): group for group in config.groups}
    found: dict[str, GroupConfig] = {}
    for known in (
        {task: by_unit.get(units.get(task, "").casefold()) for task in tasks},
        {task: by_name.get(task.casefold()) for task in tasks},
    ):
        for task, group in known.items():
            if group is not None and task not in found and group not in found.values():
                found[task] = group
    left = iter([group for group in config.groups if group not in found.values()])
    groups = []
    for i, task in enumerate(tasks):
        unit = units.get(task, "")
        last = config.groups[-1]
        copy = replace(last, name=unit.lower().replace("_", "") or f"{last.name}_{i + 1}")
        group = found.get(task) or next(left, copy)
        groups.append(replace(group, task=task, mechanical_unit=unit or group.mechanical_unit))
    return tuple(groups)


def mechanics(
    system: System, robot: str = "", own: Mapping[str, CellRobotKeys] | None = None
) -> tuple[tuple[GroupConfig, ...], tuple[Diagnostic, ...]]:
    """A robot for each motion task: the one that is named for it (`own`, by task) or for all
    (`robot`), else of the type that a backup tells.

    Notes say where another robot stands in. Raises DiagnosticError RG432 for a type that no
    shipped model is of.
    """
    given = {task.casefold(): keys for task, keys in (own or {}).items()}
    types = {unit.casefold(): name for unit, name in system.robot_types}
    units = _units(system)
    groups: list[GroupConfig] = []
    notes: list[Diagnostic] = []
    for i, task in enumerate(motion_tasks(system)):
        keys = given.get(task.casefold(), CellRobotKeys())
        model = keys.model or robot
        if not model and types:
            unit = units.get(task) or list(types)[min(i, len(types) - 1)]
            name = types.get(unit.casefold(), "")
            model = model_of(name)
            if not model:
                raise refusal("RG432", None, f"no shipped model is a {name or unit}", _MEND)
            notes += _other_variant(name, model)
        if not model:
            model = DEFAULT_ROBOT
            notes.append(_stands_in(f"nothing tells the mechanics: moving an {DEFAULT_ROBOT}"))
        group = next(g for g in groups_for(system, load_config(model)) if g.task == task)
        taken = any(other.name == group.name for other in groups)
        groups.append(
            replace(
                group,
                name=f"{group.name}_{i + 1}" if taken else group.name,
                mechanical_unit=keys.mechanical_unit or group.mechanical_unit,
                external_units=tuple(keys.external_units) or group.external_units,
            )
        )
    return tuple(groups), tuple(dict.fromkeys(notes))


def model_of(robot_type: str) -> str:
    """The shipped model of a type in MOC.cfg, whatever its variant; empty: there is none."""
    found = _TYPE.match(robot_type)
    names = [f"{kind}{found[1].lower()}" for kind in ("irb", "crb")] if found else []
    return next((name for name in names if name in shipped_names()), "")


def _other_variant(robot_type: str, model: str) -> Iterator[Diagnostic]:
    found = _TYPE.match(robot_type)
    described = model_description(model)
    shipped = _VARIANT.search(described)
    if found is None or found[2] is None or shipped is None:
        return
    reach, mass = float(f"{found[2]}.{found[3]}"), int(found[4])
    if (mass, reach) != (int(shipped[1]), float(shipped[2])):
        yield _stands_in(f"the controller has a {robot_type}, moving an {described}")


def _stands_in(message: str) -> Diagnostic:
    return error("RG432", None, message, _MEND, severity=Severity.WARNING)


def _units(system: System) -> dict[str, str]:
    """The robot of each motion task whose mechanical unit group the system has."""
    robots = {group.name.casefold(): group.robot for group in system.groups}
    named = {
        task.name: robots.get(task.mechanical_unit_group.casefold(), "") for task in system.tasks
    }
    return {task: unit for task, unit in named.items() if unit}
