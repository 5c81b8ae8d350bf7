"""Values of num, dnum and string, and numbers as text.

Checker, compiler and run time use them [K §2.5, 2.13].
"""

import math
import struct
from decimal import ROUND_DOWN, ROUND_HALF_UP, Context, Decimal
from typing import Final

MAX_STRING: Final = 80
"""Characters of a string."""
MAX_SINGLE: Final = 3.4028235677973366e38
"""The first value that single precision cannot hold any more."""
EXACT: Final = 1 << 24
"""Single precision represents every whole number up to this limit."""
_SINGLE: Final = struct.Struct("<f")


def single(value: float) -> float:
    """Return `value` rounded to IEEE single, ties to even.

    Whole numbers become int. OverflowError: it does not fit (ERR_NUM_LIMIT in RAPID).
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
    """Return `value` as a dnum that counts whole numbers to 2^`bits`.

    Larger values lose their last bits. Infinity and NaN stay unchanged.
    """
    limit = 1 << bits
    if -limit <= value <= limit or not math.isfinite(value):
        return value
    fraction, exponent = math.frexp(value)
    return math.ldexp(math.trunc(fraction * limit), exponent - bits)


def is_single(value: float) -> bool:
    """Return True if single precision covers the value."""
    return -MAX_SINGLE < value < MAX_SINGLE


def is_exact_single(value: int) -> bool:
    """Return True if single precision represents a whole number exactly."""
    return is_single(value) and int(single(value)) == value


# -- Numbers as text -------------------------------------------------------------------------------
#
# Numbers in RAPID's formats: ValToStr, TPWrite \Num, Write, NumToStr.
#
# All share one "standard format" [S4 reference: ValToStr, TPWrite, Write]: 6 significant digits (15
# of a dnum [mem]), no trailing zeros, no point for a whole number. A num whose fraction is below
# 0.000005 or above 0.999995 counts as whole. Exponents have the form 1E+10 [mem].


NUM_DIGITS: Final = 6
DNUM_DIGITS: Final = 15
"""Significant digits of the standard format."""
_FRACTION: Final = 0.000005
_ALL_DIGITS: Final = Context(prec=800)
"""Enough for every float with decimals."""


def number_text(value: float, digits: int = NUM_DIGITS, *, complete: bool = False) -> str:
    """Return a number in the standard format.

    `complete`: all digits of a whole and exact number.
    """
    if digits == NUM_DIGITS and math.isfinite(value):
        fraction = abs(value) % 1
        if fraction < _FRACTION or fraction > 1 - _FRACTION:
            value = round(value)
            if complete and abs(value) < EXACT:
                return str(value)
    text = f"{value:.{digits}G}"
    return "0" if text == "-0" else text


def to_places(value: float, places: int, *, truncate: bool = False) -> Decimal:
    """Round `value` (half away from zero) or truncate it to decimals."""
    step = Decimal(1).scaleb(-places)
    rounding = ROUND_DOWN if truncate else ROUND_HALF_UP
    return Decimal(value).quantize(step, rounding, _ALL_DIGITS)


def fixed_text(value: float, places: int) -> str:
    """Return `value` with a number of decimals."""
    text = f"{to_places(value, places):f}"
    return text[1:] if text.startswith("-") and not text.strip("-0.") else text


def exponent_text(value: float, places: int) -> str:
    """Return `value` as 3.85E-01 with a number of decimals.

    The exponent has two digits or more.
    """
    number = Decimal(value)
    exponent = number.adjusted() if number else 0
    mantissa = number.scaleb(-exponent).quantize(Decimal(1).scaleb(-places), ROUND_HALF_UP)
    if abs(mantissa) >= 10:
        exponent += 1
        mantissa = number.scaleb(-exponent).quantize(Decimal(1).scaleb(-places), ROUND_HALF_UP)
    return f"{mantissa:f}E{exponent:+03d}"
