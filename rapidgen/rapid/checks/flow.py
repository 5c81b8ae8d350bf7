"""Checks of statements: types, permitted places, reachability.

Each statement function returns True if execution can continue after the statement.
"""

from collections.abc import Callable, Sequence
from typing import Final, cast

from rapidgen.diagnostics import Severity
from rapidgen.rapid.binding import DataSymbol, RoutineScope, RoutineSymbol, Symbol
from rapidgen.rapid.binding.names import AGGREGATE, degree
from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.checks.findings import Findings
from rapidgen.rapid.checks.typing import TypeChecker
from rapidgen.rapid.syntax.errors import UNEQUAL, followed_by_unequal
from rapidgen.rapid.syntax.nodes import (
    Aggregate,
    Assignment,
    BoolLiteral,
    CompactIf,
    Connect,
    Exit,
    Expression,
    For,
    FunctionCall,
    Goto,
    If,
    Index,
    Label,
    LateCall,
    Member,
    Name,
    PlaceholderStatement,
    ProcedureCall,
    Raise,
    Retry,
    Return,
    RoutineDeclaration,
    Statement,
    Test,
    TryNext,
    While,
)

_LEAVING: Final = (Return, Raise, Retry, TryNext, Exit, Goto)


def _leaves(statement: Statement) -> bool:
    """Return True for a statement that leaves the sequence, or stops the program."""
    if isinstance(statement, ProcedureCall):
        return statement.name.lower() in ("stop", "exitcycle")
    return isinstance(statement, _LEAVING)


