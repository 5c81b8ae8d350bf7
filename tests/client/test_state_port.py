"""Rate and velocity from delayed reads are those of the controller."""

import pytest

from rapidgen.client.core.group import Group
from rapidgen.client.core.state_port import StatePort
from rapidgen.config import load_config
from rapidgen.wire.simple_message import encode, messages

PERIOD = 0.02
"""s between two messages of the controller"""
SPEED = 0.1
"""rad/s, of each joint"""


class Reads:
    """A state port that reads so many messages at such a time."""

    def __init__(self) -> None:
        config = load_config("irb120")
        self.now, self.sent = 0.0, 0
        self.port = StatePort(lambda: self.now)
        self.port.use(Group.of(config, config.groups[0]))

    def read(self, now: float, count: int) -> None:
        self.now, data = now, b""
        for _ in range(count):
            axes = (self.sent * PERIOD * SPEED,) * 6 + (0.0,) * 4
            data += encode(messages.JointPosition(0, axes))
            self.sent += 1
        self.port.feed(data)


@pytest.mark.parametrize("then", [0, 1, 2, 40])
def test_rate_and_velocity_where_messages_came_together(then):
    reads = Reads()
    reads.read(1.0, 1)
    assert reads.port.rate == 0
    assert set(reads.port.state.velocity) == {0.0}
    reads.read(1.8, 40)
    for n in range(then):
        reads.read(1.8 + (n + 1) * PERIOD, 1)
    assert reads.port.rate == pytest.approx(1 / PERIOD)
    assert reads.port.state.velocity == pytest.approx((SPEED,) * 6)


def test_what_came_together_first_is_no_earlier_read():
    reads = Reads()
    reads.read(1.0, 3)
    assert reads.port.rate == 0
    reads.read(1.0 + PERIOD, 1)
    assert reads.port.rate == pytest.approx(1 / PERIOD)
    assert reads.port.state.velocity == pytest.approx((SPEED,) * 6)


def test_a_new_connection_begins_anew():
    reads = Reads()
    reads.read(1.0, 1)
    reads.read(1.1, 5)
    reads.port.restart()
    assert reads.port.rate == 0
    reads.read(5.0, 1)
    assert reads.port.rate == 0
    assert set(reads.port.state.velocity) == {0.0}
