"""Inferred description of a cell for undeclared names of programs.

A public program usually lacks its controller's configuration. The rules of inference:

1. The type of a name is that of the parameter that it is an argument of.
2. If a name is only read, its first letters decide, as ABB's examples name signals (di, do, gi, go,
   ai, ao); a name compared with 0 or 1 is a digital input.
3. Tools have the load of tool0 and are at the flange; a work object is a table in front of the
   robot; a mechanical unit is at its place and has no axes; a camera sees one object in its centre.
4. Data of other types have RAPID's default: 0, FALSE, an empty text. Exceptions: a divisor is 1, a
   target is the start position of the robot, `v25` is a speed of 25 mm/s and `z5` a zone of 5 mm.
5. Components decide before all others: `mySpeed.v_leax` makes mySpeed a speeddata.
6. A number that is the port of a socket gets a port of its own.
7. A name without a type stays unknown.
"""

import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Literal, cast

from rapidgen.config.cell import CameraKeys, CellDescription, CellSignalKeys, ForceKeys, SeenKeys
from rapidgen.config.model import Load, Placement, Tool, WorkObject
from rapidgen.controller.inference.answers import (
    PolledData,
    PolledSignals,
    exchanged_persistents,
    flags,
    passed_arguments,
    polled,
    wait_conditions,
)
from rapidgen.controller.inference.names import (
    DefaultedPersistent,
    absent,
    accessed_components,
    assigned_texts,
    find_defaulted_persistents,
    has_numbers,
    passed,
    read,
    record_of,
    scoped,
    stub_datum,
)
from rapidgen.controller.inference.peers import ExpectedMessages, expected_messages
from rapidgen.diagnostics import Span
from rapidgen.rapid import Dialect
from rapidgen.rapid.binding import (
    ModuleScope,
    RoutineSymbol,
    Scope,
    TaskScope,
    TypeSymbol,
    constant,
    installed_objects,
)
from rapidgen.rapid.binding.expressions import declared_type
from rapidgen.rapid.binding.names import NUMBER, array, called, degree, element
from rapidgen.rapid.builtins.signatures import type_class
from rapidgen.rapid.module_trees import tree_of
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk
from rapidgen.system.model import System

Kind = Literal["DI", "DO", "GI", "GO", "AI", "AO"]
_PREFIX = re.compile(r"(?i:[dga][io])(?![a-z]{3})")
"""diStart, DO1, gi_part; not `difference`."""
_LOAD = Load(0.001, (0.0, 0.0, 0.000001))
"""That of tool0 [3HAC16581-1 tooldata]: a tool without any is refused by moves."""
_DIONUM = frozenset(("high", "low", "edge"))
_DATA = frozenset({"tooldata", "wobjdata", "loaddata"})
_MADE = frozenset(("mecunit", "cameradev"))
_NUM = re.compile(r"n[A-Z_\d]|num[A-Z_\d]|reg\d")
"""Names that programmers use for numbers: nCount."""
_NUMBERED = re.compile(r"[vz](\d{1,4})", re.I)
_ELEMENTS = 20
"""Elements of an array of unknown size."""
_NOTHING: Mapping[str, str] = {"num": "0", "dnum": "0", "bool": "FALSE", "string": '""'}
_ORDER = frozenset(("<", ">", "<=", ">="))
_ALIASIO = 2
_PORTS = frozenset(("socketbind", "socketconnect"))
_WITH_PORT = 3
"""Required arguments of these, of which the port is the last."""
_FIRST_PORT = 4100
"""Of inferred ports; each name gets one of its own."""
_Use = tuple[n.Name, str, int]


@dataclass(frozen=True, slots=True)
class UndeclaredName:
    """An undeclared name: its type (empty: unknown) and first use."""

    name: str
    type: str
    span: Span
    sure: int = 0
    """0: no evidence; 1: read as a number; 2: argument of a parameter."""


