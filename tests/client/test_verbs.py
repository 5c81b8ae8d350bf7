"""move, stop, monitor, record and plot as a user calls them."""

import io
import itertools
import json
import re
import struct
from datetime import datetime, timezone
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from fake_controller import FakeController
from fake_stream import StreamModel, frame

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
    displayed = capsys.readouterr()
    done, at = displayed.out.splitlines()
    assert re.fullmatch(r"done: 2 points in \d\.\d\d s, 0\.0000 \(rad, m\).*", done)
    assert at.startswith("at joint_1 11.46 deg, joint_2 5.73 deg")
    assert "standard abb_driver" in " ".join(displayed.err.split())
    recorded = Trajectory.from_csv(executed)
    assert recorded.names == tuple(JOINTS)
    assert recorded.positions[-1].tolist() == pytest.approx(GOAL)


def test_move_as_json(controller, points, capsys):
    assert main(["move", "irb120", str(points), "--to", controller.address, "-y", "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["joints"]["joint_6"] == pytest.approx(0.3)


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
    displayed = capsys.readouterr().err
    assert "RG640" in displayed
    assert "--move-real-robot 192.0.2.1" in displayed


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
    assert capsys.readouterr().out.startswith("rob1: stopped at joint_1 0.00 deg")


def test_stop_of_an_address_alone(controller):
    assert main(["stop", controller.address]) == 0
    assert len(controller.stops) == 1


def test_stop_without_driver_recommends_emergency_stop(capsys):
    with FakeController() as fake:
        address = fake.address
    assert main(["stop", "irb120", "--to", address]) == 1
    assert "emergency stop" in capsys.readouterr().err


def test_monitor(controller, capsys):
    assert main(["monitor", "irb120", "--to", controller.address, "--lines", "--count", "3"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 3
    assert all("auto" in line and "standing" in line for line in lines)
    controller.position = [0.5, -0.1, 0.0, 0.0, 0.0, 0.0]
    controller.script.status = {"possible": 0}
    assert main(["monitor", "irb120", "--to", controller.address, "--lines", "--count", "30"]) == 0
    line = capsys.readouterr().out.splitlines()[-1]
    assert "  28.65 -5.73 0.00 0.00 0.00 0.00 deg  " in line
    assert "standing, motion not possible" in line
    controller.position = [0.0] * 6
    words = ["monitor", "irb120", "--to", controller.address, "--json", "--count", "30"]
    controller.script.status = {"in_error": 1, "error_code": 7}
    assert main(words) == 0
    report = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert report[-1]["joints"]["joint_1"] == 0.0
    assert report[-1]["error_code"] == 7
    assert (report[-1]["in_error"], report[0]["in_motion"]) == (True, False)
    when = datetime.fromisoformat(report[-1]["time"])
    assert abs((datetime.now(timezone.utc) - when).total_seconds()) < 3600
    assert 0 < report[-1]["jitter_p50"] <= report[-1]["jitter_p99"] < 1


def test_the_live_table(controller):
    from rich.console import Console

    from rapidgen.client import Robot
    from rapidgen.viewer.state_lines import StateStatistics, as_table

    with Robot("irb120", address=controller.address, watch=True) as robot:
        watcher = StateStatistics()
        for state in robot.states():
            watcher.take(state)
            if state.number > 5:
                break
    for width in (100, 60):
        console = Console(width=width, record=True, file=io.StringIO())
        console.print(as_table(state, watcher, robot.group, "here", width))
        text = console.export_text()
        print(text)
        assert "joint_6" in text
        assert "states/s" in text
        assert "-|-" in text
        assert "…" not in text
        assert "0.0 deg/s" in text
        assert max(map(len, text.splitlines())) <= width


@pytest.fixture
def a_second_in_twenty_looks(monkeypatch):
    """However long a state takes on this machine."""
    looks = SimpleNamespace(monotonic=itertools.count(0, 0.05).__next__)
    monkeypatch.setattr("rapidgen.cli.observation.time", looks)


@pytest.mark.usefixtures("a_second_in_twenty_looks")
def test_record(controller, tmp_path):
    out = tmp_path / "r.csv"
    words = ["record", "irb120", "--to", controller.address, "--seconds", "0.3", "-o", str(out)]
    assert main(words) == 0
    head, names, first, *_ = out.read_text().splitlines()
    assert head == "# time s, " + ", ".join(f"{name} rad" for name in JOINTS)
    assert names == ",".join(["time", *JOINTS])
    assert first.startswith("0.000000,0,")
    recorded = Trajectory.from_csv(out)
    assert len(recorded) == 5
    assert (recorded.times[1:] > recorded.times[:-1]).all()


def test_plot(points, tmp_path, capsys):
    pytest.importorskip("matplotlib")
    out = tmp_path / "both.svg"
    assert main(["plot", str(points), str(points), "--robot", "irb120", "-o", str(out)]) == 0
    assert capsys.readouterr().out.split() == [str(out)]
    assert "<svg" in out.read_text()
    assert main(["plot", str(points), "-o", str(tmp_path / "both.pdf")]) == 2
    assert "RG626" in capsys.readouterr().err


@pytest.fixture
def streaming():
    with FakeController(stream=StreamModel(speed=20, ring=64), control=True) as fake:
        yield fake


@pytest.fixture
def many(tmp_path):
    path = tmp_path / "many.csv"
    positions = [[0.002 * n] * 6 for n in range(150)]
    Trajectory.from_points(positions, seconds=0.1, names=JOINTS).to_csv(path)
    return path


def mapping_of(name):
    from rapidgen.client.core.group import Group

    config = load_config(name)
    return Group.of(config, config.groups[0]).mapping


@pytest.mark.parametrize(
    ("words", "mode"), [([], "stream"), (["--stream"], "stream"), (["--download"], "download")]
)
def test_move_tells_which_way_the_points_go(streaming, many, capsys, words, mode):
    streaming.script.mapping = mapping_of("irb120")
    streaming.script.capacity = 100
    call = ["move", "irb120", str(many), "--to", streaming.address, "-y", *words]
    if mode == "download":
        # as a whole it does not fit
        assert main(call) == 1
        assert "RG617" in capsys.readouterr().err
        return
    assert main([*call, "--json"]) == 0
    displayed = capsys.readouterr()
    report = json.loads(displayed.out)
    assert (report["way"], report["points"]) == ("stream", 150)
    assert report["starved"] >= 0  # how often depends on this machine's load; test_stream_clock.py
    assert "sent during the motion" in " ".join(displayed.err.split())


def test_move_with_fault_at_point_reports_it(streaming, many, capsys):
    streaming.script.mapping = mapping_of("irb120")
    streaming.script.stream.point_fault = (100, 7, 0)
    assert main(["move", "irb120", str(many), "--to", streaming.address, "-y"]) == 1
    assert "at point 100: a duration needs more speed than the TCP" in " ".join(
        capsys.readouterr().err.split()
    )


def test_stream_where_the_driver_cannot(controller, points, capsys):
    call = ["move", "irb120", str(points), "--to", controller.address, "-y"]
    assert main([*call, "--stream"]) == 1
    assert "RG624" in capsys.readouterr().err
    assert main(call) == 0
    assert "(download)" in capsys.readouterr().out


def test_the_progress_bar_tells_what_the_robot_is_at(streaming, monkeypatch):
    import rich.console

    from rapidgen.cli import motion_execution
    from rapidgen.client import Robot

    class Terminal(io.StringIO):
        def isatty(self):
            return True

    terminal = Terminal()
    monkeypatch.setattr(motion_execution.sys, "stderr", terminal)
    made = rich.console.Console
    monkeypatch.setattr(
        rich.console, "Console", lambda **_: made(file=terminal, force_terminal=True, width=80)
    )
    with Robot(streaming.address) as robot:
        path = Trajectory.from_points([[0.0] * 6, [0.2] * 6], seconds=20)
        result = motion_execution.follow(robot.execute(path, mode="stream"))
    assert result.points == 2
    assert "moving" in terminal.getvalue()
    assert "done" in terminal.getvalue()
    assert "100 %" in terminal.getvalue()


def test_monitor_tells_what_a_stream_is_at(streaming, capsys):
    from rapidgen.client import Robot

    with Robot(streaming.address) as robot:
        feed = robot.stream()
        feed.append([0, 0.6], [[0.0] * 6, [0.01] * 6])
        robot.wait_until(lambda s: s.trajectory is not None and s.trajectory.name == "STARVED", 60)
        data = struct.pack("<3i80s160x", 5, 24, 3, b"Corner path failure")
        words = ["monitor", streaming.address, "--lines", "--count", "3"]
        streaming.extra = frame(1308, 1, 0, data)
        assert robot.next_event(60).code == 50024
        assert main(words) == 0
        assert "starved" in capsys.readouterr().out
        robot.pause()
        assert main([*words, "--json"]) == 0
        assert json.loads(capsys.readouterr().out.splitlines()[-1])["trajectory"] == "paused"
        robot.resume()
        feed.cancel()


def test_words_of_a_monitor():
    from rapidgen.client import Event, Status
    from rapidgen.viewer.state_lines import StateStatistics
    from rapidgen.wire.simple_message.spec import EventType, TrajectoryState

    watcher = StateStatistics()
    for number, trajectory in enumerate((TrajectoryState.MOVING, TrajectoryState.STARVED)):
        watcher.take(
            SimpleNamespace(number=number, time=number, status=Status(), trajectory=trajectory)
        )
    assert watcher.event == "the stream ran out of points"
    event = Event(0.0, 50024, EventType.ERROR, "Corner path failure", 1)
    for report in (event, None):
        watcher.take(SimpleNamespace(number=2, time=2, status=Status(), trajectory=None), report)
    assert watcher.event == "50024 Corner path failure"


@pytest.mark.usefixtures("a_second_in_twenty_looks")
def test_record_with_the_controllers_time(streaming, tmp_path):
    out = tmp_path / "r.csv"
    words = ["record", streaming.address, "--feedback", "--seconds", "0.3", "-o", str(out)]
    streaming.script.feedback = True
    assert main(words) == 0
    recorded = Trajectory.from_csv(out)
    assert len(recorded) == 5
    # of a clock that runs twice as fast as this one; on a busy machine a message may be left out
    periods = np.diff(recorded.times) / 0.02
    assert periods == pytest.approx(np.maximum(np.round(periods), 1), abs=5e-3)


def test_stop_over_the_control_port_when_the_motion_port_is_dead(streaming, capsys):
    streaming._servers["motion"].close()
    assert main(["stop", streaming.address]) == 0
    assert len(streaming.stops) == 1


def test_in_a_pipe_a_line_tells_how_far_it_is(monkeypatch, capsys):
    from rapidgen.cli import motion_execution
    from rapidgen.cli.terminal import set_up
    from rapidgen.client import RobotTimeout, TrajectoryState

    class Execution:
        is_over = False
        waits = 0

        @property
        def progress(self):
            return SimpleNamespace(state=TrajectoryState.MOVING, reached=self.waits, total=9)

        def result(self, timeout):
            assert timeout == 10
            self.waits += 1
            if self.waits < 3:
                raise RobotTimeout.because("RG603", "not yet")
            return "done"

    monkeypatch.setattr("sys.stderr.isatty", lambda: False)
    assert motion_execution.follow(Execution()) == "done"
    assert capsys.readouterr().err == "moving: 1 of 9 points\nmoving: 2 of 9 points\n"
    set_up(["-q"])
    assert motion_execution.follow(Execution()) == "done"
    assert capsys.readouterr().err == ""
    set_up([])


# -- view ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("rapidgen", "code"), [(True, "RG920"), (False, "RG923")])
def test_looking_takes_no_place_that_is_the_only_one(rapidgen, code, capsys, monkeypatch):
    """HELLO distinguishes a driver of `profile: basic` from a plain one.

    It has no control port.
    """
    monkeypatch.setattr("rapidgen.viewer.server.ASSETS", Path("nowhere"))
    with FakeController(rapidgen=rapidgen, control=False) as fake:
        assert main(["view", fake.address]) == 1
    assert code in capsys.readouterr().err


ENDED = {"in_error": 1, "error_code": 53, "possible": 0}


@pytest.mark.parametrize(
    ("report", "message"),
    [
        (ENDED, "a server task of the driver has ended, no motion is possible"),
        ({**ENDED, "in_error": 0}, ""),
        ({**ENDED, "error_code": 40}, ""),
    ],
)
def test_doctor_names_the_fix_of_a_server_task_that_has_ended(report, message, tmp_path, capsys):
    with FakeController(status=report) as fake:
        motion, state = fake.ports["motion"], fake.ports["state"]
        config = tmp_path / "cell.yaml"
        config.write_text(
            f"model: irb120\nports: {{motion: {motion}, state: {state}, control: 0}}\n"
        )
        (tmp_path / "HOME").mkdir()
        words = ["doctor", str(config), "--to", f"dir://{tmp_path}/HOME", "--host", "127.0.0.1"]
        main([*words, "--json"])
    checks = json.loads(capsys.readouterr().out)
    result = [c for c in checks if c["area"] == "driver" and c["verdict"] == "fail"]
    assert [message in check["found"] for check in result] == [True] * bool(message)
    assert all("warm start" in check["help"] for check in result)


def test_monitor_names_the_fix_of_a_server_task_that_has_ended(capsys):
    with FakeController(status=ENDED) as fake:
        assert main(["monitor", fake.address, "--lines", "--count", "1"]) == 0
    line = capsys.readouterr().out
    assert "motion not possible" in line
    assert "a server task of the driver has ended: restart the controller (a warm start)" in line
