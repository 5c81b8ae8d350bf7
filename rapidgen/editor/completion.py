"""Completion and signature help.

The place decides what is offered: types in declarations, procedures and keywords where a statement
begins, data and functions in expressions, components behind a dot, optional arguments behind a
backslash, labels behind GOTO, traps behind WITH. Names that fit the type of their place come first.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Final, Literal

from rapidgen.editor.cursor import Cursor, OpenCall, cursor_at, is_statement_start, open_call
from rapidgen.editor.hover import headline, parameter_labels, parameter_text, signature_text
from rapidgen.editor.workspace import View
from rapidgen.rapid.binding import (
    DATA,
    DataSymbol,
    RoutineScope,
    RoutineSymbol,
    Symbol,
    TypeSymbol,
    builtin,
)
from rapidgen.rapid.binding.lookup import type_before
from rapidgen.rapid.binding.names import NUMERIC, element, equal
from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.syntax.nodes import Parameter

Kind = Literal[
    "keyword", "snippet", "procedure", "function", "trap", "type", "record", "variable",
    "persistent", "constant", "parameter", "component", "signal", "label", "switch", "module",
]  # fmt: skip
_DATA_WORDS: Final = frozenset(("VAR", "PERS", "CONST", "INOUT", "REF", "ALIAS", "FUNC"))
_SNIPPETS: Final = {
    "IF": "IF ${1:condition} THEN\n    $0\nENDIF",
    "FOR": "FOR ${1:i} FROM ${2:1} TO ${3:n} DO\n    $0\nENDFOR",
    "WHILE": "WHILE ${1:condition} DO\n    $0\nENDWHILE",
    "TEST": "TEST ${1:value}\nCASE ${2:1}:\n    $0\nDEFAULT:\nENDTEST",
}
_DECLARATIONS: Final = {
    "PROC": "PROC ${1:name}()\n    $0\nENDPROC",
    "FUNC": "FUNC ${1:num} ${2:name}()\n    $0\n    RETURN ${3:0};\nENDFUNC",
    "TRAP": "TRAP ${1:name}\n    $0\nENDTRAP",
    "RECORD": "RECORD ${1:name}\n    ${2:num} ${3:part};\nENDRECORD",
}
_STATEMENTS: Final = (
    "CONNECT", "EXIT", "GOTO", "RAISE", "RETRY", "RETURN", "TRYNEXT", "VAR", "CONST", "ERROR",
    "UNDO", "BACKWARD", "ELSE", "ELSEIF", "CASE", "DEFAULT", "ENDIF", "ENDFOR", "ENDWHILE",
    "ENDTEST", "ENDPROC", "ENDFUNC", "ENDTRAP",
)  # fmt: skip
_IN_MODULE: Final = ("VAR", "PERS", "CONST", "LOCAL", "TASK", "ALIAS", "ENDMODULE")
_OPERATORS: Final = ("TRUE", "FALSE", "NOT", "AND", "OR", "XOR", "DIV", "MOD")


@dataclass(frozen=True, slots=True)
class Item:
    """A proposal. `insert` is a snippet if `is_snippet`; `rank` sorts, the smallest first."""

    label: str
    kind: Kind
    detail: str = ""
    insert: str = ""
    is_snippet: bool = False
    rank: int = 5
    is_builtin: bool = False
    is_deprecated: bool = False


@dataclass(frozen=True, slots=True)
class Completion:
    """Proposals that replace the word before the cursor, which begins at `start`."""

    items: tuple[Item, ...]
    start: int
    end: int


def complete(view: View, line: int, column: int) -> Completion:
    """Return proposals at a line and column (from 1, code points)."""
    cursor = cursor_at(view, line, column)
    items = () if cursor.is_text else tuple(_items(view, cursor))
    return Completion(items, cursor.start, cursor.offset)


def _items(view: View, cursor: Cursor) -> Iterable[Item]:
    tokens = view.source.tokens
    before = tokens[cursor.token].upper() if 0 <= cursor.token < len(tokens) else ""
    if before == ".":
        return _components(view, cursor)
    call = open_call(view, cursor)
    if before == "\\":
        return _optional(call) if call is not None else _switches(view, cursor)
    if before == "GOTO":
        return _labels(cursor)
    if before == "WITH":
        return [i for i in _routines(view) if i.kind == "trap"]
    if before in _DATA_WORDS or _is_type_place(view, cursor):
        return _types(view)
    if is_statement_start(view, cursor):
        return _statements(view, cursor)
    if before in ("PROC", "TRAP", "MODULE", "RECORD", "FOR", "LOCAL", "TASK"):
        words = (*_DECLARATIONS, *_IN_MODULE) if before in ("LOCAL", "TASK") else ()
        return [Item(word, "keyword") for word in words]
    return _expression(view, cursor, call)


# -- places --------------------------------------------------------------------------------------


def _is_type_place(view: View, cursor: Cursor) -> bool:
    """Return True where a parameter's type is written, or that of a component."""
    tokens = view.source.tokens
    if cursor.token < 0 or cursor.statement > cursor.token:
        return False
    head = [word.upper() for word in tokens[cursor.statement : cursor.statement + 2]]
    last = tokens[cursor.token]
    if head[0] == "RECORD":
        return last == ";" or cursor.token == cursor.statement + 1
    is_header = head[0] in ("PROC", "FUNC") or (head[0] == "LOCAL" and head[-1] in ("PROC", "FUNC"))
    return (
        is_header
        and last in ("(", ",", "\\", "|")
        and ")" not in tokens[cursor.statement : cursor.token]
    )


