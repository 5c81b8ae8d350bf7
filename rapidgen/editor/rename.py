"""Rename of a symbol in all modules that name it, and the reasons against it.

A rename must not change what a program does: a new name that already means something in a module
where the symbol is visible is refused. Names in strings cannot be followed, because a program may
compute them: they are listed for the user.
"""

from dataclasses import dataclass

from rapidgen.diagnostics import Span
from rapidgen.editor.documents import TextEdit
from rapidgen.editor.navigation import Mention, mentions, name_span, same_symbols
from rapidgen.editor.workspace import View, Workspace
from rapidgen.rapid.binding import (
    ComponentSymbol,
    DataSymbol,
    LabelSymbol,
    ModuleScope,
    RoutineSymbol,
    Symbol,
)
from rapidgen.rapid.syntax.lexer import MAX_NAME, NAME, Kinds
from rapidgen.rapid.syntax.source import Source


class CannotRename(ValueError):
    """A reason against a rename, for the user."""


@dataclass(frozen=True, slots=True)
class Rename:
    """Edits of a rename, and places that may mean the symbol but are not changed."""

    edits: tuple[TextEdit, ...]
    doubtful: tuple[Span, ...]
    """Strings that are equal to the name, and computed late calls."""


def renamable(view: View, line: int, column: int) -> tuple[Symbol, Span] | None:
    """Return the symbol at a place and the place of its name, if the program declares it.

    Raises CannotRename for one that it does not declare.
    """
    token = view.names.token_at(line, column)
    if token is None:
        return None
    symbol = view.names.near(token)[token]
    if symbol.module is None:
        of = "the configuration" if symbol.kind == "INSTALLED" else "RobotWare"
        raise CannotRename(f"'{symbol.name}' is declared by {of}, not by this program")
    return symbol, name_span(view, token)


def rename(workspace: Workspace, path: str, line: int, column: int, new: str) -> Rename:
    """Return the edits of a rename. Raises CannotRename."""
    views = workspace.views(path)
    found = [(view, renamable(view, line, column)) for view in views]
    known = [(view, match[0]) for view, match in found if match is not None]
    if not known:
        raise CannotRename("there is no name of this program here")
    edits: dict[tuple[str, int, int], TextEdit] = {}
    doubtful: dict[Span, None] = {}
    for view, symbol in known:
        _check_name(new)
        all_names = mentions(view, symbol, declarations=True)
        if new.lower() != symbol.name.lower():
            _check_free(view, symbol, new, all_names)
        for mention in all_names:
            span = mention.span
            edits[(span.path, span.line, span.column)] = TextEdit(span.path, span, new)
        if isinstance(symbol, RoutineSymbol | DataSymbol) and not _is_in_routine(symbol):
            doubtful.update(dict.fromkeys(_strings(view, symbol, all_names)))
    return Rename(tuple(edits[key] for key in sorted(edits)), tuple(doubtful))


def _check_name(new: str) -> None:
    kinds = Kinds()
    if not new or kinds[new] is not NAME:
        reserved = "a reserved word" if new.upper() == kinds[new or " "] else "no name of RAPID"
        raise CannotRename(f"'{new}' is {reserved}")
    if len(new) > MAX_NAME:
        raise CannotRename(f"a name has at most {MAX_NAME} characters, not {len(new)}")


def _is_in_routine(symbol: Symbol) -> bool:
    if isinstance(symbol, LabelSymbol | ComponentSymbol):
        return True
    return isinstance(symbol, DataSymbol) and symbol.routine is not None


def _check_free(view: View, symbol: Symbol, new: str, all_names: list[Mention]) -> None:
    """Refuse a name that means something else where the symbol is visible."""
    key = new.lower()
    if isinstance(symbol, ComponentSymbol):
        record = symbol.record
        if record is not None and key in view.task.check.scope.members(record):
            raise CannotRename(f"{record.name} has a component '{new}' already")
        return
    if isinstance(symbol, DataSymbol | LabelSymbol) and _is_in_routine(symbol):
        module = symbol.module
        if module is not None:
            _check_routine(symbol, module, key, new)
        return
    for task, own in same_symbols(view, symbol):
        for path, module in task.modules.items():
            sees = module is own.module or not own.local
            if sees and key in view.program.words[path]:
                raise CannotRename(f"module {module.tree.name} uses the name '{new}' already")
        if task.check.scope.find(key) is not None and not own.local:
            raise CannotRename(f"'{new}' is declared already, or built in")
    for mention in all_names:
        if mention.view.module.find(new) is not None:
            name = mention.view.module.tree.name
            raise CannotRename(f"'{new}' has a meaning in module {name}")


def _check_routine(symbol: Symbol, module: ModuleScope, key: str, new: str) -> None:
    routines = [
        r
        for r in module.tree.routines
        if r.first <= symbol.token <= r.last or getattr(symbol, "routine", None) is r
    ]
    tokens = module.tree.source.tokens
    for routine in routines:
        words = {token.lower() for token in tokens[routine.first : routine.last + 1]}
        if key in words:
            raise CannotRename(f"the routine {routine.name} uses the name '{new}' already")


def _is_sign(source: Source, at: int) -> bool:
    """Return True if a token ends the name of a late call."""
    return at < len(source.tokens) and source.tokens[at] == "%"


def _strings(view: View, symbol: Symbol, all_names: list[Mention]) -> list[Span]:
    """Return strings with the symbol's name, and late calls whose name is computed."""
    literal = f'"{symbol.name.lower()}"'
    renamed = {(mention.view.source.path, mention.token) for mention in all_names}
    result: list[Span] = []
    for task in view.program.tasks:
        for path, module in task.modules.items():
            words = view.program.words[path]
            if literal not in words and "%" not in words:
                continue
            source = module.tree.source
            for at, token in enumerate(source.tokens):
                is_named = (source.path, at) in renamed
                if token.lower() == literal and not is_named:
                    result.append(source.span(at, at))
                elif (
                    token == "%"
                    and isinstance(symbol, RoutineSymbol)
                    and at + 1 < len(source.tokens)
                    and (at == 0 or source.tokens[at - 1] in (";", "THEN", "DO", ")", "ELSE"))
                    and not (source.tokens[at + 1].startswith('"') and _is_sign(source, at + 2))
                ):
                    result.append(source.span(at, at + 1))
    return result
