"""Backups, loose files and hostile folders become a System, or a diagnostic."""

import json
import os

import pytest

from rapidgen.diagnostics import DiagnosticError, Severity
from rapidgen.system import (
    CrossConnection,
    EventRoutine,
    MechanicalUnitGroup,
    ModuleFile,
    SignalSpec,
    System,
    SystemInput,
    SystemOutput,
    TaskSpec,
    eio_cfg,
    read_backup,
    read_files,
    read_folder,
    read_system,
    sys_cfg,
    write_cfg,
)
from rapidgen.system.cfg import parse_cfg
from rapidgen.system.cfg_reader import (
    crosses_of,
    events_of,
    groups_of,
    inputs_of,
    modules_of,
    outputs_of,
    signals_of,
    tasks_of,
)

MODULE = b"MODULE %s\n  PROC main()\n  ENDPROC\nENDMODULE\n"


def put(path, data):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data if isinstance(data, bytes) else data.encode("latin-1"))
    return path


def code_of(caught):
    return [d.code for d in caught.value.diagnostics]


@pytest.fixture
def backup(tmp_path):
    root = tmp_path / "cell_backup"
    put(
        root / "SYSPAR/SYS.cfg",
        """SYS:CFG_1.0:5:0::
#
CAB_TASKS:

      -Name "T_ROB1" -Type "NORMAL" -UseMechanicalUnitGroup "rob1" -MotionTask

      -Name "T_BACK" -TrustLevel "SysHalt"
#
CAB_TASK_MODULES:

      -File "HOME:/Shared.sys" -AllTask

      -File "RELEASE:/options/dispense.sys" -Task "T_ROB1"

      -File "SMARTGRIPPER:/code/grip.sys" -AllTask

      -File "HOME:/lost.sys" -AllTask
#
CAB_EXEC_HOOKS:

      -Routine "OnStart" -Shelf "START" -Task "T_ROB1"
""",
    )
    put(
        root / "SYSPAR/EIO.cfg",
        """EIO:CFG_1.0:5:0::
#
EIO_SIGNAL:

      -Name "goProgram" -SignalType "GO" -Unit "d651" -UnitMap "8-15"
#
SYSSIG_OUT:

      -Status "TaskExecuting" -Signal "goProgram" -Arg2 "T_ROB1"
#
EIO_CROSS:

      -Res "doA" -Act1 "diB" -Act1_invert -Oper1 "OR" -Act2 "diC"
""",
    )
    put(
        root / "BACKINFO/backinfo.txt",
        ">>SYSTEM_ID:\ncell\n>>PRODUCTS_ID:\nRobotWare Version: 5.15\n",
    )
    put(root / "RAPID/TASK1/PROGMOD/Work.mod", MODULE % b"Work")
    put(root / "RAPID/TASK1/SYSMOD/user.sys", MODULE % b"user")
    put(root / "RAPID/TASK2/PROGMOD/Back.mod", MODULE % b"Back")
    put(root / "HOME/shared.SYS", MODULE % b"Shared")
    return root


def test_backup(backup):
    notes = []
    system = read_backup(backup, notes=notes)
    robot, back = system.tasks
    assert system.name == "cell_backup"
    assert system.robotware == (5, 15)
    assert (robot.motion, robot.type, back.type, back.trust) == (
        True,
        "NORMAL",
        "SEMISTATIC",
        "SysHalt",
    )
    assert [m.name for m in robot.modules] == ["user", "Work", "Shared"]
    assert [m.name for m in back.modules] == ["Back", "Shared"]
    lost, options = notes
    assert (lost.code, lost.severity, options.code, options.severity) == (
        "RG710",
        Severity.WARNING,
        "RG710",
        Severity.INFO,
    )
    assert options.notes == ("RELEASE:/options/dispense.sys", "SMARTGRIPPER:/code/grip.sys")
    program = SignalSpec("goProgram", "GO", device="d651", size=8, bits=tuple(range(8, 16)))
    assert system.signals == (program,)
    assert system.outputs == (SystemOutput("TaskExecuting", "goProgram", task="T_ROB1"),)
    assert system.cross == (CrossConnection("", "doA", (("diB", True), ("diC", False)), ("OR",)),)
    assert system.events == (EventRoutine("OnStart", "START", "T_ROB1"),)
    assert read_system(backup) == system


