"""Streams with a fault: refused, or cut behind the last point before it.

What was executed is a prefix of what was asked, point for point, and shorter only with a reason and
an index. The bytes are packed by hand from docs/develop/protocol.md.
"""

import math
import struct

import pytest

from tests.generate.bench import close_to
from tests.generate.driving import (
    BAD_DURATION,
    FAILED,
    FRAMING,
    GAP,
    INCOMPLETE,
    LIMIT,
    MIXED,
    MOTORS,
    MOVING,
    NO_START,
    NOT_EXECUTING,
    PADDING,
    RECEIVING,
    REFUSED,
    SHORT,
    START,
    TCP_TOO_FAST,
    TOO_FAST,
    all_progress,
    ask_progress,
    move_well,
)
from tests.generate.streams import (
    BEGIN,
    END,
    FLUSH,
    HEAD,
    POINTS,
    accepted,
    batch,
    batch_of_words,
    line,
    refused,
    send_stream,
    words_of,
)

OVERRUN, CHECKSUM = 15, 16
HOME = [0.0] * 6


def begin(b, count=20):
    """A stream under way: client, state client, and the rows of which 20 are sent."""
    client, state = b.client(), ask_progress(b)
    rows = line(HOME, 60)
    client.send(batch(7, 0, rows[:count], BEGIN))
    accepted(client)
    return client, state, rows


def assert_cut(b, client, state, fault, rows, count):
    """Refused with (reason, point, joint); the `count` points before it are executed in order."""
    assert refused(client) == (7, 1, count, *fault)
    heights = []
    for _ in range(300):
        b.vc.run_for(0.02)
        heights.append(b.joints()[0])
    assert heights == sorted(heights)
    assert close_to(b.joints(), rows[count - 1][1], 1e-6)
    told = all_progress(state)
    assert told[-1] == (1, FAILED, count, count, count, *fault)
    assert {t[1] for t in told[:-1]} <= {RECEIVING, MOVING, FAILED}
    assert b.status(state)[2:5] == (fault[0] + 100 * fault[2], 1, 0)
    # Whatever follows is answered with the same.
    client.send(batch(7, count, rows[count : count + 5]))
    assert refused(client) == (7, 1, count, *fault)
    client.send(batch(7, count, [], END))
    assert refused(client) == (7, 1, count, *fault)
    b.vc.run_for(1)
    assert close_to(b.joints(), rows[count - 1][1], 1e-6)
    assert b.healthy()
    goes_on(b, client)


def goes_on(b, client):
    """The next stream of the same client is executed."""
    rows = line(list(b.joints()), 20, step=0.002)
    send_stream(client, rows, stream=8)
    b.vc.run_for(4)
    assert close_to(b.joints(), rows[-1][1], 1e-6)
    assert b.healthy()


def assert_refused(b, client, number, fault, *, accepted_points=0):
    """Nothing of it moves."""
    here = b.joints()
    assert refused(client) == (7, number, accepted_points, *fault)
    state = ask_progress(b)
    b.vc.run_for(2)
    assert b.joints() == here
    assert all_progress(state)[-1][:2] == (number, REFUSED)
    assert b.status(state)[2:4] == (fault[0] + 100 * fault[2], 1)
    assert b.healthy()


# -- faults of a point ----------------------------------------------------------------------------

POINT_FAULTS = {
    "limit": ((0.5, [0.1, 0.1, 0.1, 0.1, 2.5, 0.1]), (LIMIT, 5)),
    "largest": ((0.1, [33.554431] * 6), (LIMIT, 1)),
    "too fast": ((0.1, [0.1, 0.1, 0.9, 0.1, 0.1, 0.1]), (TOO_FAST, 3)),
    "no time": ((0.0, [0.1] * 6), (BAD_DURATION, 0)),
    "less than no time": ((-1.0, [0.1] * 6), (BAD_DURATION, 0)),
    "short": ((0.05, [0.1] * 6), (SHORT, 0)),
}


@pytest.mark.parametrize("name", POINT_FAULTS)
@pytest.mark.parametrize("place", [20, 25, 39])
def test_a_fault_in_a_point_cuts_the_stream_before_it(bench, name, place):
    b = bench()
    client, state, rows = begin(b)
    row, (reason, joint) = POINT_FAULTS[name]
    sent = list(rows)
    sent[place] = row
    client.send(batch(7, 20, sent[20:40]))
    assert_cut(b, client, state, (reason, place, joint), rows, place)