def _components(view: View, cursor: Cursor) -> Iterator[Item]:
    of = type_before(view.source.tokens, cursor.token - 1, cursor.scope)
    symbol = view.module.find(of) if of else None
    if isinstance(symbol, TypeSymbol):
        for number, member in enumerate(view.task.check.scope.members(symbol).values()):
            yield Item(member.name, "component", member.type, rank=min(9, number))


def _optional(call: OpenCall) -> Iterator[Item]:
    """Yield optional arguments that are neither given nor excluded by a given one."""
    groups = {p.group for p in call.parameters if p.group >= 0 and p.name.lower() in call.given}
    for parameter in call.parameters:
        if not parameter.optional or parameter.name.lower() in call.given:
            continue
        if parameter.group in groups:
            continue
        is_switch = parameter.type.lower() == "switch"
        insert = parameter.name if is_switch else f"{parameter.name}:=$0"
        yield Item(
            parameter.name,
            "switch" if is_switch else "parameter",
            parameter_text(parameter),
            insert,
            not is_switch,
            rank=1,
        )


def _switches(view: View, cursor: Cursor) -> Iterable[Item]:
    """Return types, where an optional parameter is declared."""
    return _types(view) if _is_type_place(view, cursor) else ()


def _labels(cursor: Cursor) -> Iterator[Item]:
    if isinstance(cursor.scope, RoutineScope):
        for label in cursor.scope.labels.values():
            yield Item(label.name, "label", rank=1)


def _statements(view: View, cursor: Cursor) -> Iterator[Item]:
    if not isinstance(cursor.scope, RoutineScope):
        yield from (
            Item(word, "snippet", "", text, True, rank=2) for word, text in _DECLARATIONS.items()
        )
        yield from (Item(word, "keyword", rank=2) for word in _IN_MODULE)
        return
    for word, text in _SNIPPETS.items():
        yield Item(word, "snippet", "", text, True, rank=3)
    yield from (Item(word, "keyword", rank=4) for word in _STATEMENTS)
    yield from (item for item in _routines(view) if item.kind == "procedure")
    yield from (
        _of_datum(view, symbol, "") for symbol in _data(view, cursor) if not symbol.readonly
    )
    yield from _builtin_procedures()


def _expression(view: View, cursor: Cursor, call: OpenCall | None) -> Iterator[Item]:
    expected = _expected(view, cursor, call)
    for symbol in _data(view, cursor):
        yield _of_datum(view, symbol, expected)
    yield from (item for item in _routines(view) if item.kind == "function")
    yield from (Item(word, "keyword", rank=6) for word in _OPERATORS)
    for item, of in _builtin_values():
        yield item if not expected or not _fits(of, expected) else _first(item)
    yield from _builtin_functions()
    if call is not None and call.is_procedure:
        yield from (
            Item("\\" + i.label, i.kind, i.detail, "\\" + i.insert, i.is_snippet, 6)
            for i in _optional(call)
        )


def _expected(view: View, cursor: Cursor, call: OpenCall | None) -> str:
    """Return the type of the place, lower case; empty if it is unknown."""
    tokens = view.source.tokens
    if call is not None and 0 <= call.active < len(call.parameters):
        parameter = call.parameters[call.active]
        base = (call.routine.module or view.module).base(parameter.type)
        return base or parameter.type.lower()
    if cursor.token > 0 and tokens[cursor.token] == ":=":
        return type_before(tokens, cursor.token - 1, cursor.scope) or ""
    return ""


def _fits(of: str | None, expected: str) -> bool:
    if of is None:
        return False
    one, other = element(of), element(expected)
    return equal(one, other) or (one in NUMERIC and other in NUMERIC)


# -- names ---------------------------------------------------------------------------------------


def _data(view: View, cursor: Cursor) -> Iterator[DataSymbol]:
    """Yield data that the cursor sees, the nearest first, without predefined ones."""
    seen: set[str] = set()
    scope = view.task.check.scope
    layers: list[Iterable[Symbol]] = [view.module.own.values()]
    if isinstance(cursor.scope, RoutineScope):
        layers.insert(0, cursor.scope.names.values())
    layers += [scope.globals.values(), scope.installed.values(), scope.configured.values()]
    for layer in layers:
        for symbol in layer:
            key = symbol.name.lower()
            if isinstance(symbol, DataSymbol) and symbol.kind in DATA and key not in seen:
                seen.add(key)
                yield symbol


