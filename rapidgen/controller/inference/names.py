"""Names of a foreign program."""

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from types import MappingProxyType
from typing import Final

from rapidgen.diagnostics import Span
from rapidgen.rapid.binding import ModuleScope, RoutineSymbol, Scope, constant, match
from rapidgen.rapid.binding.expressions import declared_type, type_of
from rapidgen.rapid.binding.names import NUMBER, called, degree, element
from rapidgen.rapid.builtins.signatures import record, records, type_class
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.lexer import KEYWORDS
from rapidgen.rapid.syntax.walk import children
from rapidgen.runtime import unsupported

# -- Names and their use ---------------------------------------------------------------------------
#
# Use of names: every node with its scope, and the type of an expression from its place.


_RULED: Mapping[str, str] = {"AND": "bool", "OR": "bool", "XOR": "bool", "DIV": "num", "MOD": "num"}
"""Types of operands, from the operator alone."""


@lru_cache(maxsize=64)
def scoped(module: ModuleScope) -> Sequence[tuple[n.Node, Scope]]:
    """Return the nodes of a module, in the order of the text.

    Initial values that are numbers alone are left out: most of a module with targets.
    """
    result: list[tuple[n.Node, Scope]] = []
    stack: list[tuple[n.Node, Scope]] = [(d, module) for d in reversed(module.tree.declarations)]
    while stack:
        node, scope = stack.pop()
        result.append((node, scope))
        if isinstance(node, n.DataDeclaration) and has_numbers(node.initial):
            stack += [(size, scope) for size in reversed(node.dimensions)]
            continue
        inside = scope
        if isinstance(node, n.RoutineDeclaration):
            inside = module.routine(node)
        elif isinstance(node, n.For) and not isinstance(scope, ModuleScope):
            inside = scope.loop(node)
        stack += [(child, inside) for child in reversed(children(node))]
    return result


def has_numbers(initial: n.Expression | None) -> bool:
    """Return True for an initial value that is an aggregate of numbers alone."""
    return isinstance(initial, n.Aggregate) and initial.shape is not None


def read(node: n.Node, scope: Scope) -> Iterator[tuple[n.Expression, str]]:
    """Iterate over expressions in a node, with types from their context."""
    match node:
        case n.Binary():
            ruled = _RULED.get(node.operator, "")
            yield node.left, ruled or type_of(node.right, scope) or ""
            yield node.right, ruled or type_of(node.left, scope) or ""
        case n.Unary():
            yield node.operand, "bool" if node.operator == "NOT" else "num"
        case n.Branch() | n.CompactIf() | n.While():
            yield node.condition, "bool"
        case n.Assignment():
            yield node.value, declared_type(node.target, scope) or ""
            yield node.target, type_of(node.value, scope) or ""
        case n.Test():
            values = [value for case in node.cases for value in case.values]
            yield node.subject, next(filter(None, (type_of(v, scope) for v in values)), "")
        case n.For():
            yield from ((end, "num") for end in (node.start, node.end))
        case n.DataDeclaration():
            yield from ((size, "num") for size in node.dimensions)
            if node.initial is not None and not has_numbers(node.initial):
                name = n.Name(node.name_token, node.name_token, node.name)
                yield node.initial, declared_type(name, scope) or ""
        case n.Index():
            yield from ((index, "num") for index in node.indices)


def passed(
    arguments: list[n.Argument], routine: RoutineSymbol, scope: Scope
) -> Iterator[tuple[n.Expression, str, str]]:
    """Iterate over arguments of a known routine.

    Each has the type (empty: any) and mode of its parameter.
    """
    parameters = routine.parameters or ()
    for pair in match(parameters, arguments, lambda _, alternatives: alternatives[0]).pairs:
        value = pair.argument.value
        if value is not None and pair.parameter >= 0:
            expected = parameters[pair.parameter]
            kind = (routine.module or scope.module).base(expected.type) or ""
            is_any = kind == "anytype" or expected.dimensions
            yield value, "" if is_any else kind, expected.mode


