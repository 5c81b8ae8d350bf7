"""Requests and notifications of the protocol, each a function of the session.

`REQUESTS` and `NOTIFICATIONS` list them by method. A request returns its result; RequestFailed has
a reason for the user, KeyError and TypeError mean wrong parameters.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from typing import Final

from rapidgen._json import Json, Members, items, members, text, whole
from rapidgen.diagnostics import DiagnosticError, Edit, Fix, Severity, Span
from rapidgen.editor import (
    cfg_files,
    configuration,
    formatting,
    hover,
    navigation,
    outline,
    project_file,
    rename,
    tokens,
)
from rapidgen.editor import completion as completing
from rapidgen.editor.documents import Document, Location, TextEdit, path_of, uri_of
from rapidgen.editor.navigation import Call
from rapidgen.editor.workspace import View, Workspace
from rapidgen.lsp.conversion import (
    Client,
    Converter,
    document_path,
    position_of,
    range_json,
    range_of,
    settings_of,
)
from rapidgen.rapid.binding import RoutineSymbol, builtin


class RequestFailed(ValueError):
    """A request that cannot be fulfilled, with the reason for the user."""


@dataclass(slots=True, eq=False)
class Session:
    """What all requests of a client share."""

    workspace: Workspace
    client: Client
    tokens: dict[str, tuple[str, list[int]]] = field(default_factory=dict)
    """By path: result id and data of the last semantic tokens, for deltas."""
    messages: list[str] = field(default_factory=list)
    """Warnings that the client is to show."""
    _count: int = 0

    @property
    def convert(self) -> Converter:
        """A converter for one answer."""
        return Converter(self.workspace, self.client.units)

    def use_settings(self, data: Json) -> None:
        """Take settings of the client; programs are discovered again if they have changed."""
        before = self.workspace.settings
        self.workspace.settings = settings_of(data, before)
        if self.workspace.settings != before:
            self.workspace.reload()

    def next_id(self) -> str:
        """Return a new result id."""
        self._count += 1
        return str(self._count)


@dataclass(frozen=True, slots=True, eq=False)
class _Place:
    """A position in a document: the first task's view of it, line and column from 1."""

    view: View
    path: str
    line: int
    column: int
    convert: Converter


def _place(session: Session, params: Members) -> _Place | None:
    """Return the place that a request is about; None: the document is not RAPID, or not open."""
    path = document_path(params)
    position = position_of(params["position"])
    views = session.workspace.views(path)
    if not views:
        return None
    convert = session.convert
    return _Place(views[0], path, *convert.point(path, position), convert)


def _view(session: Session, params: Members) -> View | None:
    views = session.workspace.views(document_path(params))
    return views[0] if views else None


def _lines_in(session: Session, params: Members) -> tuple[int, int]:
    """Return first and last line (from 1) of a request's range."""
    (first, _), (last, character) = range_of(params["range"])
    return first + 1, max(first, last if character else last - 1) + 1


# -- documents -----------------------------------------------------------------------------------


def _did_open(session: Session, params: Members) -> None:
    item = members(params["textDocument"])
    document = Document(
        path_of(text(item["uri"])),
        text(item["text"]),
        whole(item.get("version") or 0),
        str(item.get("languageId") or ""),
    )
    session.workspace.open(document)


def _did_change(session: Session, params: Members) -> None:
    path = document_path(params)
    document = session.workspace.document(path)
    if document is None:
        return
    for item in items(params["contentChanges"]):
        change = members(item)
        area = range_of(change["range"]) if change.get("range") is not None else None
        document.edit(area, text(change["text"]), session.client.units)
    version = members(params["textDocument"]).get("version")
    document.version = version if isinstance(version, int) else document.version
    session.workspace.edited(path)


def _did_close(session: Session, params: Members) -> None:
    path = document_path(params)
    session.tokens.pop(path, None)
    session.workspace.close(path)


def _did_change_watched_files(session: Session, params: Members) -> None:
    """Note changes of files: a module that was there only changes, all others are read again."""
    is_new = False
    for item in items(params["changes"]):
        change = members(item)
        path = path_of(text(change["uri"]))
        if change.get("type") == 2 and session.workspace.has_module(path):
            session.workspace.file_changed(path)
        else:
            is_new = True
    if is_new:
        session.workspace.reload()


def _did_save(session: Session, params: Members) -> None:
    session.workspace.saved(path_of(text(members(params["textDocument"])["uri"])))


