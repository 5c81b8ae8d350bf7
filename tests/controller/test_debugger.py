"""Breakpoints, steps, stacks and values; time stops during a pause."""

import threading

import pytest

from rapidgen.controller import VirtualController
from rapidgen.controller.debugger import Breakpoint, Debugger, NotPaused
from rapidgen.controller.debugger.stack import where_it_looks
from rapidgen.controller.debugger.values import evaluate

PROGRAM = """MODULE m
  PERS num total := 0;
  VAR pos corner := [1,2,3];
  CONST num limit := 4;
  PROC main()
    VAR num i := 0;
    VAR string word := "a";
    WHILE TRUE DO
      i := i + 1;
      work i, word;
      WaitTime 0.5;
    ENDWHILE
  ENDPROC
  PROC work(num n, string text)
    VAR num half;
    half := n / 2;
    FOR k FROM 1 TO 3 DO
      total := total + k;
    ENDFOR
    corner.x := corner.x + twice(n);
  ENDPROC
  FUNC num twice(num v)
    RETURN 2 * v;
  ENDFUNC
ENDMODULE
"""


@pytest.fixture
def boot(tmp_path):
    opened = []

    def one(text=PROGRAM, **options):
        path = tmp_path / "m.mod"
        path.write_text(text)
        controller = VirtualController.from_files([path], **options)
        opened.append(controller)
        return controller, Debugger(controller)

    yield one
    for controller in opened:
        controller.close()


def line(debugger):
    assert debugger.halt is not None
    assert debugger.halt.place is not None
    return debugger.halt.place.span.line


def test_a_breakpoint_holds_everything_before_its_line(boot):
    controller, debugger = boot()
    assert debugger.add(Breakpoint("m", 18)).line == 18
    controller.run_for(1.0)
    assert (debugger.halt.reason, line(debugger)) == ("breakpoint", 18)
    assert controller.task("T_ROB1")["m:total"] == 0
    held = controller.now
    controller.run_for(1.0)
    assert not controller.run_until(lambda: False, timeout=1.0)
    assert controller.run(max_time=1.0) == "paused"
    assert controller.now == held
    debugger.resume()
    controller.run_for(1.0)
    assert controller.task("T_ROB1")["m:total"] == 1


def test_a_line_without_a_statement_is_moved_down(boot):
    _, debugger = boot()
    assert debugger.add(Breakpoint("M", 15)).line == 16
    nowhere = debugger.add(Breakpoint("m", 25))
    assert (nowhere.line, nowhere.doubt) == (0, "no statement begins there")
    assert debugger.add(Breakpoint("other", 3)).doubt


def test_steps(boot):
    controller, debugger = boot()
    debugger.add(Breakpoint("m", 10))
    controller.run_for(1.0)
    lines = []
    for kind in ("in", *["over"] * 8, "in", "out"):
        debugger.step("T_ROB1", kind)
        controller.run_for(1.0)
        lines.append(line(debugger))
    assert lines == [16, 17, 18, 18, 18, 20, 11, 9, 10, 16, 11]
    with pytest.raises(NotPaused, match="outermost"):
        debugger.step("T_ROB1", "out")


