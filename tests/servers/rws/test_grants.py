"""Grants by UAS name, and RMMP, which the pendant's user grants."""

import pytest
from served import Caller, code_of, make_application, make_runner

from rapidgen.machine.operator import Answer
from rapidgen.wire.rws.bodies import Generation
from rapidgen.wire.rws.codes import CODES
from rapidgen.wire.rws.grants import GRANTS

GRANT = Answer("Grant", dialog="RMMP")


def pass_time(controller_runner, seconds):
    due = controller_runner.now + seconds
    controller_runner.controller.scheduler.after(round(seconds * 1e9), lambda: None)
    controller_runner.run(lambda: controller_runner.now >= due - 1e-9)


# -- grants -----------------------------------------------------------------------------------

ONE = {
    "UAS_RAPID_EXECUTE": ("POST", "/rw/rapid/execution?action=resetpp", {}),
    "UAS_RAPID_LOADPROGRAM": (
        "POST", "/rw/rapid/tasks/T_ROB1?action=loadmod", {"modulepath": "$HOME/a.mod"}),
    "UAS_RAPID_CURRVALUE": (
        "POST", "/rw/rapid/symbol/data/RAPID/T_ROB1/x?action=set", {"value": "2"}),
    "UAS_IO_WRITE": ("POST", "/rw/iosystem/signals/aoSpeed?action=set", {"lvalue": "1"}),
    "UAS_CFG_WRITE": ("POST", "/rw/cfg?action=load", {}),
    "UAS_REMOTE_WARMSTART": ("POST", "/rw/panel?action=restart", {"restart-mode": "restart"}),
    "UAS_BACKUP": ("POST", "/ctrl/backup?action=backup", {}),
    "UAS_SPEED_DECREASE": (
        "POST", "/rw/panel/speedratio?action=setspeedratio", {"speed-ratio": "50"}),
    "UAS_FTP_WRITE": ("PUT", "/fileservice/$HOME/a.txt", {}),
    "UAS_FTP_READ": ("GET", "/fileservice/$HOME", {}),
}  # fmt: skip


@pytest.mark.parametrize("grant", ONE)
def test_without_its_grant_a_request_is_refused(grant, tmp_path):
    method, target, form = ONE[grant]
    also = {"UAS_FTP_WRITE"} if grant == "UAS_FTP_READ" else set()
    with make_runner(tmp_path) as controller_runner:
        application = make_application(controller_runner, denied=frozenset({grant, *also}))
        reply = Caller(application).send(method, target, form)
        assert (reply.status, code_of(reply)) == (403, CODES["E_UAS_REJECT"])
        allowed = Caller(application, "Admin").send(method, target, form)
        assert allowed.status < 400 or code_of(allowed) != CODES["E_UAS_REJECT"]


def test_a_start_from_afar_takes_a_grant_of_its_own_on_robotware_7(tmp_path):
    """[real 7.21]: not even Admin could start or stop before it was given."""
    with make_runner(tmp_path, Generation.TWO) as controller_runner:
        denied = frozenset({"UAS_REMOTE_START_STOP_IN_AUTO"})
        caller = Caller(make_application(controller_runner, Generation.TWO, denied=denied))
        reply = caller.send("POST", "/rw/rapid/execution/stop", {"stopmode": "stop"})
        assert (reply.status, code_of(reply)) == (403, CODES["E_UAS_REJECT"])


def test_stopping_takes_no_grant_on_robotware_6(tmp_path):
    with make_runner(tmp_path) as controller_runner:
        caller = Caller(make_application(controller_runner, denied=frozenset(GRANTS)))
        assert caller.post("/rw/rapid/execution?action=stop", {"stopmode": "stop"}) == 204


def test_grants_are_listed(tmp_path):
    with make_runner(tmp_path, Generation.TWO) as controller_runner:
        caller = Caller(
            make_application(controller_runner, Generation.TWO, denied=frozenset({"UAS_BACKUP"}))
        )
        notify = {item.text("grantname") for item in caller.get("/uas/user/grants")}
        assert notify == set(GRANTS) - {"UAS_BACKUP"}
        (result,) = caller.get("/users/grant-exists?grant=UAS_BACKUP")
        assert result.text("status") == "false"