def _did_change_configuration(session: Session, params: Members) -> None:
    session.use_settings(params.get("settings"))


def _did_change_folders(session: Session, params: Members) -> None:
    event = members(params["event"])
    removed = {path_of(text(members(item)["uri"])) for item in items(event["removed"])}
    added = [path_of(text(members(item)["uri"])) for item in items(event["added"])]
    kept = [folder for folder in session.workspace.folders if folder not in removed]
    session.workspace.folders = (*kept, *added)
    session.workspace.reload()


# -- findings ------------------------------------------------------------------------------------


def _diagnostic(session: Session, params: Members) -> Json:
    found = session.workspace.findings_of(document_path(params))
    return {"kind": "full", "items": session.convert.diagnostics(found, session.client)}


def _code_action(session: Session, params: Members) -> Json:
    path = document_path(params)
    convert = session.convert
    area = range_of(params["range"])
    first, last = (convert.point(path, position)[0] for position in area)
    context = params.get("context")
    only = context.get("only") if isinstance(context, dict) else None
    found = session.workspace.findings_of(path)
    result: list[Json] = []
    if _wants(only, "quickfix"):
        for quick in formatting.quick_fixes(found, first, last):
            action: Members = {
                "title": quick.fix.title,
                "kind": "quickfix",
                "diagnostics": [convert.diagnostic(quick.finding, session.client)],
                "isPreferred": quick.is_only,
                "edit": _workspace_edit(session, convert, _edits_of(quick.fix)),
            }
            result.append(action)
    safe = formatting.safe_fixes(found)
    if safe and _wants(only, "source.fixAll"):
        edits = [edit for fix in safe for edit in _edits_of(fix)]
        result.append(
            {
                "title": "Apply all safe fixes",
                "kind": "source.fixAll",
                "edit": _workspace_edit(session, convert, edits),
            }
        )
    return result


def _wants(only: Json, kind: str) -> bool:
    """Return True if a client asks for a kind of actions, or for all."""
    if not isinstance(only, list):
        return True
    return any(isinstance(o, str) and (kind == o or kind.startswith(f"{o}.")) for o in only)


def _edits_of(fix: Fix) -> list[TextEdit]:
    def edit(e: Edit) -> TextEdit:
        return TextEdit(e.span.path, e.span, e.text)

    return [edit(e) for e in fix.edits]


def _text_edit(convert: Converter, edit: TextEdit) -> Members:
    return {"range": convert.range(edit.span), "newText": edit.text}


def _workspace_edit(session: Session, convert: Converter, edits: list[TextEdit]) -> Members:
    """Return edits by document, with versions if the client checks them."""
    by_path: dict[str, list[Json]] = {}
    for edit in edits:
        by_path.setdefault(edit.path, []).append(_text_edit(convert, edit))
    if not session.client.can("workspace", "workspaceEdit", "documentChanges"):
        return {"changes": {uri_of(path): changes for path, changes in by_path.items()}}
    documents: list[Json] = []
    for path, changes in by_path.items():
        document = session.workspace.document(path)
        version = document.version if document is not None else None
        identity: Members = {"uri": uri_of(path), "version": version}
        documents.append({"textDocument": identity, "edits": changes})
    return {"documentChanges": documents}


# -- names ---------------------------------------------------------------------------------------


_FILES: Final = {"yaml": configuration, "toml": project_file, "cfg": cfg_files}
"""What answers about keys, by the kind of a document."""


def _keyed(session: Session, params: Members) -> tuple[Document, str, int, int] | None:
    """Return an open document with keys, its kind, line and column of a request; None for RAPID."""
    document = session.workspace.document(document_path(params))
    if document is None:
        return None
    kind = configuration.kind_of(document.path, document.language)
    if kind not in _FILES or (kind == "yaml" and not configuration.is_configuration(document.text)):
        return None
    place = session.convert.point(document.path, position_of(params["position"]))
    return (document, kind, *place)


def _hover(session: Session, params: Members) -> Json:
    keyed = _keyed(session, params)
    if keyed is not None:
        document, kind, line, column = keyed
        match = _FILES[kind].key_at(document.text, line, column)
        if match is None:
            return None
        key, span = match
        area = document.lines.range(span, session.client.units)
        value = f"`{key.name}`\n\n{key.text}"
        return {"contents": {"kind": "markdown", "value": value}, "range": range_json(area)}
    at = _place(session, params)
    found = hover.hover(at.view, at.line, at.column) if at is not None else None
    if at is None or found is None:
        return None
    return {
        "contents": {"kind": "markdown", "value": found.text},
        "range": at.convert.range(found.span),
    }


