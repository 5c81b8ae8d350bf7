"""`run` and `sim` take whatever RAPID a person brings."""

import json

import pytest

from rapidgen.cli.app import main
from tests.controller.test_booting import CELL, PROGRAM

PLAIN = PROGRAM.replace("ValToStr(ClkRead(clock9))", '"done"')


def run(capsys, *text):
    code = main(["run", *map(str, text)])
    captured = capsys.readouterr()
    return code, captured.out.splitlines(), captured.err


@pytest.fixture
def program(tmp_path):
    path = tmp_path / "work.mod"
    path.write_text(PLAIN)
    return path


def test_a_described_cell(capsys, program, tmp_path):
    cell = tmp_path / "cell.yaml"
    cell.write_text(CELL)
    time = "simulated time: 2.349 s (estimated, ±16 %)\n"
    assert run(capsys, program, "--cell", cell) == (0, ["done"], time)


def test_inferred_cell_is_reported(capsys, program):
    code, out, err = run(capsys, program, "--cell", "infer")
    assert (code, out) == (0, ["done"])
    assert "diGripped  signaldi   work.mod:4" in err
    assert "because the program waited for it: diGripped = 1, giPart = 4" in err


def test_where_the_robot_starts(capsys, tmp_path):
    path = tmp_path / "where.mod"
    path.write_text(
        "MODULE where\n PROC main()\n  VAR jointtarget j;\n  j := CJointT();\n"
        '  TPWrite ValToStr(j.robax);\n ENDPROC\n PROC other()\n  TPWrite "other";\n'
        " ENDPROC\nENDMODULE\n"
    )
    assert run(capsys, path)[1] == ["[0,0,0,0,30,0]"]
    assert run(capsys, path, "--start", "1,2,3,4,5,6")[1] == ["[1,2,3,4,5,6]"]
    assert run(capsys, path, "--entry", "other")[1] == ["other"]
    code, _, err = run(capsys, path, "--start", "1,two")
    assert (code, "RG901" in err) == (2, True)


def test_the_schema_of_a_cell(capsys):
    assert main(["schema", "--cell"]) == 0
    schema = json.loads(capsys.readouterr().out)
    assert schema["title"] == "rapidgen cell"
    assert set(schema["properties"]) >= {"robots", "signals", "tools", "devices"}


def test_target_out_of_reach_is_reported_with_axis_and_robot(capsys, tmp_path):
    path = tmp_path / "reach.mod"
    path.write_text(
        "MODULE reach\n"
        " CONST robtarget far:=[[2000,0,300],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        " CONST robtarget back:=[[-300,0,200],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        " PROC main()\n  MoveJ far, v100, fine, tool0;\n ENDPROC\n"
        " PROC behind()\n  MoveJ back, v100, fine, tool0;\n ENDPROC\nENDMODULE\n"
    )
    code, _, err = run(capsys, path)
    assert (code, "irb120: the flange cannot be at [2000.0, 0.0, 300.0] mm" in err) == (1, True)
    code, _, err = run(capsys, path, "--entry", "behind")
    assert (code, "rax_1 would be at 180.0 deg, its range is -165 to 165" in err) == (1, True)


@pytest.mark.parametrize(
    ("statement", "words", "help"),
    [
        ("SetDO do1, 1;", [], "use `--cell infer` to infer signals"),
        ("x := y;", ["--cell", "infer"], "`rapidgen schema --cell`"),
        ("foo;", [], "load the module that declares it"),
        ('TPReadNum n, "how many";', [], "`--answers FILE` answers dialogs"),
        ("MoveL other, v100, fine, tool0;", [], "use ConfL \\Off"),
        (
            "MoveL Offs(other,2000,0,0), v100, fine, tool0;",
            [],
            "robot of the program with `--robot`",
        ),
        (
            "MoveAbsJ [[180,0,0,0,0,0],other.extax], v100, fine, tool0;",
            [],
            "program with `--robot`",
        ),
    ],
)
def test_program_error_has_help(tmp_path, capsys, statement, words, help):
    path = tmp_path / "a.mod"
    path.write_text(
        "MODULE a\nCONST robtarget other := [[300,0,400],[0,0,1,0],[0,2,-2,1],"
        "[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        f"PROC main()\nVAR num n;\n{statement}\nENDPROC\nENDMODULE\n"
    )
    assert main(["run", str(path), *words]) == 1
    text = capsys.readouterr().err
    assert help in text[text.index("error[RG407]") :]
