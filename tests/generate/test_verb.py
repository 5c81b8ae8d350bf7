"""`rapidgen build`: what it prints, writes and returns."""

import os

import pytest

from rapidgen.cli.app import main


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_build_writes_to_rapid_out(here, capsys):
    assert main(["build", "irb120"]) == 0
    out, err = capsys.readouterr()
    assert out == ""
    assert "rapid_out/irb120: 14 files, build " in err
    assert sorted(os.listdir(here / "rapid_out/irb120")) == [
        "EIO.cfg",
        "HOME",
        "README.md",
        "SYS.cfg",
        "manifest.json",
    ]


def test_list_writes_nothing(here, capsys):
    assert main(["build", "irb120", "--list", "-o", "x"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[-1] == "manifest.json"
    assert "HOME/rapidgen/ROS_motion.mod" in lines
    assert os.listdir(here) == []


def test_check_and_diff(here, capsys):
    assert main(["build", "irb120", "-o", "x"]) == 0
    assert main(["build", "irb120", "-o", "x", "--check"]) == 0
    assert main(["build", "irb120", "-o", "x", "--diff"]) == 0
    assert capsys.readouterr().out == ""
    changed = ["build", "irb120", "-o", "x", "--set", "trajectory.capacity=5000"]
    assert main([*changed, "--diff"]) == 1
    out = capsys.readouterr().out
    assert "-    CONST num ROS_CAPACITY := 1000;\n+    CONST num ROS_CAPACITY := 5000;" in out
    assert main([*changed, "--check"]) == 1
    assert "RG104" in capsys.readouterr().err
    assert main(["build", "irb120", "-o", "x", "--check"]) == 0


def test_a_file_that_no_build_made_is_not_taken_away(here, capsys):
    assert main(["build", "irb120", "-o", "x"]) == 0
    # A file of an earlier build is the build's own, though this one does not write it.
    assert main(["build", "irb120", "-o", "x", "--set", "ports.control=0"]) == 0
    assert not (here / "x/HOME/rapidgen/ROS_control.mod").exists()
    own = here / "x/HOME/rapidgen/my_calibration.mod"
    own.write_text("MODULE my_calibration\nENDMODULE\n")
    assert main(["build", "irb120", "-o", "x"]) == 2
    assert "error[RG102]" in (displayed := capsys.readouterr().err)
    assert "HOME/rapidgen/my_calibration.mod" in displayed
    assert own.exists()
    own.unlink()
    (here / "x/manifest.json").write_text("{")
    assert main(["build", "irb120", "-o", "x"]) == 0


def test_a_wrong_key_is_bad_input(here, capsys):
    assert main(["build", "irb120", "--set", "trajectory.capasity=5"]) == 2
    assert "capacity" in capsys.readouterr().err
    assert os.listdir(here) == []
