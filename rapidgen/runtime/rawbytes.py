"""Containers of 0 to 1024 raw bytes, little endian by default.

Source: [manual 3HAC16581-1]. `data` contains the valid bytes only; the bytes after them count as 0.
Indexes are those of RAPID, from 1. No public source has the error of a value out of range (switch
`argument_error`). Here a number that is not whole raises ERR_INT_NOTVAL, one that is too large
ERR_ARGVALERR, and an outside index ERR_OUTOFBND.
"""

import struct

from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.values import register_type

CAPACITY = 1024

# inttypes: negative = signed, magnitude = bytes.
_INTEGERS = {1: "B", 2: "H", 4: "I", 8: "Q", -1: "b", -2: "h", -4: "i", -8: "q"}


class RawBytes:
    """A `rawbytes`."""

    __slots__ = ("data",)

    def __init__(self, data: bytes = b"") -> None:
        self.data = bytearray(data)

    def put(self, index: int, data: bytes) -> None:
        """Write bytes from `index` on; extend the valid length as needed."""
        end = index - 1 + len(data)
        if index < 1 or end > CAPACITY:
            raise RapidError("ERR_OUTOFBND", f"bytes {index} to {end} of a rawbytes")
        if index - 1 > len(self.data):
            self.data.extend(bytes(index - 1 - len(self.data)))
        self.data[index - 1 : end] = data

    def take(self, index: int, count: int) -> bytes:
        """Return `count` valid bytes from `index` on.

        ERR_OUTOFBND: beyond the valid length.
        """
        if index < 1 or index - 1 + count > len(self.data):
            raise RapidError(
                "ERR_OUTOFBND",
                f"bytes {index} to {index - 1 + count} of {len(self.data)} valid ones",
            )
        return bytes(self.data[index - 1 : index - 1 + count])


register_type("rawbytes", RawBytes)


def whole(value: float, error: str = "ERR_INT_NOTVAL") -> int:
    """Return `value` as an int, or raise the error if it is not whole."""
    number = int(value)
    if number != value:
        raise RapidError(error, f"{value:g} is not whole")
    return number


def integer_bytes(value: float, kind: float, *, network: bool) -> bytes:
    """Return the bytes of an integer of an inttype."""
    code = _code(kind)
    number = whole(value)
    try:
        return struct.pack((">" if network else "<") + code, number)
    except struct.error as error:
        raise RapidError("ERR_ARGVALERR", f"{number} does not fit the inttype") from error


def integer_from(raw: RawBytes, index: int, kind: float, *, network: bool) -> int:
    """Return the integer of an inttype at `index`."""
    code = _code(kind)
    data = raw.take(index, struct.calcsize("<" + code))
    number: int = struct.unpack((">" if network else "<") + code, data)[0]
    return number


def float_bytes(value: float, *, network: bool) -> bytes:
    """Return the bytes of an IEEE single."""
    return struct.pack(">f" if network else "<f", value)


def float_from(raw: RawBytes, index: int, *, network: bool) -> float:
    """Return the IEEE single at `index`."""
    number: float = struct.unpack(">f" if network else "<f", raw.take(index, 4))[0]
    return number


def byte_value(value: float) -> int:
    """Return a `byte`: whole, 0 to 255. ERR_ARGVALERR otherwise."""
    number = whole(value, "ERR_ARGVALERR")
    if not 0 <= number <= 255:
        raise RapidError("ERR_ARGVALERR", f"{number} is no byte")
    return number


def _code(kind: float) -> str:
    code = _INTEGERS.get(int(kind))
    if code is None:
        raise RapidError("ERR_ARGVALERR", f"{kind:g} is no inttype")
    return code
