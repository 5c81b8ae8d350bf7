"""The partner's side: envelope, reference and answers, without sockets."""

import itertools
import math
import random
from dataclasses import replace

import pytest

from rapidgen.axes import frames
from rapidgen.axes.mapping import JointMap
from rapidgen.client.egm.envelope import Envelope, TcpLimits
from rapidgen.client.egm.exchange import CYCLE, PartnerExchange, Path, Stop, Target
from rapidgen.client.egm.reference import PoseReference, Reference
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
        controller.exchange.execute(Target(controller.now, goal))
        answer, state = controller.frame()
    assert answer == pytest.approx(goal)
    assert state.age == pytest.approx(CYCLE)


def test_missing_targets_stop_the_robot(envelope):
    controller = Controller(envelope)
    controller.frame()
    controller.exchange.execute(Target(controller.now, (1.0, 0, 0, 0, 0.5, 0)))
    answers = [controller.frame() for _ in range(200)]
    assert answers[-1][1].stopped
    assert answers[-1][0] == answers[-2][0]
    # Later targets do not count, until the program begins a new run.
    controller.exchange.execute(Target(controller.now, (0.5, 0, 0, 0, 0.5, 0)))
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
    controller.exchange.execute(Target(controller.now, (0.05, 0, 0, 0, 0.5, 0)))
    controller.frame(running=False)
    assert controller.frame(sequence=0)[0] == pytest.approx(HOME)


def test_target_moves_on_with_its_speeds(envelope):
    """A caller at 10 Hz and a reference at 250 Hz: the robot moves evenly."""
    controller = Controller(envelope)
    controller.frame()
    answers, begin = [], controller.now
    for i in range(500):
        if i % 25 == 0:
            at = 0.2 * (controller.now - begin)
            goal, rates = (at, 0.0, 0.0, 0.0, 0.5, 0.0), (0.2, 0.0, 0.0, 0.0, 0.0, 0.0)
            controller.exchange.execute(Target(controller.now, goal, speeds=rates))
        answers.append(controller.frame()[0][0])
    assert answers[-1] == pytest.approx(0.2 * (controller.now - begin), abs=1e-3)
    steps = [b - a for a, b in itertools.pairwise(answers[250:])]
    assert steps == pytest.approx([0.2 * CYCLE] * len(steps), abs=1e-6)


def test_speeds_without_a_target(envelope):
    controller = Controller(envelope)
    controller.frame()
    rates = (0.1, 0.0, 0.0, 0.0, -0.2, 0.0)
    for _ in range(250):
        controller.exchange.execute(Target(controller.now, speeds=rates))
        _, state = controller.frame()
    # It accelerates for about 0.1 s.
    assert state.reference[0] == pytest.approx(0.1, abs=0.01)
    assert state.reference[4] == pytest.approx(0.3, abs=0.02)


@pytest.mark.parametrize(
    ("speeds", "reason"),
    [([9.0, 0, 0, 0, 0, 0], "would have speed"), ([math.nan] * 6, "nan"), ([0.1], "1 values")],
)
def test_rejected_speeds(envelope, speeds, reason):
    with pytest.raises(TargetRejected, match=reason):
        envelope.check_speeds(speeds)


@pytest.mark.parametrize("seed", range(4))
def test_driven_axes_stop_before_their_range_ends(envelope, seed):
    """Any speeds for any time: an axis brakes within its acceleration and stays in its range."""
    chance = random.Random(seed)
    reference = Reference(envelope, HOME)
    rates = HOME
    for _ in range(3_000):
        if chance.random() < 0.005:
            rates = tuple(chance.choice((-9.0, 0.0, 9.0)) for _ in HOME)
        before, speeds = reference.positions, reference.speeds
        reference.drive(rates, CYCLE)
        for i, (q, v) in enumerate(zip(reference.positions, reference.speeds, strict=True)):
            assert envelope.lower[i] <= q <= envelope.upper[i]
            assert abs(q - before[i]) <= envelope.speed[i] * CYCLE * (1 + 1e-9)
            assert abs(v - speeds[i]) <= envelope.acceleration[i] * CYCLE * (1 + 1e-6)


@pytest.mark.parametrize("seed", range(5))
def test_pose_keeps_the_limits(seed):
    chance = random.Random(seed)
    limits = TcpLimits(lower=(-0.1, -0.2, 0.0), upper=(0.3, 0.2, 0.4))
    reference = PoseReference(limits, ((0.0, 0.0, 0.1), frames.UNIT))
    turn = limits.rotation * CYCLE * (1 + 1e-9)
    target = reference.pose
    for _ in range(2_000):
        if chance.random() < 0.01:
            axis = frames.scale((1.0, 1.0, 1.0), 3**-0.5)
            target = (
                (chance.uniform(-0.1, 0.3), chance.uniform(-0.2, 0.2), chance.uniform(0, 0.4)),
                frames.about(axis, chance.uniform(-3, 3)),
            )
        before = reference.pose
        reference.follow(target, CYCLE)
        assert frames.distance(before[0], reference.pose[0]) <= limits.speed * CYCLE * (1 + 1e-9)
        assert frames.angle_between(before[1], reference.pose[1]) <= turn
    for _ in range(5_000):
        reference.follow(target, CYCLE)
    assert reference.is_standing
    assert reference.pose[0] == pytest.approx(target[0], abs=1e-9)
    assert frames.angle_between(reference.pose[1], target[1]) < 1e-7


