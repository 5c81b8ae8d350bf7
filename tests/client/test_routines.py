"""Routines of the cell's own that a program calls, against our own driver, on the virtual clock."""

import numpy as np
import pytest
from driven import BENT, caller_comes_late, complaints, driven, wiggle

from rapidgen.client import (
    InvalidProgram,
    MotionFailed,
    MotionStopped,
    Program,
    RoutineFailed,
    TrajectoryRefused,
)
from rapidgen.system.model import ModuleFile
from rapidgen.wire.simple_message.spec import Reason

ROUTINES = {
    "routines.weld": {
        "call": "cell:weld",
        "parameters": [
            {"name": "seam", "type": "num", "mode": "inout"},
            {"name": "dry", "type": "bool"},
            {"name": "done", "type": "bool", "mode": "inout"},
            {"name": "note", "type": "string"},
        ],
    },
    "routines.go_home": {"call": "go_home"},
    "routines.named": {
        "call": "cell:named",
        "parameters": [{"name": "text", "type": "string", "mode": "inout"}],
    },
    "routines.reach": {
        "call": "cell:reach",
        "parameters": [
            {"name": "there", "type": "robtarget"},
            {"name": "back", "type": "jointtarget"},
            {"name": "steps", "type": "num", "mode": "inout"},
        ],
    },
    "routines.taught": {
        "call": "cell:taught",
        "parameters": [
            {"name": "back", "type": "jointtarget"},
            {"name": "there", "type": "robtarget", "mode": "inout"},
            {"name": "place", "type": "jointtarget", "mode": "inout"},
            {"name": "name", "type": "string", "mode": "inout"},
            {"name": "next", "type": "robtarget", "mode": "inout"},
        ],
    },
    "routines.absent": {"call": "nocell:weld"},
    "routines.area": {
        "call": "cell:area",
        "parameters": [{"name": "side", "type": "num"}],
        "returns": "num",
    },
    "routines.report": {"call": "report", "returns": "string"},
    "routines.divides": {"call": "cell:divides"},
    "routines.slowly": {
        "call": "cell:slowly",
        "parameters": [
            {"name": "seconds", "type": "num"},
            {"name": "count", "type": "num", "mode": "inout"},
        ],
    },
    "routines.missing": {"call": "cell:missing"},
    "routines.other": {"call": "cell:weld"},
}
CELL_MODULE = b"""MODULE cell
    PERS string noted := "";
    PERS bool undone := FALSE;
    VAR errnum weld_failed := -1;
    PROC weld(INOUT num seam, bool dry, INOUT bool done, string note)
        noted := note;
        IF seam < 0 RAISE ERR_ARGVALERR;
        seam := seam * 2;
        done := NOT dry;
    ERROR
        RAISE;
    ENDPROC
    PROC named(INOUT string text)
        IF weld_failed = -1 BookErrNo weld_failed;
        IF text = "" RAISE weld_failed;
        text := "<" + text + ">";
    ERROR
        RAISE;
    ENDPROC
    PROC reach(robtarget there, jointtarget back, INOUT num steps)
        MoveJ there, v100, fine, tool0;
        steps := steps + 1;
        MoveAbsJ back \\NoEOffs, v100, fine, tool0;
        steps := steps + 1;
    ENDPROC
    PROC slowly(num seconds, INOUT num count)
        WaitTime seconds;
        count := count + 1;
    ENDPROC
    PROC taught(jointtarget back, INOUT robtarget there, INOUT jointtarget place, INOUT string name,
        INOUT robtarget next)
        there.trans.z := there.trans.z + 10;
        place.robax.rax_2 := back.robax.rax_1 + 30;
        name := name + "!";
        next := there;
        next.robconf := [-1,2,-3,4];
        next.rot := [0,0,0,1];
        IF back.robax.rax_1 > 5 next.trans.x := 9E9;
    ENDPROC
    PROC divides()
        VAR num none := 0;
        none := 1 / none;
    ENDPROC
    FUNC num area(num side)
        RETURN side * side;
    ENDFUNC
    FUNC string report()
        RETURN "well";
    ENDFUNC
    PROC go_home()
        VAR jointtarget home;
        undone := FALSE;
        home := CJointT();
        home.robax.rax_1 := home.robax.rax_1 + 20;
        MoveAbsJ home \\NoEOffs, v10, fine, tool0;
        home.robax.rax_1 := home.robax.rax_1 - 20;
        MoveAbsJ home \\NoEOffs, v10, fine, tool0;
    UNDO
        undone := TRUE;
    ENDPROC
ENDMODULE
"""


