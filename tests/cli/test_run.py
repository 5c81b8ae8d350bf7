"""`rapidgen run`: output, exit codes, reports."""

import json
from contextlib import closing
from math import radians
from pathlib import Path

import pytest

from rapidgen.cli.app import main
from rapidgen.viewer.recording.reader import RecordingFile

PROGRAM = """MODULE demo
  PERS num shared := 0;
  PROC main()
    VAR num n;
    FOR i FROM 1 TO 3 DO
      n := n + i;
      IF n > 100 THEN
        TPWrite "never";
      ENDIF
    ENDFOR
    TPWrite "sum " + ValToStr(n);
    WaitTime 2;
  ENDPROC
  PROC divide()
    VAR num z;
    z := 1 / z;
  ENDPROC
  PROC deadlock()
    WaitUntil FALSE;
  ENDPROC
  PROC locked()
    shared := 1;
    shared := 2;
  ENDPROC
  PROC endless()
    WHILE TRUE DO
    ENDWHILE
  ENDPROC
  PROC stops()
    TPWrite "before";
    Stop;
    TPWrite "never";
  ENDPROC
  PROC asks()
    VAR num n;
    TPReadNum n, "how many?";
    TPWrite "got " + ValToStr(n);
  ENDPROC
  PROC moves()
    MoveAbsJ [[10,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
    TPWrite "moved";
  ENDPROC
  PROC flies()
    MoveAbsJ [[90,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, z10, tool0;
  ENDPROC
ENDMODULE
"""


@pytest.fixture
def program(tmp_path: Path) -> Path:
    path = tmp_path / "demo.mod"
    path.write_text(PROGRAM)
    return path


def run(capsys, *text: object) -> tuple[int, list[str], str]:
    code = main(["run", *map(str, text)])
    captured = capsys.readouterr()
    return code, captured.out.splitlines(), captured.err


def test_one_line_for_each_tpwrite(capsys, program: Path) -> None:
    assert run(capsys, program) == (0, ["sum 6"], "")


def test_a_fault_points_to_the_line(capsys, program: Path) -> None:
    code, out, err = run(capsys, program, "--entry", "divide")
    assert (code, out) == (1, [])
    assert "ERR_DIVZERO" in err
    assert "demo.mod:16:5" in err
    assert "z := 1 / z" in err


def test_deadlock(capsys, program: Path) -> None:
    text = program.read_text().replace(
        "shared := 2;", "WaitTestAndSet flag;\n    WaitTestAndSet flag;"
    )
    program.write_text(text.replace("PERS num", "PERS bool flag := FALSE;\n  PERS num"))
    code, _, err = run(capsys, program, "--entry", "locked")
    assert code == 1
    assert "RG405" in err
    assert "demo.mod:25 (locked)" in err
    assert "a device in the file of `--cell`" in err


def test_limits_of_time_and_statements(capsys, program: Path) -> None:
    code, _, err = run(capsys, program, "--entry", "endless", "--max-time", 1)
    assert (code, "RG406" in err, "1 s" in err) == (1, True, True)
    code, _, err = run(capsys, program, "--entry", "endless", "--max-statements", 1000)
    assert (code, "1000 statements" in err) == (1, True)
    code, _, err = run(capsys, program, "--entry", "deadlock", "--max-time", 5)
    assert (code, "RG406" in err) == (1, True)
    code, _, err = run(capsys, program, "--entry", "flies", "--robot", "irb120", "--max-time", 5)
    assert (code, "RG406" in err, "rob1: the robot is moving" in err) == (1, True, True)


def test_stop_ends_the_run(capsys, program: Path) -> None:
    assert run(capsys, program, "--entry", "stops")[:2] == (0, ["before"])


def test_answers(capsys, program: Path, tmp_path: Path) -> None:
    answers = tmp_path / "answers.yaml"
    answers.write_text("- 12\n")
    code, out, _ = run(capsys, program, "--entry", "asks", "--answers", answers)
    assert (code, out[-1]) == (0, "got 12")
    code, _, err = run(capsys, program, "--entry", "asks")
    assert (code, "ERR_TP_NO_CLIENT" in err) == (1, True)


def test_motion_on_the_default_robot(capsys, program: Path) -> None:
    assert run(capsys, program, "--entry", "moves")[:2] == (0, ["moved"])


def test_several_tasks(capsys, tmp_path: Path) -> None:
    for name, body in {
        "a": "WaitUntil go; TPWrite GetTaskName();",
        "b": "go := TRUE; TPWrite GetTaskName();",
    }.items():
        (tmp_path / f"{name}.mod").write_text(
            f"MODULE {name}\nPERS bool go := FALSE;\nPROC main()\n{body}\nENDPROC\nENDMODULE\n"
        )
    a, b = tmp_path / "a.mod", tmp_path / "b.mod"
    assert run(capsys, "--task", f"T_A={a}", "--task", f"T_B={b}")[:2] == (0, ["T_B", "T_A"])


def test_usage(capsys, program: Path) -> None:
    assert run(capsys)[0] == 2
    assert run(capsys, program, "--task", "nonsense")[0] == 2
    assert run(capsys, program, "--assume", "for_loop=sideways")[0] == 2
    assert run(capsys, program, "--entry", "missing")[0] == 2
    assert run(capsys, program.parent / "missing.mod")[0] == 2


