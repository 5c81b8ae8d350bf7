"""Calls of routines that do not exist here, found when modules are loaded."""

from rapidgen.diagnostics import Diagnostic, Severity
from rapidgen.rapid import nodes as n
from rapidgen.virtual import unsupported
from rapidgen.virtual.compiler.analysis import walk
from rapidgen.virtual.compiler.program import Program


def missing_routines(program: Program) -> list[Diagnostic]:
    """One warning for each built-in that is not available and each name that is not declared."""
    found: dict[str, Diagnostic] = {}
    for module in program.modules.values():
        for declaration in module.tree.declarations:
            if not isinstance(declaration, n.RoutineDeclaration):
                continue
            for node in walk(declaration):
                if not isinstance(node, n.ProcedureCall | n.FunctionCall):
                    continue
                key = node.name.lower()
                if key in found:
                    continue
                routine = program.find_routine(module, key)
                if routine is None:
                    found[key] = Diagnostic(
                        "RG404",
                        Severity.WARNING,
                        f"{node.name} is not declared in any module of {program.task.name}",
                        module.span(node),
                        label="ERR_REFUNKPRC when it is reached",
                        help="load the module that declares it",
                    )
                elif routine.missing:
                    found[key] = Diagnostic(
                        "RG403",
                        Severity.WARNING,
                        f"{routine.name} is not available on the virtual controller",
                        module.span(node),
                        label=f"{unsupported.reason(key)}; the task stops here",
                    )
    return list(found.values())
