"""Streams that end early: STOP, another trajectory, a lost client, the controller's own events."""

import pytest

from tests.generate.bench import STOP, close_to, trajectory
from tests.generate.driving import (
    CLIENT_LOST,
    COLLISION,
    FAILED,
    MODE,
    MOTORS,
    PROGRAM,
    STOPPED,
    STOPPED_STATE,
    SUPERSEDED,
    all_progress,
    ask_progress,
    move_well,
    recover,
    reply_of,
    statements_of,
)
from tests.generate.streams import (
    BEGIN,
    END,
    FLUSH,
    accepted,
    batch,
    batches,
    line,
    refused,
    send_stream,
)

HOME = [0.0] * 6
E_STOP = 22


def under_way(b, count=60):
    """A stream that is executed: client, state client, rows."""
    client, state = b.client(), ask_progress(b)
    rows = line(HOME, 100)
    for data in batches(7, rows[:count], end=False):
        client.send(data)
        accepted(client)
    b.vc.run_for(1.5)
    assert 0.02 < b.joints()[0] < 0.1
    return client, state, rows


def stays(b, seconds=3):
    here = b.joints()
    b.vc.run_for(seconds)
    assert b.joints() == here


def test_stop_on_the_motion_port(bench):
    b = bench()
    client, state, rows = under_way(b)
    client.send(STOP)
    assert reply_of(client) == (1, ())
    b.vc.run_for(1)
    stays(b)
    told = all_progress(state)[-1]
    assert told[:3] == (1, STOPPED_STATE, 60)
    assert told[5:] == (STOPPED, told[4], 0)
    assert b.status(state)[2:5] == (0, 0, 0)
    client.send(batch(7, 60, rows[60:80]))
    assert refused(client) == (7, 1, 60, STOPPED, told[4], 0)
    stays(b)
    move_well(b, client)


@pytest.mark.parametrize("count", [0, 5])
def test_stop_before_it_has_begun_to_move(bench, count):
    b = bench(overrides=["trajectory.preload=5"])
    client, state = b.client(), ask_progress(b)
    rows = line(HOME, 60)
    client.send(batch(7, 0, rows[:count], BEGIN))
    accepted(client)
    client.send(STOP)
    assert reply_of(client) == (1, ())
    client.send(batch(7, count, rows[count : count + 20], FLUSH))
    assert refused(client)[:4] == (7, 1, count, STOPPED)
    b.vc.run_for(2)
    assert b.joints() == tuple(HOME)
    assert all_progress(state)[-1][:2] == (1, STOPPED_STATE)
    move_well(b, client)


def test_stop_and_points_in_one_packet(bench):
    """Points behind a STOP are of a stream that has ended."""
    b = bench()
    client, _, rows = under_way(b)
    client.send(STOP + batch(7, 60, rows[60:80]))
    assert reply_of(client) == (1, ())
    assert refused(client)[3] == STOPPED
    b.vc.run_for(1)
    stays(b)


def test_another_stream_takes_its_place(bench):
    b = bench()
    client, state, _ = under_way(b)
    client.send(batch(8, 0, [], BEGIN))
    assert accepted(client)[:3] == (8, 2, 0)
    b.vc.run_for(1)
    stays(b, 1)
    assert all_progress(state)[-1][0] == 2
    rows = line(list(b.joints()), 20, step=0.002)
    client.send(batch(8, 0, rows, END))
    assert accepted(client)[2] == 20
    b.vc.run_for(4)
    assert close_to(b.joints(), rows[-1][1], 1e-6)
    client.send(batch(7, 60, line(HOME, 3)))
    assert refused(client)[3] == 10


def test_another_stream_may_begin_with_points_while_the_ring_is_full(bench):
    """Nothing of what it ends counts as being in the ring."""
    b = bench()
    client = b.client()
    slow = line(HOME, 120, step=1e-5)
    for first in range(0, 120, 30):
        client.send(batch(7, first, slow[first : first + 30], BEGIN if first == 0 else 0))
        accepted(client)
    b.vc.run_for(0.5)
    rows = line(list(b.joints()), 30)
    client.send(batch(8, 0, rows, BEGIN | END))
    assert accepted(client)[:3] == (8, 2, 30)
    b.vc.run_for(6)
    assert close_to(b.joints(), rows[-1][1], 1e-5)


def test_another_stream_has_to_begin_where_the_robot_then_stands(bench):
    b = bench()
    client, _, _ = under_way(b)
    client.send(batch(8, 0, line(HOME, 20), BEGIN | END))
    code = refused(client)
    assert code[:3] == (8, 2, 0)
    assert code[3:5] == (5, 0)
    stays(b)


def test_a_download_takes_its_place(bench):
    b = bench()
    client, state, rows = under_way(b)
    client.send(trajectory([HOME, [0.1] * 6], [10, 2])[0])
    b.vc.run_for(1)
    client.send(batch(7, 60, rows[60:80]))
    assert refused(client) == (7, 1, 60, SUPERSEDED, -1, 0)
    stays(b, 1)
    assert all_progress(state)[-1][0] == 2
    move_well(b, client)


def test_a_stream_takes_the_place_of_a_download(bench):
    b = bench()
    client = b.client()
    client.send(b"".join(trajectory([HOME, [0.3] * 6], [10, 3])))
    assert reply_of(client)[0] == 1
    b.vc.run_for(1)
    client.send(batch(7, 0, [], BEGIN))
    accepted(client)
    b.vc.run_for(1)
    rows = line(list(b.joints()), 20, step=0.002)
    client.send(batch(7, 0, rows, END))
    accepted(client)
    b.vc.run_for(4)
    assert close_to(b.joints(), rows[-1][1], 1e-6)