def test_task_folders_by_backinfo(backup):
    """[code] backinfo.txt names the task of each folder; it wins over the order of CAB_TASKS."""
    put(
        backup / "BACKINFO/backinfo.txt",
        "RobotWare Version: 6.08.01\n>>TASK2: (T_ROB1,prog,)\n>>TASK1: (T_BACK,,)\n",
    )
    system = read_backup(backup)
    assert [m.name for m in system.tasks[0].modules] == ["Back", "Shared"]
    assert system.robotware == (6, 8)


def test_only_the_modules_that_backinfo_lists_were_loaded(backup):
    """[code] Kraker1's and PaletizadoCajasConFrascos' folders keep modules of earlier backups."""
    put(
        backup / "BACKINFO/backinfo.txt",
        "RobotWare Version: 6.08.01\n>>TASK1: (T_ROB1,prog,)\nSYSMOD/user.sys @ user.sys\n"
        "PROGMOD\\WORK.mod @ \n\n>>TASK2: (T_BACK,,)\n>>EOF:\n",
    )
    put(backup / "RAPID/TASK1/PROGMOD/Work_old.mod", MODULE % b"Work")
    notes = []
    robot, back = read_backup(backup, notes=notes).tasks
    assert [m.name for m in robot.modules] == ["user", "Work", "Shared"]
    assert [m.name for m in back.modules] == ["Back", "Shared"]
    (left,) = (n for n in notes if n.code == "RG715")
    assert "Work_old.mod" in left.message
    assert left.severity is Severity.INFO


@pytest.mark.parametrize(
    ("parts", "media", "robotware"),
    [
        ("RobotControl Version: 7.6.1\nRobotOS Version: 5.0.1\n", "", (7, 6)),
        ("RobotOS Version: 5.0.1\nRobotControl Version: 7.6.1\n", "", (7, 6)),
        ("RobotOS Version: 16.0.0\nRobotControl Version: 7.18.1\n", "", (7, 18)),
        (
            "",
            '<Media path="C:/ABB/RobotWare/RobotOS_5.0.1" name="RobotOS" version="5.0.1+0"/>\n'
            '<Media path="C:/ABB/RobotWare/RobotControl_7.6.1" name="RobotControl"/>\n',
            (7, 6),
        ),
    ],
)
def test_robotware_7_is_the_release_of_its_robotcontrol(backup, parts, media, robotware):
    """[backup 7.6.1 GoFa, rparak; 7.18.1 IRB 1300, Wlups] The order of the parts differs."""
    put(backup / "BACKINFO/backinfo.txt", f">>SYSTEM_ID:\ncell\n\n>>PRODUCTS_ID:\n{parts}\n")
    put(backup / "system.xml", f"<SystemProperties>\n{media}</SystemProperties>\n")
    notes = []
    assert read_backup(backup, notes=notes).robotware == robotware
    assert "RG713" not in [n.code for n in notes]


def test_a_backup_without_version_says_so(backup):
    os.remove(backup / "BACKINFO/backinfo.txt")
    notes = []
    assert read_backup(backup, notes=notes).robotware == (5, 0)
    assert "RG713" in [n.code for n in notes]


@pytest.mark.parametrize("file", ["HOME:/../secret.sys", "HOME:/sub/../../secret.sys"])
def test_paths_must_not_leave_the_backup(backup, file):
    put(backup.parent / "secret.sys", MODULE % b"Secret")
    text = (backup / "SYSPAR/SYS.cfg").read_text().replace("HOME:/Shared.sys", file)
    put(backup / "SYSPAR/SYS.cfg", text)
    with pytest.raises(DiagnosticError) as caught:
        read_backup(backup)
    assert code_of(caught) == ["RG706"]


