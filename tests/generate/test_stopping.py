"""STOP on the motion port."""

import struct

from tests.generate.bench import STOP, close_to, trajectory
from tests.generate.driving import (
    FIVE,
    LONG,
    NO_START,
    SECONDS,
    move_well,
    reply_of,
    send_all,
    statements_of,
)


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