@dataclass(frozen=True, slots=True)
class InferredCell:
    """An inferred cell, its contents, and the names without a result."""

    cell: CellDescription
    named: tuple[UndeclaredName, ...]
    unknown: tuple[UndeclaredName, ...]
    polled: tuple[PolledSignals, ...] = ()
    """Comparisons of inferred inputs in loops."""
    data: tuple[tuple[str, str, str], ...] = ()
    """Kind and type (`VAR num`), name and initial value (empty: none) of inferred data."""
    units: tuple[str, ...] = ()
    """Mechanical units."""
    routines: str = ""
    """Declarations of missing routines, without effect."""
    flags: tuple[PolledData, ...] = ()
    """Data that programs look at and do not set."""
    expected_messages: ExpectedMessages = field(default_factory=ExpectedMessages)
    """Messages that programs expect at their sockets."""
    blank: tuple[DefaultedPersistent, ...] = ()
    """Tools and work objects whose values another task would set."""
    driven: frozenset[str] = frozenset()
    """Signals without another source, lower case: inputs, and outputs that are only read."""
    divisors: frozenset[str] = frozenset()
    """Names of what is divided by, lower case."""


def infer_cell(
    system: System,
    units: Iterable[str] = (),
    table: tuple[float, float, float] = (0.0, 0.0, 0.0),
    frames: Mapping[str, str] = MappingProxyType({}),
) -> InferredCell:
    """Return the cell that the programs of `system` seem to need.

    `units` are its mechanical units, `table` is the place of work objects in m, `frames` the start
    robtarget and jointtarget of the robot as RAPID texts.
    """
    found: dict[str, UndeclaredName] = {}
    assigned: set[str] = set()
    tasks: list[list[ModuleScope]] = []
    known = [(signal.name, f"signal{signal.type.lower()}") for signal in system.signals]
    known += [(camera, "cameradev") for camera in system.cameras]
    known += [(f"{task.name}Id", "taskid") for task in system.tasks]
    known += [(unit, "mecunit") for unit in (*units, "ROB_ID")]
    for spec in system.tasks:
        task = TaskScope(installed_objects(known))
        dialect = Dialect(system.robotware, some=not system.is_robotware_known)
        scopes = [
            task.add(tree_of(f, dialect), installed=f.installed or f.shared) for f in spec.modules
        ]
        tasks.append(scopes)
        for scope in scopes:
            assigned |= _assigned(scope)
            for one in _undeclared(scope):
                before = found.setdefault(one.name.casefold(), one)
                if one.sure > before.sure:
                    surer = replace(before, type=one.type, sure=one.sure)
                    found[one.name.casefold()] = surer
    paths: dict[str, set[tuple[str, ...]]] = {}
    for scopes in tasks:
        for scope in scopes:
            for name, path in accessed_components(scope):
                key = name.name.casefold()
                at = scope.tree.source.span(name.first, name.first)
                found.setdefault(key, UndeclaredName(name.name, "", at))
                paths.setdefault(key, set()).add(path)
    for key, components in paths.items():
        found[key] = replace(found[key], type=record_of(components, found[key].type))
    for key in assigned & found.keys():
        # No signal is assigned: it is a number.
        if found[key].type.startswith("signal"):
            found[key] = replace(found[key], type="num")
    made = {one.name: one.type for one in found.values()}
    divisors = {name for scopes in tasks for scope in scopes for name in _divisors(scope)}
    cell = CellDescription(
        signals={
            name: CellSignalKeys(
                cast(Kind, kind[6:].upper()), value=float(name.casefold() in divisors)
            )
            for name, kind in made.items()
            if kind.startswith("signal")
        },
        tools=tuple(Tool(name, load=_LOAD) for name, kind in made.items() if kind == "tooldata"),
        work_objects=tuple(
            WorkObject(name, user_frame=Placement(table))
            for name, kind in made.items()
            if kind == "wobjdata"
        ),
        loads={name: _LOAD for name, kind in made.items() if kind == "loaddata"},
        force=ForceKeys(),
        cameras={
            name: CameraKeys([[SeenKeys(name)]])
            for name in (*system.cameras, *(n for n, kind in made.items() if kind == "cameradev"))
        },
    )
    named = [one for one in found.values() if _can_be_made(one.type)]
    unknown = [one for one in found.values() if not _can_be_made(one.type)]
    handed = {name for scopes in tasks for scope in scopes for name in passed_arguments(scope)}
    given = {
        name.casefold()
        for name, keys in cell.signals.items()
        if keys.kind[1] == "I" or name.casefold() not in handed
    }
    # Inputs declared in a backup have no source either. A cross connection sets its own.
    made_here = {connection.result.casefold() for connection in system.cross}
    given |= {s.name.casefold() for s in system.signals if s.type[1] == "I"} - made_here
    looks = {
        spec.name: tuple(wait_conditions(scopes, spec.entry))
        for spec, scopes in zip(system.tasks, tasks, strict=True)
    }
    rows = dict.fromkeys(row for spec in system.tasks for row in polled(looks[spec.name], given))
    persisted = {name for scopes in tasks for scope in scopes for name in _persistent(scope)}
    initial = {word for scopes in tasks for scope in scopes for word in _in_initial_values(scope)}
    sizes = {name: size for scopes in tasks for scope in scopes for name, size in _sizes(scope)}
    ports = dict.fromkeys(port for scopes in tasks for scope in scopes for port in _ports(scope))
    values = {port: _FIRST_PORT + k for k, port in enumerate(ports)}
    values |= dict.fromkeys(divisors, 1) | sizes
    arrays = {name: dims for scopes in tasks for scope in scopes for name, dims in _arrays(scope)}
    data = tuple(
        _declaration(one, frames, initial | sizes.keys(), persisted, values, arrays)
        for one in named
        if _is_plain(one.type)
    )
    made_units = tuple(one.name for one in named if one.type == "mecunit")
    made |= {signal.name.casefold(): f"signal{signal.type.lower()}" for signal in system.signals}
    kinds = {name.casefold(): kind for name, kind in made.items()}
    texts: dict[str, set[str]] = {}
    for scope in (scope for scopes in tasks for scope in scopes):
        for receiver, text in assigned_texts(scope):
            texts.setdefault(receiver, set()).add(text)
    stubs = {one.name.casefold(): one for scopes in tasks for one in absent(scopes, kinds, texts)}
    named += [UndeclaredName(s.name, s.kind, s.span) for s in stubs.values()]
    data += tuple(row for stub in stubs.values() for row in stub.data)
    kinds |= {stub_datum(s.name).casefold(): s.type for s in stubs.values() if s.type}
    exchanged = exchanged_persistents(tasks, kinds)
    looked = dict.fromkeys(
        flag
        for spec, scopes in zip(system.tasks, tasks, strict=True)
        for flag in flags(spec.name, scopes, looks[spec.name], kinds, exchanged)
    )
    blank = find_defaulted_persistents(
        (spec.name, s) for spec, s in zip(system.tasks, tasks, strict=True)
    )
    named += [UndeclaredName(row.name, kind, span) for row, (kind, span) in blank.items()]
    listens = expected_messages((scope for scopes in tasks for scope in scopes), frames)
    routines = "".join(s.stub(frames.get(s.type, "")) for s in stubs.values())
    scoped.cache_clear()  # the nodes of this system are not needed again
    return InferredCell(
        cell,
        tuple(named),
        tuple(unknown),
        tuple(rows),
        data,
        made_units,
        routines,
        tuple(looked),
        listens,
        tuple(blank),
        frozenset(given),
        frozenset(divisors),
    )


