"""The controller's own events, and moves that fail: nothing of an old path resumes."""

import struct

import pytest

from tests.generate.bench import STOP, close_to, trajectory
from tests.generate.driving import (
    COLLISION,
    E_STOP,
    FIVE,
    MODE,
    MOTORS,
    NOT_EXECUTING,
    PROGRAM,
    SECONDS,
    line_with,
    move_well,
    recover,
    reply_of,
    send_all,
    start_moving,
    statements_of,
)


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
