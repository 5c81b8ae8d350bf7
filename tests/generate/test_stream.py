"""Streams of points: what is executed, when it begins, credits, starvation.

The bytes are packed by hand from docs/develop/protocol.md (tests/generate/streams.py). That a point
without a successor is a stop point, so that the planner never runs dry in a corner, rests on S4
overview 5-25; that a num counts to 2^23 exactly on [K §2.13].
"""

import struct

import pytest

from tests.generate.bench import close_to
from tests.generate.driving import DONE, MOVING, STARVED, all_progress, ask_progress
from tests.generate.streams import (
    BEGIN,
    END,
    FLUSH,
    POINTS,
    accepted,
    batch,
    batches,
    line,
    longest_rest,
    positions,
    seconds,
    send_stream,
)

HOME = [0.0] * 6
RING = 127
CORNER_WITHOUT_SUCCESSOR = 50_024


def done(b, number=1):
    return lambda: b.pers("ROS_done") == number


def complaints(b):
    return [e for e in b.vc.log if e.type.name != "INFO"]


def test_a_stream_is_executed(bench):
    b = bench()
    client, state = b.client(), ask_progress(b)
    rows = line(HOME, 50)
    client.send(batch(7, 0, rows[:30], BEGIN))
    assert accepted(client) == (7, 1, 30, RING - 30, 0, 0, MOVING)
    client.send(batch(7, 30, rows[30:], END))
    assert accepted(client)[:3] == (7, 1, 50)
    start = b.vc.now
    assert b.vc.run_until(done(b), timeout=20)
    assert b.vc.now - start == pytest.approx(seconds(rows), abs=0.3)
    assert close_to(b.joints(), rows[-1][1], 1e-6)
    b.vc.run_for(0.3)
    assert all_progress(state)[-1] == (1, DONE, 50, 50, 50, 0, -1, 0)
    assert complaints(b) == []
    assert b.healthy()


def test_a_stream_moves_without_a_rest(bench):
    b = bench()
    client = b.client()
    rows = line(HOME, 100)
    for data in batches(7, rows):
        client.send(data)
    track = positions(b, seconds(rows) + 1)
    assert close_to(track[-1], rows[-1][1], 1e-6)
    assert longest_rest(track) == 0
    heights = [p[0] for p in track]
    assert heights == sorted(heights)


@pytest.mark.parametrize("size", [1, 3, 7, 15, 16, 17, 1000, 1020, 100_000])
def test_any_split_and_merge_of_the_bytes(bench, size):
    """R2: TCP cuts where it likes."""
    b = bench()
    client = b.client()
    rows = line(HOME, 40, step=0.01, duration=0.2)
    data = b"".join(batches(7, rows, size=25))
    for at in range(0, len(data), size):
        client.send(data[at : at + size])
        b.vc.run_for(0.0005)
    assert accepted(client)[2] == 25
    assert accepted(client)[2] == 40
    assert b.vc.run_until(done(b), timeout=20)
    assert close_to(b.joints(), rows[-1][1], 1e-6)


def test_topics_are_not_answered(bench):
    b = bench()
    client = b.client()
    rows = line(HOME, 50)
    for data in batches(7, rows, comm=1):
        client.send(data)
    assert client.wait_frame(timeout=8) is None
    assert close_to(b.joints(), rows[-1][1], 1e-6)


def test_points_of_one_by_one(bench):
    """A batch may hold any number of points that fits."""
    b = bench()
    client = b.client()
    rows = line(HOME, 20, step=0.01, duration=0.2)
    for data in batches(7, rows, size=1):
        client.send(data)
        accepted(client)
    assert b.vc.run_until(done(b), timeout=20)
    assert close_to(b.joints(), rows[-1][1], 1e-6)


def test_the_same_place_again_is_a_dwell(bench):
    b = bench()
    client = b.client()
    rows = [(0, HOME), (0.5, [0.1] * 6), (1.0, [0.1] * 6), (0.5, [0.15] * 6)]
    client.send(batch(7, 0, rows, BEGIN | END))
    start = b.vc.now
    accepted(client)
    b.vc.run_for(1.2)
    assert close_to(b.joints(), rows[1][1], 1e-6)
    assert b.vc.run_until(done(b), timeout=10)
    assert b.vc.now - start == pytest.approx(2.0, abs=0.3)