@pytest.mark.parametrize(
    ("pose", "reason"),
    [
        (((0.1, 0, 0), frames.UNIT), "would step by 0.1000"),
        (((0, 0, 0), (math.cos(0.1), math.sin(0.1), 0, 0)), "would turn by 0.2000"),
        (((0, 0, 0), (2.0, 0, 0, 0)), "has length 2"),
        (((math.nan, 0, 0), frames.UNIT), "nan"),
        (((0, 0, -0.01), frames.UNIT), "z = -0.0100"),
        (((0, 0), frames.UNIT), "a pose is"),
    ],
)
def test_rejected_poses(pose, reason):
    limits = TcpLimits(lower=(-1.0, -1.0, 0.0))
    with pytest.raises(TargetRejected, match=reason):
        limits.check(pose, frames.IDENTITY)


def test_missed_frames_are_counted(envelope):
    controller = Controller(envelope)
    controller.frame()
    assert controller.frame(sequence=4)[1].missed == 3


@pytest.mark.parametrize("seed", range(6))
def test_answers_keep_the_envelope(envelope, seed):
    """Whatever a caller orders, and however frames come: a session's checks are not needed."""
    chance = random.Random(seed)
    controller = Controller(envelope)
    answer, before = controller.frame()[0], controller.now
    for _ in range(1_500):
        joints = tuple(chance.uniform(-9, 9) for _ in HOME)
        rates = tuple(chance.uniform(-20, 20) for _ in HOME)
        if chance.random() < 0.05:
            target = Target(controller.now, joints)
            order = chance.choice(
                (
                    target,
                    replace(target, speeds=rates),
                    Target(controller.now, speeds=rates),
                    Path((0.0, 0.3), (joints, HOME)),
                    Stop(),
                )
            )
            controller.exchange.execute(order)
        gap = chance.choice((0, 0, 0, 0, 1, 5))
        controller.now += gap * CYCLE
        # A stop of the program and a new run, now and then: they begin where the robot is.
        begins = chance.random() < 0.01
        if begins:
            controller.joints = answer
        number = 0 if begins else controller.sequence + gap
        last, (answer, _) = answer, controller.frame(sequence=number)
        time, before = controller.now - before, controller.now
        for i, (q, p) in enumerate(zip(answer, last, strict=True)):
            assert envelope.lower[i] - 1e-9 <= q <= envelope.upper[i] + 1e-9
            # Frames carry milliseconds, so their distance is known to 1 ms.
            assert abs(q - p) <= envelope.speed[i] * (time + 1e-3)


def test_frames_that_are_none(envelope):
    exchange = PartnerExchange(JointMap.of(GROUP), envelope, 0.1)
    for data in (b"", b"\xff" * 30, b"\x0a\x02\x18\x03"):
        with pytest.raises(EgmMessageError):
            exchange.answer(data, 0.0)


def test_target_with_a_duration_ends_without_a_stop(envelope):
    """The robot slows down and waits; a target without one ends the session's targets."""
    controller = Controller(envelope)
    controller.frame()
    for _ in range(2):
        controller.exchange.execute(
            Target(controller.now, speeds=(0.2, *HOME[1:4], 0, 0), lasts=0.1)
        )
        answers = [controller.frame() for _ in range(100)]
        moved = [answer[0] for answer, _ in answers]
        assert moved[20] > moved[0]
        assert moved[-1] == moved[-2]
        assert not answers[-1][1].stopped


def test_spline_begins_from_the_present_reference(envelope):
    """Position and speed are continuous, and a last velocity is slowed down after the end."""
    controller = Controller(envelope)
    controller.frame()
    end, rate = (0.1, *HOME[1:]), (0.2, 0, 0, 0, 0, 0)
    controller.exchange.execute(Path((0.5,), (end,), ((0.0,) * 6,), since=-0.5))
    answers = [controller.frame()[0][0] for _ in range(125)]
    controller.exchange.execute(Path((1.0,), ((0.25, *HOME[1:]),), (rate,)))
    answers += [controller.frame()[0][0] for _ in range(400)]
    speeds = [(b - a) / CYCLE for a, b in itertools.pairwise(answers)]
    most = envelope.acceleration[0] * CYCLE * 1.01
    assert max(abs(b - a) for a, b in itertools.pairwise(speeds)) < most
    # In the middle of the first spline the speed is 1.5 times the mean.
    assert min(speeds[120:150]) > 0.14
    assert speeds[-1] == 0
    assert 0.25 < answers[-1] < 0.27
