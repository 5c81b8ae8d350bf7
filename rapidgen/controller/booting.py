"""What can be booted, whatever it is: a configuration, a shipped name, a generated folder, a
backup, or RAPID files with a cell around them. `run`, `sim`, tests and Python load it here."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from rapidgen.config import from_manifest, load_config
from rapidgen.config.cell import CellDescription, load_cell
from rapidgen.config.model import GroupConfig, RobotConfig
from rapidgen.controller.cell import in_its_cell
from rapidgen.controller.guessing import Guess, guess
from rapidgen.controller.mechanics import mechanics
from rapidgen.controller.starts import start_of, usual_start
from rapidgen.controller.surroundings import Surroundings, furnish
from rapidgen.diagnostics import Diagnostic, refusal, suggest
from rapidgen.generate import build, make_system
from rapidgen.system import (
    is_backup,
    is_generated,
    read_backup,
    read_files,
    read_folder,
    read_manifest,
)
from rapidgen.system.backup import backup_cfg
from rapidgen.system.controller_cfg import ControllerCfg
from rapidgen.system.model import System

GUESS = "guess"
"""Instead of a cell's file: whatever the programs name is there."""
Source = Path | str


@dataclass(frozen=True, slots=True)
class Wishes:
    """What a user says beside the files."""

    tasks: Mapping[str, Sequence[Source]] = field(default_factory=dict)
    """Files of tasks of their own; what is given beside them goes to T_ROB1."""
    robot: str = ""
    entry: str = ""
    """Procedure that tasks start in; empty: as SYS.cfg says, or main."""
    cell: Source = ""
    start: Sequence[float] = ()
    """Where the first robot stands, deg and mm."""
    backup: Source | None = None
    """Of the controller that a generated folder is loaded onto."""
    overrides: Sequence[str] = ()


@dataclass(frozen=True, slots=True)
class Bootable:
    """A controller that can be booted. `driver` tells whether it runs a generated driver."""

    name: str
    system: System
    groups: tuple[GroupConfig, ...]
    driver: bool
    notes: tuple[Diagnostic, ...] = ()
    surroundings: Surroundings = field(default_factory=Surroundings)
    guessed: Guess | None = None
    cfg: ControllerCfg | None = None
    """All domains of a backup."""


def load_target(targets: Sequence[Source], wishes: Wishes | None = None) -> Bootable:
    """Read what is to be booted. Raises DiagnosticError with what is wrong."""
    wishes = wishes or Wishes()
    first = Path(targets[0]) if len(targets) == 1 and not wishes.tasks else None
    if first is not None and is_configuration(first):
        _only_of_folders(str(first), wishes)
        config = load_config(str(targets[0]), overrides=tuple(wishes.overrides))
        system = make_system(config, build(config))
        return _driver(config, system, tuple(config.diagnostics), wishes)
    notes: list[Diagnostic] = []
    if first is not None and first.is_dir() and is_generated(first):
        config = from_manifest(read_manifest(first)["configuration"])
        system = read_folder(first, wishes.backup, notes=notes)
        return _driver(config, system, tuple(notes), wishes)
    _only_of_folders(" ".join(map(str, targets)), wishes)
    if first is not None and first.is_dir() and is_backup(first):
        system = _entered(read_backup(first, notes=notes), wishes.entry)
        found = _foreign(system, notes, wishes)
        return replace(found, cfg=backup_cfg(first, system.robotware, []))
    # Loose files have no mechanics that could be told.
    return _foreign(_loose(targets, wishes), None, wishes)


def is_configuration(target: Path) -> bool:
    """Whether `target` is a configuration's file or the name of a shipped one."""
    if target.suffix.lower() in (".yaml", ".yml"):
        return True
    return not target.exists() and not target.suffix and len(target.parts) == 1


