"""Connection of one viewer: frames, made once for all, go to its socket.

Ten pages should cost a simulation hardly more than one, so the usual case, a page that has read
everything, is one system call. The transport does the rest.
"""

import asyncio
import struct
from dataclasses import dataclass, field
from socket import socket as Socket
from typing import Final

UNREAD: Final = 8_388_608
"""Bytes that may wait for a page that does not read.

Passing messages are dropped at once.
"""


@dataclass(eq=False, slots=True)
class PageConnection:
    """A page. It belongs to the thread of the server's loop."""

    transport: asyncio.Transport
    knows: bool = False
    """True once it has the complete state, so that changes apply."""
    _socket: Socket = field(init=False, repr=False)
    """A separate handle.

    After the transport has closed its own, that number may belong to another connection.
    """

    def __post_init__(self) -> None:
        self._socket = self.transport.get_extra_info("socket").dup()

    def send(self, frame: bytes, *, passing: bool = False) -> None:
        """Send a message; a slow page misses passing ones, then is disconnected."""
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
            # The page has disconnected: the transport notices it and ends the connection.
            return
        if sent < len(frame):
            self.transport.write(frame[sent:])

    def close(self) -> None:
        """Close the handle: the connection is closed when both are."""
        self._socket.close()


def text_frame(data: bytes) -> bytes:
    """Return a text message in one frame of a server (RFC 6455, 5.2)."""
    length = len(data)
    if length < 126:
        head = struct.pack("!BB", 0x81, length)
    elif length < 65_536:
        head = struct.pack("!BBH", 0x81, 126, length)
    else:
        head = struct.pack("!BBQ", 0x81, 127, length)
    return head + data