# -- Default tools ---------------------------------------------------------------------------------
#
# Tools, work objects, loads and speeds without a value in the program: persistents whose other
# declaration is in a task outside the files. In an inferred cell predefined data (tool0, wobj0,
# load0, v100) replace them; with all numbers 0 no move and no CRobT would be possible.


_DEFAULTS: Final[Mapping[str, str]] = {
    "tooldata": "tool0",
    "wobjdata": "wobj0",
    "loaddata": "load0",
    "speeddata": "v100",
}


@dataclass(frozen=True, slots=True)
class DefaultedPersistent:
    """A persistent of a module, and the predefined datum for it."""

    task: str
    module: str
    name: str
    replacement: str


def find_defaulted_persistents(
    tasks: Iterable[tuple[str, Iterable[ModuleScope]]],
) -> dict[DefaultedPersistent, tuple[str, Span]]:
    """Return such persistents of all tasks, with types and places."""
    result: dict[DefaultedPersistent, tuple[str, Span]] = {}
    filled: set[str] = set()
    for task, modules in tasks:
        for module in modules:
            filled |= set(_filled(module))
            for one in module.tree.data:
                kind = one.type.lower()
                if one.kind == "PERS" and kind in _DEFAULTS and not (one.initial or one.dimensions):
                    row = DefaultedPersistent(task, module.tree.name, one.name, _DEFAULTS[kind])
                    result[row] = kind, module.tree.source.span(one.name_token, one.name_token)
    return {row: at for row, at in result.items() if row.name.casefold() not in filled}


def _filled(module: ModuleScope) -> Iterator[str]:
    """Iterate over data of a module with a value or an assignment."""
    for node, _ in scoped(module):
        if isinstance(node, n.DataDeclaration) and node.initial is not None:
            yield node.name.casefold()
        elif isinstance(node, n.Assignment):
            target = node.target
            while isinstance(target, n.Index | n.Member):
                target = target.base
            if isinstance(target, n.Name):
                yield target.name.casefold()


# -- Records ---------------------------------------------------------------------------------------
#
# The record of an undeclared datum, from the components that a program accesses:
# `mySpeed.v_leax := 5000;` makes it a speeddata.


_PREFERRED: Final = ("robtarget", "jointtarget", "pose", "pos", "orient", "speeddata", "tooldata")
"""Records that programs use most, the first that fits is taken: `x.trans` is also in a pose."""


def accessed_components(module: ModuleScope) -> Iterator[tuple[n.Name, tuple[str, ...]]]:
    """Iterate over undeclared names with components, and the path of these (lower case)."""
    for node, scope in scoped(module):
        path: list[str] = []
        base = node
        while isinstance(base, n.Member):
            path.insert(0, base.component.lower())
            base = base.base
        if path and isinstance(base, n.Name) and scope.find(base.name) is None:
            yield base, tuple(path)


def record_of(paths: Collection[tuple[str, ...]], known: str) -> str:
    """Return the predefined record with all these components; empty if it is not certain.

    `known` is the type by another use, which is taken if it fits.
    """
    fitting = [name for name in records() if all(_has(name, path) for path in paths)]
    if known in fitting:
        return known
    preferred = [name for name in _PREFERRED if name in fitting]
    return preferred[0] if preferred else fitting[0] if len(fitting) == 1 else ""


def _has(kind: str, path: Sequence[str]) -> bool:
    """Return True if a type has a component, and that the further ones of the path."""
    if not path:
        return True
    one = record(kind)
    components = {name.lower(): type_name for type_name, name in one.components} if one else {}
    return path[0] in components and _has(components[path[0]], path[1:])


# -- Missing routines ------------------------------------------------------------------------------
#
# Stubs for called routines that are in no file.
#
# Public modules call routines that remained on the controller, and built-in ones that are not
# simulated (ExecEngine, CSSAct, CyclicBrakeCheck). A stub takes the arguments of its
# first call, by their types, and the optional ones of all further calls. It does nothing and
# returns RAPID's default: 0, FALSE, an empty text, or the robot's position for a target. The result
# of a function that a condition waits for is a datum, which is set like other polled data. A call
# whose arguments have an unknown type, or a type of the program, gets no stub: the task stops
# there.


