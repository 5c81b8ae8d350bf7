"""Times under limits, resampling, thinning."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst

from rapidgen.axes.timing import decimate, limit_usage, parametrise, resample, slow_down

SPEED = np.array([3.0, 2.0])
ACCELERATION = np.array([8.0, 5.0])
waypoints = st.integers(2, 30).flatmap(
    lambda n: npst.arrays(np.float64, (n, 2), elements=st.floats(-3, 3, width=32))
)


@settings(max_examples=60)
@given(waypoints)
def test_limits_hold_and_times_increase(points):
    times = parametrise(points, SPEED, ACCELERATION)
    assert (np.diff(times) > 0).all()
    assert limit_usage(times, points, SPEED, ACCELERATION).worst <= 1 + 1e-9


def test_a_straight_line_is_as_fast_as_its_trapezoid():
    line = np.linspace([0, 0], [1.0, 0.0], 101)
    times = parametrise(line, SPEED, ACCELERATION)
    fastest = 2 * np.sqrt(1.0 / 8.0)  # never reaches 3 rad/s
    assert times[-1] == pytest.approx(fastest, rel=0.01)


def test_one_segment_has_both_ramps():
    times = parametrise(np.array([[0.0, 0], [1.0, 0]]), SPEED, ACCELERATION)
    assert times[-1] == pytest.approx(2 * np.sqrt(1.0 / 8.0))


def test_slow_down_stretches_as_little_as_needed_and_else_not():
    points = np.array([[0.0, 0], [1.0, 0], [2.0, 0]])
    slow = np.array([0.0, 10.0, 20.0])
    assert slow_down(slow, points, SPEED, ACCELERATION) is not None
    assert slow_down(slow, points, SPEED, ACCELERATION) == pytest.approx(slow)
    fast = slow_down(slow / 100, points, SPEED, ACCELERATION)
    assert limit_usage(fast, points, SPEED, ACCELERATION).worst == pytest.approx(1.0)


@settings(max_examples=40)
@given(waypoints, st.floats(0.01, 2.0))
def test_resampling_keeps_the_ends_and_stays_inside(points, period):
    times = parametrise(points, SPEED, ACCELERATION)
    fresh, values = resample(times, points, period)
    assert fresh[0] == times[0]
    assert fresh[-1] == pytest.approx(times[-1])
    assert values[0] == pytest.approx(points[0])
    assert values[-1] == pytest.approx(points[-1])
    assert (values >= points.min(axis=0) - 1e-9).all()
    assert (values <= points.max(axis=0) + 1e-9).all()


def test_decimate_drops_only_points_on_the_path():
    times = np.arange(7) * 0.02
    points = np.array([[0, 0], [1, 0], [2, 0], [3, 0], [3, 1], [3, 2], [3, 3]], dtype=float)
    saved = decimate(times, points, 0.05, 1e-6)
    assert saved.tolist() == [0, 3, 6]
    assert decimate(times, points, 0.2, 1e-6).tolist() == [0, 3, 6]
    assert decimate(times, points, 0.2, 2.0).tolist() == [0, 6]


def test_times_must_increase():
    with pytest.raises(ValueError, match="increase"):
        limit_usage(np.array([0.0, 0.0]), np.zeros((2, 2)), SPEED, ACCELERATION)


def test_no_segment_is_shorter_than_the_period():
    random = np.random.default_rng(1)
    for complete in [*random.uniform(0.1, 3, 200), *np.arange(1, 40) * 0.1]:
        fresh, _ = resample(np.array([0, complete]), np.zeros((2, 1)), 0.1)
        assert np.diff(fresh).min() >= 0.1 - 1e-6
        assert np.diff(fresh).max() < 0.2
