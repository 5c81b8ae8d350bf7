"""HELLO and PROGRESS."""

import struct

import pytest

from tests.generate.bench import trajectory
from tests.generate.driving import (
    DONE,
    FIVE,
    LIMIT,
    MOVING,
    RECEIVING,
    REFUSED,
    SECONDS,
    ask_progress,
    hold,
    progress_of,
    reply_of,
    send_all,
    statements_of,
)


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
