"""Motion programs against our own driver, on the virtual clock."""

from dataclasses import replace

import numpy as np
import pytest
from driven import BENT, complaints, driven

from rapidgen.axes import frames
from rapidgen.client import (
    ConnectionLost,
    InvalidProgram,
    MotionFailed,
    MotionStopped,
    NotSupported,
    Pose,
    Program,
    Speed,
    Trigger,
    UserTool,
    UserWorkObject,
    pulse,
)
from rapidgen.client.core.group import Group
from rapidgen.client.core.program_checks import check_program
from rapidgen.config import load_config
from rapidgen.config.model import ExposedSignal
from rapidgen.system.model import SignalSpec
from rapidgen.wire.simple_message.spec import Port, Reason, TrajectoryState


def square(robot, size=0.05, **options):
    """Joints, then a way around on lines and with all axes."""
    corner = robot.pose_of(BENT)
    program = Program(speed=0.3, zone="z10", **options).move_joints(BENT)
    program.move_linear(corner.moved(y=size)).move_linear(corner.moved(y=size, z=size))
    return program.move_to(corner.moved(z=size)).move_linear(corner, zone="fine")


def test_a_program_goes_from_joints_to_poses():
    with driven() as (robot, controller):
        execution = robot.run(square(robot))
        assert execution.mode == "download"
        result = execution.result()
        assert (result.points, execution.progress.reached) == (5, 5)
        assert execution.progress.state is TrajectoryState.DONE
        assert result.deviation < 1e-4
        assert not complaints(controller)


def test_basic_has_no_programs():
    with (
        driven(overrides={"profile": "basic"}) as (robot, _),
        pytest.raises(NotSupported, match="does not accept programs"),
    ):
        robot.run(Program().move_joints(BENT))


def test_impossible_instruction_is_reported_with_number():
    with driven() as (robot, _):
        program = square(robot).move_linear(Pose((5.0, 0.0, 0.5)))
        program.move_to(Pose((9.0, 0, 0))).move_joints([9.0] * 6)
        with pytest.raises(InvalidProgram) as report:
            robot.run(program)
        assert [d.message.partition(":")[0] for d in report.value.diagnostics] == [
            "instruction 5",
            "instruction 6",
            "instruction 7",
        ]


@pytest.mark.parametrize(
    ("name", "to", "code", "report"),
    [
        (
            "irb120",
            (3.3, 0.0, 0.5),
            "RG671",
            "irb120: the flange cannot be at [3300.0",
        ),
        ("irb120", (-0.37, 0.05, 0.5), "RG671", "rax_1 would be at"),
        (
            "crb15000",
            (0.0, 0.0, 0.57),
            "RG672",
            "leaves the robot's reach after 82%: rax_5",
        ),
    ],
)
def test_check_line_out_of_reach_is_reported(name, to, code, report):
    config = load_config(name)
    group = Group.of(config, config.groups[0])
    start = group.map.to_controller(BENT)
    program = Program().move_linear(Pose(to, group.poses.pose(start)[1]))
    with pytest.raises(InvalidProgram) as error:
        check_program(program, group, start=start, most=10)
    (fault,) = error.value.diagnostics
    assert fault.code == code
    assert report in fault.message


def test_a_scara_sets_no_signals_on_the_way_of_a_joint_move():
    config = replace(load_config("irb910sc"), signals=(ExposedSignal("valve", "DO", "write"),))
    group, here = Group.of(config, config.groups[0]), (0.9, -0.3, 0.0, 0.3)
    target = Pose(*group.poses.pose(here))
    on_the_way = [Trigger.before(0.01, "valve")]
    for program in (
        Program().move_joints(here, triggers=on_the_way),
        Program().move_to(target, triggers=on_the_way),
    ):
        with pytest.raises(InvalidProgram) as error:
            check_program(program, group, start=here, most=10)
        assert [fault.code for fault in error.value.diagnostics] == ["RG670"]
        assert "on which side of it the arm is" in str(error.value)
    check_program(Program().move_linear(target, triggers=on_the_way), group, start=here, most=10)


def test_single_moves_and_what_lies_where():
    with driven() as (robot, _):
        assert robot.move_to(BENT, speed=1.0).deviation < 1e-4
        pose = robot.pose
        assert np.allclose(np.hstack(pose), np.hstack(robot.pose_of(BENT)), atol=1e-5)
        higher = pose.moved(z=0.03)
        robot.move_linear(higher)
        assert np.allclose(np.hstack(robot.pose), np.hstack(higher), atol=1e-5)
        assert robot.joints_for(pose)[0] == pytest.approx(BENT, abs=1e-4)


