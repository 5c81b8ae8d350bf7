"""Checker: errors of a program that are known before execution.

`check` takes a module, modules that belong together, or a `System`. `CheckContext` decides whether
an unknown name is an error.
"""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType

from rapidgen.diagnostics import Diagnostic, Severity, Span, error
from rapidgen.rapid.binding import (
    DataSymbol,
    ModuleScope,
    RoutineSymbol,
    Symbol,
    TaskScope,
    installed_objects,
)
from rapidgen.rapid.checks.context import CheckContext, Payload
from rapidgen.rapid.checks.declarations import check_module
from rapidgen.rapid.checks.findings import Findings
from rapidgen.rapid.checks.motion_tasks import moves_without_robot
from rapidgen.rapid.dialect import Dialect
from rapidgen.rapid.module_trees import tree_of
from rapidgen.rapid.syntax.nodes import Module
from rapidgen.rapid.syntax.parser import parse
from rapidgen.system import System, TaskSpec

_CHECKABLE = frozenset(("RG213", "RG215", "RG216", "RG220"))
"""Errors of the text whose tree can be checked nevertheless."""
_LOADERS = frozenset(("load", "startload"))
_SIGNAL_TYPES = {
    "DI": "signaldi",
    "DO": "signaldo",
    "GI": "signalgi",
    "GO": "signalgo",
    "AI": "signalai",
    "AO": "signalao",
}


def check(
    given: Module | Iterable[Module] | System | str | bytes,
    *,
    dialect: Dialect | None = None,
    path: str | None = None,
    gaps: bool = False,
    elsewhere: Collection[str] = frozenset(),
    payloads: Mapping[str, Payload] = MappingProxyType({}),
    strict: bool = False,
    configured: bool = True,
) -> list[Diagnostic]:
    """Return all errors of a text, a module, related modules, or a system.

    Other modules may declare what the given ones do not; `elsewhere` are lower-case names of
    further given modules. A system declares everything, unless `gaps` names a missing source of
    names. `strict`: an unknown name is an error wherever it may be declared; objects of the
    configuration (signals, tasks) only in a system that is `configured`, which has its cfg files.
    A system's own RobotWare applies unless `dialect` is given. `payloads` are those of the
    robots by the lower-case name of the task that moves them; modules without a task use an empty
    name. Errors of the parser are included. The result is sorted by place.
    """
    if isinstance(given, System):
        return _check_system(
            given,
            dialect or Dialect(given.robotware, some=not given.is_robotware_known),
            gaps,
            payloads,
            strict=strict,
            configured=configured,
        )
    dialect = dialect or Dialect()
    if isinstance(given, str | bytes):
        given = parse(given, path=path, dialect=dialect)
    if isinstance(given, Module):
        given = [given]
    modules = list(given)
    extent = CheckContext(
        dialect,
        gaps=_any_unreadable(modules),
        configured=False,
        strict=strict,
        elsewhere=elsewhere,
        payload=payloads.get(""),
    )
    return _check_modules(modules, extent)


def _check_modules(modules: Sequence[Module], given: CheckContext) -> list[Diagnostic]:
    """Check modules of one folder.

    They may belong to several tasks, so equal names do not clash.
    """
    task = TaskScope()
    scopes = [task.add(module) for module in modules]
    for clash in task.clashes:
        task.conflicting_objects(clash)
    return _sorted(d for scope in scopes for d in _check_module(scope, given))


def _check_module(
    scope: ModuleScope,
    given: CheckContext,
    clashes: Sequence[tuple[Symbol, Symbol]] = (),
    entry: str = "",
) -> list[Diagnostic]:
    """Check one module; `clashes` are those with other modules.

    The task starts in `entry`.
    """
    findings = Findings(scope, given)
    for first, second in scope.clashes:
        _clash(findings, first, second, "in this module")
    diagnostics = scope.tree.diagnostics
    if all(d.code in _CHECKABLE or d.severity is not Severity.ERROR for d in diagnostics):
        check_module(findings)
    for first, second in clashes:
        if second.module is scope:
            _clash(findings, first, second, "in this task", entry)
    return [*diagnostics, *findings.found]


