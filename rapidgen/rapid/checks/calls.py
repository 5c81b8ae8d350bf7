"""Checks of arguments against the routine's parameters [K §3.10, 5.1]."""

from collections.abc import Sequence
from typing import Final, Protocol, cast

from rapidgen.diagnostics import Severity, Tag
from rapidgen.rapid.binding import (
    ArgumentFault,
    DataSymbol,
    Pairing,
    RoutineSymbol,
    constant,
    declared_type,
    first_fit,
    held_as,
    match,
    may_pass,
    root,
    type_of,
)
from rapidgen.rapid.binding.names import array, called
from rapidgen.rapid.builtins.signatures import Version
from rapidgen.rapid.checks.context import closest
from rapidgen.rapid.checks.findings import Findings
from rapidgen.rapid.syntax.nodes import (
    Argument,
    Expression,
    FunctionCall,
    Index,
    LateCall,
    Member,
    Name,
    Node,
    Parameter,
    Placeholder,
    ProcedureCall,
    Star,
)
from rapidgen.system.releases import ANY_MINOR

_Call = FunctionCall | ProcedureCall | LateCall
"""A call with arguments."""
_RAW_BYTES: Final = 1024
"""Bytes of a rawbytes."""
_OTHER: Final = ("a module that is not given may declare another routine of that name [K §2.12]",)
_MODES: Final = {
    "VAR": "a variable",
    "PERS": "a persistent",
    "INOUT": "a variable or persistent",
    "REF": "a datum",
}


class ExpressionChecker(Protocol):
    """Checks of expressions that a call needs; `typing.TypeChecker` implements them.

    Calls contain expressions and expressions contain calls: the protocol keeps the two modules
    from importing each other.
    """

    def used(self, node: Expression) -> None:
        """Check an expression of any type."""

    def expect(self, node: Expression, expected: str | None, place: str) -> str | None:
        """Check that an expression has the type `expected`."""

    def type_of(self, node: Expression) -> str | None:
        """Return the type of an expression, None if it is unknown."""

    def datum(self, node: Name | Index | Member, expected: str | None = None) -> str | None:
        """Return the declared type of a data reference."""

    def mismatch(self, node: Expression, expected: str, result: str, place: str) -> None:
        """Report that types differ."""


