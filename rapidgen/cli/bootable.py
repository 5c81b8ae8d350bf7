"""What `run` and `sim` boot: configuration, shipped name, generated folder or backup."""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, refusal

if TYPE_CHECKING:
    from rapidgen.config.model import GroupConfig
    from rapidgen.system import System
    from rapidgen.system.controller_cfg import ControllerCfg


@dataclass(frozen=True, slots=True)
class Bootable:
    """A controller that can be booted. `driver` tells whether it runs a generated driver."""

    name: str
    system: "System"
    groups: tuple["GroupConfig", ...]
    driver: bool
    notes: tuple[Diagnostic, ...] = ()
    cfg: "ControllerCfg | None" = None
    """All domains of a backup."""


def load_target(
    target: str,
    robot: str = "",
    overrides: Iterable[str] = (),
    backup: Path | None = None,
) -> Bootable:
    """Read a TARGET. `robot` names the mechanics of a backup, else its robot types tell them.
    `backup` is of the controller that a generated folder is loaded onto.

    Raises DiagnosticError.
    """
    path = Path(target)
    if path.is_dir():
        return _folder(path, robot, backup)
    if backup is not None:
        raise only_of_folders(target)
    if path.is_file() and path.suffix.lower() not in (".yaml", ".yml"):
        raise _no_target(target)
    from rapidgen.config import load_config
    from rapidgen.controller.cell import in_its_cell
    from rapidgen.generate import build, make_system

    config = load_config(target, overrides=tuple(overrides))
    system = in_its_cell(make_system(config, build(config)), config)
    return Bootable(config.name, system, config.groups, True, tuple(config.diagnostics))


def _folder(path: Path, robot: str, backup: Path | None) -> Bootable:
    from rapidgen.config import from_manifest
    from rapidgen.controller.cell import in_its_cell
    from rapidgen.controller.mechanics import mechanics
    from rapidgen.system import is_backup, is_generated, read_folder, read_manifest, read_system
    from rapidgen.system.backup import backup_cfg

    notes: list[Diagnostic] = []
    if is_generated(path):
        config = from_manifest(read_manifest(path)["configuration"])
        system = in_its_cell(read_folder(path, backup, notes=notes), config)
        return Bootable(config.name, system, config.groups, True, tuple(notes))
    if backup is not None:
        raise only_of_folders(str(path))
    system = read_system(path, notes=notes)
    groups, more = mechanics(system, robot)
    cfg = backup_cfg(path, system.robotware, []) if is_backup(path) else None
    return Bootable(system.name, system, groups, False, (*notes, *more), cfg)


def only_of_folders(target: str) -> Exception:
    """What is no generated folder is loaded onto no backup."""
    return refusal(
        "RG433",
        None,
        f"'{target}' is no generated folder, and --backup is what one is loaded onto",
        "build it first: `rapidgen build CONFIG --backup FOLDER`",
    )


def _no_target(target: str) -> Exception:
    return refusal(
        "RG433",
        None,
        f"'{target}' is no controller",
        "name a configuration, a shipped model, a generated folder or a backup;"
        " `rapidgen run` executes single RAPID files",
    )


def refuse_unloadable(system: "System") -> None:
    """Refuse what no controller loads; names that nothing declares are found when reached.

    Warnings are `rapidgen check`'s business. Raises DiagnosticError with all errors.
    """
    from rapidgen.rapid import check

    errors = [d for d in check(system, gaps=True) if d.severity is Severity.ERROR]
    if errors:
        raise DiagnosticError(errors)
