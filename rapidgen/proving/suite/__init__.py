"""The behaviours that a generated driver must have: one file a theme."""

from dataclasses import replace

from rapidgen.proving.model import Case
from rapidgen.proving.suite import (
    asking,
    batches,
    commanding,
    compatible,
    controller,
    controlling,
    corners,
    cutting,
    edges,
    failing,
    faults,
    framing,
    halting,
    handing,
    interrupted,
    joints,
    limits,
    links,
    moving,
    paired,
    reading,
    refusals,
    restarts,
    sockets,
    starting,
    stopping,
    streaming,
    taking,
    telling,
    watching,
)

_ALL: tuple[Case, ...] = (
    *compatible.CASES,
    *paired.CASES,
    *refusals.CASES,
    *edges.CASES,
    *framing.CASES,
    *sockets.CASES,
    *taking.CASES,
    *handing.CASES,
    *joints.CASES,
    *limits.CASES,
    *stopping.CASES,
    *streaming.CASES,
    *batches.CASES,
    *cutting.CASES,
    *controlling.CASES,
    *asking.CASES,
    *commanding.CASES,
    *telling.CASES,
    *watching.CASES,
    *reading.CASES,
    *links.CASES,
    *controller.CASES,
    *starting.CASES,
    *restarts.CASES,
    *failing.CASES,
    *faults.CASES,
    *moving.CASES,
    *corners.CASES,
    *halting.CASES,
    *interrupted.CASES,
)

# They boot many controllers, or let hours pass.
_ONCE = {
    "counters-wrap",
    "full-capacity",
    "half-files",
    "mixed-builds",
    "stale-data",
    "state-for-hours",
    "stop-every-statement",
    "stream",
}

# They are answered, or keep their link, while the program is stopped.
_BACKGROUND = {
    "answers-soon",
    "batch-not-now",
    "before-a-move",
    "builds-differ",
    "e-stop-status",
    "ends-while-fed",
    "first-reason",
    "manual-speed",
    "manual-status",
    "nobody-answers",
    "not-executing",
    "one-signal-missing",
    "pause-ends",
    "progress-ended",
    "start-alone",
    "stop-pp-to-main",
    "stopped-unseen",
    "stream-ended",
    "supervisor-gone",
    "unseen",
    "why-it-ended",
    "without-routines",
}

CASES = tuple(
    replace(case, once=case.name in _ONCE, background=case.name in _BACKGROUND) for case in _ALL
)
