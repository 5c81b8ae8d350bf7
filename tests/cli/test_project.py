"""`check --strict`, and the project file as `check`, `fmt`, `run` and `sim` read it."""

import pytest

from rapidgen.cli.app import main

MAIN = """MODULE work
    PROC main()
        count;
        TPWrite ValToStr(parts);
        %s
    ENDPROC
ENDMODULE
"""
DATA = """MODULE store
    VAR num parts := 0;

    PROC count()
        parts := parts + 1;
    ENDPROC
ENDMODULE
"""
SIGNALS = 'EIO:CFG_1.0:6:1::\n\nEIO_SIGNAL:\n\n      -Name "doX" -SignalType "DO"\n'


@pytest.fixture
def project(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "src").mkdir()
    (tmp_path / "lib").mkdir()
    (tmp_path / "src" / "work.mod").write_text(MAIN % "")
    (tmp_path / "lib" / "store.mod").write_text(DATA)
    (tmp_path / "EIO.cfg").write_text(SIGNALS)

    def write(text="", statement=""):
        (tmp_path / "src" / "work.mod").write_text(MAIN % statement)
        (tmp_path / "rapidgen.toml").write_text(text)

    return write


TASK = '[tasks]\nT_ROB1 = ["src", "lib"]\n'


@pytest.mark.parametrize(
    ("statement", "code"),
    [
        ("patrs := 1;", "RG302"),
        ("TPWrite ValToStr(zzzzz);", "RG302"),
        ("IF zzzzz = 1 Stop;", "RG302"),
        ("zzzzz 1;", "RG301"),
        ("parts := zzzzz(1);", "RG301"),
        ("CONNECT parts WITH zzzzz;", "RG301"),
    ],
)
def test_strict_makes_each_unknown_name_an_error(project, capsys, statement, code):
    project("", statement)
    assert main(["check", "src/work.mod", "lib/store.mod", "--format", "concise"]) == 0
    capsys.readouterr()
    assert main(["check", "--strict", "src/work.mod", "lib/store.mod", "--format", "concise"]) == 1
    assert f"error[{code}]" in capsys.readouterr().out


def test_strict_covers_types(project, capsys):
    project()
    with open("lib/store.mod", "r+") as file:
        file.write(DATA.replace("VAR num parts", "VAR nmu unknown;\n    VAR num parts"))
    assert main(["check", "lib", "--strict", "--format", "concise"]) == 1
    assert "error[RG303]" in capsys.readouterr().out


def test_signals_are_unknown_only_with_a_cfg(project, capsys):
    project("", "SetDO doY, 1;")
    assert main(["check", "src/work.mod", "lib/store.mod", "--strict"]) == 0
    project(TASK, "SetDO doY, 1;")
    assert main(["check", "--strict"]) == 0
    project('cfg = ["EIO.cfg"]\n' + TASK, "SetDO doY, 1;")
    assert main(["check"]) == 0
    capsys.readouterr()
    assert main(["check", "--strict", "--format", "concise"]) == 1
    assert "no datum 'doY'" in capsys.readouterr().out
    project('cfg = ["EIO.cfg"]\n' + TASK, "SetDO doX, 1;")
    assert main(["check", "--strict"]) == 0


def test_a_strict_check_does_not_follow_from_a_syntax_error(project, capsys):
    project("", "count;")
    with open("lib/store.mod", "w") as file:
        file.write(DATA.replace("ENDPROC", ""))
    assert main(["check", "src/work.mod", "lib/store.mod", "--strict", "--format", "concise"]) == 1
    assert "RG301" not in capsys.readouterr().out.replace("info[RG301]", "")


def test_a_file_is_checked_in_its_task(project, capsys):
    project("strict = true\n" + TASK)
    assert main(["check", "src/work.mod"]) == 0
    project("strict = true\n", "")
    assert main(["check", "src/work.mod"]) == 1
    assert main(["check", "src/work.mod", "--no-strict"]) == 0


def test_only_findings_of_the_named_file_are_reported(project, capsys):
    project("strict = true\n" + TASK, "zzzzz;")
    assert main(["check", "lib/store.mod"]) == 0
    assert main(["check", "lib"]) == 0
    assert main(["check", "src"]) == 1


def test_ignored_codes_are_not_reported(project, capsys):
    project("strict = true\n" + TASK, "zzzzz;")
    assert main(["check"]) == 1
    project("strict = true\nignore = ['RG301']\n" + TASK, "zzzzz;")
    assert main(["check"]) == 0