def test_stack_values_and_setting_them(boot):
    controller, debugger = boot()
    number = debugger.add(Breakpoint("m", 18)).number
    controller.run_for(1.0)
    assert [f.routine.name for f in debugger.frames("T_ROB1")] == ["main", "work"]
    displayed = {v.name: (v.type, v.text) for v in debugger.variables("T_ROB1")}
    assert displayed == {
        "k": ("num", "1"),
        "n": ("num", "1"),
        "text": ("string", '"a"'),
        "half": ("num", "0.5"),
    }
    assert debugger.evaluate("T_ROB1", "n * 10 + k + limit").text == "15"
    assert debugger.evaluate("T_ROB1", "corner").text == "[1,2,3]"
    assert debugger.evaluate("T_ROB1", "i", level=0).text == "1"
    assert debugger.evaluate("T_ROB1", "StrLen(text) = 1").text == "TRUE"
    with pytest.raises(NotPaused, match="not known here"):
        debugger.evaluate("T_ROB1", "i")
    with pytest.raises(NotPaused, match="calls a routine"):
        debugger.evaluate("T_ROB1", "twice(1)")
    with pytest.raises(NotPaused, match="can be assigned"):
        debugger.assign("T_ROB1", "limit", "5")
    with pytest.raises(NotPaused, match="ERR_DIVZERO"):
        debugger.evaluate("T_ROB1", "1 / (n - 1)")
    assert debugger.assign("T_ROB1", "n", "2.5").text == "2.5"
    assert debugger.assign("T_ROB1", "corner.y", "n").text == "2.5"
    assert debugger.assign("T_ROB1", "total", "100").text == "100"
    assert debugger.assign("T_ROB1", "i", "7", level=0).text == "7"
    debugger.remove(number)
    debugger.add(Breakpoint("m", 10))
    debugger.resume()
    controller.run_for(1.0)
    assert controller.task("T_ROB1")["m:total"] == 106
    assert debugger.evaluate("T_ROB1", "corner").text == "[6,2.5,3]"
    assert debugger.evaluate("T_ROB1", "i").text == "8"


@pytest.mark.parametrize(
    ("hits", "expected"), [("", [1, 2, 3, 4, 5]), ("3", [3]), (">=4", [4, 5]), ("%2", [2, 4])]
)
def test_passes(boot, hits, expected):
    controller, debugger = boot()
    debugger.add(Breakpoint("m", 10, hits=hits))
    result = []
    while controller.now < 2.3:
        controller.run_for(2.4 - controller.now)
        if debugger.halt is not None:
            result.append(int(debugger.evaluate("T_ROB1", "i").text))
            debugger.resume()
    assert result == expected


def test_condition_and_log_point(boot):
    controller, debugger = boot()
    debugger.add(Breakpoint("m", 10, condition="i = 3"))
    debugger.add(Breakpoint("m", 18, condition="k = 2", log="n is {n}, k {k}."))
    controller.run_for(5.0)
    assert debugger.evaluate("T_ROB1", "i").text == "3"
    assert [t.text for t in debugger.output] == ["n is 1, k 2.", "n is 2, k 2."]
    with pytest.raises(ValueError, match="passes"):
        debugger.add(Breakpoint("m", 10, hits="often"))


def test_faulty_condition_pauses_with_reason(boot):
    controller, debugger = boot()
    debugger.add(Breakpoint("m", 10, condition="missing > 3"))
    controller.run_for(1.0)
    assert "missing is not known here" in debugger.halt.text


def test_running_routine_stops_at_new_breakpoint(boot):
    """main never returns: it continues in other code, without repetition."""
    controller, debugger = boot()
    controller.run_for(1.2)  # in the third WaitTime
    assert debugger.add(Breakpoint("m", 9)).doubt == ""
    controller.run_for(1.0)
    assert (debugger.halt.reason, line(debugger)) == ("breakpoint", 9)
    assert controller.now == pytest.approx(1.5, abs=1e-3)
    assert debugger.evaluate("T_ROB1", "i").text == "3"
    assert controller.task("T_ROB1")["m:total"] == 18


def test_run_to_cursor_and_pause(boot):
    controller, debugger = boot()
    with pytest.raises(NotPaused, match="nothing is paused"):
        debugger.resume()
    controller.run_for(0.7)
    debugger.pause()
    assert debugger.halt.reason == "pause"
    assert debugger.program_pointer("T_ROB1").span.line == 11
    debugger.run_to("T_ROB1", "m", 20)
    controller.run_for(2.0)
    assert (debugger.halt.reason, line(debugger)) == ("cursor", 20)
    debugger.step("T_ROB1", "in")
    controller.run_for(2.0)
    assert [f.routine.name for f in debugger.frames("T_ROB1")] == ["main", "work", "twice"]
    debugger.step("T_ROB1", "out")
    controller.run_for(2.0)
    assert line(debugger) == 11


