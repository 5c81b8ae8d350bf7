"""Boot of any target, with a described or an inferred cell."""

import pytest

from rapidgen.axes.default_postures import usual_start
from rapidgen.axes.kinematics import Kinematics
from rapidgen.config import load_config
from rapidgen.config.cell import load_cell
from rapidgen.controller import VirtualController
from rapidgen.controller.boot_targets import BootOptions, load_target
from rapidgen.controller.cell_setup import INFERRED_INPUT
from rapidgen.controller.inference.robot import RobotCandidate
from rapidgen.controller.inference.start_poses import shown
from rapidgen.diagnostics import DiagnosticError
from rapidgen.system.cfg_composition import database_of
from rapidgen.system.releases import UNKNOWN_ROBOTWARE

PROGRAM = r"""MODULE work
  PROC main()
    SetDO doGrip, 1;
    WaitDI diGripped, 1;
    MoveL Offs(CRobT(\Tool:=tGrip\WObj:=wTable), 10, 0, 0), v100, fine, tGrip\WObj:=wTable;
    WaitUntil giPart > 3 AND diDoor = 0;
    IF partHere = 1 TPWrite "on";
    TPWrite ValToStr(ClkRead(clock9));
  ENDPROC
ENDMODULE
"""
CELL = """
robots:
  T_ROB1: {model: irb4600, start: [10, 0, 0, 0, 45, 0]}
signals:
  doGrip: {kind: DO}
  diGripped: {kind: DI}
  diDoor: {kind: DI, value: 1}
  giPart: {kind: GI, size: 4}
  partHere: {kind: DI, access: read}
tools:
  tGrip: {frame: {position: [0, 0, 100]}, load: {mass: 1, centre: [0, 0, 50]}}
work_objects:
  wTable: {user_frame: {position: [800, 0, 0]}}
devices:
  gripper:
    - {when: {doGrip: 1}, then: {diGripped: 1}, after: 0.25}
  line:
    - {when: {diGripped: 1}, then: {giPart: 5, diDoor: 0}, after: 2}
"""


@pytest.fixture
def program(tmp_path):
    path = tmp_path / "work.mod"
    path.write_text(PROGRAM)
    return path


@pytest.fixture
def cell(tmp_path):
    path = tmp_path / "cell.yaml"
    path.write_text(CELL)
    return path


def text_of(program, cell, path):
    path.write_text(program.read_text().replace("ValToStr(ClkRead(clock9))", '"done"'))
    return VirtualController.from_files([path], cell=cell, cycle="once")


def test_a_described_cell_answers_the_program(program, cell, tmp_path):
    with text_of(program, cell, tmp_path / "work.mod") as controller:
        (group,) = controller.motion.groups.values()
        assert group.config.model == "irb4600"
        assert shown(group.config, group.positions()) == "[10,0,0,0,45,0]"
        assert controller.signals["diDoor"] == 1
        assert controller.run(max_time=60) == "finished"
        assert controller.signals["giPart"] == 5
        assert controller.operator.rows[-1] == "done"
        assert controller.now > 2.25
        # The frames are the cell's: from the table's origin the flange is far off.
        assert controller.task("T_ROB1")["cell_data:wTable"].uframe.trans.x == 800


def test_inferred_cell_has_names_of_program(program):
    result = load_target([program], BootOptions(cell="infer"))
    assert result.guessed is not None
    named = {one.name: one.type for one in result.guessed.named}
    assert named == {
        "doGrip": "signaldo",
        "diGripped": "signaldi",
        "giPart": "signalgi",
        "diDoor": "signaldi",
        "partHere": "signaldi",
        "tGrip": "tooldata",
        "wTable": "wobjdata",
        "clock9": "clock",
    }
    assert result.guessed.named[0].span.line == 3
    (table,) = result.guessed.cell.work_objects
    x, y, z = table.user_frame.position
    assert (0.3 < x < 0.4, y, 0.1 < z < 0.3) == (True, 0, True), "an IRB 120 reaches it"


def test_inferred_input_gets_awaited_value_after_half_second(tmp_path):
    path = tmp_path / "waits.mod"
    path.write_text(
        "MODULE waits\n PROC main()\n WaitDI diA, 1;\n WaitUntil (NOT diA = 1) AND giB >= 7;\n"
        " WaitGI giB, \\LT, 3;\n WaitUntil TestDI(diA);\n ENDPROC\nENDMODULE\n"
    )
    with VirtualController.from_files([path], cell="infer", cycle="once") as controller:
        assert controller.run(max_time=60) == "finished"
        assert controller.guessed.answered == [
            ("diA", 1),
            ("diA", 0),
            ("giB", 7),
            ("giB", 2),
            ("diA", 1),
        ]
        assert controller.now == pytest.approx(2.0, abs=0.25)
        message = [event.texts for event in controller.log if event.code == INFERRED_INPUT]
        assert message[0] == ("diA becomes 1",)
        assert len(message) == 5


