"""Foreign partners of externally guided motion and the RAPID programs that they come with.

`ABBRobotEGM` is used as it is. The message patterns of clients without a package
(rparak/ABB_EGM_Python, fronchetti/egm-for-abb-robots) are written anew, with the message classes of
abb_robot_client; their RAPID loops have the arguments of the originals.
"""

import math
import socket
import subprocess
import sys
import threading

import pytest

from rapidgen.config import load_config
from rapidgen.controller.controller import VirtualController
from rapidgen.motion.egm.sessions import LockStep
from rapidgen.servers.egm import UdpLink, serve_egm

pb = pytest.importorskip("abb_robot_client._egm_protobuf.egm_pb2")

# The class registers egm.proto, as abb_robot_client does: it has a process of its own.
CLIENT = """
import sys
import numpy as np
from ABBRobotEGM import EGM
mode = sys.argv[1]
with EGM(port=0) as client:
    print(client.socket.getsockname()[1], flush=True)
    start, last, reached = None, None, 0
    while reached < 50:
        received, state = client.receive_from_robot(60)
        if not received:
            sys.exit("no frame")
        if state.mci_state != 3 and state.mci_state != "MCI_RUNNING":
            # A header alone, and RAPID data, are answers, too.
            client.send_to_robot(digital_signal_to_robot=True)
            continue
        if start is None:
            start = state
        if mode == "joints":
            goal = np.array(start.joint_angles) + [6.0, 0, 0, 0, 0, 0]
            client.send_to_robot(goal, rapid_to_robot=np.array([1.0, 2.0]))
            error = abs(goal - state.joint_angles).max()
        else:
            pos = np.array(start.cartesian.pos) + [0.0, 15.0, 0.0]
            orient = np.array(start.cartesian.orient)
            speed = EGM.create_combined_speed_ref()
            client.send_to_robot_cart(pos, orient, speed_ref=speed)
            error = abs(pos - np.array(state.cartesian.pos)).max()
        reached = reached + 1 if error < 0.1 else 0
    facts = (state.motors_on, state.rapid_running, state.utilization_rate >= 0, bool(state.clock))
    print(*facts)
"""
HEAD = r"""MODULE m
CONST egm_minmax near := [-0.1, 0.1];
CONST egm_minmax wide := [-1, 1];
CONST jointtarget home := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
CONST pose base := [[0,0,0],[1,0,0,0]];
VAR egmident id;
VAR egmstate state;
PROC main()
MoveAbsJ home, v1000, fine, tool0;
"""
JOINTS = (
    HEAD
    + r"""EGMGetId id;
EGMSetupUC ROB_1, id, "default", "PC" \Joint \CommTimeout:=60;
EGMActJoint id \Tool:=tool0 \J1:=near \MaxPosDeviation:=30 \MaxSpeedDeviation:=60;
EGMRunJoint id, EGM_STOP_HOLD \J1 \CondTime:=600;
ENDPROC
ENDMODULE
"""
)
POSES = (
    HEAD
    + r"""EGMGetId id;
EGMSetupUC ROB_1, id, "default", "PC" \Pose \CommTimeout:=60;
EGMActPose id \Tool:=tool0 \WObj:=wobj0, base, EGM_FRAME_BASE, base, EGM_FRAME_BASE
 \MaxPosDeviation:=30 \MaxSpeedDeviation:=60;
EGMRunPose id, EGM_STOP_HOLD \x \y \z \rx \ry \rz \CondTime:=600;
ENDPROC
ENDMODULE
"""
)
RPARAK = (
    HEAD
    + r"""EGMReset id;
EGMGetId id;
EGMSetupUC ROB_1, id, "default", "ROB_1:" \Joint;
WHILE TRUE DO
EGMActJoint id \Tool:=tool0 \WObj:=wobj0 \J1:=near \J2:=near \J3:=near \J4:=near \J5:=near \J6:=near
 \LpFilter:=100 \SampleRate:=4 \MaxPosDeviation:=1000 \MaxSpeedDeviation:=1000;
EGMRunJoint id, EGM_STOP_HOLD \J1 \J2 \J3 \J4 \J5 \J6 \CondTime:=1 \RampInTime:=0.1
 \RampOutTime:=0.1 \PosCorrGain:=1;
ENDWHILE
ERROR
IF ERRNO = ERR_UDPUC_COMM THEN
TPWrite "silent";
TRYNEXT;
ENDIF
ENDPROC
ENDMODULE
"""
)
FRONCHETTI = (
    HEAD
    + r"""WHILE TRUE DO
EGMGetId id;
state := EGMGetState(id);
IF state <= EGM_STATE_CONNECTED THEN
EGMSetupUC ROB_1, id, "default", "UCdevice" \Pose;
ENDIF
EGMActPose id \Tool:=tool0 \WObj:=wobj0, base, EGM_FRAME_BASE, base, EGM_FRAME_BASE
 \x:=wide \y:=wide \z:=wide \rx:=wide \ry:=wide \rz:=wide
 \LpFilter:=20 \MaxSpeedDeviation:=100;
EGMRunPose id, EGM_STOP_HOLD \x \y \z \rx \ry \rz \CondTime:=10 \RampInTime:=0 \PosCorrGain:=1;
state := EGMGetState(id);
IF state <= EGM_STATE_CONNECTED THEN
EGMReset id;
ENDIF
ENDWHILE
ENDPROC
ENDMODULE
"""
)


