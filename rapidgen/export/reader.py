"""Read a straight-line routine of RAPID as a description.

Constants and persistents of the module are replaced by their values. Every statement that is not
one of the exported kinds (IF, WHILE, offsets computed at run time, ...) is reported with its line:
nothing is left out. Statements that the writer puts at the beginning of a routine are recognised
and leave no instruction.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Literal, cast

from rapidgen.diagnostics import Diagnostic, DiagnosticError, Severity, Span, error, suggest
from rapidgen.export import description as rapid
from rapidgen.rapid import check, parse
from rapidgen.rapid.binding import DataSymbol, NotConstant, Scope, TaskScope, evaluate
from rapidgen.rapid.builtins.signatures import Value
from rapidgen.rapid.syntax.nodes import (
    Argument,
    Assignment,
    Expression,
    FunctionCall,
    Name,
    ProcedureCall,
    RoutineDeclaration,
    Statement,
)

_MOVES = {f"{verb}{kind}".lower(): kind for verb in ("Move", "Trigg") for kind in "JLC"} | {
    "moveabsj": "AbsJ"
}
_SETS = {"setdo": "DO", "setgo": "GO", "setao": "AO"}
_WAITS = {"waitdi": "DI", "waitdo": "DO", "waitgi": "GI", "waitgo": "GO"}
_SETTINGS = frozenset(("pdispoff", "eoffsoff", "confj", "gripload"))
_FOREVER = 2000.0
"""s of a wait without \\MaxTime: the longest that a program has."""


@dataclass(frozen=True, slots=True)
class ReadRoutine:
    """A routine as data, and the place of each of its instructions."""

    routine: rapid.Routine
    spans: tuple[Span, ...]


class _Unsupported(Exception):
    """A statement or value without counterpart; the text is the reason."""


def read_routine(text: str, routine: str, path: str = "module") -> ReadRoutine:
    """Read a procedure without parameters. Raises DiagnosticError: RG763 with all faults."""
    tree = parse(text, path=path)
    # The checker makes sure that each instruction has its arguments.
    faults = [d for d in check(tree) if d.severity is Severity.ERROR]
    if faults:
        raise DiagnosticError(faults)
    procedures = {r.name.lower(): r for r in tree.routines if r.kind == "PROC"}
    node = procedures.get(routine.lower())
    if node is None:
        names = [r.name for r in procedures.values()]
        help = suggest(routine, names) or f"it has: {', '.join(names) or 'none'}"
        found = error("RG763", Span(path, 1, 1), f"{tree.name} has no procedure '{routine}'", help)
        raise DiagnosticError(found)
    module = TaskScope().add(tree)
    reader = _Reader(module.routine(node), module)
    for statement in node.body:
        span = tree.source.span(statement.first, statement.last)
        reader.read(statement, span)
    if node.parameters or node.error or node.undo or node.backward:
        reader.fault(tree.source.span(node.name_token, node.name_token), _what_else(node))
    if reader.findings:
        raise DiagnosticError(reader.findings)
    described = rapid.Routine(
        tree.name,
        node.name,
        tuple(reader.instructions),
        tuple(reader.tools.values()),
        tuple(reader.objects.values()),
    )
    return ReadRoutine(described, tuple(reader.spans))


def _what_else(node: RoutineDeclaration) -> str:
    return f"'{node.name}' has parameters" if node.parameters else f"'{node.name}' has handlers"


@dataclass
class _Reader:
    """Statements read so far."""

    scope: Scope
    module: Scope
    instructions: list[rapid.Instruction] = field(default_factory=list)
    spans: list[Span] = field(default_factory=list)
    findings: list[Diagnostic] = field(default_factory=list)
    tools: dict[str, rapid.ToolData] = field(default_factory=dict)
    objects: dict[str, rapid.WorkObjectData] = field(default_factory=dict)
    _triggers: dict[str, rapid.Trigger] = field(default_factory=dict)
    _variables: dict[str, Value] = field(default_factory=dict)
    _mode: tuple[bool, bool] = (False, False)

    def fault(self, span: Span, message: str) -> None:
        help = "a routine of moves, signals, waits and calls only"
        self.findings.append(error("RG763", span, message, help))

    def read(self, statement: Statement, span: Span) -> None:
        """Read one statement; report it if it has no counterpart."""
        try:
            result = self._instruction(statement)
        except NotConstant as fault:
            self.fault(span, f"a value is not known before the run: {fault}")
            return
        except _Unsupported as fault:
            self.fault(span, str(fault))
            return
        if result is not None:
            self.instructions.append(result)
            self.spans.append(span)

    def _instruction(self, node: Statement) -> rapid.Instruction | None:
        if isinstance(node, Assignment):
            return self._assignment(node)
        if not isinstance(node, ProcedureCall):
            raise _Unsupported(f"{type(node).__name__} is no instruction of an exported program")
        name, arguments = node.name.lower(), _Arguments(node.arguments)
        if name in _MOVES:
            return self._move(name, arguments)
        if name == "triggio":
            self._define_trigger(arguments)
            return None
        if name in _SETS:
            kind = cast("rapid.SignalKind", _SETS[name])
            return rapid.SetSignal(arguments.name(0), kind, self._number(arguments.required[1]))
        if name in _WAITS:
            kind = cast("rapid.SignalKind", _WAITS[name])
            limit = arguments.optional.get("maxtime")
            seconds = _FOREVER if limit is None else self._number(limit)
            value = self._number(arguments.required[1])
            return rapid.WaitSignal(arguments.name(0), kind, value, seconds)
        if name == "waittime":
            return rapid.Wait(self._number(arguments.required[0]))
        if name in ("singarea", "confl"):
            return self._path_mode(name, arguments)
        if name in _SETTINGS:
            return None
        values = tuple(self._argument(a) for a in arguments.required)
        return rapid.Call(node.name, values)

    def _assignment(self, node: Assignment) -> rapid.Instruction | None:
        if not isinstance(node.target, Name):
            raise _Unsupported("only whole variables are assigned")
        if isinstance(node.value, FunctionCall):
            symbol = self.scope.find(node.target.name)
            kind = symbol.type if isinstance(symbol, DataSymbol) else ""
            values = tuple(self._argument(a) for a in _Arguments(node.value.arguments).required)
            return rapid.Call(node.value.name, values, kind)
        symbol = self.scope.find(node.target.name)
        if not isinstance(symbol, DataSymbol) or symbol.kind != "VAR":
            raise _Unsupported(f"{node.target.name} is assigned")
        self._variables[node.target.name.lower()] = evaluate(node.value, self.scope, symbol.type)
        return None

    def _path_mode(self, name: str, arguments: "_Arguments") -> rapid.PathMode | None:
        singular, other = self._mode
        if name == "singarea":
            singular = "wrist" in arguments.switches
        else:
            other = "off" in arguments.switches
        changed = (singular, other) != self._mode
        self._mode = singular, other
        if not changed:
            return None
        last = self.instructions[-1] if self.instructions else None
        if isinstance(last, rapid.PathMode):
            # SingArea and ConfL stand together.
            self.instructions.pop()
            self.spans.pop()
        return rapid.PathMode(singular, other)

    def _move(self, name: str, arguments: "_Arguments") -> rapid.Move:
        kind = cast("Literal['AbsJ', 'J', 'L', 'C']", _MOVES[name])
        values = list(arguments.required)
        if set(arguments.optional) - {"wobj", "tload", "t", *(f"t{n}" for n in range(2, 9))}:
            raise _Unsupported(f"an argument of {name} has no counterpart")
        if arguments.switches - {"noeoffs"}:
            raise _Unsupported(f"\\{min(arguments.switches - {'noeoffs'})} has no counterpart")
        via = self._robtarget(values.pop(0)) if kind == "C" else None
        target: rapid.Target
        goal = values.pop(0)
        target = self._jointtarget(goal) if kind == "AbsJ" else self._robtarget(goal)
        tcp, orientation, linear, rotary = self._numbers(values.pop(0), "speeddata")
        triggers = []
        if name.startswith("trigg"):
            named = [values.pop(0), *(arguments.optional[t] for t in arguments.triggers)]
            triggers = [self._trigger(each) for each in named]
        finep, *sizes = cast("tuple[Value, ...]", self._value(values.pop(0), "zonedata"))
        zone = rapid.FINE if finep else rapid.Zone(False, _floats(tuple(sizes)))
        tool = self._tool(values.pop(0))
        wobj = arguments.optional.get("wobj")
        seconds = self._number(arguments.optional["t"]) if "t" in arguments.optional else 0.0
        return rapid.Move(
            kind,
            target,
            rapid.Speed(tcp, orientation, linear, rotary),
            zone,
            tool,
            "wobj0" if wobj is None else self._object(wobj),
            via,
            tuple(triggers),
            seconds,
        )

    def _define_trigger(self, arguments: "_Arguments") -> None:
        kinds = {f"{kind.lower()}p": kind for kind in ("DO", "GO", "AO")}
        (option,) = [name for name in arguments.optional if name in kinds] or [""]
        if not option or set(arguments.optional) - {option}:
            raise _Unsupported("an argument of TriggIO has no counterpart")
        signal = arguments.optional[option]
        if not isinstance(signal, Name):
            raise _Unsupported("a signal has no name")
        reference: rapid.Reference = "end"
        if "start" in arguments.switches:
            reference = "start"
        elif "time" in arguments.switches:
            reference = "time"
        self._triggers[arguments.name(0).lower()] = rapid.Trigger(
            signal.name,
            cast("rapid.SignalKind", kinds[option]),
            self._number(arguments.required[2]),
            reference,
            self._number(arguments.required[1]),
        )

    def _trigger(self, node: Expression) -> rapid.Trigger:
        if isinstance(node, Name) and node.name.lower() in self._triggers:
            return self._triggers[node.name.lower()]
        raise _Unsupported("a trigger is not defined by TriggIO before the move")

    # -- values -----------------------------------------------------------------------------------

    def _value(self, node: Expression, kind: str) -> Value:
        """Return a value; persistents have that of their declaration. Raises NotConstant."""
        symbol = self.scope.find(node.name) if isinstance(node, Name) else None
        if isinstance(symbol, DataSymbol) and symbol.kind == "PERS" and symbol.initial is not None:
            return evaluate(symbol.initial, self.module, kind)
        return evaluate(node, self.scope, kind)

    def _number(self, node: Expression) -> float:
        return _rounded(cast("float", self._value(node, "num")))

    def _numbers(self, node: Expression, kind: str) -> tuple[float, ...]:
        return _floats(cast("tuple[Value, ...]", self._value(node, kind)))

    def _robtarget(self, node: Expression) -> rapid.RobTarget:
        trans, rot, conf, extax = cast(
            "tuple[tuple[float, ...], ...]", self._value(node, "robtarget")
        )
        cf = tuple(round(value) for value in conf)
        return rapid.RobTarget(_floats(trans), _floats(rot), cf, _floats(extax))

    def _jointtarget(self, node: Expression) -> rapid.JointTarget:
        robax, extax = cast("tuple[tuple[float, ...], ...]", self._value(node, "jointtarget"))
        return rapid.JointTarget(_floats(robax), _floats(extax))

    def _argument(self, node: Expression) -> rapid.Argument:
        if isinstance(node, Name):
            if node.name.lower() in self._variables:
                symbol = self.scope.find(node.name)
                assert isinstance(symbol, DataSymbol), "assigned before"
                return _as_argument(self._variables[node.name.lower()], symbol.type, inout=True)
            symbol = self.scope.find(node.name)
            if isinstance(symbol, DataSymbol):
                return _as_argument(self._value(node, symbol.type), symbol.type)
        for kind in ("num", "bool", "string"):
            try:
                value = evaluate(node, self.scope, kind)
            except NotConstant:
                continue
            if isinstance(value, bool) == (kind == "bool"):
                return _as_argument(value, kind)
        raise _Unsupported("an argument has no value before the run")

    def _tool(self, node: Expression) -> str:
        """Return a tool's name; its declaration is read if the module has one."""
        if not isinstance(node, Name):
            raise _Unsupported("a tool has no name")
        symbol = self.scope.find(node.name)
        if isinstance(symbol, DataSymbol) and symbol.module is not None:
            held, frame, load = cast("tuple[Value, ...]", self._value(node, "tooldata"))
            mass, centre, axes, *inertia = cast("tuple[Value, ...]", load)
            self.tools[symbol.name] = rapid.ToolData(
                symbol.name,
                bool(held),
                _frame(frame),
                rapid.Load(
                    _rounded(cast("float", mass)),
                    _floats(cast("tuple[Value, ...]", centre)),
                    _floats(cast("tuple[Value, ...]", axes)),
                    _floats(tuple(inertia)),
                ),
            )
            return symbol.name
        return node.name

    def _object(self, node: Expression) -> str:
        if not isinstance(node, Name):
            raise _Unsupported("a work object has no name")
        symbol = self.scope.find(node.name)
        if isinstance(symbol, DataSymbol) and symbol.module is not None:
            held, _, _, user, inner = cast("tuple[Value, ...]", self._value(node, "wobjdata"))
            self.objects[symbol.name] = rapid.WorkObjectData(
                symbol.name, bool(held), _frame(user), _frame(inner)
            )
            return symbol.name
        return node.name


