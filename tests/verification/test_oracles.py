"""Oracles of the cases: good runs pass, and each kind of bad one fails.

For positions see test_positions_judged.py.
"""

from types import SimpleNamespace

import pytest

from rapidgen.motion.moves import Zone
from rapidgen.verification import messages, position_checks
from rapidgen.verification.history import assert_no_move_follows
from rapidgen.verification.instruction_hooks import Order, at_call, fails, watched_orders
from rapidgen.verification.messages import (
    JOINT_POSITION,
    JOINT_TRAJ_PT,
    RawFrame,
    RawPointsAccepted,
    RawPointsRefused,
    RawReason,
    RawStatus,
    RawTrajectoryState,
)
from rapidgen.verification.raw_connection import STOP
from rapidgen.verification.stream import Streamer
from rapidgen.verification.suite import (
    boundary_values,
    control,
    corners,
    motion_task,
    refusals,
    state_port,
)
from rapidgen.verification.suite.end_frames import _done, _in_time, _times
from rapidgen.verification.suite.pendant import _Pendant
from rapidgen.verification.suite.points import Table
from tests.verification.made_up import CONFIG, A, B, C, D, along, check_fails

# -- reports -------------------------------------------------------------------------------------


def test_a_reply_that_does_not_come_is_seen(bench):
    link = bench.motion()
    with check_fails("STOP is answered: not within 0.2 s"):
        link.expect_reply(0.2, "STOP is answered")
    link.send(STOP)
    with check_fails("a reply of type 1 arrives"):
        link.reply(1, 0.2)
    with check_fails("a STATUS arrives"):
        link.expect(RawStatus, 0.2, "a STATUS arrives")
    link.send(STOP)
    assert link.reply(JOINT_TRAJ_PT) == messages.RawAcknowledged()
    # Each is read once.
    with check_fails("another"):
        link.expect_reply(0.2, "another")


@pytest.mark.parametrize(
    ("frame", "wanted"),
    [
        (RawFrame(13, 1, 0, bytes(28)), RawStatus(*[0] * 7)),
        (RawFrame(11, 3, 1, b""), messages.RawAcknowledged()),
        (RawFrame(11, 3, 2, b""), messages.RawFailure()),
        (RawFrame(13, 1, 0, bytes(24)), None),
        (RawFrame(13, 1, 1, bytes(28)), None),
        (RawFrame(13, 4, 0, bytes(28)), None),
        (RawFrame(999, 1, 0, b""), None),
        (RawFrame(11, 3, 0, b""), None),
    ],
)
def test_a_message_that_is_none_is_seen(frame, wanted):
    if wanted is not None:
        assert messages.decode(frame) == wanted
        return
    with check_fails("no message has type"):
        messages.decode(frame)


@pytest.mark.parametrize("length", [-1, 0, 11, 1021])
def test_a_length_that_no_message_has_is_seen(length):
    with check_fails("length field"):
        messages.Splitter().feed(length.to_bytes(4, "little", signed=True))


def accepted(**changes):
    return RawPointsAccepted(1, 1, 5, 100, 3, 1, RawTrajectoryState.MOVING)._replace(**changes)


def test_replies_to_a_batch_are_distinguished(bench):
    stream = Streamer(bench)
    stream.last = accepted()
    assert stream.accepted("points") is stream.last
    with check_fails("wanted JOINT_LIMIT"):
        stream.refused(RawReason.JOINT_LIMIT, "points")
    stream.last = RawPointsRefused(1, 1, 5, RawReason.TOO_FAST, 5, 1)
    assert stream.refused(RawReason.TOO_FAST, "points") is stream.last
    with check_fails("wanted JOINT_LIMIT"):
        stream.refused(RawReason.JOINT_LIMIT, "points")
    with check_fails("the reply is"):
        stream.accepted("points")


def test_a_stream_that_is_refused_in_between_is_seen(bench):
    stream = Streamer(bench)
    points = [(p, 0.2) for p, _ in bench.wave(12, duration=0.2)]
    points[7] = (points[7][0], 0.0)
    with check_fails("points up to 8 of 12"):
        stream.all(points, size=4)


