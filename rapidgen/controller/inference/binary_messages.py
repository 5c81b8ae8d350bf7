"""Binary messages of a made-up partner: what a program unpacks from received bytes, and tests.

`UnpackRawBytes` tells where a number is and how long, a comparison which ones are listened for.
What `\\ReadNoOfBytes` takes from the message itself is the length of the rest, which comes first.
"""

import struct
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Final

from rapidgen.rapid.binding import Scope, constant
from rapidgen.rapid.syntax import nodes as n

_FORMATS: Final[Mapping[str, str]] = {
    **{"usint": "B", "uint": "H", "udint": "I", "ulint": "Q"},
    **{"sint": "b", "int": "h", "dint": "i", "lint": "q"},
}
"""Of \\IntX [S4 UnpackRawBytes]."""
_LONGEST: Final = 1024


@dataclass(frozen=True, slots=True)
class BinaryField:
    """A number in a message: where it begins (from 0), its format, and what it is tested for."""

    place: int
    format: str
    values: tuple[float, ...] = ()

    @property
    def end(self) -> int:
        """Where the next may begin."""
        return self.place + struct.calcsize(self.format)

    @property
    def other(self) -> float:
        """What it is not tested for."""
        return max(self.values) + 1


@dataclass(frozen=True, slots=True)
class MessageFraming:
    """How messages are made up; `prefix` is the length before them, None: there is none."""

    prefix: BinaryField | None = None
    length: int = 0
    parts: tuple[BinaryField, ...] = ()
    """Those that the program tests."""

    def messages(self) -> list[bytes]:
        """Each value that is tested, and one that is not, beside the first ones of the others; the
        first part, which tells what a message is, is unknown at last."""
        if not self.length or not (self.parts or self.prefix):
            return []
        first = [part.values[0] for part in self.parts]
        rows = [first]
        for value in self.parts[0].values if self.parts else ():
            rows.append([value, *first[1:]])
            for k, part in enumerate(self.parts[1:], 1):
                tried = (part.other, *part.values)
                rows += [[value, *first[1:k], v, *first[k + 1 :]] for v in tried]
        rows += [[part.other, *first[1:]] for part in self.parts[:1]]
        return list(dict.fromkeys(map(self._message, rows)))

    def _message(self, values: list[float]) -> bytes:
        body = bytearray(self.length)
        for part, value in zip(self.parts, values, strict=True):
            try:
                complete = value if part.format[1] == "f" else int(value)
                struct.pack_into(part.format, body, part.place, complete)
            except struct.error:
                continue
        return (struct.pack(self.prefix.format, self.length) if self.prefix else b"") + body


def framed(
    nodes: Iterable[tuple[n.Node, Scope]], tested: Mapping[str, Iterable[float]]
) -> MessageFraming:
    """What programs unpack; `tested` are numbers that data are compared with, by name."""
    unpacked: list[tuple[str, str, int, str]] = []
    copies: list[tuple[str, str, int]] = []
    sizes: list[tuple[str, int]] = []
    lengths: set[str] = set()
    received: set[str] = set()
    for node, scope in nodes:
        if isinstance(node, n.ProcedureCall):
            given = [a.value for a in node.arguments if a.kind == "required" and a.value]
            match node.name.lower():
                case "unpackrawbytes" if len(given) > 2:
                    form, at = _format(node), constant(given[1], scope)
                    if form and isinstance(at, int | float) and 0 < at < _LONGEST:
                        unpacked.append((last(given[0]), last(given[2]), int(at) - 1, form))
                case "copyrawbytes" if len(given) > 3:
                    places = constant(given[1], scope), constant(given[3], scope)
                    if isinstance(places[0], int | float) and isinstance(places[1], int | float):
                        copies.append((last(given[0]), last(given[2]), int(places[0] - places[1])))
                case "socketreceive":
                    options = {(a.name or "").lower(): a.value for a in node.arguments}
                    count = options.get("readnoofbytes")
                    in_use = options.get("rawdata")
                    if in_use is not None:
                        received.add(last(in_use))
                        lengths.add(last(count) if count is not None else "")
        sizes += _sizes(node, scope)
    copied = {to: by for of, to, by in copies if of in received and to not in received}
    prefixes = [
        BinaryField(at, form) for _, whose, at, form in unpacked if whose and whose in lengths
    ]
    parts: dict[str, BinaryField] = {}
    for raw, whose, at, form in unpacked:
        if whose not in lengths:
            values = tuple(dict.fromkeys(tested.get(whose, ())))
            parts.setdefault(whose, BinaryField(at + copied.get(raw, 0), form, values))
    ends = [part.end for part in parts.values()]
    ends += [size + copied.get(raw, 0) for raw, size in sizes]
    ordered = sorted((part for part in parts.values() if part.values), key=lambda p: p.place)
    length = max(0, *ends) if ends else 0
    return MessageFraming(prefixes[0] if prefixes else None, length, tuple(ordered))


def last(node: n.Node) -> str:
    """The last part of a name, lower case: `id` of `message.id`; empty: it is none."""
    match node:
        case n.Name():
            return node.name.casefold()
        case n.Member():
            return node.component.casefold()
    return ""


def _format(node: n.ProcedureCall) -> str:
    options = {(a.name or "").lower(): a.value for a in node.arguments if a.name}
    order = ">" if "network" in options else "<"
    if "float4" in options:
        return f"{order}f"
    if "hex1" in options:
        return "<B"
    size = options.get("intx")
    return order + _FORMATS[last(size)] if size is not None and last(size) in _FORMATS else ""


def _sizes(node: n.Node, scope: Scope) -> Iterator[tuple[str, int]]:
    """What a program compares the length of raw bytes with."""
    if isinstance(node, n.Binary):
        call, size = node.left, constant(node.right, scope)
        if isinstance(call, n.FunctionCall) and call.name.lower() == "rawbyteslen":
            whose = call.arguments[0].value if call.arguments else None
            if whose is not None and isinstance(size, int | float) and 0 < size < _LONGEST:
                yield last(whose), int(size)
