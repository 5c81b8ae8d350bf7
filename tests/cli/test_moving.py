"""move to a goal, jog, pose and io against a simulator: typed in deg and mm, right and wrong."""

import json
import math
import re
import signal
import subprocess
import sys

import pytest

from rapidgen.cli.app import main
from rapidgen.cli.motion import within_limits
from rapidgen.cli.target_text import Units, joints_of, read_figures
from rapidgen.client import InvalidTrajectory, Robot, Trajectory
from rapidgen.client.core.group import Group
from rapidgen.client.permission import FIRST_SPEED
from rapidgen.client.program import SLOW
from rapidgen.config import load_config

CELL = """\
model: irb120
signals:
  gripper: {kind: DO, access: write}
  part: {kind: DI}
  count: {kind: GO, access: write}
"""
HOME = "0,0,0,0,30,0"
FAST = ("--speed", "1")


@pytest.fixture(scope="module")
def cell(tmp_path_factory):
    """A simulator in a runtime folder of its own; (configuration, simulator)."""
    from tests.cli.conftest import Running

    folder = tmp_path_factory.mktemp("cell")
    path = folder / "cell.yaml"
    path.write_text(CELL)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_RUNTIME_DIR", str(folder))
        sim = Running(str(path), "--ports", "auto")
        yield str(path), sim
        sim.close()


def run_command(capsys, *text, code=0):
    assert main(list(text)) == code
    return capsys.readouterr()


def positions(sim):
    return sim.control(do="status")["result"]["groups"]["rob1"]["positions"]


def at_home(cell, capsys):
    run_command(capsys, "move", cell[0], "--joints", HOME, "--to", "sim", *FAST)


def test_joints_are_typed_in_degrees(cell, capsys):
    path, sim = cell
    displayed = run_command(
        capsys, "move", path, "--joints", "-10,5,0,0,30,0", "--to", "sim", *FAST
    )
    assert "at joint_1 -10.00 deg, joint_2 5.00 deg" in displayed.out
    wanted = [math.radians(angle) for angle in (-10, 5, 0, 0, 30, 0)]
    assert positions(sim) == pytest.approx(wanted, abs=1e-5)
    columns = next(line for line in displayed.err.splitlines() if "joint " in line).split()
    assert columns == ["joint", "now", "min", "max", "end", "lower", "upper"]
    assert max(map(len, displayed.err.splitlines())) < 100


def test_some_by_name_and_in_radians(cell, capsys):
    path, sim = cell
    at_home(cell, capsys)
    run_command(
        capsys, "move", path, "--joints", "joint_6=0.2,joint_2=-0.1", "--rad", "--to", "sim", *FAST
    )
    wanted = [0, -0.1, 0, 0, math.radians(30), 0.2]
    assert positions(sim) == pytest.approx(wanted, abs=1e-5)


def test_a_robot_that_stands_at_its_limit_is_moved_on(cell, capsys):
    """float32, as the wire tells it, of 120 deg is more than 120 deg."""
    run_command(capsys, "move", cell[0], "--joints", "0,0,0,0,120,0", "--to", "sim", *FAST)
    run_command(capsys, "move", cell[0], "--joints", "joint_1=10", "--to", "sim", *FAST)
    assert positions(cell[1])[0] == pytest.approx(math.radians(10), abs=1e-5)


def test_rounding_at_limit_of_coupled_axis_is_accepted():
    config = load_config("irb2400")
    group = Group.of(config, config.groups[0])
    goal = joints_of(read_figures("0,-29,-31,0,0,0"), Units(), group, [0.0] * 6)
    within_limits(group, goal, Units())
    with pytest.raises(InvalidTrajectory, match=r"rax_3 would be at -60\.01 deg"):
        within_limits(group, [*goal[:2], math.radians(-31.01), *goal[3:]], Units())


