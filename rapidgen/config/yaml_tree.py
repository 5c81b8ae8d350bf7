"""Parse YAML 1.2 text to a tree with the place of each key and value.

The events of ruamel.yaml are read one by one, so that duplicate keys, tags, alias bombs and other
hostile input end with one finding instead of an object graph. Plain scalars follow the core schema
of YAML 1.2 (§10.3.2): `on` and `1:30` are texts, `9E9` is a number.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from rapidgen._json import Json
from rapidgen._reading import TooLarge, read_foreign
from rapidgen.diagnostics import Diagnostic, DiagnosticError, Span, error, refusal

MAX_BYTES = 1_000_000
MAX_LINES = 100_000
MAX_DEPTH = 40
MAX_NODES = 50_000

_INT = re.compile(r"[-+]?[0-9]+|0o[0-7]+|0x[0-9a-fA-F]+")
_FLOAT = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
_INF = re.compile(r"[-+]?\.(inf|Inf|INF)")
_UNREADABLE = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\ud800-\udfff\ufffe\uffff]")
"""Control characters and lone surrogates."""
_CONSTANTS: dict[str, bool | float | None] = {
    **dict.fromkeys(("", "~", "null", "Null", "NULL")),
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
    **dict.fromkeys((".nan", ".NaN", ".NAN"), float("nan")),
}


class Number(float):
    """A decimal number with its spelling: RobotWare 6.10 is not 6.1."""

    __slots__ = ("text",)
    text: str

    def __new__(cls, text: str) -> "Number":
        self = super().__new__(cls, text)
        self.text = text
        return self


@dataclass(frozen=True, slots=True)
class ScalarNode:
    """A leaf: None, bool, int, float or str."""

    value: bool | int | float | str | None
    span: Span


@dataclass(frozen=True, slots=True)
class SequenceNode:
    """A list."""

    items: tuple["Node", ...]
    span: Span


@dataclass(frozen=True, slots=True)
class MappingNode:
    """A dictionary in the order of the text; `entries[key]` = (place of the key, value)."""

    entries: dict[str, tuple[Span, "Node"]]
    span: Span


Node = ScalarNode | SequenceNode | MappingNode


def read_bytes(path: Path, displayed: str) -> bytes:
    """Return the file's bytes.

    Raises one finding (RG001, RG002).
    """
    try:
        return read_foreign(path, MAX_BYTES)
    except TooLarge:
        raise refusal(
            "RG002",
            None,
            f"{displayed} is larger than {MAX_BYTES:,} bytes",
            "a configuration is a few kilobytes: is this the right file?",
        ) from None
    except OSError as fault:
        raise refusal(
            "RG001", None, f"cannot read {displayed}: {fault.strerror}", "give the path of a file"
        ) from None


def data_of(data: bytes, displayed: str) -> Json:
    """Return plain data of YAML within the limits of a configuration.

    Raises DiagnosticError (RG002 to RG004).
    """
    root, faults = parse(decode(data, displayed), displayed)
    doubles = [fault for fault in faults if fault.code == "RG004"]
    if doubles:
        raise DiagnosticError(doubles)
    return to_python(root)


def decode(data: bytes, displayed: str) -> str:
    """Return UTF-8 text; raise one finding with its place (RG002)."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as fault:
        line = data.count(b"\n", 0, fault.start) + 1
        column = fault.start - data.rfind(b"\n", 0, fault.start)
        raise refusal(
            "RG002",
            Span(displayed, line, column),
            f"{displayed} is not UTF-8 text",
            "save the file as UTF-8",
            label=f"byte 0x{data[fault.start]:02x}",
        ) from None


_CLOSE: Final = {"{": "}", "[": "]", '"': '"', "'": "'"}


def parse(text: str, displayed: str, *, at: Span | None = None) -> tuple[Node, list[Diagnostic]]:
    """Return the tree of one YAML document and its non-fatal faults.

    Non-fatal faults are duplicate keys. `at` is the place given to everything if the text is not a
    file's (an override). Raises DiagnosticError (RG002, RG003).
    """
    from ruamel.yaml import YAML
    from ruamel.yaml.error import YAMLError

    # Lines take most time: without values there is no other limit on them.
    if text.count("\n") > MAX_LINES:
        message = f"{displayed} has more than {MAX_LINES:,} lines"
        help = "a configuration has a few hundred: is this the right file?"
        raise refusal("RG002", at or Span(displayed, 1, 1), message, help)
    try:
        return _Builder(YAML(typ="safe", pure=True).parse(text), displayed, at).document()
    except YAMLError as fault:
        raise DiagnosticError(_syntax(fault, text, displayed, at)) from None
    except (ValueError, OverflowError) as fault:  # an escape that ruamel does not check
        raise refusal("RG003", at or Span(displayed, 1, 1), f"not YAML: {fault}") from None


