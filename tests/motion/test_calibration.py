"""Accelerations fitted to logs, and their way into a configuration."""

import math
import random
from itertools import pairwise

import numpy as np
import pytest

from rapidgen.cli.app import main
from rapidgen.cli.boot_options import load_boot_target
from rapidgen.client import Trajectory
from rapidgen.config import load_config
from rapidgen.config.edit import CannotEdit, set_value
from rapidgen.controller.controller import VirtualController
from rapidgen.motion.calibration import accelerations, fit_moves, identification_moves

AXES = [f"rax_{i}" for i in range(1, 7)]
CELL = "# the cell\nmodel: irb120  # the robot\njoints:\n  joint_2:\n    lower: -100 # fence\n"


@pytest.fixture(scope="module")
def hidden():
    """Accelerations of the robot, which the calibration does not know."""
    factors = random.Random(4)
    joints = load_config("irb120").groups[0].joints
    return [math.degrees(j.acceleration) * factors.uniform(0.6, 1.7) for j in joints]


@pytest.fixture(scope="module")
def measured(tmp_path_factory, hidden):
    """A folder with a configuration and the log of a robot with other accelerations."""
    folder = tmp_path_factory.mktemp("calibration")
    (folder / "cell.yaml").write_text(CELL)
    lines = [f"  joint_{i}: {{acceleration: {a}}}\n" for i, a in enumerate(hidden, 1)]
    (folder / "robot.yaml").write_text("model: irb120\njoints:\n" + "".join(lines))
    words = ["calibrate", str(folder / "cell.yaml"), "--program", str(folder / "moves.mod")]
    assert main([*words, "--amplitude", "15", "--speed", "1"]) == 0
    booted = load_boot_target([str(folder / "moves.mod")], robot=str(folder / "robot.yaml"))
    with VirtualController.boot(booted, cycle="once", autostart=False) as controller:
        (recorder,) = controller.record().values()
        controller.start_program()
        assert controller.run(max_time=200) == "finished"
        recording = recorder.recording(0.02)
    noise = np.random.default_rng(5).normal(0, 2e-6, recording.actual.shape)
    Trajectory(recording.time, recording.actual + noise, recording.joints).to_csv(
        folder / "log.csv"
    )
    return folder


def calibrated(folder, *options):
    return main(
        ["calibrate", str(folder / "cell.yaml"), "--log", str(folder / "log.csv"), *options]
    )


def test_hidden_accelerations_are_found_and_written(measured, hidden, capsys):
    assert calibrated(measured, "--write") == 0
    assert "residual 0.0" in capsys.readouterr().out
    lines = (measured / "cell.yaml").read_text().splitlines()
    assert [line for line in lines if "acceleration" not in line] == CELL.splitlines()
    group = load_config(measured / "cell.yaml").groups[0]
    found = [math.degrees(joint.acceleration) for joint in group.joints]
    assert found == pytest.approx(hidden, rel=0.02)
    assert group.acceleration_source.startswith("measured on this robot by rapidgen calibrate")


def test_block_to_paste_has_the_same_values(measured, hidden, capsys):
    assert calibrated(measured) == 0
    block = capsys.readouterr().out.partition("\njoints:")[2]
    values = [float(line.split("acceleration: ")[1][:-1]) for line in block.splitlines()[1:7]]
    assert values == pytest.approx(hidden, rel=0.02)


@pytest.mark.parametrize(
    ("change", "code"),
    [
        (lambda rows: [*rows[:40], "nan" + rows[40][rows[40].index(",") :], *rows[41:]], "RG613"),
        (lambda rows: [*rows[:40], rows[20], *rows[41:]], "RG612"),
        (lambda rows: rows[:1], "RG612"),
        (lambda rows: rows[:30], "RG643"),
        (lambda rows: [rows[0].replace("joint_6", "tool"), *rows[1:]], "RG611"),
        (lambda rows: [rows[0], *(_scaled(row, 20) for row in rows[1:])], "RG614"),
        (lambda rows: [rows[0], *(_faster(row, 2) for row in rows[1:])], "RG615"),
    ],
    ids=["nan", "time", "empty", "short", "joint", "degrees", "other robot"],
)  # fmt: skip
def test_bad_logs_are_rejected(measured, tmp_path, capsys, change, code):
    rows = (measured / "log.csv").read_text().splitlines()
    (tmp_path / "log.csv").write_text("\n".join(change(rows)))
    words = ["calibrate", str(measured / "robot.yaml"), "--log", str(tmp_path / "log.csv")]
    before = (measured / "robot.yaml").read_bytes()
    assert main([*words, "--write"]) != 0
    assert code in capsys.readouterr().err
    assert (measured / "robot.yaml").read_bytes() == before


