"""Numbers: rounding, powers, trigonometry in degrees, counters; num and dnum twins.

Sources: the S4 reference's page of each name [manual]; argument errors: switch `argument_error`.
"""

import math
from collections.abc import Callable

from rapidgen.rapid.numbers import single
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.rawbytes import whole
from rapidgen.runtime.registry import builtin
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.text import to_places
from rapidgen.runtime.values import Ref

_LARGEST_NUM_INTEGER = 8_388_608
_SMALLEST_NUM_INTEGER = -8_388_607


def _one(name: str, function: Callable[[float], float]) -> None:
    """Bind a function of one number, as num and as dnum."""

    @builtin(name, pure=True)
    def of_num(_task: Task, value: float) -> float:
        return single(function(value))

    @builtin(name + "Dnum", pure=True)
    def of_dnum(_task: Task, value: float) -> float:
        return function(value)


def _two(name: str, function: Callable[[float, float], float]) -> None:
    """Bind a function of two numbers, as num and as dnum."""

    @builtin(name, pure=True)
    def of_num(_task: Task, one: float, two: float) -> float:
        return single(function(one, two))

    @builtin(name + "Dnum", pure=True)
    def of_dnum(_task: Task, one: float, two: float) -> float:
        return function(one, two)


def _square_root(value: float) -> float:
    if value < 0:
        raise RapidError("ERR_ARGVALERR", f"Sqrt({value:g})")
    return math.sqrt(value)


def _power(base: float, exponent: float) -> float:
    if (base < 0 and exponent != int(exponent)) or (base == 0 and exponent <= 0):
        raise RapidError("ERR_ARGVALERR", f"Pow({base:g}, {exponent:g})")
    return math.pow(base, exponent)


def _within_one(value: float) -> float:
    if not -1 <= value <= 1:
        raise RapidError("ERR_ARGVALERR", f"{value:g} is not within -1 to 1")
    return value


_one("Abs", abs)
_one("Sqrt", _square_root)
_two("Pow", _power)
_one("Sin", lambda angle: math.sin(math.radians(angle)))
_one("Cos", lambda angle: math.cos(math.radians(angle)))
_one("Tan", lambda angle: math.tan(math.radians(angle)))
_one("ASin", lambda value: math.degrees(math.asin(_within_one(value))))
_one("ACos", lambda value: math.degrees(math.acos(_within_one(value))))
_one("ATan", lambda value: math.degrees(math.atan(value)))
_two("ATan2", lambda y, x: math.degrees(math.atan2(y, x)))


@builtin("Exp", pure=True)
def exp(_task: Task, exponent: float) -> float:
    """e to the power of `exponent`."""
    return single(math.exp(exponent))


@builtin("Max", pure=True)
def largest(_task: Task, one: float, two: float) -> float:
    """The larger of two."""
    return max(one, two)


@builtin("Min", pure=True)
def smallest(_task: Task, one: float, two: float) -> float:
    """The smaller of two."""
    return min(one, two)


def _rounded(value: float, decimals: float | None, *, truncate: bool = False) -> float:
    places = 0 if decimals is None else whole(decimals, "ERR_ARGVALERR")
    if not 0 <= places <= 15:
        raise RapidError("ERR_ARGVALERR", f"\\Dec:={places}")
    number = to_places(value, places, truncate=truncate)
    return int(number) if places == 0 else float(number)


@builtin("Round", pure=True)
def round_num(_task: Task, value: float, decimals: float | None) -> float:
    """Rounded half away from zero."""
    return single(_rounded(value, decimals))


@builtin("Trunc", pure=True)
def trunc_num(_task: Task, value: float, decimals: float | None) -> float:
    """Cut towards zero."""
    return single(_rounded(value, decimals, truncate=True))


@builtin("RoundDnum", pure=True)
def round_dnum(_task: Task, value: float, decimals: float | None) -> float:
    """Rounded half away from zero."""
    return _rounded(value, decimals)


@builtin("TruncDnum", pure=True)
def trunc_dnum(_task: Task, value: float, decimals: float | None) -> float:
    """Cut towards zero."""
    return _rounded(value, decimals, truncate=True)


def _target(num: Ref | None, dnum: Ref | None) -> Ref:
    target = num if num is not None else dnum
    assert target is not None
    return target


@builtin("Incr")
def incr(_task: Task, num: Ref | None, dnum: Ref | None) -> None:
    """Add 1."""
    target = _target(num, dnum)
    target.set(target.get() + 1)


@builtin("Decr")
def decr(_task: Task, num: Ref | None, dnum: Ref | None) -> None:
    """Take 1 away."""
    target = _target(num, dnum)
    target.set(target.get() - 1)


@builtin("Add")
def add(
    _task: Task,
    num: Ref | None,
    dnum: Ref | None,
    value: float | None,
    dnum_value: float | None,
) -> None:
    """Add a value."""
    target = _target(num, dnum)
    amount = value if value is not None else dnum_value
    assert amount is not None
    target.set(target.get() + amount)


@builtin("Clear")
def clear(_task: Task, num: Ref | None, dnum: Ref | None) -> None:
    """Set to 0."""
    _target(num, dnum).set(0)


@builtin("TryInt", pure=True)
def try_int(_task: Task, num: float | None, dnum: float | None) -> None:
    """ERR_INT_NOTVAL when the value is not whole."""
    value = num if num is not None else dnum
    assert value is not None
    whole(value, "ERR_INT_NOTVAL")


@builtin("NumToDnum", pure=True)
def num_to_dnum(_task: Task, value: float) -> float:
    """The same value as a dnum, exactly."""
    return single(value)


@builtin("DnumToNum", pure=True)
def dnum_to_num(_task: Task, value: float, integer: bool | None) -> float:
    """The nearest num; \\Integer insists on a whole number that a num holds exactly."""
    if integer:
        number = whole(value, "ERR_INT_NOTVAL")
        if not _SMALLEST_NUM_INTEGER <= number <= _LARGEST_NUM_INTEGER:
            raise RapidError("ERR_INT_MAXVAL", f"{value:g}")
        return number
    try:
        return single(value)
    except OverflowError as error:
        raise RapidError("ERR_ARGVALERR", f"{value:g} does not fit a num") from error
