"""A client and a virtual controller: in lock-step, and over UDP in real time."""

import asyncio
import inspect
import math
import socket
import threading

import numpy as np
import pytest

import rapidgen.client.egm as egm
from rapidgen.axes import frames
from rapidgen.axes.mapping import JointMap
from rapidgen.client import Pose, Trajectory
from rapidgen.client.egm.exchange import PartnerExchange, Path, Target
from rapidgen.client.egm.lag import estimate
from rapidgen.client.errors import ConnectionFailed, NotReady, RobotTimeout, TargetRejected
from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.servers.egm import serve_egm
from rapidgen.wire.egm.codec import decode_sensor, encode_robot
from rapidgen.wire.egm.values import AxisPositions, RapidData, RobotMessage

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


def controller_of(path, timeout=60, program=PROGRAM, **options):
    (path / "m.mod").write_text(program.replace("@timeout", str(timeout)))
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


POSE = PROGRAM.replace("\\Joint \\Comm", "\\Pose \\Comm").replace(
    "EGMActJoint id \\Tool:=tool0",
    "EGMActPose id \\Tool:=tool0 \\WObj:=wobj0, base, EGM_FRAME_BASE, base, EGM_FRAME_BASE",
)
POSE = POSE.replace("EGMRunJoint", "EGMRunPose").replace(
    "\\J1 \\J2 \\J3 \\J4 \\J5 \\J6", "\\x \\y \\z \\rx \\ry \\rz"
)
POSE = POSE.replace("VAR egmident", "CONST pose base := [[0,0,0],[1,0,0,0]];\nVAR egmident")


def test_poses_in_lock_step(tmp_path):
    """Nothing moves before the first pose; then the TCP is where it was sent."""
    group = load_config("irb120").groups[0]
    exchange = PartnerExchange(JointMap.of(group), egm.Envelope.of(group), 0.1, "pose")
    with controller_of(tmp_path, program=POSE) as controller:
        robot = next(iter(controller.motion.groups.values()))

        def partner(frame):
            return exchange.answer(frame, controller.scheduler.now * 1e-9)

        controller.egm.connect("PC", partner)
        controller.run_for(2)
        state = exchange.state()
        assert state.guided
        assert state.reference_pose is None
        assert robot.positions() == pytest.approx(START, abs=1e-6)
        (x, y, z), orientation = state.pose
        goal = ((x + 0.02, y, z - 0.03), orientation)
        for _ in range(500):
            exchange.execute(Target(controller.scheduler.now * 1e-9, pose=goal))
            controller.run_for(0.004)
        reached = exchange.state().pose
        assert reached[0] == pytest.approx(goal[0], abs=1e-4)
        assert frames.angle_between(reached[1], orientation) < 1e-4
        rates = (0.05, 0.0, 0.0, 0.0, 0.0, 0.1)
        for _ in range(125):
            exchange.execute(Target(controller.scheduler.now * 1e-9, speeds=rates))
            controller.run_for(0.004)
        turned = exchange.state().reference_pose
        assert turned[0][0] - goal[0][0] == pytest.approx(0.025, abs=0.003)
        assert frames.angle_between(turned[1], orientation) == pytest.approx(0.05, abs=0.006)
        # Missing targets end in a stop.
        controller.run_for(0.5)
        assert exchange.state().stopped


def test_rapid_data_are_part_of_each_answer(tmp_path):
    group = load_config("irb120").groups[0]
    exchange = PartnerExchange(JointMap.of(group), egm.Envelope.of(group), 0.1)
    exchange.execute(RapidData(True, (1.0, 2.5)))
    axes = AxisPositions((0.0, 0.0, 0.0, 0.0, 30.0, 0.0))
    frame = encode_robot(RobotMessage(0, 0, axes, axes, True, "running", True, False), (7, 7))
    assert decode_sensor(exchange.answer(frame, 0.0)).data == RapidData(True, (1.0, 2.5))


@pytest.mark.parametrize("delay", [0.008, 0.03, 0.05])
def test_lag_of_a_delayed_copy(delay):
    """The estimate of a pure delay is that delay, also between two frames."""
    times = np.arange(500) * 0.004
    paths = np.stack([0.2 * np.sin(2 * times), np.zeros(500)], axis=1)
    measured = np.stack([0.2 * np.sin(2 * (times - delay)), np.zeros(500)], axis=1)
    result = estimate(times, paths, measured)
    assert result.seconds == pytest.approx(delay, abs=1e-3)
    assert result.residual < 1e-3
    assert estimate(times, np.zeros((500, 2)), measured) is None


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


