"""Places of symbols: definitions, references, implementations, calls, symbols of a workspace.

Symbols of different tasks are different, also with the same name, except for what the controller
has once: persistents with the same name and type, objects of the configuration, and the
declarations of a file that several tasks load.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

from rapidgen.diagnostics import Span
from rapidgen.editor.cfg_files import installed_place
from rapidgen.editor.documents import Location
from rapidgen.editor.workspace import LoadedTask, View, Workspace
from rapidgen.rapid.binding import (
    BoundModule,
    ComponentSymbol,
    DataSymbol,
    ModuleSymbol,
    RoutineSymbol,
    Symbol,
    TypeSymbol,
)
from rapidgen.rapid.binding.constants import constant
from rapidgen.rapid.binding.names import element
from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.syntax.nodes import LateCall, RoutineDeclaration
from rapidgen.rapid.syntax.walk import walk

_MOST_SYMBOLS: Final = 500
"""Symbols of one answer to a search."""


def symbol_at(view: View, line: int, column: int) -> Symbol | None:
    """Return the symbol at a line and column (from 1, code points)."""
    return view.names.at(line, column)


def name_span(view: View, token: int) -> Span:
    """Return the place of a name; without the quotes of a late call's string."""
    span = view.source.span(token, token)
    if view.source.tokens[token].startswith('"'):
        return Span(span.path, span.line, span.column + 1, span.end_line, span.end_column - 1)
    return span


def _declaration(view: View, symbol: Symbol) -> Location | None:
    """Return the declaration of a symbol; that of a signal is in the cfg files of a backup."""
    if symbol.kind == "INSTALLED":
        span = installed_place(view.program.program.root, symbol.name)
        return Location(span) if span is not None else None
    return location_of(symbol)


def location_of(symbol: Symbol) -> Location | None:
    """Return the declaration of a symbol.

    That of a built-in one is in the headers of this package, whose files an editor can show.
    """
    at = symbol.declared_at
    if at is not None and symbol.module is not None:
        node = symbol.node
        source = symbol.module.tree.source
        if isinstance(symbol, ModuleSymbol) or node is None or node.last >= len(source.tokens):
            return Location(at)
        return Location(at, source.span(node.first, node.last))
    name = symbol.record.name if isinstance(symbol, ComponentSymbol) and symbol.record else ""
    place = signatures.place(name or symbol.name)
    if place is None:
        return None
    path, line, column, length = place
    return Location(Span(str(path), line, column, line, column + length))


def definitions(workspace: Workspace, path: str, line: int, column: int) -> list[Location]:
    """Return the declarations of the symbol at a place, of all tasks of the file."""
    found = []
    for view in workspace.views(path):
        symbol = symbol_at(view, line, column)
        if symbol is not None:
            found.append(_declaration(view, symbol))
    return _unique(found)


def type_definitions(workspace: Workspace, path: str, line: int, column: int) -> list[Location]:
    """Return the declarations of the type of the symbol at a place."""
    found = []
    for view in workspace.views(path):
        symbol = symbol_at(view, line, column)
        if isinstance(symbol, DataSymbol | RoutineSymbol | ComponentSymbol) and symbol.type:
            scope = symbol.module or view.module
            of = scope.find(element(symbol.type))
            if isinstance(of, TypeSymbol):
                found.append(location_of(of))
    return _unique(found)


def implementations(workspace: Workspace, path: str, line: int, column: int) -> list[Location]:
    """Return the procedures that a late call at a place may run, else the definitions.

    The name of a constant late call is known. A computed one may run any procedure of the program
    with the same number of required arguments.
    """
    found: list[Location | None] = []
    for view in workspace.views(path):
        call = _late_call_at(view, line, column)
        if call is None:
            continue
        scope = view.module
        named = constant(call.procedure, scope, "string")
        if isinstance(named, str):
            symbol = scope.find(named)
            found.append(location_of(symbol) if isinstance(symbol, RoutineSymbol) else None)
            continue
        given = sum(argument.kind == "required" for argument in call.arguments)
        for other in view.task.check.scope.globals.values():
            if isinstance(other, RoutineSymbol) and other.kind == "PROC":
                required = sum(not p.optional for p in other.parameters or ())
                if required == given:
                    found.append(location_of(other))
    return _unique(found) or definitions(workspace, path, line, column)


