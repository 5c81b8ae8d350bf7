"""Frames: split a byte stream into messages, however TCP divides it.

`length:int32` (bytes that follow), `msg_type`, `comm_type`, `reply_code` (int32 each), data; little
endian.
"""

from struct import Struct
from typing import NamedTuple

from rapidgen.wire.simple_message import spec

_HEAD = Struct("<4i")
_HEAD_BYTES = spec.PREFIX_BYTES + spec.HEADER_BYTES
_PREFIX = Struct("<i")
# Every message passes here: look-ups are done once in advance.
_PREFIX_BYTES = spec.PREFIX_BYTES
_MIN_LENGTH = spec.MIN_LENGTH


class WireError(ValueError):
    """Bytes that violate the protocol."""


class FramingError(WireError):
    """A length outside its bounds.

    No later bytes can be trusted; the link must be dropped.
    """


class ContentError(WireError):
    """The data of one frame does not fit its type; later frames are valid."""


class Frame(NamedTuple):
    """One frame: the header's three numbers and the data."""

    number: int
    comm: int
    reply: int
    data: bytes

    def to_bytes(self) -> bytes:
        """Return the frame with its length, as on the wire."""
        length = spec.HEADER_BYTES + len(self.data)
        return _HEAD.pack(length, self.number, self.comm, self.reply) + self.data


_new_frame = tuple.__new__


class FrameSplitter:
    """Splits received bytes into frames; holds at most one incomplete frame.

    Call `feed` with received bytes, then `next` until it returns None.
    """

    def __init__(self, *, max_length: int = spec.MAX_LENGTH) -> None:
        self._max_length = max_length
        self._buffer = b""
        self._at = 0
        self._broken = ""

    @property
    def pending(self) -> int:
        """Return the bytes of the incomplete frame."""
        return len(self._buffer) - self._at

    def feed(self, data: bytes) -> None:
        """Add received bytes."""
        remaining = self._buffer[self._at :]
        self._buffer = remaining + data if remaining else data
        self._at = 0

    def next(self) -> Frame | None:
        """Return the next complete frame, or None.

        Raises FramingError at a length below a header or above the largest message, and again on
        each later call.
        """
        if self._broken:
            raise FramingError(self._broken)
        buffer, at = self._buffer, self._at
        available = len(buffer) - at
        if available < _PREFIX_BYTES:
            return None
        # A wrong length is known from its first four bytes, without waiting for the rest.
        (length,) = _PREFIX.unpack_from(buffer, at)
        if not _MIN_LENGTH <= length <= self._max_length:
            self._broken = f"length field is {length}, must be {_MIN_LENGTH} to {self._max_length}"
            raise FramingError(self._broken)
        if available < _PREFIX_BYTES + length:
            return None
        _, number, comm, reply = _HEAD.unpack_from(buffer, at)
        self._at = end = at + _PREFIX_BYTES + length
        return _new_frame(Frame, (number, comm, reply, buffer[at + _HEAD_BYTES : end]))
