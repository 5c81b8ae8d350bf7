"""`robot.data`: a mapping over what is read and written at the robot."""

import pytest

from rapidgen.client import NotSupported, Robot
from rapidgen.client.own_data import RobotData


def test_it_is_a_mapping_that_is_read_and_written_at_the_robot():
    held = {"cell:count": 3.0, "cell:recipe": "none"}
    data = RobotData(tuple(held), held.__getitem__, held.__setitem__)
    data["cell:count"] = 4.0
    assert dict(data) == held == {"cell:count": 4.0, "cell:recipe": "none"}
    assert "cell:recipe" in data
    assert "cell:nobody" not in data
    assert len(data) == 2


def test_without_a_connection_nothing_is_asked():
    robot = Robot("irb120")
    with pytest.raises(NotSupported, match="lists no datum"):
        robot.data["cell:count"]
