"""JOINT and STATUS."""

import struct

import pytest

from tests.generate.bench import STOP, trajectory
from tests.generate.driving import (
    E_STOP,
    MOTORS,
    PROGRAM,
    move_well,
    recover,
    reply_of,
    send_all,
    start_moving,
)


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
