"""`rapidgen export`: whole files or none."""

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
