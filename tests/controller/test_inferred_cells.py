"""Inferred routines, and unreachable targets of inferred robots."""

import pytest

from rapidgen.controller import VirtualController
from rapidgen.controller.boot_targets import BootOptions, load_target
from rapidgen.diagnostics import Severity
from rapidgen.rapid import check


def test_missing_routines_do_nothing_and_are_reported(tmp_path):
    path = tmp_path / "calls.mod"
    path.write_text(
        "MODULE calls\n VAR num x := 5;\n VAR robtarget p;\n LOCAL VAR socketdev s;\n PROC main()\n"
        "  closeGrip;\n  openPort s, 5;\n"
        '  setThing 5, "a", di1 \\Fast;\n  setThing 6, "b", di1 \\Fast;\n'
        '  IF isReady(x) THEN\n   TPWrite "ready";\n  ENDIF\n  x := 3 + countOf(strange{2});\n'
        '  x := x + sizeOf("k");\n  p := lookUp(x);\n  MoveJ p, v100, fine, tool0;\n'
        '  %"later"% 3;\n  TPWrite "x " + ValToStr(x);\n ENDPROC\nENDMODULE\n'
    )
    result = load_target([path], BootOptions(cell="infer"))
    assert result.guessed is not None
    named = {one.name: one.type for one in result.guessed.named}
    assert named == {
        "di1": "signaldi",
        "closeGrip": "proc",
        "openPort": "proc",
        "setThing": "proc",
        "isReady": "func bool",
        "sizeOf": "func num",
        "lookUp": "func robtarget",
        "later": "proc",
    }, "what countOf takes is not known, so there is none"
    displayed: list[str] = []
    with VirtualController.boot(result, cycle="once") as controller:
        controller.operator.subscribe(lambda _task, text: displayed.append(text))
        controller.run(max_time=20)
        assert "ERR_REFUNKFUN" in str(controller.task("T_ROB1").fault)
    text = path.read_text().replace("  x := 3 + countOf(strange{2});\n", "")
    path.write_text(text)
    with VirtualController.from_files([path], cell="infer", cycle="once") as controller:
        controller.operator.subscribe(lambda _task, text: displayed.append(text))
        start = controller.positions()
        assert controller.run(max_time=20) == "finished"
        assert displayed == ["x 5"], "a function gives 0, FALSE, and the position of the robot"
        assert controller.positions() == pytest.approx(start, abs=1e-5)


def test_missing_routine_has_optional_arguments_of_calls(tmp_path):
    """A logger of a public cell is called with another level each time."""
    path = tmp_path / "logs.mod"
    path.write_text(
        "MODULE talks\n PROC main()\n"
        '  logs \\Warning \\Origin:="a", "one";\n  logs \\Debug \\Origin:="a", "two";\n'
        '  logs \\Debug, "three" \\Code:=3;\n  logs "four" \\Code:=4 \\Twice;\n'
        '  TPWrite "behind";\n ENDPROC\nENDMODULE\n'
    )
    displayed: list[str] = []
    with VirtualController.from_files([path], cell="infer", cycle="once") as controller:
        controller.operator.subscribe(lambda _task, text: displayed.append(text))
        controller.run(max_time=5)
        assert controller.task("T_ROB1").fault is None
    assert displayed == ["behind"]


def test_missing_trap_does_nothing_and_is_reported(tmp_path):
    path = tmp_path / "calls.mod"
    path.write_text(
        "MODULE calls\n VAR intnum i;\n PROC main()\n  CONNECT i WITH later;\n"
        '  ITimer \\Single, 0.1, i;\n  WaitTime 1;\n  TPWrite "end";\n ENDPROC\nENDMODULE\n'
    )
    result = load_target([path], BootOptions(cell="infer"))
    assert result.guessed is not None
    assert {one.name: one.type for one in result.guessed.named} == {"later": "trap"}
    with VirtualController.boot(result, cycle="once") as controller:
        assert controller.run(max_time=20) == "finished"


