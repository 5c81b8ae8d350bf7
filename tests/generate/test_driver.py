"""The driver on the virtual controller: every promise of docs/driver.md, driven with bytes.

R1..R20 are the faults of abb_driver's modules that a promise answers.
"""

import math
import struct
from dataclasses import replace
from pathlib import Path

import pytest

from rapidgen.virtual.controller import VirtualController
from tests.generate.bench import POINT, STOP, close_to, point, trajectory

FIVE = [[0.0] * 6, [0.1] * 6, [0.2] * 6, [0.3] * 6, [0.25] * 6]
SECONDS = [10.0, 1.0, 1.0, 1.0, 1.0]
LONG = [[0.001 * n] * 6 for n in range(300)]
NO_REPLY = 0.3

CAPACITY, GAP, NOT_FINITE, LIMIT, START, TOO_FAST = 1, 2, 3, 4, 5, 6
BAD_DURATION, SHORT, NO_START, INCOMPLETE, FRAMING = 8, 9, 10, 11, 12
PADDING, NOT_EXECUTING, MOTORS, E_STOP, MIXED = 14, 20, 21, 22, 24
STOPPED, SUPERSEDED, CLIENT_LOST, PROGRAM, COLLISION, POWER, MODE = 40, 41, 42, 43, 45, 46, 47
RECEIVING, MOVING, DONE, REFUSED, FAILED, STOPPED_STATE = 1, 2, 3, 4, 5, 6


def reply_of(client):
    """(reply code, data as int32) of the next frame, which must be a reply to a point."""
    frame = client.wait_frame()
    assert frame is not None, "no reply"
    _, kind, comm, code = struct.unpack_from("<4i", frame)
    assert (kind, comm) == (11, 3)
    return code, struct.unpack(f"<{(len(frame) - 16) // 4}i", frame[16:])


def send_all(client, frames):
    client.send(b"".join(frames))


def assert_refused(bench, client, reason, index, joint=0):
    before = bench.joints()
    assert reply_of(client) == (2, (reason, index, joint))
    state = bench.state_client()
    status = bench.status(state)
    assert status[2:4] == (reason + 100 * joint, 1)
    bench.vc.run_for(2)
    assert bench.joints() == before
    assert bench.healthy()


def move_well(bench, client=None):
    """A good trajectory from where the robot stands is executed to its end."""
    client = client or bench.client()
    here = list(bench.joints())
    there = [v + 0.02 for v in here]
    send_all(client, trajectory([here, there], [10, 0.5]))
    code, data = reply_of(client)
    assert code == 1, data
    bench.vc.run_for(2)
    assert close_to(bench.joints(), there)
    assert bench.healthy()
    return client


# -- what is executed -------------------------------------------------------------------------


def test_a_trajectory_is_executed(bench):
    b = bench()
    client, state = b.client(), b.state_client()
    b.vc.run_for(0.2)
    send_all(client, trajectory(FIVE, SECONDS))
    start = b.vc.now
    assert reply_of(client) == (1, (1,))
    assert b.status(state)[4] == 1
    assert b.vc.run_until(lambda: b.pers("ROS_done") == 1, timeout=10)
    # The first point's 10 s are no wait (R8): four seconds of motion and little more.
    assert 4.0 <= b.vc.now - start < 4.6
    assert close_to(b.joints(), FIVE[-1], 1e-5)
    b.vc.run_for(0.3)
    assert b.status(state) == (1, 0, 0, 0, 0, 2, 1)


def test_points_as_topics_are_not_answered(bench):
    b = bench()
    client = b.client()
    send_all(client, trajectory(FIVE, SECONDS, request=False))
    assert client.wait_frame(timeout=6) is None
    assert close_to(b.joints(), FIVE[-1], 1e-5)


def test_state_is_joint_and_status_as_topics(bench):
    b = bench()
    state = b.state_client()
    joint, status = state.wait_frame(), state.wait_frame()
    assert joint == struct.pack("<4ii10f", 56, 10, 1, 0, 0, *[0.0] * 10)
    assert status == struct.pack("<4i7i", 40, 13, 1, 0, 1, 0, 0, 0, 0, 2, 1)


def test_nothing_moves_before_the_end_frame(bench):
    b = bench()
    client = b.client()
    frames = trajectory(FIVE, SECONDS)
    send_all(client, frames[:-1])
    b.vc.run_for(3)
    assert b.joints() == (0.0,) * 6
    client.send(frames[-1])
    assert reply_of(client)[0] == 1


