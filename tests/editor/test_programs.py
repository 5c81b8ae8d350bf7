"""Which modules belong together, and what tasks share: backups, folders, projects, lone files."""

import subprocess
import sys
from pathlib import Path

import pytest

from rapidgen.config import load_config
from rapidgen.editor import hover, navigation, rename
from rapidgen.editor.documents import Document, probable_encoding
from rapidgen.editor.project import Settings, discover
from rapidgen.editor.workspace import Workspace
from rapidgen.generate import build, write

SYS = """SYS:CFG_1.0:6:1::
#
CAB_TASKS:

      -Name "T_ROB1" -Type "NORMAL" -MotionTask

      -Name "T_BACK" -Entry "run"
"""
EIO = """EIO:CFG_1.0:6:1::
#
EIO_SIGNAL:

      -Name "doGrip" -SignalType "DO"
"""
MAIN = """MODULE Prog
    PERS num shared := 0;
    PERS num other := 0;
    PROC main()
        shared := 1;
        other := 1;
        Set doGrip;
    ENDPROC
ENDMODULE
"""
BACK = """MODULE Rear
    PERS num shared := 0;
    PERS string other := "";
    PROC run()
        WaitUntil shared = 1;
        TPWrite other;
        %"ru" + "n"%;
        TPWrite "shared";
    ENDPROC
ENDMODULE
"""


@pytest.fixture
def backup(tmp_path):
    folder = tmp_path / "backup"
    for name, text in {
        "SYSPAR/SYS.cfg": SYS,
        "SYSPAR/EIO.cfg": EIO,
        "BACKINFO/backinfo.txt": ">>SYSTEM_ID:\n>>PRODUCTS_ID:\nRobotWare Version: 6.13\n",
        "RAPID/TASK1/PROGMOD/Main.mod": MAIN,
        "RAPID/TASK2/PROGMOD/Back.mod": BACK,
        "HOME/free.mod": "MODULE free\nPROC p()\nshared := 1;\nENDPROC\nENDMODULE\n",
    }.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    return folder


def workspace(*paths, folders=(), settings=None):
    made = Workspace(tuple(map(str, folders)), settings or Settings())
    for path in paths:
        made.open(Document(str(path), path.read_text()))
    return made


def place(path, marker):
    """Line and column of the marker's start."""
    text = path.read_text()
    at = text.index(marker)
    return text.count("\n", 0, at) + 1, at - text.rfind("\n", 0, at)


def names(places):
    return [(Path(p.path).name, p.span.line) for p in places]


# -- discovery -------------------------------------------------------------------------------


def test_a_backup_has_tasks_and_signals(backup):
    main = backup / "RAPID/TASK1/PROGMOD/Main.mod"
    program = discover(str(main), [str(backup.parent)], Settings())
    assert program.kind == "backup"
    assert [task.name for task in program.system.tasks] == ["T_ROB1", "T_BACK"]
    opened = workspace(main)
    assert opened.findings_of(str(main)) == []
    (found,) = navigation.definitions(opened, str(main), *place(main, "doGrip"))
    assert names([found]) == [("EIO.cfg", 5)]


def test_folders_above_the_workspace_folder_do_not_count(backup):
    main = backup / "RAPID/TASK1/PROGMOD/Main.mod"
    program = discover(str(main), [str(main.parent)], Settings())
    assert (program.kind, program.root) == ("folder", str(main.parent))


def test_a_file_of_home_that_no_task_loads_is_in_a_group_of_its_own(backup):
    free = backup / "HOME/free.mod"
    program = discover(str(free), [], Settings())
    assert program.files == (str(free),)


def test_a_generated_folder_has_its_configuration(tmp_path):
    write(build(load_config("irb120")), tmp_path / "out")
    module = sorted((tmp_path / "out").rglob("*.mod"))[0]
    opened = workspace(module)
    assert opened.programs[0].program.kind == "generated"
    assert [d for d in opened.findings_of(str(module)) if d.severity == "error"] == []


def test_a_project_file_gives_tasks_and_settings(tmp_path):
    (tmp_path / "rapidgen.toml").write_text(
        'robotware = "6.15"\nignore = ["RG324"]\n[tasks]\nT_ROB1 = ["a.mod", "b.mod"]\n'
    )
    (tmp_path / "a.mod").write_text(
        "MODULE a\nPROC main()\nVAR num n;\nhelp;\nENDPROC\nENDMODULE\n"
    )
    (tmp_path / "b.mod").write_text("MODULE b\nPROC help()\nENDPROC\nENDMODULE\n")
    opened = workspace(tmp_path / "a.mod")
    program = opened.programs[0].program
    assert (program.kind, program.dialect.robotware) == ("project", (6, 15))
    assert opened.findings_of(str(tmp_path / "a.mod")) == []