def test_move_to_printed_pose_reaches_it(cell, capsys):
    path, sim = cell
    run_command(capsys, "move", path, "--joints", "10,10,0,0,30,5", "--to", "sim", *FAST)
    before = positions(sim)
    line = run_command(capsys, "pose", path, "--to", "sim").out.splitlines()[0]
    at_home(cell, capsys)
    run_command(capsys, "move", path, "--pose", line.split()[1], "--to", "sim", *FAST)
    assert positions(sim) == pytest.approx(before, abs=1e-4)
    x, y, z = (float(value) for value in line.split()[1].split(",")[:3])
    run_command(capsys, "move", path, "--pose", f"{x},{y},{z - 50}", "--to", "sim", *FAST)
    result = json.loads(run_command(capsys, "pose", path, "--to", "sim", "--json").out)
    assert result["position"] == pytest.approx([x / 1000, y / 1000, (z - 50) / 1000], abs=1e-4)


def test_a_pose_of_joints_asks_no_robot(capsys):
    displayed = run_command(capsys, "pose", "irb120", "--joints", HOME)
    assert displayed.out.splitlines() == [
        "pose    364.35,0.00,594.00,0.50000,0.00000,0.86603,0.00000  (mm, quaternion)",
        "joints  0.00,0.00,0.00,0.00,30.00,0.00  (deg, mm)",
    ]


@pytest.mark.parametrize(
    ("goal", "axis", "turn", "slowest"),
    [("30,0,0,0,30,0", 0, 30, "tool"), ("0,0,0,0,30,90", 5, 90, "axis")],
)
def test_default_speed_is_that_of_python(cell, capsys, goal, axis, turn, slowest):
    path, _ = cell
    at_home(cell, capsys)
    with Robot(path, address="sim", watch=True) as robot:
        radius = math.hypot(*robot.pose[0][:2])
        axis_speed = robot.group.joints[axis].speed
    text = run_command(capsys, "move", path, "--joints", goal, "--to", "sim", "--dry-run").err
    seconds = float(re.search(r"points, ([\d.]+) s", text)[1])
    speed = SLOW / radius if slowest == "tool" else FIRST_SPEED * axis_speed
    at_speed = math.radians(turn) / speed
    # Rounded to 0.01 s, and a ramp of about a tenth of a second.
    assert at_speed - 0.01 < seconds < at_speed + 0.15


def test_a_dry_run_draws_and_sends_nothing(cell, capsys, tmp_path):
    path, sim = cell
    before = positions(sim)
    text = ["move", path, "--joints", "20,20,20,20,20,20", "--to", "sim", "--dry-run"]
    displayed = run_command(capsys, *text, "--plot", str(tmp_path / "p.png"))
    assert displayed.out == "dry run: 2 points checked, nothing sent\n"
    assert [result.name for result in tmp_path.iterdir()] == ["p.png"]
    assert json.loads(run_command(capsys, *text, "--json").out)["dry_run"] is True
    assert positions(sim) == before


def test_executed_motion_is_plotted_and_recorded_in_radians(cell, capsys, tmp_path):
    path, _ = cell
    at_home(cell, capsys)
    files = ["--plot", str(tmp_path / "p"), "--record", str(tmp_path / "r.csv")]
    run_command(capsys, "move", path, "--joints", "joint_1=10", "--to", "sim", *files, *FAST)
    recorded = Trajectory.from_csv(tmp_path / "r.csv")
    assert recorded.positions[-1][0] == pytest.approx(math.radians(10), abs=1e-5)
    assert (tmp_path / "p.png").read_bytes().startswith(b"\x89PNG")


@pytest.fixture
def patient(monkeypatch):
    """A busy machine may be silent for longer than the hand of who jogs may."""
    monkeypatch.setattr("rapidgen.client.flows.program._DEAD_MAN", 20.0)


@pytest.mark.usefixtures("patient")
def test_jog(cell, capsys):
    path, sim = cell
    at_home(cell, capsys)
    run_command(capsys, "jog", path, "joint_1=5", "joint_3=-2", "--speed", "200", "--to", "sim")
    wanted = [math.radians(angle) for angle in (5, 0, -2, 0, 30, 0)]
    assert positions(sim) == pytest.approx(wanted, abs=1e-5)


