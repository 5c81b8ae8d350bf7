"""What is refused, with which reason, point and joint."""

import math

import pytest

from tests.generate.bench import close_to, point, trajectory
from tests.generate.driving import (
    BAD_DURATION,
    CAPACITY,
    FIVE,
    GAP,
    LIMIT,
    NO_START,
    NOT_FINITE,
    PADDING,
    SECONDS,
    SHORT,
    START,
    TOO_FAST,
    assert_refused,
    move_well,
    reply_of,
    send_all,
)


def test_too_many_points(bench):
    """R1: abb_driver drops what is above 100 and moves along the rest."""
    b = bench(overrides=["trajectory.capacity=100"])
    client = b.client()
    points = [[0.001 * n] * 6 for n in range(101)]
    send_all(client, trajectory(points, [10.0] + [0.2] * 100))
    assert_refused(b, client, CAPACITY, 100)
    send_all(client, trajectory(points[:100], [10.0] + [0.2] * 99))
    assert reply_of(client) == (1, (2,))


def test_a_hole_in_the_sequence(bench):
    """C4: a client that fails to send a point goes on with the next."""
    b = bench()
    client = b.client()
    frames = trajectory(FIVE, SECONDS)
    send_all(client, frames[:2] + frames[3:])
    assert_refused(b, client, GAP, 2)
    move_well(b, client)


@pytest.mark.parametrize("sequence", [0, -5, 1, 3, 2**31 - 1, -(2**31)])
def test_a_wrong_number_in_the_sequence(bench, sequence):
    b = bench()
    client = b.client()
    frames = trajectory(FIVE, SECONDS)
    frames[2] = point(sequence, FIVE[2], 1.0)
    send_all(client, frames)
    assert_refused(b, client, GAP, 2)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("place", [0, 2, 4])
def test_a_joint_that_is_no_number(bench, value, place):
    b = bench()
    client = b.client()
    points = [list(p) for p in FIVE]
    points[place][3] = value
    send_all(client, trajectory(points, SECONDS))
    assert_refused(b, client, NOT_FINITE, place, 4)


@pytest.mark.parametrize("value", [math.nan, math.inf])
@pytest.mark.parametrize("place", [0, 2, 4])
def test_a_duration_that_is_no_number(bench, value, place):
    b = bench()
    client = b.client()
    durations = list(SECONDS)
    durations[place] = value
    send_all(client, trajectory(FIVE, durations))
    assert_refused(b, client, NOT_FINITE, place)


@pytest.mark.parametrize("value", [0.0, -1.0, 4000.0])
def test_a_bad_duration(bench, value):
    """R10"""
    b = bench()
    client = b.client()
    send_all(client, trajectory(FIVE, [10, 1, value, 1, 1]))
    assert_refused(b, client, BAD_DURATION, 2)


@pytest.mark.parametrize("joint", range(6))
@pytest.mark.parametrize("side", ["lower", "upper"])
def test_a_joint_outside_its_limits(bench, joint, side):
    b = bench()
    limit = getattr(b.config.groups[0].joints[joint], side)
    client = b.client()
    points = [list(p) for p in FIVE]
    points[3][joint] = limit + math.copysign(0.001, limit)
    send_all(client, trajectory(points, [10] + [60] * 4))
    assert_refused(b, client, LIMIT, 3, joint + 1)


@pytest.mark.parametrize("joint", range(6))
def test_a_start_too_far_from_the_robot(bench, joint):
    """R8: abb_driver drives there slowly and says nothing."""
    b = bench()
    client = b.client()
    points = [list(p) for p in FIVE]
    points[0][joint] = 0.02
    send_all(client, trajectory(points, SECONDS))
    assert_refused(b, client, START, 0, joint + 1)


def test_a_start_within_tolerance_is_reached_first(bench):
    b = bench()
    client = b.client()
    points = [[0.005] * 6, *FIVE[1:]]
    send_all(client, trajectory(points, SECONDS))
    assert reply_of(client)[0] == 1
    assert b.vc.run_until(lambda: b.pers("ROS_reached") == 1, timeout=1)
    assert close_to(b.joints(), points[0], 1e-3)