_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,31}")
_DATA_OF_STUBS = frozenset(("bool", "num", "dnum", "string"))
"""Types of results that are inferred when a program waits for them."""
_LONGEST = 32
"""Characters of a RAPID name."""
_Call = n.ProcedureCall | n.FunctionCall | n.LateCall


def stub_datum(name: str) -> str:
    """Return the name of the datum whose value the stub of a function returns."""
    return f"r_{name}"[:_LONGEST]


@dataclass(frozen=True, slots=True)
class _Parameter:
    """A parameter of a stub; `name` is empty if no call contains it."""

    name: str
    declaration: str
    """Without its name."""

    @property
    def optional(self) -> bool:
        return self.declaration.startswith("\\")

    def text(self, number: int) -> str:
        before, _, after = self.declaration.partition("{")
        return f"{before} {self.name or f'given{number}'}" + (f"{{{after}" if after else "")


@dataclass(frozen=True, slots=True)
class MissingRoutine:
    """A called routine that is in no file.

    `type` is that of its result, empty for procedures and traps.
    """

    name: str
    type: str
    parameters: tuple[_Parameter, ...]
    span: Span
    is_trap: bool = False
    is_builtin: bool = False
    """A routine of RAPID or of an option that is not simulated."""

    @property
    def kind(self) -> str:
        """Display name of its kind: proc, func num, trap."""
        kind = f"func {self.type}" if self.type else "trap" if self.is_trap else "proc"
        return f"{kind}, not simulated" if self.is_builtin else kind

    @property
    def data(self) -> tuple[tuple[str, str, str], ...]:
        """Data that the stub needs: kind and type, name, no value."""
        is_needed = self.type in _DATA_OF_STUBS
        return ((f"VAR {self.type}", stub_datum(self.name), ""),) if is_needed else ()

    def stub(self, value: str) -> str:
        """Return the declaration of a stub that returns `value`.

        Empty means the default of its type.
        """
        if self.is_trap:
            return f"    TRAP {self.name}\n    ENDTRAP\n"
        given = (p.text(number) for number, p in enumerate(self.parameters, 1))
        head = f"{self.name}({','.join(given)})"
        if not self.type:
            return f"    PROC {head}\n    ENDPROC\n"
        if self.type in _DATA_OF_STUBS:
            returned = stub_datum(self.name)
            return f"    FUNC {self.type} {head}\n        RETURN {returned};\n    ENDFUNC\n"
        initial = f" := {value}" if value else ""
        return (
            f"    FUNC {self.type} {head}\n"
            f"        VAR {self.type} nothing{initial};\n"
            f"        RETURN nothing;\n"
            f"    ENDFUNC\n"
        )


def assigned_texts(module: ModuleScope) -> Iterator[tuple[str, str]]:
    """Iterate over lower-case names of data, and literal texts that they receive."""
    for node, _ in scoped(module):
        match node:
            case n.Assignment(target=n.Name() as target, value=n.StringLiteral() as text):
                yield target.name.casefold(), text.value
            case n.DataDeclaration(initial=n.StringLiteral() as text):
                yield node.name.casefold(), text.value


