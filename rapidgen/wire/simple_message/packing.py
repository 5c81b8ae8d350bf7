"""Pack the fields of a declaration as bytes, and unpack them.

This module knows no message.
"""

from collections.abc import Sequence
from struct import Struct
from struct import error as StructError

from rapidgen.wire.simple_message.declaration import ANY, Field, Value, Wire
from rapidgen.wire.simple_message.frames import ContentError
from rapidgen.wire.simple_message.spec import FIXED_LIMIT, FIXED_SCALE

_CODES = {Wire.INT32: "i", Wire.FLOAT32: "f", Wire.CHAR: "s", Wire.FIXED: "i"}


def steps_of(value: float) -> int:
    """Return a FIXED as the number of the wire.

    Raises ContentError beyond FIXED_LIMIT, and for NaN.
    """
    if not -FIXED_LIMIT <= value <= FIXED_LIMIT:
        raise ContentError(f"{value} does not fit: at most {FIXED_LIMIT} in magnitude")
    return round(value * FIXED_SCALE)


class Packing:
    """Packs and unpacks the values of fixed-count fields, in order."""

    def __init__(self, fields: Sequence[Field]) -> None:
        self.fields = tuple(fields)
        codes = (f"{f.count}{_CODES[f.type]}" for f in self.fields)
        self._struct = Struct("<" + "".join(codes))
        self.size = self._struct.size
        self._places = self._find_places()
        """First and last place of each field among the unpacked values; end 0: text, -1: one."""
        self._is_flat = all(end < 0 for _, end in self._places)

    def _find_places(self) -> tuple[tuple[int, int], ...]:
        places = []
        at = 0
        for field in self.fields:
            if field.type is Wire.CHAR:
                places.append((at, 0))
                at += 1
            else:
                places.append((at, -1 if field.count == 1 else at + field.count))
                at += field.count
        return tuple(places)

    def pack(self, values: Sequence[Value]) -> bytes:
        """Return the values as bytes.

        Raises ContentError when one does not fit its field.
        """
        flat: list[object] = []
        for field, value in zip(self.fields, values, strict=True):
            if field.type is Wire.CHAR:
                flat.append(_text_bytes(field, value))
            elif field.count == 1:
                flat.append(value)
            else:
                flat.extend(_numbers(field, value))
        try:
            return self._struct.pack(*flat)
        except (StructError, OverflowError) as error:
            raise ContentError(f"{self._names()}: {error}") from error

    def unpack(self, data: bytes, at: int = 0) -> tuple[Value, ...]:
        """Return the values in `data` from byte `at` on.

        The caller has checked the length.
        """
        flat = self._struct.unpack_from(data, at)
        if self._is_flat:
            return flat
        return tuple(
            [
                flat[start]
                if end < 0
                else flat[start:end]
                if end
                else flat[start].rstrip(b"\0").decode("latin-1")
                for start, end in self._places
            ]
        )

    def _names(self) -> str:
        return ", ".join(field.name for field in self.fields)


class OpenPacking:
    """Packs fields with one variable number of FIXEDs.

    Their number follows from the length of the data.
    """

    def __init__(self, fields: Sequence[Field]) -> None:
        (place,) = (i for i, f in enumerate(fields) if f.count == ANY)
        if fields[place].type is not Wire.FIXED:
            raise ValueError(f"{fields[place].name}: only fixed-point numbers may be of any count")
        self._name = fields[place].name
        self._place = place
        self._head = Packing(fields[:place])
        self._tail = Packing(fields[place + 1 :])
        self.size = self._head.size + self._tail.size
        """Bytes without these values."""

    def fits(self, size: int) -> bool:
        """True if data may have so many bytes."""
        return size >= self.size and (size - self.size) % Wire.FIXED.size == 0

    def pack(self, values: Sequence[Value]) -> bytes:
        """Return the values as bytes.

        Raises ContentError when one does not fit its field.
        """
        numbers = values[self._place]
        if not isinstance(numbers, tuple):
            raise ContentError(f"{self._name}: a tuple of numbers is needed")
        middle = Struct(f"<{len(numbers)}i").pack(*(steps_of(number) for number in numbers))
        tail = self._tail.pack(values[self._place + 1 :])
        return self._head.pack(values[: self._place]) + middle + tail

    def unpack(self, data: bytes) -> tuple[Value, ...]:
        """Return the values in `data`, whose length `fits`."""
        count = (len(data) - self.size) // Wire.FIXED.size
        steps = Struct(f"<{count}i").unpack_from(data, self._head.size)
        numbers = tuple(number / FIXED_SCALE for number in steps)
        tail = self._tail.unpack(data, len(data) - self._tail.size)
        return (*self._head.unpack(data), numbers, *tail)


def _numbers(field: Field, value: Value) -> Sequence[object]:
    if not isinstance(value, tuple) or len(value) != field.count:
        raise ContentError(f"{field.name}: {field.count} values are needed")
    return value


def _text_bytes(field: Field, value: Value) -> bytes:
    if not isinstance(value, str):
        raise ContentError(f"{field.name}: a text is needed")
    try:
        data = value.encode("latin-1")
    except UnicodeEncodeError as error:
        raise ContentError(f"{field.name}: {error}") from error
    if len(data) > field.count:
        raise ContentError(f"{field.name}: {len(data)} bytes, at most {field.count}")
    return data
