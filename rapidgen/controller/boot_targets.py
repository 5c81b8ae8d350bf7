"""Targets that can be booted, for `run`, `sim`, tests and Python.

A target is a configuration, a shipped name, a generated folder, a backup, or RAPID files with a
cell description.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import rapidgen.system as files
from rapidgen.axes.default_postures import usual_start
from rapidgen.config import from_manifest, load_config
from rapidgen.config.model import ChainLink, GroupConfig, Positioner, RobotConfig
from rapidgen.config.registry import is_path
from rapidgen.controller.cell_setup import CellSetup, apply_cell, cameras_of, force_of
from rapidgen.controller.inference.start_poses import start_of, start_targets, table_pose
from rapidgen.controller.mechanics import DEFAULT_ROBOT, mechanics, of_unknown_payload
from rapidgen.diagnostics import Diagnostic, refusal, suggest
from rapidgen.system.model import System
from rapidgen.system.releases import UNKNOWN_ROBOTWARE

if TYPE_CHECKING:
    from rapidgen.config.cell import CellDescription, CellRobotKeys
    from rapidgen.controller.collisions import CollisionSetup
    from rapidgen.controller.inference.cell import InferredCell
    from rapidgen.controller.inference.robot import RobotCandidate

# Descriptions, inference, generated drivers and backups are imported on demand: the run of a small
# program takes little longer than its imports.
INFER = "infer"
"""Instead of a cell's file: whatever the programs name is there."""
Source = Path | str


@dataclass(frozen=True, slots=True)
class BootOptions:
    """Options of the user in addition to the files."""

    tasks: Mapping[str, Sequence[Source]] = field(default_factory=dict)
    """Files of separate tasks; other files go to T_ROB1."""
    robot: str = ""
    robotware: tuple[int, int] | None = None
    """Release of loose files; None: unknown."""
    entry: str = ""
    """Entry procedure of the tasks; empty: as SYS.cfg says, or main."""
    cell: Source = ""
    start: Sequence[float] = ()
    """Start position of the first robot, deg and mm."""
    backup: Source | None = None
    """Of the controller that a generated folder is loaded onto."""
    overrides: Sequence[str] = ()


@dataclass(frozen=True, slots=True)
class Bootable:
    """A controller that can be booted.

    `driver` is True if it runs a generated driver.
    """

    name: str
    system: System
    groups: tuple[GroupConfig, ...]
    driver: bool
    notes: tuple[Diagnostic, ...] = ()
    surroundings: CellSetup = field(default_factory=CellSetup)
    guessed: "InferredCell | None" = None
    likely: "RobotCandidate | None" = None
    """The inferred robot."""
    described: Mapping[str, Path] = field(default_factory=dict)
    """Configurations with the visual models of groups."""
    overrides: Sequence[str] = ()
    """Of those configurations."""
    cell: "CellDescription | None" = None
    """Description of the cell."""

    def collisions(self, chosen: Literal["error", "warn", "off"] | None) -> "CollisionSetup | None":
        """Return the set-up of collision checks; None without one.

        Not chosen, `collision:` of the cell file means `error`. Raises DiagnosticError RG901 if
        there is no cell file.
        """
        if chosen == "off" or (chosen is None and getattr(self.cell, "collision", None) is None):
            return None
        if self.cell is None:
            raise refusal(
                "RG901",
                None,
                "--collisions needs a cell file",
                "add --cell FILE: `rapidgen schema --cell`",
            )
        from rapidgen.controller.collisions import CollisionSetup

        return CollisionSetup(self.cell, self.described, chosen or "error")


def load_target(targets: Sequence[Source], options: BootOptions | None = None) -> Bootable:
    """Read a target. Raises DiagnosticError with its faults."""
    options = options or BootOptions()
    first = Path(targets[0]) if len(targets) == 1 and not options.tasks else None
    if first is not None and is_configuration(first):
        _only_of_folders(str(first), options)
        _only_of_files(str(first), options, "--set controller.robotware=7.6 changes it")
        from rapidgen.generate import build, make_system

        config = load_config(str(targets[0]), overrides=options.overrides)
        system = make_system(config, build(config))
        made = _driver(config, system, tuple(config.diagnostics), options)
        named = [group.name for group in config.groups if is_path(str(first))]
        described = dict.fromkeys(named, first)
        return replace(made, described=described, overrides=options.overrides)
    notes: list[Diagnostic] = []
    folder = first if first is not None and first.is_dir() else None
    if folder is not None and files.is_generated(folder):
        _only_of_files(str(first), options, "build it for another one")
        config = from_manifest(files.read_manifest(folder)["configuration"])
        system = files.read_folder(folder, options.backup, notes=notes)
        return _driver(config, system, tuple(notes), options)
    _only_of_folders(" ".join(map(str, targets)), options)
    if folder is not None and files.is_backup(folder):
        _only_of_files(str(first), options, "leave it out")
        system = _entered(files.read_backup(folder, notes=notes), options.entry)
        return _foreign(system, notes, options)
    # Loose files do not describe their mechanics.
    return _foreign(_loose(targets, options), None, options)


