"""Build for an existing controller: reuse its backup, add the rest."""

import pytest

from rapidgen.config import from_manifest, load_config
from rapidgen.controller import VirtualController
from rapidgen.diagnostics import DiagnosticError
from rapidgen.generate import build, write
from rapidgen.generate.existing_controller import fit, read_cell
from rapidgen.system import parse_cfg, read_folder, read_manifest
from rapidgen.system.cfg_loading import identity
from tests.generate.cell_backup import write_backup

ABB_DRIVER = '  -File "HOME:/ROS/ROS_common.sys" -ModName "ROS_common" -AllTask\n'


@pytest.fixture
def backup(tmp_path):
    return write_backup(tmp_path / "cell")


def edit(backup, name, old, new):
    path = backup / "SYSPAR" / name
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


def built(backup, name="irb120", overrides=()):
    cell = read_cell(backup)
    config = fit(load_config(name, overrides=overrides), cell)
    output = build(config, cell)
    texts = {f.path: parse_cfg(f.data) for f in output.files if f.kind == "cfg"}
    return config, output, texts


def refused(backup, name="irb120"):
    with pytest.raises(DiagnosticError) as caught:
        built(backup, name)
    return caught.value.diagnostics


def names(text, section, attribute="Name"):
    return [instance.text(attribute) for instance in text.instances(section)]


def test_parts_of_the_cell_are_used(backup):
    config, _, texts = built(backup)
    (group,) = config.groups
    assert config.robotware == (6, 7)
    assert (group.task, group.mechanical_unit) == ("T_MOVE", "ROB_1")
    assert not config.call_main
    assert "signalMotorOn" not in names(texts["EIO.cfg"], "EIO_SIGNAL")
    assert "signalRobotEStop" in names(texts["EIO.cfg"], "EIO_SIGNAL")
    assert "MotOnState" not in names(texts["EIO.cfg"], "SYSSIG_OUT", "Status")


def test_a_program_without_main_gets_ours(backup):
    (backup / "RAPID/TASK1/PROGMOD/theirs.mod").write_text("MODULE theirs\nENDMODULE\n")
    assert built(backup)[0].call_main


def test_a_hook_has_an_order_of_its_own(backup):
    orders = {
        hook.text("Shelf"): hook.number("SeqNo")
        for hook in built(backup)[2]["SYS.cfg"].instances("CAB_EXEC_HOOKS")
    }
    assert orders["STOP"] == 51
    assert orders["START"] == 50


def test_the_result_loads_and_only_adds(backup, tmp_path):
    _, output, texts = built(backup)
    for text in texts.values():
        cell = read_cell(backup).cfg
        for section in text.sections:
            target = {identity(section.name, i) for i in cell.instances(text.domain, section.name)}
            assert not target & {identity(section.name, i) for i in section.instances}
    write(output, tmp_path / "out")
    system = read_folder(tmp_path / "out", backup)
    assert [task.name for task in system.tasks[:2]] == ["T_MOVE", "T_PLC"]
    move, _, *added = system.tasks
    assert [m.name for m in move.modules][:2] == ["theirs", "user"]
    assert "ROS_motion" in [m.name for m in move.modules]
    assert all(task.modules[0].name == "user" for task in added)
    assert "signalMotorOn" in [o.signal for o in system.outputs if o.status == "MotOnState"]
    assert (system.home_below, system.home) == (backup / "HOME", tmp_path / "out/HOME")
    config = from_manifest(read_manifest(tmp_path / "out")["configuration"])
    assert config.groups[0].task == "T_MOVE"


def test_home_is_the_cells_and_ours_over_it(backup, tmp_path):
    (backup / "HOME/theirs.txt").write_text("kept")
    write(built(backup)[1], tmp_path / "out")
    with VirtualController.from_folder(tmp_path / "out", backup=backup) as controller:
        home = controller.files.path("HOME:")
        assert (home / "theirs.txt").read_text() == "kept"
        assert (home / "rapidgen/ROS_motion.mod").is_file()
        assert "T_MOVE" in controller.rapid_tasks