@pytest.mark.parametrize("size", [1, 3, 67, 69, 1000, 100_000])
def test_any_split_and_merge_of_the_stream(bench, size):
    """R2: TCP cuts where it likes."""
    b = bench()
    client = b.client()
    data = b"".join(trajectory(FIVE, [10, 0.5, 0.5, 0.5, 0.5]))
    for at in range(0, len(data), size):
        client.send(data[at : at + size])
        b.vc.run_for(0.002)
    assert reply_of(client) == (1, (1,))
    b.vc.run_for(4)
    assert close_to(b.joints(), FIVE[-1], 1e-5)


def test_more_points_than_the_ring_takes(bench):
    b = bench()
    client = b.client()
    send_all(client, trajectory(LONG, [10.0] + [0.1] * 299))
    assert reply_of(client) == (1, (1,))
    start = b.vc.now
    assert b.vc.run_until(lambda: b.pers("ROS_done") == 1, timeout=60)
    assert b.vc.now - start == pytest.approx(29.9, abs=0.6)
    assert close_to(b.joints(), LONG[-1], 1e-5)
    assert b.pers("ROS_reached") == 300
    assert not [e for e in b.vc.log if e.code == 50_024]


def test_one_point_sent_twice_is_one_move(bench):
    """A single point comes as -1 and as -3 (C13): one move, in its duration, from anywhere."""
    b = bench()
    client = b.client()
    target = [0.1, -0.1, 0.05, 0, 0, 0]
    send_all(client, trajectory([target, target], [3.0, 3.0]))
    assert reply_of(client) == (1, (1,))
    start = b.vc.now
    assert b.vc.run_until(lambda: b.pers("ROS_done") == 1, timeout=10)
    assert b.vc.now - start == pytest.approx(3.0, abs=0.3)
    assert close_to(b.joints(), target, 1e-5)


def test_a_far_single_point_is_approached_slowly(bench):
    """C1: the duration of a single point cannot be trusted to be long enough."""
    b = bench()
    client = b.client()
    target = [1.0, 0, 0, 0, 0, 0]
    send_all(client, trajectory([target, target], [0.3, 0.3]))
    assert reply_of(client)[0] == 1
    start = b.vc.now
    assert b.vc.run_until(lambda: b.pers("ROS_done") == 1, timeout=20)
    # 57.3 deg at a tenth of 250 deg/s
    assert b.vc.now - start == pytest.approx(2.3, abs=0.3)


def test_the_same_point_again_is_a_dwell(bench):
    b = bench()
    client = b.client()
    send_all(client, trajectory([FIVE[0], FIVE[1], FIVE[1], FIVE[2]], [10, 1, 2, 1]))
    assert reply_of(client)[0] == 1
    start = b.vc.now
    b.vc.run_for(2.0)
    assert close_to(b.joints(), FIVE[1])
    assert b.vc.run_until(lambda: b.pers("ROS_done") == 1, timeout=10)
    assert b.vc.now - start == pytest.approx(4.0, abs=0.4)


def test_a_point_on_a_limit_is_reached(bench):
    """A limit that was rounded to a float32 on its way is still the limit."""
    b = bench()
    joint = b.config.groups[0].joints[4]
    client = b.client()
    for limit in (joint.upper, joint.lower):
        here = list(b.joints())
        there = [*here[:4], limit, here[5]]
        send_all(client, trajectory([here, there], [10, 3]))
        assert reply_of(client)[0] == 1, limit
        b.vc.run_for(5)
        assert close_to(b.joints(), there, 1e-5)


# -- what is refused --------------------------------------------------------------------------


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


# -- framing ----------------------------------------------------------------------------------


@pytest.mark.parametrize("length", [-1, 0, 11, 1021, 2**31 - 1, -(2**31), 63, 65])
def test_a_broken_length_drops_the_client_and_nobody_else(bench, length):
    """R2, R3: abb_driver's task halts on such bytes."""
    b = bench()
    client = b.client()
    client.send(struct.pack("<4i", length, 11, 1, 0) + bytes(60))
    assert b.vc.run_until(lambda: (client.pump(), client.closed)[1], timeout=5)
    assert b.healthy()
    move_well(b)


@pytest.mark.parametrize("data", [b"\xff\xff\xff\xff", b"\x00\x00\x00\x80", b"\xff\x00\x00\x10"])
def test_four_wrong_bytes_are_enough(bench, data):
    b = bench()
    client = b.client()
    client.send(data)
    assert b.vc.run_until(lambda: (client.pump(), client.closed)[1], timeout=5)
    move_well(b)


def test_an_unknown_message_is_skipped(bench):
    b = bench()
    client = b.client()
    client.send(struct.pack("<4i", 12 + 996, 999, 1, 0) + bytes(996))
    client.send(struct.pack("<4i", 16, 20, 2, 0) + bytes(4))
    assert client.wait_frame() == struct.pack("<4i", 12, 20, 3, 2)
    move_well(b, client)


