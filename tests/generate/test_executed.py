"""What is executed: trajectories that come whole."""

import struct

import pytest

from tests.generate.bench import close_to, trajectory
from tests.generate.driving import FIVE, LONG, SECONDS, reply_of, send_all


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
