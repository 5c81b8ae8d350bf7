"""Data of a program's sockets in words, decoded by `wire`.

A listener may join in the middle of a frame, and a program may use another protocol: bytes that are
not a frame are shown as they are, and decoding starts again at the next ones.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Final

from rapidgen.machine.network.sockets import SocketChange
from rapidgen.viewer.panel_messages import SocketLogLine
from rapidgen.wire.simple_message.codec import decode
from rapidgen.wire.simple_message.declaration import Content
from rapidgen.wire.simple_message.frames import ContentError, Frame, FrameSplitter, FramingError
from rapidgen.wire.simple_message.messages import MESSAGES
from rapidgen.wire.simple_message.spec import Comm

_NAMES: Final = {message.number: message.name for message in MESSAGES}
_LONGEST: Final = 400
"""Characters of a line."""


@dataclass(frozen=True, slots=True)
class SocketPiece:
    """Bytes of a socket, or its beginning or end."""

    time: float
    change: SocketChange
    task: str
    local: str
    peer: str
    data: bytes = b""


@dataclass
class Interpreter:
    """Converts received data to lines; a frame may arrive in pieces."""

    _splitters: dict[tuple[str, str, str, SocketChange], FrameSplitter] = field(
        default_factory=dict
    )

    def lines(self, received: SocketPiece) -> Iterator[SocketLogLine]:
        """The lines that a piece completes."""
        if received.change in ("open", "close"):
            for way in ("in", "out"):
                self._splitters.pop((received.task, received.local, received.peer, way), None)
            yield _line(received, "", "connected" if received.change == "open" else "closed")
            return
        key = (received.task, received.local, received.peer, received.change)
        splitter = self._splitters.setdefault(key, FrameSplitter())
        splitter.feed(received.data)
        try:
            while (frame := splitter.next()) is not None:
                yield _framed(received, frame)
        except FramingError:
            del self._splitters[key]
            yield _line(received, "", _plain(received.data))


def _framed(received: SocketPiece, frame: Frame) -> SocketLogLine:
    name = _NAMES.get(frame.number, f"type {frame.number}")
    try:
        content = decode(frame)
    except ContentError as why:
        return _line(received, name, f"{why}: {frame.data[:40].hex(' ')}", fault=True)
    reply = "reply " if frame.comm == Comm.REPLY else ""
    return _line(received, f"{reply}{name}", _fields_text(content))


def _fields_text(content: Content) -> str:
    fields = content._asdict() if hasattr(content, "_asdict") else {}
    parts = [f"{name} {_value(value)}" for name, value in fields.items()]
    return ", ".join(parts) or type(content).__name__.lower()


def _value(value: object) -> str:
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, bytes):
        return _plain(value)
    if isinstance(value, tuple | list):
        return "[" + " ".join(map(_value, value)) + "]"
    return str(value)


def _plain(data: bytes) -> str:
    text = data.decode("latin-1")
    return text if text.isprintable() else data[: _LONGEST // 3].hex(" ")


def _line(received: SocketPiece, name: str, text: str, *, fault: bool = False) -> SocketLogLine:
    return SocketLogLine(
        time=received.time,
        way=received.change,
        task=received.task,
        local=received.local,
        peer=received.peer,
        name=name,
        text=text if len(text) <= _LONGEST else text[:_LONGEST] + "…",
        fault=fault,
    )
