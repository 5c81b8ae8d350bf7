"""Sessions of the debug adapter on small programs, with the client of `own_client.py`."""

from contextlib import contextmanager

import pytest

from rapidgen.controller.editor_link import EditorCursor
from tests.dap.own_client import OwnClient, Refused

PROGRAM = """MODULE m
  PERS num total := 0;
  VAR robtarget p := [[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num table{2,3} := [[1,2,3],[4,5,6]];
  PROC main()
    VAR num i := 0;
    FOR k FROM 1 TO 4 DO
      work i, "a";
    ENDFOR
    TPWrite "done";
  ENDPROC
  PROC work(INOUT num n, string word)
    n := n + 1;
    total := total + n;
  ENDPROC
ENDMODULE
"""


def test_breakpoint_step_and_values(client, program):
    path = program(PROGRAM)
    assert client.begin(path, [13])[0]["verified"]
    reason, frame = client.stopped()
    assert (reason, frame["line"], frame["name"]) == ("breakpoint", 13, "work")
    assert frame["source"]["path"] == str(path)
    assert [f["line"] for f in client.frames()] == [13, 8]
    scopes = client.scopes(frame)
    assert {n: v["value"] for n, v in client.variables(scopes["Parameters"]).items()} == {
        "n": "0",
        "word": '"a"',
    }
    client.ask("next", threadId=1)
    assert client.stopped()[1]["line"] == 14
    client.ask("stepOut", threadId=1)
    reason, frame = client.stopped()
    assert (reason, frame["line"]) == ("step", 8)
    assert client.value("i", frame) == "1"
    client.set_lines(path)
    client.ask("continue", threadId=1)
    assert client.event("output", category="stdout")["output"] == "T_ROB1: done\n"
    assert client.event("exited") == {"exitCode": 0}
    client.event("terminated")


def test_records_and_arrays_are_read_in_pages_and_set(client, program):
    client.begin(program(PROGRAM), [13])
    _, frame = client.stopped()
    data = client.variables(client.scopes(frame)["Module m"])
    assert data["p"]["namedVariables"] == 4
    parts = client.variables(data["p"]["variablesReference"])
    assert (
        client.variables(parts["trans"]["variablesReference"])["y"]["evaluateName"] == "p.trans.y"
    )
    rows = client.variables(data["table"]["variablesReference"], start=1, count=1)
    assert list(rows) == ["{2}"]
    row = rows["{2}"]["variablesReference"]
    assert [v["value"] for v in client.variables(row, start=1, count=2).values()] == ["5", "6"]
    changed = client.ask("setVariable", variablesReference=row, name="{2,3}", value="60")
    assert changed["value"] == "60"
    trans = parts["trans"]["variablesReference"]
    client.ask("setVariable", variablesReference=trans, name="x", value="7.5")
    assert client.value("p.trans") == "[7.5,2,3]"
    assert client.value("table{2,3}") == "60"


def test_shared_and_system_scopes(client, program):
    client.begin(program(PROGRAM), [14])
    _, frame = client.stopped()
    scopes = client.scopes(frame)
    assert client.variables(scopes["System"])["state"]["value"] == "running"
    robot = client.variables(scopes["Robots"])["rob1"]
    axes = client.variables(robot["variablesReference"])
    assert axes["rax_5"]["value"] == "30.000 deg"
    assert client.variables(scopes["Shared PERS"]) == {}


def test_condition_hits_and_log_text(client, program):
    path = program(PROGRAM)
    lines = [
        {"line": 13, "condition": "n = 2"},
        {"line": 14, "logMessage": "n is {n}", "hitCondition": "%2"},
    ]
    client.begin(path, lines)
    _, frame = client.stopped()
    assert client.value("n", frame) == "2"
    client.ask("continue", threadId=1)
    assert client.event("output", category="console", line=14)["output"] == "T_ROB1: n is 4\n"
    client.event("exited")