def _late_call_at(view: View, line: int, column: int) -> LateCall | None:
    offset = view.source.offset(line, column)
    starts, tokens = view.source.starts, view.source.tokens
    for node in walk(view.module.tree):
        if isinstance(node, LateCall):
            end = node.procedure.last + 1
            if starts[node.first] <= offset <= starts[end] + len(tokens[end]):
                return node
    return None


def _unique(found: list[Location | None]) -> list[Location]:
    return list(dict.fromkeys(place for place in found if place is not None))


# -- references --------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True, eq=False)
class Mention:
    """A name in a module that means a symbol."""

    view: View
    token: int

    @property
    def span(self) -> Span:
        """Its place, without quotes."""
        return name_span(self.view, self.token)


def same_symbols(view: View, symbol: Symbol) -> list[tuple[LoadedTask, Symbol]]:
    """Return a symbol as each task of the program has it."""
    result: list[tuple[LoadedTask, Symbol]] = [(view.task, symbol)]
    path = symbol.module.tree.source.path if symbol.module is not None else ""
    shared = is_shared_persistent(symbol)
    for task in view.program.tasks:
        if task is view.task:
            continue
        other: Symbol | None = None
        if symbol.module is None:
            if isinstance(symbol, ComponentSymbol) and symbol.record is not None:
                other = task.check.scope.members(symbol.record).get(symbol.name.lower())
            else:
                other = task.check.scope.find(symbol.name.lower())
            if other is not symbol and not isinstance(other, ComponentSymbol):
                other = None
        else:
            same = [m for m in task.modules.values() if m.tree.source.path == path]
            if same and symbol.token >= 0:
                other = task.names_of(same[0]).names.get(symbol.token)
            elif shared:
                twin = task.check.scope.find(symbol.name.lower())
                if twin is not None and is_shared_persistent(twin) and _equal(symbol, twin):
                    other = twin
        if other is not None:
            result.append((task, other))
    return result


def is_shared_persistent(symbol: Symbol) -> bool:
    """Return True for a persistent that all tasks share that declare it [K §2.18]."""
    if not isinstance(symbol, DataSymbol) or symbol.kind != "PERS" or symbol.routine is not None:
        return False
    return symbol.node is not None and getattr(symbol.node, "scope", "") == ""


def _equal(one: Symbol, other: Symbol) -> bool:
    if not isinstance(one, DataSymbol) or not isinstance(other, DataSymbol):
        return False
    return (one.type.lower(), one.degree) == (other.type.lower(), other.degree)


def mentions(view: View, symbol: Symbol, *, declarations: bool) -> list[Mention]:
    """Return all names of a program that mean a symbol, sorted by file and place."""
    word = symbol.name.lower()
    result: dict[tuple[str, int], Mention] = {}
    for task, own in same_symbols(view, symbol):
        for path, module in task.modules.items():
            words = view.program.words[path]
            if word not in words and f'"{word}"' not in words:
                continue
            bound: BoundModule = task.names_of(module)
            here = View(view.workspace, view.program, task, module)
            for token, named in bound.names.items():
                is_declaration = token == own.token and own.module is module
                if named is own and token >= 0 and (declarations or not is_declaration):
                    result.setdefault((module.tree.source.path, token), Mention(here, token))
    return [result[key] for key in sorted(result)]


def references(
    workspace: Workspace, path: str, line: int, column: int, *, declarations: bool
) -> list[Location]:
    """Return the places that name the symbol at a place, in all modules of its program."""
    found: list[Location | None] = []
    for view in workspace.views(path):
        symbol = symbol_at(view, line, column)
        if symbol is not None:
            all_names = mentions(view, symbol, declarations=declarations)
            found += [Location(mention.span) for mention in all_names]
    return _unique(found)


@dataclass(frozen=True, slots=True)
class Highlight:
    """A mention of a symbol in the same module."""

    span: Span
    is_write: bool


def highlights(view: View, line: int, column: int) -> list[Highlight]:
    """Return the mentions of the symbol at a place in its module; assignments are writes."""
    symbol = symbol_at(view, line, column)
    if symbol is None:
        return []
    tokens = view.source.tokens
    result = []
    for token, named in sorted(view.names.names.items()):
        if named is symbol and token >= 0:
            following = tokens[token + 1] if token + 1 < len(tokens) else ""
            is_write = following == ":=" and isinstance(symbol, DataSymbol)
            result.append(Highlight(name_span(view, token), is_write))
    return result