def test_without_a_cell_nothing_is_made_up(program):
    result = load_target([program])
    assert result.guessed is None
    assert result.system.signals == ()


@pytest.mark.parametrize(
    ("model", "first", "second"),
    [
        ("irb120", "[0,0,0,0,30,0]", ""),
        ("irb14000", "[0,-130,30,0,40,0] [135]", "[0,-130,30,0,40,0] [-135]"),
        ("irb660", "[0,0,0,0,0,0]", ""),
        ("irb910sc", "[0,0,0,0,0,0]", ""),
    ],
)
def test_foreign_program_starts_at_usual_pose(model, first, second):
    result = [shown(group, usual_start(group)) for group in load_config(model).groups]
    assert result == [text for text in (first, second) if text]


def test_a_driver_starts_at_zero():
    assert load_target(["irb120"]).surroundings.starts == {}


def refused(call, *words):
    with pytest.raises(DiagnosticError) as caught:
        call()
    (result,) = caught.value.diagnostics
    assert all(word in f"{result.message} {result.help}" for word in words), result
    return result.code


def test_unreachable_start_is_rejected(program):
    far = BootOptions(start=(0, 0, 0, 0, 130, 0))
    assert refused(lambda: load_target([program], far), "rax_5", "-120 to 120") == "RG435"
    few = BootOptions(start=(0, 0))
    assert refused(lambda: load_target([program], few), "2 values", "rax_6") == "RG435"


def test_mismatched_cell_is_rejected(program, cell):
    cell.write_text(
        "signals: {doGrip: {kind: DO}}\ndevices: {a: [{when: {dGrip: 1}, then: {x: 1}}]}"
    )
    with pytest.raises(DiagnosticError) as caught:
        load_target([program], BootOptions(cell=cell))
    assert [d.code for d in caught.value.diagnostics] == ["RG434", "RG434"]
    assert "did you mean 'doGrip'" in caught.value.diagnostics[0].help
    cell.write_text("robots: {T_ROB2: {model: irb120}}")
    assert refused(lambda: load_target([program], BootOptions(cell=cell)), "T_ROB2") == "RG434"
    cell.write_text("signal: {doGrip: {kind: DO}}")
    assert refused(lambda: load_cell(cell), "signal", "signals") == "RG005"


def test_robot_of_cell_may_be_adjacent_configuration(program, cell, tmp_path):
    (tmp_path / "mine.yaml").write_text("name: mine\nmodel: irb1600\n")
    cell.write_text("robots: {T_ROB1: {model: mine.yaml, mechanical_unit: ROB_7}}")
    (group,) = load_target([program], BootOptions(cell=cell)).groups
    assert (group.model, group.mechanical_unit) == ("irb1600", "ROB_7")


def test_inferred_input_polled_in_loop_is_pressed(tmp_path):
    path = tmp_path / "polls.mod"
    path.write_text(
        "MODULE polls\n VAR num done;\n PROC main()\n  WHILE done < 3 DO\n"
        "   IF DI_1 = 1 Incr done;\n   IF DInput(start) = 1 THEN\n    done := done + 10;\n"
        "   ENDIF\n   TEST giPart\n   CASE 4:\n    done := done + 100;\n   ENDTEST\n"
        "   WaitTime 0.3;\n  ENDWHILE\n ENDPROC\nENDMODULE\n"
    )
    with VirtualController.from_files([path], cell="infer", cycle="once") as controller:
        assert controller.run(max_time=20) == "finished"
        assert controller.guessed.answered[:2] == [("DI_1", 1), ("start", 1)]
        assert controller.signals["DI_1"] == 0, "a button is let go"


def test_entry_routine_counts_as_loop(tmp_path):
    path = tmp_path / "cycles.mod"
    path.write_text(
        "MODULE cycles\n PERS num done := 0;\n PROC main()\n  IF DI_1 = 1 Incr done;\n"
        "  WaitTime 0.1;\n ENDPROC\nENDMODULE\n"
    )
    with VirtualController.from_files([path], cell="infer", cycle="forever") as controller:
        assert controller.run_until(lambda: controller.task("T_ROB1")["cycles:done"] > 1, timeout=5)


def test_a_guessed_cell_does_not_hide_a_deadlock(tmp_path):
    path = tmp_path / "dead.mod"
    path.write_text(
        "MODULE dead\n PERS bool never := FALSE;\n VAR bool got;\n PROC main()\n"
        "  WHILE di1 = 0 DO\n   never := TRUE;\n   WaitTestAndSet never;\n  ENDWHILE\n"
        " ENDPROC\nENDMODULE\n"
    )
    with VirtualController.from_files([path], cell="infer", cycle="once") as controller:
        assert controller.run(max_time=20) == "deadlock"
        assert "WaitTestAndSet waits for its flag" in controller.where()[0]


