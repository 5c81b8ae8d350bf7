"""What num and string can hold [K §2.5, 2.13]: used by checker, compiler and run time."""

import math
import struct
from typing import Final

MAX_STRING: Final = 80
"""Characters of a string."""
MAX_SINGLE: Final = 3.4028235677973366e38
"""The first value that single precision cannot hold any more."""
EXACT: Final = 1 << 24
"""Single precision holds every whole number up to here."""
_SINGLE: Final = struct.Struct("<f")


def single(value: float) -> float:
    """`value` as a num: rounded to IEEE single, ties to even. Whole numbers become int.

    OverflowError when it does not fit (ERR_NUM_LIMIT in RAPID).
    """
    if value.__class__ is int and -EXACT <= value <= EXACT:
        return value
    rounded: float = _SINGLE.unpack(_SINGLE.pack(value))[0]
    if -EXACT <= rounded <= EXACT:
        complete = int(rounded)
        if complete == rounded:
            return complete
    return rounded


def dnum(value: float, bits: int) -> float:
    """`value` as a dnum that counts whole numbers to 2^`bits`: what is larger loses its last bits.

    Infinity and NaN stay what they are.
    """
    limit = 1 << bits
    if -limit <= value <= limit or not math.isfinite(value):
        return value
    fraction, exponent = math.frexp(value)
    return math.ldexp(math.trunc(fraction * limit), exponent - bits)


def is_single(value: float) -> bool:
    """Whether single precision holds the value at all."""
    return -MAX_SINGLE < value < MAX_SINGLE


def is_exact_single(value: int) -> bool:
    """Whether single precision holds a whole number exactly."""
    return is_single(value) and int(single(value)) == value
