"""Numbers: rounding, powers, trigonometry in degrees, counters; num and dnum twins.

Sources: the S4 reference's page of each name [manual]; argument errors: switch `argument_error`.
"""

import math
from collections.abc import Callable

from rapidgen.rapid.number_text import to_places
from rapidgen.rapid.numbers import single
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.rawbytes import whole
from rapidgen.runtime.registry import builtin, builtins
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.values import Ref, Value

_LARGEST_NUM_INTEGER = 8_388_608
_SMALLEST_NUM_INTEGER = -8_388_607


def _one(name: str, function: Callable[[float], float]) -> None:
    """Bind a function of one number, as num and as dnum."""
    builtin(name, pure=True)(lambda _task, value: single(function(value)))
    builtin(name + "Dnum", pure=True)(lambda _task, value: function(value))


def _two(name: str, function: Callable[[float, float], float]) -> None:
    """Bind a function of two numbers, as num and as dnum."""
    builtin(name, pure=True)(lambda _task, one, two: single(function(one, two)))
    builtin(name + "Dnum", pure=True)(lambda _task, one, two: function(one, two))


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


def _rounded(value: float, decimals: float | None, *, truncate: bool = False) -> float:
    """To so many decimals (0), half away from zero, or cut towards zero."""
    places = 0 if decimals is None else whole(decimals, "ERR_ARGVALERR")
    if not 0 <= places <= 15:
        raise RapidError("ERR_ARGVALERR", f"\\Dec:={places}")
    number = to_places(value, places, truncate=truncate)
    return int(number) if places == 0 else float(number)


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
_two("Round", _rounded)
_two("Trunc", lambda value, decimals: _rounded(value, decimals, truncate=True))


def _target(num: Ref | None, dnum: Ref | None) -> Ref:
    target = num if num is not None else dnum
    assert target is not None
    return target


def _increase(target: Ref, amount: float) -> None:
    target.set(target.get() + amount)


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
    _increase(target, amount)


@builtin("TryInt", pure=True)
def try_int(_task: Task, num: float | None, dnum: float | None) -> None:
    """ERR_INT_NOTVAL when the value is not whole."""
    value = num if num is not None else dnum
    assert value is not None
    whole(value, "ERR_INT_NOTVAL")


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


# Num or dnum, whichever is given.
_COUNTING: dict[str, Callable[..., Value]] = {
    "Incr": lambda _, num, dnum: _increase(_target(num, dnum), 1),
    "Decr": lambda _, num, dnum: _increase(_target(num, dnum), -1),
    "Clear": lambda _, num, dnum: _target(num, dnum).set(0),
}
builtins(_COUNTING)
_PURE: dict[str, Callable[..., Value]] = {
    "Exp": lambda _, exponent: single(math.exp(exponent)),
    "Max": lambda _, one, two: max(one, two),
    "Min": lambda _, one, two: min(one, two),
    "NumToDnum": lambda _, value: single(value),
}
builtins(_PURE, pure=True)