def test_a_value_where_no_joint_is(bench):
    b = bench()
    client, state, rows = begin(b)
    words = [word for row in rows[20:30] for word in words_of(row)]
    words[4 * 5 + 3] += 1
    client.send(batch_of_words(7, 0, 20, 10, words))
    assert_cut(b, client, state, (PADDING, 25, 0), rows, 25)


def test_a_fault_in_the_first_point_of_all(bench):
    b = bench()
    client = b.client()
    client.send(batch(7, 0, [(0.0, [0, 0, 0, 0, 2.5, 0]), *line(HOME, 20)[1:]], BEGIN))
    assert_refused(b, client, 1, (LIMIT, 0, 5))
    goes_on(b, client)


def test_a_fault_in_the_second_point_of_all(bench):
    """The first one was right: the robot stands there anyway."""
    b = bench()
    client, state = b.client(), ask_progress(b)
    client.send(batch(7, 0, [(0.0, HOME), (0.1, [1.0] * 6)], BEGIN))
    assert refused(client) == (7, 1, 1, TOO_FAST, 1, 1)
    b.vc.run_for(1)
    assert b.joints() == tuple(HOME)
    assert all_progress(state)[-1] == (1, FAILED, 1, 1, 1, TOO_FAST, 1, 1)
    goes_on(b, client)


@pytest.mark.parametrize("joint", range(6))
def test_a_start_too_far_from_the_robot(bench, joint):
    b = bench()
    client = b.client()
    far = list(HOME)
    far[joint] = 0.02
    client.send(batch(7, 0, [(0.0, far), (1.0, HOME)], BEGIN))
    assert_refused(b, client, 1, (START, 0, joint + 1))


def test_more_speed_than_the_tcp_may_have(bench):
    b = bench(overrides=["tcp_speed_limit=250"])
    client, state = b.client(), ask_progress(b)
    rows = line(HOME, 30, step=0.01, duration=0.2)
    client.send(batch(7, 0, rows, BEGIN))
    accepted(client)
    fast = [(0.1, [v + 0.1 for v in rows[-1][1]])]
    client.send(batch(7, 30, fast, END))
    assert refused(client) == (7, 1, 30, TCP_TOO_FAST, 30, 0)
    b.vc.run_for(9)
    assert close_to(b.joints(), rows[-1][1], 1e-6)
    assert all_progress(state)[-1] == (1, FAILED, 30, 30, 30, TCP_TOO_FAST, 30, 0)


def test_what_is_too_fast_is_slowed_down_where_told_so(bench):
    b = bench(overrides=["trajectory.too_fast=slow_down"])
    client = b.client()
    rows = [(0, HOME), (0.1, [1.0, 0, 0, 0, 0, 0]), (0.02, [1.01, 0, 0, 0, 0, 0])]
    rows.append((1.0, [1.1, 0, 0, 0, 0, 0]))
    client.send(batch(7, 0, rows, BEGIN | END))
    assert accepted(client)[2] == 4
    b.vc.run_for(4)
    assert b.joints()[0] == pytest.approx(1.1, abs=1e-5)
    assert [e for e in b.vc.log if "slowed down" in str(e)]


# -- faults of a batch ----------------------------------------------------------------------------


@pytest.mark.parametrize("bit", [0, 25, 26, 51])
@pytest.mark.parametrize("word", [0, 17, 39])
def test_a_damaged_word(bench, word, bit):
    """The whole batch is refused; also when the damage would pass every check."""
    b = bench()
    client, state, rows = begin(b)
    good = [w for row in rows[20:30] for w in words_of(row)]
    data = bytearray(batch(7, 20, rows[20:30]))
    struct.pack_into("<Q", data, 32 + 8 * word, good[word] ^ (1 << bit))
    client.send(bytes(data))
    assert_cut(b, client, state, (CHECKSUM, 20, 0), rows, 20)


@pytest.mark.parametrize("value", [2**53 + 1, 2**63, 2**64 - 1])
@pytest.mark.parametrize("word", [0, 5, 40])
def test_a_word_that_no_dnum_holds(bench, word, value):
    """Among the points, and in the place of the checksum."""
    b = bench()
    client, state, rows = begin(b)
    data = bytearray(batch(7, 20, rows[20:30]))
    struct.pack_into("<Q", data, 32 + 8 * word, value)
    client.send(bytes(data))
    assert_cut(b, client, state, (CHECKSUM, 20, 0), rows, 20)


def test_two_words_exchanged(bench):
    b = bench()
    client, state, rows = begin(b)
    data = bytearray(batch(7, 20, rows[20:30]))
    data[32:48] = data[40:48] + data[32:40]
    client.send(bytes(data))
    assert_cut(b, client, state, (CHECKSUM, 20, 0), rows, 20)


