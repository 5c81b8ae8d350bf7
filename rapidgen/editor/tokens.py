"""Semantic tokens and inlay hints of a module."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

from rapidgen.diagnostics import Span
from rapidgen.editor.workspace import View
from rapidgen.rapid.binding import (
    DataSymbol,
    RoutineSymbol,
    Symbol,
)
from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.builtins.signatures import Value
from rapidgen.rapid.syntax.nodes import Argument, FunctionCall, Name, Node, ProcedureCall
from rapidgen.rapid.syntax.walk import walk

TOKEN_TYPES: Final = (
    "namespace", "type", "struct", "parameter", "variable", "property", "function", "method",
    "event", "label",
)  # fmt: skip
"""`method`: a PROC; `event`: a TRAP; `property`: a component, or an object of the configuration."""
TOKEN_MODIFIERS: Final = (
    "declaration", "readonly", "static", "modification", "defaultLibrary", "persistent", "local",
)  # fmt: skip
"""`persistent`: a PERS; `local`: declared LOCAL; `static`: data of a module."""
_KINDS: Final = {
    "PROC": "method",
    "FUNC": "function",
    "TRAP": "event",
    "MODULE": "namespace",
    "LABEL": "label",
    "COMPONENT": "property",
    "RECORD": "struct",
    "ALIAS": "type",
    "TYPE": "type",
    "PARAMETER": "parameter",
    "INSTALLED": "property",
}
_TYPE_INDEX: Final = {name: index for index, name in enumerate(TOKEN_TYPES)}
_BIT: Final = {name: 1 << index for index, name in enumerate(TOKEN_MODIFIERS)}


@dataclass(frozen=True, slots=True)
class SemanticToken:
    """A name with its meaning; `kind` and `modifiers` are those of the legends above."""

    line: int
    """From 1, like the column, which counts code points."""
    column: int
    length: int
    kind: int
    modifiers: int


def semantic_tokens(view: View, lines: tuple[int, int] | None = None) -> list[SemanticToken]:
    """Return the names of a module in order; with `lines` those of lines first to last (from 1).

    Keywords, numbers, strings and comments are for the editor's own grammar.
    """
    source = view.source
    result = []
    for token, symbol in sorted(view.names.names.items()):
        if not 0 <= token < len(source.tokens):
            continue
        text = source.tokens[token]
        line, column = source.position(source.starts[token])
        if lines is not None and not lines[0] <= line <= lines[1]:
            continue
        if text.startswith('"'):
            continue
        kind = _TYPE_INDEX[_KINDS.get(symbol.kind, "variable")]
        modifiers = _modifiers(view, symbol, token)
        result.append(SemanticToken(line, column, len(text), kind, modifiers))
    return result


def _modifiers(view: View, symbol: Symbol, token: int) -> int:
    bits = 0
    if symbol.module is view.module and symbol.token == token:
        bits |= _BIT["declaration"]
    if symbol.module is None and symbol.kind != "INSTALLED":
        bits |= _BIT["defaultLibrary"]
    if symbol.local:
        bits |= _BIT["local"]
    if isinstance(symbol, DataSymbol):
        if symbol.readonly:
            bits |= _BIT["readonly"]
        if symbol.kind == "PERS":
            bits |= _BIT["persistent"]
        elif symbol.routine is None and symbol.module is not None:
            bits |= _BIT["static"]
        tokens = view.source.tokens
        if token + 1 < len(tokens) and tokens[token + 1] == ":=":
            bits |= _BIT["modification"]
    return bits


# -- inlay hints ---------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Hint:
    """A text that an editor shows before or behind a place, without being in the file."""

    span: Span
    text: str
    is_behind: bool
    """Behind the span, else before it."""


def inlay_hints(view: View, lines: tuple[int, int]) -> list[Hint]:
    """Return hints for calls in lines first to last (from 1).

    Arguments of the program's own routines get the name of their parameter, unless they are a
    name that says the same. Built-in speeds and zones get their value with its unit, because
    v1000 and z50 are only names.
    """
    source = view.source
    result: list[Hint] = []
    for routine in view.module.tree.routines:
        last = min(routine.last, len(source.tokens) - 1)
        if source.line(routine.first) > lines[1] or source.line(last) < lines[0]:
            continue
        for node in walk(routine):
            if isinstance(node, ProcedureCall | FunctionCall) and node.arguments:
                line = source.line(node.first)
                if lines[0] <= line <= lines[1]:
                    result += _of_call(view, node)
    return result


def _of_call(view: View, node: ProcedureCall | FunctionCall) -> Iterator[Hint]:
    symbol = view.names.names.get(node.first)
    if not isinstance(symbol, RoutineSymbol):
        return
    span = view.source.span
    if symbol.module is None:
        for argument in node.arguments:
            value = argument.value
            text = _motion_value(view, value) if isinstance(value, Name) else ""
            if text and value is not None:
                yield Hint(span(value.first, value.last), text, True)
        return
    required = [p for p in symbol.parameters or () if not p.optional]
    given = [a for a in node.arguments if a.kind == "required"]
    for parameter, argument in zip(required, given, strict=False):
        if argument.name is None and not _says(argument, parameter.name):
            yield Hint(span(argument.first, argument.first), f"{parameter.name}:=", False)


def _says(argument: Argument, name: str) -> bool:
    """Return True if an argument is a datum or component that has the parameter's name in it."""
    value = argument.value
    text = getattr(value, "name", "") or getattr(value, "component", "")
    return isinstance(value, Node) and (name.lower() in text.lower() or len(name) == 1)


def _motion_value(view: View, node: Name) -> str:
    """Return the value of a predefined speed or zone; empty for other data."""
    symbol = view.names.names.get(node.first)
    if not isinstance(symbol, DataSymbol) or symbol.module is not None:
        return ""
    predefined = signatures.constant(symbol.name)
    value: Value | None = predefined.value if predefined is not None else None
    if not isinstance(value, tuple):
        return ""
    of = symbol.type.lower()
    if of == "speeddata":
        return f"{_number(value[0])} mm/s"
    if of == "zonedata" and value[0] is False:
        return f"{_number(value[1])} mm"
    return ""


def _number(value: Value) -> str:
    return f"{value:g}" if isinstance(value, int | float) else ""


def encoded(tokens: Sequence[tuple[int, int, int, int, int]]) -> list[int]:
    """Return tokens in the protocol's form: five numbers each, places relative to the one before.

    Each token is (line, character, length, kind, modifiers), from 0 and in units of the client.
    """
    result: list[int] = []
    last_line = last_character = 0
    for line, character, length, kind, modifiers in tokens:
        start = character - last_character if line == last_line else character
        result += (line - last_line, start, length, kind, modifiers)
        last_line, last_character = line, character
    return result
