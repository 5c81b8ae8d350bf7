"""Streams of framed JSON messages: standard input and output, and TCP on loopback."""

import os
import socket
import sys
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager

from rapidgen._json import Json, Members
from rapidgen.wire.framing import MessageSplitter, encode

_PIECE = 65_536


class MessageStream:
    """A client on the other end of a stream.

    `receive(n)` returns up to n bytes, b"" at the end; `send(data)` sends all bytes. One thread
    reads; any thread may write.
    """

    def __init__(self, receive: Callable[[int], bytes], send: Callable[[bytes], None]) -> None:
        self._receive = receive
        self._send = send
        self._splitter = MessageSplitter()
        self._lock = threading.Lock()
        self.is_lost = False
        """True if the client does not read any more."""

    def read(self) -> Members | None:
        """Wait for a message and return it; None: the client has ended the stream.

        ContentError: the message is skipped, the next call reads on. FramingError: no later
        message can be read.
        """
        while (message := self._splitter.next()) is None:
            try:
                data = self._receive(_PIECE)
            except OSError:
                data = b""
            if not data:
                return None
            self._splitter.feed(data)
        return message

    def write(self, message: Mapping[str, Json]) -> None:
        """Send a message; a client that is lost gets nothing.

        ValueError: the message contains NaN or an infinity.
        """
        data = encode(message)
        with self._lock:
            if self.is_lost:
                return
            try:
                self._send(data)
            except OSError:
                self.is_lost = True


@contextmanager
def standard_stream() -> Iterator[MessageStream]:
    """Yield the stream of the process that started this one.

    Until the end stdout leads to stderr, so that no other output gets between the messages.
    """
    sys.stdout.flush()
    own = os.dup(1)
    os.dup2(2, 1)

    def send(data: bytes) -> None:
        rest = memoryview(data)
        while rest:
            rest = rest[os.write(own, rest) :]

    try:
        yield MessageStream(lambda size: os.read(0, size), send)
    finally:
        sys.stdout.flush()
        os.dup2(own, 1)
        os.close(own)


@contextmanager
def listening(port: int) -> Iterator[tuple[int, Iterator[MessageStream]]]:
    """Listen on a loopback port, 0: any free one; yield it and its clients, one after another.

    A client is disconnected when the next one is asked for. OSError: the port is not available.
    """
    with socket.create_server(("127.0.0.1", port)) as server:
        yield server.getsockname()[1], _clients(server)


def _clients(server: socket.socket) -> Iterator[MessageStream]:
    while True:
        own, _ = server.accept()
        with own:
            own.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            yield MessageStream(own.recv, own.sendall)
