"""Boxes of joint values: stops of streams, guidance, and jogs out of the clearance."""

import numpy as np
import pytest

from rapidgen.client import Robot, Trajectory
from rapidgen.client.collisions import GuidanceCheck
from rapidgen.client.core.program_checks import check_program
from rapidgen.client.core.state_port import StatePort
from rapidgen.client.egm import listen
from rapidgen.client.egm.envelope import Envelope
from rapidgen.client.egm.exchange import EgmState
from rapidgen.client.egm.session import EgmSession
from rapidgen.client.errors import InvalidTrajectory, NotSupported, TargetRejected
from rapidgen.client.program import Program
from rapidgen.collision.boxes import prove_boxes

POST = "things:\n  post: {box: [80, 80, 900], frame: {position: [350, 250, 450]}}"
START = (0.0, 0.2, 0.1, 0.0, 0.6, 0.0)


@pytest.fixture
def robot(cell, folder, monkeypatch):
    monkeypatch.setattr(StatePort, "wire_joints", (*START, 0.0, 0.0, 0.0, 0.0))
    return Robot(folder / "robot.yaml", address="127.0.0.1:1", cell=cell(POST))


def turned(angle):
    return (angle, *START[1:])


def test_boxes_agree_with_random_postures(robot):
    """A proved box has no posture that is too near, of 200 random ones; an unproved box may."""
    scene = robot.cell.world.scene
    random = np.random.default_rng(3)
    proved = refuted = 0
    for _ in range(16):
        middle = np.array(turned(random.uniform(0.2, 0.6))) + random.uniform(-0.1, 0.1, 6)
        half = random.uniform(0, 0.03, 6)
        found = prove_boxes((middle - half)[None], (middle + half)[None], scene)
        values = random.uniform(middle - half, middle + half, (200, 6))
        far = scene.body_distances(values) - [pair.clearance for pair in scene.pairs]
        bad = set(np.flatnonzero((far <= 0).any(axis=0)).tolist())
        assert bad <= {violation.pair for violation in found}
        proved += not found
        refuted += bool(bad)
    assert proved
    assert refuted


def test_first_box_of_each_pair_is_reported(robot):
    boxes = np.array([turned(0.0), turned(0.8), turned(0.4), turned(0.8)])
    found = prove_boxes(boxes, boxes, robot.cell.world.scene)
    assert {violation.box for violation in found} == {1}
    assert all(violation.values == pytest.approx(turned(0.8)) for violation in found)
    assert {violation.verdict for violation in found} <= {"contact", "too near"}


# -- streams ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(("seconds", "free"), [(2.0, True), (0.1, False)])
def test_stream_is_rejected_where_a_stop_may_touch(robot, seconds, free):
    """The path ends 0.06 rad before the contact; fast axes come to rest behind it."""
    core = robot._core
    points = Trajectory.from_points([START, turned(0.36)], seconds=seconds)
    if free:
        core.check(points, "download", is_open=True)
        return
    robot.check(points)
    with pytest.raises(InvalidTrajectory, match=r"RG838.*post"):
        core.check(points, "download", is_open=True)


# -- jogs ------------------------------------------------------------------------------------------


def test_jog_may_leave_the_clearance_but_not_go_deeper(cell, folder, monkeypatch):
    near = turned(0.52)
    monkeypatch.setattr(StatePort, "wire_joints", (*near, 0.0, 0.0, 0.0, 0.0))
    core = Robot(folder / "robot.yaml", address="127.0.0.1:1", cell=cell(POST))._core

    def report(angle, **options):
        program = Program(speed=0.05).move_joints(turned(angle))
        checked = check_program(program, core.known_group, start=core.start, most=100)
        return core.collisions.check_program(checked, **options)

    assert not report(0.42).is_free
    assert report(0.42, leaving=True).is_free
    assert not report(0.58, leaving=True).is_free


# -- guidance --------------------------------------------------------------------------------------


class Loop:
    """A loop without a process."""

    port = 0

    def __init__(self):
        self.sent = []

    def post(self, order):
        self.sent.append(order)


def state(joints, time=0.0):
    return EgmState(
        time=time,
        joints=tuple(joints),
        planned=tuple(joints),
        reference=tuple(joints),
        guided=True,
        motors_on=True,
        program_runs=True,
        converged=True,
        stopped=False,
        utilization=0.0,
        sequence=1,
        missed=0,
        age=None,
        controller_time=time,
    )


@pytest.fixture
def session(robot):
    """A session in the cell, whose loop keeps what is sent: (session, loop, receive)."""
    envelope = Envelope.of(robot.cell.group)
    loop, receivers = Loop(), []

    def connect(receive, _end):
        receivers.append(receive)
        return loop

    guard = GuidanceCheck(robot.cell, envelope, 0.1)
    return EgmSession(envelope, "joints", connect, guard=guard), loop, receivers[0]


def test_targets_are_rejected_before_the_clearance(session):
    guided, loop, receive = session
    reached = 0.0

    def approach():
        nonlocal reached
        for step in range(1, 40):
            receive(state(turned(reached), 0.1 * step))
            guided.send(turned(0.02 * step))
            reached = 0.02 * step

    with pytest.raises(TargetRejected, match=r"RG837.*post"):
        approach()
    # The contact is at 0.417 rad.
    assert 0.2 < reached < 0.417
    assert len(loop.sent) == round(reached / 0.02)


def test_speeds_count_with_their_way_until_the_stop(session):
    guided, loop, receive = session
    receive(state(turned(0.35)))
    guided.send(turned(0.35))
    fast = guided.envelope.speed[0]
    with pytest.raises(TargetRejected, match="RG837"):
        guided.send(turned(0.35), speeds=(fast, 0, 0, 0, 0, 0))
    with pytest.raises(TargetRejected, match="RG837"):
        guided.send(speeds=(fast, 0, 0, 0, 0, 0))
    guided.send(speeds=(-fast, 0, 0, 0, 0, 0))
    assert len(loop.sent) == 2


def test_trajectory_of_guidance_is_checked(session):
    guided, loop, receive = session
    receive(state(START))
    with pytest.raises(TargetRejected, match=r"RG837.*post"):
        guided._begin_path(Trajectory.from_points([START, turned(0.8)], seconds=4))
    guided._begin_path(Trajectory.from_points([START, turned(-0.4)], seconds=4))
    assert len(loop.sent) == 1


def test_guidance_of_the_tcp_is_not_opened_in_a_cell(robot, folder):
    with pytest.raises(NotSupported, match="RG840"):
        listen(str(folder / "robot.yaml"), guidance="pose", cell=robot.cell, port=0)