# -- calls -------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True, eq=False)
class Call:
    """A routine on the other end of calls, and the places of the calls."""

    view: View
    symbol: RoutineSymbol
    spans: tuple[Span, ...]


def routine_at(view: View, line: int, column: int) -> RoutineSymbol | None:
    """Return the routine that a place names or, without a name there, the one around it."""
    symbol = symbol_at(view, line, column)
    if isinstance(symbol, RoutineSymbol):
        return symbol if symbol.node is not None else None
    token = view.names.token_at(line, column)
    if symbol is not None and token is None:
        return None
    offset = view.source.offset(line, column)
    for routine in view.module.tree.routines:
        starts = view.source.starts
        if starts[routine.first] <= offset <= starts[routine.last]:
            return _symbol_of(view, routine)
    return None


def _symbol_of(view: View, routine: RoutineDeclaration) -> RoutineSymbol | None:
    symbol = view.module.own.get(routine.name.lower())
    return symbol if isinstance(symbol, RoutineSymbol) and symbol.node is routine else None


def incoming(view: View, symbol: RoutineSymbol) -> list[Call]:
    """Return the routines that call one, in its task."""
    grouped: dict[RoutineSymbol, tuple[View, list[Span]]] = {}
    for mention in mentions(view, symbol, declarations=False):
        routine = _routine_around(mention.view, mention.token)
        caller = _symbol_of(mention.view, routine) if routine is not None else None
        if caller is not None:
            grouped.setdefault(caller, (mention.view, []))[1].append(mention.span)
    return [Call(where, caller, tuple(spans)) for caller, (where, spans) in grouped.items()]


def outgoing(view: View, symbol: RoutineSymbol) -> list[Call]:
    """Return the routines of the program that one calls."""
    routine, module = symbol.node, symbol.module
    if routine is None or module is None:
        return []
    here = View(view.workspace, view.program, view.task, module)
    grouped: dict[RoutineSymbol, list[Span]] = {}
    for token, named in sorted(here.names.names.items()):
        inside = routine.first < token <= routine.last and token != symbol.token
        if inside and isinstance(named, RoutineSymbol) and named.module is not None:
            grouped.setdefault(named, []).append(name_span(here, token))
    return [
        Call(View(here.workspace, here.program, here.task, called.module), called, tuple(spans))
        for called, spans in grouped.items()
        if called.module is not None
    ]


def _routine_around(view: View, token: int) -> RoutineDeclaration | None:
    for routine in view.module.tree.routines:
        if routine.first <= token <= routine.last:
            return routine
    return None


# -- symbols of a workspace --------------------------------------------------------------------


@dataclass(frozen=True, slots=True, eq=False)
class FoundSymbol:
    """A declaration that a search has found."""

    symbol: Symbol
    location: Location
    container: str


def search_symbols(workspace: Workspace, query: str) -> list[FoundSymbol]:
    """Return declarations of modules whose names have the letters of `query` in this order.

    Names that begin with it come first, then those that contain it. At most 500.
    """
    wanted = query.casefold()
    ranked: list[tuple[int, str, FoundSymbol]] = []
    seen: set[Span] = set()
    for program in workspace.loaded():
        for view in program.all_views(workspace):
            for symbol in (view.module.symbol, *view.module.own.values()):
                rank = _rank(symbol.name.casefold(), wanted)
                place = location_of(symbol) if rank >= 0 else None
                if place is None or place.span in seen:
                    continue
                seen.add(place.span)
                container = "" if isinstance(symbol, ModuleSymbol) else view.module.tree.name
                found = FoundSymbol(symbol, place, container)
                ranked.append((rank, symbol.name.casefold(), found))
    ranked.sort(key=lambda item: item[:2])
    return [found for _, _, found in ranked[:_MOST_SYMBOLS]]


def _rank(name: str, wanted: str) -> int:
    """Return 0, 1 or 2, the smaller the better; -1: the name does not fit."""
    if name.startswith(wanted):
        return 0
    if wanted in name:
        return 1
    letters: Iterator[str] = iter(name)
    return 2 if all(letter in letters for letter in wanted) else -1
