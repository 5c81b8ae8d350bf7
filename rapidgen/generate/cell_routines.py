"""Check that a cell's program has the configured routines and data.

Late binding finds a procedure when it is called, and RAPID can ask for data by name, not for
routines. In a backup the check is possible before.
"""

from collections.abc import Iterator

from rapidgen.config.model import GroupConfig, RobotConfig, RoutineParameter, UserDatum, UserRoutine
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Span, error, suggest
from rapidgen.rapid import parse
from rapidgen.rapid.syntax.nodes import DataDeclaration, Module, Parameter, RoutineDeclaration
from rapidgen.system import System


def check_routines(config: RobotConfig, cell: System) -> None:
    """Reject missing routines and data, and wrong parameters and types.

    A missing module may be loaded later: the driver rejects the use until then. Raises
    DiagnosticError RG114.
    """
    faults = [fault for group in config.groups for fault in _faults(group, cell)]
    if faults:
        raise DiagnosticError(faults)


def _faults(group: GroupConfig, cell: System) -> Iterator[Diagnostic]:
    motion = [t for t in cell.tasks if t.name.casefold() == group.task.casefold()]
    modules = {
        module.name.casefold(): parse(module.data, path=module.path)
        for task in motion
        for module in task.modules
    }
    for routine in group.routines:
        module = modules.get(routine.call.partition(":")[0].casefold())
        if ":" in routine.call and module is not None:
            yield from _of_routine(routine, module)
    for datum in group.data:
        module = modules.get(datum.name.partition(":")[0].casefold())
        if module is not None:
            yield from _of_datum(datum, module)


def _of_routine(routine: UserRoutine, module: Module) -> Iterator[Diagnostic]:
    expected = routine.call.partition(":")[2]
    names = [declared.name for declared in module.routines]
    result = [r for r in module.routines if r.name.casefold() == expected.casefold()]
    if not result:
        yield _fault(
            module.source.span(0, 0),
            f"routine '{routine.name}': module {module.name} has no {expected}",
            suggest(expected, names) or f"it has: {', '.join(names) or 'none'}",
        )
        return
    (declared,) = result[:1]
    needed = [p for p in declared.parameters if not p.optional]
    kind = "FUNC" if routine.returns else "PROC"
    fits = len(needed) == len(routine.parameters) and all(
        _takes(own, foreign) for own, foreign in zip(routine.parameters, needed, strict=False)
    )
    if declared.kind != kind or (declared.type or "").casefold() != routine.returns or not fits:
        yield _fault(
            module.source.span(declared.name_token, declared.name_token),
            f"routine '{routine.name}' is called as {kind} {expected}"
            f"({', '.join(map(_shown, routine.parameters))}), and is not declared so",
            f"it is {_declared(declared)}: `parameters:` of the configuration have to be its own",
        )


def _takes(own: RoutineParameter, foreign: Parameter) -> bool:
    """True if a parameter takes the driver's variable.

    An IN parameter gives no result.
    """
    modes = ("INOUT", "VAR") if own.inout else ("", "INOUT", "VAR")
    return (foreign.type.casefold(), foreign.dimensions) == (own.type, 0) and foreign.mode in modes


def _shown(own: RoutineParameter) -> str:
    return f"{'INOUT ' * own.inout}{own.type} {own.name}"


def _declared(routine: RoutineDeclaration) -> str:
    parameters = ", ".join(
        " ".join(filter(None, (p.mode, p.type, p.name))) + "{*}" * bool(p.dimensions)
        for p in routine.parameters
        if not p.optional
    )
    return " ".join(filter(None, (routine.kind, routine.type, f"{routine.name}({parameters})")))


def _of_datum(datum: UserDatum, module: Module) -> Iterator[Diagnostic]:
    name = datum.name.partition(":")[2]
    result = [
        d
        for d in module.declarations
        if isinstance(d, DataDeclaration) and d.name.casefold() == name.casefold()
    ]
    if not result:
        yield _fault(
            module.source.span(0, 0),
            f"datum '{datum.name}': module {module.name} declares no {name}",
            f"`PERS {datum.type} {name} := ...;`",
        )
    elif any(
        d.scope == "LOCAL" or d.kind != "PERS" or d.type.casefold() != datum.type or d.dimensions
        for d in result
    ):
        yield _fault(
            module.source.span(result[0].name_token, result[0].name_token),
            f"datum '{datum.name}' is not a global PERS of the type {datum.type}",
            f"`PERS {datum.type} {name} := ...;`",
        )


def _fault(at: Span, message: str, help: str) -> Diagnostic:
    return error("RG114", at, message, help)