@pytest.mark.usefixtures("patient")
def test_jog_of_the_tool(cell, capsys):
    path, _ = cell
    at_home(cell, capsys)
    before = json.loads(run_command(capsys, "pose", path, "--to", "sim", "--json").out)
    run_command(capsys, "jog", path, "z=20", "x=-5", "--speed", "200", "--to", "sim")
    after = json.loads(run_command(capsys, "pose", path, "--to", "sim", "--json").out)
    moved = [b - a for a, b in zip(before["position"], after["position"], strict=True)]
    assert moved == pytest.approx([-0.005, 0, 0.02], abs=1e-4)
    assert after["orientation"] == pytest.approx(before["orientation"], abs=1e-4)


def test_signals_of_a_driver_are_read_and_set(cell, capsys):
    path, _ = cell
    assert run_command(capsys, "io", path, "gripper", "1", "--to", "sim").out == "gripper  DO  1\n"
    result = json.loads(run_command(capsys, "io", path, "--to", "sim", "--json").out)
    assert [(s["name"], s["value"]) for s in result] == [
        ("gripper", 1.0),
        ("part", 0.0),
        ("count", 0.0),
    ]
    displayed = run_command(capsys, "io", path, "count", "1234567", "--to", "sim")
    assert displayed.out == "count  GO  1234567\n"
    displayed = run_command(capsys, "io", "irb120", "--to", "127.0.0.1:1,1,1")
    assert displayed.out == ""
    assert "irb120 has no signals" in displayed.err


@pytest.mark.parametrize(
    ("text", "code", "message"),
    [
        (["move"], 2, "no target"),
        (
            ["move", "--joints", HOME, "--pose", "1,2,3"],
            2,
            "more than one target: --joints and --pose",
        ),
        (["move", "p.csv", "--joints", HOME], 2, "more than one target: a file and --joints"),
        (["move", "--joints", "1,2,3"], 2, "3 values for 6 joints"),
        (["move", "--joints", "1,2,3,4,5,six"], 2, "'six' is not a number"),
        (["move", "--joints", "1,2,3,4,5,nan"], 2, "'nan' is not a number"),
        (["move", "--joints", "1_0,0,0,0,30,0"], 2, "'1_0' is not a number"),
        (["jog", "joint_1=0_5"], 2, "'0_5' is not a number"),
        (["io", "count", "1_0"], 2, "'1_0' is not a signal value"),
        (["move", "--joints", "joint_7=1"], 2, "unknown joint 'joint_7': did you mean"),
        (["move", "--joints", "joint_1=1,joint_1=2"], 2, "'joint_1' is given twice"),
        (
            ["move", "--joints", "joint_1=166"],
            1,
            "use a value from -165.00 to 165.00 deg for rax_1",
        ),
        (["move", "--pose", "1,2"], 2, "2 values: give X,Y,Z,Q1,Q2,Q3,Q4"),
        (["move", "--pose", "300,0,500,1,1,0,0"], 2, "not a unit quaternion: its length is 1.4"),
        (["move", "--pose", "3000,0,500"], 1, "no joint values within the limits reach the pose"),
        (
            ["move", "--joints", HOME, "--approach", "3"],
            2,
            "--joints starts at the current position",
        ),
        (["move", "--joints", HOME, "--speed", "0"], 2, "must be above 0"),
        (["move", "--joints", HOME, "--record", "/nowhere/r.csv"], 2, "cannot write /nowhere"),
        (["jog", "joint_1"], 2, "write JOINT=STEP"),
        (["jog", "joint_1=20"], 2, "at most 11.46 deg at a time"),
        (["jog", "joint_9=1"], 2, "unknown joint 'joint_9'"),
        (["jog", "z=150"], 2, "z by 150.00 mm is too far: at most 100.00 mm"),
        (["jog", "z=1", "joint_1=1"], 2, "unknown joint 'z'"),
        (["jog", "z=1", "z=2"], 2, "'z' is given twice"),
        (["jog", "up=1"], 2, "unknown joint 'up'"),
        (["jog", "joint_1=1", "--speed", "-1"], 2, "must be above 0"),
        (["io", "gripper", "on"], 2, "'on' is not a signal value"),
        (["io", "gipper"], 1, "did you mean 'gripper'?"),
        (["io", "part", "1"], 1, "exposed for reading only"),
        (["pose", "--joints", "1"], 2, "1 values for 6 joints"),
    ],
)
def test_usage_error(cell, capsys, text, code, message):
    path, sim = cell
    before = positions(sim)
    verb, *remaining = text
    displayed = run_command(capsys, verb, path, *remaining, "--to", "sim", code=code)
    assert message in " ".join(displayed.err.split())
    assert "Traceback" not in displayed.err
    assert positions(sim) == before


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (["move", "--joints", "1,2,x"], "'x' is not a number"),
        (["move", "--joints", "joint_1=1,2"], "'2' is not NAME=VALUE"),
        (["move", "--joints", "a=1,a=2"], "'a' is given twice"),
        (["move", "--pose", "1,2"], "2 values: give X,Y,Z,Q1,Q2,Q3,Q4"),
        (["move", "--pose", "1,2,3,1,1,0,0"], "its length is 1.414"),
        (["jog", "joint_1"], "write JOINT=STEP"),
        (["jog", "joint_1=five"], "'five' is not a number"),
    ],
)
def test_wrong_target_is_reported_before_connecting(capsys, text, message):
    verb, *remaining = text
    displayed = run_command(capsys, verb, "irb120", *remaining, "--to", "127.0.0.1:1,1,1", code=2)
    assert message in " ".join(displayed.err.split())