def _syntax(fault: Any, text: str, displayed: str, at: Span | None) -> Diagnostic:
    marker = getattr(fault, "problem_mark", None) or getattr(fault, "context_mark", None)
    problem = getattr(fault, "problem", None) or getattr(fault, "reason", None) or "not YAML"
    context = getattr(fault, "context", None)
    began = getattr(fault, "context_mark", None)
    opened = text[began.index : began.index + 1] if began else ""
    if marker and began and opened in _CLOSE and marker.line > began.line:
        return error(
            "RG003",
            at or Span(displayed, began.line + 1, began.column + 1),
            f"not YAML: `{opened}` is opened here but not closed",
            f"close it with `{_CLOSE[opened]}`, or correct line {marker.line + 1}: {problem}",
        )
    span = at or (
        Span(displayed, marker.line + 1, marker.column + 1) if marker else Span(displayed, 1, 1)
    )
    return error(
        "RG003",
        span,
        f"not YAML: {problem}" + (f" ({context})" if context else ""),
        "quote a text that holds ': ', '#', '[' or '{'; indent with blanks, never with tabs",
    )


class _Builder:
    """Converts events to nodes, with limits.

    It has its own stack: depth takes no Python frames.
    """

    def __init__(self, events: Iterator[Any], displayed: str, at: Span | None) -> None:
        self._events = events
        self._shown = displayed
        self._at = at
        self._anchors: dict[str, Node] = {}
        self._weights: dict[str, int] = {}
        self._nodes = 0
        self._found: list[Diagnostic] = []

    def document(self) -> tuple[Node, list[Diagnostic]]:
        root: Node | None = None
        for event in self._events:
            kind = type(event).__name__
            if kind == "DocumentStartEvent":
                if root is not None:
                    raise self._refuse("a second document in one file", self._span(event))
                if event.version not in (None, (1, 2), [1, 2]):
                    raise self._refuse("only YAML 1.2 is read", self._span(event))
            elif kind in ("ScalarEvent", "AliasEvent", "SequenceStartEvent", "MappingStartEvent"):
                root = self._node(event, 0)
        if root is None:
            root = ScalarNode(None, self._at or Span(self._shown, 1, 1))
        return root, self._found

    def _span(self, event: Any) -> Span:
        if self._at:
            return self._at
        start, end = event.start_mark, event.end_mark
        return Span(self._shown, start.line + 1, start.column + 1, end.line + 1, end.column + 1)

    def _refuse(self, what: str, span: Span) -> DiagnosticError:
        return refusal("RG002", span, what, "see `rapidgen explain RG002`")

    def _node(self, event: Any, depth: int) -> Node:
        span = self._span(event)
        kind = type(event).__name__
        before = self._nodes
        self._count(1, span)
        if kind == "AliasEvent":
            known = self._anchors.get(event.anchor)
            if known is None:
                raise self._refuse(f"alias '*{event.anchor}' has no anchor before it", span)
            self._count(self._weights[event.anchor], span)
            return known
        if event.tag is not None:
            raise self._refuse(f"tag '{event.tag}' is not allowed in a configuration", span)
        if depth > MAX_DEPTH:
            raise self._refuse(f"nested deeper than {MAX_DEPTH} levels", span)
        node: Node
        if kind == "ScalarEvent":
            plain = event.style in (None, "")
            self._readable(event.value, span)
            value = self._resolve(event.value, span) if plain else event.value
            node = ScalarNode(value, span)
        elif kind == "SequenceStartEvent":
            node = self._sequence(span, depth)
        else:
            node = self._mapping(span, depth)
        if event.anchor is not None:
            self._anchors[event.anchor] = node
            self._weights[event.anchor] = self._nodes - before
        return node

    def _readable(self, text: str, span: Span) -> None:
        hit = _UNREADABLE.search(text)
        if hit:
            raise self._refuse(f"the character U+{ord(hit[0]):04X} refers to nothing", span)

    def _count(self, nodes: int, span: Span) -> None:
        self._nodes += nodes
        if self._nodes > MAX_NODES:
            raise self._refuse(f"more than {MAX_NODES:,} values, aliases written out", span)

    def _resolve(self, text: str, span: Span) -> bool | int | float | str | None:
        if text in _CONSTANTS:
            return _CONSTANTS[text]
        if _INT.fullmatch(text):
            if len(text) > 20:
                raise self._refuse("a number of more than 20 digits", span)
            return int(text, 0 if text[:2] in ("0o", "0x") else 10)
        if _FLOAT.fullmatch(text):
            return Number(text)
        if _INF.fullmatch(text):
            return float(text.replace(".", ""))
        return text

    def _sequence(self, start: Span, depth: int) -> SequenceNode:
        items: list[Node] = []
        for event in self._events:
            if type(event).__name__ == "SequenceEndEvent":
                return SequenceNode(tuple(items), start)
            items.append(self._node(event, depth + 1))
        raise self._refuse("the text ends inside a list", start)

    def _mapping(self, start: Span, depth: int) -> MappingNode:
        entries: dict[str, tuple[Span, Node]] = {}
        for event in self._events:
            if type(event).__name__ == "MappingEndEvent":
                return MappingNode(entries, start)
            place = self._span(event)
            if type(event).__name__ != "ScalarEvent" or event.tag is not None:
                raise self._refuse("a key that is not a plain text", place)
            self._count(1, place)
            self._readable(event.value, place)
            following = next(self._events)
            value = self._node(following, depth + 1)
            given = type(following).__name__ != "ScalarEvent" or following.value != ""
            if not given and isinstance(value, ScalarNode) and value.value is None:
                self._found.append(_empty(event.value, place, entries))
            if event.value in entries:
                self._found.append(_duplicate(event.value, place, entries[event.value][0]))
            else:
                entries[event.value] = (place, value)
        raise self._refuse("the text ends inside a mapping", start)


