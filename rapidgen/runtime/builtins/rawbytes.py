"""PackRawBytes and related routines; bit functions of bytes and dnums.

Sources: [manual 3HAC16581-1] for the packing rules; abb_driver [code] for a copy out of an empty
container, motion_program_exec [code] for \\ASCII:=0.
"""

from collections.abc import Callable

from rapidgen.rapid.numbers import dnum, single
from rapidgen.runtime.errors import FatalError, RapidError
from rapidgen.runtime.rawbytes import (
    CAPACITY,
    RawBytes,
    byte_value,
    float_bytes,
    float_from,
    integer_bytes,
    integer_from,
    whole,
)
from rapidgen.runtime.registry import builtin, builtins
from rapidgen.runtime.signals import target_of, value_of
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value

DNUM_BITS = 52
_MASK = (1 << DNUM_BITS) - 1
_ULINT = 8


@builtin("PackRawBytes", cost="string")
def pack_raw_bytes(
    task: Task,
    argument: object,
    raw: RawBytes,
    network: bool | None,
    start: float,
    hex1: bool | None,
    int_type: float | None,
    float4: bool | None,
    ascii_: bool | None,
    utf8: bool | None,
) -> None:
    """Write one value into a container."""
    value, _ = value_of(argument)
    index = whole(start, "ERR_OUTOFBND")
    if index > len(raw.data) + 1 and task.controller.dialect.pack_beyond == "error":
        raise RapidError(
            "ERR_OUTOFBND", f"{index} is after a gap that follows {len(raw.data)} bytes"
        )
    if isinstance(value, str):
        if not (ascii_ or utf8) or not value:
            raise RapidError("ERR_ARGVALERR", "a string is packed with \\ASCII, and not empty")
        raw.put(index, value.encode("utf-8" if utf8 else "latin-1"))
    elif int_type is not None:
        raw.put(index, integer_bytes(value, int_type, network=bool(network)))
    elif float4:
        raw.put(index, float_bytes(value, network=bool(network)))
    elif hex1 or ascii_:
        raw.put(index, bytes([byte_value(value)]))
    else:
        raise _no_format("PackRawBytes")


@builtin("UnpackRawBytes", cost="string")
def unpack_raw_bytes(
    task: Task,
    raw: RawBytes,
    network: bool | None,
    start: float,
    argument: object,
    hex1: bool | None,
    int_type: float | None,
    float4: bool | None,
    ascii_: float | None,
    utf8: float | None,
    latin1: float | None,
) -> None:
    """Read one value out of a container."""
    value = target_of(argument)
    index = whole(start, "ERR_OUTOFBND")
    if task.controller.dialect.unpack_beyond == "zero":
        raw = RawBytes(bytes(raw.data).ljust(CAPACITY, b"\0"))
    if int_type == _ULINT:
        value.set(_unsigned_long(task, integer_from(raw, index, int_type, network=bool(network))))
    elif int_type is not None:
        value.set(integer_from(raw, index, int_type, network=bool(network)))
    elif float4:
        value.set(float_from(raw, index, network=bool(network)))
    elif hex1:
        value.set(raw.take(index, 1)[0])
    elif (
        characters := next((n for n in (ascii_, utf8, latin1) if n is not None), None)
    ) is not None:
        count = whole(characters, "ERR_ARGVALERR")
        text = value.type.kind == "string"
        # No characters: motion_program_exec reads wobj0's empty name so [code].
        if not (0 if text else 1) <= count <= 80:
            raise RapidError("ERR_ARGVALERR", f"\\ASCII:={count}")
        data = raw.take(index, count)
        known = "latin-1" if utf8 is None else "utf-8"
        value.set(data.decode(known, errors="replace") if text else data[0])
    else:
        raise _no_format("UnpackRawBytes")


def _first(*lengths: float | None) -> float | None:
    return next((length for length in lengths if length is not None), None)


def _unsigned_long(task: Task, value: int) -> float:
    match task.controller.dialect.unpack_ulint:
        case "error":
            raise RapidError("ERR_ARGVALERR", "\\IntX:=ULINT")
        case "single":
            return single(value)
    return dnum(value, int(task.controller.dialect.dnum_whole))


def _no_format(name: str) -> FatalError:
    return FatalError(
        194_659, f"{name} needs a format", "one of \\Hex1, \\IntX, \\Float4 and \\ASCII"
    )


