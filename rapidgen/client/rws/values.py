"""RAPID literals as Python values, and back.

TRUE is True, texts are str, numbers int or float, records and arrays tuples.
"""

import re
from collections.abc import Iterator, Sequence
from typing import TypeAlias

RapidValue: TypeAlias = "bool | str | int | float | Sequence[RapidValue]"
_TOKEN = re.compile(
    r"\s*(?:(?P<number>[+-]?(?:\d+\.?\d*|\.\d+)(?:E[+-]?\d+)?)|(?P<word>TRUE|FALSE)"
    r'|"(?P<text>(?:[^"]|"")*)"|(?P<mark>[\[\],]))\s*',
    re.IGNORECASE,
)
_DEEPEST = 32


def read(literal: str) -> RapidValue:
    """Parse a literal. Raises ValueError for an invalid one."""
    tokens = list(_tokens(literal))[::-1]
    value = _value(tokens, 0) if tokens else None
    if tokens or value is None:
        raise ValueError(f"no literal: {literal[:60]!r}")
    return value


def write(value: RapidValue) -> str:
    """Format a value as a literal.

    ValueError: RAPID has no such number.
    """
    if isinstance(value, bool):
        return "TRUE" if value else "FALSE"
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '""') + '"'
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        if not abs(value) < 1e39:
            raise ValueError(f"{value} is not a number of RAPID")
        return repr(int(value)) if value.is_integer() and abs(value) < 1e9 else repr(value).upper()
    return "[" + ",".join(write(part) for part in value) + "]"


def same(one: RapidValue, other: RapidValue) -> bool:
    """True if two values are equal to the precision of a num."""
    if isinstance(one, bool) or isinstance(other, bool):
        return one is other
    if isinstance(one, int | float) and isinstance(other, int | float):
        return abs(one - other) <= 1e-6 * max(1.0, abs(one))
    if isinstance(one, str) or isinstance(other, str):
        return one == other
    if not isinstance(one, Sequence) or not isinstance(other, Sequence):
        return False
    return len(one) == len(other) and all(same(a, b) for a, b in zip(one, other, strict=True))


def _tokens(literal: str) -> "Iterator[tuple[str, RapidValue]]":
    """(mark, value): the mark of a value is empty."""
    place = 0
    while place < len(literal):
        match = _TOKEN.match(literal, place)
        if match is None:
            raise ValueError(f"no literal: {literal[:60]!r}")
        place = match.end()
        if match["number"] is not None:
            number = float(match["number"])
            complete = number.is_integer() and abs(number) < 1e15
            yield "", int(number) if complete else number
        elif match["word"] is not None:
            yield "", match["word"].upper() == "TRUE"
        elif match["text"] is not None:
            yield "", match["text"].replace('""', '"').replace("\\\\", "\\")
        else:
            yield match["mark"], ""


def _value(tokens: "list[tuple[str, RapidValue]]", depth: int) -> RapidValue:
    """The next value of tokens, which are last first."""
    marker, value = _next(tokens)
    if marker == "":
        return value
    parts: list[RapidValue] = []
    while marker == "[" or (marker == "," and parts):
        if depth > _DEEPEST:
            break
        parts.append(_value(tokens, depth + 1))
        marker, value = _next(tokens)
        if marker == "]":
            return tuple(parts)
        if marker != ",":
            break
    raise ValueError("no literal")


def _next(tokens: "list[tuple[str, RapidValue]]") -> "tuple[str, RapidValue]":
    if not tokens:
        raise ValueError("no literal")
    return tokens.pop()