TRAP = """MODULE m
  VAR intnum timer;
  VAR num i := 0;
  VAR num traps := 0;
  PROC main()
    CONNECT timer WITH tick;
    ITimer 0.1, timer;
    WHILE TRUE DO
      i := i + 1;
      WaitTime 0.25;
    ENDWHILE
  ENDPROC
  TRAP tick
    traps := traps + 1;
    i := i + 100;
  ENDTRAP
ENDMODULE
"""


def test_step_skips_trap_without_breakpoint(boot):
    controller, debugger = boot(TRAP)
    at = debugger.add(Breakpoint("m", 10)).number
    controller.run_for(1.0)
    debugger.step("T_ROB1", "in")
    controller.run_for(1.0)
    assert line(debugger) == 9
    assert controller.task("T_ROB1")["m:traps"] == 2
    debugger.remove(at)
    debugger.add(Breakpoint("m", 15))
    debugger.resume()
    controller.run_for(1.0)
    frames = debugger.frames("T_ROB1")
    assert [(f.routine.name, f.level) for f in frames] == [("main", "program"), ("tick", "trap")]
    assert debugger.program_pointer("T_ROB1").span.line in (9, 10)


FAULTY = """MODULE m
  VAR num zero := 0;
  VAR num x := 5;
  PROC main()
    VAR num mine := 7;
    x := guarded(zero);
    x := mine / zero;
    x := 9;
  ENDPROC
  FUNC num guarded(num d)
    RETURN 1 / d;
  ERROR
    RETURN 0;
  ENDFUNC
ENDMODULE
"""


def test_stop_on_error(boot):
    controller, debugger = boot(FAULTY, cycle="once")
    debugger.errors = "unhandled"
    controller.run_for(1.0)
    assert (debugger.halt.reason, line(debugger)) == ("error", 7)
    assert "ERR_DIVZERO" in debugger.halt.text
    assert debugger.evaluate("T_ROB1", "mine").text == "7"
    debugger.assign("T_ROB1", "zero", "2")
    debugger.resume()
    controller.run_for(0.1)
    controller.start_program()
    controller.run_for(1.0)
    assert controller.task("T_ROB1")["m:x"] == 9


def test_handled_error_pauses(boot):
    controller, debugger = boot(FAULTY, cycle="once")
    debugger.errors = "all"
    controller.run_for(1.0)
    assert (line(debugger), debugger.halt.text) == (11, "ERR_DIVZERO")
    assert debugger.evaluate("T_ROB1", "d").text == "0"


def test_idle_task_has_data_without_variables(boot):
    controller, _ = boot(autostart=False)
    task = controller.rapid_tasks["T_ROB1"]
    frame = where_it_looks(task)
    assert evaluate(task.program, frame, "corner.y + limit").text == "6"
    with pytest.raises(NotPaused, match="not being executed"):
        evaluate(task.program, frame, "i")


def test_nothing_is_reported_without_breakpoints(boot):
    controller, debugger = boot()
    controller.run_for(1.0)
    task = controller.rapid_tasks["T_ROB1"]
    assert not task.program.options.tracing
    assert not controller.statements.tracers
    number = debugger.add(Breakpoint("m", 10)).number
    assert task.program.options.tracing
    debugger.remove(number)
    assert not controller.statements.tracers


def test_a_debugger_changes_no_time(boot):
    times = []
    for debugged in (False, True):
        controller, debugger = boot()
        if debugged:
            debugger.add(Breakpoint("m", 18))
        while controller.now < 1.9:
            controller.run_for(2.0 - controller.now)
            if debugger.halt is not None:
                debugger.resume()
        times.append((controller.now, controller.task("T_ROB1")["m:total"]))
    assert times[0] == times[1]