def _clash(findings: Findings, first: Symbol, second: Symbol, where: str, entry: str = "") -> None:
    named = isinstance(second, DataSymbol | RoutineSymbol)
    head = second.node.first if second.node is not None else 0
    # RobotWare 7.21 loads such modules: "Global routine name main ambiguous" comes at the start.
    starts = second.name.lower() == entry.lower() and isinstance(second, RoutineSymbol)
    notes = ("only the start of this task is refused",) if starts else ()
    findings.report(
        "RG305",
        f"'{second.name}' is declared twice {where}",
        second.token if named else head,
        notes=("objects of one scope differ in name [K §2.12, 9.1]", *notes),
        related=findings.declared(first),
        severity=Severity.WARNING if starts else Severity.ERROR,
    )


# -- systems ---------------------------------------------------------------------------------


def _check_system(
    system: System,
    dialect: Dialect,
    gaps: bool,
    payloads: Mapping[str, Payload],
    *,
    strict: bool,
    configured: bool,
) -> list[Diagnostic]:
    objects = installed_objects(_installed(system))
    findings: list[Diagnostic] = []
    has_robot = any(spec.motion for spec in system.tasks)
    for spec in system.tasks:
        task = TaskScope(objects)
        scopes = []
        for file in spec.modules:
            module = tree_of(file, dialect)
            scopes.append(task.add(module, installed=file.installed or file.shared))
        modules = [scope.tree for scope in scopes]
        given = CheckContext(
            dialect,
            True,
            _any_unreadable(modules) or (not strict and (gaps or _loads(modules))),
            configured=configured,
            strict=strict,
            payload=payloads.get(spec.name.lower()),
        )
        for scope in scopes:
            findings += _check_module(scope, given, task.clashes, spec.entry)
        findings += _entry(spec, task, given)
        if has_robot and not spec.motion:
            for one in moves_without_robot(spec, task, given):
                findings += one.found
    return _sorted(dict.fromkeys(findings))  # a module may be in several tasks


def _entry(spec: TaskSpec, task: TaskScope, given: CheckContext) -> list[Diagnostic]:
    """Check that a task starts in a procedure without parameters [K §9].

    A task without modules never starts.
    """
    symbol = task.find(spec.entry.lower())
    if not isinstance(symbol, RoutineSymbol) or symbol.module is None or symbol.node is None:
        if given.gaps or not spec.modules:
            return []
        # A backup of a task without a program has system modules alone.
        modules = [scope.tree for scope in task.modules.values()]
        has_program = any("SYSMODULE" not in module.attributes for module in modules)
        return [
            error(
                "RG331",
                Span(spec.modules[0].path, 1, 1),
                f"the task {spec.name} has no procedure '{spec.entry}' to start in",
                f"declare PROC {spec.entry}() in one of its modules, or name another entry",
                severity=Severity.WARNING if has_program else Severity.INFO,
            )
        ]
    if symbol.kind == "PROC" and not symbol.node.parameters:
        return []
    what = "has parameters" if symbol.kind == "PROC" else f"is a {symbol.kind}"
    findings = Findings(symbol.module, given)
    findings.report(
        "RG331",
        f"the task {spec.name} starts in '{symbol.name}', but that {what}",
        symbol.token,
        help=f"write PROC {symbol.name}()",
        notes=("the entry routine is a procedure without parameters [K §9]",),
    )
    return findings.found


def _installed(system: System) -> Iterator[tuple[str, str]]:
    """Iterate over name and type of installed objects.

    These are signals, mechanical units and task identities of a configuration.
    """
    for signal in system.signals:
        yield signal.name, _SIGNAL_TYPES[signal.type]
    for group in system.groups:
        for unit in (group.robot, *group.units):
            if unit:
                yield unit, "mecunit"
    for task in system.tasks:
        yield f"{task.name}Id", "taskid"
    for camera in system.cameras:
        yield camera, "cameradev"


def _unreadable(module: Module) -> bool:
    """Return True if some declarations of a file are unknown."""
    return not module.name or any(
        d.severity is Severity.ERROR or d.code == "RG217" for d in module.diagnostics
    )


def _any_unreadable(modules: Iterable[Module]) -> bool:
    return any(_unreadable(module) for module in modules)


def _loads(modules: Iterable[Module]) -> bool:
    """Return True if a program loads modules during execution."""
    return any(
        token.lower() in _LOADERS for module in modules for token in set(module.source.tokens)
    )


def _sorted(findings: Iterable[Diagnostic]) -> list[Diagnostic]:
    def key(d: Diagnostic) -> tuple[str, int, int]:
        return (d.span.path, d.span.line, d.span.column) if d.span else ("", 0, 0)

    return sorted(findings, key=key)


__all__ = ["Payload", "check"]
