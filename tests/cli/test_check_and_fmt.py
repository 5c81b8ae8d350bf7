"""`rapidgen check` and `rapidgen fmt` as a user calls them."""

import json

import pytest

from rapidgen.cli.app import main

GOOD = "MODULE Good\n    PROC main()\n        TPErase;\n    ENDPROC\nENDMODULE\n"
BAD = "MODULE Bad\n    VAR num a := TRUE;\nENDMODULE\n"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "good.mod").write_text(GOOD)
    (tmp_path / "bad.mod").write_text(BAD)
    return tmp_path


def test_clean_file(folder, capsys):
    assert main(["check", "good.mod"]) == 0
    out, err = capsys.readouterr()
    assert (out, err) == ("", "0 error(s), 0 warning(s)\n")


def test_findings_are_data_and_make_exit_1(folder, capsys):
    assert main(["check", "bad.mod"]) == 1
    out = capsys.readouterr().out
    assert "error[RG307]" in out
    assert "VAR num a := TRUE;" in out


def test_json_is_one_array_also_for_none(folder, capsys):
    assert main(["check", "good.mod", "--format", "json"]) == 0
    assert json.loads(capsys.readouterr().out) == []
    assert main(["check", "bad.mod", "--format", "json"]) == 1
    result = json.loads(capsys.readouterr().out)
    assert [(f["code"], f["path"], f["line"], f["column"]) for f in result] == [
        ("RG307", "bad.mod", 2, 18)
    ]


@pytest.mark.parametrize(
    "text",
    ["#!/usr/bin/env python3\n", "module example.org/x\n\ngo 1.21\n", "Sub Load()\nEnd Sub\n"],
)
def test_a_file_of_another_language_in_a_folder_is_left_out(folder, capsys, text):
    (folder / "bad.mod").write_text(text)
    assert main(["check", ".", "--format", "concise"]) == 0
    assert "info[RG208]" in capsys.readouterr().out
    (folder / "bad.mod").write_text("PROC p()\nENDPROC\n")
    assert main(["check", "."]) == 1


@pytest.mark.parametrize(
    ("format", "start"), [("concise", "bad.mod:2:18: error[RG307]"), ("github", "::error ")]
)
def test_other_formats(folder, capsys, format, start):
    assert main(["check", "bad.mod", "--format", format]) == 1
    assert capsys.readouterr().out.startswith(start)


def test_folder(folder, capsys):
    assert main(["check", "."]) == 1


def test_nothing_there_is_bad_input(folder, capsys):
    assert main(["check", "nowhere.mod"]) == 2
    assert "RG904" in capsys.readouterr().err
    (folder / "empty").mkdir()
    assert main(["check", "empty"]) == 1


@pytest.mark.parametrize("version", ["4", "9", "six", "6.x"])
def test_wrong_robotware_is_bad_usage(folder, capsys, version):
    assert main(["check", "good.mod", "--robotware", version]) == 2


def test_robotware_decides(folder, capsys):
    (folder / "hex.mod").write_text("MODULE h\n    CONST num a := 0x10;\nENDMODULE\n")
    assert main(["check", "hex.mod"]) == 0
    assert main(["check", "hex.mod", "--robotware", "5.0"]) == 1
    assert main(["check", "hex.mod", "--robotware", "7"]) == 0


def test_files_named_together_know_each_other(folder, capsys):
    (folder / "a.mod").write_text(
        "MODULE a\n    PROC main()\n        b1 1;\n    ENDPROC\nENDMODULE\n"
    )
    (folder / "b.mod").write_text("MODULE b\n    PROC b1()\n    ENDPROC\nENDMODULE\n")
    assert main(["check", "a.mod"]) == 0
    assert main(["check", "a.mod", "b.mod"]) == 1


def test_configurations_by_name_and_path(folder, capsys):
    assert main(["check", "irb120"]) == 0
    (folder / "wrong.yaml").write_text("model: irb120\nportss: 1\n")
    assert main(["check", "wrong.yaml", "--format", "json"]) == 1
    assert json.loads(capsys.readouterr().out)[0]["line"] == 2


@pytest.mark.parametrize(
    ("line", "code"),
    [("task: T_ROS_RECV", "RG012"), ("tool: {name: num, load: {mass: 1}}", "RG106")],
)
def test_check_reports_build_errors(folder, capsys, line, code):
    (folder / "taken.yaml").write_text(f"model: irb120\n{line}\n")
    assert main(["check", "taken.yaml", "--format", "json"]) == 1
    (text,) = json.loads(capsys.readouterr().out)
    assert (text["code"], text["path"], text["line"]) == (code, "taken.yaml", 2)
    assert main(["build", "taken.yaml"]) == 2
    assert not (folder / "rapid_out").exists()