def test_half_a_download_is_dropped_by_a_stream(bench):
    b = bench()
    client = b.client()
    frames = trajectory([HOME, [0.01] * 6, [0.02] * 6], [10, 1, 1])
    client.send(frames[0] + frames[1])
    send_stream(client, line(HOME, 20))
    client.send(frames[2])
    assert reply_of(client)[0] == 2
    b.vc.run_for(4)
    assert b.healthy()


@pytest.mark.parametrize("how", ["fin", "reset"])
def test_a_client_that_vanishes(bench, how):
    b = bench()
    client, state, _ = under_way(b)
    b.vc.network.close(client.endpoint, abort=how == "reset")
    b.vc.run_for(1)
    stays(b)
    assert all_progress(state)[-1][1::4] == (FAILED, CLIENT_LOST)
    move_well(b)


def test_a_client_that_vanishes_while_it_is_starved(bench):
    b = bench()
    client = b.client()
    rows = line(HOME, 10)
    client.send(batch(7, 0, rows, BEGIN))
    accepted(client)
    b.vc.run_for(3)
    client.close()
    b.vc.run_for(0.5)
    state = b.state_client()
    assert b.status(state)[2:5] == (CLIENT_LOST, 1, 0)
    move_well(b)


def test_a_silent_link_gives_way_to_the_newest_client(bench):
    b = bench()
    client, _, _ = under_way(b)
    b.vc.network.silence(client.endpoint)
    new = b.client()
    b.vc.run_for(6)
    assert b.group.is_standing
    move_well(b, new)


def test_a_stream_whose_batches_come_seconds_apart_is_not_given_away(bench):
    """Another client waits meanwhile; it is served when the first one is gone."""
    b = bench()
    client = b.client()
    rows = line(HOME, 90)
    client.send(batch(7, 0, rows[:30], BEGIN))
    accepted(client)
    other = b.client()
    for first in (30, 60, 90, 90):
        b.vc.run_for(2.5)
        client.send(batch(7, first, rows[first : first + 30]))
        accepted(client)
    assert close_to(b.joints(), rows[-1][1], 1e-6)
    client.close()
    move_well(b, other)


@pytest.mark.parametrize(
    ("action", "reasons"),
    [
        ("stop", {PROGRAM}),
        ("e-stop", {E_STOP}),
        ("motors-off", {MOTORS}),
        ("manual", {MODE, MOTORS, PROGRAM}),
    ],
)
@pytest.mark.parametrize("starved", [False, True])
def test_the_controllers_own_events(bench, action, reasons, starved):
    b = bench()
    if starved:
        client, state = b.client(), ask_progress(b)
        rows = line(HOME, 100)
        client.send(batch(7, 0, rows[:10], BEGIN))
        accepted(client)
        b.vc.run_for(3)
    else:
        client, state, rows = under_way(b)
    b.vc.perform(action)
    b.vc.run_for(1)
    told = all_progress(state)[-1]
    assert told[1] == FAILED
    assert told[5] in reasons
    count = told[2]
    client.send(batch(7, count, rows[count : count + 10]))
    assert refused(client)[:4] == (7, 1, count, told[5])
    recover(b)
    stays(b, 4)
    client.send(batch(7, count, rows[count : count + 10], FLUSH))
    assert refused(client)[3] == told[5]
    stays(b, 1)
    move_well(b, client)


def test_power_failure(bench):
    b = bench()
    under_way(b)
    b.vc.perform("power-loss")
    b.vc.run_for(2)
    here = b.joints()
    recover(b)
    b.vc.run_for(5)
    assert close_to(b.joints(), here, 1e-6)
    move_well(b)


def test_a_move_that_fails(bench):
    b = bench()
    client, state, rows = under_way(b)
    b.vc.tasks["T_ROB1"]["ROS_motion:fault"] = COLLISION
    b.vc.run_for(3)
    stays(b)
    told = all_progress(state)[-1]
    assert (told[1], told[5]) == (FAILED, COLLISION)
    client.send(batch(7, 60, rows[60:80]))
    assert refused(client)[3] == COLLISION
    move_well(b, client)


@pytest.mark.parametrize("action", ["stop", "wire"])
def test_a_stop_at_every_statement(bench, action):
    """Of the motion task, among them those of a stream that is starved and of one that ends."""
    stopped = 0
    lines = [
        line_of
        for routine in ("next_point", "stops_before", "wait_for_points", "finish")
        for line_of in statements_of(bench(), routine)
    ]
    for line_of in lines:
        b = bench()
        client = b.client()
        rows = line(HOME, 12, step=0.01, duration=0.2)
        happened = []

        def act(b=b, client=client, happened=happened):
            happened.append(b.vc.now)
            if action == "stop":
                b.vc.perform("stop")
            else:
                client.network.send(client.endpoint, STOP)

        b.vc.before_statement("T_ROB1", "ROS_motion", line_of, 3, act)
        client.send(batch(7, 0, rows[:6], BEGIN))
        accepted(client)
        b.vc.run_for(3)
        client.send(batch(7, 6, rows[6:], END))
        if not b.vc.run_until(lambda happened=happened: bool(happened), timeout=5):
            continue
        stopped += 1
        b.vc.run_for(1)
        here = b.joints()
        if action == "stop":
            b.vc.perform("start")
        b.vc.run_for(4)
        assert close_to(b.joints(), here, 1e-6), line_of
        client.frames()
        move_well(b, client)
    assert stopped > 15
