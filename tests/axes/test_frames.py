"""Quaternions and poses against their defining properties."""

from math import pi

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rapidgen.axes import frames

angles = st.floats(-pi, pi)
numbers = st.floats(-2, 2)
vectors = st.tuples(numbers, numbers, numbers)


@st.composite
def rotations(draw):
    axis = draw(vectors)
    assume(frames.norm(axis) > 0.1)
    return frames.about(frames.unit(axis), draw(angles))


poses = st.tuples(vectors, rotations())


@given(poses, poses, vectors)
def test_composition_is_one_transform_after_the_other(a, b, v):
    both = frames.transform(frames.compose(a, b), v)
    assert both == pytest.approx(frames.transform(a, frames.transform(b, v)), abs=1e-9)


@given(poses, vectors)
def test_inverse_undoes(p, v):
    assert frames.transform(frames.invert(p), frames.transform(p, v)) == pytest.approx(v, abs=1e-9)


@given(rotations())
def test_matrix_and_back(q):
    back = frames.from_matrix(frames.to_matrix(q))
    assert frames.angle_between(q, back) < 1e-7
    assert back[0] >= 0


@given(angles, st.floats(-1.5, 1.5), angles)
def test_zyx_and_back(z, y, x):
    q = frames.from_zyx(z, y, x)
    by_axes = frames.multiply(
        frames.multiply(frames.about((0, 0, 1), z), frames.about((0, 1, 0), y)),
        frames.about((1, 0, 0), x),
    )
    assert q == pytest.approx(by_axes, abs=1e-12)
    assert frames.angle_between(frames.from_zyx(*frames.to_zyx(q)), q) < 1e-7


def test_zyx_straight_up_keeps_the_rotation():
    q = frames.from_zyx(0.4, pi / 2, 0.1)
    assert frames.angle_between(frames.from_zyx(*frames.to_zyx(q)), q) < 1e-7


@given(rotations(), rotations(), st.floats(0, 1))
def test_slerp_turns_at_an_even_rate(a, b, fraction):
    complete = frames.angle_between(a, b)
    assume(complete < pi - 1e-3)
    part = frames.angle_between(a, frames.slerp(a, b, fraction))
    assert part == pytest.approx(fraction * complete, abs=1e-6)
