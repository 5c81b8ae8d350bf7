"""Socket peers of a foreign program."""

import re
import struct
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Final, Protocol

from rapidgen.controller.inference.names import scoped
from rapidgen.machine.network.interface import Endpoint, Network, NetworkFault
from rapidgen.machine.network.sockets import SocketTable
from rapidgen.machine.scheduler import S, Scheduler
from rapidgen.rapid.binding import ModuleScope, RoutineScope, Scope, constant
from rapidgen.rapid.binding.expressions import declared_type, type_of
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk

if TYPE_CHECKING:
    from rapidgen.controller.inference.answers import Answer


# -- Binary messages -------------------------------------------------------------------------------
#
# Binary messages of an inferred peer: numbers that a program unpacks from received bytes and tests.
#
# `UnpackRawBytes` gives position and size of a number, a comparison its expected values. A number
# of a message in `\ReadNoOfBytes` is the length of the rest, which comes first.


_FORMATS: Final[Mapping[str, str]] = {
    **{"usint": "B", "uint": "H", "udint": "I", "ulint": "Q"},
    **{"sint": "b", "int": "h", "dint": "i", "lint": "q"},
}
"""Of \\IntX [S4 UnpackRawBytes]."""
_LONGEST: Final = 1024


@dataclass(frozen=True, slots=True)
class BinaryField:
    """A number in a message.

    It has a position (from 0), a format and tested values.
    """

    place: int
    format: str
    values: tuple[float, ...] = ()

    @property
    def end(self) -> int:
        """Position after the number."""
        return self.place + struct.calcsize(self.format)

    @property
    def other(self) -> float:
        """A value that the program does not test."""
        return max(self.values) + 1


@dataclass(frozen=True, slots=True)
class MessageFraming:
    """The structure of messages; `prefix` is the length before them.

    None: messages have no length.
    """

    prefix: BinaryField | None = None
    length: int = 0
    parts: tuple[BinaryField, ...] = ()
    """Numbers that the program tests."""

    def messages(self) -> list[bytes]:
        """Return messages for each tested value, and an untested one.

        Other numbers have their first value. The first number, which identifies a message, is
        unknown in the last message.
        """
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
    """Return the structure of messages that programs unpack.

    `tested` are numbers compared with data, by name.
    """
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
    """Return the last part of a name, lower case.

    Example: `id` of `message.id`. Returns "" for other nodes.
    """
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
    """Iterate over lengths of raw bytes that a program compares."""
    if isinstance(node, n.Binary):
        call, size = node.left, constant(node.right, scope)
        if isinstance(call, n.FunctionCall) and call.name.lower() == "rawbyteslen":
            whose = call.arguments[0].value if call.arguments else None
            if whose is not None and isinstance(size, int | float) and 0 < size < _LONGEST:
                yield last(whose), int(size)


# -- Text fields -----------------------------------------------------------------------------------
#
# Texts of an inferred peer: fields in the order in which a routine extracts them from received
# text.
#
# `StrToVal(StrPart(message, 1, at - 1), x)` is a number; its comparisons give its values,
# comparisons of a text field its words. A field at a fixed position keeps it.


_BOUNDS: Final = frozenset(("<", ">", "<=", ">="))
_LONGEST_TEXT: Final = 80


@dataclass(frozen=True, slots=True)
class TextField:
    """A part of a text: its values, position and length.

    The position counts from 0; -1 means after the previous field. Length 0 means that of the value.
    """

    values: tuple[str, ...]
    place: int = -1
    length: int = 0


def texts(layout: Sequence[TextField], marker: str) -> Iterator[str]:
    """Iterate over texts: first values, then variants of one field."""
    first = [part.values[0] for part in layout]
    rows = [first]
    for k, part in enumerate(layout):
        rows += [[*first[:k], value, *first[k + 1 :]] for value in part.values[1:]]
    for row in rows:
        text = ""
        for part, value in zip(layout, row, strict=True):
            if part.place >= 0:
                text = text[: part.place].ljust(part.place, marker)
            elif text:
                text += "" if text.endswith(marker) else marker
            complete = (
                value.rjust(part.length, "0") if value.isdigit() else value.ljust(part.length)
            )
            text += complete[: part.length or None]
        yield text + marker


