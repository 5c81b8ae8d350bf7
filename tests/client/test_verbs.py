"""move, stop, monitor, record and plot as a user calls them."""

import io
import json
import re
from pathlib import Path

import pytest
from fake_controller import FakeController

from rapidgen.cli.app import main
from rapidgen.client import Trajectory
from rapidgen.config import load_config

JOINTS = [joint.name for joint in load_config("irb120").groups[0].joints]
GOAL = [0.2, 0.1, 0.0, -0.1, 0.0, 0.3]


@pytest.fixture
def controller():
    with FakeController(rapidgen=False) as fake:
        yield fake


@pytest.fixture
def points(tmp_path):
    path = tmp_path / "points.csv"
    trajectory = Trajectory.from_points([[0.0] * 6, GOAL], seconds=0.3, names=JOINTS)
    trajectory.to_csv(path)
    return path


@pytest.fixture(autouse=True)
def memory(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))


def test_move(controller, points, tmp_path, capsys):
    executed = tmp_path / "executed.csv"
    words = ["move", "irb120", str(points), "--to", controller.address, "--yes"]
    assert main([*words, "--record", str(executed)]) == 0
    shown = capsys.readouterr()
    assert re.fullmatch(r"done: 2 points in \d\.\d\d s, 0\.0000 \(rad, m\).*\n", shown.out)
    assert "plain simple_message" in " ".join(shown.err.split())
    recorded = Trajectory.from_csv(executed)
    assert recorded.names == tuple(JOINTS)
    assert recorded.positions[-1].tolist() == pytest.approx(GOAL)


