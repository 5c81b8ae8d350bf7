"""Meaning of streaming messages, as plain values: what is understood, and what is ignored."""

import math

import pytest

from rapidgen.config import load_config
from rapidgen.ros.goals import Point
from rapidgen.ros.stream_commands import (
    CommandIgnored,
    CommandReader,
    Hold,
    JointCommand,
    Positions,
    Speeds,
    Spline,
    TrajectoryCommand,
    TwistCommand,
    repeats,
)

GROUP = load_config("irb120").groups[0]
NAMES = tuple(joint.name for joint in GROUP.joints)
READER = CommandReader.of(GROUP)
NOW = 1000.0
SIX = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6)


def twist(frame="base_link", stamp=0.0, values=SIX):
    return TwistCommand(stamp, frame, values)


def path(*points, names=NAMES, stamp=0.0):
    return TrajectoryCommand(names, [Point(*point) for point in points], stamp)


@pytest.mark.parametrize(
    ("command", "reason"),
    [
        (twist(frame=""), "header.frame_id '' is not known"),
        (twist(frame="world"), "it is one of base_link, tool0"),
        (twist(stamp=NOW - 0.2), "0.200 s in the past"),
        (twist(stamp=NOW + 0.2), "0.200 s in the future"),
        (twist(values=(math.nan, 0, 0, 0, 0, 0)), "no finite number"),
        (JointCommand(SIX[:5]), "5 values of position for 6 joints"),
        (JointCommand((*SIX[:5], math.inf)), "no finite number"),
        (JointCommand(SIX, layout=(2, 3)), "several dimensions"),
        (JointCommand(), "has no values"),
        (JointCommand(SIX, names=NAMES[:5]), "missing: joint_6"),
        (JointCommand(SIX, names=(*NAMES[:5], "elbow")), "unknown: elbow"),
        (JointCommand(SIX, names=(*NAMES, "joint_1")), "given twice"),
        (JointCommand(SIX, names=NAMES, stamp=NOW - 1), "1.000 s in the past"),
        (path((1.0, SIX), names=NAMES[:2]), "missing: joint_3"),
        (path((1.0, SIX[:2])), "2 values of positions at point 0"),
        (path((1.0, ())), "point 0 has no positions"),
        (path((1.0, SIX, SIX), (2.0, SIX)), "some points have velocities"),
        (path((1.0, SIX), (1.0, SIX)), "does not increase"),
        (path((-1.0, SIX), (1.0, SIX)), "below 0"),
        (path((math.nan, SIX)), "no finite number"),
        (path((1.0, (*SIX[:5], math.nan))), "no finite number"),
        (path((1.0, SIX), stamp=NOW - 2), "the trajectory ends before now"),
        (path((1.0, SIX), stamp=NOW + 100), "100 s in the future"),
    ],
)
def test_commands_that_are_ignored(command, reason):
    with pytest.raises(CommandIgnored) as caught:
        READER.read("topic", command, NOW)
    assert reason in caught.value.text
    assert caught.value.code == "RG694"


def test_twist_counts_from_its_stamp_or_now():
    assert READER.read("twist_commands", twist(), NOW) == Speeds(NOW, SIX, "base")
    stamped = READER.read("twist_commands", twist("tool0", NOW - 0.05), NOW)
    assert stamped == Speeds(NOW - 0.05, SIX, "flange")
    assert READER.read("twist_commands", twist(stamp=NOW + 0.05), NOW).at == NOW


def test_frames_of_a_group_have_its_prefixes():
    reader = CommandReader.of(GROUP, "left_", "arm_")
    assert reader.read("", twist("left_arm_tool0"), NOW).axes == "flange"
    with pytest.raises(CommandIgnored):
        reader.read("", twist(), NOW)


def test_columns_are_sorted_by_joint_names():
    back = tuple(reversed(NAMES))
    command = JointCommand(SIX, tuple(reversed(SIX)), names=back)
    assert READER.read("", command, NOW) == Positions(NOW, tuple(reversed(SIX)), SIX)
    assert READER.read("", path((1.0, SIX), names=back), NOW).positions == (SIX[::-1],)
    assert READER.read("", JointCommand(SIX, layout=(1, 6)), NOW) == Positions(NOW, SIX)


def test_trajectory_begins_in_the_middle_if_its_stamp_is_past():
    """As joint_trajectory_controller; Servo's messages begin 0.1 s before now."""
    read = READER.read("", path((0.0, SIX), (1.0, SIX), stamp=NOW - 0.25), NOW)
    assert read == Spline((0.0, 1.0), (SIX, SIX), None, 0.25)
    assert READER.read("", path((1.0, SIX), stamp=NOW + 1), NOW).since == -1
    assert READER.read("", path(), NOW) == Hold()


@pytest.mark.parametrize(
    ("request_", "is_silence"),
    [
        (Hold(), True),
        (Speeds(NOW, (0.0,) * 6), True),
        (Speeds(NOW, (0.0,) * 5 + (0.01,)), False),
        (Positions(NOW, SIX), True),
        (Positions(NOW, SIX, (0.01,) * 6), False),
        (Positions(NOW, (0.0,) * 6), False),
        (Spline((0.1, 0.2), (SIX, SIX), ((0.0,) * 6,) * 2, 0.0), True),
        (Spline((0.1, 0.2), (SIX, SIX), ((0.0,) * 6, (0.1,) * 6), 0.0), False),
        (Spline((0.1, 0.2), (SIX, (0.0,) * 6), None, 0.0), False),
    ],
)
def test_repeated_held_position_is_silence(request_, is_silence):
    assert repeats(request_, SIX) is is_silence