ENDS = {
    "what an initial value is made of is a constant": (
        " VAR num count := nParts;\n VAR robtarget p := pHome;\n PROC main()\n"
        "  MoveJ p, v100, fine, tool0;\n  TPWrite ValToStr(count);\n ENDPROC\n",
        "Statement cannot be executed",
    ),
    "an undeclared size is a constant, and as long as the initial value": (
        " VAR num many{maxSources};\n VAR num few{maxParts} := [1,2,3];\n PROC main()\n"
        "  many{3} := few{3};\n  TPWrite ValToStr(Dim(few, 1));\n ENDPROC\n",
        "Statement cannot be executed",
    ),
    "what is divided by is 1": (
        " PROC main()\n  TPWrite ValToStr(nRate + 4 / (GOutput(goSpeed) * nRate));\n ENDPROC\n",
        "ERR_REFUNKDAT",
    ),
    "what is divided by is 1 behind an alias, too": (
        ' VAR signalgo speed;\n PROC main()\n  AliasIO "speed" + ArgName(speed), speed;\n'
        "  TPWrite ValToStr(4 / GOutput(speed));\n ENDPROC\n",
        "ERR_ALIASIO_DEF",
    ),
    "what only a persistent may be is one": (
        ' PROC main()\n  WaitTestAndSet gripLock;\n  TPWrite "mine";\n'
        "  gripLock := FALSE;\n ENDPROC\n",
        "ERR_REFUNKDAT",
    ),
    "no tasks are met that are in no file": (
        ' PERS tasks both{2} := [["T_ROB_L"],["T_ROB_R"]];\n VAR syncident sync1;\n'
        " PROC main()\n  WaitSyncTask sync1, both;\n ENDPROC\n",
        "ERR_TASKNAME",
    ),
    "a tool that another task would fill is tool0": (
        " PERS tooldata grip;\n PERS wobjdata table;\n VAR robtarget p;\n PROC main()\n"
        "  p := CRobT(\\Tool:=grip \\WObj:=table);\n"
        "  MoveL p, v100, fine, grip \\WObj:=table;\n ENDPROC\n",
        "Tool and work object contradict",
    ),
    "an undescribed unit carries its work objects": (
        ' PERS wobjdata plate := [FALSE,FALSE,"STN1",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n'
        " VAR robtarget p;\n PROC main()\n  ActUnit STN1;\n  p := CRobT(\\WObj:=plate);\n"
        "  MoveL p, v100, fine, tool0 \\WObj:=plate;\n ENDPROC\n",
        "ERR_REFUNKDAT",
    ),
    "a signal may be named by a text": (
        " VAR signaldo grip;\n PROC main()\n"
        '  AliasIO "hand_" + ArgName(grip), grip;\n  SetDO grip, 1;\n ENDPROC\n',
        "ERR_ALIASIO_DEF",
    ),
}
"""Programs that end in a guessed cell, and the error with which each stops without one."""


@pytest.mark.parametrize("name", ENDS)
def test_a_program_ends_in_a_guessed_cell_alone(name, tmp_path):
    text, lacks = ENDS[name]
    path = tmp_path / "ends.mod"
    path.write_text(f"MODULE ends\n{text}ENDMODULE\n")
    with VirtualController.from_files([path], cell="infer", cycle="once") as controller:
        assert controller.run(max_time=20) == "finished"
        assert controller.task("T_ROB1").fault is None
        assert controller.signals.get("hand_grip", 1) == 1
    with VirtualController.from_files([path], cycle="once") as controller:
        controller.run(max_time=20)
        assert lacks in str(controller.task("T_ROB1").fault)


def test_undeclared_array_size_is_constant(tmp_path):
    """The size is that of an initial value, if there is one."""
    path = tmp_path / "sizes.mod"
    path.write_text(
        "MODULE sizes\n VAR num many{maxSources};\n VAR num few{maxParts} := [1,2,3];\n"
        " PROC main()\n  FOR i FROM 1 TO maxParts DO\n   many{i} := few{i};\n  ENDFOR\n"
        "  TPWrite ValToStr(Dim(few, 1) + many{3});\n ENDPROC\nENDMODULE\n"
    )
    result = load_target([path], BootOptions(cell="infer"))
    assert [d for d in check(result.system, gaps=True) if d.severity is Severity.ERROR] == []
    displayed: list[str] = []
    with VirtualController.boot(result, cycle="once") as controller:
        controller.operator.subscribe(lambda _task, text: displayed.append(text))
        controller.run(max_time=5)
    assert displayed == ["6"]