def test_links_must_not_leave_the_backup(backup):
    secret = put(backup.parent / "secret.sys", MODULE % b"Secret")
    (backup / "RAPID/TASK1/PROGMOD/evil.mod").symlink_to(secret)
    with pytest.raises(DiagnosticError) as caught:
        read_backup(backup)
    assert code_of(caught) == ["RG706"]


def test_pipes_and_monsters_are_not_read(backup, tmp_path):
    pipe = tmp_path / "pipe.mod"
    os.mkfifo(pipe)
    with pytest.raises(DiagnosticError) as caught:
        read_files([pipe])
    assert code_of(caught) == ["RG705"]
    monster = tmp_path / "monster.mod"
    with monster.open("wb") as file:
        file.truncate(9 * 1024 * 1024)
    with pytest.raises(DiagnosticError) as caught:
        read_files([monster])
    assert code_of(caught) == ["RG705"]


def test_a_wrong_word_names_the_right_one(backup):
    text = (backup / "SYSPAR/SYS.cfg").read_text().replace('"SysHalt"', '"SysHlt"')
    put(backup / "SYSPAR/SYS.cfg", text)
    with pytest.raises(DiagnosticError) as caught:
        read_backup(backup)
    (result,) = caught.value.diagnostics
    assert (result.code, result.span.line) == ("RG708", 7)
    assert "SysHalt" in result.help


def test_loose_files(tmp_path):
    put(tmp_path / "b.mod", MODULE % b"Bee")
    put(tmp_path / "a.sys", b"%%%\nVERSION:1\nLANGUAGE:ENGLISH\n%%%\n" + MODULE % b"Aye")
    put(tmp_path / "readme.txt", b"no module")
    system = read_system(tmp_path)
    (task,) = system.tasks
    assert (task.name, task.type, task.motion) == ("T_ROB1", "NORMAL", True)
    assert [m.name for m in task.modules] == ["Aye", "Bee"]


@pytest.mark.parametrize(
    ("content", "fix"), [(MODULE % b"Work", "call it work.mod"), (b"", "<Module>NAME.mod")]
)
def test_a_program_file_that_lists_no_modules(tmp_path, content, fix):
    put(tmp_path / "work.pgf", content)
    with pytest.raises(DiagnosticError) as caught:
        read_files([tmp_path / "work.pgf"])
    (report,) = caught.value.diagnostics
    assert (report.code, fix in report.help) == ("RG709", True)


def test_several_tasks_and_a_program_file(tmp_path):
    put(tmp_path / "work.mod", MODULE % b"Work")
    put(tmp_path / "back.mod", MODULE % b"Back")
    put(tmp_path / "work.pgf", "<?xml version='1.0'?><Program><Module>work.mod</Module></Program>")
    put(
        tmp_path / "EIO.cfg",
        'EIO:CFG_1.0:6:1::\n#\nEIO_SIGNAL:\n\n  -Name "di1" -SignalType "DI"\n',
    )
    system = read_files(
        {"T_BG": [tmp_path / "back.mod", tmp_path / "EIO.cfg"], "T_ROB1": [tmp_path / "work.pgf"]}
    )
    assert [(t.name, t.motion) for t in system.tasks] == [("T_BG", False), ("T_ROB1", True)]
    assert system.signals == (SignalSpec("di1", "DI"),)


def test_a_task_s_folder_of_a_backup(backup):
    """RAPID/TASK1 has SYSMOD and PROGMOD and nothing else [backups]."""
    put(backup / "RAPID/TASK1/PROGMOD/Work.pgf", "<Program><Module>Work.mod</Module></Program>")
    put(backup / "RAPID/TASK1/PROGMOD/left.mod", MODULE % b"Left")
    (task,) = read_files([backup / "RAPID/TASK1"]).tasks
    assert [module.name for module in task.modules] == ["user", "Work"]
    with pytest.raises(DiagnosticError) as caught:
        read_files([backup / "RAPID"])
    assert caught.value.diagnostics[0].help == f"a backup is loaded whole: name {backup}"


