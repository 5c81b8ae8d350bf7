"""Guided robots in lock-step with a partner, from RAPID to the axes.

Source, unless a test names another: manual 3HAC073318, chapters 2 to 5.
"""

import itertools
import math

import pytest

from rapidgen.config import load_config
from rapidgen.controller.boot_targets import BootOptions, load_target
from rapidgen.controller.controller import VirtualController
from rapidgen.machine.event_log import EventLog
from rapidgen.machine.scheduler import Scheduler
from rapidgen.motion.egm.sessions import MAX_IDENTITIES, EgmSessions
from rapidgen.motion.recorder import Recorder
from rapidgen.rapid.switches import Switches
from rapidgen.servers.control_commands import commands
from rapidgen.system.model import UdpDevice
from rapidgen.wire.egm.codec import decode_robot, encode_sensor
from rapidgen.wire.egm.values import CartesianPose, RapidData, SensorMessage

HEAD = r"""MODULE m
CONST egm_minmax near := [-0.1, 0.1];
CONST jointtarget home := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
VAR egmident id;
VAR intnum alarm;
PROC main()
MoveAbsJ home, v1000, fine, tool0;
EGMGetId id;
"""
TAIL = r"""
EGMReset id;
WaitTime 600;
ENDPROC
TRAP stops
EGMStop id, EGM_STOP_HOLD \RampOutTime:=0.2;
ENDTRAP
TRAP returns
EGMStop id, EGM_STOP_RAMP_DOWN \RampOutTime:=0.5;
ENDTRAP
ENDMODULE
"""
JOINT = r"""EGMSetupUC ROB_1, id, "default", "UCdevice" \Joint \CommTimeout:=1;
EGMActJoint id \Tool:=tool0 \J1:=near \J2:=near \MaxSpeedDeviation:=@speed \MaxPosDeviation:=20;
EGMRunJoint id, EGM_STOP_HOLD \J1 \J2 \CondTime:=@condition;
"""


class Partner:
    """Records messages and answers them by a function."""

    def __init__(self, answer):
        self.answer = answer
        self.messages = []

    def __call__(self, data):
        message = decode_robot(data)
        self.messages.append(message)
        result = self.answer(message)
        return encode_sensor(result) if isinstance(result, SensorMessage) else result


@pytest.fixture
def guided(tmp_path):
    made = []

    def make(body, answer, *, speed=100, condition=1, **options):
        text = (
            HEAD + body.replace("@speed", str(speed)).replace("@condition", str(condition)) + TAIL
        )
        (tmp_path / "m.mod").write_text(text)
        controller = VirtualController.from_files(
            {"T_ROB1": [tmp_path / "m.mod"]},
            robots=load_config("irb120").groups,
            cycle="once",
            autostart=False,
            **options,
        )
        made.append(controller)
        partner = Partner(answer)
        controller.egm.connect("UCdevice", partner)
        controller.start_program()
        return controller, partner, next(iter(controller.motion.groups.values()))

    yield make
    for controller in made:
        controller.close()


def degrees(posture):
    return [math.degrees(q) for q in posture]


def to(*joints):
    return lambda _message: SensorMessage(joints=joints)


def until_guided(controller, partner):
    for _ in range(1_000):
        if any(m.state == "running" for m in partner.messages):
            return
        controller.run_for(0.004)
    raise AssertionError("no run has started")


def test_robot_follows_chosen_axes_until_it_converges(guided):
    controller, partner, group = guided(JOINT, to(10, 5, 7, 0, 30, 0))
    controller.run_for(10)
    # Axis 3 is not chosen. The run ends one second after all are within 0.1 degrees.
    assert degrees(group.positions()) == pytest.approx([10, 5, 0, 0, 30, 0], abs=0.1)
    running = [m for m in partner.messages if m.state == "running"]
    assert running[0].sequence == 0
    assert [m.sequence for m in running] == list(range(len(running)))
    assert {b.milliseconds - a.milliseconds for a, b in itertools.pairwise(running)} <= {4}
    assert sum(m.converged for m in running) == pytest.approx(250, abs=6)