def layouts(nodes: Iterable[tuple[n.Node, Scope]]) -> Iterator[tuple[TextField, ...]]:
    """Iterate over the fields of each routine that extracts several."""
    result: dict[int, dict[str, tuple[int, int, bool]]] = {}
    compared: dict[str, dict[str, None]] = {}
    bounds: dict[str, list[float]] = {}
    became: dict[str, str] = {}
    for node, scope in nodes:
        for whom, value, is_bound in _tested(node, scope):
            if is_bound and not isinstance(value, str):
                bounds.setdefault(whom, []).append(value)
            else:
                displayed = value if isinstance(value, str) else f"{value:g}"
                compared.setdefault(whom, {})[displayed] = None
        target, source = _kept(node)
        cut = None if source is None else next(filter(_is_cut, walk(source)), None)
        if isinstance(cut, n.FunctionCall) and target is not None:
            is_text = declared_type(target, scope) == "string"
            if isinstance(scope, RoutineScope):
                row = result.setdefault(id(scope.node), {})
                row.setdefault(last(target), (*_where(cut, scope), is_text))
        elif isinstance(source, n.Name) and target is not None:
            became[source.name.casefold()] = last(target)
    for fields in result.values():
        if len(fields) > 1:
            yield tuple(
                TextField(_values(name, became, compared, bounds, is_text=is_text), place, length)
                for name, (place, length, is_text) in fields.items()
            )


def _values(
    name: str,
    became: Mapping[str, str],
    compared: Mapping[str, Mapping[str, None]],
    bounds: Mapping[str, Sequence[float]],
    *,
    is_text: bool,
) -> tuple[str, ...]:
    known = (*compared.get(name, ()), *compared.get(became.get(name, ""), ()))
    if known:
        return known
    ends = bounds.get(name, bounds.get(became.get(name, ""), ()))
    if ends:
        return (f"{round((min(ends) + max(ends)) / 2)}",)
    return ("x",) if is_text and name not in became else ("1",)


def _tested(node: n.Node, scope: Scope) -> Iterator[tuple[str, str | float, bool]]:
    """Iterate over names and compared values.

    The flag is True for a comparison that only limits the value.
    """
    if isinstance(node, n.Binary) and (node.operator in _BOUNDS or node.operator in ("=", "<>")):
        rows = [(node.left, node.right), (node.right, node.left)]
    elif isinstance(node, n.Test):
        rows = [(node.subject, value) for case in node.cases for value in case.values]
    else:
        return
    for one, other in rows:
        value = constant(other, scope)
        if last(one) and isinstance(value, str | int | float) and not isinstance(value, bool):
            is_bound = isinstance(node, n.Binary) and node.operator in _BOUNDS
            yield last(one), value, is_bound


def _kept(node: n.Node) -> tuple[n.Expression | None, n.Expression | None]:
    """Return the target and source of an extracted part of a text."""
    if isinstance(node, n.Assignment) and last(node.target):
        inside = node.value
        # StrToVal returns the validity, and stores the value in an argument.
        tells = isinstance(inside, n.FunctionCall) and inside.name.lower() == "strtoval"
        return (None, None) if tells else (node.target, inside)
    if isinstance(node, n.FunctionCall) and node.name.lower() == "strtoval":
        given = [a.value for a in node.arguments]
        if len(given) > 1 and given[1] is not None and last(given[1]):
            return given[1], given[0]
    return None, None


def _is_cut(node: n.Node) -> bool:
    return isinstance(node, n.FunctionCall) and node.name.lower() == "strpart"


def _where(cut: n.FunctionCall, scope: Scope) -> tuple[int, int]:
    given = [constant(a.value, scope) if a.value is not None else None for a in cut.arguments]
    place, length = (given[1], given[2]) if len(given) > 2 else (None, None)
    if not isinstance(place, int | float) or not isinstance(length, int | float):
        return -1, 0
    is_there = 0 < place <= _LONGEST_TEXT and 0 < length <= _LONGEST_TEXT
    return (int(place) - 1, int(length)) if is_there else (-1, 0)


# -- Peers -----------------------------------------------------------------------------------------
#
# Socket peers in an inferred cell: a peer for each socket, which sends the messages that the
# program expects.
#
# The texts of a program show its expectations: words compared with a text, tested numbers, searched
# delimiters, values converted from text. Each message is sent when the program has waited for bytes
# for half a second, one after the other and each twice. After the last one the program waits
# without an answer. The peer accepts all messages of the program and ignores their content.


_THOUGHT: Final = 0.5
"""Seconds that a program waits."""
_WAYS: Final = 3
_MOST: Final = 60
_NUMBERS: Final = "1", "2", "3", "100", "0", "0", "0", "1", "0", "0"
"""Numbers after a word or a number: more than most programs read."""
_OTHERS: Final = "0", "0", *"1" * 8
_VALUES: Mapping[str, str] = {
    "num": "1",
    "dnum": "1",
    "bool": "TRUE",
    "pos": "[100,0,100]",
    "orient": "[1,0,0,0]",
    "pose": "[[100,0,100],[1,0,0,0]]",
}
_LAST: Final = re.compile("exit|quit|close|stop|end|bye", re.I)
"""Words that may end a conversation are sent last."""
_SEARCHING: Final = frozenset(("strfind", "strmatch", "strmemb"))
_COMPARING: Final = frozenset(("=", "<>"))
_NUMBER: Final = re.compile(r"-?[0-9.]+(?:e[-+]?[0-9]+)?", re.I)
_MOST_VALUES: Final = 20
"""Maximum number of values after a number."""