def test_paused_real_clock_serves_requests(boot):
    controller, debugger = boot(clock="real")
    halted = threading.Event()
    debugger.changed.add(lambda: halted.set() if debugger.halt is not None else None)
    debugger.add(Breakpoint("m", 9, hits=">=2"))
    controller.start()
    assert halted.wait(30)
    held = controller.call(lambda: controller.now)
    for _ in range(20):
        assert controller.call(lambda: debugger.evaluate("T_ROB1", "i").text) == "1"
    assert controller.call(lambda: controller.now) == held
    halted.clear()
    controller.call(debugger.resume)
    assert halted.wait(30)
    assert controller.call(lambda: controller.now) == pytest.approx(held + 0.5, abs=0.01)
    controller.stop()


JUMPS = """MODULE m
  PERS num n := 0;
  PROC main()
  again:
    n := n + 1;
    WaitTime 0.1;
    work;
    GOTO again;
  ENDPROC
  PROC work()
    n := n + 10;
  ENDPROC
ENDMODULE
"""


def test_unreachable_routine_is_reported(boot):
    controller, debugger = boot(JUMPS)
    controller.run_for(0.55)
    assert "GOTO" in debugger.add(Breakpoint("m", 5)).doubt
    debugger.add(Breakpoint("m", 11))
    controller.run_for(1.0)
    assert line(debugger) == 11, "routines that it calls are noticed"
    assert controller.task("T_ROB1")["m:n"] == 56


NESTED = """MODULE m
  PERS num n := 0;
  PROC main()
    FOR i FROM 1 TO 3 DO
      outer i;
    ENDFOR
  ENDPROC
  PROC outer(num a)
    VAR num sum := 0;
    WHILE sum < 20 DO
      IF added(a) > 0 THEN
        sum := sum + a + 5;
      ELSE
        n := -1000;
      ENDIF
    ENDWHILE
  ENDPROC
  FUNC num added(num a)
    FOR k FROM 1 TO 40 DO
      n := n + 1;
    ENDFOR
    RETURN a;
  ENDFUNC
ENDMODULE
"""


@pytest.mark.parametrize("moment", [0.0001, 0.0004, 0.0007, 0.0011, 0.0016, 0.0023, 0.0031])
def test_going_on_in_other_code_executes_nothing_twice(boot, moment):
    """The first breakpoint may come anywhere, deep in loops and calls."""
    results = []
    for debugged in (False, True):
        controller, debugger = boot(NESTED, cycle="once")
        controller.run_for(moment)
        assert controller.task("T_ROB1").state == "running"
        if debugged:
            debugger.add(Breakpoint("m", 14))
        controller.run(max_time=1.0)
        results.append(controller.task("T_ROB1")["m:n"])
    assert results[0] == results[1] == 400


HIDDEN = """MODULE m(NOSTEPIN)
  PERS num n := 0;
  PROC main()
    n := 1;
    inner;
    n := 3;
  ENDPROC
  PROC inner()
    n := 2;
  ENDPROC
ENDMODULE
"""


def test_steps_stay_in_nostepin_module_if_started_there(boot):
    controller, debugger = boot(HIDDEN, cycle="once")
    debugger.add(Breakpoint("m", 5))
    controller.run_for(1.0)
    debugger.step("T_ROB1", "in")
    controller.run_for(1.0)
    assert line(debugger) == 9


def test_time_step_advances_by_given_time(boot):
    controller, debugger = boot()
    with pytest.raises(NotPaused):
        debugger.run_for(0.1)
    controller.run_for(0.2)
    debugger.pause()
    before = controller.now
    debugger.run_for(0.1)
    controller.run_for(5.0)
    assert debugger.halt.reason == "time"
    assert controller.now == pytest.approx(before + 0.1, abs=1e-6)
    # What pauses before the time is over ends the step.
    debugger.add(Breakpoint("m", 9))
    debugger.run_for(3.0)
    controller.run_for(5.0)
    assert debugger.halt.reason == "breakpoint"
    debugger.remove(1)
    debugger.resume()
    controller.run_for(5.0)
    assert debugger.halt is None
