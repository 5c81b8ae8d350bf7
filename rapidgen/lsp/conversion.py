"""Conversion between `editor` and the objects of the language server protocol.

`Client` has what a client said about itself at its start: units of characters, and the optional
parts that it understands.
"""

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Final

from rapidgen._json import Json, Members, members, text, whole
from rapidgen.diagnostics import Diagnostic, Severity, Span, Tag
from rapidgen.editor.documents import ENCODINGS, Lines, Position, Range, Units, path_of, uri_of
from rapidgen.editor.documents import Location as Place
from rapidgen.editor.project import Settings
from rapidgen.editor.workspace import Workspace

SOURCE: Final = "rapidgen"
_SEVERITIES: Final = {Severity.ERROR: 1, Severity.WARNING: 2, Severity.INFO: 3}
_TAGS: Final = {Tag.UNNECESSARY: 1, Tag.DEPRECATED: 2}
_UNITS: Final[tuple[Units, ...]] = ("utf-32", "utf-8", "utf-16")
"""By preference: our columns are code points."""


@dataclass(slots=True, eq=False)
class Client:
    """Capabilities of a client."""

    units: Units = "utf-16"
    capabilities: Members = field(default_factory=dict)

    def can(self, *path: str) -> bool:
        """Return True if the client has a capability, named by its path.

        An object without members is one: all its members are optional.
        """
        return self.value(*path) not in (None, False)

    def value(self, *path: str) -> Json:
        """Return a value of the client's capabilities; None without it."""
        data: Json = self.capabilities
        for name in path:
            data = data.get(name) if isinstance(data, dict) else None
        return data

    @property
    def pulls(self) -> bool:
        """True if the client asks for the findings of documents that it has opened."""
        return self.can("textDocument", "diagnostic")


def client_of(capabilities: Members) -> Client:
    """Return a client; units are the first of ours that it offers, UTF-16 always works."""
    client = Client("utf-16", capabilities)
    offered = client.value("general", "positionEncodings")
    if isinstance(offered, list):
        client.units = next((unit for unit in _UNITS if unit in offered), "utf-16")
    return client


# -- parameters ----------------------------------------------------------------------------------


def settings_of(data: Json, before: Settings) -> Settings:
    """Return the settings in a client's configuration; wrong or missing ones stay as they were.

    The object may be the section itself or contain it as `rapidgen`.
    """
    if not isinstance(data, dict):
        return before
    section = data.get("rapidgen", data)
    if not isinstance(section, dict):
        return before

    def value(name: str, otherwise: Json) -> Json:
        given = section.get(name)
        return given if type(given) is type(otherwise) else otherwise

    encoding = str(value("encoding", before.encoding))
    return Settings(
        robotware=str(value("robotware", before.robotware)),
        strict=bool(value("strict", before.strict)),
        encoding=encoding if encoding in ENCODINGS else before.encoding,
        backup=str(value("backup", before.backup)),
        inlay_hints=bool(value("inlayHints", before.inlay_hints)),
        code_lenses=bool(value("codeLens", before.code_lenses)),
    )


def document_path(params: Members) -> str:
    """Return the path of the document that a request is about."""
    return path_of(text(members(params["textDocument"])["uri"]))


def position_of(data: Json) -> Position:
    """Return a position of the protocol."""
    at = members(data)
    return whole(at["line"]), whole(at["character"])


def range_of(data: Json) -> Range:
    """Return a range of the protocol."""
    area = members(data)
    return position_of(area["start"]), position_of(area["end"])


# -- results -------------------------------------------------------------------------------------


def range_json(area: Range) -> Members:
    """Return a range as data."""
    (line, character), (end_line, end) = area
    return {
        "start": {"line": line, "character": character},
        "end": {"line": end_line, "character": end},
    }


@dataclass(slots=True, eq=False)
class Converter:
    """Conversion of places, with the texts of one moment."""

    workspace: Workspace
    units: Units
    _lines: dict[str, Lines] = field(default_factory=dict)

    def lines(self, path: str) -> Lines:
        """Return the lines of a document."""
        result = self._lines.get(path)
        if result is None:
            result = self._lines[path] = self.workspace.lines_of(path)
        return result

    def point(self, path: str, position: Position) -> tuple[int, int]:
        """Return line and column (from 1, code points) of a position."""
        lines = self.lines(path)
        line, column = lines.position(lines.offset(position, self.units), "utf-32")
        return line + 1, column + 1

    def range(self, span: Span) -> Members:
        """Return a span as a range of the protocol."""
        return range_json(self.lines(span.path).range(span, self.units))

    def location(self, place: Place) -> Members:
        """Return a place with its document."""
        return {"uri": uri_of(place.path), "range": self.range(place.span)}

    def link(self, place: Place) -> Members:
        """Return a place with its whole declaration."""
        return {
            "targetUri": uri_of(place.path),
            "targetRange": self.range(place.whole or place.span),
            "targetSelectionRange": self.range(place.span),
        }

    def diagnostic(self, d: Diagnostic, client: Client) -> Members:
        """Return a finding; its help and notes follow the message."""
        span = d.span or Span("", 1, 1)
        message = "\n".join(
            [
                d.message,
                *([f"help: {d.help}"] if d.help else []),
                *(f"note: {note}" for note in d.notes),
            ]
        )
        result: Members = {
            "range": self.range(span),
            "severity": _SEVERITIES[d.severity],
            "code": d.code,
            "source": SOURCE,
            "message": message,
        }
        if d.tags:
            result["tags"] = [_TAGS[tag] for tag in d.tags]
        if d.related and client.can("textDocument", "publishDiagnostics", "relatedInformation"):
            result["relatedInformation"] = [
                {
                    "location": self.location(Place(label.span)),
                    "message": label.text or d.message,
                }
                for label in d.related
            ]
        return result

    def diagnostics(self, found: Iterable[Diagnostic], client: Client) -> list[Json]:
        """Return findings as data."""
        return [self.diagnostic(d, client) for d in found]