class FlowChecker:
    """Checks the statements of one routine."""

    def __init__(self, findings: Findings, types: TypeChecker, routine: RoutineDeclaration) -> None:
        self.findings = findings
        self.report, self.warn, self.declared = findings.report, findings.warn, findings.declared
        self.types = types
        self.calls = types.calls
        self.routine = routine
        self.part = "body"
        """`body`, `ERROR`, `UNDO` or `BACKWARD`."""
        self.returns = 0

    def statements(self, body: Sequence[Statement]) -> bool:
        """Check a list; return True if its end is reachable."""
        alive, is_reported = True, False
        leaving: Statement | None = None
        for statement in body:
            if type(statement) is Label:
                alive = True
                continue
            # To leave again, as by a RETURN behind a loop that never ends, changes nothing.
            if not alive and not is_reported and not _leaves(statement):
                is_reported = True
                self._unreachable(statement, leaving, body)
            goes_on = _CHECKS[type(statement)](self, statement)
            if alive and not goes_on:
                leaving = statement
            alive = goes_on and alive
        return alive

    def _unreachable(
        self, statement: Statement, leaving: Statement | None, body: Sequence[Statement]
    ) -> None:
        """Report the first statement that cannot be reached.

        Statements after an endless loop or after branches that all leave, and those that a RETURN
        disables at the end of a routine, such as moves for teaching, are usually meant to be there.
        """
        is_meant = type(leaving) in (While, If, Test) or (
            type(leaving) is Return and body is self.routine.body
        )
        report = self.findings.remark if is_meant else self.warn
        report(
            "RG323",
            "this statement cannot be reached",
            statement.first,
            help="remove it, or what leaves before it",
        )

    # -- simple --------------------------------------------------------------------------

    def _assignment(self, node: Assignment) -> bool:
        target = node.target
        expected: str | None = None
        if isinstance(target, Name | Index | Member):
            root = self.types.root(target)
            was_used = root in self.findings.used
            expected = self.types.datum(target, self._hint(node))
            if root is not None:
                # A function can only be called in an expression, so its value needs a receiver.
                forced = isinstance(node.value, FunctionCall)
                if isinstance(target, Name) and not was_used and not forced:
                    self.findings.used.discard(root)  # being written is no use
                self._writable(target, root)
        if expected is not None:
            kind = self.findings.module.type_class(expected)
            if kind in ("nonvalue", "semivalue"):
                self.report(
                    "RG309",
                    f"{expected} cannot be assigned",
                    target,
                    help="signals are set with SetDO, SetAO or SetGO"
                    if kind == "semivalue"
                    else "",
                    notes=("value classes [K §2.16]",),
                )
                self.types.used(node.value)
                return True
        self.types.expect(node.value, expected, "the value")
        if (
            expected == "num"  # then every part of the target is known, and reported once
            and isinstance(target, Member)
            and target.component.lower() == "mass"
            and self.types.type_of(target.base) == "loaddata"
        ):
            self.types.load(node.value)
        if expected is not None and degree(expected):
            self.types.same_sizes(node, target, node.value)
        return True

    def _hint(self, node: Assignment) -> str | None:
        """Return the type of a literal value, for an unknown target."""
        if isinstance(node.value, BoolLiteral):
            return "bool"
        return "robtarget" if isinstance(node.value, Aggregate) else None

    def _writable(self, target: Expression, root: Symbol) -> None:
        if root.kind == "CONST" and isinstance(root, DataSymbol) and root.readonly:
            why = f"'{root.name}' is a constant"
        elif root.kind == "LOOP":
            why = f"the loop variable '{root.name}' is read-only"
        elif isinstance(root, DataSymbol) and root.readonly:
            why = f"{root.name} is read-only"
        else:
            return
        self.report(
            "RG310",
            f"{why}: it cannot be assigned",
            target,
            notes=("assignment targets [K §4.4, 4.15]",),
            related=self.declared(root),
        )

    def _call_statement(self, node: ProcedureCall) -> bool:
        self.calls.call(node)
        return node.name.lower() not in signatures.marked("ends")

    def _late(self, node: LateCall) -> bool:
        self.types.expect(node.procedure, "string", "the name of the procedure")
        name = self.types.constant(node.procedure)
        # `module:name` may reach a LOCAL procedure of a module that is not checked here.
        known = name.removeprefix(":") if isinstance(name, str) else ""
        symbol = self.findings.find(known) if known and ":" not in known else None
        if isinstance(symbol, RoutineSymbol) and symbol.kind == "PROC":
            self.calls.loose_arguments(node.arguments)
            self.findings.add_warnings(
                lambda: self.calls.check_arguments(symbol, node),
                "the call ends in ERR_CALLPROC when it is reached [K §4.5]",
            )
            return True
        if symbol is not None:
            self.warn("RG306", f"'{symbol.name}' is no procedure", node.procedure)
        elif known and ":" not in known and self.findings.given.is_complete:
            self.warn(
                "RG301",
                f"there is no procedure '{known}'",
                node.procedure,
                help="the call would fail with ERR_REFUNKPRC",
            )
        self.calls.loose_arguments(node.arguments)
        return True

    def _holder(self, node: PlaceholderStatement) -> bool:
        return True

    def _goto(self, node: Goto) -> bool:
        return False  # labels are looked at for the routine as a whole

    def _return(self, node: Return) -> bool:
        self.returns += 1
        routine = self.routine
        if self.part == "UNDO":
            self._place(node, "RETURN", "the body, an ERROR or a BACKWARD handler", "4.7")
        elif routine.kind == "FUNC":
            if node.value is None:
                self.report(
                    "RG321",
                    f"the function '{routine.name}' must return {routine.type}",
                    node,
                    notes=("RETURN in a function has a value [K §4.7]",),
                )
        elif node.value is not None:
            self.report(
                "RG321",
                f"a {routine.kind} returns no value",
                node.value,
                help="only a FUNC has a value",
                notes=("RETURN [K §4.7]",),
            )
        if node.value is not None:
            expected = self.findings.module.base(routine.type) if routine.type else None
            if expected is not None and self.findings.module.type_class(expected) != "value":
                expected = None  # reported at the head of the function
            self.types.expect(node.value, expected, "the returned value")
        return False

    def _place(self, node: Statement, keyword: str, where: str, section: str) -> None:
        self.report(
            "RG321", f"{keyword} is permitted only in {where}", node, notes=(f"[K §{section}]",)
        )

    def _raise(self, node: Raise) -> bool:
        if node.number is None:
            if self.part != "ERROR":
                self._place(node, "RAISE without a number", "an ERROR handler", "4.8")
        else:
            self.types.expect(node.number, "num", "the error number")
            if self.part == "ERROR":
                # ABB's modules for RobotWare 7 contain it, so it is not an error.
                self.report(
                    "RG321",
                    "RAISE with a number in a handler passes that error to the caller",
                    node,
                    notes=("[K §4.8] has it in bodies only; controllers load and execute it",),
                    severity=Severity.INFO,
                )
            value = self.types.constant(node.number)
            if (
                isinstance(value, int | float)
                and not 1 <= value <= 90
                and not isinstance(node.number, Name)
            ):
                self.report(
                    "RG321",
                    f"an error number of a program is in 1 to 90, not {value:g}",
                    node.number,
                    help="or book one with BookErrNo",
                    notes=("any other number becomes ERR_ILLRAISE [K §4.8]",),
                )
        return False

    def _retry(self, node: Retry | TryNext) -> bool:
        if self.part != "ERROR":
            keyword = "RETRY" if isinstance(node, Retry) else "TRYNEXT"
            self._place(node, keyword, "an ERROR handler", "4.10, 4.11")
        return False

    def _exit(self, node: Exit) -> bool:
        return False

    def _connect(self, node: Connect) -> bool:
        target = node.target
        if isinstance(target, Name | Index | Member):
            result = self.types.datum(target, "num")
            root = self.types.root(target)
            if result is not None and result != "num":
                self.types.mismatch(target, "num", result, "the interrupt variable")
            elif root is not None and root.kind in ("CONST", "PERS", "LOOP"):
                self.report(
                    "RG326",
                    f"'{root.name}' is no variable",
                    target,
                    help="declare VAR intnum at the head of the module",
                    notes=("CONNECT [K §4.12]",),
                    related=self.declared(root),
                )
            elif (
                root is not None
                and root.kind == "VAR"
                and root.name.lower() in self.findings.locals
            ):
                self.warn(
                    "RG326",
                    f"the interrupt variable '{root.name}' ends with its routine",
                    target,
                    help="declare it at the head of the module",
                )
        trap = self.findings.find(node.trap)
        if trap is None:
            self.findings.unknown("trap", node.trap, node.last - 1)
        elif trap.kind != "TRAP":
            self.report(
                "RG306", f"'{trap.name}' is no trap", node.last - 1, related=self.declared(trap)
            )
        return True

    # -- compound ------------------------------------------------------------------------

    def _if(self, node: If) -> bool:
        alive = False
        for branch in node.branches:
            self._condition(branch.condition)
            alive = self.statements(branch.body) or alive
        if node.otherwise is None:
            return True
        return self.statements(node.otherwise) or alive

    def _condition(self, node: Expression) -> None:
        self.types.expect(node, "bool", "the condition")
        if followed_by_unequal(self.findings.module.tree.source, node.last):
            self.warn("RG332", "the condition ends before `!=`", node, help=UNEQUAL)

    def _compact_if(self, node: CompactIf) -> bool:
        self._condition(node.condition)
        _CHECKS[type(node.statement)](self, node.statement)
        return True

    def _for(self, node: For) -> bool:
        self.types.expect(node.start, "num", "the start")
        self.types.expect(node.end, "num", "the end")
        if node.step is not None:
            self.types.expect(node.step, "num", "the step")
            if self.types.constant(node.step) == 0:
                self.warn("RG319", "a step of 0 never comes to an end", node.step)
        around = self.findings.here
        assert isinstance(around, RoutineScope)
        self.findings.here = around.loop(node)
        self.statements(node.body)
        self.findings.here = around
        return True

    def _while(self, node: While) -> bool:
        self._condition(node.condition)
        self.statements(node.body)
        return not (isinstance(node.condition, BoolLiteral) and node.condition.value)

    def _test(self, node: Test) -> bool:
        subject = self.types.type_of(node.subject)
        alive = False
        for case in node.cases:
            for value in case.values:
                self.types.expect(
                    value, subject if subject != AGGREGATE else None, "the CASE value"
                )
            alive = self.statements(case.body) or alive
        if node.default is None:
            return True
        return self.statements(node.default) or alive


_CHECKS: Final = cast(
    "dict[type, Callable[[FlowChecker, Statement], bool]]",
    {
        Assignment: FlowChecker._assignment,
        ProcedureCall: FlowChecker._call_statement,
        LateCall: FlowChecker._late,
        If: FlowChecker._if,
        CompactIf: FlowChecker._compact_if,
        For: FlowChecker._for,
        While: FlowChecker._while,
        Test: FlowChecker._test,
        Goto: FlowChecker._goto,
        Return: FlowChecker._return,
        Raise: FlowChecker._raise,
        Retry: FlowChecker._retry,
        TryNext: FlowChecker._retry,
        Exit: FlowChecker._exit,
        Connect: FlowChecker._connect,
        PlaceholderStatement: FlowChecker._holder,
    },
)
