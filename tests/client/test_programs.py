"""Motion programs against our own driver, on the virtual clock."""

import numpy as np
import pytest
from driven import complaints, driven, wiggle

from rapidgen.axes import frames
from rapidgen.client import (
    InvalidProgram,
    MotionFailed,
    MotionStopped,
    NotSupported,
    Program,
    RequestRefused,
    RoutineFailed,
    Speed,
    Trigger,
    pulse,
)
from rapidgen.system.model import ModuleFile, SignalSpec
from rapidgen.wire.simple_message.spec import Reason, TrajectoryState

BENT = [0.2, 0.1, 0.1, 0.3, 0.6, -0.2]


def moved(pose, x=0.0, y=0.0, z=0.0):
    (a, b, c), q = pose
    return (a + x, b + y, c + z), q


def square(robot, size=0.05, **options):
    """Joints, then a way around on lines and with all axes."""
    corner = robot.pose_of(BENT)
    program = Program(speed=0.3, zone="z10", **options).move_joints(BENT)
    program.move_linear(moved(corner, y=size)).move_linear(moved(corner, y=size, z=size))
    return program.move_to(moved(corner, z=size)).move_linear(corner, zone="fine")


def test_a_program_goes_from_joints_to_poses():
    with driven() as (robot, controller):
        execution = robot.run(square(robot))
        assert execution.way == "download"
        result = execution.result()
        assert (result.points, execution.progress.reached) == (5, 5)
        assert execution.progress.state is TrajectoryState.DONE
        assert result.deviation < 1e-4
        assert not complaints(controller)


def test_basic_has_no_programs():
    with (
        driven(overrides={"profile": "basic"}) as (robot, _),
        pytest.raises(NotSupported, match="no programs"),
    ):
        robot.run(Program().move_joints(BENT))


def test_what_no_robot_does_is_told_with_its_instruction():
    with driven() as (robot, _):
        program = square(robot).move_linear(((5.0, 0.0, 0.5), (1, 0, 0, 0)))
        program.move_to(((9.0, 0, 0), (1, 0, 0, 0))).move_joints([9.0] * 6)
        with pytest.raises(InvalidProgram) as told:
            robot.run(program)
        assert [d.message.partition(":")[0] for d in told.value.diagnostics] == [
            "instruction 5",
            "instruction 6",
            "instruction 7",
        ]


def test_single_moves_and_what_lies_where():
    with driven() as (robot, _):
        assert robot.move_to(BENT, speed=1.0).deviation < 1e-4
        pose = robot.pose
        assert np.allclose(np.hstack(pose), np.hstack(robot.pose_of(BENT)), atol=1e-5)
        higher = moved(pose, z=0.03)
        robot.move_linear(higher)
        assert np.allclose(np.hstack(robot.pose), np.hstack(higher), atol=1e-5)
        assert robot.joints_for(pose)[0] == pytest.approx(BENT, abs=1e-4)


def test_a_circle_is_one():
    with driven() as (robot, _):
        robot.move_to(BENT, speed=1.0)
        centre, radius = moved(robot.pose, y=-0.04), 0.04
        program = Program(speed=0.1, zone="z5")
        program.move_circular(moved(centre, z=radius), moved(centre, y=-radius))
        program.move_circular(moved(centre, z=-radius), moved(centre, y=radius), zone="fine")
        with robot.recording() as recording:
            assert robot.run(program).result().deviation < 1e-4
        poses = [robot.pose_of(joints)[0] for joints in recording.positions]
        away = [np.hypot(y - centre[0][1], z - centre[0][2]) for _, y, z in poses]
        assert np.allclose(away, radius, atol=5e-4)
        assert max(y for _, y, _ in poses) - min(y for _, y, _ in poses) > 1.9 * radius


def test_more_than_the_ring_holds_is_streamed():
    with driven(overrides={"trajectory.ring": 64}) as (robot, controller):
        robot.move_to(BENT, speed=1.0)
        program = Program(speed=0.07, zone="z1")
        for n in range(1, 201):
            program.move_linear(moved(robot.pose_of(BENT), y=0.01 * (n % 7), z=0.01 * (n % 5)))
        execution = robot.run(program)
        assert execution.way == "stream"
        result = execution.result()
        assert (result.points, result.starved) == (200, 0)
        assert execution.progress.reached == 200
        assert not complaints(controller)
        with pytest.raises(InvalidProgram, match="ring holds"):
            robot.run(program, way="download")


