"""Strings and conversions.

Sources: the S4 reference's page of each name for the limits (positions count from 1, an outside
position is an error); the switch `argument_error` selects the error.
"""

from collections.abc import Callable
from operator import add, eq, floordiv, ge, gt, le, lt, mod, mul, ne, sub

from rapidgen.rapid.numbers import exponent_text, fixed_text, single
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.rawbytes import byte_value, whole
from rapidgen.runtime.registry import builtin, builtins
from rapidgen.runtime.signals import target_of, value_of
from rapidgen.runtime.task.task import Task
from rapidgen.runtime.text import (
    NotALiteral,
    limited,
    parse_value,
    value_text,
)
from rapidgen.runtime.values import Value

_LARGEST_STRDIG = 4_294_967_295
_LARGEST_DECIMAL = 9_223_372_036_854_775_807


def _place(text: str, position: float) -> int:
    place = whole(position, "ERR_OUTOFBND")
    if not 1 <= place <= len(text):
        raise RapidError("ERR_OUTOFBND", f"position {place} of {len(text)} characters")
    return place


def _search_place(task: Task, text: str, position: float) -> int:
    """Return the start of a search; see `Switches.find_past_end`."""
    after = task.controller.dialect.find_past_end == "none" and position == len(text) + 1
    return len(text) + 1 if after else _place(text, position)


@builtin("StrPart", cost="string", pure=True)
def str_part(_task: Task, text: str, position: float, length: float) -> str:
    """Return a part, or raise ERR_OUTOFBND [S4 StrPart]."""
    count = whole(length, "ERR_OUTOFBND")
    start = _place(text, position)
    if count < 0 or start - 1 + count > len(text):
        raise RapidError("ERR_OUTOFBND", f"{count} characters from {start} of {len(text)}")
    return text[start - 1 : start - 1 + count]


@builtin("StrFind", cost="string", pure=True)
def str_find(task: Task, text: str, position: float, set_: str, not_in: bool | None) -> int:
    """Return the first position with a character (not) in the set.

    Returns length + 1 without a match.
    """
    for place in range(_search_place(task, text, position), len(text) + 1):
        if (text[place - 1] in set_) != bool(not_in):
            return place
    return len(text) + 1


@builtin("StrMatch", cost="string", pure=True)
def str_match(task: Task, text: str, position: float, pattern: str) -> int:
    """Return the first position of the pattern.

    Returns length + 1 without a match.
    """
    result = text.find(pattern, _search_place(task, text, position) - 1)
    return result + 1 if result >= 0 else len(text) + 1


@builtin("StrMap", cost="string", pure=True)
def str_map(_task: Task, text: str, source: str, target: str) -> str:
    """Replace each character of `source` by that of `target`.

    A character of `source` without a counterpart stays, like characters outside `source` [S4
    StrMap]: STR_LOWER has two letters more than STR_UPPER.
    """
    paired = min(len(source), len(target))
    return text.translate(str.maketrans(source[:paired], target[:paired]))


@builtin("StrOrder", cost="string", pure=True)
def str_order(_task: Task, one: str, two: str, order: str) -> bool:
    """Return True if `one` precedes or equals `two` in an order.

    Characters without a rank come last.
    """

    def ranks(text: str) -> list[tuple[int, int]]:
        return [(order.find(c) if c in order else len(order), ord(c)) for c in text]

    # Among ranked characters the rank alone decides; it is unique, so the code never does.
    return ranks(one) <= ranks(two)


@builtin("StrToVal", cost="string")
def str_to_val(_task: Task, text: str, argument: object) -> bool:
    """Parse a literal of the target's type.

    FALSE leaves the target unchanged [S4 StrToVal].
    """
    target = target_of(argument)
    try:
        value = parse_value(text, target.type, target.dims)
    except NotALiteral:
        return False
    target.set(value)
    return True


@builtin("ValToStr", cost="string")
def val_to_str(task: Task, argument: object) -> str:
    """Return the text of any value; ERR_STRTOOLNG over 80 characters."""
    return limited(
        value_text(*value_of(argument), complete=task.controller.dialect.whole_text == "all")
    )


@builtin("StrFormat", cost="string", pure=True)
def str_format(_task: Task, text: str, *arguments: str | None) -> str:
    """Replace `{1}` to `{5}` by the arguments."""
    for i, argument in enumerate(arguments, 1):
        if argument is not None:
            text = text.replace(f"{{{i}}}", argument)
    return limited(text)


def _decimals(decimals: float) -> int:
    places = whole(decimals, "ERR_ARGVALERR")
    if not 0 <= places <= 15:
        raise RapidError("ERR_ARGVALERR", f"{places} decimals")
    return places