@pytest.mark.parametrize("paths", [[], ["nothing.mod"], ["folder"]])
def test_nothing_to_load(tmp_path, paths):
    (tmp_path / "folder").mkdir()
    with pytest.raises(DiagnosticError) as caught:
        read_files([tmp_path / path for path in paths])
    assert code_of(caught)[0] in ("RG704", "RG709")


@pytest.mark.parametrize(
    "manifest",
    ["", "[]", '{"format": 99}', '{"format": 1}', "[" * 100_000, '{"format": 1, "robotware": [6]}'],
)
def test_a_damaged_manifest(tmp_path, manifest):
    put(tmp_path / "manifest.json", manifest)
    with pytest.raises(DiagnosticError) as caught:
        read_folder(tmp_path)
    assert code_of(caught) == ["RG711"]


def test_a_generated_folder_must_be_whole(tmp_path):
    manifest = {
        "format": 1, "robotware": [6, 15], "name": "x", "build_id": "0", "lines": {},
        "files": [{"path": "SYS.cfg", "kind": "cfg"}, {"path": "EIO.cfg", "kind": "cfg"}],
        "configuration": {
            "groups": [{"task": "T_ROB1", "mechanical_unit": "ROB_1", "external_units": []}]
        },
    }  # fmt: skip
    put(tmp_path / "manifest.json", json.dumps(manifest))
    put(tmp_path / "EIO.cfg", "EIO:CFG_1.0:6:1::\n")
    put(
        tmp_path / "SYS.cfg",
        'SYS:CFG_1.0:6:0::\n#\nCAB_TASKS:\n\n -Name "T_A"\n#\nCAB_TASK_MODULES:\n\n'
        ' -File "HOME:/a.sys" -Task "T_ROB1"\n',
    )
    with pytest.raises(DiagnosticError) as caught:
        read_folder(tmp_path)
    assert code_of(caught) == ["RG710"]
    put(tmp_path / "HOME/a.sys", MODULE % b"Aye")
    robot, added = read_folder(tmp_path).tasks
    assert (robot.name, robot.motion, [m.name for m in robot.modules]) == ("T_ROB1", True, ["Aye"])
    put(tmp_path / "HOME/b.sys", MODULE % b"aye")
    with (tmp_path / "SYS.cfg").open("a") as cfg:
        cfg.write('\n -File "HOME:/b.sys" -AllTask\n')
    with pytest.raises(DiagnosticError) as caught:
        read_folder(tmp_path)
    assert code_of(caught) == ["RG714"]
    assert (added.name, added.type) == ("T_A", "SEMISTATIC")


def test_model_to_text_and_back():
    system = System(
        "cell",
        (
            TaskSpec("T_ROB1", motion=True, mechanical_unit_group="rob1"),
            TaskSpec("T_SRV", "SEMISTATIC", "SysStop", "serve"),
            TaskSpec("T_LOG", "STATIC", "NoSafety"),
        ),
        signals=(SignalSpec("doA", "DO", "ReadOnly"), SignalSpec("goB", "GO", size=8, default=3)),
        outputs=(
            SystemOutput("MotorOn", "doA"),
            SystemOutput("TaskExecuting", "doA", task="T_ROB1"),
        ),
        inputs=(SystemInput("Start", "diA", "CONT"),),
        cross=(CrossConnection("c", "doA", (("diA", True), ("diB", False)), ("AND",)),),
        events=(EventRoutine("OnStop", "STOP", "T_ROB1"),),
        groups=(MechanicalUnitGroup("rob1", "ROB_1", ("TRACK_1",), "motion_planner_1"),),
        robotware=(6, 15),
    )
    sys_text = parse_cfg(write_cfg(sys_cfg(system)))
    eio_text = parse_cfg(write_cfg(eio_cfg(system)))
    assert tasks_of(sys_text) == system.tasks
    assert modules_of(sys_text) == ()
    assert events_of(sys_text) == system.events
    assert groups_of(sys_text) == system.groups
    assert signals_of(eio_text) == system.signals
    assert outputs_of(eio_text) == system.outputs
    assert inputs_of(eio_text) == system.inputs
    assert crosses_of(eio_text) == system.cross


