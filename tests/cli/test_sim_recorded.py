"""`sim --record`: one file for each run of the controller; wrong options are rejected."""

import signal
import subprocess
import sys

import pytest
import typer

from rapidgen.cli.run_outputs import read_appearance
from rapidgen.cli.sim import _recording
from rapidgen.controller.boot_targets import BootOptions, load_target
from rapidgen.controller.runner import ControllerRunner
from rapidgen.viewer.recording.reader import RecordingFile


@pytest.fixture
def runner():
    with ControllerRunner.boot(load_target(["irb120"], BootOptions()), clock="virtual") as runner:
        yield runner


@pytest.fixture(scope="module")
def look():
    return read_appearance(load_target(["irb120"], BootOptions()))


def test_a_restart_begins_another_file(runner, look, tmp_path):
    path = tmp_path / "run.mcap"
    with _recording(runner, look, path, ["T_ROB1:ERRNO"]):
        runner.controller.run_for(1.0)
        runner.ask_restart()
        runner.run(lambda: runner.restarts > 0)
        runner.controller.run_for(2.0)
    for name, length in (("run.mcap", 1.0), ("run-2.mcap", 2.0)):
        with RecordingFile(tmp_path / name) as file:
            assert not file.cut
            assert file.end == pytest.approx(length, abs=0.1)
            assert file.at(0.5).watch["T_ROB1", "ERRNO"].text == "0"


@pytest.mark.parametrize("watch", ["ERRNO", "T_NONE:ERRNO", "T_ROB1:"])
def test_a_watch_names_a_task_and_an_expression(runner, look, tmp_path, watch):
    with (
        pytest.raises(typer.BadParameter, match="T_ROB1, T_ROS_RECV"),
        _recording(runner, look, tmp_path / "run.mcap", [watch]),
    ):
        pytest.fail("it went on")
    assert list(tmp_path.iterdir()) == []


def test_a_watch_is_for_a_recording(runner):
    with (
        pytest.raises(typer.BadParameter, match="--record"),
        _recording(runner, None, None, ["T_ROB1:1"]),
    ):
        pytest.fail("it went on")


def test_the_end_of_the_simulator_ends_the_file_whole(tmp_path):
    path = tmp_path / "run.mcap"
    command = [sys.executable, "-m", "rapidgen.cli", "sim", "irb120", "--ports", "auto"]
    with subprocess.Popen(
        [*command, "--record", str(path)], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
    ) as process:
        assert process.stdout.readline().startswith(b"ready ")
        process.send_signal(signal.SIGTERM)
        assert process.wait(60) == 0
    with RecordingFile(path) as file:
        assert not file.cut
        assert file.at(file.end).tasks["T_ROB1"].state == "running"