def test_faulty_value_is_not_reported_as_missing(tmp_path):
    path = tmp_path / "cell.yaml"
    path.write_text("signals:\n  a: {kind: XX}\ntools:\n  1x: {}\n")
    with pytest.raises(DiagnosticError) as fault:
        load_cell(path)
    result = fault.value.diagnostics
    assert [(d.code, d.span.line) for d in result] == [("RG006", 2), ("RG006", 4)]
    assert "`rapidgen schema --cell` has all keys" in result[0].help
    assert "begin with a letter" in result[1].help
    path.write_text("- doGrip\n")
    with pytest.raises(DiagnosticError, match="a cell file is a mapping of keys") as fault:
        load_cell(path)
    assert "`rapidgen schema --cell`" in fault.value.diagnostics[0].help


def test_dialog_of_inferred_cell_gets_default_then_choices(tmp_path):
    path = tmp_path / "asks.mod"
    path.write_text(
        "MODULE asks\n PERS num key := 0;\n PERS num sum := 0;\n VAR num n;\n PROC main()\n"
        '  WHILE key <> 3 DO\n   TPReadFK key, "Where?", "left", "", "right", "", "";\n'
        "   sum := 10 * sum + key;\n  ENDWHILE\n"
        '  TPReadNum n, "How many?";\n  sum := 10 * sum + n;\n'
        r'  sum := 10 * sum + UINumEntry(\Header:="N"\InitValue:=7\MinValue:=5\MaxValue:=9);'
        "\n"
        r'  IF UIMessageBox(\Message:="On?"\Buttons:=btnYesNo\DefaultBtn:=resNo) = resNo THEN'
        "\n   sum := 10 * sum + 8;\n  ENDIF\n ENDPROC\nENDMODULE\n"
    )
    with VirtualController.from_files([path], cell="infer", cycle="once") as controller:
        assert controller.run(max_time=60) == "finished"
        assert controller.task("T_ROB1")["asks:sum"] == 13178
        assert controller.guessed.answered == [
            ("TPReadFK 'Where?'", "left"),
            ("TPReadFK 'Where?'", "right"),
            ("TPReadNum 'How many?'", "1"),
            ("UINumEntry 'N'", "7"),
            ("UIMessageBox 'On?'", "No"),
        ]


def test_script_of_answers_replaces_inferred_answers(tmp_path):
    path = tmp_path / "asks.mod"
    path.write_text(
        'MODULE asks\n VAR num n;\n PROC main()\n  TPReadNum n, "A";\n ENDPROC\nENDMODULE\n'
    )
    with VirtualController.from_files([path], cell="infer", cycle="once", answers=[]) as controller:
        assert controller.run(max_time=60) == "deadlock"
        assert controller.guessed.answered == []


def test_undeclared_plain_data_have_type_of_use(tmp_path):
    path = tmp_path / "names.mod"
    path.write_text(
        'MODULE names\n CONST string named := "sig_a";\n VAR signaldo alias1;\n'
        " VAR robtarget seen;\n PROC main()\n  AliasIO named, alias1;\n  Set alias1;\n"
        "  DeactUnit M7;\n  MoveJ pHome, v25, z5, tool0;\n  MoveL pHome, vSlow, zMine, tool0;\n"
        '  IF bReady OR nMode > 3 THEN\n   TPWrite stText + "x";\n  ENDIF\n'
        "  WHILE nCount < nMax DO\n   nCount := nCount + 1;\n  ENDWHILE\n"
        "  WaitDI Sensor, 1;\n"
        '  FOR i FROM 1 TO nParts DO\n   TPWrite "part";\n  ENDFOR\n  x{3} := undeclared;\n'
        " ENDPROC\nENDMODULE\n"
    )
    result = load_target([path], BootOptions(cell="infer", robot="irb1600"))
    assert result.guessed is not None
    assert {one.name: one.type for one in result.guessed.named} == {
        "sig_a": "signaldo",
        "M7": "mecunit",
        "pHome": "robtarget",
        "v25": "speeddata",
        "vSlow": "speeddata",
        "zMine": "zonedata",
        "bReady": "bool",
        "nMode": "num",
        "stText": "string",
        "nCount": "num",
        "nMax": "num",
        "nParts": "num",
        "Sensor": "signaldi",
    }
    assert [one.name for one in result.guessed.unknown] == ["undeclared"]
    with VirtualController.boot(result, cycle="once") as controller:
        start = controller.positions()
        controller.run(max_time=20)
        assert controller.signals["sig_a"] == 1
        assert controller.positions() == pytest.approx(start, abs=1e-5), "a target is where it is"
        assert controller.task("T_ROB1")["cell_data:v25"].v_tcp == 25
        assert controller.task("T_ROB1")["cell_data:vSlow"].v_tcp == 100