def test_control_port_confirmations_are_distinguished():
    control.done(messages.RawAcknowledged(), "PAUSE")
    control.not_done(messages.RawNotDone(RawReason.IDLE), RawReason.IDLE, "PAUSE")
    for reply in (messages.RawNotDone(RawReason.IDLE), messages.RawFailure(), None):
        with check_fails("PAUSE"):
            control.done(reply, "PAUSE")
    for reply in (
        messages.RawNotDone(RawReason.BAD_VALUE),
        messages.RawFailure(),
        messages.RawAcknowledged(),
    ):
        with check_fails("wanted IDLE"):
            control.not_done(reply, RawReason.IDLE, "PAUSE")


def test_a_stop_that_is_not_confirmed_is_seen(bench):
    control.stop(bench.control())
    link = bench.control()
    link.stop_reading()
    with check_fails("STOP is answered"):
        control.stop(link)


def test_each_reply_of_a_table_counts(bench):
    good = messages.RawAcknowledged()
    for wanted in (good, messages.RawRefused(RawReason.JOINT_LIMIT, 0, 1), messages.RawFailure()):
        table = Table(bench)
        table.row(-1, bench.position, 9.0, wanted)
        table.row(1, bench.position, 9.0, good)
        if wanted is good:
            table.ask()
            continue
        with check_fails("point -1 .* wanted"):
            table.ask()


def test_table_checks_its_replies(bench):
    table = Table(bench)
    table.row(-1, bench.position, 9.0, messages.RawAcknowledged())
    table.ask()
    nothing = messages.RawRefused(0, -1, 0)
    table.shows(RawTrajectoryState.RECEIVING, 1, nothing)
    for state, received, reply in (
        (RawTrajectoryState.MOVING, 1, nothing),
        (RawTrajectoryState.RECEIVING, 2, nothing),
        (RawTrajectoryState.RECEIVING, 1, messages.RawRefused(4, 0, 1)),
    ):
        with check_fails("PROGRESS says"):
            table.shows(state, received, reply)
    table.number += 1
    with check_fails("PROGRESS says"):
        table.shows(RawTrajectoryState.RECEIVING, 1, nothing)


def test_a_refusal_that_does_not_come_is_seen(bench):
    points = bench.wave(4)
    wrong = position_checks.changed(points[2][0], 0, 9.0)
    frames = bench.download([*points[:2], (wrong, 60.0), points[3]])
    refusals.refused(bench, frames, [RawReason.JOINT_LIMIT], 1, 2)
    for reason, joint, point in (
        (RawReason.TOO_FAST, 0, None),
        (RawReason.JOINT_LIMIT, 2, None),
        (RawReason.JOINT_LIMIT, 1, 1),
    ):
        with check_fails("wanted in_error|had to be named"):
            refusals.refused(bench, frames, [reason], joint, point)
    with check_fails("it had to be refused"):
        refusals.refused(bench, bench.download(bench.wave(4)), [RawReason.JOINT_LIMIT])


def test_lines_that_the_operator_does_not_get_are_seen(bench):
    pendant = _Pendant(bench)
    with check_fails("the event log has"):
        pendant.says(RawReason.NO_START, 0, 0, after="nothing")
    point = bench.download(bench.wave(3))[68:136]
    for reason, place, joint, wrong in (
        (RawReason.NO_START, 0, 0, ""),
        (RawReason.JOINT_LIMIT, 0, 0, "the event log says"),
        (RawReason.NO_START, 2, 0, "the event log says"),
        (RawReason.NO_START, 0, 3, "the event log says"),
    ):
        bench.motion().send(point)
        bench.run(2.5)
        if wrong:
            with check_fails(wrong):
                pendant.says(reason, place, joint, after="a point alone")
        else:
            pendant.says(reason, place, joint, after="a point alone")


# -- done, reported, in order ---------------------------------------------------------------------


STEPS = [
    motion_task._Step(0, 1, 2, 1),
    motion_task._Step(1, 2, 3, 2),
    motion_task._Step(2, 99, 3, 3, RawTrajectoryState.DONE),
]
MOVING, DONE = RawTrajectoryState.MOVING, RawTrajectoryState.DONE
REPORTED = [(0.5, MOVING, 2, 1), (1.5, MOVING, 3, 2), (2.1, DONE, 3, 3)]


def test_steps_in_their_order_and_time_are_good(bench):
    motion_task._in_order(bench, 0.0, REPORTED, STEPS)