def _integer(text: str, base: int, largest: int = _LARGEST_DECIMAL) -> int:
    if not text or not text.isascii() or not text.isalnum():
        raise RapidError("ERR_ARGVALERR", f"'{text}' is no number")
    try:
        number = int(text, base)
    except ValueError as error:
        raise RapidError("ERR_ARGVALERR", f"'{text}' is no number") from error
    if number > largest:
        raise RapidError("ERR_ARGVALERR", f"{text} is too large")
    return number


@builtin("StrToByte", cost="string", pure=True)
def str_to_byte(
    _task: Task,
    text: str,
    hexadecimal: bool | None,
    octal: bool | None,
    binary: bool | None,
    char: bool | None,
) -> int:
    """Return the byte of a text, decimal by default."""
    if char:
        if len(text) != 1:
            raise RapidError("ERR_ARGVALERR", "\\Char takes one character")
        return ord(text)
    base, longest = (16, 2) if hexadecimal else (8, 3) if octal else (2, 8) if binary else (10, 3)
    if len(text) > longest:
        raise RapidError("ERR_ARGVALERR", f"'{text}' is no byte")
    return _integer(text, base, 255)


@builtin("ByteToStr", cost="string", pure=True)
def byte_to_str(
    task: Task,
    data: float,
    hexadecimal: bool | None,
    octal: bool | None,
    binary: bool | None,
    char: bool | None,
) -> str:
    """Return the text of a byte, decimal by default.

    See `Switches.byte_to_str` for \\Char.
    """
    byte = byte_value(data)
    if hexadecimal:
        return f"{byte:02X}"
    if octal:
        return f"{byte:03o}"
    if binary:
        return f"{byte:08b}"
    if char:
        displayed = chr(byte)
        as_code = task.controller.dialect.byte_to_str == "code" and not displayed.isprintable()
        return f"\\{byte:02X}" if as_code else displayed
    return str(byte)


def _digits(text: str) -> int:
    if not text.isdigit():
        raise RapidError("ERR_ARGVALERR", f"'{text}' is no stringdig")
    return _integer(text, 10, _LARGEST_STRDIG)


_RELATIONS: dict[int, Callable[[int, int], bool]] = {1: lt, 2: le, 3: eq, 4: ne, 5: ge, 6: gt}
"""opnum"""
_CALCULATIONS: dict[float, Callable[[int, int], int]] = {
    1: add,
    2: sub,
    3: mul,
    4: floordiv,
    5: mod,
}
"""opcalc: OpAdd, OpSub, OpMult, OpDiv, OpMod"""


@builtin("StrDigCmp", cost="string", pure=True)
def str_dig_cmp(_task: Task, one: str, relation: float, two: str) -> bool:
    """Compare two whole numbers given as digits."""
    a, b = _digits(one), _digits(two)
    if int(relation) not in _RELATIONS:
        raise RapidError("ERR_ARGVALERR", f"{relation:g} is no opnum")
    return _RELATIONS[int(relation)](a, b)


@builtin("StrDigCalc", cost="string", pure=True)
def str_dig_calc(_task: Task, one: str, operation: float, two: str) -> str:
    """Calculate with whole numbers given as digits."""
    a, b = _digits(one), _digits(two)
    if operation not in _CALCULATIONS:
        raise RapidError("ERR_ARGVALERR", f"{operation:g} is no opcalc")
    try:
        result = _CALCULATIONS[operation](a, b)
    except ZeroDivisionError as error:
        raise RapidError("ERR_CALC_DIVZERO") from error
    if result < 0:
        raise RapidError("ERR_CALC_NEG")
    if result > _LARGEST_STRDIG:
        raise RapidError("ERR_CALC_OVERFLOW")
    return str(result)


def _number(value: float, decimals: float, exponent: bool | None) -> str:
    """Return a number with decimals, halves rounded away from zero."""
    return limited((exponent_text if exponent else fixed_text)(value, _decimals(decimals)))


# Hexadecimal digits are those of up to 7FFFFFFFFFFFFFFF [manual].
_PURE: dict[str, Callable[..., Value]] = {
    "StrLen": lambda _, text: len(text),
    "StrMemb": lambda _, text, position, set_: text[_place(text, position) - 1] in set_,
    "NumToStr": lambda _, value, *form: _number(single(value), *form),
    "DnumToStr": lambda _, value, *form: _number(value, *form),
    "DecToHex": lambda _, text: f"{_integer(text, 10):X}",
    "HexToDec": lambda _, text: str(_integer(text, 16)),
}
builtins(_PURE, cost="string", pure=True)
