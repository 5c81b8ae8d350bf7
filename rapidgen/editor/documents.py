"""Texts of an editor: addresses, positions, edits, and encodings of files that are not open.

A position of the editor counts lines from 0 and characters in code units that client and server
agree on. Lines end with LF, CRLF or CR only, which is narrower than `str.splitlines`: old 8-bit
texts have U+0085 inside of comments.
"""

import os
import re
from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import accumulate
from pathlib import Path
from types import ModuleType
from typing import Final, Literal
from urllib.parse import quote, unquote, urlsplit

from rapidgen.diagnostics import Span

Units = Literal["utf-8", "utf-16", "utf-32"]
"""Code units of a character offset in a line."""
Position = tuple[int, int]
"""Line and character, both from 0."""
Range = tuple[Position, Position]

_LINE_END: Final = re.compile(r"\r\n?|\n")
_SCHEME: Final = re.compile(r"[A-Za-z][A-Za-z0-9+.-]+:")
"""The start of an address; a single letter is a drive of Windows."""
_DRIVE: Final = re.compile(r"/[A-Za-z]:")
_ASTRAL: Final = re.compile(r"[^\u0000-\uffff]")
_NOT_ASCII: Final = re.compile(r"[^\x00-\x7f]")
ENCODINGS: Final = ("auto", "utf-8", "latin-1", "cp1252", "gbk")
"""Encodings of files that are not open; `auto` is UTF-8 if valid, else Latin-1."""


# -- addresses -----------------------------------------------------------------------------------


def path_of(uri: str, *, paths: ModuleType = os.path) -> str:
    """Return the path of a `file:` address; the address itself for another one.

    Editors write drives of Windows as `file:///c%3A/folder`, and its network folders as
    `file://server/share`. An untitled document keeps its address as its name, so that each document
    has one. `paths`: posixpath or ntpath.
    """
    parts = urlsplit(uri)
    if parts.scheme != "file":
        return uri
    path = unquote(parts.path)
    if _DRIVE.match(path):
        path = path[1:]
    if parts.netloc and parts.netloc != "localhost":
        path = f"//{parts.netloc}{path}"
    return str(paths.normpath(path)) if path else uri


def uri_of(path: str, *, paths: ModuleType = os.path) -> str:
    """Return the address of a path; an untitled document's name is its address."""
    if not is_file(path):
        return path
    text = paths.abspath(path).replace(paths.sep, "/")
    if text.startswith("//"):
        return "file:" + quote(text)
    return "file://" + quote(text if text.startswith("/") else "/" + text)


def is_file(path: str) -> bool:
    """Return True unless the name of a document is an address without a file."""
    return not _SCHEME.match(path)


# -- positions -----------------------------------------------------------------------------------


@dataclass(slots=True, eq=False)
class Lines:
    """A text with the offsets of its lines."""

    text: str
    starts: Sequence[int] = ()
    _widths: tuple[int, Units, "_Widths"] | None = None
    """Of the last line that was asked about: an answer may have many places in one long line."""

    def __post_init__(self) -> None:
        if not self.starts:
            self.starts = [0, *(end.end() for end in _LINE_END.finditer(self.text))]

    def _line(self, number: int) -> str:
        """Return a line (from 0) with its end."""
        if not 0 <= number < len(self.starts):
            return ""
        end = self.starts[number + 1] if number + 1 < len(self.starts) else len(self.text)
        return self.text[self.starts[number] : end]

    def offset(self, position: Position, units: Units) -> int:
        """Return the offset of a position.

        A character behind the end of its line means the end of the line, a line behind the last
        one the end of the text.
        """
        number, character = position
        if number < 0:
            return 0
        if number >= len(self.starts):
            return len(self.text)
        line = self._line(number).rstrip("\r\n")
        return self.starts[number] + _code_points(line, max(0, character), units)

    def position(self, offset: int, units: Units) -> Position:
        """Return the position of an offset."""
        number = max(0, bisect_right(self.starts, offset) - 1)
        return number, _units_of(self.text[self.starts[number] : offset], units)

    def range(self, span: Span, units: Units) -> Range:
        """Return the range of a span; a point marks one character."""
        start = self.point(span.line, span.column, units)
        if not span.end_line:
            return start, self.point(span.line, span.column + 1, units)
        return start, self.point(span.end_line, span.end_column, units)

    def point(self, line: int, column: int, units: Units) -> Position:
        """Return the position of a line and column from 1, in code points."""
        number = line - 1
        known = self._widths
        if known is None or known[:2] != (number, units):
            known = self._widths = (number, units, _widths(self._line(number), units))
        return max(0, number), known[2].units(max(0, column - 1))