def test_a_program_file_and_its_modules_are_one_group(tmp_path):
    for name in "abc":
        (tmp_path / f"{name}.mod").write_text(f"MODULE {name}\nENDMODULE\n")
    (tmp_path / "p.pgf").write_text("<Module>b.mod</Module><Module>a.mod</Module>")
    program = discover(str(tmp_path / "a.mod"), [], Settings())
    assert program.kind == "program"
    assert [Path(file).name for file in program.files] == ["b.mod", "a.mod"]
    assert discover(str(tmp_path / "c.mod"), [], Settings()).kind == "folder"


def test_progmod_and_sysmod_side_by_side_are_one_group(tmp_path):
    for name in ("PROGMOD/a.mod", "SYSMOD/b.sys"):
        (tmp_path / name).parent.mkdir()
        (tmp_path / name).write_text("MODULE x\nENDMODULE\n")
    program = discover(str(tmp_path / "PROGMOD/a.mod"), [], Settings())
    assert [Path(file).name for file in program.files] == ["a.mod", "b.sys"]


# -- tasks -----------------------------------------------------------------------------------


def test_a_persistent_of_one_type_is_one_datum_of_all_tasks(backup):
    main, back = (backup / f"RAPID/TASK{n}" for n in (1, 2))
    main, back = main / "PROGMOD/Main.mod", back / "PROGMOD/Back.mod"
    opened = workspace(main)
    at = place(main, "shared := 1")
    found = navigation.references(opened, str(main), *at, declarations=True)
    assert names(found) == [("Main.mod", 2), ("Main.mod", 5), ("Back.mod", 2), ("Back.mod", 5)]
    # The other one has another type there, so that it is another datum.
    at = place(main, "other := 1")
    found = navigation.references(opened, str(main), *at, declarations=True)
    assert names(found) == [("Main.mod", 3), ("Main.mod", 6)]


def test_a_rename_goes_over_tasks_and_counts_strings(backup):
    main = backup / "RAPID/TASK1/PROGMOD/Main.mod"
    opened = workspace(main)
    result = rename.rename(opened, str(main), *place(main, "shared := 1"), "common")
    assert [Path(e.path).name for e in result.edits] == ["Main.mod"] * 2 + ["Back.mod"] * 2
    assert [span.line for span in result.doubtful] == [8]
    back = backup / "RAPID/TASK2/PROGMOD/Back.mod"
    result = rename.rename(opened, str(back), *place(back, "run()"), "go")
    assert [span.line for span in result.doubtful] == [7]
    with pytest.raises(rename.CannotRename, match="other"):
        rename.rename(opened, str(main), *place(main, "shared := 1"), "other")


def test_a_module_of_several_tasks_is_checked_in_each(tmp_path):
    (tmp_path / "rapidgen.toml").write_text(
        '[tasks]\nT_ROB1 = ["both.mod", "one.mod"]\nT_TWO = ["both.mod"]\n'
    )
    both = tmp_path / "both.mod"
    both.write_text("MODULE both\nPROC main()\nhere;\nENDPROC\nENDMODULE\n")
    (tmp_path / "one.mod").write_text("MODULE one\nPROC here()\nENDPROC\nENDMODULE\n")
    opened = workspace(both, settings=Settings(strict=True))
    (finding,) = opened.findings_of(str(both))
    assert finding.message == "there is no procedure 'here' (in task T_TWO)"
    assert names(navigation.definitions(opened, str(both), 3, 1)) == [("one.mod", 2)]


def test_a_computed_late_call_may_run_procedures_with_as_many_arguments(backup):
    back = backup / "RAPID/TASK2/PROGMOD/Back.mod"
    opened = workspace(back)
    line, column = place(back, '%"ru"')
    found = navigation.implementations(opened, str(back), line, column + 1)
    assert names(found) == [("Back.mod", 4)]


