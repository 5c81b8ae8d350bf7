"""`--backup`: a driver for a controller that exists, built, run and booted on it."""

import pytest

from rapidgen.cli.app import main
from tests.generate.cell_backup import write_backup


@pytest.fixture
def built(tmp_path, capsys):
    backup, out = write_backup(tmp_path / "cell"), tmp_path / "out"
    assert main(["build", "irb120", "--backup", str(backup), "-o", str(out)]) == 0
    err = capsys.readouterr().err
    assert "RobotWare 6.07, T_MOVE moves ROB_1; the user's main calls ROS_run" in err
    return backup, out


def test_run_on_the_cell(built, capsys):
    backup, out = built
    assert main(["run", str(out), "--backup", str(backup), "--max-time", "1"]) == 1
    assert "RG406" in capsys.readouterr().err


def test_run_without_its_cell_is_refused(built, capsys):
    """The status output is the cell's, and so is the task that is called T_MOVE."""
    _, out = built
    assert main(["check", str(out)]) == 0
    other = write_backup(out.parent / "other")
    cfg = other / "SYSPAR/SYS.cfg"
    cfg.write_text(cfg.read_text().replace("T_MOVE", "T_ROB1"))
    assert main(["run", str(out), "--backup", str(other), "--max-time", "1"]) == 2
    assert "RG723" in capsys.readouterr().err


@pytest.mark.parametrize("verb", ["run", "sim"])
def test_only_a_generated_folder_is_loaded_onto_a_backup(verb, built, capsys):
    backup, _ = built
    assert main([verb, str(backup), "--backup", str(backup)]) == 2
    assert "RG433" in capsys.readouterr().err


def test_sim_on_the_cell(built, start):
    backup, out = built
    sim = start(str(out), "--backup", str(backup), "--ports", "auto")
    assert set(sim.ready["ports"]["rob1"]) == {"motion", "control", "state"}
    sim.end()


def test_the_proof_refuses_another_cell(built, capsys):
    backup, _ = built
    assert main(["test", "crb15000", "--backup", str(backup)]) == 2
    assert "RG111" in capsys.readouterr().err


def test_check_looks_at_a_configuration_and_a_folder_on_the_cell(built, capsys):
    backup, out = built
    assert main(["check", "irb120", str(out), "--backup", str(backup)]) == 0
    program = backup / "RAPID/TASK1/PROGMOD/theirs.mod"
    program.write_text(
        program.read_text().replace("  PROC", "  VAR num ROS_stop_latched;\n  PROC", 1)
    )
    capsys.readouterr()
    assert main(["check", "irb120", "--backup", str(backup)]) == 1
    assert "RG112" in capsys.readouterr().out
    assert main(["check", str(out), "--backup", str(backup)]) == 1
    assert main(["check", "irb120", "--backup", str(backup / "SYSPAR")]) == 2
    assert main(["check", "irb120"]) == 0