@dataclass(frozen=True, slots=True)
class _Widths:
    """The characters of a line that have more than one unit."""

    length: int
    places: Sequence[int]
    further: Sequence[int]
    """Units beyond one a character, of all characters up to each place."""

    def units(self, characters: int) -> int:
        """Return the units of the first characters."""
        characters = min(characters, self.length)
        at = bisect_left(self.places, characters)
        return characters + (self.further[at - 1] if at else 0)


def _widths(line: str, units: Units) -> _Widths:
    if units == "utf-32" or line.isascii():
        return _Widths(len(line), (), ())
    pattern = _ASTRAL if units == "utf-16" else _NOT_ASCII
    found = [(match.start(), _units_of(match[0], units) - 1) for match in pattern.finditer(line)]
    return _Widths(len(line), [at for at, _ in found], list(accumulate(more for _, more in found)))


def _code_points(line: str, character: int, units: Units) -> int:
    """Return the code points before a number of units; half a character counts as none."""
    if units == "utf-32" or line.isascii():
        return min(character, len(line))
    if units == "utf-8":
        return len(line.encode("utf-8", "replace")[:character].decode("utf-8", "ignore"))
    data = line.encode("utf-16-le", "surrogatepass")[: 2 * character]
    return len(data.decode("utf-16-le", "ignore"))


def _units_of(text: str, units: Units) -> int:
    if units == "utf-32" or text.isascii():
        return len(text)
    if units == "utf-8":
        return len(text.encode("utf-8", "replace"))
    return len(text.encode("utf-16-le", "surrogatepass")) // 2


# -- documents -----------------------------------------------------------------------------------


@dataclass(slots=True, eq=False)
class Document:
    """A text that an editor has opened; it counts in place of the file."""

    path: str
    """The path of its file, or the address of an untitled document."""
    text: str
    version: int = 0
    language: str = "rapid"
    changes: int = 0
    """So many edits since it was opened."""
    _lines: Lines | None = None

    @property
    def lines(self) -> Lines:
        """The text with its lines."""
        if self._lines is None:
            self._lines = Lines(self.text)
        return self._lines

    def edit(self, area: Range | None, text: str, units: Units) -> None:
        """Replace a range, None: the whole text. A range with swapped ends is empty."""
        if area is None:
            self.text = text
        else:
            start = self.lines.offset(area[0], units)
            end = max(start, self.lines.offset(area[1], units))
            self.text = self.text[:start] + text + self.text[end:]
        self.changes += 1
        self._lines = None


def decode_file(data: bytes, encoding: str) -> str:
    """Return the text of a file that is not open, as the client would read it.

    A byte that the encoding does not have becomes U+FFFD, so that columns stay right.
    """
    if encoding in ("auto", ""):
        try:
            return data.decode("utf-8-sig")
        except UnicodeDecodeError:
            return data.decode("latin-1")
    if encoding == "utf-8":
        encoding = "utf-8-sig"
    return data.decode(encoding, "replace")


def probable_encoding(data: bytes) -> str:
    """Return the encoding that bytes probably have: UTF-8, GBK or Windows-1252.

    GBK: nearly all bytes above 0x7F are in pairs of the area that common Chinese characters have
    (0xB0 to 0xF7, then 0xA1 to 0xFE), and there are several of them. Text of Western languages has
    single bytes of that kind among letters.
    """
    if data.isascii():
        return "utf-8"
    try:
        data.decode("utf-8-sig")
    except UnicodeDecodeError:
        pairs = re.findall(rb"[\xb0-\xf7][\xa1-\xfe]", data)
        high = sum(byte > 0x7F for byte in data)
        is_chinese = len(pairs) >= 2 and 2 * len(pairs) >= 0.9 * high
        return "gbk" if is_chinese else "cp1252"
    return "utf-8"


def real_path(path: str) -> str:
    """Return the path with its links resolved, for comparison of files."""
    return os.path.realpath(path) if is_file(path) else path


def is_below(path: str, folder: str) -> bool:
    """Return True if a path is a folder or lies in it."""
    return Path(path).is_relative_to(folder)


@dataclass(frozen=True, slots=True)
class TextEdit:
    """A replacement in one document."""

    path: str
    span: Span
    text: str


@dataclass(frozen=True, slots=True)
class Location:
    """A place in a document, with the place of the whole declaration for definitions."""

    span: Span
    whole: Span | None = None

    @property
    def path(self) -> str:
        """The document."""
        return self.span.path


@dataclass(slots=True, eq=False)
class Cancellation:
    """A mark that a client sets on a request that it does not need any more."""

    is_set: bool = field(default=False)
