"""Dialogs of the pendant, answered over web services [RWS manual 3HAC050973; code: App SDK]."""

import pytest
from served import STARTED, Caller, make_application, make_runner

from rapidgen.wire.rws import media
from rapidgen.wire.rws.bodies import Generation

MAIN = """MODULE MainModule
    PERS num key := 0;
    PERS num number := 0;
    PERS num pressed := 0;
    VAR num answer;
    VAR btnres button;
    PROC main()
        TPReadFK answer, "Which one?", "Left", "Right", "", "", "None";
        key := answer;
        TPReadNum answer, "How many?";
        number := answer;
        UIMsgBox \\Header:="Ready", "Go on?" \\Buttons:=btnYesNo \\Result:=button;
        pressed := button;
    ENDPROC
ENDMODULE
"""


@pytest.fixture(params=[Generation.ONE, Generation.TWO], ids=["one", "two"])
def caller(request, tmp_path):
    with make_runner(tmp_path, request.param, program=MAIN) as controller_runner:
        caller = Caller(make_application(controller_runner, request.param))
        start = "?action=start" if caller.is_one else "/start"
        form = {**STARTED, "cycle": "once"}
        assert caller.post(f"/rw/rapid/execution{start}", form) == 204
        controller_runner.controller.run_for(0.5)
        yield caller


def answer(caller, name, value):
    (active,) = caller.get("/rw/rapid/uiinstr/active")
    stack = active.text("stack").replace("%", "%25")
    action = "?action=set" if caller.is_one else ""
    return caller.post(f"/rw/rapid/uiinstr/active/param/{stack}/{name}{action}", {"value": value})


def test_dialogs_are_answered_and_the_program_goes_on(caller):
    controller = caller.application.runner.controller
    (active,) = caller.get("/rw/rapid/uiinstr/active")
    assert active.text("instr") == "TPReadFK"
    stack = active.text("stack").replace("%", "%25")
    match = caller.get(f"/rw/rapid/uiinstr/active/params/{stack}")
    notify = {item.title: item.text("value") for item in match}
    assert (notify["TPText"], notify["TPFK2"], notify["TPCompleted"]) == (
        '"Which one?"',
        '"Right"',
        "FALSE",
    )
    (one,) = caller.get(f"/rw/rapid/uiinstr/active/param/{stack}/TPFK1")
    assert one.text("value") == '"Left"'
    assert answer(caller, "TPAnswer", "2") == 204
    controller.run_for(0.5)
    assert controller.tasks["T_ROB1"]["key"] == 0, "it is not complete"
    assert answer(caller, "TPCompleted", "TRUE") == 204
    controller.run_for(0.5)
    assert controller.tasks["T_ROB1"]["key"] == 2
    assert answer(caller, "TPAnswer", "7.5") == 204
    assert answer(caller, "TPCompleted", "TRUE") == 204
    controller.run_for(0.5)
    assert controller.tasks["T_ROB1"]["number"] == 7.5
    assert answer(caller, "Result", "6") == 204
    controller.run_for(0.5)
    assert controller.tasks["T_ROB1"]["pressed"] == 6
    assert caller.send("GET", "/rw/rapid/uiinstr/active").status == 404


def test_what_is_no_answer_is_refused_and_the_dialog_stays(caller):
    assert answer(caller, "TPAnswer", "9") == 204
    assert answer(caller, "TPCompleted", "TRUE") == 400
    assert answer(caller, "TPText", '"else"') == 400
    assert answer(caller, "Nothing", "1") == 404
    assert caller.send("GET", "/rw/rapid/uiinstr/active").status == 200
    wrong = "/rw/rapid/uiinstr/active/params/RAPID/T_ROB1/%25$99"
    assert caller.send("GET", wrong).status == 404


def test_of_two_dialogs_the_newer_one_is_active(caller):
    controller = caller.application.runner.controller
    newer = controller.operator.ask("T_OTHER", "TPReadNum", "more?", (), float)
    (active,) = caller.get("/rw/rapid/uiinstr/active")
    assert active.text("stack").startswith("RAPID/T_OTHER/")
    controller.operator.ask("", "RMMP", "may it?", (), str)  # no program waits in it
    (still,) = caller.get("/rw/rapid/uiinstr/active")
    assert still == active
    controller.operator.withdraw(newer)
    (older,) = caller.get("/rw/rapid/uiinstr/active")
    assert older.text("stack").startswith("RAPID/T_ROB1/")


def test_an_answer_counts_when_it_is_complete_and_in_automatic_mode(caller):
    controller = caller.application.runner.controller
    assert answer(caller, "TPAnswer", "2") == answer(caller, "TPCompleted", "FALSE") == 204
    controller.run_for(0.5)
    assert controller.tasks["T_ROB1"]["key"] == 0
    controller.set_mode("manual_reduced")
    assert answer(caller, "TPCompleted", "TRUE") == 403
    controller.set_mode("auto")
    controller.run_for(0.5)
    assert controller.tasks["T_ROB1"]["key"] == 0
    # What was chosen for a dialog ends with it.
    assert caller.application.dialogs
    controller.start_program()
    controller.run_for(0.1)
    assert answer(caller, "TPCompleted", "TRUE") == 204
    assert not caller.application.dialogs


def test_subscriber_receives_dialogs_and_texts(caller):
    form = {"resources": "1", "1": "/rw/rapid/uiinstr;uievent", "1-p": "1"}
    assert caller.post("/subscription", form) == 201
    app, controller = caller.application, caller.application.runner.controller
    events = []
    app.groups.listen("1", caller.session, events.append)
    controller.operator.write("T_ROB1", "hello")
    assert answer(caller, "TPAnswer", "1") == answer(caller, "TPCompleted", "TRUE") == 204
    controller.run_for(1.0)
    items = [item for event in events for item in media.read(event, "application/xhtml+xml").items]
    notify = [(i.text("instr"), i.text("event"), i.text("msg")) for i in items]
    assert notify == [("TPWrite", "POST", '"hello"'), ("TPReadNum", "SEND", "")]
    (waiting,) = controller.operator.questions
    controller.operator.withdraw(waiting)
    (event,) = events[2:]
    (item,) = media.read(event, "application/xhtml+xml").items
    assert (item.text("instr"), item.text("event")) == ("TPReadNum", "ABORT")
    assert caller.send("DELETE", "/subscription/1").status == 200
    controller.operator.write("T_ROB1", "to no client")
    assert events[3:] == [None]
