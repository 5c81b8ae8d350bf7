"""Every reachable pose within the ranges is found, from far away."""

import random

import pytest

from rapidgen.axes import frames
from rapidgen.axes.kinematics import Kinematics
from rapidgen.config import load_config, shipped_names

GROUPS = [
    pytest.param(g, id=f"{name}-{g.name}")
    for name in shipped_names()
    for g in load_config(name).groups
]


@pytest.mark.parametrize("group", GROUPS)
def test_a_reachable_pose_is_found_from_afar(group):
    own = Kinematics.of(group)
    draw = random.Random(11)
    for _ in range(60):
        posture = tuple(draw.uniform(j.lower, j.upper) for j in group.joints)
        pose = own.forward(posture)
        start = tuple(
            (j.lower + j.upper) / 2 if j.axis.startswith("rax") else v
            for j, v in zip(group.joints, posture, strict=True)
        )
        result = own.solutions(pose, start)
        assert result
        for other in result[:2]:
            assert max(map(abs, frames.error(own.forward(other), pose))) < 1e-6
            for value, joint in zip(other, group.joints, strict=True):
                assert joint.lower - 1e-5 <= value <= joint.upper + 1e-5


@pytest.mark.parametrize("name", ["irb460", "irb660", "irb910sc"])
def test_four_axes_have_a_closed_form_with_every_branch(name):
    own = Kinematics.of(load_config(name).groups[0])
    assert own.is_closed_form
    draw = random.Random(12)
    most = 0
    for _ in range(200):
        posture = tuple(draw.uniform(j.lower, j.upper) for j in own.group.joints)
        pose = own.forward(posture)
        assert own.follow(pose, posture) == pytest.approx(posture, abs=1e-9)
        most = max(most, len(own.solutions(pose, posture)))
    assert most > 1


@pytest.mark.parametrize("name", ["irb460", "irb910sc"])
def test_four_axes_cannot_tilt(name):
    own = Kinematics.of(load_config(name).groups[0])
    posture = tuple((j.lower + j.upper) / 2 for j in own.group.joints)
    place, q = own.forward(posture)
    tilted = place, frames.multiply(frames.about((1.0, 0.0, 0.0), 0.01), q)
    assert own.solutions(tilted, posture) == []
    assert own.follow(tilted, posture) is None
    assert not any(own.beyond(tilted, posture))