@pytest.fixture(autouse=True, params=[0.0, 0.3], ids=["prompt", "late"])
def caller(request, monkeypatch):
    """Whatever a routine does may be over before the call hears that it was taken."""
    if request.param:
        caller_comes_late(monkeypatch, request.param)


def with_routines():
    return driven(overrides=ROUTINES, modules=[ModuleFile("cell", "cell.mod", CELL_MODULE)])


def test_a_result_is_that_of_its_own_call_whenever_it_ends():
    # PROGRESS may tell the end before RESULT is asked for again.
    with with_routines() as (robot, _):
        for n in range(30):
            assert robot.call("slowly", 0.04 + 0.007 * n, float(n)) == (n + 1.0,)


def test_a_routine_is_called_and_tells_its_results():
    with with_routines() as (robot, controller):
        assert robot.call("weld", 3.5, False, False, "seam 7, \u00e9") == (7.0, True)
        assert controller.task("T_ROB1")["cell:noted"] == "seam 7, \u00e9"
        assert robot.call("weld", -0.0, True, True, "x" * 80) == (0.0, False)
        program = Program().move_joints(BENT).call("weld", 1e30, True, False, "")
        program.move_joints([0.0] * 6)
        assert robot.run(program).result().points == 3


def test_what_a_routine_raises_comes_back():
    with with_routines() as (robot, controller):
        with pytest.raises(RoutineFailed) as report:
            robot.call("weld", -1.0, False, False, "")
        assert (report.value.number > 0, report.value.name) == (True, "ERR_ARGVALERR")
        with pytest.raises(RoutineFailed, match="weld_failed") as own:
            robot.call("named", "")
        assert own.value.name == "weld_failed"
        program = Program().call("weld", -1.0, False, False, "").move_joints(BENT)
        with pytest.raises(MotionFailed) as failed:
            robot.run(program).result()
        assert (failed.value.reason, failed.value.reached) == (Reason.ROUTINE, 0)
        for name, *given in (("missing",), ("other",)):
            with pytest.raises(MotionFailed) as failed:
                robot.call(name, *given)
            assert failed.value.reason is Reason.NO_ROUTINE
        assert controller.task("T_ROB1").state == "running"
        assert robot.call("weld", 2.0, False, False, "") == (4.0, True)


def test_call_stopped_by_error_reports_place():
    with with_routines() as (robot, controller):
        with pytest.raises(RoutineFailed, match=r"cell/divides/\d+") as report:
            robot.call("divides")
        assert "PP to Main" in report.value.diagnostics[0].help
        assert (report.value.number, report.value.event.code) == (0, 194199)
        assert controller.task("T_ROB1").state == "error"


def test_texts_and_values_of_functions_come_back():
    with with_routines() as (robot, controller):
        for text in ("x" * 78, "caf\u00e9", "7"):
            assert robot.call("named", text) == (f"<{text}>",)
        assert robot.call("area", 3.0) == (9.0,)
        assert robot.call("report") == ("well",)
        assert not complaints(controller)


def test_a_routine_gets_poses_and_joints():
    with with_routines() as (robot, controller):
        robot.move_to(BENT, speed=1.0)
        target = robot.pose.moved(y=0.05)
        with robot.recording() as recording:
            assert robot.call("reach", target, [0.0] * 6, 1.0) == (3.0,)
        ways = [robot.pose_of(joints)[0] for joints in recording.positions]
        assert min(np.linalg.norm(np.subtract(way, target[0])) for way in ways) < 5e-3
        assert robot.next_state().joints == pytest.approx([0.0] * 6, abs=1e-3)
        far = (9.0, 0.0, 0.0), target[1]
        for given in ((far, [0.0] * 6), (target, [9.0] * 6), (target, [0.0] * 5), (1.0, [0.0] * 6)):
            with pytest.raises(InvalidProgram):
                robot.call("reach", *given, 1.0)
        assert not complaints(controller)