_Finder = Callable[[Workspace, str, int, int], list[Location]]


def _locations(kind: str, find: _Finder) -> Callable[[Session, Members], Json]:
    """Return the request that finds declarations; links if the client understands them."""

    def request(session: Session, params: Members) -> Json:
        at = _place(session, params)
        if at is None:
            return None
        found = find(session.workspace, at.path, at.line, at.column)
        if session.client.can("textDocument", kind, "linkSupport"):
            return [at.convert.link(place) for place in found]
        return [at.convert.location(place) for place in found]

    return request


def _references(session: Session, params: Members) -> Json:
    at = _place(session, params)
    if at is None:
        return None
    context = params.get("context")
    declarations = isinstance(context, dict) and bool(context.get("includeDeclaration"))
    found = navigation.references(
        session.workspace, at.path, at.line, at.column, declarations=declarations
    )
    return [at.convert.location(place) for place in found]


def _document_highlight(session: Session, params: Members) -> Json:
    at = _place(session, params)
    if at is None:
        return None
    return [
        {"range": at.convert.range(mark.span), "kind": 3 if mark.is_write else 2}
        for mark in navigation.highlights(at.view, at.line, at.column)
    ]


def _prepare_rename(session: Session, params: Members) -> Json:
    at = _place(session, params)
    if at is None:
        return None
    try:
        found = rename.renamable(at.view, at.line, at.column)
    except rename.CannotRename as fault:
        raise RequestFailed(str(fault)) from fault
    if found is None:
        return None
    symbol, span = found
    return {"range": at.convert.range(span), "placeholder": symbol.name}


def _rename(session: Session, params: Members) -> Json:
    at = _place(session, params)
    if at is None:
        return None
    new = text(params["newName"])
    try:
        result = rename.rename(session.workspace, at.path, at.line, at.column, new)
    except rename.CannotRename as fault:
        raise RequestFailed(str(fault)) from fault
    if result.doubtful:
        first = result.doubtful[0]
        count = len(result.doubtful)
        session.messages.append(
            f"{count} {'string or late call' if count == 1 else 'strings or late calls'} may mean "
            f"the old name and did not change; the first is at {first.path}:{first.line}"
        )
    return _workspace_edit(session, at.convert, list(result.edits))


# -- calls ---------------------------------------------------------------------------------------


def _prepare_calls(session: Session, params: Members) -> Json:
    at = _place(session, params)
    symbol = navigation.routine_at(at.view, at.line, at.column) if at is not None else None
    if at is None or symbol is None:
        return None
    return [_call_item(at.convert, symbol)]


def _call_item(convert: Converter, symbol: RoutineSymbol) -> Members:
    place = navigation.location_of(symbol)
    assert place is not None  # routines with a node have a place
    name = symbol.module.tree.name if symbol.module is not None else ""
    return {
        "name": symbol.name,
        "kind": _SYMBOL_KINDS[symbol.kind],
        "detail": name,
        "uri": uri_of(place.path),
        "range": convert.range(place.whole or place.span),
        "selectionRange": convert.range(place.span),
    }


def _calls(
    find: Callable[[View, RoutineSymbol], list[Call]], key: str
) -> Callable[[Session, Members], Json]:
    def request(session: Session, params: Members) -> Json:
        item = members(params["item"])
        path = path_of(text(item["uri"]))
        position = range_of(item["selectionRange"])[0]
        convert = session.convert
        result: list[Json] = []
        for view in session.workspace.views(path)[:1]:
            symbol = navigation.routine_at(view, *convert.point(path, position))
            for call in find(view, symbol) if symbol is not None else ():
                ranges: list[Json] = [convert.range(span) for span in call.spans]
                result.append({key: _call_item(convert, call.symbol), "fromRanges": ranges})
        return result

    return request


# -- structure -----------------------------------------------------------------------------------


_SYMBOL_KINDS: Final = {
    "MODULE": 2, "PROC": 6, "FUNC": 12, "TRAP": 24, "RECORD": 23, "ALIAS": 26, "TYPE": 26,
    "CONST": 14, "VAR": 13, "PERS": 13, "PARAMETER": 13, "LOOP": 13, "LABEL": 20,
    "COMPONENT": 8, "INSTALLED": 19,
}  # fmt: skip
"""Kinds of the protocol: a PROC is a method, a TRAP an event, a RECORD a struct."""