FAR = """MODULE far
 CONST robtarget near := [[374,0,630],[0.707107,0,0.707107,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
 CONST robtarget turned := [[374,0,600],[0.707107,0,0.707107,0],[2,2,2,1],
   [9E9,9E9,9E9,9E9,9E9,9E9]];
 CONST robtarget away := [[9000,0,600],[0.707107,0,0.707107,0],[0,0,0,0],
   [9E9,9E9,9E9,9E9,9E9,9E9]];
 PROC main()
  MoveJ near, v500, fine, tool0;
  MoveL turned, v500, fine, tool0;
  MoveLDO away, v500, fine, tool0, doThere, 1;
  MoveAbsJ [[400,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v500, fine, tool0;
  MoveL near, v500, fine, tool0;
  TPWrite "done";
 ENDPROC
ENDMODULE
"""


def test_inferred_robot_reports_missed_targets(tmp_path):
    path = tmp_path / "far.mod"
    path.write_text(FAR)
    with VirtualController.from_files([path], cell="infer", cycle="once") as controller:
        assert controller.run(max_time=60) == "finished"
        assert controller.guessed.missed == [
            ("far.mod:9", "by its axes, in the nearest configuration"),
            ("far.mod:10", "not at all"),
            ("far.mod:11", "not at all"),
        ]
        assert controller.signals["doThere"] == 1, "what a move does on its way is done"


def test_chosen_robot_stops_at_unreachable_target(tmp_path):
    path = tmp_path / "far.mod"
    path.write_text(FAR)
    with VirtualController.from_files(
        [path], cell="infer", robot="irb120", cycle="once"
    ) as controller:
        controller.run(max_time=60)
        assert str(controller.task("T_ROB1").fault) == "Close to singularity"
        assert controller.guessed.missed == []


def test_hands_of_a_guessed_cell_are_calibrated(tmp_path):
    path = tmp_path / "grips.mod"
    path.write_text("MODULE grips\n PROC main()\n  g_GripIn;\n ENDPROC\nENDMODULE\n")
    for cell in ("infer", ""):
        with VirtualController.from_files(
            [path], cell=cell, robot="irb14000", cycle="once"
        ) as controller:
            controller.run(max_time=60)
            assert (controller.task("T_ROB1").fault is None) is (cell == "infer")


def test_inputs_of_backup_are_inferred_without_crossings(tmp_path):
    for name, text in {
        "SYSPAR/SYS.cfg": 'SYS:CFG_1.0:6:0::\n#\nCAB_TASKS:\n\n -Name "T_ROB1" -MotionTask\n',
        "SYSPAR/EIO.cfg": "EIO:CFG_1.0:6:1::\n#\nEIO_SIGNAL:\n\n"
        ' -Name "diPart" -SignalType "DI"\n\n -Name "diBoth" -SignalType "DI"\n\n'
        ' -Name "doA" -SignalType "DO"\n#\nEIO_CROSS:\n\n -Res "diBoth" -Act1 "doA"\n',
        "RAPID/TASK1/PROGMOD/waits.mod": "MODULE waits\n PROC main()\n  WaitDI diPart, 1;\n"
        "  WHILE diPart = 1 DO\n   WaitTime 0.1;\n  ENDWHILE\n  WaitDI diBoth, 1;\n ENDPROC\n"
        "ENDMODULE\n",
    }.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    with VirtualController.boot(load_target([tmp_path], BootOptions(cell="infer"))) as controller:
        assert controller.run(max_time=20) == "deadlock"
        assert controller.guessed.answered == [("diPart", 1), ("diPart", 0)]
        assert "waits for diBoth = 1" in controller.where()[0]
