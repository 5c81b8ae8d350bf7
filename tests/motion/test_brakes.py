"""Stops by the brakes: off the path, and back to it before anything else."""

from dataclasses import replace

import numpy as np
import pytest

from rapidgen.machine.scheduler import S
from rapidgen.motion import MotionSettings
from rapidgen.motion.braking import coast
from tests.motion.cell import PLANNED

P = "[[364.354,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
DATA = f"CONST robtarget p := {P};\n"
HOME = "MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;\n"


def off_line(path):
    """Distance of every sample from the joint line, axis 2 = half of axis 1."""
    return np.abs(path[:, 0] - 2 * path[:, 1]).max()


def test_the_brakes_take_it_off_the_path_and_it_comes_back(cell, joint):
    # S4 overview 5-23: a stop by the brakes deviates; first back to where it should have stopped
    group = cell.group
    seen = {}

    def look():
        seen["off"] = group.off_path
        seen["rest"] = group.positions()
        seen["standing"] = group.is_standing

    cell.at(0.2, lambda: group.stop("x", brakes=True))
    cell.at(1.0, look)
    cell.at(1.0, lambda: group.start("x"))
    cell.run(lambda task: group.move(task, joint(90, 45, tcp=10)))
    assert seen["standing"]
    assert 1e-4 < seen["off"][0] < 0.2
    assert group.off_path == (0.0, 0.0)
    assert group.positions() == pytest.approx(np.radians([90, 45, 0, 0, 0, 0]))
    stopped = np.argmin(np.abs(np.array(cell.times) / S - 1.0))
    assert off_line(cell.path[:stopped]) > 1e-3
    # Back on the path it stays there.
    back = next(k for k in range(stopped, len(cell.times)) if off_line(cell.path[k : k + 1]) < 1e-9)
    assert off_line(cell.path[back:]) < 1e-6
    speeds = np.abs(np.diff(cell.path, axis=0)) / 0.002
    assert (speeds <= np.array([j.speed for j in cell.config.joints]) * (1 + 1e-6)).all()


def test_each_axis_slows_down_by_itself(cell, joint):
    group = cell.group
    cell.at(0.2, lambda: group.stop("x", brakes=True))
    cell.at(1.0, lambda: group.start("x"))
    cell.run(lambda task: group.move(task, joint(90, 45, tcp=10)))
    bends = np.abs(np.diff(cell.path, n=2, axis=0)) / 0.002**2
    coasting = bends[101:110, :2]
    strongest = np.array([j.acceleration for j in cell.config.joints])[:2] * 2  # quick_factor
    assert coasting[0] == pytest.approx(strongest, rel=1e-3)


def test_a_path_that_is_cleared_while_it_coasts_is_gone(make_cell, joint):
    cell = make_cell(settings=MotionSettings(cleared_move="return"))
    group = cell.group

    def halt():
        group.stop("x", brakes=True)
        group.clear_path()
        group.start("x")

    cell.at(0.2, halt)
    finished = []

    def program(task):
        group.move(task, joint(90, 45, tcp=10))
        finished.append(group.positions())
        task.sleep(1.0)
        finished.append(group.positions())
        group.move(task, joint(0, 0))

    cell.run(program)
    assert finished[1] != pytest.approx(np.radians([90, 45, 0, 0, 0, 0]), abs=0.1)
    assert group.positions() == pytest.approx([0.0] * 6)
    assert np.abs(np.diff(cell.path, axis=0)).max() < 0.02  # no jump


def test_every_move_is_made_after_a_stop_by_the_brakes_at_any_time(make_cell, joint, zones):
    for tenth in range(1, 16):
        cell = make_cell()
        group = cell.group

        def stop(group=group):
            group.stop("x", brakes=True)

        cell.at(tenth / 10, stop)
        cell.at(3.0, lambda group=group: group.start("x"))

        def program(task, group=group):
            for degrees in (20, 50, 60):
                group.move(task, joint(degrees, degrees / 2, z=10 if degrees < 60 else 0))

        cell.run(program)
        assert group.positions() == pytest.approx(np.radians([60, 30, 0, 0, 0, 0]))
        assert np.abs(np.diff(cell.path, axis=0)).max() < 0.02