@pytest.mark.parametrize("first", [0, 19, 21, 2**23 - 1])
def test_a_hole_or_a_repetition(bench, first):
    """R2, C4: a batch that was lost, or came twice."""
    b = bench()
    client, state, rows = begin(b)
    client.send(batch(7, first, rows[20:30]))
    assert_cut(b, client, state, (GAP, 20, 0), rows, 20)


@pytest.mark.parametrize("count", [9, 11, 0, 2**31])
def test_a_count_that_does_not_fit_the_length(bench, count):
    b = bench()
    client, state, rows = begin(b)
    words = [w for row in rows[20:30] for w in words_of(row)]
    client.send(batch_of_words(7, 0, 20, count, words))
    assert_cut(b, client, state, (FRAMING, 20, 0), rows, 20)


@pytest.mark.parametrize("bytes_more", [-8, -4, 4, 8])
def test_a_length_that_does_not_fit(bench, bytes_more):
    b = bench()
    client, state, rows = begin(b)
    data = batch(7, 20, rows[20:30])[16:]
    data = data[:bytes_more] if bytes_more < 0 else data + bytes(bytes_more)
    client.send(HEAD.pack(12 + len(data), POINTS, 2, 0) + data)
    assert_cut(b, client, state, (FRAMING, 20, 0), rows, 20)


def test_more_points_than_room(bench):
    b = bench(overrides=["trajectory.ring=64", "trajectory.preload=10"])
    client, state = b.client(), ask_progress(b)
    rows = line(HOME, 90, step=0.001)
    client.send(batch(7, 0, rows[:30], BEGIN))
    client.send(batch(7, 30, rows[30:60]))
    assert accepted(client)[3] == 33
    assert accepted(client)[3] == 3
    client.send(batch(7, 60, rows[60:64]))
    assert refused(client) == (7, 1, 60, OVERRUN, 60, 0)
    # It waited for more; what was accepted is executed all the same.
    b.vc.run_for(8)
    assert close_to(b.joints(), rows[59][1], 1e-6)
    assert all_progress(state)[-1] == (1, FAILED, 60, 60, 60, OVERRUN, 60, 0)


def test_points_behind_the_end(bench):
    """The trajectory was told whole, and is executed whole."""
    b = bench()
    client, state, rows = begin(b)
    client.send(batch(7, 20, rows[20:30], END))
    assert accepted(client)[2] == 30
    client.send(batch(7, 30, rows[30:40]))
    assert refused(client) == (7, 1, 30, GAP, 30, 0)
    b.vc.run_for(6)
    assert close_to(b.joints(), rows[29][1], 1e-6)
    assert all_progress(state)[-1][:5] == (1, 3, 30, 30, 30)
    goes_on(b, client)


def test_an_end_of_nothing(bench):
    b = bench()
    client = b.client()
    client.send(batch(7, 0, [], BEGIN))
    assert accepted(client)[2] == 0
    client.send(batch(7, 0, [], END))
    assert_refused(b, client, 1, (GAP, 0, 0))
    goes_on(b, client)


@pytest.mark.parametrize("number", [8, 0, 2**23 - 1, 2**31])
def test_a_stream_that_was_never_begun(bench, number):
    """The one under way has nothing to do with it."""
    b = bench()
    client, _, rows = begin(b)
    client.send(batch(number, 20, rows[20:30]))
    assert refused(client) == (number if number < 2**23 else 0, 0, 0, NO_START, -1, 0)
    client.send(batch(7, 20, rows[20:30], END))
    assert accepted(client)[2] == 30
    b.vc.run_for(5)
    assert close_to(b.joints(), rows[29][1], 1e-6)


def test_a_damaged_beginning_does_not_end_what_is_under_way(bench):
    b = bench()
    client, _, rows = begin(b)
    client.send(batch(9, 0, rows[:10], BEGIN, check=1))
    assert refused(client) == (9, 0, 0, CHECKSUM, -1, 0)
    client.send(batch(7, 20, rows[20:30], END))
    assert accepted(client)[2] == 30
    b.vc.run_for(5)
    assert close_to(b.joints(), rows[29][1], 1e-6)


def test_a_damaged_beginning_of_nothing(bench):
    b = bench()
    client = b.client()
    client.send(batch(7, 0, line(HOME, 10), BEGIN | END, check=1))
    assert_refused(b, client, 1, (CHECKSUM, 0, 0))
    goes_on(b, client)


