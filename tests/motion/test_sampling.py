"""Limits from samples hold between the samples, too, also where a way turns sharply."""

from math import tanh

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rapidgen.motion import sampling
from rapidgen.motion.pieces import AxisLimits

LIMITS = AxisLimits((4.0,), (30.0,), 0.8)
TOO_MUCH = 1 + 1e-3


def swing(size, centre, width):
    """An axis that turns by `size` around `centre` within some `width`s, as near a singularity."""

    def at(t):
        x = tanh((t - centre) / width)
        slope = 1 - x * x
        return size * x, size * slope / width, -2 * size * x * slope / width**2

    return at


def ceilings_of(at):
    """Limits from nodes that are close enough, as a way finds them."""
    count = 8
    while True:
        nodes = sampling.sample(lambda t: (at(t)[0],), 0.0, 1.0, count)
        ceilings, close = sampling.interval_limits(nodes, 1 / count, LIMITS)
        if close or count == 512:
            return ceilings
        count *= 2


def largest_shares(at):
    """Largest shares of speed and acceleration that the found limits let the axis reach."""
    ceilings = ceilings_of(at)
    count = len(ceilings)
    fastest = strongest = 0.0
    for k, (speed, ((rate_share, curvature_share),)) in enumerate(ceilings):
        for i in range(33):
            _, rate, bend = at((k + i / 32) / count)
            fastest = max(fastest, abs(rate) * speed / 4.0)
            for x in (0.0, speed * speed):
                acceleration = (1 - curvature_share * x) / rate_share
                strongest = max(strongest, (abs(rate) * acceleration + abs(bend) * x) / 30.0)
    return fastest, strongest


@given(
    size=st.floats(0.01, 3.0),
    centre=st.floats(0.0, 1.0),
    width=st.floats(0.1, 1.0),
)
def test_limits_hold_between_the_nodes(size, centre, width):
    fastest, strongest = largest_shares(swing(size, centre, width))
    assert fastest <= TOO_MUCH
    assert strongest <= TOO_MUCH


def test_they_are_not_much_tighter_than_needed():
    fastest, strongest = largest_shares(swing(0.5, 0.5, 0.3))
    assert fastest > 0.3
    assert strongest > 0.9


@pytest.mark.parametrize(("width", "count"), [(0.3, 8), (0.1, 32)])
def test_a_sharper_turn_is_sampled_closer(width, count):
    assert len(ceilings_of(swing(0.5, 0.5, width))) == count


def test_a_straight_line_is_not():
    straight = [(0.1 * k,) for k in range(9)]
    ceilings, close = sampling.interval_limits(straight, 0.125, LIMITS)
    assert close
    for speed, ((rate, curvature),) in ceilings:
        assert (speed, rate) == pytest.approx((1.0, 0.8 / 30.0), rel=1e-9)
        assert curvature == pytest.approx(0.0, abs=1e-9)