def _document_symbol(session: Session, params: Members) -> Json:
    view = _view(session, params)
    if view is None:
        return _cfg_symbols(session, params)
    convert = session.convert
    is_tree = session.client.can(
        "textDocument", "documentSymbol", "hierarchicalDocumentSymbolSupport"
    )
    result: list[Json] = []

    def add(entry: outline.Entry, container: str, into: list[Json]) -> None:
        common: Members = {"name": entry.name, "kind": _SYMBOL_KINDS[entry.kind]}
        if not is_tree:
            into.append(
                {
                    **common,
                    "location": convert.location(Location(entry.span)),
                    "containerName": container,
                }
            )
            for child in entry.children:
                add(child, entry.name, into)
            return
        below: list[Json] = []
        for child in entry.children:
            add(child, entry.name, below)
        into.append(
            {
                **common,
                "detail": entry.detail[:120],
                "range": convert.range(entry.span),
                "selectionRange": convert.range(entry.name_span),
                "children": below,
            }
        )

    for entry in outline.outline(view):
        add(entry, "", result)
    return result


def _cfg_symbols(session: Session, params: Members) -> Json:
    """Return the named instances of a cfg document."""
    document = session.workspace.document(document_path(params))
    if document is None or configuration.kind_of(document.path, document.language) != "cfg":
        return None
    convert = session.convert
    return [
        {
            "name": name,
            "kind": 19,
            "containerName": section,
            "location": convert.location(Location(Span(document.path, line, 1))),
        }
        for section, name, line in cfg_files.instances(document.text)
    ]


def _workspace_symbol(session: Session, params: Members) -> Json:
    convert = session.convert
    return [
        {
            "name": found.symbol.name,
            "kind": _SYMBOL_KINDS[found.symbol.kind],
            "location": convert.location(found.location),
            "containerName": found.container,
        }
        for found in navigation.search_symbols(session.workspace, text(params["query"]))
    ]


def _folding_range(session: Session, params: Members) -> Json:
    view = _view(session, params)
    if view is None:
        return None
    result: list[Json] = []
    for fold in outline.folds(view.module.tree):
        data: Members = {"startLine": fold.first - 1, "endLine": fold.last - 1}
        if fold.kind:
            data["kind"] = fold.kind
        result.append(data)
    return result


def _selection_range(session: Session, params: Members) -> Json:
    view = _view(session, params)
    if view is None:
        return None
    convert, path = session.convert, document_path(params)
    result: list[Json] = []
    for item in items(params["positions"]):
        place = convert.point(path, position_of(item))
        nested: Json = None
        for span in reversed(outline.selections(view.module.tree, *place)):
            step: Members = {"range": convert.range(span)}
            if nested is not None:
                step["parent"] = nested
            nested = step
        empty: Members = {"range": {"start": item, "end": item}}
        result.append(nested if nested is not None else empty)
    return result


def _document_link(session: Session, params: Members) -> Json:
    view = _view(session, params)
    convert = session.convert
    if view is None:
        document = session.workspace.document(document_path(params))
        if document is None or configuration.kind_of(document.path, document.language) != "yaml":
            return None
        return [
            {"range": convert.range(span), "target": uri_of(target)}
            for span, target in configuration.links(document.path, document.text)
        ]
    return [
        {"range": convert.range(link.span), "target": uri_of(link.target)}
        for link in outline.links(view)
    ]


def _code_lens(session: Session, params: Members) -> Json:
    view = _view(session, params)
    if view is None or not session.workspace.settings.code_lenses:
        return None
    convert = session.convert
    return [
        {
            "range": convert.range(lens.span),
            "command": {
                "title": lens.title,
                "command": lens.command,
                "arguments": list[Json](lens.arguments),
            },
        }
        for lens in outline.lenses(view)
    ]


# -- tokens and hints ----------------------------------------------------------------------------


def _token_data(session: Session, view: View, lines: tuple[int, int] | None) -> list[int]:
    text_lines = session.convert.lines(view.source.path)
    units = session.client.units
    found = []
    for token in tokens.semantic_tokens(view, lines):
        start = text_lines.point(token.line, token.column, units)
        end = text_lines.point(token.line, token.column + token.length, units)
        found.append((*start, end[1] - start[1], token.kind, token.modifiers))
    return tokens.encoded(found)