@pytest.mark.parametrize(
    "reply",
    [
        REPORTED[:2],
        REPORTED[1:],
        [REPORTED[1], REPORTED[0], REPORTED[2]],
        [*REPORTED, (3.0, MOVING, 3, 2)],
        [*REPORTED[:2], (2.1, DONE, 3, 2)],
        [*REPORTED[:2], (1.6, DONE, 3, 3)],
        [(0.5, MOVING, 2, 1), (2.4, MOVING, 3, 2), (2.5, DONE, 3, 3)],
    ],
    ids=["not done", "late", "order", "back", "counts", "early", "slow"],
)
def test_steps_out_of_order_or_time_are_seen(bench, reply):
    with check_fails("is reported|not reported|reported in state"):
        motion_task._in_order(bench, 0.0, reply, STEPS)


def test_trajectory_without_done_report_is_detected(bench):
    table, link = Table(bench), bench.motion()
    points = bench.wave(3)
    link.send(bench.download(points))
    bench.wait_until_at(points[-1][0])
    table.number += 1
    _done(bench, table, 3, 0.1)
    for count, number in ((2, table.number), (3, table.number + 1)):
        table.number = number
        with check_fails("points are executed"):
            _done(bench, table, count, 0.1)


def test_times_of_a_motion_count(bench):
    _in_time(bench, "a stay", 1.0, 1.0)
    for seen in (0.9, 1.2):
        with check_fails("a stay took"):
            _in_time(bench, "a stay", seen, 1.0)


def test_when_a_place_was_come_to_and_left():
    record = SimpleNamespace(track=along(A, B, B, C), now=9.0)
    arrived, left = _times(record, 0.0, B)
    assert (arrived, left) == (1.0, 2.0)
    assert _times(record, 0.0, C)[1] == 9.0
    with check_fails("was not at"):
        _times(record, 0.0, D)


def test_a_stay_and_a_slow_way_are_read_from_the_record(bench):
    record = SimpleNamespace(track=[(0.0, A), (1.0, B), (3.0, B), (4.0, C)])
    assert boundary_values._stood_at(record, B, -1.0, 2.0)
    assert not boundary_values._stood_at(record, B, -1.0, 2.5)
    assert not boundary_values._stood_at(record, (0.5, 0.5), -1.0, 0.1)
    path = SimpleNamespace(track=along(A, B))
    boundary_values._slow_to(path, B, 0.0, 1.0)
    with check_fails("faster than"):
        boundary_values._slow_to(path, B, 0.0, 0.5)
    with check_fails("was left out"):
        boundary_values._slow_to(path, C, 0.0, 1.0)


def test_a_motion_that_begins_late_is_seen(bench):
    link = bench.motion()
    bench.run(0.5)
    link.send(bench.download(bench.wave(3)))
    motion_task.begins_soon(bench, bench.now)
    bench.wait_until_standing()
    link.send(bench.download(bench.wave(3)))
    with check_fails("after the end frame"):
        motion_task.begins_soon(bench, bench.now - 0.5)


# -- rounds of the state port ---------------------------------------------------------------------


PERIOD = CONFIG.state_period


def rounds_at(*times):
    return [state_port.Round(t, [RawFrame(JOINT_POSITION, 1, 0, bytes(44))]) for t in times]


def test_rounds_on_their_turn_are_good(bench):
    state_port.on_turn(bench, rounds_at(*(n * PERIOD for n in range(9))), "")
    state_port.on_turn(bench, rounds_at(0.0, PERIOD + 0.004, 2 * PERIOD), "")


@pytest.mark.parametrize(
    "times",
    [
        (0.0, 1.0),
        (0.0, 1.0, 3.0, 4.0),
        (0.0, 1.2, 2.0, 3.0),
        (0.0, 1.05, 2.15, 3.2, 4.3),
        (0.0, 1.0, 1.0, 2.0),
    ],
    ids=["few", "missing", "late", "drifting", "twice"],
)
def test_rounds_off_their_turn_are_seen(bench, times):
    with check_fails("rounds"):
        state_port.on_turn(bench, rounds_at(*(t * PERIOD for t in times)), "a client")


