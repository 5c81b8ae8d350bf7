"""Validation of a goal: names in any order, tolerances, stamps, defaults.

The meaning of 0 and -1 is joint_trajectory_controller's.
"""

import math
from dataclasses import replace

import numpy as np
import pytest

from rapidgen.ros.goals import Code, Defaults, Goal, GoalRefused, Point, Tolerance, validate_goal

NAMES = ("a", "b", "c")
GOAL = Goal(
    ("c", "a", "b"),
    [Point(0.0, [3.0, 1.0, 2.0]), Point(1.5, [3.3, 1.1, 2.2])],
    goal_time_tolerance=0.0,
)
DEFAULTS = Defaults(path=0.5, goal=0.02, goal_time=4.0, late=0.2)
INF = math.inf


def judged(**changes):
    return validate_goal(replace(GOAL, **changes), NAMES, DEFAULTS, now=100.0)


def test_columns_are_in_the_order_of_the_robot():
    moving = [
        replace(GOAL.points[0], velocities=[30.0, 10.0, 20.0]),
        replace(GOAL.points[1], velocities=[0.0, 0.0, 0.0]),
    ]
    result = judged(points=moving)
    assert result.trajectory.names == NAMES
    assert result.trajectory.times.tolist() == [0.0, 1.5]
    assert result.trajectory.positions.tolist() == [[1.0, 2.0, 3.0], [1.1, 2.2, 3.3]]
    assert result.velocities.tolist() == [[10.0, 20.0, 30.0], [0.0] * 3]
    assert judged().velocities is None
    assert (judged().start, judged().notes) == (None, ())


def test_each_point_may_have_velocities_or_none():
    """joint_trajectory_controller checks point by point, not the trajectory (R5)."""
    started = judged(points=[replace(GOAL.points[0], velocities=[30.0, 10.0, 20.0]), LAST])
    assert started.velocities.tolist() == [[10.0, 20.0, 30.0], [0.0] * 3]
    ended = judged(points=[GOAL.points[0], replace(LAST, velocities=[0.0] * 3)])
    assert ended.velocities.tolist() == [[0.0] * 3] * 2


@pytest.mark.parametrize(
    ("requested", "position", "velocity"),
    [
        ([], [0.5, 0.5, 0.5], [INF] * 3),
        ([Tolerance("b", 0.1, 0.3)], [0.5, 0.1, 0.5], [INF, 0.3, INF]),
        ([Tolerance("b"), Tolerance("c", -1.0, -1.0)], [0.5, 0.5, INF], [INF] * 3),
    ],
)
def test_a_tolerance_is_of_its_joint_0_the_default_and_minus_1_none(requested, position, velocity):
    path = judged(path_tolerance=requested)
    assert (path.path.tolist(), path.path_velocity.tolist()) == (position, velocity)
    assert path.goal.tolist() == [0.02] * 3
    end = judged(goal_tolerance=requested)
    assert end.goal.tolist() == [0.02 if value == 0.5 else value for value in position]
    assert end.goal_velocity.tolist() == velocity
    assert end.path.tolist() == [0.5] * 3


@pytest.mark.parametrize(("requested", "result"), [(0.0, 4.0), (-1.0, INF), (0.7, 0.7)])
def test_the_time_that_a_goal_may_be_late(requested, result):
    assert judged(goal_time_tolerance=requested).goal_time == result


@pytest.mark.parametrize(("stamp", "start"), [(0.0, None), (99.8, 99.8), (120.0, 120.0)])
def test_a_stamp_is_when_it_starts(stamp, start):
    assert judged(stamp=stamp).start == start


def test_what_cannot_be_looked_at_is_noted():
    pushed = [replace(GOAL.points[0], effort=[1.0] * 3), GOAL.points[1]]
    (effort,) = judged(points=pushed).notes
    (acceleration,) = judged(goal_tolerance=[Tolerance("a", acceleration=0.1)]).notes
    assert ("effort" in effort, "acceleration" in acceleration) == (True, True)
    assert judged(path_tolerance=[Tolerance("a", acceleration=-1.0)]).notes == ()


LAST = GOAL.points[1]


@pytest.mark.parametrize(
    ("changes", "code", "text"),
    [
        ({"stamp": 99.7}, Code.OLD_HEADER_TIMESTAMP, "0.300 s in the past"),
        ({"goal_time_tolerance": -0.5}, Code.INVALID_GOAL, "goal_time_tolerance is -0.5"),
        ({"goal_time_tolerance": INF}, Code.INVALID_GOAL, "goal_time_tolerance is inf"),
        (
            {"goal_tolerance": [Tolerance("c", acceleration=-2.0)]},
            Code.INVALID_GOAL,
            "goal_tolerance of c is -2",
        ),
        (
            {"path_tolerance": [Tolerance("d", 0.1)]},
            Code.INVALID_GOAL,
            "path_tolerance names 'd'",
        ),
        (
            {"points": [replace(GOAL.points[0], time=-0.1), LAST]},
            Code.INVALID_GOAL,
            "below 0 or no number",
        ),
        (
            {"points": [GOAL.points[0], replace(LAST, time=0.0)]},
            Code.INVALID_GOAL,
            "at point 1: 0 s, then 0 s",
        ),
        (
            {"points": [GOAL.points[0], replace(LAST, positions=[1.0, math.nan, 1.0])]},
            Code.INVALID_GOAL,
            "point 1 has positions that are no numbers",
        ),
        (
            {"points": [GOAL.points[0], replace(LAST, velocities=[0.0] * 2)]},
            Code.INVALID_GOAL,
            "point 1 has 2 velocities for 3 joints",
        ),
        (
            {"points": [replace(LAST, velocities=[-0.2, 0.0, 0.0])]},
            Code.INVALID_GOAL,
            "velocity (c -0.2)",
        ),
        ({"names": ("a", "b", "b")}, Code.INVALID_JOINTS, "missing: c; twice: b"),
    ],
)
def test_a_goal_that_is_none(changes, code, text):
    with pytest.raises(GoalRefused) as refused:
        judged(**changes)
    assert refused.value.outcome.code is code
    assert text in refused.value.outcome.text


@pytest.mark.parametrize(
    ("time", "positions", "velocities"),
    [
        (-1.0, [1.0, 2.0, 3.0], [0.0] * 3),
        (0.75, [1.05, 2.1, 3.15], [0.1 / 1.5, 0.2 / 1.5, 0.2]),
        (0.0, [1.0, 2.0, 3.0], [0.1 / 1.5, 0.2 / 1.5, 0.2]),
        (1.5, [1.1, 2.2, 3.3], [0.0] * 3),
        (9.0, [1.1, 2.2, 3.3], [0.0] * 3),
    ],
)
def test_what_is_desired_at_a_moment(time, positions, velocities):
    result = judged()
    assert np.allclose(result.desired(time), positions)
    assert np.allclose(result.desired_velocity(time), velocities)


@pytest.mark.parametrize(
    ("defaults", "changes", "watched"),
    [
        (Defaults(), {}, False),
        (Defaults(path=0.1), {}, True),
        (Defaults(), {"path_tolerance": [Tolerance("b", velocity=0.1)]}, True),
        (Defaults(), {"path_tolerance": [Tolerance("b", -1.0)]}, False),
        (Defaults(), {"goal_tolerance": [Tolerance("b", 0.1)]}, False),
    ],
)
def test_whether_the_way_is_watched(defaults, changes, watched):
    assert validate_goal(replace(GOAL, **changes), NAMES, defaults, 0.0).watches_path is watched