class CallChecker:
    """Checks calls of procedures and functions."""

    def __init__(self, findings: Findings, types: ExpressionChecker) -> None:
        self.findings = findings
        self.report, self.declared = findings.report, findings.declared
        self.types = types

    def call(self, node: ProcedureCall) -> None:
        """Check a procedure call."""
        findings = self.findings
        symbol = called(findings.find(node.name))
        if symbol is None:
            findings.unknown("procedure", node.name, node.first)
            self.loose_arguments(node.arguments)
            return
        if isinstance(symbol, RoutineSymbol) and symbol.kind == "PROC":
            self.check_arguments(symbol, node)
            return
        help = {
            "FUNC": "use its value: x := Name(...);",
            "TRAP": "a trap is started by its interrupt only",
        }.get(symbol.kind, "")
        findings.report(
            "RG306",
            f"'{symbol.name}' is no procedure",
            node.first,
            label=f"a {symbol.kind}",
            help=help,
            related=findings.declared(symbol),
        )

    def loose_arguments(self, arguments: Sequence[Argument]) -> None:
        """Check arguments of an unknown routine."""
        for argument in arguments:
            if argument.value is not None:
                self.types.used(argument.value)

    def check_arguments(self, symbol: RoutineSymbol, node: _Call) -> None:
        """Check arguments against the parameters of a known routine."""
        parameters = symbol.parameters
        if parameters is None:
            self.loose_arguments(node.arguments)
            return
        self._version(symbol, node)
        arguments = _up_to_placeholder(node.arguments)
        result = match(parameters, arguments, lambda a, these: self._fitting(parameters, a, these))
        missing = result.missing if len(arguments) == len(node.arguments) else ()
        hidden = self._may_be_hidden(symbol, node, result.pairs)
        surplus = False
        for pair in result.pairs:
            again = surplus and ArgumentFault.SURPLUS in pair.misfits
            surplus = surplus or ArgumentFault.SURPLUS in pair.misfits
            if (
                pair.misfits and not again
            ):  # one surplus argument is reported, the others follow from it
                self._misfits(symbol, parameters, pair, hidden)
            if pair.parameter < 0 or hidden:
                self.loose_arguments([pair.argument])
            else:
                self._argument(symbol, parameters[pair.parameter], pair.argument)
        if missing:
            listed = ", ".join(f"'{parameters[k].name}'" for k in missing)
            self.report(
                "RG311",
                f"{symbol.name} needs {listed}",
                node.first,
                help=f"it takes {_listed(parameters)}",
                notes=_OTHER if hidden else (),
                related=self.declared(symbol),
                severity=Severity.WARNING if hidden else Severity.ERROR,
            )

    def _may_be_hidden(
        self, symbol: RoutineSymbol, node: _Call, pairs: Sequence[Pairing[Argument]]
    ) -> bool:
        """Return True if another module may declare the routine [K §2.12].

        Public programs hide built-ins by procedures without parameters (Reset), and built-ins that
        not every controller has by procedures with more parameters (GetJointData) [code].
        """
        if symbol.signature is None or self.findings.given.is_complete:
            return False
        if isinstance(node, ProcedureCall) and not node.arguments:
            return True
        surplus = any(ArgumentFault.SURPLUS in pair.misfits for pair in pairs)
        return surplus and not symbol.signature.everywhere

    def _version(self, symbol: RoutineSymbol, node: _Call) -> None:
        signature = symbol.signature
        if signature is None:
            return
        self._release(symbol.name, signature.since, signature.until, node.first)
        for argument in node.arguments:
            name = argument.name or ""
            came = signature.argument_version("came", name)
            went = signature.argument_version("went", name)
            self._release(f"\\{name} of {symbol.name}", came, went, argument)

    def _release(
        self, what: str, since: Version | None, until: Version | None, node: Node | int
    ) -> None:
        """Report what the release lacks; a note if the release is unknown."""
        dialect = self.findings.given.dialect
        if since is not None and dialect.robotware < since:
            message = f"{what} came with RobotWare {since[0]}.{since[1]}"
        elif until is not None and dialect.robotware >= until:
            message = f"{what} went with RobotWare {until[0]}.{until[1]}"
        else:
            return
        major, minor = dialect.robotware
        displayed = f"{major}" if minor >= ANY_MINOR else f"{major}.{minor:02d}"
        self.report(
            "RG325",
            message,
            node,
            help=f"this is checked for RobotWare {displayed}"
            if dialect.is_known
            else "name its RobotWare with --robotware",
            severity=Severity.ERROR if dialect.is_known else Severity.INFO,
            tags=(Tag.DEPRECATED,) if until is not None and dialect.robotware >= until else (),
        )

    def _fitting(
        self, parameters: Sequence[Parameter], argument: Argument, these: Sequence[int]
    ) -> int:
        """Return the required alternative that the argument fits."""
        current, value = self.findings.here, argument.value
        result: str | None = None
        if isinstance(value, Name | Index | Member):
            result = declared_type(value, current)
        elif value is not None:
            result = type_of(value, current)
        base = current.module.base
        expected = [array(base(parameters[k].type) or "", parameters[k].dimensions) for k in these]
        return first_fit(result, these, expected)

    # -- matching ------------------------------------------------------------------------

    def _misfits(
        self,
        symbol: RoutineSymbol,
        parameters: Sequence[Parameter],
        pair: Pairing[Argument],
        hidden: bool,
    ) -> None:
        """Report the faults of an argument.

        `hidden`: another module may declare the routine.
        """
        argument = pair.argument
        for misfit in pair.misfits:
            if misfit is ArgumentFault.SURPLUS:
                self.report(
                    "RG311",
                    f"{symbol.name} has no parameter for this argument",
                    argument,
                    help=f"it takes {_listed(parameters)}",
                    notes=_OTHER if hidden else (),
                    related=self.declared(symbol),
                    severity=Severity.WARNING if hidden else Severity.ERROR,
                )
            elif misfit is ArgumentFault.UNKNOWN:
                self._no_parameter(symbol, parameters, argument)
            elif misfit is ArgumentFault.EXCLUSIVE:
                other = pair.rival.name if pair.rival else ""
                self.report(
                    "RG313",
                    f"'{argument.name}' and '{other}' exclude each other",
                    argument,
                    notes=("at most one of alternative arguments [K §5.1]",),
                )
            else:
                name = parameters[pair.parameter].name
                twice = misfit is ArgumentFault.TWICE
                self.report(
                    "RG314",
                    f"'{name}' is given twice" if twice else f"'{name}' is too far back",
                    argument,
                    help=f"the order is {_listed(parameters)}",
                    notes=("arguments have the order of the parameters [K §3.10]",),
                    related=self.declared(symbol),
                )

    def _no_parameter(
        self, symbol: RoutineSymbol, parameters: Sequence[Parameter], argument: Argument
    ) -> None:
        optional = argument.kind != "required"
        names = [p.name for p in parameters if p.optional == optional]
        likely = closest(argument.name or "", names)
        displayed = ", ".join(("\\" if optional else "") + n for n in names)
        what = "optional argument" if optional else "parameter"
        self.report(
            "RG312",
            f"{symbol.name} has no {what} '{argument.name}'",
            argument,
            help=f"did you mean '{likely}'?"
            if likely
            else (f"it has {displayed}" if displayed else ""),
            related=self.declared(symbol),
            fixes=self.findings.spelling(likely, argument.first + optional),
        )

    # -- one argument --------------------------------------------------------------------

    def _argument(self, symbol: RoutineSymbol, parameter: Parameter, argument: Argument) -> None:
        is_switch = parameter.type.lower() == "switch"
        if argument.kind == "switch":
            if not is_switch:
                self.report(
                    "RG312",
                    f"\\{parameter.name} needs a value",
                    argument,
                    help=f"write \\{parameter.name}:=...",
                )
            return
        if argument.kind == "conditional":
            self._conditional(parameter, argument)
            return
        value = argument.value
        if is_switch:
            self.report(
                "RG312",
                f"the switch \\{parameter.name} takes no value",
                argument,
                help=f"write \\{parameter.name}, or \\{parameter.name}?own_switch",
            )
            return
        if value is None or isinstance(value, Star | Placeholder):
            return
        scope = symbol.module or self.findings.module
        base = "anytype" if parameter.type.lower() == "anytype" else scope.base(parameter.type)
        expected = None if base is None else array(base, parameter.dimensions)
        place = f"the argument {parameter.name}"
        if (
            symbol.signature is not None
            and symbol.name.lower() == "aliasio"
            and parameter.mode == "REF"
            and self._is_undeclared(value)
        ):
            # A signal of EIO.cfg, though the parameter has any type.
            self.findings.unknown("datum", cast(Name, value).name, value, "signaldi")
            return
        if parameter.mode == "":
            self.types.expect(value, expected, place)
            self._raw_index(symbol, parameter, argument)
            return
        if not isinstance(value, Name | Index | Member):
            self.types.type_of(value)
            self.report(
                "RG315",
                f"{place} must be {_MODES[parameter.mode]}, not an expression",
                argument,
                notes=("arguments by mode [K §5.1]",),
            )
            return
        result = self.types.datum(value, expected)
        if base != "anytype" and None not in (result, expected) and result != expected:
            self.types.mismatch(value, expected or "", result or "", place)
        else:
            self._mode(parameter, argument, value)

    def _is_undeclared(self, value: Expression) -> bool:
        return isinstance(value, Name) and root(value, self.findings.here) is None

    def _mode(self, parameter: Parameter, argument: Argument, value: Name | Index | Member) -> None:
        datum = root(value, self.findings.here)
        if not isinstance(datum, DataSymbol) or datum.kind == "INSTALLED":
            return
        mode = parameter.mode
        if may_pass(datum, mode):
            return
        held = {"VAR": "a variable", "PERS": "a persistent"}.get(held_as(datum), "read-only")
        self.report(
            "RG315",
            f"the argument {parameter.name} must be {_MODES[mode]}; '{datum.name}' is {held}",
            argument,
            notes=("arguments by mode [K §5.1]",),
            related=self.declared(datum),
        )

    def _conditional(self, parameter: Parameter, argument: Argument) -> None:
        value = argument.value
        if not isinstance(value, Name) or value.name == "<ID>":
            return
        own = self.findings.find(value.name)
        if not isinstance(own, DataSymbol) or not own.optional:
            self.report(
                "RG316",
                f"'{value.name}' is no optional parameter of this routine",
                argument,
                notes=("a conditional argument hands an optional parameter on [K §3.10]",),
                related=self.declared(own) if own else (),
            )
            return
        expected = parameter.type.lower()
        if (own.type.lower() == "switch") != (expected == "switch"):
            self.report("RG316", f"'{value.name}' is {own.type}, not {parameter.type}", argument)
        elif expected not in ("switch", "anytype"):
            base = self.findings.module.base(parameter.type)
            result = self.findings.module.type_of(own)
            if base and result and result != array(base, parameter.dimensions):
                self.types.mismatch(
                    value, array(base, parameter.dimensions), result, f"'{value.name}'"
                )

    def _raw_index(self, symbol: RoutineSymbol, parameter: Parameter, argument: Argument) -> None:
        if symbol.signature is None or argument.value is None:
            return
        if parameter.name.lower() not in symbol.signature.marks.get("index", ()):
            return
        value = constant(argument.value, self.findings.here)
        if isinstance(value, int | float) and not 1 <= value <= _RAW_BYTES:
            self.report(
                "RG319",
                f"a raw byte index is in 1 to {_RAW_BYTES}, not {value:g}",
                argument,
                notes=("the error comes when it is executed",),
                severity=Severity.WARNING,
            )


def _up_to_placeholder(arguments: Sequence[Argument]) -> Sequence[Argument]:
    """Return arguments before a placeholder.

    The parameters of later ones are unknown.
    """
    for i, argument in enumerate(arguments):
        if argument.name == "<ID>" or (
            isinstance(argument.value, Placeholder) and argument.kind == "required"
        ):
            return arguments[:i]
    return arguments


def _listed(parameters: Sequence[Parameter]) -> str:
    """Return a short list of parameters, for help texts."""
    out = []
    for parameter in parameters[:12]:
        marker = "\\" if parameter.optional else ""
        out.append(f"{marker}{parameter.name}")
    more = ", ..." if len(parameters) > 12 else ""
    return (", ".join(out) + more) if out else "no arguments"