# -- encodings -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("encoding", "text"),
    [("cp1252", "gr\u00fcn \u20ac"), ("gbk", "\u53d6\u6599 \u4f4d\u7f6e"), ("utf-8", "gr\u00fcn")],
)
def test_files_that_are_not_open_are_read_as_the_client_would(tmp_path, encoding, text):
    data = f'MODULE b\nCONST string s := "{text}"; CONST num far := 1;\nENDMODULE\n'
    (tmp_path / "b.mod").write_bytes(data.encode(encoding))
    (tmp_path / "a.mod").write_text("MODULE a\nCONST num x := far;\nENDMODULE\n")
    assert probable_encoding((tmp_path / "b.mod").read_bytes()) == encoding
    opened = workspace(tmp_path / "a.mod", settings=Settings(encoding=encoding))
    (found,) = navigation.definitions(opened, str(tmp_path / "a.mod"), 2, 16)
    assert found.span.column == data.split("\n")[1].index("far") + 1


@pytest.mark.parametrize(
    ("encoding", "name", "text"),
    [("cp1252", "Windows-1252", "! gr\u00fcn"), ("gbk", "GBK", "! \u53d6\u6599 \u4f4d\u7f6e")],
)
def test_a_document_that_was_read_in_a_wrong_encoding(tmp_path, encoding, name, text):
    path = tmp_path / "a.mod"
    data = f"MODULE a\n{text}\nENDMODULE\n".encode(encoding)
    path.write_bytes(data)
    opened = Workspace()
    opened.open(Document(str(path), data.decode("utf-8", "replace")))
    (finding,) = opened.findings_of(str(path))
    assert (finding.code, finding.span.line) == ("RG338", 2)
    assert name in finding.help
    opened.open(Document(str(path), data.decode(encoding)))
    assert opened.findings_of(str(path)) == []


def test_hover_shows_comments_and_values(tmp_path):
    path = tmp_path / "a.mod"
    path.write_text(
        "MODULE a\n! Grip *force* in N\nCONST num force := 5 * 2; ! not this\n"
        "CONST tooldata t := [TRUE,[[0,0,100],[0.7071068,0,0.7071068,0]],"
        "[2,[0,0,1],[1,0,0,0],0,0,0]];\n"
        "PROC p(num a \\switch b)\nENDPROC\nENDMODULE\n"
    )
    opened = workspace(path)
    (view,) = opened.views(str(path))
    text = hover.hover(view, 3, 12).text
    assert "Grip \\*force\\* in N" in text
    assert "Value: `10`" in text
    text = hover.hover(view, 4, 17).text
    assert "rotation z 0.00\u00b0, y 90.00\u00b0, x 0.00\u00b0" in text
    assert "mass 2 kg" in text


TARGETS = """MODULE Targets
    CONST robtarget near := [[374,0,630],[0.707107,0,0.707107,0],[0,0,0,0],[{none}]];
    CONST robtarget far := [[3740,0,630],[0.707107,0,0.707107,0],[0,0,0,0],[{none}]];
    CONST robtarget turned := [[374,0,630],[0.707107,0,0.707107,0],[0,0,0,4],[{none}]];
    CONST jointtarget out := [[0,0,500,0,0,0],[{none}]];
    PERS tooldata long := [TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
    PERS tooldata fixed := [FALSE,[[0,0,100],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
    PERS wobjdata away := [FALSE,TRUE,"",[[5000,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
    PROC moves(PERS tooldata given)
        MoveL near, v100, fine, tool0;
        MoveL near, v100, fine, long \\WObj:=wobj0;
        MoveL near, v100, fine, tool0 \\WObj:=away;
        MoveL near, v100, fine, fixed;
        MoveL near, v100, fine, given;
    ENDPROC
ENDMODULE
""".replace("{none}", "9E9,9E9,9E9,9E9,9E9,9E9")
MOC = """MOC:CFG_1.0:6:0::
#
ROBOT:

      -name "ROB_1" -use_robot_type "{type}" -base_frame_pos_x {x}
"""


def reach_at(opened, path, marker):
    (view,) = opened.views(str(path))
    text = hover.hover(view, *place(path, marker)).text
    return [line.strip() for line in text.split("\n") if "reach" in line]


def with_moc(backup, kind, x=0.0):
    (backup / "SYSPAR/MOC.cfg").write_text(MOC.format(type=kind, x=x))
    path = backup / "RAPID/TASK1/PROGMOD/Targets.mod"
    path.write_text(TARGETS)
    return workspace(path), path