def test_wrong_hits_are_reported_at_the_breakpoint(client, program):
    (placed,) = client.begin(program(PROGRAM), [{"line": 13, "hitCondition": "often"}])
    assert not placed["verified"]
    assert "often" in placed["message"]


def test_routine_breakpoint(client, program):
    client.begin(program(PROGRAM), configured=False)
    answer = client.ask("setFunctionBreakpoints", breakpoints=[{"name": "M:WORK"}, {"name": "no"}])
    assert [one["verified"] for one in answer["breakpoints"]] == [True, False]
    client.ask("configurationDone")
    assert client.stopped()[1]["line"] == 13


def test_stop_on_entry(client, program):
    client.begin(program(PROGRAM), stopOnEntry=True)
    reason, frame = client.stopped()
    assert (reason, frame["line"], frame["name"]) == ("entry", 7, "main")


def test_console_assigns_and_completes(client, program):
    client.begin(program(PROGRAM), [13])
    _, frame = client.stopped()
    assert client.value("n := 41", frame, "repl") == "41"
    assert client.value("n + 1", frame, "hover") == "42"
    with pytest.raises(Refused, match="nothing"):
        client.value("nothing", frame)
    found = client.ask("completions", frameId=frame["id"], text="1 + to", column=7)["targets"]
    assert [(one["label"], one["start"], one["length"]) for one in found] == [("total", 4, 2)]
    found = client.ask("completions", frameId=frame["id"], text="p.tr", column=5)["targets"]
    assert [one["label"] for one in found] == ["trans"]
    found = client.ask("completions", text=":a", column=3)["targets"]
    assert [one["label"] for one in found] == [":answer"]


def test_goto_moves_the_program_pointer(client, program):
    path = program(PROGRAM)
    client.begin(path, [14])
    _, frame = client.stopped()
    source = {"path": str(path)}
    assert client.ask("gotoTargets", source=source, line=15)["targets"] == []
    (target,) = client.ask("gotoTargets", source=source, line=13)["targets"]
    client.ask("goto", threadId=1, targetId=target["id"])
    reason, frame = client.stopped()
    assert (reason, frame["line"]) == ("goto", 13)
    assert client.value("n", frame) == "1"  # incremented once; it is incremented again


def test_restart_boots_the_changed_file(client, program):
    path = program(PROGRAM)
    client.begin(path, [13])
    client.stopped()
    program(PROGRAM.replace("VAR num i := 0", "VAR num i := 70"))
    client.ask("restart")
    client.event("initialized")
    client.set_lines(path, 13)
    client.ask("configurationDone")
    assert client.value("n", client.stopped()[1]) == "70"


ERRORS = """MODULE m
  VAR num n := 0;
  PROC main()
    handled;
    n := 1 / (n - 1);
    n := 5;
  ENDPROC
  PROC handled()
    n := 1 / n;
  ERROR
    n := 1;
    TRYNEXT;
  ENDPROC
ENDMODULE
"""


def test_error_that_stops_the_task_pauses(client, program):
    client.begin(program(ERRORS))
    reason, frame = client.stopped()
    assert (reason, frame["line"]) == ("exception", 5)
    info = client.ask("exceptionInfo", threadId=1)
    assert (info["exceptionId"], info["breakMode"]) == ("ERR_DIVZERO", "unhandled")
    client.ask("continue", threadId=1)
    assert client.event("exited") == {"exitCode": 1}


def test_program_pointer_moves_past_an_error(client, program):
    path = program(ERRORS)
    client.begin(path)
    client.stopped()
    (target,) = client.ask("gotoTargets", source={"path": str(path)}, line=6)["targets"]
    client.ask("goto", threadId=1, targetId=target["id"])
    assert client.stopped()[0] == "goto"
    client.ask("continue", threadId=1)
    assert client.event("exited") == {"exitCode": 0}


