"""Stops at speed are what they are called, and are judged."""

from functools import cache

import pytest

from rapidgen.config import load_config
from rapidgen.generate import build, make_system
from rapidgen.proving.bench import Bench
from rapidgen.proving.fast_stops import FAST, fast_stop
from rapidgen.proving.settings import assumed
from rapidgen.proving.workers import in_a_fork


@cache
def booted(*texts):
    config = load_config("irb120")
    bench = Bench(config, make_system(config, build(config)), assumed(texts))
    bench.compile()
    bench.run(0.5)
    return bench


def stopped(seed, *texts):
    bench = booted("schedule=random", *texts)
    return in_a_fork(lambda: fast_stop(bench, seed))


@pytest.mark.parametrize("seed", [0, 2])
def test_an_emergency_stop_on_the_path_does_no_harm(seed):
    stop = stopped(seed, "emergency_stop=path")
    assert (stop.action, stop.off_path, stop.finding) == ("e-stop", 0, "")
    assert stop.share >= FAST


def test_the_brakes_lead_off_the_path():
    assert all(stopped(seed).off_path > 0.01 for seed in range(4))


def test_a_seed_does_the_same_again():
    assert stopped(3) == stopped(3)
    assert stopped(3) != stopped(4)
