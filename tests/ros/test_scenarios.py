"""A short form of `make ros-goals`: no hang, no wrong SUCCEEDED."""

import pytest
from scenarios import play


@pytest.mark.parametrize("seed", range(12))
def test_goals_by_lot(seed):
    result = play(seed)
    assert result.wrong == []
    assert sum(result.ends.values()) == 3