def test_messages_to_clients_are_compared(bench):
    one, other = bench.state(), bench.state()
    bench.run(1)
    since = bench.now
    bench.run(1)
    nothing = state_port._NONE
    state_port._all_alike(bench, [(one, nothing), (other, nothing)], since)
    with check_fails("gets messages"):
        state_port._all_alike(bench, [(one, state_port.RawFeature.PROGRESS)], since)
    when, frame = other.frames[-1]
    other.frames[-1] = (when, frame._replace(data=bytes(len(frame.data))))
    with check_fails("different"):
        state_port._all_alike(bench, [(one, nothing), (other, nothing)], since)


@pytest.mark.parametrize(
    ("which", "field", "value", "what"),
    [
        (JOINT_POSITION, "joints", (0.1, *[0.0] * 9), "the robot is at"),
        (JOINT_POSITION, "joints", (*[0.0] * 9, 0.1), "the robot is at"),
        (13, "in_error", 1, "is reported with"),
        (13, "error_code", 4, "is reported with"),
        (13, "in_motion", 1, "is reported with"),
        (13, "motion_possible", 0, "STATUS says"),
        (13, "e_stopped", 1, "STATUS says"),
        (1301, "state", RawTrajectoryState.MOVING, "is reported with"),
        (1301, "reason", 4, None),
    ],
)
def test_round_with_false_content_is_detected(bench, which, field, value, what):
    link = bench.watcher()
    bench.run(1)
    reply = state_port.rounds(link, bench.now - 0.5)[1:]
    state_port._is_true(bench, reply)
    for one in reply:
        for at, frame in enumerate(one.frames):
            if frame.number == which:
                content = messages.decode(frame)._replace(**{field: value})
                raw = messages.encode(content)
                one.frames[at] = frame._replace(data=raw[16:])
    if what is None:
        state_port._is_true(bench, reply)
        return
    with check_fails(what):
        state_port._is_true(bench, reply)


# -- orders, zones --------------------------------------------------------------------------------


def orders(*rows):
    return [Order(time, instruction, free) for time, instruction, free in rows]


@pytest.mark.parametrize(
    "given",
    [
        orders(),
        orders((1.0, "MoveAbsJ", True), (2.0, "StopMove", True)),
        # The motion task was about to when it was stopped, and gets no farther.
        orders((2.0, "StopMove", True), (2.1, "MoveAbsJ", False)),
    ],
)
def test_orders_until_a_stop_are_good(given):
    assert_no_move_follows(given, 1.9, 2.5)


@pytest.mark.parametrize(
    "given",
    [
        orders((2.0, "StopMove", True), (2.1, "MoveAbsJ", True)),
        orders((2.0, "StopMove", True), (9.0, "MoveJ", True)),
        orders((1.0, "StopMove", True), (2.6, "MoveAbsJ", True)),
    ],
)
def test_order_after_a_stop_is_detected(given):
    with check_fails("of the old trajectory"):
        assert_no_move_follows(given, 1.9, 2.5)


def test_orders_are_recorded(bench):
    received = watched_orders(bench)
    link = bench.motion()
    bench.start_motion(link, bench.wave(6), 0.3)
    assert {o.instruction for o in received if o.free} == {"MoveAbsJ"}
    link.send(STOP)
    bench.run(0.5)
    assert "StopMove" in {o.instruction for o in received}
    assert [o.time for o in received] == sorted(o.time for o in received)


def test_instruction_fails_as_often_as_requested(bench):
    calls = []
    end = fails(bench, "ROS_motion", "ClearPath", "ERR_PATH_STOP", 2, after=1)
    at_call(bench, "ROS_motion", "ClearPath", 3, lambda: calls.append(bench.now))
    link = bench.motion()
    for _ in range(2):
        bench.start_motion(link, bench.wave(6))
        link.send(STOP)
        bench.wait_until_standing()
        bench.run(1)
    assert len(calls) == 1
    end()
    bench.assert_healthy()


def test_zones_are_compared_in_each_part():
    zone = Zone(False, 0.01, 0.015, 0.015, 0.2, 0.02, 0.3)
    assert corners._alike(zone, zone)
    for part in ("tcp", "orientation", "external", "angle", "linear", "rotary"):
        values = {n: getattr(zone, n) for n in ("tcp", "orientation", "external")}
        values |= {n: getattr(zone, n) for n in ("angle", "linear", "rotary")}
        values[part] *= 1.02
        assert not corners._alike(zone, Zone(False, *values.values()))
    assert not corners._alike(zone, Zone(True, 0.01, 0.015, 0.015, 0.2, 0.02, 0.3))