@dataclass(frozen=True, slots=True)
class ExpectedMessages:
    """Messages that a program expects."""

    words: tuple[str, ...] = ()
    """Texts compared with a whole message."""
    beginnings: tuple[str, ...] = ()
    """Texts compared with a part of a message."""
    numbers: tuple[int, ...] = ()
    separators: tuple[str, ...] = ()
    values: tuple[str, ...] = ()
    """Whole values in a text."""
    sized: tuple[tuple[int, int], ...] = ()
    """Numbers, and the numbers of values after each, from the comparisons in its branch."""
    start_values: Mapping[str, str] = field(default_factory=dict)
    framed: MessageFraming = field(default_factory=MessageFraming)
    """Binary messages."""
    layouts: tuple[tuple[TextField, ...], ...] = ()
    """Texts that are cut into fields."""

    def messages(self) -> list[bytes]:
        """Return messages in turn: with counted values once, others twice."""
        if self.framed.prefix is not None:
            return self.framed.messages()[:_MOST] * 2
        marks = self.separators or (" ",)
        tail = "".join(self.separators)
        counted, with_more = [], []
        for code, count in self.sized:
            for marker in marks[:_WAYS]:
                end = "".join(one for one in self.separators if one != marker)
                for after in dict.fromkeys(self._values_after(count)):
                    counted.append(marker.join((str(code), *after)) + marker + end)
        sized = {code for code, _ in self.sized}
        others = [str(number) for number in self.numbers if number not in sized]
        others += [str(max(self.numbers) + 1)] if self.numbers else []
        for first in (*others, *self.beginnings):
            with_more += [
                marker.join((first, *_NUMBERS)) + marker + tail for marker in marks[:_WAYS]
            ]
        cut = [
            t for layout in self.layouts for marker in marks[:_WAYS] for t in texts(layout, marker)
        ]
        complete = (*map(str, self.numbers), *self.words)
        with_more += sorted(complete, key=lambda word: _LAST.search(word) is not None)
        message = [text.encode("latin-1", "replace") for text in (*cut, *self.values, *with_more)]
        message += [
            number.to_bytes(4, "little") + bytes(8) for number in self.numbers if number >= 0
        ]
        return [text.encode("latin-1", "replace") for text in counted] + (
            message[:_MOST] or [b"1"]
        ) * 2

    def _values_after(self, count: int) -> Iterator[tuple[str, ...]]:
        """Iterate over sequences of numbers of a given length.

        A position, a rotation, axes or a target are those of the robot's start; other lengths have
        no known meaning.
        """
        kind = {3: "pos", 4: "orient", 6: "jointtarget", 7: "robtarget"}.get(count, "")
        known = _NUMBER.findall({**_VALUES, **self.start_values}.get(kind, ""))
        report = tuple(f"{float(number):g}" for number in known)
        for numbers in (_NUMBERS, _OTHERS):
            yield (*report, *numbers, *"0" * count)[:count]


def expected_messages(
    modules: Iterable[ModuleScope], frames: Mapping[str, str]
) -> ExpectedMessages:
    """Return the messages that the modules of all tasks expect.

    `start_values` are values of targets.
    """
    known = {**_VALUES, **frames}
    nodes = [result for module in modules for result in scoped(module)]
    received = {name for node, _ in nodes for name in _received(node)}
    received |= {
        last(node.target)
        for node, _ in nodes
        if isinstance(node, n.Assignment) and last(node.value) in received
    }
    words, parts = dict[str, None](), dict[str, None]()
    marks, values, numbers = dict[str, None](), dict[str, None](), dict[int, None]()
    sized = dict[tuple[int, int], None]()
    tested: dict[str, list[float]] = {}
    for node, scope in nodes:
        for whom, one in _compared(node, scope):
            if isinstance(one, str) and one:
                complete = isinstance(whom, n.Name) and whom.name.casefold() in received
                marker = len(one) == 1 and not one.isalnum()
                (words if complete else marks if marker else parts)[one] = None
            elif isinstance(one, int) and not isinstance(one, bool):
                numbers[one] = None
                tested.setdefault(last(whom), []).append(one)
        sized.update(dict.fromkeys(_sized(node, scope)))
        if isinstance(node, n.FunctionCall):
            given = [a.value for a in node.arguments if a.value is not None]
            result = constant(given[-1], scope) if given else None
            if node.name.lower() in _SEARCHING and isinstance(result, str):
                marks.update(dict.fromkeys(result))
            elif node.name.lower() == "strtoval" and len(given) > 1:
                kind = declared_type(given[1], scope) or ""
                if kind in known:
                    values[known[kind]] = None
    expected = tuple(words), tuple(parts), tuple(numbers), tuple(marks), tuple(values)
    binary = framed(nodes, tested)
    return ExpectedMessages(*expected, tuple(sized), frames, binary, tuple(layouts(nodes)))