def test_ping_is_answered(bench):
    b = bench()
    client = b.client()
    client.send(struct.pack("<4i", 12, 1, 2, 0))
    assert client.wait_frame() == struct.pack("<4i", 12, 1, 3, 1)


@pytest.mark.parametrize("comm", [0, 3, 7])
def test_a_point_that_is_neither_topic_nor_request(bench, comm):
    b = bench()
    client = b.client()
    client.send(POINT.pack(64, 11, comm, 0, -1, *[0.0] * 12))
    assert b.vc.run_until(lambda: (client.pump(), client.closed)[1], timeout=5)
    move_well(b)


def test_random_bytes_never_move_the_robot(bench):
    import random

    b = bench()
    rng = random.Random(7)
    good = b"".join(trajectory(FIVE, SECONDS))
    for _ in range(60):
        client = b.client()
        data = bytearray(good)
        for _ in range(rng.randint(1, 4)):
            at = rng.randrange(0, 20)
            data[at] = rng.randrange(256)
        client.send(bytes(data[: rng.randrange(1, len(data) - 68)]))
        b.vc.run_for(0.05)
        client.close()
        b.vc.run_for(0.05)
        assert b.joints() == (0.0,) * 6
        assert b.healthy()
    move_well(b)


# -- stopping ---------------------------------------------------------------------------------


def test_stop_is_answered_and_stops(bench):
    b = bench()
    client, state = b.client(), b.state_client()
    send_all(client, trajectory(FIVE, SECONDS))
    assert reply_of(client)[0] == 1
    b.vc.run_for(1.5)
    sent = b.vc.now
    client.send(STOP)
    assert client.wait_frame() == struct.pack("<4i", 12, 11, 3, 1)
    assert b.vc.now - sent < 0.1
    assert b.vc.run_until(lambda: b.group.is_standing, timeout=1)
    here = b.joints()
    assert 0.1 < here[0] < 0.25
    b.vc.run_for(3)
    assert b.joints() == here
    assert b.status(state) == (1, 0, 0, 0, 0, 2, 1)
    move_well(b, client)


def test_deceleration_begins_soon_after_the_last_byte_of_stop(bench):
    """At most 10 ms and the interrupt's delay (2 to 30 ms)."""
    for seed in range(5):
        b = bench(options={"seed": seed})
        client = b.client()
        send_all(client, trajectory(FIVE, SECONDS))
        assert reply_of(client)[0] == 1
        b.vc.run_for(1.5)
        client.send(STOP)
        sent = b.vc.now
        assert b.vc.run_until(lambda b=b: b.group.stop_reasons != (), timeout=1)
        assert b.vc.now - sent <= 0.010 + 0.030 + 0.0002


def test_stop_behind_points_in_one_stream(bench):
    """The real client's STOP lies behind its points: they are read, it is found."""
    b = bench()
    client = b.client()
    frames = trajectory(LONG, [10.0] + [0.1] * 299, request=False)
    send_all(client, [*frames, STOP])
    assert client.wait_frame() == struct.pack("<4i", 12, 11, 3, 1)
    b.vc.run_for(2)
    here = b.joints()
    b.vc.run_for(5)
    assert b.joints() == here
    assert here[0] < 0.01
    move_well(b, client)


def test_stop_in_the_middle_of_a_download(bench):
    b = bench()
    client = b.client()
    frames = trajectory(FIVE, SECONDS)
    send_all(client, [*frames[:3], STOP])
    assert client.wait_frame() == struct.pack("<4i", 12, 11, 3, 1)
    send_all(client, frames[3:])
    assert reply_of(client) == (2, (NO_START, 0, 0))
    b.vc.run_for(2)
    assert b.joints() == (0.0,) * 6
    move_well(b, client)


def test_stop_while_nothing_moves(bench):
    b = bench()
    client = b.client()
    client.send(STOP)
    assert client.wait_frame() == struct.pack("<4i", 12, 11, 3, 1)
    assert b.group.stop_reasons == ()
    move_well(b, client)


def test_stop_clears_the_report_of_a_refusal(bench):
    b = bench()
    client, state = b.client(), b.state_client()
    send_all(client, trajectory([[1.0] * 6, [1.1] * 6], [10, 5]))
    assert reply_of(client)[0] == 2
    assert b.status(state)[3] == 1
    client.send(STOP)
    assert client.wait_frame() is not None
    assert b.status(state)[2:4] == (0, 0)


def test_stop_and_a_new_trajectory_in_one_packet(bench):
    b = bench()
    client = b.client()
    send_all(client, trajectory(FIVE, SECONDS))
    assert reply_of(client)[0] == 1
    b.vc.run_for(0.02)
    send_all(client, [STOP, *trajectory([[0] * 6, [0.05] * 6], [10, 1])])
    assert client.wait_frame() == struct.pack("<4i", 12, 11, 3, 1)
    assert reply_of(client) == (1, (2,))
    b.vc.run_for(3)
    assert close_to(b.joints(), [0.05] * 6, 1e-5)