@pytest.mark.parametrize("joint", range(6))
def test_more_speed_than_an_axis_has(bench, joint):
    b = bench()
    speed = b.config.groups[0].joints[joint].speed
    client = b.client()
    points = [[0.0] * 6, [0.0] * 6, [0.0] * 6]
    points[1][joint] = 1.0
    points[2][joint] = 1.1
    send_all(client, trajectory(points, [10, 0.98 / speed, 1]))
    assert_refused(b, client, TOO_FAST, 1, joint + 1)


def test_more_speed_than_an_axis_has_slowed_down(bench):
    b = bench(overrides=["trajectory.too_fast=slow_down"])
    client = b.client()
    send_all(
        client, trajectory([[0] * 6, [1.0, 0, 0, 0, 0, 0], [1.1, 0, 0, 0, 0, 0]], [10, 0.1, 1])
    )
    assert reply_of(client) == (1, (1,))
    b.vc.run_for(4)
    assert b.joints()[0] == pytest.approx(1.1, abs=1e-5)
    assert any("slowed down" in str(e) for e in b.vc.log)


def test_a_segment_too_short_for_the_planner(bench):
    b = bench()
    client = b.client()
    send_all(client, trajectory(FIVE, [10, 1, 0.05, 1, 1]))
    assert_refused(b, client, SHORT, 2)


def test_the_last_segment_may_be_short(bench):
    b = bench()
    client = b.client()
    points = [[0] * 6, [0.1] * 6, [0.105] * 6]
    send_all(client, trajectory(points, [10, 1, 0.05]))
    assert reply_of(client)[0] == 1
    b.vc.run_for(3)
    assert close_to(b.joints(), points[-1], 1e-5)


@pytest.mark.parametrize("joint", [7, 8, 9, 10])
@pytest.mark.parametrize("value", [0.5, math.nan, -1e-30])
def test_a_joint_that_the_robot_does_not_have(bench, joint, value):
    b = bench()
    client = b.client()
    points = [[*p, 0, 0, 0, 0] for p in FIVE]
    points[2][joint - 1] = value
    send_all(client, trajectory(points, SECONDS))
    assert_refused(b, client, PADDING, 2, joint)


def test_minus_zero_is_zero(bench):
    b = bench()
    client = b.client()
    send_all(client, trajectory([[*p, -0.0, 0, -0.0, -0.0] for p in FIVE], SECONDS))
    assert reply_of(client)[0] == 1


@pytest.mark.parametrize("sequence", [1, 7, -3, -2, 0])
def test_points_without_a_start(bench, sequence):
    b = bench()
    client = b.client()
    client.send(point(sequence, FIVE[0], 1.0, comm=2))
    assert reply_of(client) == (2, (NO_START, 0, 0))
    b.vc.run_for(1)
    assert b.joints() == (0.0,) * 6
    move_well(b, client)


def test_the_first_fault_counts_and_the_rest_is_skipped(bench):
    b = bench()
    client = b.client()
    frames = trajectory([FIVE[0], [9.0] * 6, [math.nan] * 6, *FIVE[3:]], SECONDS)
    send_all(client, frames)
    assert_refused(b, client, LIMIT, 1, 1)
    move_well(b, client)


def test_a_refusal_is_said_once_on_the_pendant(bench):
    """R19: lines are rationed."""
    b = bench()
    client = b.client()
    for _ in range(20):
        send_all(client, trajectory([[1.0] * 6, [1.1] * 6], [10, 5]))
        assert reply_of(client)[0] == 2
    warnings = [e for e in b.vc.log if "ROS: trajectory refused" in str(e)]
    assert 1 <= len(warnings) <= 1 + b.vc.now
    b.vc.run_for(2)
    send_all(client, trajectory([[1.0] * 6, [1.1] * 6], [10, 5]))
    reply_of(client)
    last = str([e for e in b.vc.log if "ROS: trajectory refused" in str(e)][-1])
    assert "too far" in last
    assert "more like it" in last
