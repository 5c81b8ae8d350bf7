"""Polled data in an inferred cell are set in turn."""

import pytest

from rapidgen.controller import VirtualController
from rapidgen.controller.inference.restarts import run_past_stops

PROGRAM = """MODULE flag
 PERS bool bStart := FALSE;
 PERS num nOrder := 0;
 PERS bool bNew := FALSE;
 PERS bool bDone := FALSE;
 VAR num loops;
 PROC main()
  WaitUntil bStart;
  TPWrite "started";
  WHILE NOT bDone DO
   IF nOrder = 3 THEN
    TPWrite "three";
    WaitUntil nOrder = 0;
    loops := loops + 1;
   ELSEIF bNew THEN
    TPWrite "new";
    bNew := FALSE;
    loops := loops + 1;
   ENDIF
   bDone := loops >= 2;
   WaitTime 0.1;
  ENDWHILE
 ENDPROC
ENDMODULE
"""


def run(tmp_path, text, cell):
    path = tmp_path / "flag.mod"
    path.write_text(text)
    displayed: list[str] = []
    with VirtualController.from_files([path], cell=cell, cycle="once") as controller:
        controller.operator.subscribe(lambda _task, line: displayed.append(line))
        finished = controller.run(max_time=60)
        return finished, displayed, controller.guessed.answered


def test_polled_data_get_expected_values_and_are_reported(tmp_path):
    finished, displayed, answered = run(tmp_path, PROGRAM, "infer")
    assert finished == "finished"
    assert displayed == ["started", "three", "new"]
    given = [("bStart", "TRUE"), ("nOrder", "3"), ("nOrder", "0"), ("bNew", "TRUE")]
    assert answered == given


def test_data_set_by_program_are_unchanged(tmp_path):
    text = PROGRAM.replace("  WaitUntil bStart;", "  bStart := TRUE;\n  WaitUntil bStart;")
    _, _, answered = run(tmp_path, text, "infer")
    assert "bStart" not in [name for name, _ in answered]
    assert "bDone" not in [name for name, _ in answered]


def test_data_without_inference_are_unchanged(tmp_path):
    finished, displayed, answered = run(tmp_path, PROGRAM, "")
    assert (finished, displayed, answered) == ("time", [], [])


TOGETHER = {
    "two at once": 'IF bAuto AND nPart = 3 THEN\n TPWrite "both";\n EXIT;\nENDIF\n',
    "one inside the other": "IF bAuto THEN\n IF 3 = nPart THEN\n  EXIT;\n ENDIF\nENDIF\n",
    "in parentheses": "IF (bAuto) EXIT;\n",
    "in a routine that the loop calls": "look;\n",
    "in a function that the loop asks": "IF asked() EXIT;\n",
    "a copy": "nCopy := 0;\nnCopy := nPart;\nIF nCopy > 5 EXIT;\n",
    "what an interrupt watches": "IDelete i;\nCONNECT i WITH t;\nIPers bAuto, i;\nIF bAuto EXIT;\n",
    "what leaves a loop": "WHILE NOT bAuto DO\n WaitTime 0.1;\nENDWHILE\nEXIT;\n",
    "inputs together": "IF diDoor = 1 AND diPart = 1 EXIT;\n",
    "inputs that a routine reads": "IF DInput(diDoor) = 1 press;\n",
    "what an interrupt waits for": "IDelete i;\nCONNECT i WITH t;\nISignalDI diLid, 1, i;\n",
    "an output that is waited for": "WaitDO doMotorOn, 1;\nEXIT;\n",
    "an output that the system sets": "IF DOutput(doMotorOn) = 1 EXIT;\n",
}


@pytest.mark.parametrize("name", TOGETHER)
def test_combined_condition_becomes_true(name, tmp_path):
    text = (
        "MODULE flag\n PERS bool bAuto := FALSE;\n PERS num nPart := 0;\n VAR num nCopy;\n"
        " VAR intnum i;\n PROC main()\n  WHILE TRUE DO\n"
        f"{TOGETHER[name]}   WaitTime 0.1;\n  ENDWHILE\n ENDPROC\n"
        " TRAP t\n  IF diPart = 1 EXIT;\n ENDTRAP\n"
        " PROC look()\n  IF bAuto EXIT;\n ENDPROC\n PROC press()\n  IF diPart = 1 EXIT;\n"
        " ENDPROC\n FUNC bool asked()\n  RETURN nPart = 4 AND NOT (NOT bAuto);\n ENDFUNC\n"
        "ENDMODULE\n"
    )
    finished, _, answered = run(tmp_path, text, "infer")
    assert finished == "finished"
    assert answered


STOPS = """MODULE stops
 VAR num n;
 PROC main()
  n := n + 1;
  Stop;
  TPWrite "on";
  IF n < 60 main;
 ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize(("cell", "starts"), [("infer", 50), ("", 0)])
def test_program_is_started_after_stop(cell, starts, tmp_path):
    path = tmp_path / "stops.mod"
    path.write_text(STOPS)
    with VirtualController.from_files([path], cell=cell, cycle="once") as controller:
        run_past_stops(controller, max_time=60)
        assert controller.guessed.answered == [("Stop at stops.mod:5", "start")] * starts


FAILS = """MODULE fails
 PROC main()
  WaitDI diStart, 1;
  WaitDI diStart, 0;
  MoveAbsJ [[0,0,0,165,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v500, fine, tool0;
 ENDPROC
ENDMODULE
"""


def test_program_failing_after_all_answers_fails(tmp_path):
    path = tmp_path / "fails.mod"
    path.write_text(FAILS)
    with VirtualController.from_files([path], robot="irb120", cell="infer", cycle="once") as driven:
        run_past_stops(driven, max_time=600)
        (task,) = driven.tasks.values()
        assert task.fault is not None
        (why,) = task.fault.arguments
        assert task.fault.event == 50_050
        assert "rax_4" in why
        assert driven.guessed.stopped == [("fails.mod:5", why)] * 50
