"""Values of an inferred cell: records, shared data, ports, disks and default data."""

import pytest

from rapidgen.controller import VirtualController
from rapidgen.controller.boot_targets import BootOptions, load_target
from rapidgen.controller.inference.restarts import run_past_stops


def inferred(tmp_path, body, data=""):
    path = tmp_path / "m.mod"
    path.write_text(f"MODULE m\n{data}\nPROC main()\n{body}\nENDPROC\nENDMODULE\n")
    result = load_target([path], BootOptions(cell="infer"))
    names = {one.name: one.type for one in result.guessed.named}
    return names | {one.name: "" for one in result.guessed.unknown}


@pytest.mark.parametrize(
    ("body", "kind"),
    [
        ("a.v_leax := 5000;\ngoThere 1, a;", "speeddata"),
        ("a.v_tcp := 5;", "speeddata"),
        ("TPWrite ValToStr(a.v_ori);", "speeddata"),
        ("a.trans.x := 5;", "robtarget"),
        ("a.rot := [1,0,0,0];", "robtarget"),
        ("a.robconf.cf1 := 1;", "robtarget"),
        ("a.extax.eax_a := 1;", "robtarget"),
        ("a.robax.rax_1 := 1;", "jointtarget"),
        ("a.extax.eax_a := 1;\na.trans.x := 1;", "robtarget"),
        ("a.tframe.trans.z := 1;", "tooldata"),
        ("a.uframe := [[0,0,0],[1,0,0,0]];", "wobjdata"),
        ("a.mass := 1;", "loaddata"),
        ("a.x := 1;", "pos"),
        ("a.trans.x := 1;\nb := PoseInv(a);", "pose"),
        ("a.no_such_component := 1;", ""),
        ("a.x.y := 1;", ""),
    ],
)
def test_components_decide_the_type(tmp_path, body, kind):
    assert inferred(tmp_path, body).get("a") == kind


def test_an_undeclared_record_is_executed(tmp_path):
    path = tmp_path / "m.mod"
    path.write_text(
        "MODULE m\nPROC main()\nmySpeed.v_leax := 5000;\ngoThere 1, mySpeed;\n"
        "TPWrite ValToStr(mySpeed.v_tcp);\nENDPROC\nENDMODULE\n"
    )
    displayed = []
    with VirtualController.from_files([path], cell="infer", cycle="once") as controller:
        controller.operator.subscribe(lambda _task, text: displayed.append(text))
        assert controller.run(max_time=5) == "finished"
    assert displayed == ["100"]