def _of_datum(view: View, symbol: DataSymbol, expected: str) -> Item:
    kinds: dict[str, Kind] = {
        "VAR": "variable", "PERS": "persistent", "CONST": "constant", "PARAMETER": "parameter",
        "LOOP": "variable", "INSTALLED": "signal",
    }  # fmt: skip
    rank = 2 if symbol.routine is not None else 3
    if expected:
        rank = rank - 2 if _fits(view.module.type_of(symbol), expected) else rank + 3
    stars = "{" + ",".join("*" * symbol.degree) + "}" if symbol.degree else ""
    return Item(symbol.name, kinds[symbol.kind], f"{symbol.type}{stars}", rank=rank)


def _routines(view: View) -> Iterator[Item]:
    """Yield the routines of the program that the module sees."""
    kinds: dict[str, Kind] = {"PROC": "procedure", "FUNC": "function", "TRAP": "trap"}
    seen: set[str] = set()
    scope = view.task.check.scope
    for layer in (view.module.own, scope.globals, scope.installed):
        for key, symbol in layer.items():
            if isinstance(symbol, RoutineSymbol) and key not in seen:
                seen.add(key)
                insert = _call_text(symbol, tuple(symbol.parameters or ()))
                detail = headline(symbol)
                yield Item(symbol.name, kinds[symbol.kind], detail, insert, True, rank=3)


def _call_text(symbol: RoutineSymbol, parameters: tuple[Parameter, ...]) -> str:
    """Return a snippet of a call with its required arguments."""
    required: list[str] = []
    group = -1
    for parameter in parameters:
        is_new = parameter.group < 0 or parameter.group != group
        if not parameter.optional and is_new:
            required.append(f"${{{len(required) + 1}:{parameter.name}}}")
        group = parameter.group
    if symbol.kind == "FUNC":
        return f"{symbol.name}({', '.join(required)})$0"
    if symbol.kind == "TRAP":
        return symbol.name
    return f"{symbol.name} {', '.join(required)};$0" if required else f"{symbol.name};$0"


def _types(view: View) -> Iterator[Item]:
    scope = view.task.check.scope
    seen: set[str] = set()
    for layer in (view.module.own, scope.globals, scope.installed):
        for key, symbol in layer.items():
            if isinstance(symbol, TypeSymbol) and key not in seen:
                seen.add(key)
                kind: Kind = "record" if symbol.kind == "RECORD" else "type"
                yield Item(symbol.name, kind, rank=2)
    yield from _builtin_types()


@cache
def _builtin_types() -> tuple[Item, ...]:
    common = {"num", "bool", "string", "robtarget", "jointtarget", "tooldata", "wobjdata", "dnum"}
    names = sorted({*signatures.type_names(), "switch"}, key=str.casefold)
    return tuple(
        Item(name, "type", rank=3 if name in common else 5, is_builtin=True) for name in names
    )


def _first(item: Item) -> Item:
    return Item(item.label, item.kind, item.detail, rank=1, is_builtin=True)


@cache
def _builtin_values() -> tuple[tuple[Item, str], ...]:
    return tuple(
        (Item(d.name, "constant", d.type, rank=7, is_builtin=True), d.type.lower())
        for d in signatures.predefined().values()
    )


@cache
def _builtin_procedures() -> tuple[Item, ...]:
    return tuple(_builtin("PROC", "procedure"))


@cache
def _builtin_functions() -> tuple[Item, ...]:
    return tuple(_builtin("FUNC", "function"))


def _builtin(kind: str, shown: Kind) -> Iterator[Item]:
    for signature in signatures.routines().values():
        symbol = builtin(signature.name.lower())
        if signature.kind == kind and isinstance(symbol, RoutineSymbol):
            known = signature.parameters if signature.checked else ()
            insert = _call_text(symbol, known)
            detail = signatures.description(signature.name) or signature_text(signature)
            yield Item(signature.name, shown, detail, insert, True, 6, True)


def prepare() -> None:
    """Make the proposals of RAPID itself, which costs 0.2 s once."""
    _builtin_types()
    _builtin_values()
    _builtin_procedures()
    _builtin_functions()


# -- signature help ------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class SignatureHelp:
    """The header of the routine that is being called; -1: no parameter is active."""

    label: str
    parameters: tuple[tuple[int, int], ...]
    """Start and end of each parameter in the label, in code points."""
    active: int
    documentation: str


def signature_help(view: View, line: int, column: int) -> SignatureHelp | None:
    """Return the header of the innermost call at a place; None outside of calls."""
    cursor = cursor_at(view, line, column)
    call = None if cursor.is_text else open_call(view, cursor)
    if call is None:
        return None
    symbol = call.routine
    of = f"{symbol.type} " if symbol.type else ""
    label = f"{of}{symbol.name}("
    ranges = []
    for text in parameter_labels(call.parameters):
        bare = text.lstrip(" ,|")
        start = len(label) + len(text) - len(bare)
        label += text
        ranges.append((start, len(label)))
    text = signatures.description(symbol.name) if symbol.module is None else ""
    return SignatureHelp(label + ")", tuple(ranges), call.active, text)
