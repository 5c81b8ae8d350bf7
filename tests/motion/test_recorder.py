"""Recordings."""

import csv
from pathlib import Path

import numpy as np
import pytest

from rapidgen.cli.app import main
from rapidgen.motion.recorder import is_recording, read_recording

BODY = """
    MoveAbsJ [[10,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, z10, tool0;
    MoveAbsJ [[20,10,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
"""


def test_arrays_and_csv(rapid, tmp_path):
    program = rapid(BODY)
    recorder = program.controller.record()["rob1"]
    program.run(2.0)
    recorder.stop()
    program.run(1.0)
    recording = recorder.recording()
    assert np.diff(recording.time) == pytest.approx(0.004)
    assert recording.time[-1] == pytest.approx(2.0, abs=0.004)
    assert recording.commanded.shape == (len(recording.time), 6)
    assert np.degrees(recording.commanded[-1]) == pytest.approx([20, 10, 0, 0, 30, 0], abs=1e-5)
    assert (recording.actual == recording.commanded).all()
    flange = program.group.kinematics.forward(tuple(recording.commanded[100]))
    assert recording.tcp[100] == pytest.approx([*flange[0], *flange[1]])
    lines = [name.rpartition("/")[2] for name in recording.motion_pointer]
    assert [line for i, line in enumerate(lines) if line and line not in lines[:i]] == ["5", "6"]
    ahead = recording.program_pointer.index("Probe/main/6")
    assert recording.motion_pointer[ahead] == "Probe/main/5"  # the program runs ahead

    recording.write_csv(tmp_path / "r.csv")
    with (tmp_path / "r.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(recording.time)
    assert float(rows[-1]["joint_1"]) == pytest.approx(recording.commanded[-1][0], abs=1e-8)
    assert rows[-1]["motion_pointer"] == "Probe/main/6"


def test_any_period_gives_the_same_motion(rapid):
    program = rapid(BODY)
    recorder = program.controller.record()["rob1"]
    program.run(2.0)
    fine, coarse = recorder.recording(0.001), recorder.recording(0.01)
    assert fine.commanded[::10] == pytest.approx(coarse.commanded, abs=0)


def test_the_tool_of_the_first_move_is_there_before_it(rapid):
    """A curve of the TCP has no jump without a tool, before or after one is set."""
    rod = "[TRUE,[[0,0,200],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]]"
    move = "MoveAbsJ [[20,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, rod;"
    program = rapid(
        f"WaitTime 0.1; {move} StopMove; ClearPath; StartMove; WaitTime 0.1;",
        f"PERS tooldata rod := {rod};\n",
    )
    recorder = program.controller.record()["rob1"]
    program.run(3.0)
    tcp = recorder.recording().tcp
    assert np.abs(np.diff(tcp[:, :3], axis=0)).max() < 0.1 * 0.004 * 1.5


def test_a_recording_is_read_back_and_drawn(rapid, tmp_path, capsys):
    program = rapid(BODY)
    recorder = program.controller.record()["rob1"]
    program.run()
    recording = recorder.recording()
    path = tmp_path / "r.csv"
    recording.write_csv(path)
    result = read_recording(path)
    assert is_recording(path)
    assert result.joints == recording.joints
    assert np.abs(result.commanded - recording.commanded).max() < 1e-9
    assert np.abs(result.tcp - recording.tcp).max() < 1e-9
    assert result.motion_pointer == recording.motion_pointer
    pytest.importorskip("matplotlib")
    assert main(["plot", str(path)]) == 0
    html, png = (Path(name) for name in capsys.readouterr().out.split())
    assert png.read_bytes().startswith(b"\x89PNG")
    text = html.read_text()
    for expected in ("commanded", "TCP speed", "joint_6", "deg", '"x"', "mm"):
        assert expected in text


@pytest.mark.parametrize(
    ("row", "reason"),
    [("1,2", "values"), ("0,0,0,0,0,0,x,0,0,0,0,0,0,0,0,0,0,0,0,0,a,b", "could not convert")],
)
def test_a_damaged_recording_is_a_finding(rapid, tmp_path, capsys, row, reason):
    program = rapid(BODY)
    recorder = program.controller.record()["rob1"]
    program.run()
    path = tmp_path / "r.csv"
    recorder.recording().write_csv(path)
    path.write_text(path.read_text() + row + "\n")
    assert main(["plot", str(path)]) == 2
    assert reason in capsys.readouterr().err
    assert not path.with_suffix(".png").exists()
