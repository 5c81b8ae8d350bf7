"""Checks of moves: StorePath in traps and handlers, `\\ID` in synchronised movement.

The checks follow the statements and the calls of the program's own procedures with one state:
whether StorePath was executed, or whether movement is synchronised. Branches start with the same
state. Where branches end with different states, the one applies that gives no finding. Late calls
are not followed. All findings are warnings, except for moves in error handlers: most of these
errors come from an instruction that waits for the end of the path, such as SearchL.
"""

from collections.abc import Callable, Sequence
from typing import Final

from rapidgen.diagnostics import Severity
from rapidgen.rapid.binding import ModuleScope, RoutineSymbol
from rapidgen.rapid.binding.names import called
from rapidgen.rapid.builtins.signatures import Signature
from rapidgen.rapid.checks.findings import Findings
from rapidgen.rapid.checks.labels import bodies, inner_lists
from rapidgen.rapid.syntax.nodes import If, ProcedureCall, RoutineDeclaration, Statement, Test

_TARGETS: Final = frozenset(("topoint", "tojointpos"))
_STORED: Final = {"storepath": True}
_SYNCHRONISED: Final = {
    "syncmoveon": True,
    "syncmoveresume": True,
    "syncmoveoff": False,
    "syncmoveundo": False,
    "syncmovesuspend": False,
}
"""Instructions that change the state, and the state after them."""

_DEEPEST = 30
"""Calls within calls that are followed."""

_Report = Callable[[ProcedureCall, RoutineSymbol], None]


class MoveChecker:
    """Checks the moves of all routines of a module."""

    def __init__(self, findings: Findings) -> None:
        self._findings = findings
        self._handlers = _Walk(_STORED, safe=True, is_fault=lambda _call, _symbol: True)
        self._movements = _Walk(_SYNCHRONISED, safe=False, is_fault=_lacks_identity)

    def routine(self, node: RoutineDeclaration) -> None:
        """Check a routine and its handlers."""
        module = self._findings.module
        for part, body in bodies(node):
            if part == "ERROR" or (part == "body" and node.kind == "TRAP"):
                where = "an error handler" if part == "ERROR" else "a trap"
                self._handlers.follow(body, module, False, self._once(where))
            self._movements.follow(body, module, False, self._no_identity)

    def _once(self, where: str) -> _Report:
        """Return a function that reports the first move without StorePath."""
        is_reported = False

        def report(call: ProcedureCall, symbol: RoutineSymbol) -> None:
            nonlocal is_reported
            if not is_reported:
                is_reported = True
                verb = "in" if symbol.node is None else "moves in"
                self._report(
                    "RG334",
                    f"{symbol.name} {verb} {where} without StorePath",
                    call,
                    symbol,
                    help="call StorePath before the move, and RestoPath after it",
                    note="the move joins the interrupted path; a controller logs event 41739",
                    is_fault=where != "an error handler",
                )

        return report

    def _no_identity(self, call: ProcedureCall, symbol: RoutineSymbol) -> None:
        verb = "without" if symbol.node is None else "moves without"
        self._report(
            "RG335",
            f"{symbol.name} {verb} \\ID in synchronised movement",
            call,
            symbol,
            help="add \\ID with the number that the moves of the other tasks have",
            note="the move stops the program between SyncMoveOn and SyncMoveOff",
        )

    def _report(
        self,
        code: str,
        message: str,
        call: ProcedureCall,
        symbol: RoutineSymbol,
        *,
        help: str,
        note: str,
        is_fault: bool = True,
    ) -> None:
        is_warning = is_fault or self._findings.given.strict
        self._findings.report(
            code,
            message,
            call.first,
            help=help,
            notes=(note,),
            related=self._findings.declared(symbol),
            severity=Severity.WARNING if is_warning else Severity.INFO,
        )


class _Walk:
    """Follows statements and calls with a state of two values.

    A move is a fault in the state that is not `safe`, if `is_fault` agrees.
    """

    def __init__(
        self,
        after: dict[str, bool],
        *,
        safe: bool,
        is_fault: Callable[[ProcedureCall, Signature], bool],
    ) -> None:
        self._after, self._safe, self._is_fault = after, safe, is_fault
        self._known: dict[tuple[RoutineSymbol, bool], tuple[bool, bool]] = {}
        self._depth = 0

    def follow(
        self, body: Sequence[Statement], module: ModuleScope, state: bool, report: _Report
    ) -> bool:
        """Return the state after a list of statements that starts in `state`; report faults."""
        for statement in body:
            if isinstance(statement, ProcedureCall):
                symbol = called(module.find(statement.name))
                if isinstance(symbol, RoutineSymbol) and symbol.kind == "PROC":
                    is_fault, after = self._call(statement, symbol, state)
                    if is_fault:
                        report(statement, symbol)
                    state = after
                continue
            ends = [self.follow(one, module, state, report) for one in inner_lists(statement)]
            if not _is_exhaustive(statement):
                ends.append(state)
            state = self._safe if self._safe in ends else not self._safe
        return state

    def _call(self, call: ProcedureCall, symbol: RoutineSymbol, state: bool) -> tuple[bool, bool]:
        """Return whether a call is a fault, and the state after it."""
        signature = symbol.signature
        if signature is not None:
            is_fault = state != self._safe and is_move(signature)
            after = self._after.get(symbol.name.lower(), state)
            return is_fault and self._is_fault(call, signature), after
        key = (symbol, state)
        if key not in self._known and self._depth == _DEEPEST:
            return False, state
        if key not in self._known and symbol.node is not None and symbol.module is not None:
            self._known[key] = False, state  # a recursive call adds nothing
            faults: list[ProcedureCall] = []
            self._depth += 1
            after = self.follow(
                symbol.node.body, symbol.module, state, lambda inner, _: faults.append(inner)
            )
            self._depth -= 1
            # Faults in a state that the procedure itself brings about are reported there.
            self._known[key] = bool(faults) and state != self._safe, after
        return self._known.get(key, (False, state))


def _lacks_identity(call: ProcedureCall, signature: Signature) -> bool:
    has_parameter = any(p.name.lower() == "id" for p in signature.parameters)
    return has_parameter and all((a.name or "").lower() != "id" for a in call.arguments)


def is_move(signature: Signature) -> bool:
    """Return True for an instruction with a target."""
    return signature.kind == "PROC" and any(
        parameter.name.lower() in _TARGETS for parameter in signature.parameters
    )


def _is_exhaustive(statement: Statement) -> bool:
    """Return True if a compound statement executes one of its lists in any case."""
    if isinstance(statement, If):
        return statement.otherwise is not None
    return isinstance(statement, Test) and statement.default is not None
