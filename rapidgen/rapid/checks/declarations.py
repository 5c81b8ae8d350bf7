"""Checks of types, records, data, parameters, routines [K §2.11-2.24, 5]."""

from collections.abc import Sequence
from typing import Final

from rapidgen.diagnostics import Edit, Fix, Severity, replacement
from rapidgen.rapid.binding import DataSymbol, RoutineScope, Symbol, TypeSymbol
from rapidgen.rapid.binding.names import array, datum_symbol, parameter_symbol
from rapidgen.rapid.checks.findings import Findings
from rapidgen.rapid.checks.flow import FlowChecker
from rapidgen.rapid.checks.labels import bodies, check_labels, flat
from rapidgen.rapid.checks.moves import MoveChecker
from rapidgen.rapid.checks.typing import TypeChecker
from rapidgen.rapid.syntax.damage import Damage
from rapidgen.rapid.syntax.nodes import (
    Aggregate,
    AliasDeclaration,
    Binary,
    BoolLiteral,
    DataDeclaration,
    Expression,
    FunctionCall,
    Index,
    LateCall,
    Member,
    Name,
    NumberLiteral,
    Parameter,
    Parenthesis,
    Placeholder,
    RecordDeclaration,
    RoutineDeclaration,
    StringLiteral,
    Unary,
)

_MAX_DEGREE: Final = 3
_LISTED: Final = 5
"""Names in one finding."""
_LOADED: Final = frozenset(("tooldata", "loaddata"))


def check_module(findings: Findings, damage: Damage) -> None:
    """Check all declarations of a module but routines with a syntax error."""
    _ModuleChecker(findings, damage).module()


