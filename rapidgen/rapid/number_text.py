"""Numbers as RAPID writes them: ValToStr, TPWrite \\Num, Write, NumToStr.

One "standard format" for all [S4 reference: ValToStr, TPWrite, Write]: 6 significant digits
(15 of a dnum [mem]), no trailing zeros, no point for a whole number; a num whose fraction is
below 0.000005 or above 0.999995 counts as whole. Exponents look like 1E+10 [mem].
"""

import math
from decimal import ROUND_DOWN, ROUND_HALF_UP, Context, Decimal
from typing import Final

from rapidgen.rapid.numbers import EXACT

NUM_DIGITS: Final = 6
DNUM_DIGITS: Final = 15
"""Significant digits of the standard format."""
_FRACTION: Final = 0.000005
_ALL_DIGITS: Final = Context(prec=800)
"""Enough for every float with decimals behind it."""


def number_text(value: float, digits: int = NUM_DIGITS, *, complete: bool = False) -> str:
    """A number in the standard format; `complete`: all digits of one that is whole and exact."""
    if digits == NUM_DIGITS and math.isfinite(value):
        fraction = abs(value) % 1
        if fraction < _FRACTION or fraction > 1 - _FRACTION:
            value = round(value)
            if complete and abs(value) < EXACT:
                return str(value)
    text = f"{value:.{digits}G}"
    return "0" if text == "-0" else text


def to_places(value: float, places: int, *, truncate: bool = False) -> Decimal:
    """`value` rounded (half away from zero) or cut to a number of decimals."""
    step = Decimal(1).scaleb(-places)
    rounding = ROUND_DOWN if truncate else ROUND_HALF_UP
    return Decimal(value).quantize(step, rounding, _ALL_DIGITS)


def fixed_text(value: float, places: int) -> str:
    """`value` with so many decimals."""
    text = f"{to_places(value, places):f}"
    return text[1:] if text.startswith("-") and not text.strip("-0.") else text


def exponent_text(value: float, places: int) -> str:
    """`value` as 3.85E-01: so many decimals and an exponent of two digits or more."""
    number = Decimal(value)
    exponent = number.adjusted() if number else 0
    mantissa = number.scaleb(-exponent).quantize(Decimal(1).scaleb(-places), ROUND_HALF_UP)
    if abs(mantissa) >= 10:
        exponent += 1
        mantissa = number.scaleb(-exponent).quantize(Decimal(1).scaleb(-places), ROUND_HALF_UP)
    return f"{mantissa:f}E{exponent:+03d}"