def _semantic_full(session: Session, params: Members) -> Json:
    view = _view(session, params)
    if view is None:
        return None
    data = _token_data(session, view, None)
    identity = session.next_id()
    session.tokens[document_path(params)] = (identity, data)
    return {"resultId": identity, "data": list[Json](data)}


def _semantic_delta(session: Session, params: Members) -> Json:
    """Return the part of the numbers that has changed since an earlier answer."""
    path = document_path(params)
    before = session.tokens.get(path)
    if before is None or before[0] != params.get("previousResultId"):
        return _semantic_full(session, params)
    view = _view(session, params)
    if view is None:
        return None
    old, new = before[1], _token_data(session, view, None)
    head = 0
    most = min(len(old), len(new))
    while head < most and old[head] == new[head]:
        head += 1
    tail = 0
    while tail < most - head and old[-1 - tail] == new[-1 - tail]:
        tail += 1
    identity = session.next_id()
    session.tokens[path] = (identity, new)
    edits: list[Json] = []
    if head < len(old) or head < len(new):
        piece = list[Json](new[head : len(new) - tail])
        edits.append({"start": head, "deleteCount": len(old) - head - tail, "data": piece})
    return {"resultId": identity, "edits": edits}


def _semantic_range(session: Session, params: Members) -> Json:
    view = _view(session, params)
    if view is None:
        return None
    data = _token_data(session, view, _lines_in(session, params))
    return {"data": list[Json](data)}


def _inlay_hint(session: Session, params: Members) -> Json:
    view = _view(session, params)
    if view is None or not session.workspace.settings.inlay_hints:
        return None
    convert = session.convert
    result: list[Json] = []
    for hint in tokens.inlay_hints(view, _lines_in(session, params)):
        area = convert.range(hint.span)
        hint_json: Members = {
            "position": area["end" if hint.is_behind else "start"],
            "label": hint.text,
            "kind": 1 if hint.is_behind else 2,
            "paddingLeft": hint.is_behind,
            "paddingRight": False,
        }
        result.append(hint_json)
    return result


# -- formatting ----------------------------------------------------------------------------------


def _format(session: Session, params: Members, lines: tuple[int, int] | None) -> Json:
    view = _view(session, params)
    if view is None:
        return None
    convert = session.convert
    try:
        edits = formatting.format_document(view, lines)
    except DiagnosticError as fault:
        first = next(d for d in fault.diagnostics if d.severity is Severity.ERROR)
        line = first.span.line if first.span is not None else 1
        raise RequestFailed(f"line {line}: {first.message}") from fault
    return [_text_edit(convert, edit) for edit in edits]


def _formatting(session: Session, params: Members) -> Json:
    return _format(session, params, None)


def _range_formatting(session: Session, params: Members) -> Json:
    return _format(session, params, _lines_in(session, params))


def _on_type_formatting(session: Session, params: Members) -> Json:
    """Format the line that was ended, by Enter or a semicolon."""
    at = _place(session, params)
    if at is None:
        return None
    line = at.line - 1 if params.get("ch") == "\n" else at.line
    return [_text_edit(at.convert, edit) for edit in formatting.format_line(at.view, line)]


# -- completion ----------------------------------------------------------------------------------


_ITEM_KINDS: Final = {
    "keyword": 14, "snippet": 15, "procedure": 2, "function": 3, "trap": 23, "type": 25,
    "record": 22, "variable": 6, "persistent": 6, "constant": 21, "parameter": 6, "component": 5,
    "signal": 10, "label": 18, "switch": 20, "module": 9,
}  # fmt: skip


def _item(item: completing.Item, with_snippets: bool) -> Members:
    result: Members = {
        "label": item.label,
        "kind": _ITEM_KINDS[item.kind],
        "sortText": f"{item.rank}{item.label.lower()}",
    }
    if item.detail:
        result["detail"] = item.detail[:200]
    if item.insert:
        if item.is_snippet and with_snippets:
            result["insertText"] = item.insert
            result["insertTextFormat"] = 2
        elif not item.is_snippet:
            result["insertText"] = item.insert
    if item.is_builtin:
        result["data"] = item.label
    return result


@cache
def _cached_item(item: completing.Item, with_snippets: bool) -> Members:
    """Return the data of an item of RAPID itself, which are many and always the same."""
    return _item(item, with_snippets)


