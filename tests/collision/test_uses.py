"""Where collisions are checked: client, command line, virtual controller."""

import subprocess
import sys
from importlib.metadata import entry_points

import numpy as np
import pytest

from rapidgen.cli.app import main
from rapidgen.client import Robot, Trajectory
from rapidgen.client.core.state_port import StatePort
from rapidgen.client.errors import InvalidTrajectory
from rapidgen.client.program import Program
from rapidgen.controller.boot_targets import BootOptions, load_target
from rapidgen.controller.collisions import CollisionWatch
from rapidgen.controller.controller import VirtualController
from rapidgen.diagnostics import DiagnosticError

POST = "things:\n  post: {box: [80, 80, 900], frame: {position: [350, 250, 450]}}"
FAR = POST.replace("350, 250", "-400, 250")
PROGRAM = """MODULE feeder
  CONST jointtarget a := [[0,10,5,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget b := [[70,10,5,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveAbsJ a, v500, z50, tool0;
    MoveAbsJ b, v500, fine, tool0;
  ENDPROC
ENDMODULE
"""
HEADER = "time,joint_1,joint_2,joint_3,joint_4,joint_5,joint_6\n"


def test_client_without_a_cell_loads_nothing_of_collision_checks():
    """Importing the client, and a robot without a cell, cost what they cost before."""
    text = (
        "import sys; from rapidgen.client import Robot; Robot('irb120', address='127.0.0.1');"
        "print([m for m in sys.modules if m.startswith(('rapidgen.collision', 'coal'))])"
    )
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


@pytest.fixture
def program(folder):
    path = folder / "feeder.mod"
    path.write_text(PROGRAM)
    return str(path)


def test_run_reports_the_move_that_touches(cell, program, capsys):
    assert main(["run", program, "--cell", str(cell(POST))]) == 1
    err = capsys.readouterr().err
    assert "RG820" in err
    assert "feeder.mod:6" in err
    assert "not checked: hoses" in err


def test_run_warns_or_does_not_check_as_chosen(cell, program, capsys):
    file = str(cell(POST))
    assert main(["run", program, "--cell", file, "--collisions", "warn"]) == 0
    assert "warning[RG820]" in capsys.readouterr().err
    assert main(["run", program, "--cell", file, "--collisions", "off"]) == 0
    assert "RG820" not in capsys.readouterr().err
    assert main(["run", program, "--collisions", "error"]) == 2


def test_run_does_not_check_without_the_key(cell, program, capsys):
    path = cell(POST)
    path.write_text(path.read_text().split("collision:")[0])
    assert main(["run", program, "--cell", str(path)]) == 0
    assert "RG82" not in capsys.readouterr().err


@pytest.mark.parametrize(("things", "code"), [(POST, 1), (FAR, 0)])
def test_check_of_a_trajectory(cell, folder, things, code, capsys):
    path = folder / "path.csv"
    path.write_text(HEADER + "0,0,0.2,0.1,0,0.6,0\n2,1.2,0.2,0.1,0,0.6,0\n")
    plot = folder / "clearance.svg"
    words = ["check", str(path), "--cell", str(cell(things))]
    assert main(words) == code
    seen = capsys.readouterr()
    assert ("RG820" in seen.out) == bool(code)
    assert "not checked" in seen.err
    assert not plot.exists()


def test_check_of_a_program_draws_the_clearance(cell, program, folder):
    pytest.importorskip("matplotlib")
    plot = folder / "clearance.svg"
    assert main(["check", program, "--cell", str(cell(FAR)), "--plot", str(plot)]) == 0
    assert plot.read_text().startswith("<?xml")


def test_check_of_other_joints_names_the_robots(cell, folder, capsys):
    path = folder / "other.csv"
    path.write_text("time,a,b\n0,0,0\n1,0,0\n")
    assert main(["check", str(path), "--cell", str(cell(FAR))]) == 2
    assert "RG834" in capsys.readouterr().err


def test_watch_has_clearances_of_the_planned_path(cell, program):
    booted = load_target([program], BootOptions(cell=str(cell(FAR))))
    with VirtualController.boot(booted, autostart=False) as controller:
        watch = CollisionWatch(controller, booted.collisions("error"))
        controller.start_program()
        controller.run_for(3)
        assert watch.report().is_free
        seen = watch.clearance()
        assert seen.least > 0.01


@pytest.fixture
def robot_of(folder, monkeypatch):
    """A robot that is not connected, at a position."""
    position = [0.0, 0.2, 0.1, 0.0, 0.6, 0.0]
    monkeypatch.setattr(StatePort, "wire_joints", (*position, 0.0, 0.0, 0.0, 0.0))

    def make(path):
        return Robot(folder / "robot.yaml", address="127.0.0.1:1", cell=path), position

    return make


def test_robot_rejects_a_trajectory_before_it_is_sent(cell, robot_of):
    robot, position = robot_of(cell(POST))
    end = [1.2, *position[1:]]
    points = Trajectory.from_points([position, end], seconds=2)
    with pytest.raises(InvalidTrajectory, match="RG820"):
        robot.check(points)
    free, _ = robot_of(cell(FAR))
    free.check(points)


def test_check_of_a_stream_piece_begins_at_the_last_point(cell, robot_of):
    robot, position = robot_of(cell(POST))
    core = robot._core
    near = [0.3, *position[1:]]
    checked = core.check(Trajectory.from_points([position, near], seconds=1), "download")
    beyond = Trajectory(np.array([3.0]), np.array([[1.2, *position[1:]]]), core.known_group.names)
    with pytest.raises(InvalidTrajectory, match="before point 2"):
        core.check(beyond, "download", before=checked.last, is_open=True)


def test_robot_rejects_a_program(cell, robot_of):
    from rapidgen.client.core.program_checks import check_program

    robot, position = robot_of(cell(POST))
    core = robot._core
    program = Program(speed=0.2).move_joints([1.2, *position[1:]])
    checked = check_program(program, core.known_group, start=core.start, most=100)
    report = core.collisions.check_program(checked)
    assert report.diagnostics[0].code == "RG820"
    assert "instruction 0" in report.diagnostics[0].message


def test_robot_with_an_address_alone_has_no_cell(cell):
    with pytest.raises(DiagnosticError, match="RG834"):
        Robot("127.0.0.1", cell=cell(POST))


pytest_plugins = ["pytester"]


@pytest.mark.parametrize(("things", "outcome"), [(POST, {"errors": 1}), (FAR, {})])
def test_pytest_fixture_fails_for_a_contact(pytester, cell, program, things, outcome):
    pytester.makepyfile(
        f"""
        def test_free(virtual_controller):
            controller = virtual_controller(
                {program!r}, cell={str(cell(things))!r}, cycle="once", collisions="error"
            )
            assert controller.run(max_time=60) == "finished"
            assert virtual_controller.clearance(controller).least > -1
        """
    )
    named = {point.value for point in entry_points(group="pytest11")}
    plugin = "rapidgen.testing.pytest_plugin"
    plugins = () if plugin in named else ("-p", plugin)
    done = pytester.runpytest_inprocess("-p", "no:cacheprovider", "-n", "0", *plugins)
    done.assert_outcomes(passed=1, **outcome)
    if outcome:
        done.stdout.fnmatch_lines(["*RG820*"])