def test_a_folder_with_a_folder_for_each_task_is_those_tasks(tmp_path):
    text = "MODULE m\n PROC main()\n  {} doMet, 1;\n ENDPROC\nENDMODULE\n"
    for task, message in (("T_ROB_L", "SetDO"), ("T_ROB_R", "WaitDO")):
        (tmp_path / task).mkdir()
        (tmp_path / task / "m.mod").write_text(text.format(message))
    result = load_target([tmp_path], BootOptions(cell="infer", robot="irb14000"))
    assert [group.task for group in result.groups] == ["T_ROB_L", "T_ROB_R"]
    with VirtualController.boot(result, cycle="once") as controller:
        assert controller.run(max_time=20) == "finished"


def test_inferred_robot_reaches_targets(tmp_path):
    group = load_config("irb4600").groups[0]
    kinematics = Kinematics.of(group)
    assert kinematics is not None
    far = [0.2, 0.9, -0.2, 0.1, 0.5, 0.3]
    place, turn = kinematics.forward(far)
    target = [[1000 * v for v in place], list(turn), list(kinematics.configuration(far)), [9e9] * 6]
    path = tmp_path / "far.mod"
    path.write_text(
        "MODULE far\n PERS tooldata tRod := [TRUE,[[0,0,100],[1,0,0,0]],"
        "[1,[0,0,1],[1,0,0,0],0,0,0]];\n"
        ' PERS wobjdata wAway := [FALSE,TRUE,"",[[900,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n'
        f" CONST robtarget p := {target};\n"
        " CONST robtarget q := [[50,0,400],[0.707107,0,0.707107,0],[0,0,0,0],"
        "[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        " PROC main()\n  MoveJ Offs(p, 0, 0, 1), v100, fine, tool0;\n"
        "  MoveJ q, v100, fine, tRod \\WObj:=wAway;\n  MoveJ [[0,0,0],[0,0,0,0],[0,0,0,0],"
        "[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;\n ENDPROC\nENDMODULE\n"
    )
    result = load_target([path], BootOptions(cell="infer"))
    assert result.likely == RobotCandidate("irb4600", 2, 2)
    assert result.groups[0].model == "irb4600"
    assert load_target([path], BootOptions(cell="infer", robot="irb1600")).likely is None
    assert load_target([path]).groups[0].model == "irb120"
    text = path.read_text().replace("MODULE far\n", "MODULE far\n VAR num i := 3;\n")
    path.write_text(text.replace("Offs(p, 0, 0, 1)", "RelTool(Offs(p, 0, 0, i), 0, 0, -1)"))
    assert load_target([path], BootOptions(cell="infer")).likely == RobotCandidate("irb4600", 2, 2)


@pytest.mark.parametrize(("eax_a", "robot"), [(101.96, "irb14000"), (0, "irb120")])
def test_an_arm_angle_guesses_the_robot_with_seven_axes(eax_a, robot, tmp_path):
    """0 is what other writers of programs give to axes that no robot has
    (TPHugo/TimovyProjekt, walls from Grasshopper for an arm with six axes)."""
    path = tmp_path / "angle.mod"
    path.write_text(
        "MODULE angle\n PROC main()\n  MoveJ [[300,0,400],[0,0.707107,0.707107,0],[0,0,0,0],"
        f"[{eax_a},9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;\n ENDPROC\nENDMODULE\n"
    )
    result = load_target([path], BootOptions(cell="infer"))
    assert result.groups[0].model == robot


def test_loose_files_run_on_given_release(program, cell):
    """An OmniCore as delivered: tasks, robot, firewall (backups of 7.5, 7.6)."""
    result = load_target([program], BootOptions(robotware=(7, 6), cell=cell))
    assert result.system.robotware == (7, 6)
    cfg = database_of(result.system, result.groups).cfg
    assert cfg.tasks == {"t_rob1"}
    assert cfg.units == {"rob_1"}
    assert "rapidsockets" in cfg.names("SIO", "FIREWALL_MANAGEMENT")
    assert cfg.signal("doGrip").text("SignalType") == "DO"


def test_target_with_release_rejects_robotware(program):
    assert load_target([program]).system.robotware == UNKNOWN_ROBOTWARE
    with pytest.raises(DiagnosticError, match="'crb15000' defines its RobotWare"):
        load_target(["crb15000"], BootOptions(robotware=(7, 6)))


def test_current_folder_has_name(tmp_path, monkeypatch):
    folder = tmp_path / "wall"
    folder.mkdir()
    (folder / "m.mod").write_text("MODULE m\n PROC main()\n ENDPROC\nENDMODULE\n")
    monkeypatch.chdir(folder)
    assert load_target(["."]).name == "wall"
