"""What the checker was given, and therefore what it may call unknown."""

from collections.abc import Iterable
from dataclasses import dataclass
from difflib import SequenceMatcher
from enum import IntEnum
from typing import Final

from rapidgen.rapid.dialect import Dialect


class Extent(IntEnum):
    """How much of a controller is there to be judged."""

    FILE = 0
    """One module: its siblings and the configuration are not known."""
    FOLDER = 1
    """Modules with an entry routine: routines and types are known, data may lie elsewhere."""
    TASK = 2
    """All modules of a task: only what the configuration installs may be unknown."""
    SYSTEM = 3
    """A whole system with its configuration."""


@dataclass(frozen=True, slots=True)
class Given:
    """Dialect and extent. `gaps` is set where parts of a task are not there to be read."""

    dialect: Dialect
    extent: Extent
    gaps: bool = False

    @property
    def judges_routines(self) -> bool:
        """Whether an unknown routine or type is an error."""
        return self.extent >= Extent.FOLDER and not self.gaps

    @property
    def judges_data(self) -> bool:
        """Whether an unknown datum is an error wherever it stands."""
        return self.extent == Extent.SYSTEM and not self.gaps


_CLOSE: Final = 0.8


def closest(word: str, known: Iterable[str]) -> str:
    """The known name that `word` looks like a slip of, or an empty text.

    Names that differ in their digits only (p10, p20) are siblings, not slips.
    """
    folded = word.lower()
    matcher = SequenceMatcher(autojunk=False)
    matcher.set_seq2(folded)
    bare = _without_digits(folded)
    best, found = _CLOSE, ""
    for name in known:
        other = name.lower()
        if abs(len(other) - len(folded)) > 2 or (bare != folded and _without_digits(other) == bare):
            continue
        matcher.set_seq1(other)
        if matcher.real_quick_ratio() < best or matcher.quick_ratio() < best:
            continue
        ratio = matcher.ratio()
        if ratio > best or (ratio == best and not found):
            best, found = ratio, name
    return found


def _without_digits(text: str) -> str:
    return "".join(c for c in text if not c.isdigit())