def test_targets_come_back_as_a_routine_leaves_them():
    with with_routines() as (robot, controller):
        robot.move_to(BENT, speed=1.0)
        (x, y, z), q = robot.pose
        zero = [0.0] * 6
        target, place, name, following = robot.call(
            "taught", zero, robot.pose, BENT, "p10", robot.pose
        )
        assert np.allclose(np.hstack(target.pose), (x, y, z + 0.01, *q), atol=1e-5)
        assert place == pytest.approx([BENT[0], np.pi / 6, *BENT[2:]], abs=1e-5)
        assert (name, following.configuration) == ("p10!", (-1, 2, -3, 4))
        assert np.allclose(np.hstack(following.pose), (x, y, z + 0.01, 0, 0, 0, 1), atol=1e-5)
        program = Program(speed=0.2).move_to(target.pose, configuration=target.configuration)
        robot.run(program).result()
        assert np.allclose(robot.pose[0], (x, y, z + 0.01), atol=1e-5)
        # Results of a routine are not checked.
        *_, far = robot.call("taught", [0.1] * 6, robot.pose, BENT, "", robot.pose)
        assert far.pose[0][0] == pytest.approx(9e6, rel=1e-6)
        assert not complaints(controller)


def test_external_axes_of_a_target_come_back_by_their_names():
    routine = {"call": "cell:taught", "parameters": ROUTINES["routines.taught"]["parameters"]}
    module = ModuleFile("cell", "cell.mod", CELL_MODULE)
    with driven("irb120_track", overrides={"routines.taught": routine}, modules=[module]) as (
        robot,
        _,
    ):
        home = [0.0] * len(robot.state.joints)
        target, place, *_ = robot.call("taught", home, robot.pose, home, "", robot.pose)
        assert target.external == {"track": pytest.approx(0.0), "positioner": pytest.approx(0.0)}
        assert place == pytest.approx([0.0, np.pi / 6, *home[2:]], abs=1e-5)


def test_a_routine_of_a_module_that_is_not_there_is_refused_at_once():
    with with_routines() as (robot, _):
        program = Program().move_joints(BENT).call("absent")
        with pytest.raises(TrajectoryRefused) as refused:
            robot.run(program)
        assert (refused.value.reason, refused.value.point) == (Reason.NO_ROUTINE, 1)
        assert robot.state.joints == pytest.approx([0.0] * 6, abs=1e-6)


def test_the_controller_leaves_a_routine_that_takes_too_long():
    with with_routines() as (robot, controller):
        with pytest.raises(MotionFailed) as failed:
            robot.call("go_home", timeout=1.0)
        assert failed.value.reason is Reason.OVERTIME
        robot.wait_until(lambda state: not state.is_moving, 5)
        assert controller.task("T_ROB1")["cell:undone"] is True
        here = robot.state.joints
        robot.sleep(2)
        assert robot.state.joints == pytest.approx(here, abs=1e-6)
        assert robot.call("named", "a") == ("<a>",)


def test_nothing_else_begins_while_a_routine_runs():
    with with_routines() as (robot, _):
        execution = robot.run(Program().call("go_home").move_joints(BENT))
        robot.sleep(1)
        # The client itself sees that something is under way; a driver must not need that.
        robot._core.motion, motion = None, robot._core.motion
        for mode in ("download", "stream"):
            with pytest.raises(TrajectoryRefused) as refused:
                robot.run(Program().move_joints([0.1] * 6), mode=mode)
            assert refused.value.reason is Reason.MOVING
        with pytest.raises(TrajectoryRefused) as refused:
            robot.execute(wiggle(robot), mode="download")
        assert refused.value.reason is Reason.MOVING
        robot._core.motion = motion
        assert execution.result().deviation < 1e-4
        assert robot.state.joints == pytest.approx(BENT, abs=1e-4)


def test_a_stop_leaves_a_routine_wherever_it_is():
    with with_routines() as (robot, controller):
        execution = robot.run(Program().call("go_home").move_joints(BENT))
        robot.sleep(3)
        assert robot.state.is_moving
        robot.stop()
        with pytest.raises(MotionStopped) as report:
            execution.result()
        assert report.value.reached == 0
        assert controller.task("T_ROB1")["cell:undone"] is True
        here = robot.state.joints
        robot.sleep(2)
        assert robot.state.joints == pytest.approx(here, abs=1e-6)
        assert robot.run(Program().move_joints(BENT)).result().deviation < 1e-4


@pytest.mark.parametrize(
    "given",
    [(1.0, True, True), (1.0, 1, True, ""), ("1", True, True, ""), (1.0, True, True, "x" * 81)],
)
def test_call_with_wrong_arguments_is_rejected(given):
    with with_routines() as (robot, _), pytest.raises(InvalidProgram):
        robot.call("weld", *given)