def test_a_point_before_a_dwell_in_the_next_batch_is_a_stop_point(bench):
    b = bench()
    client = b.client()
    client.send(batch(7, 0, [(0, HOME), (0.6, [0.1] * 6)], BEGIN | FLUSH))
    accepted(client)
    client.send(batch(7, 2, [(1.0, [0.1] * 6), (0.5, [0.15] * 6)], END))
    accepted(client)
    b.vc.run_for(1.2)
    assert close_to(b.joints(), [0.1] * 6, 1e-6)
    assert b.vc.run_until(done(b), timeout=10)
    assert close_to(b.joints(), [0.15] * 6, 1e-6)


def test_the_approach_is_the_drivers(bench):
    """The client's duration for the first point is of no use; within tolerance the robot goes."""
    b = bench()
    client = b.client()
    near = [0.005] * 6
    rows = [(30.0, near), (0.5, [0.05] * 6), (0.5, [0.1] * 6)]
    client.send(batch(7, 0, rows, BEGIN | END))
    start = b.vc.now
    assert accepted(client)[2] == 3
    assert b.vc.run_until(done(b), timeout=10)
    assert b.vc.now - start < 2
    assert close_to(b.joints(), rows[-1][1], 1e-6)


def test_a_last_segment_may_be_short(bench):
    b = bench()
    client = b.client()
    rows = [(0, HOME), (0.5, [0.05] * 6), (0.02, [0.051] * 6)]
    client.send(batch(7, 0, rows, BEGIN | END))
    assert accepted(client)[2] == 3
    b.vc.run_for(2)
    assert close_to(b.joints(), rows[-1][1], 1e-6)


# -- when it begins -------------------------------------------------------------------------------


def test_motion_begins_when_enough_seconds_are_there(bench):
    b = bench(overrides=["trajectory.preload=1"])
    client = b.client()
    rows = line(HOME, 60)
    client.send(batch(7, 0, rows[:8], BEGIN))
    accepted(client)
    b.vc.run_for(2)
    assert b.joints() == tuple(HOME)
    client.send(batch(7, 8, rows[8:30]))
    accepted(client)
    assert b.vc.run_until(lambda: b.joints()[0] > 0, timeout=0.3)


@pytest.mark.parametrize("flag", [FLUSH, END])
@pytest.mark.parametrize("apart", [False, True])
def test_flush_and_end_begin_with_less(bench, flag, apart):
    b = bench(overrides=["trajectory.preload=5"])
    client = b.client()
    rows = line(HOME, 5)
    client.send(batch(7, 0, rows, BEGIN | (0 if apart else flag)))
    accepted(client)
    if apart:
        b.vc.run_for(1)
        assert b.joints() == tuple(HOME)
        client.send(batch(7, 5, [], flag))
        accepted(client)
    b.vc.run_for(2)
    assert close_to(b.joints(), rows[-1][1], 1e-6)


def test_a_full_ring_begins_with_less(bench):
    """Else client and driver would wait for each other."""
    b = bench(overrides=["trajectory.preload=10", "trajectory.ring=64"])
    client = b.client()
    rows = line(HOME, 63, step=0.001)
    for data in batches(7, rows[:60], end=False):
        client.send(data)
        accepted(client)
    b.vc.run_for(1)
    assert b.joints() == tuple(HOME)
    client.send(batch(7, 60, rows[60:]))
    assert accepted(client)[3] == 0
    b.vc.run_for(1)
    assert b.joints()[0] > 0


def test_the_first_motion_does_not_depend_on_the_length(bench):
    found = []
    for count in (60, 600):
        b = bench()
        client = b.client()
        rows = line(HOME, count, step=0.001)
        start = b.vc.now
        client.send(batch(7, 0, rows[:30], BEGIN))
        b.vc.run_until(lambda b=b: b.joints()[0] > 0, timeout=5)
        found.append(b.vc.now - start)
        accepted(client)
        send_rest(client, rows, 30)
        assert b.vc.run_until(done(b), timeout=100)
    assert found[0] == pytest.approx(found[1], abs=0.03)
    assert found[0] < 0.1