def _scaled(row, factor):
    time, *joints = row.split(",")
    return ",".join([time, *(str(float(value) * factor) for value in joints)])


def _faster(row, factor):
    time, joints = row.split(",", 1)
    return f"{float(time) / factor},{joints}"


@pytest.mark.parametrize(
    ("options", "text"),
    [
        (["--amplitude", "100", "--speed", "1"], "joint_3 would leave its limits"),
        (["--amplitude", "-5", "--speed", "1"], "amplitudes are 0 or more"),
        (["--amplitude", "5,5", "--speed", "1"], "2 values for 6 joints"),
        (["--amplitude", "5", "--speed", "1.5"], "at most 1, not 1.5"),
        (["--amplitude", "5"], "choose a fraction of the axis speeds"),
        (["--speed", "1"], "choose how far the axes may move"),
    ],
)
def test_bad_moves_are_rejected(tmp_path, capsys, options, text):
    program = tmp_path / "moves.mod"
    assert main(["calibrate", "irb120", "--program", str(program), *options]) == 2
    assert text in " ".join(capsys.readouterr().err.split())
    assert not program.exists()


def test_moves_stay_within_the_amplitudes():
    start, amplitudes = (0.1, -0.2, 0.3, 0.0, 0.5, 0.0), (0.2, 0.3, 0.1, 0.0, 0.4, 0.5)
    targets = [start, *identification_moves(start, amplitudes, AXES)]
    for target in targets:
        for value, begin, amplitude in zip(target, start, amplitudes, strict=True):
            assert abs(value - begin) <= amplitude + 1e-12
    assert targets[-1] == start
    moved = [[j for j in range(6) if a[j] != b[j]] for a, b in pairwise(targets)]
    single = [axes[0] for axes in moved if len(axes) == 1]
    assert {axis: single.count(axis) for axis in range(6) if axis != 3} == {
        0: 9, 1: 7, 2: 7, 4: 9, 5: 9
    }  # fmt: skip
    assert {targets[k + 1][1] for k, axes in enumerate(moved) if axes == [1, 2]} == {
        -0.2 + 0.3, -0.2 - 0.3, -0.2
    }  # fmt: skip


def test_moves_of_several_axes_are_left_out():
    joints = load_config("irb120").groups[0].joints
    times = np.arange(0, 2, 0.02)
    positions = np.zeros((len(times), 6))
    positions[:, 0] = positions[:, 1] = np.clip(times - 0.5, 0, 0.5)
    assert fit_moves(times, positions, joints) == []
    assert accelerations([]) == []


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", "joints:\n  a: {acceleration: 5}\n"),
        ("model: x # robot", "model: x # robot\njoints:\n  a: {acceleration: 5}\n"),
        ("joints: {}\n", "joints: {a: {acceleration: 5}}\n"),
        ("joints:\n  b: 1\nx: 1\n", "joints:\n  a: {acceleration: 5}\n  b: 1\nx: 1\n"),
        ("joints:\n  a:\n    # c\n    b: 1\n",
         "joints:\n  a:\n    # c\n    acceleration: 5\n    b: 1\n"),
        ("joints: {a: {acceleration: 4.5}} # c", "joints: {a: {acceleration: 5}} # c"),
        ("joints:\n  a: # c\n", "joints:\n  a: {acceleration: 5} # c\n"),
        ("model: x\r\njoints:\r\n", "model: x\r\njoints: {a: {acceleration: 5}}\r\n"),
    ],
)  # fmt: skip
def test_a_value_is_set_in_place(text, expected):
    assert set_value(text, ("joints", "a", "acceleration"), 5) == expected


@pytest.mark.parametrize(
    "text", ["- joints\n", "joints: 5\n", "b: &x {}\njoints: {a: {acceleration: *x}}\n",
             "b: &x 5\njoints: {a: {acceleration: *x}}\n", "model: x\n...\n"]
)  # fmt: skip
def test_other_texts_cannot_be_edited(text):
    with pytest.raises(CannotEdit):
        set_value(text, ("joints", "a", "acceleration"), 5)


def test_a_value_shared_by_an_alias_is_not_written(measured, tmp_path, capsys):
    path = tmp_path / "cell.yaml"
    path.write_text("model: irb120\njoints:\n  joint_1: &one {source: mine}\n  joint_2: *one\n")
    before = path.read_bytes()
    words = ["calibrate", str(path), "--log", str(measured / "log.csv"), "--write"]
    assert main(words) == 1
    err = capsys.readouterr().err
    assert "RG644" in err
    assert "joint_1: {acceleration: " in err
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]
