"""Offset wrists: all postures, and the one nearby."""

import math
import random

import pytest

from rapidgen.axes import frames
from rapidgen.axes.kinematics import Kinematics
from rapidgen.config import load_config


@pytest.fixture(scope="module")
def gofa():
    return Kinematics.of(load_config("crb15000").groups[0])


def postures(own, count, seed):
    draw = random.Random(seed)
    return [tuple(draw.uniform(j.lower, j.upper) for j in own.group.joints) for _ in range(count)]


def near_target(one, other):
    return max(abs(math.remainder(a - b, 2 * math.pi)) for a, b in zip(one, other, strict=True))


def test_every_posture_is_among_those_of_its_pose(gofa):
    for posture in postures(gofa, 300, seed=1):
        pose = gofa.forward(posture)
        result = gofa.solutions(pose, (0.0,) * 6)
        assert min(near_target(posture, other) for other in result) < 1e-5
        for other in result:
            assert max(map(abs, frames.error(gofa.forward(other), pose))) < 1e-9


def test_iteration_knows_no_posture_more(gofa):
    # Newton's method from some thousand starts, which knows nothing of the wrist.
    for posture in postures(gofa, 6, seed=2):
        pose = gofa.forward(posture)
        result = gofa.solutions(pose, (0.0,) * 6)
        for others in gofa.arm.rounds(pose, posture):
            for other in others:
                inside = any(True for _ in gofa._turned(other))
                assert not inside or min(near_target(other, one) for one in result) < 1e-5


@pytest.mark.parametrize("elbow", [-76.5, -77.1])
def test_postures_by_the_stretched_elbow_are_found(gofa, elbow):
    # There the reach ends, and two of four branches meet.
    for posture in postures(gofa, 40, seed=3):
        stretched = (*posture[:2], math.radians(elbow), *posture[3:])
        result = gofa.solutions(gofa.forward(stretched), (0.0,) * 6)
        assert min(near_target(stretched, other) for other in result) < 1e-4


def test_a_posture_nearby_stays_on_its_branch(gofa):
    draw = random.Random(4)
    for posture in postures(gofa, 200, seed=4):
        start = tuple(v + draw.uniform(-0.01, 0.01) for v in posture)
        result = gofa.follow(gofa.forward(posture), start)
        assert result is not None
        assert max(map(abs, frames.error(gofa.forward(result), gofa.forward(posture)))) < 1e-8
        assert near_target(result, posture) < 0.3


def test_out_of_reach_there_is_none(gofa):
    assert gofa.solutions(((1.2, 0.3, 0.2), frames.UNIT), (0.0,) * 6) == []
    assert next(gofa.beyond(((1.2, 0.3, 0.2), frames.UNIT), (0.0,) * 6), None) is None
