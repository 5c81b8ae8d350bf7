"""Check that only tasks with a robot move it."""

from collections.abc import Iterator

from rapidgen.diagnostics import Severity
from rapidgen.rapid.binding import RoutineSymbol, TaskScope
from rapidgen.rapid.binding.names import called
from rapidgen.rapid.checks.context import CheckContext
from rapidgen.rapid.checks.findings import Findings
from rapidgen.rapid.checks.moves import is_move
from rapidgen.rapid.syntax.nodes import Connect, FunctionCall, ProcedureCall
from rapidgen.rapid.syntax.walk import walk
from rapidgen.system import TaskSpec


def moves_without_robot(spec: TaskSpec, task: TaskScope, given: CheckContext) -> Iterator[Findings]:
    """Report the first move that a task without a robot reaches from its entry.

    Modules of several tasks contain routines that only the motion task calls, so only calls from
    the entry count.
    """
    waiting = [task.find(spec.entry.lower())]
    known = {*waiting}
    while waiting:
        routine = waiting.pop(0)
        if not isinstance(routine, RoutineSymbol) or routine.node is None or not routine.module:
            continue
        scope = routine.module.routine(routine.node)
        for node in walk(routine.node):
            if isinstance(node, Connect):
                symbol = scope.find(node.trap)
            elif isinstance(node, ProcedureCall | FunctionCall):
                symbol = called(scope.find(node.name))
            else:
                continue
            if isinstance(node, ProcedureCall) and _moves(symbol):
                findings = Findings(routine.module, given)
                findings.report(
                    "RG336",
                    f"the task {spec.name} has no robot, and calls {node.name}",
                    node,
                    help="move in a motion task: one named like T_ROB1, or with MotionTask in "
                    "SYS.cfg",
                    notes=("the task stops when it reaches the instruction",),
                    severity=Severity.WARNING,
                )
                yield findings
                return
            if symbol not in known:
                known.add(symbol)
                waiting.append(symbol)


def _moves(symbol: object) -> bool:
    """Return True for a move instruction of RAPID."""
    return (
        isinstance(symbol, RoutineSymbol)
        and symbol.signature is not None
        and is_move(symbol.signature)
    )
