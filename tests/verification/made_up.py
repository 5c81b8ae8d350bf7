"""Runs that are made up to be judged, and the judgement that is wanted."""

import itertools

import pytest

from rapidgen.config import load_config
from rapidgen.generate import build, make_system
from rapidgen.verification.model import CheckFailed

CONFIG = load_config("irb120")
SYSTEM = make_system(CONFIG, build(CONFIG))
A, B, C, D = ((x, y) for x, y in ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)))
PATH = [A, B, C]


def along(*places, steps=20):
    """A track at even speed from place to place, a second each."""
    failures = [(0.0, places[0])]
    for number, (one, other) in enumerate(itertools.pairwise(places)):
        for n in range(1, steps + 1):
            place = tuple(a + (b - a) * n / steps for a, b in zip(one, other, strict=True))
            failures.append((number + n / steps, place))
    return failures


def check_fails(what="", *, by=CheckFailed):
    return pytest.raises(by, match=what)
