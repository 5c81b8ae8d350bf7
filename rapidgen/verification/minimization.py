"""Minimise failures: the smallest schedule, the fewest assumptions."""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

from rapidgen.verification.model import Counterexample
from rapidgen.verification.schedule import ScheduleName


def smaller(
    name: ScheduleName,
    steps: int,
    finding: Counterexample,
    run: Callable[[ScheduleName], Counterexample | None],
) -> Counterexample:
    """Return the finding of the smallest schedule that still fails.

    The minimizer removes network faults, task order and steps as long as the same check fails: the
    same text, ignoring numbers.
    """
    result = finding

    def breaks(tried: ScheduleName) -> bool:
        nonlocal result
        came = run(tried)
        if came is None or _words(came) != _words(finding):
            return False
        result = came
        return True

    for simpler in (replace(name, calm=True), replace(name, calm=True, turns=True)):
        if breaks(simpler):
            name = simpler
    if breaks(replace(name, steps=())):
        return result
    left = smallest(
        [str(number) for number in range(steps)],
        lambda part: breaks(replace(name, steps=tuple(int(number) for number in part))),
    )
    least = replace(name, steps=tuple(int(number) for number in left))
    if len(left) < steps and result.schedule != str(least):
        breaks(least)
    return result


def _words(finding: Counterexample) -> str:
    return re.sub(r"[\d.,-]+", "#", finding.detail)


# -- assumptions -----------------------------------------------------------------------------------


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