def test_many_stops_at_every_moment(bench):
    """R5, R7: nothing can stay taken, whenever the stop comes."""
    b = bench()
    client = b.client()
    for n in range(25):
        here = list(b.joints())
        there = [v + 0.3 * (1 if n % 2 == 0 else -1) for v in here]
        send_all(client, trajectory([here, there], [10, 1.0]))
        assert reply_of(client)[0] == 1
        b.vc.run_for(0.004 * n)
        client.send(STOP)
        assert client.wait_frame() == struct.pack("<4i", 12, 11, 3, 1), n
        b.vc.run_for(0.7)
    assert b.healthy()
    move_well(b, client)


# -- one after the other ----------------------------------------------------------------------


def test_a_new_trajectory_ends_the_one_under_way(bench):
    b = bench()
    client = b.client()
    send_all(client, trajectory(FIVE, SECONDS))
    assert reply_of(client)[0] == 1
    b.vc.run_for(1.5)
    send_all(client, trajectory([[0] * 6, [0.05] * 6], [10, 1]))
    # It stood still, and its start is not where the robot stands now.
    assert reply_of(client) == (2, (START, 0, 1))
    here = b.joints()
    assert b.group.is_standing
    b.vc.run_for(3)
    assert b.joints() == here
    move_well(b, client)


def test_an_unfinished_download_is_dropped_by_the_next(bench):
    b = bench()
    client = b.client()
    send_all(client, trajectory(FIVE, SECONDS)[:3])
    move_well(b, client)


def test_a_client_that_vanishes_stops_the_robot(bench):
    b = bench()
    client, state = b.client(), b.state_client()
    send_all(client, trajectory(FIVE, SECONDS))
    assert reply_of(client)[0] == 1
    b.vc.run_for(1.5)
    client.close()
    b.vc.run_for(1)
    here = b.joints()
    assert 0.1 < here[0] < 0.25
    assert b.status(state)[2:5] == (CLIENT_LOST, 1, 0)
    b.vc.run_for(3)
    assert b.joints() == here
    move_well(b)
    assert b.status(state)[2:4] == (0, 0)


def test_a_client_that_vanishes_in_a_download(bench):
    b = bench()
    client, state = b.client(), b.state_client()
    send_all(client, trajectory(FIVE, SECONDS)[:3])
    b.vc.run_for(0.1)
    client.close()
    b.vc.run_for(0.5)
    assert b.status(state)[2:4] == (INCOMPLETE, 1)
    assert b.joints() == (0.0,) * 6
    move_well(b)


def test_a_dead_link_gives_way_to_the_newest_client(bench):
    """R12: a peer that is gone without FIN blocks abb_driver's port for ever."""
    b = bench()
    old = b.client()
    move_well(b, old)
    b.vc.network.silence(old.endpoint)
    b.vc.run_for(1)
    move_well(b)


def test_a_dead_link_gives_way_while_the_ring_is_fed(bench):
    b = bench()
    old = b.client()
    send_all(old, trajectory(LONG, [10.0] + [0.1] * 299))
    assert reply_of(old)[0] == 1
    b.vc.network.silence(old.endpoint)
    b.vc.run_for(1)
    new = b.client()
    b.vc.run_for(2)
    assert b.group.is_standing
    move_well(b, new)


def test_an_idle_client_is_never_timed_out(bench):
    b = bench()
    client = b.client()
    b.vc.run_for(600)
    client.pump()
    assert not client.closed
    move_well(b, client)
    assert not [e for e in b.vc.log if e.type.name in ("WARNING", "ERROR")]


def test_a_client_that_stalls_inside_a_message(bench):
    b = bench(overrides=["network.receive_timeout=3"])
    client = b.client()
    client.send(trajectory(FIVE, SECONDS)[0][:40])
    b.vc.run_for(2.5)
    client.pump()
    assert not client.closed
    b.vc.run_for(2)
    client.pump()
    assert client.closed
    move_well(b)


def test_strangers_are_refused(bench):
    b = bench(allowed_clients=("10.0.0.9",))
    b.address = "10.0.0.8"
    stranger = b.client()
    b.vc.run_for(0.5)
    send_all(stranger, trajectory(FIVE, SECONDS))
    b.vc.run_for(1)
    stranger.pump()
    assert stranger.closed
    assert stranger.received == b""
    assert b.joints() == (0.0,) * 6
    assert b.healthy()
    b.address = "10.0.0.9"
    move_well(b)