def test_a_circle_is_one():
    with driven() as (robot, _):
        robot.move_to(BENT, speed=1.0)
        centre, radius = robot.pose.moved(y=-0.04), 0.04
        program = Program(speed=0.1, zone="z5")
        program.move_circular(centre.moved(z=radius), centre.moved(y=-radius))
        program.move_circular(centre.moved(z=-radius), centre.moved(y=radius), zone="fine")
        with robot.recording() as recording:
            assert robot.run(program).result().deviation < 1e-4
        poses = [robot.pose_of(joints)[0] for joints in recording.positions]
        away = [np.hypot(y - centre[0][1], z - centre[0][2]) for _, y, z in poses]
        assert np.allclose(away, radius, atol=5e-4)
        assert max(y for _, y, _ in poses) - min(y for _, y, _ in poses) > 1.9 * radius


@pytest.mark.parametrize(
    ("degrees", "report"), [(239.0, None), (239.8, "longer than 239.5 degrees")]
)
def test_a_circle_is_not_too_long(degrees, report):
    """The driver, which has it in whole micrometres, refuses it from 240 degrees on."""
    config = load_config("irb120")
    group = Group.of(config, config.groups[0])
    start = group.map.to_controller(BENT)
    pose, turn = Pose(*group.poses.pose(start)), np.radians(degrees)
    via, end = (
        pose.moved(y=0.03 * (1 - np.cos(angle)), z=0.03 * np.sin(angle))
        for angle in (turn / 2, turn)
    )
    program = Program().move_circular(via, end)
    if report is None:
        check_program(program, group, start=start, most=10)
        return
    with pytest.raises(InvalidProgram, match=report):
        check_program(program, group, start=start, most=10)


def test_more_than_the_ring_holds_is_streamed():
    with driven(overrides={"trajectory.ring": 64}) as (robot, controller):
        robot.move_to(BENT, speed=1.0)
        program = Program(speed=0.07, zone="z1")
        for n in range(1, 201):
            program.move_linear(robot.pose_of(BENT).moved(y=0.01 * (n % 7), z=0.01 * (n % 5)))
        execution = robot.run(program)
        assert execution.mode == "stream"
        result = execution.result()
        assert (result.points, result.starved) == (200, 0)
        assert execution.progress.reached == 200
        assert not complaints(controller)
        with pytest.raises(InvalidProgram, match="ring holds"):
            robot.run(program, mode="download")


def test_a_stop_gives_a_prefix_with_its_index():
    with driven() as (robot, _):
        execution = robot.run(square(robot))
        robot.wait_until(lambda _: execution.progress.reached >= 1, 20)
        robot.stop()
        with pytest.raises(MotionStopped) as report:
            execution.result()
        assert 1 <= report.value.reached < 5
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
        program.move_linear(start.moved(y=0.1), triggers=pulse("valve", 0.02, 0.05))
        marks = [Trigger.before(0.01, "flow", 0.5), Trigger.ahead(0.2, "level", 7)]
        program.move_linear(start.moved(y=0.1, z=0.08), triggers=marks, zone="fine")
        assert robot.run(program).result().deviation < 1e-4
        (on, opened), (off, closed) = valve
        assert (on, off) == (1, 0)
        assert [opened[1] - start[0][1], closed[1] - start[0][1]] == pytest.approx(
            [0.02, 0.07], abs=2e-3
        )
        ((value, target),) = flow
        assert (value, target[2] - start[0][2]) == pytest.approx((0.5, 0.07), abs=2e-3)
        assert [v for v, _ in level] == [7]
        assert not complaints(controller)


def test_a_speed_holds_for_a_program_and_no_longer():
    with cell() as (robot, controller):
        robot.move_to(BENT, speed=1.0)
        here = robot.pose
        program = Program(speed=0.1).move_linear(here.moved(z=0.05))
        quick = robot.run(program).result().seconds
        execution = robot.run(Program(speed=0.1).move_linear(here))
        robot.set_speed(20)
        assert execution.result().deviation < 1e-4
        assert execution.result().seconds > 3 * quick
        assert robot.run(program).result().seconds == pytest.approx(quick, abs=0.15)
        assert not complaints(controller)