class _ModuleChecker:
    """Checks the declarations of one module."""

    def __init__(self, findings: Findings, damage: Damage) -> None:
        self.findings = findings
        self.damage = damage
        self.report, self.warn, self.declared = findings.report, findings.warn, findings.declared
        self.scope = findings.module
        self.types = TypeChecker(findings)
        self.moves = MoveChecker(findings)

    def module(self) -> None:
        """Check the module."""
        for declaration in self.scope.tree.declarations:
            if isinstance(declaration, DataDeclaration):
                self._data(declaration, routine=False)
            elif isinstance(declaration, RoutineDeclaration):
                if declaration not in self.damage.routines:
                    self._routine(declaration)
            elif isinstance(declaration, RecordDeclaration):
                self._record(declaration)
            elif isinstance(declaration, AliasDeclaration):
                self._alias(declaration)
        self._unused_local()
        self.findings.note_other_scopes()

    def _type(self, name: str, at: int) -> str | None:
        """Return the base of a declared type; report an unknown one."""
        symbol = self.findings.find(name)
        if symbol is None:
            self.findings.unknown("type", name, at)
            return None
        if not isinstance(symbol, TypeSymbol) or symbol.name == "anytype":
            self.report(
                "RG303",
                f"'{symbol.name}' is no type",
                at,
                label=f"a {symbol.kind}",
                related=self.declared(symbol),
            )
            return None
        if name.lower() == "dnum" and not self.findings.given.dialect.has_dnum:
            self.report("RG325", "dnum came with RobotWare 5.12", at)
        return self.scope.base(name)

    # -- types ---------------------------------------------------------------------------

    def _record(self, node: RecordDeclaration) -> None:
        seen: set[str] = set()
        for component in node.components:
            key = component.name.lower()
            if key in seen:
                self.report("RG327", f"the component '{component.name}' is there twice", component)
            seen.add(key)
            base = self._type(component.type, component.first)
            if base is None:
                continue
            if base == node.name.lower():
                self.report("RG327", f"the record '{node.name}' contains itself", component)
            elif base == "switch" or self.scope.type_class(base) == "semivalue":
                self.report(
                    "RG327",
                    f"a component cannot be {component.type}",
                    component,
                    notes=("no signals in records [K §2.14]",),
                )

    def _alias(self, node: AliasDeclaration) -> None:
        target = self.findings.find(node.type)
        self._type(node.type, node.last - 2)
        if isinstance(target, TypeSymbol) and target.kind == "ALIAS":
            self.report(
                "RG327",
                f"'{node.type}' is itself an alias",
                node,
                help=f"name its base type: ALIAS {target.base} {node.name};",
                fixes=self.findings.spelling(target.base or "", node.last - 2),
                notes=("no alias of an alias [K §2.15]",),
            )

    # -- data ----------------------------------------------------------------------------

    def _data(self, node: DataDeclaration, *, routine: bool) -> None:
        type_token = node.name_token - 1
        base = self._type(node.type, type_token)
        self._dimensions(node)
        if node.kind == "PERS":
            self._persistent(node, routine=routine)
        if base == "switch":
            self.report("RG303", "switch is for optional parameters only", type_token)
            return
        kind = self.scope.type_class(base) if base else "value"
        if kind in ("nonvalue", "semivalue") and (node.kind != "VAR" or node.initial is not None):
            message = (
                f"a {node.kind} cannot be of type {node.type}"
                if node.kind != "VAR"
                else f"{node.type} takes no initial value"
            )
            self.report(
                "RG309",
                message,
                type_token,
                help=f"declare VAR {node.type} {node.name};",
                notes=("value classes [K §2.16]",),
            )
            return
        initial = node.initial
        if initial is None:
            return
        if node.kind == "PERS":
            self._literal(initial)
        else:
            self._constant_expression(initial)
        expected = array(base, len(node.dimensions)) if base else None
        self.types.is_placeholder = base in _LOADED and not self._is_named_elsewhere(node.name)
        self.types.expect(initial, expected, "the initial value")
        self.types.is_placeholder = False
        self.types.members_of(initial, [self.types.constant(size) for size in node.dimensions])

    def _is_named_elsewhere(self, name: str) -> bool:
        """Return True if a module of the task names a datum outside its declaration."""
        key = name.lower()
        modules = self.scope.task.modules.values()
        named = (m.tree.source.tokens for m in modules)
        return sum(token.lower() == key for tokens in named for token in tokens) > 1

    def _persistent(self, node: DataDeclaration, *, routine: bool) -> None:
        if routine:
            self.report(
                "RG329",
                "a routine has no PERS of its own",
                node.name_token - 2,
                help="declare it at the head of the module",
                notes=("[K §2.18]",),
            )
        elif node.initial is None and node.scope:
            self.report(
                "RG317",
                f"a {node.scope} PERS needs an initial value",
                node.name_token,
                notes=("only a system-global PERS may come without one [K §2.23]",),
            )

    def _dimensions(self, node: DataDeclaration) -> None:
        if len(node.dimensions) > _MAX_DEGREE:
            self.report(
                "RG318",
                f"an array has at most {_MAX_DEGREE} dimensions",
                node.dimensions[_MAX_DEGREE],
                notes=("[K §2.22]",),
            )
        for size in node.dimensions:
            self._constant_expression(size)
            self.types.expect(size, "num", "a size")
            value = self.types.constant(size)
            if isinstance(value, int | float) and (value < 1 or value != int(value)):
                self.report("RG318", f"a size is a whole number from 1, not {value:g}", size)

    def _literal(self, node: Expression) -> None:
        """A PERS starts from a literal, or an aggregate of literals [K §3.2]."""
        if isinstance(node, Aggregate):
            for member in node.members if node.shape is None else ():
                self._literal(member)
            return
        if isinstance(node, Unary) and node.operator in ("+", "-"):
            node = node.operand
        if not isinstance(node, NumberLiteral | StringLiteral | BoolLiteral | Placeholder):
            self.report(
                "RG317",
                "the initial value of a PERS is made of literals only",
                node,
                help="write the value itself: its program may change it",
                notes=("literal expressions [K §3.2]",),
            )

    def _constant_expression(self, node: Expression) -> None:
        """Check that an expression has no variable or call [K §3.1].

        It also excludes persistents, at any depth.
        """
        if isinstance(node, NumberLiteral | StringLiteral | BoolLiteral | Placeholder):
            return
        if isinstance(node, Aggregate):
            for member in node.members if node.shape is None else ():
                self._constant_expression(member)
        elif isinstance(node, Unary):
            self._constant_expression(node.operand)
        elif isinstance(node, Parenthesis):
            self._constant_expression(node.inner)
        elif isinstance(node, Binary):
            self._constant_expression(node.left)
            self._constant_expression(node.right)
        elif isinstance(node, FunctionCall):
            self._not_constant(node, "a function call")
        elif isinstance(node, Name | Index | Member):
            root = self.types.root(node)
            if root is not None and root.kind in ("VAR", "PERS", "PARAMETER"):
                self._not_constant(node, f"'{root.name}' ({root.kind})", root)

    def _not_constant(self, node: Expression, what: str, root: Symbol | None = None) -> None:
        self.report(
            "RG317",
            f"{what} is not permitted in a constant expression",
            node,
            help="assign it as a statement",
            notes=("constant expressions [K §3.1, 2.22]",),
            related=self.declared(root) if root else (),
        )

    # -- routines ------------------------------------------------------------------------

    def _routine(self, node: RoutineDeclaration) -> None:
        current = RoutineScope(self.scope, node)
        self.findings.here = current
        flow = FlowChecker(self.findings, self.types, node)
        if node.kind == "FUNC" and node.type is not None:
            self._result(node)
        for parameter in node.parameters:
            self._parameter(parameter, current)
        for datum in node.data:
            self._data(datum, routine=True)
            self._declare(current, datum_symbol(datum, self.scope, node))
        check_labels(self.findings, node)
        self.moves.routine(node)
        for part, body in bodies(node):
            flow.part = part
            if part == "ERROR":
                self._error_numbers(node)
            alive = flow.statements(body)
            if part == "body" and node.kind == "FUNC" and alive:
                self._no_return(node, flow.returns)
        self._unused(
            [
                symbol
                for symbol in current.names.values()
                if symbol not in self.findings.used and isinstance(symbol.node, DataDeclaration)
            ]
        )
        self.findings.here = self.scope

    def _declare(self, current: RoutineScope, symbol: DataSymbol) -> None:
        first = current.declare(symbol)
        if first is not None:
            self.report(
                "RG305",
                f"'{symbol.name}' is declared twice in this routine",
                symbol.token,
                notes=("parameters count as data of the routine [K §2.20]",),
                related=self.declared(first),
            )

    def _result(self, node: RoutineDeclaration) -> None:
        base = self._type(node.type or "", node.name_token - 1)
        if base is not None and (base == "switch" or self.scope.type_class(base) != "value"):
            self.report(
                "RG309",
                f"a function cannot return {node.type}",
                node.name_token - 1,
                notes=("functions return value types [K §5.4]",),
            )

    def _parameter(self, parameter: Parameter, current: RoutineScope) -> None:
        if parameter.name.startswith("<"):
            return
        self._declare(current, parameter_symbol(parameter, self.scope, current.node))
        if parameter.dimensions > _MAX_DEGREE:
            self.report("RG318", "an array has at most 3 dimensions", parameter)
        type_token = parameter.name_token - 1
        base = self._type(parameter.type, type_token)
        if base is None:
            return
        if base == "switch":
            if not parameter.optional or parameter.mode or parameter.dimensions:
                self.report(
                    "RG328",
                    "a switch is an optional parameter without a mode",
                    parameter,
                    help=f"write \\switch {parameter.name}",
                    fixes=self._rewritten(parameter, f"\\switch {parameter.name}"),
                    notes=("[K §5.1]",),
                )
        elif parameter.mode != "VAR" and self.scope.type_class(base) in ("nonvalue", "semivalue"):
            self.report(
                "RG328",
                f"a parameter of type {parameter.type} must be VAR",
                parameter,
                help=f"write VAR {parameter.type} {parameter.name}",
                notes=("value classes [K §2.16]",),
            )

    def _rewritten(self, parameter: Parameter, text: str) -> tuple[Fix, ...]:
        """Return the fix that writes a parameter in another way."""
        source = self.scope.tree.source
        # A separator, such as the comma of an alternative, may be part of the node's tokens.
        first = parameter.first + (source.tokens[parameter.first] in (",", "|"))
        return replacement(f"Change to {text}", source.span(first, parameter.last), text)

    def _error_numbers(self, node: RoutineDeclaration) -> None:
        for number in (node.error.numbers or []) if node.error else []:
            self.types.expect(number, "num", "the error number")

    def _no_return(self, node: RoutineDeclaration, returns: int) -> None:
        if returns == 0:
            self.report(
                "RG322",
                f"the function '{node.name}' has no RETURN",
                node.name_token,
                help=f"return a value of type {node.type}",
                notes=("without RETURN a call ends in ERR_FNCNORET [K §5.4, 12]",),
                severity=Severity.WARNING,
            )
        else:
            self.report(
                "RG322",
                f"the end of the function '{node.name}' can perhaps be reached without RETURN",
                node.name_token,
                notes=("a call that does so ends in ERR_FNCNORET [K §5.4, 12]",),
                severity=Severity.INFO,
            )

    def _unused(self, symbols: Sequence[DataSymbol]) -> None:
        """Report data of a routine that no statement reads."""
        if not symbols:
            return
        names = [f"'{symbol.name}'" for symbol in symbols]
        listed = ", ".join(names[:_LISTED])
        more = f" and {len(names) - _LISTED} more" if len(names) > _LISTED else ""
        is_one = len(names) == 1
        self.findings.remark(
            "RG324",
            f"{listed}{more} {'is' if is_one else 'are'} never read",
            symbols[0].token,
            help=f"remove {'its declaration' if is_one else 'their declarations'}",
            fixes=self._removals(symbols),
        )

    def _removals(self, symbols: Sequence[DataSymbol]) -> tuple[Fix, ...]:
        """Return the fix that takes out declarations of data that no statement names.

        A datum that is written, but never read, has further uses.
        """
        edits: list[Edit] = []
        source = self.scope.tree.source
        for symbol in symbols:
            node, routine = symbol.node, symbol.routine
            if not isinstance(node, DataDeclaration) or routine is None:
                return ()
            named = source.tokens[routine.first : routine.last + 1]
            if sum(token.lower() == symbol.name.lower() for token in named) > 1:
                return ()
            edits += [e for fix in self.findings.removal("", node) for e in fix.edits]
        title = f"Remove {', '.join(symbol.name for symbol in symbols)}"
        return (Fix(title, tuple(edits), is_safe=True),)

    def _unused_local(self) -> None:
        """Report LOCAL objects without a use in the module.

        Persistents are visible from outside.
        """
        late = any(
            isinstance(statement, LateCall)
            for routine in self.scope.tree.routines
            for _, body in bodies(routine)
            for statement in flat(body)
        )
        late = late or self._has_late_call_in_damage()
        for key, symbol in self.scope.own.items():
            if symbol in self.findings.used or not symbol.local or symbol.kind == "PERS":
                continue
            if key in self.damage.names:
                continue
            node = symbol.node
            if isinstance(node, RoutineDeclaration) and not late:
                self.findings.remark(
                    "RG324",
                    f"the LOCAL '{symbol.name}' is never called",
                    node.name_token,
                    fixes=self.findings.removal(f"Remove {symbol.name}", node),
                )
            elif isinstance(node, DataDeclaration):
                self.findings.remark(
                    "RG324", f"the LOCAL '{symbol.name}' is never read", node.name_token
                )

    def _has_late_call_in_damage(self) -> bool:
        """Return True if a late call may stand in a part with a syntax error."""
        tokens = self.scope.tree.source.tokens
        return any("%" in tokens[first : last + 1] for first, last in self.damage.ranges)
