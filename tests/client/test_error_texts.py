"""Texts of errors, wrong arguments, and display of objects."""

import math
import struct
import sys
import traceback
from pathlib import Path

import numpy as np
import pytest
from fake_controller import hello_reply

from rapidgen.client import (
    IncompatibleDriver,
    InvalidProgram,
    InvalidTarget,
    InvalidTrajectory,
    NotReady,
    Program,
    RequestRefused,
    Robot,
    RobotError,
    Trajectory,
)
from rapidgen.client.core.checks import check_trajectory
from rapidgen.client.core.group import Group
from rapidgen.config import load_config
from rapidgen.diagnostics import DiagnosticError

HOME = [0.0] * 6
PATH = Trajectory.from_points([HOME, [0.1] * 6, [0.2] * 6], seconds=0.1)


@pytest.fixture(scope="module")
def irb120():
    config = load_config("irb120")
    return Group.of(config, config.groups[0])


@pytest.mark.parametrize(
    ("trajectory", "figures"),
    [
        (Trajectory([0, 9, 18], [HOME, [0, 9, 0, 0, 0, 0], HOME]), ["9.0000", "1.9199", "point 1"]),
        (Trajectory([0, 0.2], [HOME, [1.0, 0, 0, 0, 0, 0]]), ["5.000 rad/s", "4.363", "point 1"]),
        (Trajectory([0, 1], [[0.5, 0, 0, 0, 0, 0]] * 2), ["joint_1", "0.5000", "0.0087"]),
        (Trajectory([0, 0.05], [HOME, HOME]), ["0.0500 s", "0.1 s", "point 1"]),
        (Trajectory([0, 1, 1], [HOME] * 3), ["point 2", "1 s after 1 s"]),
    ],
    ids=["limit", "speed", "start", "short", "time"],
)
def test_the_text_of_an_error_has_the_figures(irb120, trajectory, figures):
    with pytest.raises(InvalidTrajectory) as error:
        check_trajectory(trajectory, irb120, start=HOME)
    assert [figure for figure in figures if figure not in str(error.value)] == []


def test_a_scale_that_is_named_fits(irb120):
    rng = np.random.default_rng(5)
    for seconds in rng.uniform(0.1, 0.3, 20):
        fast = Trajectory([0, seconds], [HOME, [1.7, 0, 0, 0, 0, 0]])
        with pytest.raises(InvalidTrajectory) as error:
            check_trajectory(fast, irb120, start=HOME)
        fraction = float(error.value.diagnostics[0].help.split("scaled(")[1].split(")")[0])
        check_trajectory(fast.scaled(fraction), irb120, start=HOME)


@pytest.mark.parametrize("value", [math.inf, -math.inf, math.nan])
def test_what_is_no_number_is_not_called_too_fast(irb120, value):
    points = Trajectory([0, 1, 2], [HOME, [value, *HOME[1:]], HOME])
    with pytest.raises(InvalidTrajectory) as error:
        check_trajectory(points, irb120)
    assert [d.code for d in error.value.diagnostics] == ["RG613"]


def test_trajectory_faults_have_a_help(irb120):
    names = ["joint_1", "joint_2", "joint_3", "joint_4", "joint_5"]
    for points in (
        Trajectory([0, 1], [HOME[1:]] * 2, names),
        Trajectory([0, 1], [HOME, [math.nan, *HOME[1:]]]),
        Trajectory([0, math.nan], [HOME, HOME]),
        Trajectory([0, 0.2], [HOME, [1.0, 0, 0, 0, 0, 0]]),
    ):
        with pytest.raises(InvalidTrajectory) as error:
            check_trajectory(points, irb120)
        assert all(d.help for d in error.value.diagnostics)
    assert "--speed" in error.value.diagnostics[0].help


def test_resampling_from_help_fixes_the_trajectory(irb120):
    for duration in np.random.default_rng(7).uniform(0.5, 60, 100):
        dense = Trajectory(np.linspace(0, duration, 2000), np.zeros((2000, 6)))
        check_trajectory(dense.resampled(0.1), irb120, start=HOME)


@pytest.mark.skipif(sys.version_info < (3, 11), reason="Python 3.10 shows no notes")
def test_traceback_shows_place_and_help(tmp_path):
    bad = tmp_path / "cell.yaml"
    bad.write_text("model: irb120\nmodle: irb120\n")
    with pytest.raises(DiagnosticError) as error:
        load_config(bad)
    displayed = "".join(traceback.format_exception(error.value))
    assert f"{bad}:2" in displayed
    assert "did you mean" in displayed


@pytest.mark.parametrize(
    ("given", "mode"),
    [
        ([HOME, [0.1] * 6], "from_points"),
        (np.zeros((2, 6)), "from_points"),
        ("path.csv", "from_csv"),
        (Path("path.csv"), "from_csv"),
        ({"points": []}, "from_ros"),
        (Program(), "robot.run"),
        (None, "from_points"),
    ],
)
@pytest.mark.parametrize("call", ["execute", "check", "mode_for"])
def test_execute_of_other_type_names_conversion(connected, call, given, mode):
    with connected() as (robot, controller):
        with pytest.raises(InvalidTrajectory) as error:
            getattr(robot, call)(given)
        assert type(given).__name__ in str(error.value)
        assert mode in error.value.diagnostics[0].help
        assert not controller.frames


@pytest.mark.parametrize("given", [PATH, "move", None])
def test_run_of_other_type_is_rejected(connected, given):
    with connected() as (robot, controller):
        with pytest.raises(InvalidProgram, match=type(given).__name__):
            robot.run(given)
        assert not controller.frames