@pytest.mark.parametrize("tenths", [4, 6, 7, 8])
def test_an_axis_that_coasts_is_held_at_the_end_of_its_range(make_cell, joint, tenths):
    # Weak brakes: at a fifth of its acceleration the axis would pass the end of its range.
    cell = make_cell(settings=MotionSettings(quick_factor=0.2))
    group, limit = cell.group, cell.config.joints[0].upper
    cell.at(tenths / 10, lambda: group.stop("x", brakes=True))
    cell.at(5.0, lambda: group.start("x"))
    cell.run(lambda task: group.move(task, joint(164.9, tcp=10)))
    assert cell.path[:, 0].max() <= limit + 1e-9
    held = cell.path[np.array(cell.times) < 5.0 * S, 0].max()
    assert held == pytest.approx(limit if tenths > 4 else held, abs=1e-6)
    assert np.degrees(group.positions()[0]) == pytest.approx(164.9)


def test_an_axis_at_the_end_of_its_range_does_not_coast_at_all(cell):
    joints = cell.config.joints
    here = tuple(j.upper for j in joints)
    before = tuple(q - 1e-6 for q in here)  # 1 rad/s towards the end
    stop = coast(0, here, before, joints, 2.0)
    assert stop.posture(stop.end) == here
    back = coast(0, here, tuple(q + 1e-6 for q in here), joints, 2.0)
    assert all(q < end for q, end in zip(back.posture(back.end), here, strict=True))


def test_after_a_quick_stop_whose_path_is_cleared_it_stands_before_it_goes_on(make_cell, joint):
    # The hard stop cannot be taken back for the new path: the robot comes to rest, and the ramp
    # of its acceleration with it.
    cell = make_cell(settings=MotionSettings(cleared_move="return"))
    group = cell.group

    def abort():
        group.stop("x", quick=True)
        group.clear_path()
        group.start("x")

    cell.at(0.3, abort)

    def program(task):
        group.move(task, joint(60, tcp=10))
        group.move(task, joint(60, 30, tcp=10))

    cell.run(program, period=0.001)
    steps = np.abs(np.diff(cell.path, axis=0)).max(axis=1)
    assert (steps[310:500] == 0.0).any()
    assert cell.shares(0.001)[1] <= 2 + 1e-6  # quick_factor


@pytest.mark.parametrize("choice", ["brakes", "path"])
def test_an_emergency_stop_by_category(rapid, choice):
    program = rapid(
        HOME + "MoveL Offs(p,0,200,0), v100, fine, tool0;" + 'TPWrite "" \\Pos:=CPos();', DATA
    )
    controller, group = program.controller, program.group
    controller.motion.settings = MotionSettings(emergency_stop=choice)
    controller.scheduler.at(round(1.0 * S), lambda: controller.perform("e-stop"))
    controller.run_for(2.0)
    assert (group.off_path[0] > 1e-5) is (choice == "brakes")
    for action in ("reset-e-stop", "motors-on", "start"):
        controller.perform(action)
    out = program.run()
    assert out
    assert "200" in out[0]


def test_a_program_does_not_start_far_from_its_path(rapid):
    program = rapid(HOME + "MoveL Offs(p,0,200,0), v50, fine, tool0;", DATA)
    controller, group = program.controller, program.group
    controller.run_for(2.0)
    controller.stop_program()
    controller.run_for(1.0)
    here = group.positions()
    group.jog((2.5, *here[1:]))
    assert group.off_path[0] > 0.5
    assert not controller.start_program()
    assert any("from its path" in str(event) for event in controller.log)
    group.jog((here[0] + 0.2, *here[1:]))
    assert controller.start_program()
    controller.run_for(20.0)
    assert group.off_path == (0.0, 0.0)
    assert group.positions()[0] != pytest.approx(here[0])


def test_start_move_refuses_a_path_that_is_not_near(rapid):
    # S4 datasys 2-StartMove-1: more than 10 mm or 20 degrees
    data = DATA + (
        "VAR intnum i;\nTRAP aside\nVAR robtarget here;\nStopMove;\nStorePath;\n"
        "here := CRobT(\\Tool:=tool0);\nMoveL Offs(here,0,0,WAY), v200, fine, tool0;\n"
        'RestoPath;\nStartMove;\nERROR\nIF ERRNO = ERR_PATHDIST TPWrite "far"; StopMoveReset;'
        " TRYNEXT;\nENDTRAP\n"
    )
    body = (
        HOME
        + "CONNECT i WITH aside; ITimer \\Single, 0.5, i;"
        + ("MoveL Offs(p,0,100,0), v100, fine, tool0;")
    )
    assert rapid(body, data.replace("WAY", "9")).run() == []
    assert rapid(body, data.replace("WAY", "11")).run() == ["far"]