# -- the controller's own events --------------------------------------------------------------


def start_moving(b):
    client, state = b.client(), b.state_client()
    send_all(client, trajectory(FIVE, SECONDS))
    assert reply_of(client)[0] == 1
    b.vc.run_for(1.5)
    return client, state


def recover(b):
    b.vc.perform("reset-e-stop")
    b.vc.perform("auto")
    b.vc.perform("motors-on")
    b.vc.perform("start")


@pytest.mark.parametrize(
    ("action", "reasons"),
    [
        ("stop", {PROGRAM}),
        ("e-stop", {E_STOP, PROGRAM}),
        ("motors-off", {MOTORS, PROGRAM}),
        ("manual", {MODE, MOTORS, PROGRAM}),
    ],
)
def test_nothing_of_the_old_path_resumes(bench, action, reasons):
    b = bench()
    client, state = start_moving(b)
    b.vc.perform(action)
    b.vc.run_for(1)
    here = b.joints()
    assert 0.1 < here[0] < 0.25
    status = b.status(state)
    assert status[2] in reasons
    assert status[3] == 1
    assert status[6] == 0
    # What comes while the motion task does not run is refused.
    send_all(client, trajectory([list(here), [0.3] * 6], [10, 2]))
    code, data = reply_of(client)
    assert code == 2
    assert data[0] in {E_STOP, MOTORS, NOT_EXECUTING}
    b.vc.run_for(1)
    recover(b)
    b.vc.run_for(5)
    assert b.joints() == here, "moved without a new trajectory"
    assert b.status(state)[6] == 1
    move_well(b, client)


def test_power_failure(bench):
    b = bench()
    start_moving(b)
    b.vc.perform("power-loss")
    b.vc.run_for(2)
    here = b.joints()
    recover(b)
    b.vc.run_for(5)
    # Less than a thousandth of a degree, in the microseconds until the event routine runs.
    assert close_to(b.joints(), here, 1e-6)
    move_well(b)


def test_program_pointer_to_main(bench):
    b = bench()
    client, _ = start_moving(b)
    b.vc.perform("stop")
    b.vc.run_for(1)
    b.vc.perform("pp-to-main")
    b.vc.run_for(0.1)
    b.vc.perform("start")
    here = b.joints()
    b.vc.run_for(5)
    assert b.joints() == here
    move_well(b, client)


def test_a_stop_and_start_within_one_watch(bench):
    """A stop that is over before the supervisor looks is not missed."""
    b = bench()
    client, _ = start_moving(b)
    b.vc.perform("stop")
    b.vc.run_for(0.01)
    b.vc.perform("start")
    b.vc.run_for(1)
    here = b.joints()
    b.vc.run_for(4)
    assert b.joints() == here
    move_well(b, client)


def statements_of(b, routine, module="ROS_motion"):
    """Lines of the statements of a routine."""
    from rapidgen.rapid import parse

    (file,) = [f for f in b.output.files if Path(f.path).stem == module]
    module = parse(file.data)
    (found,) = [r for r in module.routines if r.name == routine]
    lines = []

    def walk(body):
        for node in body:
            lines.append(module.source.line(node.first))
            for branch in getattr(node, "branches", ()):
                walk(branch.body)
            walk(getattr(node, "otherwise", None) or ())

    walk(found.body)
    return lines


def line_with(b, module, words):
    """Number of the only line of a module that contains these words."""
    (file,) = [f for f in b.output.files if f.path.endswith(f"/{module}.mod")]
    lines = file.data.decode("latin-1").splitlines()
    (found,) = [n for n, line in enumerate(lines, 1) if words in line]
    return found


@pytest.mark.parametrize("pause", [0.001, 1.0])
def test_a_program_stop_at_every_statement(bench, pause):
    """Also when main is just about to begin a move: nothing of the old path comes after Start.

    With a short pause the robot may still be braking, and the supervisor has not looked.
    """
    lines = statements_of(bench(), "next_point")
    assert len(lines) > 20
    stopped = 0
    for line in lines:
        b = bench()
        client = b.client()
        b.vc.before_statement("T_ROB1", "ROS_motion", line, 2, lambda b=b: b.vc.perform("stop"))
        send_all(client, trajectory(FIVE, SECONDS))
        assert reply_of(client)[0] == 1
        task = b.vc.tasks["T_ROB1"]
        if not b.vc.run_until(lambda task=task: task.state == "stopped", timeout=6):
            continue
        stopped += 1
        b.vc.run_for(pause)
        standing = b.group.is_standing
        here = b.joints()
        b.vc.perform("start")
        if not standing:
            b.vc.run_for(0.3)
            here = b.joints()
        b.vc.run_for(4)
        assert close_to(b.joints(), here, 1e-6), line
        move_well(b, client)
    assert stopped > 10