def send_rest(client, rows, first):
    """Go on with a stream as far as there is room, all the way."""
    while first < len(rows):
        count = min(30, len(rows) - first)
        client.send(batch(7, first, [], 0))
        if accepted(client)[3] < count:
            client.bench.vc.run_for(0.5)
            continue
        flags = END if first + count == len(rows) else 0
        client.send(batch(7, first, rows[first : first + count], flags))
        accepted(client)
        first += count


# -- credits --------------------------------------------------------------------------------------


def test_room_is_what_the_ring_takes(bench):
    b = bench(overrides=["trajectory.ring=64", "trajectory.preload=10"])
    client = b.client()
    rows = line(HOME, 40, step=0.001)
    client.send(batch(7, 0, rows[:20], BEGIN))
    assert accepted(client)[3] == 43
    client.send(batch(7, 20, rows[20:]))
    assert accepted(client)[3] == 23
    client.send(batch(7, 40, [], FLUSH))
    accepted(client)
    b.vc.run_for(1.5)
    client.send(batch(7, 40, []))
    _, _, count, room, planned, reached, _ = accepted(client)
    assert count == 40
    # A point given to the planner makes room.
    assert room == 63 - 40 + planned
    assert 10 < reached <= planned < 20


def test_a_long_stream_goes_through_the_ring_without_a_rest(bench):
    b = bench()
    client = b.client()
    rows = line(HOME, 400, step=0.001)
    track = []
    first = 0
    while b.pers("ROS_done") != 1:
        room = RING - (first - b.pers("ROS_planned")) if first else RING
        if first < len(rows) and room >= 40:
            flags = (BEGIN if first == 0 else 0) | (END if first + 25 >= len(rows) else 0)
            client.send(batch(7, first, rows[first : first + 25], flags))
            first += 25
        track += positions(b, 0.1)[1:]
    assert longest_rest(track) == 0
    assert close_to(b.joints(), rows[-1][1], 1e-6)
    assert complaints(b) == []


# -- starvation -----------------------------------------------------------------------------------


def test_starvation_is_a_stop_on_the_path_and_no_end(bench):
    b = bench()
    client, state = b.client(), ask_progress(b)
    rows = line(HOME, 40)
    client.send(batch(7, 0, rows[:20], BEGIN))
    accepted(client)
    b.vc.run_for(5)
    assert close_to(b.joints(), rows[19][1], 1e-6)
    assert b.group.is_standing
    assert all_progress(state)[-1][:5] == (1, STARVED, 20, 20, 20)
    status = b.status(state)
    assert status[2:5] == (0, 0, 0)
    client.send(batch(7, 20, rows[20:22]))
    assert accepted(client)[6] == STARVED
    b.vc.run_for(1)
    assert close_to(b.joints(), rows[19][1], 1e-6), "two points are not enough to go on"
    client.send(batch(7, 22, rows[22:], END))
    accepted(client)
    assert b.vc.run_until(done(b), timeout=10)
    assert close_to(b.joints(), rows[-1][1], 1e-6)
    b.vc.run_for(0.3)
    assert all_progress(state)[-1] == (1, DONE, 40, 40, 40, 0, -1, 0)
    assert not [e for e in b.vc.log if e.code == CORNER_WITHOUT_SUCCESSOR]
    assert complaints(b) == []


@pytest.mark.parametrize("flag", [FLUSH, END])
def test_a_starved_stream_goes_on_when_told_so(bench, flag):
    b = bench()
    client = b.client()
    rows = line(HOME, 22)
    client.send(batch(7, 0, rows[:20], BEGIN))
    accepted(client)
    b.vc.run_for(4)
    client.send(batch(7, 20, rows[20:], flag))
    accepted(client)
    b.vc.run_for(1)
    assert close_to(b.joints(), rows[-1][1], 1e-6)