def test_fmt_writes_once(folder, capsys):
    path = folder / "ugly.mod"
    path.write_bytes(b"module m\r\nvar num gr\xf6\xdfe;\r\nendmodule\r\n")
    assert main(["fmt", "ugly.mod", "--check"]) == 1
    assert main(["fmt", "ugly.mod", "--diff"]) == 1
    assert "+    VAR num größe;" in capsys.readouterr().out
    assert main(["fmt", "ugly.mod"]) == 0
    assert path.read_bytes() == b"MODULE m\r\n    VAR num gr\xf6\xdfe;\r\nENDMODULE\r\n"
    assert main(["fmt", "ugly.mod", "--check"]) == 0


def test_fmt_mixed_line_ends_are_reported(folder, capsys):
    (folder / "mixed.mod").write_bytes(GOOD.encode().replace(b"\n", b"\r\n", 2))
    assert main(["fmt", "mixed.mod"]) == 0
    assert "mixed.mod mixes line ends (3 LF, 2 CRLF): all changed to LF" in capsys.readouterr().err
    assert (folder / "mixed.mod").read_bytes() == GOOD.encode()


def test_fmt_leaves_wrong_files_alone(folder, capsys):
    path = folder / "wrong.mod"
    path.write_text("module m\nvar num\nendmodule\n")
    assert main(["fmt", str(folder)]) == 1
    assert path.read_text() == "module m\nvar num\nendmodule\n"
    assert "RG201" in capsys.readouterr().err


def test_fmt_of_nothing(folder, capsys):
    assert main(["fmt", "nowhere.mod"]) == 2


def test_fmt_leaves_encoded_modules_alone(folder, capsys):
    (folder / "encoded.sys").write_bytes(b"\xfc\x00\x01\x02")
    assert main(["fmt", "encoded.sys"]) == 0
    assert "encoded" in capsys.readouterr().err


@pytest.fixture
def backup(tmp_path):
    """A backup with one task, whose module loads, and a folder of other modules on HOME."""
    folder = tmp_path / "backup"
    (folder / "SYSPAR").mkdir(parents=True)
    (folder / "SYSPAR" / "SYS.cfg").write_text(
        'SYS:CFG_1.0:6:0::\n#\nCAB_TASKS:\n\n      -Name "T_ROB1" -Entry "main" -MotionTask\n'
    )
    (folder / "RAPID" / "TASK1" / "PROGMOD").mkdir(parents=True)
    (folder / "RAPID" / "TASK1" / "PROGMOD" / "Good.mod").write_text(GOOD)
    (folder / "HOME" / "parts").mkdir(parents=True)
    return folder


def test_check_unloaded_modules_of_backup_one_by_one(backup, capsys):
    part = backup / "HOME" / "parts" / "part.mod"
    part.write_text("MODULE part\n    PROC part1()\n        Helper;\n    ENDPROC\nENDMODULE\n")
    assert main(["check", str(backup)]) == 0
    capsys.readouterr()
    part.write_text("MODULE 1part\nENDMODULE\n")
    assert main(["check", str(backup), "--format", "json"]) == 1
    result = json.loads(capsys.readouterr().out)
    assert [(f["code"], f["path"]) for f in result if f["severity"] == "error"] == [
        ("RG205", str(part))
    ]


def test_one_unreadable_file_of_home_does_not_hide_the_others(backup, capsys):
    (backup / "HOME" / "bad.mod").write_text(BAD)
    (backup / "HOME" / "parts" / "away.mod").symlink_to("/etc/hostname")
    assert main(["check", str(backup), "--format", "concise"]) == 1
    out = capsys.readouterr().out
    assert "RG706" in out
    assert "RG307" in out


@pytest.mark.parametrize("suffix", ["mod", "MOD", "modx", "sys", "sysx", "prg"])
def test_module_files_have_many_names(folder, capsys, suffix):
    (folder / "more").mkdir()
    (folder / "more" / f"bad.{suffix}").write_text(BAD)
    assert main(["check", "more", "--format", "concise"]) == 1
    assert "RG307" in capsys.readouterr().out


def test_a_program_stands_for_its_modules(folder, capsys):
    (folder / "work.pgf").write_text(
        "<?xml version='1.0'?><Program><Module>good.mod</Module><Module>bad.mod</Module></Program>"
    )
    assert main(["check", "work.pgf", "--format", "concise"]) == 1
    assert "bad.mod:2" in capsys.readouterr().out


LOADED = GOOD.replace(
    "MODULE Good\n",
    "MODULE Good\n    PERS loaddata carried := [{}, [0, 0, 50], [1, 0, 0, 0], 0, 0, 0];\n",
)


