"""Data that a program waits for and nothing in it sets: in a guessed cell they are set in turn."""

from rapidgen.controller import VirtualController

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
    shown: list[str] = []
    with VirtualController.from_files([path], cell=cell, cycle="once") as controller:
        controller.operator.subscribe(lambda _task, line: shown.append(line))
        ended = controller.run(max_time=60)
        return ended, shown, controller.guessed.answered


def test_each_becomes_what_it_is_looked_at_for_and_is_told(tmp_path):
    ended, shown, answered = run(tmp_path, PROGRAM, "guess")
    assert ended == "finished"
    assert shown == ["started", "three", "new"]
    assert answered == [("bStart", "TRUE"), ("nOrder", "3"), ("bNew", "TRUE")]


def test_what_the_program_sets_itself_is_left_alone(tmp_path):
    text = PROGRAM.replace("  WaitUntil bStart;", "  bStart := TRUE;\n  WaitUntil bStart;")
    _, _, answered = run(tmp_path, text, "guess")
    assert "bStart" not in [name for name, _ in answered]
    assert "bDone" not in [name for name, _ in answered]


def test_without_a_guess_nobody_sets_it(tmp_path):
    ended, shown, answered = run(tmp_path, PROGRAM, "")
    assert (ended, shown, answered) == ("time", [], [])
