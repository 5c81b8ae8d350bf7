"""Numbers in ROS messages are those of the message definitions."""

import pytest

from rapidgen.ros.goals import Code
from rapidgen.ros.status_messages import Level

NUMBERS = {
    # control_msgs/action/FollowJointTrajectory.
    Code: (
        "SUCCESSFUL 0, INVALID_GOAL -1, INVALID_JOINTS -2, OLD_HEADER_TIMESTAMP -3, "
        "PATH_TOLERANCE_VIOLATED -4, GOAL_TOLERANCE_VIOLATED -5"
    ),
    # diagnostic_msgs/msg/DiagnosticStatus.
    Level: "OK 0, WARN 1, ERROR 2, STALE 3",
}


@pytest.mark.parametrize("kind", NUMBERS, ids=lambda kind: kind.__name__)
def test_numbers_are_those_of_the_definition(kind):
    assert ", ".join(f"{member.name} {member.value}" for member in kind) == NUMBERS[kind]