def _can_be_made(kind: str) -> bool:
    return kind.startswith("signal") or kind in _DATA or kind in _MADE or _is_plain(kind)


def _is_plain(kind: str) -> bool:
    """Return True for a predefined type that any module may declare, or an array of one."""
    kind = element(kind)
    ours = kind.startswith("signal") or kind in _DATA or kind in ("mecunit", "taskid", "cameradev")
    return not ours and type_class(kind) is not None


def _declaration(
    one: UndeclaredName,
    frames: Mapping[str, str],
    initial: Collection[str],
    persisted: Collection[str],
    sizes: Mapping[str, int],
    arrays: Mapping[str, tuple[int, ...]],
) -> tuple[str, str, str]:
    """Return the declaration of an inferred datum.

    A name in an initial value becomes a constant if its value is known, a name in a place for
    persistents a persistent.
    """
    if degree(one.type):
        plain = replace(one, type=element(one.type))
        dims = arrays.get(one.name.casefold(), ())
        dims = (*dims, *(_ELEMENTS,) * degree(one.type))[: degree(one.type)]
        value = _value(plain, frames)
        for size in reversed(dims):
            value = value and f"[{','.join([value] * size)}]"
        return f"VAR {plain.type}", f"{one.name}{{{','.join(map(str, dims))}}}", value
    value = str(sizes.get(one.name.casefold()) or _value(one, frames))
    if one.name.casefold() in initial:
        value = value or _NOTHING.get(one.type, "")
        return f"{'CONST' if value else 'VAR'} {one.type}", one.name, value
    return f"{'PERS' if one.name.casefold() in persisted else 'VAR'} {one.type}", one.name, value