def test_move_as_json(controller, points, capsys):
    assert main(["move", "irb120", str(points), "--to", controller.address, "-y", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["joints"]["joint_6"] == pytest.approx(0.3)


def test_move_at_another_speed_with_an_approach(controller, points):
    controller.position = [0.1] * 6
    words = ["move", "irb120", str(points), "--to", controller.address, "-y"]
    assert main(words) == 1
    assert controller.frames == []
    assert main([*words, "--speed", "0.5", "--approach", "0.4", "--resample", "0.2"]) == 0
    assert [round(duration, 3) for _, duration in controller.points] == [0.1, 0.4, 0.2, 0.2, 0.2]


@pytest.mark.parametrize("option", ["--speed", "--approach", "--resample"])
@pytest.mark.parametrize("value", ["0", "-1", "nan", "inf"])
def test_move_with_a_number_that_is_none(points, option, value, capsys):
    assert main(["move", "irb120", str(points), option, value]) == 2
    assert "above 0" in capsys.readouterr().err


def test_move_asks_and_takes_no_answer_from_a_pipe(controller, points, capsys):
    assert main(["move", "irb120", str(points), "--to", controller.address]) == 2
    assert "RG641" in capsys.readouterr().err
    assert controller.frames == []


@pytest.mark.parametrize("words", [["--yes"], ["--move-real-robot", "192.0.2.2"], []])
def test_a_real_robot_needs_its_host_twice(points, words, capsys):
    assert main(["move", "irb120", str(points), "--to", "192.0.2.1", *words]) == 2
    shown = capsys.readouterr().err
    assert "RG640" in shown
    assert "--move-real-robot 192.0.2.1" in shown


def test_a_name_is_no_loopback(points, capsys):
    assert main(["move", "irb120", str(points), "--to", "localhost.example", "--yes"]) == 2
    assert "RG640" in capsys.readouterr().err


def test_first_run_on_a_real_host_is_slow(points, monkeypatch):
    from rapidgen.client.address import Address
    from rapidgen.client.permission import FIRST_SPEED, first_speed, remember

    real = Address("192.0.2.1")
    trajectory = Trajectory.from_csv(points)
    assert first_speed(Address("127.0.0.1"), trajectory) == 1.0
    assert first_speed(real, trajectory) == FIRST_SPEED
    remember(real, trajectory)
    assert first_speed(real, trajectory) == 1.0
    assert first_speed(real, trajectory.scaled(2)) == FIRST_SPEED
    assert first_speed(Address("192.0.2.2"), trajectory) == FIRST_SPEED


def test_faults_of_the_file_have_places(tmp_path, capsys):
    path = tmp_path / "bad.csv"
    path.write_text("time,joint_1\n0,x\n")
    assert main(["move", "irb120", str(path), "--yes"]) == 2
    assert f"{path}:2:3" in capsys.readouterr().err


def test_stop(controller, capsys):
    assert main(["stop", "irb120", "--to", controller.address]) == 0
    assert len(controller.stops) == 1
    assert capsys.readouterr().out.startswith("rob1: stopped at joint_1 0.0000")


def test_stop_of_an_address_alone(controller):
    assert main(["stop", controller.address]) == 0
    assert len(controller.stops) == 1


def test_stop_that_nobody_hears(capsys):
    with FakeController() as fake:
        address = fake.address
    assert main(["stop", "irb120", "--to", address]) == 1
    assert "emergency stop" in capsys.readouterr().err


def test_monitor(controller, capsys):
    assert main(["monitor", "irb120", "--to", controller.address, "--plain", "--count", "3"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 3
    assert all("auto" in line and "standing" in line for line in lines)
    words = ["monitor", "irb120", "--to", controller.address, "--json", "--count", "30"]
    controller.script.status = {"in_error": 1, "error_code": 7}
    assert main(words) == 0
    told = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert told[-1]["joints"]["joint_1"] == 0.0
    assert told[-1]["error_code"] == 7
    assert 0 < told[-1]["jitter_p50"] <= told[-1]["jitter_p99"] < 1


def test_the_live_table(controller):
    from rich.console import Console

    from rapidgen.cli.monitor import _table
    from rapidgen.client import Robot
    from rapidgen.client.watch import Watcher

    with Robot("irb120", address=controller.address, watch=True) as robot:
        watcher = Watcher()
        for state in robot.states():
            watcher.take(state)
            if state.number > 5:
                break
        console = Console(width=100, record=True, file=io.StringIO())
        console.print(_table(robot, state, watcher))
    text = console.export_text()
    assert "joint_6" in text
    assert "states/s" in text
    assert "-|-" in text


def test_record(controller, tmp_path):
    out = tmp_path / "r.csv"
    words = ["record", "irb120", "--to", controller.address, "--seconds", "0.3", "-o", str(out)]
    assert main(words) == 0
    head, names, first, *_ = out.read_text().splitlines()
    assert head == "# time s, " + ", ".join(f"{name} rad" for name in JOINTS)
    assert names == ",".join(["time", *JOINTS])
    assert first.startswith("0.000000,0,")
    recorded = Trajectory.from_csv(out)
    assert 5 < len(recorded) < 60
    assert (recorded.times[1:] > recorded.times[:-1]).all()


def test_plot(points, tmp_path, capsys):
    assert main(["plot", str(points), str(points), "--linear", "joint_6"]) == 0
    png, html = capsys.readouterr().out.split()
    assert Path(png).read_bytes().startswith(b"\x89PNG\r\n\x1a\n")
    text = Path(html).read_text()
    assert "joint_6 [mm]" in text
    assert "joint_1 [deg]" in text
    assert "http" not in text.replace("http://www.w3.org/2000/svg", "")
    assert text.count("<polyline") > 12


def test_plot_of_names_that_want_out(tmp_path):
    path = tmp_path / "p.csv"
    path.write_text("time,</script><b>\n0,1\n1,nan\n2,2\n")
    assert main(["plot", str(path), "-o", str(tmp_path / "p")]) == 0
    text = (tmp_path / "p.html").read_text()
    assert "</script><b>" not in text


def test_plot_thins_long_recordings(tmp_path):
    import numpy as np

    from rapidgen.client.plot import Curve, write_plot

    times = np.arange(200_000) * 0.01
    values = np.sin(times)[:, None]
    values[123_456] = 9.0
    html = tmp_path / "long.html"
    write_plot(None, html, [Curve("executed", Trajectory(times, values, ("a",)))], title="long")
    assert html.stat().st_size < 200_000
    # the one outlier is still there: 9 rad in degrees
    assert "515.662" in html.read_text()


def test_plot_without_points(tmp_path):
    import numpy as np

    from rapidgen.client.plot import Curve, write_plot

    empty = Trajectory(np.zeros(0), np.zeros((0, 2)), ("a", "b"))
    write_plot(tmp_path / "e.png", tmp_path / "e.html", [Curve("nothing", empty)], title="empty")
    assert (tmp_path / "e.png").stat().st_size > 500