def _completion(session: Session, params: Members) -> Json:
    keyed = _keyed(session, params)
    if keyed is not None:
        document, kind, line, column = keyed
        keys, start = _FILES[kind].keys_at(document.text, line, column)
        # The word has signs that clients do not count to it, such as the `-` of an attribute.
        first = document.lines.point(line, start, session.client.units)
        last = document.lines.point(line, column, session.client.units)
        return [
            {
                "label": key.name,
                "kind": 10,
                "filterText": key.insert or key.name,
                "textEdit": {"range": range_json((first, last)), "newText": key.insert or key.name},
                "documentation": {"kind": "markdown", "value": key.text},
            }
            for key in keys
        ]
    at = _place(session, params)
    if at is None:
        return None
    with_snippets = session.client.can(
        "textDocument", "completion", "completionItem", "snippetSupport"
    )
    found = completing.complete(at.view, at.line, at.column)
    result: list[Json] = []
    seen: set[str] = set()
    for item in found.items:
        key = item.label.lower()
        if key not in seen:
            seen.add(key)
            make = _cached_item if item.is_builtin else _item
            result.append(make(item, with_snippets))
    return {"isIncomplete": False, "items": result}


def _resolve_completion(session: Session, params: Members) -> Json:
    """Add the description of a built-in name."""
    name = params.get("data")
    symbol = builtin(name.lower()) if isinstance(name, str) else None
    programs = session.workspace.programs
    if symbol is None or not programs:
        return params
    for view in programs[0].all_views(session.workspace):
        value = hover.describe(view, symbol)
        return {**params, "documentation": {"kind": "markdown", "value": value}}
    return params


def _signature_help(session: Session, params: Members) -> Json:
    at = _place(session, params)
    found = completing.signature_help(at.view, at.line, at.column) if at is not None else None
    if found is None:
        return None
    # Labels of built-in routines and of RAPID's names are Latin-1: one unit each, but in UTF-8.
    offsets = session.client.can(
        "textDocument", "signatureHelp", "signatureInformation", "parameterInformation",
        "labelOffsetSupport",
    )  # fmt: skip
    parameters: list[Json] = [
        {"label": [start, end] if offsets and found.label.isascii() else found.label[start:end]}
        for start, end in found.parameters
    ]
    signature: Members = {"label": found.label, "parameters": parameters}
    if found.documentation:
        signature["documentation"] = found.documentation
    active = found.active if found.active >= 0 else len(parameters)
    return {"signatures": [signature], "activeSignature": 0, "activeParameter": active}


REQUESTS: Final[dict[str, Callable[[Session, Members], Json]]] = {
    "textDocument/diagnostic": _diagnostic,
    "textDocument/codeAction": _code_action,
    "textDocument/hover": _hover,
    "textDocument/definition": _locations("definition", navigation.definitions),
    "textDocument/typeDefinition": _locations("typeDefinition", navigation.type_definitions),
    "textDocument/implementation": _locations("implementation", navigation.implementations),
    "textDocument/references": _references,
    "textDocument/documentHighlight": _document_highlight,
    "textDocument/prepareRename": _prepare_rename,
    "textDocument/rename": _rename,
    "textDocument/prepareCallHierarchy": _prepare_calls,
    "callHierarchy/incomingCalls": _calls(navigation.incoming, "from"),
    "callHierarchy/outgoingCalls": _calls(navigation.outgoing, "to"),
    "textDocument/documentSymbol": _document_symbol,
    "workspace/symbol": _workspace_symbol,
    "textDocument/foldingRange": _folding_range,
    "textDocument/selectionRange": _selection_range,
    "textDocument/documentLink": _document_link,
    "textDocument/codeLens": _code_lens,
    "textDocument/semanticTokens/full": _semantic_full,
    "textDocument/semanticTokens/full/delta": _semantic_delta,
    "textDocument/semanticTokens/range": _semantic_range,
    "textDocument/inlayHint": _inlay_hint,
    "textDocument/formatting": _formatting,
    "textDocument/rangeFormatting": _range_formatting,
    "textDocument/onTypeFormatting": _on_type_formatting,
    "textDocument/completion": _completion,
    "completionItem/resolve": _resolve_completion,
    "textDocument/signatureHelp": _signature_help,
}
NOTIFICATIONS: Final[dict[str, Callable[[Session, Members], None]]] = {
    "textDocument/didOpen": _did_open,
    "textDocument/didChange": _did_change,
    "textDocument/didClose": _did_close,
    "textDocument/didSave": _did_save,
    "workspace/didChangeWatchedFiles": _did_change_watched_files,
    "workspace/didChangeConfiguration": _did_change_configuration,
    "workspace/didChangeWorkspaceFolders": _did_change_folders,
}
