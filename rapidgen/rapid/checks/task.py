"""The check of one task, which edits of its modules keep up to date.

`TaskCheck` has the modules in loading order. After `replace`, the findings of a module are those of
a new check of all modules: what a module says about others is read again, and nothing is cached but
properties of single trees.
"""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
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
from rapidgen.rapid.syntax.damage import Damage, damage_of
from rapidgen.rapid.syntax.nodes import Module
from rapidgen.system import System, TaskSpec

_UTF8_FROM = (7, 1)
_LOADERS = frozenset(("load", "startload"))
_SIGNAL_TYPES = {
    "DI": "signaldi",
    "DO": "signaldo",
    "GI": "signalgi",
    "GO": "signalgo",
    "AI": "signalai",
    "AO": "signalao",
}


@dataclass(frozen=True, slots=True)
class _Facts:
    """Properties of a tree on which the findings of other modules depend."""

    damage: Damage
    loads: bool
    """It may load modules during execution."""


@dataclass(slots=True, eq=False)
class TaskCheck:
    """Modules of a task with their findings.

    Without a `spec` the modules are those of one folder: they may belong to several tasks, so that
    equal names do not clash.
    """

    dialect: Dialect
    spec: TaskSpec | None = None
    objects: Mapping[str, Symbol] = field(default_factory=dict)
    """Signals, mechanical units and task identities, by lower-case name."""
    gaps: bool = False
    """Parts of the task are missing."""
    configured: bool = True
    strict: bool = False
    elsewhere: Collection[str] = frozenset()
    payload: Payload | None = None
    has_robot: bool = False
    """A task of the system moves a robot."""
    scope: TaskScope = field(init=False)
    modules: list[ModuleScope] = field(default_factory=list)
    """In loading order."""
    _facts: dict[ModuleScope, _Facts] = field(default_factory=dict)
    _context: CheckContext | None = None

    def __post_init__(self) -> None:
        self.scope = TaskScope(self.objects)

    # -- modules -------------------------------------------------------------------------

    def add(self, tree: Module, *, installed: bool = False) -> ModuleScope:
        """Add a module behind the others."""
        module = self.scope.add(tree, installed=installed)
        self.modules.append(module)
        self._learn(module)
        return module

    def replace(self, module: ModuleScope, tree: Module) -> ModuleScope:
        """Put an edited module into the place of an earlier version."""
        result = self.scope.replace(module, tree)
        self.modules[self.modules.index(module)] = result
        del self._facts[module]
        self._learn(result)
        return result

    def _learn(self, module: ModuleScope) -> None:
        tokens = set(module.tree.source.tokens)
        loads = any(token.lower() in _LOADERS for token in tokens)
        self._facts[module] = _Facts(damage_of(module.tree), loads)
        self._context = None

    @property
    def context(self) -> CheckContext:
        """Input of the checker for each module of this task."""
        if self._context is None:
            facts = self._facts.values()
            unknown: frozenset[str] = frozenset().union(*(f.damage.names for f in facts))
            gaps = any(fact.damage.is_whole for fact in facts)
            if self.spec is not None and not self.strict:
                gaps = gaps or self.gaps or any(fact.loads for fact in facts)
            self._context = CheckContext(
                self.dialect,
                self.spec is not None,
                gaps,
                configured=self.configured,
                strict=self.strict,
                elsewhere=unknown.union(self.elsewhere),
                payload=self.payload,
            )
            if self.spec is None:
                for clash in self.scope.clashes:
                    self.scope.conflicting_objects(clash)
        return self._context

    # -- findings ------------------------------------------------------------------------

    def findings(self) -> list[Diagnostic]:
        """Return all findings, those of the parser included."""
        result = [d for module in self.modules for d in self.module_findings(module)]
        return result + self.task_findings()

    def module_findings(self, module: ModuleScope) -> list[Diagnostic]:
        """Return the findings of one module, those of the parser included."""
        findings = Findings(module, self.context)
        for first, second in module.clashes:
            _clash(findings, first, second, "in this module")
        damage = self._facts[module].damage
        if module.tree.name:
            check_module(findings, damage)
        if self.spec is not None:
            for first, second in self.scope.clashes:
                if second.module is module:
                    _clash(findings, first, second, "in this task", self.spec.entry)
        found = [*module.tree.diagnostics, *findings.found]
        source = module.tree.source
        return found + encoding_findings(source.path, source.encoding, self.context.dialect)

    def task_findings(self) -> list[Diagnostic]:
        """Return findings about the task as a whole: its entry, and moves without a robot."""
        if self.spec is None:
            return []
        result = _entry(self.spec, self.scope, self.context)
        if self.has_robot and not self.spec.motion:
            for one in moves_without_robot(self.spec, self.scope, self.context):
                result += one.found
        return result


def encoding_findings(path: str, encoding: str, dialect: Dialect) -> list[Diagnostic]:
    """Report a file that controllers from RobotWare 7.1 on expect to be converted.

    They expect UTF-8 without byte order mark (Technical reference manual, RAPID Overview, RobotWare
    7: files in .mod or .sys format). ASCII is UTF-8. Without a known release nothing is reported,
    but for a file that is not in the encoding which the user has named.
    """
    if encoding == "latin-1" != dialect.encoding:
        message = f"the file is neither UTF-8 nor {dialect.encoding}; it was read as Latin-1"
        help = "name the encoding of this file: `--encoding` latin-1, cp1252 or gbk"
        return [error("RG339", Span(path, 1, 1), message, help, severity=Severity.WARNING)]
    if not dialect.is_known or dialect.robotware < _UTF8_FROM or encoding == "utf-8":
        return []
    if encoding == "utf-8-sig":
        message = "the file begins with a byte order mark, which RobotWare 7.1 does not expect"
        command = f"rapidgen fmt --to-utf-8 {path}"
    else:
        message = "the file is not UTF-8, which RobotWare 7.1 and later expect"
        command = f"rapidgen fmt --to-utf-8 --encoding cp1252 {path}"
    help = f"convert it: `{command}`, with the encoding that the file has"
    return [error("RG339", Span(path, 1, 1), message, help, severity=Severity.WARNING)]


def tasks_of(
    system: System,
    dialect: Dialect,
    gaps: bool = False,
    payloads: Mapping[str, Payload] = MappingProxyType({}),
    *,
    strict: bool = False,
    configured: bool = True,
) -> Iterator[tuple[TaskSpec, TaskCheck]]:
    """Iterate over the tasks of a system; their modules are to be added."""
    objects = installed_objects(_installed(system))
    has_robot = any(spec.motion for spec in system.tasks)
    for spec in system.tasks:
        yield (
            spec,
            TaskCheck(
                dialect,
                spec,
                objects,
                gaps,
                configured,
                strict,
                payload=payloads.get(spec.name.lower()),
                has_robot=has_robot,
            ),
        )


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


def _entry(spec: TaskSpec, task: TaskScope, given: CheckContext) -> list[Diagnostic]:
    """Check that a task starts in a procedure without parameters [K §9].

    A task without modules never starts.
    """
    symbol = task.find(spec.entry.lower())
    if not isinstance(symbol, RoutineSymbol) or symbol.module is None or symbol.node is None:
        if given.gaps or not spec.modules or spec.entry.lower() in given.elsewhere:
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