@pytest.mark.parametrize(
    ("ignored", "number"), [("", signal.SIGINT), ("INT", signal.SIGINT), ("", signal.SIGTERM)]
)
def test_interrupted_move_stops_and_prints_position(cell, capsys, ignored, number):
    """A shell starts the background jobs of a script with SIGINT ignored [POSIX, sh, 2.11]."""
    path, sim = cell
    at_home(cell, capsys)
    words = ["move", path, "--joints", "joint_1=90", "--speed", "0.02", "--to", "sim"]
    shell = ["sh", "-c", f"trap '' {ignored}; exec \"$@\"", "sh"] if ignored else []
    process = subprocess.Popen(
        [*shell, sys.executable, "-m", "rapidgen.cli", *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    while positions(sim)[0] < 0.01:
        assert process.poll() is None, process.communicate()
    process.send_signal(number)
    _, displayed = process.communicate(timeout=60)
    assert process.returncode == 130
    degrees = math.degrees(positions(sim)[0])
    match = re.search(r"Ctrl-C: stopped at joint_1 (\S+) deg", displayed)
    assert match, displayed
    # Two decimals, and a state is a message old.
    assert float(match[1]) == pytest.approx(degrees, abs=0.05)
    assert degrees < 90


def test_calibrate_moves_only_the_chosen_axis(cell, capsys, tmp_path):
    at_home(cell, capsys)
    log = tmp_path / "log.csv"
    words = ("--amplitude", "joint_1=100", "--speed", "0.5", "--record", str(log))
    displayed = run_command(capsys, "calibrate", cell[0], *words, "--to", "sim")
    # The acceleration of the simulated robot is that of the configuration.
    acceleration = float(re.search(r"joint_1: (\d+) deg", displayed.out)[1])
    assert acceleration == pytest.approx(2500, rel=0.05)
    assert displayed.out.count("not measured") == 5
    recorded = Trajectory.from_csv(log)
    turned = recorded.positions[:, 0]
    assert math.degrees(turned.min()) == pytest.approx(-100, abs=0.1)
    assert math.degrees(turned.max()) == pytest.approx(100, abs=0.1)
    others = recorded.positions[:, [1, 2, 3, 5]]
    assert abs(others).max() < 1e-4


def test_calibrate_does_not_move_without_confirmation(cell, capsys):
    address = cell[1].ready["address"]["rob1"]
    before = positions(cell[1])
    words = ("calibrate", cell[0], "--amplitude", "5", "--speed", "1", "--to")
    assert "RG641" in run_command(capsys, *words, address, code=2).err
    assert "RG640" in run_command(capsys, *words, "192.0.2.1", "--yes", code=2).err
    assert positions(cell[1]) == before
