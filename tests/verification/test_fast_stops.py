"""A driver recovers after a stop at speed off its path; others are detected."""

from functools import cache

import pytest

from rapidgen.config import load_config
from rapidgen.generate import build, make_system
from rapidgen.verification.fast_stops import FAST, fast_stop
from rapidgen.verification.settings import assumed
from rapidgen.verification.testbench import Bench, with_module
from rapidgen.verification.worker_pool import run_in_fork


@cache
def booted(robot, *texts, stuck=False, overrides=()):
    config = load_config(robot, overrides=overrides)
    system = make_system(config, build(config))
    if stuck:
        # A halt that is never answered is in force for ever.
        module = next(m for t in system.tasks for m in t.modules if m.name == "ROS_motion")
        assert module.data.count(b"ROS_abort_done := asked;") == 1
        without = module.data.replace(b"ROS_abort_done := asked;", b"")
        system = with_module(system, module.path, without)
    bench = Bench(config, system, assumed(("schedule=random", *texts)))
    bench.compile()
    bench.run(0.5)
    return bench


def stopped(seed, *texts, robot="irb120", stuck=False, overrides=()):
    bench = booted(robot, *texts, stuck=stuck, overrides=overrides)
    return run_in_fork(lambda: fast_stop(bench, seed))


@pytest.mark.parametrize("robot", ["irb120", "irb6700", "irb14000"])
def test_a_driver_goes_on(robot):
    stops = [stopped(seed, robot=robot) for seed in range(12)]
    assert [stop.finding for stop in stops if stop.finding] == []
    assert {stop.action for stop in stops} == {"e-stop", "power-loss"}
    assert min(stop.share for stop in stops) >= FAST
    assert sum(stop.off_path > 0.01 for stop in stops) >= len(stops) / 3


def test_a_robot_half_a_metre_off_is_started_from_main():
    # A slow robot: at the accelerations of its class it would be 0.13 m.
    stop = stopped(51, robot="irb6700", overrides=("acceleration_time=0.5",))
    assert stop.off_path > 0.5
    assert (stop.from_main, stop.finding) == (True, "")


@pytest.mark.parametrize("seed", [0, 2])
def test_a_driver_that_is_stuck_is_found(seed):
    assert "not within 15 s" in stopped(seed, stuck=True).finding


@pytest.mark.parametrize("seed", [0, 2])
def test_an_emergency_stop_on_the_path_does_no_harm(seed):
    stop = stopped(seed, "emergency_stop=path")
    assert (stop.action, stop.off_path, stop.finding) == ("e-stop", 0, "")
    assert stop.share >= FAST


def test_a_seed_does_the_same_again():
    assert stopped(3) == stopped(3)
    assert stopped(3) != stopped(4)
