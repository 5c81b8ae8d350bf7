"""Motion programs against our own driver, on the virtual clock."""

import numpy as np
import pytest
from driven import complaints, driven

from rapidgen.client import InvalidProgram, MotionStopped, NotSupported, Program
from rapidgen.wire.simple_message.spec import TrajectoryState

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
