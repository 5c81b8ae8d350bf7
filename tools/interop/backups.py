"""Trial: build drivers for backups of real cells.

    python -m tools.interop.backups FOLDER     (or: make interop PROGRAM=backups FOREIGN=FOLDER)

FOLDER holds backups at any depth. Each is read as a controller: the rules for generated files apply
to all its cfg files, which must not violate any, since it ran. Then a driver is built for it, with
the shipped robot that its MOC.cfg names (else an irb120 or a crb15000), loaded onto it, and
compared: the cell's own instances must be unchanged. The output includes the number of checker
errors in its RAPID alone, and with the driver.
"""

import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from rapidgen.config import load_config
from rapidgen.config.model import RobotConfig
from rapidgen.controller.mechanics import model_of
from rapidgen.diagnostics import DiagnosticError, Severity
from rapidgen.generate import build, make_system
from rapidgen.generate.existing_controller import Cell, fit, read_cell
from rapidgen.rapid import check
from rapidgen.system import System, is_backup, parse_cfg
from rapidgen.system.build_loading import of_backup
from rapidgen.system.cfg_loading import CfgFileLoad, add


@dataclass(frozen=True)
class Answer:
    """Result of a backup; `build` is a sentence."""

    name: str
    release: str
    rules: str
    build: str
    rapid: str


def answer(folder: Path, name: str) -> Answer:
    """Read a backup and build for it."""
    try:
        cell = read_cell(folder)
    except DiagnosticError as refused:
        return Answer(name, "?", f"does not load: {refused}", "-", "-")
    broken = [note for note in cell.notes if note.code not in ("RG710", "RG713")]
    rules = ", ".join(f"{n.code} {n.message}" for n in broken) or "loads"
    release = f"{cell.system.robotware[0]}.{cell.system.robotware[1]:02d}"
    alone = errors(cell.system)
    try:
        config = fit(robot(cell), cell)
        output = build(config, cell)
        system = make_system(config, output, under=of_backup(cell.cfg, cell.system))
    except DiagnosticError as refused:
        result = "; ".join(f"{d.code} {d.message}" for d in refused.diagnostics[:4])
        return Answer(name, release, rules, f"refused: {result}", str(alone))
    files = [f for f in output.files if f.kind == "cfg"]
    arguments = tuple(
        CfgFileLoad(parse_cfg(f.data), f.path.endswith("_open.cfg"), f.path == "SIO.cfg")
        for f in files
    )
    lost = list(changed(cell, arguments))
    if lost:
        return Answer(name, release, rules, f"changes {', '.join(lost)}", str(alone))
    group = ", ".join(f"{g.task}/{g.mechanical_unit}" for g in config.groups)
    main = "main: own" if not config.call_main else "main: ours"
    text = f"adds {sum(counts(arguments))} instances ({group}, {main})"
    return Answer(name, release, rules, text, f"{alone}, with the driver {errors(system)}")


def robot(cell: Cell) -> RobotConfig:
    """Return the shipped robot of the cell's type, or of its generation."""
    models = [model_of(robot_type) for _, robot_type in cell.system.robot_types]
    default = "crb15000" if cell.system.robotware[0] >= 7 else "irb120"
    return load_config(next(filter(None, models), default))


def changed(cell: Cell, arguments: tuple[CfgFileLoad, ...]) -> Iterator[str]:
    """Yield the cell's instances that are missing after loading.

    A firewall service may be opened.
    """
    after = add(cell.cfg, arguments).cfg
    for before in cell.cfg.domains:
        for section in before.sections:
            target = list(after.instances(before.domain, section.name))
            for instance in section.instances:
                if section.name != "FIREWALL_MANAGEMENT" and instance not in target:
                    yield f"{before.domain} {section.name} {instance.text('Name')}"


def counts(arguments: tuple[CfgFileLoad, ...]) -> Iterator[int]:
    """Yield the number of instances of each file."""
    for addition in arguments:
        yield sum(len(section.instances) for section in addition.file.sections)


def errors(system: System) -> int:
    """Return the checker's errors in a system's RAPID.

    References to parts outside the backup do not count.
    """
    return sum(d.severity is Severity.ERROR for d in check(system, gaps=True))


def main(folder: Path) -> None:
    """Print a table with a row for each backup."""
    print("| backup | RobotWare | its cfg | build --backup | RAPID errors |\n|---|---|---|---|---|")
    for place in sorted(p for p in (folder, *folder.rglob("*")) if p.is_dir() and is_backup(p)):
        row = answer(place, str(place.relative_to(folder)))
        print(f"| {row.name} | {row.release} | {row.rules} | {row.build} | {row.rapid} |")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
