"""The behaviours that a generated driver must have: one file a theme."""

from rapidgen.proving.model import Case
from rapidgen.proving.suite import compatible, controller, framing, links, refusals, stopping

CASES: tuple[Case, ...] = (
    *compatible.CASES,
    *refusals.CASES,
    *framing.CASES,
    *stopping.CASES,
    *links.CASES,
    *controller.CASES,
)
