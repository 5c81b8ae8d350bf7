"""The checker: what a program means, as far as that is known before it runs.

`check` takes a module, modules that belong together, or a `System`. What is unknown is judged
by what was given: see `given.Extent`.
"""

from collections.abc import Collection, Iterable, Mapping, Sequence

from rapidgen.diagnostics import Diagnostic, Severity, Span
from rapidgen.rapid.checks.declarations import ModuleChecker
from rapidgen.rapid.checks.given import Extent, Given
from rapidgen.rapid.checks.symbols import Scope, Symbol, World, collect, task_globals
from rapidgen.rapid.dialect import Dialect
from rapidgen.rapid.syntax.nodes import Module, RoutineDeclaration
from rapidgen.rapid.syntax.parser import parse
from rapidgen.system import System, TaskSpec

_TREE_STANDS = frozenset(("RG213", "RG215", "RG216", "RG220"))
"""Errors of the text that leave a tree whose meaning can be checked."""
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
    whole_task: bool = False,
    gaps: bool = False,
    elsewhere: Collection[str] = frozenset(),
) -> list[Diagnostic]:
    """Everything wrong with a text, a module, modules that belong together, or a system.

    A text or one module is judged as a lone file: what it does not declare may be anywhere.
    An iterable of modules is a folder; where it has an entry routine `main`, routines and types
    must be in it. With `whole_task` they are all modules of one task (or of several), and only
    what the configuration installs may be unknown. `gaps` says that something is missing that
    a name could come from; `elsewhere` are lower-case names that are declared in modules which
    were given too, but do not belong to these. A system's own RobotWare decides unless
    `dialect` is given. Findings of the parser are included. Sorted by place.
    """
    if isinstance(given, System):
        return _check_system(given, dialect or Dialect(given.robotware), gaps)
    dialect = dialect or Dialect()
    if isinstance(given, str | bytes):
        given = parse(given, path=path, dialect=dialect)
    if isinstance(given, Module):
        return _check_modules([given], Given(dialect, Extent.FILE, gaps), World())
    modules = list(given)
    extent = Extent.TASK if whole_task else Extent.FOLDER
    if not whole_task and not any(r.name.lower() == "main" for m in modules for r in m.routines):
        gaps = True
    return _check_modules(modules, Given(dialect, extent, gaps), World(elsewhere=elsewhere))


def _check_modules(modules: Sequence[Module], given: Given, world: World) -> list[Diagnostic]:
    """Modules of one folder: they may belong to several tasks, so equal names do not clash."""
    if _any_unreadable(modules) or _loads(modules):
        given = Given(given.dialect, given.extent, gaps=True)
    collected = [collect(module, world) for module in modules]
    scopes = [scope for scope, _ in collected]
    names, clashes = task_globals(scopes)
    for first, second in clashes:
        _merge(first, second)
    found: list[Diagnostic] = []
    for scope, twice in collected:
        scope.globals = names
        found += _check_module(scope, given, twice)
    return _sorted(found)


def _merge(first: Symbol, second: Symbol) -> None:
    """Two tasks' objects of one name: what they differ in is not judged."""
    if first.kind != second.kind or first.type != second.type or first.degree != second.degree:
        first.known, first.resolved = True, None


def _check_module(
    scope: Scope, given: Given, twice: Sequence[tuple[Symbol, Symbol]]
) -> list[Diagnostic]:
    module = scope.module
    checker = ModuleChecker(scope, given)
    for first, second in twice:
        _clash(checker, first, second, "in this module")
    if all(d.code in _TREE_STANDS or d.severity is not Severity.ERROR for d in module.diagnostics):
        checker.module()
    return [*module.diagnostics, *checker.found]


def _clash(checker: ModuleChecker, first: Symbol, second: Symbol, where: str) -> None:
    node = second.node
    at = getattr(node, "name_token", None)
    place = at if isinstance(at, int) else (node.first if node is not None else 0)
    checker.report(
        "RG305",
        f"'{second.name}' is declared twice {where}",
        place,
        notes=("objects of one scope differ in name [K §2.12, 9.1]",),
        related=checker.declared(first),
    )


