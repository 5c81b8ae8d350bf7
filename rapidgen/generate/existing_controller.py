"""Build for an existing controller: reuse its backup, add the rest.

From the backup come the release, the digits of the cfg headers, the motion tasks, mechanical units
and unit groups, signals, and whether the user's program has a `main` (then it calls the driver).
"""

from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from rapidgen.config.model import GroupConfig, RobotConfig
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, Span, error, refusal
from rapidgen.generate.context import data_of_another
from rapidgen.generate.layout import modules
from rapidgen.generate.output import Output
from rapidgen.rapid import check, parse
from rapidgen.rapid.syntax.nodes import DataDeclaration
from rapidgen.system import Attribute, CfgText, Instance, Section, System
from rapidgen.system.backup import backup_cfg, read_backup
from rapidgen.system.build_loading import module_stem
from rapidgen.system.cfg_loading import identity, identity_text
from rapidgen.system.cfg_reader import modules_of
from rapidgen.system.controller_cfg import ControllerCfg
from rapidgen.system.model import TaskSpec
from rapidgen.system.releases import known_digits

_OMNICORE_SINCE = 7


@dataclass(frozen=True, slots=True)
class Cell:
    """A backup: its tasks with their modules, and its cfg."""

    system: System
    cfg: ControllerCfg
    notes: tuple[Diagnostic, ...] = ()


def read_cell(folder: Path | str) -> Cell:
    """Return the cell in a backup.

    Raises DiagnosticError RG701..RG712.
    """
    notes: list[Diagnostic] = []
    system = read_backup(folder, notes=notes)
    cfg = backup_cfg(Path(folder), system.robotware, notes)
    return Cell(system, cfg, tuple(dict.fromkeys(notes)))


# -- the configuration ----------------------------------------------------------------------------


def fit(config: RobotConfig, cell: Cell) -> RobotConfig:
    """Return the configuration with the cell's names and release.

    Raises DiagnosticError RG111 if its groups are not the cell's.
    """
    robotware = cell.system.robotware
    if (config.controller == "omnicore") != (robotware[0] >= _OMNICORE_SINCE):
        raise _unfit(
            f"the backup is of RobotWare {robotware[0]}, '{config.controller}' is another family",
            "set controller.type to the cell's type",
        )
    header = tuple(
        (text.domain, *text.version)
        for text in cell.cfg.domains
        if text.version is not None
        and text.domain in ("SYS", "EIO", "SIO")
        and text.version != known_digits(text.domain, robotware)
    )
    ours = {name.casefold() for group in config.groups for name in modules(config, group)}
    own_main = any(_has_main(task, ours) for task in cell.system.tasks if task.motion)
    return replace(
        config,
        robotware=robotware,
        cfg_header=header,
        multimove=bool(cell.cfg.unit_groups) and len(config.groups) == 1,
        call_main=config.call_main and not own_main,
        groups=_groups(config, cell),
    )


def _groups(config: RobotConfig, cell: Cell) -> tuple[GroupConfig, ...]:
    """Return each group with its motion task, by mechanical unit or name."""
    units = _units(cell.system)
    fitted = []
    for group in config.groups:
        by_unit = [t for t in units if units[t].casefold() == group.mechanical_unit.casefold()]
        by_name = [t for t in units if t.casefold() == group.task.casefold()]
        only = list(units) if len(units) == len(config.groups) == 1 else []
        result = (by_unit if len(by_unit) == 1 else []) or by_name or only
        if not result:
            known = ", ".join(f"{task} moves {unit}" for task, unit in units.items())
            raise _unfit(
                f"no motion task of the cell is group '{group.name}' ({group.task}, "
                f"{group.mechanical_unit})",
                f"name them as the cell has them: {known or 'it has no motion task'}",
            )
        task = next(t for t in cell.system.tasks if t.name == result[0])
        unit = units[task.name] or group.mechanical_unit
        fitted.append(
            replace(
                group,
                task=task.name,
                mechanical_unit=unit,
                unit_group=task.mechanical_unit_group,
            )
        )
        _check_external(group, cell)
    if len({group.task for group in fitted}) < len(fitted):
        raise _unfit(
            "two groups would be one motion task of the cell", "name their mechanical units"
        )
    return tuple(fitted)


def _units(system: System) -> dict[str, str]:
    """Return the robot of each motion task.

    It comes from its unit group, or from MOC without groups.
    """
    robots = {group.name.casefold(): group.robot for group in system.groups}
    only = system.robot_types[0][0] if system.robot_types else ""
    return {
        task.name: robots.get(task.mechanical_unit_group.casefold(), "" if robots else only)
        for task in system.tasks
        if task.motion
    }


def _check_external(group: GroupConfig, cell: Cell) -> None:
    missing = [u for u in group.external_units if u.casefold() not in cell.cfg.units]
    if missing:
        raise _unfit(
            f"the cell has no mechanical unit '{missing[0]}' (group '{group.name}')",
            f"its units are {', '.join(sorted(cell.cfg.units))}",
        )