@pytest.mark.parametrize("robotware", [(5, 15), (5, 61), (6, 13), (7, 6)])
def test_system_signals_and_hooks_of_each_release(robotware):
    """Outputs have a unit in Arg1 and a task in Arg2, inputs a task in Arg7; 7 has them in SYS."""
    system = System(
        "cell",
        (),
        outputs=(
            SystemOutput("MechUnitNotMoving", "doA", unit="ROB_1"),
            SystemOutput("Error", "doB", task="T_ROB1"),
        ),
        inputs=(
            SystemInput("Start", "diA", "CONT"),
            SystemInput("PpToMain", "diB", task="T_ROB1"),
        ),
        events=(
            EventRoutine("on_power", "POWER_ON", all_motion_tasks=True, order=1),
            EventRoutine("on_stop", "STOP", all_tasks=True),
        ),
        robotware=robotware,
    )
    sys_text = parse_cfg(write_cfg(sys_cfg(system)))
    eio_text = parse_cfg(write_cfg(eio_cfg(system)))
    home, key = (sys_text, "Name") if robotware[0] >= 7 else (eio_text, "Signal")
    first, second = home.instances("SYSSIG_OUT")
    assert (first.text(key), first.text("Arg1"), first.text("Arg2")) == ("doA", "ROB_1", "")
    assert (second.text(key), second.text("Arg1"), second.text("Arg2")) == ("doB", "", "T_ROB1")
    assert outputs_of(eio_text, sys_text) == system.outputs
    assert inputs_of(eio_text, sys_text) == system.inputs
    assert events_of(sys_text) == system.events


def test_nothing_of_the_controllers_is_written_on_top():
    system = System(
        "cell",
        (
            TaskSpec("T_ROB1", motion=True, modules=(ModuleFile("a", "", b"", "HOME:/a.sys"),)),
            TaskSpec("T_SRV", "SEMISTATIC"),
        ),
        groups=(MechanicalUnitGroup("rob1", "ROB_1"),),
    )
    text = sys_cfg(system, on_top=True)
    assert [s.name for s in text.sections] == ["CAB_TASKS", "CAB_TASK_MODULES"]
    assert [i.text("Name") for i in text.instances("CAB_TASKS")] == ["T_SRV"]
    assert [i.text("Task") for i in text.instances("CAB_TASK_MODULES")] == ["T_ROB1"]


def test_shared_and_installed_modules(backup):
    """-Shared, -Install [code]; one instance stands for all tasks [K §14.3]."""
    cfg = backup / "SYSPAR/SYS.cfg"
    text = cfg.read_text()
    put(backup / "HOME/tools.sys", MODULE % b"Tools")
    put(
        cfg,
        text.replace('"HOME:/Shared.sys" -AllTask', '"HOME:/Shared.sys" -Shared').replace(
            '"RELEASE:/options/dispense.sys"', '"HOME:/tools.sys" -Install'
        ),
    )
    system = read_backup(backup)
    robot, back = ({m.name: (m.shared, m.installed) for m in t.modules} for t in system.tasks)
    plain = (False, False)
    assert robot == {"user": plain, "Work": plain, "Shared": (True, False), "Tools": (False, True)}
    assert back == {"Back": plain, "Shared": (True, False)}
    again = modules_of(parse_cfg(write_cfg(sys_cfg(system))))
    assert [(e.file, e.tasks, e.shared, e.installed) for e in again] == [
        ("HOME:/Shared.sys", (), True, False),
        ("HOME:/tools.sys", ("T_ROB1",), False, True),
    ]


