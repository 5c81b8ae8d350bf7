"""Find the smallest set of assumptions that makes a case fail."""

from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise


def smallest(suspects: Sequence[str], breaks: Callable[[Sequence[str]], bool]) -> tuple[str, ...]:
    """Return a minimal subset of `suspects` that still fails.

    All of `suspects` together fail; without any one element of the result the case passes. Delta
    debugging (A. Zeller, R. Hildebrandt, IEEE Trans. Software Eng. 28, 2002): try halves first,
    then smaller parts and their complements.
    """
    left, parts = list(suspects), 2
    while len(left) > 1:
        cuts = [len(left) * part // parts for part in range(parts + 1)]
        chunks = [left[a:b] for a, b in pairwise(cuts)]
        rests = [[s for s in left if s not in chunk] for chunk in chunks]
        smaller = next((chunk for chunk in chunks if breaks(chunk)), None)
        # With two parts, each is the complement of the other.
        fewer = (
            None
            if parts == 2
            else next((remaining for remaining in rests if breaks(remaining)), None)
        )
        if smaller is not None:
            left, parts = smaller, 2
        elif fewer is not None:
            left, parts = fewer, max(parts - 1, 2)
        elif parts == len(left):
            break
        else:
            parts = min(2 * parts, len(left))
    return tuple(left)


def minimal_assumptions(
    rows: Mapping[str, Sequence[str]], breaks: Callable[[Sequence[str]], bool]
) -> dict[str, tuple[str, ...]]:
    """Return the smallest failing set of assumptions for each failing row.

    A set found for one row also explains every other row that contains it.
    """
    result: dict[str, tuple[str, ...]] = {}
    for name, suspects in rows.items():
        known = [part for part in result.values() if set(part) <= set(suspects)]
        result[name] = min(known, key=len) if known else smallest(suspects, breaks)
    return result
