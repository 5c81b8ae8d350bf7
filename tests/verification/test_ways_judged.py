"""Deviation of a robot from a path: `farthest` and the TCP."""

import math
import random
from functools import lru_cache

import numpy as np
import pytest

from rapidgen.config import load_config
from rapidgen.generate import build, make_system
from rapidgen.verification.path_deviation import farthest, movement, points
from rapidgen.verification.testbench import Bench

LINE = np.array([[n / 1000, 0.0, 0.0] for n in range(401)])
ASIDE = np.array([0.02, 0.0, 0.0])
ROBOTS = (
    "irb120",
    "irb14000",
    "robots/examples/irb460-rw7.yaml",
    "robots/examples/irb910sc-rw6.yaml",
)


@lru_cache
def driver(robot):
    config = load_config(robot)
    return config, make_system(config, build(config))


@pytest.mark.parametrize("robot", ROBOTS)
def test_the_tcp_is_where_the_controller_has_it(robot):
    chance = random.Random(robot)
    with Bench(*driver(robot)) as bench:
        places = [
            tuple(chance.uniform(joint.lower, joint.upper) for joint in bench.group.joints)
            for _ in range(50)
        ]
        wanted = [bench.tcp(place) for place in places]
        assert points(bench, places) == pytest.approx(np.array(wanted), abs=1e-9)
        assert len(points(bench, [])) == 0


def test_the_same_way_is_not_left():
    assert farthest(LINE, LINE) == 0.0
    assert farthest(LINE[::3] + ASIDE / 100, LINE) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("at", [0, 1, 15, 16, 17, 200, 399, 400])
def test_one_place_off_the_path_is_detected(at):
    seen = LINE.copy()
    seen[at, 1] = 0.003
    assert farthest(seen, LINE) == pytest.approx(0.003)


def test_places_before_and_after_the_path_are_off_it():
    assert farthest(LINE - ASIDE, LINE) == pytest.approx(0.02)
    assert farthest(LINE + ASIDE, LINE) == pytest.approx(0.02)


def test_skipped_part_of_the_path_is_detected():
    assert farthest(LINE[[0, 1, 2, *range(300, 401)]], LINE) > 0.1


def test_a_way_that_crosses_itself_is_followed_in_its_order():
    target = np.array([[0.4 - n / 1000, 0.0, 0.0] for n in range(401)])
    adjacent = np.array([[0.4, n / 1000, 0.0] for n in range(201)])
    path = np.concatenate([LINE, adjacent, adjacent[::-1], target])
    assert farthest(np.concatenate([LINE, target]), path) > 0.05


def test_where_one_did_not_move_everything_is_off():
    nothing = np.empty((0, 3))
    assert (farthest(LINE, nothing), farthest(nothing, LINE)) == (math.inf, 0.0)
    assert farthest(LINE, LINE[:1]) == math.inf


def test_a_movement_begins_and_ends_where_the_place_changes():
    track = [(0.0, (0.0,)), (1.0, (0.0,)), (1.5, (1.0,)), (2.0, (2.0,)), (9.0, (2.0,))]
    assert movement(track) == (0.5, [(1.0,), (2.0,)])
    assert movement(track[:2]) == (0.0, [])