def _has_main(task: TaskSpec, ours: Collection[str]) -> bool:
    """True if the user's program has the task's entry.

    An existing driver does not count.
    """
    entry = task.entry.casefold()
    return any(
        routine.name.casefold() == entry
        for module in task.modules
        if module.name.casefold() not in ours
        for routine in parse(module.data, path=module.path).routines
    )


def _unfit(message: str, help: str) -> DiagnosticError:
    return refusal("RG111", None, message, help)


# -- the cfg files --------------------------------------------------------------------------------


def missing(texts: Iterable[tuple[str, CfgText]], cell: Cell) -> tuple[tuple[str, CfgText], ...]:
    """Return the parts of the files that the cell lacks; omit empty files.

    Raises DiagnosticError RG110 for conflicts.
    """
    given = tuple(texts)
    faults = [fault for _, text in given for fault in _conflicts(text, cell)]
    if faults:
        raise DiagnosticError(faults)
    saved = []
    for name, text in given:
        sections = tuple(
            Section(section.name, instances)
            for section in text.sections
            if (instances := tuple(_lacking(text, section, cell)))
        )
        if sections:
            saved.append((name, replace(text, sections=sections)))
    return tuple(saved)


def used_signals(texts: Iterable[tuple[str, CfgText]], cell: Cell) -> dict[str, str]:
    """Return the files' signals that the cell has, with their types."""
    names = (i.text("Name") for _, text in texts for i in text.instances("EIO_SIGNAL"))
    result = {name: cell.cfg.signal(name) for name in names}
    return {name: old.text("SignalType") for name, old in result.items() if old is not None}


def _lacking(text: CfgText, section: Section, cell: Cell) -> Iterator[Instance]:
    for instance in section.instances:
        old = _existing(text, section, instance, cell)
        if section.name == "FIREWALL_MANAGEMENT" and old is not None:
            # The instance is replaced: what the cell opened stays open.
            merged = _merged(old, instance)
            if not _same(merged, old):
                yield merged
        elif old is None:
            yield _in_order(instance, cell) if section.name == "CAB_EXEC_HOOKS" else instance


def _existing(text: CfgText, section: Section, instance: Instance, cell: Cell) -> Instance | None:
    key = identity(section.name, instance)
    there = cell.cfg.instances(text.domain, section.name)
    return next((old for old in there if identity(section.name, old) == key), None)


def _conflicts(text: CfgText, cell: Cell) -> Iterator[Diagnostic]:
    """Yield conflicts, and modules of the same name from other drivers.

    Those are abb_driver's, or an older build's.
    """
    for section in text.sections:
        for instance in section.instances:
            old = _existing(text, section, instance, cell)
            if old is None or section.name == "FIREWALL_MANAGEMENT":
                continue
            if section.name == "EIO_SIGNAL":
                # A signal of the same type is used, whatever its other attributes.
                same = old.text("SignalType").upper() == instance.text("SignalType").upper()
            elif section.name == "CAB_EXEC_HOOKS":
                # The cell decides the order.
                same = True
            else:
                same = _same(old, instance)
            if not same:
                name = " ".join(filter(None, identity_text(section.name, instance)))
                yield _conflict(cell, text.domain, section.name, name, old.line)
    if text.domain == "SYS":
        yield from _module_conflicts(text, cell)


def _module_conflicts(text: CfgText, cell: Cell) -> Iterator[Diagnostic]:
    """Report generated modules that a task would have twice.

    The second comes from another file of the cell.
    """
    entries = tuple(zip(text.instances("CAB_TASK_MODULES"), modules_of(text), strict=True))
    ours = {_name(instance): entry.file.casefold() for instance, entry in entries}
    tasks = {task.casefold() for _, entry in entries for task in entry.tasks}
    sys = cell.cfg.domain("SYS")
    foreign = tuple(zip(sys.instances("CAB_TASK_MODULES"), modules_of(sys), strict=True))
    reported = set()
    for instance, entry in foreign:
        name = _name(instance)
        if ours.get(name) == entry.file.casefold():
            # An earlier load of this build; the backup has a copy of it in RAPID.
            reported.add(name)
            continue
        everywhere = entry.all_tasks or entry.all_motion_tasks or entry.shared
        reached = everywhere or any(task.casefold() in tasks for task in entry.tasks)
        if reached and name in ours:
            reported.add(name)
            folder = entry.file.rpartition("/")[0].casefold()
            adjacent = [
                o.file for _, o in foreign if o.file.rpartition("/")[0].casefold() == folder
            ]
            yield _another_driver(
                f"the cell loads a module {instance.text('ModName') or name} of its own, "
                f"'{entry.file}'",
                Span(sys.path, max(entry.line, 1), 1),
                f"from the same folder: {', '.join(adjacent)}",
            )
    for task in cell.system.tasks:
        for module in task.modules:
            key, file = module.name.casefold(), module.target.casefold()
            if (
                task.name.casefold() in tasks
                and key not in reported
                and ours.get(key, file) != file
            ):
                yield _another_driver(
                    f"task {task.name} of the cell has a module {module.name} of its own",
                    Span(module.path, 1, 1),
                )