@pytest.mark.parametrize(("mode", "program"), [("joints", JOINTS), ("poses", POSES)])
def test_abb_robot_egm(tmp_path, mode, program):
    """ABBRobotEGM 1.0.7: sequence numbers from 0, no time, its own receive loop."""
    pytest.importorskip("numpy")
    (tmp_path / "m.mod").write_text(program)
    with subprocess.Popen(
        [sys.executable, "-c", CLIENT, mode], stdout=subprocess.PIPE, text=True
    ) as client:
        port = int(client.stdout.readline())
        with VirtualController.from_files(
            {"T_ROB1": [tmp_path / "m.mod"]},
            robots=load_config("irb120").groups,
            cycle="once",
            clock="real",
        ) as controller:
            end = serve_egm(controller, {"pc": ("127.0.0.1", port)})
            ended = threading.Event()
            lines = []

            def read():
                lines.append(client.stdout.read())
                ended.set()

            reader = threading.Thread(target=read)
            reader.start()
            scheduler = controller.scheduler
            scheduler.rebase()
            while not ended.is_set():
                scheduler.advance(scheduler.now + 10_000_000, ended.is_set)
            end()
            reader.join()
    assert client.returncode == 0
    assert lines == ["True True True True\n"]


class Foreign:
    """A controller on the virtual clock, and a partner's socket that the test reads and writes."""

    def __init__(self, path, program):
        (path / "m.mod").write_text(program)
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.settimeout(0)
        self.controller = VirtualController.from_files(
            {"T_ROB1": [path / "m.mod"]}, robots=load_config("irb120").groups, cycle="once"
        )
        address = self.socket.getsockname()
        self.controller.egm.open_loop = lambda _device, exchange: LockStep(
            exchange, UdpLink(address)
        )
        self.frames, self.source = [], None

    def cycle(self):
        """Execute a cycle; return the frame of the controller, None if there is none."""
        self.controller.run_for(0.004)
        try:
            data, self.source = self.socket.recvfrom(65_536)
        except BlockingIOError:
            return None
        self.frames.append(pb.EgmRobot.FromString(data))
        return self.frames[-1]

    def answer(self, message):
        self.socket.sendto(message.SerializeToString(), self.source)

    def close(self):
        self.controller.close()
        self.socket.close()


@pytest.fixture
def foreign(tmp_path):
    made = []

    def make(program):
        made.append(Foreign(tmp_path, program))
        return made[-1]

    yield make
    for one in made:
        one.close()


def joints_of(*values):
    """An answer of rparak's client: no sequence number, no time."""
    message = pb.EgmSensor()
    message.header.mtype = pb.EgmHeader.MSGTYPE_CORRECTION
    message.planned.joints.joints.extend(values)
    return message


def begins(frames):
    return [f for f in frames if f.header.seqno == 0 and f.mciState.state == 3]


def test_loop_of_runs_on_one_identity(foreign):
    """rparak: each convergence ends a run, the loop begins the next one as a new session."""
    one = foreign(RPARAK)
    for _ in range(1_200):
        frame = one.cycle()
        if frame is not None:
            one.answer(joints_of(5.0, 0.0, 0.0, 0.0, 30.0, 0.0))
    assert len(begins(one.frames)) >= 2
    assert one.frames[-1].feedBack.joints.joints[0] == pytest.approx(5.0, abs=0.1)
    assert not list(one.controller.operator.rows)


def test_burst_of_stale_answers_counts_one_per_cycle(foreign):
    """rparak's client sleeps 0.5 s in mid-session, then answers all frames that have come."""
    one = foreign(RPARAK)
    while not begins(one.frames):
        one.cycle()
    for _ in range(50):
        one.cycle()
        one.answer(joints_of(0.0, 0.0, 0.0, 0.0, 30.0, 0.0))
    # One is under way: it was sent after the last cycle.
    for _ in range(125):
        assert one.cycle() is not None
    for i in range(1, 126):
        one.answer(joints_of(0.02 * i, 0.0, 0.0, 0.0, 30.0, 0.0))
    (session,) = one.controller.egm.sessions
    seen = []
    for _ in range(125):
        one.cycle()
        seen.append(math.degrees(session.latest.reference[0]))
    assert seen == pytest.approx([0.02 * i for i in range(1, 126)], abs=1e-9)
    one.cycle()
    assert math.degrees(session.latest.reference[0]) == pytest.approx(2.5)


def test_silent_partner_of_the_loop(foreign):
    """ERR_UDPUC_COMM, TRYNEXT, the next run: the partner may come back."""
    one = foreign(RPARAK)
    while not begins(one.frames):
        one.cycle()
    for _ in range(300):
        one.cycle()
    assert "silent" in one.controller.operator.rows
    assert len(begins(one.frames)) >= 2
    assert one.controller.task("T_ROB1").fault is None


def test_loop_that_gets_its_identity_in_each_turn(foreign):
    """fronchetti: poses of the base, +-1 mm and degree, 10 s, no ramp; the state decides."""
    one = foreign(FRONCHETTI)
    goal = None
    for _ in range(6_000):
        frame = one.cycle()
        if frame is None:
            continue
        if goal is None and frame.mciState.state == 3:
            goal = frame.feedBack.cartesian
            goal.pos.y += 10.0
        message = pb.EgmSensor()
        message.header.mtype = pb.EgmHeader.MSGTYPE_CORRECTION
        message.header.seqno = frame.header.seqno
        if goal is not None:
            message.planned.cartesian.pos.CopyFrom(goal.pos)
            message.planned.cartesian.orient.CopyFrom(goal.orient)
        one.answer(message)
        if len(begins(one.frames)) >= 2:
            break
    assert len(begins(one.frames)) == 2
    assert one.frames[-1].feedBack.cartesian.pos.y == pytest.approx(goal.pos.y, abs=0.5)
    assert one.controller.task("T_ROB1").fault is None
