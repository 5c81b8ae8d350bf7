"""Contents of RWS bodies, independent of syntax: items, links, faults.

Shapes are those of three generations of controllers [VC 6.16, VC 7.21, real 7.21].
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import IntEnum
from typing import Literal


class Generation(IntEnum):
    """RWS 1.0 (IRC5, RobotWare 6), 2.0 (RobotWare 7), and 2.0 as RobotWare 8 has it."""

    ONE = 1
    TWO = 2
    EIGHT = 8


Syntax = Literal["xhtml", "json", "hal"]
"""XHTML of either generation, JSON of RWS 1.0, HAL of RWS 2.0."""


def whole(text: str) -> int:
    """Return a whole number of at most 18 digits; 0 for another text."""
    return int(text) if re.fullmatch(r"[+-]?[0-9]{1,18}", text) else 0


@dataclass(frozen=True, slots=True)
class Item:
    """One item of a body: class, title and fields as texts, in order.

    `within` are items inside it (arguments of an event, attributes of a cfg instance); `links` are
    by their `rel`.
    """

    kind: str
    title: str = ""
    fields: Mapping[str, str] = field(default_factory=dict)
    links: Mapping[str, str] = field(default_factory=dict)
    within: tuple["Item", ...] = ()

    def text(self, name: str, default: str = "") -> str:
        """Return a field, or `default`."""
        return self.fields.get(name, default)

    def whole(self, name: str) -> int:
        """Return a field as a whole number; 0 if it is not one."""
        return whole(self.fields.get(name, ""))


@dataclass(frozen=True, slots=True)
class Fault:
    """Reason of a rejected request: ABB's code and its text."""

    code: int
    message: str = ""


@dataclass(frozen=True, slots=True)
class Body:
    """Contents of an answer.

    `next` is the address of the rest of a collection, relative to `base`.
    """

    items: tuple[Item, ...] = ()
    title: str = ""
    base: str = ""
    here: str = ""
    next: str = ""
    collection: bool = False
    """True if HAL gives the items as embedded resources."""
    links: Mapping[str, str] = field(default_factory=dict)
    fault: Fault | None = None

    def first(self, kind: str) -> Item | None:
        """Return the first item of a class."""
        return next(iter(self.all(kind)), None)

    def all(self, *kinds: str) -> tuple[Item, ...]:
        """Return the items of any of these classes."""
        return tuple(item for item in self.items if item.kind in kinds)


class Unreadable(ValueError):
    """Bytes that are not a body of Robot Web Services."""