@pytest.mark.parametrize("cleared_distance", ["counts", "forgotten"])
@pytest.mark.parametrize("stop_move_reset", ["releases", "keeps"])
def test_behind_a_path_that_was_cleared_far_off(rapid, cleared_distance, stop_move_reset):
    # Open questions, each answered both ways; what is released moves nothing.
    data = DATA + (
        "VAR intnum i;\nTRAP aside\nStopMove;\nWaitTime 1;\nClearPath;\nStartMove;\n"
        'IF IsStopMoveAct() StopMoveReset;\nIF IsStopMoveAct() TPWrite "held";\n'
        'ERROR\nIF ERRNO = ERR_PATHDIST TPWrite "far";\nTRYNEXT;\nENDTRAP\n'
    )
    body = (
        HOME
        + "CONNECT i WITH aside; ITimer \\Single, 3, i; MoveL Offs(p,0,100,0), v20, fine, tool0;"
    )
    program = rapid(body, data)
    controller, group = program.controller, program.group
    controller.motion.settings = MotionSettings(
        cleared_distance=cleared_distance, stop_move_reset=stop_move_reset
    )
    controller.run_for(4.0)
    here = group.positions()
    group.jog((here[0] + 0.1, *here[1:]))
    wanted = []
    if cleared_distance == "counts":
        wanted = ["far", "held"] if stop_move_reset == "keeps" else ["far"]
    assert program.run(5) == wanted
    assert group.positions()[0] == pytest.approx(here[0] + 0.1)


def test_only_a_standing_robot_is_jogged(cell, joint):
    def program(task):
        task.sleep(0.1)
        with pytest.raises(ValueError, match="moves"):
            cell.group.jog((0.0,) * 6)

    cell.start(program)
    cell.run(lambda task: cell.group.move(task, joint(30)))
    cell.group.jog(tuple(np.radians([31, 0, 0, 0, 0, 0])))
    assert cell.group.off_path == (0.0, 0.0)  # the path is done
    cell.run(lambda task: cell.group.move(task, joint(30)))
    assert cell.group.positions() == pytest.approx(np.radians([30, 0, 0, 0, 0, 0]))


def with_braking(group, **decelerations):
    """Give the first axis decelerations of its own, rad/s^2."""
    joints = group.config.joints
    joints = (replace(joints[0], **decelerations), *joints[1:])
    group.planner.config = replace(group.config, joints=joints)


def test_brakes_of_an_axis_are_those_of_the_configuration(cell, joint):
    group = cell.group
    with_braking(group, brake_deceleration=12.0)
    cell.at(0.2, lambda: group.stop("x", brakes=True))
    cell.start(lambda task: group.move(task, joint(90, 45, tcp=10)))
    cell.sample(lambda: cell.scheduler.now > S)
    coasting = np.abs(np.diff(cell.path, n=2, axis=0))[101:110, :2] / 0.002**2
    second = cell.config.joints[1].acceleration * 2  # quick_factor
    assert coasting[0] == pytest.approx([12.0, second], rel=1e-3)


@pytest.mark.parametrize(("quick", "expected"), [(True, 8.0), (False, None)])
def test_quick_stop_brakes_as_the_configuration_says(make_cell, joint, quick, expected):
    cell = make_cell(settings=PLANNED)
    group = cell.group
    with_braking(group, stop_deceleration=8.0)
    cell.at(0.3, lambda: group.stop("x", quick=quick))
    cell.start(lambda task: group.move(task, joint(160, tcp=10)))
    cell.sample(lambda: cell.scheduler.now > S)
    braking = np.abs(np.diff(cell.path, n=2, axis=0))[155:170, 0] / 0.002**2
    own = cell.config.joints[0].acceleration
    assert braking == pytest.approx(expected or own, rel=1e-3)