@pytest.mark.parametrize("first", [1, 2**23 - 1])
def test_a_stream_that_does_not_begin_at_its_beginning(bench, first):
    b = bench()
    client = b.client()
    client.send(batch(7, first, line(HOME, 10), BEGIN))
    assert_refused(b, client, 1, (GAP, 0, 0))


@pytest.mark.parametrize("comm", [0, 3, 7])
def test_a_batch_that_is_neither_topic_nor_request(bench, comm):
    b = bench()
    client = b.client()
    client.send(batch(7, 0, line(HOME, 10), BEGIN, comm=comm))
    assert b.vc.run_until(lambda: (client.pump(), client.closed)[1], timeout=5)
    move_well(b)


def test_a_batch_without_a_head(bench):
    b = bench()
    client = b.client()
    for size in (0, 8, 16):
        client.send(HEAD.pack(12 + size, POINTS, 2, 0) + bytes(size))
        code, reason = struct.unpack_from("<i", client.wait_frame(), 12)[0], None
        assert (code, reason) == (2, None)
    move_well(b, client)


def test_a_refusal_of_topics_shows_in_status_and_progress(bench):
    b = bench()
    client, state = b.client(), ask_progress(b)
    rows = line(HOME, 20)
    client.send(batch(7, 0, rows, BEGIN, comm=1))
    client.send(batch(7, 30, rows, comm=1))
    b.vc.run_for(4)
    assert client.frames() == []
    assert all_progress(state)[-1] == (1, FAILED, 20, 20, 20, GAP, 20, 0)
    assert b.status(state)[2:4] == (GAP, 1)


# -- what hinders ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("action", "reason"), [("stop", NOT_EXECUTING), ("motors-off", MOTORS), ("e-stop", 22)]
)
def test_what_hinders_a_beginning(bench, action, reason):
    b = bench()
    b.vc.perform(action)
    b.vc.run_for(0.5)
    client = b.client()
    client.send(batch(7, 0, line(HOME, 10), BEGIN | FLUSH))
    assert_refused(b, client, 1, (reason, -1, 0))


def test_another_build(bench):
    b = bench()
    b.vc.tasks["T_ROS_STATE"]["ROS_common:ROS_shown_control"] = "0123456789ab"
    client = b.client()
    client.send(batch(7, 0, line(HOME, 10), BEGIN | FLUSH))
    assert refused(client) == (7, 1, 0, MIXED, -1, 0)
    b.vc.run_for(1)
    assert b.joints() == tuple(HOME)


def test_an_interruption_between_beginning_and_motion(bench):
    """Points wait for more; the motors go off and on: nothing begins to move by itself."""
    b = bench(overrides=["trajectory.preload=5"])
    client, state = b.client(), ask_progress(b)
    rows = line(HOME, 60, step=0.001)
    client.send(batch(7, 0, rows[:10], BEGIN))
    accepted(client)
    b.vc.perform("motors-off")
    b.vc.run_for(0.3)
    b.vc.perform("motors-on")
    b.vc.perform("start")
    b.vc.run_for(1)
    client.send(batch(7, 10, rows[10:40], FLUSH))
    assert refused(client)[:3] == (7, 1, 10)
    b.vc.run_for(2)
    assert b.joints() == tuple(HOME)
    assert all_progress(state)[-1][1] == FAILED
    move_well(b, client)


def test_a_client_that_vanishes_before_motion(bench):
    b = bench(overrides=["trajectory.preload=5"])
    client = b.client()
    client.send(batch(7, 0, [], BEGIN))
    accepted(client)
    client.close()
    b.vc.run_for(0.5)
    state = b.state_client()
    assert b.status(state)[2:4] == (INCOMPLETE, 1)
    move_well(b)


def test_random_damage_moves_nothing_but_the_prefix(bench):
    """Any bytes of a batch changed, cut or doubled: the robot passes points that were sent."""
    import random

    rng = random.Random(11)
    rows = line(HOME, 40)
    ways = [row[1][0] for row in rows]
    for _ in range(25):
        b = bench()
        client = b.client()
        client.send(batch(7, 0, rows[:20], BEGIN))
        accepted(client)
        data = bytearray(batch(7, 20, rows[20:40], END))
        for _ in range(rng.randint(1, 3)):
            data[rng.randrange(4, len(data))] = rng.randrange(256)
        client.send(bytes(data[: rng.choice((len(data), rng.randrange(1, len(data))))]))
        b.vc.run_for(0.5)
        client.close()
        b.vc.run_for(3)
        here = b.joints()
        assert max(here) - min(here) < 1e-6
        assert -1e-6 <= here[0] <= ways[39] + 1e-6
        assert b.healthy()
        assert math.isfinite(here[0])
