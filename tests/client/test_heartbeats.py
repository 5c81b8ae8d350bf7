"""When a heartbeat is due, and when its answer is late: the schedule without a connection."""

import pytest

from rapidgen.client.core.heartbeat import HeartbeatSchedule
from rapidgen.client.core.request_port import PendingReply
from rapidgen.wire.simple_message import messages


def sent(timeout=2.0, at=100.0):
    schedule = HeartbeatSchedule(timeout)
    pending = PendingReply(messages.HEARTBEAT.number)
    schedule.sent(at, timeout, pending)
    return schedule, pending


@pytest.mark.parametrize(
    ("now", "listening", "is_late"),
    [
        (102.0, 0.0, False),  # exactly in time
        (102.01, 0.0, True),
        (101.0, 0.0, False),
        (104.9, 103.0, False),  # this process was held up until 103
        (105.01, 103.0, True),
        (102.5, 99.0, True),  # it was listening before it was sent
    ],
)
def test_heartbeat_reply_after_timeout_is_late(now, listening, is_late):
    schedule, _ = sent()
    assert schedule.is_late(now, listening) is is_late


def test_an_answer_that_has_come_or_is_not_awaited_is_not_late():
    schedule, pending = sent()
    pending.reply = messages.HeartbeatReply(1, 2)
    assert not schedule.is_late(1000.0, 0.0)
    assert not schedule.is_refused
    schedule, pending = sent()
    schedule.forget()
    assert not schedule.is_late(1000.0, 0.0)
    assert not schedule.is_armed
    assert not HeartbeatSchedule(2.0).is_late(1000.0, 0.0)


def test_a_refused_heartbeat():
    schedule, pending = sent()
    assert not schedule.is_refused
    pending.reply = messages.NotDone(5)
    assert schedule.is_refused


@pytest.mark.parametrize(("timeout", "period"), [(2.0, 0.5), (1.0, 0.25), (20.0, 0.5)])
def test_the_next_one_is_due_in_a_quarter_of_the_time_out_at_most_half_a_second(timeout, period):
    schedule, pending = sent(timeout)
    assert schedule.due(1000.0, moves=True) is None  # one is unanswered
    pending.reply = messages.HeartbeatReply(1, 2)
    assert schedule.due(100.0 + period - 0.001, moves=True) is None
    assert schedule.due(100.0 + period, moves=True) == timeout


def test_it_begins_at_once_and_ends_with_the_motion():
    schedule = HeartbeatSchedule(2.0)
    assert schedule.due(0.0, moves=False) is None
    assert schedule.due(0.0, moves=True) == 2.0
    pending = PendingReply(messages.HEARTBEAT.number)
    schedule.sent(0.0, 2.0, pending)
    assert schedule.is_armed
    pending.reply = messages.HeartbeatReply(1, 2)
    assert schedule.due(0.1, moves=False) == 0.0
    schedule.sent(0.1, 0.0, pending)
    assert not schedule.is_armed
    assert schedule.due(5.0, moves=False) is None
    assert schedule.due(0.1, moves=True) == 2.0
    assert HeartbeatSchedule(0.0).due(0.0, moves=True) is None
