"""Stamps are the controller's moments, whatever the network does to the messages."""

import random

import numpy as np
import pytest

from rapidgen.ros.time_stamps import RosTimeEstimator


def test_spacing_is_the_controllers():
    draw, stamps = random.Random(1), RosTimeEstimator()
    report = [stamps.stamp(n * 0.02, 1000 + n * 0.02 + draw.expovariate(200)) for n in range(2000)]
    spacing = np.diff(report[500:]) * 1e-9
    # p99 within 5 % of the period, where messages come up to 30 ms late
    assert np.quantile(np.abs(spacing - 0.02), 0.99) < 0.05 * 0.02


def test_never_later_than_received_and_never_backwards():
    draw, stamps = random.Random(2), RosTimeEstimator()
    last = 0
    for n in range(500):
        received = 50 + n * 0.1 + draw.random() * 0.05
        stamp = stamps.stamp(n * 0.1 * (1 + 2e-5), received)
        assert last < stamp <= received * 1e9 + 1
        last = stamp


def test_drift_is_followed():
    """A quartz that is 50 ppm slow: after an hour stamps are still of now."""
    stamps = RosTimeEstimator()
    for n in range(36_000):
        stamp = stamps.stamp(n * 0.1, 7 + n * 0.1 * (1 + 5e-5))
    assert stamp * 1e-9 == pytest.approx(7 + 3599.9 * (1 + 5e-5), abs=0.01)


def test_a_clock_that_begins_again():
    stamps = RosTimeEstimator()
    before = stamps.stamp(800.0, 10.0)
    after = stamps.stamp(0.5, 10.1)
    assert before < after <= 10.1e9
    # simulated ROS time that was reset
    assert stamps.stamp(0.6, 1.0) == pytest.approx(1e9)


def test_a_simulators_clock_goes_at_its_own_speed():
    """Four times as fast as this machine, and continued after a restart."""
    stamps = RosTimeEstimator(is_clock=True)
    report = [stamps.stamp(n * 0.02, 1000 + n * 0.005) for n in range(200)]
    assert np.diff(report) * 1e-9 == pytest.approx(0.02)
    assert report[0] == 1000 * 10**9
    again = stamps.stamp(0.0, 1100.0)
    assert 0 < again - report[-1] < 10**6
    assert stamps.stamp(0.02, 1100.005) - again == pytest.approx(0.02e9, rel=1e-3)