def _received(node: n.Node) -> Iterator[str]:
    """Iterate over texts that a node receives into."""
    if isinstance(node, n.ProcedureCall) and node.name.lower() == "socketreceive":
        for argument in node.arguments:
            if (argument.name or "").lower() == "str" and isinstance(argument.value, n.Name):
                yield argument.value.name.casefold()


def _compared(node: n.Node, scope: Scope) -> Iterator[tuple[n.Expression, object]]:
    """Iterate over compared texts and numbers with their constants."""
    if isinstance(node, n.Binary) and node.operator in _COMPARING:
        for one, other in ((node.left, node.right), (node.right, node.left)):
            asks = isinstance(one, n.FunctionCall) and one.name.lower() == "socketgetstatus"
            if asks or last(one) == "errno" or constant(one, scope) is not None:
                continue
            if type_of(one, scope) in ("string", "num", "byte"):
                yield one, constant(other, scope)
    elif isinstance(node, n.Test) and last(node.subject) != "errno":
        for case in node.cases:
            yield from ((node.subject, constant(value, scope)) for value in case.values)


def _sized(node: n.Node, scope: Scope) -> Iterator[tuple[int, int]]:
    """Iterate over numbers of a branch with the numbers compared in it."""
    match node:
        case n.Test():
            ways = [(case.values, case.body) for case in node.cases]
            subject = node.subject
        case n.Branch() if isinstance(node.condition, n.Binary) and node.condition.operator == "=":
            ways, subject = [([node.condition.right], node.body)], node.condition.left
        case _:
            return
    if not isinstance(subject, n.Name):
        return
    for values, body in ways:
        inside = (one for statement in body for one in walk(statement))
        counts = {
            count: None
            for one in inside
            for what, count in _compared(one, scope)
            if isinstance(what, n.Name) and what.name.casefold() != subject.name.casefold()
        }
        for code in (constant(value, scope) for value in values):
            if isinstance(code, int | float) and code == int(code):
                yield from (
                    (int(code), int(count))
                    for count in counts
                    if isinstance(count, int | float) and 0 <= count <= _MOST_VALUES
                )


class HasSockets(Protocol):
    """A controller whose programs use sockets."""

    network: Network
    sockets: SocketTable
    scheduler: Scheduler


class SocketPeer:
    """A peer that connects, listens and sends as the program expects."""

    def __init__(
        self, controller: HasSockets, what: ExpectedMessages, message: "list[Answer]"
    ) -> None:
        self._network = controller.network
        self._scheduler = controller.scheduler
        self._answers = message
        self._left = what.messages()
        self._is_cut = what.framed.prefix is None
        self._ends: dict[Endpoint, None] = {}
        self._asked: set[Endpoint] = set()
        controller.sockets.on_awaited = self._awaited

    def _awaited(self, endpoint: Endpoint | None, port: int, count: int) -> None:
        if not self._left:
            return
        if endpoint is None:
            self._serve(port)
        elif endpoint not in self._asked:
            self._asked.add(endpoint)
            wait = round(_THOUGHT * S)
            self._scheduler.after(wait, partial(self._come, endpoint, count))

    def _serve(self, port: int) -> None:
        if port in self._network.listeners:
            return
        try:
            listener = self._network.bind("", port)
        except NetworkFault:
            return
        self._network.listen(listener)
        listener.changed.add(partial(self._accept, listener))

    def _accept(self, listener: Endpoint) -> None:
        came = None if listener.closed else self._network.accept(listener)
        if came is not None:
            self._ends[came] = None

    def _come(self, endpoint: Endpoint, count: int) -> None:
        self._asked.discard(endpoint)
        if endpoint.closed or not self._left:
            return
        if endpoint.peer is None:
            self._ends[self._network.connect("127.0.0.1", endpoint.local[1])] = None
            return
        # Of a port that was listened at before, older ends may still be open.
        ends = sorted(self._ends, key=lambda end: end.local != endpoint.peer)
        same = (e for e in ends if e.local == endpoint.peer or e.peer == endpoint.local)
        mine = next((end for end in same if not end.closed), None)
        if mine is None or not mine.connected or mine.fault is not None:
            return
        message = self._left.pop(0)
        if count and self._is_cut:
            message = message.ljust(count, b"0" if message[-1:].isdigit() else b"\0")[:count]
        self._network.receive(mine, 1 << 16)
        self._network.send(mine, message)
        displayed = message.decode("latin-1")
        self._answers.append(
            ("SocketReceive", displayed if displayed.isprintable() else message.hex(" "))
        )