def test_hover_of_a_target_tells_if_the_robot_reaches_it(backup):
    """An IRB 120 at zero has its flange at [374, 0, 630] mm, turned by 90 degrees about y."""
    opened, path = with_moc(backup, "ROB1_120_0.58_3")
    zero = "joints 0.00°, 0.00°, 0.00°, 0.00°, 0.00°, 0.00°"
    (line,) = reach_at(opened, path, "near :=")
    assert line == f"reachable with tool0 and wobj0: {zero}"
    assert reach_at(opened, path, "far :=") == ["out of reach with tool0 and wobj0"]
    (line,) = reach_at(opened, path, "turned :=")
    assert line.startswith("out of reach with tool0 and wobj0 in its configuration; with [")
    (line,) = reach_at(opened, path, "out :=")
    assert line.startswith("out of reach: rax_3 (")


def test_hover_of_a_target_uses_tool_and_work_object_of_the_move(backup):
    opened, path = with_moc(backup, "ROB1_120_0.58_3")
    (line,) = reach_at(opened, path, "near, v100, fine, tool0;")
    assert line.startswith("reachable with tool0 and wobj0: joints 0.00°, 0.00°")
    (line,) = reach_at(opened, path, "near, v100, fine, long")
    assert line.startswith("reachable with long and wobj0: joints 0.00°, -")
    assert reach_at(opened, path, "near, v100, fine, tool0 \\") == [
        "out of reach with tool0 and away"
    ]
    # The robot holds neither, and a parameter has no value.
    assert reach_at(opened, path, "near, v100, fine, fixed") == []
    assert reach_at(opened, path, "near, v100, fine, given") == []


def test_hover_of_a_target_uses_the_base_frame(backup):
    opened, path = with_moc(backup, "ROB1_120_0.58_3", x=3.366)
    assert reach_at(opened, path, "near :=") == ["out of reach with tool0 and wobj0"]
    (line,) = reach_at(opened, path, "far :=")
    assert line.startswith("reachable with tool0 and wobj0: joints 0.00°")


def test_hover_of_a_target_of_an_unknown_robot_has_no_reachability(backup):
    opened, path = with_moc(backup, "ROB1_99999_9.99_9")
    assert reach_at(opened, path, "near :=") == []


def test_hover_of_a_target_uses_the_robot_of_the_project(tmp_path):
    (tmp_path / "rapidgen.toml").write_text('robot = "irb120"\n[tasks]\nT_ROB1 = ["t.mod"]\n')
    path = tmp_path / "t.mod"
    path.write_text(TARGETS)
    (line,) = reach_at(workspace(path), path, "near :=")
    assert line.startswith("reachable with tool0 and wobj0: joints 0.00°")


def test_the_editor_loads_kinematics_for_the_first_target_only():
    code = (
        "import sys, rapidgen.lsp.methods; "
        "print([n for n in sys.modules if n.startswith('rapidgen.axes.') or n == 'numpy'])"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout.strip() == "[]"


def test_an_open_file_is_reported_until_it_is_saved_as_utf_8(tmp_path):
    path = tmp_path / "a.mod"
    text = "MODULE a\n! gr\u00fcn\nENDMODULE\n"
    path.write_bytes(text.encode("cp1252"))
    opened = Workspace((), Settings(robotware="7.6"))
    opened.open(Document(str(path), text))
    assert [d.code for d in opened.findings_of(str(path))] == ["RG339"]
    path.write_bytes(text.encode())
    opened.saved(str(path))
    assert opened.findings_of(str(path)) == []


def test_huge_ranges_and_values_have_no_reachability(backup):
    opened, path = with_moc(backup, "ROB1_120_0.58_3")
    moc = backup / "SYSPAR/MOC.cfg"
    joints = " ".join(f'-use_joint_{n} "j{n}"' for n in range(6))
    rows = [f'      -name "j{n}" -use_arm "a"\n' for n in range(6)]
    arm = '      -name "a" -upper_joint_bound 1E9 -lower_joint_bound -1E9\n'
    text = moc.read_text().rstrip() + f" {joints}\n#\nJOINT:\n\n{''.join(rows)}#\nARM:\n\n{arm}"
    moc.write_text(text)
    opened = workspace(path)
    assert reach_at(opened, path, "near :=") == []
    moc.write_text(MOC.format(type="ROB1_120_0.58_3", x=0))
    path.write_text(TARGETS.replace("[0,0,0,4]", "[0,0,0,1E999]"))
    opened = workspace(path)
    assert reach_at(opened, path, "turned :=") == []
    (line,) = reach_at(opened, path, "near :=")
    assert line.startswith("reachable")