def boot_modules(
    system: System, groups: Sequence[GroupConfig], options: BootOptions | None = None
) -> Bootable:
    """Return a target of modules in memory, with known robots.

    Of the options, cell and start apply. Raises DiagnosticError.
    """
    # With a known robot, inference does not excuse unreachable targets.
    options = replace(options or BootOptions(), robot=groups[0].model or groups[0].name)
    result = Bootable(system.name, system, tuple(groups), False)
    return _surrounded(result, _described(options), options)


def is_configuration(target: Path) -> bool:
    """Return True for a configuration file or a shipped name."""
    if target.suffix.lower() in (".yaml", ".yml"):
        return True
    return not target.exists() and not target.suffix and len(target.parts) == 1


def _loose(targets: Sequence[Source], options: BootOptions) -> System:
    if not targets and not any(options.tasks.values()):
        raise refusal(
            "RG901",
            None,
            "nothing to run",
            "name a module, a folder with modules, a generated folder or a backup",
        )
    by_task = {task: list(names) for task, names in options.tasks.items()}
    only = Path(targets[0]) if len(targets) == 1 and not by_task else None
    if only is not None and only.is_dir() and (folders := files.task_folders(only)):
        return _read(folders, only.resolve().name, options)
    if targets:
        own = by_task.pop("T_ROB1", [])
        by_task = {"T_ROB1": [*own, *targets], **by_task}
    name = Path(next(names[0] for names in by_task.values() if names)).resolve().stem
    return _read(by_task, name, options)


def _read(tasks: Mapping[str, Sequence[Source]], name: str, options: BootOptions) -> System:
    entry, robotware = options.entry or "main", options.robotware or UNKNOWN_ROBOTWARE
    return files.read_files(tasks, entry=entry, name=name, robotware=robotware)


def _entered(system: System, entry: str) -> System:
    """Return a system whose tasks start in `entry`, where declared."""
    if not entry:
        return system
    proc = f"proc {entry}(".casefold().encode("latin-1", "replace")
    tasks = tuple(
        replace(task, entry=entry)
        if any(proc in module.data.lower() for module in task.modules)
        else task
        for task in system.tasks
    )
    return replace(system, tasks=tasks)


def _driver(
    config: RobotConfig, system: System, notes: tuple[Diagnostic, ...], options: BootOptions
) -> Bootable:
    """Return a target that runs a generated driver.

    Its robots are those of the configuration and start at 0.
    """
    from rapidgen.controller.cell import in_its_cell
    from rapidgen.controller.external_axes import with_limits

    if options.robot:
        raise refusal(
            "RG901",
            None,
            f"{config.name} has its own robot, and --robot is for programs that name none",
            "leave it out",
        )
    system = _entered(in_its_cell(system, config), options.entry)
    cell = _described(options)
    groups = tuple(with_limits(group, system.cfg) for group in config.groups)
    result = Bootable(config.name, system, groups, True, (*notes, *_warned(cell)))
    return _surrounded(result, cell, options)


def _foreign(system: System, notes: list[Diagnostic] | None, options: BootOptions) -> Bootable:
    cell = _described(options)
    robots = cell.robots if cell is not None else {}
    system = _moving(system, robots)
    robot, model = options.robot, None
    if str(options.cell) == INFER and not robot and not system.robot_types:
        from rapidgen.controller.inference.robot import infer_robot_model

        model = infer_robot_model(system, DEFAULT_ROBOT)
        robot = model.model if model is not None else ""
    groups, which = mechanics(system, robot, robots)
    if model is not None:
        groups = of_unknown_payload(groups)
    report = _warned(cell) if notes is None else (*notes, *which, *_warned(cell))
    models = {task.casefold(): keys.model for task, keys in robots.items()}
    chosen = {group.name: models.get(group.task.casefold()) or robot for group in groups}
    described = {name: Path(model) for name, model in chosen.items() if is_path(model)}
    result = Bootable(system.name, system, groups, False, report, likely=model, described=described)
    return _surrounded(result, cell, options)


