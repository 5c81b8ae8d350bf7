"""Frames of language servers and debug adapters: JSON objects behind a `Content-Length` header.

Both protocols send `Content-Length: N`, an empty line and N bytes of UTF-8 JSON. A stream whose
frames cannot be found any more ends with `FramingError`; a frame with wrong content is skipped with
`ContentError`, and the next one is read. Headers other than the two of the protocol are refused, so
that no web page can send commands in the body of an HTTP request.
"""

import json
import math
from collections.abc import Mapping

from rapidgen._json import Json, Members

MAX_HEADER = 1024
"""Bytes of a header."""
MAX_MESSAGE = 64 * 1024 * 1024
"""Bytes of a message: a module of 10 MB in one line, with its escapes, fits."""
MAX_DEPTH = 64
"""Levels of arrays and objects; the protocols need about 12."""
_END = b"\r\n\r\n"


class FramingError(ValueError):
    """A header that violates the protocol; no later byte can be interpreted."""


class ContentError(ValueError):
    """A message that is not a JSON object within limits; the next message is valid."""


def encode(message: Mapping[str, Json]) -> bytes:
    """Return a message with its header.

    ValueError: it contains NaN or an infinity.
    """
    # ASCII, because a text may contain half of a surrogate pair, which UTF-8 cannot encode.
    data = json.dumps(message, allow_nan=False, separators=(",", ":")).encode("ascii")
    return b"Content-Length: %d\r\n\r\n%b" % (len(data), data)


class MessageSplitter:
    """Splits received bytes into messages, however they are divided.

    Call `feed` with received bytes, then `next` until it returns None.
    """

    def __init__(self, *, max_message: int = MAX_MESSAGE) -> None:
        self._max = max_message
        self._buffer = bytearray()
        self._length = -1
        """Bytes of the message whose header was read; -1: the header comes next."""
        self._broken = ""

    @property
    def pending(self) -> int:
        """Return the bytes of the incomplete message."""
        return len(self._buffer)

    def feed(self, data: bytes) -> None:
        """Add received bytes."""
        if not self._broken:
            self._buffer += data

    def next(self) -> Members | None:
        """Return the next complete message, or None.

        Raises ContentError for a message that is skipped, and FramingError, which repeats on each
        later call.
        """
        if self._broken:
            raise FramingError(self._broken)
        try:
            if self._length < 0 and not self._read_header():
                return None
        except FramingError as error:
            self._broken = str(error)
            self._buffer.clear()
            raise
        if len(self._buffer) < self._length:
            return None
        data = bytes(self._buffer[: self._length])
        del self._buffer[: self._length]
        self._length = -1
        return decode(data)

    def _read_header(self) -> bool:
        end = self._buffer.find(_END, 0, MAX_HEADER)
        if end < 0:
            if len(self._buffer) >= MAX_HEADER:
                raise FramingError(f"no end of a header in {MAX_HEADER} bytes")
            _check_names(bytes(self._buffer))
            return False
        self._length = _length(bytes(self._buffer[:end]), self._max)
        del self._buffer[: end + len(_END)]
        return True


def _check_names(part: bytes) -> None:
    """Raise FramingError as soon as an incomplete header is known to be wrong."""
    for line in part.split(b"\r\n")[:-1]:
        _field(line)


def _field(line: bytes) -> tuple[bytes, bytes]:
    name, colon, value = line.partition(b":")
    if not colon or name.lower() not in (b"content-length", b"content-type"):
        raise FramingError(f"not a header of this protocol: {line[:60]!r}")
    return name.lower(), value.strip(b" \t")


def _length(header: bytes, largest: int) -> int:
    lengths = [v for k, v in map(_field, header.split(b"\r\n")) if k == b"content-length"]
    if len(lengths) != 1:
        raise FramingError(f"{len(lengths)} fields Content-Length in a header")
    text = lengths[0]
    # `isdigit` of bytes accepts ASCII digits only; the length bounds the work of `int`.
    if not text.isdigit() or len(text) > 20:
        raise FramingError(f"not a length: {text[:60]!r}")
    if int(text) > largest:
        raise FramingError(f"a message of {int(text)} bytes; at most {largest} are accepted")
    return int(text)


def decode(data: bytes) -> Members:
    """Return the object of a message's bytes. Raises ContentError."""
    try:
        message = json.loads(data.decode("utf-8"), parse_float=_finite, parse_constant=_finite)
    except RecursionError:
        raise ContentError(_TOO_DEEP) from None
    except ValueError as error:
        raise ContentError(f"not JSON: {error}") from error
    if not isinstance(message, dict):
        raise ContentError("a message is a JSON object")
    # Most messages have fewer brackets than levels that are accepted: nothing to measure.
    if data.count(b"{") + data.count(b"[") > MAX_DEPTH:
        _check_depth(message)
    return message


_TOO_DEEP = f"more than {MAX_DEPTH} levels of arrays and objects"


def _check_depth(message: Json) -> None:
    level: list[Json] = [message]
    for _ in range(MAX_DEPTH):
        level = [
            item
            for value in level
            if isinstance(value, list | dict)
            for item in (value.values() if isinstance(value, dict) else value)
        ]
        if not level:
            return
    if any(isinstance(value, list | dict) for value in level):
        raise ContentError(_TOO_DEEP)


def _finite(text: str) -> float:
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(f"{text} is not a number")
    return value