class Frames:
    """Sends frames of a controller that guides, and stays where it is."""

    def __init__(self, port):
        self.port, self.number = port, 0
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.settimeout(60)

    def exchange(self):
        axes = AxisPositions((0.0, 0.0, 0.0, 0.0, 30.0, 0.0))
        number, self.number = self.number, self.number + 1
        message = RobotMessage(number, 4 * number, axes, axes, True, "running", True, False)
        self.socket.sendto(encode_robot(message, (7, 0)), ("127.0.0.1", self.port))
        return decode_sensor(self.socket.recv(65_536))


def test_the_end_of_the_frames_ends_guidance():
    """A controller does not announce its end [manual 3HAC073318, 3.3]; later frames resume it."""
    states = []
    with egm.listen("irb120", port=0, timeout=60.0) as session:
        session._listeners.append(lambda: states.append(session.state))
        session.explain = lambda: "the driver says why"
        controller = Frames(session.port)
        controller.exchange()
        session._wait(lambda state: state.ended, 60, "guidance goes on")
        with pytest.raises(TargetRejected, match="does not guide the robot: the driver says why"):
            session.send(START)
        controller.exchange()
        session._wait(lambda state: state.sequence == 1, 60, "it is not resumed")
        controller.socket.close()
    found = [(state.sequence, state.guided, state.ended) for state in states]
    assert found[:3] == [(0, True, ""), (0, False, "the driver says why"), (1, True, "")]
    # The end of the session is one, too.
    assert not session.state.guided
    assert session.state.ended


def test_a_frame_without_guidance_ends_it():
    group = load_config("irb120").groups[0]
    exchange = PartnerExchange(JointMap.of(group), egm.Envelope.of(group), 0.1)
    axes = AxisPositions((0.0, 0.0, 0.0, 0.0, 30.0, 0.0))
    found = []
    for number, state in enumerate(("stopped", "running", "stopped", "running")):
        message = RobotMessage(number, 4 * number, axes, axes, True, state, True, False)
        exchange.answer(encode_robot(message, (7, 0)), number * 0.004)
        found.append((exchange.state().guided, exchange.state().ended))
    ended = "the controller has ended the run"
    assert found == [(False, ""), (True, ""), (False, ended), (True, "")]


def test_asyncio():
    """The same calls, awaited, and while another task runs."""

    async def guide():
        async with egm.listen_async("irb120", port=0, timeout=60.0) as session:
            with pytest.raises(RobotTimeout, match="does not guide within"):
                await session.wait_until_guided(0.01)
            controller = Frames(session.port)
            waiting = asyncio.create_task(session.wait_until_guided(60))
            await asyncio.to_thread(controller.exchange)
            state = await waiting
            session.send(state.joints, speeds=[0.0] * 6)
            with pytest.raises(TargetRejected, match="guides by joints"):
                session.send(pose=Pose((0.0, 0.0, 0.0)))
            with pytest.raises(TargetRejected, match="a target is joints"):
                session.send()
            session.write([1.0])
            with pytest.raises(TargetRejected, match="at most 40"):
                session.write([1.0] * 41)
            with pytest.raises(TargetRejected, match="allowed is"):
                await session.follow(Trajectory([0, 1e-3], [START, [0.05, *START[1:]]]))
            # The order may arrive after the first of these frames.
            while session.state.age is None:
                following = asyncio.create_task(session.next_state(60))
                # It begins to wait before the frame is sent.
                await asyncio.sleep(0)
                await asyncio.to_thread(controller.exchange)
                state = await following
            assert state.sequence > 0
            assert session.lag is None
            controller.socket.close()
        with pytest.raises(NotReady, match="closed"):
            await session.next_state()

    asyncio.run(guide())


def test_both_sessions_have_the_same_calls():
    def text(function):
        source = inspect.getsource(function).replace("async ", "").replace("await ", "")
        return "".join(source.split()) if function.__name__ != "close" else ""

    sync, other = egm.EgmSession, egm.AsyncEgmSession
    names = [name for name in dir(sync) if not name.startswith("_")]
    assert names == [name for name in dir(other) if not name.startswith("_")]
    for name in names:
        call, twin = getattr(sync, name), getattr(other, name)
        if call is not twin:
            assert inspect.iscoroutinefunction(twin)
            assert inspect.signature(call) == inspect.signature(twin)
            assert call.__doc__ == twin.__doc__
            assert text(call) == text(twin)
    assert inspect.signature(egm.listen).parameters == (
        inspect.signature(egm.listen_async).parameters
    )
