"""One trajectory after the other, and clients that come and go."""

import pytest

from tests.generate.bench import STOP, trajectory
from tests.generate.driving import (
    CLIENT_LOST,
    FIVE,
    INCOMPLETE,
    LONG,
    SECONDS,
    START,
    move_well,
    reply_of,
    send_all,
    start_moving,
)


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


def _lost(b):
    return [e for e in b.vc.log if e.title == "ROS: trajectory ended early"]


@pytest.mark.parametrize("how", ["fin", "reset"])
def test_the_event_log_tells_why_a_robot_stops_without_its_client(bench, how):
    """The controller shows nothing of it, and STATUS has nobody left to tell."""
    b = bench()
    client, _ = start_moving(b)
    b.vc.network.close(client.endpoint, abort=how == "reset")
    b.vc.run_for(1)
    assert b.group.is_standing
    (event,) = _lost(b)
    assert event.type.name == "WARNING"
    assert "the connection to the client was lost" in str(event)


def test_a_client_that_takes_over_from_a_moving_one_is_told_in_the_event_log(bench):
    """As a second node does: it connects and says nothing while the first one's robot moves."""
    b = bench()
    start_moving(b)
    b.client()
    b.vc.run_for(1.5)
    assert b.group.is_standing
    assert len(_lost(b)) == 1


def test_clients_that_leave_a_standing_robot_are_not_reported(bench):
    b = bench()
    move_well(b).close()
    b.vc.run_for(1)
    client = b.client()
    send_all(client, trajectory([b.joints(), FIVE[1]], [10, 1]))
    assert reply_of(client)[0] == 1
    b.vc.run_for(0.3)
    assert not b.group.is_standing
    client.send(STOP)
    b.vc.run_for(1)
    client.close()
    b.vc.run_for(1)
    assert not _lost(b)


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