def _name(instance: Instance) -> str:
    return (instance.text("ModName") or module_stem(instance.text("File"))).casefold()


def _another_driver(message: str, at: Span, *notes: str) -> Diagnostic:
    help = "take the other driver out of the cell first: two of one name cannot be loaded together"
    return error("RG110", at, message, help, notes=notes)


def _conflict(cell: Cell, domain: str, section: str, name: str, line: int) -> Diagnostic:
    return error(
        "RG110",
        Span(cell.cfg.domain(domain).path, max(line, 1), 1),
        f"the cell has {section} '{name}', and not as this build has it",
        "take the instance out of the cell first, or give ours another name in the configuration",
    )


def _in_order(hook: Instance, cell: Cell) -> Instance:
    """Return a hook with a -SeqNo that is unique for its event and task."""
    shelf, task = hook.text("Shelf").casefold(), hook.text("Task").casefold()
    in_use = {
        old.number("SeqNo")
        for old in cell.cfg.instances("SYS", "CAB_EXEC_HOOKS")
        if old.text("Shelf").casefold() == shelf
        and (old.text("Task").casefold() in ("", task) or old.flag("AllMotionTask"))
    }
    order = int(hook.number("SeqNo"))
    while order in in_use:
        order += 1
    return Instance(
        tuple(Attribute("SeqNo", (order,)) if a.name == "SeqNo" else a for a in hook.attributes)
    )


def _merged(old: Instance, new: Instance) -> Instance:
    named = {attribute.name.casefold() for attribute in old.attributes}
    more = tuple(a for a in new.attributes if a.name.casefold() not in named)
    return Instance((*old.attributes, *more))


def _same(one: Instance, other: Instance) -> bool:
    return _values(one) == _values(other)


def _values(instance: Instance) -> dict[str, tuple[str, ...]]:
    return {
        a.name.casefold(): tuple(str(value).casefold() for value in a.values)
        for a in instance.attributes
    }


# -- the modules ----------------------------------------------------------------------------------


def check_link_conflicts(system: System, output: Output) -> None:
    """Reject a driver whose modules do not link with the cell's program.

    A global name of the program hides a predefined one, or clashes with a global one of the driver.
    Raises DiagnosticError RG112.
    """
    ours = {file.path for file in output.files if file.kind == "module"}
    faults = []
    for result in check(system, gaps=True):
        places = [at for at in (result.span, *(r.span for r in result.related)) if at is not None]
        if result.severity is Severity.ERROR and any(at.path in ours for at in places):
            foreign = [at for at in places if at.path not in ours]
            faults.append(
                error(
                    "RG112",
                    foreign[0] if foreign else None,
                    f"the cell's program is in the way of {places[0].path}, "
                    f"line {places[0].line}: {result.message}",
                    "rename it there, or declare it LOCAL",
                )
            )
    if faults:
        raise DiagnosticError(faults)


def check_data(config: RobotConfig, cell: System) -> None:
    """Reject external data that a cell's motion task does not declare.

    They must be PERS. The driver also names them in its other tasks: all declarations share one
    object [K §14.4]. Raises DiagnosticError RG113.
    """
    faults = []
    for group in config.groups:
        motion = [t for t in cell.tasks if t.name.casefold() == group.task.casefold()]
        for kind, name, _ in data_of_another(group):
            result = [d for task in motion for d in _declared(task, name)]
            if not any(_is_global(data, kind) for data, _ in result):
                wrong = (
                    f"{name} there is {_shown(result[0][0])}" if result else f"no {name} is there"
                )
                faults.append(
                    error(
                        "RG113",
                        result[0][1] if result else None,
                        f"the program of {group.task} has to declare {kind} {name}, and {wrong}",
                        f"declare it in a module of {group.task}: `PERS {kind} {name} := ...;`",
                    )
                )
    if faults:
        raise DiagnosticError(faults)


def _declared(task: TaskSpec, name: str) -> Iterator[tuple[DataDeclaration, Span]]:
    for module in task.modules:
        tree = parse(module.data, path=module.path)
        for data in tree.declarations:
            if isinstance(data, DataDeclaration) and data.name.casefold() == name.casefold():
                yield data, tree.source.span(data.name_token, data.name_token)


def _is_global(data: DataDeclaration, kind: str) -> bool:
    given = data.scope, data.kind, data.type.casefold(), len(data.dimensions)
    return given == ("", "PERS", kind, 0)


def _shown(data: DataDeclaration) -> str:
    words = (data.scope, data.kind, data.type)
    return " ".join(word for word in words if word) + (" with dimensions" * bool(data.dimensions))
