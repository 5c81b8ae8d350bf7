"""The behaviours that a generated driver must have: one file a theme."""

from rapidgen.proving.model import Case
from rapidgen.proving.suite import (
    compatible,
    controller,
    controlling,
    edges,
    failing,
    faults,
    framing,
    links,
    paired,
    refusals,
    stopping,
    streaming,
    telling,
    watching,
)

CASES: tuple[Case, ...] = (
    *compatible.CASES,
    *paired.CASES,
    *refusals.CASES,
    *edges.CASES,
    *framing.CASES,
    *stopping.CASES,
    *streaming.CASES,
    *controlling.CASES,
    *telling.CASES,
    *watching.CASES,
    *links.CASES,
    *controller.CASES,
    *failing.CASES,
    *faults.CASES,
)
