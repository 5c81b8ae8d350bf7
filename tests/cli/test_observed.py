"""What `run` shows of a run: trace, coverage with the source, a plot, and what tasks wait for."""

import re
import subprocess
import sys

import pytest

from rapidgen.cli.app import main

HOSTILE = '<script>alert("x")</script>'
PROGRAM = f"""MODULE see
  ! {HOSTILE} & more
  PROC main()
    VAR num i;
    FOR i FROM 1 TO 3 DO
      MoveAbsJ [[10*i,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, z10, tool0;
    ENDFOR
    IF i > 100 THEN
      TPWrite "<never>";
    ENDIF
  ENDPROC
ENDMODULE
"""


@pytest.fixture
def program(tmp_path):
    path = tmp_path / "see<b>.mod"
    path.write_text(PROGRAM)
    return path


def test_a_trace_has_the_lines_as_they_are_written(capsys, program):
    assert main(["run", str(program), "--trace"]) == 0
    lines = capsys.readouterr().err.splitlines()
    assert re.fullmatch(r" +0\.00000\d  T_ROB1 +see/main:5 +FOR i FROM 1 TO 3 DO", lines[0])
    assert sum("see/main:6 " in line for line in lines) == 3


def test_coverage_as_a_page_beside_the_tracefile(program, tmp_path):
    page, lcov = tmp_path / "a.html", tmp_path / "a.lcov"
    assert main(["run", str(program), "--coverage", str(page), "--coverage", str(lcov)]) == 0
    text = page.read_text()
    assert HOSTILE not in text
    assert "<b>.mod" not in text
    assert "see&lt;b&gt;.mod" in text
    assert '<span class="hit"><i>3&times; 6</i>      MoveAbsJ' in text
    assert '<span class="miss"><i>0&times; 9</i>      TPWrite &quot;&lt;never&gt;&quot;' in text
    assert "3 of 4 lines with statements were executed (75 %)" in text
    assert "DA:6,3" in lcov.read_text()


def test_run_plots_motion(program, tmp_path):
    assert main(["run", str(program), "--plot", str(tmp_path / "motion")]) == 0
    assert (tmp_path / "motion.png").read_bytes().startswith(b"\x89PNG")
    assert "joint_1" in (tmp_path / "motion.html").read_text()
    other, third = tmp_path / "other.svg", tmp_path / "third.png"
    assert main(["run", str(program), "--plot", str(other), "--plot", str(third)]) == 0
    assert "<svg" in other.read_text()
    assert third.read_bytes().startswith(b"\x89PNG")


def test_unwritable_output_is_reported_before_the_run(capsys, program, tmp_path):
    for option in ("--plot", "--coverage"):
        code = main(["run", str(program), option, str(tmp_path / "none" / "x.html")])
        captured = capsys.readouterr()
        assert (code, captured.out, "RG901" in captured.err) == (2, "", True)


@pytest.mark.parametrize(
    ("statement", "text"),
    [
        ("SocketAccept s, c \\Time:=WAIT_MAX", "SocketAccept waits for a client on port 5000"),
        ("WaitDI di1, 1", "waits for di1 = 1; di1 is 0"),
        ("WaitGI gi1, \\GT, 3", "waits for gi1 > 3; gi1 is 0"),
        ("WaitUntil flag AND di1 = 1", "WaitUntil waits; flag is FALSE, di1 is 0"),
        ("WaitTestAndSet busy", "WaitTestAndSet waits for its flag"),
    ],
)
def test_timeout_reports_wait_conditions(capsys, tmp_path, statement, text):
    (tmp_path / "cell.yaml").write_text("signals: {di1: {kind: DI}, gi1: {kind: GI}}")
    path = tmp_path / "waits.mod"
    path.write_text(
        "MODULE waits\n VAR socketdev s;\n VAR socketdev c;\n PERS bool flag := FALSE;\n"
        " PERS bool busy := TRUE;\n PROC main()\n  SocketCreate s;\n"
        f'  SocketBind s, "127.0.0.1", 5000;\n  SocketListen s;\n  {statement};\n'
        " ENDPROC\nENDMODULE\n"
    )
    words = ["run", str(path), "--cell", str(tmp_path / "cell.yaml"), "--max-time", "5"]
    assert main(words) == 1
    err = capsys.readouterr().err
    assert text in err
    assert "waits.mod:10 (main)" in err


@pytest.mark.parametrize(
    "text",
    [
        "MODULE big\n VAR num a{100000,100000};\n PROC main()\n ENDPROC\nENDMODULE\n",
        "MODULE big\n PROC main()\n  VAR num a{100000,100000};\n  a{1,1}:=1;\n ENDPROC\nENDMODULE",
    ],
)
def test_an_array_that_no_memory_holds_is_refused(capsys, tmp_path, text):
    path = tmp_path / "big.mod"
    path.write_text(text)
    assert main(["run", str(path)]) != 0
    assert "a would have 10,000,000,000 elements; the limit is 4,000,000" in (
        capsys.readouterr().err
    )


def test_a_program_that_takes_too_much_memory_is_stopped(tmp_path):
    path = tmp_path / "grows.mod"
    path.write_text(
        "MODULE grows\n PROC main()\n  deeper 1;\n ENDPROC\n PROC deeper(num n)\n"
        "  VAR string a{100000};\n  a{1} := ValToStr(n);\n  deeper n + 1;\n ENDPROC\nENDMODULE\n"
    )
    words = [sys.executable, "-m", "rapidgen.cli", "run", str(path), "--max-memory", "300"]
    done = subprocess.run(words, capture_output=True, text=True, timeout=120)
    assert done.returncode == 1
    assert "RG406" in done.stderr
    assert "more than 300 MB" in done.stderr
    assert "Traceback" not in done.stderr
