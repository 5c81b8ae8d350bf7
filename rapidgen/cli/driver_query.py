"""Queries on a driver's state port, for `doctor` and `deploy`."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rapidgen.wire.simple_message.declaration import Content
    from rapidgen.wire.simple_message.spec import Reason


def hello(host: str, port: int, timeout: float = 3.0) -> str | None:
    """Return the BUILD_ID of the driver on a state port; None for another program.

    Raises OSError if the port does not answer.
    """
    from rapidgen.wire.simple_message.messages import HelloReply

    for content in _messages(host, port, timeout):
        if isinstance(content, HelloReply):
            return content.build_id
    return None


def error_reason(host: str, port: int, timeout: float = 3.0) -> "Reason | None":
    """Return the error in the STATUS of a rapidgen driver; None: no error or another program.

    Raises OSError if the port does not answer.
    """
    from rapidgen.wire.simple_message.messages import HelloReply, StatusReport
    from rapidgen.wire.simple_message.spec import split_error_code

    is_ours = False
    for content in _messages(host, port, timeout):
        is_ours = is_ours or isinstance(content, HelloReply)
        if is_ours and isinstance(content, StatusReport):
            return split_error_code(content.error_code)[0] if content.in_error == 1 else None
    return None


def _messages(host: str, port: int, timeout: float) -> "Iterator[Content]":
    """Yield the messages after a HELLO, until `timeout` seconds or invalid data."""
    import socket
    import time

    from rapidgen import __version__
    from rapidgen.wire.simple_message.codec import decode, encode
    from rapidgen.wire.simple_message.frames import FrameSplitter, WireError
    from rapidgen.wire.simple_message.messages import HelloRequest
    from rapidgen.wire.simple_message.spec import PROTOCOL_VERSION, Comm

    major, minor, patch = (int(part) for part in __version__.split(".")[:3])
    end = time.monotonic() + timeout
    with socket.create_connection((host, port), timeout) as connection:
        connection.sendall(
            encode(HelloRequest(PROTOCOL_VERSION, (major, minor, patch), 0), Comm.REQUEST)
        )
        splitter = FrameSplitter()
        try:
            while (left := end - time.monotonic()) > 0:
                connection.settimeout(left)
                block = connection.recv(4096)
                if not block:
                    return
                splitter.feed(block)
                while (frame := splitter.next()) is not None:
                    yield decode(frame)
        except (WireError, TimeoutError):
            return