def test_an_end_behind_a_starved_stream_is_its_end(bench):
    b = bench()
    client = b.client()
    client.send(batch(7, 0, line(HOME, 10), BEGIN))
    accepted(client)
    b.vc.run_for(3)
    assert b.pers("ROS_done") == 0
    client.send(batch(7, 10, [], END))
    assert accepted(client)[2] == 10
    assert b.vc.run_until(done(b), timeout=0.2)
    client.send(batch(7, 10, []))
    assert accepted(client)[6] == DONE


@pytest.mark.parametrize("pause", [0.02 * n for n in range(12)])
def test_points_that_come_just_in_time_or_just_too_late(bench, pause):
    """Whenever the next batch comes while the last point is approached: all points are passed."""
    b = bench()
    client = b.client()
    rows = line(HOME, 24, step=0.01, duration=0.2)
    client.send(batch(7, 0, rows[:6], BEGIN))
    accepted(client)
    b.vc.run_for(0.85 + pause)
    client.send(batch(7, 6, rows[6:], END))
    accepted(client)
    track = positions(b, 6)
    assert close_to(track[-1], rows[-1][1], 1e-6)
    heights = [p[0] for p in track]
    assert heights == sorted(heights)
    assert not [e for e in b.vc.log if e.code == CORNER_WITHOUT_SUCCESSOR]


# -- counters -------------------------------------------------------------------------------------


def have_passed(b, count):
    """As if so many points of a starved stream had passed."""
    b.vc.tasks["T_ROS_RECV"]["ROS_acceptance:ROS_count"] = count
    b.vc.tasks["T_ROS_RECV"]["ROS_stream:accepted"] = count
    b.vc.tasks["T_ROB1"]["ROS_motion:expected"] = (count + 1) % 2**23


def test_points_count_modulo_2_to_the_23(bench):
    """A num counts no farther [K §2.13]: after point 8,388,607 comes point 0."""
    b = bench()
    client, state = b.client(), ask_progress(b)
    rows = line(HOME, 60, step=0.002)
    client.send(batch(7, 0, rows[:20], BEGIN))
    accepted(client)
    b.vc.run_for(4)
    shift = 2**23 - 30
    have_passed(b, shift)
    client.send(batch(7, shift, rows[20:45]))
    assert accepted(client)[2] == shift + 25
    client.send(batch(7, shift + 25, rows[45:], END))
    assert accepted(client)[2] == 10
    assert b.vc.run_until(done(b), timeout=10)
    assert close_to(b.joints(), rows[-1][1], 1e-6)
    b.vc.run_for(0.3)
    assert all_progress(state)[-1] == (1, DONE, 10, 10, 10, 0, -1, 0)


def test_the_point_behind_the_last_number_is_checked_like_any_other(bench):
    """Point 0 of the second round is not the first point: its speed counts."""
    b = bench()
    client = b.client()
    client.send(batch(7, 0, line(HOME, 10), BEGIN))
    accepted(client)
    b.vc.run_for(3)
    have_passed(b, 2**23 - 1)
    client.send(batch(7, 2**23 - 1, [(0.1, [0.04] * 6), (0.1, [1.0] * 6)], END))
    code, kind = struct.unpack_from("<i", client.wait_frame(), 12)[0], POINTS
    assert (code, kind) == (2, POINTS)
    b.vc.run_for(2)
    assert b.joints()[0] < 0.05


def test_streams_one_after_the_other(bench):
    b = bench()
    client = b.client()
    for number in range(1, 6):
        rows = line(list(b.joints()), 30, step=0.002)
        send_stream(client, rows, stream=number)
        assert b.vc.run_until(done(b, number), timeout=10)
        assert close_to(b.joints(), rows[-1][1], 1e-6)


def test_a_stream_and_a_download_in_turn(bench):
    from tests.generate.driving import move_well

    b = bench()
    client = b.client()
    for number in range(1, 4):
        rows = line(list(b.joints()), 30, step=0.002)
        send_stream(client, rows, stream=number)
        assert b.vc.run_until(done(b, 2 * number - 1), timeout=10)
        move_well(b, client)
