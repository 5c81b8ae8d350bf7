"""The other end of a program's sockets in a guessed cell: nobody is there, so somebody is made up
who says what the program listens for.

What that is its texts tell: words that it compares with a text, numbers that it tests, the
characters that it looks for between them, values that it makes of a text. Each is said when the
program has waited for bytes for half a second, one after the other and each twice; then nobody
answers any more, and the program waits as before. What it sends is taken and not understood.
"""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Final, Protocol

from rapidgen.controller.inference.binary_messages import MessageFraming, framed, last
from rapidgen.controller.inference.name_usage import scoped
from rapidgen.controller.inference.text_fields import TextField, layouts, texts
from rapidgen.machine.network.interface import Endpoint, Network, NetworkFault
from rapidgen.machine.network.sockets import SocketTable
from rapidgen.machine.scheduler import S, Scheduler
from rapidgen.rapid.binding import ModuleScope, Scope, constant
from rapidgen.rapid.binding.expressions import declared_type, type_of
from rapidgen.rapid.syntax import nodes as n
from rapidgen.rapid.syntax.walk import walk

if TYPE_CHECKING:
    from rapidgen.controller.inference.dialog_answers import Said

_THOUGHT: Final = 0.5
"""Seconds that a program waits."""
_WAYS: Final = 3
_MOST: Final = 60
_NUMBERS: Final = "1", "2", "3", "100", "0", "0", "0", "1", "0", "0"
"""What follows a word or a number: more values than most take."""
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
"""Words that may end a conversation are said behind the others."""
_SEARCHING: Final = frozenset(("strfind", "strmatch", "strmemb"))
_COMPARING: Final = frozenset(("=", "<>"))
_NUMBER: Final = re.compile(r"-?[0-9.]+(?:e[-+]?[0-9]+)?", re.I)
_LONGEST: Final = 20
"""Values behind a number."""


@dataclass(frozen=True, slots=True)
class ExpectedMessages:
    """What a program listens for."""

    words: tuple[str, ...] = ()
    """What a whole message is compared with."""
    beginnings: tuple[str, ...] = ()
    """What parts of one are compared with."""
    numbers: tuple[int, ...] = ()
    separators: tuple[str, ...] = ()
    values: tuple[str, ...] = ()
    """Whole values in a text."""
    sized: tuple[tuple[int, int], ...] = ()
    """Numbers, and how many values behind each: what else its own branch compares with a number."""
    stands: Mapping[str, str] = field(default_factory=dict)
    framed: MessageFraming = field(default_factory=MessageFraming)
    """Binary messages."""
    layouts: tuple[tuple[TextField, ...], ...] = ()
    """Texts that are cut into fields."""

    def messages(self) -> list[bytes]:
        """What is said, in turn: with counted values once, all else twice."""
        if self.framed.prefix is not None:
            return self.framed.messages()[:_MOST] * 2
        marks = self.separators or (" ",)
        tail = "".join(self.separators)
        counted, with_more = [], []
        for code, count in self.sized:
            for marker in marks[:_WAYS]:
                end = "".join(one for one in self.separators if one != marker)
                for after in dict.fromkeys(self._behind(count)):
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

    def _behind(self, count: int) -> Iterator[tuple[str, ...]]:
        """So many numbers: a position, a turn, axes or a target, of where the robot stands; of
        others nobody knows what they are."""
        kind = {3: "pos", 4: "orient", 6: "jointtarget", 7: "robtarget"}.get(count, "")
        known = _NUMBER.findall({**_VALUES, **self.stands}.get(kind, ""))
        report = tuple(f"{float(number):g}" for number in known)
        for numbers in (_NUMBERS, _OTHERS):
            yield (*report, *numbers, *"0" * count)[:count]


def expected_messages(
    modules: Iterable[ModuleScope], frames: Mapping[str, str]
) -> ExpectedMessages:
    """What the modules of all tasks listen for; `stands` are values of targets."""
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
    heard_of = tuple(words), tuple(parts), tuple(numbers), tuple(marks), tuple(values)
    binary = framed(nodes, tested)
    return ExpectedMessages(*heard_of, tuple(sized), frames, binary, tuple(layouts(nodes)))


def _received(node: n.Node) -> Iterator[str]:
    """Texts that a node receives into."""
    if isinstance(node, n.ProcedureCall) and node.name.lower() == "socketreceive":
        for argument in node.arguments:
            if (argument.name or "").lower() == "str" and isinstance(argument.value, n.Name):
                yield argument.value.name.casefold()


def _compared(node: n.Node, scope: Scope) -> Iterator[tuple[n.Expression, object]]:
    """What text or number is compared, and with which constant."""
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
    """Numbers that lead to a branch in which another number is compared, and what with."""
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
                    if isinstance(count, int | float) and 0 <= count <= _LONGEST
                )


class HasSockets(Protocol):
    """A controller whose programs use sockets."""

    network: Network
    sockets: SocketTable
    scheduler: Scheduler


class SocketPeer:
    """Connects where a program listens, listens where one connects, and speaks where one waits."""

    def __init__(
        self, controller: HasSockets, what: ExpectedMessages, message: "list[Said]"
    ) -> None:
        self._network = controller.network
        self._scheduler = controller.scheduler
        self._said = message
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
        self._said.append(
            ("SocketReceive", displayed if displayed.isprintable() else message.hex(" "))
        )
