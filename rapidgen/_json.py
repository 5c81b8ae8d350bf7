"""Typed access to JSON data.

Each function raises TypeError for another type; a missing member is a KeyError.
"""

from typing import TypeAlias

Json: TypeAlias = "bool | int | float | str | list[Json] | dict[str, Json] | None"
Members: TypeAlias = dict[str, Json]


def members(data: Json) -> Members:
    """An object."""
    if not isinstance(data, dict):
        raise TypeError(f"{type(data).__name__} is no object")
    return data


def items(data: Json) -> list[Json]:
    """An array."""
    if not isinstance(data, list):
        raise TypeError(f"{type(data).__name__} is no array")
    return data


def text(data: Json) -> str:
    """A string."""
    if not isinstance(data, str):
        raise TypeError(f"{type(data).__name__} is no text")
    return data


def number(data: Json) -> float:
    """A number."""
    if not isinstance(data, int | float):
        raise TypeError(f"{type(data).__name__} is no number")
    return data


def whole(data: Json) -> int:
    """A whole number."""
    if not isinstance(data, int):
        raise TypeError(f"{type(data).__name__} is no whole number")
    return data