def test_a_build_for_a_cell_boots_without_it(backup, tmp_path):
    """On a delivered controller with the cell's names and the signals that the build uses."""
    edit(backup, "EIO.cfg", 'SYSSIG_OUT:\n  -Status "MotOnState" -Signal "signalMotorOn"\n', "")
    edit(backup, "SYS.cfg", "CAB_EXEC_HOOKS:\n", GROUPS + "CAB_EXEC_HOOKS:\n")
    edit(backup, "SYS.cfg", "-MotionTask", '-MotionTask -UseMechanicalUnitGroup "rob21"')
    edit(backup, "SYS.cfg", '"None"', '"None" -UseMechanicalUnitGroup "rob21"')
    write(built(backup)[1], tmp_path / "out")
    system = read_folder(tmp_path / "out")
    assert system.tasks[0].mechanical_unit_group == "rob21"
    assert "signalMotorOn" in [signal.name for signal in system.signals]


def test_a_second_build_finds_nothing_missing(backup):
    _, output, _ = built(backup)
    for file in output.files:
        if file.kind == "cfg":
            path = backup / "SYSPAR" / file.path
            more = file.data.decode().replace("\r\n", "\n").split("\n", 1)[1]
            path.write_text(path.read_text() + more)
        if file.path == "HOME/rapidgen/ROS_motion.mod":
            # A controller saves what it has loaded, too.
            (backup / "RAPID/TASK1/PROGMOD/ROS_motion.mod").write_bytes(file.data)
            place = backup / file.path
            place.parent.mkdir()
            place.write_bytes(file.data)
    config, _, texts = built(backup)
    assert texts == {}
    assert not config.call_main


def test_a_driver_that_is_there_is_no_users_main(backup):
    (backup / "RAPID/TASK1/PROGMOD/theirs.mod").write_text("MODULE theirs\nENDMODULE\n")
    _, output, _ = built(backup)
    (motion,) = (f for f in output.files if f.path == "HOME/rapidgen/ROS_motion.mod")
    assert b"PROC main()" in motion.data
    cfg = backup / "SYSPAR/SYS.cfg"
    entry = '  -File "HOME:/rapidgen/ROS_motion.mod" -ModName "ROS_motion" -Task "T_MOVE"\n'
    cfg.write_text(cfg.read_text().replace("CAB_EXEC_HOOKS:\n", entry + "CAB_EXEC_HOOKS:\n"))
    (backup / "RAPID/TASK1/PROGMOD/ROS_motion.mod").write_bytes(motion.data)
    assert built(backup)[0].call_main


def test_a_signal_of_another_type_is_refused(backup):
    edit(backup, "EIO.cfg", '"DO" -Category', '"DI" -Category')
    (fault,) = refused(backup)
    assert fault.code == "RG110"
    assert "signalMotorOn" in fault.message
    assert fault.span.line == 3


def test_a_task_of_that_name_is_refused(backup):
    edit(backup, "SYS.cfg", '"T_PLC"', '"T_ROS_STATE" -Type "NORMAL"')
    (fault,) = refused(backup)
    assert (fault.code, fault.span.line) == ("RG110", 4)


def test_abb_driver_is_refused_by_its_instances(backup):
    """HONG: three common modules with -AllTask."""
    edit(backup, "SYS.cfg", "CAB_EXEC_HOOKS:\n", ABB_DRIVER + "CAB_EXEC_HOOKS:\n")
    (fault,) = refused(backup)
    assert (fault.code, fault.span.line) == ("RG110", 7)
    assert "HOME:/ROS/ROS_common.sys" in fault.message


def test_a_module_in_the_program_is_refused(backup):
    place = backup / "RAPID/TASK1/PROGMOD/ROS_motion.mod"
    place.write_text("MODULE ROS_motion\nENDMODULE\n")
    (fault,) = refused(backup)
    assert fault.code == "RG110"
    assert fault.span.path == str(place)