def test_trace_profile_coverage(capsys, program: Path, tmp_path: Path) -> None:
    code, out, err = run(capsys, program, "--trace")
    assert (code, out) == (0, ["sum 6"])
    lines = [line.split(None, 3) for line in err.splitlines()]
    assert [f"{task} {place}" for _, task, place, _ in lines[:4]] == [
        "T_ROB1 demo/main:5",
        "T_ROB1 demo/main:6",
        "T_ROB1 demo/main:7",
        "T_ROB1 demo/main:6",
    ]
    assert lines[-1][3].startswith("WaitTime 2")

    report = tmp_path / "p.json"
    assert run(capsys, program, f"--profile={report}")[0] == 0
    rows = json.loads(report.read_text())
    assert rows[0]["line"] == 12  # WaitTime 2
    assert rows[0]["seconds"] == pytest.approx(2, abs=0.01)
    assert next(r for r in rows if r["line"] == 6)["passes"] == 3

    lcov = tmp_path / "c.lcov"
    assert run(capsys, program, "--coverage", lcov)[0] == 0
    result = lcov.read_text().splitlines()
    assert f"SF:{program}" in result
    assert {"DA:6,3", "DA:8,0", "DA:12,1", "DA:16,0", "FNDA:1,main", "FNDA:0,divide"} <= set(result)
    branches = [line.split(",")[2:] for line in result if line.startswith("BRDA:7,")]
    assert branches == [["0", "0"], ["1", "3"]]


def test_tracing_changes_no_time(capsys, program: Path) -> None:
    from rapidgen.controller import VirtualController

    ends = []
    for tracing in (False, True):
        with VirtualController.from_files([program], cycle="once", tracing=tracing) as controller:
            controller.run(max_time=10)
            ends.append(controller.scheduler.now)
    assert ends[0] == ends[1]


def test_a_last_move_with_a_zone_is_made_to_its_end(program: Path) -> None:
    """Where nothing follows a fly-by point it is a stop point [S4 overview 5-20]."""
    from rapidgen.controller import VirtualController

    with VirtualController.from_files([program], entry="flies", cycle="once") as controller:
        assert controller.run(max_time=60) == "finished"
        assert controller.positions()["joint_1"] == pytest.approx(radians(90), abs=1e-4)


def test_unloadable_program_is_rejected_with_all_errors(tmp_path, capsys) -> None:
    """Static errors are found at load [K §1.4]; unknown routines when they are reached."""
    path = tmp_path / "a.mod"
    path.write_text(
        'MODULE a\nPROC main()\n TPWrite "x";\nENDPROC\n'
        'PROC never()\n VAR num n;\n n := "text";\n missing;\nENDPROC\nENDMODULE\n'
    )
    assert main(["run", str(path)]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert "RG307" in err
    assert ":7:" in err
    assert main(["run", "--no-check", str(path)]) == 0
    assert capsys.readouterr().out == "x\n"
    path.write_text(path.read_text().replace('n := "text"', "n := 1"))
    assert main(["run", str(path)]) == 0
    out, err = capsys.readouterr()
    assert (out, "RG404" in err) == ("x\n", True)


@pytest.mark.parametrize(
    "options",
    [
        ("--max-time", "nan"),
        ("--max-time", "inf"),
        ("--max-time", "-1"),
        ("--max-time", "0"),
        ("--max-statements", "0"),
        ("--coverage", "/nonexistent/x.lcov"),
        ("--profile=/nonexistent/x.json",),
    ],
)
def test_invalid_options_run_nothing(program, capsys, options) -> None:
    assert main(["run", str(program), *options]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert "RG901" in err


@pytest.mark.parametrize("name", ["irb120", "cell.yaml"])
def test_a_configuration_is_not_taken(tmp_path, monkeypatch, capsys, name):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cell.yaml").write_text("model: irb120\n")
    assert main(["run", name]) == 2
    assert f"rapidgen sim {name}" in capsys.readouterr().err


def test_duplicate_module_is_rejected_without_check(capsys, tmp_path: Path) -> None:
    text = "MODULE m\n PROC main()\n  aux;\n ENDPROC\n PROC aux()\n ENDPROC\nENDMODULE\n"
    for name in ("a.mod", "b.mod"):
        (tmp_path / name).write_text(text)
    code, out, err = run(capsys, tmp_path / "a.mod", tmp_path / "b.mod", "--no-check")
    assert (code, out) == (1, [])
    assert "module 'm' is twice in this task" in err


def test_folder_above_a_backup_names_it(tmp_path, capsys):
    inner = tmp_path / "line 1" / "Backup_1"
    (inner / "SYSPAR").mkdir(parents=True)
    (inner / "SYSPAR" / "SYS.cfg").write_text("SYS:CFG_1.0::\n")
    assert main(["run", str(tmp_path)]) == 2
    text = capsys.readouterr().err
    assert f"error[RG709]: no RAPID module in {tmp_path} itself; below it: {inner}" in text
    assert f"`rapidgen run '{inner}'`" in text


def test_run_is_recorded(program: Path, tmp_path: Path) -> None:
    file = tmp_path / "run.mcap"
    assert main(["run", str(program), "--entry", "moves", "--record", str(file)]) == 0
    with closing(RecordingFile(file)) as recording:
        joints = recording.at(recording.end).joints["rob1"]
    assert joints.actual[0] == pytest.approx(radians(10), abs=1e-6)