def test_signals_are_set_on_the_way_to_joints():
    with cell() as (robot, controller):
        robot.move_to(BENT, speed=1.0)
        goal = [BENT[0] + 0.3, *BENT[1:]]
        valve = watched(robot, controller, "valve")
        program = Program(speed=0.1).move_joints(goal, triggers=pulse("valve", 0.02, 0.03))
        assert robot.run(program).result().deviation < 1e-4
        assert [value for value, _ in valve] == [1, 0]
        assert robot.state.joints == pytest.approx(goal, abs=1e-4)
        assert not complaints(controller)


def test_a_singularity_is_passed_on_request_alone():
    with driven() as (robot, controller):
        robot.move_to([0.2, 0.1, 0.1, 0.3, 0.35, -0.2], speed=1.0)
        beyond = robot.pose_of([0.2, 0.1, 0.15, 0.5, -0.3, -0.2])
        with pytest.raises(InvalidProgram, match="singularity"):
            robot.run(Program().move_linear(beyond))
        execution = robot.run(Program().allow(singularities=True).move_linear(beyond))
        assert "singularity" in execution.warnings[0].message
        assert execution.result().deviation < 1e-4
        assert np.allclose(np.hstack(robot.pose), np.hstack(beyond), atol=1e-4)
        back = robot.pose_of([0.2, 0.1, 0.1, 0.3, 0.35, -0.2])
        again = Program().allow(singularities=True).allow().move_linear(back)
        with pytest.raises(InvalidProgram, match="singularity"):
            robot.run(again)
        assert not complaints(controller)


def test_waits_and_signals_stand_between_moves():
    with cell() as (robot, controller):
        robot.move_to(BENT, speed=1.0)
        start = robot.pose
        higher = start.moved(z=0.05)
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
        program = Program().wait_for("part", timeout=0.5).move_linear(robot.pose.moved(z=0.05))
        with pytest.raises(MotionFailed) as report:
            robot.run(program).result()
        assert (report.value.reason, report.value.reached) == (Reason.WAITED, 0)
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
        target = Pose((tip[0] - 0.3, tip[1] + 0.05, tip[2] - 0.1), q)
        program = Program(speed=0.2, zone="z10").move_linear(robot.pose.moved(z=0.01))
        program.use(tool="grip", work_object="table").move_linear(target)
        execution = robot.run(program)
        assert "another tool" in execution.warnings[0].message
        assert execution.result().deviation < 1e-4
        assert np.allclose(robot.pose[0], (x, y + 0.05, z), atol=1e-5)
        assert not complaints(controller)
        with pytest.raises(InvalidProgram, match="no tool"):
            robot.run(Program().use(tool="gripp").move_linear(target))


def test_a_tool_and_an_object_by_values():
    """The same ways as with those of the configuration, which the driver knows by name."""
    grip = UserTool(Pose((0.0, 0.0, 0.1)), 1.0, centre=(0.0, 0.0, 0.05))
    longer = replace(grip, frame=Pose((0.0, 0.0, 0.15)))
    table = UserWorkObject(Pose((0.3, 0.0, 0.0)), Pose((0.0, 0.0, 0.1)))
    with cell() as (robot, controller):
        robot.move_to(BENT, speed=1.0)
        (x, y, z), q = robot.pose
        tip = frames.transform(((x, y, z), q), (0.0, 0.0, 0.1))
        target = Pose((tip[0] - 0.3, tip[1] + 0.05, tip[2] - 0.1), q)
        program = Program(speed=0.2, zone="z10").move_linear(robot.pose.moved(z=0.01))
        program.use(tool=grip, work_object=table).move_linear(target)
        assert len(program) == 4
        program.use(tool="grip", work_object="table").move_linear(target.moved(y=0.02))
        program.use(tool=longer).use(tool=grip).move_linear(target)
        execution = robot.run(program)
        assert "does not move" in execution.warnings[0].message
        assert execution.result().deviation < 1e-4
        assert np.allclose(robot.pose[0], (x, y + 0.05, z), atol=1e-5)
        assert not complaints(controller)
        program = Program().use(tool=longer).move_linear(robot.pose.moved(z=-0.01))
        robot.run(program.use(tool="")).result()
        assert len(program) == 2


UPRIGHT = Pose((0.0, 0.0, 0.1))