def test_a_stop_gives_a_prefix_with_its_index():
    with driven() as (robot, _):
        execution = robot.run(square(robot))
        robot.wait_until(lambda _: execution.progress.reached >= 1, 20)
        robot.stop()
        with pytest.raises(MotionStopped) as told:
            execution.result()
        assert 1 <= told.value.reached < 5
        assert robot.run(square(robot)).result().deviation < 1e-4


CELL = {
    "signals.valve": {"kind": "DO", "access": "write"},
    "signals.part": {"kind": "DI"},
    "signals.level": {"kind": "GO", "access": "write"},
    "signals.flow": {"kind": "AO", "access": "write"},
    "tools": [
        {
            "name": "grip",
            "frame": {"position": [0, 0, 100]},
            "load": {"mass": 1, "centre": [0, 0, 50]},
        }
    ],
    "work_objects": [{"name": "table", "user_frame": {"position": [300, 0, 100]}}],
}
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
    "routines.nobody": {"call": "cell:nobody"},
    "routines.other": {"call": "cell:weld"},
}
CELL_MODULE = b"""MODULE cell
    PERS string noted := "";
    PERS bool undone := FALSE;
    PROC weld(INOUT num seam, bool dry, INOUT bool done, string note)
        noted := note;
        IF seam < 0 RAISE ERR_ARGVALERR;
        seam := seam * 2;
        done := NOT dry;
    ERROR
        RAISE;
    ENDPROC
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
WIRED = (
    SignalSpec("valve", "DO"),
    SignalSpec("part", "DI"),
    SignalSpec("flow", "AO"),
    SignalSpec("level", "GO", size=8),
)


def cell():
    return driven(overrides=CELL, signals=WIRED)


def watched(robot, controller, name):
    """(value, TCP) at each change of a signal."""
    signal, group = controller.io[name], controller.motion.group("rob1")
    seen = []
    geometry = robot.group.poses
    signal.changed.add(lambda: seen.append((signal.value, geometry.pose(group.commanded())[0])))
    return seen


def test_signals_are_set_on_the_way():
    with cell() as (robot, controller):
        robot.move_to(BENT, speed=1.0)
        start = robot.pose
        valve, flow, level = (watched(robot, controller, n) for n in ("valve", "flow", "level"))
        program = Program(speed=0.1, zone="z5")
        program.move_linear(moved(start, y=0.1), triggers=pulse("valve", 0.02, 0.05))
        marks = [Trigger.before(0.01, "flow", 0.5), Trigger.ahead(0.2, "level", 7)]
        program.move_linear(moved(start, y=0.1, z=0.08), triggers=marks, zone="fine")
        assert robot.run(program).result().deviation < 1e-4
        (on, opened), (off, closed) = valve
        assert (on, off) == (1, 0)
        assert [opened[1] - start[0][1], closed[1] - start[0][1]] == pytest.approx(
            [0.02, 0.07], abs=2e-3
        )
        ((value, there),) = flow
        assert (value, there[2] - start[0][2]) == pytest.approx((0.5, 0.07), abs=2e-3)
        assert [v for v, _ in level] == [7]
        assert not complaints(controller)


def test_a_speed_for_a_program_is_refused_instead_of_confirmed_and_not_obeyed():
    with cell() as (robot, controller):
        robot.move_to(BENT, speed=1.0)
        execution = robot.run(Program(speed=0.1).move_linear(moved(robot.pose, z=0.05)))
        with pytest.raises(RequestRefused) as refused:
            robot.set_speed(20)
        assert refused.value.reason is Reason.IS_PROGRAM
        assert robot.override == 1.0
        assert execution.result().deviation < 1e-4
        path = wiggle(robot)
        trajectory = robot.execute(path)
        robot.set_speed(20)
        assert trajectory.result().seconds > path.duration
        assert not complaints(controller)


def test_waits_and_signals_stand_between_moves():
    with cell() as (robot, controller):
        robot.move_to(BENT, speed=1.0)
        start = robot.pose
        higher = moved(start, z=0.05)
        valve = watched(robot, controller, "valve")
        program = Program(speed=0.2, zone="z10").move_linear(higher).set("valve").wait(1.0)
        program.set("valve", 0).wait_for("part", timeout=5).move_linear(start)
        execution = robot.run(program)
        assert [d.code for d in execution.warnings] == ["RG674"]
        assert "instruction 0" in execution.warnings[0].message
        part = controller.io["part"]
        controller.scheduler.after(4_000_000_000, lambda: controller.io.set(part, 1))
        result = execution.result()
        assert result.seconds > 3.9
        for _, place in valve:
            assert place == pytest.approx(higher[0], abs=1e-5)
        assert [v for v, _ in valve] == [1, 0]


def test_a_signal_that_does_not_come_ends_a_program():
    with cell() as (robot, _):
        robot.move_to(BENT, speed=1.0)
        program = Program().wait_for("part", timeout=0.5).move_linear(moved(robot.pose, z=0.05))
        with pytest.raises(MotionFailed) as told:
            robot.run(program).result()
        assert (told.value.reason, told.value.reached) == (Reason.WAITED, 0)
        assert np.allclose(np.hstack(robot.pose), np.hstack(robot.pose_of(BENT)), atol=1e-5)


def test_stop_ends_a_wait():
    with cell() as (robot, _):
        robot.move_to(BENT, speed=1.0)
        execution = robot.run(
            Program().wait(100).wait_for("part", timeout=100).move_joints([0.0] * 6)
        )
        robot.sleep(1)
        robot.stop()
        with pytest.raises(MotionStopped):
            execution.result()
        robot.run(Program().wait(0.1).move_joints(BENT)).result()


def test_another_tool_in_another_object():
    with cell() as (robot, controller):
        robot.move_to(BENT, speed=1.0)
        (x, y, z), q = robot.pose
        tip = frames.transform(((x, y, z), q), (0.0, 0.0, 0.1))
        there = (tip[0] - 0.3, tip[1] + 0.05, tip[2] - 0.1), q
        program = Program(speed=0.2, zone="z10").move_linear(moved(robot.pose, z=0.01))
        program.use(tool="grip", work_object="table").move_linear(there)
        execution = robot.run(program)
        assert "another tool" in execution.warnings[0].message
        assert execution.result().deviation < 1e-4
        assert np.allclose(robot.pose[0], (x, y + 0.05, z), atol=1e-5)
        assert not complaints(controller)
        with pytest.raises(InvalidProgram, match="no tool"):
            robot.run(Program().use(tool="gripp").move_linear(there))


@pytest.mark.parametrize(
    "program",
    [
        Program().set("part"),
        Program().set("nobody"),
        Program().set("valve", 2),
        Program().wait_for("flow", timeout=1),
        Program().wait(-1),
        Program().wait(2500),
        Program().set("level", 5000),
        Program().set("flow", float("nan")),
        Program(speed=Speed(0.1, rotary=5000)).move_joints(BENT),
        Program().wait(float("nan")),
        Program(speed=0).move_joints(BENT),
        Program(zone=-1).move_joints(BENT),
        Program().move_joints([0.0] * 5),
        Program().move_joints([float("nan")] * 6),
        Program().move_linear(((0.3, 0, 0.5), (2, 0, 0, 0))),
        Program().move_linear(((float("inf"), 0, 0.5), (1, 0, 0, 0))),
        Program(),
    ],
)
def test_what_cannot_be_is_told_and_nothing_is_sent(program):
    with cell() as (robot, _):
        with pytest.raises(InvalidProgram):
            robot.run(program)
        assert robot.state.trajectory in (None, TrajectoryState.NONE)


def with_routines():
    return driven(overrides=ROUTINES, modules=[ModuleFile("cell", "cell.mod", CELL_MODULE)])


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
        with pytest.raises(RoutineFailed) as told:
            robot.call("weld", -1.0, False, False, "")
        assert told.value.number > 0
        program = Program().call("weld", -1.0, False, False, "").move_joints(BENT)
        with pytest.raises(MotionFailed) as failed:
            robot.run(program).result()
        assert (failed.value.reason, failed.value.reached) == (Reason.ROUTINE, 0)
        for name, *given in (("nobody",), ("other",)):
            with pytest.raises(MotionFailed) as failed:
                robot.call(name, *given)
            assert failed.value.reason is Reason.NO_ROUTINE
        assert controller.task("T_ROB1").state == "running"
        assert robot.call("weld", 2.0, False, False, "") == (4.0, True)


def test_a_stop_leaves_a_routine_wherever_it_is():
    with with_routines() as (robot, controller):
        execution = robot.run(Program().call("go_home").move_joints(BENT))
        robot.sleep(3)
        assert robot.state.is_moving
        robot.stop()
        with pytest.raises(MotionStopped) as told:
            execution.result()
        assert told.value.reached == 0
        assert controller.task("T_ROB1")["cell:undone"] is True
        here = robot.state.joints
        robot.sleep(2)
        assert robot.state.joints == pytest.approx(here, abs=1e-6)
        assert robot.run(Program().move_joints(BENT)).result().deviation < 1e-4


@pytest.mark.parametrize(
    "given",
    [(1.0, True, True), (1.0, 1, True, ""), ("1", True, True, ""), (1.0, True, True, "x" * 81)],
)
def test_arguments_that_do_not_fit_are_told(given):
    with with_routines() as (robot, _), pytest.raises(InvalidProgram):
        robot.call("weld", *given)


def test_a_jog_is_small_and_stands_soon_after_a_lost_client():
    with driven() as (robot, controller):
        robot.jog(joint_1=0.1, joint_5=-0.05)
        assert robot.state.joints[0] == pytest.approx(0.1, abs=1e-4)
        assert robot.state.joints[4] == pytest.approx(-0.05, abs=1e-4)
        for wrong in ({"joint_1": 0.3}, {"joint_9": 0.1}, {"joint_1": float("nan")}):
            with pytest.raises(InvalidProgram):
                robot.jog(**wrong)
        jogging = robot.later.jog(joint_1=-0.2, speed=0.02)
        robot.sleep(1.0)
        group = controller.motion.group("rob1")
        assert not group.is_standing
        # The client says nothing any more, though its connections stand.
        robot._core.heartbeat.due = lambda *_, **__: None
        since = controller.now
        assert controller.run_until(lambda: group.is_standing, timeout=2)
        assert controller.now - since < 0.3
        with pytest.raises((MotionFailed, MotionStopped)):
            jogging.result()


DATA = {
    "data": {
        "cell:count": {"type": "num", "access": "write"},
        "cell:ready": {"type": "bool", "access": "write"},
        "cell:recipe": {"type": "string", "access": "write"},
        "cell:limit": {"type": "num"},
        "cell:nobody": {"type": "num", "access": "write"},
        "cell:other": {"type": "bool"},
        "cell:passing": {"type": "num"},
    }
}
DATA_MODULE = b"""MODULE cell
    PERS num count := 3;
    PERS bool ready := FALSE;
    PERS string recipe := "none";
    PERS num limit := 0.5;
    PERS num other := 1;
    VAR num passing := 1;