def test_step_response_is_that_of_the_law(guided):
    """Gain 5, low pass of 20 Hz; the robot is 16 ms behind, and an answer counts a cycle later."""
    controller, partner, _ = guided(JOINT, to(10, 0, 0, 0, 30, 0))
    controller.run_for(5)
    running = [m for m in partner.messages if m.state == "running"]
    start = running[0].milliseconds
    x = v = 0.0
    step = 1e-5
    for i in range(round(0.4 / step)):
        if i % 400 == 0:
            message = running[i // 400]
            assert message.milliseconds == start + 4 * (i // 400)
            assert message.planned.joints[0] == pytest.approx(x, abs=0.01)
        v += 2 * math.pi * 20 * (5 * (10 - x) - v) * step
        x += v * step


def test_speed_limit_slows_all_axes_by_one_ratio(guided):
    _, partner, _ = result = guided(JOINT, to(10, 5, 0, 0, 30, 0), speed=2)
    result[0].run_for(3)
    joints = [m.planned.joints for m in partner.messages if m.state == "running"]
    rates = [((b[0] - a[0]) / 0.004, (b[1] - a[1]) / 0.004) for a, b in itertools.pairwise(joints)]
    assert max(abs(r) for pair in rates for r in pair) <= 2.0 + 1e-6
    assert rates[300] == pytest.approx((2.0, 1.0), abs=1e-3)


@pytest.mark.parametrize("target", [25.0, -25.0, 1e6])
def test_deviation_beyond_the_limit_stops_the_program(guided, target):
    controller, partner, group = guided(JOINT, to(target, 0, 0, 0, 30, 0))
    controller.run_for(20)
    assert 194_913 in [e.code for e in controller.log]
    assert abs(degrees(group.positions())[0]) <= 20.0 + 1e-6
    assert group.is_standing
    assert controller.tasks["T_ROB1"].state == "error"
    assert partner.messages[-1].state == "running"


def test_silent_partner(guided):
    controller, _, _ = guided(JOINT, lambda _message: None)
    controller.run_for(3)
    assert any("ERR_UDPUC_COMM" in str(e) for e in controller.log)


def test_partner_that_falls_silent_in_motion(guided):
    """The last speed remains in force until the time-out (ros-industrial/abb_libegm issue 64)."""
    count = iter(range(10_000))
    answer = lambda _m: (  # noqa: E731
        SensorMessage(joint_speeds=(5.0, 0, 0, 0, 0, 0)) if next(count) < 100 else None
    )
    body = JOINT.replace(r"\CondTime:=@condition", r"\CondTime:=9 \PosCorrGain:=0")
    controller, partner, group = guided(body, answer)
    until_guided(controller, partner)
    controller.run_for(3)
    assert degrees(group.positions())[0] == pytest.approx(5.0 * 1.4, abs=0.2)
    assert group.is_standing


@pytest.mark.parametrize(("trap", "end"), [("stops", None), ("returns", 0.0)])
def test_stop_modes(guided, trap, end):
    body = f"CONNECT alarm WITH {trap};\nITimer \\Single, 0.5, alarm;\n" + JOINT
    controller, partner, group = guided(body, to(15, 0, 0, 0, 30, 0), condition=9)
    until_guided(controller, partner)
    controller.run_for(0.4)
    before = degrees(group.positions())[0]
    assert before > 5
    controller.run_for(3)
    assert group.is_standing
    after = degrees(group.positions())[0]
    assert after == pytest.approx(end, abs=1e-6) if end is not None else after >= before
    assert partner.messages[-1].state == "running"
    count = len(partner.messages)
    controller.run_for(1)
    assert len(partner.messages) == count


def test_program_stop_and_restart(guided):
    controller, partner, group = guided(JOINT, to(15, 0, 0, 0, 30, 0), condition=9)
    until_guided(controller, partner)
    controller.run_for(0.2)
    controller.stop_program()
    controller.run_for(1.0)
    assert group.is_standing
    stood = degrees(group.positions())[0]
    assert 1 < stood < 20
    assert partner.messages[-1].state == "stopped"
    controller.run_for(1.0)
    assert degrees(group.positions())[0] == stood
    controller.start_program()
    controller.run_for(3.0)
    assert degrees(group.positions())[0] == pytest.approx(15, abs=0.1)


def test_emergency_stop(guided):
    controller, partner, group = guided(JOINT, to(15, 0, 0, 0, 30, 0), condition=9)
    until_guided(controller, partner)
    controller.run_for(0.2)
    before = degrees(group.positions())[0]
    controller.operation.set_e_stop(True)
    controller.run_for(0.5)
    assert group.is_standing
    stood = degrees(group.positions())[0]
    assert before <= stood < before + 3
    assert partner.messages[-1].motors_on is False
    assert partner.messages[-1].state == "stopped"
    controller.run_for(2)
    assert degrees(group.positions())[0] == stood


@pytest.mark.parametrize("data", [b"", b"\xff" * 20, b"\x0a\x02\x18\x04"])
def test_rejected_datagrams_move_nothing(guided, data):
    controller, _, group = guided(JOINT, lambda _m: data)
    controller.run_for(1)
    assert degrees(group.positions()) == pytest.approx([0, 0, 0, 0, 30, 0], abs=1e-9)
    assert [e.code for e in controller.log if e.code == 194_912] == [194_912]


def test_one_message_is_read_in_a_cycle(guided):
    """A burst of stale answers is executed one by one (ABB: one message per cycle)."""
    controller, partner, _ = guided(JOINT, lambda _m: None, condition=9)
    until_guided(controller, partner)
    answers = controller.egm.sessions[0].loop.link.answers
    for target in range(1, 6):
        answers.append(encode_sensor(SensorMessage(joints=(target, 0, 0, 0, 30, 0))))
    for left in (4, 3, 2, 1, 0):
        controller.run_for(0.004)
        assert len(answers) == left


def test_pose_in_the_base(guided):
    body = r"""EGMSetupUC ROB_1, id, "default", "UCdevice" \Pose \CommTimeout:=1;
EGMActPose id \Tool:=tool0 \WObj:=wobj0, tool0.tframe, EGM_FRAME_BASE, tool0.tframe, EGM_FRAME_BASE
 \x:=near \y:=near \z:=near \rx:=near \ry:=near \rz:=near \MaxSpeedDeviation:=100;
EGMRunPose id, EGM_STOP_HOLD \x \y \rz \CondTime:=0.5;
"""
    start = []

    def answer(message):
        start.append(message.measured.pose)
        (x, y, z), q = start[0].position, start[0].orientation
        return SensorMessage(pose=CartesianPose((x + 10, y + 20, z + 30), q))

    controller, partner, _ = guided(body, answer)
    controller.run_for(10)
    first, last = partner.messages[0].measured.pose, partner.messages[-1].measured.pose
    moved = [b - a for a, b in zip(first.position, last.position, strict=True)]
    # z is not chosen.
    assert moved == pytest.approx([10, 20, 0], abs=0.11)
    assert last.orientation == pytest.approx(first.orientation, abs=1e-3)


def test_stream_without_guidance(guided):
    body = r"""EGMSetupUC ROB_1, id, "default", "UCdevice";
EGMStreamStart id;
MoveAbsJ [[20,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
EGMStreamStop id;
"""
    controller, partner, group = guided(body, to(90, 0, 0, 0, 30, 0))
    controller.run_for(5)
    joints = [m.measured.joints[0] for m in partner.messages]
    assert joints[0] == pytest.approx(0)
    assert joints[-1] == pytest.approx(20, abs=0.1)
    assert {m.state for m in partner.messages} == {"stopped"}
    assert degrees(group.positions())[0] == pytest.approx(20)


def sessions_with(devices):
    scheduler = Scheduler()
    return EgmSessions(scheduler, EventLog(scheduler), (7, 0), devices, lambda _task: None)


def test_egm_identities_are_taken_and_freed():
    sessions = sessions_with((UdpDevice("UCdevice"),))
    assert sessions.device("ucdevice:") is sessions.device("UCdevice") is not None
    assert sessions.device("other") is None
    assert sessions_with(None).device("any:") == UdpDevice("any")
    # [manual 3HAC073318 5.2: four at a time]
    in_use = [sessions.take(task) for task in ("A", "B", "A", "A")]
    assert len(in_use) == MAX_IDENTITIES
    assert sessions.take("B") is None
    sessions.close_task("A")
    free = [sessions.take("C") for _ in range(4)]
    assert [s is None for s in free] == [False, False, False, True]
    sessions.free(in_use[1])
    sessions.free(in_use[1])
    assert sessions.take("D") is not None


DATA = r"""EGMSetupUC ROB_1, id, "default", "UCdevice" \Joint \CommTimeout:=1;
EGMActJoint id \Tool:=tool0 \DOtoSensor:=doReady \DataToSensor:=sent \DIfromSensor:=diSeen
 \DataFromSensor:=received \J1:=near \MaxSpeedDeviation:=100 \MaxPosDeviation:=20;
sent{2} := 2.5;
SetDO doReady, 1;
EGMRunJoint id, EGM_STOP_HOLD \J1 \CondTime:=600;
"""


@pytest.fixture
def exchanging(tmp_path):
    """A program that exchanges data, with the release and the answer of the partner."""
    made = []

    def make(release, answer):
        persistent = "PERS dnum sent{3} := [1, 2, 3];\nPERS dnum received{3} := [7, 8, 9];\n"
        text = HEAD.replace("PROC main", persistent + "PROC main") + DATA + TAIL
        (tmp_path / "m.mod").write_text(text)
        (tmp_path / "cell.yaml").write_text(
            "signals: {doReady: {kind: DO}, diSeen: {kind: DI}}\n"
            "robots: {T_ROB1: {model: irb120}}\n"
        )
        target = load_target(
            (),
            BootOptions(
                {"T_ROB1": [tmp_path / "m.mod"]},
                cell=str(tmp_path / "cell.yaml"),
                robotware=release,
            ),
        )
        controller = VirtualController.boot(target, cycle="once")
        made.append(controller)
        partner = Partner(answer)
        controller.egm.connect("UCdevice", partner)
        return controller, partner

    yield make
    for controller in made:
        controller.close()


def test_rapid_data_of_both_sides(exchanging):
    """RobotWare 7.7 and later: signals and arrays travel in each message."""
    answer = SensorMessage(joints=(0, 0, 0, 0, 30, 0), data=RapidData(True, (0.5,)))
    controller, partner = exchanging((7, 16), lambda _message: answer)
    controller.run_for(2)
    assert partner.messages[-1].data == RapidData(True, (1.0, 2.5, 3.0))
    assert controller.signals["diSeen"] == 1
    assert controller.task("T_ROB1")["received"] == {1: 0.5, 2: 8, 3: 9}


def test_rapid_data_need_a_release(exchanging):
    controller, _ = exchanging((7, 6), lambda _message: None)
    controller.run_for(2)
    assert "needs RobotWare 7.07" in controller.task("T_ROB1").fault.arguments[0]


@pytest.mark.parametrize(
    ("dead_time", "cycles"), [("none", 0), ("short", 2), ("typical", 4), ("long", 12)]
)
def test_dead_time_of_a_switch(guided, dead_time, cycles):
    dialect = Switches(egm_dead_time=dead_time)
    controller, partner, _ = guided(JOINT, to(10, 0, 0, 0, 30, 0), dialect=dialect)
    controller.run_for(3)
    running = [m for m in partner.messages if m.state == "running"]
    planned = [m.planned.joints[0] for m in running]
    measured = [m.measured.joints[0] for m in running]
    assert measured[cycles + 1 :] == pytest.approx(planned[1 : len(planned) - cycles], abs=1e-9)


@pytest.mark.parametrize(("counted", "ends"), [("messages", False), ("cycles", True)])
def test_cycles_that_count_for_convergence(guided, counted, ends):
    """A partner that falls silent in the tolerance; without \\CommTimeout nothing else ends it."""
    body = JOINT.replace("\\CommTimeout:=1", "\\CommTimeout:=600")
    target = to(0, 0, 0, 0, 30, 0)
    dialect = Switches(egm_convergence=counted)
    controller, _partner, _ = guided(
        body, lambda m: target(m) if m.sequence < 20 else None, dialect=dialect
    )
    controller.run_for(4)
    assert any(session.guided for session in controller.egm.sessions) is not ends


def test_clock_of_messages(guided):
    answer = to(0, 0, 0, 0, 30, 0)
    controller, partner, _ = guided(JOINT, answer, dialect=Switches(egm_clock="epoch"))
    controller.run_for(2)
    assert partner.messages[-1].measured.time > 1.6e9
    assert partner.messages[-1].milliseconds < 10_000


def test_utilization_above_the_limit(guided):
    """A step of 10 degrees at gain 5 asks for 50 deg/s; the low pass lets some of it pass."""
    controller, partner, _ = guided(JOINT, to(10, 0, 0, 0, 30, 0), speed=10)
    controller.run_for(1)
    rates = [m.utilization for m in partner.messages if m.state == "running"]
    assert max(rates) > 100
    controller.run_for(10)
    assert partner.messages[-1].utilization < 5


def test_move_while_guided_stops_the_program(guided):
    """Event 50453 [ros-industrial/abb_libegm, issue 110]."""
    body = JOINT.replace("EGM_STOP_HOLD", "EGM_STOP_HOLD \\NoWaitCond").replace("@condition", "600")
    body += "WaitTime 0.5;\nMoveAbsJ home, v1000, fine, tool0;\n"
    controller, _, group = guided(body, to(5, 0, 0, 0, 30, 0))
    controller.run_for(5)
    assert 50_453 in [event.code for event in controller.log]
    assert group.is_standing


LEFT = r"""MODULE m
CONST egm_minmax near := [-0.1, 0.1];
CONST jointtarget home := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
VAR egmident id;
VAR errnum LEAVE := -1;
VAR intnum alarm;
PROC main()
BookErrNo LEAVE;
MoveAbsJ home, v1000, fine, tool0;
EGMGetId id;
CONNECT alarm WITH leaves;
ITimer \Single, 0.5, alarm;
EGMSetupUC ROB_1, id, "default", "UCdevice" \Joint \CommTimeout:=1;
EGMActJoint id \Tool:=tool0 \J1:=near \MaxSpeedDeviation:=10 \MaxPosDeviation:=20;
EGMRunJoint id, EGM_STOP_HOLD \J1 \CondTime:=600;
ERROR (LEAVE)
TPWrite "running" \Bool:=EGMGetState(id) = EGM_STATE_RUNNING;
EGMStop id, EGM_STOP_HOLD \RampOutTime:=0.3;
TPWrite "running" \Bool:=EGMGetState(id) = EGM_STATE_RUNNING;
MoveAbsJ home, v1000, fine, tool0;
TPWrite "home";
EGMReset id;
WaitTime 600;
ENDPROC
TRAP leaves
RAISE LEAVE;
ERROR (LEAVE)
RAISE LEAVE;
ENDTRAP
ENDMODULE
"""


def test_run_that_a_trap_leaves_goes_on_until_egm_stop(tmp_path):
    """ABB's StateMachine add-in: RAISE in a trap, then EGMStop if RUNNING [code]."""
    (tmp_path / "m.mod").write_text(LEFT)
    with VirtualController.from_files(
        {"T_ROB1": [tmp_path / "m.mod"]}, robots=load_config("irb120").groups, cycle="once"
    ) as controller:
        controller.egm.connect("UCdevice", Partner(to(15, 0, 0, 0, 30, 0)))
        controller.run_for(5)
        rows = list(controller.operator.rows)
        assert controller.task("T_ROB1").fault is None
    assert rows == ["runningTRUE", "runningFALSE", "home"]


def test_reference_is_recorded(guided):
    """Recordings and views show where the partner wants the robot to be, and where it is."""
    controller, partner, group = guided(JOINT, to(10, 0, 0, 0, 30, 0))
    until_guided(controller, partner)
    recorder = Recorder(controller.scheduler, group)
    controller.run_for(0.2)
    assert degrees(group.reference())[0] == pytest.approx(10)
    recording = recorder.recording()
    assert math.degrees(recording.commanded[-1][0]) == pytest.approx(10)
    assert 0.5 < math.degrees(recording.actual[-1][0]) < 9
    status = commands(controller)["status"]({})["egm"]
    assert status[0]["guided"]
    assert math.degrees(status[0]["reference"][0]) == pytest.approx(10)
    assert status[0]["age"] <= 0.004 + 1e-9
    controller.run_for(10)
    # After the run there is no partner whose reference would count.
    assert group.reference() == group.positions()