def _described(options: BootOptions) -> "CellDescription | None":
    if str(options.cell) in ("", INFER):
        return None
    from rapidgen.config.cell import load_cell

    return load_cell(Path(options.cell))


def _warned(cell: "CellDescription | None") -> tuple[Diagnostic, ...]:
    return () if cell is None else cell.diagnostics


def _surrounded(result: Bootable, cell: "CellDescription | None", options: BootOptions) -> Bootable:
    guessed = None
    if str(options.cell) == INFER:
        from rapidgen.controller.inference.cell import infer_cell

        units = [u for g in result.groups for u in (g.mechanical_unit, *g.external_units)]
        first, *others = result.groups
        table = table_pose(first)
        guessed = infer_cell(result.system, units, table, start_targets(first))
        cell = guessed.cell
        fixed_table = (ChainLink("", table, (0.0, 0.0, 0.0)),)
        carriers = [Positioner(unit, fixed_table) for unit in guessed.units]
        first = replace(
            first,
            external_units=(*first.external_units, *guessed.units),
            positioners=(*first.positioners, *carriers),
        )
        result = replace(result, groups=(first, *others))
    usual = not result.driver
    if cell is None:
        starts = dict(_starts(result.groups, {}, options.start, usual=usual))
        return replace(result, surroundings=CellSetup(starts))
    return replace(
        result,
        cell=cell,
        system=apply_cell(result.system, cell)
        if guessed is None
        else apply_cell(result.system, cell, guessed.data, guessed.routines),
        surroundings=CellSetup(
            dict(_starts(result.groups, cell.robots, options.start, usual=usual)),
            tuple(reaction for rows in cell.devices.values() for reaction in rows),
            guessed.driven if guessed is not None else frozenset(),
            guessed.polled if guessed is not None else (),
            guessed.flags if guessed is not None else (),
            guessed.expected_messages if guessed is not None else None,
            cameras_of(cell, is_guess=guessed is not None),
            force_of(cell),
            frozenset(guessed.divisors if guessed is not None else ()),
            guessed.blank if guessed is not None else (),
            partners=cell.egm,
            is_guess=guessed is not None,
            placed=frozenset(g.name for g in result.groups[:1] if options.start),
            is_any_robot=guessed is not None
            and not options.robot
            and not result.system.robot_types,
        ),
        guessed=guessed,
    )


def _moving(system: System, robots: "Mapping[str, CellRobotKeys]") -> System:
    """Make tasks with a robot of the cell motion tasks."""
    names = {task.name.casefold(): task.name for task in system.tasks}
    for task in robots:
        if task.casefold() not in names:
            raise refusal(
                "RG434",
                None,
                f"the cell has a robot for {task}, and there is no such task",
                suggest(task, list(names.values())) or f"there are {', '.join(names.values())}",
            )
    moved = {task.casefold() for task in robots}
    tasks = (
        replace(t, motion=t.motion or t.name.casefold() in moved) if moved else t
        for t in system.tasks
    )
    return replace(system, tasks=tuple(tasks))


def _starts(
    groups: Sequence[GroupConfig],
    robots: "Mapping[str, CellRobotKeys]",
    first: Sequence[float],
    *,
    usual: bool,
) -> Iterator[tuple[str, tuple[float, ...]]]:
    described = {task.casefold(): robot.start for task, robot in robots.items()}
    for i, group in enumerate(groups):
        values = described.get(group.task.casefold())
        if first and i == 0:
            yield group.name, start_of(group, first, "--start")
        elif values:
            yield group.name, start_of(group, values, f"`start` of {group.task}")
        elif usual:
            yield group.name, usual_start(group)


def _only_of_files(target: str, options: BootOptions, help: str) -> None:
    """Reject `robotware` for a target that defines its release."""
    if options.robotware is not None:
        raise refusal(
            "RG901",
            None,
            f"'{target}' defines its RobotWare, and --robotware names another one",
            help,
        )


def _only_of_folders(target: str, options: BootOptions) -> None:
    """Reject `backup` for a target that is not a generated folder."""
    if options.backup is not None:
        raise refusal(
            "RG433",
            None,
            f"'{target}' is not a generated folder; --backup requires one",
            "build it first: `rapidgen build CONFIG --backup FOLDER`",
        )
