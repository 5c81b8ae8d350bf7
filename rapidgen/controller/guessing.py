"""What programs name and nobody declares, as the description of a cell: a guess.

A public program seldom has its controller's configuration beside it. The type of a name is that of
the parameter that it is an argument of; where it is only read, its first letters tell as ABB's
examples name signals (di, do, gi, go, ai, ao), and what is compared with 0 or 1 is a digital input.
Tools have the load of tool0 and are the flange; a work object is a table in front of the robot.
Values of other types say something about the program that nobody can guess; they stay unknown.
"""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Literal, cast

from rapidgen.config.cell import CellDescription, CellSignalKeys
from rapidgen.config.model import Load, Placement, Tool, WorkObject
from rapidgen.controller.polling import Polled, polled
from rapidgen.diagnostics import Span
from rapidgen.rapid import Dialect, parse
from rapidgen.rapid.binding import (
    ModuleScope,
    RoutineSymbol,
    Scope,
    TaskScope,
    installed_objects,
    match,
)
from rapidgen.rapid.binding.names import called
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import children, walk
from rapidgen.system.model import System

Kind = Literal["DI", "DO", "GI", "GO", "AI", "AO"]
_PREFIX = re.compile(r"(?i:[dga][io])(?![a-z]{3})")
"""diStart, DO1, gi_part; not `difference`."""
_LOAD = Load(0.001, (0.0, 0.0, 0.000001))
"""That of tool0 [3HAC16581-1 tooldata]: a tool without any is refused by moves."""
_DIONUM = frozenset(("high", "low", "edge"))
_DATA = frozenset({"tooldata", "wobjdata", "loaddata"})


@dataclass(frozen=True, slots=True)
class Named:
    """A name that nobody declares: its type (empty: not to be told), and where it is used first."""

    name: str
    type: str
    span: Span
    sure: int = 0
    """0: nothing tells; 1: it is read as a number; 2: it is the argument of a parameter."""


@dataclass(frozen=True, slots=True)
class Guess:
    """A made-up cell, what is in it, and what could not be made up."""

    cell: CellDescription
    named: tuple[Named, ...]
    unknown: tuple[Named, ...]
    polled: tuple[Polled, ...] = ()
    """Comparisons of guessed inputs in loops."""


def guess(
    system: System, units: Iterable[str] = (), table: tuple[float, float, float] = (0.0, 0.0, 0.0)
) -> Guess:
    """The cell that the programs of `system` seem to stand in.

    `units` are its mechanical units, `table` is where work objects are, m.
    """
    found: dict[str, Named] = {}
    assigned: set[str] = set()
    looked_at: list[Polled] = []
    known = [(signal.name, f"signal{signal.type.lower()}") for signal in system.signals]
    known += [(f"{task.name}Id", "taskid") for task in system.tasks]
    known += [(unit, "mecunit") for unit in (*units, "ROB_ID")]
    for spec in system.tasks:
        task = TaskScope(installed_objects(known))
        dialect = Dialect(system.robotware)
        scopes = [
            task.add(parse(f.data, path=f.path, dialect=dialect), installed=f.installed or f.shared)
            for f in spec.modules
        ]
        for scope in scopes:
            looked_at += polled(scope, spec.entry)
            assigned |= _assigned(scope)
            for one in _undeclared(scope):
                before = found.setdefault(one.name.casefold(), one)
                if one.sure > before.sure:
                    surer = replace(before, type=one.type, sure=one.sure)
                    found[one.name.casefold()] = surer
    for key in assigned & found.keys():
        # No signal is assigned: it is a datum of some type.
        if found[key].type.startswith("signal"):
            found[key] = replace(found[key], type="")
    made = {one.name: one.type for one in found.values()}
    cell = CellDescription(
        signals={
            name: CellSignalKeys(cast(Kind, kind[6:].upper()))
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
    )
    named = [one for one in found.values() if _can_be_made(one.type)]
    unknown = [one for one in found.values() if not _can_be_made(one.type)]
    inputs = {name.casefold() for name, keys in cell.signals.items() if keys.kind[1] == "I"}
    rows = dict.fromkeys(row for row in looked_at if row.signal in inputs)
    return Guess(cell, tuple(named), tuple(unknown), tuple(rows))


def _can_be_made(kind: str) -> bool:
    return kind.startswith("signal") or kind in _DATA


def _assigned(module: ModuleScope) -> set[str]:
    return {
        node.target.name.casefold()
        for routine in module.tree.routines
        for node in walk(routine)
        if isinstance(node, n.Assignment) and isinstance(node.target, n.Name)
    }


def _undeclared(module: ModuleScope) -> Iterator[Named]:
    """Every use of a datum that nobody declares, in a module."""
    if not module.tree.name:
        return
    stack: list[tuple[n.Node, Scope]] = [(d, module) for d in reversed(module.tree.declarations)]
    while stack:
        node, scope = stack.pop()
        for name, kind in _uses(node, scope):
            if scope.find(name.name) is None:
                at = module.tree.source.span(name.first, name.first)
                read_as = _read_as(name.name, node)
                yield Named(name.name, kind or read_as, at, 2 if kind else bool(read_as))
        inside = scope
        if isinstance(node, n.RoutineDeclaration):
            inside = module.routine(node)
        elif isinstance(node, n.For) and not isinstance(scope, ModuleScope):
            inside = scope.loop(node)
        stack += [(child, inside) for child in reversed(list(children(node)))]


def _uses(node: n.Node, scope: Scope) -> Iterator[tuple[n.Name, str]]:
    """Plain names that stand in a node, with the type that they must have; empty: any."""
    if isinstance(node, n.FunctionCall | n.ProcedureCall):
        routine = called(scope.find(node.name))
        if isinstance(routine, RoutineSymbol):
            yield from _arguments(node.arguments, routine, scope)
        return
    for read in _read(node):
        if isinstance(read, n.Name):
            yield read, ""


def _read(node: n.Node) -> tuple[n.Expression, ...]:
    match node:
        case n.Binary():
            return node.left, node.right
        case n.Assignment():
            return (node.value,)
        case n.Test():
            return (node.subject,)
    return ()


def _arguments(
    arguments: list[n.Argument], routine: RoutineSymbol, scope: Scope
) -> Iterator[tuple[n.Name, str]]:
    parameters = routine.parameters or ()
    for pair in match(parameters, arguments, lambda _, alternatives: alternatives[0]).pairs:
        value = pair.argument.value
        if isinstance(value, n.Name) and pair.parameter >= 0:
            kind = (routine.module or scope.module).base(parameters[pair.parameter].type) or ""
            # A signal stands for its value where a number is wanted.
            yield value, "" if kind in ("anytype", "num", "dnum") else kind


def _read_as(name: str, node: n.Node) -> str:
    """What a name may be that a node reads as a number."""
    prefix = _PREFIX.match(name)
    if prefix is not None:
        return f"signal{prefix[0].lower()}"
    if isinstance(node, n.Binary) and node.operator in ("=", "<>"):
        for side in (node.left, node.right):
            if isinstance(side, n.NumberLiteral) and side.value in (0, 1):
                return "signaldi"
            if isinstance(side, n.Name) and side.name.casefold() in _DIONUM:
                return "signaldi"
    return ""
