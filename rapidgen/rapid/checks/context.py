"""Input of the checker, which decides on the treatment of unknown names."""

import re
from collections.abc import Collection, Iterable
from dataclasses import dataclass
from typing import Final

from rapidgen.rapid.dialect import Dialect

_SHORT: Final = 3
_LONG: Final = 7
_PREFIX: Final = re.compile(r"^([a-z]{1,3})(?=[A-Z_])")
"""The type in front of a name: nCount, di_Start."""


@dataclass(frozen=True, slots=True)
class Payload:
    """The payload of a robot in kg, and the robot's display name."""

    robot: str
    mass: float


@dataclass(frozen=True, slots=True)
class CheckContext:
    """Dialect and completeness of the input."""

    dialect: Dialect
    system: bool = False
    """A task of a system with its configuration. Else modules: what they do not declare may lie
    elsewhere, and hide what is predefined."""
    gaps: bool = False
    """Parts of the task are not there to be read."""
    configured: bool = True
    """The configuration of the controller is given: it declares all signals and tasks."""
    strict: bool = False
    """The input is to declare all names, whatever else may declare them."""
    elsewhere: Collection[str] = ()
    """Lower-case names that modules of other tasks declare: neither known nor unknown."""
    payload: Payload | None = None
    """Of the robot that the task moves; None: not known."""

    @property
    def is_complete(self) -> bool:
        """True if the input declares all names: an unknown one is an error."""
        return (self.system or self.strict) and not self.gaps


def closest(keyword: str, known: Iterable[str]) -> str:
    """Return the known name that `keyword` may be a typing error of.

    Returns "" without one. It accepts one slip, or two in a long name: a letter too many, too few,
    wrong, or two swapped. Names that differ only in digits (p10, p20) are not slips, nor are those
    that differ only in the letters before the first capital (diGripper, doGripper).
    """
    folded = keyword.lower()
    allowed = 1 if len(folded) < _LONG else 2
    letters = set(folded)
    bare = _without_digits(folded)
    best, result = allowed + 1, ""
    for name in known:
        other = name.lower()
        if (
            abs(len(other) - len(folded)) > allowed
            or len(letters.symmetric_difference(other)) > 2 * allowed
            or (bare != folded and _without_digits(other) == bare)
            or _have_other_prefixes(keyword, name)
        ):
            continue
        slips = _slips(folded, other, best)
        if slips < best:
            best, result = slips, name
    # p1 and v1 are no slips of each other either.
    shortest = _SHORT if bare == folded else _SHORT + 2
    return result if len(folded) >= shortest else ""


def _slips(one: str, other: str, limit: int) -> int:
    """Return the number of slips between two words, at most `limit`."""
    before: list[int] = []
    row = list(range(len(other) + 1))
    for i, letter in enumerate(one, 1):
        earlier, before, row = before, row, [i]
        for j, against in enumerate(other, 1):
            cost = min(before[j] + 1, row[j - 1] + 1, before[j - 1] + (letter != against))
            if i > 1 and j > 1 and letter == other[j - 2] and one[i - 2] == against:
                cost = min(cost, earlier[j - 2] + 1)
            row.append(cost)
        if min(row) >= limit:
            return limit
    return min(row[-1], limit)


def _have_other_prefixes(one: str, other: str) -> bool:
    """Return True if `one` has a prefix of a type, and `other` is the same name with another one.

    Digits may differ, too; `other` may have no prefix.
    """
    first, second = (_PREFIX.split(_without_digits(name), 1) for name in (one, other))
    return len(first) > 1 and first[-1].lower() == second[-1].lower() and first != second


def _without_digits(text: str) -> str:
    return "".join(c for c in text if not c.isdigit())