def test_filters_select_errors(client, program):
    client.begin(program(ERRORS), filters=(), configured=False)
    options = [{"filterId": "all", "condition": "err_divzero"}]
    client.ask("setExceptionBreakpoints", filters=[], filterOptions=options)
    client.ask("configurationDone")
    assert client.stopped()[1]["line"] == 9
    options = [{"filterId": "all", "condition": "ERR_SOCK_CLOSED"}]
    client.ask("setExceptionBreakpoints", filters=[], filterOptions=options)
    client.ask("continue", threadId=1)
    assert client.event("exited") == {"exitCode": 1}


QUESTION = """MODULE m
  VAR num n;
  PROC main()
    TPReadFK n, "Go on?", "Yes", "No", stEmpty, stEmpty, stEmpty;
    TPReadNum n, "How many?";
    TPWrite "n" \\Num := n;
  ENDPROC
ENDMODULE
"""


def test_dialogs_are_answered_in_the_console(client, program):
    client.begin(program(QUESTION))
    asked = client.event("rapidgen/question")
    assert (asked["text"], asked["choices"]) == ("Go on?", ["Yes", "No"])
    assert ":answer Yes" in client.event("output", category="important")["output"]
    with pytest.raises(Refused):
        client.value(":answer Maybe", context="repl")
    client.value(":answer Yes", context="repl")
    number = client.event("rapidgen/question")["number"]
    client.ask("rapidgen/answer", number=number, value="12")
    assert client.event("output", category="stdout")["output"] == "T_ROB1: n12\n"


EXTRA = """MODULE extra
  PROC extra_work()
    TPWrite "extra";
  ENDPROC
ENDMODULE
"""
QUOTED = EXTRA.replace('"', '""').splitlines()
WRITTEN = "".join(f'    Write f, "{line}";\n' for line in QUOTED)
LOADING = f"""MODULE m
  VAR iodev f;
  PROC main()
    Open "HOME:/extra.mod", f \\Write;
{WRITTEN}    Close f;
    Load \\Dynamic, "HOME:/extra.mod";
    %"extra_work"%;
    UnLoad "HOME:/extra.mod";
  ENDPROC
ENDMODULE
"""


def test_breakpoint_waits_for_its_module(client, program):
    extra = program(EXTRA, "extra.mod")
    path = program(LOADING)
    client.begin(path, configured=False)
    (placed,) = client.set_lines(extra, 3)
    assert not placed["verified"]
    assert "no task has loaded" in placed["message"]
    client.ask("configurationDone")
    changed = client.event("breakpoint")
    assert changed["reason"] == "changed"
    assert changed["breakpoint"]["verified"]
    _, frame = client.stopped()
    assert frame["source"]["path"] == str(extra)
    client.ask("continue", threadId=1)
    assert client.event("loadedSource", reason="removed")["source"]["name"] == "extra.mod"
    client.event("exited")


def test_show_target_and_lines_that_the_page_opens(program):
    runners = []

    @contextmanager
    def page(runner, _target):
        runners.append(runner)
        yield "http://127.0.0.1:1/"

    path = program(PROGRAM.replace('TPWrite "done";', "MoveJ p, v100, fine, tool0;"))
    client = OwnClient(page)
    try:
        client.ask("initialize", adapterID="rapidgen")
        # In real time, what the page asks for wakes a paused controller.
        client.ask("launch", program=str(path), robot="irb120", view=True)
        client.set_lines(path, 13)
        client.ask("configurationDone")
        client.stopped()
        source = {"path": str(path)}
        shown = client.ask("rapidgen/showTarget", source=source, line=10, name="v100")
        assert shown == {"module": "m", "targets": ["p"], "doubt": ""}
        (runner,) = runners
        assert runner.editor.cursor == EditorCursor("m", 10, "v100")
        assert client.ask("rapidgen/showTarget", source=source, line=9)["targets"] == []
        runner.post(lambda: runner.editor.open("M", 13))
        opened = client.event("rapidgen/open")
        assert (opened["source"]["path"], opened["line"]) == (str(path), 13)
        # The page shows the breakpoints of the session: they have one debugger.
        assert [placed.line for placed in runner.debugger.placed.values()] == [13]
    finally:
        client.close()
    assert not runner.editor.is_attached
