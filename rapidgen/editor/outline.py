"""Structure of a module: symbols, folding, selection ranges, links and lenses."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Final, Literal

from rapidgen.diagnostics import DiagnosticError, Span
from rapidgen.editor.documents import is_file
from rapidgen.editor.hover import headline
from rapidgen.editor.workspace import View
from rapidgen.rapid.syntax.nodes import (
    Case,
    DataDeclaration,
    Declaration,
    For,
    If,
    Label,
    Module,
    Node,
    PlaceholderDeclaration,
    RecordDeclaration,
    RoutineDeclaration,
    Test,
    While,
)
from rapidgen.rapid.syntax.source import Source
from rapidgen.rapid.syntax.walk import children, walk
from rapidgen.system.paths import home_file

FoldKind = Literal["", "comment", "region"]
_COMMENT_LINES: Final = 3
"""Comment lines from which on they fold."""
_DISK: Final = re.compile(r"(?i)^(HOME|TEMP|RELEASE|DATA):")
_FILE: Final = re.compile(
    r'(?i)^"(?:(?:HOME|TEMP|DATA):)?[\w/\\. -]+\.(?:mod|modx|sys|sysx|prg|pgf|txt|cfg)"$'
)


# -- symbols -------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Entry:
    """A declaration in the outline of a document."""

    name: str
    detail: str
    kind: str
    """Kind of the symbol, such as `PROC`."""
    span: Span
    name_span: Span
    children: "tuple[Entry, ...]" = ()


def outline(view: View) -> list[Entry]:
    """Return the module with its declarations, those of routines below them.

    A module whose head is broken has none.
    """
    tree, source = view.module.tree, view.source
    if not tree.name or not source.tokens:
        return []
    last = min(tree.last, len(source.tokens) - 1)
    inner = tuple(entry for d in tree.declarations if (entry := _entry(view, d)) is not None)
    name = min(tree.first + 1, last)
    return [
        Entry(
            tree.name,
            ", ".join(tree.attributes),
            "MODULE",
            source.span(tree.first, last),
            source.span(name, name),
            inner,
        )
    ]


def _entry(view: View, d: Declaration) -> Entry | None:
    if isinstance(d, PlaceholderDeclaration) or not d.name:
        return None
    source = view.source
    last = min(d.last, len(source.tokens) - 1)
    symbol = view.module.own.get(d.name.lower())
    detail = headline(symbol) if symbol is not None and symbol.node is d else ""
    detail = detail.partition("(")[2].rpartition(")")[0] if "(" in detail else detail
    kind, token, inner = _parts(view, d, last)
    return Entry(d.name, detail, kind, source.span(d.first, last), source.span(token, token), inner)


def _parts(view: View, d: Declaration, last: int) -> tuple[str, int, tuple[Entry, ...]]:
    """Return kind, token of the name, and the parts of a declaration."""
    span = view.source.span
    if isinstance(d, RoutineDeclaration):
        inner = [
            Entry(x.name, x.type, x.kind, span(x.first, x.last), span(x.name_token, x.name_token))
            for x in d.data
        ]
        inner += [
            Entry(x.name, "", "LABEL", span(x.first, x.last), span(x.first, x.first))
            for x in walk(d)
            if isinstance(x, Label)
        ]
        return d.kind, d.name_token, tuple(inner)
    if isinstance(d, RecordDeclaration):
        parts = tuple(
            Entry(
                c.name,
                c.type,
                "COMPONENT",
                span(c.first, c.last),
                span(c.first + 1, c.first + 1),
            )
            for c in d.components
        )
        return "RECORD", d.first + 1 + bool(d.scope), parts
    if isinstance(d, DataDeclaration):
        return d.kind, d.name_token, ()
    return "ALIAS", last - 1, ()


# -- folding and selection -----------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Fold:
    """Lines (from 1) that an editor can hide behind the first one."""

    first: int
    last: int
    kind: FoldKind = ""


def folds(tree: Module) -> list[Fold]:
    """Return blocks, handlers, long comments and regions (`! region`, `! endregion`)."""
    source = tree.source
    found: dict[int, Fold] = {}
    for node in walk(tree):
        for first, last in _blocks(node):
            if last < len(source.tokens):
                top, bottom = source.line(first), source.line(last)
                if bottom > top:
                    found.setdefault(top, Fold(top, bottom))
    for fold in _comment_folds(source):
        found.setdefault(fold.first, fold)
    return [found[line] for line in sorted(found)]


def _blocks(node: Node) -> Iterator[tuple[int, int]]:
    """Yield first and last tokens of the parts of a node that fold."""
    match node:
        case RoutineDeclaration():
            yield node.first, node.last
            for handler in (node.backward, node.error, node.undo):
                if handler is not None:
                    yield handler.first, handler.last
        case RecordDeclaration() | For() | While():
            yield node.first, node.last
        case If():
            for branch in node.branches:
                yield branch.first, branch.last
            if node.otherwise:
                yield node.branches[-1].last + 1, node.otherwise[-1].last
        case Test():
            yield node.first, node.last
        case Case():
            yield node.first, node.last
        case DataDeclaration():
            yield node.first, node.last


def _comment_folds(source: Source) -> Iterator[Fold]:
    """Yield runs of comment lines and regions."""
    lines = source.text.splitlines() if len(source.lines) == 1 else _lines(source)
    run = 0
    regions: list[int] = []
    for number, line in enumerate([*lines, ""], 1):
        bare = line.strip()
        if bare.startswith("!"):
            words = bare.lstrip("! #").lower().split()
            if words[:1] == ["region"]:
                regions.append(number)
            elif words[:1] == ["endregion"] and regions:
                yield Fold(regions.pop(), number, "region")
            run += 1
            continue
        if run >= _COMMENT_LINES:
            yield Fold(number - run, number - 1, "comment")
        run = 0


def _lines(source: Source) -> list[str]:
    starts = [*source.lines, len(source.text)]
    return [source.text[a:b] for a, b in pairwise(starts)]


def selections(tree: Module, line: int, column: int) -> list[Span]:
    """Return the places around a position, from the name or token to the module."""
    source = tree.source
    if not source.tokens:
        return []
    offset = source.offset(line, column)
    ends = [start + len(token) for start, token in zip(source.starts, source.tokens, strict=True)]
    found: list[tuple[int, int]] = []
    node: Node | None = tree
    while node is not None:
        last = min(node.last, len(ends) - 1)
        if node.first <= last:
            found.append((node.first, last))
        node = next(
            (
                child
                for child in children(node)
                if child.first <= child.last < len(ends)
                and source.starts[child.first] <= offset <= ends[child.last]
            ),
            None,
        )
    for at, start in enumerate(source.starts):
        if start <= offset <= ends[at]:
            found.append((at, at))
            break
    spans = [source.span(*tokens) for tokens in dict.fromkeys(reversed(found))]
    return list(dict.fromkeys(spans))


# -- links and lenses ----------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Link:
    """A text that names a file."""

    span: Span
    target: str


def links(view: View) -> list[Link]:
    """Return strings that name an existing file, as `Load "HOME:/part.mod"` does.

    HOME: is the backup's folder of that name, else the folder of the module.
    """
    source = view.source
    if not is_file(source.path):
        return []
    homes = _homes(view)
    result = []
    for at, token in enumerate(source.tokens):
        if not token.startswith('"') or not _FILE.match(token):
            continue
        name = token[1:-1]
        bare = _DISK.sub("", name).lstrip("/\\")
        for home in homes:
            try:
                file = home_file(home, f"HOME:{bare}")
            except DiagnosticError:
                continue
            if file.is_file():
                span = source.span(at, at)
                inner = Span(
                    span.path, span.line, span.column + 1, span.end_line, span.end_column - 1
                )
                result.append(Link(inner, str(file)))
                break
    return result


def _homes(view: View) -> list[Path]:
    folder = Path(view.source.path).parent
    system = view.program.program.system
    home = system.home if system is not None else None
    return [*([home] if home is not None else []), folder]


@dataclass(frozen=True, slots=True)
class Lens:
    """A command above a declaration; its arguments are the file, the task and the routine."""

    span: Span
    title: str
    command: str
    arguments: tuple[str, ...] = field(default=())


def lenses(view: View) -> list[Lens]:
    """Return Run, Debug and Show in page above the routine in which the task starts.

    The commands are those of the client's extension: `rapidgen.run`, `rapidgen.debug` and
    `rapidgen.showInPage`, each with file, task and routine.
    """
    result: list[Lens] = []
    spec = view.task.check.spec
    entry = spec.entry.lower() if spec is not None else "main"
    for routine in view.module.tree.routines:
        if routine.kind != "PROC" or routine.parameters or not routine.name:
            continue
        span = view.source.span(routine.name_token, routine.name_token)
        arguments = (view.source.path, view.task.name, routine.name)
        if routine.name.lower() == entry:
            result.append(Lens(span, "Run", "rapidgen.run", arguments))
            result.append(Lens(span, "Debug", "rapidgen.debug", arguments))
            result.append(Lens(span, "Show in page", "rapidgen.showInPage", arguments))
    return result