def test_a_stop_at_every_statement(bench):
    stopped = 0
    for line in statements_of(bench(), "next_point"):
        b = bench()
        client = b.client()

        def stop(client=client):
            client.network.send(client.endpoint, STOP)

        b.vc.before_statement("T_ROB1", "ROS_motion", line, 2, stop)
        send_all(client, trajectory(FIVE, SECONDS))
        assert reply_of(client)[0] == 1
        frame = client.wait_frame(timeout=4)
        if frame is None:
            continue
        stopped += 1
        assert frame == struct.pack("<4i", 12, 11, 3, 1)
        b.vc.run_for(1)
        here = b.joints()
        b.vc.run_for(3)
        assert b.joints() == here, line
        move_well(b, client)
    assert stopped > 10


def test_a_move_that_fails_ends_its_trajectory(bench):
    b = bench()
    client, state = start_moving(b)
    b.vc.tasks["T_ROB1"]["ROS_motion:fault"] = COLLISION
    b.vc.run_for(3)
    here = b.joints()
    assert close_to(here, b.joints())
    assert here[0] < 0.25
    status = b.status(state)
    assert status[2:5] == (COLLISION, 1, 0)
    assert [e for e in b.vc.log if "ROS: trajectory ended early" in str(e)]
    b.vc.run_for(3)
    assert b.joints() == here
    move_well(b, client)


def test_a_move_that_fails_while_it_is_stopped(bench):
    """The fault goes with its trajectory: it must not end the next one."""
    b = bench()
    client, _ = start_moving(b)
    line = line_with(b, "ROS_motion", "asked := ROS_abort")

    def fail():
        b.vc.tasks["T_ROB1"]["ROS_motion:fault"] = COLLISION

    b.vc.before_statement("T_ROB1", "ROS_motion", line, 1, fail)
    client.send(STOP)
    assert client.wait_frame() == struct.pack("<4i", 12, 11, 3, 1)
    b.vc.run_for(1)
    assert b.vc.tasks["T_ROB1"]["ROS_motion:fault"] == 0
    assert not [e for e in b.vc.log if "ROS: trajectory ended early" in str(e)]
    move_well(b, client)


def mix(b, role, build="0123456789ab"):
    """One task shows another build."""
    b.vc.tasks["T_ROS_STATE"][f"ROS_common:ROS_shown_{role}"] = build


@pytest.mark.parametrize("role", ["motion", "motion_server", "supervisor", "state"])
def test_tasks_of_different_builds_take_no_trajectory(bench, role):
    b = bench()
    mix(b, role)
    b.vc.run_for(3)
    client = b.client()
    for _ in range(2):
        send_all(client, trajectory(FIVE, SECONDS))
        assert_refused(b, client, MIXED, -1)
    # STATUS said why; the event log does, once.
    assert b.status(b.state_client())[6] == 0
    assert len([e for e in b.vc.log if "ROS: tasks of different builds" in str(e)]) == 1
    mix(b, role, b.output.build_id)
    b.vc.run_for(0.3)
    move_well(b, client)


def test_another_build_is_refused_at_the_first_point(bench):
    b = bench()
    mix(b, "supervisor")
    client = b.client()
    client.send(point(-1, FIVE[0], 10.0, comm=2))
    assert reply_of(client) == (2, (MIXED, -1, 0))
    # What else is wrong with it does not hide that.
    send_all(client, trajectory([[9.0] * 6, [math.nan] * 6], [10, 1]))
    assert reply_of(client) == (2, (MIXED, -1, 0))
    client.send(STOP)
    assert client.wait_frame() == struct.pack("<4i", 12, 11, 3, 1)


@pytest.mark.parametrize("name", ["ROS_messages.sys", "ROS_socket.sys", "ROS_motionServer.mod"])
def test_a_task_with_modules_of_two_builds(bench, name):
    b = bench()
    b.vc.close()
    b.vc = VirtualController(with_old_file(b, name), b.config.groups)
    b.vc.run_for(0.5)
    events = [str(e) for e in b.vc.log if "ROS: modules of different builds" in str(e)]
    assert events
    assert any("T_ROS_RECV" in e for e in events)
    client, state = b.client(), b.state_client()
    send_all(client, trajectory(FIVE, SECONDS))
    assert reply_of(client) == (2, (MIXED, -1, 0))
    # The state port serves, so that the reason can be read.
    assert b.status(state)[2:] == (MIXED, 1, 0, 2, 0)
    b.vc.run_for(2)
    assert b.joints() == (0.0,) * 6
    assert b.healthy()


