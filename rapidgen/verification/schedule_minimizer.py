"""The smallest schedule that still breaks the same thing."""

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
    """What `run` finds in the least that is left of a schedule of so many `steps`.

    Network, order of tasks and steps are taken away, as long as the same demand does not hold:
    in the same words, whatever their figures.
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