@pytest.mark.parametrize(
    ("own", "report"),
    [
        (UserTool(UPRIGHT, 0.0), "more than 0"),
        (UserTool(UPRIGHT, float("nan")), "more than 0"),
        (UserTool(UPRIGHT, 2001.0), "more than 0"),
        (UserTool(UPRIGHT, 1.0, inertia=(0.0, -1.0, 0.0)), "moments"),
        (UserTool(UPRIGHT, 1.0, inertia=(0.0, 1.0)), "moments"),
        (UserTool(UPRIGHT, 1.0, centre=(0.0, 101.0, 0.0)), "centre"),
        (UserTool(UPRIGHT, 1.0, axes=(1.0, 1.0, 0.0, 0.0)), "quaternion"),
        (UserTool((0.0, 0.0, 0.1), 1.0), "is not a Pose"),
        (UserTool(UPRIGHT, "heavy"), "heavy"),
        (UserWorkObject(Pose((float("inf"), 0.0, 0.0))), "finite"),
        (UserWorkObject(UPRIGHT, Pose((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0))), "object frame"),
    ],
)
def test_invalid_tool_values_are_reported(own, report):
    key = "tool" if isinstance(own, UserTool) else "work_object"
    with cell() as (robot, _):
        program = Program().use(**{key: own}).move_linear(robot.pose)
        with pytest.raises(InvalidProgram, match=report) as error:
            robot.run(program)
        assert error.value.diagnostics[0].message.startswith("instruction 0")


@pytest.mark.parametrize(
    "program",
    [
        Program().set("part"),
        Program().set("absent"),
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
        Program().move_linear(Pose((0.3, 0, 0.5), (2, 0, 0, 0))),
        Program().move_linear(Pose((float("inf"), 0, 0.5))),
        Program(),
    ],
)
def test_invalid_program_is_reported_and_not_sent(program):
    with cell() as (robot, _):
        with pytest.raises(InvalidProgram):
            robot.run(program)
        assert robot.state.trajectory in (None, TrajectoryState.NONE)


def test_a_jog_is_small_and_stands_soon_after_a_lost_client():
    with driven() as (robot, controller):
        robot.jog(joint_1=0.1, joint_5=-0.05)
        assert robot.state.joints[0] == pytest.approx(0.1, abs=1e-4)
        assert robot.state.joints[4] == pytest.approx(-0.05, abs=1e-4)
        for wrong, help_text in (
            ({"joint_1": 0.3}, "at most 0.2 rad"),
            ({"joint_9": 0.1}, "did you mean 'joint_"),
            ({"joint_1": float("nan")}, "at most 0.2 rad"),
            ({"z": 0.2}, "at most 0.1 m"),
            ({"joint_1": "5"}, "at most 0.2 rad"),
        ):
            with pytest.raises(InvalidProgram) as error:
                robot.jog(**wrong)
            assert help_text in error.value.diagnostics[0].help
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


@pytest.mark.parametrize("finished", ["reset", "closed"])
@pytest.mark.parametrize(
    "lost",
    [(Port.MOTION,), (Port.CONTROL,), (Port.STATE,), (Port.MOTION, Port.CONTROL, Port.STATE)],
)
def test_a_jog_stands_soon_after_a_connection_is_cut(lost, finished):
    with driven(reconnect=0.0) as (robot, controller):
        group = controller.motion.group("rob1")
        jogging = robot.later.jog(joint_1=-0.2, speed=0.02)
        robot.sleep(1.0)
        assert not group.is_standing
        since = controller.now
        for port in lost:
            cut(robot, controller, port, finished)
        while not group.is_standing and controller.now - since < 1.0:
            robot.sleep(0.01)
        # 0.3 s is allowed; but who waits for 0.2 s of silence has not seen that it was cut.
        assert controller.now - since < 0.2
        with pytest.raises((ConnectionLost, MotionFailed)):
            jogging.result()
        here = group.positions()
        robot.sleep(1.0)
        assert group.positions() == here


def cut(robot, controller, port, finished):
    """One connection is reset, as by a computer that crashed, or closed, as by a program's end."""
    if finished == "closed":
        robot._runner._by_port[port].transport.close()
        return
    for device in tuple(controller.sockets.in_use):
        end = device.endpoint
        if end is not None and end.peer is not None and end.local[1] == port:
            controller.sockets.cut(device)
