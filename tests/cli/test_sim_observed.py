"""`sim --coverage --plot`: what was reached until it ended, and until each restart."""

import pytest

from rapidgen.cli.run_outputs import Outputs, observing
from rapidgen.controller.boot_targets import load_target
from rapidgen.controller.runner import ControllerRunner
from rapidgen.diagnostics import DiagnosticError

TEXT = (
    "MODULE m\n PERS num n := 0;\n PROC main()\n  IF n = 0 THEN\n   n := 1;\n  ENDIF\n"
    "  MoveAbsJ [[10,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;\n"
    "  WaitTime 100;\n ENDPROC\nENDMODULE\n"
)


def test_coverage_is_written_at_end_and_before_restart(tmp_path):
    path = tmp_path / "m.mod"
    path.write_text(TEXT)
    wanted = Outputs(coverage=(tmp_path / "c.lcov",), plots=(tmp_path / "p.png",))
    result = load_target([path])
    with (
        ControllerRunner.boot(result, tracing=wanted.tracing) as runner,
        observing(runner, wanted),
    ):
        runner.run(lambda: runner.controller.now > 2)
        assert not (tmp_path / "c.lcov").exists()
        runner.ask_restart()
        runner.run(lambda: runner.restarts > 0)
    before, after = ((tmp_path / name).read_text() for name in ("c-1.lcov", "c.lcov"))
    assert ("DA:5,1" in before, "DA:5,0" in after) == (True, True), "nothing ran behind it"
    assert sorted(p.name for p in tmp_path.glob("p*")) == ["p-1.png", "p.png"]


def test_one_file_for_two_things_is_refused(tmp_path):
    with pytest.raises(DiagnosticError, match="written twice"):
        Outputs(coverage=(tmp_path / "a.png",), plots=(tmp_path / "a.png",)).check_files_writable()