def _empty(key: str, place: Span, before: dict[str, tuple[Span, Node]]) -> Diagnostic:
    last = next(reversed(before.values()))[1] if before else None
    if key.isdigit() and isinstance(last, ScalarNode) and isinstance(last.value, int | float):
        return error(
            "RG023",
            place,
            f"'{key}' is a key without a value",
            f"write a decimal point: {last.value}.{key}",
            label="after a decimal comma?",
        )
    return error(
        "RG023",
        place,
        f"'{key}' has no value",
        "give it one, or take the line out",
        label="nothing after it",
    )


def _duplicate(key: str, place: Span, first: Span) -> Diagnostic:
    from rapidgen.diagnostics import Label

    return error(
        "RG004",
        place,
        f"duplicate key '{key}'",
        "keep one of the two",
        label="second time",
        related=(Label(first, "first time"),),
    )


def from_python(value: object, span: Span) -> Node:
    """Return a tree for a Python value; every part has the place `span`."""
    if isinstance(value, dict):
        entries = {str(k): (span, from_python(v, span)) for k, v in value.items()}
        return MappingNode(entries, span)
    if isinstance(value, list | tuple):
        return SequenceNode(tuple(from_python(v, span) for v in value), span)
    if value is None or isinstance(value, bool | int | float | str):
        return ScalarNode(value, span)
    raise refusal("RG008", span, f"an override cannot be a {type(value).__name__}")


def to_python(node: Node) -> Json:
    """Return plain dicts, lists and scalars."""
    if isinstance(node, MappingNode):
        return {key: to_python(value) for key, (_, value) in node.entries.items()}
    if isinstance(node, SequenceNode):
        return [to_python(item) for item in node.items]
    return node.value


def place_of(root: Node, path: tuple[str | int, ...]) -> tuple[Span, Span]:
    """Return the places (key or item, value) at `path`, or nearest to it."""
    node, key = root, root.span
    for part in path:
        if isinstance(node, MappingNode) and part in node.entries:
            key, node = node.entries[str(part)]
        elif isinstance(node, SequenceNode) and isinstance(part, int) and part < len(node.items):
            node = node.items[part]
            key = node.span
        else:
            break
    return key, node.span if isinstance(node, ScalarNode) else key