class _Arguments:
    """Arguments of a call by their kind; optional names are in lower case."""

    def __init__(self, arguments: Sequence[Argument]) -> None:
        self.required: list[Expression] = []
        self.optional: dict[str, Expression] = {}
        self.switches: set[str] = set()
        for argument in arguments:
            if argument.kind == "required" and argument.value is not None:
                self.required.append(argument.value)
            elif argument.kind == "optional" and argument.value is not None:
                self.optional[str(argument.name).lower()] = argument.value
            elif argument.kind == "switch":
                self.switches.add(str(argument.name).lower())
            else:
                raise _Unsupported("a conditional argument")

    @property
    def triggers(self) -> list[str]:
        """Names of further triggers, T2 to T8, in their order."""
        return [name for n in range(2, 9) if (name := f"t{n}") in self.optional]

    def name(self, number: int) -> str:
        """Return the name given as an argument. Raises _Unsupported for another expression."""
        node = self.required[number] if number < len(self.required) else None
        if not isinstance(node, Name):
            raise _Unsupported("a signal or trigger has no name")
        return node.name


def _as_argument(value: Value, kind: str, *, inout: bool = False) -> rapid.Argument:
    if kind == "robtarget":
        trans, rot, conf, extax = cast("tuple[tuple[float, ...], ...]", value)
        cf = tuple(round(each) for each in conf)
        target = rapid.RobTarget(_floats(trans), _floats(rot), cf, _floats(extax))
        return rapid.Argument(target, kind, inout)
    if kind == "jointtarget":
        robax, extax = cast("tuple[tuple[float, ...], ...]", value)
        return rapid.Argument(rapid.JointTarget(_floats(robax), _floats(extax)), kind, inout)
    if isinstance(value, tuple):
        raise _Unsupported(f"an argument is a {kind}")
    if kind == "num":
        return rapid.Argument(_rounded(cast("float", value)), kind, inout)
    return rapid.Argument(value, kind, inout)


def _frame(value: Value) -> rapid.Frame:
    trans, rot = cast("tuple[tuple[float, ...], ...]", value)
    return rapid.Frame(_floats(trans), _floats(rot))


def _floats(values: Sequence[Value]) -> tuple[float, ...]:
    return tuple(_rounded(cast("float", value)) for value in values)


def _rounded(value: float) -> float:
    """Return a num in the decimals that it was written with, seven significant digits."""
    return float(f"{value:.7g}")