def test_a_backup_tells_its_robots(backup):
    put(
        backup / "SYSPAR/MOC.cfg",
        'MOC:CFG_1.0:6:0::\n#\nROBOT:\n\n -name "ROB_1" -use_robot_type "ROB1_120_0.58_3"\n',
    )
    assert read_backup(backup).robot_types == (("ROB_1", "ROB1_120_0.58_3"),)


def test_a_file_that_may_be_refused(tmp_path):
    """The manifest names it: it is left out whole with a note, or not loaded at all."""
    manifest = {
        "format": 1, "robotware": [7, 6], "name": "x", "build_id": "0", "lines": {},
        "files": [{"path": n, "kind": "cfg"} for n in ("EIO.cfg", "SYS_open.cfg")],
        "optional": ["SYS_open.cfg"],
        "configuration": {
            "groups": [{"task": "T_ROB1", "mechanical_unit": "ROB_1", "external_units": []}]
        },
    }  # fmt: skip
    put(tmp_path / "manifest.json", json.dumps(manifest))
    put(tmp_path / "EIO.cfg", 'EIO:CFG_1.0:7:0::\nEIO_SIGNAL:\n -Name "doA" -SignalType "DO"\n')
    put(
        tmp_path / "SYS_open.cfg",
        'SYS:CFG_1.0:7:0::\nSYSSIG_OUT:\n -Status "EmStop" -Name "doA"\n',
    )
    notes = []
    assert read_folder(tmp_path, notes=notes, open_words=False).outputs == ()
    assert [(note.code, note.severity) for note in notes] == [("RG722", Severity.WARNING)]
    assert read_folder(tmp_path, without=("SYS_open.cfg",)).outputs == ()
    in_use = read_folder(tmp_path, open_words=True).outputs
    assert [(o.status, o.signal) for o in in_use] == [("EmStop", "doA")]


def test_a_damaged_moc_is_a_note(backup):
    put(backup / "SYSPAR/MOC.cfg", "MOC:CFG_1.0:6:0::\nROBOT:\n what is this\n")
    notes = []
    assert read_backup(backup, notes=notes).robot_types == ()
    assert ("RG702", Severity.WARNING) in [(note.code, note.severity) for note in notes]


def test_two_files_of_one_module_in_a_task(backup):
    """A note in a backup: the controller that it is of ran."""
    put(backup / "HOME/old/shared.sys", MODULE % b"Shared")
    for cfg in (backup / "SYSPAR").iterdir():
        if b"CAB_TASK_MODULES" in cfg.read_bytes():
            text = cfg.read_text(encoding="latin-1")
            row = '\n -File "HOME:/old/shared.sys" -Task "T_ROB1"\n'
            put(cfg, text.replace("CAB_TASK_MODULES:", "CAB_TASK_MODULES:" + row))
    notes = []
    system = read_backup(backup, notes=notes)
    (note,) = [n for n in notes if n.code == "RG714"]
    assert "'HOME:/old/shared.sys'" in note.message
    assert "[mem]" in note.message
    assert [m.name for m in system.tasks[0].modules] == ["user", "Work", "Shared"]


def test_program_folder_includes_its_system_modules(tmp_path):
    put(tmp_path / "work.pgf", "<?xml version='1.0'?><Program><Module>work.mod</Module></Program>")
    for name in ("work.mod", "old.mod", "lib.sys"):
        put(tmp_path / name, f"MODULE {name[:-4]}\nENDMODULE\n")
    (task,) = read_files([tmp_path]).tasks
    assert [module.name for module in task.modules] == ["work", "lib"]


def test_macos_resource_file_is_no_module(tmp_path):
    put(tmp_path / "main.mod", MODULE % b"Main")
    put(tmp_path / "._main.mod", b"\x00\x05\x16\x07\x00\x02\x00\x00Mac OS X")
    (task,) = read_files({"T_ROB1": [tmp_path]}).tasks
    assert [module.name for module in task.modules] == ["Main"]