@pytest.mark.parametrize(
    "points", [[[0, 0], [0]], [["a"], ["b"]], 3.0, [[[0]], [[1]]]], ids=["ragged", "text", "0", "3"]
)
def test_points_that_are_none(points):
    with pytest.raises(InvalidTrajectory):
        Trajectory([0, 1], points)


@pytest.mark.parametrize("seconds", [[1, 2, 3], "soon"])
def test_seconds_that_do_not_fit(seconds):
    with pytest.raises(InvalidTrajectory, match="2 points"):
        Trajectory.from_points([HOME, HOME], seconds=seconds)


@pytest.mark.parametrize("target", ["irb121", "no such.yaml", "host:99999"])
def test_a_wrong_target_is_a_robot_error(target):
    address = "127.0.0.1" if target == "irb121" else None
    with pytest.raises(InvalidTarget) as error:
        Robot(target, address=address)
    assert isinstance(error.value, RobotError)
    assert error.value.exit_code == 2


def test_a_fault_of_a_configuration_keeps_its_place(tmp_path):
    bad = tmp_path / "cell.yaml"
    bad.write_text("model: irb120\nmodle: irb120\n")
    with pytest.raises(RobotError) as error:
        Robot(bad)
    assert error.value.diagnostics[0].span.path == str(bad)
    with pytest.raises(InvalidTarget, match="no motion group 'left'"):
        Robot("irb120", group="left")


def test_a_value_that_no_message_holds_is_refused(connected):
    with connected(control=True) as (robot, _):
        with pytest.raises(RequestRefused):
            robot.write_signal(0, "on")
        with pytest.raises(RequestRefused):
            robot.read_signal(2**40)


@pytest.mark.parametrize("value", [None, "on"])
def test_a_signal_without_a_number_is_not_read_instead_of_written(connected, value):
    with connected(control=True) as (robot, controller):
        with pytest.raises(RequestRefused, match=f"takes a number, not {value!r}") as error:
            robot.write_signal(0, value)
        assert error.value.diagnostics[0].help
        assert not controller.frames


@pytest.mark.parametrize("mode", ["fast", "Stream", 1])
def test_a_way_that_is_none_moves_nothing(connected, mode):
    with connected() as (robot, controller):
        for call, given in ((robot.execute, PATH), (robot.run, Program().move_joints(HOME))):
            with pytest.raises(ValueError, match="'download', 'stream' or None"):
                call(given, mode=mode)
        assert not controller.frames


def edited(script_hello, offset, packing, *values):
    """A HELLO with other bytes in its content, which follows 16 bytes of head."""
    data = bytearray(script_hello)
    struct.pack_into(packing, data, 16 + offset, *values)
    return bytes(data)


_CAPACITY, _PERIOD, _LOWER, _RING = 44, 56, 72, 196


@pytest.mark.parametrize(
    ("offset", "packing", "value", "message"),
    [
        (_RING, "<i", -1, "ring -1"),
        (_CAPACITY, "<i", -5, "capacity -5"),
        (_CAPACITY + 4, "<i", 0, "joint_count 0"),
        (_CAPACITY + 4, "<i", 11, "11 joints"),
        (_PERIOD, "<f", math.nan, "state_period nan"),
        (_LOWER + 4, "<f", math.nan, "of joint 2"),
        (_LOWER + 80 + 8, "<f", 0.0, "of joint 3"),
    ],
)
def test_a_hello_that_no_driver_can_mean_is_refused(fake, client, offset, packing, value, message):
    controller = fake()
    controller.script.hello = edited(hello_reply(controller.script, 0), offset, packing, value)
    with pytest.raises(IncompatibleDriver, match=message):
        client(controller.address).__enter__()


def test_a_robot_that_tells_no_number_of_where_it_stands_gets_nothing(connected):
    with connected() as (robot, controller):
        controller.position[2] = math.nan
        robot.next_state()
        robot.next_state()
        with pytest.raises(NotReady, match="joint_3"):
            robot.execute(PATH)
        assert not controller.frames


def test_a_trajectory_is_a_sequence_of_points():
    path = Trajectory([0, 1, 3], [[0, 5], [1, 6], [2, 7]], ("a", "b"))
    assert path[1] == (1.0, (1.0, 6.0))
    assert path[-1].joints == (2.0, 7.0)
    assert [point.time for point in path] == [0, 1, 3]
    assert path["b"].tolist() == [5, 6, 7]
    assert path[1:].times.tolist() == [1, 3]
    assert path[::2].names == path.names
    assert list(path)[2] == path[2]
    with pytest.raises(IndexError):
        path[3]
    with pytest.raises(KeyError):
        path["c"]


def test_everything_shows_itself(fake, patient):
    path = Trajectory.from_points(
        [[n * 0.01, 0] for n in range(40)], seconds=0.1, names=("a", "<b")
    )
    assert repr(path) == "<Trajectory 40 points in 3.900 s: a, <b>"
    table = path._repr_html_()
    assert "&lt;b" in table
    assert table.count("<tr>") == 10
    controller = fake()
    with Robot(controller.address, timeouts=patient()) as robot:
        assert controller.address.split(",")[0] in repr(robot)
        assert "rapidgen 0.1.0, AUTO, motors on, standing" in repr(robot)
        assert "joint_6" in robot._repr_html_()
        assert "joint_6" in robot.state._repr_html_()
        assert "joint_1 0.0000" in repr(robot.state)
        with robot.recording() as recording:
            execution = robot.execute(PATH)
            assert "3 points" in repr(execution)
            assert "<progress" in execution._repr_html_()
            execution.result()
        assert "done: 3 points" in repr(execution)
        assert "joint_6" in recording._repr_html_()
        assert repr(recording).startswith("<JointRecording")
    assert "not connected" in repr(Robot("irb120"))
    assert "rob1" in Robot("irb120")._repr_html_()