def with_old_file(b, name):
    """The system, with the BUILD_ID of one file's module being another one."""
    tasks = []
    for task in b.system.tasks:
        modules = [
            replace(m, data=m.data.replace(b.output.build_id.encode(), b"0123456789ab"))
            if m.path.endswith(name)
            else m
            for m in task.modules
        ]
        tasks.append(replace(task, modules=tuple(modules)))
    return replace(b.system, tasks=tuple(tasks))


def test_missing_signals_are_not_fatal(bench):
    """R15: abb_driver's module does not even load."""
    b = bench()
    b.vc.close()
    b.vc = VirtualController(replace(b.system, signals=(), outputs=()), b.config.groups)
    b.vc.run_for(0.5)
    state = b.state_client()
    assert b.status(state) == (-1, -1, 0, 0, 0, 2, 1)
    move_well(b)


# -- state ------------------------------------------------------------------------------------


def test_the_state_rate_is_kept(bench):
    b = bench()
    state = b.state_client()
    b.vc.run_for(1)
    state.frames()
    count = 0
    for _ in range(100):
        b.vc.run_for(10)
        count += len(state.frames())
    assert count == pytest.approx(2 * 10_000, abs=4)


def test_a_set_state_rate(bench):
    b = bench(overrides=["state.rate=50"])
    state = b.state_client()
    b.vc.run_for(1)
    state.frames()
    b.vc.run_for(10)
    assert len(state.frames()) == pytest.approx(2 * 500, abs=4)


def test_every_movement_shows_in_a_status(bench):
    """R16: a movement shorter than the state period."""
    b = bench(overrides=["state.rate=1"])
    client, state = b.client(), b.state_client()
    b.vc.run_for(3)
    state.frames()
    send_all(client, trajectory([[0] * 6, [0.002] * 6], [10, 0.1]))
    assert reply_of(client)[0] == 1
    b.vc.run_for(3)
    found = [struct.unpack_from("<7i", f, 16)[4] for f in state.frames() if f[4] == 13]
    assert 1 in found
    assert found[-1] == 0


@pytest.mark.parametrize(
    ("action", "reasons"),
    [("e-stop", {E_STOP}), ("motors-off", {MOTORS}), ("stop", {PROGRAM})],
)
def test_a_halted_robot_that_stands_is_not_in_motion(bench, action, reasons):
    """Also while the motion task cannot answer, since its program does not run."""
    b = bench()
    _, state = start_moving(b)
    assert b.status(state)[4] == 1
    b.vc.perform(action)
    assert b.vc.run_until(lambda: b.group.is_standing, timeout=2)
    b.vc.run_for(2)
    status = b.status(state)
    assert status[2] in reasons
    assert status[4] == 0
    # Recovery moves nothing, and says so.
    b.vc.run_for(1)
    state.frames()
    recover(b)
    b.vc.run_for(5)
    told = [struct.unpack_from("<7i", f, 16)[4] for f in state.frames() if f[4] == 13]
    assert set(told) == {0}


def test_a_robot_that_brakes_is_in_motion(bench):
    b = bench(overrides=["state.rate=100"])
    client, state = start_moving(b)
    state.frames()
    client.send(STOP)
    moving, standing = [], []
    for _ in range(100):
        b.vc.run_for(0.01)
        told = [struct.unpack_from("<7i", f, 16)[4] for f in state.frames() if f[4] == 13]
        (standing if b.group.is_standing else moving).extend(told)
    assert set(moving) == {1}
    assert standing[3:].count(1) == 0


def test_a_movement_back_and_forth_between_two_messages_shows(bench):
    """It ends where it began: no axis has moved since the message before."""
    b = bench(overrides=["state.rate=0.5"])
    client, state = b.client(), b.state_client()
    b.vc.run_for(4.1)
    state.frames()
    send_all(client, trajectory([[0] * 6, [0.002] * 6, [0] * 6], [10, 0.2, 0.2]))
    assert reply_of(client)[0] == 1
    b.vc.run_for(1)
    assert b.pers("ROS_done") == 1
    assert not state.frames()
    b.vc.run_for(6)
    told = [struct.unpack_from("<7i", f, 16)[4] for f in state.frames() if f[4] == 13]
    assert told == [1, 0, 0]


def test_a_state_client_that_does_not_read_harms_nobody(bench):
    """R13"""
    b = bench()
    deaf = b.state_client()
    b.vc.run_for(0.2)
    b.vc.network.silence(deaf.endpoint)
    b.vc.run_for(300)
    move_well(b)