# -- systems ---------------------------------------------------------------------------------


def _check_system(system: System, dialect: Dialect, gaps: bool) -> list[Diagnostic]:
    installed = _installed(system)
    parsed: dict[tuple[str, int], Module] = {}
    found: list[Diagnostic] = []
    seen: set[Diagnostic] = set()
    for task in system.tasks:
        modules = []
        for file in task.modules:
            key = (file.path, len(file.data))
            module = parsed.get(key)
            if module is None:
                module = parsed[key] = parse(file.data, path=file.path, dialect=dialect)
            modules.append(module)
        given = Given(dialect, Extent.SYSTEM, gaps or _loads(modules) or _any_unreadable(modules))
        for diagnostic in _check_task(modules, given, World(installed), task):
            if diagnostic not in seen:
                seen.add(diagnostic)
                found.append(diagnostic)
    return _sorted(found)


def _check_task(
    modules: Sequence[Module], given: Given, world: World, task: TaskSpec
) -> list[Diagnostic]:
    collected = [collect(module, world) for module in modules]
    names, clashes = task_globals([scope for scope, _ in collected])
    found: list[Diagnostic] = []
    for scope, twice in collected:
        scope.globals = names
        found += _check_module(scope, given, twice)
        checker = ModuleChecker(scope, given)
        for first, second in clashes:
            if second.module is scope:
                _clash(checker, first, second, "in this task")
        found += checker.found
    return found + _entry(task, names, given)


def _entry(task: TaskSpec, names: Mapping[str, Symbol], given: Given) -> list[Diagnostic]:
    """A task starts in a procedure without parameters [K §9]; without modules it never does."""
    symbol = names.get(task.entry.lower())
    if symbol is None or symbol.module is None or not isinstance(symbol.node, RoutineDeclaration):
        if given.gaps or not task.modules:
            return []
        return [
            Diagnostic(
                "RG331",
                Severity.WARNING,
                f"the task {task.name} has no procedure '{task.entry}' to start in",
                Span(task.modules[0].path, 1, 1),
                help=f"declare PROC {task.entry}() in one of its modules, or name another entry",
            )
        ]
    if symbol.kind == "PROC" and not symbol.node.parameters:
        return []
    what = "has parameters" if symbol.kind == "PROC" else f"is a {symbol.kind}"
    checker = ModuleChecker(symbol.module, given)
    checker.report(
        "RG331",
        f"the task {task.name} starts in '{symbol.name}', but that {what}",
        symbol.node.name_token,
        help=f"write PROC {symbol.name}()",
        notes=("the entry routine is a procedure without parameters [K §9]",),
    )
    return checker.found


def _installed(system: System) -> Mapping[str, Symbol]:
    """Signals, mechanical units and task identities of a configuration."""
    found: dict[str, Symbol] = {}
    for signal in system.signals:
        kind = _SIGNAL_TYPES[signal.type]
        found[signal.name.lower()] = Symbol(signal.name, "INSTALLED", kind)
    for group in system.groups:
        for unit in (group.robot, *group.units):
            if unit:
                found[unit.lower()] = Symbol(unit, "INSTALLED", "mecunit")
    for task in system.tasks:
        name = f"{task.name}Id"
        found[name.lower()] = Symbol(name, "INSTALLED", "taskid")
    return found


def _unreadable(module: Module) -> bool:
    """Whether something of a file is not known that other modules may name."""
    return not module.name or any(
        d.severity is Severity.ERROR or d.code == "RG217" for d in module.diagnostics
    )


def _any_unreadable(modules: Iterable[Module]) -> bool:
    return any(_unreadable(module) for module in modules)


def _loads(modules: Iterable[Module]) -> bool:
    """Whether a program loads further modules while it runs."""
    return any(
        token.lower() in _LOADERS for module in modules for token in set(module.source.tokens)
    )


def _sorted(found: Iterable[Diagnostic]) -> list[Diagnostic]:
    def key(d: Diagnostic) -> tuple[str, int, int]:
        return (d.span.path, d.span.line, d.span.column) if d.span else ("", 0, 0)

    return sorted(found, key=key)


__all__ = ["check"]
