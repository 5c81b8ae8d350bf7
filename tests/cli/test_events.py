"""`rapidgen explain NUMBER` and `rapidgen log FILE`."""

import json

import pytest

from rapidgen.cli.app import main

LOG = (
    "RobotWare: 5.61\n"
    '8\tE\tMotion\t50050\tPosition\t2026-01-02 03:04:06\tText\t{args: "3", "ROB_1"}\n'
    "7\tE\tOther\t99999\tUnknown title\t2026-01-02 03:04:05\tUnknown text\t{args: }\n"
)


def test_explain_names_cause_remedy_and_source(capsys):
    assert main(["explain", "50050"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("50050: Position out of reach\n")
    for part in ("error, domain motion", "5.61, 6.03", "Usual causes:", "What to do:", "Source:"):
        assert part in out


def test_explain_lists_events(capsys):
    assert main(["explain", "events"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) >= 60
    assert " 50024  W    Corner path executed as a stop point" in lines


@pytest.mark.parametrize("code", ["12345", "0", "9" * 40])
def test_explain_rejects_unknown_event(capsys, code):
    assert main(["explain", code]) == 2
    assert "RG902" in capsys.readouterr().err


def test_log_explains_a_saved_file(tmp_path, capsys):
    path = tmp_path / "Elog_all.txt"
    path.write_text(LOG)
    assert main(["log", str(path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[:4] == [
        "2026-01-02 03:04:05  E   99999  Unknown title",
        "    Unknown text",
        "2026-01-02 03:04:06  E   50050  Position out of reach",
        "    Axis 3 of ROB_1 cannot reach the position.",
    ]
    assert lines[5] == "2 events of RobotWare 5.61; errors and warnings:"


def test_log_writes_a_saved_file_as_json(tmp_path, capsys):
    path = tmp_path / "Elog_all.txt"
    path.write_text(LOG)
    assert main(["log", str(path), "--json", "--domain", "5"]) == 0
    (line,) = capsys.readouterr().out.splitlines()
    assert json.loads(line)["arguments"] == ["3", "ROB_1"]


@pytest.mark.parametrize("options", [["--follow"], []])
def test_log_rejects_following_a_file_or_another_file(tmp_path, capsys, options):
    path = tmp_path / "Elog_all.txt"
    path.write_text(LOG if options else "text")
    assert main(["log", str(path), *options]) == 2
    assert ("RG901" if options else "RG724") in capsys.readouterr().err


CORNERS = """MODULE corner
  CONST robtarget p := [[364,0,594],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
    FOR i FROM 1 TO 3 DO
      MoveL Offs(p, 0, 20 * i, 0), v1000, z50, tool0;
      WaitTime 1;
    ENDFOR
    handled;
  ENDPROC
  PROC handled()
    VAR num zero;
    zero := 1 / zero;
  ERROR
    TRYNEXT;
  ENDPROC
ENDMODULE
"""


def test_run_prints_each_warning_of_the_event_log_once(tmp_path, capsys):
    path = tmp_path / "corner.mod"
    path.write_text(CORNERS)
    assert main(["run", str(path)]) == 0
    lines = capsys.readouterr().err.splitlines()
    assert [line for line in lines if line.startswith("warning")] == [
        "warning[RG409]: event 50024: Corner path executed as a stop point (3 times)"
    ]
    assert f" --> {path}:6:7" in lines
    assert "  = note: Task T_ROB1: the corner at /corner/main/MoveL/6 became a stop." in lines