def test_release_and_robot_come_from_the_file(project, capsys):
    tool = "PERS tooldata t := [TRUE,[[0,0,0],[1,0,0,0]],[5,[0,0,1],[1,0,0,0],0,0,0]];\n"
    with open("lib/store.mod", "w") as file:
        file.write(DATA.replace("    VAR", f"    {tool}    VAR", 1).replace("+ 1", "+ 0x1"))
    project("robot = 'irb120'\nrobotware = '6.01'\n" + TASK)
    assert main(["check", "--format", "concise"]) == 0
    assert "RG333" in capsys.readouterr().out
    project("robot = 'irb6700'\nrobotware = '5.00'\n" + TASK)
    assert main(["check", "--format", "concise"]) == 1
    assert "RG333" not in capsys.readouterr().out
    assert main(["check", "--robotware", "6.01"]) == 0


def test_an_unknown_robot_is_a_fault_of_the_file(project, capsys):
    project("\nrobot = 'irb1'\n" + TASK)
    for command in (["check"], ["run"]):
        assert main([*command]) == 2
        text = capsys.readouterr().err
        assert "RG730" in text
        assert "rapidgen.toml:2:1" in text


def test_run_boots_the_tasks_of_the_project(project, capsys, monkeypatch):
    project(TASK)
    monkeypatch.chdir("src")
    assert main(["run"]) == 0
    assert capsys.readouterr().out == "1\n"


def test_sim_boots_the_tasks_of_the_project(project, start, monkeypatch, tmp_path):
    project('robot = "irb1200"\nrobotware = "7.6"\n[tasks]\nT_ROB1 = ["src"]\nT_LIB = ["lib"]\n')
    (tmp_path / "src" / "work.mod").write_text("MODULE work\nPROC main()\nENDPROC\nENDMODULE\n")
    (tmp_path / "lib" / "store.mod").write_text(
        "MODULE store\nVAR socketdev s;\nVAR socketdev c;\nPROC main()\nSocketCreate s;\n"
        'SocketBind s, "127.0.0.1", 5000;\nSocketListen s;\n'
        "SocketAccept s, c \\Time:=WAIT_MAX;\nENDPROC\nENDMODULE\n"
    )
    monkeypatch.chdir("src")
    sim = start("--ports", "auto")
    assert set(sim.control(do="status")["result"]["tasks"]) == {"T_ROB1", "T_LIB"}
    assert "5000" in sim.ready["listeners"]


def test_sim_is_strict_where_the_project_is(project, capsys):
    project("strict = true\n" + TASK, "IF parts = 5 zzzzz;")
    assert main(["sim", "--ports", "auto"]) == 2
    assert "RG301" in capsys.readouterr().err


def test_sim_names_faults_of_the_file(project, capsys):
    project("\nrobot = 'irb1'\n" + TASK)
    assert main(["sim", "--ports", "auto"]) == 2
    assert "rapidgen.toml:2:1" in capsys.readouterr().err


def test_run_is_strict_where_the_project_is(project, capsys):
    project(TASK, "IF parts = 5 zzzzz;")
    assert main(["run"]) == 0
    project("strict = true\n" + TASK, "IF parts = 5 zzzzz;")
    assert main(["run"]) == 2
    assert "RG301" in capsys.readouterr().err
    project("strict = true\nignore = ['RG301']\n" + TASK, "IF parts = 5 zzzzz;")
    assert main(["run"]) == 0
    project("ignore = ['RG307']\n" + TASK, "parts := TRUE;")
    assert main(["run"]) == 2


def test_the_commands_name_the_file_that_is_missing(project, capsys):
    for command in ("check", "fmt"):
        assert main([command]) == 2
        assert "no rapidgen.toml" in capsys.readouterr().err


def test_fmt_formats_the_folders_of_the_project(project, capsys):
    project("folders = ['lib']\n")
    for file in ("src/work.mod", "lib/store.mod"):
        with open(file, "a") as text:
            text.write("\n\n\n")
    assert main(["fmt", "--check"]) == 1
    assert capsys.readouterr().err == "would format lib/store.mod\n"


def test_a_project_does_not_change_what_describes_itself(project, capsys):
    project("robot = 'irb6700'\nrobotware = '5.00'\nstrict = true\n")
    assert main(["build", "irb120", "-o", "out"]) == 0
    assert main(["check", "out", "--robotware", "6.15"]) == 0
    assert main(["run", "out", "--max-time", "0.01"]) == 1
    assert "RG901" not in capsys.readouterr().err
