"""Motion programs against our own driver, on the virtual clock."""

import pytest
from driven import complaints, driven

from rapidgen.client import InvalidProgram, NotSupported, Program
from rapidgen.wire.simple_message.spec import TrajectoryState

BENT = [0.2, 0.1, 0.1, 0.3, 0.6, -0.2]


def at(robot, joints):
    """The pose of joints."""
    group = robot.group
    return group.frames.pose(group.map.to_controller(joints))


def moved(pose, x=0.0, y=0.0, z=0.0):
    (a, b, c), q = pose
    return (a + x, b + y, c + z), q


def square(robot, size=0.05, **options):
    """Joints, then a way around on lines and with all axes."""
    corner = at(robot, BENT)
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