def _persistent(module: ModuleScope) -> Iterator[str]:
    """Iterate over names in places that require a persistent."""
    for node, scope in scoped(module):
        if isinstance(node, n.FunctionCall | n.ProcedureCall):
            routine = called(scope.find(node.name))
            if isinstance(routine, RoutineSymbol):
                for one, _, mode in passed(node.arguments, routine, scope):
                    if isinstance(one, n.Name) and mode == "PERS":
                        yield one.name.casefold()


def _in_initial_values(module: ModuleScope) -> Iterator[str]:
    """Iterate over names in the initial values of a module's data."""
    for declared in module.tree.data:
        if declared.initial is not None and not has_numbers(declared.initial):
            for node in walk(declared.initial):
                if isinstance(node, n.Name):
                    yield node.name.casefold()


def _ports(module: ModuleScope) -> Iterator[str]:
    """Iterate over names of the ports of sockets."""
    for node, scope in scoped(module):
        if isinstance(node, n.ProcedureCall) and node.name.lower() in _PORTS:
            routine = called(scope.find(node.name))
            if isinstance(routine, RoutineSymbol) and routine.module is None:
                given = [a.value for a in node.arguments if a.kind == "required"]
                port = given[-1] if len(given) == _WITH_PORT else None
                if isinstance(port, n.Name):
                    yield port.name.casefold()


def _divisors(module: ModuleScope) -> Iterator[str]:
    """Iterate over names of divisors."""
    for node, _ in scoped(module):
        if isinstance(node, n.Binary) and node.operator in ("/", "DIV", "MOD"):
            by = node.right.inner if isinstance(node.right, n.Parenthesis) else node.right
            yield from (one.name.casefold() for one in walk(by) if isinstance(one, n.Name))


def _sizes(module: ModuleScope) -> Iterator[tuple[str, int]]:
    """Iterate over names of array sizes.

    The number is that of the elements in the initial value.
    """
    tree = module.tree
    for declared in (*tree.data, *(d for routine in tree.routines for d in routine.data)):
        for place, size in enumerate(declared.dimensions):
            if isinstance(size, n.Name):
                complete = declared.initial if place == 0 else None
                known = len(complete.members) if isinstance(complete, n.Aggregate) else _ELEMENTS
                yield size.name.casefold(), known


def _arrays(module: ModuleScope) -> Iterator[tuple[str, tuple[int, ...]]]:
    """Iterate over names that receive aggregates, with the sizes of these as arrays."""
    for node, _ in scoped(module):
        if isinstance(node, n.Assignment) and isinstance(node.target, n.Name):
            dims: list[int] = []
            value = node.value
            while isinstance(value, n.Aggregate):
                dims.append(len(value.members))
                value = value.members[0]
            if dims:
                yield node.target.name.casefold(), tuple(dims)


def _value(one: UndeclaredName, frames: Mapping[str, str]) -> str:
    numbered = _NUMBERED.fullmatch(one.name)
    figure = float(numbered[1]) if numbered is not None else 0.0
    match one.type:
        case "speeddata":
            return f"[{figure or 100:g},500,5000,1000]"
        case "zonedata" if figure:
            return f"[FALSE,{figure:g},{figure:g},{figure:g},1,{figure:g},1]"
        case "zonedata":
            return "[TRUE,0,0,0,0,0,0]"
    return frames.get(one.type, "")


