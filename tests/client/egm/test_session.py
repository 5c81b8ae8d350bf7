"""A client and a virtual controller: in lock-step, and over UDP in real time."""

import math
import socket
import threading

import pytest

import rapidgen.client.egm as egm
from rapidgen.axes.mapping import JointMap
from rapidgen.client import Trajectory
from rapidgen.client.egm.exchange import PartnerExchange, Path
from rapidgen.client.errors import ConnectionFailed, RobotTimeout, TargetRejected
from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.servers.egm import serve_egm

PROGRAM = r"""MODULE m
VAR egmident id;
PROC main()
MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
EGMGetId id;
EGMSetupUC ROB_1, id, "default", "PC" \Joint \CommTimeout:=@timeout;
EGMActJoint id \Tool:=tool0 \MaxSpeedDeviation:=200 \MaxPosDeviation:=60;
EGMRunJoint id, EGM_STOP_HOLD \J1 \J2 \J3 \J4 \J5 \J6 \CondTime:=600;
ERROR
EGMReset id;
TPWrite "ended";
ENDPROC
ENDMODULE
"""
START = (0.0, 0.0, 0.0, 0.0, math.radians(30), 0.0)


def controller_of(path, timeout=60, **options):
    (path / "m.mod").write_text(PROGRAM.replace("@timeout", str(timeout)))
    return VirtualController.from_files(
        {"T_ROB1": [path / "m.mod"]},
        robots=load_config("irb120").groups,
        cycle="once",
        **options,
    )


def test_trajectory_in_lock_step(tmp_path):
    """With the speed as feed-forward the robot is behind by its dead time and the filter."""
    group = load_config("irb120").groups[0]
    exchange = PartnerExchange(JointMap.of(group), egm.Envelope.of(group), 0.1)
    with controller_of(tmp_path) as controller:
        robot = next(iter(controller.motion.groups.values()))
        states = []

        def partner(frame):
            answer = exchange.answer(frame, controller.scheduler.now * 1e-9)
            states.append((exchange.state(), robot.positions()))
            return answer

        controller.egm.connect("PC", partner)
        while not states or not states[-1][0].guided:
            controller.run_for(0.004)
        end = (0.4, 0.2, 0.0, 0.0, START[4], 0.0)
        exchange.execute(Path((0.0, 2.0, 3.0), (START, end, end)))
        controller.run_for(4.0)
    assert robot.positions() == pytest.approx(end, abs=1e-4)
    middle = [(s, q) for s, q in states if 0.5 < s.reference[0] / 0.4 < 0.9]
    lags = [(s.reference[0] - q[0]) / 0.2 for s, q in middle]
    assert max(lags) < 0.06


class RealTime:
    """A controller on the real clock, on a thread of its own."""

    def __init__(self, path, port):
        self.controller = controller_of(path, clock="real")
        end = serve_egm(self.controller, {"pc": ("127.0.0.1", port)})
        self.ended = threading.Event()

        def run():
            scheduler = self.controller.scheduler
            scheduler.rebase()
            while not self.ended.is_set():
                scheduler.advance(scheduler.now + 10_000_000, self.ended.is_set)
            end()

        self.thread = threading.Thread(target=run)
        self.thread.start()

    def close(self):
        self.ended.set()
        self.thread.join()
        self.controller.close()


@pytest.fixture
def served(tmp_path):
    with egm.listen("irb120", port=0, timeout=60.0) as session:
        real = RealTime(tmp_path, session.port)
        yield session, real.controller
        real.close()


def test_targets_over_udp(served):
    session, controller = served
    with pytest.raises(TargetRejected, match="does not guide"):
        session.send(START)
    state = session.wait_until_guided(60)
    assert state.joints == pytest.approx(START, abs=1e-6)
    with pytest.raises(TargetRejected, match="would step"):
        session.send([1.0, 0, 0, 0, START[4], 0])
    goal = [0.05, 0.02, 0, 0, START[4], 0]
    session.send(goal)
    while abs(session.state.joints[0] - 0.05) > 1e-3:
        session.next_state(10)
    with pytest.raises(TargetRejected, match="would step"):
        session.follow(Trajectory([0, 1], [[0.5, 0, 0, 0, 0.5, 0], [0.5, 0, 0, 0, 0.5, 0]]))
    with pytest.raises(TargetRejected, match="allowed is"):
        session.follow(Trajectory([0, 0.01], [goal, [0.5, 0.02, 0, 0, START[4], 0]]))
    names = session.envelope.names
    with pytest.raises(TargetRejected, match="other joints"):
        session.follow(Trajectory([0, 1], [goal, START], ["a", *names[1:]]))
    # In another order of joints: read as the same positions.
    turned = [goal[::-1], START[::-1]]
    session.follow(Trajectory([0, 0.5], turned, names[::-1]), timeout=60)
    assert session.state.reference == START
    session.stop()
    while not session.state.stopped:
        session.next_state(10)
    with pytest.raises(TargetRejected, match="stopped"):
        session.send(START)
    assert controller.rapid_tasks["T_ROB1"].fault is None


def test_no_controller():
    with egm.listen("irb120", port=0) as session:
        with pytest.raises(RobotTimeout, match="does not guide within"):
            session.wait_until_guided(0.01)
        with pytest.raises(ConnectionFailed, match="cannot listen"):
            egm.listen("irb120", port=session.port)
    session.close()


def test_two_answers_are_never_sent():
    """Each frame has one answer, and a burst one for its newest."""
    from rapidgen.wire.egm.codec import encode_robot
    from rapidgen.wire.egm.values import AxisPositions, RobotMessage

    axes = AxisPositions((0.0, 0.0, 0.0, 0.0, 30.0, 0.0))
    with (
        egm.listen("irb120", port=0) as session,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as robot,
    ):
        robot.bind(("127.0.0.1", 0))
        robot.settimeout(30)
        for number in range(100):
            message = RobotMessage(number, 4 * number, axes, axes, True, "running", True, False)
            robot.sendto(encode_robot(message, (7, 0)), ("127.0.0.1", session.port))
            robot.recv(65_536)
        robot.setblocking(False)
        with pytest.raises(BlockingIOError):
            robot.recv(65_536)
        while session.state.sequence < 99:
            session.next_state(10)
        assert session.state.missed == 0
