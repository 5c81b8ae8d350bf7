"""Loading of modules into tasks: parse once, link, report faults."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

from rapidgen.config.model import GroupConfig
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, error
from rapidgen.machine.io import IOSystem
from rapidgen.rapid.syntax import nodes as n
from rapidgen.runtime.compiler.link import find_type
from rapidgen.runtime.compiler.program import missing_routines
from rapidgen.runtime.compiler.symbols import Routine
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Type, Value
from rapidgen.system.model import ModuleFile, System


def load(
    tasks: Iterable[Task], tree_of: Callable[[ModuleFile], n.Module], *, entries_wanted: bool = True
) -> list[Diagnostic]:
    """Link the modules of tasks and return warnings.

    A task without its entry routine, or with two of them, cannot be started; the others can.
    DiagnosticError: a module cannot be loaded, or no task at all can be started.
    """
    tasks = list(tasks)
    findings: list[Diagnostic] = []
    for task in tasks:
        trees = [(tree_of(file), file) for file in task.spec.modules]
        for tree, _ in trees:
            findings += [d for d in tree.diagnostics if d not in findings]
        task.program.load([(t, f) for t, f in trees if t.name])
        findings += task.program.faults
        _tell_its_robot(task)
        key = task.spec.entry.lower()
        entry = task.program.find_routine(None, key)
        if any(first.name.lower() == key for first, _ in task.program.names.clashes):
            task.no_start = f"Global routine name {task.spec.entry} ambiguous"
        elif not isinstance(entry, Routine) or entry.kind != "PROC" or entry.parameters:
            task.no_start = f"no procedure {task.spec.entry} without parameters"
        if task.no_start:
            findings.append(_no_entry(task))
        else:
            task.state = "ready"
        findings += missing_routines(task.program)
    if all(task.scheduler.clock == "virtual" for task in tasks):
        findings += _unguided(tasks)
    if not entries_wanted or any(task.state == "ready" for task in tasks):
        findings = [
            replace(d, severity=Severity.WARNING) if d.code == "RG402" else d for d in findings
        ]
    if any(d.severity is Severity.ERROR for d in findings):
        raise DiagnosticError(findings)
    return findings


def _tell_its_robot(task: Task) -> None:
    """Set ROB_ID to the robot that the task moves or uses."""
    group = task.controller.motion.of_task(task.name)
    unit = task.program.value(None, "rob_id")
    unit.value = group.config.mechanical_unit if group is not None else ""


def _unguided(tasks: Iterable[Task]) -> list[Diagnostic]:
    """Return a note on all programs that use externally guided motion."""
    for module in (module for task in tasks for module in task.program.modules.values()):
        if b"egmsetupuc" not in module.file.data.lower():
            continue
        source = module.tree.source
        for at, token in enumerate(source.tokens):
            if token.lower() == "egmsetupuc":
                return [
                    error(
                        "RG408",
                        source.span(at, at),
                        "an EGM partner needs the real clock, or one that a test connects",
                        "`rapidgen sim` exchanges datagrams with it; tests call "
                        "`controller.egm.connect(device, partner)`",
                        label="without a partner the robot stands still, and its task waits",
                        severity=Severity.WARNING,
                    )
                ]
    return []


def _no_entry(task: Task) -> Diagnostic:
    return error(
        "RG402",
        None,
        f"task {task.name} cannot be started: {task.no_start}",
        f"declare PROC {task.spec.entry}() in one of its modules, or name another entry",
        severity=Severity.ERROR if task.spec.modules else Severity.WARNING,
    )


def configured(
    system: System, robots: Sequence[GroupConfig], io: IOSystem
) -> dict[str, tuple[Type, Value]]:
    """Return objects of the configuration by lower-case name.

    These are signals, mechanical units, taskids and cameras.
    """
    result: dict[str, tuple[Type, Value]] = {}
    for task in system.tasks:
        result[f"{task.name.lower()}id"] = _named("taskid", task.name)
    for group in robots:
        for unit in (group.mechanical_unit, *group.external_units):
            if unit:
                result[unit.lower()] = _named("mecunit", unit)
    for camera in system.cameras:
        result[camera.lower()] = _named("cameradev", camera)
    for signal in io.signals.values():
        kind = find_type(f"signal{signal.spec.type.lower()}")
        if kind is not None:
            result[signal.name.lower()] = (kind, signal)
    return result


def _named(type_name: str, name: str) -> tuple[Type, Value]:
    kind = find_type(type_name)
    assert kind is not None
    made = kind.default()
    made.value = name
    return kind, made