def overloads(capsys, *text):
    """Messages of RG333."""
    assert main(["check", *text, "--json"]) == 0
    result = json.loads(capsys.readouterr().out)
    return [f["message"] for f in result if f["code"] == "RG333"]


def test_check_loads_against_payload_of_named_robot(folder, capsys):
    (folder / "good.mod").write_text(LOADED.format(9))
    assert overloads(capsys, "good.mod") == []
    assert overloads(capsys, "good.mod", "--robot", "irb6640") == []
    (message,) = overloads(capsys, "good.mod", "--robot", "irb120")
    assert message == "a load of 9 kg is more than irb120 carries, 3 kg"
    (folder / "more").mkdir()
    (folder / "more" / "good.mod").write_text(LOADED.format(1500))
    (message,) = overloads(capsys, "more")
    assert message == "a load of 1500 kg is more than any robot of ABB carries, 1000 kg"
    assert main(["check", "good.mod", "--robot", "nowhere"]) == 2


@pytest.mark.parametrize(
    ("kind", "mass", "robot"),
    [
        ("ROB1_120_0.58_3", 9, "irb120"),
        ("ROB1_120_0.58_3", 2, ""),
        ("ROB1_120_0.58_3", -1, "first move"),
        ("ROB1_9999_1_1", 9, ""),
        ("ROB1_9999_1_1", 1500, "any robot of ABB"),
        ("", 9, ""),
    ],
)
def test_loads_are_compared_with_the_robot_of_a_backup(backup, capsys, kind, mass, robot):
    program = backup / "RAPID" / "TASK1" / "PROGMOD" / "Good.mod"
    program.write_text(LOADED.format(mass).replace("TPErase;", "TPErase; GripLoad carried;"))
    if kind:
        (backup / "SYSPAR" / "MOC.cfg").write_text(
            "MOC:CFG_1.0:6:0::\n#\nROBOT:\n\n"
            f'      -name "ROB_1" -use_robot_type "{kind}" -use_joint_0 "rob1_1"\n'
        )
    result = overloads(capsys, str(backup))
    assert len(result) == bool(robot)
    assert all(robot in message for message in result)


def test_loads_are_compared_with_the_robot_of_a_generated_folder(folder, capsys):
    assert main(["build", "irb120", "-o", "out"]) == 0
    assert overloads(capsys, "out") == []
    module = folder / "out" / "HOME" / "rapidgen" / "ROS_motion.mod"
    text = module.read_text(encoding="latin-1")
    head, marker, remaining = text.partition("\n    LOCAL ")
    datum = "\n    PERS loaddata own := [9, [0, 0, 50], [1, 0, 0, 0], 0, 0, 0];"
    module.write_text(head + datum + marker + remaining, encoding="latin-1")
    assert overloads(capsys, "out") == ["a load of 9 kg is more than irb120 carries, 3 kg"]


def test_encoded_modules_of_a_folder_are_one_note(tmp_path, capsys):
    (tmp_path / "good.mod").write_text(GOOD)
    for name in ("a.sys", "b.sys", "c.sys"):
        (tmp_path / name).write_bytes(b"\xfc\x01\x02\x03" * 100)
    assert main(["check", str(tmp_path)]) == 0
    out, err = capsys.readouterr()
    assert out.count("RG219") == 1
    assert all(name in out for name in ("a.sys", "b.sys", "c.sys"))
    assert "0 warning(s)" in err


def test_findings_of_equal_files_are_reported_once(tmp_path, capsys):
    text = "MODULE part\nPROC part1()\nRAISE 1;\nTPErase;\nENDPROC\nENDMODULE\n"
    for name in ("old", "new", "other"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "part.mod").write_text(text)
    (tmp_path / "other" / "part.mod").write_text("\n" + text)
    assert main(["check", str(tmp_path)]) == 0
    out, err = capsys.readouterr()
    assert out.count("RG323") == 2
    assert "also in 1 equal file" in out
    assert "2 warning(s)" in err


def test_safe_fixes_keep_encoding_and_line_ends(folder, capsys):
    lines = ("MODULE M", "! gr\xfcn", "PROC main()", "VAR num n;", "TPErase();", "ENDPROC")
    text = "\r\n".join((*lines, "ENDMODULE", ""))
    (folder / "bad.mod").write_bytes(text.encode("latin-1"))
    assert main(["check", "bad.mod", "--fix"]) == 0
    after = text.replace("VAR num n;\r\n", "").replace("();", ";")
    assert (folder / "bad.mod").read_bytes() == after.encode("latin-1")
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("fixed 1 finding(s) in bad.mod\n") == 2