@pytest.mark.parametrize("name", ["ROS_run", "ROS_stop_latched"])
def test_a_name_of_the_program_is_in_the_way(backup, name):
    """A Grinding.mod of 6.13 has a global `distance`, which hides a predefined function."""
    path = backup / "RAPID/TASK1/PROGMOD/theirs.mod"
    path.write_text(
        path.read_text().replace("MODULE theirs\n", f"MODULE theirs\n VAR num {name};\n")
    )
    assert {fault.code for fault in refused(backup)} == {"RG112"}


GROUPS = """MECHANICAL_UNIT_GROUP:
  -Name "rob21" -Robot "ROB_1" -MechanicalUnit_1 "TRACK_1" -UseMotionPlanner "motion_planner_1"
"""


def test_the_unit_group_of_the_cell(backup):
    """A gantry cell of 6.03 calls it rob21."""
    edit(backup, "SYS.cfg", "CAB_EXEC_HOOKS:\n", GROUPS + "CAB_EXEC_HOOKS:\n")
    edit(backup, "SYS.cfg", "-MotionTask", '-MotionTask -UseMechanicalUnitGroup "Rob21"')
    edit(backup, "SYS.cfg", '"None"', '"None" -UseMechanicalUnitGroup "rob21"')
    config, _, texts = built(backup)
    assert config.multimove
    added = texts["SYS.cfg"].instances("CAB_TASKS")
    assert {task.text("UseMechanicalUnitGroup") for task in added} == {"Rob21"}


def test_digits_of_the_cell(backup):
    edit(backup, "EIO.cfg", "6:1", "6:2")
    assert built(backup)[2]["EIO.cfg"].version == (6, 2)


@pytest.mark.parametrize("name", ["irb14000", "irb120_track", "crb15000"])
def test_a_configuration_of_another_cell(backup, name):
    (fault,) = refused(backup, name)
    assert fault.code == "RG111"


def test_the_firewall_of_the_cell_stays_open(backup):
    """A GoFa whose RapidSockets are open on the I/O net."""
    for file in ("SYS", "EIO", "MOC"):
        edit(
            backup, f"{file}.cfg", "CFG_1.0:6:1" if file == "EIO" else "CFG_1.0:6:0", "CFG_1.0:7:0"
        )
    (backup / "BACKINFO/backinfo.txt").write_text("RobotWare Version: 7.6.1\n")
    (backup / "SYSPAR/EIO.cfg").write_text("EIO:CFG_1.0:7:0::\n")
    sio = 'SIO:CFG_1.0:7:0::\nFIREWALL_MANAGEMENT:\n  -Name "RapidSockets" -EnableOnIONet\n'
    (backup / "SYSPAR/SIO.cfg").write_text(sio)
    (rule,) = built(backup, "crb15000")[2]["SIO.cfg"].instances("FIREWALL_MANAGEMENT")
    assert rule.flag("EnableOnIONet")
    assert rule.flag("EnableOnPublicNet")
    opened = sio.replace("-EnableOnIONet", "-EnableOnPublicNet -EnableOnPrivateNet")
    (backup / "SYSPAR/SIO.cfg").write_text(opened)
    assert "SIO.cfg" not in built(backup, "crb15000")[2]


def test_another_build_id_where_the_cell_makes_other_files(backup):
    before = built(backup)[1]
    edit(backup, "SYS.cfg", "-SeqNo 50", "-SeqNo 60")
    after = built(backup)[1]
    assert [f.data for f in before.files] != [f.data for f in after.files]
    assert before.build_id != after.build_id


TOOL = ["tool.name=tGripper", "tool.declared=elsewhere", "tool.load.mass=1", "tcp_speed_limit=4000"]
VALUE = "[TRUE,[[0,0,0],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]]"


