"""The partner's side: envelope, reference and answers, without sockets."""

import math
import random

import pytest

from rapidgen.axes.mapping import JointMap
from rapidgen.client.egm.envelope import Envelope, Reference
from rapidgen.client.egm.exchange import CYCLE, PartnerExchange, Path, Stop, Target
from rapidgen.client.errors import TargetRejected
from rapidgen.config import load_config
from rapidgen.wire.egm.codec import decode_sensor, encode_robot
from rapidgen.wire.egm.values import AxisPositions, EgmMessageError, RobotMessage

GROUP = load_config("irb120").groups[0]
HOME = (0.0, 0.0, 0.0, 0.0, 0.5, 0.0)


@pytest.fixture
def envelope():
    return Envelope.of(GROUP)


class Controller:
    """Sends frames and reads the answers."""

    def __init__(self, envelope, timeout=0.1):
        self.exchange = PartnerExchange(JointMap.of(GROUP), envelope, timeout)
        self.sequence = 0
        self.now = 50.0
        self.joints = HOME

    def frame(self, *, running=True, sequence=None):
        number = self.sequence if sequence is None else sequence
        self.sequence = number + 1
        self.now += CYCLE
        axes = AxisPositions(tuple(map(math.degrees, self.joints)))
        mode = "running" if running else "stopped"
        message = RobotMessage(number, round(self.now * 1000), axes, axes, True, mode, True, False)
        data = self.exchange.answer(encode_robot(message, (7, 0)), self.now)
        answer = decode_sensor(data)
        return tuple(map(math.radians, answer.joints)), self.exchange.state()


@pytest.mark.parametrize(
    ("target", "reason"),
    [
        ([0.0] * 5, "5 values for 6 joints"),
        ([math.nan, 0, 0, 0, 0.5, 0], "joint_1 = nan"),
        ([math.inf, 0, 0, 0, 0.5, 0], "joint_1 = inf"),
        ([9.0, 0, 0, 0, 0.5, 0], "allowed are"),
        ([0.2, 0, 0, 0, 0.5, 0], "would step by 0.2000, allowed is 0.1"),
    ],
)
def test_rejected_targets(envelope, target, reason):
    with pytest.raises(TargetRejected, match=reason):
        envelope.check(target, HOME)


@pytest.mark.parametrize(("fraction", "step"), [(0.0, 1), (1.1, 1), (math.nan, 1), (0.5, 0)])
def test_envelope_without_a_meaning(fraction, step):
    with pytest.raises(ValueError, match="is not"):
        Envelope.of(GROUP, fraction, step)


@pytest.mark.parametrize("seed", range(20))
def test_reference_keeps_the_envelope(envelope, seed):
    """Whatever the targets are: ranges, speeds and accelerations, and it comes to rest."""
    chance = random.Random(seed)
    reference = Reference(envelope, HOME)
    target = HOME
    for _ in range(2_000):
        if chance.random() < 0.05:
            target = tuple(
                chance.uniform(low, high)
                for low, high in zip(envelope.lower, envelope.upper, strict=True)
            )
        before, rates = reference.positions, reference.speeds
        if chance.random() < 0.9:
            reference.follow(target, CYCLE)
        else:
            reference.brake(CYCLE)
        for i, (q, p) in enumerate(zip(reference.positions, before, strict=True)):
            assert envelope.lower[i] <= q <= envelope.upper[i]
            assert abs(q - p) <= envelope.speed[i] * CYCLE * (1 + 1e-9)
            change = abs(reference.speeds[i] - rates[i])
            assert change <= envelope.acceleration[i] * CYCLE * (1 + 1e-9)
    for _ in range(5_000):
        reference.follow(target, CYCLE)
    assert reference.positions == pytest.approx(target, abs=1e-9)
    assert reference.is_standing


def test_answers_repeat_the_position_until_a_target_comes(envelope):
    controller = Controller(envelope)
    for _ in range(100):
        answer, state = controller.frame()
        assert answer == pytest.approx(HOME)
    assert state.guided
    assert not state.stopped
    assert state.age is None


def test_targets_are_answered(envelope):
    controller = Controller(envelope)
    controller.frame()
    goal = (0.05, 0.0, 0.0, 0.0, 0.5, 0.0)
    for _ in range(200):
        controller.exchange.execute(Target(goal, controller.now))
        answer, state = controller.frame()
    assert answer == pytest.approx(goal)
    assert state.age == pytest.approx(CYCLE)


def test_missing_targets_stop_the_robot(envelope):
    controller = Controller(envelope)
    controller.frame()
    controller.exchange.execute(Target((1.0, 0, 0, 0, 0.5, 0), controller.now))
    answers = [controller.frame() for _ in range(200)]
    assert answers[-1][1].stopped
    assert answers[-1][0] == answers[-2][0]
    # Later targets do not count, until the program begins a new run.
    controller.exchange.execute(Target((0.5, 0, 0, 0, 0.5, 0), controller.now))
    assert controller.frame()[0] == answers[-1][0]
    controller.joints = answers[-1][0]
    answer, state = controller.frame(sequence=0)
    assert not state.stopped
    assert answer == pytest.approx(controller.joints)


def test_stop(envelope):
    controller = Controller(envelope)
    controller.frame()
    controller.exchange.execute(Path((0.0, 1.0), (HOME, (0.3, 0, 0, 0, 0.5, 0))))
    for _ in range(50):
        moving = controller.frame()[0]
    controller.exchange.execute(Stop())
    for _ in range(100):
        answer, state = controller.frame()
    assert moving[0] < answer[0] < 0.2
    assert state.stopped


def test_target_of_an_ended_run_is_forgotten(envelope):
    controller = Controller(envelope)
    controller.frame()
    controller.exchange.execute(Target((0.05, 0, 0, 0, 0.5, 0), controller.now))
    controller.frame(running=False)
    assert controller.frame(sequence=0)[0] == pytest.approx(HOME)


def test_missed_frames_are_counted(envelope):
    controller = Controller(envelope)
    controller.frame()
    assert controller.frame(sequence=4)[1].missed == 3


def test_frames_that_are_none(envelope):
    exchange = PartnerExchange(JointMap.of(GROUP), envelope, 0.1)
    for data in (b"", b"\xff" * 30, b"\x0a\x02\x18\x03"):
        with pytest.raises(EgmMessageError):
            exchange.answer(data, 0.0)