WATCHER = """MODULE watcher
    PERS num place;
    PROC main()
        WHILE place <> 7 DO
            WaitTime 0.1;
        ENDWHILE
        TPWrite "end " + ValToStr(place);
    ENDPROC
ENDMODULE
"""
WORKER = """MODULE worker
    PERS num place := 3;
    PROC main()
        FOR i FROM 1 TO 60 DO
            WaitTime 0.1;
            IF place <> 3 TPWrite "changed";
        ENDFOR
        place := %s;
    ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize("value", ["7", "3 + 4", "Trunc(7.5)"])
def test_a_datum_that_another_task_sets_is_not_inferred(tmp_path, value):
    (tmp_path / "watcher.mod").write_text(WATCHER)
    (tmp_path / "worker.mod").write_text(WORKER % value)
    tasks = {"T_ROB1": [tmp_path / "worker.mod"], "T_LOOK": [tmp_path / "watcher.mod"]}
    displayed = []
    target = load_target([], BootOptions(tasks=tasks, cell="infer"))
    with VirtualController.boot(target, cycle="once") as controller:
        controller.operator.subscribe(lambda _task, text: displayed.append(text))
        assert controller.run(max_time=30) == "finished"
        assert controller.guessed.answered == []
    assert displayed == ["end 7"]


def test_a_datum_of_one_task_is_still_inferred(tmp_path):
    (tmp_path / "watcher.mod").write_text(WATCHER)
    with VirtualController.from_files([tmp_path / "watcher.mod"], cell="infer") as controller:
        controller.run(max_time=5)
        assert ("place", "7") in controller.guessed.answered


def test_ports_and_speeds_are_usable(tmp_path):
    path = tmp_path / "m.mod"
    path.write_text(
        "MODULE m\nVAR socketdev s;\nVAR socketdev t;\nPERS speeddata fast;\nPERS loaddata part;\n"
        'PROC main()\nSocketCreate s;\nSocketBind s, "127.0.0.1", nPort;\nSocketListen s;\n'
        'SocketCreate t;\nSocketBind t, "127.0.0.1", nOther;\nSocketListen t;\n'
        'TPWrite ValToStr(nPort) + " " + ValToStr(nOther) + " " + ValToStr(fast.v_tcp);\n'
        "GripLoad part;\nMoveJ Offs(CRobT(), 0, 0, 1), fast, fine, tool0;\nENDPROC\nENDMODULE\n"
    )
    displayed = []
    with VirtualController.from_files([path], cell="infer", cycle="once") as controller:
        controller.operator.subscribe(lambda _task, text: displayed.append(text))
        assert controller.run(max_time=20) == "finished"
        assert controller.task("T_ROB1").fault is None
    assert displayed == ["4100 4101 100"]


def test_a_disk_of_a_computer_is_an_empty_folder(tmp_path):
    path = tmp_path / "m.mod"
    path.write_text(
        'MODULE m\nVAR iodev f;\nPROC main()\nOpen "C:/a.txt", f \\Write;\n'
        'Write f, "x";\nClose f;\n'
        'Open "pc:b.txt", f \\Write;\nClose f;\nTPWrite ValToStr(FileSize("C:/a.txt"));\n'
        "ENDPROC\nENDMODULE\n"
    )
    displayed = []
    with VirtualController.from_files([path], cell="infer", cycle="once") as controller:
        controller.operator.subscribe(lambda _task, text: displayed.append(text))
        assert controller.run(max_time=5) == "finished"
        assert controller.task("T_ROB1").fault is None
        assert controller.guessed.disks == ["c:", "pc:"]
        assert controller.files.path("C:/a.txt").is_relative_to(controller.files.folder)
    assert displayed == ["2"]
    with VirtualController.from_files([path], cycle="once") as controller:
        controller.run(max_time=5)
        assert controller.task("T_ROB1").fault is not None


BUILT_IN = (
    "ExecEngine;\nCSSAct \\RefFrame:=1;\nCSSDeact;\nCyclicBrakeCheck;\nLinked_m_exe;\n"
    "LoadIdentify;\nTuneServo ROB_1, 1, 110;\nn := PMgrAtStation();\n"
)


def test_built_in_routines_that_are_not_simulated_do_nothing(tmp_path):
    names = inferred(tmp_path, BUILT_IN, "VAR num n;")
    assert set(names) == {
        "ExecEngine", "CSSAct", "CSSDeact", "CyclicBrakeCheck", "Linked_m_exe", "LoadIdentify",
        "TuneServo", "PMgrAtStation",
    }  # fmt: skip
    assert set(names.values()) == {"proc, not simulated", "func num, not simulated"}
    with VirtualController.from_files([tmp_path / "m.mod"], cell="infer", cycle="once") as one:
        assert one.run(max_time=5) == "finished"
        assert one.task("T_ROB1").fault is None
        assert not [d for d in one.diagnostics if d.code == "RG403"]
    with VirtualController.from_files([tmp_path / "m.mod"], cycle="once") as one:
        one.run(max_time=5)
        assert "ExecEngine" in str(one.task("T_ROB1").fault)


def test_tune_reset_has_nothing_to_reset(tmp_path):
    path = tmp_path / "m.mod"
    path.write_text("MODULE m\nPROC main()\nTuneReset;\nENDPROC\nENDMODULE\n")
    with VirtualController.from_files([path], cycle="once") as controller:
        assert controller.run(max_time=5) == "finished"
        assert controller.task("T_ROB1").fault is None


def executed(tmp_path, body, data=""):
    """Return what a program displays, the answers that it got, and how it ended."""
    path = tmp_path / "m.mod"
    path.write_text(f"MODULE m\n{data}\nPROC main()\n{body}\nENDPROC\nENDMODULE\n")
    displayed = []
    target = load_target([path], BootOptions(cell="infer"))
    with VirtualController.boot(target, cycle="once", autostart=False) as controller:
        controller.operator.subscribe(lambda _task, text: displayed.append(text))
        controller.start_program()
        end = run_past_stops(controller, max_time=60)
        return displayed, controller.guessed, end


def test_function_that_a_program_waits_for_gets_a_value(tmp_path):
    body = "WaitUntil IsReady();\nWHILE Count(1) < 3 DO\nWaitTime 0.1;\nENDWHILE\n"
    body += "WaitUntil NOT Busy();"
    displayed, guessed, end = executed(tmp_path, body + '\nTPWrite "on";')
    assert (displayed, end) == (["on"], "finished")
    assert guessed.answered[0] == ("IsReady()", "TRUE")
    assert ("Count()", "3") in guessed.answered


def test_declared_function_is_never_inferred(tmp_path):
    path = tmp_path / "m.mod"
    path.write_text(
        "MODULE m\nPROC main()\nWaitUntil IsReady();\nENDPROC\n"
        "FUNC bool IsReady()\nRETURN FALSE;\nENDFUNC\nENDMODULE\n"
    )
    with VirtualController.from_files([path], cell="infer", cycle="once") as controller:
        assert controller.run(max_time=60) == "time"
        assert controller.guessed.answered == []


def test_undeclared_arrays_are_executed(tmp_path):
    body = (
        "MoveAbsJ places{2}, v100, fine, tool0;\ncounts{3} := 4;\n"
        "TPWrite ValToStr(counts{3} + counts{1});\nTPWrite texts{1,2};"
    )
    displayed, _, end = executed(tmp_path, body)
    assert (displayed, end) == (["4", ""], "finished")
    names = inferred(tmp_path, body)
    assert (names["places"], names["counts"]) == ("jointtarget{*}", "num{*}")
    assert names["texts"] == "string{*,*}"


def test_undeclared_array_has_the_size_of_its_aggregate(tmp_path):
    body = "places := [5, 6, 7];\nplaces{2} := 1;\nTPWrite ValToStr(places) + texts{4};"
    displayed, _, end = executed(tmp_path, body)
    assert (displayed, end) == (["[5,1,7]"], "finished")


def test_late_call_of_missing_routine_does_nothing(tmp_path):
    body = 'job := "DoIt";\n%job%;\nTPWrite "done";'
    displayed, _, end = executed(tmp_path, body, "VAR string job;")
    assert (displayed, end) == (["done"], "finished")
    assert inferred(tmp_path, body, "VAR string job;")["DoIt"] == "proc"


STOPPING = """MODULE m2
PROC main()
WHILE TRUE DO
WaitTime 2;
Stop;
ENDWHILE
ENDPROC
ENDMODULE
"""


def test_a_task_at_its_stop_does_not_use_up_the_restarts(tmp_path):
    main, other = tmp_path / "m.mod", tmp_path / "m2.mod"
    main.write_text(
        'MODULE m\nVAR num n;\nPROC main()\nTPReadNum n, "n";\nTPWrite ValToStr(1 / (n - 1));\n'
        "ENDPROC\nENDMODULE\n"
    )
    other.write_text(STOPPING)
    tasks = {"T_ROB1": [main], "T_IO": [other]}
    displayed = []
    target = load_target([], BootOptions(tasks=tasks, cell="infer"))
    with VirtualController.boot(target, cycle="once", autostart=False) as controller:
        controller.operator.subscribe(lambda _task, text: displayed.append(text))
        controller.start_program()
        run_past_stops(controller, max_time=60)
    assert "1" in displayed  # the second answer: 1 / (2 - 1)


FIRST_MOVE = """MODULE m
CONST robtarget p := [[400,0,500],[0,0,1,0],[0,0,2,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
PROC main()
MoveL p, v100, fine, tool0;
TPWrite "there";
ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize("start", [(), (0, 0, 0, 0, 30, 0)])
def test_first_move_from_an_assumed_position_goes_by_axes(tmp_path, start):
    path = tmp_path / "m.mod"
    path.write_text(FIRST_MOVE)
    target = load_target([path], BootOptions(cell="infer", robot="irb1200", start=start))
    displayed = []
    with VirtualController.boot(target, cycle="once", autostart=False) as controller:
        controller.operator.subscribe(lambda _task, text: displayed.append(text))
        controller.start_program()
        controller.run(max_time=60)
        missed = controller.guessed.missed
    assert displayed == ([] if start else ["there"])
    assert len(missed) == (0 if start else 1)
