"""Permission and trajectories that have run on a real host before."""

import pytest

from rapidgen.client import Trajectory
from rapidgen.client.address import Address
from rapidgen.client.permission import FIRST_SPEED, first_speed, remember

REAL = Address("192.0.2.1")
PATH = Trajectory.from_points([[0.0] * 6, [0.1] * 6], seconds=1.0)


@pytest.fixture
def state(tmp_path, monkeypatch):
    """The user's state folder, not yet created."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "not" / "there"))
    return tmp_path / "not" / "there" / "rapidgen"


@pytest.mark.parametrize("is_made", [False, True])
def test_every_trajectory_that_ran_on_a_host_is_remembered(state, is_made):
    if is_made:
        state.mkdir(parents=True)
    paths = [PATH, PATH.scaled(2), Trajectory(PATH.times, PATH.positions, list("abcdef"))]
    for path in paths:
        assert first_speed(REAL, path) == FIRST_SPEED
        remember(REAL, path)
    assert {first_speed(REAL, path) for path in paths} == {1.0}
    assert first_speed(Address("192.0.2.2"), PATH) == FIRST_SPEED


def test_what_is_made_on_the_spot_is_slow_on_a_real_host_only(state):
    assert first_speed(REAL, None) == FIRST_SPEED
    assert first_speed(Address("127.0.0.1"), None) == 1.0


def test_a_memory_that_cannot_be_read_remembers_nothing(state):
    state.mkdir(parents=True)
    (state / "moved").write_bytes(b"\xff\n")
    assert first_speed(REAL, PATH) == FIRST_SPEED