# -- RMMP -------------------------------------------------------------------------------------


@pytest.fixture
def manual(tmp_path):
    """A session of RWS 1.0 in manual mode without a grant."""
    with make_runner(tmp_path) as controller_runner:
        controller_runner.controller.operator.attach()
        controller_runner.controller.set_mode("manual_reduced")
        yield Caller(make_application(controller_runner))


def wants(caller):
    """The status of a write."""
    form = {"value": "2"}
    return caller.post("/rw/rapid/symbol/data/RAPID/T_ROB1/x?action=set", form)


def polled(caller):
    (item,) = caller.get("/users/rmmp/poll")
    return item.text("status")


def question(caller):
    return caller.application.controller.operator.questions[0]


def answer(caller, text):
    operator = caller.application.controller.operator
    operator.answer(question(caller).number, text)


def test_granted_at_the_pendant(manual):
    assert wants(manual) == 403
    assert manual.post("/users/rmmp", {"privilege": "modify"}) == 202
    assert question(manual).dialog == "RMMP"
    assert "Default User" in question(manual).text
    assert polled(manual) == "PENDING"
    assert wants(manual) == 403
    answer(manual, "Grant")
    assert polled(manual) == "GRANTED"
    (item,) = manual.get("/users/rmmp")
    assert (item.text("privilege"), item.text("rmmpheldbyme")) == ("modify", "true")
    assert wants(manual) == 204
    assert not manual.application.controller.operator.questions
    started = {
        "regain": "continue", "execmode": "continue", "cycle": "asis", "condition": "none",
        "stopatbp": "disabled", "alltaskbytsp": "false",
    }  # fmt: skip
    assert manual.post("/rw/rapid/execution?action=start", started) == 403  # that is `exec`


def test_denied_at_the_pendant(manual):
    manual.post("/users/rmmp", {"privilege": "modify"})
    answer(manual, "Deny")
    assert polled(manual) == "DENIED"
    assert wants(manual) == 403


def test_a_question_stands_for_ten_seconds_after_the_last_poll(manual):
    controller_runner = manual.application.runner
    manual.post("/users/rmmp", {"privilege": "modify"})
    for _ in range(3):
        pass_time(controller_runner, 6)
        assert polled(manual) == "PENDING"
    pass_time(controller_runner, 10.5)
    assert not controller_runner.controller.operator.questions
    assert polled(manual) == "TIMEOUT"


@pytest.mark.parametrize("end", ["cancel", "logout", "mode", "restart"])
def test_what_was_granted_ends(manual, end):
    app, controller_runner = manual.application, manual.application.runner
    manual.post("/users/rmmp", {"privilege": "exec"})
    answer(manual, "Grant")
    assert wants(manual) == 204
    if end == "cancel":
        assert manual.post("/users/rmmp?action=cancel") == 204
    elif end == "logout":
        manual.get("/logout")
    elif end == "mode":
        controller_runner.controller.set_mode("auto")
        controller_runner.controller.set_mode("manual_reduced")
    else:
        restarts = controller_runner.restarts
        controller_runner.ask_restart()
        controller_runner.run(lambda: controller_runner.restarts > restarts)
        controller_runner.controller.set_mode("manual_reduced")
    caller = manual if end in ("cancel", "mode") else Caller(app)
    assert wants(caller) == 403


def test_one_session_at_a_time(manual):
    other = Caller(manual.application, "Admin")
    manual.post("/users/rmmp", {"privilege": "modify"})
    assert other.post("/users/rmmp", {"privilege": "modify"}) == 403
    answer(manual, "Grant")
    assert wants(other) == 403


def test_a_script_answers(tmp_path):
    with make_runner(tmp_path, answers=[GRANT]) as controller_runner:
        controller_runner.controller.set_mode("manual_reduced")
        caller = Caller(make_application(controller_runner))
        caller.post("/users/rmmp", {"privilege": "modify"})
        pass_time(controller_runner, 0.1)
        assert polled(caller) == "GRANTED"