def _loose(targets: Sequence[Source], wishes: Wishes) -> System:
    if not targets and not wishes.tasks:
        raise refusal(
            "RG901",
            None,
            "nothing to run",
            "name a module, a folder with modules, a generated folder or a backup",
        )
    by_task = {task: list(files) for task, files in wishes.tasks.items()}
    if targets:
        own = by_task.pop("T_ROB1", [])
        by_task = {"T_ROB1": [*own, *targets], **by_task}
    name = Path(next(iter(by_task.values()))[0]).stem
    return read_files(by_task, entry=wishes.entry or "main", name=name)


def _entered(system: System, entry: str) -> System:
    """A system whose tasks start in `entry`, where a module of theirs has it."""
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
    config: RobotConfig, system: System, notes: tuple[Diagnostic, ...], wishes: Wishes
) -> Bootable:
    """A generated driver's robots are those of its configuration; they start at 0."""
    if wishes.robot:
        raise refusal(
            "RG901",
            None,
            f"{config.name} has its own robot, and --robot is for programs that name none",
            "leave it out",
        )
    system = _entered(in_its_cell(system, config), wishes.entry)
    found = Bootable(config.name, system, config.groups, True, notes)
    return _surrounded(found, _described(wishes), wishes)


def _foreign(system: System, notes: list[Diagnostic] | None, wishes: Wishes) -> Bootable:
    cell = _described(wishes)
    system = _moving(system, cell)
    groups, which = mechanics(system, wishes.robot, cell.robots)
    told = () if notes is None else (*notes, *which)
    return _surrounded(Bootable(system.name, system, groups, False, told), cell, wishes)


def _described(wishes: Wishes) -> CellDescription:
    told = str(wishes.cell) not in ("", GUESS)
    return load_cell(Path(wishes.cell)) if told else CellDescription()


def _surrounded(found: Bootable, cell: CellDescription, wishes: Wishes) -> Bootable:
    guessed = None
    if str(wishes.cell) == GUESS:
        units = [u for g in found.groups for u in (g.mechanical_unit, *g.external_units)]
        guessed = guess(found.system, units)
        cell = guessed.cell
    inputs = [name.casefold() for name, keys in cell.signals.items() if keys.kind.endswith("I")]
    return replace(
        found,
        system=furnish(found.system, cell),
        surroundings=Surroundings(
            dict(_starts(found.groups, cell, wishes.start, usual=not found.driver)),
            tuple(reaction for rows in cell.devices.values() for reaction in rows),
            frozenset(inputs if guessed is not None else ()),
            guessed.polled if guessed is not None else (),
        ),
        guessed=guessed,
    )


def _moving(system: System, cell: CellDescription) -> System:
    """The tasks that a cell has a robot for are motion tasks."""
    names = {task.name.casefold(): task.name for task in system.tasks}
    for task in cell.robots:
        if task.casefold() not in names:
            raise refusal(
                "RG434",
                None,
                f"the cell has a robot for {task}, and there is no such task",
                suggest(task, list(names.values())) or f"there are {', '.join(names.values())}",
            )
    moved = {task.casefold() for task in cell.robots}
    tasks = (
        replace(t, motion=t.motion or t.name.casefold() in moved) if moved else t
        for t in system.tasks
    )
    return replace(system, tasks=tuple(tasks))


def _starts(
    groups: Sequence[GroupConfig], cell: CellDescription, first: Sequence[float], *, usual: bool
) -> Iterator[tuple[str, tuple[float, ...]]]:
    described = {task.casefold(): robot.start for task, robot in cell.robots.items()}
    for i, group in enumerate(groups):
        values = described.get(group.task.casefold())
        if first and i == 0:
            yield group.name, start_of(group, first, "--start")
        elif values:
            yield group.name, start_of(group, values, f"`start` of {group.task}")
        elif usual:
            yield group.name, usual_start(group)


def _only_of_folders(target: str, wishes: Wishes) -> None:
    """What is no generated folder is loaded onto no backup."""
    if wishes.backup is not None:
        raise refusal(
            "RG433",
            None,
            f"'{target}' is no generated folder, and --backup is what one is loaded onto",
            "build it first: `rapidgen build CONFIG --backup FOLDER`",
        )
