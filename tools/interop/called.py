"""Find the routines of a program that are called from its entry."""

from collections.abc import Collection, Iterator

from rapidgen.controller import VirtualController
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk
from rapidgen.runtime.compiler.program import Program
from rapidgen.runtime.compiler.symbols import LoadedModule


def lines_called(controller: VirtualController) -> dict[str, set[int]]:
    """Return lines of called routines by module file.

    A routine counts if it is called, connected, or named by a text, from each task's entry on.
    """
    result: dict[str, set[int]] = {}
    for task in controller.rapid_tasks.values():
        program = task.program
        entry = next(t.entry for t in controller.system.tasks if t.name == task.name)
        for module, routine in _called(program, entry):
            source = module.tree.source
            lines = range(source.line(routine.first), 1 + source.line(routine.last))
            result.setdefault(module.file.path, set()).update(lines)
    return result


def _called(program: Program, entry: str) -> Iterator[tuple[LoadedModule, n.RoutineDeclaration]]:
    by_name: dict[str, list[tuple[LoadedModule, n.RoutineDeclaration]]] = {}
    for module in program.modules.values():
        for routine in module.tree.routines:
            by_name.setdefault(routine.name.lower(), []).append((module, routine))
    expected = [entry.lower()]
    known: set[str] = set()
    while expected:
        name = expected.pop()
        if name in known:
            continue
        known.add(name)
        for module, routine in by_name.get(name, ()):
            yield module, routine
            for node in walk(routine):
                expected += _names(node, by_name.keys())


def _names(node: n.Node, known: Collection[str]) -> Iterator[str]:
    match node:
        case n.ProcedureCall() | n.FunctionCall():
            yield node.name.lower()
        case n.Connect():
            yield node.trap.lower()
        case n.StringLiteral():
            # Late calls, and instructions that take the name of a procedure.
            yield node.value.lower()
        case n.LateCall() if isinstance(node.procedure, n.Binary):
            first = node.procedure.left
            start = first.value.lower() if isinstance(first, n.StringLiteral) else ""
            yield from (name for name in known if name.startswith(start))
