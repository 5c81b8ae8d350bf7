"""One page that looks: frames go to its socket as they are, made once for all who look.

Ten pages shall cost a simulation hardly more than one, so what most often happens, that a page has
read everything, is one system call. All else is the transport's.
"""

import asyncio
import struct
from dataclasses import dataclass, field
from socket import socket as Socket
from typing import Final

UNREAD: Final = 8_388_608
"""Bytes that may wait for a page that does not read; what is passing is dropped at once."""


@dataclass(eq=False, slots=True)
class PageConnection:
    """A page. It belongs to the thread of the server's loop."""

    transport: asyncio.Transport
    knows: bool = False
    """It has been told all; news make sense to it."""
    _socket: Socket = field(init=False, repr=False)
    """A handle of its own: the transport's may be another connection's once that is closed."""

    def __post_init__(self) -> None:
        self._socket = self.transport.get_extra_info("socket").dup()

    def send(self, frame: bytes, *, passing: bool = False) -> None:
        """One more; a page that does not keep up misses what is passing, and is cut off then."""
        waiting = self.transport.get_write_buffer_size()
        if not waiting:
            self._write(frame)
        elif waiting > UNREAD:
            self.transport.abort()
        elif not passing:
            self.transport.write(frame)

    def _write(self, frame: bytes) -> None:
        try:
            sent = self._socket.send(frame)
        except BlockingIOError:
            sent = 0
        except OSError:
            # It has gone: the transport will notice by itself, and ends the connection.
            return
        if sent < len(frame):
            self.transport.write(frame[sent:])

    def close(self) -> None:
        """Give the handle back: the connection is closed when both are."""
        self._socket.close()


def text_frame(data: bytes) -> bytes:
    """A text message in one frame, as servers write them (RFC 6455, 5.2)."""
    length = len(data)
    if length < 126:
        head = struct.pack("!BB", 0x81, length)
    elif length < 65_536:
        head = struct.pack("!BBH", 0x81, 126, length)
    else:
        head = struct.pack("!BBQ", 0x81, 127, length)
    return head + data