def _assigned(module: ModuleScope) -> set[str]:
    return {
        node.target.name.casefold()
        for routine in module.tree.routines
        for node in walk(routine)
        if isinstance(node, n.Assignment) and isinstance(node.target, n.Name)
    }


def _undeclared(module: ModuleScope) -> Iterator[UndeclaredName]:
    """Iterate over uses of undeclared data in a module."""
    if not module.tree.name:
        return
    for node, scope in scoped(module):
        for name, kind, sure in (*_uses(node, scope), *_elements(node, scope)):
            # A signal may have the name of a type: SENSOR.
            if isinstance(scope.find(name.name), TypeSymbol | None):
                at = module.tree.source.span(name.first, name.first)
                yield UndeclaredName(name.name, kind, at, sure)


def _uses(node: n.Node, scope: Scope) -> Iterator[_Use]:
    """Iterate over plain names in a node.

    Each has its apparent type (empty: any) and the certainty of it.
    """
    if isinstance(node, n.FunctionCall | n.ProcedureCall):
        if node.name.lower() == "aliasio":
            yield from _aliased(node, scope)
            return
        routine = called(scope.find(node.name))
        if isinstance(routine, RoutineSymbol):
            for name, kind, _ in passed(node.arguments, routine, scope):
                if not isinstance(name, n.Name):
                    continue
                # A signal represents its value where a number is required.
                if kind in ("", "num", "dnum"):
                    result = _read_as(name.name, node) or kind
                    yield name, result, 1 if result else 0
                else:
                    yield name, kind, 2
        elif routine is None:
            for argument in node.arguments:
                if isinstance(argument.value, n.Name):
                    # An argument of a missing routine may be a number.
                    result = _read_as(argument.value.name, node)
                    yield argument.value, result or "num", 1 if result else 0
        return
    for one, kind in read(node, scope):
        if isinstance(one, n.Name):
            # Without other evidence, a compared name is a number.
            plain = kind or (
                "num" if isinstance(node, n.Binary) and node.operator in _ORDER else ""
            )
            result = _read_as(one.name, node) or plain.replace(NUMBER, "num")
            yield one, result, 1 if result else 0


def _elements(node: n.Node, scope: Scope) -> Iterator[_Use]:
    """Iterate over undeclared arrays whose elements a node reads, writes or passes on."""
    for one, kind in _typed(node, scope):
        if isinstance(one, n.Index) and isinstance(one.base, n.Name) and _is_plain(kind):
            yield one.base, array(kind, len(one.indices)), 2


def _typed(node: n.Node, scope: Scope) -> Iterator[tuple[n.Expression, str]]:
    """Iterate over expressions in a node, with the types of their places."""
    yield from ((one, kind.replace(NUMBER, "num")) for one, kind in read(node, scope))
    if isinstance(node, n.FunctionCall | n.ProcedureCall):
        routine = called(scope.find(node.name))
        if isinstance(routine, RoutineSymbol):
            yield from ((one, kind) for one, kind, _ in passed(node.arguments, routine, scope))


def _aliased(node: n.FunctionCall | n.ProcedureCall, scope: Scope) -> Iterator[_Use]:
    """Return the signal of an alias, given by text or by itself."""
    values = [argument.value for argument in node.arguments if argument.value is not None]
    kind = declared_type(values[-1], scope) if len(values) == _ALIASIO else None
    if kind is not None and kind.startswith("signal"):
        given = constant(values[0], scope)
        if isinstance(given, str):
            yield n.Name(node.first, node.last, given), kind, 2
        elif isinstance(values[0], n.Name):
            yield values[0], kind, 2


def _read_as(name: str, node: n.Node) -> str:
    """Return the type of a name that a node reads as a number."""
    prefix = _PREFIX.match(name)
    if prefix is not None:
        return f"signal{prefix[0].lower()}"
    if isinstance(node, n.Binary) and node.operator in ("=", "<>") and not _NUM.match(name):
        for side in (node.left, node.right):
            if isinstance(side, n.NumberLiteral) and side.value in (0, 1):
                return "signaldi"
            if isinstance(side, n.Name) and side.name.casefold() in _DIONUM:
                return "signaldi"
    return ""
