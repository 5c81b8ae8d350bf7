"""Warm start: a new controller from cfg database, disks and modules.

Program memory survives a warm start. Modules in CAB_TASK_MODULES that are not loaded are loaded
from their files, those of SEMISTATIC tasks always. Persistents keep their values; VARs, sockets,
paths and program pointers do not. (A real NORMAL task keeps its program pointer; here it is at
main.) A module that cannot be loaded causes a system failure, which an event reports.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from rapidgen.controller.controller import ControllerOptions, VirtualController
from rapidgen.controller.external_axes import with_limits
from rapidgen.controller.programs import Programs, UnlinkedModule
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity
from rapidgen.rapid import Dialect, parse
from rapidgen.system.cfg_reader import ModuleEntry, modules_of, tasks_of, with_cfg
from rapidgen.system.controller_cfg import ControllerCfg
from rapidgen.system.loading import load_module
from rapidgen.system.model import ModuleFile, System, TaskSpec
from rapidgen.system.paths import home_file

PersistedState = Mapping[str, tuple[ModuleFile, ...]]
"""Modules that lay in each task."""
_PROGRAM_ERRORS = 40_160
_SYSTEM_FAILURE = 192_095
_NOT_LOADED = 194_165


@dataclass(slots=True)
class _Task:
    spec: TaskSpec
    broken: list[UnlinkedModule]
    missing: list[str]


def boot(
    old: VirtualController,
    persisted: PersistedState,
    cfg: ControllerCfg,
    options: ControllerOptions,
) -> tuple[VirtualController, Programs]:
    """Return the controller after a warm start.

    Motors are off, background tasks run. Invalid cfg leaves the old tasks and signals, and is a
    system failure.
    """
    events: list[tuple[int, str, str, str]] = []
    before = replace(old.system, home=None, home_below=None, cfg=cfg)
    sys, eio = cfg.domain("SYS"), cfg.domain("EIO")
    entries, home = modules_of(sys), old.files.path("HOME:")
    try:
        tasks = [_task(spec, persisted, entries, home, before) for spec in tasks_of(sys)]
        system = with_cfg(before, sys, eio)
    except DiagnosticError as fault:
        tasks = [_Task(replace(t, modules=persisted.get(t.name, ())), [], []) for t in before.tasks]
        system = before
        why = [d.message for d in fault.diagnostics]
        events += [(_SYSTEM_FAILURE, "Configuration error", text, "") for text in why]
    robots = (group.config for group in old.motion.groups.values())
    options["robots"] = tuple(with_limits(robot, cfg) for robot in robots)
    options["autostart"] = options["entry_needed"] = False
    options["faults"] = None  # a plan's times are those of the first run
    controller = _booted(system, tasks, options)
    for name, group in controller.motion.groups.items():
        # The robot has not moved meanwhile.
        group.jump(old.motion.group(name).positions())
    programs = Programs(controller)
    for task in tasks:
        name = task.spec.name
        broken = programs.broken[name] = {b.file.name.lower(): b for b in task.broken}
        programs.put_clashes_aside(controller.rapid_tasks[name])
        events += [
            (_PROGRAM_ERRORS, "Errors in RAPID program", f"{d.message} ({b.file.path})", name)
            for b in broken.values()
            for d in b.faults
        ]
        events += [(_NOT_LOADED, "Module not loaded", file, name) for file in task.missing]
    controller.set_motors(False)
    for code, title, text, name in events:
        controller.log.error(code, title, text, task=name)
    if events:
        controller.operation.fail()
    for running in controller.rapid_tasks.values():
        if running.spec.type != "NORMAL" and not events:
            running.start()
    return controller, programs


def _task(
    spec: TaskSpec,
    persisted: PersistedState,
    entries: tuple[ModuleEntry, ...],
    home: Path,
    before: System,
) -> _Task:
    """Return a task with its modules and those of its files."""
    match = {m.name.casefold(): m for m in persisted.get(spec.name, ())}
    if spec.name not in persisted:
        # A new task has what is loaded into all of them.
        match = {m.name.casefold(): m for t in before.tasks for m in t.modules if m.shared}
    missing = []
    for entry in entries:
        if not entry.loads_into(spec):
            continue
        path = home_file(home, entry.file) if entry.file.upper().startswith("HOME:") else None
        stem = entry.file.replace("\\", "/").rpartition("/")[2].rpartition(".")[0].casefold()
        if spec.type == "NORMAL" and _has(match, entry.file, stem):
            continue
        if path is None or not path.is_file():
            if not _has(match, entry.file, stem):
                missing.append(entry.file)
            continue
        file = load_module(path, target=entry.file, shared=entry.shared, installed=entry.installed)
        match[file.name.casefold()] = replace(file, path=entry.file)
    good: list[ModuleFile] = []
    broken: list[UnlinkedModule] = []
    for file in match.values():
        faults = _faults(file, before.robotware)
        if faults:
            broken.append(UnlinkedModule(file, faults))
        else:
            good.append(file)
    return _Task(replace(spec, modules=tuple(good)), broken, missing)


def _has(result: Mapping[str, ModuleFile], target: str, stem: str) -> bool:
    return stem in result or any(m.target.casefold() == target.casefold() for m in result.values())


def _faults(file: ModuleFile, robotware: tuple[int, int]) -> tuple[Diagnostic, ...]:
    tree = parse(file.data, path=file.path, dialect=Dialect(robotware=robotware))
    return tuple(d for d in tree.diagnostics if d.severity is Severity.ERROR)


def _booted(system: System, tasks: list[_Task], options: ControllerOptions) -> VirtualController:
    """Return a controller of these tasks.

    It leaves out modules that cannot be linked.
    """
    while True:
        complete = replace(system, tasks=tuple(task.spec for task in tasks))
        try:
            return VirtualController(complete, **options)
        except DiagnosticError as fault:
            if not _put_aside(tasks, fault.diagnostics):
                raise


def _put_aside(tasks: list[_Task], findings: Sequence[Diagnostic]) -> bool:
    """Remove modules with errors from their tasks.

    Returns False if there is none to remove.
    """
    errors = [d for d in findings if d.severity is Severity.ERROR]
    paths = {d.span.path for d in errors if d.span is not None}
    some = False
    for task in tasks:
        for file in task.spec.modules:
            if file.path in paths or not paths:
                own = tuple(d for d in errors if d.span is None or d.span.path == file.path)
                task.broken.append(UnlinkedModule(file, own))
                some = True
        gone = {b.file.name for b in task.broken}
        left = tuple(m for m in task.spec.modules if m.name not in gone)
        task.spec = replace(task.spec, modules=left)
    return some
