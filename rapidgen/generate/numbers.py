"""RAPID number literals: a num is an IEEE single [K §2.13]."""

import math
import struct


def single(value: float) -> float:
    """Return `value` rounded to an IEEE single.

    Raises OverflowError outside its range.
    """
    return float(struct.unpack("<f", struct.pack("<f", value))[0])


def literal(value: float) -> str:
    """Return the shortest decimal literal that reads as the same num.

    The sign, if any, is an operator in RAPID: it may stand only at the start of an expression.
    """
    if not math.isfinite(value):
        raise ValueError(f"{value} is not a number of RAPID")
    rounded = single(value)
    if rounded == int(rounded) and abs(rounded) < 2**23:
        return str(int(rounded))
    for digits in range(1, 10):
        text = f"{rounded:.{digits}g}"
        if single(float(text)) == rounded:
            break
    mantissa, _, exponent = text.partition("e")
    return f"{mantissa}E{int(exponent)}" if exponent else mantissa


def inward(value: float, *, up: bool) -> float:
    """Return a limit in deg or mm, rounded to 4 decimals inside `value`.

    A value that differs only by the float error of a conversion to SI and back is not changed.
    """
    near = round(value, 3)
    if abs(near - value) < 2e-5:
        return near
    scaled = value * 1e4
    return (math.ceil(scaled) if up else math.floor(scaled)) / 1e4