def absent(
    modules: Sequence[ModuleScope],
    types: Mapping[str, str],
    texts: Mapping[str, Collection[str]] = MappingProxyType({}),
) -> tuple[MissingRoutine, ...]:
    """Return undeclared routines that a task calls, for stubs.

    Each is returned once. `types` are those of undeclared names, by lower-case name, `texts` those
    that data receive: late calls may name a routine by them.
    """
    result: dict[str, MissingRoutine] = {}
    for module in modules:
        if not module.tree.name:
            continue
        kinds: dict[int, str] = {}
        for node, scope in scoped(module):
            # The nodes around a call come before it.
            kinds.update((id(e), kind) for e, kind in _wanted(node, scope))
            if isinstance(node, n.LateCall) and isinstance(node.procedure, n.Name):
                given = _parameters(node.arguments, scope, types)
                at = module.tree.source.span(node.first, node.first)
                for name in texts.get(node.procedure.name.casefold(), ()):
                    if given is not None and _is_missing(name, scope):
                        result.setdefault(name.casefold(), MissingRoutine(name, "", given, at))
            name = _unknown(node, scope)
            if not name:
                continue
            before = result.get(name.casefold())
            at = module.tree.source.span(node.first, node.first)
            if isinstance(node, n.Connect):
                result.setdefault(name.casefold(), MissingRoutine(name, "", (), at, is_trap=True))
                continue
            assert isinstance(node, _Call)
            parameters = _parameters(node.arguments, scope, types)
            if parameters is None:
                continue
            if before is not None and not before.is_trap:
                merged = _with_options(before.parameters, parameters)
                result[name.casefold()] = replace(before, parameters=merged)
                continue
            wanted = kinds.get(id(node), "").replace(NUMBER, "num")
            is_function = isinstance(node, n.FunctionCall)
            if not is_function or type_class(wanted) is not None:
                kind = wanted if is_function else ""
                result[name.casefold()] = MissingRoutine(
                    name, kind, parameters, at, is_builtin=_is_unsupported(name)
                )
    return tuple(result.values())


def _with_options(
    known: Sequence[_Parameter], further: Sequence[_Parameter]
) -> tuple[_Parameter, ...]:
    """Return a stub with the additional optional parameters of a call."""
    merged, place = list(known), 0
    for parameter in further:
        names = [p.name.casefold() if p.optional else "" for p in merged]
        if parameter.optional and parameter.name.casefold() in names:
            place = names.index(parameter.name.casefold()) + 1
        elif not parameter.optional:
            place = next((k for k in range(place, len(names)) if not names[k]), place - 1) + 1
        else:
            merged.insert(place, parameter)
            place += 1
    return tuple(merged)


def _wanted(node: n.Node, scope: Scope) -> Iterator[tuple[n.Expression, str]]:
    yield from read(node, scope)
    if isinstance(node, n.ProcedureCall | n.FunctionCall):
        routine = called(scope.find(node.name))
        if isinstance(routine, RoutineSymbol):
            yield from ((e, kind) for e, kind, _ in passed(node.arguments, routine, scope))


def _unknown(node: n.Node, scope: Scope) -> str:
    """Return the name of an undeclared routine that a node calls.

    Returns "" for other nodes.
    """
    name: object = ""
    if isinstance(node, n.LateCall):
        name = constant(node.procedure, scope)
    elif isinstance(node, n.ProcedureCall | n.FunctionCall):
        name = node.name
    elif isinstance(node, n.Connect):
        name = node.trap
    return name if isinstance(name, str) and _is_missing(name, scope) else ""


def _is_missing(name: str, scope: Scope) -> bool:
    """Return True for a name that a routine can have, and none that is executed has."""
    if _NAME.fullmatch(name) is None or name.upper() in KEYWORDS:
        return False
    symbol = scope.find(name)
    return symbol is None or (symbol.module is None and _is_unsupported(name))


def _is_unsupported(name: str) -> bool:
    """Return True for a routine of RAPID or of an option that only stops a task here."""
    return name.lower() in unsupported.names() | unsupported.option_routines()


def _parameters(
    arguments: Sequence[n.Argument], scope: Scope, types: Mapping[str, str]
) -> tuple[_Parameter, ...] | None:
    """Return parameters for these arguments, None for an unknown type."""
    result = []
    for argument in arguments:
        name = argument.name or ""
        if argument.kind == "switch":
            result.append(_Parameter(name, "\\switch"))
            continue
        value = argument.value
        kind = None if value is None else type_of(value, scope) or declared_type(value, scope)
        if not kind and isinstance(value, n.Name):
            kind = types.get(value.name.casefold(), "")
        kind = (kind or "").replace(NUMBER, "num")
        persisted = type_class(element(kind))
        if persisted is None:
            return None
        mode = "" if persisted == "value" else "VAR "
        dimensions = "{" + ",".join("*" * degree(kind)) + "}" if degree(kind) else ""
        optional = "" if argument.kind == "required" else "\\"
        result.append(_Parameter(name, f"{optional}{mode}{element(kind)}{dimensions}"))
    return tuple(result)
