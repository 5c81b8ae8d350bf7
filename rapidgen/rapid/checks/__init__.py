"""Checker: errors of a program that are known before execution.

`check` takes a module, modules that belong together, or a `System`. `CheckContext` decides whether
an unknown name is an error.
"""

from collections.abc import Collection, Iterable, Mapping
from types import MappingProxyType

from rapidgen.diagnostics import Diagnostic
from rapidgen.rapid.checks.context import Payload
from rapidgen.rapid.checks.task import TaskCheck, tasks_of
from rapidgen.rapid.dialect import Dialect
from rapidgen.rapid.module_trees import tree_of
from rapidgen.rapid.syntax.nodes import Module
from rapidgen.rapid.syntax.parser import parse
from rapidgen.system import System


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
    task = TaskCheck(
        dialect,
        configured=False,
        strict=strict,
        elsewhere=elsewhere,
        payload=payloads.get(""),
    )
    for module in [given] if isinstance(given, Module) else given:
        task.add(module)
    return _sorted(task.findings())


def _check_system(
    system: System,
    dialect: Dialect,
    gaps: bool,
    payloads: Mapping[str, Payload],
    *,
    strict: bool,
    configured: bool,
) -> list[Diagnostic]:
    findings: list[Diagnostic] = []
    for spec, task in tasks_of(
        system, dialect, gaps, payloads, strict=strict, configured=configured
    ):
        for file in spec.modules:
            task.add(tree_of(file, dialect), installed=file.installed or file.shared)
        findings += task.findings()
    return _sorted(dict.fromkeys(findings))  # a module may be in several tasks


def _sorted(findings: Iterable[Diagnostic]) -> list[Diagnostic]:
    def key(d: Diagnostic) -> tuple[str, int, int]:
        return (d.span.path, d.span.line, d.span.column) if d.span else ("", 0, 0)

    return sorted(findings, key=key)


__all__ = ["Payload", "TaskCheck", "check", "tasks_of"]
