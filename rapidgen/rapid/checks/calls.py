"""Arguments of calls against the routine's parameters [K §3.10, 5.1]."""

from collections.abc import Sequence
from typing import Final

from rapidgen.rapid.checks.constants import MAX_RAW_BYTES
from rapidgen.rapid.checks.given import closest
from rapidgen.rapid.checks.symbols import READ_ONLY, Symbol, array
from rapidgen.rapid.checks.typing import NUMBER, TypeChecker
from rapidgen.rapid.syntax.nodes import (
    Argument,
    FunctionCall,
    Index,
    LateCall,
    Member,
    Name,
    Parameter,
    Placeholder,
    ProcedureCall,
    RoutineDeclaration,
    Star,
)

_Call = FunctionCall | ProcedureCall | LateCall
_RAW_INDEX: Final = {
    "packrawbytes": ("startindex",),
    "unpackrawbytes": ("startindex",),
    "copyrawbytes": ("fromindex", "toindex"),
    "clearrawbytes": ("fromindex",),
}
_MODES: Final = {
    "VAR": "a variable",
    "PERS": "a persistent",
    "INOUT": "a variable or persistent",
    "REF": "a datum",
}


class CallChecker(TypeChecker):
    """Checks calls of procedures and functions."""

    def check_arguments(self, symbol: Symbol, node: _Call) -> None:
        """Arguments against the parameters of a known routine."""
        parameters = parameters_of(symbol)
        if parameters is None:
            for argument in node.arguments:
                self.loose_argument(argument)
            return
        self._version(symbol, node)
        self._match(symbol, parameters, node)

    def _version(self, symbol: Symbol, node: _Call) -> None:
        signature = symbol.signature
        if signature is None:
            return
        robotware = self.given.dialect.robotware
        since, until = signature.since, signature.until
        if since is not None and robotware < since:
            self.report(
                "RG325",
                f"{symbol.name} came with RobotWare {since[0]}.{since[1]}",
                node.first,
                help=f"this is checked for {robotware[0]}.{robotware[1]}; see --robotware",
            )
        if until is not None and robotware > until:
            self.report(
                "RG325", f"{symbol.name} went with RobotWare {until[0]}.{until[1]}", node.first
            )

    def _match(self, symbol: Symbol, parameters: Sequence[Parameter], node: _Call) -> None:
        """Walk arguments and parameters together: their orders are the same [K §3.10]."""
        at = 0
        groups: dict[int, Argument] = {}
        given: set[int] = set()
        for argument in node.arguments:
            if argument.name == "<ID>" or (
                isinstance(argument.value, Placeholder) and argument.kind == "required"
            ):
                return  # which parameter is meant is not known yet
            if argument.kind == "required" and argument.name is None:
                k = self._next_required(parameters, at, groups)
                if k < 0:
                    self.report(
                        "RG311",
                        f"{symbol.name} has no parameter for this argument",
                        argument,
                        help=f"it takes {_listed(parameters)}",
                        related=self.declared(symbol),
                    )
                    self.loose_argument(argument)
                    continue
                k = self._alternative(parameters, k, argument)
            else:
                k = self._named(symbol, parameters, argument)
                if k < 0:
                    self.loose_argument(argument)
                    continue
                if k < at:
                    self._out_of_turn(symbol, parameters, argument, k, k in given)
            parameter = parameters[k]
            given.add(k)
            if parameter.group >= 0:
                self._exclusive(parameter, argument, groups)
            self._argument(symbol, parameter, argument)
            at = max(at, k + 1)
        self._missing(symbol, parameters, node, given, groups)

    def _next_required(
        self, parameters: Sequence[Parameter], at: int, groups: dict[int, Argument]
    ) -> int:
        for k in range(at, len(parameters)):
            parameter = parameters[k]
            if not parameter.optional and not (parameter.group >= 0 and parameter.group in groups):
                return k
        return -1

    def _alternative(self, parameters: Sequence[Parameter], k: int, argument: Argument) -> int:
        """Of required alternatives, the one that the argument fits; else the first."""
        group = parameters[k].group
        value = argument.value
        if group < 0 or value is None:
            return k
        found: str | None
        if isinstance(value, Name | Index | Member):
            if self.root(value) is None:
                return k
            before = len(self.found)
            found = self.datum(value)
            del self.found[before:]
        else:
            before = len(self.found)
            found = self.type_of(value)
            del self.found[before:]
        if found == NUMBER:
            return k
        for other in range(k, len(parameters)):
            parameter = parameters[other]
            if parameter.group == group and not parameter.optional:
                wanted = array(self.scope.base(parameter.type) or "", parameter.dimensions)
                if found == wanted:
                    return other
        return k

    def _named(self, symbol: Symbol, parameters: Sequence[Parameter], argument: Argument) -> int:
        """Index of the parameter that an argument names, or -1 after a report."""
        name = (argument.name or "").lower()
        for k, parameter in enumerate(parameters):
            if parameter.name.lower() == name and parameter.optional == (
                argument.kind != "required"
            ):
                return k
        optional = argument.kind != "required"
        names = [p.name for p in parameters if p.optional == optional]
        likely = closest(argument.name or "", names)
        shown = ", ".join(("\\" if optional else "") + n for n in names)
        what = "optional argument" if optional else "parameter"
        self.report(
            "RG312",
            f"{symbol.name} has no {what} '{argument.name}'",
            argument,
            help=f"did you mean '{likely}'?" if likely else (f"it has {shown}" if shown else ""),
            related=self.declared(symbol),
        )
        return -1

    def _out_of_turn(
        self,
        symbol: Symbol,
        parameters: Sequence[Parameter],
        argument: Argument,
        k: int,
        again: bool,
    ) -> None:
        name = parameters[k].name
        message = f"'{name}' is given twice" if again else f"'{name}' stands too far behind"
        self.report(
            "RG314",
            message,
            argument,
            help=f"the order is {_listed(parameters)}",
            notes=("arguments have the order of the parameters [K §3.10]",),
            related=self.declared(symbol),
        )

    def _exclusive(
        self, parameter: Parameter, argument: Argument, groups: dict[int, Argument]
    ) -> None:
        other = groups.get(parameter.group)
        groups[parameter.group] = argument
        if other is None or "conditional" in (other.kind, argument.kind):
            return  # of conditional arguments it is known at run time only
        self.report(
            "RG313",
            f"'{argument.name}' and '{other.name}' exclude each other",
            argument,
            notes=("at most one of alternative arguments [K §5.1]",),
        )

    def _missing(
        self,
        symbol: Symbol,
        parameters: Sequence[Parameter],
        node: _Call,
        given: set[int],
        groups: dict[int, Argument],
    ) -> None:
        missing = [
            p.name
            for k, p in enumerate(parameters)
            if not p.optional and k not in given and p.group not in groups
        ]
        if missing:
            listed = ", ".join(f"'{name}'" for name in missing)
            self.report(
                "RG311",
                f"{symbol.name} needs {listed}",
                node.first,
                help=f"it takes {_listed(parameters)}",
                related=self.declared(symbol),
            )

    # -- one argument --------------------------------------------------------------------

    def _argument(self, symbol: Symbol, parameter: Parameter, argument: Argument) -> None:
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
        scope = symbol.module or self.scope
        base = "anytype" if parameter.type.lower() == "anytype" else scope.base(parameter.type)
        wanted = None if base is None else array(base, parameter.dimensions)
        place = f"the argument {parameter.name}"
        if parameter.mode == "":
            self.expect(value, wanted, place)
            self._raw_index(symbol, parameter, argument)
            return
        if not isinstance(value, Name | Index | Member):
            self.type_of(value)
            self.report(
                "RG315",
                f"{place} must be {_MODES[parameter.mode]}, not an expression",
                argument,
                notes=("arguments by mode [K §5.1]",),
            )
            return
        found = self.datum(value, wanted)
        self._mode(parameter, argument, value)
        if found is None or wanted is None or base == "anytype":
            return
        if found != wanted:
            self.mismatch(value, wanted, found, place)

    def _mode(self, parameter: Parameter, argument: Argument, value: Name | Index | Member) -> None:
        root = self.root(value)
        if root is None or root.kind == "INSTALLED":
            return
        mode = parameter.mode
        kind = root.kind
        if mode == "REF":
            return
        own = root.node if isinstance(root.node, Parameter) else None
        if kind == "PARAMETER" and own is not None:
            held = {"PERS": "PERS", "INOUT": "either"}.get(own.mode, "VAR")
        elif kind in ("CONST", "LOOP") or root.name.lower() in READ_ONLY:
            held = "read-only"
        else:
            held = kind
        if held == "either" or held == mode or (mode == "INOUT" and held in ("VAR", "PERS")):
            return
        if kind not in ("VAR", "PERS", "CONST", "PARAMETER", "LOOP"):
            return  # reported where the datum was looked up
        shown = {"read-only": "read-only", "VAR": "a variable", "PERS": "a persistent"}
        self.report(
            "RG315",
            f"the argument {parameter.name} must be {_MODES[mode]}; "
            f"'{root.name}' is {shown.get(held, held)}",
            argument,
            notes=("arguments by mode [K §5.1]",),
            related=self.declared(root),
        )

    def _conditional(self, parameter: Parameter, argument: Argument) -> None:
        value = argument.value
        if not isinstance(value, Name) or value.name == "<ID>":
            return
        own = self.find(value.name)
        if own is None or not isinstance(own.node, Parameter) or not own.node.optional:
            self.report(
                "RG316",
                f"'{value.name}' is no optional parameter of this routine",
                argument,
                notes=("a conditional argument hands an optional parameter on [K §3.10]",),
                related=self.declared(own) if own else (),
            )
            return
        wanted = parameter.type.lower()
        if (own.node.type.lower() == "switch") != (wanted == "switch"):
            self.report(
                "RG316", f"'{value.name}' is {own.node.type}, not {parameter.type}", argument
            )
        elif wanted not in ("switch", "anytype"):
            base = self.scope.base(parameter.type)
            found = self.scope.type_of(own)
            if base and found and found != array(base, parameter.dimensions):
                self.mismatch(value, array(base, parameter.dimensions), found, f"'{value.name}'")

    def _raw_index(self, symbol: Symbol, parameter: Parameter, argument: Argument) -> None:
        if symbol.signature is None or argument.value is None:
            return
        if parameter.name.lower() not in _RAW_INDEX.get(symbol.name.lower(), ()):
            return
        value = self.constant(argument.value)
        if isinstance(value, int | float) and not 1 <= value <= MAX_RAW_BYTES:
            self.report(
                "RG319",
                f"a raw byte index lies in 1 to {MAX_RAW_BYTES}, not {value:g}",
                argument,
            )

    def call(self, node: ProcedureCall) -> None:
        """A procedure call."""
        symbol = self.find(node.name)
        if symbol is None:
            self.unknown("procedure", node.name, node.first, certain=self.given.judges_routines)
            for argument in node.arguments:
                self.loose_argument(argument)
            return
        if symbol.kind == "PROC":
            self.check_arguments(symbol, node)
            return
        help = {
            "FUNC": "use its value: x := Name(...);",
            "TRAP": "a trap is started by its interrupt only",
        }.get(symbol.kind, "")
        self.report(
            "RG306",
            f"'{symbol.name}' is no procedure",
            node.first,
            label=f"a {symbol.kind}",
            help=help,
            related=self.declared(symbol),
        )


def parameters_of(symbol: Symbol) -> Sequence[Parameter] | None:
    """Parameters of a routine; None when they are not known."""
    if symbol.signature is not None:
        return symbol.signature.parameters if symbol.signature.checked else None
    if isinstance(symbol.node, RoutineDeclaration):
        known = symbol.node.parameters
        return None if any(p.name.startswith("<") for p in known) else known
    return None


def _listed(parameters: Sequence[Parameter]) -> str:
    """Parameters in short, for help."""
    out = []
    for parameter in parameters[:12]:
        mark = "\\" if parameter.optional else ""
        out.append(f"{mark}{parameter.name}")
    more = ", ..." if len(parameters) > 12 else ""
    return (", ".join(out) + more) if out else "no arguments"
