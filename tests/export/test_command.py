"""`rapidgen export`: whole files or none."""

import re

import pytest

from rapidgen.cli.app import main

CELL = """model: irb120
signals:
  spindle: {kind: DO, access: write}
"""
PART = "G21 G90\nG0 X0 Y0 Z20\nM3\nG1 Z0 F6000\nG1 X50\nG2 X60 Y10 R10\nG0 Z20\nM30\n"
FRAME = ["--tool-axis", "0,0,-1", "--turn", "0", "--origin", "350,-20,300"]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cell.yaml").write_text(CELL)
    (tmp_path / "part.nc").write_text(PART)
    return tmp_path


def export(*options, source="part.nc", output="part.mod"):
    return main(["export", source, "--config", "cell.yaml", "-o", output, *options])


def test_gcode_becomes_a_module(folder, capsys):
    assert export(*FRAME, "--word", "M3=signal:spindle:1") == 0
    text = (folder / "part.mod").read_text()
    assert text.startswith("MODULE part\n")
    assert text.count("MoveC") == 1
    assert "SetDO spindle, 1;" in text
    assert "virtual controller:" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "report"),
    [
        (FRAME, "part.nc:3:1"),
        ([*FRAME, "--word", "M3=signal:spin:1"], "part.nc:3:1"),
        ([*FRAME, "--word", "M3=ignore", "--origin", "950,0,300"], "part.nc:2:1"),
        ([*FRAME, "--word", "M3"], "is not WORD=ACTION"),
        ([*FRAME, "--word", "M3=ignore", "--turn", "x"], "turn"),
        ([*FRAME, "--word", "M3=ignore", "--tool", "gun"], "no tool 'gun'"),
        ([*FRAME, "--word", "M3=ignore", "--zone", "z11"], "z11"),
        ([*FRAME, "--word", "M3=ignore", "--routine", "movej"], "RG750"),
        ([*FRAME, "--word", "M3=ignore", "--epilogue", "bad.txt"], "RG2"),
        ([*FRAME, "--word", "M3=ignore", "--prologue", "missing.txt"], "cannot read"),
        ([*FRAME, "--word", "M3=ignore", "--prologue", "wrong.txt"], "RG754"),
    ],
)
def test_fault_leaves_no_file(folder, capsys, options, report):
    (folder / "bad.txt").write_text("IF THEN\n")
    # Accepted by the checker, and beyond the workspace.
    (folder / "wrong.txt").write_text("MoveL Offs(CRobT(), 9000, 0, 0), v100, fine, tool0;\n")
    assert export(*options) in (1, 2)
    assert report in capsys.readouterr().err
    assert sorted(path.name for path in folder.iterdir()) == [
        "bad.txt",
        "cell.yaml",
        "part.nc",
        "wrong.txt",
    ]


def test_existing_module_is_kept_on_a_fault(folder):
    (folder / "part.mod").write_text("mine")
    assert export(*FRAME) == 2
    assert (folder / "part.mod").read_text() == "mine"
    assert export(*FRAME, "--word", "M3=ignore", "--no-run") == 0
    assert (folder / "part.mod").read_text().startswith("MODULE part")


def test_output_is_a_module(folder, capsys):
    assert export(*FRAME, output="part.txt") == 2
    assert export(*FRAME, output="7.mod", source="part.xyz") == 2
    assert "unknown kind of file" in capsys.readouterr().err


def test_orientation_error_of_wrist_interpolation_is_reported(folder, capsys):
    # The first line keeps the orientation, the second turns it about an oblique axis.
    (folder / "poses.csv").write_text(
        "x,y,z,q1,q2,q3,q4\n350,-20,300,0,0,1,0\n350,20,300,0,0,1,0\n"
        "400,20,350,0.3213938,0.5416752,0.7660444,-0.1298\n"
    )
    options = ["--units", "mm", "--speed", "100"]
    assert export(*options, source="poses.csv") in (0, 2)
    assert "RG759" not in capsys.readouterr().err
    assert export(*options, "--allow-singularities", source="poses.csv") == 0
    report = capsys.readouterr().err
    places = re.findall(
        r"turns up to ([0-9.]+) deg away on this move\n *--> poses.csv:(\d)", report
    )
    assert [line for _, line in places] == ["4", "3"]
    # At the ends the orientation is the programmed one: the error is less than the whole turn.
    assert 0 < float(places[1][0]) < float(places[0][0]) < 40