@pytest.mark.parametrize(
    ("declared", "what"),
    [
        ("", "no tGripper is there"),
        ("PERS wobjdata tGripper;", "tGripper there is PERS wobjdata"),
        (f"TASK PERS tooldata tGripper := {VALUE};", "TASK PERS tooldata"),
        ("VAR tooldata tGripper;", "VAR tooldata"),
        ("PERS tooldata tGripper{2};", "PERS tooldata with dimensions"),
    ],
)
def test_data_that_the_program_does_not_declare(backup, declared, what):
    program = backup / "RAPID/TASK1/PROGMOD/theirs.mod"
    program.write_text(program.read_text().replace("  PROC", f"  {declared}\n  PROC", 1))
    with pytest.raises(DiagnosticError, match=what) as caught:
        built(backup, overrides=TOOL)
    (fault,) = caught.value.diagnostics
    assert fault.code == "RG113"
    assert declared == "" or (fault.span and fault.span.path.endswith("theirs.mod"))


def test_data_that_the_program_declares(backup):
    program = backup / "RAPID/TASK1/PROGMOD/theirs.mod"
    declared = f"  PERS tooldata TGRIPPER := {VALUE};\n  PROC"
    program.write_text(program.read_text().replace("  PROC", declared, 1))
    assert built(backup, overrides=TOOL)[2]


CALLED = [
    "routines.weld={call: 'theirs:weld', parameters: [{name: seam, type: num}, "
    "{name: good, type: bool, mode: inout}]}"
]
COUNTED = ["data.theirs:count={type: num}"]


@pytest.mark.parametrize(
    ("declared", "overrides", "what"),
    [
        ("PROC wield(num seam, INOUT bool good) ENDPROC", CALLED, "has no weld"),
        ("PROC weld(num seam) ENDPROC", CALLED, "not declared so"),
        ("PROC weld(num seam, bool good) ENDPROC", CALLED, "not declared so"),
        ("PROC weld(num seam, INOUT num good) ENDPROC", CALLED, "not declared so"),
        ("PROC weld(PERS num seam, INOUT bool good) ENDPROC", CALLED, "not declared so"),
        ("PROC weld(num seam{*}, INOUT bool good) ENDPROC", CALLED, "not declared so"),
        ("FUNC num weld(num seam, INOUT bool good) RETURN 1; ENDFUNC", CALLED, "not declared so"),
        ("VAR num other;", COUNTED, "declares no count"),
        ("LOCAL PERS num count := 1;", COUNTED, "not a global PERS"),
        ("PERS bool count := TRUE;", COUNTED, "not a global PERS"),
        ("VAR num count := 1;", COUNTED, "not a global PERS"),
    ],
)
def test_routines_and_data_that_their_module_does_not_have(backup, declared, overrides, what):
    with pytest.raises(DiagnosticError, match=what) as caught:
        _with(backup, declared, overrides)
    (fault,) = caught.value.diagnostics
    assert fault.code == "RG114"
    assert fault.span.path.endswith("theirs.mod")


@pytest.mark.parametrize(
    ("declared", "overrides"),
    [
        ("PROC WELD(num one, VAR bool two \\num more) ENDPROC", CALLED),
        ("LOCAL PROC weld(INOUT num one, INOUT bool two) ENDPROC", CALLED),
        ("PERS num Count := 1;", COUNTED),
        # Their modules may be loaded later, and a name alone is looked for everywhere.
        ("", ["routines.away={call: 'missing:away'}", "routines.home={call: home}"]),
        ("", ["data.missing:count={type: num}"]),
    ],
)
def test_routines_and_data_that_are_there_or_may_come(backup, declared, overrides):
    assert _with(backup, declared, overrides)[2]


def _with(backup, declared, overrides):
    program = backup / "RAPID/TASK1/PROGMOD/theirs.mod"
    lines = declared.replace(") ENDPROC", ")\n  ENDPROC").replace(") RETURN", ")\n  RETURN")
    text = program.read_text()
    if lines.startswith(("PROC", "FUNC", "LOCAL PROC")):
        text = text.replace("ENDMODULE", f"  {lines}\nENDMODULE")
    else:
        text = text.replace("  PROC", f"  {lines}\n  PROC", 1)
    program.write_text(text)
    return built(backup, overrides=overrides)