def test_files_of_a_generated_folder_are_not_fixed(folder, capsys):
    text = GOOD.replace("TPErase;", "TPErase();")
    (folder / "good.mod").write_text(text)
    (folder / "manifest.json").write_text('{"rapidgen": "1", "configuration": {}}')
    assert main(["check", "good.mod", "--fix"]) == 1
    assert (folder / "good.mod").read_text() == text
    assert "not changed: good.mod is generated" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("data", "robotware", "codes"),
    [
        ("MODULE m\n! gr\u00fcn\nENDMODULE\n".encode("latin-1"), "7.1", ["RG339"]),
        ("MODULE m\n! gr\u00fcn\nENDMODULE\n".encode("utf-8-sig"), "7.10", ["RG339"]),
        ("MODULE m\n! gr\u00fcn\nENDMODULE\n".encode(), "7.1", []),
        ("MODULE m\n! gr\u00fcn\nENDMODULE\n".encode("latin-1"), "7.0", []),
        ("MODULE m\n! gr\u00fcn\nENDMODULE\n".encode("latin-1"), "6.15", []),
    ],
)
def test_robotware_7_1_expects_utf_8(folder, capsys, data, robotware, codes):
    """Technical reference manual, RAPID Overview, RobotWare 7: UTF-8 without byte order mark."""
    (folder / "m.mod").write_bytes(data)
    main(["check", "m.mod", "--robotware", robotware, "--format", "json"])
    assert [found["code"] for found in json.loads(capsys.readouterr().out)] == codes


@pytest.mark.parametrize(("encoding", "letters"), [("cp1252", "\u20ac"), ("gbk", "\u5939\u722a")])
def test_fmt_converts_to_utf_8(folder, capsys, encoding, letters):
    text = f'MODULE m\n    CONST string s := "{letters}";\nENDMODULE\n'
    file = folder / "m.mod"
    file.write_bytes(text.encode(encoding))
    assert main(["fmt", "m.mod", "--to-utf-8"]) == 1
    assert f"--encoding {encoding}" in capsys.readouterr().err
    assert file.read_bytes() == text.encode(encoding)
    assert main(["fmt", "m.mod", "--encoding", encoding, "--diff"]) == 0
    assert main(["fmt", "m.mod", "--encoding", encoding, "--to-utf-8"]) == 0
    assert file.read_bytes() == text.encode()


@pytest.mark.parametrize("encoding", ["cp1252", "gbk"])
def test_check_reads_and_fixes_files_in_an_encoding(folder, capsys, encoding):
    letters = {"cp1252": "\u20ac", "gbk": "\u5939\u722a"}[encoding]
    text = f'MODULE m\nPROC main()\nTPWrite "{letters}"; TPErase();\nENDPROC\nENDMODULE\n'
    (folder / "m.mod").write_bytes(text.encode(encoding))
    assert main(["check", "m.mod", "--format", "json", "--encoding", encoding]) == 1
    (found,) = json.loads(capsys.readouterr().out)
    assert found["column"] == text.splitlines()[2].index(")") + 1
    assert main(["check", "m.mod", "--encoding", encoding]) == 1
    assert f'TPWrite "{letters}"; TPErase();' in capsys.readouterr().out
    assert main(["check", "m.mod", "--encoding", encoding, "--fix"]) == 0
    assert (folder / "m.mod").read_bytes() == text.replace("();", ";").encode(encoding)


def test_check_reports_files_that_are_in_no_named_encoding(folder, capsys):
    (folder / "m.mod").write_bytes(b"MODULE m\n! \xb5\n! \xff\nENDMODULE\n")
    assert main(["check", "m.mod", "--encoding", "gbk", "--format", "concise"]) == 0
    assert "m.mod:1:1: warning[RG339]" in capsys.readouterr().out


def test_fmt_keeps_files_of_another_encoding(folder, capsys):
    (folder / "m.mod").write_bytes(
        "MODULE m\n! \u20ac \u0081\nENDMODULE\n".encode("gbk", "ignore") + b"!\xff"
    )
    before = (folder / "m.mod").read_bytes()
    assert main(["fmt", "m.mod", "--encoding", "gbk", "--to-utf-8"]) == 1
    assert "the file is not gbk" in capsys.readouterr().err
    assert (folder / "m.mod").read_bytes() == before


def test_fmt_removes_a_byte_order_mark(folder):
    (folder / "m.mod").write_bytes("MODULE m\n    ! gr\u00fcn\nENDMODULE\n".encode("utf-8-sig"))
    assert main(["fmt", "m.mod", "--to-utf-8"]) == 0
    assert (folder / "m.mod").read_bytes() == "MODULE m\n    ! gr\u00fcn\nENDMODULE\n".encode()
