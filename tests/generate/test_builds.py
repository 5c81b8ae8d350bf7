"""Modules of different builds, and a controller without the signals."""

import math
import struct
from dataclasses import replace

import pytest

from rapidgen.controller.controller import VirtualController
from tests.generate.bench import STOP, point, trajectory
from tests.generate.driving import (
    FIVE,
    MIXED,
    NOT_EXECUTING,
    SECONDS,
    assert_refused,
    mix,
    move_well,
    reply_of,
    send_all,
    with_old_file,
)
from tests.generate.streams import BEGIN, batch, line, refused


@pytest.mark.parametrize("role", ["motion", "motion_server", "supervisor", "control", "state"])
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


def test_missing_signals_are_not_fatal(bench):
    """R15: abb_driver's module does not even load."""
    b = bench()
    b.vc.close()
    b.vc = VirtualController(replace(b.system, signals=(), outputs=()), b.config.groups)
    b.vc.run_for(0.5)
    state = b.state_client()
    assert b.status(state) == (-1, -1, 0, 0, 0, 2, 1)
    move_well(b)


@pytest.mark.parametrize("shown", ["", "0123456789ab"])
@pytest.mark.parametrize("how", ["download", "stream"])
def test_a_program_that_has_not_run_yet_is_not_of_another_build(bench, shown, how):
    """After loading, before the first Start, the motion task shows nothing, or its last build."""
    b = bench()
    b.vc.perform("stop")
    mix(b, "motion", shown)
    b.vc.run_for(3)
    client, state = b.client(), b.state_client()
    if how == "download":
        send_all(client, trajectory(FIVE, SECONDS))
        assert reply_of(client) == (2, (NOT_EXECUTING, -1, 0))
    else:
        client.send(batch(7, 0, line([0.0] * 6, 5), BEGIN))
        assert refused(client) == (7, 1, 0, NOT_EXECUTING, -1, 0)
    assert b.status(state)[2:4] == (NOT_EXECUTING, 1)
    assert not [e for e in b.vc.log if "ROS: tasks of different builds" in str(e)]
    b.vc.perform("pp-to-main")
    b.vc.perform("start")
    b.vc.run_for(0.5)
    move_well(b, client)


def test_without_the_signal_a_program_that_never_ran_is_told_by_what_it_shows(bench):
    b = bench()
    b.vc.close()
    b.vc = VirtualController(replace(b.system, signals=(), outputs=()), b.config.groups)
    b.vc.perform("stop")
    b.vc.run_for(0.5)
    mix(b, "motion", "")
    client = b.client()
    send_all(client, trajectory(FIVE, SECONDS))
    assert reply_of(client) == (2, (NOT_EXECUTING, -1, 0))
