"""Find the smallest schedule with the same failure."""

import re
from collections.abc import Callable
from dataclasses import replace

from rapidgen.verification.assumption_minimizer import smallest
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
