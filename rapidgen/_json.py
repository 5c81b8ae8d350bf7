"""Typed access to JSON data.

Each function raises TypeError for another type; a missing member is a KeyError.
"""

from typing import TypeAlias

Json: TypeAlias = "bool | int | float | str | list[Json] | dict[str, Json] | None"
Members: TypeAlias = dict[str, Json]


def members(data: Json) -> Members:
    """Return the members of an object."""
    if not isinstance(data, dict):
        raise TypeError(f"{type(data).__name__} is no object")
    return data


def items(data: Json) -> list[Json]:
    """Return the items of an array."""
    if not isinstance(data, list):
        raise TypeError(f"{type(data).__name__} is no array")
    return data


def text(data: Json) -> str:
    """Return a string."""
    if not isinstance(data, str):
        raise TypeError(f"{type(data).__name__} is no text")
    return data


def number(data: Json) -> float:
    """Return a number."""
    if not isinstance(data, int | float):
        raise TypeError(f"{type(data).__name__} is no number")
    return data


def whole(data: Json) -> int:
    """Return a whole number."""
    if not isinstance(data, int):
        raise TypeError(f"{type(data).__name__} is no whole number")
    return data