ENDMODULE
"""


def with_data():
    return driven(overrides=DATA, modules=[ModuleFile("cell", "cell.mod", DATA_MODULE)])


def test_data_of_the_program_are_read_and_written():
    with with_data() as (robot, controller):
        own = controller.task("T_ROB1")
        assert robot.read_data("cell:count") == 3
        assert robot.write_data("cell:count", -1.5e30) == pytest.approx(-1.5e30)
        assert own["cell:count"] == pytest.approx(-1.5e30)
        for yes in (True, False):
            assert robot.write_data("cell:ready", yes) is yes
            assert own["cell:ready"] is yes
        for text in ("x" * 80, "é 7", ""):
            assert robot.write_data("cell:recipe", text) == text
            assert own["cell:recipe"] == text
        assert robot.read_data("cell:limit") == 0.5
        robot.move_to(BENT, speed=0.3)
        assert not complaints(controller)


def test_data_are_written_while_the_robot_moves_and_it_moves_on():
    with with_data() as (robot, controller):
        execution = robot.run(square(robot))
        robot.sleep(0.5)
        for n in range(20):
            assert robot.write_data("cell:count", n) == n
        assert execution.result().deviation < 1e-4
        assert not complaints(controller)


@pytest.mark.parametrize(
    ("name", "reason"),
    [("cell:nobody", "datum"), ("cell:other", "type"), ("cell:passing", "datum")],
)
def test_data_that_the_program_does_not_have_so_are_refused_the_others_work(name, reason):
    with with_data() as (robot, _):
        with pytest.raises(RequestRefused, match=reason) as refused:
            robot.read_data(name)
        assert refused.value.reason is Reason.NO_DATUM
        assert robot.read_data("cell:count") == 3


def test_data_that_are_not_listed_so_are_not_asked_for():
    with with_data() as (robot, controller):
        with pytest.raises(NotSupported, match="cell:count"):
            robot.read_data("cell:counts")
        with pytest.raises(NotSupported, match="reading only"):
            robot.write_data("cell:limit", 1.0)
        for name, value in (
            ("cell:count", float("nan")),
            ("cell:count", True),
            ("cell:ready", 1),
            ("cell:recipe", "x" * 81),
            ("cell:recipe", "Ω"),
        ):
            with pytest.raises(ValueError, match=name):
                robot.write_data(name, value)
        assert controller.task("T_ROB1")["cell:limit"] == 0.5