def test_hello_and_progress(bench):
    b = bench()
    state = b.state_client()
    state.send(struct.pack("<4i5i", 32, 1300, 2, 0, 2, 0, 1, 0, 1))
    reply = None
    while reply is None or struct.unpack_from("<i", reply, 4)[0] != 1300:
        reply = state.wait_frame()
    assert struct.unpack_from("<4i", reply)[2:] == (3, 1)
    assert reply[16 + 16 : 16 + 28] == b.output.build_id.encode()
    client = b.client()
    send_all(client, trajectory(FIVE, SECONDS))
    assert reply_of(client)[0] == 1
    b.vc.run_for(6)
    told = [
        struct.unpack_from("<8i", f, 16)
        for f in state.frames()
        if struct.unpack_from("<i", f, 4)[0] == 1301
    ]
    states = [t[1] for t in told]
    assert MOVING in states
    assert told[-1] == (1, DONE, 5, 5, 5, 0, -1, 0)
    assert [t[4] for t in told] == sorted(t[4] for t in told)


def ask_progress(b):
    """A state client that gets PROGRESS."""
    state = b.state_client()
    state.send(struct.pack("<4i5i", 32, 1300, 2, 0, 2, 0, 1, 0, 1))
    b.vc.run_for(0.3)
    state.frames()
    return state


def progress_of(state):
    return {
        struct.unpack_from("<8i", f, 16)
        for f in state.frames()
        if struct.unpack_from("<i", f, 4)[0] == 1301
    }


def hold(b, task, seconds):
    """Let a task wait where it is."""
    b.vc.rapid_tasks[task].hold()
    b.vc.kernel.after(round(seconds * 1e9), b.vc.rapid_tasks[task].release)


def held_at(bench, task, module, routine, second):
    """What PROGRESS tells of a first trajectory of three points and of a second one, for each
    statement of a routine at which `task` is held when the second comes."""
    for line in statements_of(bench(), routine, module):
        b = bench()
        client, state = b.client(), ask_progress(b)
        send_all(client, trajectory(FIVE[:3], [10, 0.2, 0.2]))
        assert reply_of(client)[0] == 1
        b.vc.run_for(2)
        state.frames()

        def begin(b=b, client=client):
            if task == "T_ROS_STATE":
                client.network.send(client.endpoint, b"".join(second))
            hold(b, task, 0.35)

        b.vc.before_statement(task, module, line, 1, begin)
        if task != "T_ROS_STATE":
            send_all(client, second)
        b.vc.run_for(1.5)
        yield line, client, progress_of(state)


BEFORE = (1, DONE, 3, 3, 3, 0, -1, 0)


@pytest.mark.parametrize(
    ("module", "routine"),
    [("ROS_stateServer", "tell"), ("ROS_messages", "ROS_look"), ("ROS_messages", "look_at")],
)
def test_progress_is_one_snapshot(bench, module, routine):
    """Whatever the state server is at when a trajectory comes and is refused: a number comes
    with the state, the counts and the fault of that trajectory."""
    second = trajectory([FIVE[2], FIVE[1], [9.0] * 6], [10, 1, 1])
    refused = (2, REFUSED, 2, 0, 0, LIMIT, 2, 1)
    held = 0
    for line, client, told in held_at(bench, "T_ROS_STATE", module, routine, second):
        if client.frames():
            held += 1
            assert refused in told, line
        assert told <= {BEFORE, refused}, line
    assert held


@pytest.mark.parametrize(
    ("task", "module", "routine"),
    [
        ("T_ROS_RECV", "ROS_acceptance", "ROS_new_trajectory"),
        ("T_ROS_RECV", "ROS_acceptance", "ROS_hand_over"),
        ("T_ROS_RECV", "ROS_download", "hand_over"),
        ("T_ROB1", "ROS_motion", "next_point"),
    ],
)
def test_progress_of_a_trajectory_that_begins(bench, task, module, routine):
    """Nothing of the trajectory before is told under the number of the new one, or the other
    way round, whatever statement a writer is at."""
    second = trajectory([FIVE[2], FIVE[1]], [10, 0.5])
    for line, _, told in held_at(bench, task, module, routine, second):
        assert {t for t in told if t[0] == 1} <= {BEFORE}, line
        assert (2, DONE, 2, 2, 2, 0, -1, 0) in told, line
        for number, state, received, planned, reached, *fault in told - {BEFORE}:
            assert number == 2
            assert state in {RECEIVING, MOVING, DONE}, line
            assert reached <= planned <= received <= 2, line
            assert state != RECEIVING or planned == 0, line
            assert fault == [0, -1, 0], line


@pytest.mark.parametrize("data", [bytes(36), b"\xff" * 36, bytes(500)])
def test_nonsense_on_the_state_port_breaks_only_that_link(bench, data):
    b = bench()
    state = b.state_client()
    state.send(data)
    b.vc.run_for(2)
    state.pump()
    assert state.closed
    assert b.healthy()
    assert b.status(b.state_client())[6] == 1