@builtin("ClearRawBytes", cost="string")
def clear_raw_bytes(_task: Task, raw: RawBytes, from_index: float | None) -> None:
    """Clear bytes; the valid length becomes at most `from_index` - 1."""
    start = 1 if from_index is None else whole(from_index, "ERR_OUTOFBND")
    if not 1 <= start <= CAPACITY:
        raise RapidError("ERR_OUTOFBND", f"\\FromIndex:={start}")
    del raw.data[start - 1 :]


@builtin("CopyRawBytes", cost="string")
def copy_raw_bytes(
    _task: Task,
    source: RawBytes,
    from_index: float,
    target: RawBytes,
    to_index: float,
    count: float | None,
) -> None:
    """Copy valid bytes up to the end of the container.

    If no byte follows `from_index`, the instruction does nothing.
    """
    start, place = whole(from_index, "ERR_OUTOFBND"), whole(to_index, "ERR_OUTOFBND")
    if not 1 <= start <= CAPACITY or not 1 <= place <= CAPACITY:
        raise RapidError("ERR_OUTOFBND", f"from {start} to {place}")
    data = bytes(source.data[start - 1 :])
    if count is not None:
        expected = whole(count, "ERR_ARGVALERR")
        if expected < 0 or expected > len(data):
            raise RapidError("ERR_OUTOFBND", f"{expected} bytes of {len(data)}")
        data = data[:expected]
    data = data[: CAPACITY - place + 1]
    if data:
        target.put(place, data)


# -- bits -----------------------------------------------------------------------------------


def _steps(value: float, largest: int, low: int = 0) -> int:
    number = whole(value, "ERR_ARGVALERR")
    if not low <= number <= largest:
        raise RapidError("ERR_ARGVALERR", f"{number} is not within {low} to {largest}")
    return number


def _bits(value: float) -> int:
    return _steps(value, _MASK)


def _lowest(size: float | None) -> int:
    """Return the mask of \\Size bits, by default all 52."""
    return _MASK if size is None else (1 << _steps(size, DNUM_BITS, 1)) - 1


def _change(data: Ref | None, dnum: Ref | None, position: float, value: int) -> None:
    target = data if data is not None else dnum
    assert target is not None
    if dnum is None:
        bits, place = byte_value(target.get()), _steps(position, 8, 1)
    else:
        bits, place = _bits(target.get()), _steps(position, DNUM_BITS, 1)
    mask = 1 << place - 1
    target.set(bits | mask if value else bits & ~mask)


def _shifted(value: float, steps: float, size: float | None) -> int:
    mask = _lowest(size)
    return _steps(value, mask) << _steps(steps, mask.bit_length(), 1) & mask


def _is_set(bits: int, position: float, last: int) -> bool:
    return bool(bits >> _steps(position, last, 1) - 1 & 1)


_CHANGING: dict[str, Callable[..., Value]] = {
    "BitSet": lambda _, data, dnum, position: _change(data, dnum, position, 1),
    "BitClear": lambda _, data, dnum, position: _change(data, dnum, position, 0),
    "RawBytesLen": lambda _, raw: len(raw.data),
}
# Of bytes, and of the 52 bits (or the lowest \\Size) of a dnum; position 1 is the lowest bit.
_PURE: dict[str, Callable[..., Value]] = {
    "BitAnd": lambda _, one, two: byte_value(one) & byte_value(two),
    "BitAndDnum": lambda _, one, two: _bits(one) & _bits(two),
    "BitOr": lambda _, one, two: byte_value(one) | byte_value(two),
    "BitOrDnum": lambda _, one, two: _bits(one) | _bits(two),
    "BitXOr": lambda _, one, two: byte_value(one) ^ byte_value(two),
    "BitXOrDnum": lambda _, one, two: _bits(one) ^ _bits(two),
    "BitNeg": lambda _, data: byte_value(data) ^ 0xFF,
    "BitNegDnum": lambda _, data, size: _steps(data, _lowest(size)) ^ _lowest(size),
    "BitLSh": lambda _, data, steps: byte_value(data) << _steps(steps, 8, 1) & 0xFF,
    "BitLShDnum": lambda _, data, steps, size: _shifted(data, steps, size),
    "BitRSh": lambda _, data, steps: byte_value(data) >> _steps(steps, 8, 1),
    "BitRShDnum": lambda _, data, steps: _bits(data) >> _steps(steps, DNUM_BITS, 1),
    "BitCheck": lambda _, data, position: _is_set(byte_value(data), position, 8),
    "BitCheckDnum": lambda _, data, position: _is_set(_bits(data), position, DNUM_BITS),
}
builtins(_CHANGING, cost="string")
builtins(_PURE, cost="string", pure=True)
