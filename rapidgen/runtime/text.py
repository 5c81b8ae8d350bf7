"""RAPID values as text and back: ValToStr, TPWrite, StrToVal."""

import math
import re

from rapidgen.rapid.numbers import DNUM_DIGITS, MAX_STRING, NUM_DIGITS, number_text, single
from rapidgen.runtime.errors import RapidError
from rapidgen.runtime.values import DNUM, Record, Type, Value

_LITERAL = re.compile(
    r'[+-]?(?:\d+\.?\d*|\.\d+)(?:E[+-]?\d+)?|TRUE|FALSE|"(?:[^"]|"")*"|[\[\],]', re.IGNORECASE
)
_BLANK = re.compile(r"\s*")


def limited(text: str) -> str:
    """Return `text`; ERR_STRTOOLNG: too long for a RAPID string."""
    if len(text) > MAX_STRING:
        raise RapidError("ERR_STRTOOLNG", f"{len(text)} characters")
    return text


def value_text(
    value: Value,
    type_: Type | None = None,
    *,
    complete: bool = False,
) -> str:
    """Return any value in the standard format.

    Texts are quoted, aggregates have no blanks.
    """
    if value.__class__ is dict:
        return "[" + ",".join(value_text(v, type_, complete=complete) for v in value.values()) + "]"
    if isinstance(value, Record):
        parts = zip(value.values(), value.rapid_type.components, strict=True)
        texts = (value_text(part, kind, complete=complete) for part, (_, kind) in parts)
        return "[" + ",".join(texts) + "]"
    if isinstance(value, bool):
        return "TRUE" if value else "FALSE"
    if isinstance(value, str):
        return '"' + value.replace('"', '""') + '"'
    return number_text(value, DNUM_DIGITS if type_ is DNUM else NUM_DIGITS, complete=complete)


def literal_text(value: Value, type_: Type) -> str:
    """Return a value as a literal that parses to exactly this value."""
    if value.__class__ is dict:
        return "[" + ",".join(literal_text(v, type_) for v in value.values()) + "]"
    if isinstance(value, Record):
        parts = zip(value.values(), value.rapid_type.components, strict=True)
        return "[" + ",".join(literal_text(part, kind) for part, (_, kind) in parts) + "]"
    if isinstance(value, bool):
        return "TRUE" if value else "FALSE"
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '""') + '"'
    if type_ is DNUM:
        return f"{value:.17G}" if float(f"{value:.15G}") != value else f"{value:.15G}"
    for digits in range(6, 10):
        text = f"{value:.{digits}G}"
        if single(float(text)) == value:
            return text
    return text


class NotALiteral(Exception):
    """The text is not a literal of the expected type."""


def parse_value(
    text: str, type_: Type, dims: tuple[int, ...] = (), *, escaped: bool = False
) -> Value:
    """Return the value of a literal or literal aggregate of a type.

    `escaped`: texts contain doubled backslashes, as in `literal_text` and source. NotALiteral: the
    text is not a literal of the type.
    """
    tokens = _tokens(text)
    if escaped:
        tokens = [t.replace("\\\\", "\\") if t[0] == '"' else t for t in tokens]
    value, remaining = _parse(tokens, 0, type_, dims)
    if remaining != len(tokens):
        raise NotALiteral
    return value


def _tokens(text: str) -> list[str]:
    result = []
    place = _end_of_blank(text, 0)
    while place < len(text):
        match = _LITERAL.match(text, place)
        if match is None:
            raise NotALiteral
        result.append(match.group())
        place = _end_of_blank(text, match.end())
    return result


def _end_of_blank(text: str, place: int) -> int:
    blank = _BLANK.match(text, place)
    return blank.end() if blank is not None else place


def _parse(tokens: list[str], place: int, type_: Type, dims: tuple[int, ...]) -> tuple[Value, int]:
    if place >= len(tokens):
        raise NotALiteral
    if dims:
        parts, place = _aggregate(tokens, place, [(type_, dims[1:])] * dims[0])
        return dict(enumerate(parts, 1)), place
    if type_.kind == "record":
        parts, place = _aggregate(tokens, place, [(kind, ()) for _, kind in type_.components])
        assert type_.make is not None
        return type_.make(*parts), place
    return _atom(tokens[place], type_), place + 1


def _aggregate(
    tokens: list[str], place: int, parts: list[tuple[Type, tuple[int, ...]]]
) -> tuple[list[Value], int]:
    values = []
    for i, (kind, dims) in enumerate(parts):
        if place >= len(tokens) or tokens[place] != ("[" if i == 0 else ","):
            raise NotALiteral
        value, place = _parse(tokens, place + 1, kind, dims)
        values.append(value)
    if place >= len(tokens) or tokens[place] != "]":
        raise NotALiteral
    return values, place + 1


def _atom(token: str, type_: Type) -> Value:
    if type_.kind == "bool" and token.upper() in ("TRUE", "FALSE"):  # any case [K §2.4, 2.6]
        return token.upper() == "TRUE"
    if type_.kind == "string" and token[0] == '"':
        return token[1:-1].replace('""', '"')
    if type_.kind in ("num", "dnum") and token[-1] in "0123456789.":
        number = float(token)
        try:
            value = single(number) if type_.kind == "num" else number
        except OverflowError as error:
            raise NotALiteral from error
        if math.isfinite(value):
            return value
    raise NotALiteral
